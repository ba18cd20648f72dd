//! Numbers with the digits of a double that no power takes out of range.

use std::ops::{Div, Mul};

use num_bigint::BigInt;
use num_traits::ToPrimitive;

use crate::geometry::power_of_two::{self, times_power_of_two};

/// A number digits · 2^exponent that no power takes out of range; digits are 0 or of size 1 … 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Floating {
    digits: f64,
    exponent: i64,
}

impl Floating {
    /// Write `number` · 2^exponent.
    pub(super) fn new(number: &BigInt, exponent: i64) -> Self {
        /// Beyond the precision of a double.
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
        let far = i64::from(i32::MAX);
        times_power_of_two(self.digits, self.exponent.clamp(-far, far) as i32)
    }

    fn normal(digits: f64, exponent: i64) -> Self {
        if digits == 0.0 || !digits.is_finite() {
            return Self {
                digits,
                exponent: 0,
            };
        }
        let shift = power_of_two::exponent(digits);
        Self {
            digits: times_power_of_two(digits, -shift),
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
}
