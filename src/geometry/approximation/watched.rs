//! Curves that end with the computation that evaluates them.

use glam::DVec3;

use crate::geometry::differentiable::Differentiable;
use crate::geometry::interval::Interval;
use crate::geometry::power_series::PowerSeries;
use crate::geometry::progress::Progress;

/// A curve without points from the moment on at which a computation is cancelled: tables of lengths, vertices,
/// distances and levels that are computed from it come to their end, or to an error, at once.
pub struct Watched<'a> {
    curve: &'a dyn Differentiable,
    progress: &'a Progress,
}

impl<'a> Watched<'a> {
    /// Watch whether a computation with a curve is cancelled.
    pub fn new(curve: &'a dyn Differentiable, progress: &'a Progress) -> Self {
        Self { curve, progress }
    }
}

impl Differentiable for Watched<'_> {
    fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3> {
        match self.progress.is_cancelled() {
            true => vec![DVec3::NAN; order + 1],
            false => self.curve.derivatives(t, order),
        }
    }

    fn enclosed(&self, t: &PowerSeries<Interval>) -> Option<[PowerSeries<Interval>; 3]> {
        match self.progress.is_cancelled() {
            true => None,
            false => self.curve.enclosed(t),
        }
    }
}
