//! The objects of classes, in tables and within each other.

use super::chunks::{Archive, CLASS, CLASS_DATA, CLASS_END, CLASS_ID, Chunk, Chunks};
use super::classes::Class;
use super::cursor::Cursor;

/// An object, not read yet.
#[derive(Clone, Copy)]
pub(super) struct Object<'a> {
    pub(super) class: Class,
    pub(super) data: Cursor<'a>,
    /// Whether the checksum of the data is wrong, if the class nests nothing.
    pub(super) damaged: bool,
}

/// Read the class and find the data of the object in a chunk of code [`CLASS`].
pub(super) fn object<'a>(chunk: &Chunk<'a>, archive: Archive) -> Result<Object<'a>, String> {
    if chunk.code != CLASS {
        return Err("it is no object".to_owned());
    }
    let mut class = None;
    for part in Chunks::new(chunk.body, archive) {
        match part.code {
            CLASS_ID => class = Some(Class::of(part.body.clone().id()?)),
            CLASS_DATA => {
                let class = class.ok_or_else(|| "it has no class".to_owned())?;
                return data(class, &part);
            }
            CLASS_END => break,
            _ => {}
        }
    }
    match class {
        // Some objects consist of nothing but their class.
        Some(class) if !chunk.cut => Ok(Object {
            class,
            data: Cursor::new(&[], chunk.at),
            damaged: false,
        }),
        _ => Err("it has no data".to_owned()),
    }
}

fn data<'a>(class: Class, part: &Chunk<'a>) -> Result<Object<'a>, String> {
    if part.cut {
        return Err(format!("{}: the file ends within it", class.name()));
    }
    Ok(Object {
        class,
        data: part.body,
        damaged: class.is_plain() && part.damaged(),
    })
}
