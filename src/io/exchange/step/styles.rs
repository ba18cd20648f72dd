//! Layers and colours, by the instances that they are assigned to.

use std::collections::HashMap;

use super::instances::{Instance, Instances};
use super::text::decode;
use super::tokens::Value;

/// Styles deeper than this are damage: from STYLED_ITEM to a colour there are six steps.
const DEEPEST: usize = 8;

/// What a file says of the look of its instances.
#[derive(Default)]
pub struct Styles<'a> {
    layers: HashMap<u64, &'a [u8]>,
    colours: HashMap<u64, [u8; 3]>,
}

/// The layer and colour of one item, as far as known.
#[derive(Clone, Copy, Default)]
pub struct Style<'a> {
    /// The name of its layer, raw.
    pub layer: Option<&'a [u8]>,
    /// Red, green and blue.
    pub colour: Option<[u8; 3]>,
}

impl<'a> Styles<'a> {
    /// Read all layers and colours.
    pub fn read(file: &Instances<'a>) -> Self {
        let mut styles = Self::default();
        for layer in file
            .all()
            .filter(|it| it.is("PRESENTATION_LAYER_ASSIGNMENT"))
        {
            let [name, _, items] = layer.params().first::<3>();
            if let (Value::Text(name), Some(items)) = (name, items.list()) {
                for id in items.refs().filter(|id| file.has(*id)) {
                    styles.layers.entry(id).or_insert(name);
                }
            }
        }
        for styled in file.all() {
            let overrides = styled.is("OVER_RIDING_STYLED_ITEM");
            if overrides || styled.is("STYLED_ITEM") {
                styles.add(file, &styled, overrides);
            }
        }
        styles
    }

    /// Find the style of an instance within something of the style `outer`.
    pub fn of(&self, id: u64, outer: Style<'a>) -> Style<'a> {
        Style {
            layer: self.layers.get(&id).copied().or(outer.layer),
            colour: self.colours.get(&id).copied().or(outer.colour),
        }
    }

    fn add(&mut self, file: &Instances<'a>, styled: &Instance<'a>, overrides: bool) {
        let [_, looks, item] = styled.named_params::<3>("STYLED_ITEM");
        let Some(item) = item.reference().filter(|id| file.has(*id)) else {
            return;
        };
        if let Some(layer) = self.layers.get(&styled.id).copied() {
            self.layers.entry(item).or_insert(layer);
        }
        let looks: Vec<u64> = looks.list().unwrap_or_default().refs().take(64).collect();
        if let Some(colour) = colour_of(file, &looks) {
            if overrides {
                self.colours.insert(item, colour);
            } else {
                self.colours.entry(item).or_insert(colour);
            }
        }
    }
}

impl<'a> Style<'a> {
    /// Take this style where it says something, else the outer one.
    pub fn within(self, outer: Self) -> Self {
        Self {
            layer: self.layer.or(outer.layer),
            colour: self.colour.or(outer.colour),
        }
    }

    /// Name the layer as a path.
    pub fn group(&self) -> Vec<String> {
        let name = self.layer.map(decode).unwrap_or_default();
        name.split('/')
            .filter(|part| !part.is_empty())
            .map(str::to_owned)
            .collect()
    }
}

/// Find a colour among style assignments: that of curves or points first, then any.
fn colour_of(file: &Instances, looks: &[u64]) -> Option<[u8; 3]> {
    let mut parts: Vec<Instance> = Vec::new();
    for look in looks.iter().filter_map(|id| file.get(*id)) {
        parts.extend(look.references().take(64).filter_map(|id| file.get(id)));
    }
    let is_own = |part: &&Instance| part.is("CURVE_STYLE") || part.is("POINT_STYLE");
    let own = parts
        .iter()
        .filter(is_own)
        .find_map(|part| colour(file, part, 0));
    own.or_else(|| parts.iter().find_map(|part| colour(file, part, 0)))
}

fn colour(file: &Instances, look: &Instance, depth: usize) -> Option<[u8; 3]> {
    if let Some(rgb) = look.part("COLOUR_RGB") {
        let mut bytes = [0; 3];
        for (byte, share) in bytes
            .iter_mut()
            .zip(rgb.filter(|it| !matches!(it, Value::Text(_))))
        {
            *byte = (share.number()?.clamp(0.0, 1.0) * 255.0).round() as u8;
        }
        return Some(bytes);
    }
    if look.is("DRAUGHTING_PRE_DEFINED_COLOUR") || look.is("PRE_DEFINED_COLOUR") {
        return named(&decode(look.label()?));
    }
    if depth >= DEEPEST {
        return None;
    }
    let inner = look.references().take(64).filter_map(|id| file.get(id));
    inner
        .into_iter()
        .find_map(|part| colour(file, &part, depth + 1))
}

fn named(name: &str) -> Option<[u8; 3]> {
    Some(match name {
        "red" => [255, 0, 0],
        "green" => [0, 255, 0],
        "blue" => [0, 0, 255],
        "yellow" => [255, 255, 0],
        "magenta" => [255, 0, 255],
        "cyan" => [0, 255, 255],
        "black" => [0, 0, 0],
        "white" => [255, 255, 255],
        _ => return None,
    })
}
