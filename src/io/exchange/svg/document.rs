//! The tree of a drawing: groups, layers, nested drawings, and elements that are used again.

use std::collections::HashMap;
use std::sync::Arc;

use roxmltree::{Document, Node, NodeId};

use super::super::remarks::Remarks;
use super::lengths::{Along, Viewport, aspect_ratio, length, page, view_box};
use super::maker::{Maker, Room};
use super::names::{group_name, name};
use super::namespaces::{SVG, XLINK};
use super::style::{MOST_SELECTORS, Sheet, Style};
use super::transforms::{fit, matrix, transform};
use super::{paths, shapes};
use crate::io::exchange::drawing::{Affine, Drawing, Item, Kind, Space, Unreadable};
use crate::io::exchange::short_names::{short, short_path};
use crate::io::exchange::spending::most_items;
use crate::io::xml::Source;

/// The most groups and uses inside one another. Each is a recursion, and drawings have about ten.
const DEPTH_LIMIT: usize = 64;
/// What all files may cost: one for an element and for each four bytes of attributes, which hold at least a
/// point.
const COST: usize = 400_000;

/// The cost of an element that is used again.
const USED: usize = 4;

/// So many nodes inside an element cost as much as an element.
const NODES: usize = 16;

/// The memory for the tree and the items of a file of up to 11 MB; larger files get eleven times their size.
const MEMORY: usize = 120 << 20;

/// The memory for the items of a small file, and for those that each byte of a file may bring.
const OF_SMALL: usize = 64 << 20;
const OF_BYTE: usize = 20;

/// The memory for a point of a path, with what it takes while a long path is read.
const OF_POINT: usize = 56;

/// Where an item of a drawing comes from.
#[derive(Clone)]
pub(super) struct Placed {
    /// The element.
    pub(super) element: NodeId,
    /// How many elements were drawn before, with every use of one.
    pub(super) drawn: usize,
    /// What places its coordinates.
    pub(super) place: Affine,
    /// What percentages refer to.
    pub(super) viewport: Viewport,
    /// Whether all of the element was read.
    pub(super) is_whole: bool,
}

/// Read a drawing.
pub(super) fn read(
    source: &Source,
    document: &Document<'_>,
    size: usize,
) -> Result<Drawing, Unreadable> {
    Ok(walk(source, document, size, false)?.0)
}

/// Read where the items of a drawing come from.
pub(super) fn places(
    source: &Source,
    document: &Document<'_>,
    size: usize,
) -> Result<Vec<Placed>, Unreadable> {
    Ok(walk(source, document, size, true)?.1)
}

/// Say that things are skipped, at the place of the first.
fn skipped(count: usize, one: &str, many: &str) -> String {
    match count {
        1 => format!("a {one} is skipped"),
        _ => format!("{count} {many} are skipped, of which this is the first"),
    }
}

/// Walk over a drawing. `places` tells whether to keep where items come from.
fn walk(
    source: &Source,
    document: &Document<'_>,
    size: usize,
    places: bool,
) -> Result<(Drawing, Vec<Placed>), Unreadable> {
    let root = document.root_element();
    if !is_svg(root) || root.tag_name().name() != "svg" {
        return Err(Unreadable {
            at: Some(source.line_of(root)),
            reason: format!(
                "this is no SVG file: its root is <{}>",
                root.tag_name().name()
            ),
        });
    }
    let page = page(root);
    let mut walk = Walk::new(source, document, size);
    walk.places = places.then(Vec::new);
    walk.drawing.unit = page.unit;
    source
        .remarks
        .iter()
        .for_each(|it| walk.remarks.add(it.clone()));
    page.remark.into_iter().for_each(|it| walk.remarks.add(it));
    let frame = Frame {
        place: page.place,
        group: Arc::default(),
        block: None,
        style: Style::default().of(root, &walk.sheet),
        viewport: page.viewport,
        depth: 0,
    };
    walk.children(root, &frame);
    let places = walk.places.take().unwrap_or_default();
    Ok((walk.finish(), places))
}

/// What an element inherits from those around it.
#[derive(Clone)]
struct Frame {
    place: Affine,
    group: Arc<[String]>,
    block: Option<Arc<str>>,
    style: Style,
    viewport: Viewport,
    depth: usize,
}

/// The walk over all elements that are drawn.
struct Walk<'d> {
    source: &'d Source,
    document: &'d Document<'d>,
    ids: HashMap<&'d str, NodeId>,
    sheet: Sheet,
    drawing: Drawing,
    /// Where the items come from, if that is kept.
    places: Option<Vec<Placed>>,
    /// How many elements were drawn.
    drawn: usize,
    remarks: Remarks,
    /// The elements that are being used, outermost first.
    used: Vec<NodeId>,
    /// What may still be spent.
    budget: usize,
    /// The room that is left for items.
    room: Room,
    /// Whether the budget or the number of items is used up.
    full: bool,
    /// How many elements are hidden, and the first one's line.
    hidden: (usize, u64),
    /// The same for subpaths of one point.
    empty: (usize, u64),
}

impl<'d> Walk<'d> {
    fn new(source: &'d Source, document: &'d Document<'d>, size: usize) -> Self {
        let mut ids = HashMap::new();
        let mut sheet = Sheet::default();
        let mut drawing = Drawing::of_file(size);
        for node in document.descendants().filter(Node::is_element) {
            if let Some(id) = node.attribute("id") {
                ids.entry(id).or_insert(node.id());
            }
            match node.tag_name().name() {
                "style" if is_svg(node) => node
                    .children()
                    .filter_map(|it| it.text())
                    .for_each(|it| sheet.add(it)),
                // What they hide or add is told by their count alone.
                name @ ("clipPath" | "mask" | "pattern" | "marker") if is_svg(node) => {
                    drawing.count_other(name, source.line_of(node));
                }
                _ => {}
            }
        }
        Self {
            source,
            document,
            ids,
            sheet,
            drawing,
            places: None,
            drawn: 0,
            remarks: Remarks::default(),
            used: Vec::new(),
            budget: COST + size / 2,
            room: Room {
                memory: MEMORY
                    .max(size.saturating_mul(11))
                    .saturating_sub(source.tree_size())
                    .min(OF_SMALL.saturating_add(size.saturating_mul(OF_BYTE))),
                items: most_items(size),
            },
            full: false,
            hidden: (0, 0),
            empty: (0, 0),
        }
    }

    fn finish(mut self) -> Drawing {
        let (count, line) = self.hidden;
        if count > 0 {
            let skipped = skipped(count, "hidden element", "hidden elements");
            self.remarks.add(format!("line {line}: {skipped}"));
        }
        if self.sheet.is_full {
            self.remarks.add(format!(
                "style sheets with more than {MOST_SELECTORS} selectors: the others have no effect"
            ));
        }
        let (count, line) = self.empty;
        if count > 0 {
            let skipped = skipped(count, "subpath of one point", "subpaths of one point");
            self.remarks.add(format!("line {line}: {skipped}"));
        }
        self.drawing.remarks = self.remarks.finish();
        self.drawing
    }

    fn children(&mut self, node: Node<'d, 'd>, frame: &Frame) {
        for (child, number) in node.children().zip(1..) {
            // Texts and comments that are used again and again cost time too.
            if self.full || (number % NODES == 0 && !self.spend_some(node, 1)) {
                return;
            }
            if child.is_element() {
                self.element(child, frame);
            }
        }
    }

    fn element(&mut self, node: Node<'d, 'd>, outer: &Frame) {
        let name = node.tag_name().name();
        if !is_svg(node) || is_definition(name) || !self.spend(node) {
            return;
        }
        let style = outer.style.of(node, &self.sheet);
        if style.hidden {
            self.count_hidden(node);
            return;
        }
        match name {
            "g" | "a" | "switch" | "svg" | "use" => {
                if let Some(frame) = self.enter(node, outer, style) {
                    self.container(node, &frame);
                }
            }
            "path" | "rect" | "circle" | "ellipse" | "line" | "polyline" | "polygon" => {
                if style.is_invisible() {
                    self.count_hidden(node);
                } else {
                    self.shape(node, outer, style);
                }
            }
            _ => self
                .drawing
                .count_other(&short(name), self.source.line_of(node)),
        }
    }

    /// Pay for an element.
    fn spend(&mut self, node: Node) -> bool {
        let attributes: usize = node.attributes().map(|it| it.value().len()).sum();
        // Empty elements that are used again and again cost time alone.
        let own = if self.used.is_empty() { 1 } else { USED };
        self.spend_some(node, own + attributes / 4)
    }

    fn spend_some(&mut self, node: Node, cost: usize) -> bool {
        match self.budget.checked_sub(cost) {
            Some(rest) if !self.full => {
                self.budget = rest;
                true
            }
            _ => {
                self.stop(node);
                false
            }
        }
    }

    fn stop(&mut self, node: Node) {
        if !self.full {
            self.full = true;
            self.remark(
                node,
                "the drawing is too large, or uses elements again too often: its rest is missing",
            );
        }
    }

    fn count_hidden(&mut self, node: Node) {
        let first = if self.hidden.0 == 0 {
            self.source.line_of(node)
        } else {
            self.hidden.1
        };
        self.hidden = (self.hidden.0 + 1, first);
    }

    /// Make the frame for the children of an element.
    fn enter(&mut self, node: Node, outer: &Frame, style: Style) -> Option<Frame> {
        if outer.depth >= DEPTH_LIMIT {
            self.remark(node, "it is skipped because it is nested more than 64 deep");
            return None;
        }
        let own = (node.tag_name().name() == "g").then(|| group_name(node));
        let group = match own.flatten() {
            Some(name) => {
                let names = outer.group.iter().chain([&name]);
                short_path(names.map(String::as_str)).into()
            }
            None => Arc::clone(&outer.group),
        };
        Some(Frame {
            place: self.placed(node, outer),
            group,
            block: outer.block.clone(),
            style,
            viewport: outer.viewport,
            depth: outer.depth + 1,
        })
    }

    fn placed(&mut self, node: Node, outer: &Frame) -> Affine {
        let Some(text) = node.attribute("transform") else {
            return outer.place;
        };
        let (place, error) = transform(text);
        if let Some(error) = error {
            self.remark(
                node,
                &format!("its transform is damaged and read up to the damage: {error}"),
            );
        }
        outer.place.of(&place)
    }

    fn container(&mut self, node: Node<'d, 'd>, frame: &Frame) {
        match node.tag_name().name() {
            "svg" => self.nested(node, frame, [None, None]),
            "use" => self.reuse(node, frame),
            "switch" => {
                let fits = |it: &Node| {
                    is_svg(*it)
                        && it.tag_name().name() != "foreignObject"
                        && !it.has_attribute("requiredExtensions")
                };
                if let Some(child) = node.children().find(fits) {
                    self.element(child, frame);
                }
            }
            _ => self.children(node, frame),
        }
    }

    /// Walk over an `svg` or a `symbol`, of a size that may be given by its `use`.
    fn nested(&mut self, node: Node<'d, 'd>, frame: &Frame, size: [Option<f64>; 2]) {
        let mut inner = frame.clone();
        let get = |name, along| length(node, name, along, frame.viewport);
        let width = size[0].or_else(|| get("width", Along::Width));
        let height = size[1].or_else(|| get("height", Along::Height));
        inner.viewport = Viewport {
            width: width.unwrap_or(frame.viewport.width),
            height: height.unwrap_or(frame.viewport.height),
        };
        if !(inner.viewport.width > 0.0 && inner.viewport.height > 0.0) {
            if width.is_some() || height.is_some() {
                self.remark(
                    node,
                    "it is skipped because its width or height is not above 0",
                );
                return;
            }
        } else if let Some(view) = view_box(node) {
            let size = (inner.viewport.width, inner.viewport.height);
            inner.place =
                inner
                    .place
                    .of(&corner(node, frame))
                    .of(&fit(view, size, aspect_ratio(node)));
            inner.viewport = Viewport {
                width: view.w,
                height: view.h,
            };
            self.children(node, &inner);
            return;
        }
        inner.place = inner.place.of(&corner(node, frame));
        self.children(node, &inner);
    }

    /// Walk over the element that a `use` refers to.
    fn reuse(&mut self, node: Node<'d, 'd>, frame: &Frame) {
        let reference = node
            .attribute("href")
            .or_else(|| node.attribute((XLINK, "href")));
        let id = reference.and_then(|it| it.trim().strip_prefix('#'));
        let target = id.and_then(|id| self.document.get_node(*self.ids.get(id)?));
        let (Some(id), Some(target)) = (id, target) else {
            let what = reference.unwrap_or("nothing");
            self.remark(
                node,
                &format!("it is skipped because it refers to {what}, which this file has not"),
            );
            return;
        };
        if self.used.contains(&target.id()) {
            self.remark(node, &format!("it is skipped because #{id} uses itself"));
            return;
        }
        let mut inner = frame.clone();
        inner.place = inner.place.of(&corner(node, frame));
        inner.block = Some(short(id).into());
        self.used.push(target.id());
        self.target(node, target, inner);
        self.used.pop();
    }

    fn target(&mut self, node: Node<'d, 'd>, target: Node<'d, 'd>, mut inner: Frame) {
        let name = target.tag_name().name();
        if name == "symbol" || name == "svg" {
            if !self.spend(target) {
                return;
            }
            inner.place = self.placed(target, &inner);
            inner.style = inner.style.of(target, &self.sheet);
            if inner.style.hidden {
                self.count_hidden(target);
                return;
            }
            let size = [("width", Along::Width), ("height", Along::Height)]
                .map(|(name, along)| length(node, name, along, inner.viewport));
            self.nested(target, &inner, size);
        } else {
            self.element(target, &inner);
        }
    }

    fn shape(&mut self, node: Node<'d, 'd>, outer: &Frame, style: Style) {
        let item = Item {
            kind: Kind::Path,
            shapes: Vec::new(),
            group: outer.group.clone(),
            name: name(node).map(short),
            block: outer.block.clone(),
            colour: style.shown(),
            hidden: false,
            space: Space::Model,
            at: self.source.line_of(node),
        };
        let items = std::mem::take(&mut self.drawing.items);
        let (place, before) = (self.placed(node, outer), items.len());
        let (mut is_whole, mut is_full) = (true, false);
        let mut maker = Maker::new(place, item, items, self.room);
        if node.tag_name().name() == "path" {
            let data = node.attribute("d").unwrap_or_default();
            let most_points = self.room.memory / OF_POINT;
            let outcome = paths::read(data, most_points, &mut |shapes| maker.take(shapes));
            is_whole = outcome.error.is_none() && !outcome.is_full;
            is_full = outcome.is_full;
            self.report_path(node, &outcome);
        } else {
            match shapes::shape(node, outer.viewport) {
                Ok(shapes) => {
                    maker.take(shapes);
                }
                Err(reason) => self.remark(node, &format!("it is skipped because {reason}")),
            }
            if shapes::has_damaged_points(node) {
                is_whole = false;
                self.remark(node, "its points are damaged and read up to the damage");
            }
        }
        if maker.infinite > 0 {
            is_whole = false;
            self.remark(
                node,
                "it is skipped because its coordinates are beyond all numbers",
            );
        }
        let full = is_full || maker.is_full();
        self.room = maker.room;
        self.drawing.items = maker.items;
        self.drawn += 1;
        if let Some(places) = &mut self.places {
            let placed = Placed {
                element: node.id(),
                drawn: self.drawn,
                place,
                viewport: outer.viewport,
                is_whole: is_whole && !full,
            };
            places.resize(places.len() + self.drawing.items.len() - before, placed);
        }
        if full {
            self.stop(node);
        }
    }

    fn report_path(&mut self, node: Node, outcome: &paths::Outcome) {
        if let Some(error) = &outcome.error {
            self.remark(
                node,
                &format!("its data is damaged and read up to the damage: {error}"),
            );
        }
        if outcome.empty > 0 {
            let first = if self.empty.0 == 0 {
                self.source.line_of(node)
            } else {
                self.empty.1
            };
            self.empty = (self.empty.0 + outcome.empty, first);
        }
    }

    fn remark(&mut self, node: Node, text: &str) {
        let line = self.source.line_of(node);
        let element = node.tag_name().name();
        let name = name(node).map(short);
        let name = name.map(|it| format!(" “{it}”")).unwrap_or_default();
        self.remarks
            .add(format!("line {line}: <{element}>{name}: {text}"));
    }
}

fn is_svg(node: Node) -> bool {
    node.is_element() && node.tag_name().namespace().is_none_or(|it| it == SVG)
}

/// Whether an element is drawn only where another one refers to it, or not at all.
fn is_definition(name: &str) -> bool {
    matches!(
        name,
        "defs"
            | "symbol"
            | "clipPath"
            | "mask"
            | "pattern"
            | "marker"
            | "linearGradient"
            | "radialGradient"
            | "filter"
            | "title"
            | "desc"
            | "metadata"
            | "style"
            | "script"
            | "view"
            | "font"
            | "font-face"
            | "cursor"
            | "color-profile"
            | "animate"
            | "animateTransform"
            | "animateMotion"
            | "set"
    )
}

/// The corner of an `svg` or the shift of a `use`.
fn corner(node: Node, frame: &Frame) -> Affine {
    if node.tag_name().name() == "symbol" {
        return Affine::default();
    }
    let x = length(node, "x", Along::Width, frame.viewport).unwrap_or_default();
    let y = length(node, "y", Along::Height, frame.viewport).unwrap_or_default();
    matrix([1.0, 0.0, 0.0, 1.0, x, y])
}
