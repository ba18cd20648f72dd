//! Commands: their table, and their execution.

mod arranging;
mod clipboard;
pub(in crate::editor) mod command;
mod deleting;
pub(in crate::editor) mod drawing;
mod end_fit;
mod end_matches;
mod execute;
mod files;
mod foreseen;
mod items;
mod locking;
mod merging;
mod operating;
mod pictures;
mod recovering;
mod references;
mod state;

pub use clipboard::{CopyForm, Pasted};
pub use command::{Command, Shortcut};
pub use end_matches::met_curves;
pub use pictures::{PICTURE_PLANES, PictureChange, measured_direction, picture_plane};
pub use references::ReferenceChange;
