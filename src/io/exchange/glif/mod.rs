//! Glyphs of UFO fonts, versions 2 and 3: one file a glyph. Font units have no length.
//!
//! Each contour becomes an item. A run of off-curve points is a B-spline on clamped uniform knots, so neither
//! the points that TrueType implies nor those of longer cubic runs have to be computed.

mod reader;
mod writer;

#[cfg(test)]
mod tests;

use crate::io::exchange::drawing::{Drawing, Unreadable};

/// Read the contours of a glyph.
pub fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    reader::read(bytes)
}

/// Write a glyph of lines, cubic and quadratic curves; refuse anything else.
pub fn write(drawing: &Drawing, name: &str) -> Result<Vec<u8>, Unreadable> {
    writer::write(drawing, name)
}
