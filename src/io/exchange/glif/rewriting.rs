//! Writes changed contours into the text of a glyph. Where a contour keeps the kinds of its points, their coordinates
//! alone change; everything else stays as it was, to the byte.

use std::collections::HashMap;

use glam::DVec3;
use roxmltree::{Document, Node};

use super::super::changes::Changes;
use super::super::text_edits::TextEdits;
use super::reader;
use super::writer::{Contour, contours};
use crate::io::exchange::drawing::{Affine, Unreadable};
use crate::io::loss::{Loss, LossReport};
use crate::io::xml::Source;

/// Write changes into the text of a glyph; the reason where that is not possible.
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
    let (drawing, places) = reader::read(&source, &document).map_err(unreadable)?;
    let mut edits = TextEdits::default();
    for (index, (item, place)) in drawing.items.into_iter().zip(places).enumerate() {
        let Some(change) = changes.items.get(&index) else {
            continue;
        };
        let node = document.get_node(place).ok_or("the file is damaged")?;
        let was_open = contours(&item.shapes)?.iter().any(Contour::is_open);
        let shapes = change.applied(item.shapes, &Affine::default());
        let new = contours(&shapes)?;
        let is_kept = contour(text, node, &new, &mut edits).ok_or("the file is damaged")?;
        let mut lose = |loss| losses.losses.push((change.name.clone(), loss));
        if !is_kept {
            lose(Loss::PointAttributes);
        }
        if !was_open && new.iter().any(Contour::is_open) {
            lose(Loss::Opened);
        }
    }
    add(text, &document, changes, &mut edits)?;
    edits.written(bytes, text, before)
}

/// Put contours in the place of one. Points that have not changed keep their text. Returns whether all keep their
/// attributes.
fn contour(text: &str, node: Node, new: &[Contour], edits: &mut TextEdits) -> Option<bool> {
    let range = node.range();
    if new.is_empty() {
        // With the line that it is alone on.
        let line = text.get(..range.start)?.trim_end_matches([' ', '\t']);
        let line = line.strip_suffix('\n').unwrap_or(line);
        let line = line.strip_suffix('\r').unwrap_or(line);
        edits.replace(line.len()..range.end, "");
        return Some(true);
    }
    if let [new] = new
        && moved(node, new, edits)
    {
        return Some(true);
    }
    let points = || node.children().filter(|it| it.has_tag_name("point"));
    let (first, last) = (points().next()?, points().next_back()?);
    let mut old = OldPoints::of(points(), text);
    let before = text.get(..first.range().start)?;
    let indent = before.get(before.trim_end_matches([' ', '\t']).len()..)?;
    let mut written = String::new();
    let [first_new, others @ ..] = new else {
        return None;
    };
    first_new.write_points(&mut written, indent, |at, kind| old.take(at, kind));
    let inside = written.trim().to_owned();
    edits.replace(first.range().start..last.range().end, inside);
    let mut written = String::new();
    for other in others {
        other.write(&mut written, |at, kind| old.take(at, kind));
    }
    if !written.is_empty() {
        edits.replace(range.end..range.end, format!("\n{}", written.trim_end()));
    }
    Some(!old.have_more())
}

/// The points of a contour that are not written yet, by coordinates and type. A contour may have a million.
struct OldPoints<'t> {
    texts: HashMap<([u64; 2], Option<&'t str>), Vec<OldPoint<'t>>>,
}

/// A point as it stands in the file.
struct OldPoint<'t> {
    text: &'t str,
    /// Whether it has more than coordinates and a type, as a name.
    has_more: bool,
}

impl<'t> OldPoints<'t> {
    fn of<'n: 't>(nodes: impl Iterator<Item = Node<'t, 'n>>, text: &'t str) -> Self {
        let mut texts: HashMap<_, Vec<OldPoint>> = HashMap::new();
        for node in nodes {
            let mut names = node.attributes().map(|it| it.name());
            let has_more = names.any(|name| !["x", "y", "type"].contains(&name));
            if let (Some(at), Some(text)) = (point_of(&node), text.get(node.range())) {
                let own = texts.entry((bits(at), kind(&node))).or_default();
                own.push(OldPoint { text, has_more });
            }
        }
        // The first one goes first.
        texts.values_mut().for_each(|own| own.reverse());
        Self { texts }
    }

    /// Take a point that is to be written.
    fn take(&mut self, at: DVec3, kind: Option<&'static str>) -> Option<&'t str> {
        let own = self.texts.get_mut(&(bits(at), kind))?;
        own.pop().map(|point| point.text)
    }

    /// Whether points with more than coordinates and a type are left.
    fn have_more(&self) -> bool {
        self.texts.values().flatten().any(|point| point.has_more)
    }
}

/// The coordinates to the bit; 0 has one sign.
fn bits(at: DVec3) -> [u64; 2] {
    [at.x, at.y].map(|it| (it + 0.0).to_bits())
}

/// The type of a point on the curve.
fn kind<'a>(node: &Node<'a, '_>) -> Option<&'a str> {
    node.attribute("type").filter(|kind| *kind != "offcurve")
}

fn point_of(node: &Node) -> Option<DVec3> {
    let coordinate = |name| node.attribute(name)?.trim().parse().ok();
    Some(DVec3::new(coordinate("x")?, coordinate("y")?, 0.0))
}

/// Move the points of a contour to those of another one, if these are of the same kinds. Returns whether they are.
fn moved(node: Node, new: &Contour, edits: &mut TextEdits) -> bool {
    let points = node.children().filter(|it| it.has_tag_name("point"));
    let points: Vec<Node> = points.collect();
    // The reader begins at the first point on the curve.
    let first = points.iter().position(|it| kind(it).is_some());
    let mut turned = points.clone();
    turned.rotate_left(first.unwrap_or_default());
    let is_same = turned.len() == new.points.len()
        && turned
            .iter()
            .zip(&new.points)
            .all(|(old, (_, new))| kind(old) == *new);
    if !is_same {
        return false;
    }
    for (old, (at, _)) in turned.iter().zip(&new.points) {
        for (name, value) in [("x", at.x), ("y", at.y)] {
            if let Some(attribute) = old.attribute_node(name)
                && attribute.value().trim().parse() != Ok(value)
            {
                edits.replace(attribute.range_value(), value.to_string());
            }
        }
    }
    true
}

/// Add new contours at the end of the outline.
fn add(
    text: &str,
    document: &Document,
    changes: &Changes,
    edits: &mut TextEdits,
) -> Result<(), String> {
    let mut written = String::new();
    for item in &changes.added {
        for contour in contours(&item.shapes)? {
            contour.write(&mut written, |_, _| None);
        }
    }
    if written.is_empty() {
        return Ok(());
    }
    let outline = document
        .root_element()
        .children()
        .find(|it| it.has_tag_name("outline"));
    let outline = outline.ok_or("the glyph has no outline")?.range();
    let inside = text.get(outline.clone()).unwrap_or_default();
    match inside.rfind("</") {
        Some(at) => {
            let at = outline.start + at;
            let before = text.get(..at).unwrap_or_default();
            let line = before.trim_end_matches([' ', '\t']).len();
            edits.replace(line..line, written);
        }
        None => edits.replace(outline, format!("<outline>\n{written}  </outline>")),
    }
    Ok(())
}
