//! Numbers of twice the precision: the unevaluated sum of two doubles.
//!
//! Only what the proofs need when plain doubles cannot decide a sign. The algorithms are the
//! accurate ones of Dekker and Knuth; each operation errs by less than 2⁻¹⁰² of its result
//! (Joldes, Muller, Popescu, "Tight and rigorous error bounds for basic building blocks of
//! double-word arithmetic", 2017, prove at most 15 · 2⁻¹⁰⁶).

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::geometry::error_free::{two_product, two_sum};

/// Hold the number `high` + `low`, |`low`| at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct DoubleDouble {
    pub(super) high: f64,
    pub(super) low: f64,
}

impl DoubleDouble {
    /// Subtract two doubles without error.
    pub(super) fn difference(a: f64, b: f64) -> Self {
        Self::from_pair(two_sum(a, -b))
    }

    /// Multiply two doubles without error, unless the result leaves the range of numbers.
    pub(super) fn product(a: f64, b: f64) -> Self {
        Self::from_pair(two_product(a, b))
    }

    fn from_pair((high, low): (f64, f64)) -> Self {
        Self { high, low }
    }

    /// Multiply by a power of two.
    pub(super) fn scaled(self, power_of_two: f64) -> Self {
        Self {
            high: self.high * power_of_two,
            low: self.low * power_of_two,
        }
    }
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        Self {
            high: value,
            low: 0.0,
        }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, error) = two_sum(self.high, other.high);
        let (low, least) = two_sum(self.low, other.low);
        let sum = quick_two_sum(high, error + low);
        quick_two_sum(sum.high, least + sum.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        quick_two_sum(product.high, product.low + cross)
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        let third = rest.high / other.high;
        quick_two_sum(first, second) + Self::from(third)
    }
}

/// Add two doubles without error, |a| ≥ |b|.
#[inline]
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    let low = b - (high - a);
    DoubleDouble { high, low }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_bigint::BigInt;
    use num_rational::BigRational;

    fn exact(value: DoubleDouble) -> BigRational {
        let rational = |part| BigRational::from_float(part).unwrap_or_default();
        rational(value.high) + rational(value.low)
    }

    fn assert_close(found: DoubleDouble, expected: &BigRational) {
        let error = exact(found) - expected;
        let allowed = expected / BigRational::from(BigInt::from(1) << 102);
        assert!(&error * &error <= &allowed * &allowed, "{found:?}");
    }

    #[test]
    fn every_operation_errs_by_less_than_two_to_the_minus_102() {
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let unit = (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
            unit * 2.0_f64.powi((state % 41) as i32 - 20)
        };
        for _ in 0..500 {
            let a = DoubleDouble::from(next()) + DoubleDouble::from(next() * 1e-17);
            let b = DoubleDouble::from(next()) + DoubleDouble::from(next() * 1e-17);
            assert_close(a + b, &(exact(a) + exact(b)));
            assert_close(a - b, &(exact(a) - exact(b)));
            assert_close(a * b, &(exact(a) * exact(b)));
            assert_close(a / b, &(exact(a) / exact(b)));
            let (a, b) = (a.high, b.high);
            let parts = [a, b].map(|part| exact(DoubleDouble::from(part)));
            assert_eq!(exact(DoubleDouble::product(a, b)), &parts[0] * &parts[1]);
            assert_eq!(exact(DoubleDouble::difference(a, b)), &parts[0] - &parts[1]);
        }
    }
}
