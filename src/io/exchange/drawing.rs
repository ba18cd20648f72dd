//! What a file of another program holds: one model for every format of CAD and drawing programs.
//!
//! Readers make a [`Drawing`] of bytes, writers make bytes of a [`Drawing`]. A reader applies the placements of the
//! file (blocks, transforms, extrusions, assemblies), so that every point is where the user sees it.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::remarks::shortened;
use crate::io::error::{Place, Problem, ReadError};

/// An arc that misses so small an angle of a turn is a whole one.
const WHOLE: f64 = 1e-12;

/// So many kinds of what is no curve are named, the rest together.
const MOST_KINDS: usize = 200;

/// The name of the rest.
const REST: &str = "of other kinds";

/// Everything that was found in a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The length of a unit of the file in millimetres; `None` if the file does not say it.
    pub unit: Option<f64>,
    /// The curves and points, in the order of the file.
    pub items: Vec<Item>,
    /// What is not a curve.
    pub other: Vec<Other>,
    /// What is not wrong but better told: damage that was survived, what was skipped and why.
    pub remarks: Vec<String>,
    /// Whether the file is binary: places in it are bytes, not lines.
    pub is_binary: bool,
    /// Whether lengths of the format have no unit at all, as in glyphs.
    pub is_unitless: bool,
    /// Whether items of the format have no names: layers stand for them.
    pub is_nameless: bool,
}

/// One curve, or one point, of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// The file's entity.
    pub kind: Kind,
    /// Its pieces: one, but for polycurves and paths.
    pub shapes: Vec<Shape>,
    /// The path of its layers or groups, outermost first; empty where there is none. Items of one layer share it.
    pub group: Arc<[String]>,
    /// Its name, if the file gives one.
    pub name: Option<String>,
    /// The block or symbol from which it was inserted.
    pub block: Option<Arc<str>>,
    /// Red, green and blue, if the file gives a colour.
    pub colour: Option<[u8; 3]>,
    /// Whether the file hides it, or its layer.
    pub hidden: bool,
    /// Where it belongs.
    pub space: Space,
    /// The line or the byte of its entity, from 1.
    pub at: u64,
}

/// The entity of a file, by the name that its format uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A B-spline, even of one Bézier segment.
    Spline,
    /// A Bézier curve.
    Bezier,
    /// An arc of a circle.
    Arc,
    /// A circle.
    Circle,
    /// An ellipse, whole or an arc of one.
    Ellipse,
    /// A straight segment.
    Line,
    /// A chain of straight segments; in DXF also with bulges.
    Polyline,
    /// A chain of curves as one entity.
    Polycurve,
    /// A path of SVG, or a contour of a glyph.
    Path,
    /// A point.
    Point,
}

impl Item {
    /// Make an item of its own, with neither a name nor a group nor a colour.
    pub fn new(kind: Kind, shapes: Vec<Shape>) -> Self {
        Self {
            kind,
            shapes,
            group: Arc::default(),
            name: None,
            block: None,
            colour: None,
            hidden: false,
            space: Space::Model,
            at: 0,
        }
    }
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 10] = [
        Self::Spline,
        Self::Bezier,
        Self::Arc,
        Self::Circle,
        Self::Ellipse,
        Self::Line,
        Self::Polyline,
        Self::Polycurve,
        Self::Path,
        Self::Point,
    ];

    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Spline => "spline",
            Self::Bezier => "bezier",
            Self::Arc => "arc",
            Self::Circle => "circle",
            Self::Ellipse => "ellipse",
            Self::Line => "line",
            Self::Polyline => "polyline",
            Self::Polycurve => "polycurve",
            Self::Path => "path",
            Self::Point => "point",
        }
    }

    /// The name that an item of this kind gets if it has none, by its number from 1.
    pub(super) fn numbered(self, number: usize) -> String {
        format!("{} {number}", self.name())
    }

    /// Whether a name is one that an item without a name gets, or a piece of it.
    pub(in crate::io) fn is_made_up(name: &str) -> bool {
        let is_number = |text: &str| !text.is_empty() && text.bytes().all(|it| it.is_ascii_digit());
        let Some((kind, numbers)) = name.split_once(' ') else {
            return false;
        };
        Self::ALL.iter().any(|it| it.name() == kind) && numbers.split(' ').all(is_number)
    }
}

/// Where an item belongs in its file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Space {
    /// A curve of its own.
    #[default]
    Model,
    /// A layout for printing (DXF's paper space).
    Paper,
    /// The edge of a solid or the boundary of a surface: taken on demand alone.
    Edge,
}

/// One piece of an item.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A B-spline by its own knots.
    Nurbs(Nurbs),
    /// An arc of an ellipse, or a whole one.
    Conic(Conic),
    /// A chain of straight segments, two points or more.
    Polyline {
        /// The corners.
        points: Vec<DVec3>,
        /// Whether the last corner is joined to the first.
        closed: bool,
    },
    /// A point.
    Point(DVec3),
}

/// A B-spline curve on any knots.
#[derive(Clone, Debug, PartialEq)]
pub struct Nurbs {
    /// The degree, at least 1.
    pub degree: usize,
    /// All knots, points + degree + 1 of them, rising. Formats that leave out the first and the last are completed.
    pub knots: Vec<f64>,
    /// The control points, not multiplied by their weights.
    pub points: Vec<DVec3>,
    /// The weights, positive, one a point; `None` if all are alike.
    pub weights: Option<Vec<f64>>,
    /// Whether the file calls it periodic. Its points and knots are complete even so: the curve runs over
    /// `knots[degree] ..= knots[points]`, whatever this says.
    pub periodic: bool,
}

/// The curve centre + cos t · x + sin t · y for t from `from` to `to`: a circle where x and y are perpendicular and
/// of one length.
#[derive(Clone, Debug, PartialEq)]
pub struct Conic {
    /// The centre.
    pub centre: DVec3,
    /// The first half-axis, to the point of parameter 0.
    pub x: DVec3,
    /// The second half-axis, to the point of parameter π/2.
    pub y: DVec3,
    /// The first parameter, in radians.
    pub from: f64,
    /// The last parameter, in radians, above `from`; a whole turn above it where the curve closes.
    pub to: f64,
}

/// What is not a curve, and how often it occurs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Other {
    /// The entity, by the name that its format uses.
    pub kind: String,
    /// How many there are.
    pub count: usize,
    /// The line or the byte of the first one, from 1.
    pub at: u64,
}

/// Why nothing of a file can be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable {
    /// The line (of text) or the byte (of binary files), from 1, if it is known.
    pub at: Option<u64>,
    /// What is wrong and what to do about it, as one sentence without a full stop.
    pub reason: String,
}

impl Unreadable {
    /// Make an error of it, at a line or, in a binary file, at a byte.
    pub(in crate::io) fn into_error(self, is_binary: bool) -> ReadError {
        let (at, reason) = (self.at, shortened(self.reason));
        match (at, is_binary) {
            (Some(at), false) => Place::line(at as usize).problem(Problem::Drawing(reason)),
            (Some(at), true) => Problem::Drawing(format!("byte {at}: {reason}")).into(),
            (None, _) => Problem::Drawing(reason).into(),
        }
    }
}

impl Other {
    /// Name it with its count and the place of the first one.
    pub(super) fn told(&self, is_binary: bool) -> String {
        let place = match is_binary {
            true => "byte",
            false => "line",
        };
        let (count, kind, at) = (self.count, &self.kind, self.at);
        match count {
            1 => format!("1 {kind} at {place} {at}"),
            _ => format!("{count} {kind}, the first at {place} {at}"),
        }
    }
}

/// A placement of a part of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// What it does to directions.
    pub linear: DMat3,
    /// Where the origin goes.
    pub origin: DVec3,
}

impl Default for Affine {
    fn default() -> Self {
        Self {
            linear: DMat3::IDENTITY,
            origin: DVec3::ZERO,
        }
    }
}

impl Affine {
    /// Scale about the origin.
    pub fn scaling(factor: f64) -> Self {
        Self {
            linear: DMat3::from_diagonal(DVec3::splat(factor)),
            origin: DVec3::ZERO,
        }
    }

    /// Place a point.
    pub fn point(&self, point: DVec3) -> DVec3 {
        self.linear * point + self.origin
    }

    /// Place a direction.
    pub fn vector(&self, vector: DVec3) -> DVec3 {
        self.linear * vector
    }

    /// The placement that takes this one back; `None` if it flattens something.
    pub fn inverse(&self) -> Option<Self> {
        let linear = self.linear.inverse();
        let origin = -(linear * self.origin);
        let is_regular =
            linear.is_finite() && origin.is_finite() && self.linear.determinant() != 0.0;
        is_regular.then_some(Self { linear, origin })
    }

    /// The placement of a part within a part that `self` places.
    pub fn of(&self, inner: &Self) -> Self {
        Self {
            linear: self.linear * inner.linear,
            origin: self.point(inner.origin),
        }
    }
}

impl Shape {
    /// The B-spline, if it is one.
    pub fn nurbs(&self) -> Option<&Nurbs> {
        match self {
            Self::Nurbs(nurbs) => Some(nurbs),
            _ => None,
        }
    }

    /// How many corners it has, if it is a polyline.
    pub fn corners(&self) -> Option<usize> {
        match self {
            Self::Polyline { points, .. } => Some(points.len()),
            _ => None,
        }
    }

    /// Run through a shape backwards, exactly.
    pub fn reversed(self) -> Self {
        match self {
            Self::Nurbs(mut nurbs) => {
                nurbs.points.reverse();
                nurbs.knots = nurbs.knots.iter().rev().map(|knot| 0.0 - knot).collect();
                if let Some(weights) = &mut nurbs.weights {
                    weights.reverse();
                }
                Self::Nurbs(nurbs)
            }
            Self::Conic(conic) => Self::Conic(Conic {
                y: -conic.y,
                from: -conic.to,
                to: -conic.from,
                ..conic
            }),
            Self::Polyline { mut points, closed } => {
                points.reverse();
                if closed {
                    points.rotate_right(1);
                }
                Self::Polyline { points, closed }
            }
            Self::Point(point) => Self::Point(point),
        }
    }

    /// Place a shape.
    pub fn placed(self, place: &Affine) -> Self {
        match self {
            Self::Nurbs(mut nurbs) => {
                for point in &mut nurbs.points {
                    *point = place.point(*point);
                }
                Self::Nurbs(nurbs)
            }
            Self::Conic(conic) => Self::Conic(Conic {
                centre: place.point(conic.centre),
                x: place.vector(conic.x),
                y: place.vector(conic.y),
                ..conic
            }),
            Self::Polyline { points, closed } => Self::Polyline {
                points: points.into_iter().map(|it| place.point(it)).collect(),
                closed,
            },
            Self::Point(point) => Self::Point(place.point(point)),
        }
    }
}

impl Conic {
    /// Whether it has numbers of a curve: no half-axis is 0, and it goes forward.
    pub fn is_curve(&self) -> bool {
        let Self { centre, x, y, .. } = self;
        let is_finite = [centre, x, y].iter().all(|it| it.is_finite());
        is_finite && x.cross(*y) != DVec3::ZERO && self.from < self.to
    }

    /// Whether it closes.
    pub fn is_whole(&self) -> bool {
        self.to - self.from >= TAU - WHOLE
    }
}

impl Drawing {
    /// The same drawing in millimetres, also where it has no unit.
    pub fn in_millimetres(&self) -> Self {
        let mut drawing = self.clone();
        let factor = drawing.unit.replace(1.0).unwrap_or(1.0);
        if factor != 1.0 {
            let place = Affine::scaling(factor);
            for shape in drawing.items.iter_mut().flat_map(|item| &mut item.shapes) {
                *shape = shape.clone().placed(&place);
            }
        }
        drawing
    }

    /// Whether nothing was found.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty() && self.other.is_empty()
    }

    /// Count something that is not a curve.
    pub fn count_other(&mut self, kind: &str, at: u64) {
        let is_full = self.other.len() >= MOST_KINDS;
        let known = |other: &&mut Other| other.kind == kind;
        let kind = match self.other.iter_mut().find(known) {
            None if is_full => REST,
            _ => kind,
        };
        match self.other.iter_mut().find(|other| other.kind == kind) {
            Some(other) => other.count += 1,
            None => self.other.push(Other {
                kind: kind.to_owned(),
                count: 1,
                at,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Kind;

    #[test]
    fn names_that_are_made_up_have_a_kind_and_numbers() {
        for name in [
            Kind::Line.numbered(7),
            "polycurve 25".to_owned(),
            "path 3 2".to_owned(),
        ] {
            assert!(Kind::is_made_up(&name), "{name}");
        }
        for name in [
            "line", "line ", "line a", "hull 1", "line 1 b", "1 line", "lines 1",
        ] {
            assert!(!Kind::is_made_up(name), "{name}");
        }
    }
}
