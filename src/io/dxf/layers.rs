//! The layers of a drawing: those of groups, and those of curves without group.

use std::collections::HashMap;

use super::frame::Layer;
use crate::document::{Curve, Group, Reference};
use crate::geometry::PolygonKind;
use crate::io::layer_names::LayerNames;

/// Stands between the names of a path, as in the files of other programs that have layers within layers.
const SEPARATOR: &str = "$";

/// The curves of a group that share a layer: layers are off or locked as a whole.
type Shared = (Group, bool, bool);

/// The layers in the order of their first use.
pub(super) struct Layers<'a> {
    /// The polygons that are drawn beside each curve.
    kinds: &'a [PolygonKind],
    names: LayerNames,
    shared: HashMap<Shared, String>,
    /// The layers of groups of references.
    references: HashMap<Shared, String>,
    list: Vec<Layer>,
}

impl<'a> Layers<'a> {
    /// Begin without layers.
    pub(super) fn new(kinds: &'a [PolygonKind]) -> Self {
        Self {
            kinds,
            names: LayerNames::new(),
            shared: HashMap::new(),
            references: HashMap::new(),
            list: Vec::new(),
        }
    }

    /// The layers so far.
    pub(super) fn list(&self) -> &[Layer] {
        &self.list
    }

    /// The layer of a curve. Those of its polygons are there too, their names with a [`suffix`].
    pub(super) fn take(&mut self, curve: &Curve) -> String {
        if curve.group.is_none() {
            return self.add(curve, &curve.name);
        }
        let shared = (curve.group.clone(), curve.visible, curve.locked);
        if let Some(layer) = self.shared.get(&shared) {
            return layer.clone();
        }
        let layer = self.add(curve, &group_name(curve));
        self.shared.insert(shared, layer.clone());
        layer
    }

    /// The layer of a reference: that of its group, or one of its name.
    pub(super) fn take_reference(&mut self, reference: &Reference) -> String {
        let path = reference.group.names().join(SEPARATOR);
        let name = match reference.group.is_none() {
            true => &reference.name,
            false => &path,
        };
        let shared = (reference.group.clone(), reference.visible, reference.locked);
        let known = self.shared.get(&shared);
        let known = known.or_else(|| self.references.get(&shared));
        if let Some(layer) = known.filter(|_| !reference.group.is_none()) {
            return layer.clone();
        }
        let layer = self.names.take(name, &PolygonKind::ALL.map(suffix));
        self.list.push(Layer::new(
            layer.clone(),
            None,
            reference.visible,
            reference.locked,
        ));
        self.references.insert(shared, layer.clone());
        layer
    }

    fn add(&mut self, curve: &Curve, name: &str) -> String {
        let base = self.names.take(name, &PolygonKind::ALL.map(suffix));
        self.list.push(Layer::of(curve, base.clone(), None));
        for &kind in self.kinds {
            let layer = format!("{base}{}", suffix(kind));
            self.list.push(Layer::of(curve, layer, Some(kind)));
        }
        base
    }
}

/// What the name of a polygon's layer has behind that of its curve.
pub(super) fn suffix(kind: PolygonKind) -> &'static str {
    match kind {
        PolygonKind::Float => " float polygon",
        PolygonKind::Clamped => " closed polygon",
        PolygonKind::Bezier => " bezier polygon",
    }
}

/// The name of a group's layer for curves that are as visible and as locked as this one.
fn group_name(curve: &Curve) -> String {
    let hidden = if curve.visible { "" } else { " hidden" };
    let locked = if curve.locked { " locked" } else { "" };
    let path = curve.group.names().join(SEPARATOR);
    format!("{path}{hidden}{locked}")
}
