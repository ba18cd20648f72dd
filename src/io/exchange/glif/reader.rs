//! Reads glyphs.

use glam::DVec3;
use roxmltree::{Document, Node, NodeId};

use super::super::pieces::Pieces;
use super::super::remarks::Remarks;
use crate::io::exchange::drawing::{Drawing, Item, Kind, Nurbs, Shape, Unreadable};
use crate::io::exchange::short_names::short;
use crate::io::xml::Source;

/// Read the contours of a glyph. Returns also the element that each item comes from.
pub(super) fn read(
    source: &Source,
    document: &Document,
) -> Result<(Drawing, Vec<NodeId>), Unreadable> {
    let root = document.root_element();
    if root.tag_name().name() != "glyph" {
        return Err(Unreadable {
            at: Some(source.line_of(root)),
            reason: format!("this is no glyph: its root is <{}>", root.tag_name().name()),
        });
    }
    let mut reader = Reader {
        source,
        name: root.attribute("name").filter(|it| !it.is_empty()),
        drawing: Drawing::default(),
        places: Vec::new(),
        remarks: Remarks::default(),
    };
    source
        .remarks
        .iter()
        .for_each(|it| reader.remarks.add(it.clone()));
    for node in root.children().filter(Node::is_element) {
        match node.tag_name().name() {
            "outline" => reader.outline(node),
            "anchor" | "guideline" | "image" => reader.count(node, node.tag_name().name()),
            _ => {}
        }
    }
    reader.drawing.remarks = reader.remarks.finish();
    Ok((reader.drawing, reader.places))
}

struct Reader<'d> {
    source: &'d Source,
    /// The name of the glyph.
    name: Option<&'d str>,
    drawing: Drawing,
    /// The elements of the items.
    places: Vec<NodeId>,
    remarks: Remarks,
}

/// A point of a contour.
#[derive(Clone, Copy)]
struct Corner {
    at: DVec3,
    role: Role,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Move,
    Line,
    Curve,
    Quadratic,
    OffCurve,
}

impl Reader<'_> {
    fn outline(&mut self, outline: Node) {
        for node in outline.children().filter(Node::is_element) {
            match node.tag_name().name() {
                "contour" => self.contour(node),
                "component" => {
                    let base = node.attribute("base").unwrap_or_default();
                    self.count(node, &format!("component {base}"));
                }
                name => self.count(node, name),
            }
        }
    }

    fn count(&mut self, node: Node, kind: &str) {
        self.drawing.count_other(kind, self.source.line_of(node));
    }

    fn contour(&mut self, node: Node) {
        let points = node.children().filter(|it| it.has_tag_name("point"));
        let corners = match points
            .map(|it| self.corner(it))
            .collect::<Result<Vec<_>, _>>()
        {
            Ok(corners) => corners,
            Err(reason) => return self.remark(node, &format!("it is skipped because {reason}")),
        };
        let shapes = match corners.as_slice() {
            [] => return self.remark(node, "it is skipped because it has no points"),
            // Anchors of UFO 2 are contours of one point.
            [
                Corner {
                    role: Role::Move, ..
                },
            ] => return self.count(node, "anchor"),
            [_] => return self.remark(node, "it is skipped because it has one point alone"),
            [
                Corner {
                    role: Role::Move,
                    at,
                },
                rest @ ..,
            ] => self.open(node, *at, rest),
            _ => self.closed(node, &corners),
        };
        if shapes.is_empty() {
            return self.remark(node, "it is skipped because nothing of it is a curve");
        }
        self.places.push(node.id());
        self.drawing.items.push(Item {
            name: self.name.map(short),
            at: self.source.line_of(node),
            ..Item::new(Kind::Path, shapes)
        });
    }

    fn corner(&self, node: Node) -> Result<Corner, String> {
        let line = self.source.line_of(node);
        let number = |name| {
            let number = node
                .attribute(name)
                .and_then(|it| it.trim().parse::<f64>().ok());
            number
                .filter(|it| it.is_finite())
                .ok_or_else(|| format!("the point in line {line} has no {name}"))
        };
        let role = match node.attribute("type") {
            None | Some("offcurve") => Role::OffCurve,
            Some("move") => Role::Move,
            Some("line") => Role::Line,
            Some("curve") => Role::Curve,
            Some("qcurve") => Role::Quadratic,
            Some(other) => return Err(format!("the type “{other}” in line {line} is unknown")),
        };
        Ok(Corner {
            at: DVec3::new(number("x")?, number("y")?, 0.0),
            role,
        })
    }

    fn open(&mut self, node: Node, start: DVec3, rest: &[Corner]) -> Vec<Shape> {
        let mut pieces = Pieces::new(start);
        self.draw(node, &mut pieces, rest.iter());
        pieces.finish()
    }

    fn closed(&mut self, node: Node, corners: &[Corner]) -> Vec<Shape> {
        let Some(first) = corners.iter().position(|it| it.role != Role::OffCurve) else {
            return ring(corners).into_iter().collect();
        };
        let (before, from) = corners.split_at(first);
        let Some((start, rest)) = from.split_first() else {
            return Vec::new();
        };
        let mut pieces = Pieces::new(start.at);
        let turn = rest.iter().chain(before);
        if start.role == Role::Line && corners.iter().all(|it| it.role == Role::Line) {
            self.draw(node, &mut pieces, turn);
            pieces.close();
        } else {
            self.draw(node, &mut pieces, turn.chain([start]));
        }
        pieces.finish()
    }

    fn draw<'c>(
        &mut self,
        node: Node,
        pieces: &mut Pieces,
        corners: impl Iterator<Item = &'c Corner>,
    ) {
        let mut run: Vec<DVec3> = Vec::new();
        for corner in corners {
            run.push(corner.at);
            let off_curve = run.len() - 1;
            match corner.role {
                Role::OffCurve => continue,
                Role::Move => {
                    self.remark(node, "a point of type “move” within it is read as a line");
                    pieces.line(corner.at);
                }
                Role::Line => {
                    if off_curve > 0 {
                        self.remark(node, "off-curve points before a line are skipped");
                    }
                    pieces.line(corner.at);
                }
                Role::Curve | Role::Quadratic if off_curve == 0 => pieces.line(corner.at),
                // A single point before a cubic makes it a quadratic, as fontTools reads it.
                Role::Curve if off_curve > 1 => pieces.spline(3, &run),
                Role::Curve | Role::Quadratic => pieces.spline(2, &run),
            }
            run.clear();
        }
        if !run.is_empty() {
            self.remark(
                node,
                "off-curve points behind the last point on the curve are skipped",
            );
        }
    }

    fn remark(&mut self, node: Node, text: &str) {
        let line = self.source.line_of(node);
        self.remarks
            .add(format!("line {line}: <{}>: {text}", node.tag_name().name()));
    }
}

/// Make the closed spline of a contour without points on the curve.
fn ring(corners: &[Corner]) -> Option<Shape> {
    let count = corners.len();
    let (first, last) = (corners.first()?, corners.last()?);
    let mut points = vec![last.at];
    points.extend(corners.iter().map(|it| it.at));
    points.push(first.at);
    Some(Shape::Nurbs(Nurbs {
        degree: 2,
        knots: (0..count + 5).map(|it| it as f64 - 2.0).collect(),
        points,
        weights: None,
        periodic: true,
    }))
}
