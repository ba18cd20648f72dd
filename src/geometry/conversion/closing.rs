//! Checks of periodic polygons, and the largest difference of two polygons.

use crate::geometry::control_polygon::ControlPolygon;
use crate::geometry::error::PolygonError;
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

/// Find the vertex that lies farthest from its counterpart, and its distance. Weights differ by
/// their quotient, times the largest coordinate.
pub(in crate::geometry) fn worst_difference(
    given: &ControlPolygon,
    exact: &ControlPolygon,
) -> (usize, f64) {
    let scale = vector::reach(given.vertices());
    let pairs = given.weighted_vertices().zip(exact.weighted_vertices());
    let distances = pairs.map(|((found, weight), (expected, exact))| {
        let quotient = weight / exact;
        vector::length(found - expected).max(scale * (quotient - 1.0).abs())
    });
    let worst = distances.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    worst.unwrap_or((0, 0.0))
}
