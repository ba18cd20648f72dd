//! The time a frame may wait for its background work.

use std::time::{Duration, Instant};

/// Hold the time that is left of a frame's budget, which all its requests share.
#[derive(Debug, Default)]
pub struct Patience {
    /// The budget of a frame.
    frame: Duration,
    left: Duration,
}

/// The most segments of a curve that a frame waits for: a thousand take about a millisecond.
const MOST_SEGMENTS: usize = 1000;

impl Patience {
    /// Give every frame this budget.
    pub fn new(frame: Duration) -> Self {
        Self { frame, left: frame }
    }

    /// The patience with work on so many segments of a curve.
    pub fn with_segments(&mut self, segments: usize) -> Option<&mut Self> {
        (segments <= MOST_SEGMENTS).then_some(self)
    }

    /// Begin a frame with the full budget.
    pub fn renew(&mut self) {
        self.left = self.frame;
    }

    /// Wait with the time that is left, and subtract the time it takes.
    pub fn spend<T>(&mut self, wait: impl FnOnce(Duration) -> T) -> T {
        let begin = Instant::now();
        let waited = wait(self.left);
        self.left = self.left.saturating_sub(begin.elapsed());
        waited
    }
}
