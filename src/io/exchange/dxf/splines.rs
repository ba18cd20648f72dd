//! SPLINE: by control points, or by fit points alone.

use glam::DVec3;

use super::fit::{Ends, interpolate};
use super::groups::{Group, Trouble};
use super::notes::Notes;
use super::records::{Record, real};
use crate::io::exchange::drawing::{Nurbs, Shape};

/// Bits of group 70.
const CLOSED: i64 = 1;
const PERIODIC: i64 = 2;

/// The lists of a SPLINE.
#[derive(Debug, Default)]
struct Lists {
    knots: Vec<f64>,
    weights: Vec<f64>,
    control: Points,
    fit: Points,
}

/// Points as they come, a coordinate at a time.
#[derive(Debug, Default)]
struct Points {
    points: Vec<DVec3>,
    /// How many points have a y.
    ys: usize,
}

/// Read a SPLINE, or the spline of a HELIX.
///
/// # Errors
/// [`Trouble`] if its numbers make no curve.
pub fn spline(record: &Record<'_>, notes: &mut Notes) -> Result<Shape, Trouble> {
    let lists = lists(record)?;
    if !lists.control.are_whole() || !lists.fit.are_whole() {
        return Err(record.trouble("a point has no y"));
    }
    let is_fit = lists.control.points.is_empty() && !lists.fit.points.is_empty();
    let nurbs = if is_fit {
        fitted(record, lists.fit.points, notes)?
    } else {
        controlled(record, lists, notes)?
    };
    Ok(Shape::Nurbs(nurbs))
}

impl Points {
    fn add(&mut self, axis: i32, value: f64) {
        match (axis, self.points.last_mut()) {
            (0, _) => self.points.push(DVec3::new(value, 0.0, 0.0)),
            (1, Some(point)) => {
                point.y = value;
                self.ys += 1;
            }
            (2, Some(point)) => point.z = value,
            _ => {}
        }
    }

    fn are_whole(&self) -> bool {
        self.ys == self.points.len()
    }
}

fn lists(record: &Record<'_>) -> Result<Lists, Trouble> {
    let mut lists = Lists::default();
    // The axis of a HELIX comes under the codes of its spline.
    let is_helix = |group: &Group<'_>| group.code == 100 && group.value.text() == b"AcDbHelix";
    for group in record.groups().take_while(|group| !is_helix(group)) {
        match group.code {
            40 => lists.knots.push(real(group)?),
            41 => lists.weights.push(real(group)?),
            10 | 20 | 30 => lists.control.add(group.code / 10 - 1, real(group)?),
            11 | 21 | 31 => lists.fit.add(group.code / 10 - 1, real(group)?),
            _ => {}
        }
    }
    Ok(lists)
}

fn controlled(record: &Record<'_>, lists: Lists, notes: &mut Notes) -> Result<Nurbs, Trouble> {
    let Lists {
        mut knots,
        weights,
        control,
        ..
    } = lists;
    let mut points = control.points;
    let said = record.integer(71)?;
    let count = points.len();
    let degree = usize::try_from(said)
        .ok()
        .filter(|degree| (1..count).contains(degree));
    let Some(degree) = degree else {
        if said == 0 {
            return Err(record.trouble("its degree is missing".to_owned()));
        }
        return Err(record.trouble(format!("degree {said} does not fit {count} control points")));
    };
    let mut weights = checked_weights(record, weights, count)?;
    let periodic = record.integer(70)? & PERIODIC != 0;
    if knots.is_empty() {
        notes.add(
            record.at,
            "SPLINE has no knots; clamped uniform ones are taken",
        );
        knots = uniform(degree, count);
    } else if periodic && knots.len() == count + 1 {
        notes.add(
            record.at,
            "SPLINE holds one period; its points and knots are repeated",
        );
        knots = unrolled(degree, &knots);
        points.extend_from_within(..degree);
        if let Some(weights) = &mut weights {
            weights.extend_from_within(..degree);
        }
    }
    check_knots(record, degree, points.len(), &knots)?;
    Ok(Nurbs {
        degree,
        knots,
        points,
        weights,
        periodic,
    })
}

/// Continue the knots of one period by `degree` knots on both sides.
fn unrolled(degree: usize, knots: &[f64]) -> Vec<f64> {
    let first = knots.first().copied().unwrap_or_default();
    let last = knots.last().copied().unwrap_or_default();
    let period = last - first;
    let before = knots
        .iter()
        .skip(knots.len().saturating_sub(degree + 1))
        .take(degree);
    let after = knots.iter().skip(1).take(degree);
    let before = before.map(|knot| knot - period);
    let after = after.map(|knot| knot + period);
    before.chain(knots.iter().copied()).chain(after).collect()
}

fn check_knots(
    record: &Record<'_>,
    degree: usize,
    points: usize,
    knots: &[f64],
) -> Result<(), Trouble> {
    let (found, wanted) = (knots.len(), points.saturating_add(degree + 1));
    if found != wanted {
        let points = format!("{points} control points of degree {degree}");
        return Err(record.trouble(format!("{points} take {wanted} knots, not {found}")));
    }
    if !knots.is_sorted() {
        return Err(record.trouble("its knots fall"));
    }
    if knots.get(degree) >= knots.get(points) {
        return Err(record.trouble("its knots leave no curve"));
    }
    Ok(())
}

fn checked_weights(
    record: &Record<'_>,
    weights: Vec<f64>,
    points: usize,
) -> Result<Option<Vec<f64>>, Trouble> {
    let found = weights.len();
    if found == 0 {
        return Ok(None);
    }
    if found != points {
        return Err(record.trouble(format!(
            "{points} control points take as many weights, not {found}"
        )));
    }
    if let Some(weight) = weights.iter().find(|weight| **weight <= 0.0) {
        return Err(record.trouble(format!("weight {weight} is not above 0")));
    }
    let first = weights.first().copied();
    let are_alike = weights.iter().all(|weight| Some(*weight) == first);
    Ok((!are_alike).then_some(weights))
}

fn uniform(degree: usize, points: usize) -> Vec<f64> {
    let last = points.saturating_sub(degree);
    let inner = (1..last).map(|knot| knot as f64);
    let start = std::iter::repeat_n(0.0, degree + 1);
    let end = std::iter::repeat_n(last as f64, degree + 1);
    start.chain(inner).chain(end).collect()
}

fn fitted(
    record: &Record<'_>,
    mut points: Vec<DVec3>,
    notes: &mut Notes,
) -> Result<Nurbs, Trouble> {
    let given = points.len();
    points.dedup();
    if points.len() < given {
        let repeated = given - points.len();
        notes.add(
            record.at,
            format_args!("SPLINE repeats {repeated} fit points, which are left out"),
        );
    }
    let tangent = |code| {
        let tangent = record.point(code)?.unwrap_or_default();
        Ok((tangent / tangent.abs().max_element()).try_normalize())
    };
    let ends = Ends {
        start: tangent(12)?,
        end: tangent(13)?,
        is_closed: record.integer(70)? & CLOSED != 0,
    };
    let said = record.integer(71)?;
    if said != 3 || ends.start.is_none() || ends.end.is_none() {
        let missing = if said == 3 {
            "end tangents"
        } else {
            "cubic degree"
        };
        let remark = format_args!("SPLINE by fit points is approximated: it has no {missing}");
        notes.add(record.at, remark);
    }
    let none = || record.trouble("its fit points make no curve");
    interpolate(points, ends).ok_or_else(none)
}
