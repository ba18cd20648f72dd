//! Autosaves of unsaved changes, written beside the frame for recovery after a crash.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use super::Client;
use crate::document::Document;
use crate::editor::workspace::Workspace;
use crate::io::autosave::Origin;
use crate::io::{AbandonedSession, FileError, Fingerprint, Session, Sessions};

/// An autosave begins when this share of its period is over, so that it is on the disk when the
/// period ends.
const BEGINS: f64 = 0.95;

/// Decide when unsaved changes are written, and write them beside the frame. By default nothing is.
#[derive(Debug, Default)]
pub struct Autosaving {
    autosaver: Option<Autosaver>,
    client: Client<(), Result<(), FileError>>,
    /// The most work that a crash loses.
    period: Duration,
    /// The state that the autosaver was given last.
    state: State,
    /// Recovered sessions that the autosaver was not given yet.
    superseded: Vec<AbandonedSession>,
    /// The time of the next write, if there is something to write.
    due: Option<Instant>,
    /// Whether the last write failed: further failures are not reported.
    has_failed: bool,
}

/// The state of the document that an autosave depends on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct State {
    /// The revision of the document; `None` if it is saved.
    unsaved: Option<u64>,
    path: Option<PathBuf>,
}

/// Write the newest autosave of a session, from any thread.
#[derive(Clone, Debug)]
pub struct Autosaver(Arc<Shared>);

/// State shared by threads. The frame locks `newest` only, which no thread holds for long.
#[derive(Debug)]
struct Shared {
    newest: Mutex<Newest>,
    kept: Mutex<Kept>,
    sessions: Sessions,
}

/// The state to write.
#[derive(Debug, Default)]
struct Newest {
    /// The document with the fingerprint of its file; `None` if it is saved.
    unsaved: Option<(Document, Option<Fingerprint>)>,
    state: State,
    /// Recovered sessions: they are removed once this session's autosave is on the disk.
    superseded: Vec<AbandonedSession>,
}

/// The state on the disk.
#[derive(Debug)]
struct Kept {
    /// `None` once the session is closed.
    session: Option<Session>,
    state: State,
}

impl Autosaver {
    /// Write unsaved changes, unless the disk has them. Returns when they are on the disk.
    ///
    /// # Errors
    /// [`FileError`] if it cannot be written; the autosave before is unchanged then.
    pub fn write(&self) -> Result<(), FileError> {
        let mut kept = held(&self.0.kept);
        let Kept { session, state } = &mut *kept;
        let Some(session) = session else {
            return Ok(());
        };
        let (unsaved, newest, mut superseded) = {
            let mut newest = held(&self.0.newest);
            let superseded = std::mem::take(&mut newest.superseded);
            (newest.unsaved.clone(), newest.state.clone(), superseded)
        };
        let written = write(session, state, unsaved, newest);
        match written {
            Ok(()) => superseded.into_iter().for_each(AbandonedSession::remove),
            Err(_) => held(&self.0.newest).superseded.append(&mut superseded),
        }
        written
    }

    /// Whether another window has a file open.
    pub(in crate::editor) fn is_open_elsewhere(&self, path: &Path) -> bool {
        let kept = held(&self.0.kept);
        let session = kept.session.as_ref();
        session.is_some_and(|session| self.0.sessions.has_open(path, session))
    }

    fn begin(sessions: Sessions) -> Result<Self, FileError> {
        let session = Some(sessions.begin()?);
        let state = State::default();
        Ok(Self(Arc::new(Shared {
            newest: Mutex::default(),
            kept: Mutex::new(Kept { session, state }),
            sessions,
        })))
    }

    fn set_newest(&self, workspace: &Workspace, state: State, superseded: Vec<AbandonedSession>) {
        let document = || (workspace.settled().clone(), workspace.fingerprint());
        let mut newest = held(&self.0.newest);
        newest.unsaved = state.unsaved.map(|_| document());
        newest.state = state;
        // Together with the document that supersedes them.
        newest.superseded.extend(superseded);
    }

    /// Remove the session with its autosave.
    fn close(&self) {
        let session = held(&self.0.kept).session.take();
        let superseded = std::mem::take(&mut held(&self.0.newest).superseded);
        superseded.into_iter().for_each(AbandonedSession::remove);
        if let Some(session) = session {
            // Should it stay, the work is offered once too often, and not lost.
            let _ = session.remove_autosave();
        }
    }
}

/// Bring the files of a session from one state to another.
fn write(
    session: &Session,
    state: &mut State,
    unsaved: Option<(Document, Option<Fingerprint>)>,
    newest: State,
) -> Result<(), FileError> {
    match unsaved {
        Some((document, fingerprint)) if state.unsaved != newest.unsaved => {
            let origin = Origin {
                path: newest.path.clone(),
                fingerprint,
                time: SystemTime::now(),
                revision: newest.unsaved.unwrap_or_default(),
            };
            session.write_autosave(&origin, &document)?;
        }
        Some(_) => {}
        None => session.remove_autosave()?,
    }
    state.unsaved = newest.unsaved;
    if state.path != newest.path {
        session.tell_open(newest.path.as_deref())?;
        state.path = newest.path;
    }
    Ok(())
}

impl Autosaving {
    /// Write on a thread from now on, which calls `wake` after each write.
    pub fn run_in_background(&mut self, wake: impl Fn() + Send + 'static) {
        self.client = Client::background("autosave", wake);
    }

    /// Begin a session: from now on a crash loses the work of at most one `period`.
    ///
    /// # Errors
    /// [`FileError`] if there can be no session; then there are no autosaves.
    pub fn begin(&mut self, sessions: Sessions, period: Duration) -> Result<(), FileError> {
        self.autosaver = Some(Autosaver::begin(sessions)?);
        self.period = period;
        Ok(())
    }

    /// The autosaver for other threads, if there is a session.
    pub fn autosaver(&self) -> Option<&Autosaver> {
        self.autosaver.as_ref()
    }

    /// Remove a recovered session once this session's autosave holds its document.
    pub fn supersede(&mut self, session: AbandonedSession) {
        self.superseded.push(session);
    }

    /// The time until the next write; `None` if there is nothing to write.
    pub fn wait(&self, now: Instant) -> Option<Duration> {
        Some(self.due?.saturating_duration_since(now))
    }

    /// Remove the session with its autosave.
    pub fn close(&mut self) {
        if let Some(autosaver) = &self.autosaver {
            autosaver.close();
        }
    }

    /// Start the writes that are due, all at once if it is `urgent`. Returns the error of the last write,
    /// unless the write before it failed too.
    pub fn advance(
        &mut self,
        workspace: &Workspace,
        now: Instant,
        urgent: bool,
    ) -> Option<FileError> {
        let autosaver = self.autosaver.as_ref()?;
        // Nothing of an empty document is worth recovering.
        let unsaved = workspace.is_settled_modified() && !workspace.settled().is_empty();
        let state = State {
            unsaved: unsaved.then_some(workspace.revision()),
            path: workspace.path().map(Path::to_owned),
        };
        if state != self.state {
            // A file that was opened, saved or left is soon told; changes can wait.
            let waits = state.unsaved.is_some()
                && state.path == self.state.path
                && self.superseded.is_empty();
            let due = if waits {
                now + self.period.mul_f64(BEGINS)
            } else {
                now
            };
            self.due = Some(self.due.map_or(due, |before| before.min(due)));
            let superseded = std::mem::take(&mut self.superseded);
            autosaver.set_newest(workspace, state.clone(), superseded);
            self.state = state;
        }
        self.client.receive();
        if self.due.is_some_and(|due| due <= now || urgent) {
            self.due = None;
            let autosaver = autosaver.clone();
            self.client
                .start((), move |_| Some(autosaver.write()), None);
        }
        let written = self.client.take_result()?;
        self.note(written, now)
    }

    fn note(&mut self, written: Result<(), FileError>, now: Instant) -> Option<FileError> {
        let had_failed = std::mem::replace(&mut self.has_failed, written.is_err());
        let error = written.err()?;
        self.due.get_or_insert(now + self.period);
        (!had_failed).then_some(error)
    }
}

impl Drop for Autosaving {
    /// Write unsaved changes when the program panics.
    fn drop(&mut self) {
        if let Some(autosaver) = &self.autosaver
            && thread::panicking()
        {
            // Nobody is left to be told.
            let _ = autosaver.write();
        }
    }
}

fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
