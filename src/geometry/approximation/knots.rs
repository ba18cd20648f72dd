//! Uniform knots on a curve's parameter.

use super::error::ApproximationError;
use crate::geometry::control_polygon::check_size;

/// Hold where the vertices of a float polygon belong on a curve's parameter t: vertex i at
/// t = first + i · step. That is its Greville abscissa: its n knots lie about it, `step` apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformKnots {
    degree: usize,
    first: f64,
    step: f64,
    count: usize,
    periodic: bool,
}

impl UniformKnots {
    /// Let vertex i of `count` belong to t = `first` + i · `step`.
    ///
    /// # Errors
    /// [`ApproximationError::BadStep`] if the step is not positive or a parameter not finite;
    /// [`ApproximationError::Polygon`] for degrees and counts that make no polygon.
    pub fn of_vertices(
        degree: usize,
        first: f64,
        step: f64,
        count: usize,
    ) -> Result<Self, ApproximationError> {
        check_size(degree, count, false)?;
        let last = first + step * count as f64;
        if !(step > 0.0 && first.is_finite() && last.is_finite()) {
            return Err(ApproximationError::BadStep { step });
        }
        Ok(Self {
            degree,
            first,
            step,
            count,
            periodic: false,
        })
    }

    /// Let a periodic curve of `count` vertices run once round from t = `from` to t = `to`, the whole
    /// period of another one: a segment for each vertex, and parameters are taken modulo the period.
    ///
    /// # Errors
    /// As [`UniformKnots::of_vertices`].
    pub fn around(
        degree: usize,
        [from, to]: [f64; 2],
        count: usize,
    ) -> Result<Self, ApproximationError> {
        check_size(degree, count, true)?;
        let step = (to - from) / count as f64;
        let first = from - 0.5 * (degree as f64 - 1.0) * step;
        let open = Self::of_vertices(degree, first, step, count)?;
        Ok(Self {
            periodic: true,
            ..open
        })
    }

    /// Let a curve of `count` vertices run from t = `from` to t = `to`.
    ///
    /// # Errors
    /// As [`UniformKnots::of_vertices`].
    pub fn between(
        degree: usize,
        [from, to]: [f64; 2],
        count: usize,
    ) -> Result<Self, ApproximationError> {
        check_size(degree, count, false)?;
        let step = (to - from) / (count - degree) as f64;
        let first = from - 0.5 * (degree as f64 - 1.0) * step;
        Self::of_vertices(degree, first, step, count)
    }

    /// The degree n.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The number of vertices.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The distance of the knots.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Whether they run round a periodic curve.
    pub fn is_periodic(&self) -> bool {
        self.periodic
    }

    /// The parameter t that vertex i belongs to; of a periodic curve one of the period.
    pub fn vertex_parameter(&self, index: usize) -> f64 {
        let parameter = self.first + index as f64 * self.step;
        if !self.periodic {
            return parameter;
        }
        let [from, to] = self.interval();
        from + (parameter - from).rem_euclid(to - from)
    }

    /// The parameter t that belongs to the parameter u of the curve: u = 0 is the knot in the middle
    /// between the first and the last of the n first vertices.
    pub fn curve_parameter(&self, u: f64) -> f64 {
        self.first + (u + 0.5 * (self.degree as f64 - 1.0)) * self.step
    }

    /// The parameters that the first and the last vertex belong to; of a periodic curve the period.
    pub fn reach(&self) -> [f64; 2] {
        if self.periodic {
            return self.interval();
        }
        [0, self.count - 1].map(|index| self.vertex_parameter(index))
    }

    /// The start and end of the curve.
    pub fn interval(&self) -> [f64; 2] {
        let segments = match self.periodic {
            true => self.count,
            false => self.count - self.degree,
        };
        [0, segments].map(|u| self.curve_parameter(u as f64))
    }
}
