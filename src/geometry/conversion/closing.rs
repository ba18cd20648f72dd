//! Periodic float polygons from clamped and Bézier polygons that close smoothly.

use glam::DVec3;

use super::exact_polygon::ExactPolygon;
use super::exact_vertices::converted_error;
use crate::geometry::bezier_polygon::BezierPolygon;
use crate::geometry::clamped_polygon::ClampedPolygon;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_kind::PolygonKind;
use crate::geometry::vector;

/// How far, in units of the curve's size, polygons read from a file may lie from a curve of
/// smoothness n − 1: what single-precision writers leave is refused, decimal rounding to ten
/// digits is not.
const SMOOTHNESS_TOLERANCE: f64 = 1e-9;

/// The same where the conversion itself amplifies the rounding of the vertices beyond that, as
/// it does from degree 12 on.
const WORST_TOLERANCE: f64 = 1e-6;

impl ClampedPolygon {
    /// Convert to the periodic float polygon of the same curve: the way back from
    /// [`ClampedPolygon::from_float`] of a periodic one. Each vertex is taken from the end where
    /// errors grow less.
    ///
    /// # Errors
    /// [`PolygonError::NotPeriodic`] if the curve does not close with smoothness n − 1, within
    /// 1e-9 of its size or what the conversion makes of rounding (at most 1e-6);
    /// [`PolygonError::TooFewVertices`] if it has fewer than n + 1 segments; and as
    /// [`ClampedPolygon::to_float`].
    pub fn to_periodic_float(&self) -> Result<FloatPolygon, PolygonError> {
        let from = PolygonKind::Clamped;
        let open = ExactPolygon::from_clamped(self).converted(PolygonKind::Float);
        let float = periodic(self.degree(), &open.folded())?;
        let exact = Self::from_float(&float);
        let given = (self.vertices(), self.weights());
        let tolerance = smoothness_tolerance(self.amplification().norm);
        match worst_difference(given, (exact.vertices(), exact.weights()), |_| tolerance) {
            Some((index, distance)) => Err(PolygonError::NotPeriodic {
                from,
                index,
                distance,
            }),
            None => Ok(float),
        }
    }
}

impl BezierPolygon {
    /// Convert to the periodic float polygon of the same curve: the way back from
    /// [`BezierPolygon::from_float`] of a periodic one. Each float vertex is taken from the
    /// segment in the middle of its knots, across the joint too.
    ///
    /// # Errors
    /// As [`ClampedPolygon::to_periodic_float`].
    pub fn to_periodic_float(&self) -> Result<FloatPolygon, PolygonError> {
        let from = PolygonKind::Bezier;
        let degree = self.degree();
        let vertices = ExactPolygon::from_bezier(self).periodic_blossoms();
        let float = periodic(degree, &vertices)?;
        let exact = Self::from_float(&float);
        let given = (self.vertices(), self.weights());
        let tolerance = smoothness_tolerance(Self::vertex_norm(degree, degree / 2));
        match worst_difference(given, (exact.vertices(), exact.weights()), |_| tolerance) {
            Some((index, distance)) => Err(PolygonError::NotPeriodic {
                from,
                index,
                distance,
            }),
            None => Ok(float),
        }
    }
}

fn periodic(degree: usize, exact: &ExactPolygon) -> Result<FloatPolygon, PolygonError> {
    let to = PolygonKind::Float;
    let (vertices, weights) = exact.rounded(to)?;
    FloatPolygon::new(degree, vertices, weights, true).map_err(|error| converted_error(to, error))
}

/// How far a smooth curve's vertices may be off, in units of its size, if the way to the float
/// polygon and back amplifies by `norm`.
pub(in crate::geometry) fn smoothness_tolerance(norm: f64) -> f64 {
    (2.0 * f64::EPSILON * norm).clamp(SMOOTHNESS_TOLERANCE, WORST_TOLERANCE)
}

/// Points and, of a rational curve, weights.
type Vertices<'a> = (&'a [DVec3], Option<&'a [f64]>);

/// Find the vertex that lies farthest beyond its tolerance, a number in units of the largest
/// coordinate, and its distance; `None` if all lie within. Weights differ by their quotient.
pub(in crate::geometry) fn worst_difference(
    given: Vertices,
    exact: Vertices,
    tolerance: impl Fn(usize) -> f64,
) -> Option<(usize, f64)> {
    let reach = given.0.iter().map(|v| v.abs().max_element());
    let scale = reach.fold(0.0, f64::max);
    let weight = |weights: Option<&[f64]>, index: usize| weights.map_or(1.0, |all| all[index]);
    let pairs = given.0.iter().zip(exact.0).enumerate();
    let excess = pairs.map(|(index, (found, expected))| {
        let quotient = weight(given.1, index) / weight(exact.1, index);
        let distance = vector::length(*found - *expected).max(scale * (quotient - 1.0).abs());
        (index, distance, distance - tolerance(index) * scale)
    });
    let worst = excess.max_by(|a, b| a.2.total_cmp(&b.2))?;
    (worst.2 > 0.0).then_some((worst.0, worst.1))
}
