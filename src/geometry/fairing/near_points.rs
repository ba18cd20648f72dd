//! A curve near points, and how far it is from them.

use glam::DVec3;

use super::least_squares::LeastSquares;
use crate::geometry::banded::difference_stencil;
use crate::geometry::basis::uniform_basis_derivative;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::nearest::refined_parameter;

/// The order of the differences of the vertices that fairness keeps small.
pub(in crate::geometry) const FAIR_ORDER: usize = 3;

/// The weight by which points hold the curve along itself.
const ALONG: f64 = 0.2;

/// A curve near points that follow each other along it.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::geometry) struct NearPoints {
    /// The polygon.
    pub(in crate::geometry) polygon: FloatPolygon,
    /// For every point the parameter of the curve's nearest point; those of the first and the last are
    /// the ends.
    pub(in crate::geometry) places: Vec<f64>,
}

/// The points near a curve, and their distance from it.
#[derive(Clone, Copy)]
pub(in crate::geometry) struct Points<'a> {
    /// The points in their order along the curve.
    pub(in crate::geometry) points: &'a [DVec3],
    /// How much each of them counts.
    pub(in crate::geometry) weights: &'a [f64],
    /// The weight λ of Σ |Δ³P|².
    pub(in crate::geometry) fairness: f64,
    /// The unit σ of distances: about how far points are off any such curve.
    pub(in crate::geometry) noise: f64,
}

impl NearPoints {
    /// Find the nearest parameters, beginning at known ones, at most a segment away from them.
    pub(in crate::geometry) fn new(polygon: FloatPolygon, points: &[DVec3], known: &[f64]) -> Self {
        let end = polygon.segments() as f64;
        let last = points.len().saturating_sub(1);
        let place = |(index, (point, start)): (usize, (&DVec3, &f64))| {
            if index == 0 || index == last {
                return *start;
            }
            let bracket = [(start - 1.0).max(0.0), (start + 1.0).min(end)];
            let refined = refined_parameter(*point, *start, bracket, |u| polygon.jet(u));
            let distance = |u: f64| polygon.point(u).distance_squared(*point);
            if distance(refined) < distance(*start) {
                refined
            } else {
                *start
            }
        };
        let places = points.iter().zip(known).enumerate().map(place).collect();
        Self { polygon, places }
    }

    /// From each point to the curve.
    pub(in crate::geometry) fn offsets(&self, points: &[DVec3]) -> Vec<DVec3> {
        let offsets = points.iter().zip(&self.places);
        offsets
            .map(|(point, u)| self.polygon.point(*u) - *point)
            .collect()
    }

    /// The same with moved vertices.
    ///
    /// # Errors
    /// [`PolygonError`] if a vertex left the range of numbers.
    pub(super) fn moved(
        &self,
        vertices: Vec<DVec3>,
        points: &[DVec3],
    ) -> Result<Self, PolygonError> {
        let polygon = FloatPolygon::new(self.polygon.degree(), vertices, None, false)?;
        Ok(Self::new(polygon, points, &self.places))
    }
}

impl Points<'_> {
    /// Evaluate Σ |C(uᵢ) − pᵢ|² / σ².
    pub(super) fn square(&self, near: &NearPoints) -> f64 {
        let offsets = near.offsets(self.points);
        let weighed = offsets.iter().zip(self.weights);
        weighed
            .map(|(offset, weight)| weight * (*offset / self.noise).length_squared())
            .sum()
    }

    /// Evaluate Σ |C(uᵢ) − pᵢ|² / σ² + λ Σ |Δ³P|² / σ².
    pub(super) fn value(&self, near: &NearPoints) -> f64 {
        let differences = self.differences(&near.polygon);
        let fair: f64 = differences
            .iter()
            .map(|difference| difference.length_squared())
            .sum();
        self.square(near) + fair
    }

    /// Add the residuals of this sum. A point's parameter follows the curve, so that what moves the curve
    /// along itself counts for little, but at its ends.
    pub(super) fn gather(&self, near: &NearPoints, squares: &mut LeastSquares) {
        let polygon = &near.polygon;
        let end = polygon.segments() as f64;
        let placed = self.points.iter().zip(&near.places).zip(self.weights);
        for ((point, u), weight) in placed {
            let factor = weight.sqrt() / self.noise;
            let (segment, t) = polygon.locate(*u);
            let basis: Vec<f64> = uniform_basis_derivative(polygon.degree(), 0, t);
            let basis = basis.iter().enumerate();
            let stencil: Vec<(usize, f64)> = basis
                .map(|(index, value)| (segment + index, factor * value))
                .collect();
            let jet = polygon.jet(*u);
            let off = factor * (jet.point - *point);
            let along = jet.first.try_normalize();
            let Some(along) = along.filter(|_| *u > 0.0 && *u < end) else {
                squares.add_vector(off, &stencil);
                continue;
            };
            let mut add = |direction: DVec3, weight: f64| {
                let gradient = stencil.iter();
                let gradient: Vec<(usize, DVec3)> = gradient
                    .map(|(vertex, factor)| (*vertex, weight * *factor * direction))
                    .collect();
                squares.add(weight * off.dot(direction), &gradient);
            };
            add(along, ALONG);
            let (first, second) = along.any_orthonormal_pair();
            add(first, 1.0);
            add(second, 1.0);
        }
        let stencil = fair_stencil(polygon);
        let factor = self.fair_factor();
        for (first, difference) in self.differences(polygon).into_iter().enumerate() {
            let entries = stencil.iter().enumerate();
            let entries: Vec<(usize, f64)> = entries
                .map(|(index, entry)| (first + index, factor * entry))
                .collect();
            squares.add_vector(difference, &entries);
        }
    }

    /// The differences of the vertices, weighed.
    fn differences(&self, polygon: &FloatPolygon) -> Vec<DVec3> {
        let stencil = fair_stencil(polygon);
        let factor = self.fair_factor();
        let difference = |window: &[DVec3]| -> DVec3 {
            let terms = window.iter().zip(&stencil);
            factor * terms.map(|(vertex, entry)| *entry * *vertex).sum::<DVec3>()
        };
        let windows = polygon.vertices().windows(stencil.len());
        windows.map(difference).collect()
    }

    fn fair_factor(&self) -> f64 {
        self.fairness.sqrt() / self.noise
    }
}

/// The differences that fairness keeps small, of as high an order as there are vertices for.
fn fair_stencil(polygon: &FloatPolygon) -> Vec<f64> {
    difference_stencil(FAIR_ORDER.min(polygon.vertices().len() - 1))
}
