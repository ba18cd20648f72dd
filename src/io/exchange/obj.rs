//! Free-form curves, polylines and points of Wavefront OBJ files.
//!
//! The format has no units; a comment such as `# unit: 25.4 mm`, as it is written here, is understood. `o`
//! gives the name, `g` the group: all of its line, split at each `/`. Faces and surfaces are counted alone.

mod curves;
mod reader;
mod words;
mod writer;

#[cfg(test)]
mod tests;

use crate::io::exchange::drawing::{Drawing, Unreadable};

/// Read all curves, polylines and points.
pub fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    reader::read(bytes)
}

/// The names of a group's path that a file holds.
pub fn kept_group(path: &[String]) -> Vec<String> {
    reader::group(&writer::group_name(path))
}

/// Write all items: splines and arcs as B-splines, polylines as lines, points as points.
pub fn write(drawing: &Drawing, name: &str) -> Result<Vec<u8>, Unreadable> {
    writer::write(drawing, name)
}
