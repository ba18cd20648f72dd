//! The attributes of objects: id, name, layer, colour and where they are seen.

use super::chunks::{Archive, Chunks};
use super::cursor::Cursor;

/// What is not shown.
const HIDDEN: u8 = 1;
/// What is part of an instance definition.
const MEMBER: u8 = 3;

/// Where the colour of an object comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Source {
    #[default]
    Layer,
    Object,
    Material,
    Parent,
}

/// The attributes of an object.
#[derive(Clone, Debug, Default)]
pub(super) struct Attributes {
    pub(super) id: u128,
    pub(super) layer: i32,
    pub(super) name: String,
    pub(super) colour: Option<[u8; 3]>,
    pub(super) source: Source,
    pub(super) hidden: bool,
    /// Whether it is part of an instance definition.
    pub(super) member: bool,
    /// Whether it is on a layout.
    pub(super) paper: bool,
}

impl Attributes {
    /// Read the attributes; those before damage are kept.
    pub(super) fn read(&mut self, mut data: Cursor, archive: Archive) -> Result<(), String> {
        match data.version()? {
            (1, minor) => self.old(&mut data, minor),
            (2, _) => self.items(&mut data, archive),
            (major, minor) => Err(format!("their layout {major}.{minor} is not known")),
        }
    }

    /// The layout up to version 4: every attribute, in order.
    fn old(&mut self, data: &mut Cursor, minor: u8) -> Result<(), String> {
        self.id = data.id()?;
        self.layer = data.int()?;
        data.int()?;
        self.colour = data.colour()?;
        // The line style and the wire density.
        data.bytes(20 + 4)?;
        self.mode(data.byte()?);
        self.source = source(data.byte()?);
        // The sources of the line type and the material.
        data.bytes(2)?;
        self.name = data.text()?;
        data.text()?;
        if minor >= 1 {
            let groups = data.count(4)?;
            data.bytes(groups.saturating_mul(4))?;
        }
        if minor >= 2 {
            self.hidden |= data.byte()? == 0;
        }
        if minor >= 3 {
            display_materials(data)?;
        }
        if minor >= 6 {
            // Arrows, the colour and the width of plots with their sources, the line type.
            data.bytes(4 + 1 + 4 + 1 + 8 + 4)?;
            self.paper = data.byte()? == 1;
        }
        Ok(())
    }

    /// The layout from version 5 on: those that are not as usual, each after its number, rising.
    fn items(&mut self, data: &mut Cursor, archive: Archive) -> Result<(), String> {
        self.id = data.id()?;
        self.layer = data.int()?;
        loop {
            match data.byte()? {
                1 => self.name = data.text()?,
                2 => drop(data.text()?),
                5 => skip_chunk(data, archive)?,
                6 => self.colour = data.colour()?,
                3 | 4 | 7 | 10 => drop(data.int()?),
                8 => drop(data.number()?),
                9 | 14..=17 => drop(data.byte()?),
                11 => self.hidden |= data.byte()? == 0,
                12 => self.mode(data.byte()?),
                13 => self.source = source(data.byte()?),
                18 => {
                    let groups = data.count(4)?;
                    data.bytes(groups.saturating_mul(4))?;
                }
                19 => {
                    self.paper = data.byte()? == 1;
                    return Ok(());
                }
                // The end, or what comes after the last that is used.
                _ => return Ok(()),
            }
        }
    }

    fn mode(&mut self, mode: u8) {
        self.hidden |= mode & 15 == HIDDEN;
        self.member = mode & 15 == MEMBER;
    }
}

fn source(byte: u8) -> Source {
    match byte {
        1 => Source::Object,
        2 => Source::Material,
        3 => Source::Parent,
        _ => Source::Layer,
    }
}

fn display_materials(data: &mut Cursor) -> Result<(), String> {
    let count = data.count(32)?;
    data.bytes(count.saturating_mul(32)).map(drop)
}

fn skip_chunk(data: &mut Cursor, archive: Archive) -> Result<(), String> {
    let mut chunks = Chunks::new(*data, archive);
    match chunks.next() {
        Some(chunk) if !chunk.cut => {
            *data = chunks.rest();
            Ok(())
        }
        _ => Err("the render attributes are cut short".to_owned()),
    }
}
