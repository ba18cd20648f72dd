//! A number of points spread over a curve.

use std::f64::consts::PI;

use super::arc_length::arc_length_between;
use super::parametric_curve::ParametricCurve;
use super::polyline::{MOST_POINTS, polyline_deviation};
use super::root::maximum;
use super::vector::length;

/// The relative error allowed in lengths.
const LENGTH_TOLERANCE: f64 = 1e-12;

/// The most steps that find a place by its arc length; Newton's method takes about four.
const MOST_STEPS: usize = 60;

/// The ends of a section are nearer to each other than this share of the way to its nose.
const NEAR_ENDS: f64 = 0.1;

/// Samples of a piece among which the nose is looked for.
const SAMPLES: usize = 8;

/// With so many points a piece, and at most a curve that bends, the deviation falls with the square of their number, or
/// slower; a number this many times too large is out of reach then.
const SETTLED: usize = 16;
const FAR: f64 = 4.0;

/// How points are spread over a curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spacing {
    /// Evenly by arc length.
    #[default]
    ArcLength,
    /// Densely at both ends, s = L (1 − cos φ) / 2 for even φ. A curve that comes back to where it begins, as
    /// the section of a wing, is spread so on either side of its nose, the point farthest from its ends.
    Cosine,
    /// Evenly by the parameter u.
    Parameter,
}

impl Spacing {
    /// Every spacing.
    pub const ALL: [Self; 3] = [Self::ArcLength, Self::Cosine, Self::Parameter];

    /// Its name: arc-length, cosine or parameter.
    pub fn name(self) -> &'static str {
        match self {
            Self::ArcLength => "arc-length",
            Self::Cosine => "cosine",
            Self::Parameter => "parameter",
        }
    }

    /// Find the parameters of at least two points, both ends of the curve among them. The points of a
    /// periodic curve end where they begin.
    pub fn parameters(self, curve: &dyn ParametricCurve, count: usize) -> Vec<f64> {
        let legs = count.max(2) - 1;
        let even = |index: usize| index as f64 / legs as f64;
        if self == Self::Parameter {
            let end = curve.pieces() as f64;
            return (0..=legs).map(|index| end * even(index)).collect();
        }
        let lengths = Lengths::of(curve);
        let total = lengths.total();
        let places: Vec<f64> = match (self, nose(curve).filter(|_| legs > 1)) {
            (Self::Cosine, Some(nose)) => {
                let before = lengths.to(nose);
                let share = (legs as f64 * before / total).round();
                let first = (share as usize).clamp(1, legs - 1);
                let upper = (0..first).map(|index| before * cosine(index, first));
                let lower = (0..=legs - first)
                    .map(|index| before + (total - before) * cosine(index, legs - first));
                upper.chain(lower).collect()
            }
            (Self::Cosine, None) => (0..=legs)
                .map(|index| total * cosine(index, legs))
                .collect(),
            _ => (0..=legs).map(|index| total * even(index)).collect(),
        };
        places
            .into_iter()
            .map(|place| lengths.parameter(place))
            .collect()
    }

    /// Find the parameters of as few points, spread so, as keep the polyline through them within `tolerance` > 0
    /// of the curve.
    ///
    /// The number is doubled until they do, then bisected: where the deviation does not fall with the number, a
    /// smaller one may do, too. `None` if it takes more than 100 000 points, or would if it falls with the square of
    /// the number.
    pub fn within(self, curve: &dyn ParametricCurve, tolerance: f64) -> Option<Vec<f64>> {
        let spread = |count: usize| {
            let parameters = self.parameters(curve, count);
            let deviation = polyline_deviation(curve, &parameters);
            (parameters, deviation)
        };
        let (mut low, mut high) = (1, 2);
        let mut best = loop {
            let (parameters, deviation) = spread(high);
            if deviation <= tolerance {
                break parameters;
            }
            let needed = high as f64 * (deviation / tolerance).sqrt();
            let is_settled = high >= SETTLED * curve.pieces();
            if high >= MOST_POINTS || (is_settled && needed > FAR * MOST_POINTS as f64) {
                return None;
            }
            (low, high) = (high, (2 * high).min(MOST_POINTS));
        };
        while high - low > 1 {
            let middle = low.midpoint(high);
            let (parameters, deviation) = spread(middle);
            match deviation <= tolerance {
                true => (best, high) = (parameters, middle),
                false => low = middle,
            }
        }
        Some(best)
    }
}

fn cosine(index: usize, legs: usize) -> f64 {
    0.5 - 0.5 * (PI * index as f64 / legs as f64).cos()
}

/// The parameter of the point that is farthest from the ends of a curve, if these are near each other.
fn nose(curve: &dyn ParametricCurve) -> Option<f64> {
    let end = curve.pieces() as f64;
    let [first, last] = [0.0, end].map(|u| curve.jet(u).point);
    let middle = 0.5 * (first + last);
    let distance = |u: f64| length(curve.jet(u).point - middle);
    let steps = SAMPLES * curve.pieces();
    let place = |index: usize| end * index as f64 / steps as f64;
    let farther = |a: &usize, b: &usize| distance(place(*a)).total_cmp(&distance(place(*b)));
    let best = (1..steps).max_by(farther)?;
    let (nose, reach) = maximum([place(best - 1), place(best + 1)], MOST_STEPS, distance);
    (length(last - first) <= NEAR_ENDS * reach).then_some(nose)
}

/// The arc lengths of a curve from its start to the end of each piece.
struct Lengths<'a> {
    curve: &'a dyn ParametricCurve,
    sums: Vec<f64>,
}

impl<'a> Lengths<'a> {
    fn of(curve: &'a dyn ParametricCurve) -> Self {
        let pieces = (0..curve.pieces()).map(|piece| piece as f64);
        let lengths = pieces.map(|u| arc_length_between(curve, u, u + 1.0, LENGTH_TOLERANCE));
        let sums = lengths.scan(0.0, |sum, length| {
            *sum += length;
            Some(*sum)
        });
        Self {
            curve,
            sums: sums.collect(),
        }
    }

    fn total(&self) -> f64 {
        self.sums.last().copied().unwrap_or_default()
    }

    /// The arc length before a piece.
    fn before(&self, piece: usize) -> f64 {
        let before = piece.checked_sub(1);
        before.map_or(0.0, |before| self.sums[before])
    }

    /// The arc length up to a parameter.
    fn to(&self, u: f64) -> f64 {
        let piece = (u as usize).min(self.sums.len() - 1);
        let rest = arc_length_between(self.curve, piece as f64, u, LENGTH_TOLERANCE);
        self.before(piece) + rest
    }

    /// The parameter at an arc length, by Newton's method inside a bracket.
    fn parameter(&self, place: f64) -> f64 {
        let last = self.sums.len() - 1;
        let piece = self.sums.partition_point(|sum| *sum < place).min(last);
        if place >= self.total() {
            return self.sums.len() as f64;
        }
        let start = piece as f64;
        let wanted = place - self.before(piece);
        let whole = self.sums[piece] - self.before(piece);
        let [mut low, mut high] = [0.0, 1.0];
        let mut t = if whole > 0.0 { wanted / whole } else { 0.0 };
        for _ in 0..MOST_STEPS {
            let found = arc_length_between(self.curve, start, start + t, LENGTH_TOLERANCE);
            let miss = found - wanted;
            if miss.abs() <= LENGTH_TOLERANCE * self.total() {
                break;
            }
            if miss < 0.0 {
                low = t
            } else {
                high = t
            }
            let speed = length(self.curve.piece_jet(piece, t).first);
            let next = t - miss / speed;
            t = if low < next && next < high {
                next
            } else {
                0.5 * (low + high)
            };
        }
        start + t
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FloatPolygon;

    fn arch() -> FloatPolygon {
        let points = [(0.0, 0.0), (1.0, 5.0), (2.0, 0.0), (9.0, 1.0), (10.0, 0.0)];
        FloatPolygon::planar(3, &points).unwrap()
    }

    /// A closed loop of two unequal sides that begins and ends at its tail.
    fn section() -> FloatPolygon {
        let points = [
            (1.5, 0.1),
            (1.0, 0.0),
            (0.3, 0.2),
            (-0.2, 0.0),
            (0.3, -0.1),
            (1.0, 0.0),
            (1.5, 0.1),
        ];
        FloatPolygon::planar(2, &points).unwrap()
    }

    fn lengths(curve: &FloatPolygon, parameters: &[f64]) -> Vec<f64> {
        let pairs = parameters.windows(2);
        pairs
            .map(|pair| arc_length_between(curve, pair[0], pair[1], 1e-13))
            .collect()
    }

    #[test]
    fn points_are_even_by_arc_length() {
        let curve = arch();
        for count in [2, 3, 17, 200] {
            let parameters = Spacing::ArcLength.parameters(&curve, count);
            assert_eq!(parameters.len(), count);
            let lengths = lengths(&curve, &parameters);
            let expected = curve.arc_length(1e-13) / (count - 1) as f64;
            for length in lengths {
                assert!(
                    (length - expected).abs() < 1e-9 * expected.max(1e-2),
                    "{length} {expected}"
                );
            }
            let ends = [parameters[0], parameters[count - 1]];
            assert_eq!(ends, [0.0, curve.segments() as f64]);
        }
    }

    #[test]
    fn cosine_is_dense_at_the_ends_and_at_the_nose() {
        let curve = arch();
        let found = lengths(&curve, &Spacing::Cosine.parameters(&curve, 9));
        let total: f64 = found.iter().sum();
        for (index, length) in found.iter().enumerate() {
            let expected = total * (cosine(index + 1, 8) - cosine(index, 8));
            assert!(
                (length - expected).abs() < 1e-9 * total,
                "{index}: {length} {expected}"
            );
        }
        let curve = section();
        let parameters = Spacing::Cosine.parameters(&curve, 21);
        assert_eq!(parameters.len(), 21);
        let tail = curve.point(0.0);
        let distances = parameters.iter().map(|u| curve.point(*u).distance(tail));
        let distances: Vec<f64> = distances.collect();
        let farthest = distances.iter().copied().fold(0.0, f64::max);
        let nose = distances.iter().position(|it| *it == farthest).unwrap();
        let found = lengths(&curve, &parameters);
        let longest = found.iter().copied().fold(0.0, f64::max);
        for index in [0, nose - 1, nose, 19] {
            assert!(found[index] < 0.4 * longest, "{index}: {found:?}");
        }
    }
}
