//! The greatest common divisor of polynomials with whole coefficients, by its images modulo
//! numbers of 61 bits (Brown, 1971).

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Moduli are looked for below this number.
const LARGEST: u64 = 1 << 61;

/// The most moduli that are tried: divisors with longer coefficients would take too long.
const MOST_MODULI: usize = 400;

/// Find the greatest common divisor of two polynomials, written as coefficients in powers of x,
/// the last one not 0; an empty list is 0. Its coefficients have no common factor, the last one
/// is positive. `None` if it would take too long.
///
/// An image never has a lower degree than the divisor, so an image that is constant proves that
/// there is none, and a polynomial of the degree of an image that divides both is the one.
pub(super) fn common_divisor(a: &[BigInt], b: &[BigInt]) -> Option<Vec<BigInt>> {
    match (a, b) {
        ([], other) | (other, []) => Some(primitive(other)),
        _ => common_divisor_of_nonzero(a, b),
    }
}

fn common_divisor_of_nonzero(a: &[BigInt], b: &[BigInt]) -> Option<Vec<BigInt>> {
    let ends = [a.last()?, b.last()?];
    let mut lead = None;
    // The images' common multiple by the leading coefficient, and the product of their moduli.
    let (mut sum, mut product) = (Vec::<BigInt>::new(), BigInt::one());
    let candidates = (0..).map(|index| LARGEST - 1 - 2 * index);
    let moduli = candidates.filter(|candidate| power(2, candidate - 1, *candidate) == 1);
    for modulus in moduli.take(MOST_MODULI) {
        let images = [a, b].map(|list| residues(list, modulus));
        let [Some(_), Some(_)] = images
            .each_ref()
            .map(|image| image.last().filter(|last| **last != 0))
        else {
            continue;
        };
        let Some(mut image) = divisor_modulo(images, modulus) else {
            continue;
        };
        if image.len() == 1 {
            return Some(vec![BigInt::one()]);
        }
        if !sum.is_empty() && image.len() > sum.len() {
            continue;
        }
        if image.len() < sum.len() || sum.is_empty() {
            (sum, product) = (vec![BigInt::zero(); image.len()], BigInt::one());
        }
        // What the divisor's own leading coefficient divides.
        let lead = lead.get_or_insert_with(|| ends[0].gcd(ends[1]));
        let scale = residue(lead, modulus);
        for coefficient in &mut image {
            *coefficient = multiply(*coefficient, scale, modulus);
        }
        if combine(&mut sum, &mut product, &image, modulus) {
            let candidate = primitive(&sum);
            if divided(a, &candidate).is_some() && divided(b, &candidate).is_some() {
                return Some(candidate);
            }
        }
    }
    None
}

/// Divide by a polynomial without common factor; `None` if it leaves a rest.
pub(super) fn divided(a: &[BigInt], b: &[BigInt]) -> Option<Vec<BigInt>> {
    let last = b.last()?;
    let mut rest = a.to_vec();
    let mut quotient = vec![BigInt::zero(); (a.len() + 1).saturating_sub(b.len())];
    for (offset, place) in quotient.iter_mut().enumerate().rev() {
        let (share, left) = rest.get(offset + b.len() - 1)?.div_rem(last);
        if !left.is_zero() {
            return None;
        }
        for (rest, coefficient) in rest[offset..].iter_mut().zip(b) {
            *rest -= &share * coefficient;
        }
        *place = share;
    }
    rest.iter().all(Zero::is_zero).then_some(quotient)
}

/// Divide by the common factor of the coefficients, and make the last one positive.
fn primitive(list: &[BigInt]) -> Vec<BigInt> {
    let factor = list.iter().fold(BigInt::zero(), |factor, next| {
        if factor.is_one() {
            factor
        } else {
            factor.gcd(next)
        }
    });
    if factor.is_zero() {
        return list.to_vec();
    }
    let negative = list.last().is_some_and(Signed::is_negative);
    let factor = if negative { -factor } else { factor };
    list.iter()
        .map(|coefficient| coefficient / &factor)
        .collect()
}

/// Bring a sum into agreement with one more image, between ± half the product of the moduli;
/// tells whether it agreed before.
fn combine(sum: &mut [BigInt], product: &mut BigInt, image: &[u64], modulus: u64) -> bool {
    let mut agreed = true;
    let next = &*product * modulus;
    let half = &next >> 1_u8;
    let Some(inverse) = inverse(residue(product, modulus), modulus) else {
        return false;
    };
    for (sum, image) in sum.iter_mut().zip(image) {
        let missing = (image + modulus - residue(sum, modulus)) % modulus;
        if missing != 0 {
            agreed = false;
            *sum += &*product * multiply(missing, inverse, modulus);
            if *sum > half {
                *sum -= &next;
            }
        }
    }
    *product = next;
    agreed
}

/// Euclid's algorithm modulo a number; the result's leading coefficient is 1. `None` if a number
/// has no inverse.
fn divisor_modulo([mut a, mut b]: [Vec<u64>; 2], modulus: u64) -> Option<Vec<u64>> {
    if a.len() < b.len() {
        std::mem::swap(&mut a, &mut b);
    }
    while let Some(last) = b.last() {
        let inverse = inverse(*last, modulus)?;
        for coefficient in &mut b {
            *coefficient = multiply(*coefficient, inverse, modulus);
        }
        while a.len() >= b.len() {
            let share = a.pop().unwrap_or_default();
            let offset = a.len() + 1 - b.len();
            for (rest, coefficient) in a[offset..].iter_mut().zip(&b) {
                let product = multiply(share, *coefficient, modulus);
                *rest = (*rest + modulus - product) % modulus;
            }
        }
        while a.last() == Some(&0) {
            a.pop();
        }
        std::mem::swap(&mut a, &mut b);
    }
    Some(a)
}

fn residues(list: &[BigInt], modulus: u64) -> Vec<u64> {
    list.iter().map(|value| residue(value, modulus)).collect()
}

fn residue(value: &BigInt, modulus: u64) -> u64 {
    let wide = u128::from(modulus);
    let digits = value.iter_u64_digits().rev();
    let size = digits.fold(0, |rest: u128, digit| {
        ((rest << 64) | u128::from(digit)) % wide
    });
    if value.sign() == Sign::Minus && size != 0 {
        modulus - size as u64
    } else {
        size as u64
    }
}

fn multiply(a: u64, b: u64, modulus: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(modulus)) as u64
}

fn power(mut base: u64, mut exponent: u64, modulus: u64) -> u64 {
    let mut result = 1;
    while exponent > 0 {
        if exponent % 2 == 1 {
            result = multiply(result, base, modulus);
        }
        base = multiply(base, base, modulus);
        exponent /= 2;
    }
    result
}

/// The inverse modulo a number, if there is one.
fn inverse(value: u64, modulus: u64) -> Option<u64> {
    let found = i128::from(value).extended_gcd(&i128::from(modulus));
    (found.gcd == 1).then(|| found.x.rem_euclid(i128::from(modulus)) as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    type Factors<'a> = &'a [&'a [i64]];

    fn product(factors: Factors<'_>) -> Vec<BigInt> {
        let mut result = vec![BigInt::one()];
        for factor in factors {
            let mut next = vec![BigInt::zero(); result.len() + factor.len() - 1];
            for (i, a) in result.iter().enumerate() {
                for (j, b) in factor.iter().enumerate() {
                    next[i + j] += a * *b;
                }
            }
            result = next;
        }
        result
    }

    #[test]
    fn what_two_polynomials_share_is_found_and_nothing_else() {
        let (p, q, r): (&[i64], &[i64], &[i64]) =
            (&[-1, 3], &[5, 0, 7_000_000_007], &[2, -9, 4, 1]);
        let cases: [[Factors<'_>; 3]; 5] = [
            [&[p, q], &[r, q], &[q]],
            [&[p, p, q], &[p, p, p, r], &[p, p]],
            [&[p, q], &[r], &[]],
            [&[&[6], p], &[&[-4], p, r], &[p]],
            [&[p], &[p, q, r], &[p]],
        ];
        for [a, b, expected] in cases {
            assert_eq!(
                common_divisor(&product(a), &product(b)),
                Some(product(expected))
            );
        }
        assert_eq!(
            common_divisor(&[], &product(&[p, &[-2]])),
            Some(product(&[p]))
        );
    }

    #[test]
    fn long_coefficients_take_several_moduli() {
        let long = BigInt::from(3).pow(400);
        let shared = vec![-&long, BigInt::from(7), &long + 1];
        let times = |factor: i64| -> Vec<BigInt> {
            let low = shared.iter().map(|c| c * factor).chain([BigInt::zero()]);
            let high = [BigInt::zero()].into_iter().chain(shared.iter().cloned());
            low.zip(high).map(|(a, b)| a + b).collect()
        };
        let found = common_divisor(&times(3), &times(-5));
        assert_eq!(found.as_deref(), Some(&shared[..]));
        assert_eq!(
            divided(&times(3), &shared),
            Some([3, 1].map(BigInt::from).to_vec())
        );
        assert_eq!(divided(&times(3), &[2, 3, 1].map(BigInt::from)), None);
    }
}
