//! Sums and products without loss, of numbers or of vectors component by component: the rounded
//! result and its error (Knuth's TwoSum; Dekker, "A floating-point technique for extending the
//! available precision", 1971).
//!
//! Dekker's product rather than a fused multiply-add: processors of the basic x86-64 level have
//! none, and its replacement in software is ten times slower.

use std::ops::{Add, Mul, Sub};

/// Splits a double into halves of 26 bits: 2²⁷ + 1.
const SPLITTER: f64 = 134_217_729.0;

/// Add: the rounded sum and its error.
#[inline(always)]
pub(super) fn two_sum<T>(a: T, b: T) -> (T, T)
where
    T: Copy + Add<Output = T> + Sub<Output = T>,
{
    let sum = a + b;
    let other = sum - a;
    (sum, (a - (sum - other)) + (b - other))
}

/// Add where |a| ≥ |b|: the rounded sum and its error.
#[inline(always)]
pub(super) fn quick_two_sum<T>(a: T, b: T) -> (T, T)
where
    T: Copy + Add<Output = T> + Sub<Output = T>,
{
    let sum = a + b;
    (sum, b - (sum - a))
}

/// Multiply by a double: the rounded product and its error, unless it leaves the range of numbers.
#[inline(always)]
pub(super) fn two_product<T>(a: T, b: f64) -> (T, T)
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    let error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    (product, error)
}

/// Split into numbers of half the digits, whose products are exact.
#[inline(always)]
fn halves<T>(value: T) -> (T, T)
where
    T: Copy + Sub<Output = T> + Mul<f64, Output = T>,
{
    let spread = value * SPLITTER;
    let high = spread - (spread - value);
    (high, value - high)
}
