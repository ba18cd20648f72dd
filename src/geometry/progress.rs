//! Progress and cancellation of a long computation.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Share with a computation, which may run on another thread, how far it has come and whether its
/// result is still wanted. Clones are handles of the same computation; one made by
/// [`Progress::default`] that nobody else has is never cancelled.
#[derive(Clone, Debug, Default)]
pub struct Progress {
    shared: Arc<State>,
    /// When the time is up.
    deadline: Option<Instant>,
}

#[derive(Debug, Default)]
struct State {
    cancelled: AtomicBool,
    /// The bits of the share that is done.
    done: AtomicU64,
}

impl Progress {
    /// Give the computation so much time from now on.
    pub fn limited(&self, limit: Duration) -> Self {
        Self {
            shared: Arc::clone(&self.shared),
            deadline: Instant::now().checked_add(limit),
        }
    }

    /// Ask the computation to stop as soon as it can.
    pub fn cancel(&self) {
        self.shared.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the computation must stop: the result is no longer wanted, or the time is up.
    pub fn is_cancelled(&self) -> bool {
        self.shared.cancelled.load(Ordering::Relaxed) || self.is_late()
    }

    /// Whether the time is up. What was found so far may still be wanted.
    pub fn is_late(&self) -> bool {
        self.deadline
            .is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// Tell which share of the work is done, from 0 to 1.
    pub fn set_done(&self, share: f64) {
        self.shared.done.store(share.to_bits(), Ordering::Relaxed);
    }

    /// The share of the work that is done, from 0 to 1.
    pub fn done(&self) -> f64 {
        f64::from_bits(self.shared.done.load(Ordering::Relaxed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clones_share_what_is_done_and_the_wish_to_stop() {
        let here = Progress::default();
        let there = here.clone();
        assert!(!here.is_cancelled());
        assert_eq!(here.done(), 0.0);
        std::thread::spawn(move || {
            there.set_done(0.75);
            there.cancel();
        })
        .join()
        .expect("a thread that does not panic");
        assert!(here.is_cancelled());
        assert_eq!(here.done(), 0.75);
    }

    #[test]
    fn a_computation_whose_time_is_up_must_stop_and_others_may_go_on() {
        let all = Progress::default();
        let part = all.limited(Duration::ZERO);
        assert!(part.is_late() && part.is_cancelled());
        assert!(!all.is_late() && !all.is_cancelled());
        let long = all.limited(Duration::from_secs(1 << 20));
        all.cancel();
        assert!(long.is_cancelled() && !long.is_late());
    }
}
