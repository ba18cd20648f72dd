//! The pairs of group codes and values that the format consists of.

use std::fmt::{Display, Write};

use glam::DVec3;

use crate::document::Colour;
use crate::io::exchange::dxf::colours::nearest_index;

/// The handle of the block that everything drawn belongs to.
pub(super) const MODEL_SPACE: u64 = 0x10;

/// The first handle given to entities; those below belong to the frame.
const FIRST_ENTITY: u64 = 0x100;

/// Collect groups, and give out the handles by which entities are known.
pub(super) struct Writer {
    text: String,
    next_handle: u64,
    /// The index of the colour of the entities to come; `None` for that of their layer.
    colour: Option<i64>,
}

impl Writer {
    /// Begin without entities.
    pub(super) fn new() -> Self {
        Self {
            text: String::new(),
            next_handle: FIRST_ENTITY,
            colour: None,
        }
    }

    /// Begin to write something whose handles follow those of another writer.
    pub(super) fn following(other: &Self) -> Self {
        Self {
            text: String::new(),
            next_handle: other.next_handle,
            colour: None,
        }
    }

    /// Give the entities to come the nearest colour of those that the format has.
    pub(super) fn set_colour(&mut self, colour: Option<Colour>) {
        self.colour = colour.map(|it| nearest_index(it.0).0);
    }

    /// The handle that `take_handle` returns next.
    pub(super) fn next_handle(&self) -> u64 {
        self.next_handle
    }

    /// Take a new handle.
    pub(super) fn take_handle(&mut self) -> u64 {
        self.next_handle += 1;
        self.next_handle - 1
    }

    /// The text written so far.
    pub(super) fn into_text(self) -> String {
        self.text
    }

    /// Append what another writer wrote.
    pub(super) fn append(&mut self, text: &str) {
        self.text.push_str(text);
    }

    /// Begin an entity of the model; returns its handle.
    pub(super) fn entity(&mut self, name: &str, layer: &str) -> u64 {
        self.part(name, MODEL_SPACE, layer)
    }

    /// Begin an entity that belongs to another one; returns its handle.
    pub(super) fn part(&mut self, name: &str, owner: u64, layer: &str) -> u64 {
        let handle = self.take_handle();
        self.text(0, name);
        self.handle(5, handle);
        self.handle(330, owner);
        self.text(100, "AcDbEntity");
        self.text(8, layer);
        if let Some(index) = self.colour {
            self.integer(62, index);
        }
        handle
    }

    /// Write text. The format is not UTF-8: what is not ASCII is written by its number.
    pub(super) fn text(&mut self, code: u32, text: &str) {
        let mut escaped = String::with_capacity(text.len());
        for character in text.chars() {
            if character.is_ascii() {
                escaped.push(character);
            } else {
                // Writing to a string cannot fail.
                let _ = write!(escaped, "\\U+{:04X}", u32::from(character));
            }
        }
        self.group(code, escaped);
    }

    /// Write a handle.
    pub(super) fn handle(&mut self, code: u32, handle: u64) {
        self.group(code, format_args!("{handle:X}"));
    }

    /// Write a whole number.
    pub(super) fn integer(&mut self, code: u32, value: i64) {
        self.group(code, value);
    }

    /// Write how many there are of something.
    pub(super) fn count(&mut self, code: u32, count: usize) {
        self.group(code, count);
    }

    /// Write a number exactly.
    pub(super) fn number(&mut self, code: u32, value: f64) {
        // The sum makes 0 of −0, which some readers stumble over.
        self.group(code, format_args!("{:?}", value + 0.0));
    }

    /// Write a point, its coordinates with codes ten apart.
    pub(super) fn point(&mut self, code: u32, point: DVec3) {
        for (index, value) in (0..).zip(point.to_array()) {
            self.number(code + 10 * index, value);
        }
    }

    fn group(&mut self, code: u32, value: impl Display) {
        // Writing to a string cannot fail.
        let _ = write!(self.text, "{code:>3}\n{value}\n");
    }
}
