//! Files: one module a format, bytes in and bytes out, and [`disk`], the only one that touches
//! the disk.
//!
//! Reading gives a [`Reading`], with [`Remarks`] on what is not wrong but better told, or a
//! [`ReadError`] that names the place; writing gives an [`Export`]:
//! the bytes together with a [`LossReport`] of what the format could not hold. Nothing in here
//! opens dialogs or changes a document.

pub mod autosave;
mod decimals;
pub mod disk;
mod dxf;
mod error;
pub mod examples;
mod file_match;
mod fingerprint;
mod format;
pub mod formats;
pub mod json_layout;
mod layer_names;
mod loss;
mod object;
mod polygon;
mod project;
mod project_curves;
mod project_file;
mod project_matches;
mod project_references;
mod project_values;
mod reading;
mod sessions;
mod table;
mod table_header;
mod text;

pub use dxf::DXF;
pub use error::{
    FileError, FileProblem, FormatError, Place, Problem, ReadError, WriteError, shown_path,
};
pub use file_match::{FileMatch, MatchSource};
pub use fingerprint::Fingerprint;
pub use format::{ExportRow, Exporter, Format};
pub use loss::{Export, Loss, LossReport};
pub use project::PROJECT;
pub use reading::{Owner, Reading, Remark, Remarks, counted_items};
pub use sessions::{AbandonedSession, Session, Sessions};
pub use table::TABLE;

#[cfg(test)]
mod units;
