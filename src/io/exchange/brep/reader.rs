//! The walk from a file's root shape to its edges.

use std::collections::HashSet;
use std::rc::Rc;

use glam::DVec3;

use super::curves::Curve;
use super::spending::Spending;
use super::spline_part::is_finite;
use super::tokens::Tokens;
use super::topology::{self, Content, Edge, Part, Reference};
use crate::io::exchange::drawing::{Affine, Drawing, Item, Kind, Shape, Space, Unreadable};

/// How deep compounds may nest.
const NESTING: usize = 64;

/// What the visit of a shape costs, in bytes of work.
const VISIT: u64 = 64;

/// Remarks kept: a damaged file would otherwise give one for each of its edges.
const REMARKS: usize = 1000;

/// Read a BREP file. The format has no units: programs take millimetres.
///
/// # Errors
/// [`Unreadable`] for binary files, where locations are damaged, and where nothing stands before the damage.
pub fn read(bytes: &[u8]) -> Result<Drawing, Unreadable> {
    let mut from = Tokens::of(bytes);
    let version = version(&mut from)?;
    section(&mut from, b"Locations")?;
    let locations = topology::locations(&mut from)?;
    section(&mut from, b"Curves")?;
    let (curves, damage) = curves(&mut from);
    let shapes = section(&mut from, b"TShapes");
    let mut counting = from.clone();
    let count = counting.count().unwrap_or_default();
    let (parts, damage_of_parts) = match &shapes {
        Ok(()) => topology::parts(&mut from, version),
        Err(_) => (Vec::new(), None),
    };
    let mut reader = Reader {
        locations,
        curves,
        parts,
        drawing: Drawing {
            unit: Some(1.0),
            ..Drawing::of_file(bytes.len())
        },
        spending: Spending::of_file(bytes.len()),
        boundaries: HashSet::new(),
        untold: 0,
    };
    if let Err(missing) = shapes {
        let damage = damage.unwrap_or(missing);
        reader.draw_curves(&damage);
        return match reader.drawing.items.is_empty() {
            true => Err(damage),
            false => Ok(reader.finish()),
        };
    }
    if let Some(Unreadable { at, reason }) = &damage {
        let known = reader.curves.len();
        let told = format!("{reason}; the curves behind number {known} are missing");
        reader.remark(at.unwrap_or_default(), &told);
    }
    let root = match damage_of_parts {
        None => topology::reference(&mut from, reader.parts.len(), count),
        Some(damage) => Err(damage),
    };
    match root {
        Ok(Some(root)) => reader.draw(root, &Affine::default(), Space::Model, 0),
        Ok(None) => {}
        Err(damage) => reader.draw_unplaced(&damage),
    }
    match damage {
        Some(damage) if reader.drawing.items.is_empty() => Err(damage),
        _ => Ok(reader.finish()),
    }
}

fn version(from: &mut Tokens) -> Result<u32, Unreadable> {
    let mut start = from.clone();
    while let Some(word) = start.next() {
        match word {
            b"V1," => return Ok(1),
            b"V2," => return Ok(2),
            b"V3," => return Ok(3),
            b"Locations" => break,
            _ if word.starts_with(b"Open") && start.line() <= 1 => {
                return Err(unreadable("binary BREP; save it as text"));
            }
            _ => {}
        }
    }
    Err(unreadable(
        "no line \"CASCADE Topology V1\" to V3; this is no BREP file in text",
    ))
}

fn unreadable(reason: &str) -> Unreadable {
    Unreadable {
        at: Some(1),
        reason: reason.to_owned(),
    }
}

fn section(from: &mut Tokens, name: &[u8]) -> Result<(), Unreadable> {
    if from.skip_to(name) {
        return Ok(());
    }
    Err(from.fault(&format!("section {}", String::from_utf8_lossy(name)), None))
}

/// Read the curves up to the first damage.
fn curves(from: &mut Tokens) -> (Vec<Curve>, Option<Unreadable>) {
    let mut curves = Vec::new();
    let mut read = || {
        for _ in 0..from.count()? {
            curves.push(Curve::read(from)?);
        }
        Ok(())
    };
    let damage = read().err();
    (curves, damage)
}

struct Reader {
    locations: Vec<Affine>,
    curves: Vec<Curve>,
    parts: Vec<Part>,
    drawing: Drawing,
    spending: Spending,
    /// The edges of faces that were drawn, with their places: two faces share each.
    boundaries: HashSet<(usize, [u64; 12])>,
    untold: usize,
}

impl Reader {
    fn draw(&mut self, shape: Reference, outer: &Affine, space: Space, depth: usize) {
        let (Some(part), Some(own)) = (
            self.parts.get(shape.part()),
            self.locations.get(shape.location()),
        ) else {
            self.drawing.remarks.push(format!(
                "location {} is missing; a shape is skipped",
                shape.location()
            ));
            return;
        };
        self.spending.work(VISIT);
        let (place, line, children) = (outer.of(own), part.line, Rc::clone(&part.children));
        let space = if matches!(part.content, Content::Face) {
            Space::Edge
        } else {
            space
        };
        match part.content {
            Content::Vertex(point) => {
                if space == Space::Model {
                    self.add(
                        Kind::Point,
                        vec![Shape::Point(place.point(point))],
                        space,
                        line,
                    );
                }
            }
            Content::Edge(_) => self.draw_edge(shape.part(), &place, space, line),
            Content::Wire if space == Space::Model => self.draw_wire(&children, &place, line),
            _ if depth >= NESTING => self.remark(
                line,
                &format!("shapes nest more than {NESTING} deep; skipped"),
            ),
            _ => {
                for &child in children.iter() {
                    if self.spending.is_over() {
                        break;
                    }
                    self.draw(child, &place, space, depth + 1);
                }
            }
        }
    }

    fn draw_edge(&mut self, part: usize, place: &Affine, space: Space, line: u64) {
        if space == Space::Edge && !self.boundaries.insert((part, bits(place))) {
            return;
        }
        match self.edge(part, place) {
            Ok(Some((kind, shape))) => self.add(kind, vec![shape], space, line),
            Ok(None) => {}
            Err(reason) => self.remark(line, &format!("edge: {reason}; skipped")),
        }
    }

    /// A wire of its own: one polyline or polycurve.
    fn draw_wire(&mut self, children: &[Reference], outer: &Affine, line: u64) {
        let mut pieces: Vec<(Kind, Shape)> = Vec::new();
        for child in children {
            if self.spending.is_over() {
                return;
            }
            let Some(own) = self.locations.get(child.location()) else {
                continue;
            };
            match self.edge(child.part(), &outer.of(own)) {
                Ok(Some((kind, shape))) => {
                    let shape = if child.is_reversed {
                        shape.reversed()
                    } else {
                        shape
                    };
                    self.spending.keep_shape(&shape);
                    if !joins(&mut pieces, &shape) {
                        pieces.push((kind, shape));
                    }
                }
                Ok(None) => {}
                Err(reason) => self.remark(line, &format!("edge of a wire: {reason}; skipped")),
            }
        }
        for (_, shape) in &mut pieces {
            close(shape);
        }
        let kind = match pieces.as_slice() {
            [] => return,
            [(kind, Shape::Polyline { points, .. })] if points.len() == 2 => *kind,
            [(_, Shape::Polyline { .. })] => Kind::Polyline,
            [(kind, _)] => *kind,
            _ => Kind::Polycurve,
        };
        let shapes = pieces.into_iter().map(|(_, shape)| shape).collect();
        self.keep(kind, shapes, Space::Model, line);
    }

    /// Give the part of its curve that an edge takes; `None` for points on surfaces.
    fn edge(&self, index: usize, place: &Affine) -> Result<Option<(Kind, Shape)>, String> {
        let Some(Part {
            content: Content::Edge(edge),
            children,
            ..
        }) = self.parts.get(index)
        else {
            return Err("a shape that is no edge".to_owned());
        };
        let Edge {
            curve,
            is_degenerate,
        } = edge;
        let Some((number, location, from, to)) = *curve else {
            return if *is_degenerate {
                Ok(None)
            } else {
                Err("it has no curve in space".to_owned())
            };
        };
        let curve = number
            .checked_sub(1)
            .and_then(|index| self.curves.get(index));
        let curve = curve.ok_or_else(|| format!("curve {number} is missing"))?;
        let own = self.locations.get(location);
        let own = own.ok_or_else(|| format!("location {location} is missing"))?;
        let (kind, shape) = curve.part(from, to)?;
        let mut shape = shape.placed(own);
        if let (Curve::Line { .. }, Shape::Polyline { points, .. }) = (curve, &mut shape) {
            self.take_vertices(points, children);
        }
        let shape = shape.placed(place);
        if !is_finite(&shape) {
            return Err("its numbers are too large".to_owned());
        }
        Ok(Some((kind, shape)))
    }

    /// Take the ends of a segment from its vertices, which do not suffer from the unit direction's rounding.
    fn take_vertices(&self, points: &mut [DVec3], children: &[Reference]) {
        let [first, last] = points else {
            return;
        };
        let near = 1.0e-9 * first.distance(*last);
        for child in children {
            let Some(Part {
                content: Content::Vertex(point),
                ..
            }) = self.parts.get(child.part())
            else {
                continue;
            };
            let Some(place) = self.locations.get(child.location()) else {
                continue;
            };
            let (point, end) = (
                place.point(*point),
                if child.is_reversed {
                    &mut *last
                } else {
                    &mut *first
                },
            );
            if point.distance(*end) <= near {
                *end = point;
            }
        }
    }

    /// Keep what a cut-off file has: edges without the places that shapes behind them would give.
    fn draw_unplaced(&mut self, damage: &Unreadable) {
        for index in 0..self.parts.len() {
            let Some(line) = self.parts.get(index).map(|part| part.line) else {
                break;
            };
            if matches!(
                self.parts.get(index),
                Some(Part {
                    content: Content::Edge(_),
                    ..
                })
            ) {
                self.draw_edge(index, &Affine::default(), Space::Model, line);
            }
        }
        let (line, reason) = (damage.at.unwrap_or_default(), &damage.reason);
        self.remark(
            line,
            &format!("{reason}; the edges before are kept without their places"),
        );
    }

    /// Keep the curves of a file that ends before its shapes, as far as they are not infinite.
    fn draw_curves(&mut self, damage: &Unreadable) {
        let (line, reason) = (damage.at.unwrap_or_default(), &damage.reason);
        for curve in std::mem::take(&mut self.curves) {
            match curve.whole() {
                Some(Ok((kind, shape))) => self.add(kind, vec![shape], Space::Model, line),
                Some(Err(reason)) => self.remark(line, &format!("a curve: {reason}; skipped")),
                None => {}
            }
        }
        let told = format!("{reason}; the curves before are kept whole, without their places");
        self.remark(line, &told);
    }

    fn add(&mut self, kind: Kind, shapes: Vec<Shape>, space: Space, line: u64) {
        for shape in &shapes {
            self.spending.keep_shape(shape);
        }
        self.keep(kind, shapes, space, line);
    }

    fn keep(&mut self, kind: Kind, shapes: Vec<Shape>, space: Space, line: u64) {
        let item = Item {
            space,
            at: line,
            ..Item::new(kind, shapes)
        };
        if self.spending.keep(&item, self.drawing.items.last()) {
            self.drawing.items.push(item);
        }
    }

    fn remark(&mut self, line: u64, reason: &str) {
        if self.drawing.remarks.len() < REMARKS {
            self.drawing.remarks.push(format!("line {line}: {reason}"));
        } else {
            self.untold += 1;
        }
    }

    fn finish(mut self) -> Drawing {
        if self.spending.is_over() {
            let reason = self.spending.reason();
            self.drawing
                .remarks
                .push(format!("{reason}; the rest is left out"));
        }
        if self.untold > 0 {
            self.drawing
                .remarks
                .push(format!("{} more remarks", self.untold));
        }
        self.drawing
    }
}

fn bits(place: &Affine) -> [u64; 12] {
    let mut all = [0; 12];
    let numbers = place
        .linear
        .to_cols_array()
        .into_iter()
        .chain(place.origin.to_array());
    for (bits, number) in all.iter_mut().zip(numbers) {
        *bits = number.to_bits();
    }
    all
}

/// Append a segment to the polyline that ends where it begins.
fn joins(pieces: &mut [(Kind, Shape)], shape: &Shape) -> bool {
    let Some((_, Shape::Polyline { points, .. })) = pieces.last_mut() else {
        return false;
    };
    let Shape::Polyline { points: next, .. } = shape else {
        return false;
    };
    if points.last() != next.first() {
        return false;
    }
    points.extend(next.iter().skip(1));
    true
}

/// Close a polyline that ends where it begins.
fn close(shape: &mut Shape) {
    if let Shape::Polyline { points, closed } = shape
        && points.len() > 3
        && points.first() == points.last()
    {
        points.pop();
        *closed = true;
    }
}
