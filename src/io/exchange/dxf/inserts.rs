//! The drawing as it is seen: entities with their layers and colours, blocks where they are inserted.

use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;
use std::sync::Arc;

use super::colours::Paint;
use super::groups::Groups;
use super::layers::Layer;
use super::notes::Notes;
use super::parts::{Content, Insert, Part, Parts};
use super::sections::Sections;
use crate::io::exchange::drawing::{Affine, Conic, Drawing, Item, Kind, Nurbs, Shape, Space};
use crate::io::exchange::spending::most_items;

/// The deepest nesting of blocks.
const DEEPEST: usize = 64;
/// The bytes up to which inserts may draw, by estimate, for files of up to `USUAL` bytes.
const MEMORY: usize = 120_000_000;
/// Files above this get more, `MORE` bytes a byte.
const USUAL: usize = 10_000_000;
const MORE: usize = 20;
/// The most names of hidden layers that a remark lists.
const LISTED: usize = 12;
/// The layer whose entities take the layer of the insert.
const LAYER_OF_INSERT: &str = "0";

/// Draws entities and blocks.
pub struct Placer<'a, 'n> {
    sections: &'n Sections<'a>,
    notes: &'n mut Notes,
    drawing: Drawing,
    /// What is no curve, by its name.
    others: HashMap<String, usize>,
    /// The entities of the blocks that were inserted so far.
    parts: HashMap<usize, Rc<Vec<Part>>>,
    /// The blocks that are being drawn, outermost first.
    open: Vec<usize>,
    /// The layers that the file hides and that have items.
    hidden: BTreeSet<String>,
    /// How many entities the file marks as invisible, themselves or their blocks, and the place of the first.
    invisible: (usize, u64),
    /// How many entities and blocks inserts drew.
    drawn: usize,
    /// The most entities and blocks that inserts may draw.
    most: usize,
    /// The bytes that are in use, by estimate.
    memory: usize,
    /// The most bytes that inserts may bring about.
    most_memory: usize,
    is_full: bool,
}

/// Where an entity is drawn.
#[derive(Clone)]
struct Setting {
    place: Affine,
    space: Space,
    /// The insert around it.
    insert: Option<Around>,
}

/// What an insert gives to the entities of its block.
#[derive(Clone)]
struct Around {
    layer: String,
    colour: Option<[u8; 3]>,
    block: Arc<str>,
    /// Whether the insert is marked as invisible, or lies in one that is.
    is_invisible: bool,
    /// The frozen layer of the insert, or of one that it lies in.
    frozen: Option<Arc<str>>,
}

impl<'a, 'n> Placer<'a, 'n> {
    /// Start with what was found in a file of some size.
    pub fn new(sections: &'n Sections<'a>, notes: &'n mut Notes, size: usize) -> Self {
        let more = size.saturating_sub(USUAL).saturating_mul(MORE);
        Self {
            sections,
            notes,
            drawing: Drawing {
                is_nameless: true,
                ..Drawing::of_file(size)
            },
            others: HashMap::new(),
            parts: HashMap::new(),
            open: Vec::new(),
            hidden: BTreeSet::new(),
            invisible: (0, 0),
            drawn: 0,
            most: most_items(size),
            memory: 0,
            most_memory: MEMORY.saturating_add(more),
            is_full: false,
        }
    }

    /// Draw everything: the entities, then the layouts that are stored as blocks.
    pub fn drawing(mut self) -> Drawing {
        let sections = self.sections;
        for entities in &sections.entities {
            self.draw_top(entities, None);
        }
        for block in &sections.blocks {
            if let Some(space) = block.layout {
                self.draw_top(&block.entities, Some(space));
            }
        }
        self.note_hidden();
        self.drawing
    }

    fn draw_top(&mut self, entities: &Groups<'a>, layout: Option<Space>) {
        let mut parts = Parts::new(entities, self.sections);
        while let Some(mut part) = parts.next(self.notes) {
            let marked = if part.is_paper {
                Space::Paper
            } else {
                Space::Model
            };
            let setting = Setting {
                place: Affine::default(),
                space: layout.unwrap_or(marked),
                insert: None,
            };
            match &mut part.content {
                Content::Curve(kind, shapes) => {
                    let (kind, shapes) = (*kind, std::mem::take(shapes));
                    self.draw_curve(&part, kind, shapes, &setting);
                }
                _ => self.draw(&part, &setting),
            }
        }
    }

    fn draw(&mut self, part: &Part, setting: &Setting) {
        match &part.content {
            Content::Curve(kind, shapes) => {
                let place = |shape: &Shape| shape.clone().placed(&setting.place);
                let shapes = shapes.iter().map(place).collect();
                self.draw_curve(part, *kind, shapes, setting);
            }
            Content::Insert(insert) => self.draw_insert(part, insert, setting),
            Content::Other(name) => self.count_other(name, part.at),
        }
    }

    fn draw_curve(&mut self, part: &Part, kind: Kind, shapes: Vec<Shape>, setting: &Setting) {
        if !shapes.iter().all(is_finite) {
            let name = kind.name();
            self.notes.add_once(
                part.at,
                format_args!("{name} skipped: it reaches beyond all numbers"),
            );
            return;
        }
        let around = setting.insert.as_ref();
        let name = layer_name(part, around);
        let layer = self.sections.layers.find(name);
        let item = Item {
            kind,
            shapes,
            colour: colour(part, layer, around),
            hidden: self.is_hidden(part, layer, around),
            name: None,
            block: around.map(|around| Arc::clone(&around.block)),
            space: setting.space,
            at: part.at,
            // The table has the usual spelling.
            group: self
                .drawing
                .path(&[layer.map_or(name, |layer| &layer.name)]),
        };
        let memory = item.memory(self.drawing.items.last());
        self.memory = self.memory.saturating_add(memory);
        self.drawing.items.push(item);
    }

    fn draw_insert(&mut self, part: &Part, insert: &Insert, setting: &Setting) {
        let sections = self.sections;
        let Some(block) = sections.blocks.get(insert.block) else {
            return;
        };
        if !self.may_open(part.at, insert.block) {
            return;
        }
        let parts = self.parts_of(insert.block);
        let around = setting.insert.as_ref();
        let name = layer_name(part, around);
        let layer = sections.layers.find(name);
        let frozen = layer
            .filter(|it| it.is_frozen)
            .map(|it| it.name.as_str().into());
        let mut inner = Setting {
            place: setting.place,
            space: setting.space,
            insert: Some(Around {
                layer: name.to_owned(),
                colour: colour(part, layer, around),
                block: block.name.as_str().into(),
                is_invisible: part.is_invisible || around.is_some_and(|it| it.is_invisible),
                frozen: frozen.or_else(|| around?.frozen.clone()),
            }),
        };
        self.open.push(insert.block);
        let (columns, across) = insert.columns;
        let (rows, along) = insert.rows;
        for number in 0..columns.saturating_mul(rows) {
            if !self.has_room(part.at) {
                break;
            }
            let step = across * (number % columns) as f64 + along * (number / columns) as f64;
            let mut place = insert.place;
            place.origin += step;
            inner.place = setting.place.of(&place);
            self.draw_block(&parts, &inner);
        }
        self.open.pop();
    }

    fn draw_block(&mut self, parts: &[Part], setting: &Setting) {
        for part in parts {
            if !self.has_room(part.at) {
                return;
            }
            self.draw(part, setting);
        }
    }

    fn may_open(&mut self, at: u64, block: usize) -> bool {
        let reason = if self.open.contains(&block) {
            "the block holds itself"
        } else if self.open.len() >= DEEPEST {
            "blocks are nested more than 64 deep"
        } else {
            return true;
        };
        self.notes
            .add_once(at, format_args!("INSERT skipped: {reason}"));
        false
    }

    /// Count one more drawn by an insert, if there is room.
    fn has_room(&mut self, at: u64) -> bool {
        if self.is_full {
            return false;
        }
        self.drawn += 1;
        self.is_full = self.drawn > self.most || self.memory > self.most_memory;
        if self.is_full {
            let most = self.most;
            let remark = format!(
                "INSERT cut off: inserts draw more than {most} entities or take too much memory"
            );
            self.notes.add(at, remark);
        }
        !self.is_full
    }

    fn parts_of(&mut self, number: usize) -> Rc<Vec<Part>> {
        if let Some(parts) = self.parts.get(&number) {
            return Rc::clone(parts);
        }
        let mut found = Vec::new();
        if let Some(block) = self.sections.blocks.get(number) {
            let mut parts = Parts::new(&block.entities, self.sections);
            while let Some(part) = parts.next(self.notes) {
                self.memory = self.memory.saturating_add(part_size(&part));
                found.push(part);
            }
        }
        found.shrink_to_fit();
        let found = Rc::new(found);
        self.parts.insert(number, Rc::clone(&found));
        found
    }

    /// Whether a curve is not drawn, for a reason that will be told.
    fn is_hidden(&mut self, part: &Part, layer: Option<&Layer>, around: Option<&Around>) -> bool {
        let is_invisible = part.is_invisible || around.is_some_and(|it| it.is_invisible);
        if is_invisible {
            let (count, first) = &mut self.invisible;
            *first = if *count == 0 { part.at } else { *first };
            *count = count.saturating_add(1);
        }
        let own = layer
            .filter(|layer| layer.is_hidden())
            .map(|it| it.name.as_str());
        let frozen = around.and_then(|around| around.frozen.as_deref());
        let hiding = own.or(frozen);
        if let Some(name) = hiding.filter(|name| !self.hidden.contains(*name)) {
            self.hidden.insert(name.to_owned());
        }
        is_invisible || hiding.is_some()
    }

    fn count_other(&mut self, name: &str, at: u64) {
        let others = &mut self.drawing.other;
        if let Some(other) = self
            .others
            .get(name)
            .and_then(|number| others.get_mut(*number))
        {
            other.count = other.count.saturating_add(1);
            return;
        }
        let known = self.drawing.other.len();
        self.drawing.count_other(name, at);
        // Of too many kinds the rest has one row.
        if self.drawing.other.len() > known {
            self.others.insert(name.to_owned(), known);
        }
    }

    fn note_hidden(&mut self) {
        let (count, first) = self.invisible;
        match count {
            0 => {}
            1 => self
                .notes
                .add(first, "an entity is marked as invisible, it is hidden"),
            _ => self.notes.add(
                first,
                format_args!("{count} entities are marked as invisible, they are hidden"),
            ),
        }
        let names: Vec<&str> = self
            .hidden
            .iter()
            .take(LISTED)
            .map(String::as_str)
            .collect();
        if names.is_empty() {
            return;
        }
        let names = names.join(", ");
        let more = match self.hidden.len().saturating_sub(LISTED) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        self.notes.add_whole(format!(
            "layers that are off or frozen, their curves are hidden: {names}{more}"
        ));
    }
}

/// The layer of an entity; in blocks the layer 0 is that of the insert.
fn layer_name<'a>(part: &'a Part, around: Option<&'a Around>) -> &'a str {
    match around {
        Some(around) if part.layer == LAYER_OF_INSERT => &around.layer,
        _ => &part.layer,
    }
}

fn colour(part: &Part, layer: Option<&Layer>, around: Option<&Around>) -> Option<[u8; 3]> {
    match part.paint {
        Paint::Own(colour) => colour,
        Paint::Layer => layer?.colour,
        Paint::Block => around?.colour,
    }
}

fn is_finite(shape: &Shape) -> bool {
    match shape {
        Shape::Nurbs(Nurbs { points, .. }) | Shape::Polyline { points, .. } => {
            points.iter().all(|point| point.is_finite())
        }
        Shape::Conic(Conic {
            centre,
            x,
            y,
            from,
            to,
        }) => {
            [centre, x, y].into_iter().all(|it| it.is_finite())
                && from.is_finite()
                && to.is_finite()
        }
        Shape::Point(point) => point.is_finite(),
    }
}

/// About how many bytes an entity of a block takes.
fn part_size(part: &Part) -> usize {
    let content = match &part.content {
        Content::Curve(_, shapes) => shapes.iter().map(Shape::memory).sum(),
        Content::Insert(_) => 0,
        Content::Other(name) => name.len(),
    };
    size_of::<Part>() + 64 + part.layer.len() + content
}
