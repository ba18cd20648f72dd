//! The walk over a file's entities.

use std::collections::HashSet;
use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::directory::{Directory, Entry};
use super::entities::{self, Content, Found, is_shape};
use super::global::Global;
use super::links::{self, Links, NESTING};
use super::names::entity_name;
use super::parameters::{Delimiters, Parameters};
use super::records::Records;
use super::spending::Spending;
use super::spline_part::is_finite;
use crate::geometry::counted;
use crate::io::exchange::drawing::{Affine, Drawing, Item, Kind, Shape, Space, Unreadable};

/// The use flag of curves in the parameter plane of a surface.
const IN_PARAMETERS: u8 = 5;

/// Remarks kept: a damaged file would otherwise give one for each of its entities.
const REMARKS: usize = 1000;

/// Read an IGES file in fixed ASCII.
///
/// # Errors
/// [`Unreadable`] for binary and compressed files, and where there is no directory.
pub fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    let mut records = Records::read(bytes)?;
    let global = Global::read(std::mem::take(&mut records.global));
    let directory = Directory::read(&records);
    let mut links = Links::read(&records, global.delimiters, &directory);
    let faults = std::mem::take(&mut links.faults);
    let mut reader = Reader {
        records: &records,
        directory: &directory,
        links: &links,
        delimiters: global.delimiters,
        drawing: Drawing {
            unit: global.unit,
            ..Drawing::of_file(bytes.len())
        },
        spending: Spending::of_file(bytes.len()),
        drawn: HashSet::new(),
        open: Vec::new(),
        hidden: 0,
        flat: 0,
        untold: 0,
    };
    let remarks = records
        .remarks
        .iter()
        .chain(&global.remarks)
        .chain(&directory.remarks);
    reader.drawing.remarks.extend(remarks.cloned());
    for (line, entity, reason) in faults {
        reader.remark(line, entity, &reason);
    }
    reader.draw_all();
    Ok(reader.finish())
}

struct Reader<'a> {
    records: &'a Records<'a>,
    directory: &'a Directory,
    links: &'a Links,
    delimiters: Delimiters,
    drawing: Drawing,
    spending: Spending,
    /// The parts of composite curves and subfigures that were drawn.
    drawn: HashSet<u32>,
    /// The composite curves and subfigures around the current entity.
    open: Vec<u32>,
    /// How many items are hidden.
    hidden: usize,
    /// How many curves lie in the parameter plane of a surface.
    flat: usize,
    /// How many remarks were left out.
    untold: usize,
}

/// What an inserted subfigure hands to its parts.
#[derive(Default)]
struct Context {
    place: Affine,
    /// The instance's own space; without an instance, each entity has its own.
    space: Option<Space>,
    group: Arc<[String]>,
    block: Option<Arc<str>>,
}

impl<'a> Reader<'a> {
    fn draw_all(&mut self) {
        let directory = self.directory;
        let context = Context::default();
        for entry in &directory.entries {
            if !self.links.is_part(entry.number) {
                self.draw(entry, &context);
            }
            if self.spending.is_over() {
                let what = self.spending.reason();
                self.remark(
                    entry.line,
                    entry.entity,
                    &format!("{what}; the rest is left out"),
                );
                break;
            }
        }
    }

    fn draw(&mut self, entry: &Entry, context: &Context) {
        if self.spending.is_over() {
            return;
        }
        let result = match (entry.entity, entry.form) {
            // Null entities, and what others refer to.
            (0 | 124 | 308 | 314 | 406, _) | (402, 1 | 7 | 14 | 15) => Ok(()),
            (102, _) => self.draw_composite(entry, context),
            (408, _) => self.draw_instance(entry, context),
            (entity, form) if is_shape(entity, form) => self.draw_shape(entry, context),
            (entity, form) => {
                self.drawing
                    .count_other(&entity_name(entity, form), entry.line);
                Ok(())
            }
        };
        if let Err(reason) = result {
            self.remark(entry.line, entry.entity, &format!("{reason}; skipped"));
        }
    }

    fn draw_shape(&mut self, entry: &Entry, context: &Context) -> Result<(), String> {
        let place = context.place.of(&self.links.place(entry)?);
        let (found, from) = self.shapes(entry)?;
        let properties = from.properties(found.used);
        let points = match found.content {
            Content::One(shape) => {
                let shape = placed(shape, &place)?;
                self.spending.keep_shape(&shape);
                self.add(entry, context, &properties, found.kind, vec![shape]);
                return Ok(());
            }
            Content::Points(points) => points,
        };
        for point in points {
            let shape = placed(Shape::Point(point), &place)?;
            self.spending.keep_shape(&shape);
            self.add(entry, context, &properties, found.kind, vec![shape]);
            if self.spending.is_over() {
                break;
            }
        }
        Ok(())
    }

    fn draw_composite(&mut self, entry: &Entry, context: &Context) -> Result<(), String> {
        let mut pieces = Vec::new();
        self.collect(entry, &context.place, &mut pieces)?;
        if pieces.is_empty() {
            return Err("none of its curves can be read".to_owned());
        }
        let from = self.parameters(entry)?;
        let properties = from.properties(from.count(1)?.saturating_add(2));
        self.add(entry, context, &properties, Kind::Polycurve, pieces);
        Ok(())
    }

    /// Collect the pieces of a composite curve and of those within it.
    fn collect(
        &mut self,
        entry: &Entry,
        outer: &Affine,
        pieces: &mut Vec<Shape>,
    ) -> Result<(), String> {
        let place = outer.of(&self.links.place(entry)?);
        let parts = self.parameters(entry)?.pointers(1)?;
        self.enter(entry)?;
        for part in parts {
            if self.spending.is_over() {
                break;
            }
            if let Err(reason) = self.collect_part(part, &place, pieces) {
                self.remark(
                    entry.line,
                    entry.entity,
                    &format!("its curve D{part}: {reason}; skipped"),
                );
            }
        }
        self.open.pop();
        Ok(())
    }

    fn collect_part(
        &mut self,
        part: u32,
        place: &Affine,
        pieces: &mut Vec<Shape>,
    ) -> Result<(), String> {
        let entry = self.find(part)?;
        if entry.entity == 102 {
            return self.collect(entry, place, pieces);
        }
        if !is_shape(entry.entity, entry.form) {
            return Err(format!(
                "{} is not read",
                entity_name(entry.entity, entry.form)
            ));
        }
        let place = place.of(&self.links.place(entry)?);
        match self.shapes(entry)?.0.content {
            Content::One(shape) => {
                self.spending.keep_shape(&shape);
                pieces.push(placed(shape, &place)?);
            }
            Content::Points(_) => return Err("a point set is no piece of a curve".to_owned()),
        }
        Ok(())
    }

    /// Insert a subfigure: scaled by S, turned, and moved by X, Y, Z.
    fn draw_instance(&mut self, entry: &Entry, context: &Context) -> Result<(), String> {
        let links = self.links;
        let from = self.parameters(entry)?;
        let number = from.pointer(1).ok_or("no subfigure")?;
        let subfigure = links
            .subfigures
            .get(&number)
            .ok_or_else(|| format!("its subfigure D{number} cannot be read"))?;
        let definition = self.find(number)?;
        let scale = from
            .number(5)
            .ok()
            .filter(|scale| *scale != 0.0)
            .unwrap_or(1.0);
        // X, Y, Z are those of the space around: they move what is scaled and then turned.
        let moved = Affine {
            linear: DMat3::IDENTITY,
            origin: from.point(2)?,
        };
        let scaled = Affine {
            linear: DMat3::from_diagonal(DVec3::splat(scale)),
            origin: DVec3::ZERO,
        };
        let place = context
            .place
            .of(&moved)
            .of(&links.place(entry)?)
            .of(&scaled);
        let inner = Context {
            place: place.of(&links.place(definition)?),
            space: Some(self.space(entry, context)),
            group: self.group(entry, context),
            block: Some(
                context
                    .block
                    .clone()
                    .unwrap_or_else(|| subfigure.name.as_str().into()),
            ),
        };
        self.enter(definition)?;
        for part in &subfigure.parts {
            if self.spending.is_over() {
                break;
            }
            self.spending.work(1);
            match self.find(*part) {
                Ok(part) => self.draw(part, &inner),
                Err(reason) => self.remark(definition.line, 308, &format!("{reason}; skipped")),
            }
        }
        self.open.pop();
        Ok(())
    }

    /// Begin the parts of an entity.
    fn enter(&mut self, entry: &Entry) -> Result<(), String> {
        if self.open.contains(&entry.number) {
            return Err("it is a part of itself".to_owned());
        }
        if self.open.len() >= NESTING {
            return Err(format!("it nests more than {NESTING} deep"));
        }
        self.open.push(entry.number);
        Ok(())
    }

    /// Find a part.
    fn find(&mut self, number: u32) -> Result<&'a Entry, String> {
        self.drawn.insert(number);
        self.directory
            .find(number)
            .ok_or_else(|| format!("entry D{number} is missing"))
    }

    fn parameters(&mut self, entry: &Entry) -> Result<Parameters, String> {
        let lines = entry.parameters.end.saturating_sub(entry.parameters.start);
        self.spending
            .work(u64::from(lines).saturating_add(1).saturating_mul(64));
        let from = links::parameters(entry, self.records, self.delimiters)?;
        if !from.is_complete() {
            self.remark(entry.line, entry.entity, "its parameters are cut off");
        }
        Ok(from)
    }

    fn shapes(&mut self, entry: &Entry) -> Result<(Found, Parameters), String> {
        let from = self.parameters(entry)?;
        let mut found = entities::read(entry.entity, entry.form, &from)?;
        if let Some(remark) = found.remark.take() {
            self.remark(entry.line, entry.entity, &remark);
        }
        Ok((found, from))
    }

    fn add(
        &mut self,
        entry: &Entry,
        context: &Context,
        properties: &[u32],
        kind: Kind,
        shapes: Vec<Shape>,
    ) {
        // Such curves have two coordinates, which are no lengths.
        if entry.usage == IN_PARAMETERS {
            self.flat = self.flat.saturating_add(1);
            return;
        }
        let space = self.space(entry, context);
        // Surfaces show their boundaries, whatever their own status is.
        let hidden = entry.is_hidden && space != Space::Edge;
        let item = Item {
            kind,
            shapes,
            group: self.group(entry, context),
            name: self.links.name(entry, properties),
            block: context.block.clone(),
            colour: self.links.colour(entry),
            hidden,
            space,
            at: entry.line,
        };
        if self.spending.keep(&item, self.drawing.items.last()) {
            self.hidden = self.hidden.saturating_add(usize::from(hidden));
            self.drawing.items.push(item);
        }
    }

    fn group(&self, entry: &Entry, context: &Context) -> Arc<[String]> {
        let own = self.links.group(entry);
        if own.is_empty() {
            Arc::clone(&context.group)
        } else {
            self.drawing.path(&own)
        }
    }

    /// Curves of their own are independent, or depend on free groups alone, and are used as geometry.
    fn space(&self, entry: &Entry, context: &Context) -> Space {
        if let Some(space) = context.space {
            return space;
        }
        let is_free = match entry.subordinate {
            0 => true,
            2 => self.links.is_group_member(entry),
            _ => false,
        };
        if is_free && entry.usage == 0 {
            Space::Model
        } else {
            Space::Edge
        }
    }

    fn remark(&mut self, line: u64, entity: u32, reason: &str) {
        if self.drawing.remarks.len() < REMARKS {
            self.drawing
                .remarks
                .push(format!("line {line}: type {entity}: {reason}"));
        } else {
            self.untold = self.untold.saturating_add(1);
        }
    }

    /// Tell which subfigures and composite curves were drawn nowhere.
    fn tell_undrawn(&mut self) {
        for entry in &self.directory.entries {
            if self.drawn.contains(&entry.number) {
                continue;
            }
            if let Some(subfigure) = self.links.subfigures.get(&entry.number) {
                let (name, count) = (&subfigure.name, subfigure.parts.len());
                let reason = format!(
                    "subfigure \"{name}\" is never inserted; its {count} entities are left out"
                );
                self.remark(entry.line, entry.entity, &reason);
            } else if entry.entity == 102 && self.links.is_own_part(entry.number) {
                self.remark(entry.line, entry.entity, "it is a part of itself; skipped");
            }
        }
    }

    fn finish(mut self) -> Drawing {
        let mut remarks = Vec::new();
        if self.hidden > 0 {
            let told = counted(self.hidden, "item is hidden", "items are hidden");
            remarks.push(format!("{told} (blank status 01)"));
        }
        if self.flat > 0 {
            let told = counted(self.flat, "curve lies", "curves lie");
            remarks.push(format!(
                "{told} in the parameter plane of a surface (use flag 05) and are left out"
            ));
        }
        if !self.spending.is_over() {
            self.tell_undrawn();
        }
        if self.untold > 0 {
            remarks.push(format!("{} more remarks", self.untold));
        }
        self.drawing.remarks.extend(remarks);
        self.drawing
    }
}

/// Place a shape.
fn placed(shape: Shape, place: &Affine) -> Result<Shape, String> {
    let shape = shape.placed(place);
    if is_finite(&shape) {
        Ok(shape)
    } else {
        Err("its numbers are too large".to_owned())
    }
}
