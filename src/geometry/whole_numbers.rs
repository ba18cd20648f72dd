//! Doubles as whole numbers of any length, times a power of two.

use num_bigint::{BigInt, Sign};
use num_traits::{Float, One, Zero};

/// Multiply finite doubles by the smallest power of two that makes all of them whole.
pub(super) fn whole_numbers(values: &[f64]) -> Vec<BigInt> {
    scaled_numbers(values).0
}

/// Write finite doubles as whole numbers times one power of two, as large as it can be; returns
/// its exponent too.
pub(super) fn scaled_numbers(values: &[f64]) -> (Vec<BigInt>, i32) {
    let decoded: Vec<_> = values.iter().map(|value| decode(*value)).collect();
    let nonzero = decoded.iter().filter(|(digits, _)| !digits.is_zero());
    let least = nonzero.map(|(_, exponent)| *exponent).min().unwrap_or(0);
    let shifted = decoded
        .into_iter()
        .map(|(digits, exponent)| digits << (exponent - least).max(0));
    (shifted.collect(), least)
}

/// Write a double from 0 to 1 as a fraction p/q in lowest terms.
pub(super) fn fraction(value: f64) -> [BigInt; 2] {
    let (digits, exponent) = decode(value);
    [digits, BigInt::one() << exponent.min(0).unsigned_abs()]
}

/// Tell the sign of a whole number.
pub(super) fn sign(value: &BigInt) -> i8 {
    match value.sign() {
        Sign::Minus => -1,
        Sign::NoSign => 0,
        Sign::Plus => 1,
    }
}

/// Decide exactly whether numbers given as sums of two doubles satisfy a b = c d.
pub(super) fn products_agree([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let numbers = whole_numbers([a, b, c, d].as_flattened());
    let sum = |index: usize| &numbers[2 * index] + &numbers[2 * index + 1];
    sum(0) * sum(1) == sum(2) * sum(3)
}

/// Split a finite double into odd digits, or 0, and an exponent of two.
fn decode(value: f64) -> (BigInt, i32) {
    let (digits, exponent, sign) = value.integer_decode();
    if digits == 0 {
        return (BigInt::zero(), 0);
    }
    let spare = digits.trailing_zeros();
    let odd = BigInt::from(digits >> spare) * sign;
    (odd, i32::from(exponent) + spare as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_become_whole_numbers_without_loss() {
        let least = f64::from_bits(1);
        let values = [0.75, -3.0, 0.0, -0.0, 8.0];
        assert_eq!(whole_numbers(&values), [3, -12, 0, 0, 32].map(BigInt::from));
        assert_eq!(
            whole_numbers(&[least, -2.0 * least]),
            [1, -2].map(BigInt::from)
        );
        assert_eq!(fraction(0.375), [3, 8].map(BigInt::from));
        assert_eq!(fraction(1.0), [1, 1].map(BigInt::from));
        assert_eq!(fraction(0.0), [0, 1].map(BigInt::from));
    }

    #[test]
    fn products_of_sums_are_compared_to_the_last_digit() {
        let tiny = f64::EPSILON.powi(5);
        let one = [1.0, 0.0];
        assert!(products_agree([[1.0, tiny], one], [one, [1.0, tiny]]));
        assert!(!products_agree([[1.0, tiny], one], [one, one]));
    }
}
