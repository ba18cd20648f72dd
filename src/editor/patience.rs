//! How long a frame waits for what workers do.

use std::time::{Duration, Instant};

/// Hold how long the frame may still wait for answers that may come at once.
#[derive(Debug, Default)]
pub struct Patience {
    /// How long a frame waits at most, for all of its answers together.
    frame: Duration,
    left: Duration,
}

impl Patience {
    /// Let every frame wait so long.
    pub fn new(frame: Duration) -> Self {
        Self { frame, left: frame }
    }

    /// Begin a frame.
    pub fn renew(&mut self) {
        self.left = self.frame;
    }

    /// Wait for something for as long as is left; what it takes is spent.
    pub fn spend<T>(&mut self, wait: impl FnOnce(Duration) -> T) -> T {
        let begin = Instant::now();
        let waited = wait(self.left);
        self.left = self.left.saturating_sub(begin.elapsed());
        waited
    }
}
