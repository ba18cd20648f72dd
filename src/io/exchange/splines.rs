//! What the formats that hold splines, and those that hold Bézier curves alone, need to know of a shape.

use std::borrow::Cow;
use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use crate::io::exchange::drawing::{Conic, Drawing, Item, Nurbs, Shape};

/// A part of a path, as formats of paths know them.
pub(super) enum Piece<'s> {
    /// Straight segments.
    Lines { points: &'s [DVec3], closed: bool },
    /// A quadratic B-spline on clamped uniform knots, most often a single Bézier curve.
    Quadratic(&'s [DVec3]),
    /// A cubic Bézier curve.
    Cubic(&'s [DVec3]),
    /// An arc of an ellipse.
    Arc(&'s Conic),
    /// A quadratic B-spline on uniform knots that closes smoothly, without the points that are repeated.
    Ring(&'s [DVec3]),
}

impl Piece<'_> {
    /// Get the first point.
    pub(super) fn start(&self) -> Option<DVec3> {
        match self {
            Self::Arc(conic) => Some(at(conic, conic.from)),
            Self::Lines { points, .. } | Self::Quadratic(points) | Self::Cubic(points) => {
                points.first().copied()
            }
            Self::Ring(_) => None,
        }
    }
}

/// Divide a shape into the pieces of a path, or say what it is instead.
pub(super) fn pieces(shape: &Shape) -> Result<Vec<Piece<'_>>, String> {
    match shape {
        Shape::Point(_) => Err("a point".to_owned()),
        Shape::Conic(conic) => Ok(vec![Piece::Arc(conic)]),
        Shape::Polyline { points, closed } => Ok(vec![Piece::Lines {
            points,
            closed: *closed,
        }]),
        Shape::Nurbs(nurbs) => spline_pieces(nurbs),
    }
}

/// Check the numbers of a spline, and leave out weights that are all alike.
pub(super) fn checked(mut nurbs: Nurbs) -> Result<Nurbs, String> {
    let (count, degree) = (nurbs.points.len(), nurbs.degree);
    if degree == 0 || count <= degree {
        return Err(format!(
            "{count} control points are too few for the degree {degree}"
        ));
    }
    let wanted = count + degree + 1;
    if nurbs.knots.len() != wanted {
        return Err(format!(
            "it has {} knots in place of {wanted}",
            nurbs.knots.len()
        ));
    }
    let finite = nurbs.knots.iter().all(|it| it.is_finite());
    if !finite || !nurbs.points.iter().all(|it| it.is_finite()) {
        return Err("a number is not finite".to_owned());
    }
    if !nurbs.knots.is_sorted() || nurbs.knots.get(degree) >= nurbs.knots.get(count) {
        return Err("its knots do not rise".to_owned());
    }
    if let Some(weights) = &nurbs.weights {
        if weights.len() != count {
            return Err(format!(
                "it has {} weights in place of {count}",
                weights.len()
            ));
        }
        if !weights.iter().all(|it| it.is_finite() && *it > 0.0) {
            return Err("a weight is not above 0".to_owned());
        }
        if weights.windows(2).all(|it| it[0] == it[1]) {
            nurbs.weights = None;
        }
    }
    Ok(nurbs)
}

/// Make clamped uniform knots.
pub(super) fn clamped_knots(degree: usize, count: usize) -> Vec<f64> {
    let last = count.saturating_sub(degree);
    let inner = (1..last).map(|it| it as f64);
    let mut knots = vec![0.0; degree + 1];
    knots.extend(inner);
    knots.extend(vec![last as f64; degree + 1]);
    knots
}

/// Make a shape a spline; a point is none.
pub(super) fn spline(shape: &Shape) -> Option<Cow<'_, Nurbs>> {
    match shape {
        Shape::Nurbs(nurbs) => Some(Cow::Borrowed(nurbs)),
        Shape::Conic(conic) => Some(Cow::Owned(from_conic(conic))),
        Shape::Polyline { points, closed } => Some(Cow::Owned(from_corners(points, *closed))),
        Shape::Point(_) => None,
    }
}

/// Get the point of an ellipse at a parameter.
pub(super) fn at(conic: &Conic, parameter: f64) -> DVec3 {
    let (sin, cos) = parameter.sin_cos();
    conic.centre + cos * conic.x + sin * conic.y
}

/// The ends of an arc, and its points where a coordinate turns.
pub(super) fn outermost(conic: &Conic) -> impl Iterator<Item = DVec3> {
    let Conic { x, y, from, to, .. } = *conic;
    let turns = x.to_array().into_iter().zip(y.to_array());
    let turns = turns.flat_map(move |(x, y)| {
        let phase = y.atan2(x);
        let first = phase + PI * ((from - phase) / PI).ceil();
        (0..3).map(move |turn| first + PI * f64::from(turn))
    });
    let parameters = [from, to]
        .into_iter()
        .chain(turns.filter(move |it| *it < to));
    parameters.map(|parameter| at(conic, parameter))
}

/// Say which item something is about.
pub(super) fn described(drawing: &Drawing, item: &Item) -> String {
    let number = drawing.items.iter().position(|it| std::ptr::eq(it, item));
    let number = number.map_or(String::new(), |it| format!(" {}", it + 1));
    let name = item.name.as_ref().map(|it| format!(" “{it}”"));
    format!(
        "item{number}{} ({})",
        name.unwrap_or_default(),
        item.kind.name()
    )
}

/// Get all points that define a shape, and for an ellipse the corners of a box around it.
pub(super) fn hull(shape: &Shape) -> Vec<DVec3> {
    match shape {
        Shape::Nurbs(nurbs) => nurbs.points.clone(),
        Shape::Polyline { points, .. } => points.clone(),
        Shape::Point(point) => vec![*point],
        Shape::Conic(conic) => {
            let half = DVec3::new(
                conic.x.x.hypot(conic.y.x),
                conic.x.y.hypot(conic.y.y),
                conic.x.z.hypot(conic.y.z),
            );
            vec![conic.centre - half, conic.centre + half]
        }
    }
}

fn spline_pieces(nurbs: &Nurbs) -> Result<Vec<Piece<'_>>, String> {
    let refused = |what: &str| Err(format!("a {what}spline of degree {}", nurbs.degree));
    let weights = nurbs.weights.as_deref().unwrap_or_default();
    let rational = weights.iter().any(|it| Some(it) != weights.first());
    match nurbs.degree {
        1 => Ok(vec![Piece::Lines {
            points: &nurbs.points,
            closed: false,
        }]),
        _ if rational => refused("rational "),
        2 if is_ring(nurbs) => {
            let count = nurbs.points.len();
            Ok(vec![Piece::Ring(
                nurbs.points.get(1..count - 1).unwrap_or_default(),
            )])
        }
        2 | 3 => match runs(nurbs) {
            Some(pieces) => Ok(pieces),
            None => refused("general "),
        },
        _ => refused(""),
    }
}

/// Divide a clamped spline of degree 2 or 3 at its full knots, if what is between is uniform or a Bézier
/// curve.
fn runs(nurbs: &Nurbs) -> Option<Vec<Piece<'_>>> {
    let (degree, count) = (nurbs.degree, nurbs.points.len());
    let clamped = |ends: &[f64]| ends.windows(2).all(|it| it[0] == it[1]);
    if !clamped(nurbs.knots.get(..=degree)?) || !clamped(nurbs.knots.get(count..)?) {
        return None;
    }
    let (mut pieces, mut start) = (Vec::new(), 0);
    let mut breaks = vec![*nurbs.knots.first()?];
    let mut index = degree + 1;
    while index <= count {
        let knot = *nurbs.knots.get(index)?;
        let end = nurbs
            .knots
            .get(index..)?
            .iter()
            .take_while(|&&it| it == knot)
            .count()
            + index;
        breaks.push(knot);
        if index == count || end - index == degree {
            let last = if index == count {
                count - 1
            } else {
                end - 1 - degree
            };
            let points = nurbs.points.get(start..=last)?;
            pieces.push(piece(degree, points, &breaks)?);
            (start, breaks) = (last, vec![knot]);
        } else if end - index != 1 {
            return None;
        }
        index = end;
    }
    Some(pieces)
}

fn piece<'s>(degree: usize, points: &'s [DVec3], breaks: &[f64]) -> Option<Piece<'s>> {
    match degree {
        2 if is_uniform(breaks) => Some(Piece::Quadratic(points)),
        3 if points.len() == 4 => Some(Piece::Cubic(points)),
        _ => None,
    }
}

fn is_uniform(knots: &[f64]) -> bool {
    let (Some(first), Some(last)) = (knots.first(), knots.last()) else {
        return false;
    };
    let step = (last - first) / (knots.len().max(2) - 1) as f64;
    knots
        .windows(2)
        .all(|it| (it[1] - it[0] - step).abs() <= 1e-12 * step.abs())
}

/// Whether a quadratic spline is uniform and its last two points are its first two.
fn is_ring(nurbs: &Nurbs) -> bool {
    let count = nurbs.points.len();
    count >= 4 && nurbs.points.get(..2) == nurbs.points.get(count - 2..) && is_uniform(&nurbs.knots)
}

fn from_corners(corners: &[DVec3], closed: bool) -> Nurbs {
    let mut points = corners.to_vec();
    if closed {
        points.extend(corners.first());
    }
    Nurbs {
        degree: 1,
        knots: clamped_knots(1, points.len()),
        points,
        weights: None,
        periodic: false,
    }
}

/// Make an arc a rational spline of parts of up to a quarter turn.
fn from_conic(conic: &Conic) -> Nurbs {
    let span = conic.to - conic.from;
    let parts = (span / FRAC_PI_2 - 1e-9).ceil().clamp(1.0, 4.0);
    let step = span / parts;
    let weight = (0.5 * step).cos();
    let mut points = vec![at(conic, conic.from)];
    let (mut knots, mut weights) = (vec![0.0; 3], vec![1.0]);
    for part in 1..=parts as usize {
        let end = conic.from + step * part as f64;
        let middle = at(conic, end - 0.5 * step) - conic.centre;
        points.extend([conic.centre + middle / weight, at(conic, end)]);
        knots.extend([part as f64; 2]);
        weights.extend([weight, 1.0]);
    }
    knots.push(parts);
    if conic.is_whole() {
        points.pop();
        points.extend(points.first().copied());
    }
    Nurbs {
        degree: 2,
        knots,
        points,
        weights: Some(weights),
        periodic: false,
    }
}
