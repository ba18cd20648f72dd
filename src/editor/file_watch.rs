//! Looking at the document's file beside the frame.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::time::Duration;

use crate::editor::worker::{Outcome, Worker};
use crate::geometry::Progress;
use crate::io::{Fingerprint, disk};

/// Look at the document's file beside the frame.
#[derive(Debug)]
pub struct FileWatch {
    worker: Worker<Seen>,
    ready: VecDeque<Outcome<Seen>>,
    /// What was told: one change is told once.
    told: Option<Seen>,
}

/// What a file was seen to hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seen {
    /// The file.
    pub path: PathBuf,
    /// What it holds; `None` if it is not there, or cannot be read.
    pub fingerprint: Option<Fingerprint>,
}

impl Default for FileWatch {
    /// Look at once, however long it takes.
    fn default() -> Self {
        Self {
            worker: Worker::inline(),
            ready: VecDeque::new(),
            told: None,
        }
    }
}

impl FileWatch {
    /// Look on a thread of its own; `wake` is called when something was seen.
    pub fn background(wake: impl Fn() + Send + 'static) -> Self {
        Self {
            worker: Worker::background("file", wake),
            ..Self::default()
        }
    }

    /// Look at a file.
    pub fn look_at(&mut self, path: PathBuf) {
        let look = move |_: &Progress| Seen {
            fingerprint: disk::fingerprint(&path),
            path,
        };
        let seen = self.worker.start(look, Duration::ZERO);
        self.ready.extend(seen);
    }

    /// Take what was seen since the last time.
    pub fn take(&mut self) -> Option<Seen> {
        let mut ready = std::mem::take(&mut self.ready);
        ready.extend(self.worker.take());
        match ready.pop_back()? {
            Outcome::Done(seen) => Some(seen),
            Outcome::Panicked(_) => None,
        }
    }

    /// Take note that something is told. Returns whether it is new.
    pub fn note(&mut self, seen: Seen) -> bool {
        let seen = Some(seen);
        let is_new = self.told != seen;
        self.told = seen;
        is_new
    }
}
