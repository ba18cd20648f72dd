//! Background work: worker threads, the client that every kind of work shares, and the kinds themselves.

mod client;
mod worker;

pub(in crate::editor) mod autosaving;
pub(in crate::editor) mod comparing;
pub(in crate::editor) mod edited_file;
pub(in crate::editor) mod exporting;
pub(in crate::editor) mod file_reading;
pub(in crate::editor) mod filing;
pub(in crate::editor) mod foreseeing;
pub(in crate::editor) mod guides;
pub(in crate::editor) mod measuring;
pub(in crate::editor) mod patience;
pub(in crate::editor) mod pictures;
pub(in crate::editor) mod proving;
pub(in crate::editor) mod pyramid;
pub(in crate::editor) mod recoverable;
mod recovery;

pub use autosaving::Autosaver;
pub(in crate::editor) use client::Client;
pub use filing::{FileWork, with_extension};
pub use recoverable::{Recoverable, RecoverableDocument};
pub use recovery::Recovery;
