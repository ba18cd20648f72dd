//! Files of version 4, which every Rhino since 2006 and every reader of 3DM files reads.

use std::collections::HashMap;

use super::chunks::{
    COMMENT, END_OF_FILE, END_OF_TABLE, LAYER, LAYERS, LIBRARY, OBJECT, OBJECT_ATTRIBUTES,
    OBJECT_END, OBJECT_TYPE, OBJECTS, PROPERTIES, SETTINGS, UNITS,
};
use super::classes;
use super::exact;
use super::geometry::{Written, objects};
use super::output::Output;
use super::properties::{CUSTOM, TITLE, unit_code};
use crate::io::exchange::drawing::{Drawing, Item, Unreadable};

const VERSION: u32 = 4;
/// The library whose layouts these are, by its date.
const DATE: i32 = 200_612_060;
/// The tables between settings and objects, in the order that readers ask for; all but that of the
/// layers are empty.
const TABLES: [u32; 11] = [
    0x1000_0016, // bitmaps
    0x1000_0025, // texture mappings
    0x1000_0010, // materials
    0x1000_0023, // line types
    LAYERS,
    0x1000_0018, // groups
    0x1000_0019, // fonts
    0x1000_0020, // dimension styles
    0x1000_0012, // lights
    0x1000_0022, // hatch patterns
    0x1000_0021, // instance definitions
];
const HISTORY: u32 = 0x1000_0026;
/// The tolerance of the file in millimetres.
const TOLERANCE: f64 = 1e-3;
/// The colour of a new layer: black.
const LAYER_COLOUR: [u8; 3] = [0; 3];

/// A colour: red, green, blue.
type Colour = [u8; 3];

/// Write a file.
pub(super) fn write(drawing: &Drawing, name: &str) -> Result<Vec<u8>, Unreadable> {
    let mut layers = LayerTable::new(name, layer_colours(&drawing.items));
    let mut records = Output::default();
    for (index, item) in drawing.items.iter().enumerate() {
        let layer = layers.index(&item.group);
        let is_own = item.colour.is_some() && item.colour != layers.colour(&item.group);
        let written = objects(item).map_err(|reason| refused(index, item, &reason))?;
        for object in written {
            let attributes = attributes(layer, item, is_own, layers.ids.next());
            records = record(records, object, &attributes);
        }
    }
    if drawing.items.is_empty() {
        // Programs want one.
        layers.index(&[]);
    }
    let head = Output::default()
        .bytes(TITLE)
        .bytes(format!("{VERSION:>8}").as_bytes());
    let head = head.chunk(COMMENT, &Output::default().bytes(b"Batten\x1a\0"));
    let head = table(head, PROPERTIES, Output::default().short(LIBRARY, DATE));
    let head = table(head, SETTINGS, units(drawing.unit.unwrap_or(1.0)));
    let head = TABLES.into_iter().fold(head, |head, code| {
        let body = if code == LAYERS {
            layers.records.clone()
        } else {
            Output::default()
        };
        table(head, code, body)
    });
    let file = table(table(head, OBJECTS, records), HISTORY, Output::default());
    let length = i32::try_from(file.len().saturating_add(12)).map_err(|_| Unreadable {
        at: None,
        reason: "The file would be too large for version 4; export less".to_owned(),
    })?;
    Ok(file
        .chunk(END_OF_FILE, &Output::default().int(length))
        .into_bytes())
}

fn refused(index: usize, item: &Item, reason: &str) -> Unreadable {
    let name = item
        .name
        .as_ref()
        .map(|name| format!(" {name:?}"))
        .unwrap_or_default();
    Unreadable {
        at: None,
        reason: format!(
            "Curve {}{name} ({}) cannot be written: {reason}",
            index + 1,
            item.kind.name()
        ),
    }
}

fn table(output: Output, code: u32, body: Output) -> Output {
    output.container(code, &body.short(END_OF_TABLE, 0))
}

fn units(length: f64) -> Output {
    let code = unit_code(length);
    let metres = exact::quotient(length, 1e3);
    let settings = Output::default()
        .int(102)
        .word(code)
        // The tolerances of lengths, of angles and relative ones.
        .numbers(&[TOLERANCE / length, 1_f64.to_radians(), 0.01])
        // Decimals, three of them.
        .int(0)
        .int(3)
        .numbers(&[metres])
        .text(if code == CUSTOM { "units" } else { "" });
    Output::default().chunk(UNITS, &settings)
}

fn record(records: Output, written: Written, attributes: &Output) -> Output {
    let body = Output::default()
        .short(OBJECT_TYPE, written.kind)
        .append(&written.object)
        .chunk(OBJECT_ATTRIBUTES, attributes)
        .short(OBJECT_END, 0);
    records.container(OBJECT, &body)
}

/// The layout 1.0 of attributes; `is_own` where the colour is not that of the layer.
fn attributes(layer: i32, item: &Item, is_own: bool, id: u128) -> Output {
    Output::default()
        .byte(0x10)
        .id(id)
        .int(layer)
        // No material.
        .int(-1)
        .colour(item.colour.unwrap_or_default())
        // A line style that is not used, and the wire density.
        .bytes(&[0; 20])
        .int(1)
        // Whether it is hidden; the source of the colour; line type and material of the layer.
        .bytes(&[u8::from(item.hidden), u8::from(is_own), 0, 0])
        .text(item.name.as_deref().unwrap_or_default())
        .text("")
}

/// Ids that differ within a file, and the same for the same file.
struct Ids {
    next: u128,
}

impl Ids {
    /// Ids that depend on `name`.
    fn new(name: &str) -> Self {
        let hash = name.bytes().fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
        });
        // The digits that mark an id as one of a scheme of its own.
        let marks = 0x8000_8000_0000_0000_0000;
        let hash = u128::from(hash) << 64;
        Self {
            next: (hash & !(0xF000_u128 << 64) & !(0xC000_u128 << 48)) | marks,
        }
    }

    fn next(&mut self) -> u128 {
        self.next = self.next.wrapping_add(1);
        self.next
    }
}

/// The layer of what is in no group, as Rhino names it.
const DEFAULT_LAYER: &str = "Default";

/// The colour of each layer on which all items have one and the same.
fn layer_colours(items: &[Item]) -> HashMap<&[String], Option<Colour>> {
    let mut colours = HashMap::new();
    for item in items {
        let colour = colours.entry(&item.group[..]).or_insert(item.colour);
        *colour = colour.filter(|colour| Some(*colour) == item.colour);
    }
    colours
}

/// The layers, in the order of their first use; outer ones before inner ones.
struct LayerTable<'d> {
    ids: Ids,
    colours: HashMap<&'d [String], Option<Colour>>,
    indices: HashMap<Vec<String>, (i32, u128)>,
    records: Output,
}

impl<'d> LayerTable<'d> {
    /// The layers of a file with this name.
    fn new(name: &str, colours: HashMap<&'d [String], Option<Colour>>) -> Self {
        Self {
            ids: Ids::new(name),
            colours,
            indices: HashMap::new(),
            records: Output::default(),
        }
    }

    /// The colour of the layer of a group.
    fn colour(&self, group: &[String]) -> Option<Colour> {
        self.colours.get(group).copied().flatten()
    }

    /// The index of the layer of a group.
    fn index(&mut self, group: &[String]) -> i32 {
        if group.is_empty() {
            let colour = self.colour(group);
            return self.layer(&[DEFAULT_LAYER.to_owned()], 0, colour).0;
        }
        let mut found = (0, 0);
        for depth in 1..=group.len() {
            let path = group.get(..depth).unwrap_or(group);
            found = self.layer(path, found.1, self.colour(path));
        }
        found.0
    }

    fn layer(&mut self, path: &[String], parent: u128, colour: Option<Colour>) -> (i32, u128) {
        if let Some(found) = self.indices.get(path) {
            return *found;
        }
        let index = i32::try_from(self.indices.len()).unwrap_or(i32::MAX);
        let id = self.ids.next();
        let colour = colour.unwrap_or(LAYER_COLOUR);
        let data = layer(index, &layer_name(path.last()), colour, [id, parent]);
        let object = Output::default().object(classes::LAYER, &data, &data);
        self.records = std::mem::take(&mut self.records).container(LAYER, &object);
        self.indices.insert(path.to_vec(), (index, id));
        (index, id)
    }
}

/// A name that Rhino accepts: it replaces others by names of its own.
pub(super) fn layer_name(name: Option<&String>) -> String {
    let name: String = name
        .into_iter()
        .flat_map(|it| it.chars())
        .filter(|it| !it.is_control())
        .collect();
    let refused = name.trim().is_empty() || name.starts_with(['(', ')', '[', ']', '{', '}']);
    if refused { format!("_{name}") } else { name }
}

/// The layout 1.6 of layers, the first with parents; `ids` are its own and that of its parent.
fn layer(index: i32, name: &str, colour: Colour, [id, parent]: [u128; 2]) -> Output {
    Output::default()
        .byte(0x16)
        // Shown.
        .int(0)
        .int(index)
        // No IGES level, no material, and a value that is not used.
        .int(-1)
        .int(-1)
        .int(0)
        .colour(colour)
        // A line style that is not used.
        .bytes(&[0; 20])
        .text(name)
        // Shown; lines without a pattern.
        .byte(1)
        .int(-1)
        // Plots as on the screen; not locked.
        .word(u32::MAX)
        .numbers(&[0.0])
        .byte(0)
        .id(id)
        .id(parent)
        // Unfolded.
        .byte(1)
}
