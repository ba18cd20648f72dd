//! The knots of a curve: 3DM leaves out the first and the last of them, which the curve does not depend on.

use glam::DVec3;

/// Points that differ by less than this part of their size are the same: about what the programs
/// that write these files allow.
const SAME: f64 = 1e-10;
/// The same for the spaces between knots, as a part of the whole.
const SAME_STEP: f64 = 1e-8;

/// Add the first and the last knot to those of a file.
pub(super) fn complete(
    inner: &[f64],
    degree: usize,
    points: usize,
    periodic: bool,
) -> Result<Vec<f64>, String> {
    let wrong = || "its knots are wrong".to_owned();
    let count = points.checked_add(degree).ok_or_else(wrong)?;
    if degree == 0 || points <= degree || inner.len() != count - 1 {
        return Err(format!(
            "it has {} knots for {points} points of degree {degree}",
            inner.len()
        ));
    }
    let first = outer(inner, degree, points, periodic, |index| index).ok_or_else(wrong)?;
    let last =
        outer(inner, degree, points, periodic, |index| count - 2 - index).ok_or_else(wrong)?;
    let mut knots = Vec::with_capacity(count + 1);
    knots.push(first);
    knots.extend_from_slice(inner);
    knots.push(last);
    check(&knots, degree, points)?;
    Ok(knots)
}

/// The knot before the first one, or with `side` counting from the end the knot after the last one.
fn outer(
    inner: &[f64],
    degree: usize,
    points: usize,
    periodic: bool,
    side: impl Fn(usize) -> usize,
) -> Option<f64> {
    let knot = |index: usize| inner.get(side(index)).copied();
    let end = knot(0)?;
    if end == knot(degree - 1)? {
        return Some(end);
    }
    if periodic {
        let period = knot(points - 1)? - knot(degree - 1)?;
        return Some(knot(points.checked_sub(degree + 1)?)? - period);
    }
    Some(end - (knot(1)? - end))
}

fn check(knots: &[f64], degree: usize, points: usize) -> Result<(), String> {
    if !knots.iter().all(|knot| knot.is_finite()) {
        return Err("a knot is no number".to_owned());
    }
    if !knots.is_sorted() {
        return Err("its knots do not rise".to_owned());
    }
    if knots.get(degree) >= knots.get(points) {
        return Err("its knots have no length".to_owned());
    }
    let span = degree.saturating_add(2);
    if knots.windows(span).any(|run| run.first() == run.last()) {
        return Err("a knot occurs too often".to_owned());
    }
    Ok(())
}

/// Whether the knots of a file and the points that belong to them repeat with a period.
pub(super) fn periodic(
    inner: &[f64],
    degree: usize,
    points: &[DVec3],
    weights: Option<&[f64]>,
) -> bool {
    let count = points.len();
    let least = if degree <= 3 { degree + 3 } else { 2 * degree };
    if degree < 2 || count < least {
        return false;
    }
    repeats(inner, degree, count) && wraps(points, degree) && wrapped_weights(weights, degree)
}

fn repeats(inner: &[f64], degree: usize, count: usize) -> bool {
    let (Some(first), Some(last)) = (inner.get(degree - 1), inner.get(count - 1)) else {
        return false;
    };
    let tolerance = SAME_STEP * (last - first);
    let steps = |skip: usize| inner.iter().skip(skip).zip(inner.iter().skip(skip + 1));
    steps(0)
        .zip(steps(count - degree))
        .take(2 * (degree - 1))
        .all(|((a, b), (c, d))| ((b - a) - (d - c)).abs() <= tolerance)
}

fn wraps(points: &[DVec3], degree: usize) -> bool {
    let size = points
        .iter()
        .fold(0.0, |size: f64, point| size.max(point.abs().max_element()));
    let tail = points.iter().skip(points.len() - degree);
    points
        .iter()
        .zip(tail)
        .all(|(a, b)| (*a - *b).abs().max_element() <= SAME * size)
}

fn wrapped_weights(weights: Option<&[f64]>, degree: usize) -> bool {
    let Some(weights) = weights else { return true };
    let tail = weights.iter().skip(weights.len().saturating_sub(degree));
    weights
        .iter()
        .zip(tail)
        .all(|(a, b)| (a - b).abs() <= SAME * a.abs())
}
