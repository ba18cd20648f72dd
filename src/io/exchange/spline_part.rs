//! The part of a B-spline between two parameters, by de Boor's algorithm.

use glam::{DVec3, DVec4};

use crate::io::exchange::drawing::{Nurbs, Shape};

/// Cut a spline to the part from `from` to `to`, within its domain; ends of the domain stay as they are.
///
/// The knots and points that survive are the same doubles. The spline must be valid: rising knots,
/// `points + degree + 1` of them, and a domain that is no point.
pub(super) fn cut(mut nurbs: Nurbs, from: f64, to: f64) -> Nurbs {
    if to < nurbs.knots[nurbs.points.len()] {
        cut_after(&mut nurbs, to);
    }
    if from > nurbs.knots[nurbs.degree] {
        cut_before(&mut nurbs, from);
    }
    nurbs
}

/// The points at the ends of a valid spline's domain.
pub(super) fn end_points(nurbs: &Nurbs) -> (DVec3, DVec3) {
    let domain = (nurbs.knots[nurbs.degree], nurbs.knots[nurbs.points.len()]);
    let (mut first, mut last) = (nurbs.clone(), nurbs.clone());
    cut_before(&mut first, domain.0);
    cut_after(&mut last, domain.1);
    (first.points[0], last.points[last.points.len() - 1])
}

/// Check that a spline is one curve: fitting counts, rising knots, positive weights, no knot that tears it.
///
/// # Errors
/// The reason why it is none.
pub(super) fn check(nurbs: &Nurbs) -> Result<(), String> {
    let (degree, count, knots) = (nurbs.degree, nurbs.points.len(), &nurbs.knots);
    if degree == 0 || count <= degree || knots.len() != count + degree + 1 {
        let knots = knots.len();
        return Err(format!(
            "{count} points and {knots} knots do not fit degree {degree}"
        ));
    }
    if knots.windows(2).any(|pair| !(pair[0] <= pair[1])) {
        return Err("the knots do not rise".to_owned());
    }
    if knots[degree] == knots[count] {
        return Err("the knots span no length".to_owned());
    }
    let is_torn = |run: &[f64]| run[0] == run[degree];
    if knots[1..count + degree].windows(degree + 1).any(is_torn) {
        return Err(format!("a knot inside occurs more than {degree} times"));
    }
    let weights = nurbs.weights.as_deref().unwrap_or_default();
    if nurbs.weights.is_some() && weights.len() != count {
        return Err(format!(
            "{} weights do not fit {count} points",
            weights.len()
        ));
    }
    if weights.iter().any(|weight| !(*weight > 0.0)) {
        return Err("a weight is not positive".to_owned());
    }
    Ok(())
}

/// Say whether all numbers of a shape are finite.
pub(super) fn is_finite(shape: &Shape) -> bool {
    match shape {
        Shape::Nurbs(nurbs) => {
            nurbs.points.iter().all(|point| point.is_finite())
                && nurbs
                    .knots
                    .iter()
                    .chain(nurbs.weights.iter().flatten())
                    .all(|it| it.is_finite())
        }
        Shape::Conic(conic) => {
            let is_placed = conic.centre.is_finite() && conic.x.is_finite() && conic.y.is_finite();
            is_placed && conic.from.is_finite() && conic.to.is_finite()
        }
        Shape::Polyline { points, .. } => points.iter().all(|point| point.is_finite()),
        Shape::Point(point) => point.is_finite(),
    }
}

fn cut_after(nurbs: &mut Nurbs, at: f64) {
    let degree = nurbs.degree;
    // The span whose end is `at` or behind it.
    let after = nurbs.knots[..nurbs.points.len()].partition_point(|knot| *knot < at);
    let span = (after.max(degree + 1)) - 1;
    let levels = de_boor(nurbs, span, at);
    let kept = span - degree;
    let new: Vec<DVec4> = (0..=degree).map(|level| levels[level][0]).collect();
    nurbs.points.truncate(kept);
    if let Some(weights) = &mut nurbs.weights {
        weights.truncate(kept);
    }
    nurbs.knots.truncate(span + 1);
    nurbs.knots.extend(std::iter::repeat_n(at, degree + 1));
    for point in new {
        nurbs.points.push(point.truncate() / point.w);
        if let Some(weights) = &mut nurbs.weights {
            weights.push(point.w);
        }
    }
}

fn cut_before(nurbs: &mut Nurbs, at: f64) {
    let degree = nurbs.degree;
    // The span that begins at `at` or before it.
    let after = nurbs.knots[..nurbs.points.len()].partition_point(|knot| *knot <= at);
    let span = after.max(degree + 1) - 1;
    let levels = de_boor(nurbs, span, at);
    let new = (0..=degree)
        .rev()
        .map(|level| levels[level][degree - level]);
    let (points, weights): (Vec<DVec3>, Vec<f64>) = new
        .map(|point| (point.truncate() / point.w, point.w))
        .unzip();
    nurbs.points.splice(..=span, points);
    if let Some(all) = &mut nurbs.weights {
        all.splice(..=span, weights);
    }
    nurbs
        .knots
        .splice(..=span, std::iter::repeat_n(at, degree + 1));
}

/// The triangle of de Boor's algorithm in a span, homogeneous: level after level, one point fewer each.
fn de_boor(nurbs: &Nurbs, span: usize, at: f64) -> Vec<Vec<DVec4>> {
    let degree = nurbs.degree;
    let start = span - degree;
    let homogeneous = |index: usize| {
        let weight = nurbs.weights.as_ref().map_or(1.0, |weights| weights[index]);
        (nurbs.points[index] * weight).extend(weight)
    };
    let mut levels = vec![(start..=span).map(homogeneous).collect::<Vec<_>>()];
    for level in 1..=degree {
        let last = &levels[level - 1];
        let next = (0..=degree - level).map(|index| {
            let low = nurbs.knots[start + index + level];
            let high = nurbs.knots[span + index + 1];
            let ratio = (at - low) / (high - low);
            let mixed = last[index] * (1.0 - ratio) + last[index + 1] * ratio;
            if nurbs.weights.is_some() {
                mixed
            } else {
                mixed.truncate().extend(1.0)
            }
        });
        levels.push(next.collect());
    }
    levels
}
