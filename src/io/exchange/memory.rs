//! How much memory curves of a file take, about.

use std::sync::Arc;

use super::drawing::{Item, Shape};

/// What an allocation costs beside its contents.
const ALLOCATION: usize = 16;

impl Shape {
    /// About how many bytes it takes.
    pub(super) fn memory(&self) -> usize {
        let numbers = match self {
            Self::Nurbs(nurbs) => {
                let weights = nurbs.weights.as_deref().unwrap_or_default();
                size_of_val(&*nurbs.points) + size_of_val(&*nurbs.knots) + size_of_val(weights)
            }
            Self::Polyline { points, .. } => size_of_val(&**points),
            Self::Conic(_) | Self::Point(_) => 0,
        };
        size_of::<Self>() + numbers + 2 * ALLOCATION
    }
}

impl Item {
    /// About how many bytes it takes behind another item.
    pub(super) fn memory(&self, before: Option<&Self>) -> usize {
        let shapes = self.shapes.iter().map(Shape::memory);
        self.own_memory(before) + shapes.sum::<usize>()
    }

    /// About how many bytes it takes without its shapes. The list of items has room for more of them.
    pub(super) fn own_memory(&self, before: Option<&Self>) -> usize {
        size_of::<Self>() * 3 / 2 + ALLOCATION + self.names_memory(before)
    }

    /// The bytes of its names, without the path and the block that it shares with the item before it.
    pub(super) fn names_memory(&self, before: Option<&Self>) -> usize {
        let path = self.group.iter();
        let path = path.map(|name| name.capacity() + size_of::<String>() + ALLOCATION);
        let is_own = before.is_none_or(|it| !Arc::ptr_eq(&it.group, &self.group));
        let path = if is_own { path.sum() } else { 0 };
        let block = self.block.as_ref().filter(|block| {
            let before = before.and_then(|it| it.block.as_ref());
            before.is_none_or(|it| !Arc::ptr_eq(it, block))
        });
        let block = block.map_or(0, |block| block.len() + 2 * ALLOCATION);
        let name = self.name.as_ref();
        let name = name.map_or(0, |name| name.capacity() + ALLOCATION);
        path + block + name
    }
}
