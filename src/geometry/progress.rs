//! Progress and cancellation of a long computation.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Share with a computation, which may run on another thread, how far it has come and whether its
/// result is still wanted. Clones are handles of the same computation; one made by
/// [`Progress::default`] that nobody else has is never cancelled.
#[derive(Clone, Debug, Default)]
pub struct Progress(Arc<State>);

#[derive(Debug, Default)]
struct State {
    cancelled: AtomicBool,
    /// The bits of the share that is done.
    done: AtomicU64,
}

impl Progress {
    /// Ask the computation to stop as soon as it can.
    pub fn cancel(&self) {
        self.0.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the result is no longer wanted.
    pub fn is_cancelled(&self) -> bool {
        self.0.cancelled.load(Ordering::Relaxed)
    }

    /// Tell which share of the work is done, from 0 to 1.
    pub fn set_done(&self, share: f64) {
        self.0.done.store(share.to_bits(), Ordering::Relaxed);
    }

    /// The share of the work that is done, from 0 to 1.
    pub fn done(&self) -> f64 {
        f64::from_bits(self.0.done.load(Ordering::Relaxed))
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
}
