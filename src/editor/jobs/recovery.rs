//! The session of this window with its autosaves, and the autosaves of earlier sessions.

use super::Recoverable;
use super::autosaving::{Autosaver, Autosaving};

/// Hold this session's autosaves and the documents of earlier sessions, for recovery after a crash.
#[derive(Debug, Default)]
pub struct Recovery {
    pub(in crate::editor) autosaving: Autosaving,
    pub(in crate::editor) recoverable: Vec<Recoverable>,
}

impl Recovery {
    /// The autosaver for other threads, if there is a session.
    pub fn autosaver(&self) -> Option<&Autosaver> {
        self.autosaving.autosaver()
    }

    /// End the session and remove its autosave.
    pub fn close(&mut self) {
        self.autosaving.close();
    }

    /// The autosaves of earlier sessions, the newest first.
    pub fn recoverable(&self) -> &[Recoverable] {
        &self.recoverable
    }

    /// Remove the autosave of an earlier session.
    pub fn discard(&mut self, id: usize) {
        if let Some(recoverable) = self.take(id) {
            recoverable.session.remove();
        }
    }

    /// Leave the autosaves of earlier sessions for the next start.
    pub fn leave(&mut self) {
        self.recoverable.clear();
    }

    /// Take an autosave out of the list.
    pub(in crate::editor) fn take(&mut self, id: usize) -> Option<Recoverable> {
        let mut all = self.recoverable.iter();
        let place = all.position(|recoverable| recoverable.id == id)?;
        Some(self.recoverable.remove(place))
    }
}
