//! Numbers of more digits than a double: unevaluated sums of K doubles.
//!
//! K = 2 is double-double arithmetic (106 bits), enough for conversions that interpolate. Those
//! that extrapolate lose the digits of their amplification, (2n − 1)!!: 52 bits at degree 15,
//! 103 at degree 25, so they carry K = 3 (159 bits).
//!
//! Sums and products are split into their rounded value and its error without loss (Knuth's
//! TwoSum, Dekker's product); a list of terms is then distilled into K parts, each pass taking
//! the rounded sum and leaving the errors behind (Ogita, Rump and Oishi, "Accurate sum and dot
//! product", 2005). The error of an operation is a few units of 2^(−53 K) of the sum of its
//! terms' magnitudes.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::knots::Blend;
use crate::geometry::error_free::{two_product, two_sum};

/// The most terms that one operation distils: for K = 3 those of a product and a number added, and
/// those of two numbers times a double each.
const MOST_TERMS: usize = 12;

/// Hold a number as the sum of K doubles, the largest first. K is 2 or 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::geometry) struct Expansion<const K: usize>([f64; K]);

impl<const K: usize> Expansion<K> {
    /// The number 0.
    pub(in crate::geometry) const ZERO: Self = Self([0.0; K]);

    /// Multiply two doubles without error, unless the product leaves the range of numbers.
    pub(in crate::geometry) fn product(a: f64, b: f64) -> Self {
        let mut parts = [0.0; K];
        (parts[0], parts[1]) = two_product(a, b);
        Self(parts)
    }

    /// Add a product of two numbers.
    #[inline(always)]
    pub(in crate::geometry) fn plus_product(self, a: Self, b: Self) -> Self {
        let mut terms = [0.0; MOST_TERMS];
        let mut count = 0;
        for order in 0..K {
            terms[count] = self.0[order];
            count += 1;
            for part in 0..=order {
                let (a, b) = (a.0[part], b.0[order - part]);
                // The errors of the smallest products are beyond the K parts.
                if order + 1 < K {
                    (terms[count], terms[count + 1]) = two_product(a, b);
                    count += 2;
                } else {
                    terms[count] = a * b;
                    count += 1;
                }
            }
        }
        Self::distilled(&mut terms[..count])
    }

    /// Keep the first parts, or add parts that are 0.
    pub(in crate::geometry) fn resized<const J: usize>(self) -> Expansion<J> {
        Expansion(std::array::from_fn(|part| {
            self.0.get(part).copied().unwrap_or(0.0)
        }))
    }

    /// The K doubles.
    pub(in crate::geometry) fn parts(&self) -> &[f64; K] {
        &self.0
    }

    /// Round to the nearest double.
    pub(in crate::geometry) fn value(self) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, part| part + sum)
    }

    /// Distil terms, given roughly from the largest to the smallest, into K parts.
    #[inline(always)]
    fn distilled(terms: &mut [f64]) -> Self {
        let mut parts = [0.0; K];
        for (pass, part) in parts.iter_mut().enumerate() {
            let mut sum = 0.0;
            if pass + 1 == K {
                *part = terms.iter().rev().fold(sum, |sum, term| sum + term);
                break;
            }
            for term in terms.iter_mut().rev() {
                (sum, *term) = two_sum(sum, *term);
            }
            *part = sum;
        }
        Self(parts)
    }

    /// Divide by repeatedly taking the quotient of the leading doubles off the remainder.
    #[inline(always)]
    fn quotient(self, leading: f64, multiple: impl Fn(f64) -> Self) -> Self {
        let mut parts = [0.0; K];
        let mut remainder = self;
        for (pass, part) in parts.iter_mut().enumerate() {
            *part = remainder.value() / leading;
            if pass + 1 < K {
                remainder = remainder - multiple(*part);
            }
        }
        Self(parts)
    }
}

impl<const K: usize> From<f64> for Expansion<K> {
    fn from(value: f64) -> Self {
        let mut parts = [0.0; K];
        parts[0] = value;
        Self(parts)
    }
}

impl From<i128> for Expansion<3> {
    /// Take an integer exactly: its 127 bits fit into three doubles.
    fn from(value: i128) -> Self {
        let high = value as f64;
        let rest = value - high as i128;
        let middle = rest as f64;
        let low = (rest - middle as i128) as f64;
        Self([high, middle, low])
    }
}

impl<const K: usize> Add for Expansion<K> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let mut terms = [0.0; MOST_TERMS];
        for part in 0..K {
            terms[2 * part] = self.0[part];
            terms[2 * part + 1] = other.0[part];
        }
        Self::distilled(&mut terms[..2 * K])
    }
}

impl<const K: usize> Sub for Expansion<K> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const K: usize> Neg for Expansion<K> {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|part| -part))
    }
}

impl<const K: usize> Mul<f64> for Expansion<K> {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        let mut terms = [0.0; MOST_TERMS];
        for part in 0..K {
            (terms[2 * part], terms[2 * part + 1]) = two_product(self.0[part], factor);
        }
        Self::distilled(&mut terms[..2 * K])
    }
}

impl<const K: usize> Mul for Expansion<K> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::ZERO.plus_product(self, other)
    }
}

impl<const K: usize> Div<f64> for Expansion<K> {
    type Output = Self;

    fn div(self, divisor: f64) -> Self {
        self.quotient(divisor, |part| Self::product(part, divisor))
    }
}

impl<const K: usize> Div for Expansion<K> {
    type Output = Self;

    fn div(self, divisor: Self) -> Self {
        self.quotient(divisor.value(), |part| divisor * part)
    }
}

impl<const K: usize> Blend for Expansion<K> {
    #[inline(always)]
    fn blend(p: f64, a: &Self, q: f64, b: &Self, divisor: f64) -> Self {
        let mut terms = [0.0; MOST_TERMS];
        for part in 0..K {
            (terms[4 * part], terms[4 * part + 2]) = two_product(a.0[part], p);
            (terms[4 * part + 1], terms[4 * part + 3]) = two_product(b.0[part], q);
        }
        Self::distilled(&mut terms[..4 * K]) / divisor
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_bigint::BigInt;
    use num_rational::BigRational;
    use num_traits::{FromPrimitive, Signed, ToPrimitive};

    fn exact<const K: usize>(number: Expansion<K>) -> BigRational {
        number.0.iter().map(|part| rational(*part)).sum()
    }

    fn rational(value: f64) -> BigRational {
        BigRational::from_f64(value).unwrap()
    }

    /// Assert that a result has all but a few bits of its K doubles right.
    #[track_caller]
    fn assert_close<const K: usize>(found: Expansion<K>, expected: &BigRational) {
        let error = ((exact(found) - expected) / expected).abs().to_f64();
        let allowed = 16.0 * 2.0_f64.powi(-53 * K as i32);
        assert!(error.unwrap() <= allowed, "{error:?} > {allowed:e}");
    }

    fn check_operations<const K: usize>() {
        for (a, b) in [(1.1, 3.3), (1e100, 7e-100), (-0.3, 1e30 + 1.0), (5.0, 3.0)] {
            let (left, right) = (Expansion::<K>::from(a), Expansion::<K>::from(b));
            let (x, y) = (rational(a), rational(b));
            let third = left / 3.0;
            let exact_third = &x / rational(3.0);
            assert_close(third, &exact_third);
            assert_eq!(exact(Expansion::<K>::product(a, b)), &x * &y);
            assert_close(third + right, &(&exact_third + &y));
            assert_close(third - right, &(&exact_third - &y));
            assert_close(third * right, &(&exact_third * &y));
            assert_close(third * b, &(&exact_third * &y));
            assert_close(right / third, &(&y / &exact_third));
            let blend = Expansion::blend(2.0, &third, 5.0, &right, 7.0);
            let expected = (rational(2.0) * &exact_third + rational(5.0) * &y) / rational(7.0);
            assert_close(blend, &expected);
        }
    }

    #[test]
    fn operations_keep_twice_and_three_times_the_digits() {
        check_operations::<2>();
        check_operations::<3>();
    }

    #[test]
    fn integers_are_exact() {
        for value in [
            0,
            1,
            -7,
            i128::MAX / 3,
            5_843_921_666_542_530_000_000_000_000_001,
        ] {
            let expected = BigRational::from_integer(BigInt::from(value));
            assert_eq!(exact(Expansion::<3>::from(value)), expected);
        }
    }
}
