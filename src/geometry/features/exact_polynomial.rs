//! Polynomials on \[0, 1\] with whole coefficients, where rounded numbers leave a doubt.

use num_bigint::BigInt;
use num_traits::{One, Zero};

use super::floating::Floating;
use crate::geometry::whole_numbers::sign;

/// Hold a polynomial Σ sᵢ tⁱ (1 − t)ᴺ⁻ⁱ: its Bernstein coefficients times binomial coefficients.
/// Without coefficients it is 0.
#[derive(Clone, Debug, Default)]
pub(super) struct ExactPolynomial(Vec<BigInt>);

impl ExactPolynomial {
    /// Take the coefficients sᵢ.
    pub(super) fn new(coefficients: Vec<BigInt>) -> Self {
        Self(coefficients)
    }

    /// Take a number for a polynomial of degree 0.
    pub(super) fn constant(value: u32) -> Self {
        Self(vec![BigInt::from(value)])
    }

    /// The coefficients sᵢ.
    pub(super) fn coefficients(&self) -> &[BigInt] {
        &self.0
    }

    /// Whether it is 0 everywhere.
    pub(super) fn is_zero(&self) -> bool {
        self.0.iter().all(Zero::is_zero)
    }

    /// The number of binary digits of its largest coefficient.
    pub(super) fn bits(&self) -> u64 {
        self.0.iter().map(BigInt::bits).max().unwrap_or(0)
    }

    /// Multiply two polynomials.
    pub(super) fn times(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::default();
        }
        let mut product = vec![BigInt::zero(); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate().filter(|(_, a)| !a.is_zero()) {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        Self(product)
    }

    /// Add a multiple of another polynomial, of the same degree or 0.
    pub(super) fn plus(mut self, factor: impl Into<BigInt>, other: &Self) -> Self {
        let factor = factor.into();
        if self.0.is_empty() {
            self.0.resize(other.0.len(), BigInt::zero());
        }
        for (sum, term) in self.0.iter_mut().zip(&other.0) {
            *sum += &factor * term;
        }
        self
    }

    /// Differentiate.
    pub(super) fn derivative(&self) -> Self {
        let degree = self.0.len().saturating_sub(1);
        let slopes = self.0.windows(2).enumerate();
        let slopes = slopes.map(|(i, pair)| (i + 1) * &pair[1] - (degree - i) * &pair[0]);
        Self(slopes.collect())
    }

    /// The values at t = 0 and t = 1.
    pub(super) fn ends(&self) -> [BigInt; 2] {
        [self.0.first(), self.0.last()].map(|end| end.cloned().unwrap_or_default())
    }

    /// Tell the sign at p/q, for 0 ≤ p ≤ q.
    pub(super) fn sign_at(&self, place: &[BigInt; 2]) -> i8 {
        sign(&self.scaled_value(place))
    }

    /// The degree that it is written with.
    pub(super) fn degree(&self) -> usize {
        self.0.len().saturating_sub(1)
    }

    /// Evaluate at p / 2^`bits`.
    pub(super) fn floating_at(&self, place: &[BigInt; 2], bits: u64) -> Floating {
        let exponent = bits as i64 * self.degree() as i64;
        Floating::new(&self.scaled_value(place), -exponent)
    }

    /// Evaluate at p/q, times qᴺ.
    pub(super) fn scaled_value(&self, [p, q]: &[BigInt; 2]) -> BigInt {
        let rest = q - p;
        let (mut sum, mut power) = (BigInt::zero(), BigInt::one());
        for coefficient in self.0.iter().rev() {
            sum = sum * p + coefficient * &power;
            power *= &rest;
        }
        sum
    }

    /// Write the parts of \[0, 1\] on both sides of the cut at `place` / 2^`bits` as polynomials on
    /// \[0, 1\], but for positive factors.
    pub(super) fn cut(&self, place: u32, bits: u32) -> [Self; 2] {
        let reversed = Self(self.0.iter().rev().cloned().collect());
        let mut left = reversed.behind((1 << bits) - place, bits);
        left.0.reverse();
        [left, self.behind(place, bits)]
    }

    /// Rough number of single-digit additions of a cut.
    pub(super) fn cost(&self) -> u64 {
        /// Overhead of one addition.
        const LEAST: u64 = 8;
        let size = self.0.len() as u64;
        size * size * (self.bits() / 64 + LEAST)
    }

    /// The part behind a cut: with t = (a (1 − τ) + c τ) / c and 1 − t = (c − a) (1 − τ) / c,
    /// c = 2^`bits`.
    fn behind(&self, place: u32, bits: u32) -> Self {
        let mut coefficients = self.0.clone();
        let mut power = BigInt::one();
        for coefficient in coefficients.iter_mut().rev() {
            *coefficient *= &power;
            power *= (1 << bits) - place;
        }
        let last = coefficients.len().saturating_sub(1);
        for from in 0..last {
            for index in (from..last).rev() {
                let carried = place * &coefficients[index + 1];
                coefficients[index] += carried;
            }
        }
        for (index, coefficient) in coefficients.iter_mut().enumerate() {
            *coefficient <<= bits as usize * index;
        }
        let spare = coefficients.iter().filter_map(BigInt::trailing_zeros).min();
        for coefficient in &mut coefficients {
            *coefficient >>= spare.unwrap_or(0);
        }
        Self(coefficients)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Multiply factors a t − b (1 − t), which have the roots b / (a + b).
    pub(in super::super) fn with_roots(factors: &[(i64, i64)]) -> ExactPolynomial {
        let factor =
            |(a, b): &(i64, i64)| ExactPolynomial::new([-b, *a].map(BigInt::from).to_vec());
        let one = ExactPolynomial::constant(1);
        factors
            .iter()
            .map(factor)
            .fold(one, |product, factor| product.times(&factor))
    }

    #[test]
    fn derivatives_are_those_of_the_polynomial() {
        // (2 t − (1 − t))² = (3 t − 1)² has the derivative 6 (3 t − 1).
        let square = with_roots(&[(2, 1), (2, 1)]);
        let expected = with_roots(&[(12, 6)]);
        assert_eq!(square.derivative().0, expected.0);
        assert!(ExactPolynomial::constant(3).derivative().is_zero());
    }
}
