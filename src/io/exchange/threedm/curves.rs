//! The curves and points of a file.

use std::f64::consts::TAU;

use glam::DVec3;

use super::chunks::{Archive, Chunks};
use super::classes::Class;
use super::cursor::Cursor;
use super::knots;
use super::objects::{Object, object};
use crate::io::exchange::drawing::{Conic, Kind, Nurbs, Shape};

/// Polycurves within polycurves.
const DEPTH: usize = 64;
/// What is larger is no coordinate: programs write -1.2e308 for one that is not set.
const LARGEST: f64 = 1e300;
/// An arc that lacks less than this of a whole turn is a circle.
const TURN: f64 = 1e-10;

/// A curve, or points.
pub(super) struct Curve {
    pub(super) kind: Kind,
    /// The pieces of a curve; for a point cloud, its points.
    pub(super) shapes: Vec<Shape>,
    /// The parameters of its ends.
    pub(super) domain: (f64, f64),
}

/// Read a curve, a point or a point cloud; `None` if the object is another.
pub(super) fn curve(object: &Object, archive: Archive) -> Result<Option<Curve>, String> {
    nested(object, archive, 0)
}

/// Read a polycurve that is not wrapped as an object; a single piece is a curve of its own.
pub(super) fn polycurve(data: &mut Cursor, archive: Archive) -> Result<Curve, String> {
    let mut curve = pieces(data, archive, 0)?;
    if let [shape] = curve.shapes.as_slice() {
        curve.kind = match shape {
            Shape::Nurbs(_) => Kind::Spline,
            Shape::Conic(conic) => round_kind(conic),
            Shape::Polyline {
                points,
                closed: false,
            } if points.len() == 2 => Kind::Line,
            Shape::Polyline { .. } => Kind::Polyline,
            Shape::Point(_) => Kind::Point,
        };
    }
    Ok(curve)
}

/// Whether all numbers of a shape can be coordinates.
pub(super) fn usable(shape: &Shape) -> bool {
    let sound = |point: &DVec3| point.is_finite() && point.abs().max_element() < LARGEST;
    let all = |points: &[DVec3]| points.iter().all(sound);
    match shape {
        Shape::Nurbs(nurbs) => all(&nurbs.points),
        Shape::Conic(conic) => all(&[conic.centre, conic.x, conic.y]),
        Shape::Polyline { points, .. } => all(points),
        Shape::Point(point) => all(&[*point]),
    }
}

fn nested(object: &Object, archive: Archive, depth: usize) -> Result<Option<Curve>, String> {
    let mut data = object.data;
    let read = match object.class {
        Class::NurbsCurve => nurbs,
        Class::PolylineCurve => polyline,
        Class::ArcCurve => arc,
        Class::CircleCurve => circle,
        Class::LineCurve => line,
        Class::AnnotationArrow => arrow,
        Class::Point => point,
        Class::PointCloud => cloud,
        Class::PolyCurve => return pieces(&mut data, archive, depth).map(Some),
        _ => return Ok(None),
    };
    start(&mut data)?;
    let curve = read(&mut data)?;
    if curve.shapes.iter().all(usable) {
        Ok(Some(curve))
    } else {
        Err("a coordinate is no number, or not set".to_owned())
    }
}

fn start(data: &mut Cursor) -> Result<(), String> {
    match data.version()? {
        (1, _) => Ok(()),
        (major, minor) => Err(format!("its layout {major}.{minor} is not known")),
    }
}

fn nurbs(data: &mut Cursor) -> Result<Curve, String> {
    let (dimension, rational) = (data.int()?, data.int()? != 0);
    let (order, count) = (data.int()?, data.int()?);
    data.bytes(8 + 48)?;
    if !(2..=3).contains(&dimension) {
        return Err(format!("it has {dimension} dimensions"));
    }
    let (Ok(order), Ok(count)) = (usize::try_from(order), usize::try_from(count)) else {
        return Err(format!(
            "its order {order} or its count of points {count} is wrong"
        ));
    };
    let degree = order.saturating_sub(1);
    let inner = data.numbers()?;
    let size = if dimension == 3 { 24 } else { 16 } + if rational { 8 } else { 0 };
    if data.count(size)? != count {
        return Err("its counts of points differ".to_owned());
    }
    let mut points = Vec::with_capacity(count);
    let mut weights = Vec::with_capacity(if rational { count } else { 0 });
    for _ in 0..count {
        let (x, y) = data.interval()?;
        let z = if dimension == 3 { data.number()? } else { 0.0 };
        points.push(DVec3::new(x, y, z));
        if rational {
            weights.push(data.number()?);
        }
    }
    let weights = projected(&mut points, weights)?;
    let periodic = knots::periodic(&inner, degree, &points, weights.as_deref());
    let knots = knots::complete(&inner, degree, count, periodic)?;
    Ok(Curve {
        kind: Kind::Spline,
        domain: ends(&knots, degree, count),
        shapes: vec![Shape::Nurbs(Nurbs {
            degree,
            knots,
            points,
            weights,
            periodic,
        })],
    })
}

/// Divide the points by their weights; weights that are all alike go.
fn projected(points: &mut [DVec3], mut weights: Vec<f64>) -> Result<Option<Vec<f64>>, String> {
    if !weights.is_empty() && weights.iter().all(|weight| *weight < 0.0) {
        // The same curve.
        points.iter_mut().for_each(|point| *point = -*point);
        weights.iter_mut().for_each(|weight| *weight = -*weight);
    }
    if !weights
        .iter()
        .all(|weight| *weight > 0.0 && weight.is_finite())
    {
        return Err("a weight is not positive".to_owned());
    }
    for (point, weight) in points.iter_mut().zip(&weights) {
        *point /= *weight;
    }
    let alike = weights.iter().all(|weight| Some(weight) == weights.first());
    Ok((!alike).then_some(weights))
}

fn ends(knots: &[f64], degree: usize, count: usize) -> (f64, f64) {
    let knot = |index: usize| knots.get(index).copied().unwrap_or_default();
    (knot(degree), knot(count))
}

fn polyline(data: &mut Cursor) -> Result<Curve, String> {
    let mut points = data.points()?;
    let parameters = data.numbers()?;
    if points.len() < 2 {
        return Err("it has less than two points".to_owned());
    }
    let closed = points.len() > 3 && points.first() == points.last();
    if closed {
        points.pop();
    }
    let end = |end: Option<&f64>| end.copied().unwrap_or(f64::NAN);
    Ok(Curve {
        kind: Kind::Polyline,
        domain: (end(parameters.first()), end(parameters.last())),
        shapes: vec![Shape::Polyline { points, closed }],
    })
}

fn line(data: &mut Cursor) -> Result<Curve, String> {
    let mut points = vec![data.point()?, data.point()?];
    let domain = data.interval()?;
    if data.int()? == 2 {
        points.iter_mut().for_each(|point| point.z = 0.0);
    }
    Ok(segment(points, domain))
}

fn arrow(data: &mut Cursor) -> Result<Curve, String> {
    Ok(segment(vec![data.point()?, data.point()?], (0.0, 1.0)))
}

fn segment(points: Vec<DVec3>, domain: (f64, f64)) -> Curve {
    Curve {
        kind: Kind::Line,
        shapes: vec![Shape::Polyline {
            points,
            closed: false,
        }],
        domain,
    }
}

fn arc(data: &mut Cursor) -> Result<Curve, String> {
    let (centre, x, y) = round(data)?;
    let (from, to) = data.interval()?;
    conic(
        data,
        Conic {
            centre,
            x,
            y,
            from,
            to,
        },
    )
}

fn circle(data: &mut Cursor) -> Result<Curve, String> {
    let (centre, x, y) = round(data)?;
    let (from, to) = (0.0, TAU);
    conic(
        data,
        Conic {
            centre,
            x,
            y,
            from,
            to,
        },
    )
}

/// The centre and the half-axes of a circle.
fn round(data: &mut Cursor) -> Result<(DVec3, DVec3, DVec3), String> {
    let (centre, x, y) = (data.point()?, data.point()?, data.point()?);
    // The normal and the equation of the plane.
    data.bytes(24 + 32)?;
    let radius = data.number()?;
    // The points of parameters 0, π/2 and π.
    data.bytes(72)?;
    if radius > 0.0 {
        Ok((centre, x * radius, y * radius))
    } else {
        Err(format!("its radius {radius} is wrong"))
    }
}

fn conic(data: &mut Cursor, conic: Conic) -> Result<Curve, String> {
    let domain = data.interval()?;
    let angle = conic.to - conic.from;
    if !(angle > 0.0 && angle <= TAU + TURN) || conic.from.abs() > LARGEST {
        return Err("its angles are wrong".to_owned());
    }
    Ok(Curve {
        kind: round_kind(&conic),
        shapes: vec![Shape::Conic(conic)],
        domain,
    })
}

fn round_kind(conic: &Conic) -> Kind {
    let whole = conic.to - conic.from >= TAU - TURN;
    if whole { Kind::Circle } else { Kind::Arc }
}

fn point(data: &mut Cursor) -> Result<Curve, String> {
    Ok(points(vec![data.point()?]))
}

fn cloud(data: &mut Cursor) -> Result<Curve, String> {
    Ok(points(data.points()?))
}

fn points(points: Vec<DVec3>) -> Curve {
    Curve {
        kind: Kind::Point,
        shapes: points.into_iter().map(Shape::Point).collect(),
        domain: (0.0, 0.0),
    }
}

fn pieces(data: &mut Cursor, archive: Archive, depth: usize) -> Result<Curve, String> {
    if depth == DEPTH {
        return Err("its polycurves are nested too deep".to_owned());
    }
    start(data)?;
    let count = data.count(8)?;
    data.bytes(8 + 48)?;
    let parameters = data.numbers()?;
    let mut chunks = Chunks::new(*data, archive);
    let mut shapes = Vec::new();
    for piece in 1..=count {
        let name = |reason| format!("piece {piece} of {count}: {reason}");
        let chunk = chunks
            .next()
            .ok_or_else(|| name("it is missing".to_owned()))?;
        let segment = object(&chunk, archive).map_err(name)?;
        match nested(&segment, archive, depth + 1).map_err(name)? {
            Some(curve) if curve.kind != Kind::Point => shapes.extend(curve.shapes),
            _ => return Err(name(format!("{} is no curve", segment.class.name()))),
        }
    }
    *data = chunks.rest();
    if shapes.is_empty() {
        return Err("it has no pieces".to_owned());
    }
    let end = |end: Option<&f64>| end.copied().unwrap_or(f64::NAN);
    Ok(Curve {
        kind: Kind::Polycurve,
        domain: (end(parameters.first()), end(parameters.last())),
        shapes,
    })
}
