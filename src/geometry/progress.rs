//! Progress and cancellation of a long computation, and the best it has found so far.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use cpu_time::ThreadTime;

use super::float_polygon::FloatPolygon;

/// Share with a computation, which may run on another thread, how far it has come and whether its
/// result is still wanted. Clones are handles of the same computation; one made by
/// [`Progress::default`] that nobody else has is never cancelled.
#[derive(Clone, Debug)]
pub struct Progress {
    shared: Arc<State>,
    /// When the time is up, by the time that the thread has computed: other programs that run do not change a result.
    deadline: Option<Duration>,
    /// The part of the whole work whose shares are told.
    part: Part,
    /// Which of the curves of the result is searched for; `None` shows no curve.
    curve: Option<usize>,
}

impl Default for Progress {
    fn default() -> Self {
        Self {
            shared: Arc::default(),
            deadline: None,
            part: Part::default(),
            curve: Some(0),
        }
    }
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
    /// Whether the best found so far will do.
    stopped: AtomicBool,
    /// The bits of the share that is done.
    done: AtomicU64,
    best: Mutex<Best>,
}

/// The best curves found so far, by their numbers in the result.
#[derive(Debug, Default)]
struct Best {
    curves: BTreeMap<usize, FloatPolygon>,
    /// Whether one was added since they were taken.
    is_new: bool,
}

impl Progress {
    /// Give a part of the computation so much time from now on, and no more than the whole has. It counts while this thread
    /// computes, and must be watched there.
    pub fn limited(&self, limit: Duration) -> Self {
        let own = computed().checked_add(limit);
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
        let now = computed();
        let left = self.deadline.map(|deadline| deadline.saturating_sub(now));
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

    /// Watch the search for one of several curves of a result, by its number.
    pub fn of_curve(&self, curve: usize) -> Self {
        Self {
            curve: self.curve.map(|_| curve),
            ..self.clone()
        }
    }

    /// Watch a part whose best curves are not shown, as those of another result.
    pub fn unshown(&self) -> Self {
        Self {
            curve: None,
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

    /// Ask for the best found so far: the time of parts whose time is limited is up. The others go on.
    pub fn stop(&self) {
        self.shared.stopped.store(true, Ordering::Relaxed);
    }

    /// Whether the best found so far was asked for.
    pub fn is_stopped(&self) -> bool {
        self.shared.stopped.load(Ordering::Relaxed)
    }

    /// Whether the time is up. What was found so far may still be wanted.
    pub fn is_late(&self) -> bool {
        self.deadline
            .is_some_and(|deadline| self.is_stopped() || computed() >= deadline)
    }

    /// Show the best curve found so far to whoever watches.
    pub fn show(&self, best: FloatPolygon) {
        let Some(curve) = self.curve else {
            return;
        };
        let mut shown = self.best();
        shown.curves.insert(curve, best);
        shown.is_new = true;
    }

    /// The best curves found so far, in the order of the result; `None` if they are those of the last call.
    pub fn take_shown(&self) -> Option<Vec<FloatPolygon>> {
        let mut shown = self.best();
        let is_new = std::mem::take(&mut shown.is_new);
        is_new.then(|| shown.curves.values().cloned().collect())
    }

    fn best(&self) -> MutexGuard<'_, Best> {
        let best = self.shared.best.lock();
        best.unwrap_or_else(PoisonError::into_inner)
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

/// The time that this thread has computed; none where the system does not tell, so that only [`Progress::stop`] ends a
/// search.
fn computed() -> Duration {
    ThreadTime::try_now().map_or(Duration::ZERO, |time| time.as_duration())
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
    fn stopping_ends_what_has_a_limited_time_and_nothing_else() {
        let all = Progress::default();
        let search = all.limited(Duration::from_secs(1 << 20));
        assert!(!search.is_late());
        all.stop();
        assert!(all.is_stopped() && search.is_late() && search.is_cancelled());
        assert!(!all.is_cancelled() && !search.without_limit().is_cancelled());
    }

    #[test]
    fn the_best_curves_are_taken_once_in_the_order_of_the_result() {
        let line = |y: f64| FloatPolygon::planar(1, &[(0.0, y), (1.0, y)]).expect("a polygon");
        let all = Progress::default();
        assert_eq!(all.take_shown(), None);
        all.of_curve(1).show(line(1.0));
        let first = all.of_curve(0).limited(Duration::ZERO);
        first.show(line(5.0));
        first.show(line(0.0));
        assert_eq!(all.take_shown(), Some(vec![line(0.0), line(1.0)]));
        assert_eq!(all.take_shown(), None);
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
