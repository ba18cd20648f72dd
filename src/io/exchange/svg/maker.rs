//! The items of an element.

use super::super::pieces::is_finite;
use crate::io::exchange::drawing::{Affine, Item, Shape};

/// Makes the items of one element.
pub(super) struct Maker {
    place: Affine,
    /// The item without its shapes.
    item: Item,
    /// All items so far.
    pub(super) items: Vec<Item>,
    /// How many were beyond all numbers.
    pub(super) infinite: usize,
    /// The room that is left.
    pub(super) room: Room,
}

/// The room for items.
#[derive(Clone, Copy)]
pub(super) struct Room {
    /// How many bytes they may still take.
    pub(super) memory: usize,
    /// How many there may be.
    pub(super) items: usize,
}

impl Maker {
    /// Make items like one without shapes, behind other items.
    pub(super) fn new(place: Affine, item: Item, items: Vec<Item>, room: Room) -> Self {
        Self {
            place,
            item,
            items,
            infinite: 0,
            room,
        }
    }

    /// Place the shapes of an item; return whether there is room for another.
    pub(super) fn take(&mut self, shapes: Vec<Shape>) -> bool {
        let shapes = if self.place == Affine::default() {
            shapes
        } else {
            shapes
                .into_iter()
                .map(|it| it.placed(&self.place))
                .collect()
        };
        if shapes.iter().all(is_finite) {
            let item = Item {
                shapes,
                ..self.item.clone()
            };
            self.room.memory = self
                .room
                .memory
                .saturating_sub(item.memory(self.items.last()));
            self.items.push(item);
        } else {
            self.infinite += 1;
        }
        !self.is_full()
    }

    /// Tell whether there is no room for another item.
    pub(super) fn is_full(&self) -> bool {
        self.room.memory == 0 || self.items.len() >= self.room.items
    }
}
