//! Bézier polygons: one a segment, and the chain of all of them.

use std::ops::Deref;

use glam::{DVec3, DVec4};

use super::exact_vertices::ExactVertices;
use super::knots::clamp;
use super::whole_vertices::rounded_chain;
use crate::geometry::control_polygon::ControlPolygon;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;

/// Hold a curve by the Bézier polygons of its L segments in one chain of n·L + 1 vertices,
/// neighbours sharing the vertex at their joint.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierPolygon(ControlPolygon);

impl Deref for BezierPolygon {
    type Target = ControlPolygon;

    fn deref(&self) -> &ControlPolygon {
        &self.0
    }
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
        let polygon = ControlPolygon::new(degree, vertices, weights, false)?;
        let found = polygon.vertices.len();
        if !(found - 1).is_multiple_of(degree) {
            return Err(PolygonError::BezierCount { found, degree });
        }
        Ok(Self(polygon))
    }

    /// Convert a float polygon, segment by segment (the paper's SB and NSB): interpolation only,
    /// in double-double arithmetic, and exactly where that leaves a number too few digits, so each
    /// is the exact one rounded. A periodic curve runs round once from u = 0.
    pub fn from_float(float: &FloatPolygon) -> Self {
        let degree = float.degree();
        let given = ExactVertices::of(&float.unrolled());
        let (vertices, weights) = rounded_chain(degree, &given);
        Self(ControlPolygon {
            degree,
            vertices,
            weights,
        })
    }

    /// Convert to the float polygon of the same curve (the paper's BS and NBS): that of
    /// [`BezierPolygon::nearest_float`].
    ///
    /// # Errors
    /// As [`BezierPolygon::nearest_float`].
    pub fn to_float(&self) -> Result<FloatPolygon, PolygonError> {
        Ok(self.nearest_float()?.polygon)
    }

    /// The number of segments L.
    pub fn segments(&self) -> usize {
        (self.vertices.len() - 1) / self.degree
    }
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
    clamp(degree, &mut window);
    window
}
