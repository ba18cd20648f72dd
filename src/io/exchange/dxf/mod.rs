//! AutoCAD's drawing exchange format, in text or binary, from R12 on: the reader.
//!
//! One pass finds the sections, tables and blocks. Entities are read where they stand, so that memory
//! goes to curves alone. Damage costs the entity in which it lies, not the file.

use crate::io::exchange::drawing::{Drawing, Unreadable};

mod axes;
mod code_pages;
pub(in crate::io) mod colours;
mod entities;
mod fit;
mod groups;
mod inserts;
mod layers;
mod notes;
mod parts;
mod polylines;
mod records;
mod sections;
mod splines;
mod text;
mod units;

#[cfg(test)]
mod tests;

use groups::Groups;
use inserts::Placer;
use notes::Notes;
use sections::Sections;

/// Read every curve and point of a drawing, with its blocks inserted.
///
/// # Errors
/// [`Unreadable`] if the bytes are no DXF file, or one without a single section.
pub fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    let groups = Groups::of(bytes)?;
    let mut notes = Notes::new(groups.counts_lines());
    let sections = Sections::find(groups, &mut notes)?;
    let mut drawing = Placer::new(&sections, &mut notes, bytes.len()).drawing();
    drawing.unit = sections.unit;
    drawing.remarks = notes.into_remarks();
    Ok(drawing)
}
