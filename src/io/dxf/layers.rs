//! The layers of a drawing: those of groups, and those of curves without group.

use std::collections::HashMap;

use super::frame::Layer;
use crate::document::{Curve, Group, Reference};
use crate::geometry::PolygonKind;
use crate::io::exchange::drawing::Kind;
use crate::io::layer_names::{DEFAULT, LayerNames};

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
            names: LayerNames::new(&PolygonKind::ALL.map(suffix)),
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
        let state = (curve.visible, curve.locked);
        let Some(group) = shared_group(&curve.name, &curve.group) else {
            return self.add(state, &curve.name);
        };
        let shared = (group, curve.visible, curve.locked);
        if let Some(layer) = self.shared.get(&shared) {
            return layer.clone();
        }
        let layer = self.add(state, &group_name(&shared));
        self.shared.insert(shared, layer.clone());
        layer
    }

    /// The layer of a reference: that of its group, or one of its name.
    pub(super) fn take_reference(&mut self, reference: &Reference) -> String {
        let state = (reference.visible, reference.locked);
        let Some(group) = shared_group(&reference.name, &reference.group) else {
            return self.add_plain(state, &reference.name);
        };
        let shared = (group, reference.visible, reference.locked);
        let known = self.shared.get(&shared);
        if let Some(layer) = known.or_else(|| self.references.get(&shared)) {
            return layer.clone();
        }
        let layer = self.add_plain(state, &group_name(&shared));
        self.references.insert(shared, layer.clone());
        layer
    }

    /// Add a layer, and those of polygons.
    fn add(&mut self, (visible, locked): (bool, bool), name: &str) -> String {
        let base = self.add_plain((visible, locked), name);
        for &kind in self.kinds {
            let layer = format!("{base}{}", suffix(kind));
            self.list
                .push(Layer::new(layer, Some(kind), visible, locked));
        }
        base
    }

    /// Add a layer, but for the one that every drawing has.
    fn add_plain(&mut self, (visible, locked): (bool, bool), name: &str) -> String {
        if name == DEFAULT {
            return name.to_owned();
        }
        let layer = self.names.take(name, &PolygonKind::ALL.map(suffix));
        self.list
            .push(Layer::new(layer.clone(), None, visible, locked));
        layer
    }
}

/// The group whose layers hold a curve or a reference: names that readers make up are none. `None` for what has a layer of
/// its own, since it has a name and no group.
fn shared_group(name: &str, group: &Group) -> Option<Group> {
    let names = group.names().iter().filter(|name| !Kind::is_made_up(name));
    let group = Group::new(names);
    (!group.is_none() || Kind::is_made_up(name)).then_some(group)
}

/// What the name of a polygon's layer has behind that of its curve.
pub(super) fn suffix(kind: PolygonKind) -> &'static str {
    match kind {
        PolygonKind::Float => " float polygon",
        PolygonKind::Clamped => " closed polygon",
        PolygonKind::Bezier => " bezier polygon",
    }
}

/// The name of the layer of a group, of what is as visible and as locked; without names the layer that every drawing has.
fn group_name((group, visible, locked): &Shared) -> String {
    let hidden = if *visible { "" } else { " hidden" };
    let locked = if *locked { " locked" } else { "" };
    let path = match group.is_none() {
        true => DEFAULT.to_owned(),
        false => group.names().join(SEPARATOR),
    };
    format!("{path}{hidden}{locked}")
}
