//! Tab chooses among curves that overlap at one place.

use glam::DVec2;

use crate::editor::hand::gesture::THRESHOLD;

/// The choice of Tab among the items at one place, as long as the pointer stays there.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cycle {
    count: usize,
    at: Option<DVec2>,
}

impl Cycle {
    /// How many times Tab was pressed here.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Choose the next item at this place.
    pub fn next(&mut self, at: Option<DVec2>) {
        self.count = self.count.wrapping_add(1);
        self.at = at;
    }

    /// Forget the choice once the pointer has moved by more than a hand that trembles.
    pub fn moved(&mut self, to: DVec2) {
        if self.at.is_none_or(|at| at.distance(to) > THRESHOLD) {
            *self = Self::default();
        }
    }
}
