//! Bézier polygons: one a segment, and the chain of all of them.

use glam::{DVec3, DVec4};

use super::clamped_polygon::{float_from_homogeneous, projected};
use super::error::PolygonError;
use super::float_polygon::{FloatPolygon, check_degree, check_vertices, check_weights};
use super::knots::{clamp_end, clamp_start, float_knots, unclamp_end, unclamp_start};
use super::vector;

/// How far, in units of the curve's size, the Bézier polygons read from a file may lie from a
/// curve of smoothness n − 1: what single-precision writers leave is refused, decimal rounding
/// to ten digits is not.
const SMOOTHNESS_TOLERANCE: f64 = 1e-9;

/// The same where the conversion itself amplifies the rounding of the vertices beyond that, as
/// it does from degree 12 on.
const WORST_TOLERANCE: f64 = 1e-6;

/// Hold a curve by the Bézier polygons of its L segments in one chain of n·L + 1 vertices,
/// neighbours sharing the vertex at their joint.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierPolygon {
    degree: usize,
    vertices: Vec<DVec3>,
    weights: Option<Vec<f64>>,
}

impl BezierPolygon {
    /// Build a chain of Bézier polygons.
    ///
    /// # Errors
    /// As [`FloatPolygon::new`], and [`PolygonError::BezierCount`] if the number of vertices is
    /// not n·L + 1.
    pub fn new(
        degree: usize,
        vertices: Vec<DVec3>,
        weights: Option<Vec<f64>>,
    ) -> Result<Self, PolygonError> {
        check_degree(degree)?;
        let found = vertices.len();
        if found < degree + 1 {
            return Err(PolygonError::TooFewVertices {
                found,
                needed: degree + 1,
                degree,
                periodic: false,
            });
        }
        if !(found - 1).is_multiple_of(degree) {
            return Err(PolygonError::BezierCount { found, degree });
        }
        check_vertices(&vertices)?;
        check_weights(weights.as_deref(), found)?;
        Ok(Self {
            degree,
            vertices,
            weights,
        })
    }

    /// Convert a float polygon, segment by segment (the paper's SB and NSB): interpolation only.
    pub fn from_float(float: &FloatPolygon) -> Self {
        let degree = float.degree();
        let mut chain: Vec<DVec4> = Vec::with_capacity(degree * float.segments() + 1);
        for segment in 0..float.segments() {
            let polygon = segment_bezier(float, segment);
            let shared = usize::from(segment > 0);
            chain.extend_from_slice(&polygon[shared..]);
        }
        let (vertices, weights) = projected(&chain, float.is_rational());
        Self {
            degree,
            vertices,
            weights,
        }
    }

    /// Convert to the float polygon of the same curve (the paper's BS and NBS).
    ///
    /// Each float vertex is extrapolated from the segment nearest to the middle of its knots,
    /// where the rounding of the Bézier vertices grows least.
    ///
    /// # Errors
    /// [`PolygonError::NotSmooth`] if the segments are not one curve of smoothness n − 1 on
    /// uniform knots, within 1e-9 of its size or what the conversion makes of rounding (at most
    /// 1e-6); [`PolygonError::WeightLost`] and
    /// [`PolygonError::Overflow`] as in [`super::ClampedPolygon::to_float`].
    pub fn to_float(&self) -> Result<FloatPolygon, PolygonError> {
        let segments = self.segments();
        let pieces: Vec<Vec<DVec4>> = (0..segments).map(|k| self.segment_float(k)).collect();
        let chain: Vec<DVec4> = (0..segments + self.degree)
            .map(|index| {
                let nearest = self.nearest_segment(index);
                pieces[nearest][index - nearest]
            })
            .collect();
        let float = float_from_homogeneous(self.degree, &chain, self.weights.is_some())?;
        self.check_smooth(&float)?;
        Ok(float)
    }

    /// The degree n.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The n·L + 1 vertices.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// The weights, one a vertex, of a rational curve.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// The number of segments L.
    pub fn segments(&self) -> usize {
        (self.vertices.len() - 1) / self.degree
    }

    /// The segment whose knots lie in the middle of those of a float vertex, as far as there is
    /// one.
    fn nearest_segment(&self, index: usize) -> usize {
        let middle = index.saturating_sub(self.degree / 2);
        middle.min(self.segments() - 1)
    }

    fn segment_float(&self, segment: usize) -> Vec<DVec4> {
        let first = segment * self.degree;
        let mut window: Vec<DVec4> = (first..=first + self.degree)
            .map(|index| {
                let weight = self.weights.as_ref().map_or(1.0, |weights| weights[index]);
                (self.vertices[index] * weight).extend(weight)
            })
            .collect();
        unclamp_segment(self.degree, &mut window);
        window
    }

    fn check_smooth(&self, float: &FloatPolygon) -> Result<(), PolygonError> {
        let exact = Self::from_float(float);
        let reach = self.vertices.iter().map(|v| v.abs().max_element());
        let scale = reach.fold(0.0, f64::max);
        let worst = self
            .vertices
            .iter()
            .zip(&exact.vertices)
            .zip(self.amplifications()?)
            .map(|((given, exact), amplification)| {
                let rounding = 2.0 * f64::EPSILON * amplification;
                let tolerance = rounding.clamp(SMOOTHNESS_TOLERANCE, WORST_TOLERANCE) * scale;
                let distance = vector::length(*given - *exact);
                (distance, distance - tolerance)
            })
            .enumerate()
            .max_by(|a, b| a.1.1.total_cmp(&b.1.1));
        match worst {
            Some((index, (distance, excess))) if excess > 0.0 => {
                Err(PolygonError::NotSmooth { index, distance })
            }
            _ => Ok(()),
        }
    }

    /// Bound what an error of 1 in every vertex does to each vertex on the way to the float
    /// polygon and back.
    fn amplifications(&self) -> Result<Vec<f64>, PolygonError> {
        // The sums of the absolute values of each row of the matrix of one segment.
        let mut rows = vec![0.0; self.degree + 1];
        for column in 0..=self.degree {
            let mut unit = vec![DVec4::ZERO; self.degree + 1];
            unit[column].x = 1.0;
            unclamp_segment(self.degree, &mut unit);
            for (row, vertex) in rows.iter_mut().zip(unit) {
                *row += vertex.x.abs();
            }
        }
        let bounds = (0..self.segments() + self.degree).map(|index| {
            let bound: f64 = rows[index - self.nearest_segment(index)];
            DVec3::new(bound, 0.0, 0.0)
        });
        let bounds = FloatPolygon::new(self.degree, bounds.collect(), None, false)?;
        let back = Self::from_float(&bounds).vertices;
        Ok(back.into_iter().map(|vertex| vertex.x).collect())
    }
}

/// Take the Bézier vertices of one segment to the float vertices, in place.
fn unclamp_segment(degree: usize, window: &mut [DVec4]) {
    let knots = float_knots(degree, window.len());
    unclamp_end(degree, &knots, window);
    unclamp_start(degree, &knots, window);
}

/// Convert one segment of a float polygon to its n + 1 homogeneous Bézier vertices.
///
/// # Panics
/// If the curve has no segment with this number.
pub fn segment_bezier(float: &FloatPolygon, segment: usize) -> Vec<DVec4> {
    let degree = float.degree();
    let mut window: Vec<DVec4> = (segment..=segment + degree)
        .map(|index| float.homogeneous(index))
        .collect();
    let mut knots = float_knots(degree, window.len());
    clamp_start(degree, &mut knots, &mut window);
    clamp_end(degree, &mut knots, &mut window);
    window
}
