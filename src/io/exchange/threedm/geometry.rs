//! Curves and points as objects of the file.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;

use super::classes::{ARC_CURVE, LINE_CURVE, NURBS_CURVE, POINT, POLY_CURVE, POLYLINE_CURVE};
use super::ends::meet;
use super::exact;
use super::output::Output;
use crate::io::exchange::drawing::{Conic, Item, Kind, Nurbs, Shape};

/// The layout that every class is written in.
const VERSION: u8 = 0x10;
/// The dimension of space.
const SPACE: i32 = 3;
/// Half-axes that differ by less than this part of their length are those of a circle.
const ROUND: f64 = 1e-12;

/// An object, and what programs ask before they read it.
pub(super) struct Written {
    pub(super) kind: i32,
    pub(super) object: Output,
}

const POINT_KIND: i32 = 1;
const CURVE_KIND: i32 = 4;

/// Make the objects of an item: one, or several if its pieces do not meet.
pub(super) fn objects(item: &Item) -> Result<Vec<Written>, String> {
    item.shapes.iter().try_for_each(check)?;
    if let [shape] = item.shapes.as_slice()
        && item.kind != Kind::Polycurve
    {
        return Ok(vec![single(shape, item.kind)]);
    }
    let is_point = |shape: &Shape| matches!(shape, Shape::Point(_));
    if item.shapes.iter().any(is_point) {
        return Ok(item
            .shapes
            .iter()
            .map(|shape| single(shape, item.kind))
            .collect());
    }
    Ok(item.shapes.chunk_by(meet).map(polycurve).collect())
}

/// Say which numbers no file can hold.
fn check(shape: &Shape) -> Result<(), String> {
    let finite = |points: &[DVec3]| points.iter().all(|point| point.is_finite());
    let sound = match shape {
        Shape::Nurbs(nurbs) => finite(&nurbs.points) && nurbs_sound(nurbs),
        Shape::Conic(Conic {
            centre,
            x,
            y,
            from,
            to,
        }) => finite(&[*centre, *x, *y]) && from < to && to - from <= TAU + 1e-9,
        Shape::Polyline { points, .. } => finite(points) && points.len() >= 2,
        Shape::Point(point) => point.is_finite(),
    };
    if sound {
        Ok(())
    } else {
        Err("its numbers are not those of a curve".to_owned())
    }
}

fn nurbs_sound(nurbs: &Nurbs) -> bool {
    let count = nurbs.points.len();
    nurbs.degree >= 1
        && count > nurbs.degree
        && nurbs.knots.len() == count + nurbs.degree + 1
        && nurbs.knots.iter().all(|knot| knot.is_finite())
        && nurbs.knots.is_sorted()
        && nurbs.knots.get(nurbs.degree) < nurbs.knots.get(count)
        && nurbs.weights.as_ref().is_none_or(|weights| {
            weights.len() == count && weights.iter().all(|it| *it > 0.0 && it.is_finite())
        })
}

fn single(shape: &Shape, kind: Kind) -> Written {
    let (class, data) = plain(shape, kind);
    Written {
        kind: if class == POINT {
            POINT_KIND
        } else {
            CURVE_KIND
        },
        object: Output::default().object(class, &data, &data),
    }
}

fn polycurve(shapes: &[Shape]) -> Written {
    let parameters: Vec<f64> = (0_u32..).take(shapes.len() + 1).map(f64::from).collect();
    let own = bounds(
        Output::default()
            .byte(VERSION)
            .count(shapes.len())
            .int(0)
            .int(0),
    )
    .count(parameters.len())
    .numbers(&parameters);
    let data = shapes.iter().fold(own.clone(), |output, shape| {
        let (class, data) = plain(shape, Kind::Polycurve);
        output.object(class, &data, &data)
    });
    Written {
        kind: CURVE_KIND,
        object: Output::default().object(POLY_CURVE, &data, &own),
    }
}

/// Whether a shape is written as a spline of the same form: an ellipse has no class of its own.
pub(in crate::io) fn is_spline(shape: &Shape) -> bool {
    matches!(shape, Shape::Conic(conic) if !is_round(conic))
}

/// The class and the data of a piece.
fn plain(shape: &Shape, kind: Kind) -> (u128, Output) {
    let data = Output::default().byte(VERSION);
    match shape {
        Shape::Nurbs(nurbs) => (NURBS_CURVE, spline(data, nurbs)),
        Shape::Conic(conic) if is_round(conic) => (ARC_CURVE, arc(data, conic)),
        Shape::Conic(conic) => (NURBS_CURVE, spline(data, &conic_spline(conic))),
        Shape::Point(point) => (POINT, data.point(*point)),
        Shape::Polyline { points, closed } => match points.as_slice() {
            [from, to] if !closed && kind != Kind::Polyline => {
                let data = data.point(*from).point(*to);
                (LINE_CURVE, data.numbers(&[0.0, 1.0]).int(SPACE))
            }
            _ => (POLYLINE_CURVE, polyline(data, points, *closed)),
        },
    }
}

/// A box that is not set, as all programs write it.
fn bounds(data: Output) -> Output {
    data.numbers(&[1.0, 1.0, 1.0, -1.0, -1.0, -1.0])
}

fn spline(data: Output, nurbs: &Nurbs) -> Output {
    let count = nurbs.points.len();
    let rational = i32::from(nurbs.weights.is_some());
    let head = data
        .int(SPACE)
        .int(rational)
        .count(nurbs.degree + 1)
        .count(count);
    let inner = nurbs
        .knots
        .get(1..nurbs.knots.len().saturating_sub(1))
        .unwrap_or_default();
    let head = bounds(head.int(0).int(0))
        .count(inner.len())
        .numbers(inner)
        .count(count);
    let Some(weights) = &nurbs.weights else {
        return nurbs
            .points
            .iter()
            .fold(head, |output, point| output.point(*point));
    };
    nurbs
        .points
        .iter()
        .zip(weights)
        .fold(head, |output, (point, &weight)| {
            let multiples = point.to_array().map(|it| exact::multiple(it, weight));
            output.numbers(&multiples).numbers(&[weight])
        })
}

fn polyline(data: Output, points: &[DVec3], closed: bool) -> Output {
    let closing = points.first().filter(|_| closed);
    let count = points.len() + usize::from(closing.is_some());
    let data = data.count(count);
    let data = points
        .iter()
        .chain(closing)
        .fold(data, |output, point| output.point(*point));
    let parameters: Vec<f64> = (0_u32..).take(count).map(f64::from).collect();
    data.count(count).numbers(&parameters).int(SPACE)
}

fn is_round(conic: &Conic) -> bool {
    let (x, y) = (conic.x.length(), conic.y.length());
    (x - y).abs() <= ROUND * x && conic.x.dot(conic.y).abs() <= ROUND * x * y
}

fn arc(data: Output, conic: &Conic) -> Output {
    let Conic {
        centre, from, to, ..
    } = *conic;
    let (radius, x, y) = exact::axes(conic.x, conic.y);
    let normal = x.cross(y);
    let data = data.point(centre).point(x).point(y).point(normal);
    let data = data.point(normal).numbers(&[-normal.dot(centre), radius]);
    let data = data
        .point(centre + conic.x)
        .point(centre + conic.y)
        .point(centre - conic.x);
    data.numbers(&[from, to, from, to]).int(SPACE)
}

/// An arc of an ellipse as a rational curve of degree 2: the format has no ellipses.
fn conic_spline(conic: &Conic) -> Nurbs {
    let angle = conic.to - conic.from;
    let spans = (1..=4)
        .find(|&spans| angle <= f64::from(spans) * FRAC_PI_2 + 1e-9)
        .unwrap_or(4);
    let half = angle / f64::from(2 * spans);
    let at =
        |t: f64, far: f64| conic.centre + (t.cos() * far) * conic.x + (t.sin() * far) * conic.y;
    let parameter = |step: i32| conic.from + f64::from(step) * half;
    let mut points: Vec<DVec3> = (0..=2 * spans)
        .map(|step| {
            at(
                parameter(step),
                if step % 2 == 0 {
                    1.0
                } else {
                    half.cos().recip()
                },
            )
        })
        .collect();
    let whole = angle >= TAU - 1e-9;
    if let [first, .., last] = points.as_mut_slice()
        && whole
    {
        *last = *first;
    }
    let weights = (0..=2 * spans).map(|step| if step % 2 == 0 { 1.0 } else { half.cos() });
    let inner = (0..=spans).flat_map(|span| [parameter(2 * span); 2]);
    Nurbs {
        degree: 2,
        knots: [conic.from]
            .into_iter()
            .chain(inner)
            .chain([parameter(2 * spans)])
            .collect(),
        points,
        weights: Some(weights.collect()),
        periodic: false,
    }
}
