//! What is taken of a file of another program.

use std::collections::HashSet;
use std::sync::Arc;

use super::drawing::{Item, Kind, Space};
use crate::document::Group;
use crate::geometry::expressions::LengthUnit;

/// The name of items that are on no layer.
const NO_LAYER: &str = "no layer";

/// Items of one kind on one layer.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct RowKey {
    /// Where they belong.
    pub space: Space,
    /// The path of the layer, outermost first; empty for none.
    pub layer: Arc<[String]>,
    /// The entity of the file.
    pub kind: Kind,
}

/// What is taken of a file of another program, and how.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportChoice {
    /// The kinds and layers that are taken.
    pub taken: HashSet<RowKey>,
    /// The unit of a file that says none.
    pub unit: Option<LengthUnit>,
    /// Whether float polygons are made of smooth references too.
    pub to_float: bool,
    /// How far these may be off, in the unit of the file; without it 1e-4 of their size.
    pub tolerance: Option<f64>,
}

impl RowKey {
    /// The key of an item.
    pub(super) fn of(item: &Item) -> Self {
        Self {
            space: item.space,
            layer: item.group.clone(),
            kind: item.kind,
        }
    }

    /// The layer as a path, with `/` between names.
    pub fn layer_name(&self) -> String {
        match self.layer.is_empty() {
            true => NO_LAYER.to_owned(),
            false => Group::new(&self.layer[..]).to_string(),
        }
    }
}

/// The space of which items are taken unless others are chosen.
pub(super) fn free_space(spaces: impl Iterator<Item = Space> + Clone) -> Space {
    let has = |space: Space| spaces.clone().any(|it| it == space);
    match has(Space::Edge) && !has(Space::Model) {
        true => Space::Edge,
        false => Space::Model,
    }
}
