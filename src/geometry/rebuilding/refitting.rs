//! The curve by another number of segments or another degree, nearest in its own parameter.

use glam::DVec4;

use crate::geometry::banded::{BandedQr, BandedRow};
use crate::geometry::basis::uniform_basis_derivative;
use crate::geometry::control_polygon::check_degree;
use crate::geometry::conversion::approximation::Approximation;
use crate::geometry::conversion::deviation::from_part;
use crate::geometry::conversion::exact_vertices::converted_float;
use crate::geometry::conversion::quasi_interpolation::{NewKnots, quasi_interpolated};
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::pivoted_cholesky::PivotedCholesky;

/// The samples of a segment beyond its degree.
const MORE_SAMPLES: usize = 3;

/// Repeated corrections of what rounding leaves of the conditions at the ends.
const CORRECTIONS: usize = 3;

/// Pivots below this share of the largest count as zero.
const RANK_TOLERANCE: f64 = 1e-13;

impl FloatPolygon {
    /// Approximate the curve in its own parameter by one of another degree or another number of segments, whose
    /// parameter runs evenly along it.
    ///
    /// Halved segments give the curve itself. Otherwise the vertices of an open curve minimise Σ|ΔC|², from degree 4 on
    /// Σ|ΔC|² + |ΔC″|² + |ΔC‴|², the differences from the curve at samples, the derivatives by the new parameter; its
    /// ends keep their points and, where there are vertices enough, their derivatives. Those of a periodic curve are
    /// taken from its derivatives in the middle of their knots, as in [`FloatPolygon::with_degree`]. Rational curves
    /// are approximated in homogeneous coordinates.
    ///
    /// # Errors
    /// As [`FloatPolygon::with_degree`].
    pub fn refitted(&self, degree: usize, segments: usize) -> Result<Approximation, PolygonError> {
        check_degree(degree)?;
        let own = self.segments();
        let halvings = (0..usize::BITS).find(|halvings| own << halvings >= segments);
        if let Some(halvings) =
            halvings.filter(|it| degree == self.degree() && own << it == segments)
        {
            let halved = (0..halvings).try_fold(self.clone(), |polygon, _| polygon.subdivided())?;
            return Ok(Approximation::exact(halved));
        }
        let knots = NewKnots {
            degree,
            start: 0.0,
            step: own as f64 / segments as f64,
            segments,
            periodic: self.is_periodic(),
        };
        let polygon = self.nearest_on(&knots)?;
        Ok(Approximation {
            deviation: from_part(self, knots.start, knots.step, &polygon),
            polygon,
            exact: false,
        })
    }

    /// The curve on new knots that is nearest to this one in its own parameter.
    pub(super) fn nearest_on(&self, knots: &NewKnots) -> Result<FloatPolygon, PolygonError> {
        let nearest = match knots.periodic {
            true => None,
            false => self.least_squares(knots),
        };
        let Some(vertices) = nearest else {
            return quasi_interpolated(self, knots);
        };
        let points = vertices.iter().map(|it| it.truncate() / it.w);
        let weights = vertices.iter().map(|it| it.w).collect();
        let weights = self.is_rational().then_some(weights);
        converted_float(knots.degree, (points.collect(), weights), false)
    }

    /// The homogeneous vertices of the open curve with the least sum of squares at even samples, whose ends are just
    /// where this curve's are; `None` if rounding leaves them undetermined.
    fn least_squares(&self, knots: &NewKnots) -> Option<Vec<DVec4>> {
        let &NewKnots {
            degree, segments, ..
        } = knots;
        let count = segments + degree;
        let samples = degree + MORE_SAMPLES;
        let places = (0..segments).flat_map(|segment| {
            let sample = move |it| (segment, (it as f64 + 0.5) / samples as f64);
            (0..samples).map(sample)
        });
        let rows: Vec<(usize, Vec<f64>, DVec4)> = places
            .flat_map(|(segment, t)| orders_met(degree).iter().map(move |it| (segment, t, *it)))
            .map(|(segment, t, order)| {
                let basis = uniform_basis_derivative(degree, order, t);
                (segment, basis, self.paced(knots, segment, t, order))
            })
            .collect();
        // The outer vertices hardly act: each unknown is measured by what it does.
        let mut scales = vec![0.0; count];
        for (segment, basis, _) in &rows {
            for (scale, value) in scales[*segment..].iter_mut().zip(basis) {
                *scale += value * value;
            }
        }
        let scales: Vec<f64> = scales.into_iter().map(|it| it.sqrt().recip()).collect();
        let scaled = |segment: usize, basis: &[f64]| -> Vec<f64> {
            let pairs = basis.iter().zip(&scales[segment..]);
            pairs.map(|(value, scale)| value * scale).collect()
        };
        let orders = match (degree, count) {
            (2.., 4..) => 2,
            _ => 1,
        };
        let conditions: Vec<(Vec<f64>, DVec4)> = [(0, 0.0), (segments - 1, 1.0)]
            .into_iter()
            .flat_map(|(segment, t)| (0..orders).map(move |order| (segment, t, order)))
            .map(|(segment, t, order)| {
                let mut row = vec![0.0; count];
                let basis = scaled(segment, &uniform_basis_derivative(degree, order, t));
                row[segment..]
                    .iter_mut()
                    .zip(basis)
                    .for_each(|(a, b)| *a = b);
                (row, self.paced(knots, segment, t, order))
            })
            .collect();
        let mut vertices = vec![DVec4::W; count];
        let axes = if self.is_rational() { 4 } else { 3 };
        for axis in 0..axes {
            let band = rows.iter().map(|(segment, basis, value)| BandedRow {
                first: *segment,
                entries: scaled(*segment, basis),
                right: value[axis],
            });
            let factors = BandedQr::new(band.collect(), count)?;
            let goals: Vec<(&[f64], f64)> = conditions
                .iter()
                .map(|(row, goal)| (&row[..], goal[axis]))
                .collect();
            let found = constrained(&factors, &goals)?;
            for (vertex, (value, scale)) in vertices.iter_mut().zip(found.iter().zip(&scales)) {
                vertex[axis] = value * scale;
            }
        }
        Some(vertices)
    }

    /// A derivative of the homogeneous curve by the parameter of a curve on new knots.
    fn paced(&self, knots: &NewKnots, segment: usize, t: f64, order: usize) -> DVec4 {
        let (segment, t) = self.locate(knots.start + knots.step * (segment as f64 + t));
        let basis: Vec<f64> = uniform_basis_derivative(self.degree(), order, t);
        let terms = basis.iter().enumerate();
        let terms = terms.map(|(index, value)| *value * self.homogeneous(segment + index));
        knots.step.powi(order as i32) * terms.sum::<DVec4>()
    }
}

/// The derivatives that are met beside the points: those that the slope of the curvature is made of, so that features
/// stay, where a curve of the degree has them without jumps.
fn orders_met(degree: usize) -> &'static [usize] {
    match degree {
        4.. => &[0, 2, 3],
        _ => &[0],
    }
}

/// The least-squares solution that meets some linear conditions.
fn constrained(factors: &BandedQr, conditions: &[(&[f64], f64)]) -> Option<Vec<f64>> {
    let responses: Vec<Vec<f64>> = conditions
        .iter()
        .map(|(row, _)| factors.solve(row))
        .collect();
    let entry = |a: usize, b: usize| dot(conditions[a].0, &responses[b]);
    let gram = PivotedCholesky::new(conditions.len(), entry, RANK_TOLERANCE)?;
    let mut solution = factors.solution();
    for _ in 0..CORRECTIONS {
        let missing = conditions.iter();
        let missing: Vec<f64> = missing
            .map(|(row, goal)| goal - dot(row, &solution))
            .collect();
        for (response, factor) in responses.iter().zip(gram.solve(&missing)) {
            for (value, change) in solution.iter_mut().zip(response) {
                *value += factor * change;
            }
        }
    }
    Some(solution)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
