//! Worker threads: jobs that own all they need, run one after the other beside the frame.

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use crate::geometry::{Progress, panic_message};

/// Run jobs of one kind, one after the other.
///
/// A new job cancels the one that runs, whose result still arrives, and replaces one that has not
/// begun. Jobs are numbered from 1.
#[derive(Debug)]
pub struct Worker<T> {
    /// The progress of the newest job.
    progress: Progress,
    newest: u64,
    place: Place<T>,
}

/// A finished job.
#[derive(Debug, PartialEq, Eq)]
pub struct Reply<T> {
    /// The number of the job.
    pub job: u64,
    /// Its result, or the message of its panic.
    pub result: Result<T, String>,
}

/// Where jobs run.
#[derive(Debug)]
enum Place<T> {
    /// On the calling thread, at once.
    Inline(VecDeque<Reply<T>>),
    /// On a thread of their own.
    Thread {
        jobs: Sender<Job<T>>,
        replies: Receiver<Reply<T>>,
        /// Whether the caller waits for a reply: then the thread need not wake a frame.
        awaited: Arc<Mutex<bool>>,
    },
}

struct Job<T> {
    number: u64,
    progress: Progress,
    run: Run<T>,
}

type Run<T> = Box<dyn FnOnce(&Progress) -> T + Send>;

impl<T: Send + 'static> Worker<T> {
    /// Run every job at once on the calling thread, so that tests depend on no clock.
    pub fn inline() -> Self {
        Self::at(Place::Inline(VecDeque::new()))
    }

    /// Run jobs on a thread of this name. The thread calls `wake` after a job that nobody waits for.
    /// Without threads, jobs run inline.
    pub fn background(name: &str, wake: impl Fn() + Send + 'static) -> Self {
        let (jobs, next) = channel::<Job<T>>();
        let (finished, replies) = channel();
        let awaited = Arc::new(Mutex::new(false));
        let caller = Arc::downgrade(&awaited);
        let serve = move || {
            while let Ok(job) = next.recv() {
                // A newer job replaces it, and none begins once the worker is dropped.
                let job = next.try_iter().last().unwrap_or(job);
                let Some(awaited) = caller.upgrade() else {
                    return;
                };
                let reply = job.run();
                let is_awaited = held(&awaited);
                let is_sent = finished.send(reply).is_ok();
                let wakes = is_sent && !*is_awaited;
                drop(is_awaited);
                if wakes {
                    wake();
                }
            }
        };
        let thread = thread::Builder::new().name(name.to_owned());
        match thread.spawn(serve) {
            Ok(_) => Self::at(Place::Thread {
                jobs,
                replies,
                awaited,
            }),
            Err(_) => Self::inline(),
        }
    }

    /// Start a job, wait for it no longer than `at_most`, and take the replies that are ready then.
    /// Without a wait the thread always wakes a frame, even if this call already takes the reply:
    /// the next frame may start a further job.
    pub fn start(
        &mut self,
        job: impl FnOnce(&Progress) -> T + Send + 'static,
        at_most: Duration,
    ) -> VecDeque<Reply<T>> {
        self.progress.cancel();
        self.progress = Progress::default();
        self.newest += 1;
        let job = Job {
            number: self.newest,
            progress: self.progress.clone(),
            run: Box::new(job),
        };
        match &mut self.place {
            Place::Inline(replies) => replies.push_back(job.run()),
            Place::Thread { jobs, awaited, .. } => {
                *held(awaited) = !at_most.is_zero();
                // The thread ends no sooner than this worker.
                let _ = jobs.send(job);
            }
        }
        self.wait(at_most)
    }

    /// Ask the newest job to stop.
    pub fn cancel(&self) {
        self.progress.cancel();
    }

    /// The number of the newest job; 0 before the first.
    pub fn newest(&self) -> u64 {
        self.newest
    }

    /// The progress of the newest job.
    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// Take the replies that are ready, in the order of their jobs.
    pub fn take(&mut self) -> VecDeque<Reply<T>> {
        self.wait(Duration::ZERO)
    }

    /// Wait for the newest job no longer than `at_most`, and take the replies that are ready then.
    pub fn wait(&mut self, at_most: Duration) -> VecDeque<Reply<T>> {
        match &mut self.place {
            Place::Inline(replies) => std::mem::take(replies),
            Place::Thread {
                replies, awaited, ..
            } => {
                let mut taken: VecDeque<Reply<T>> = replies.try_iter().collect();
                let end = Instant::now() + at_most;
                let left = || end.saturating_duration_since(Instant::now());
                while !at_most.is_zero() && taken.back().is_none_or(|it| it.job != self.newest) {
                    *held(awaited) = true;
                    let Ok(reply) = replies.recv_timeout(left()) else {
                        break;
                    };
                    taken.push_back(reply);
                }
                *held(awaited) = false;
                // What came after the wait, and wakes no frame.
                taken.extend(replies.try_iter());
                taken
            }
        }
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
    /// Cancel the job and let the thread end after it, without waiting.
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

/// Lock a flag. No code panics while it holds the lock.
fn held(flag: &Mutex<bool>) -> MutexGuard<'_, bool> {
    flag.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<T> Job<T> {
    /// Run the job and catch its panic.
    fn run(self) -> Reply<T> {
        let result = catch_unwind(AssertUnwindSafe(|| (self.run)(&self.progress)));
        Reply {
            job: self.number,
            result: result.map_err(|panic| panic_message(panic.as_ref())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Longer than any job here takes.
    const LONG: Duration = Duration::from_secs(60);

    /// A worker with a thread, and the receiver of its wake-up calls.
    fn background() -> (Worker<u32>, Receiver<()>) {
        let (sender, woken) = channel();
        let wake = move || sender.send(()).unwrap_or_default();
        (Worker::background("test", wake), woken)
    }

    /// Start a job that signals its begin and ends when the sender lets it go.
    fn start_held(worker: &mut Worker<u32>, result: u32) -> (Receiver<()>, Sender<()>) {
        let (begins, begun) = channel();
        let (lets_go, held) = channel::<()>();
        let job = move |progress: &Progress| {
            begins.send(()).unwrap_or_default();
            held.recv().unwrap_or_default();
            result + 100 * u32::from(progress.is_cancelled())
        };
        // Waiting for its end here would never return.
        assert!(worker.start(job, Duration::from_millis(4)).is_empty());
        (begun, lets_go)
    }

    fn done(replies: VecDeque<Reply<u32>>) -> Vec<u32> {
        let results = replies.into_iter().map(|reply| reply.result);
        results.collect::<Result<_, _>>().expect("no panic")
    }

    #[test]
    fn inline_jobs_are_done_when_they_are_handed_over() {
        let mut worker = Worker::inline();
        assert_eq!(done(worker.start(|_| 1, LONG)), [1]);
        assert_eq!(done(worker.start(|_| 2, Duration::ZERO)), [2]);
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
        assert!(worker.take().is_empty());
        lets_go.send(()).expect("it is held");
        woken.recv_timeout(LONG).expect("it wakes");
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
        // The first still reports, the second never ran.
        let mut results = Vec::new();
        while results.last() != Some(&3) {
            results.extend(done(worker.wait(LONG)));
        }
        assert_eq!(results, [101, 3]);
    }

    #[test]
    fn a_panic_is_reported_with_its_job_and_the_next_job_runs() {
        for (mut worker, _woken) in [background(), (Worker::inline(), channel().1)] {
            let replies = worker.start(|_| panic!("on purpose"), LONG);
            let result = Err("on purpose".into());
            assert_eq!(replies, [Reply { job: 1, result }]);
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
