//! Interval arithmetic: bounds of what functions have over intervals, proved but for the last digits of the
//! library's own functions, for which there is room (Moore, "Interval Analysis", 1966).

use std::cmp::Ordering;
use std::f64::consts::FRAC_PI_2;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::coefficient::Coefficient;
use super::control_polygon::MAX_MAGNITUDE;

/// Hold the numbers between two, with room for rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    low: f64,
    high: f64,
}

/// The relative error that the library's functions may have.
const FUNCTION_ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Why an expression may have no value or derivative somewhere in an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::geometry) enum Gap {
    /// Its divisor may be 0, or it grows beyond all bounds.
    Pole,
    /// A function may be at the border of where it is defined.
    Border,
}

type IntervalResult = Result<Interval, Gap>;

impl Interval {
    /// The numbers from `low` to `high`.
    pub(in crate::geometry) fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// One number.
    pub(in crate::geometry) fn number(number: f64) -> Self {
        Self::new(number, number)
    }

    /// π/2, which lies between two numbers.
    fn quarter_turn() -> Self {
        Self::new(FRAC_PI_2.next_down(), FRAC_PI_2.next_up())
    }

    /// Leave room for rounding; an infinite bound is a pole.
    fn rounded(low: f64, high: f64) -> IntervalResult {
        if low.is_finite() && high.is_finite() {
            Ok(Self::new(low.next_down(), high.next_up()))
        } else {
            Err(Gap::Pole)
        }
    }

    /// Refuse values too large for a coordinate.
    pub(in crate::geometry) fn of_coordinate(self) -> IntervalResult {
        match self.abs().high <= MAX_MAGNITUDE {
            true => Ok(self),
            false => Err(Gap::Pole),
        }
    }

    /// The bounds.
    pub(in crate::geometry) fn bounds(self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// The largest magnitude.
    pub(in crate::geometry) fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// A number in the middle, and how far the bounds are from it: not a number if nothing is known.
    pub(in crate::geometry) fn middle_and_radius(self) -> (f64, f64) {
        let middle = 0.5 * (self.low + self.high);
        let radius = (self.high - middle).max(middle - self.low);
        (middle, radius.next_up())
    }

    /// The numbers of two intervals, and those between them.
    pub(in crate::geometry) fn hull(self, other: Self) -> Self {
        Self::new(self.low.min(other.low), self.high.max(other.high))
    }

    /// Leave more room.
    pub(in crate::geometry) fn widened(self, by: f64) -> Self {
        Self::new(self.low - by, self.high + by)
    }

    /// Leave room for a few roundings of the library's functions.
    fn roughly(self) -> Self {
        self.widened(FUNCTION_ROUNDING * self.magnitude())
    }

    fn holds(self, number: f64) -> bool {
        self.low <= number && number <= self.high
    }

    /// The range of a function that rises.
    pub(in crate::geometry) fn rising(self, function: impl Fn(f64) -> f64) -> IntervalResult {
        Ok(Self::rounded(function(self.low), function(self.high))?.roughly())
    }

    /// −a.
    pub(in crate::geometry) fn negative(self) -> Self {
        Self::new(-self.high, -self.low)
    }

    /// a + b.
    pub(in crate::geometry) fn plus(self, other: Self) -> IntervalResult {
        Self::rounded(self.low + other.low, self.high + other.high)
    }

    /// a b.
    pub(in crate::geometry) fn times(self, other: Self) -> IntervalResult {
        let products = [
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ];
        let low = products.into_iter().fold(f64::INFINITY, f64::min);
        let high = products.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Self::rounded(low, high)
    }

    /// 1 / a.
    pub(in crate::geometry) fn inverse(self) -> IntervalResult {
        if self.holds(0.0) {
            return Err(Gap::Pole);
        }
        Self::rounded(self.high.recip(), self.low.recip())
    }

    /// |a|.
    pub(in crate::geometry) fn abs(self) -> Self {
        match self {
            Self { low, .. } if low >= 0.0 => self,
            Self { high, .. } if high <= 0.0 => self.negative(),
            Self { low, high } => Self::new(0.0, high.max(-low)),
        }
    }

    /// A power with a fixed exponent.
    pub(in crate::geometry) fn power(self, exponent: f64) -> IntervalResult {
        if exponent.fract() != 0.0 {
            let ends = match exponent > 0.0 {
                true => [self.low, self.high],
                false => [self.high, self.low],
            };
            let [low, high] = ends.map(|base| base.powf(exponent));
            return match self.low > 0.0 {
                true => Ok(Self::rounded(low, high)?.roughly()),
                false => Err(Gap::Border),
            };
        }
        if exponent < 0.0 {
            return self.power(-exponent)?.inverse();
        }
        let even = exponent % 2.0 == 0.0;
        let base = if even { self.abs() } else { self };
        Ok(Self::rounded(base.low.powf(exponent), base.high.powf(exponent))?.roughly())
    }

    /// The natural logarithm.
    pub(in crate::geometry) fn ln(self) -> IntervalResult {
        if self.low > 0.0 {
            self.rising(f64::ln)
        } else {
            Err(Gap::Pole)
        }
    }

    /// The sine: −1 to 1 where the range is wider than a quarter turn with a turning point in it.
    pub(in crate::geometry) fn sin(self) -> IntervalResult {
        use std::f64::consts::{PI, TAU};
        if self.high - self.low >= TAU {
            return Ok(Self::new(-1.0, 1.0));
        }
        let ends = [self.low.sin(), self.high.sin()];
        // A turning point may be at the very end: a little more is counted.
        let slack = 4.0 * f64::EPSILON * (1.0 + self.low.abs().max(self.high.abs()));
        let has = |place: f64| {
            let turns = ((self.low - slack - place) / TAU).ceil();
            place + turns * TAU <= self.high + slack
        };
        let low = if has(-FRAC_PI_2) {
            -1.0
        } else {
            ends[0].min(ends[1])
        };
        let high = if has(PI - FRAC_PI_2) {
            1.0
        } else {
            ends[0].max(ends[1])
        };
        Self::rounded(low, high)
    }

    /// The cosine.
    pub(in crate::geometry) fn cos(self) -> IntervalResult {
        self.plus(Self::quarter_turn())?.sin()
    }

    /// The tangent: no pole lies where the cosine has one sign.
    pub(in crate::geometry) fn tan(self) -> IntervalResult {
        if self.cos()?.holds(0.0) {
            return Err(Gap::Pole);
        }
        self.rising(f64::tan)
    }

    /// The smaller one of two.
    pub(in crate::geometry) fn lower(self, other: Self) -> Self {
        Self::new(self.low.min(other.low), self.high.min(other.high))
    }

    /// The larger one of two.
    pub(in crate::geometry) fn upper(self, other: Self) -> Self {
        Self::new(self.low.max(other.low), self.high.max(other.high))
    }

    /// The angle of the vector (x, y), which jumps where y = 0 and x < 0.
    pub(in crate::geometry) fn direction(y: Self, x: Self) -> IntervalResult {
        if x.low > 0.0 {
            return y.times(x.inverse()?)?.rising(f64::atan);
        }
        let quarter = match y.low > 0.0 {
            true => Self::quarter_turn(),
            false => Self::quarter_turn().negative(),
        };
        let off = x.times(y.inverse()?)?.rising(f64::atan)?;
        quarter.plus(off.negative())
    }

    /// The hyperbolic cosine.
    pub(in crate::geometry) fn cosh(self) -> IntervalResult {
        let Self { low, high } = self.abs();
        Ok(Self::rounded(low.cosh(), high.cosh())?.roughly())
    }

    /// The arc sine, whose slope is infinite at the borders.
    pub(in crate::geometry) fn asin(self) -> IntervalResult {
        if self.low > -1.0 && self.high < 1.0 {
            self.rising(f64::asin)
        } else {
            Err(Gap::Border)
        }
    }

    /// The arc cosine.
    pub(in crate::geometry) fn acos(self) -> IntervalResult {
        Self::quarter_turn().plus(self.asin()?.negative())
    }
}

impl Coefficient for Interval {
    const UNKNOWN: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    fn of(number: f64) -> Self {
        Self::number(number)
    }

    fn rising(self, function: impl Fn(f64) -> f64) -> Self {
        self.rising(function).unwrap_or(Self::UNKNOWN)
    }

    fn moving(self, functions: impl Fn(f64) -> ([f64; 2], f64)) -> [Self; 2] {
        let (middle, radius) = self.middle_and_radius();
        let (values, error) = functions(middle);
        values.map(|value| match (value, radius + error) {
            (value, room) if (value * room).is_finite() => {
                Self::number(value).widened(room.next_up())
            }
            _ => Self::UNKNOWN,
        })
    }

    fn squared(self) -> Self {
        let size = self.abs();
        size * size
    }

    fn ln(self) -> Self {
        self.ln().unwrap_or(Self::UNKNOWN)
    }

    fn power(self, exponent: f64) -> Self {
        self.power(exponent).unwrap_or(Self::UNKNOWN)
    }

    fn sin_cos(self) -> (Self, Self) {
        let both = [self.sin(), self.cos()];
        let [sine, cosine] = both.map(|it| it.unwrap_or(Self::UNKNOWN));
        (sine, cosine)
    }

    fn cosh(self) -> Self {
        self.cosh().unwrap_or(Self::UNKNOWN)
    }

    fn tan(self) -> Self {
        self.tan().unwrap_or(Self::UNKNOWN)
    }

    fn tanh_slope(self) -> Self {
        let Self { low, high } = self.abs();
        let slopes = Self::rounded(high.tanh_slope(), low.tanh_slope());
        slopes.map_or(Self::UNKNOWN, |it| it.roughly().roughly())
    }

    fn asin(self) -> Self {
        self.asin().unwrap_or(Self::UNKNOWN)
    }

    fn acos(self) -> Self {
        self.acos().unwrap_or(Self::UNKNOWN)
    }

    fn direction(self, x: Self) -> Self {
        Self::direction(self, x).unwrap_or(Self::UNKNOWN)
    }

    fn compared(self, other: Self) -> Option<Ordering> {
        if self.high < other.low {
            Some(Ordering::Less)
        } else if self.low > other.high {
            Some(Ordering::Greater)
        } else {
            None
        }
    }

    fn lower(self, other: Self) -> Self {
        self.lower(other)
    }

    fn either(self, other: Self) -> Self {
        self.hull(other)
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.plus(other).unwrap_or(Self::UNKNOWN)
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        self.times(other).unwrap_or(Self::UNKNOWN)
    }
}

impl Div for Interval {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        other
            .inverse()
            .map_or(Self::UNKNOWN, |inverse| self * inverse)
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        self.negative()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_what_functions_have_over_them() {
        type Case = (fn(Interval) -> IntervalResult, fn(f64) -> f64);
        let cases: [Case; 9] = [
            (Interval::sin, f64::sin),
            (Interval::cos, f64::cos),
            (Interval::tan, f64::tan),
            (Interval::cosh, f64::cosh),
            (Interval::asin, f64::asin),
            (Interval::acos, f64::acos),
            (Interval::ln, f64::ln),
            (|it| it.power(3.0), |x| x * x * x),
            (|it| it.power(-2.0), |x| 1.0 / (x * x)),
        ];
        let mut held = 0;
        for (over, of) in cases {
            for start in -40..40 {
                for width in [0.0, 0.01, 0.3, 1.7, 7.0] {
                    let low = 0.25 * f64::from(start);
                    let Ok(range) = over(Interval::new(low, low + width)) else {
                        continue;
                    };
                    held += 1;
                    for step in 0..=32 {
                        let value = of(low + width * f64::from(step) / 32.0);
                        assert!(
                            range.low <= value && value <= range.high,
                            "{low} {width}: {value:e} in {range:?}"
                        );
                    }
                    // And not much more.
                    assert!(
                        width > 0.0 || range.high - range.low <= 1e-9 * (1.0 + range.high.abs())
                    );
                }
            }
        }
        assert!(held > 1000, "{held}");
    }

    #[test]
    fn gaps_are_noticed() {
        let around = Interval::new(-1.0, 2.0);
        assert_eq!(around.inverse(), Err(Gap::Pole));
        assert_eq!(around.ln(), Err(Gap::Pole));
        assert_eq!(Interval::new(1.0, 2.0).tan(), Err(Gap::Pole));
        assert_eq!(around.power(0.5), Err(Gap::Border));
        assert_eq!(around.asin(), Err(Gap::Border));
        assert_eq!(Interval::number(800.0).rising(f64::exp), Err(Gap::Pole));
        assert_eq!(Interval::number(1e101).of_coordinate(), Err(Gap::Pole));
    }
}
