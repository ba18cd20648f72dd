//! Limits of items, memory and work, against files that insert blocks in blocks without end.

use crate::io::exchange::drawing::{Drawing, Item, Shape};

/// So many items any file may have: a file of five megabytes has as many without a block.
const ITEMS: usize = 150_000;

/// The bytes of a file that a further item takes.
const ITEM_BYTES: usize = 32;

/// There is room for so many items at most before any is read.
const ROOM: usize = 500_000;

/// The most items of a file of some length, those of all inserted blocks counted: as many as it could list one by one.
pub(in crate::io) fn most_items(length: usize) -> usize {
    ITEMS.max(length / ITEM_BYTES)
}

impl Drawing {
    /// Begin the drawing of a file of some length, with room for its items: a list of many that grows takes its memory
    /// twice.
    pub(super) fn of_file(length: usize) -> Self {
        Self {
            items: Vec::with_capacity(ROOM.min(length / ITEM_BYTES)),
            ..Self::default()
        }
    }
}

/// What reading has cost, and the limits.
pub(super) struct Spending {
    items: usize,
    most_items: usize,
    /// Estimated bytes of the items.
    memory: usize,
    memory_limit: usize,
    /// Bytes of parameters read.
    work: u64,
    work_limit: u64,
}

impl Spending {
    /// Give the limits for a file of a length.
    ///
    /// An item needs at most some eight bytes for a byte of its file, and each parameter line is read once,
    /// but for subfigures.
    pub fn of_file(length: usize) -> Self {
        Self {
            items: 0,
            most_items: most_items(length),
            memory: 0,
            memory_limit: length.saturating_mul(8).max(96 << 20),
            work: 0,
            work_limit: u64::try_from(length)
                .unwrap_or(u64::MAX)
                .saturating_mul(8)
                .max(192 << 20),
        }
    }

    /// Say whether a limit is reached.
    pub fn is_over(&self) -> bool {
        self.items >= self.most_items
            || self.memory >= self.memory_limit
            || self.work >= self.work_limit
    }

    /// Name the limit that was reached.
    pub fn reason(&self) -> String {
        let limit = if self.work >= self.work_limit {
            "time"
        } else {
            "memory"
        };
        if self.items >= self.most_items {
            format!("{} items are reached", self.items)
        } else {
            format!("the limit of {limit} is reached after {} items", self.items)
        }
    }

    /// Count bytes of parameters.
    pub fn work(&mut self, bytes: u64) {
        self.work = self.work.saturating_add(bytes);
    }

    /// Count a shape of an item to come.
    pub fn keep_shape(&mut self, shape: &Shape) {
        self.memory = self.memory.saturating_add(shape.memory());
    }

    /// Count an item behind another, without its shapes; `false` if it is beyond the limits.
    pub fn keep(&mut self, item: &Item, before: Option<&Item>) -> bool {
        if self.is_over() {
            return false;
        }
        self.memory = self.memory.saturating_add(item.own_memory(before));
        self.items = self.items.saturating_add(1);
        true
    }
}
