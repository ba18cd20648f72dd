//! Files: one module a format, bytes in and bytes out, and [`disk`], the only one that touches
//! the disk.
//!
//! Reading gives curves or a [`ReadError`] that names the place; writing gives an [`Export`]:
//! the bytes together with a [`LossReport`] of what the format could not hold. Nothing in here
//! opens dialogs or changes a document.

pub mod disk;
pub mod dxf;
mod error;
pub mod examples;
mod format;
pub mod json_layout;
mod layer_names;
mod loss;
mod polygon;
pub mod project;
mod project_v1;
pub mod table;
mod table_header;

pub use error::{FileError, FormatError, Place, Problem, ReadError, WriteError};
pub use format::Format;
pub use loss::{Export, Loss, LossReport};
