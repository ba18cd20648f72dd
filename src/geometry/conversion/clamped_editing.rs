//! Moving a vertex of the clamped polygon: the float polygon follows through the conversion.

use glam::DVec3;

use super::clamped_polygon::ClampedPolygon;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;

impl FloatPolygon {
    /// Compute how much a move of one vertex of the clamped polygon is amplified: the largest
    /// |∂P_i/∂C_j| for this vertex j. `None` if there is no such vertex.
    pub fn clamped_vertex_amplification(&self, index: usize) -> Option<f64> {
        let mut unit = vec![DVec3::ZERO; self.segments() + self.degree()];
        unit.get_mut(index)?.x = 1.0;
        let moves = ClampedPolygon::new(self.degree(), unit, None)
            .ok()?
            .to_float()
            .ok()?;
        let moves = moves.vertices().iter().map(|movement| movement.x.abs());
        Some(moves.fold(0.0, f64::max))
    }

    /// Move one vertex of the curve's clamped polygon to a place and return the float polygon of
    /// the curve that this makes.
    ///
    /// Of a polynomial curve the vertices' moves alone are converted, so that what does not
    /// depend on the clamped vertex stays as it is, bit for bit; the moves are up to
    /// [`ClampedPolygon::amplification`] times as large. Of a rational curve the whole polygon is
    /// converted there and back.
    ///
    /// # Errors
    /// [`PolygonError::PeriodicCurve`] if the curve is periodic: opened at u = 0, its ends could
    /// not be moved on their own. [`PolygonError::NoSuchVertex`], [`PolygonError::BadCoordinate`],
    /// [`PolygonError::WeightLost`] or [`PolygonError::Overflow`] if there is no such polygon.
    pub fn with_clamped_vertex(&self, index: usize, place: DVec3) -> Result<Self, PolygonError> {
        self.check_open("changed by its closed S-polygon")?;
        let clamped = ClampedPolygon::from_float(self);
        let mut vertices = clamped.vertices().to_vec();
        let count = vertices.len();
        let Some(vertex) = vertices.get_mut(index) else {
            return Err(PolygonError::NoSuchVertex { index, count });
        };
        let movement = place - *vertex;
        *vertex = place;
        let weights = clamped.weights().map(<[f64]>::to_vec);
        if self.is_rational() {
            return ClampedPolygon::new(self.degree(), vertices, weights)?.to_float();
        }
        // Checked as a polygon of its own, so that a bad place is called by its name.
        ClampedPolygon::new(self.degree(), vertices, None)?;
        let mut moves = vec![DVec3::ZERO; count];
        if let Some(moved) = moves.get_mut(index) {
            *moved = movement;
        }
        let moves = ClampedPolygon::new(self.degree(), moves, None)?.to_float()?;
        let pairs = self.vertices().iter().zip(moves.vertices());
        let vertices = pairs.map(|(vertex, movement)| *vertex + *movement);
        Self::new(self.degree(), vertices.collect(), None, false)
    }
}
