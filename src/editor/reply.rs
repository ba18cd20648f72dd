//! Replies to requests of the user, and the message on screen.

use std::fmt;

use thiserror::Error;

use crate::document::EditError;
use crate::io::FileError;

/// The reply to a request of the user: a note, or the reason of a refusal.
pub type Reply = Result<Note, Refusal>;

/// Ignore a reply that the message on screen already tells.
pub fn told<T>(_: Result<T, Refusal>) {}

/// A note on something that was done.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Note {
    /// The text; empty if there is nothing to tell.
    pub text: String,
    /// Whether the message offers to undo the step.
    pub offers_undo: bool,
    /// Whether it tells of something that the user may not want.
    pub warns: bool,
    /// Whether the message offers to choose anew what came in.
    pub offers_choice: bool,
}

impl Note {
    /// A note without a text.
    pub fn silent() -> Self {
        Self::default()
    }

    /// A note with a text.
    pub fn told(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            ..Self::default()
        }
    }

    /// A note on the last step, with the offer to undo it.
    pub fn done(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            offers_undo: true,
            ..Self::default()
        }
    }

    /// The same note, as a warning.
    pub(in crate::editor) fn warning(self) -> Self {
        Self {
            warns: true,
            ..self
        }
    }

    /// Tell this note before a later reply.
    pub(in crate::editor) fn before(self, reply: Reply) -> Reply {
        if self.text.is_empty() {
            return reply;
        }
        match reply {
            Ok(note) => Ok(Self {
                text: with_lines(self.text, &note.text),
                warns: self.warns || note.warns,
                ..note
            }),
            Err(Refusal(reason)) => Err(Refusal(with_lines(self.text, &reason))),
        }
    }

    /// The same note, with the offer to choose anew what came in, if there is something to choose from.
    pub(in crate::editor) fn offering_choice(self, offers_choice: bool) -> Self {
        Self {
            offers_choice,
            ..self
        }
    }
}

/// What ended because something else began.
#[derive(Debug)]
pub struct Interrupted {
    /// Whether a preview was taken back.
    pub takes_back: bool,
    /// What is told of an operation that waited to be applied; silent if none did.
    pub lost: Note,
}

/// Add lines to a message, if there are any; without a text they are the message.
pub(in crate::editor) fn with_lines(text: String, lines: &impl fmt::Display) -> String {
    format!("{text}\n{lines}").trim().to_owned()
}

/// The reason why a request was refused; nothing is changed then.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct Refusal(pub String);

impl From<String> for Refusal {
    fn from(text: String) -> Self {
        Self(text)
    }
}

impl From<&str> for Refusal {
    fn from(text: &str) -> Self {
        Self(text.to_owned())
    }
}

impl From<EditError> for Refusal {
    fn from(error: EditError) -> Self {
        Self(error.to_string())
    }
}

impl From<FileError> for Refusal {
    fn from(error: FileError) -> Self {
        Self(error.to_string())
    }
}

/// A message to the user, shown until the next action.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// The text.
    pub text: String,
    /// Whether it tells of a failure.
    pub is_error: bool,
    /// Whether it tells of something that the user may not want.
    pub warns: bool,
    /// Whether it offers to undo the last step.
    pub offers_undo: bool,
    /// Whether it offers to reload the document's file.
    pub offers_reload: bool,
    /// Whether it offers to choose anew what came in.
    pub offers_choice: bool,
    /// Whether it tells of a failed update of the preview: the next success takes it away.
    pub(in crate::editor) of_update: bool,
}

impl Message {
    /// The message of a reply; `None` for a note without a text.
    pub(in crate::editor) fn of(reply: &Reply) -> Option<Self> {
        let (note, is_error) = match reply {
            Ok(note) => (note.clone(), false),
            Err(Refusal(reason)) => (Note::told(reason.clone()), true),
        };
        (!note.text.is_empty()).then_some(Self {
            text: note.text,
            is_error,
            warns: note.warns,
            offers_undo: note.offers_undo,
            offers_choice: note.offers_choice,
            offers_reload: false,
            of_update: false,
        })
    }

    /// Show the refusal of a preview's update, or take away that of an earlier update.
    pub(in crate::editor) fn tell_update(message: &mut Option<Self>, refusal: Option<Refusal>) {
        *message = match refusal {
            Some(refusal) => Self::of(&Err(refusal)).map(|message| Self {
                of_update: true,
                ..message
            }),
            None => message.take().filter(|message| !message.of_update),
        };
    }

    /// The message of a changed file, with the offer to reload it.
    pub(in crate::editor) fn file_changed(text: String) -> Self {
        Self {
            text,
            is_error: false,
            warns: false,
            offers_undo: false,
            offers_choice: false,
            offers_reload: true,
            of_update: false,
        }
    }
}
