//! Glyphs of UFO fonts, versions 2 and 3: one file a glyph. Font units have no length.
//!
//! Each contour becomes an item. A run of off-curve points is a B-spline on clamped uniform knots, so neither
//! the points that TrueType implies nor those of longer cubic runs have to be computed.

mod reader;
mod rewriting;
mod writer;

#[cfg(test)]
mod tests;

use super::changes::Changes;
use crate::io::exchange::drawing::{Drawing, Item, Unreadable};
use crate::io::loss::LossReport;
use crate::io::xml::Source;

/// Read the contours of a glyph.
pub fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    let source = Source::new(bytes)?;
    Ok(reader::read(&source, &source.document()?)?.0)
}

/// Write changes into the text of a glyph; the reason where that is not possible.
pub fn rewrite(
    bytes: &[u8],
    changes: &Changes,
    losses: &mut LossReport,
) -> Result<Vec<u8>, String> {
    rewriting::rewritten(bytes, changes, losses)
}

/// Say what an item is that a glyph cannot hold.
pub fn holds(item: &Item) -> Result<(), String> {
    writer::contours(&item.shapes).map(|_| ())
}

/// Write a glyph of lines, cubic and quadratic curves; refuse anything else.
pub fn write(drawing: &Drawing, name: &str) -> Result<Vec<u8>, Unreadable> {
    writer::write(drawing, name)
}
