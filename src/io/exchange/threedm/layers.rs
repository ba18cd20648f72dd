//! The table of layers.

use std::collections::HashMap;

use super::chunks::{Archive, CLASS, Chunk, Chunks, LAYER};
use super::cursor::Cursor;
use super::objects::object;
use super::properties::NESTED_LAYERS;

/// Layers within layers.
const DEPTH: usize = 64;

/// A layer.
#[derive(Default)]
pub(super) struct Layer {
    name: String,
    index: i32,
    pub(super) colour: Option<[u8; 3]>,
    pub(super) hidden: bool,
    id: u128,
    parent: u128,
}

/// All layers of a file.
#[derive(Default)]
pub(super) struct Layers {
    layers: Vec<Layer>,
    by_index: HashMap<i32, usize>,
    by_id: HashMap<u128, usize>,
}

impl Layers {
    /// Read the layers of a table; tell `remark` what is damaged.
    pub(super) fn read(
        &mut self,
        table: &Chunk,
        archive: Archive,
        remark: &mut impl FnMut(String),
    ) {
        for record in Chunks::new(table.body, archive).filter(|chunk| chunk.code == LAYER) {
            let mut layer = Layer {
                index: -1,
                ..Layer::default()
            };
            if let Err(reason) = fill(&mut layer, &record, archive) {
                remark(format!("byte {}: layer: {reason}", record.place()));
            }
            self.add(layer);
        }
    }

    fn add(&mut self, layer: Layer) {
        let place = self.layers.len();
        self.by_index.entry(layer.index).or_insert(place);
        if layer.id != 0 {
            self.by_id.entry(layer.id).or_insert(place);
        }
        self.layers.push(layer);
    }

    /// The layer of an index in the file.
    pub(super) fn get(&self, index: i32) -> Option<&Layer> {
        self.layers.get(*self.by_index.get(&index)?)
    }

    /// The layer and those that it is in, innermost first. Damaged files may nest them in a circle.
    fn chain(&self, index: i32) -> impl Iterator<Item = &Layer> {
        let parent = |layer: &&Layer| self.layers.get(*self.by_id.get(&layer.parent)?);
        std::iter::successors(self.get(index), parent).take(DEPTH)
    }

    /// The names of the layers that lead to a layer, outermost first.
    pub(super) fn path(&self, index: i32) -> Vec<String> {
        let mut path: Vec<String> = self.chain(index).map(|layer| layer.name.clone()).collect();
        path.reverse();
        path
    }

    /// Whether the layer or one that it is in is hidden.
    pub(super) fn hidden(&self, index: i32) -> bool {
        self.chain(index).any(|layer| layer.hidden)
    }
}

fn fill(layer: &mut Layer, record: &Chunk, archive: Archive) -> Result<(), String> {
    let chunk = Chunks::new(record.body, archive).find(|chunk| chunk.code == CLASS);
    let chunk = chunk.ok_or_else(|| "it has no data".to_owned())?;
    let mut data = object(&chunk, archive)?.data;
    let (major, minor) = data.version()?;
    if major != 1 {
        return Err(format!("its layout {major}.{minor} is not known"));
    }
    layer.hidden = data.int()? == 1;
    layer.index = data.int()?;
    // The IGES level, the material, a value that is not used.
    data.bytes(12)?;
    layer.colour = data.colour()?;
    // A style of lines that was never used.
    data.bytes(20)?;
    layer.name = data.text()?;
    if minor >= 1 {
        layer.hidden |= data.byte()? == 0;
    }
    if minor >= 6 && archive.opennurbs >= NESTED_LAYERS {
        parents(layer, &mut data)?;
    }
    Ok(())
}

fn parents(layer: &mut Layer, data: &mut Cursor) -> Result<(), String> {
    // The line pattern, the colour and the width of plots, whether it is locked.
    data.bytes(4 + 4 + 8 + 1)?;
    layer.id = data.id()?;
    layer.parent = data.id()?;
    Ok(())
}
