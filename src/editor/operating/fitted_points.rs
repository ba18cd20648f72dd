//! The points of a fit: which are left out, and how far the others are from its curves.

use std::sync::Arc;

use glam::DVec3;

use crate::document::Curve;
use crate::geometry::{Nearest, Progress};

/// The points of a fit, with the places of its curves nearest to them.
#[derive(Debug, Default)]
pub struct FittedPoints {
    /// The numbers of those that the present values leave out, in order.
    pub(super) left_out: Vec<usize>,
    /// How many curves the present values ask for.
    pub(super) curves: usize,
    /// What to expect of the search with the present values, if they ask for more than the points allow.
    pub(super) expectation: Option<String>,
    /// The nearest place of each point; empty until it is measured.
    pub(super) nearest: Vec<Nearest>,
}

impl FittedPoints {
    /// The numbers of the points that the present values leave out, in order.
    pub fn left_out(&self) -> &[usize] {
        &self.left_out
    }

    /// What to expect of the search with the present values, if they ask for more than the points allow.
    pub fn expectation(&self) -> Option<&str> {
        self.expectation.as_deref()
    }

    /// The point that counts and is farthest off, with its distance; `None` until the distances are measured.
    pub fn farthest(&self) -> Option<(usize, f64)> {
        let all = self.nearest.iter().map(|it| it.distance).enumerate();
        let kept = all.filter(|(index, _)| !self.leaves_out(*index));
        kept.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Whether the present values leave a point out.
    pub(super) fn leaves_out(&self, index: usize) -> bool {
        self.left_out.binary_search(&index).is_ok()
    }
}

/// Find the place of some curves nearest to each point; none without a curve, and after a cancellation.
pub(super) fn nearest(
    points: &[DVec3],
    curves: &[Arc<Curve>],
    progress: &Progress,
) -> Option<Vec<Nearest>> {
    let nearest = points.iter().map(|point| {
        let all = curves.iter().map(|curve| curve.polygon.nearest(*point));
        all.min_by(|a, b| a.distance.total_cmp(&b.distance))
            .filter(|_| !progress.is_cancelled())
    });
    nearest.collect()
}
