//! What is not saved: kept for the case of a crash, and recovered afterwards.

use std::time::{Duration, Instant};

use crate::document::quoted;
use crate::editor::Editor;
use crate::editor::jobs::filing::open_elsewhere;
use crate::editor::jobs::{Autosaver, Recoverable};
use crate::editor::reply::{Message, Note, Refusal, Reply};
use crate::io::{FileError, Sessions};

impl Editor {
    /// Keep what is not saved in a session from now on, and find what earlier ones have left. At most
    /// a `period`'s work is lost when the program ends badly. That there can be no session is told.
    ///
    /// Without this nothing is kept.
    pub fn autosave_in(&mut self, sessions: Sessions, period: Duration) {
        self.recoverable = Recoverable::find(&sessions);
        match self.autosaving.begin(sessions, period) {
            Ok(()) => {
                let path = self.workspace.path();
                let elsewhere = path.map(|path| open_elsewhere(path, self.autosaving.autosaver()));
                let elsewhere = elsewhere.unwrap_or_default();
                if !elsewhere.is_empty() {
                    let told = self.message.take().map_or(String::new(), |told| told.text);
                    self.tell_line(&told, &elsewhere);
                }
            }
            Err(error) => self.tell_failure(&error),
        }
    }

    /// See to it that what is not saved is written in time, at once if the window `lost_focus`.
    /// Returns how soon to ask again, if that matters.
    pub fn autosave(&mut self, now: Instant, lost_focus: bool) -> Option<Duration> {
        let failure = self.autosaving.advance(&self.workspace, now, lost_focus);
        if let Some(error) = failure {
            self.tell_failure(&error);
        }
        self.autosaving.wait(now)
    }

    /// Write what is not saved, and return when it is on the disk. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be written.
    pub fn autosave_now(&mut self) -> Reply {
        self.autosave(Instant::now(), true);
        let written = self.autosaving.autosaver().map_or(Ok(()), Autosaver::write);
        self.tell(written.map(|()| Note::silent()).map_err(Refusal::from))
    }

    /// What writes the newest autosave from other threads, if there is a session.
    pub fn autosaver(&self) -> Option<Autosaver> {
        self.autosaving.autosaver().cloned()
    }

    /// End the session: nothing is unsaved, or it may be lost.
    pub fn close_session(&mut self) {
        self.autosaving.close();
    }

    /// What earlier sessions have left unsaved, the newest first.
    pub fn recoverable(&self) -> &[Recoverable] {
        &self.recoverable
    }

    /// Open what an earlier session has left, in place of the document: it counts as modified, and is
    /// saved to the file that it had. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if it is damaged, or not there.
    pub fn recover(&mut self, id: usize) -> Reply {
        let reply = self.replace_by_recoverable(id);
        self.tell(reply)
    }

    /// Give up what an earlier session has left.
    pub fn discard_recoverable(&mut self, id: usize) {
        if let Some(recoverable) = self.take_recoverable(id) {
            recoverable.session.remove();
        }
    }

    /// Leave what earlier sessions have left for the next start.
    pub fn leave_recoverable(&mut self) {
        self.recoverable.clear();
    }

    fn replace_by_recoverable(&mut self, id: usize) -> Reply {
        let recoverable = self
            .take_recoverable(id)
            .ok_or("It is not there any more")?;
        let content = recoverable.content?;
        let name = content.name.as_deref();
        let name = name.map_or("the document".to_owned(), quoted);
        self.replace(content.document, content.origin.path);
        self.workspace.set_fingerprint(content.origin.fingerprint);
        self.workspace.mark_unsaved();
        self.autosaving.supersede(recoverable.session);
        Ok(Note::told(format!("Recovered {name}: save it to keep it")))
    }

    fn take_recoverable(&mut self, id: usize) -> Option<Recoverable> {
        let mut all = self.recoverable.iter();
        let place = all.position(|recoverable| recoverable.id == id)?;
        Some(self.recoverable.remove(place))
    }

    fn tell_line(&mut self, told: &str, line: &str) {
        let text = format!("{told}\n{line}");
        let note = Note::told(text.trim_start());
        self.message = Message::of(&Ok(note));
    }

    fn tell_failure(&mut self, error: &FileError) {
        let refusal = Refusal(format!(
            "Changes are not kept for a crash, save often: {error}"
        ));
        self.message = Message::of(&Err(refusal));
    }
}
