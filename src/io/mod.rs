//! Files: one module a format, bytes in and bytes out, and [`disk`], the only one that touches
//! the disk.
//!
//! Reading gives a [`Reading`], with [`Remarks`] on what is not wrong but better told, or a
//! [`ReadError`] that names the place; writing gives an [`Export`]:
//! the bytes together with a [`LossReport`] of what the format could not hold. Nothing in here
//! opens dialogs or changes a document.

mod airfoil_order;
pub mod autosave;
mod decimals;
pub mod disk;
mod dxf;
mod error;
pub mod examples;
pub mod exchange;
mod export;
mod file_match;
mod fingerprint;
mod format;
pub mod formats;
mod gpx;
pub mod json_layout;
mod layer_names;
mod loss;
mod object;
mod original;
mod picture;
mod point_section;
mod point_table;
mod polygon;
mod project;
mod project_curves;
mod project_file;
mod project_guides;
mod project_matches;
mod project_references;
mod project_symmetry;
mod project_values;
mod reading;
mod sessions;
mod table;
mod table_column;
mod table_columns;
mod table_header;
mod table_lines;
mod table_points;
mod tangent_plane;
mod text;
mod xml;

pub use airfoil_order::AirfoilOrder;
pub use dxf::DXF;
pub use error::{
    FileError, FileProblem, FormatError, Place, Problem, ReadError, WriteError, shown_path,
};
pub use exchange::formats::svg_path;
pub use export::{ExportChoice, PRESETS, Preset, Scope};
pub use file_match::{FileMatch, MatchSource};
pub use fingerprint::Fingerprint;
pub use format::{ExportRow, Exporter, Format};
pub use gpx::GPX;
pub use loss::{CubicDifference, Export, Loss, LossReport};
pub use original::{Original, Rest, WrittenBack};
pub use picture::{Decoded, PICTURE, decode};
pub use point_table::POINT_TABLE;
pub use project::PROJECT;
pub use reading::{Owner, Reading, Remark, Remarks, counted_content, counted_items};
pub use sessions::{AbandonedSession, Session, Sessions};
pub use table::{TAB_TABLE, TABLE};
pub use table_column::TableColumn;
pub use table_columns::ColumnChoice;

#[cfg(test)]
mod groups;
#[cfg(test)]
mod originals;
#[cfg(test)]
mod units;
