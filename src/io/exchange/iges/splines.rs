//! Parametric splines (type 112) as B-splines.

use glam::DVec3;

use crate::io::exchange::drawing::Nurbs;

/// A segment of a parametric spline: its coefficients by power of the distance from its start.
pub(super) type Segment = [DVec3; 4];

/// How far joined segments may differ, relative to the curve's size, to count as one smooth curve.
///
/// Coefficients written with 17 digits differ by some 1e-16 of the size, those with 7 by 1e-7: the latter
/// keep full knots, which is exact.
const SMOOTH: f64 = 1.0e-13;

/// Convert a parametric spline (type 112) into a B-spline on its own breaks, one more of them than segments.
///
/// # Errors
/// A reason if the breaks do not rise or the segments do not meet.
pub(super) fn of_segments(breaks: &[f64], segments: &[Segment]) -> Result<Nurbs, String> {
    if breaks.windows(2).any(|pair| !(pair[0] < pair[1])) {
        return Err("the breakpoints do not rise".to_owned());
    }
    let degree = (1..=3)
        .rev()
        .find(|power| {
            segments
                .iter()
                .any(|segment| segment[*power] != DVec3::ZERO)
        })
        .unwrap_or(1);
    let size = segments
        .iter()
        .zip(breaks.windows(2))
        .fold(0.0_f64, |size, (segment, pair)| {
            let length = pair[1] - pair[0];
            size.max(Taylor::at(segment, length).0[0].abs().max_element())
                .max(segment[0].abs().max_element())
        });
    let mut knots = vec![breaks[0]; degree + 1];
    for (index, pair) in segments.windows(2).enumerate() {
        let lengths = [
            breaks[index + 1] - breaks[index],
            breaks[index + 2] - breaks[index + 1],
        ];
        let smoothness = smoothness(&pair[0], &pair[1], lengths, size)?;
        let multiplicity = degree.saturating_sub(smoothness).max(1);
        knots.extend(std::iter::repeat_n(breaks[index + 1], multiplicity));
    }
    knots.extend(std::iter::repeat_n(breaks[segments.len()], degree + 1));
    let points = (0..knots.len() - degree - 1)
        .map(|index| control_point(&knots, index, degree, breaks, segments))
        .collect();
    Ok(Nurbs {
        degree,
        knots,
        points,
        weights: None,
        periodic: false,
    })
}

/// Value, first and half the second derivative.
struct Taylor([DVec3; 3]);

impl Taylor {
    fn at(segment: &Segment, t: f64) -> Self {
        let [a, b, c, d] = *segment;
        Self([
            a + (b + (c + d * t) * t) * t,
            b + (c * 2.0 + d * (3.0 * t)) * t,
            c + d * (3.0 * t),
        ])
    }
}

/// How many derivatives two segments share where they meet.
fn smoothness(
    before: &Segment,
    after: &Segment,
    lengths: [f64; 2],
    size: f64,
) -> Result<usize, String> {
    let end = Taylor::at(before, lengths[0]).0;
    let gap = |power: usize| (end[power] - after[power]).abs().max_element();
    if !(gap(0) <= 1.0e-6 * size) {
        return Err("its segments do not meet".to_owned());
    }
    let longest = lengths[0].max(lengths[1]);
    // Control points of segments of very different lengths would extrapolate one of them far.
    let is_even = longest <= 16.0 * lengths[0].min(lengths[1]);
    let is_small = |power: i32, gap: f64| gap * longest.powi(power) <= SMOOTH * size;
    Ok(match is_even {
        true if gap(0) > SMOOTH * size || !is_small(1, gap(1)) => 0,
        true if !is_small(2, gap(2)) => 1,
        true => 2,
        false => 0,
    })
}

/// The blossom of a segment in the middle of a control point's support.
fn control_point(
    knots: &[f64],
    index: usize,
    degree: usize,
    breaks: &[f64],
    segments: &[Segment],
) -> DVec3 {
    let arguments = &knots[index + 1..=index + degree];
    let middle = 0.5 * (arguments[0] + arguments[degree - 1]);
    let after = breaks[..segments.len()].partition_point(|knot| *knot <= middle);
    let number = after.max(1) - 1;
    let [a, b, c, d] = segments[number];
    let t = |at: usize| arguments.get(at).map_or(0.0, |knot| knot - breaks[number]);
    let (t, count) = ([t(0), t(1), t(2)], degree as f64);
    let pairs = t[0] * t[1] + t[0] * t[2] + t[1] * t[2];
    let mut point = a + b * ((t[0] + t[1] + t[2]) / count);
    if degree > 1 {
        point += c * (pairs / (count * (count - 1.0) / 2.0));
    }
    point + d * (t[0] * t[1] * t[2])
}
