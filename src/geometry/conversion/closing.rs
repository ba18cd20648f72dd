//! Polygons that close, and how far apart two polygons are.

use glam::DVec3;

use super::exact_polygon::ExactPolygon;
use super::exact_vertices::converted_error;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_kind::PolygonKind;
use crate::geometry::vector;

/// Refuse too few segments for a periodic curve.
///
/// # Errors
/// [`PolygonError::TooFewVertices`].
pub(in crate::geometry) fn check_periodic(
    degree: usize,
    segments: usize,
) -> Result<(), PolygonError> {
    if segments > degree {
        return Ok(());
    }
    Err(PolygonError::TooFewVertices {
        found: segments,
        needed: degree + 1,
        degree,
        periodic: true,
    })
}

/// Round the vertices of a float polygon to a periodic one.
///
/// # Errors
/// As [`ExactPolygon::to_float`].
pub(in crate::geometry) fn periodic(exact: &ExactPolygon) -> Result<FloatPolygon, PolygonError> {
    let to = PolygonKind::Float;
    let (vertices, weights) = exact.rounded()?;
    FloatPolygon::new(exact.degree(), vertices, weights, true)
        .map_err(|error| converted_error(to, error))
}

/// Points and, of a rational curve, weights.
type Vertices<'a> = (&'a [DVec3], Option<&'a [f64]>);

/// Find the vertex that lies farthest from its counterpart, and its distance. Weights differ by
/// their quotient, times the largest coordinate.
pub(in crate::geometry) fn worst_difference(given: Vertices, exact: Vertices) -> (usize, f64) {
    let reach = given.0.iter().map(|v| v.abs().max_element());
    let scale = reach.fold(0.0, f64::max);
    let weight = |weights: Option<&[f64]>, index: usize| weights.map_or(1.0, |all| all[index]);
    let pairs = given.0.iter().zip(exact.0).enumerate();
    let distances = pairs.map(|(index, (found, expected))| {
        let quotient = weight(given.1, index) / weight(exact.1, index);
        let distance = vector::length(*found - *expected).max(scale * (quotient - 1.0).abs());
        (index, distance)
    });
    let worst = distances.max_by(|a, b| a.1.total_cmp(&b.1));
    worst.unwrap_or((0, 0.0))
}
