//! SVG drawings.
//!
//! In the result y goes up. The origin is the lower left corner of the page, except where the `viewBox`
//! begins elsewhere than at 0 0: such a file has an origin of its own, which is kept (x stays, y changes its
//! sign). Where the page has no height, y changes its sign too.
//!
//! Coordinates are millimetres where `width` or `height` has a unit of length, `px` counting as 1/96 inch.
//! Otherwise, and where `px` means something else (Illustrator counts 72 an inch, Inkscape before 0.92 counts
//! 90), coordinates are pixels, the unit is unknown, and a remark names the likely resolution.

mod document;
mod lengths;
mod maker;
mod names;
mod namespaces;
mod paths;
mod rewriting;
mod shapes;
mod style;
mod transforms;
mod writer;

#[cfg(test)]
mod tests;

use super::changes::Changes;
use crate::io::exchange::drawing::{Drawing, Item, Unreadable};
use crate::io::loss::LossReport;
use crate::io::xml::Source;

/// Read the shapes of a drawing.
pub fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    let source = Source::new(bytes)?;
    document::read(&source, &source.document()?, bytes.len())
}

/// Write changes into the text of a drawing; the reason where that is not possible.
pub fn rewrite(
    bytes: &[u8],
    changes: &Changes,
    losses: &mut LossReport,
) -> Result<Vec<u8>, String> {
    rewriting::rewritten(bytes, changes, losses)
}

/// Say what an item is that SVG cannot hold.
pub fn holds(item: &Item) -> Result<(), String> {
    writer::holds(item)
}

/// The names of a group's path that a file holds.
pub fn kept_group(path: &[String]) -> Vec<String> {
    writer::shortened(path)
}

/// The data of one path along everything that is drawn, with numbers as they are; refuse what SVG cannot hold.
pub fn path_data(drawing: &Drawing) -> Result<String, Unreadable> {
    writer::data(drawing)
}

/// Write a drawing to scale, in millimetres; refuse what SVG cannot hold exactly.
pub fn write(drawing: &Drawing, name: &str) -> Result<Vec<u8>, Unreadable> {
    writer::write(drawing, name)
}
