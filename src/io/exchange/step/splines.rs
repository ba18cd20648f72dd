//! B-splines: with knots, uniform, quasi-uniform and Bézier, rational or not, as simple or complex instances.

use glam::DVec3;

use super::instances::{Instance, Instances};
use super::placements::point;
use super::tokens::Params;
use crate::io::exchange::drawing::{Kind, Nurbs};

/// Degrees above this are taken for damage: no program uses them, and evaluating them takes ever longer.
const HIGHEST_DEGREE: usize = 128;

/// Whether the instance is a B-spline of any sort.
pub fn is_spline(curve: &Instance) -> bool {
    const NAMES: [&str; 5] = [
        "B_SPLINE_CURVE_WITH_KNOTS",
        "B_SPLINE_CURVE",
        "BEZIER_CURVE",
        "QUASI_UNIFORM_CURVE",
        "UNIFORM_CURVE",
    ];
    NAMES.iter().any(|name| curve.is(name))
}

/// Read a B-spline; the error is the reason.
pub fn spline(file: &Instances, curve: &Instance) -> Result<(Kind, Nurbs), String> {
    let params = body(curve);
    let knots = knot_params(curve);
    let [degree, points, _, closed] = params.first::<4>();
    let degree = degree
        .count()
        .filter(|it| (1..=HIGHEST_DEGREE).contains(it));
    let degree = degree.ok_or(format!("the degree is none from 1 to {HIGHEST_DEGREE}"))?;
    let points = points.list().ok_or("it has no list of points")?;
    let points = control_points(file, points)?;
    if points.len() <= degree {
        return Err(format!(
            "{} points are too few for degree {degree}",
            points.len()
        ));
    }
    let is_bezier = curve.is("BEZIER_CURVE");
    let knots = if let Some(knots) = knots {
        explicit_knots(knots, points.len() + degree + 1)?
    } else if is_bezier {
        bezier_knots(degree, points.len())
            .ok_or("the number of points does not fit Bézier segments")?
    } else if curve.is("QUASI_UNIFORM_CURVE") {
        quasi_uniform_knots(degree, points.len())
    } else if curve.is("UNIFORM_CURVE") {
        (0..points.len() + degree + 1)
            .map(|place| place as f64 - degree as f64)
            .collect()
    } else {
        return Err("it has no knots".to_owned());
    };
    if knots.get(degree) >= knots.get(points.len()) {
        return Err("its knots leave no range for the parameter".to_owned());
    }
    let weights = weights(curve, points.len())?;
    let periodic = closed.is("T") && knots.first() < knots.get(degree);
    let kind = if is_bezier {
        Kind::Bezier
    } else {
        Kind::Spline
    };
    Ok((
        kind,
        Nurbs {
            degree,
            knots,
            points,
            weights,
            periodic,
        },
    ))
}

/// Make the knots of Bézier segments, 0 to their number; none if the points do not fit.
pub fn bezier_knots(degree: usize, points: usize) -> Option<Vec<f64>> {
    let segments = points.checked_sub(1)? / degree.max(1);
    if segments == 0 || segments * degree + 1 != points {
        return None;
    }
    let mut knots = vec![0.0];
    for knot in 0..=segments {
        knots.extend(std::iter::repeat_n(knot as f64, degree));
    }
    knots.push(segments as f64);
    Some(knots)
}

fn quasi_uniform_knots(degree: usize, points: usize) -> Vec<f64> {
    let last = points.saturating_sub(degree);
    (0..points + degree + 1)
        .map(|place| place.saturating_sub(degree).min(last) as f64)
        .collect()
}

/// The degree and what follows it.
fn body<'a>(curve: &Instance<'a>) -> Params<'a> {
    let params = curve.params();
    if params.clone().next().is_none() {
        return curve.part("B_SPLINE_CURVE").unwrap_or_default();
    }
    let mut params = params;
    params.next();
    params
}

/// The multiplicities and the knots.
fn knot_params<'a>(curve: &Instance<'a>) -> Option<Params<'a>> {
    let mut params = curve.part("B_SPLINE_CURVE_WITH_KNOTS")?;
    if curve.params().next().is_some() {
        params.nth(5);
    }
    Some(params)
}

fn control_points(file: &Instances, list: Params) -> Result<Vec<DVec3>, String> {
    let mut points = Vec::new();
    for value in list {
        let id = value.reference().ok_or("a control point is no reference")?;
        points
            .push(point(file, id).ok_or(format!("its control point #{id} is missing or damaged"))?);
    }
    Ok(points)
}

fn explicit_knots(params: Params, count: usize) -> Result<Vec<f64>, String> {
    let [multiplicities, values] = params.first::<2>();
    let (Some(multiplicities), Some(values)) = (multiplicities.list(), values.list()) else {
        return Err("it has no lists of knots".to_owned());
    };
    let mut knots: Vec<f64> = Vec::new();
    let mut multiplicities = multiplicities.fuse();
    for value in values {
        let knot = value.number().ok_or("a knot is no number")?;
        let times = multiplicities.next().and_then(|it| it.count());
        let times = times.ok_or("a knot has no multiplicity")?;
        if knots.last().is_some_and(|last| *last > knot) {
            return Err("its knots fall".to_owned());
        }
        if times > count - knots.len() {
            return Err(format!("its points need {count} knots, it has more"));
        }
        knots.extend(std::iter::repeat_n(knot, times));
    }
    if knots.len() != count {
        return Err(format!("it has {} knots and needs {count}", knots.len()));
    }
    Ok(knots)
}

fn weights(curve: &Instance, count: usize) -> Result<Option<Vec<f64>>, String> {
    let Some(params) = curve.part("RATIONAL_B_SPLINE_CURVE") else {
        return Ok(None);
    };
    let list = if curve.params().next().is_some() {
        params.last()
    } else {
        params.first::<1>().into_iter().next()
    };
    let list = list
        .and_then(|it| it.list())
        .ok_or("it has no list of weights")?;
    let mut weights = Vec::new();
    for value in list {
        let weight = value.number().filter(|it| *it > 0.0);
        weights.push(weight.ok_or("a weight is not positive")?);
    }
    if weights.len() != count {
        return Err(format!(
            "it has {} weights for {count} points",
            weights.len()
        ));
    }
    let alike = weights.windows(2).all(|pair| pair.first() == pair.last());
    Ok((!alike).then_some(weights))
}
