//! Numbers of more digits than a double: unevaluated sums of K doubles, or of K vectors component by
//! component.
//!
//! K = 2 is double-double arithmetic (106 bits): conversions that interpolate, differences of
//! vertices, and proofs where plain doubles cannot decide a sign. Conversions that extrapolate lose
//! the digits of their amplification, (2n − 1)!!: 52 bits at degree 15, 103 at degree 25, so they
//! carry K = 3 (159 bits).
//!
//! Of K = 2 every result is normalised: its second double is at most half a unit in the last place
//! of the first. A sum errs by at most 3 · 2⁻¹⁰⁶ of what its terms' magnitudes sum up to, a product
//! by at most 5 · 2⁻¹⁰⁶ of itself, a quotient by at most 15 · 2⁻¹⁰⁶ (Joldes, Muller, Popescu, "Tight
//! and rigorous error bounds for basic building blocks of double-word arithmetic", 2017): all by
//! less than 2⁻¹⁰².
//!
//! Of K = 3 sums and products are split into their rounded value and its error without loss; the list
//! of terms is then distilled into K parts, each pass taking the rounded sum and leaving the errors
//! behind (Ogita, Rump and Oishi, "Accurate sum and dot product", 2005). The error of an operation
//! is a few units of 2⁻¹⁵⁹ of the sum of its terms' magnitudes.

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::DVec4;

use super::blend::Blend;
use super::error_free::{quick_two_sum, two_product, two_sum};

/// The most terms that one operation distils: for K = 3 those of a product and a number added, and
/// those of two numbers times a double each.
const MOST_TERMS: usize = 12;

/// Hold a number, or a vector, as the sum of K doubles or vectors, the largest first. K is 2 or 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::geometry) struct Expansion<const K: usize, T = f64>([T; K]);

/// A number of twice the digits.
pub(in crate::geometry) type DoubleDouble = Expansion<2>;

/// Parts of an expansion: doubles, or vectors of them.
pub(in crate::geometry) trait Part:
    Copy
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<f64, Output = Self>
{
}

impl Part for f64 {}
impl Part for DVec4 {}

impl<const K: usize, T: Part> Expansion<K, T> {
    /// The K parts.
    #[inline(always)]
    pub(in crate::geometry) fn parts(&self) -> &[T; K] {
        &self.0
    }

    /// The number of two parts, |`high`| ≥ |`low`|.
    #[inline(always)]
    fn pair(high: T, low: T) -> Self {
        Self::exact(quick_two_sum(high, low))
    }

    /// The number of a rounded result and its error.
    #[inline(always)]
    fn exact((value, error): (T, T)) -> Self {
        let mut parts = [T::default(); K];
        (parts[0], parts[1]) = (value, error);
        Self(parts)
    }

    /// Distil terms, given roughly from the largest to the smallest, into K parts.
    #[inline(always)]
    fn distilled(terms: &mut [T]) -> Self {
        let mut parts = [T::default(); K];
        for (pass, part) in parts.iter_mut().enumerate() {
            let mut sum = T::default();
            if pass + 1 == K {
                *part = terms.iter().rev().fold(sum, |sum, term| sum + *term);
                break;
            }
            for term in terms.iter_mut().rev() {
                (sum, *term) = two_sum(sum, *term);
            }
            *part = sum;
        }
        Self(parts)
    }
}

impl<const K: usize> Expansion<K> {
    /// Multiply two doubles without error, unless the product leaves the range of numbers.
    #[inline(always)]
    pub(in crate::geometry) fn product(a: f64, b: f64) -> Self {
        Self::exact(two_product(a, b))
    }

    /// Subtract two doubles without error.
    #[inline(always)]
    pub(in crate::geometry) fn difference(a: f64, b: f64) -> Self {
        Self::exact(two_sum(a, -b))
    }

    /// Add a product of two numbers.
    #[inline(always)]
    pub(in crate::geometry) fn plus_product(self, a: Self, b: Self) -> Self {
        if K == 2 {
            return self + a * b;
        }
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

    /// Round to two parts, or add parts that are 0.
    pub(in crate::geometry) fn resized<const J: usize>(self) -> Expansion<J> {
        if J == 2 {
            let rest = self.0[1..].iter().rev().fold(0.0, |sum, part| part + sum);
            return Expansion::exact(two_sum(self.0[0], rest));
        }
        Expansion(std::array::from_fn(|part| {
            self.0.get(part).copied().unwrap_or(0.0)
        }))
    }

    /// Multiply by a power of two.
    pub(in crate::geometry) fn scaled(self, power_of_two: f64) -> Self {
        Self(self.0.map(|part| part * power_of_two))
    }

    /// Round to the nearest double.
    #[inline(always)]
    pub(in crate::geometry) fn value(self) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, part| part + sum)
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
        if K == 2 {
            Self::pair(parts[0], parts[1])
        } else {
            Self(parts)
        }
    }
}

impl DoubleDouble {
    /// The nearest double.
    #[inline(always)]
    pub(in crate::geometry) fn high(self) -> f64 {
        self.0[0]
    }

    /// The remainder beside the nearest double.
    #[inline(always)]
    pub(in crate::geometry) fn low(self) -> f64 {
        self.0[1]
    }
}

impl<const K: usize, T: Part> Default for Expansion<K, T> {
    fn default() -> Self {
        Self([T::default(); K])
    }
}

impl<const K: usize, T: Part> From<T> for Expansion<K, T> {
    fn from(value: T) -> Self {
        Self::exact((value, T::default()))
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

impl<const K: usize, T: Part> Add for Expansion<K, T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        if K == 2 {
            let (high, error) = two_sum(self.0[0], other.0[0]);
            return Self::pair(high, error + (self.0[1] + other.0[1]));
        }
        let mut terms = [T::default(); MOST_TERMS];
        for part in 0..K {
            terms[2 * part] = self.0[part];
            terms[2 * part + 1] = other.0[part];
        }
        Self::distilled(&mut terms[..2 * K])
    }
}

impl<const K: usize, T: Part> Sub for Expansion<K, T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const K: usize, T: Part> Neg for Expansion<K, T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|part| -part))
    }
}

impl<const K: usize, T: Part> Mul<f64> for Expansion<K, T> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        if K == 2 {
            let (high, error) = two_product(self.0[0], factor);
            return Self::pair(high, error + self.0[1] * factor);
        }
        let mut terms = [T::default(); MOST_TERMS];
        for part in 0..K {
            (terms[2 * part], terms[2 * part + 1]) = two_product(self.0[part], factor);
        }
        Self::distilled(&mut terms[..2 * K])
    }
}

impl<const K: usize> Mul for Expansion<K> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        if K == 2 {
            let (high, error) = two_product(self.0[0], other.0[0]);
            let cross = self.0[0] * other.0[1] + self.0[1] * other.0[0];
            return Self::pair(high, error + cross);
        }
        Self::default().plus_product(self, other)
    }
}

impl<const K: usize> Div<f64> for Expansion<K> {
    type Output = Self;

    #[inline(always)]
    fn div(self, divisor: f64) -> Self {
        self.quotient(divisor, |part| Self::product(part, divisor))
    }
}

impl<const K: usize> Div for Expansion<K> {
    type Output = Self;

    #[inline(always)]
    fn div(self, divisor: Self) -> Self {
        self.quotient(divisor.value(), |part| divisor * part)
    }
}

impl<const K: usize> Blend for Expansion<K> {
    #[inline(always)]
    fn blend(p: f64, a: &Self, q: f64, b: &Self, divisor: f64) -> Self {
        if K == 2 {
            return (*a * p + *b * q) / divisor;
        }
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
    fn twice_the_digits_err_by_less_than_two_to_the_minus_102() {
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let unit = (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
            unit * 2.0_f64.powi((state % 41) as i32 - 20)
        };
        let check_sum = |found: DoubleDouble, expected: &BigRational, size: &BigRational| {
            let error = (exact(found) - expected).abs();
            let allowed = size / BigRational::from(BigInt::from(1) << 102);
            assert!(error <= allowed, "{found:?}");
            assert_eq!(found.high(), found.high() + found.low());
        };
        let check = |found, expected: &BigRational| check_sum(found, expected, &expected.abs());
        for _ in 0..500 {
            let a = DoubleDouble::from(next()) + DoubleDouble::from(next() * 1e-17);
            let b = DoubleDouble::from(next()) + DoubleDouble::from(next() * 1e-17);
            let size = exact(a).abs() + exact(b).abs();
            check_sum(a + b, &(exact(a) + exact(b)), &size);
            check_sum(a - b, &(exact(a) - exact(b)), &size);
            let near = a * (1.0 + 1e-15);
            check_sum(near - a, &(exact(near) - exact(a)), &exact(a).abs());
            check(a * b, &(exact(a) * exact(b)));
            check(a / b, &(exact(a) / exact(b)));
            check(a * b.high(), &(exact(a) * rational(b.high())));
            check(a / b.high(), &(exact(a) / rational(b.high())));
            let (a, b) = (a.high(), b.high());
            assert_eq!(
                exact(DoubleDouble::product(a, b)),
                rational(a) * rational(b)
            );
            assert_eq!(
                exact(DoubleDouble::difference(a, b)),
                rational(a) - rational(b)
            );
        }
    }

    #[test]
    fn vectors_are_computed_component_by_component() {
        let [a, b] = [1.0 / 3.0, 1e60 / 7.0].map(|value| [value, -value, 12345.6789, 1.0]);
        let vectors = [a, b].map(|list| Expansion::<2, DVec4>::from(DVec4::from_array(list)));
        let found = (vectors[0] - vectors[1]) * 0.7;
        for axis in 0..4 {
            let expected = (DoubleDouble::from(a[axis]) - DoubleDouble::from(b[axis])) * 0.7;
            assert_eq!(found.0.map(|part| part[axis]), expected.0);
        }
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
