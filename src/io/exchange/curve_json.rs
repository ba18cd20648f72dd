//! Curves as JSON: `{"unit", "curves": [{"name", "degree", "knots", "points", "weights", "periodic",
//! "group"}]}`.
//!
//! `unit` is mm, cm, m, in or null; a bare list of curves is read as well. Points have two or three
//! coordinates. `group` is the path of groups, joined by `/`, or a list of names if one holds a `/`. Knots,
//! weights, names and the rest may be missing: curves without knots are clamped and uniform.

mod reader;
mod units;
mod writer;

#[cfg(test)]
mod tests;

use crate::io::exchange::drawing::{Drawing, Item, Unreadable};

/// Read all curves.
pub fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    reader::read(bytes)
}

/// Say what an item is that JSON cannot hold.
///
/// # Errors
/// What it is.
pub fn holds(item: &Item) -> Result<(), String> {
    writer::holds(item)
}

/// Write all curves as splines; the file has no name of its own.
pub fn write(drawing: &Drawing, _name: &str) -> Result<Vec<u8>, Unreadable> {
    writer::write(drawing)
}
