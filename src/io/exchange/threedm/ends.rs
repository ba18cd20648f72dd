//! The ends of curves, and whether they meet.

use glam::{DVec3, DVec4};

use crate::io::exchange::drawing::{Nurbs, Shape};

/// Ends that differ by less than this part of their size meet.
const MEET: f64 = 1e-9;

/// Whether a piece begins where the one before it ends.
pub(super) fn meet(before: &Shape, after: &Shape) -> bool {
    let (Some((_, end)), Some((start, _))) = (ends(before), ends(after)) else {
        return false;
    };
    let reach = [end.length(), start.length(), size(before), size(after)];
    end.distance(start) <= MEET * reach.into_iter().fold(0.0, f64::max)
}

fn size(shape: &Shape) -> f64 {
    match shape {
        Shape::Nurbs(nurbs) => spread(&nurbs.points),
        Shape::Conic(conic) => conic.x.length().max(conic.y.length()),
        Shape::Polyline { points, .. } => spread(points),
        Shape::Point(_) => 0.0,
    }
}

fn spread(points: &[DVec3]) -> f64 {
    let first = points.first().copied().unwrap_or_default();
    points
        .iter()
        .fold(0.0, |size: f64, point| size.max(point.distance(first)))
}

/// The first and the last point of a curve.
fn ends(shape: &Shape) -> Option<(DVec3, DVec3)> {
    match shape {
        Shape::Nurbs(nurbs) => {
            let last = nurbs.points.len().checked_sub(1)?;
            Some((
                at_knot(nurbs, nurbs.degree, nurbs.degree)?,
                at_knot(nurbs, last, last + 1)?,
            ))
        }
        Shape::Conic(conic) => {
            let at = |t: f64| conic.centre + t.cos() * conic.x + t.sin() * conic.y;
            Some((at(conic.from), at(conic.to)))
        }
        Shape::Polyline { points, closed } => {
            let last = if *closed {
                points.first()
            } else {
                points.last()
            };
            Some((*points.first()?, *last?))
        }
        Shape::Point(_) => None,
    }
}

/// The point at a knot, by the polynomial between the knots `span` and `span` + 1.
fn at_knot(nurbs: &Nurbs, span: usize, knot: usize) -> Option<DVec3> {
    let t = *nurbs.knots.get(knot)?;
    let start = span.checked_sub(nurbs.degree)?;
    let weight = |index: usize| nurbs.weights.as_ref().and_then(|it| it.get(index).copied());
    let points = nurbs
        .points
        .iter()
        .enumerate()
        .skip(start)
        .take(nurbs.degree + 1);
    let mut points: Vec<DVec4> = points
        .map(|(index, point)| {
            let weight = weight(index).unwrap_or(1.0);
            (*point * weight).extend(weight)
        })
        .collect();
    for round in 1..=nurbs.degree {
        let knots = nurbs
            .knots
            .iter()
            .skip(start + round)
            .zip(nurbs.knots.iter().skip(span + 1));
        points = points
            .windows(2)
            .zip(knots)
            .filter_map(|(pair, (left, right))| {
                let part = if left < right {
                    (t - left) / (right - left)
                } else {
                    0.0
                };
                Some(pair.first()?.lerp(*pair.last()?, part))
            })
            .collect();
    }
    points.first().map(|point| point.truncate() / point.w)
}
