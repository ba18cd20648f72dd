//! Parts of curves, and curves run through backwards.

use std::f64::consts::TAU;

use glam::{DVec3, DVec4};

use super::evaluation::{Homogeneous, end, start};
use crate::io::exchange::drawing::{Conic, Nurbs, Shape};

/// How far apart, of the size, two ends may lie that count as one.
const CLOSED: f64 = 1e-7;

/// Reverse a chain of shapes.
pub fn chain_reversed(shapes: Vec<Shape>) -> Vec<Shape> {
    shapes.into_iter().rev().map(Shape::reversed).collect()
}

/// Cut a whole conic from angle `from` to angle `to`, along its own sense or against it.
pub fn conic_part(conic: Conic, from: f64, to: f64, forward: bool) -> Shape {
    let arc = |conic: Conic, from: f64, to: f64| {
        let turns = if to > from && to - from <= TAU * (1.0 + 1e-12) {
            0.0
        } else {
            ((from - to) / TAU).floor() + 1.0
        };
        Shape::Conic(Conic {
            from,
            to: to + turns * TAU,
            ..conic
        })
    };
    if forward {
        arc(conic, from, to)
    } else {
        let y = -conic.y;
        arc(Conic { y, ..conic }, 0.0 - from, 0.0 - to)
    }
}

/// Cut a spline from parameter `from` to parameter `to`. A closed one is run through along its own sense or
/// against it, over its joint if need be; an open one in the only way there is.
pub fn spline_part(nurbs: Nurbs, from: f64, to: f64, forward: bool) -> Option<Shape> {
    let closed = is_closed(&nurbs);
    let (first, last) = if forward || !closed {
        (from, to)
    } else {
        (to, from)
    };
    let part = if first < last {
        piece(&nurbs, first, last)
    } else if closed {
        over_joint(&nurbs, first, last)
    } else {
        return Some(Shape::Nurbs(piece(&nurbs, last, first)?).reversed());
    }?;
    let part = Shape::Nurbs(part);
    Some(if forward || !closed {
        part
    } else {
        part.reversed()
    })
}

/// Cut a chain of corners, whose parameter is the number of the corner.
pub fn polyline_part(
    points: Vec<DVec3>,
    closed: bool,
    from: f64,
    to: f64,
    forward: bool,
) -> Option<Shape> {
    let mut knots: Vec<f64> = vec![0.0];
    knots.extend((0..points.len() + usize::from(closed)).map(|place| place as f64));
    let mut points = points;
    if closed {
        points.extend(points.first().copied());
    }
    knots.push(points.len().saturating_sub(1) as f64);
    let nurbs = Nurbs {
        degree: 1,
        knots,
        points,
        weights: None,
        periodic: false,
    };
    match spline_part(nurbs, from, to, forward)? {
        Shape::Nurbs(mut part) => {
            part.points.dedup();
            Some(Shape::Polyline {
                points: part.points,
                closed: false,
            })
        }
        other => Some(other),
    }
}

/// Whether the ends of a spline meet.
pub fn is_closed(nurbs: &Nurbs) -> bool {
    match (start(nurbs), end(nurbs)) {
        (Some(start), Some(end)) => start.distance(end) <= CLOSED * size(&nurbs.points),
        _ => false,
    }
}

/// The longest side of the box around points.
pub fn size(points: &[DVec3]) -> f64 {
    let low = points
        .iter()
        .fold(DVec3::INFINITY, |low, point| low.min(*point));
    let high = points
        .iter()
        .fold(DVec3::NEG_INFINITY, |high, point| high.max(*point));
    (high - low).max_element().max(0.0)
}

fn domain(nurbs: &Nurbs) -> Option<(f64, f64)> {
    Some((
        *nurbs.knots.get(nurbs.degree)?,
        *nurbs.knots.get(nurbs.points.len())?,
    ))
}

/// The whole spline if the range is its own, else the clamped piece.
fn piece(nurbs: &Nurbs, from: f64, to: f64) -> Option<Nurbs> {
    let (first, last) = domain(nurbs)?;
    let (from, to) = (from.max(first), to.min(last));
    if from == first && to == last {
        return Some(nurbs.clone());
    }
    if from >= to {
        return None;
    }
    let degree = nurbs.degree;
    let mut spline = Homogeneous::of(nurbs);
    spline.insert_fully(from)?;
    spline.insert_fully(to)?;
    let knots = &spline.knots;
    let inner: Vec<f64> = knots
        .iter()
        .copied()
        .filter(|knot| *knot > from && *knot < to)
        .collect();
    let start = knots
        .iter()
        .rposition(|knot| *knot <= from)?
        .checked_sub(degree)?;
    let points = spline
        .points
        .get(start..=start + inner.len() + degree)?
        .to_vec();
    let mut knots = vec![from; degree + 1];
    knots.extend(inner);
    knots.extend(std::iter::repeat_n(to, degree + 1));
    let piece = Homogeneous {
        degree,
        knots,
        points,
    };
    Some(piece.into_nurbs(nurbs.weights.is_some()))
}

/// The piece of a closed spline from `from` to its end and on from its start to `to`.
fn over_joint(nurbs: &Nurbs, from: f64, to: f64) -> Option<Nurbs> {
    let (first, last) = domain(nurbs)?;
    if from >= last {
        return if to <= first {
            Some(nurbs.clone())
        } else {
            piece(nurbs, first, to)
        };
    }
    if to <= first {
        return piece(nurbs, from, last);
    }
    let head = Homogeneous::of(&piece(nurbs, from, last)?);
    let tail = Homogeneous::of(&piece(nurbs, first, to)?);
    let degree = nurbs.degree;
    let scale = head.points.last()?.w / tail.points.first()?.w;
    let mut knots = head.knots;
    knots.pop();
    let shift = last - first;
    knots.extend(tail.knots.iter().skip(degree + 1).map(|knot| knot + shift));
    let mut points = head.points;
    points.extend(
        tail.points
            .iter()
            .skip(1)
            .map(|point: &DVec4| *point * scale),
    );
    let joined = Homogeneous {
        degree,
        knots,
        points,
    };
    Some(joined.into_nurbs(nurbs.weights.is_some()))
}
