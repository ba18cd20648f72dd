//! The table of layers.

use std::collections::HashMap;

use super::colours::{Paint, paint};
use super::groups::Trouble;
use super::records::Record;

/// The bit of group 70 of a frozen layer.
const FROZEN: i64 = 1;

/// A row of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layer {
    /// The name as the table spells it.
    pub name: String,
    /// Its colour, if it is more than a contrast with the background.
    pub colour: Option<[u8; 3]>,
    /// Whether it is off: its own entities are not drawn.
    pub is_off: bool,
    /// Whether it is frozen: what blocks on it hold is not drawn either.
    pub is_frozen: bool,
}

/// The layers by name; large and small letters are alike.
#[derive(Debug, Default)]
pub struct Layers {
    rows: HashMap<String, Layer>,
}

impl Layer {
    /// Whether its own entities are not drawn.
    pub fn is_hidden(&self) -> bool {
        self.is_off || self.is_frozen
    }
}

impl Layers {
    /// Find a layer.
    pub fn find(&self, name: &str) -> Option<&Layer> {
        self.rows.get(&name.to_lowercase())
    }

    /// Add a row of the table, unless there is one of its name.
    ///
    /// # Errors
    /// [`Trouble`] if a number is damaged.
    pub fn add(&mut self, name: String, row: &Record<'_>) -> Result<(), Trouble> {
        // A negative colour turns the layer off.
        let is_off = row.integer(62)? < 0;
        let is_frozen = row.integer(70)? & FROZEN != 0;
        let colour = match paint(row)? {
            Paint::Own(colour) => colour,
            Paint::Layer | Paint::Block => None,
        };
        let layer = Layer {
            name,
            colour,
            is_off,
            is_frozen,
        };
        self.rows.entry(layer.name.to_lowercase()).or_insert(layer);
        Ok(())
    }
}
