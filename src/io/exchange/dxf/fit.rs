//! The cubic through fit points, as AutoCAD draws it: C2 on cumulative chord lengths.

use glam::DVec3;

use crate::io::exchange::drawing::Nurbs;

const DEGREE: usize = 3;

/// What a curve does at its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// The unit tangent at the start; without one the curve has no curvature there.
    pub start: Option<DVec3>,
    /// The same at the end.
    pub end: Option<DVec3>,
    /// Whether it returns to its start, as smoothly as elsewhere if there are no tangents.
    pub is_closed: bool,
}

/// A row of a system of equations: the factors of the unknowns before, at and after the diagonal, and what
/// they make.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    before: f64,
    at: f64,
    after: f64,
    right: DVec3,
}

/// Draw the curve through points of which no neighbours are alike.
///
/// `None` if there are too few of them or they are too far apart.
pub fn interpolate(mut points: Vec<DVec3>, ends: Ends) -> Option<Nurbs> {
    let is_open = points.first() != points.last();
    if ends.is_closed && is_open {
        points.push(*points.first()?);
    }
    let chords: Vec<f64> = points.windows(2).map(chord).collect();
    let is_periodic =
        ends.is_closed && ends.start.is_none() && ends.end.is_none() && chords.len() > 2;
    let length: f64 = chords.iter().sum();
    if chords.is_empty() || !length.is_finite() {
        return None;
    }
    let nurbs = if is_periodic {
        periodic(&points, &chords)
    } else {
        clamped(&points, &chords, ends)
    };
    nurbs
        .points
        .iter()
        .all(|point| point.is_finite())
        .then_some(nurbs)
}

fn chord(pair: &[DVec3]) -> f64 {
    match pair {
        [start, end] => start.distance(*end),
        _ => 0.0,
    }
}

fn clamped(points: &[DVec3], chords: &[f64], ends: Ends) -> Nurbs {
    let zeros = [0.0; DEGREE];
    let steps: Vec<f64> = zeros.iter().chain(chords).chain(&zeros).copied().collect();
    let first = points.first().copied().unwrap_or_default();
    let last = points.last().copied().unwrap_or_default();
    let mut rows = vec![fixed(first), end_row(first, ends.start, chords.iter())];
    let inner = points.iter().skip(1).take(points.len().saturating_sub(2));
    // The first inner knot has the steps 0, 0, h0 before and h1 after it.
    let windows = steps.windows(4).skip(2);
    rows.extend(
        inner
            .zip(windows)
            .map(|(point, around)| inner_row(*point, around)),
    );
    let end = end_row(last, ends.end.map(|tangent| -tangent), chords.iter().rev());
    rows.push(Row {
        before: end.after,
        after: end.before,
        ..end
    });
    rows.push(fixed(last));
    let mut knots = vec![0.0; DEGREE];
    knots.extend(sums(0.0, chords));
    let length = knots.last().copied().unwrap_or_default();
    knots.extend([length; DEGREE]);
    Nurbs {
        degree: DEGREE,
        knots,
        points: solve(&rows),
        weights: None,
        periodic: false,
    }
}

fn fixed(point: DVec3) -> Row {
    Row {
        at: 1.0,
        right: point,
        ..Row::default()
    }
}

/// The row of the second control point: by the tangent into the curve, or with no curvature.
fn end_row<'a>(
    point: DVec3,
    tangent: Option<DVec3>,
    mut chords: impl Iterator<Item = &'a f64>,
) -> Row {
    let first = chords.next().copied().unwrap_or_default();
    let second = chords.next().copied().unwrap_or_default();
    match tangent {
        Some(tangent) => fixed(point + tangent * (first / 3.0)),
        None => Row {
            before: -(first + second) / first,
            at: (2.0 * first + second) / first,
            after: -1.0,
            right: DVec3::ZERO,
        },
    }
}

/// The values of the three basis functions at a knot, by the two steps before and after it.
fn inner_row(point: DVec3, around: &[f64]) -> Row {
    let [far_before, before, after, far_after] = *around else {
        return fixed(point);
    };
    let both = before + after;
    let low = after / both * (after / (far_before + both));
    let high = before / both * (before / (both + far_after));
    let rising = (far_before + before) / (far_before + both) * (after / both);
    let falling = (after + far_after) / (both + far_after) * (before / both);
    Row {
        before: low,
        at: rising + falling,
        after: high,
        right: point,
    }
}

fn sums(start: f64, steps: &[f64]) -> Vec<f64> {
    let mut sums = vec![start];
    let mut sum = start;
    for step in steps {
        sum += step;
        sums.push(sum);
    }
    sums
}

/// Elimination without pivots, which is stable for the collocation matrix of B-splines.
fn solve(rows: &[Row]) -> Vec<DVec3> {
    let mut reduced: Vec<(f64, DVec3)> = Vec::with_capacity(rows.len());
    let (mut after, mut right) = (0.0, DVec3::ZERO);
    for row in rows {
        let pivot = row.at - row.before * after;
        right = (row.right - right * row.before) / pivot;
        after = row.after / pivot;
        reduced.push((after, right));
    }
    let mut next = DVec3::ZERO;
    let mut solution: Vec<DVec3> = Vec::with_capacity(rows.len());
    for (after, right) in reduced.into_iter().rev() {
        next = right - next * after;
        solution.push(next);
    }
    solution.reverse();
    solution
}

fn periodic(points: &[DVec3], chords: &[f64]) -> Nurbs {
    let count = chords.len();
    let before = chords.iter().skip(count.saturating_sub(DEGREE));
    let steps: Vec<f64> = before
        .chain(chords)
        .chain(chords.iter().take(DEGREE))
        .copied()
        .collect();
    let windows = steps.windows(4).skip(1);
    let rows = points.iter().take(count).zip(windows);
    let rows: Vec<Row> = rows
        .map(|(point, around)| inner_row(*point, around))
        .collect();
    let ring = solve_ring(rows);
    let start: f64 = steps.iter().take(DEGREE).sum();
    let last = ring.iter().skip(count.saturating_sub(1));
    Nurbs {
        degree: DEGREE,
        knots: sums(-start, &steps),
        points: last
            .chain(&ring)
            .chain(ring.iter().take(2))
            .copied()
            .collect(),
        weights: None,
        periodic: true,
    }
}

/// Solve rows of which the first and the last are neighbours too, by the formula of Sherman and Morrison.
fn solve_ring(mut rows: Vec<Row>) -> Vec<DVec3> {
    let first = rows.first().copied().unwrap_or_default();
    let last = rows.last().copied().unwrap_or_default();
    let factor = first.before / -first.at;
    if let Some(row) = rows.first_mut() {
        row.at += first.at;
    }
    if let Some(row) = rows.last_mut() {
        row.at -= factor * last.after;
    }
    let plain = solve(&rows);
    for row in &mut rows {
        row.right = DVec3::ZERO;
    }
    if let Some(row) = rows.last_mut() {
        row.right = DVec3::splat(last.after);
    }
    if let Some(row) = rows.first_mut() {
        row.right = DVec3::splat(-first.at);
    }
    let correction = solve(&rows);
    let corner = |solution: &[DVec3]| {
        let start = solution.first().copied().unwrap_or_default();
        start + solution.last().copied().unwrap_or_default() * factor
    };
    let share = corner(&plain) / (1.0 + corner(&correction).x);
    let pairs = plain.iter().zip(&correction);
    pairs
        .map(|(plain, correction)| *plain - share * *correction)
        .collect()
}
