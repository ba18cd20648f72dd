//! The walk through representations: free curves and points, and the edges of solids.

use std::cell::RefCell;
use std::collections::HashSet;

use super::curves::{Bounded, Curves};
use super::expansion::Placement;
use super::flaw::Flaw;
use super::instances::{Instance, Instances};
use super::placements::point;
use super::styles::{Style, Styles};
use super::text::decode;
use super::tokens::Params;
use crate::io::exchange::drawing::{Drawing, Item, Kind, Shape, Space};
use crate::io::exchange::remarks::Remarks;

/// How deep solids, shells, faces and loops may be nested.
const DEEPEST: usize = 64;

/// A walk through one representation.
pub struct Walk<'a, 'r> {
    /// The file.
    pub file: &'r Instances<'a>,
    /// The reader of its curves.
    pub curves: Curves<'a, 'r>,
    /// Layers and colours.
    pub styles: &'r Styles<'a>,
    /// Where the representation is placed.
    pub placements: &'r [Placement<'a>],
    /// Where to say what was skipped.
    pub remarks: &'r RefCell<Remarks>,
    /// Where items go.
    pub drawing: &'r mut Drawing,
    /// The edges, faces and shells that were seen: edges belong to two faces each.
    pub seen: HashSet<u64>,
    /// Whether the walk is within a set.
    pub in_set: bool,
}

/// What an instance is to this walk.
pub enum Role {
    /// A set of curves, points and surfaces.
    Set,
    /// A solid, a shell or a part of one.
    Topology,
    /// A wireframe: its edges are free curves.
    Wireframe,
    /// A curve.
    Curve,
    /// A point.
    Point,
    /// Nothing to show: it places other things.
    Placement,
    /// Anything else.
    Other,
}

impl<'a> Walk<'a, '_> {
    /// Take the items of a representation.
    pub fn items(&mut self, holder: &Instance<'a>, items: Params<'a>, style: Style<'a>) {
        for id in items.refs() {
            if self.is_full() {
                return;
            }
            match self.file.get(id) {
                Some(item) => self.item(&item, style),
                None => self.skip(Flaw::damaged(holder, &format!("#{id} in it is missing"))),
            }
        }
    }

    /// Take one item.
    pub fn item(&mut self, item: &Instance<'a>, outer: Style<'a>) {
        let style = self.styles.of(item.id, outer);
        match role(item) {
            Role::Placement => {}
            Role::Set => self.set(item, style),
            Role::Topology => {
                self.drawing.count_other(item.name(), item.line);
                self.topology(item, style, Space::Edge, 0);
            }
            Role::Wireframe => self.topology(item, style, Space::Model, 0),
            Role::Curve => self.curve(item, style),
            Role::Point => self.point(item, style),
            Role::Other => self.drawing.count_other(item.name(), item.line),
        }
    }

    /// Whether no more items can be taken.
    pub fn is_full(&self) -> bool {
        self.file.is_exhausted() || self.drawing.items.len() >= self.file.most_items()
    }

    /// Take the elements of a set; a set in a set is damage, or it holds itself.
    fn set(&mut self, set: &Instance<'a>, style: Style<'a>) {
        if self.in_set {
            self.skip(Flaw::damaged(set, "it is in a set itself"));
            return;
        }
        self.in_set = true;
        let [_, elements] = set.named_params::<2>(set.name());
        self.items(set, elements.list().unwrap_or_default(), style);
        self.in_set = false;
    }

    fn curve(&mut self, curve: &Instance<'a>, style: Style<'a>) {
        match self.file.lending(|| self.curves.bounded(curve)) {
            Ok(found) => self.emit(curve, style, Space::Model, found),
            Err(flaw) => self.skip(flaw),
        }
    }

    fn point(&mut self, point_of: &Instance<'a>, style: Style<'a>) {
        let vertex = self.curves.vertex(point_of.id);
        match vertex.or_else(|| point(self.file, point_of.id)) {
            Some(point) => {
                let found = Bounded {
                    kind: Kind::Point,
                    name: point_of.label(),
                    shapes: vec![Shape::Point(point)],
                };
                self.emit(point_of, style, Space::Model, found);
            }
            None => self.skip(Flaw::damaged(point_of, "its coordinates are damaged")),
        }
    }

    fn topology(&mut self, part: &Instance<'a>, outer: Style<'a>, space: Space, depth: usize) {
        if !self.seen.insert(part.id) || self.is_full() {
            return;
        }
        if depth > DEEPEST {
            self.skip(Flaw::damaged(part, "solids are nested more than 64 deep"));
            return;
        }
        let style = self.styles.of(part.id, outer);
        if part.is("EDGE_CURVE") {
            match self.file.lending(|| self.curves.edge(part)) {
                Ok(found) => self.emit(part, style, space, found),
                Err(flaw) => self.skip(flaw),
            }
            return;
        }
        match part.name() {
            "POLY_LOOP" => self.poly_loop(part, style, space),
            "VERTEX_POINT" if space == Space::Model => self.point(part, style),
            _ => {
                for id in part.references() {
                    match self.file.get(id) {
                        Some(inner) if is_topology(&inner) => {
                            self.topology(&inner, style, space, depth + 1)
                        }
                        Some(_) => {}
                        None => self.skip(Flaw::damaged(part, &format!("#{id} in it is missing"))),
                    }
                }
            }
        }
    }

    fn poly_loop(&mut self, part: &Instance<'a>, style: Style<'a>, space: Space) {
        let points: Option<Vec<_>> = part.references().map(|id| point(self.file, id)).collect();
        match points.filter(|points| points.len() > 1) {
            Some(points) => {
                let found = Bounded {
                    kind: Kind::Polyline,
                    name: part.label(),
                    shapes: vec![Shape::Polyline {
                        points,
                        closed: true,
                    }],
                };
                self.emit(part, style, space, found);
            }
            None => self.skip(Flaw::damaged(part, "its points are damaged")),
        }
    }

    fn emit(
        &mut self,
        instance: &Instance<'a>,
        style: Style<'a>,
        space: Space,
        found: Bounded<'a>,
    ) {
        let name = found
            .name
            .map(decode)
            .filter(|name| !name.trim().is_empty());
        let size: usize = found.shapes.iter().map(Shape::memory).sum();
        let mut own = Some(found.shapes);
        for (left, placement) in (0..self.placements.len()).rev().zip(self.placements) {
            if self.is_full() {
                return;
            }
            if !self.file.spend(size) {
                return self.skip(Flaw::too_large(instance));
            }
            // The last placement takes the shapes themselves: there may be millions.
            let shapes = match left {
                0 => own.take(),
                _ => own.clone(),
            };
            let place = |shape: Shape| match &placement.place {
                Some(place) => shape.placed(place),
                None => shape,
            };
            let shapes: Vec<Shape> = shapes.into_iter().flatten().map(place).collect();
            if !shapes.iter().all(is_finite) {
                self.skip(Flaw::damaged(
                    instance,
                    "its coordinates are beyond all numbers",
                ));
                continue;
            }
            let style = style.within(placement.style);
            let item = Item {
                kind: found.kind,
                shapes,
                group: self.drawing.path(&style.group()),
                name: name.clone(),
                block: placement.block.clone(),
                colour: style.colour,
                hidden: false,
                space,
                at: instance.line,
            };
            if !self.file.spend(item.own_memory(self.drawing.items.last())) {
                return self.skip(Flaw::too_large(instance));
            }
            self.drawing.items.push(item);
        }
    }

    /// Tell that something is skipped. What is missing at the limit of work has no other cause, and that is told.
    fn skip(&mut self, flaw: Flaw) {
        match flaw {
            _ if self.file.is_exhausted() => {}
            Flaw::TooLarge { line, entity } => self.remarks.borrow_mut().add_at(
                line,
                &entity,
                "the file needs too much memory, skipped",
            ),
            Flaw::Damaged {
                line,
                entity,
                reason,
            } => {
                self.remarks
                    .borrow_mut()
                    .add_at(line, &entity, &format!("{reason}, skipped"));
            }
            Flaw::Unknown { line, entity } => self.drawing.count_other(&entity, line),
        }
    }
}

/// Say what an instance is by its name.
pub fn role(item: &Instance) -> Role {
    match item.name() {
        "MAPPED_ITEM" | "AXIS1_PLACEMENT" | "AXIS2_PLACEMENT_2D" | "AXIS2_PLACEMENT_3D" => {
            Role::Placement
        }
        "GEOMETRIC_CURVE_SET" | "GEOMETRIC_SET" => Role::Set,
        "CARTESIAN_POINT" | "VERTEX_POINT" => Role::Point,
        "EDGE_BASED_WIREFRAME_MODEL"
        | "SHELL_BASED_WIREFRAME_MODEL"
        | "CONNECTED_EDGE_SET"
        | "WIRE_SHELL"
        | "VERTEX_SHELL" => Role::Wireframe,
        "LINE" | "CIRCLE" | "ELLIPSE" | "PARABOLA" | "HYPERBOLA" | "POLYLINE"
        | "OFFSET_CURVE_3D" => Role::Curve,
        name if name.ends_with("_CURVE") || name.starts_with("B_SPLINE_CURVE") => {
            if is_topology(item) {
                Role::Topology
            } else {
                Role::Curve
            }
        }
        "COMPOSITE_CURVE_ON_SURFACE" | "CURVE_REPLICA" | "PCURVE" | "RATIONAL_B_SPLINE_CURVE" => {
            Role::Curve
        }
        _ if is_topology(item) => Role::Topology,
        _ => Role::Other,
    }
}

fn is_topology(part: &Instance) -> bool {
    const NAMES: [&str; 31] = [
        "MANIFOLD_SOLID_BREP",
        "BREP_WITH_VOIDS",
        "FACETED_BREP",
        "SHELL_BASED_SURFACE_MODEL",
        "FACE_BASED_SURFACE_MODEL",
        "CONNECTED_FACE_SET",
        "CONNECTED_FACE_SUB_SET",
        "CLOSED_SHELL",
        "OPEN_SHELL",
        "ORIENTED_CLOSED_SHELL",
        "ORIENTED_OPEN_SHELL",
        "ADVANCED_FACE",
        "FACE_SURFACE",
        "FACE",
        "SUBFACE",
        "ORIENTED_FACE",
        "FACE_BOUND",
        "FACE_OUTER_BOUND",
        "EDGE_LOOP",
        "POLY_LOOP",
        "VERTEX_LOOP",
        "PATH",
        "OPEN_PATH",
        "ORIENTED_PATH",
        "ORIENTED_EDGE",
        "EDGE_CURVE",
        "VERTEX_POINT",
        "CONNECTED_EDGE_SET",
        "CONNECTED_EDGE_SUB_SET",
        "WIRE_SHELL",
        "VERTEX_SHELL",
    ];
    part.parts().any(|(name, _)| NAMES.contains(&name))
}

fn is_finite(shape: &Shape) -> bool {
    match shape {
        Shape::Nurbs(nurbs) => {
            let weights = nurbs
                .weights
                .iter()
                .flatten()
                .all(|it| it.is_finite() && *it > 0.0);
            nurbs.points.iter().all(|it| it.is_finite()) && weights
        }
        Shape::Conic(conic) => {
            let axes = [conic.centre, conic.x, conic.y]
                .iter()
                .all(|it| it.is_finite());
            axes && conic.from.is_finite() && conic.to.is_finite() && conic.from < conic.to
        }
        Shape::Polyline { points, .. } => points.iter().all(|it| it.is_finite()),
        Shape::Point(point) => point.is_finite(),
    }
}
