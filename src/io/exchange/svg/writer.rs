//! Writes drawings to scale.

use std::collections::HashMap;
use std::f64::consts::TAU;
use std::fmt::Write;

use glam::{DMat3, DVec3};

use super::super::splines::{Piece, at, described, hull, pieces};
use super::namespaces::{INKSCAPE, SVG};
use crate::io::exchange::drawing::{Affine, Conic, Drawing, Item, Shape, Unreadable};
use crate::io::xml::escaped;

/// The largest part of an arc, in radians: the centre of a half turn is badly defined by its ends.
const ARC_LIMIT: f64 = TAU / 3.0;
/// How far the ends of an arc may be off those of its neighbours, per size of the page: far above rounding,
/// far below what can be seen.
const GAP: f64 = 1e-9;
/// The same for shapes of one subpath that were placed there and back: a few times rounding.
const JOINT: f64 = 1e-13;
/// The most groups inside one another, as deep as the reader goes but for the group around them.
const DEPTH_LIMIT: usize = 60;

/// Write a drawing, in millimetres. Each outermost group mirrors its contents, so that coordinates stay as
/// they are.
pub(super) fn write(drawing: &Drawing, name: &str) -> Result<Vec<u8>, Unreadable> {
    let shapes: Vec<_> = drawing.items.iter().map(|it| scaled(drawing, it)).collect();
    let page = Page::around(shapes.iter().flatten());
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"{SVG}\" xmlns:inkscape=\"{INKSCAPE}\" \
         version=\"1.1\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"{2} {3} {0} {1}\">\n<title>{4}</title>\n",
        number(page.width),
        number(page.height),
        number(page.left),
        number(-page.top),
        escaped(name)
    );
    let mut open: Option<Vec<String>> = None;
    for (item, path) in layered(drawing) {
        enter(&mut text, open.as_deref(), &path, &page);
        let index = drawing.items.iter().position(|it| std::ptr::eq(it, item));
        let shapes = index
            .and_then(|it| shapes.get(it))
            .map(Vec::as_slice)
            .unwrap_or_default();
        let element = element(item, shapes, &page).map_err(|what| refusal(drawing, item, &what))?;
        text.push_str(&element);
        open = Some(path);
    }
    if let Some(open) = open {
        (0..open.len().max(1)).for_each(|_| text.push_str("</g>\n"));
    }
    text.push_str("</svg>\n");
    Ok(text.into_bytes())
}

/// The data of one path along everything that is drawn, with y going down as in SVG and numbers as they are.
pub(super) fn data(drawing: &Drawing) -> Result<String, Unreadable> {
    let mirrored = Affine {
        linear: DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0)),
        origin: DVec3::ZERO,
    };
    let mut text = String::new();
    for item in &drawing.items {
        let shapes = item.shapes.iter().cloned();
        let shapes: Vec<Shape> = shapes.map(|shape| shape.placed(&mirrored)).collect();
        check(&shapes).map_err(|what| refusal(drawing, item, &what))?;
        let page = Page::around(shapes.iter());
        let data = path_data(&shapes, &page, false);
        text += &data.map_err(|what| refusal(drawing, item, &what))?;
    }
    Ok(text)
}

/// The page around all shapes, in millimetres.
struct Page {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Page {
    fn around<'s>(shapes: impl Iterator<Item = &'s Shape>) -> Self {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for point in shapes.flat_map(hull).filter(|it| it.is_finite()) {
            (low, high) = (low.min(point), high.max(point));
        }
        if low.x > high.x {
            (low, high) = (DVec3::ZERO, DVec3::new(210.0, 297.0, 0.0));
        }
        let margin = (0.05 * (high - low).max_element()).max(1.0);
        let (low, high) = ((low - margin).floor(), (high + margin).ceil());
        let (mut left, top) = (low.x, high.y);
        // A view box that begins at 0 0 would move the origin to the lower left corner.
        if left == 0.0 && top == 0.0 {
            left = -1.0;
        }
        Self {
            left,
            top,
            width: (high.x - left).max(1.0),
            height: (high.y - low.y).max(1.0),
        }
    }

    fn size(&self) -> f64 {
        self.width.max(self.height)
    }
}

/// The data of a path.
struct PathData {
    text: String,
    /// The start of the subpath.
    start: DVec3,
    /// The end of what is drawn, if the subpath goes on.
    end: Option<DVec3>,
    /// How near points count as one beside an arc.
    gap: f64,
    /// Whether they count as one beside every piece.
    joins: bool,
}

impl PathData {
    fn add(&mut self, piece: &Piece, next: Option<DVec3>) -> Result<(), String> {
        let start = piece.start().ok_or("a spline of implied points")?;
        let near = |it: DVec3| {
            let is_joined = self.joins || matches!(piece, Piece::Arc(_));
            it == start || (is_joined && it.distance(start) <= self.gap)
        };
        if !self.end.is_some_and(near) {
            self.step("M", &[start]);
            self.start = start;
        }
        match piece {
            Piece::Lines { points, closed } => {
                for &point in points.iter().skip(1) {
                    self.step("L", &[point]);
                }
                if *closed {
                    self.text.push('Z');
                    self.end = None;
                }
            }
            Piece::Cubic(points) => self.step("C", points.get(1..).unwrap_or_default()),
            Piece::Quadratic(points) if points.len() == 3 => {
                self.step("Q", points.get(1..).unwrap_or_default());
            }
            Piece::Quadratic(_) | Piece::Ring(_) => {
                return Err("a spline of implied points".to_owned());
            }
            Piece::Arc(conic) => self.arc(conic, next),
        }
        Ok(())
    }

    fn step(&mut self, command: &str, points: &[DVec3]) {
        self.text.push_str(command);
        for (index, point) in points.iter().enumerate() {
            let space = if index == 0 { "" } else { " " };
            // Writing to a string cannot fail.
            let _ = write!(self.text, "{space}{} {}", number(point.x), number(point.y));
            self.end = Some(*point);
        }
    }

    fn arc(&mut self, conic: &Conic, next: Option<DVec3>) {
        let (rx, ry, degrees) = axes(conic);
        let sweep = u8::from(conic.x.x * conic.y.y - conic.x.y * conic.y.x > 0.0);
        let span = conic.to - conic.from;
        let parts = (span / ARC_LIMIT).ceil().clamp(1.0, 4.0);
        let end = at(conic, conic.to);
        let neighbours = [next, Some(self.start)];
        let snapped = neighbours
            .into_iter()
            .flatten()
            .find(|it| it.distance(end) <= self.gap);
        for part in 1..=parts as usize {
            let _ = write!(
                self.text,
                "A{} {} {} 0 {sweep} ",
                number(rx),
                number(ry),
                number(degrees)
            );
            let end = if part == parts as usize {
                snapped.unwrap_or(end)
            } else {
                at(conic, conic.from + span * part as f64 / parts)
            };
            self.step("", &[end]);
        }
    }
}

fn scaled(drawing: &Drawing, item: &Item) -> Vec<Shape> {
    let unit = drawing.unit.unwrap_or(1.0);
    if unit == 1.0 {
        return item.shapes.clone();
    }
    let place = Affine {
        linear: DMat3::from_diagonal(DVec3::splat(unit)),
        origin: DVec3::ZERO,
    };
    item.shapes
        .iter()
        .map(|it| it.clone().placed(&place))
        .collect()
}

/// Order items such that each group is in one place, each with its path of groups.
fn layered(drawing: &Drawing) -> Vec<(&Item, Vec<String>)> {
    let mut numbers = HashMap::new();
    let mut items: Vec<_> = drawing
        .items
        .iter()
        .map(|item| {
            let path = shortened(&item.group);
            let key: Vec<usize> = (1..=path.len())
                .map(|length| {
                    let next = numbers.len();
                    *numbers
                        .entry(path.get(..length).unwrap_or_default().to_vec())
                        .or_insert(next)
                })
                .collect();
            (key, item, path)
        })
        .collect();
    items.sort_by(|a, b| a.0.cmp(&b.0));
    items
        .into_iter()
        .map(|(_, item, path)| (item, path))
        .collect()
}

/// The path of a group, its innermost names joined where there are too many.
pub(super) fn shortened(group: &[String]) -> Vec<String> {
    let (outer, inner) = group.split_at(group.len().min(DEPTH_LIMIT - 1));
    let mut path = outer.to_vec();
    if !inner.is_empty() {
        path.push(inner.join("/"));
    }
    path
}

/// Close and open groups to come from one path to another. Within the outermost group, which mirrors, each
/// name of the path is a layer.
fn enter(text: &mut String, from: Option<&[String]>, to: &[String], page: &Page) {
    let common = |from: &[String]| from.iter().zip(to).take_while(|(a, b)| a == b).count();
    let shared = from.map_or(0, common);
    let mut same_top = false;
    if let Some(from) = from {
        same_top = shared > 0 || (from.is_empty() && to.is_empty());
        let groups = from.len().max(1) - shared.max(usize::from(same_top));
        (0..groups).for_each(|_| text.push_str("</g>\n"));
    }
    let top = format!(
        " transform=\"scale(1,-1)\" fill=\"none\" stroke=\"#000000\" stroke-width=\"{}\"",
        number(0.0005 * page.size())
    );
    if to.is_empty() && !same_top {
        let _ = writeln!(text, "<g{top}>");
    }
    for (index, name) in to.iter().enumerate().skip(shared) {
        let top = if index == 0 { top.as_str() } else { "" };
        let name = escaped(name);
        let _ = writeln!(
            text,
            "<g inkscape:groupmode=\"layer\" inkscape:label=\"{name}\"{top}>"
        );
    }
}

/// Refuse what SVG cannot hold.
fn check(shapes: &[Shape]) -> Result<(), String> {
    for point in shapes.iter().flat_map(hull) {
        if !point.is_finite() {
            return Err("a curve with numbers that are not finite".to_owned());
        }
        if point.z != 0.0 {
            return Err("a curve outside of the plane z = 0".to_owned());
        }
    }
    Ok(())
}

fn element(item: &Item, shapes: &[Shape], page: &Page) -> Result<String, String> {
    check(shapes)?;
    let name = item.name.as_ref();
    let name = name.map(|it| format!(" inkscape:label=\"{}\"", escaped(it)));
    let stroke = item
        .colour
        .map(|[r, g, b]| format!(" stroke=\"#{r:02x}{g:02x}{b:02x}\""));
    let attributes = format!("{}{}", name.unwrap_or_default(), stroke.unwrap_or_default());
    if let [Shape::Conic(conic)] = shapes
        && is_upright(conic)
    {
        let (centre, rx, ry) = (conic.centre, number(conic.x.x), number(conic.y.y));
        let (cx, cy) = (number(centre.x), number(centre.y));
        return Ok(format!(
            "<ellipse{attributes} cx=\"{cx}\" cy=\"{cy}\" rx=\"{rx}\" ry=\"{ry}\"/>\n"
        ));
    }
    Ok(format!(
        "<path{attributes} d=\"{}\"/>\n",
        path_data(shapes, page, false)?
    ))
}

/// Say what an item is that SVG cannot hold.
pub(super) fn holds(item: &Item) -> Result<(), String> {
    check(&item.shapes)?;
    for piece in item.shapes.iter().map(pieces) {
        for piece in piece? {
            piece.start().ok_or("a spline of implied points")?;
            if matches!(piece, Piece::Quadratic(points) if points.len() != 3) {
                return Err("a spline of implied points".to_owned());
            }
        }
    }
    Ok(())
}

/// The data of one subpath along some shapes as they are. Ends of neighbours that differ by rounding are joined.
pub(super) fn subpath(shapes: &[Shape]) -> Result<String, String> {
    check(shapes)?;
    path_data(shapes, &Page::around(shapes.iter()), true)
}

fn path_data(shapes: &[Shape], page: &Page, joins: bool) -> Result<String, String> {
    let mut parts = Vec::new();
    for shape in shapes {
        parts.extend(pieces(shape)?);
    }
    let mut data = PathData {
        text: String::new(),
        start: DVec3::ZERO,
        end: None,
        gap: match joins {
            true => JOINT * page.size(),
            false => GAP * page.size(),
        },
        joins,
    };
    for (index, piece) in parts.iter().enumerate() {
        let next = parts.get(index + 1).and_then(Piece::start);
        data.add(piece, next)?;
    }
    let is_chain = matches!(parts.as_slice(), [Piece::Lines { .. }]);
    let closes = |end: DVec3| end == data.start || (joins && end.distance(data.start) <= data.gap);
    if !is_chain && data.end.is_some_and(closes) {
        data.text.push('Z');
    }
    Ok(data.text)
}

/// Whether an ellipse is whole, begins at its right and has axes along those of the page.
fn is_upright(conic: &Conic) -> bool {
    let (x, y) = (conic.x, conic.y);
    conic.is_whole() && conic.from == 0.0 && x.y == 0.0 && y.x == 0.0 && x.x > 0.0 && y.y > 0.0
}

/// Find the principal half-axes of an ellipse, and the direction of the first in degrees.
fn axes(conic: &Conic) -> (f64, f64, f64) {
    let (x, y) = (conic.x, conic.y);
    let (long, wide) = (x.length(), y.length());
    let skew = x.dot(y);
    let (x, y) = if skew.abs() <= 1e-15 * long * wide {
        (x, y)
    } else {
        let (sin, cos) = (0.5 * (2.0 * skew).atan2((long - wide) * (long + wide))).sin_cos();
        (cos * x + sin * y, cos * y - sin * x)
    };
    (x.length(), y.length(), x.y.atan2(x.x).to_degrees())
}

/// Write a number such that it is read as the same; very large and small ones with an exponent.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 || (1e-5..1e15).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:?}")
    }
}

fn refusal(drawing: &Drawing, item: &Item, what: &str) -> Unreadable {
    Unreadable {
        at: None,
        reason: format!(
            "{} is {what}, which SVG cannot hold: approximate it by plane cubic Bézier curves before",
            described(drawing, item)
        ),
    }
}
