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
    /// The part of the whole work whose shares are told.
    part: Part,
}

/// A part of some work, from one share of it to another.
#[derive(Clone, Copy, Debug)]
struct Part {
    from: f64,
    to: f64,
}

impl Default for Part {
    fn default() -> Self {
        Self { from: 0.0, to: 1.0 }
    }
}

impl Part {
    /// The share of the whole that a share of the part is.
    fn at(self, share: f64) -> f64 {
        self.from + (self.to - self.from) * share
    }
}

#[derive(Debug, Default)]
struct State {
    cancelled: AtomicBool,
    /// The bits of the share that is done.
    done: AtomicU64,
}

impl Progress {
    /// Give a part of the computation so much time from now on, and no more than the whole has.
    pub fn limited(&self, limit: Duration) -> Self {
        let own = Instant::now().checked_add(limit);
        Self {
            deadline: own.into_iter().chain(self.deadline).min(),
            ..self.clone()
        }
    }

    /// Watch the same computation for what must be done however little time there is.
    pub fn without_limit(&self) -> Self {
        Self {
            deadline: None,
            ..self.clone()
        }
    }

    /// Give the computation this share of the time that is left, if its time is limited.
    pub fn hurried(&self, share: f64) -> Self {
        let now = Instant::now();
        let left = self
            .deadline
            .map(|deadline| deadline.saturating_duration_since(now));
        Self {
            deadline: left.map(|left| now + left.mul_f64(share.clamp(0.0, 1.0))),
            ..self.clone()
        }
    }

    /// Watch a part of the computation, which is from one share of the whole work to another.
    pub fn part(&self, from: f64, to: f64) -> Self {
        let part = Part {
            from: self.part.at(from),
            to: self.part.at(to),
        };
        Self {
            part,
            ..self.clone()
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

    /// Tell which share of the work is done, from 0 to 1. What was told before stays if it was more.
    pub fn set_done(&self, share: f64) {
        // Positive numbers have the order of their bits.
        let done = self.part.at(share.clamp(0.0, 1.0)).max(0.0);
        if !done.is_nan() {
            self.shared
                .done
                .fetch_max(done.to_bits(), Ordering::Relaxed);
        }
    }

    /// The share of the whole work that is done, from 0 to 1.
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
        assert!(part.limited(Duration::from_secs(1)).is_late());
        let long = all.limited(Duration::from_secs(1 << 20));
        all.cancel();
        assert!(long.is_cancelled() && !long.is_late());
    }

    #[test]
    fn what_is_done_never_goes_back_and_parts_tell_their_share_of_the_whole() {
        let all = Progress::default();
        let last = all.part(0.5, 1.0);
        last.part(0.0, 0.5).set_done(0.5);
        assert_eq!(all.done(), 0.625);
        for (share, done) in [
            (0.0, 0.625),
            (0.5, 0.75),
            (f64::NAN, 0.75),
            (7.0, 1.0),
            (-1.0, 1.0),
        ] {
            last.set_done(share);
            assert_eq!((all.done(), last.done()), (done, done), "{share}");
        }
    }

    #[test]
    fn a_hurried_computation_has_a_share_of_the_time() {
        let all = Progress::default().limited(Duration::from_secs(1 << 20));
        assert!(all.hurried(0.0).is_late() && !all.hurried(0.5).is_late());
        assert!(!Progress::default().hurried(0.0).is_late());
    }
}
