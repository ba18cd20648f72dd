//! Polynomials without their multiple roots.
//!
//! With f = Π fₖᵏ, where no fₖ has a multiple root or shares one with another, f has the sign of
//! the product of those of odd k: what else it has is a square. So a root of even multiplicity is
//! no change of sign, one of odd multiplicity is one, and both are decided by a polynomial whose
//! roots are all simple.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::common_divisor::{common_divisor, divided};
use super::exact_polynomial::ExactPolynomial;

impl ExactPolynomial {
    /// Find the polynomial of simple roots only that has the sign of this one on 0 < t < 1, but
    /// for single points where this one is 0; its ends are not 0. `None` if it would take too
    /// long.
    ///
    /// The coefficients sᵢ are those of a polynomial in x = t / (1 − t) from 0 to ∞, where
    /// factors x and 1 + x are positive; they are left out. The factors fₖ are found by Yun's
    /// algorithm.
    pub(super) fn odd_part(&self) -> Option<Self> {
        let reduced = self.without_positive_factors();
        let negative = reduced.last().is_some_and(Signed::is_negative);
        let slope = slope(&reduced);
        let shared = common_divisor(&reduced, &slope)?;
        if shared.len() <= 1 {
            return Some(Self::new(reduced));
        }
        let mut rest = divided(&reduced, &shared)?;
        let mut falling = difference(&divided(&slope, &shared)?, &self::slope(&rest));
        let mut product = vec![if negative {
            -BigInt::one()
        } else {
            BigInt::one()
        }];
        let mut is_odd = true;
        while rest.len() > 1 {
            let factor = common_divisor(&rest, &falling)?;
            rest = divided(&rest, &factor)?;
            falling = difference(&divided(&falling, &factor)?, &self::slope(&rest));
            if is_odd {
                product = times(&product, &factor);
            }
            is_odd = !is_odd;
        }
        Some(Self::new(product))
    }

    /// Find the polynomial that has every root on 0 < t < 1 that these polynomials share, once.
    /// `None` if it would take too long; 0 if all of them are.
    pub(super) fn shared_roots<'a>(polynomials: impl Iterator<Item = &'a Self>) -> Option<Self> {
        let shared = polynomials.map(Self::without_positive_factors);
        let shared = shared
            .map(Some)
            .reduce(|a, b| common_divisor(&a?, &b?))
            .flatten()?;
        let multiple = common_divisor(&shared, &slope(&shared))?;
        let shared = if multiple.len() > 1 {
            divided(&shared, &multiple)?
        } else {
            shared
        };
        Some(Self::new(shared))
    }

    fn without_positive_factors(&self) -> Vec<BigInt> {
        let mut list = self.coefficients();
        while let [first, rest @ ..] = list
            && first.is_zero()
        {
            list = rest;
        }
        while let [rest @ .., last] = list
            && last.is_zero()
        {
            list = rest;
        }
        let mut list = list.to_vec();
        let pole = [BigInt::one(), BigInt::one()];
        while list.len() > 1
            && let Some(quotient) = divided(&list, &pole)
        {
            list = quotient;
        }
        list
    }
}

fn slope(list: &[BigInt]) -> Vec<BigInt> {
    let terms = list.iter().enumerate().skip(1);
    terms
        .map(|(power, coefficient)| coefficient * power)
        .collect()
}

fn times(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let product = ExactPolynomial::new(a.to_vec()).times(&ExactPolynomial::new(b.to_vec()));
    product.coefficients().to_vec()
}

/// Subtract, and leave out zeros at the end.
fn difference(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let size = a.len().max(b.len());
    let at = |list: &[BigInt], index: usize| list.get(index).cloned().unwrap_or_default();
    let mut result: Vec<_> = (0..size).map(|index| at(a, index) - at(b, index)).collect();
    while result.last().is_some_and(Zero::is_zero) {
        result.pop();
    }
    result
}
