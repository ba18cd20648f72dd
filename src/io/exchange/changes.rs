//! What has become of the items of a drawing since it was read, to be written into the text of its file.

use std::collections::HashMap;

use super::drawing::{Affine, Item, Shape};
use super::writing::Manner;
use crate::io::loss::LossReport;

/// Writes changes into the bytes of a file, or says why that is not possible.
type Rewrite = fn(&[u8], &Changes, &mut LossReport) -> Result<Vec<u8>, String>;

/// How changes are written into files of a format.
pub(in crate::io) struct Rewriter {
    /// What the format makes of curves and references.
    pub(in crate::io) manner: Manner,
    /// Write changes into the bytes of a file, and leave everything else as it was; the reason where that is not
    /// possible.
    pub(in crate::io) write: Rewrite,
}

/// The changes of a drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// The items that have changed, by their places in the drawing.
    pub items: HashMap<usize, ItemChange>,
    /// The items that are new.
    pub added: Vec<Item>,
}

/// What has become of an item.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ItemChange {
    /// Its name, for what is told.
    pub name: String,
    /// For each of its shapes what stands for it now; `None` for a shape that has not changed.
    pub shapes: Vec<Option<Vec<Shape>>>,
}

impl Changes {
    /// Whether nothing has changed.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty() && self.added.is_empty()
    }
}

impl ItemChange {
    /// Put what stands for the shapes of the item, placed, in their places.
    pub(super) fn applied(&self, shapes: Vec<Shape>, place: &Affine) -> Vec<Shape> {
        let shapes = shapes.into_iter().enumerate();
        let changed = shapes.flat_map(|(index, shape)| match self.shapes.get(index) {
            Some(Some(shapes)) => {
                let shapes = shapes.iter().cloned();
                shapes.map(|it| it.placed(place)).collect()
            }
            _ => vec![shape],
        });
        changed.collect()
    }
}
