//! The entities of a span of the file, before they are placed.

use std::iter::{Flatten, Peekable};

use glam::{DMat3, DVec3};

use super::axes::axes;
use super::colours::{Paint, paint};
use super::entities::curve;
use super::groups::{Groups, Trouble};
use super::notes::Notes;
use super::polylines::{Corner, heavy, is_mesh, vertex};
use super::records::{Record, Records};
use super::sections::Sections;
use crate::io::exchange::drawing::{Affine, Kind, Shape};
use crate::io::exchange::short_names::short;

/// What is no entity of its own.
const MARKS: [&str; 8] = [
    "SECTION", "SEQEND", "ENDSEC", "BLOCK", "ENDBLK", "TABLE", "ENDTAB", "EOF",
];

/// An entity.
#[derive(Clone, Debug)]
pub struct Part {
    /// What it draws.
    pub content: Content,
    /// The name of its layer, as the entity spells it.
    pub layer: String,
    /// Its colour.
    pub paint: Paint,
    /// Whether it is marked as of paper space.
    pub is_paper: bool,
    /// Whether the file marks it as invisible.
    pub is_invisible: bool,
    /// Its line or byte, from 1.
    pub at: u64,
}

/// What an entity draws.
#[derive(Clone, Debug)]
pub enum Content {
    /// A curve or point.
    Curve(Kind, Vec<Shape>),
    /// A block.
    Insert(Box<Insert>),
    /// Something else, by its name.
    Other(String),
}

/// A block, drawn once or in rows and columns.
#[derive(Clone, Debug)]
pub struct Insert {
    /// The number of the block.
    pub block: usize,
    /// The placement of the first one.
    pub place: Affine,
    /// How many columns there are, and the step from one to the next.
    pub columns: (u64, DVec3),
    /// The same of the rows.
    pub rows: (u64, DVec3),
}

/// The entities from a cursor on.
pub struct Parts<'a, 's> {
    records: Peekable<Flatten<Records<'a>>>,
    sections: &'s Sections<'a>,
}

impl<'a, 's> Parts<'a, 's> {
    /// Start at a cursor.
    pub fn new(groups: &Groups<'a>, sections: &'s Sections<'a>) -> Self {
        Self {
            records: Records::new(groups.clone()).flatten().peekable(),
            sections,
        }
    }

    /// Read the next entity. What is damaged is skipped with a remark.
    pub fn next(&mut self, notes: &mut Notes) -> Option<Part> {
        loop {
            let record = self.records.next()?;
            if MARKS.contains(&record.name) {
                continue;
            }
            match self.part(&record, notes) {
                Ok(part) => return Some(part),
                Err(trouble) => notes.skip(record.name, &trouble),
            }
        }
    }

    fn part(&mut self, record: &Record<'a>, notes: &mut Notes) -> Result<Part, Trouble> {
        let content = self.content(record, notes)?;
        let decoder = &self.sections.decoder;
        let layer = record.text(8).filter(|name| !name.is_empty());
        Ok(Part {
            content,
            layer: decoder.decode(layer.unwrap_or(b"0")),
            paint: paint(record)?,
            is_paper: record.integer(67)? == 1,
            is_invisible: record.integer(60)? == 1,
            at: record.at,
        })
    }

    fn content(&mut self, record: &Record<'a>, notes: &mut Notes) -> Result<Content, Trouble> {
        if record.name == "POLYLINE" {
            let corners = self.corners(record, notes);
            if is_mesh(record)? {
                return Ok(Content::Other("POLYLINE mesh".to_owned()));
            }
            return Ok(Content::Curve(Kind::Polyline, heavy(record, corners?)?));
        }
        if record.name == "INSERT" {
            return self.insert(record, notes);
        }
        let curve = curve(record, notes)?;
        let other = || Content::Other(short(record.name));
        Ok(curve.map_or_else(other, |(kind, shapes)| Content::Curve(kind, shapes)))
    }

    /// Read the vertices up to the end of a POLYLINE, also after a damaged one.
    fn corners(&mut self, record: &Record<'a>, notes: &mut Notes) -> Result<Vec<Corner>, Trouble> {
        let mut corners = Ok(Vec::new());
        while let Some(record) = self.records.next_if(|record| record.name == "VERTEX") {
            let Ok(found) = &mut corners else {
                continue;
            };
            match vertex(&record) {
                Ok(corner) => found.extend(corner),
                Err(trouble) => corners = Err(trouble),
            }
        }
        if self
            .records
            .next_if(|record| record.name == "SEQEND")
            .is_none()
        {
            notes.add(
                record.at,
                "POLYLINE has no SEQEND; it ends at its last VERTEX",
            );
        }
        corners
    }

    fn insert(&self, record: &Record<'a>, notes: &mut Notes) -> Result<Content, Trouble> {
        let name = self
            .sections
            .decoder
            .decode(record.text(2).unwrap_or_default());
        let number = self.sections.block(&name);
        let found = number.and_then(|number| Some((number, self.sections.blocks.get(number)?)));
        let reason = match found {
            Some((_, block)) if block.is_external => "stands in another file",
            Some((number, block)) => {
                return insert(record, number, block.base);
            }
            None => "is not in the file",
        };
        notes.add(
            record.at,
            format_args!("INSERT skipped: block {name} {reason}"),
        );
        Ok(Content::Other("INSERT".to_owned()))
    }
}

fn insert(record: &Record<'_>, block: usize, base: DVec3) -> Result<Content, Trouble> {
    let scale = |code| Ok(record.real(code)?.unwrap_or(1.0));
    let scale = DVec3::new(scale(41)?, scale(42)?, scale(43)?);
    if scale.x == 0.0 || scale.y == 0.0 {
        return Err(record.trouble("its scale is 0"));
    }
    let axes = axes(record)?;
    let turned = axes.of(&Affine {
        linear: rotation(record.real(50)?.unwrap_or(0.0)),
        origin: record.required_point(10)?,
    });
    let scaled = DMat3::from_diagonal(scale);
    let place = turned.of(&Affine {
        linear: scaled,
        origin: -(scaled * base),
    });
    let count = |code| Ok(u64::try_from(record.integer(code)?).unwrap_or(1).max(1));
    let step = |code| Ok(record.real(code)?.unwrap_or(0.0));
    let insert = Insert {
        block,
        place,
        columns: (count(70)?, turned.vector(DVec3::X * step(44)?)),
        rows: (count(71)?, turned.vector(DVec3::Y * step(45)?)),
    };
    Ok(Content::Insert(Box::new(insert)))
}

/// Turn around z. Quarter turns are exact, which `to_radians` cannot be.
fn rotation(degrees: f64) -> DMat3 {
    let degrees = degrees.rem_euclid(360.0);
    let (sine, cosine) = if degrees == 90.0 {
        (1.0, 0.0)
    } else if degrees == 180.0 {
        (0.0, -1.0)
    } else if degrees == 270.0 {
        (-1.0, 0.0)
    } else {
        degrees.to_radians().sin_cos()
    };
    DMat3::from_cols(
        DVec3::new(cosine, sine, 0.0),
        DVec3::new(-sine, cosine, 0.0),
        DVec3::Z,
    )
}
