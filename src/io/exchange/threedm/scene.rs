//! From objects and references to the items of a drawing.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::attributes::{Attributes, Source};
use super::breps;
use super::chunks::{Archive, place};
use super::classes::Class;
use super::curves::{Curve, curve, usable};
use super::instances::{Definition, Reference, reference};
use super::layers::Layers;
use super::objects::Object;
use crate::geometry::counted;
use crate::io::exchange::drawing::{Affine, Drawing, Item, Kind, Shape, Space};
use crate::io::exchange::spending::most_items;

/// References within definitions.
const DEPTH: usize = 64;
/// Bytes of items, so that a small file cannot ask for endlessly many; more for larger files.
const BYTES: usize = 144 << 20;
/// Remarks; the rest are counted.
const REMARKS: usize = 500;
/// Kinds of what is not a curve; there are some forty.
const KINDS: usize = 100;

/// An object of the table with its attributes.
pub(super) struct Record<'a> {
    /// The place of the object in the file, counted from 0.
    pub(super) at: usize,
    pub(super) object: Object<'a>,
    pub(super) attributes: Attributes,
}

/// What a reference gives to the objects of its definition.
#[derive(Clone, Copy)]
struct Context<'b> {
    place: Affine,
    block: Option<&'b Arc<str>>,
    colour: Option<[u8; 3]>,
    paper: bool,
    hidden: bool,
}

/// A file with its tables read.
pub(super) struct Scene<'a> {
    pub(super) archive: Archive,
    pub(super) layers: Layers,
    pub(super) definitions: Vec<Definition>,
    pub(super) records: Vec<Record<'a>>,
    pub(super) report: Report,
}

/// The drawing in the making.
#[derive(Default)]
pub(super) struct Report {
    pub(super) drawing: Drawing,
    more_remarks: usize,
    items: usize,
    bytes: usize,
    full: bool,
    hidden: usize,
    /// The records that were drawn.
    drawn: HashSet<usize>,
    /// The records of which damage was told.
    told: HashSet<usize>,
}

impl Report {
    /// Begin a report on a file of so many bytes.
    pub(super) fn new(length: usize) -> Self {
        Self {
            drawing: Drawing::of_file(length),
            items: most_items(length),
            bytes: BYTES.max(length.saturating_mul(15)),
            ..Self::default()
        }
    }

    /// Note something.
    pub(super) fn remark(&mut self, remark: String) {
        if self.drawing.remarks.len() < REMARKS {
            self.drawing.remarks.push(remark);
        } else {
            self.more_remarks += 1;
        }
    }

    /// Count something that is not a curve. Unknown classes beyond some are counted together.
    pub(super) fn count(&mut self, class: Class, at: u64) {
        let name = class.name();
        let other = &self.drawing.other;
        let known = other.len() < KINDS || other.iter().any(|it| it.kind == name);
        self.drawing
            .count_other(if known { &name } else { "more classes" }, at);
    }

    /// Take from the budget; false if it is used up.
    fn spend(&mut self, items: usize, bytes: usize) -> bool {
        self.full |= items > self.items || bytes > self.bytes;
        if self.full {
            return false;
        }
        self.items -= items;
        self.bytes -= bytes;
        true
    }

    /// End the report on so many objects.
    fn finish(mut self, objects: usize) -> Drawing {
        let left = objects.saturating_sub(self.drawn.len());
        let remarks = &mut self.drawing.remarks;
        if self.full {
            remarks.push(
                "Its curves are too many, or take too much memory; the rest is left out".to_owned(),
            );
        } else if left > 0 {
            remarks.push(format!(
                "{left} objects are left out: they are in blocks that nothing refers to"
            ));
        }
        if self.hidden > 0 {
            remarks.push(counted(self.hidden, "item is hidden", "items are hidden"));
        }
        if self.more_remarks > 0 {
            remarks.push(format!("{} more remarks are left out", self.more_remarks));
        }
        self.drawing
    }
}

impl Scene<'_> {
    /// Make the items: free objects as they are, those of blocks once for each reference.
    pub(super) fn drawing(mut self) -> Drawing {
        let listed: HashSet<u128> = self
            .definitions
            .iter()
            .flat_map(|it| it.members.iter().copied())
            .collect();
        let walk = Walk {
            archive: self.archive,
            layers: &self.layers,
            records: &self.records,
            by_id: by_id(&self.records),
            definitions: self.definitions.iter().map(|it| (it.id, it)).collect(),
        };
        let context = Context {
            place: Affine::default(),
            block: None,
            colour: None,
            paper: false,
            hidden: false,
        };
        for (index, record) in self.records.iter().enumerate() {
            if self.report.full {
                break;
            }
            if !record.attributes.member && !listed.contains(&record.attributes.id) {
                walk.record(index, &context, &mut Vec::new(), &mut self.report);
            }
        }
        self.report.finish(self.records.len())
    }
}

fn by_id(records: &[Record]) -> HashMap<u128, usize> {
    let mut by_id = HashMap::with_capacity(records.len());
    for (index, record) in records.iter().enumerate() {
        by_id.entry(record.attributes.id).or_insert(index);
    }
    by_id
}

/// What does not change while the items are made.
struct Walk<'s, 'a> {
    archive: Archive,
    layers: &'s Layers,
    records: &'s [Record<'a>],
    by_id: HashMap<u128, usize>,
    definitions: HashMap<u128, &'s Definition>,
}

impl Walk<'_, '_> {
    fn record(&self, index: usize, context: &Context, open: &mut Vec<u128>, report: &mut Report) {
        let Some(record) = self.records.get(index) else {
            return;
        };
        report.drawn.insert(index);
        let class = record.object.class;
        let done = match class {
            Class::InstanceReference => self.refer(record, context, open, report),
            Class::Brep => {
                report.count(class, place(record.at));
                self.brep(record, context, report)
            }
            _ => self.curve(record, context, report),
        };
        if let Err(reason) = done
            && report.told.insert(index)
        {
            report.remark(remark(record, &reason));
        }
    }

    /// Make the items of a reference.
    fn refer(
        &self,
        record: &Record,
        context: &Context,
        open: &mut Vec<u128>,
        report: &mut Report,
    ) -> Result<(), String> {
        let Reference { definition, place } = reference(record.object.data)?;
        let block = self.definitions.get(&definition);
        let block = block.ok_or_else(|| "its definition is missing".to_owned())?;
        if open.contains(&definition) {
            return Err(format!("its definition {:?} contains itself", block.name));
        }
        if open.len() == DEPTH {
            return Err("its definitions are nested too deep".to_owned());
        }
        let inner = Context {
            place: context.place.of(&place),
            block: Some(&block.name),
            colour: self.colour(&record.attributes, context),
            paper: context.paper || record.attributes.paper,
            hidden: context.hidden || self.hidden(&record.attributes),
        };
        open.push(definition);
        let mut missing = 0;
        for member in &block.members {
            if !report.spend(1, 0) {
                break;
            }
            match self.by_id.get(member) {
                Some(&member) => self.record(member, &inner, open, report),
                None => missing += 1,
            }
        }
        open.pop();
        match missing {
            0 if block.members.is_empty() => Err(format!(
                "its definition {:?} is empty, or in another file",
                block.name
            )),
            0 => Ok(()),
            _ => Err(format!(
                "{missing} objects of its definition {:?} are missing",
                block.name
            )),
        }
    }

    fn brep(&self, record: &Record, context: &Context, report: &mut Report) -> Result<(), String> {
        if !report.spend(0, record.object.data.rest().len()) {
            return Ok(());
        }
        let edges = breps::edges(record.object.data, self.archive);
        let (edges, skipped) =
            edges.map_err(|reason| format!("{reason}, so its edges are left out"))?;
        for edge in edges {
            self.items(record, edge, Space::Edge, context, report)?;
        }
        match skipped.first() {
            Some(reason) => Err(format!(
                "{} of its edges are left out: {reason}",
                skipped.len()
            )),
            None => Ok(()),
        }
    }

    fn curve(&self, record: &Record, context: &Context, report: &mut Report) -> Result<(), String> {
        match curve(&record.object, self.archive)? {
            Some(curve) => {
                let paper = context.paper || record.attributes.paper;
                let space = if paper { Space::Paper } else { Space::Model };
                self.items(record, curve, space, context, report)
            }
            None => {
                report.count(record.object.class, place(record.at));
                Ok(())
            }
        }
    }

    /// Make an item of a curve, or of each point.
    fn items(
        &self,
        record: &Record,
        curve: Curve,
        space: Space,
        context: &Context,
        report: &mut Report,
    ) -> Result<(), String> {
        let Curve {
            kind, mut shapes, ..
        } = curve;
        if context.block.is_some() {
            shapes = shapes
                .into_iter()
                .map(|shape| shape.placed(&context.place))
                .collect();
            if !shapes.iter().all(usable) {
                return Err("a reference places it out of reach".to_owned());
            }
        }
        if kind != Kind::Point {
            self.item(record, kind, shapes, space, context, report);
            return Ok(());
        }
        for shape in shapes {
            self.item(record, kind, vec![shape], space, context, report);
        }
        Ok(())
    }

    fn item(
        &self,
        record: &Record,
        kind: Kind,
        shapes: Vec<Shape>,
        space: Space,
        context: &Context,
        report: &mut Report,
    ) {
        let attributes = &record.attributes;
        let items = &report.drawing.items;
        let hidden = space != Space::Edge && (context.hidden || self.hidden(attributes));
        let item = Item {
            kind,
            shapes,
            group: report.drawing.path(&self.layers.path(attributes.layer)),
            name: Some(attributes.name.clone()).filter(|name| !name.is_empty()),
            block: context.block.map(Arc::clone),
            colour: self.colour(attributes, context),
            hidden,
            space,
            at: place(record.at),
        };
        if report.spend(1, item.memory(items.last())) {
            report.hidden += usize::from(hidden);
            report.drawing.items.push(item);
        }
    }

    fn colour(&self, attributes: &Attributes, context: &Context) -> Option<[u8; 3]> {
        match attributes.source {
            Source::Object => attributes.colour,
            Source::Material => None,
            Source::Parent if context.block.is_some() => context.colour,
            Source::Layer | Source::Parent => self.layers.get(attributes.layer)?.colour,
        }
    }

    fn hidden(&self, attributes: &Attributes) -> bool {
        attributes.hidden || self.layers.hidden(attributes.layer)
    }
}

fn remark(record: &Record, reason: &str) -> String {
    let name: String = record.attributes.name.chars().take(40).collect();
    let name = if name.is_empty() {
        name
    } else {
        format!(" {name:?}")
    };
    let class = record.object.class.name();
    format!("byte {}: {class}{name}: {reason}", place(record.at))
}
