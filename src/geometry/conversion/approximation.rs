//! A polygon in place of another.

use crate::geometry::float_polygon::FloatPolygon;

/// Hold a polygon that stands for another, and how well it does.
#[derive(Clone, Debug, PartialEq)]
pub struct Approximation {
    /// The polygon.
    pub polygon: FloatPolygon,
    /// A bound of the distance between the two curves at corresponding parameters; 0 if the
    /// polygon is exact.
    pub deviation: f64,
    /// Whether the polygon is the exact one, but for the rounding of its numbers to doubles.
    pub exact: bool,
}

impl Approximation {
    /// Say that a polygon is exact.
    pub(in crate::geometry) fn exact(polygon: FloatPolygon) -> Self {
        Self {
            polygon,
            deviation: 0.0,
            exact: true,
        }
    }
}
