//! Writes changed curves into the text of a drawing: of a path its data, of a basic shape its geometry. Everything else
//! stays as it was, to the byte.

use std::collections::HashMap;
use std::ops::Range;

use roxmltree::{Document, Node, NodeId};

use super::super::changes::Changes;
use super::super::text_edits::TextEdits;
use super::document::{Placed, places};
use super::lengths::page;
use super::namespaces::{INKSCAPE, SODIPODI};
use super::writer::{number, subpath};
use super::{paths, shapes};
use crate::io::exchange::drawing::{Item, Shape, Unreadable};
use crate::io::loss::{Loss, LossReport};
use crate::io::xml::{Source, escaped};

/// The width of the stroke of new paths, by the size of the page.
const STROKE: f64 = 0.0005;

/// The attributes by which Inkscape draws a path, whatever its data is.
const OVERRIDES: [(&str, &str); 3] = [
    (SODIPODI, "type"),
    (INKSCAPE, "path-effect"),
    (INKSCAPE, "original-d"),
];

/// The shapes of a subpath, and whether it has changed.
type Subpath = (Vec<Shape>, bool);

/// The text of a part of the data of a path, the subpaths in it, and where it starts.
type Part<'c> = (&'c str, &'c [Subpath], [f64; 2]);

/// Write changes into the text of a drawing; the reason where that is not possible.
pub(super) fn rewritten(
    bytes: &[u8],
    changes: &Changes,
    losses: &mut LossReport,
) -> Result<Vec<u8>, String> {
    let unreadable = |error: Unreadable| error.reason;
    let source = Source::new(bytes).map_err(unreadable)?;
    let own = source.within(bytes);
    let (text, before) = own.ok_or("the file is damaged, or its text is not UTF-8")?;
    let document = source.document().map_err(unreadable)?;
    let places = places(&source, &document, bytes.len()).map_err(unreadable)?;
    let mut rewriting = Rewriting {
        text,
        document: &document,
        changes,
        edits: TextEdits::default(),
        losses,
    };
    let mut times: HashMap<NodeId, usize> = HashMap::new();
    for drawn in places.chunk_by(|a, b| a.drawn == b.drawn) {
        if let Some(placed) = drawn.first() {
            *times.entry(placed.element).or_default() += 1;
        }
    }
    let mut first = 0;
    for drawn in places.chunk_by(|a, b| a.drawn == b.drawn) {
        let items = first..first + drawn.len();
        first = items.end;
        if let Some(placed) = drawn.first()
            && items.clone().any(|item| changes.items.contains_key(&item))
        {
            let is_repeated = times.get(&placed.element).is_some_and(|times| *times > 1);
            rewriting.element(placed, items, is_repeated)?;
        }
    }
    rewriting.add()?;
    rewriting.edits.written(bytes, text, before)
}

struct Rewriting<'r, 'd> {
    text: &'d str,
    document: &'r Document<'d>,
    changes: &'r Changes,
    edits: TextEdits,
    losses: &'r mut LossReport,
}

impl<'d> Rewriting<'_, 'd> {
    /// Rewrite the element that some items come from.
    fn element(
        &mut self,
        placed: &Placed,
        items: Range<usize>,
        is_repeated: bool,
    ) -> Result<(), String> {
        let changes = self.changes;
        let change = items.clone().find_map(|item| changes.items.get(&item));
        let named = change.map_or("", |change| &change.name);
        if is_repeated {
            return Err(format!(
                "“{named}” is drawn in several places by one element"
            ));
        }
        let node = self.document.get_node(placed.element);
        let node = node.filter(|_| placed.is_whole);
        let node = node.ok_or_else(|| format!("“{named}” is damaged in the file"))?;
        let back = placed.place.inverse();
        let back = back.ok_or_else(|| format!("the transform of “{named}” flattens it"))?;
        let local = local(node, placed);
        let count = items.len();
        if local.len() != count {
            return Err(format!("“{named}” is damaged in the file"));
        }
        let subpaths: Vec<Subpath> = items
            .zip(local)
            .map(|(item, shapes)| match changes.items.get(&item) {
                None => (shapes, false),
                Some(change) => (change.applied(shapes, &back), true),
            })
            .collect();
        if subpaths.iter().all(|(shapes, _)| shapes.is_empty()) {
            self.remove(node);
            return Ok(());
        }
        match node.tag_name().name() {
            "path" => self.path(node, named, &subpaths),
            _ => self.basic_shape(node, named, &subpaths),
        }
    }

    /// Take an element away, with the line that it is alone on.
    fn remove(&mut self, node: Node) {
        let range = node.range();
        let before = self.text.get(..range.start).unwrap_or_default();
        let line = before.trim_end_matches([' ', '\t']);
        let line = line.strip_suffix('\n').unwrap_or(line);
        let line = line.strip_suffix('\r').unwrap_or(line);
        self.edits.replace(line.len()..range.end, "");
    }

    fn path(
        &mut self,
        node: Node<'_, 'd>,
        named: &str,
        subpaths: &[Subpath],
    ) -> Result<(), String> {
        let data = node.attribute("d").unwrap_or_default();
        let new = match Chunks::of(data, subpaths) {
            Some(chunks) => chunks.text()?,
            None => whole(subpaths)?,
        };
        let attribute = node.attribute_node("d");
        let place = attribute.map(|it| it.range_value());
        let place = place.ok_or_else(|| format!("“{named}” is damaged in the file"))?;
        self.edits.replace(place, new);
        for override_ in OVERRIDES {
            if let Some(attribute) = node.attribute_node(override_) {
                if override_.1 != "original-d" {
                    self.tell(named, "Inkscape shape");
                }
                self.edits.replace(self.with_space(attribute.range()), "");
            }
        }
        Ok(())
    }

    /// Rewrite the points of a polyline or polygon that still is one; everything else becomes a path.
    fn basic_shape(
        &mut self,
        node: Node<'_, 'd>,
        named: &str,
        subpaths: &[Subpath],
    ) -> Result<(), String> {
        let element = node.tag_name().name();
        let shapes: Vec<&Shape> = subpaths.iter().flat_map(|(shapes, _)| shapes).collect();
        if let [Shape::Polyline { points, closed }] = shapes.as_slice()
            && element == (if *closed { "polygon" } else { "polyline" })
            && let Some(attribute) = node.attribute_node("points")
        {
            let points = points
                .iter()
                .map(|it| format!("{},{}", number(it.x), number(it.y)));
            let points: Vec<String> = points.collect();
            self.edits
                .replace(attribute.range_value(), points.join(" "));
            return Ok(());
        }
        let geometry: &[&str] = match element {
            "rect" => &["x", "y", "width", "height", "rx", "ry"],
            "circle" => &["cx", "cy", "r"],
            "ellipse" => &["cx", "cy", "rx", "ry"],
            "line" => &["x1", "y1", "x2", "y2"],
            _ => &["points"],
        };
        let own = geometry
            .iter()
            .filter_map(|name| node.attribute_node(*name));
        for attribute in own {
            self.edits.replace(self.with_space(attribute.range()), "");
        }
        let start = node.range().start + 1;
        let tag = tag_name(self.text.get(start..).unwrap_or_default());
        let renamed = format!("{}path", tag.strip_suffix(element).unwrap_or_default());
        let end = node.range().end;
        let closing = format!("</{tag}");
        let inside = self.text.get(..end).unwrap_or_default();
        if let Some(at) = inside.rfind(&closing).filter(|at| *at > start)
            && node.has_children()
        {
            self.edits
                .replace(at + 2..at + closing.len(), renamed.clone());
        }
        let data = whole(subpaths)?;
        self.edits
            .replace(start..start + tag.len(), format!("{renamed} d=\"{data}\""));
        self.tell(named, element);
        Ok(())
    }

    fn tell(&mut self, named: &str, element: &str) {
        let element = element.to_owned();
        self.losses
            .losses
            .push((named.to_owned(), Loss::AsPath { element }));
    }

    /// A part of the text with the white space before it.
    fn with_space(&self, range: Range<usize>) -> Range<usize> {
        let before = self.text.get(..range.start).unwrap_or_default();
        before.trim_end().len()..range.end
    }

    /// Add new items as paths at the end.
    fn add(&mut self) -> Result<(), String> {
        if self.changes.added.is_empty() {
            return Ok(());
        }
        let root = self.document.root_element();
        let page = page(root);
        let back = page.place.inverse();
        let back = back.ok_or("the page of the file has no size")?;
        let inside = self.text.get(..root.range().end).unwrap_or_default();
        let at = inside.rfind("</").filter(|at| *at > root.range().start);
        let at = at.ok_or("the file is empty")?;
        let tag = tag_name(self.text.get(root.range().start + 1..).unwrap_or_default());
        let prefix = tag.strip_suffix("svg").unwrap_or_default();
        let label = root.lookup_prefix(INKSCAPE);
        let size = page.viewport.width.max(page.viewport.height);
        let style = format!(
            "fill:none;stroke:#000000;stroke-width:{}",
            number(STROKE * size)
        );
        let mut paths = String::new();
        for item in &self.changes.added {
            let shapes = item.shapes.iter().cloned();
            let shapes: Vec<Shape> = shapes.map(|it| it.placed(&back)).collect();
            let data = subpath(&shapes)?;
            let (label, title) = named(item, label, prefix);
            paths += &match title.is_empty() {
                true => format!("<{prefix}path{label} style=\"{style}\" d=\"{data}\"/>\n"),
                false => {
                    format!("<{prefix}path style=\"{style}\" d=\"{data}\">{title}</{prefix}path>\n")
                }
            };
        }
        self.edits.replace(at..at, paths);
        Ok(())
    }
}

/// The label of a new path where the file has Inkscape's names, otherwise its title.
fn named(item: &Item, label: Option<&str>, prefix: &str) -> (String, String) {
    let name = item.name.as_deref().map(escaped).unwrap_or_default();
    match label {
        _ if name.is_empty() => Default::default(),
        Some(inkscape) => (format!(" {inkscape}:label=\"{name}\""), String::new()),
        None => (
            String::new(),
            format!("<{prefix}title>{name}</{prefix}title>"),
        ),
    }
}

/// The name of the tag that a text begins with.
fn tag_name(text: &str) -> &str {
    let ends = |it: char| it.is_ascii_whitespace() || it == '>' || it == '/';
    let end = text.find(ends).unwrap_or(text.len());
    text.get(..end).unwrap_or_default()
}

/// The subpaths of an element in its own coordinates.
fn local(node: Node, placed: &Placed) -> Vec<Vec<Shape>> {
    if node.tag_name().name() != "path" {
        return shapes::shape(node, placed.viewport).into_iter().collect();
    }
    let mut subpaths = Vec::new();
    let data = node.attribute("d").unwrap_or_default();
    paths::read(data, usize::MAX, &mut |shapes| {
        subpaths.push(shapes);
        true
    });
    subpaths
}

/// The data of all subpaths.
fn whole(subpaths: &[Subpath]) -> Result<String, String> {
    let data = subpaths.iter().map(|(shapes, _)| subpath(shapes));
    let data = data.filter(|it| !matches!(it, Ok(text) if text.is_empty()));
    Ok(data.collect::<Result<Vec<String>, String>>()?.join(" "))
}

/// The data of a path, divided before each `M` and `m`.
struct Chunks<'c> {
    parts: Vec<Part<'c>>,
}

impl<'c> Chunks<'c> {
    /// Divide data; `None` if it cannot be told which subpath is where.
    fn of(data: &'c str, subpaths: &'c [Subpath]) -> Option<Self> {
        let mut marks: Vec<usize> = data
            .bytes()
            .enumerate()
            .filter_map(|(at, byte)| matches!(byte, b'M' | b'm').then_some(at))
            .collect();
        let starts = paths::starts(data);
        if starts.len() != marks.len() {
            return None;
        }
        marks.push(data.len());
        let mut rest = subpaths;
        let mut parts = Vec::new();
        for (mark, start) in marks.windows(2).zip(starts) {
            let &[from, to] = mark else { return None };
            let part = data.get(from..to)?;
            let mut count = 0;
            paths::read(part, usize::MAX, &mut |_| {
                count += 1;
                true
            });
            let (own, others) = rest.split_at_checked(count)?;
            rest = others;
            parts.push((part, own, [start.x, start.y]));
        }
        rest.is_empty().then_some(Self { parts })
    }

    /// The data with the subpaths that have changed.
    fn text(&self) -> Result<String, String> {
        let mut text = String::new();
        let mut is_moved = false;
        for (part, subpaths, start) in &self.parts {
            if !subpaths.iter().any(|(_, is_changed)| *is_changed) {
                match is_moved.then(|| absolute(part, *start)).flatten() {
                    Some(part) => text += &part,
                    None => text += part,
                }
                is_moved = false;
                continue;
            }
            is_moved = true;
            let data = whole(subpaths)?;
            let kept = part.trim_end();
            text += &data;
            if !data.is_empty() {
                text += part.get(kept.len()..).unwrap_or_default();
            }
        }
        Ok(text)
    }
}

/// A part that begins with `m`, the same beginning with `M`; `None` if it already does.
fn absolute(part: &str, [x, y]: [f64; 2]) -> Option<String> {
    let rest = part.strip_prefix('m')?;
    let rest = behind_number(behind_number(rest)?)?.trim_start_matches(SEPARATORS);
    let goes_on = rest.starts_with(|it: char| !it.is_ascii_alphabetic());
    let line = if goes_on { "l " } else { "" };
    Some(format!("M {} {} {line}{rest}", number(x), number(y)))
}

/// What separates numbers.
const SEPARATORS: [char; 5] = [' ', ',', '\t', '\n', '\r'];

/// The text behind the number that it begins with.
fn behind_number(text: &str) -> Option<&str> {
    let text = text.trim_start_matches(SEPARATORS);
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let mut at = usize::from(text.starts_with(['+', '-']));
    at += digits(text.get(at..)?);
    if text.get(at..)?.starts_with('.') {
        at += 1 + digits(text.get(at + 1..)?);
    }
    if let Some(exponent) = text.get(at..)?.strip_prefix(['e', 'E']) {
        let sign = usize::from(exponent.starts_with(['+', '-']));
        at += 1 + sign + digits(exponent.get(sign..)?);
    }
    text.get(at..)
}
