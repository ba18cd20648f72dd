//! Polynomials with whole coefficients.

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// A polynomial with exact coefficients, the constant one first; the last one is not 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Polynomial(Vec<BigInt>);

impl Polynomial {
    pub fn new(mut coefficients: Vec<BigInt>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    pub fn constant(value: impl Into<BigInt>) -> Self {
        Self::new(vec![value.into()])
    }

    pub fn coefficients(&self) -> &[BigInt] {
        &self.0
    }

    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The degree; 0 for 0 as well.
    pub fn degree(&self) -> usize {
        self.0.len().saturating_sub(1)
    }

    /// This polynomial plus a multiple of another one.
    pub fn plus(&self, other: &Self, factor: i64) -> Self {
        let size = self.0.len().max(other.0.len());
        let at = |list: &[BigInt], index: usize| list.get(index).cloned().unwrap_or_default();
        let sum = |index| at(&self.0, index) + at(&other.0, index) * factor;
        Self::new((0..size).map(sum).collect())
    }

    pub fn times(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::new(Vec::new());
        }
        let mut product = vec![BigInt::zero(); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate().filter(|(_, a)| !a.is_zero()) {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        Self::new(product)
    }

    pub fn derivative(&self) -> Self {
        let terms = self.0.iter().enumerate().skip(1);
        Self::new(
            terms
                .map(|(power, coefficient)| coefficient * power)
                .collect(),
        )
    }

    /// Without the common factor of its coefficients.
    pub fn primitive(&self) -> Self {
        let mut content = BigInt::zero();
        for coefficient in self.0.iter().rev() {
            content = common_divisor(&content, coefficient);
            if content.is_one() {
                return self.clone();
            }
        }
        Self::new(self.0.iter().map(|value| value / &content).collect())
    }

    /// The quotient, if it has whole coefficients and nothing is left.
    pub fn divided_by(&self, divisor: &Self) -> Option<Self> {
        let last = divisor.0.last().expect("a divisor that is not 0");
        if self.is_zero() {
            return Some(self.clone());
        }
        let count = self.0.len().checked_sub(divisor.0.len())? + 1;
        let mut rest = self.0.clone();
        let mut quotient = vec![BigInt::zero(); count];
        for index in (0..count).rev() {
            let leading = &rest[index + divisor.degree()];
            if !(leading % last).is_zero() {
                return None;
            }
            let factor = leading / last;
            if !factor.is_zero() {
                for (rest, coefficient) in rest[index..].iter_mut().zip(&divisor.0) {
                    *rest -= &factor * coefficient;
                }
            }
            quotient[index] = factor;
        }
        rest.iter().all(Zero::is_zero).then(|| Self::new(quotient))
    }

    /// The value at p / q, times q^degree, q > 0.
    pub fn scaled_value(&self, t: &BigRational) -> BigInt {
        let (mut sum, mut scale) = (BigInt::zero(), BigInt::one());
        for coefficient in self.0.iter().rev() {
            sum = sum * t.numer() + coefficient * &scale;
            scale *= t.denom();
        }
        sum
    }

    /// The sign at a double.
    pub fn sign_at(&self, t: f64) -> i32 {
        self.sign(&super::exact(t))
    }

    pub fn sign(&self, t: &BigRational) -> i32 {
        match self.scaled_value(t).sign() {
            Sign::Plus => 1,
            Sign::NoSign => 0,
            Sign::Minus => -1,
        }
    }

    /// The sign next to the start or the end of the interval from 0 to 1, seen from inside.
    pub fn end_sign(&self, at_end: bool) -> i32 {
        let mut coefficients = self.0.clone();
        if at_end {
            // p(1 − x).
            shift(&mut coefficients, &BigInt::one());
            for odd in coefficients.iter_mut().skip(1).step_by(2) {
                *odd = -&*odd;
            }
        }
        let first = coefficients.iter().find(|value| !value.is_zero());
        first.map_or(0, |first| if first.is_positive() { 1 } else { -1 })
    }

    /// Count the changes of sign inside the interval from 0 to 1 exactly.
    pub fn roots_inside(&self) -> usize {
        self.odd_roots().len()
    }
}

/// The greatest common divisor of two numbers.
pub(super) fn common_divisor(a: &BigInt, b: &BigInt) -> BigInt {
    if a.is_zero() || b.is_zero() {
        return (a + b).abs();
    }
    (a / BigRational::new(a.clone(), b.clone()).numer()).abs()
}

/// Replace p(x) by p(x + by).
pub(super) fn shift(coefficients: &mut [BigInt], by: &BigInt) {
    if by.is_zero() {
        return;
    }
    let size = coefficients.len();
    for level in 0..size.saturating_sub(1) {
        for index in (level..size - 1).rev() {
            let (low, high) = coefficients.split_at_mut(index + 1);
            if by.is_one() {
                low[index] += &high[0];
            } else {
                low[index] += by * &high[0];
            }
        }
    }
}
