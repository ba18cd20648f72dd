//! Instance definitions (blocks) and references to them.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::chunks::{ANONYMOUS, Archive, CLASS, COMPONENT, Chunk, Chunks};
use super::classes::printed;
use super::cursor::Cursor;
use super::objects::object;
use crate::io::exchange::drawing::Affine;

/// A block: objects that are drawn where references place them.
pub(super) struct Definition {
    pub(super) id: u128,
    pub(super) name: Arc<str>,
    pub(super) members: Vec<u128>,
}

/// A place where a block is drawn.
pub(super) struct Reference {
    pub(super) definition: u128,
    pub(super) place: Affine,
}

/// Read a definition from its record.
pub(super) fn definition(record: &Chunk, archive: Archive) -> Result<Definition, String> {
    let chunk = Chunks::new(record.body, archive).find(|chunk| chunk.code == CLASS);
    let chunk = chunk.ok_or_else(|| "it has no data".to_owned())?;
    let mut data = object(&chunk, archive)?.data;
    let newer = data.clone().word().is_ok_and(|code| code == ANONYMOUS);
    let mut definition = if newer {
        new(data, archive)?
    } else {
        old(&mut data)?
    };
    if definition.name.is_empty() {
        definition.name = printed(definition.id).into();
    }
    Ok(definition)
}

/// The layout up to version 5.
fn old(data: &mut Cursor) -> Result<Definition, String> {
    start(data)?;
    Ok(Definition {
        id: data.id()?,
        members: data.ids()?,
        name: data.text()?.into(),
    })
}

/// The layout from version 6 on.
fn new(data: Cursor, archive: Archive) -> Result<Definition, String> {
    let mut data = inner(&mut Chunks::new(data, archive), ANONYMOUS)?;
    let mut chunks = Chunks::new(data, archive);
    let (id, name) = component(inner(&mut chunks, COMPONENT)?)?;
    data = chunks.rest();
    // How it is linked.
    data.int()?;
    let mut chunks = Chunks::new(data, archive);
    // The unit; its length is in the placements of the references already.
    inner(&mut chunks, ANONYMOUS)?;
    data = chunks.rest();
    // A description and two links.
    for _ in 0..3 {
        data.text()?;
    }
    // The bounding box.
    data.bytes(48)?;
    let members = if data.byte()? != 0 {
        data.ids()?
    } else {
        Vec::new()
    };
    Ok(Definition {
        id,
        name: name.into(),
        members,
    })
}

/// The id and the name in a chunk of attributes that many classes share, each if it is given.
fn component(mut data: Cursor) -> Result<(u128, String), String> {
    let (mut id, mut name) = (0, String::new());
    if data.byte()? == 1 {
        data.bytes(12)?;
    }
    if data.byte()? == 1 {
        id = data.id()?;
    }
    for _ in ["type", "index"] {
        if data.byte()? == 1 {
            data.bytes(4)?;
        }
    }
    if data.byte()? == 1 {
        name = data.text()?;
    }
    Ok((id, name))
}

/// The bytes of the next chunk after its version.
fn inner<'a>(chunks: &mut Chunks<'a>, code: u32) -> Result<Cursor<'a>, String> {
    match chunks.next() {
        Some(chunk) if chunk.code == code && !chunk.cut => {
            let mut body = chunk.body;
            match (body.int()?, body.int()?) {
                (1, _) => Ok(body),
                (major, minor) => Err(format!("its layout {major}.{minor} is not known")),
            }
        }
        _ => Err("its layout is not known".to_owned()),
    }
}

fn start(data: &mut Cursor) -> Result<(), String> {
    match data.version()? {
        (1, _) => Ok(()),
        (major, minor) => Err(format!("its layout {major}.{minor} is not known")),
    }
}

/// Read a reference from its data.
pub(super) fn reference(mut data: Cursor) -> Result<Reference, String> {
    start(&mut data)?;
    let definition = data.id()?;
    let mut rows = [[0.0; 4]; 4];
    for row in &mut rows {
        for value in row {
            *value = data.number()?;
        }
    }
    let [x, y, z, [px, py, pz, scale]] = rows;
    if [px, py, pz] != [0.0; 3] || scale == 0.0 {
        return Err("its placement has a perspective".to_owned());
    }
    let linear = DMat3::from_cols_array(&[x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]]);
    let place = Affine {
        linear: linear * scale.recip(),
        origin: DVec3::new(x[3], y[3], z[3]) / scale,
    };
    if place.linear.is_finite() && place.origin.is_finite() {
        Ok(Reference { definition, place })
    } else {
        Err("its placement has no numbers".to_owned())
    }
}
