//! What a pass over the whole file finds: the header, layers, blocks, and where entities stand.

use std::collections::HashMap;

use glam::DVec3;

use super::groups::{Group, Groups};
use super::layers::Layers;
use super::notes::Notes;
use super::records::{Record, Records};
use super::text::Decoder;
use super::units::millimetres;
use crate::io::exchange::drawing::{Space, Unreadable};

/// The bits of group 70 of a block that stands in another file.
const EXTERNAL: i64 = 4 | 8;

/// The parts of a file.
#[derive(Debug, Default)]
pub struct Sections<'a> {
    /// The length of a unit in millimetres, if the header says it.
    pub unit: Option<f64>,
    /// How strings are coded.
    pub decoder: Decoder,
    /// The table of layers.
    pub layers: Layers,
    /// The blocks in the order of the file.
    pub blocks: Vec<Block<'a>>,
    /// Where entities stand.
    pub entities: Vec<Groups<'a>>,
    /// The numbers of the blocks by name, in small letters.
    names: HashMap<String, usize>,
}

/// A block: entities that an INSERT draws.
#[derive(Clone, Debug)]
pub struct Block<'a> {
    /// The name.
    pub name: String,
    /// The point that comes to the point of insertion.
    pub base: DVec3,
    /// Whether the entities stand in another file.
    pub is_external: bool,
    /// The space if the block is a layout, which is drawn without an INSERT.
    pub layout: Option<Space>,
    /// The entities.
    pub entities: Groups<'a>,
    /// Its line or byte, from 1.
    at: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Section {
    Outside,
    Tables,
    Blocks,
    Entities,
    Passed,
}

/// The state of the pass.
struct Pass<'a, 'n> {
    found: Sections<'a>,
    notes: &'n mut Notes,
    section: Section,
    /// The block that has not ended.
    block: Option<Block<'a>>,
    /// Where the entities of the section begin.
    entities: Option<Groups<'a>>,
    /// Whether a section was found.
    has_section: bool,
}

impl<'a> Sections<'a> {
    /// Look through a whole file.
    ///
    /// # Errors
    /// [`Unreadable`] if it has no section.
    pub fn find(groups: Groups<'a>, notes: &mut Notes) -> Result<Self, Unreadable> {
        let mut pass = Pass {
            found: Self::default(),
            notes,
            section: Section::Outside,
            block: None,
            entities: None,
            has_section: false,
        };
        pass.run(groups.clone());
        if pass.has_section {
            return Ok(pass.found);
        }
        Err(Unreadable {
            at: Some(groups.at()),
            reason: "there is no SECTION: this is no DXF file".to_owned(),
        })
    }

    /// Find the number of a block.
    pub fn block(&self, name: &str) -> Option<usize> {
        self.names.get(&name.to_lowercase()).copied()
    }
}

impl<'a> Pass<'a, '_> {
    fn run(&mut self, groups: Groups<'a>) {
        let mut records = Records::new(groups);
        let mut last = "the file";
        while let Some(record) = records.next() {
            match record {
                Ok(record) if record.name == "EOF" => {
                    self.close(&record.start);
                    self.note_trash(records.rest());
                    return;
                }
                Ok(record) => {
                    last = record.name;
                    self.take(&record);
                }
                Err(trouble) => {
                    self.notes
                        .add(trouble.at, format_args!("in {last}: {}", trouble.reason));
                }
            }
        }
        self.notes
            .add(records.rest().at(), "the file ends without EOF");
        self.close(records.rest());
    }

    /// Entities may stand after the first EOF of files that were joined.
    fn note_trash(&mut self, rest: &Groups<'a>) {
        if rest.is_followed() {
            self.notes.add(rest.at(), "what follows EOF is left out");
        }
    }

    fn take(&mut self, record: &Record<'a>) {
        match (record.name, self.section) {
            ("SECTION", _) => self.open(record),
            ("ENDSEC", _) => self.close(&record.start),
            ("LAYER", Section::Tables) => self.add_layer(record),
            ("BLOCK", Section::Blocks) => self.open_block(record),
            ("ENDBLK", Section::Blocks) => self.close_block(&record.start),
            (name, Section::Outside) => {
                self.notes.add(
                    record.at,
                    format_args!("{name} outside of a section is read as an entity"),
                );
                self.open_entities(record);
            }
            _ => {}
        }
    }

    fn open(&mut self, record: &Record<'a>) {
        if self.section != Section::Outside {
            self.notes
                .add(record.at, "the section before has no ENDSEC");
            self.close(&record.start);
        }
        self.has_section = true;
        self.section = Section::Passed;
        match record.text(2).unwrap_or_default() {
            b"HEADER" => self.read_header(record),
            b"TABLES" => self.section = Section::Tables,
            b"BLOCKS" => self.section = Section::Blocks,
            b"ENTITIES" => self.open_entities(record),
            b"CLASSES" | b"OBJECTS" | b"THUMBNAILIMAGE" | b"ACDSDATA" => {}
            name => {
                let name = name.escape_ascii();
                self.notes.add(
                    record.at,
                    format_args!("SECTION skipped: its name \"{name}\" is unknown"),
                );
            }
        }
    }

    fn open_entities(&mut self, record: &Record<'a>) {
        self.section = Section::Entities;
        self.entities = Some(record.start.clone());
    }

    fn close(&mut self, end: &Groups<'a>) {
        if let Some(block) = &self.block {
            let name = &block.name;
            self.notes
                .add(block.at, format_args!("BLOCK {name} has no ENDBLK"));
        }
        self.close_block(end);
        let entities = self.entities.take();
        self.found
            .entities
            .extend(entities.map(|start| start.until(end)));
        self.section = Section::Outside;
    }

    fn read_header(&mut self, record: &Record<'a>) {
        let mut variable: &[u8] = b"";
        let (mut version, mut page): (&[u8], &[u8]) = (b"", b"");
        for group in record.groups() {
            match (group.code, variable) {
                (9, _) => variable = group.value.text(),
                (1, b"$ACADVER") => version = group.value.text(),
                (3, b"$DWGCODEPAGE") => page = group.value.text(),
                (70, b"$INSUNITS") => self.read_unit(group),
                _ => {}
            }
        }
        let is_utf_8 =
            record.start.counts_lines() && std::str::from_utf8(record.start.bytes()).is_ok();
        let (decoder, remark) = Decoder::new(version, page, is_utf_8);
        self.found.decoder = decoder;
        if let Some(remark) = remark {
            self.notes.add(record.at, remark);
        }
    }

    fn read_unit(&mut self, group: Group<'a>) {
        let number = group.value.integer();
        self.found.unit = number.and_then(millimetres);
        if self.found.unit.is_none() && number != Some(0) {
            let value = group.value.quoted();
            self.notes
                .add(group.at, format_args!("$INSUNITS {value} is no unit"));
        }
    }

    fn add_layer(&mut self, record: &Record<'a>) {
        let name = self
            .found
            .decoder
            .decode(record.text(2).unwrap_or_default());
        if let Err(trouble) = self.found.layers.add(name, record) {
            self.notes.skip(record.name, &trouble);
        }
    }

    fn open_block(&mut self, record: &Record<'a>) {
        if let Some(block) = &self.block {
            let name = &block.name;
            self.notes.add(
                record.at,
                format_args!("BLOCK {name} has no ENDBLK before this BLOCK"),
            );
            self.close_block(&record.start);
        }
        let name = self
            .found
            .decoder
            .decode(record.text(2).unwrap_or_default());
        let base = record.point(10).unwrap_or_else(|trouble| {
            let reason = trouble.reason;
            self.notes.add(
                trouble.at,
                format_args!("BLOCK {name} is based at 0: {reason}"),
            );
            None
        });
        let flags = record.integer(70).unwrap_or(0);
        self.block = Some(Block {
            layout: layout(&name),
            name,
            base: base.unwrap_or_default(),
            is_external: flags & EXTERNAL != 0,
            entities: record.start.clone(),
            at: record.at,
        });
    }

    fn close_block(&mut self, end: &Groups<'a>) {
        let Some(mut block) = self.block.take() else {
            return;
        };
        block.entities = block.entities.until(end);
        let number = self.found.blocks.len();
        let names = &mut self.found.names;
        let first = *names.entry(block.name.to_lowercase()).or_insert(number);
        if first != number {
            let name = &block.name;
            self.notes.add(
                block.at,
                format_args!("BLOCK {name} skipped: it is there already"),
            );
            return;
        }
        self.found.blocks.push(block);
    }
}

fn layout(name: &str) -> Option<Space> {
    let name = name.to_ascii_lowercase();
    let starts = |text: &str| name.starts_with(text);
    if starts("*paper_space") || starts("$paper_space") {
        return Some(Space::Paper);
    }
    (starts("*model_space") || starts("$model_space")).then_some(Space::Model)
}
