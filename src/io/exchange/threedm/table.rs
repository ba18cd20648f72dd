//! The tables of a file.

use super::attributes::Attributes;
use super::chunks::{
    Archive, CLASS, Chunk, Chunks, DEFINITION, DEFINITIONS, END_OF_FILE, END_OF_TABLE, LAYERS,
    LIGHT, LIGHTS, OBJECT, OBJECT_ATTRIBUTES, OBJECT_END, OBJECTS, PROPERTIES, SETTINGS, place,
};
use super::cursor::Cursor;
use super::instances::definition;
use super::layers::Layers;
use super::objects::object;
use super::properties::{self, HEADER};
use super::scene::{Record, Report, Scene};
use crate::io::exchange::drawing::Unreadable;

/// The latest version of which the layout is known.
const LATEST: u32 = 80;

/// Read the tables of a file.
pub(super) fn scene(bytes: &[u8]) -> Result<Scene<'_>, Unreadable> {
    let archive = properties::archive(bytes)?;
    let mut scene = Scene {
        archive,
        layers: Layers::default(),
        definitions: Vec::new(),
        records: Vec::new(),
        report: Report::new(bytes.len()),
    };
    let tables = tables(bytes, archive, &mut scene.report);
    if tables.is_empty() {
        return Err(Unreadable {
            at: Some(place(HEADER)),
            reason: "This 3DM file has no tables; save it again".to_owned(),
        });
    }
    if archive.version > LATEST {
        let version = archive.version / 10;
        scene
            .report
            .remark(format!("Version {version} is read as if it were version 8"));
    }
    for table in tables.iter().filter(|table| table.code == PROPERTIES) {
        scene.archive.opennurbs = properties::opennurbs(table, archive);
    }
    for table in &tables {
        scene.table(table);
    }
    Ok(scene)
}

/// The tables, in the order of the file.
fn tables<'a>(bytes: &'a [u8], archive: Archive, report: &mut Report) -> Vec<Chunk<'a>> {
    let mut whole = Cursor::new(bytes, 0);
    // The header was read before.
    drop(whole.bytes(HEADER));
    let mut chunks = Chunks::new(whole, archive);
    let mut tables: Vec<Chunk> = Vec::new();
    let mut ended = false;
    while !ended {
        let fault = match chunks.next() {
            Some(end) if end.code == END_OF_FILE => {
                ended = true;
                continue;
            }
            Some(table) if table.is_table() => {
                tables.push(table);
                if !table.cut {
                    continue;
                }
                report.remark(format!(
                    "byte {}: the file ends within a table",
                    table.place()
                ));
                table.at
            }
            other => {
                let Some(fault) = other.map(|it| it.at).or(chunks.fault) else {
                    break;
                };
                report.remark(format!("byte {}: the file is damaged here", place(fault)));
                fault
            }
        };
        let seen = tables.iter().any(|table| table.code == OBJECTS);
        if seen || !chunks.resume(whole, fault, OBJECTS) {
            break;
        }
    }
    if !ended {
        report.remark("The file has no end mark; it may be cut short".to_owned());
    }
    tables
}

impl<'a> Scene<'a> {
    fn table(&mut self, table: &Chunk<'a>) {
        match table.code {
            SETTINGS => match properties::unit(table, self.archive) {
                Ok(unit) => self.report.drawing.unit = unit,
                Err(reason) => {
                    let place = table.place();
                    self.report
                        .remark(format!("byte {place}: the unit cannot be read: {reason}"));
                }
            },
            LAYERS => {
                let report = &mut self.report;
                self.layers
                    .read(table, self.archive, &mut |remark| report.remark(remark));
            }
            LIGHTS => {
                let lights =
                    Chunks::new(table.body, self.archive).filter(|chunk| chunk.code == LIGHT);
                lights.for_each(|light| self.report.drawing.count_other("Light", light.place()));
            }
            DEFINITIONS => self.definitions(table),
            OBJECTS => self.objects(table),
            _ => {}
        }
    }

    fn definitions(&mut self, table: &Chunk<'a>) {
        for record in Chunks::new(table.body, self.archive).filter(|chunk| chunk.code == DEFINITION)
        {
            match definition(&record, self.archive) {
                Ok(definition) => self.definitions.push(definition),
                Err(reason) => {
                    let place = record.place();
                    self.report
                        .remark(format!("byte {place}: InstanceDefinition: {reason}"));
                }
            }
        }
    }

    /// Read the objects; after damage go on at the next one.
    fn objects(&mut self, table: &Chunk<'a>) {
        let mut chunks = Chunks::new(table.body, self.archive);
        loop {
            let fault = match chunks.next() {
                Some(record) if record.code == OBJECT && !record.cut => {
                    self.object(&record);
                    continue;
                }
                Some(end) if end.code == END_OF_TABLE => return,
                Some(cut) if cut.code == OBJECT => {
                    // It may be whole even so, if its length alone is wrong.
                    self.object(&cut);
                    cut.at
                }
                Some(other) => other.at,
                None => match chunks.fault {
                    Some(fault) => fault,
                    None => return,
                },
            };
            let place = place(fault);
            self.report.remark(format!(
                "byte {place}: the table of objects is damaged or ends here"
            ));
            if !chunks.resume(table.body, fault, OBJECT) {
                return;
            }
        }
    }

    fn object(&mut self, record: &Chunk<'a>) {
        let place = record.place();
        let mut found = None;
        let mut attributes = Attributes::default();
        for part in Chunks::new(record.body, self.archive) {
            match part.code {
                CLASS => found = Some(object(&part, self.archive)),
                OBJECT_ATTRIBUTES => {
                    if let Err(reason) = attributes.read(part.body, self.archive) {
                        self.report
                            .remark(format!("byte {place}: attributes: {reason}"));
                    }
                }
                OBJECT_END => break,
                _ => {}
            }
        }
        match found {
            Some(Ok(object)) => {
                if object.damaged {
                    let class = object.class.name();
                    self.report.remark(format!(
                        "byte {place}: {class}: its checksum is wrong, so its numbers may be wrong too"
                    ));
                }
                self.records.push(Record {
                    at: record.at,
                    object,
                    attributes,
                });
            }
            Some(Err(reason)) => self
                .report
                .remark(format!("byte {place}: object: {reason}")),
            None => self
                .report
                .remark(format!("byte {place}: object: it has no data")),
        }
    }
}
