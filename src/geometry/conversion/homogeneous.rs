//! Rational curves as polynomial ones in homogeneous coordinates, and back.

use glam::DVec4;

use super::exact_vertices::{check_weight, converted_error};
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_kind::PolygonKind;

impl FloatPolygon {
    /// List the homogeneous vertices (w·x, w·y, w·z, w), the products rounded; w is 1 for a
    /// polynomial curve.
    pub fn homogeneous_vertices(&self) -> Vec<DVec4> {
        let all = 0..self.vertices().len();
        all.map(|index| self.homogeneous(index)).collect()
    }

    /// Make a rational curve of homogeneous vertices: the undoing of
    /// [`FloatPolygon::homogeneous_vertices`] but for one rounding a coordinate. A curve whose
    /// weights are all 1 is polynomial.
    ///
    /// # Errors
    /// [`PolygonError::WeightLost`] if a weight is not positive, [`PolygonError::Overflow`] if a
    /// vertex cannot be held, and as [`FloatPolygon::new`].
    pub fn from_homogeneous(
        degree: usize,
        vertices: &[DVec4],
        periodic: bool,
    ) -> Result<Self, PolygonError> {
        let to = PolygonKind::Float;
        for (index, vertex) in vertices.iter().enumerate() {
            check_weight(to, index, vertex.w, 0.0)?;
        }
        let points = vertices.iter().map(|vertex| vertex.truncate() / vertex.w);
        let weights: Vec<f64> = vertices.iter().map(|vertex| vertex.w).collect();
        let rational = weights.iter().any(|weight| *weight != 1.0);
        let weights = Some(weights).filter(|_| rational);
        Self::new(degree, points.collect(), weights, periodic)
            .map_err(|error| converted_error(to, error))
    }
}
