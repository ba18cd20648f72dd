//! How long a frame waits for what workers do.

use std::time::{Duration, Instant};

/// Hold how long the frame may still wait for answers that may come at once.
#[derive(Debug)]
pub struct Patience {
    left: Duration,
}

impl Patience {
    /// How long a frame waits at most, for all of its answers together.
    const FRAME: Duration = Duration::from_millis(4);

    /// Begin a frame.
    pub fn renew(&mut self) {
        self.left = Self::FRAME;
    }

    /// Wait for something for as long as is left; what it takes is spent.
    pub fn spend<T>(&mut self, wait: impl FnOnce(Duration) -> T) -> T {
        let begin = Instant::now();
        let waited = wait(self.left);
        self.left = self.left.saturating_sub(begin.elapsed());
        waited
    }
}

impl Default for Patience {
    fn default() -> Self {
        Self { left: Self::FRAME }
    }
}
