//! Bounds of the curvature and torsion from whole numbers, where rounded ones cancel.

use num_bigint::{BigInt, Sign};
use num_traits::{One, Zero};

use super::enclosure::{Enclosure, UNKNOWN};
use super::exact_numerators::ExactSegment;
use super::exact_polynomial::ExactPolynomial;
use super::feature::Feature;
use super::floating::Floating;
use super::numerators::Function;
use crate::geometry::whole_numbers::fraction;

/// The interval is narrowed by so many binary digits at once, where a secant tells where to, and
/// by twice as many the next time.
const STEP: u32 = 32;

/// Otherwise the interval is halved this often.
const BISECTIONS: usize = 6;

/// Most binary digits of a narrowed interval.
const MOST_BITS: u64 = 1024;

/// Relative rounding errors of one polynomial and of the result.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The relative error at which an enclosure is narrow enough.
const ENOUGH: f64 = 64.0 * f64::EPSILON;

/// Relative errors up to this add up in products and powers, but for a tenth.
const SMALL: f64 = 0.01;

impl ExactSegment {
    /// Whether the curvature of a space curve is 0 at an only place between two others.
    pub(super) fn is_flat_between(&self, ends: [f64; 2]) -> bool {
        let interval = Interval::new(ends);
        !self.planar && self.flat().is_some_and(|flat| interval.parts_signs(flat))
    }

    /// Enclose the curvature or torsion at the extremum that lies between two places, which are
    /// the same at a knot. It is narrowed as far as digits are to be gained.
    pub(super) fn enclose(&self, quantity: Feature, ends: [f64; 2]) -> Enclosure {
        let parts = Parts::new(self, quantity);
        let mut interval = Interval::new(ends);
        let mut best = UNKNOWN;
        let mut simple = None;
        loop {
            if let Some((bounds, error)) = parts.enclose(&interval, self.unit) {
                best = bounds;
                if error <= ENOUGH {
                    break;
                }
            }
            if interval.is_point() || interval.bits > MOST_BITS {
                break;
            }
            let is_first = simple.is_none();
            let find = || self.numerator(Function::Feature(quantity)).odd_part();
            let simple = simple.get_or_insert_with(find).as_ref();
            let Some(simple) = simple.filter(|simple| interval.parts_signs(simple)) else {
                break;
            };
            if is_first && parts.vanishes_with(simple, &interval) {
                return [0.0, 0.0];
            }
            interval.narrow(simple);
        }
        best
    }
}

/// What a quantity is made of: the numerator f, the square g below it, and the weight:
/// W³ f / g^{3/2} in the plane, W³ (f / g³)^{1/2} in space, W² f / g for the torsion.
struct Parts {
    form: Form,
    numerator: Bounded,
    below: Bounded,
    weight: Bounded,
}

#[derive(Clone, Copy, PartialEq)]
enum Form {
    Planar,
    Spatial,
    Torsion,
}

impl Parts {
    fn new(segment: &ExactSegment, quantity: Feature) -> Self {
        let (form, numerator, below) = match quantity {
            Feature::TorsionExtremum => (Form::Torsion, segment.torsion(3), segment.bending(2)),
            _ if segment.planar => (Form::Planar, segment.bend(2), segment.speed(1)),
            _ => (Form::Spatial, segment.bending(2), segment.speed(1)),
        };
        Self {
            form,
            numerator: Bounded::new(numerator),
            below: Bounded::new(below),
            weight: Bounded::new(segment.weight()),
        }
    }

    /// Enclose the quantity on an interval; returns its relative error too.
    fn enclose(&self, interval: &Interval, unit: Floating) -> Option<(Enclosure, f64)> {
        let (below, below_error) = self.below.at(interval)?;
        let (weight, weight_error) = self.weight.at(interval)?;
        if interval.is_point() && self.numerator.polynomial.sign_at(&interval.place(0)) == 0 {
            return Some(([0.0, 0.0], 0.0));
        }
        let (numerator, error) = self.numerator.at(interval)?;
        let (value, error) = match self.form {
            Form::Torsion => (
                weight * weight * (numerator / below),
                2.0 * weight_error + error + below_error,
            ),
            form => {
                let share = weight / below.sqrt();
                let (top, error) = if form == Form::Planar {
                    (numerator, error)
                } else {
                    (numerator.sqrt(), 0.5 * error)
                };
                (
                    top * share * share * share,
                    3.0 * weight_error + error + 1.5 * below_error,
                )
            }
        };
        let error = 1.1 * error + ROUNDING;
        let value = (value / unit).value();
        if !value.is_finite() {
            return None;
        }
        let off = value.abs() * error + f64::MIN_POSITIVE;
        Some(([value - off, value + off], error))
    }

    /// Whether the quantity is exactly 0 at the root that an interval holds.
    fn vanishes_with(&self, simple: &ExactPolynomial, interval: &Interval) -> bool {
        let shared =
            ExactPolynomial::shared_roots([simple, &self.numerator.polynomial].into_iter());
        shared.is_some_and(|shared| interval.parts_signs(&shared))
    }
}

/// A polynomial and a bound of its derivative.
struct Bounded {
    polynomial: ExactPolynomial,
    slope: Floating,
}

impl Bounded {
    fn new(polynomial: ExactPolynomial) -> Self {
        // Coefficients in scaled form are at least as large as those in plain form.
        let bits = polynomial.derivative().bits();
        let slope = Floating::new(&BigInt::one(), bits as i64);
        Self { polynomial, slope }
    }

    /// The value at the start of an interval, and what share of it the value on the interval may
    /// differ by; `None` if that is not small.
    fn at(&self, interval: &Interval) -> Option<(Floating, f64)> {
        let value = self
            .polynomial
            .floating_at(&interval.place(0), interval.bits);
        let change = self.slope * interval.width() / value;
        let error = change.value().abs() * (1.0 + 1e-9) + ROUNDING;
        let error = if self.polynomial.degree() == 0 {
            ROUNDING
        } else {
            error
        };
        (error <= SMALL).then_some((value, error))
    }
}

/// An interval between two whole numbers over 2^`bits`.
struct Interval {
    ends: [BigInt; 2],
    bits: u64,
    step: u32,
}

impl Interval {
    fn new(ends: [f64; 2]) -> Self {
        let places = ends.map(fraction);
        let places_bits = places
            .each_ref()
            .map(|[_, q]| q.trailing_zeros().unwrap_or(0));
        let bits = places_bits[0].max(places_bits[1]);
        let [low, high] = [0, 1].map(|end| &places[end][0] << (bits - places_bits[end]));
        Self {
            ends: [low, high],
            bits,
            step: STEP,
        }
    }

    fn is_point(&self) -> bool {
        self.ends[0] == self.ends[1]
    }

    fn place(&self, end: usize) -> [BigInt; 2] {
        [self.ends[end].clone(), BigInt::one() << self.bits]
    }

    fn width(&self) -> Floating {
        Floating::new(&(&self.ends[1] - &self.ends[0]), -(self.bits as i64))
    }

    /// Whether a polynomial has opposite signs at both ends.
    fn parts_signs(&self, polynomial: &ExactPolynomial) -> bool {
        let [low, high] = [0, 1].map(|end| polynomial.sign_at(&self.place(end)));
        low * high < 0
    }

    /// Narrow the interval about the only root of a polynomial: to the small part of it that a
    /// secant points to, if the root is there, and by some bisections otherwise.
    fn narrow(&mut self, simple: &ExactPolynomial) {
        let values = [0, 1].map(|end| simple.scaled_value(&self.place(end)));
        let before = values[0].sign();
        let [low, high] = values
            .map(BigInt::into_parts)
            .map(|(_, size)| BigInt::from(size));
        let width = &self.ends[1] - &self.ends[0];
        let share: BigInt = (&low << self.step) / (&low + &high);
        let start = (&self.ends[0] << self.step) + share * &width;
        let part = Self {
            ends: [start.clone(), start + width],
            bits: self.bits + u64::from(self.step),
            step: 2 * self.step,
        };
        let [from, to] = [0, 1].map(|end| simple.scaled_value(&part.place(end)));
        if from.is_zero() || to.is_zero() {
            let root = part.ends[usize::from(to.is_zero())].clone();
            self.ends = [root.clone(), root];
        } else if from.sign() == before && to.sign() != before {
            (self.ends, self.step) = (part.ends, part.step);
        } else {
            // The root is before or behind the part.
            let [from_start, to_end] = self.ends.each_ref().map(|end| end << self.step);
            let [part_start, part_end] = part.ends;
            self.ends = if from.sign() == before {
                [part_end, to_end]
            } else {
                [from_start, part_start]
            };
            (self.bits, self.step) = (part.bits, STEP);
            return self.bisect(simple, before);
        }
        self.bits = part.bits;
    }

    fn bisect(&mut self, simple: &ExactPolynomial, before: Sign) {
        for _ in 0..BISECTIONS {
            let middle = &self.ends[0] + &self.ends[1];
            self.bits += 1;
            for end in &mut self.ends {
                *end <<= 1;
            }
            let value = simple.scaled_value(&[middle.clone(), BigInt::one() << self.bits]);
            if value.is_zero() {
                self.ends = [middle.clone(), middle];
                return;
            }
            self.ends[usize::from(value.sign() != before)] = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::FloatPolygon;

    #[test]
    fn where_doubles_cancel_the_digits_are_those_of_the_numbers_given() {
        // Of degree 2 with legs a, b the curvature in the middle is a × b / |(a + b) / 2|³.
        let height = 1e-14;
        let points = [(0.1, 0.1), (0.4, 0.4), (0.7, 0.7 + height)];
        let polygon = FloatPolygon::planar(2, &points).expect("valid");
        let [a, b] = [0, 1].map(|j| polygon.vertex(j + 1) - polygon.vertex(j));
        let exact = ExactSegment::new(&polygon, 0, true).expect("few digits");
        let [low, high] = exact.enclose(Feature::CurvatureExtremum, [0.5, 0.5]);
        let expected = a.truncate().perp_dot(b.truncate()) / (0.5 * (a + b)).length().powi(3);
        assert!((high - low) / low.abs() < 1e-13, "{low:e} {high:e}");
        // The witness's legs are rounded: 1e-17 of 1e-14.
        assert!((low / expected - 1.0).abs() <= 0.02, "{low:e} {expected:e}");
        let sound = FloatPolygon::planar(2, &[(0.0, 0.0), (4.0, 0.0), (6.0, 3.0)]).expect("valid");
        let exact = ExactSegment::new(&sound, 0, true).expect("few digits");
        let [low, high] = exact.enclose(Feature::CurvatureExtremum, [0.375, 0.375]);
        let doubles = sound.segment_jet(0, 0.375).signed_curvature();
        assert!(
            low <= doubles * (1.0 + 4.0 * f64::EPSILON)
                && doubles * (1.0 - 4.0 * f64::EPSILON) <= high
        );
    }
}
