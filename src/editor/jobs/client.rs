//! The protocol between a frame and its background work, shared by every kind of work.
//!
//! A client has one latest request. A result or a panic counts only if it belongs to that request.

use std::time::Duration;

use super::patience::Patience;
use super::worker::{Reply, Worker};
use crate::geometry::Progress;

/// Keep the latest request of one kind of work, and its result once it arrives.
///
/// A new request cancels the job of the one before. Results and panics of outdated requests never
/// replace those of the latest.
#[derive(Debug)]
pub struct Client<Q, T> {
    worker: Worker<Option<T>>,
    request: Option<Q>,
    /// The first job of the latest request: earlier jobs are outdated.
    first: u64,
    /// Whether the newest job of the latest request has not reported yet.
    pending: bool,
    result: Option<T>,
    /// The message of the panic that ended the latest request.
    failure: Option<String>,
    /// Results of outdated requests, the oldest first.
    outdated: Vec<T>,
}

impl<Q, T: Send + 'static> Default for Client<Q, T> {
    /// Run every job at once on the calling thread, so that tests depend on no clock.
    fn default() -> Self {
        Self::with(Worker::inline())
    }
}

impl<Q, T: Send + 'static> Client<Q, T> {
    /// Run jobs on a thread of this name. The thread calls `wake` when a frame should take a result.
    pub fn background(name: &str, wake: impl Fn() + Send + 'static) -> Self {
        Self::with(Worker::background(name, wake))
    }

    /// Replace the latest request and start its job. Wait for the result as long as `patience` allows,
    /// or not at all. A job returns `None` if it was cancelled or has no result.
    pub fn start(
        &mut self,
        request: Q,
        job: impl FnOnce(&Progress) -> Option<T> + Send + 'static,
        patience: Option<&mut Patience>,
    ) {
        self.request = Some(request);
        self.first = self.worker.newest() + 1;
        self.result = None;
        self.failure = None;
        self.go_on(job, patience);
    }

    /// Take what the worker has finished, and start the job of a request that is not the latest; without a
    /// request forget everything. Returns whether a job was started.
    pub fn advance<J>(
        &mut self,
        request: Option<Q>,
        patience: Option<&mut Patience>,
        job: impl FnOnce(Q) -> J,
    ) -> bool
    where
        Q: Clone + PartialEq,
        J: FnOnce(&Progress) -> Option<T> + Send + 'static,
    {
        self.receive();
        let is_new = request.is_some() && self.request != request;
        match request {
            Some(request) if is_new => self.start(request.clone(), job(request), patience),
            Some(_) => {}
            None => self.forget(),
        }
        is_new
    }

    /// Start another job for the latest request. The result so far stays until the next one arrives.
    pub fn go_on(
        &mut self,
        job: impl FnOnce(&Progress) -> Option<T> + Send + 'static,
        patience: Option<&mut Patience>,
    ) {
        self.pending = true;
        let worker = &mut self.worker;
        let replies = match patience {
            Some(patience) => patience.spend(|left| worker.start(job, left)),
            None => worker.start(job, Duration::ZERO),
        };
        self.sort(replies);
    }

    /// Take the results of the worker. Call this once a frame.
    pub fn receive(&mut self) {
        self.outdated.clear();
        let replies = self.worker.take();
        self.sort(replies);
    }

    /// Wait until the newest job has finished, however long it takes. [`Client::receive`] takes its result.
    pub fn wait(&mut self) {
        while self.pending {
            let replies = self.worker.wait(Duration::from_secs(1));
            self.sort(replies);
        }
    }

    /// Cancel the latest request and forget its result.
    pub fn forget(&mut self) {
        if self.request.take().is_some() {
            self.worker.cancel();
            self.first = self.worker.newest() + 1;
            self.pending = false;
            self.result = None;
            self.failure = None;
        }
    }

    /// The latest request.
    pub fn request(&self) -> Option<&Q> {
        self.request.as_ref()
    }

    /// The newest result of the latest request.
    pub fn result(&self) -> Option<&T> {
        self.result.as_ref()
    }

    /// The newest result of the latest request, to be changed.
    pub fn result_mut(&mut self) -> Option<&mut T> {
        self.result.as_mut()
    }

    /// Take the newest result of the latest request out of the client.
    pub fn take_result(&mut self) -> Option<T> {
        self.result.take()
    }

    /// Take the results of outdated requests, the oldest first, that arrived since [`Client::receive`].
    pub fn take_outdated(&mut self) -> Vec<T> {
        std::mem::take(&mut self.outdated)
    }

    /// The message of the panic that ended the latest request: a fault of the program.
    pub fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }

    /// The share of the newest job that is done, from 0 to 1; `None` once it has reported.
    pub fn progress(&self) -> Option<f64> {
        self.watched().map(Progress::done)
    }

    /// The progress of the newest job; `None` once it has reported.
    pub fn watched(&self) -> Option<&Progress> {
        self.pending.then(|| self.worker.progress())
    }

    fn with(worker: Worker<Option<T>>) -> Self {
        Self {
            worker,
            request: None,
            first: 0,
            pending: false,
            result: None,
            failure: None,
            outdated: Vec::new(),
        }
    }

    fn sort(&mut self, replies: impl IntoIterator<Item = Reply<Option<T>>>) {
        for Reply { job, result } in replies {
            let counts = self.request.is_some() && job >= self.first;
            self.pending &= job != self.worker.newest();
            match result {
                Ok(Some(result)) if counts => self.result = Some(result),
                Ok(Some(result)) => self.outdated.push(result),
                Err(panic) if counts => self.failure = Some(panic),
                Ok(None) | Err(_) => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::{Receiver, Sender, channel};

    use super::*;

    /// Longer than any job here takes.
    const LONG: Duration = Duration::from_secs(60);

    type Numbers = Client<u32, u32>;

    fn background() -> (Numbers, Receiver<()>) {
        let (sender, woken) = channel();
        let wake = move || sender.send(()).unwrap_or_default();
        (Client::background("test", wake), woken)
    }

    /// Start a request whose job ends when the returned sender lets it go; a `false` makes it panic.
    fn start_held(client: &mut Numbers, request: u32) -> Sender<bool> {
        let (lets_go, held) = channel::<bool>();
        let (begins, begun) = channel();
        let job = move |_: &Progress| {
            begins.send(()).unwrap_or_default();
            let succeeds = held.recv().unwrap_or_default();
            assert!(succeeds, "job {request}");
            Some(request)
        };
        client.start(request, job, None);
        begun.recv_timeout(LONG).expect("the job begins");
        lets_go
    }

    /// Make frames until the latest request has reported.
    fn settle(client: &mut Numbers, woken: &Receiver<()>) -> Vec<u32> {
        let mut outdated = client.take_outdated();
        while client.progress().is_some() {
            woken.recv_timeout(LONG).expect("the frame is woken");
            client.receive();
            outdated.extend(client.take_outdated());
        }
        outdated
    }

    #[test]
    fn an_inline_request_has_its_result_at_once() {
        let mut client = Numbers::default();
        client.start(1, |_| Some(10), None);
        assert_eq!((client.request(), client.result()), (Some(&1), Some(&10)));
        assert_eq!(client.progress(), None);
        client.start(2, |_| None, None);
        assert_eq!((client.result(), client.progress()), (None, None));
    }

    #[test]
    fn an_outdated_result_never_replaces_that_of_the_latest_request() {
        let (mut client, woken) = background();
        let lets_go = start_held(&mut client, 1);
        client.start(2, |_| Some(2), None);
        lets_go.send(true).expect("the job is held");
        assert_eq!(settle(&mut client, &woken), [1]);
        assert_eq!(client.result(), Some(&2));
    }

    #[test]
    fn a_panic_in_an_outdated_job_leaves_the_latest_request_alone() {
        let (mut client, woken) = background();
        let lets_go = start_held(&mut client, 1);
        client.start(2, |_| Some(2), None);
        lets_go.send(false).expect("the job is held");
        assert!(settle(&mut client, &woken).is_empty());
        assert_eq!((client.result(), client.failure()), (Some(&2), None));
    }

    #[test]
    fn a_panic_of_the_latest_request_is_its_failure_until_the_next_request() {
        for (mut client, woken) in [background(), (Client::default(), channel().1)] {
            client.start(1, |_| panic!("on purpose"), None);
            settle(&mut client, &woken);
            assert_eq!(client.failure(), Some("on purpose"));
            assert_eq!((client.result(), client.progress()), (None, None));
            client.start(2, |_| Some(2), None);
            settle(&mut client, &woken);
            assert_eq!((client.failure(), client.result()), (None, Some(&2)));
        }
    }

    #[test]
    fn a_forgotten_request_has_no_result() {
        let (mut client, woken) = background();
        let lets_go = start_held(&mut client, 1);
        client.forget();
        assert_eq!((client.request(), client.progress()), (None, None));
        lets_go.send(true).expect("the job is held");
        woken.recv_timeout(LONG).expect("the frame is woken");
        client.receive();
        assert_eq!(client.result(), None);
    }

    #[test]
    fn a_further_job_keeps_the_result_until_its_own_arrives() {
        let (mut client, woken) = background();
        client.start(1, |_| Some(1), None);
        settle(&mut client, &woken);
        let (lets_go, held) = channel();
        let job = move |_: &Progress| held.recv_timeout(LONG).ok();
        client.go_on(job, None);
        client.receive();
        assert_eq!((client.result(), client.progress()), (Some(&1), Some(0.0)));
        lets_go.send(2).expect("the job is held");
        settle(&mut client, &woken);
        assert_eq!((client.request(), client.result()), (Some(&1), Some(&2)));
    }

    #[test]
    fn a_request_waits_no_longer_than_the_patience_of_the_frame() {
        let (mut client, _woken) = background();
        let mut patience = Patience::new(LONG);
        client.start(1, |_| Some(1), Some(&mut patience));
        assert_eq!(client.result(), Some(&1));
        let mut spent = Patience::new(Duration::ZERO);
        let (lets_go, held) = channel();
        let job = move |_: &Progress| held.recv_timeout(LONG).ok();
        client.start(2, job, Some(&mut spent));
        assert_eq!((client.result(), client.progress()), (None, Some(0.0)));
        lets_go.send(2).expect("the job is held");
    }
}
