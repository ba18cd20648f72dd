//! Shapes as entities: splines, conics, polylines and chains of them.

use std::f64::consts::TAU;

use glam::DVec3;

use super::cuts::{is_closed, size};
use super::evaluation::{ends, on_conic};
use super::output::{Output, list, real, refs, string};
use super::splines::bezier_knots;
use crate::io::exchange::drawing::{Conic, Item, Kind, Nurbs, Shape};

/// The highest degree that OpenCascade reads; it drops curves above without a word.
const HIGHEST_DEGREE: usize = 25;
/// How far apart, of the size, pieces may be that are joined.
const JOINED: f64 = 1e-6;
/// How far from perpendicular, or from one length, axes may be by rounding.
const ROUNDING: f64 = 1e-14;

/// Add an item: one entity or, where its pieces do not join, several. The error is the reason.
pub fn add_item(out: &mut Output, item: &Item) -> Result<Vec<u64>, String> {
    let name = item.name.as_deref().unwrap_or("");
    item.shapes.iter().try_for_each(check)?;
    if let [shape] = item.shapes.as_slice() {
        return Ok(vec![add_whole(out, shape, item.kind, name)]);
    }
    let mut entities = Vec::new();
    for run in runs(&item.shapes) {
        entities.push(match run {
            [shape] if item.kind != Kind::Polycurve => add_whole(out, shape, Kind::Path, name),
            [point @ Shape::Point(_)] => add_whole(out, point, Kind::Point, name),
            run => composite(out, run, name),
        });
    }
    Ok(entities)
}

fn check(shape: &Shape) -> Result<(), String> {
    let finite = match shape {
        Shape::Nurbs(nurbs) => {
            check_spline(nurbs)?;
            nurbs.points.iter().all(|it| it.is_finite())
        }
        Shape::Conic(conic) => {
            let turn = conic.to - conic.from;
            if !(turn > 0.0 && turn <= TAU * (1.0 + 1e-12)) {
                return Err("the arc runs over no angle, or over more than a turn".to_owned());
            }
            let area = conic.x.cross(conic.y).length();
            if area <= 1e-12 * conic.x.length_squared().max(conic.y.length_squared()) {
                return Err("the ellipse is flat".to_owned());
            }
            conic.centre.is_finite() && area.is_finite() && conic.from.is_finite()
        }
        Shape::Polyline { points, .. } => {
            if points.len() < 2 {
                return Err("the polyline has less than two points".to_owned());
            }
            points.iter().all(|it| it.is_finite())
        }
        Shape::Point(point) => point.is_finite(),
    };
    finite
        .then_some(())
        .ok_or_else(|| "a coordinate is no finite number".to_owned())
}

fn check_spline(nurbs: &Nurbs) -> Result<(), String> {
    let Nurbs {
        degree,
        knots,
        points,
        weights,
        ..
    } = nurbs;
    if *degree > HIGHEST_DEGREE {
        return Err(format!(
            "degree {degree} is above {HIGHEST_DEGREE}, which OpenCascade and FreeCAD drop"
        ));
    }
    let rises = knots
        .iter()
        .zip(knots.iter().skip(1))
        .all(|(low, high)| low <= high);
    let range = knots.get(*degree) < knots.get(points.len());
    if *degree == 0
        || points.len() <= *degree
        || knots.len() != points.len() + degree + 1
        || !rises
        || !range
    {
        return Err("degree, points and knots do not make a spline".to_owned());
    }
    let good = |weight: &f64| weight.is_finite() && *weight > 0.0;
    let weighed = weights
        .as_ref()
        .is_none_or(|it| it.len() == points.len() && it.iter().all(good));
    if !weighed || !knots.iter().all(|it| it.is_finite()) {
        return Err("a knot or weight is no number that a spline can have".to_owned());
    }
    Ok(())
}

/// Split a chain where its pieces do not join.
fn runs(shapes: &[Shape]) -> Vec<&[Shape]> {
    let corners: Vec<DVec3> = shapes
        .iter()
        .filter_map(ends)
        .flat_map(|(start, end)| [start, end])
        .collect();
    let near = JOINED * size(&corners);
    shapes
        .chunk_by(
            |before, after| match (before, after, ends(before), ends(after)) {
                (Shape::Point(_), ..) | (_, Shape::Point(_), ..) => false,
                (.., Some((_, end)), Some((start, _))) => end.distance(start) <= near,
                _ => false,
            },
        )
        .collect()
}

fn composite(out: &mut Output, run: &[Shape], name: &str) -> u64 {
    let mut segments = Vec::new();
    let outer = run.first().and_then(ends).zip(run.last().and_then(ends));
    let closed = outer.is_some_and(|((start, _), (_, end))| start == end);
    for (place, shape) in run.iter().enumerate() {
        let parent = add_bounded(out, shape, "");
        let last = place + 1 == run.len();
        let transition = if last && !closed {
            "DISCONTINUOUS"
        } else {
            "CONTINUOUS"
        };
        segments.push(out.add(&format!(
            "COMPOSITE_CURVE_SEGMENT(.{transition}.,.T.,#{parent})"
        )));
    }
    out.add(&format!(
        "COMPOSITE_CURVE({},{},.U.)",
        string(name),
        refs(&segments)
    ))
}

/// Add a shape as a curve of its own.
fn add_whole(out: &mut Output, shape: &Shape, kind: Kind, name: &str) -> u64 {
    match shape {
        Shape::Nurbs(nurbs) if kind == Kind::Bezier => bezier(out, nurbs, name),
        Shape::Conic(conic) if conic.to - conic.from >= TAU * (1.0 - 1e-12) => {
            add_conic(out, &started(conic), name)
        }
        Shape::Polyline {
            points,
            closed: false,
        } if kind == Kind::Line => match points.as_slice() {
            [from, to] if from != to => line(out, *from, *to, name),
            _ => add_bounded(out, shape, name),
        },
        _ => add_bounded(out, shape, name),
    }
}

/// Add a shape as a curve with ends.
fn add_bounded(out: &mut Output, shape: &Shape, name: &str) -> u64 {
    match shape {
        Shape::Nurbs(nurbs) => spline(out, nurbs, name),
        Shape::Conic(conic) => arc(out, &squared(conic), name),
        Shape::Polyline { points, closed } => {
            let mut ids: Vec<u64> = points.iter().map(|it| out.point("", *it)).collect();
            ids.extend(ids.first().copied().filter(|_| *closed));
            out.add(&format!("POLYLINE({},{})", string(name), refs(&ids)))
        }
        Shape::Point(point) => out.point(name, *point),
    }
}

fn line(out: &mut Output, from: DVec3, to: DVec3, name: &str) -> u64 {
    let (start, end) = (out.point("", from), out.point("", to));
    let length = from.distance(to);
    let direction = out.direction((to - from) / length);
    let vector = out.add(&format!("VECTOR('',#{direction},1.0)"));
    let line = out.add(&format!("LINE('',#{start},#{vector})"));
    let trim = |id: u64, at: f64| format!("(#{id},PARAMETER_VALUE({}))", real(at));
    let (start, end) = (trim(start, 0.0), trim(end, length));
    out.add(&format!(
        "TRIMMED_CURVE({},#{line},{start},{end},.T.,.CARTESIAN.)",
        string(name)
    ))
}

fn bezier(out: &mut Output, nurbs: &Nurbs, name: &str) -> u64 {
    if nurbs.weights.is_some()
        || bezier_knots(nurbs.degree, nurbs.points.len()) != Some(nurbs.knots.clone())
    {
        return spline(out, nurbs, name);
    }
    let points = control_points(out, nurbs);
    out.add(&format!("BEZIER_CURVE({},{points})", string(name)))
}

fn spline(out: &mut Output, nurbs: &Nurbs, name: &str) -> u64 {
    let points = control_points(out, nurbs);
    let groups: Vec<&[f64]> = nurbs.knots.chunk_by(|low, high| low == high).collect();
    let times = list(groups.iter().map(|group| group.len().to_string()));
    let knots = list(
        groups
            .iter()
            .filter_map(|group| group.first())
            .map(|knot| real(*knot)),
    );
    let knots = format!("{times},{knots},.UNSPECIFIED.");
    let name = string(name);
    match &nurbs.weights {
        None => out.add(&format!(
            "B_SPLINE_CURVE_WITH_KNOTS({name},{points},{knots})"
        )),
        Some(weights) => {
            let weights = list(weights.iter().map(|it| real(*it)));
            out.add(&format!(
                "(BOUNDED_CURVE()B_SPLINE_CURVE({points})B_SPLINE_CURVE_WITH_KNOTS({knots})CURVE()\
                 GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE({weights})\
                 REPRESENTATION_ITEM({name}))"
            ))
        }
    }
}

/// The degree, the points and what follows them.
fn control_points(out: &mut Output, nurbs: &Nurbs) -> String {
    let points: Vec<u64> = nurbs.points.iter().map(|it| out.point("", *it)).collect();
    let closed = if nurbs.periodic || is_closed(nurbs) && is_clamped(nurbs) {
        "T"
    } else {
        "F"
    };
    format!(
        "{},{},.UNSPECIFIED.,.{closed}.,.F.",
        nurbs.degree,
        refs(&points)
    )
}

fn is_clamped(nurbs: &Nurbs) -> bool {
    let at = |place: usize| nurbs.knots.get(place);
    at(0) == at(nurbs.degree) && at(nurbs.points.len()) == nurbs.knots.last()
}

fn arc(out: &mut Output, conic: &Conic, name: &str) -> u64 {
    let basis = add_conic(out, conic, "");
    let mut trim = |angle: f64| {
        let point = out.point("", on_conic(conic, angle));
        format!("(#{point},PARAMETER_VALUE({}))", real(angle))
    };
    let (from, to) = (trim(conic.from), trim(conic.to));
    out.add(&format!(
        "TRIMMED_CURVE({},#{basis},{from},{to},.T.,.PARAMETER.)",
        string(name)
    ))
}

/// Add the whole circle or ellipse. The direction of x is written as long as the half-axis: so it reads back
/// bit for bit.
fn add_conic(out: &mut Output, conic: &Conic, name: &str) -> u64 {
    let axes = out.axes(conic.centre, conic.x.cross(conic.y).normalize(), conic.x);
    let (first, second) = (conic.x.length(), conic.y.length());
    let name = string(name);
    if (first - second).abs() <= ROUNDING * first {
        out.add(&format!("CIRCLE({name},#{axes},{})", real(first)))
    } else {
        out.add(&format!(
            "ELLIPSE({name},#{axes},{},{})",
            real(first),
            real(second)
        ))
    }
}

/// Turn the axes of a whole conic so that it starts at angle 0.
fn started(conic: &Conic) -> Conic {
    let turned = if conic.from == 0.0 {
        conic.clone()
    } else {
        turned(conic, conic.from)
    };
    let square = squared(&turned);
    Conic {
        from: 0.0,
        to: TAU,
        ..square
    }
}

/// Make the axes perpendicular: a sheared circle is an ellipse on other axes.
fn squared(conic: &Conic) -> Conic {
    let lean = conic.x.dot(conic.y);
    if lean.abs() <= ROUNDING * conic.x.length() * conic.y.length() {
        return conic.clone();
    }
    let turn = (2.0 * lean).atan2(conic.x.length_squared() - conic.y.length_squared()) / 2.0;
    turned(conic, turn)
}

/// Measure the angle of a conic from another point of it.
fn turned(conic: &Conic, turn: f64) -> Conic {
    let (sin, cos) = turn.sin_cos();
    Conic {
        centre: conic.centre,
        x: conic.x * cos + conic.y * sin,
        y: conic.y * cos - conic.x * sin,
        from: conic.from - turn,
        to: conic.to - turn,
    }
}
