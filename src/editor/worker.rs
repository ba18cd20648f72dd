//! Work beside the frame: jobs that own all they need, run at once or on a thread of their own.

use std::any::Any;
use std::collections::VecDeque;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use crate::geometry::Progress;

/// Run jobs of one kind, one after the other. A newer job cancels the older one: what that had come
/// to is still delivered, if it had begun.
#[derive(Debug)]
pub struct Worker<T> {
    /// The progress of the newest job.
    progress: Progress,
    /// Its number; jobs count from 1.
    newest: u64,
    place: Place<T>,
}

/// What a job came to.
#[derive(Debug, PartialEq, Eq)]
pub enum Outcome<T> {
    /// What it returned.
    Done(T),
    /// It panicked, with this message.
    Panicked(String),
}

/// Where jobs run.
#[derive(Debug)]
enum Place<T> {
    /// At once, before they are handed over.
    Inline(VecDeque<Outcome<T>>),
    /// On a thread.
    Thread(Arc<Desk<T>>),
}

/// What the two threads share.
struct Desk<T> {
    tray: Mutex<Tray<T>>,
    /// There is a job, or there will be none.
    asked: Condvar,
    /// A job is done.
    answered: Condvar,
}

/// Jobs and outcomes on their way.
struct Tray<T> {
    job: Option<Job<T>>,
    outcomes: VecDeque<Outcome<T>>,
    /// The number of the last job that is done.
    done: u64,
    /// Whether someone waits for an outcome, and need not be woken.
    awaited: bool,
    /// Whether there will be no more jobs.
    closed: bool,
}

/// A job with its number.
struct Job<T> {
    number: u64,
    progress: Progress,
    run: Run<T>,
}

type Run<T> = Box<dyn FnOnce(&Progress) -> T + Send>;

impl<T: Send + 'static> Worker<T> {
    /// Run every job at once, in the thread that hands it over: nothing depends on time.
    pub fn inline() -> Self {
        Self::at(Place::Inline(VecDeque::new()))
    }

    /// Run jobs on a thread of their own. When an outcome is ready that nobody waits for, `wake` is
    /// called on that thread. Where no thread can be had, jobs run inline.
    pub fn background(name: &str, wake: impl Fn() + Send + 'static) -> Self {
        let desk = Arc::new(Desk::default());
        let own = desk.clone();
        let thread = thread::Builder::new().name(name.to_owned());
        match thread.spawn(move || own.serve(&wake)) {
            Ok(_) => Self::at(Place::Thread(desk)),
            Err(_) => Self::inline(),
        }
    }

    /// Hand a job over, wait until it is done, but no longer than `at_most`, and take the outcomes that
    /// are ready then. Without a wait the frame is always woken, even where the outcome is taken here: what
    /// goes on from it is begun by the next frame. An older job is cancelled; one that has not begun is dropped.
    pub fn start(
        &mut self,
        job: impl FnOnce(&Progress) -> T + Send + 'static,
        at_most: Duration,
    ) -> VecDeque<Outcome<T>> {
        self.progress.cancel();
        self.progress = Progress::default();
        self.newest += 1;
        match &mut self.place {
            Place::Inline(outcomes) => outcomes.push_back(run(Box::new(job), &self.progress)),
            Place::Thread(desk) => {
                let mut tray = desk.tray();
                tray.job = Some(Job {
                    number: self.newest,
                    progress: self.progress.clone(),
                    run: Box::new(job),
                });
                tray.awaited = !at_most.is_zero();
                drop(tray);
                desk.asked.notify_one();
            }
        }
        self.wait(at_most)
    }

    /// Ask the newest job to stop.
    pub fn cancel(&self) {
        self.progress.cancel();
    }

    /// How far the newest job has come; `None` if it is done, or there is none.
    pub fn progress(&self) -> Option<&Progress> {
        let is_done = match &self.place {
            Place::Inline(_) => true,
            Place::Thread(desk) => desk.tray().done == self.newest,
        };
        (!is_done).then_some(&self.progress)
    }

    /// Take the outcomes that are ready, in the order of their jobs.
    pub fn take(&mut self) -> VecDeque<Outcome<T>> {
        match &mut self.place {
            Place::Inline(outcomes) => std::mem::take(outcomes),
            Place::Thread(desk) => std::mem::take(&mut desk.tray().outcomes),
        }
    }

    fn wait(&mut self, at_most: Duration) -> VecDeque<Outcome<T>> {
        if let Place::Thread(desk) = &self.place
            && !at_most.is_zero()
        {
            let mut tray = desk.tray();
            tray.awaited = true;
            let newest = self.newest;
            let waited = desk
                .answered
                .wait_timeout_while(tray, at_most, |tray| tray.done != newest);
            let (mut tray, _) = waited.unwrap_or_else(PoisonError::into_inner);
            tray.awaited = false;
        }
        self.take()
    }

    fn at(place: Place<T>) -> Self {
        Self {
            progress: Progress::default(),
            newest: 0,
            place,
        }
    }
}

impl<T> Drop for Worker<T> {
    /// Let the thread end after its job, which is not waited for.
    fn drop(&mut self) {
        self.progress.cancel();
        if let Place::Thread(desk) = &self.place {
            let mut tray = desk.tray();
            tray.closed = true;
            tray.job = None;
            desk.asked.notify_one();
        }
    }
}

impl<T> Default for Desk<T> {
    fn default() -> Self {
        Self {
            tray: Mutex::new(Tray {
                job: None,
                outcomes: VecDeque::new(),
                done: 0,
                awaited: false,
                closed: false,
            }),
            asked: Condvar::new(),
            answered: Condvar::new(),
        }
    }
}

impl<T> fmt::Debug for Desk<T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Desk").finish_non_exhaustive()
    }
}

impl<T> Desk<T> {
    /// Look at the tray. Nothing panics while it is held.
    fn tray(&self) -> MutexGuard<'_, Tray<T>> {
        self.tray.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Run jobs until there will be no more.
    fn serve(&self, wake: &impl Fn()) {
        while let Some(job) = self.next() {
            let outcome = run(job.run, &job.progress);
            let mut tray = self.tray();
            tray.done = job.number;
            tray.outcomes.push_back(outcome);
            let awaited = tray.awaited;
            drop(tray);
            self.answered.notify_all();
            if !awaited {
                wake();
            }
        }
    }

    /// Wait for a job; `None` if there will be no more.
    fn next(&self) -> Option<Job<T>> {
        let mut tray = self.tray();
        loop {
            if tray.closed {
                return None;
            }
            match tray.job.take() {
                Some(job) => return Some(job),
                None => {
                    let waited = self.asked.wait(tray);
                    tray = waited.unwrap_or_else(PoisonError::into_inner);
                }
            }
        }
    }
}

/// Run a job, whatever it does.
fn run<T>(job: Run<T>, progress: &Progress) -> Outcome<T> {
    match catch_unwind(AssertUnwindSafe(|| job(progress))) {
        Ok(result) => Outcome::Done(result),
        Err(panic) => Outcome::Panicked(panic_text(panic.as_ref())),
    }
}

/// What a panic says of itself.
fn panic_text(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("no message").to_owned()
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::{Receiver, Sender, channel};

    use super::*;

    /// Longer than any of these jobs takes: whoever waits so long has failed.
    const LONG: Duration = Duration::from_secs(60);

    /// A worker with a thread, and what tells that it woke somebody.
    fn background() -> (Worker<u32>, Receiver<()>) {
        let (sender, woken) = channel();
        let wake = move || sender.send(()).unwrap_or_default();
        (Worker::background("test", wake), woken)
    }

    /// Start a job that says when it begins, and ends when it is let go or cancelled.
    fn start_held(worker: &mut Worker<u32>, result: u32) -> (Receiver<()>, Sender<()>) {
        let (begins, begun) = channel();
        let (lets_go, held) = channel::<()>();
        let job = move |progress: &Progress| {
            begins.send(()).unwrap_or_default();
            held.recv().unwrap_or_default();
            result + 100 * u32::from(progress.is_cancelled())
        };
        // Were it waited for until it is done, this would never return.
        assert!(worker.start(job, Duration::from_millis(4)).is_empty());
        (begun, lets_go)
    }

    fn done(outcomes: VecDeque<Outcome<u32>>) -> Vec<u32> {
        let results = outcomes.into_iter().map(|outcome| match outcome {
            Outcome::Done(result) => result,
            Outcome::Panicked(text) => panic!("{text}"),
        });
        results.collect()
    }

    #[test]
    fn inline_jobs_are_done_when_they_are_handed_over() {
        let mut worker = Worker::inline();
        assert_eq!(done(worker.start(|_| 1, LONG)), [1]);
        assert_eq!(done(worker.start(|_| 2, Duration::ZERO)), [2]);
        assert!(worker.progress().is_none());
        assert!(worker.take().is_empty());
    }

    #[test]
    fn a_result_that_comes_in_time_is_waited_for_and_wakes_nobody() {
        let (mut worker, woken) = background();
        for result in 0..100 {
            assert_eq!(done(worker.start(move |_| result, LONG)), [result]);
        }
        drop(worker);
        // The thread ends, and with it what could wake.
        assert!(woken.iter().next().is_none());
    }

    #[test]
    fn a_long_job_is_not_waited_for_and_wakes_when_it_is_done() {
        let (mut worker, woken) = background();
        let (begun, lets_go) = start_held(&mut worker, 1);
        begun.recv().expect("it begins");
        assert!(worker.progress().is_some());
        lets_go.send(()).expect("it is held");
        woken.recv_timeout(LONG).expect("it wakes");
        assert!(worker.progress().is_none());
        assert_eq!(done(worker.take()), [1]);
    }

    #[test]
    fn a_newer_job_cancels_the_older_and_replaces_one_that_has_not_begun() {
        let (mut worker, _woken) = background();
        let (begun, lets_go) = start_held(&mut worker, 1);
        begun.recv().expect("it begins");
        assert!(worker.start(|_| 2, Duration::ZERO).is_empty());
        assert!(worker.start(|_| 3, Duration::ZERO).is_empty());
        lets_go.send(()).expect("it is held");
        // What the first came to is told, the second never ran.
        let mut results = Vec::new();
        while results.last() != Some(&3) {
            results.extend(done(worker.wait(LONG)));
        }
        assert_eq!(results, [101, 3]);
    }

    #[test]
    fn a_panic_is_an_outcome_and_the_next_job_runs() {
        for (mut worker, _woken) in [background(), (Worker::inline(), channel().1)] {
            let outcomes = worker.start(|_| panic!("on purpose"), LONG);
            assert_eq!(outcomes, [Outcome::Panicked("on purpose".into())]);
            assert_eq!(done(worker.start(|_| 2, LONG)), [2]);
        }
    }

    #[test]
    fn dropping_a_worker_cancels_its_job_and_waits_for_nothing() {
        let (mut worker, _woken) = background();
        let (sender, ended) = channel();
        let (begins, begun) = channel();
        let job = move |progress: &Progress| {
            begins.send(()).unwrap_or_default();
            while !progress.is_cancelled() {
                thread::yield_now();
            }
            sender.send(()).unwrap_or_default();
            1
        };
        assert!(worker.start(job, Duration::ZERO).is_empty());
        begun.recv().expect("it begins");
        drop(worker);
        ended.recv_timeout(LONG).expect("it is cancelled");
    }
}
