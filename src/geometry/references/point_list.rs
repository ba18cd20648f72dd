//! Points in an order, as a reference: a drawing made of straight lines.

use std::sync::Arc;

use glam::DVec3;

use super::error::ReferenceError;
use crate::geometry::control_polygon::MAX_MAGNITUDE;

/// Hold at least two points with finite coordinates, and how much each counts.
#[derive(Clone, Debug, PartialEq)]
pub struct PointList {
    points: Arc<[DVec3]>,
    weights: Option<Arc<[f64]>>,
    is_apart: bool,
}

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
            None => Ok(Self {
                points: points.into(),
                weights: None,
                is_apart: false,
            }),
        }
    }

    /// Give each point a weight: how much it counts in a fit.
    ///
    /// # Errors
    /// [`ReferenceError::BadWeight`] if one is negative or infinite, or there is not one for each point;
    /// [`ReferenceError::NoWeight`] if all are 0.
    pub fn with_weights(self, weights: Vec<f64>) -> Result<Self, ReferenceError> {
        let is_good = |weight: &f64| (0.0..=MAX_MAGNITUDE).contains(weight);
        let count = self.points.len();
        if let Some(index) = weights.iter().position(|weight| !is_good(weight)) {
            return Err(ReferenceError::BadWeight { index });
        }
        if weights.len() != count {
            let index = weights.len().min(count);
            return Err(ReferenceError::BadWeight { index });
        }
        if weights.iter().all(|weight| *weight == 0.0) {
            return Err(ReferenceError::NoWeight);
        }
        Ok(Self {
            weights: Some(weights.into()),
            ..self
        })
    }

    /// Make the list larger about the origin.
    ///
    /// # Errors
    /// [`ReferenceError::BadPoint`] if a point leaves its range.
    pub(super) fn scaled(&self, factor: f64) -> Result<Self, ReferenceError> {
        let points = self.points.iter().map(|point| factor * *point);
        Ok(Self {
            points: Self::new(points.collect())?.points,
            ..self.clone()
        })
    }

    /// Take the points as single ones: no straight lines join them in drawings.
    #[must_use]
    pub fn apart(self) -> Self {
        Self {
            is_apart: true,
            ..self
        }
    }

    /// Whether the points are single ones, which no straight lines join in drawings.
    pub fn is_apart(&self) -> bool {
        self.is_apart
    }

    /// The weights of the points, if they differ.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// The points.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Whether all of them lie in the plane z = 0.
    pub fn is_planar(&self) -> bool {
        self.points.iter().all(|point| point.z == 0.0)
    }

    /// The point at t of the line through all points, point i at t = i, and its derivatives: those
    /// above the first are 0. Where two legs meet the later one counts.
    pub(super) fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3> {
        let last = self.points.len() - 2;
        let leg = (t.floor() as usize).min(last);
        self.leg_derivatives(leg, t - leg as f64, order)
    }

    /// As [`PointList::derivatives`], on a given leg: t runs from 0 to 1 on it.
    pub(super) fn leg_derivatives(&self, leg: usize, t: f64, order: usize) -> Vec<DVec3> {
        let (from, to) = (self.points[leg], self.points[leg + 1]);
        let mut values = vec![DVec3::ZERO; order + 1];
        values[0] = from.lerp(to, t);
        if let Some(first) = values.get_mut(1) {
            *first = to - from;
        }
        values
    }
}
