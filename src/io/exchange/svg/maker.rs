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
                .saturating_sub(size(&item, self.items.last()));
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

/// Get about how many bytes an item takes behind another.
fn size(item: &Item, before: Option<&Item>) -> usize {
    /// What an allocation costs beside its contents.
    const ALLOCATION: usize = 16;
    let shapes = item.shapes.iter().map(|shape| {
        let inner = match shape {
            Shape::Nurbs(nurbs) => {
                size_of_val(nurbs.points.as_slice()) + size_of_val(nurbs.knots.as_slice())
            }
            Shape::Polyline { points, .. } => size_of_val(points.as_slice()),
            Shape::Conic(_) | Shape::Point(_) => 0,
        };
        size_of::<Shape>() + inner + 2 * ALLOCATION
    });
    size_of::<Item>() + ALLOCATION + item.texts_size(before) + shapes.sum::<usize>()
}
