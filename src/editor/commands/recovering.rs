//! Autosaves, and the recovery of documents after a crash.

use std::time::{Duration, Instant};

use crate::document::quoted;
use crate::editor::Editor;
use crate::editor::jobs::filing::{open_elsewhere, own_path};
use crate::editor::jobs::{Autosaver, Recoverable, Recovery};
use crate::editor::reply::{Message, Note, Refusal, Reply, with_lines};
use crate::io::{FileError, Sessions};

impl Editor {
    /// Begin a session with autosaves, and find the autosaves of earlier sessions. A crash loses the work
    /// of at most one `period`. A failure is told.
    ///
    /// Without this there are no autosaves.
    pub fn autosave_in(&mut self, sessions: Sessions, period: Duration) {
        self.recovery.recoverable = Recoverable::find(&sessions);
        match self.recovery.autosaving.begin(sessions, period) {
            Ok(()) => {
                let path = self.workspace.path();
                let elsewhere = path.map(|path| open_elsewhere(path, self.recovery.autosaver()));
                let elsewhere = elsewhere.unwrap_or_default();
                if !elsewhere.is_empty() {
                    let told = self.message.take().map_or(String::new(), |told| told.text);
                    let text = with_lines(told, &elsewhere);
                    self.message = Message::of(&Ok(Note::told(text.trim_start())));
                }
            }
            Err(error) => self.message = failure(&error),
        }
    }

    /// Write the autosave when it is due, at once if the window `lost_focus`. Returns the time until the
    /// next call, if one is due.
    pub fn autosave(&mut self, now: Instant, lost_focus: bool) -> Option<Duration> {
        let error = self
            .recovery
            .autosaving
            .advance(&self.workspace, now, lost_focus);
        if let Some(error) = error {
            self.message = failure(&error);
        }
        self.recovery.autosaving.wait(now)
    }

    /// End: stop what is read, wait for what is written, then remove the session, or write the changes that are to be
    /// kept.
    ///
    /// # Errors
    /// [`Refusal`] if they cannot be written.
    pub fn close(&mut self, keeps_changes: bool) -> Reply {
        self.filing.end();
        self.receive_files();
        if !keeps_changes || !self.workspace.is_settled_modified() {
            self.recovery.close();
            return Ok(Note::silent());
        }
        self.autosave(Instant::now(), true);
        let written = self.recovery.autosaver().map_or(Ok(()), Autosaver::write);
        self.tell(written.map(|()| Note::silent()).map_err(Refusal::from))
    }

    /// The autosaves of this session and of earlier ones.
    pub fn recovery(&self) -> &Recovery {
        &self.recovery
    }

    /// The autosaves of this session and of earlier ones, to be closed or discarded.
    pub fn recovery_mut(&mut self) -> &mut Recovery {
        &mut self.recovery
    }

    /// Open the autosave of an earlier session in place of the document. It counts as modified and keeps
    /// its file. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if it is damaged, or not there.
    pub fn recover(&mut self, id: usize) -> Reply {
        let recoverable = self.recovery.take(id).ok_or("It is not there any more");
        let reply = recoverable.map_err(Refusal::from).and_then(|recoverable| {
            let content = recoverable.content?;
            let name = content.name.as_deref();
            let name = name.map_or("the document".to_owned(), quoted);
            // A file that was edited for another program is none to save a whole document to.
            let path = content.origin.path.and_then(|path| own_path(&path));
            self.replace(content.document, path);
            self.workspace.set_fingerprint(content.origin.fingerprint);
            self.workspace.mark_unsaved();
            self.recovery.autosaving.supersede(recoverable.session);
            Ok(Note::told(format!("Recovered {name}: save it to keep it")))
        });
        self.tell(reply)
    }
}

/// The message that autosaves fail.
fn failure(error: &FileError) -> Option<Message> {
    Message::of(&Err(Refusal(format!(
        "Changes are not kept for a crash, save often: {error}"
    ))))
}
