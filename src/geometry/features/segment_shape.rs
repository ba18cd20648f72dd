//! One segment's control vectors without the curve's place and size.

use glam::DVec3;

use super::scalar::FLOOR;
use crate::geometry::error::MAX_DEGREE;
use crate::geometry::expansion::DoubleDouble;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::whole_numbers;

/// Rounding error of a product or a sum of three wide numbers: 2⁻⁹⁸.
const WIDE_ROUNDING: f64 = f64::EPSILON * f64::EPSILON * 64.0;

/// Products of doubles further apart than this share of their size are different in truth.
const APART: f64 = 8.0 * f64::EPSILON;

/// The part of a segment's data that its features depend on.
///
/// Of a polynomial segment these are its n legs, the control vectors of C′; of a rational
/// one the n + 1 homogeneous vertices about one of its own. Both are divided by a power of two,
/// which brings them to size 1, and carry a bound of what could not be held.
#[derive(Debug)]
pub(super) struct SegmentShape {
    /// The number of control vectors.
    pub(super) count: usize,
    /// The control values, axis by axis: x, y, z and the weight.
    pub(super) controls: [[DoubleDouble; MAX_DEGREE + 1]; 4],
    /// Error bound of the control values.
    pub(super) bounds: [[f64; MAX_DEGREE + 1]; 4],
    /// Whether the weights differ.
    pub(super) rational: bool,
    /// The direction of the line that the vertices are proved to lie on, 0 if they are one
    /// point; here that line is the x axis.
    pub(super) line: Option<[f64; 3]>,
    /// The length that is 1 here.
    pub(super) unit: f64,
}

impl SegmentShape {
    /// Read one segment. `planar` says that z is 0.
    ///
    /// Vertices that lie on one line exactly, or all but one at either end of the segment if
    /// the curve is planar, are turned into the x axis: what vanishes on it does so exactly.
    pub(super) fn new(polygon: &FloatPolygon, segment: usize, planar: bool) -> Self {
        let degree = polygon.degree();
        let weights = (0..=degree).map(|j| polygon.weight(segment + j));
        let first = polygon.weight(segment);
        let rational = polygon.is_rational() && weights.clone().any(|weight| weight != first);
        let count = degree + usize::from(rational);
        let mut shape = Self {
            count,
            controls: Default::default(),
            bounds: Default::default(),
            rational,
            line: None,
            unit: 1.0,
        };
        let vertex = |j: usize| polygon.vertex(segment + j);
        for j in 0..count {
            let pair = if rational {
                (vertex(degree / 2), vertex(j))
            } else {
                (vertex(j), vertex(j + 1))
            };
            shape.set_difference(j, pair);
        }
        shape.normalise();
        shape.align(planar);
        if rational {
            shape.weigh(weights);
        }
        shape
    }

    fn set_difference(&mut self, j: usize, (from, to): (DVec3, DVec3)) {
        for axis in 0..3 {
            self.controls[axis][j] = DoubleDouble::difference(to[axis], from[axis]);
        }
    }

    /// Divide by the power of two that brings the largest coordinate to between 1 and 2, and
    /// replace numbers too small to be multiplied by a bound of them.
    fn normalise(&mut self) {
        let coordinates = self.controls[..3].iter().flatten();
        let largest = coordinates.fold(0.0, |largest: f64, value| largest.max(value.high().abs()));
        self.unit = power_of_two_below(largest);
        let count = self.count;
        for (controls, bounds) in self.controls.iter_mut().zip(&mut self.bounds).take(3) {
            for (control, bound) in controls.iter_mut().zip(bounds).take(count) {
                let scaled = control.scaled(1.0 / self.unit);
                let lost = |part: f64, scaled: f64| part != 0.0 && scaled.abs() < FLOOR;
                if lost(control.high(), scaled.high()) {
                    (*control, *bound) = (DoubleDouble::default(), 2.0 * FLOOR);
                } else if lost(control.low(), scaled.low()) {
                    (*control, *bound) = (DoubleDouble::from(scaled.high()), 2.0 * FLOOR);
                } else {
                    *control = scaled;
                }
            }
        }
    }

    /// Turn the direction that the vectors share, if they share one, into the x axis.
    fn align(&mut self, planar: bool) {
        let vector = |j: usize| [0, 1, 2].map(|axis| self.controls[axis][j]);
        let moving = |j: &usize| vector(*j).iter().any(|value| value.high() != 0.0);
        let known = |j: usize| (0..3).all(|axis| self.bounds[axis][j] == 0.0);
        let middle = (self.count / 2..self.count).chain((0..self.count / 2).rev());
        let Some(reference) = middle.clone().find(moving) else {
            self.line = (0..self.count).all(known).then_some([0.0; 3]);
            return;
        };
        let direction = vector(reference);
        let parallel = middle
            .filter(|j| known(*j) && are_parallel(direction, vector(*j)))
            .count();
        if parallel == self.count {
            self.line = Some(direction.map(|part| part.high()));
        }
        if self.line.is_some() || planar && self.count > 2 && parallel + 1 >= self.count {
            self.rotate(reference, planar);
        }
    }

    fn rotate(&mut self, reference: usize, planar: bool) {
        let [x, y, z] = [0, 1, 2].map(|axis| self.controls[axis][reference]);
        let size = x.high().abs() + y.high().abs() + z.high().abs();
        for j in 0..self.count {
            let [a, b, c] = [0, 1, 2].map(|axis| self.controls[axis][j]);
            let off = (self.bounds[0][j] + self.bounds[1][j] + self.bounds[2][j]) * 4.0;
            let rounding =
                WIDE_ROUNDING * size * (a.high().abs() + b.high().abs() + c.high().abs());
            let along = x * a + y * b + z * c;
            let across = x * b + -(y * a);
            let exact = self.line.is_some() || off == 0.0 && are_parallel([x, y, z], [a, b, c]);
            self.controls[0][j] = along;
            self.bounds[0][j] = off + nonzero(rounding);
            self.controls[1][j] = if exact || !planar {
                DoubleDouble::default()
            } else {
                across
            };
            self.bounds[1][j] = if exact { 0.0 } else { off + nonzero(rounding) };
            self.controls[2][j] = DoubleDouble::default();
            self.bounds[2][j] = 0.0;
        }
        // The vectors were multiplied by one of themselves.
        self.unit /= (x.high() * x.high() + y.high() * y.high() + z.high() * z.high()).sqrt();
    }

    /// Multiply by the weights, which are brought to size 1 as well.
    fn weigh(&mut self, weights: impl Iterator<Item = f64> + Clone) {
        let unit = power_of_two_below(weights.clone().fold(0.0, f64::max));
        for (j, weight) in weights.enumerate() {
            let weight = DoubleDouble::from(weight / unit);
            for axis in 0..3 {
                let product = self.controls[axis][j] * weight;
                let rounding = nonzero(WIDE_ROUNDING * product.high().abs());
                self.controls[axis][j] = product;
                self.bounds[axis][j] = self.bounds[axis][j] * weight.high() * 2.0 + rounding;
            }
            self.controls[3][j] = weight;
            if weight.high() < FLOOR {
                self.controls[3][j] = DoubleDouble::default();
                self.bounds[3][j] = FLOOR;
            }
        }
    }
}

/// A rounding error, not too small to be carried on; 0 only if there was nothing to round.
fn nonzero(rounding: f64) -> f64 {
    if rounding > 0.0 {
        rounding + FLOOR
    } else {
        0.0
    }
}

/// Find the largest power of two that is not above a number; 1 for 0.
fn power_of_two_below(value: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    let power = f64::from_bits(value.to_bits() & EXPONENT);
    if power > 0.0 {
        power
    } else {
        f64::MIN_POSITIVE
    }
}

/// Decide exactly whether two vectors are parallel.
fn are_parallel(a: [DoubleDouble; 3], b: [DoubleDouble; 3]) -> bool {
    let products_agree = |[p, q]: [DoubleDouble; 2], [r, s]: [DoubleDouble; 2]| {
        let (one, other) = (p.high() * q.high(), r.high() * s.high());
        if (one - other).abs() > APART * (one.abs() + other.abs()) {
            return false;
        }
        if [p, q, r, s].iter().all(|value| value.low() == 0.0) {
            return DoubleDouble::product(p.high(), q.high())
                == DoubleDouble::product(r.high(), s.high());
        }
        let pairs = |values: [DoubleDouble; 2]| values.map(|value| [value.high(), value.low()]);
        whole_numbers::products_agree(pairs([p, q]), pairs([r, s]))
    };
    [(0, 1), (1, 2), (2, 0)]
        .iter()
        .all(|&(i, j)| products_agree([a[i], b[j]], [a[j], b[i]]))
}
