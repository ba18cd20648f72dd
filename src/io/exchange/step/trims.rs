//! Ends of curves: by parameters, by points or by the vertices of an edge.

use glam::DVec3;

use super::cuts::{chain_reversed, conic_part, is_closed, polyline_part, size, spline_part};
use super::evaluation::{Homogeneous, angle_of, end, ends, on_conic, parameter_of, start};
use super::form::Form;
use super::instances::Instances;
use super::placements::point;
use super::tokens::Params;
use crate::io::exchange::drawing::{Conic, Nurbs, Shape};

/// What cutting takes of the file.
#[derive(Clone, Copy)]
pub struct Cutting<'f, 'a> {
    /// The file, whose time is spent.
    pub file: &'f Instances<'a>,
    /// The radians of the context's plane angle.
    pub angle: f64,
}

/// One end of a trimmed curve; it has a point or a parameter.
#[derive(Clone, Copy)]
pub struct Trim {
    point: Option<DVec3>,
    parameter: Option<f64>,
}

/// The distance, of the size, up to which points count as one.
const NEAR: f64 = 1e-7;
/// The distance, of the size, beyond which a point is not taken for one of the curve.
const FAR: f64 = 1e-3;

impl Trim {
    /// Read the list of an end.
    pub fn read(file: &Instances, list: Params) -> Option<Self> {
        let mut trim = Self {
            point: None,
            parameter: None,
        };
        for value in list {
            match value.reference() {
                Some(id) => trim.point = point(file, id).or(trim.point),
                None => trim.parameter = value.number().or(trim.parameter),
            }
        }
        (trim.point.is_some() || trim.parameter.is_some()).then_some(trim)
    }

    fn on(point: DVec3) -> Self {
        Self {
            point: Some(point),
            parameter: None,
        }
    }
}

type Trimmed = Result<(Vec<Shape>, Option<&'static str>), String>;

/// Cut a curve at two ends, along its sense or against it; what was repaired comes beside.
pub fn trimmed(
    cutting: &Cutting,
    form: Form,
    trims: [Trim; 2],
    forward: bool,
    by_points: bool,
) -> Trimmed {
    match form {
        Form::Line { point, step } => Ok((vec![segment(point, step, trims, by_points)], None)),
        Form::Shapes(shapes) => match <[Shape; 1]>::try_from(shapes) {
            Ok([Shape::Conic(conic)]) => {
                Ok(conic_between(cutting, conic, trims, forward, by_points))
            }
            Ok([Shape::Nurbs(nurbs)]) => {
                let shape = spline_between(cutting, &nurbs, trims, forward, by_points)?;
                Ok((vec![shape], None))
            }
            Ok([Shape::Polyline { points, closed }]) => {
                let shape = polyline_between(points, closed, trims, forward, by_points)?;
                Ok((vec![shape], None))
            }
            Ok([Shape::Point(_)]) => Err("a point cannot be trimmed".to_owned()),
            Err(chain) => Ok((chain_between(chain, trims, forward)?, None)),
        },
    }
}

/// Cut the curve of an edge from vertex to vertex. The error has the reason and the whole curve.
pub fn between(
    cutting: &Cutting,
    form: Form,
    start: DVec3,
    end: DVec3,
    forward: bool,
) -> Result<Vec<Shape>, (String, Vec<Shape>)> {
    let whole = match &form {
        Form::Line { .. } => Vec::new(),
        Form::Shapes(shapes) if forward => shapes.clone(),
        Form::Shapes(shapes) => chain_reversed(shapes.clone()),
    };
    match trimmed(
        cutting,
        form,
        [Trim::on(start), Trim::on(end)],
        forward,
        true,
    ) {
        Ok((shapes, _)) => Ok(shapes),
        Err(reason) => Err((reason, whole)),
    }
}

fn segment(origin: DVec3, step: DVec3, trims: [Trim; 2], by_points: bool) -> Shape {
    // A point that is on the line but for rounding is taken bit for bit, so that neighbours meet.
    let on_line = |point: DVec3| {
        let nearest = origin + step * ((point - origin).dot(step) / step.length_squared());
        let near = 1e-12 * (point - origin).length().max(origin.length());
        if nearest.distance(point) > near {
            nearest
        } else {
            point
        }
    };
    let points = trims.iter().map(|trim| match (trim.point, trim.parameter) {
        (Some(point), None) => on_line(point),
        (Some(point), Some(_)) if by_points => on_line(point),
        (_, parameter) => origin + step * parameter.unwrap_or(0.0),
    });
    Shape::Polyline {
        points: points.collect(),
        closed: false,
    }
}

fn conic_between(
    cutting: &Cutting,
    conic: Conic,
    trims: [Trim; 2],
    forward: bool,
    by_points: bool,
) -> (Vec<Shape>, Option<&'static str>) {
    let on_curve = |trim: &Trim| {
        let Trim { point, parameter } = trim;
        let size = conic.x.length().max(conic.y.length());
        match (point, parameter) {
            (Some(point), Some(parameter)) => {
                on_conic(&conic, parameter * cutting.angle).distance(*point) <= FAR * size
            }
            _ => true,
        }
    };
    let agree = trims.iter().all(on_curve);
    let angle = |trim: &Trim| match (trim.point, trim.parameter) {
        (Some(point), None) => rounded(angle_of(&conic, point)),
        (Some(point), Some(_)) if by_points || !agree => rounded(angle_of(&conic, point)),
        (_, parameter) => parameter.unwrap_or(0.0) * cutting.angle,
    };
    let [first, last] = &trims;
    let (from, to) = (angle(first), angle(last));
    let repair =
        (!agree && !by_points).then_some("its parameters miss its points; the points are taken");
    (vec![conic_part(conic, from, to, forward)], repair)
}

/// Clear rounding from the angle of the first point.
fn rounded(angle: f64) -> f64 {
    if angle.abs() < 1e-14 { 0.0 } else { angle }
}

fn spline_between(
    cutting: &Cutting,
    nurbs: &Nurbs,
    trims: [Trim; 2],
    forward: bool,
    by_points: bool,
) -> Result<Shape, String> {
    let ends = domain(nurbs).ok_or("it has no range of parameters")?;
    let closed = is_closed(nurbs);
    let homogeneous = Homogeneous::of(nurbs);
    let parameter = |trim: &Trim, is_first: bool| match (trim.point, trim.parameter) {
        (Some(point), None) => located(
            cutting,
            nurbs,
            &homogeneous,
            point,
            (is_first == forward, closed),
        ),
        (Some(point), Some(_)) if by_points => located(
            cutting,
            nurbs,
            &homogeneous,
            point,
            (is_first == forward, closed),
        ),
        (_, Some(parameter)) => Ok(parameter),
        _ => Err("an end has no parameter".to_owned()),
    };
    let [first, last] = &trims;
    let from = parameter(first, true)?;
    let to = parameter(last, false)?;
    if from == to && !closed {
        return Err("both its ends are one point".to_owned());
    }
    if closed && from == to && (from == ends.0 || from == ends.1) {
        let whole = Shape::Nurbs(nurbs.clone());
        return Ok(if forward { whole } else { whole.reversed() });
    }
    let part = spline_part(nurbs.clone(), from, to, forward);
    part.ok_or_else(|| "its ends are outside its range".to_owned())
}

/// Find the parameter of a point. `side` says whether the curve begins there, and whether it is closed.
fn located(
    cutting: &Cutting,
    nurbs: &Nurbs,
    homogeneous: &Homogeneous,
    point: DVec3,
    side: (bool, bool),
) -> Result<f64, String> {
    let damaged = || "its knots are damaged".to_owned();
    let (low, high) = domain(nurbs).ok_or_else(damaged)?;
    let (first, last) = (
        start(nurbs).ok_or_else(damaged)?,
        end(nurbs).ok_or_else(damaged)?,
    );
    let size = size(&nurbs.points);
    let (begins, closed) = side;
    let joint = if begins { low } else { high };
    let snap = |near: f64| {
        let (to_first, to_last) = (first.distance(point), last.distance(point));
        match (to_first <= near, to_last <= near) {
            (true, _) | (_, true) if closed => Some(joint),
            (true, false) => Some(low),
            (false, true) => Some(high),
            (true, true) => Some(joint),
            (false, false) => None,
        }
    };
    if let Some(found) = snap(1e-12 * size) {
        return Ok(found);
    }
    let work = nurbs.points.len() as u64 * (nurbs.degree as u64 + 1).pow(3);
    if !cutting.file.charge(work) {
        return Err("the file needs too much time".to_owned());
    }
    let parameter = parameter_of(homogeneous, point).ok_or_else(damaged)?;
    let off = homogeneous
        .at(parameter)
        .ok_or_else(damaged)?
        .distance(point);
    if off > FAR * size {
        return Err("its end is not on its curve".to_owned());
    }
    Ok(snap((2.0 * off).max(NEAR * size)).unwrap_or(parameter))
}

fn polyline_between(
    points: Vec<DVec3>,
    closed: bool,
    trims: [Trim; 2],
    forward: bool,
    by_points: bool,
) -> Result<Shape, String> {
    let scale = size(&points);
    let corners = points.len();
    let mut best = Vec::new();
    for trim in &trims {
        best.push(match (trim.point, trim.parameter) {
            (Some(point), None) => corner_of(&points, closed, point, scale)?,
            (Some(point), Some(_)) if by_points => corner_of(&points, closed, point, scale)?,
            (_, parameter) => parameter.unwrap_or(0.0),
        });
    }
    let (Some(mut from), Some(mut to)) = (best.first().copied(), best.last().copied()) else {
        return Err("it has no ends".to_owned());
    };
    let last = corners as f64;
    if closed {
        if from == to && (from == 0.0 || from == last) {
            let whole = Shape::Polyline { points, closed };
            return Ok(if forward { whole } else { whole.reversed() });
        }
        let (low, high) = if forward {
            (&mut from, &mut to)
        } else {
            (&mut to, &mut from)
        };
        if *high == 0.0 {
            *high = last;
        }
        if *low == last {
            *low = 0.0;
        }
    } else if from == 0.0 && to == last - 1.0 {
        return Ok(Shape::Polyline { points, closed });
    } else if to == 0.0 && from == last - 1.0 {
        return Ok(Shape::Polyline { points, closed }.reversed());
    }
    polyline_part(points, closed, from, to, forward)
        .ok_or_else(|| "its ends are outside its range".to_owned())
}

/// Find the nearest place on a chain of corners: the number of the corner, and the share of the way to the
/// next.
fn corner_of(points: &[DVec3], closed: bool, point: DVec3, size: f64) -> Result<f64, String> {
    let next = points
        .iter()
        .skip(1)
        .chain(points.first().filter(|_| closed));
    let mut best = (f64::INFINITY, 0.0);
    for (place, (low, high)) in points.iter().zip(next).enumerate() {
        let side = *high - *low;
        let share = ((point - *low).dot(side) / side.length_squared()).clamp(0.0, 1.0);
        let share = if *high == point || !share.is_finite() {
            1.0
        } else {
            share
        };
        let distance = low.lerp(*high, share).distance(point);
        if distance < best.0 {
            best = (distance, place as f64 + share);
        }
    }
    if best.0 > FAR * size {
        return Err("its end is not on its curve".to_owned());
    }
    Ok(best.1)
}

/// A chain is taken whole, in the sense in which its ends lie.
fn chain_between(chain: Vec<Shape>, trims: [Trim; 2], forward: bool) -> Result<Vec<Shape>, String> {
    let chain = if forward {
        chain
    } else {
        chain_reversed(chain)
    };
    let outer = chain
        .first()
        .and_then(ends)
        .zip(chain.last().and_then(ends));
    let ((start, _), (_, end)) = outer.ok_or("it has no ends")?;
    let [first, last] = trims;
    let pieces = chain.iter().filter_map(ends);
    let scale = pieces.fold(0.0f64, |scale, (_, it)| scale.max(it.distance(start)));
    let fits = |trim: Trim, end: DVec3| {
        trim.point
            .is_some_and(|it| it.distance(end) <= NEAR * scale)
    };
    if fits(first, start) && fits(last, end) {
        Ok(chain)
    } else {
        Err("it cuts a composite curve within".to_owned())
    }
}

fn domain(nurbs: &Nurbs) -> Option<(f64, f64)> {
    Some((
        *nurbs.knots.get(nurbs.degree)?,
        *nurbs.knots.get(nurbs.points.len())?,
    ))
}
