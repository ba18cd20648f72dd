//! The curvature or torsion at an extremum, to nearly all digits also where doubles cancel.

use std::ops::{Div, Mul};

use num_bigint::BigInt;
use num_traits::ToPrimitive;

use super::exact_numerators::ExactSegment;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::jet::Jet;

/// Doubles are trusted where what they round is at most this share of the result.
const TRUSTED: f64 = 1e-9;

/// Evaluate the curvature of a segment at t: signed if `planar`, ≥ 0 in space.
pub(super) fn curvature(polygon: &FloatPolygon, segment: usize, t: f64, planar: bool) -> f64 {
    let jet = polygon.segment_jet(segment, t);
    let rounding = Roundings::of(polygon, segment, &jet);
    let exact = || ExactSegment::new(polygon, segment, planar);
    if rounding.hide_curvature()
        && let Some(exact) = exact()
    {
        exact.curvature_at(t)
    } else {
        jet.curvature_of(planar)
    }
}

/// Evaluate the torsion of a segment at t.
pub(super) fn torsion(polygon: &FloatPolygon, segment: usize, t: f64) -> f64 {
    let jet = polygon.segment_jet(segment, t);
    let rounding = Roundings::of(polygon, segment, &jet);
    let exact = || ExactSegment::new(polygon, segment, false);
    if rounding.hide_torsion()
        && let Some(exact) = exact()
    {
        exact.torsion_at(t)
    } else {
        jet.torsion()
    }
}

/// A jet, and what its derivatives may be off by for each order: the legs' roundings.
struct Roundings<'a> {
    jet: &'a Jet,
    unit: f64,
}

impl<'a> Roundings<'a> {
    fn of(polygon: &FloatPolygon, segment: usize, jet: &'a Jet) -> Self {
        let degree = polygon.degree();
        let legs =
            (segment..segment + degree).map(|j| polygon.vertex(j).distance(polygon.vertex(j + 1)));
        let weights = (segment..=segment + degree).map(|j| polygon.weight(j));
        let [least, most] = weights.fold([f64::INFINITY, 0.0], |[least, most], weight| {
            [least.min(weight), most.max(weight)]
        });
        let unit = f64::EPSILON * degree as f64 * legs.fold(0.0, f64::max) * (most / least);
        Self { jet, unit }
    }

    fn hide_curvature(&self) -> bool {
        let Jet { first, second, .. } = self.jet;
        let off = self.unit * (second.length() + 4.0 * first.length());
        !(self.unit <= TRUSTED * first.length() && off <= TRUSTED * first.cross(*second).length())
    }

    fn hide_torsion(&self) -> bool {
        let Jet {
            first,
            second,
            third,
            ..
        } = self.jet;
        let normal = first.cross(*second);
        let off = self.unit * (second.length() + 4.0 * first.length());
        let off = off * third.length() + 8.0 * self.unit * normal.length();
        self.hide_curvature() || !(off <= TRUSTED * normal.dot(*third).abs())
    }
}

/// A number digits · 2^exponent that no power takes out of range; digits are 0 or of size 1 … 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Floating {
    digits: f64,
    exponent: i64,
}

impl Floating {
    /// Write `number` · 2^exponent.
    pub(super) fn new(number: &BigInt, exponent: i64) -> Self {
        /// What a double holds, and more.
        const KEPT: u64 = 64;
        let spare = number.bits().saturating_sub(KEPT);
        let digits = (number >> spare).to_f64().unwrap_or_default();
        Self::normal(digits, exponent + spare as i64)
    }

    /// The positive square root.
    pub(super) fn sqrt(self) -> Self {
        let odd = self.exponent.rem_euclid(2);
        let digits = if odd == 1 {
            2.0 * self.digits
        } else {
            self.digits
        };
        Self::normal(digits.sqrt(), (self.exponent - odd) / 2)
    }

    /// The nearest double, infinite or 0 if there is none.
    pub(super) fn value(self) -> f64 {
        /// Beyond it nothing but 0 and infinity is left, twice.
        const FAR: i64 = 2400;
        let exponent = self.exponent.clamp(-FAR, FAR) as i32;
        let third = exponent / 3;
        let power = |exponent: i32| 2f64.powi(exponent);
        self.digits * power(third) * power(third) * power(exponent - 2 * third)
    }

    fn normal(digits: f64, exponent: i64) -> Self {
        if digits == 0.0 || !digits.is_finite() {
            return Self {
                digits,
                exponent: 0,
            };
        }
        let shift = digits.abs().log2().floor() as i32;
        Self {
            digits: digits * 2f64.powi(-shift),
            exponent: exponent + i64::from(shift),
        }
    }
}

impl Mul for Floating {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::normal(self.digits * other.digits, self.exponent + other.exponent)
    }
}

impl Div for Floating {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        Self::normal(self.digits / other.digits, self.exponent - other.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_beyond_doubles_come_back_into_range() {
        let huge = Floating::new(&(BigInt::from(3) << 5000), 0);
        let tiny = Floating::new(&BigInt::from(-5), -4999);
        assert_eq!((huge * tiny).value(), -30.0);
        assert_eq!((huge / huge).value(), 1.0);
        assert_eq!((huge * huge).sqrt(), huge);
        assert_eq!(
            Floating::new(&BigInt::from(9), 1).sqrt().value(),
            18f64.sqrt()
        );
        assert_eq!(huge.value(), f64::INFINITY);
        assert_eq!((tiny * tiny).value(), 0.0);
        assert_eq!(Floating::new(&BigInt::default(), 7).value(), 0.0);
    }

    #[test]
    fn where_doubles_cancel_the_digits_are_those_of_the_numbers_given() {
        // Of degree 2 with legs a, b the curvature in the middle is a × b / |(a + b) / 2|³.
        let height = 1e-14;
        let points = [(0.1, 0.1), (0.4, 0.4), (0.7, 0.7 + height)];
        let polygon = FloatPolygon::planar(2, &points).expect("valid");
        let [a, b] = [0, 1].map(|j| polygon.vertex(j + 1) - polygon.vertex(j));
        let found = curvature(&polygon, 0, 0.5, true);
        let expected = a.truncate().perp_dot(b.truncate()) / (0.5 * (a + b)).length().powi(3);
        // The witness's legs are rounded: 1e-17 of 1e-14.
        assert!(
            (found / expected - 1.0).abs() <= 0.02,
            "{found:e} {expected:e}"
        );
        let sound = FloatPolygon::planar(2, &[(0.0, 0.0), (4.0, 0.0), (6.0, 3.0)]).expect("valid");
        let exact = ExactSegment::new(&sound, 0, true)
            .expect("few digits")
            .curvature_at(0.375);
        let doubles = sound.segment_jet(0, 0.375).signed_curvature();
        assert!((exact / doubles - 1.0).abs() <= 8.0 * f64::EPSILON);
    }
}
