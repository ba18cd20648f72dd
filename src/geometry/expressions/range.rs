//! Ranges of expressions over intervals: where a formula has values everywhere, proved.

use std::f64::consts::FRAC_PI_2;

use crate::geometry::control_polygon::MAX_MAGNITUDE;

/// Hold the numbers that an expression can have over an interval: those between two, with room for
/// rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ValueRange {
    low: f64,
    high: f64,
}

/// Why an expression may have no value or derivative somewhere in an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Gap {
    /// Its divisor may be 0, or it grows beyond all bounds.
    Pole,
    /// A function may be at the border of where it is defined.
    Border,
}

type RangeResult = Result<ValueRange, Gap>;

impl ValueRange {
    /// The numbers from `low` to `high`.
    pub(super) fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// One number.
    pub(super) fn number(number: f64) -> Self {
        Self::new(number, number)
    }

    /// π/2, which lies between two numbers.
    fn quarter_turn() -> Self {
        Self::new(FRAC_PI_2.next_down(), FRAC_PI_2.next_up())
    }

    /// Leave room for rounding; an infinite bound is a pole.
    fn rounded(low: f64, high: f64) -> RangeResult {
        if low.is_finite() && high.is_finite() {
            Ok(Self::new(low.next_down(), high.next_up()))
        } else {
            Err(Gap::Pole)
        }
    }

    /// Refuse values too large for a coordinate.
    pub(super) fn of_coordinate(self) -> RangeResult {
        match self.abs().high <= MAX_MAGNITUDE {
            true => Ok(self),
            false => Err(Gap::Pole),
        }
    }

    fn holds(self, number: f64) -> bool {
        self.low <= number && number <= self.high
    }

    /// The range of a function that rises.
    pub(super) fn rising(self, function: fn(f64) -> f64) -> RangeResult {
        Self::rounded(function(self.low), function(self.high))
    }

    /// −a.
    pub(super) fn negative(self) -> Self {
        Self::new(-self.high, -self.low)
    }

    /// a + b.
    pub(super) fn plus(self, other: Self) -> RangeResult {
        Self::rounded(self.low + other.low, self.high + other.high)
    }

    /// a b.
    pub(super) fn times(self, other: Self) -> RangeResult {
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
    pub(super) fn inverse(self) -> RangeResult {
        if self.holds(0.0) {
            return Err(Gap::Pole);
        }
        Self::rounded(self.high.recip(), self.low.recip())
    }

    /// |a|.
    pub(super) fn abs(self) -> Self {
        match self {
            Self { low, .. } if low >= 0.0 => self,
            Self { high, .. } if high <= 0.0 => self.negative(),
            Self { low, high } => Self::new(0.0, high.max(-low)),
        }
    }

    /// A power with a fixed exponent.
    pub(super) fn power(self, exponent: f64) -> RangeResult {
        if exponent.fract() != 0.0 {
            return if self.low > 0.0 {
                self.ln()?.times(Self::number(exponent))?.rising(f64::exp)
            } else {
                Err(Gap::Border)
            };
        }
        if exponent < 0.0 {
            return self.power(-exponent)?.inverse();
        }
        let even = exponent % 2.0 == 0.0;
        let base = if even { self.abs() } else { self };
        Self::rounded(base.low.powf(exponent), base.high.powf(exponent))
    }

    /// The natural logarithm.
    pub(super) fn ln(self) -> RangeResult {
        if self.low > 0.0 {
            self.rising(f64::ln)
        } else {
            Err(Gap::Pole)
        }
    }

    /// The sine: −1 to 1 where the range is wider than a quarter turn with a turning point in it.
    pub(super) fn sin(self) -> RangeResult {
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
    pub(super) fn cos(self) -> RangeResult {
        self.plus(Self::quarter_turn())?.sin()
    }

    /// The tangent: no pole lies where the cosine has one sign.
    pub(super) fn tan(self) -> RangeResult {
        if self.cos()?.holds(0.0) {
            return Err(Gap::Pole);
        }
        self.rising(f64::tan)
    }

    /// The smaller one of two.
    pub(super) fn lower(self, other: Self) -> Self {
        Self::new(self.low.min(other.low), self.high.min(other.high))
    }

    /// The larger one of two.
    pub(super) fn upper(self, other: Self) -> Self {
        Self::new(self.low.max(other.low), self.high.max(other.high))
    }

    /// The angle of the vector (x, y), which jumps where y = 0 and x < 0.
    pub(super) fn direction(y: Self, x: Self) -> RangeResult {
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
    pub(super) fn cosh(self) -> RangeResult {
        let Self { low, high } = self.abs();
        Self::rounded(low.cosh(), high.cosh())
    }

    /// The arc sine, whose slope is infinite at the borders.
    pub(super) fn asin(self) -> RangeResult {
        if self.low > -1.0 && self.high < 1.0 {
            self.rising(f64::asin)
        } else {
            Err(Gap::Border)
        }
    }

    /// The arc cosine.
    pub(super) fn acos(self) -> RangeResult {
        Self::quarter_turn().plus(self.asin()?.negative())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_what_functions_have_over_them() {
        type Case = (fn(ValueRange) -> RangeResult, fn(f64) -> f64);
        let cases: [Case; 9] = [
            (ValueRange::sin, f64::sin),
            (ValueRange::cos, f64::cos),
            (ValueRange::tan, f64::tan),
            (ValueRange::cosh, f64::cosh),
            (ValueRange::asin, f64::asin),
            (ValueRange::acos, f64::acos),
            (ValueRange::ln, f64::ln),
            (|it| it.power(3.0), |x| x * x * x),
            (|it| it.power(-2.0), |x| 1.0 / (x * x)),
        ];
        let mut held = 0;
        for (over, of) in cases {
            for start in -40..40 {
                for width in [0.0, 0.01, 0.3, 1.7, 7.0] {
                    let low = 0.25 * f64::from(start);
                    let Ok(range) = over(ValueRange::new(low, low + width)) else {
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
        let around = ValueRange::new(-1.0, 2.0);
        assert_eq!(around.inverse(), Err(Gap::Pole));
        assert_eq!(around.ln(), Err(Gap::Pole));
        assert_eq!(ValueRange::new(1.0, 2.0).tan(), Err(Gap::Pole));
        assert_eq!(around.power(0.5), Err(Gap::Border));
        assert_eq!(around.asin(), Err(Gap::Border));
        assert_eq!(ValueRange::number(800.0).rising(f64::exp), Err(Gap::Pole));
        assert_eq!(ValueRange::number(1e101).of_coordinate(), Err(Gap::Pole));
    }
}
