//! Files: one module a format, bytes in and bytes out, and [`disk`], the only one that touches
//! the disk.
//!
//! Reading gives a [`Reading`], with [`Remarks`] on what is not wrong but better told, or a
//! [`ReadError`] that names the place; writing gives an [`Export`]:
//! the bytes together with a [`LossReport`] of what the format could not hold. Nothing in here
//! opens dialogs or changes a document.

pub mod autosave;
mod codec;
mod decimals;
pub mod disk;
pub mod dxf;
mod error;
pub mod examples;
mod file_match;
mod fingerprint;
mod format;
pub mod json_layout;
mod layer_names;
mod loss;
mod object;
mod polygon;
pub mod project;
mod project_curves;
mod project_references;
mod project_v1;
mod project_v2;
mod project_values;
mod reading;
mod sessions;
pub mod table;
mod table_header;
mod text;

pub use error::{FileError, FileProblem, Place, Problem, ReadError, WriteError, shown_path};
pub use file_match::{FileMatch, MatchSource};
pub use fingerprint::Fingerprint;
pub use format::{Format, FormatError};
pub use loss::{Export, Loss, LossReport};
pub use reading::{Owner, Reading, Remark, Remarks, counted_items};
pub use sessions::{AbandonedSession, Session, Sessions};

#[cfg(test)]
mod units;
