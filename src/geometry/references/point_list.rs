//! Points in an order, as a reference: a drawing made of straight lines.

use std::sync::Arc;

use glam::DVec3;

use super::error::ReferenceError;
use crate::geometry::control_polygon::MAX_MAGNITUDE;

/// Hold at least two points with finite coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct PointList(Arc<[DVec3]>);

impl PointList {
    /// Check points.
    ///
    /// # Errors
    /// [`ReferenceError::TooFewPoints`] and [`ReferenceError::BadPoint`].
    pub fn new(points: Vec<DVec3>) -> Result<Self, ReferenceError> {
        let found = points.len();
        if found < 2 {
            return Err(ReferenceError::TooFewPoints { found });
        }
        let bad = |point: &DVec3| !(point.abs().max_element() <= MAX_MAGNITUDE);
        match points.iter().position(|point| bad(point) || point.is_nan()) {
            Some(index) => Err(ReferenceError::BadPoint { index }),
            None => Ok(Self(points.into())),
        }
    }

    /// The points.
    pub fn points(&self) -> &[DVec3] {
        &self.0
    }

    /// Whether all of them lie in the plane z = 0.
    pub fn is_planar(&self) -> bool {
        self.0.iter().all(|point| point.z == 0.0)
    }

    /// The point at t of the line through all points, point i at t = i, and its derivatives: those
    /// above the first are 0. Where two legs meet the later one counts.
    pub(super) fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3> {
        let last = self.0.len() - 2;
        let leg = (t.floor() as usize).min(last);
        self.leg_derivatives(leg, t - leg as f64, order)
    }

    /// As [`PointList::derivatives`], on a given leg: t runs from 0 to 1 on it.
    pub(super) fn leg_derivatives(&self, leg: usize, t: f64, order: usize) -> Vec<DVec3> {
        let (from, to) = (self.0[leg], self.0[leg + 1]);
        let mut values = vec![DVec3::ZERO; order + 1];
        values[0] = from.lerp(to, t);
        if let Some(first) = values.get_mut(1) {
            *first = to - from;
        }
        values
    }
}
