//! Polynomials in Bernstein form whose coefficients carry rigorous error bounds.
//!
//! A coefficient is a computed value and a bound of its error; the true coefficient lies
//! between value ± bound. Products are formed in scaled form, coefficient i times the binomial
//! coefficient (N over i), where multiplying is plain convolution. Every bound counts what its
//! operands may be off by, what each operation rounds, and what may vanish below the range of
//! numbers; only a coefficient that is exactly 0 by its structure has value and bound 0.

use std::mem::take;

use super::ring::Ring;
use super::scalar::{FLOOR, Scalar};
use crate::geometry::cut::cut;
use crate::geometry::expansion::DoubleDouble;
use crate::geometry::tables::{bernstein_matrix, binomials};

/// What the arithmetic of the bounds itself may round: fewer than 2⁸ operations in a chain or
/// 2¹² in a sum.
const SLACK: f64 = 1.0 + f64::EPSILON * 4096.0;

/// Rounding error of one step of subdivision.
const STEP_SLACK: f64 = 1.0 + f64::EPSILON * 8.0;

/// Hold the coefficients of any number of polynomials, in one place that is used again.
#[derive(Debug, Default)]
pub(super) struct Arena<T> {
    values: Vec<T>,
    errors: Vec<f64>,
    /// Room for the two parts that a cut makes.
    before: Vec<(T, f64)>,
    behind: Vec<(T, f64)>,
}

/// Name a polynomial in an arena.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polynomial {
    start: usize,
    pub(super) degree: usize,
    pub(super) vanishes: bool,
}

impl Polynomial {
    /// The polynomial 0, which takes no room.
    pub(super) const ZERO: Self = Self {
        start: 0,
        degree: 0,
        vanishes: true,
    };

    fn range(self) -> std::ops::Range<usize> {
        self.start..self.start + self.degree + 1
    }
}

impl<T: Scalar> Arena<T> {
    /// Forget all polynomials, but keep their room.
    pub(super) fn clear(&mut self) {
        self.release(0);
    }

    /// Fill level of the arena, to which [`Arena::release`] returns.
    pub(super) fn mark(&self) -> usize {
        self.values.len()
    }

    /// Forget the polynomials made since a mark.
    pub(super) fn release(&mut self, mark: usize) {
        self.values.truncate(mark);
        self.errors.truncate(mark);
    }

    /// The coefficients: values and error bounds. [`Polynomial::ZERO`] has none.
    pub(super) fn coefficients(&self, polynomial: Polynomial) -> (&[T], &[f64]) {
        if polynomial.vanishes {
            return (&[], &[]);
        }
        let range = polynomial.range();
        (&self.values[range.clone()], &self.errors[range])
    }

    /// Make room for a polynomial at the top, all 0.
    fn push(&mut self, degree: usize) -> Polynomial {
        let start = self.values.len();
        self.values.resize(start + degree + 1, T::default());
        self.errors.resize(start + degree + 1, 0.0);
        Polynomial {
            start,
            degree,
            vanishes: false,
        }
    }

    /// Take a polynomial by its coefficients in plain Bernstein form, with error bounds.
    pub(super) fn plain(&mut self, values: &[DoubleDouble], bounds: &[f64]) -> Polynomial {
        let result = self.push(values.len() - 1);
        for (index, (value, bound)) in result.range().zip(values.iter().zip(bounds)) {
            self.values[index] = T::from_wide(*value);
            self.errors[index] = inflated(bound + T::conversion_error(*value));
        }
        result
    }

    /// Convert the control values of one segment of a uniform B-spline, given with error
    /// bounds, to Bernstein form.
    pub(super) fn convert(&mut self, controls: &[DoubleDouble], bounds: &[f64]) -> Polynomial {
        let degree = controls.len() - 1;
        let result = self.push(degree);
        let unit = T::TABLE_ERROR + T::UNIT * (degree as f64 + 3.0) * SLACK;
        let matrix = bernstein_matrix(degree);
        for (j, row) in matrix.chunks_exact(degree + 1).enumerate() {
            let (mut value, mut error) = (T::default(), 0.0);
            for ((entry, control), bound) in row.iter().zip(controls).zip(bounds) {
                let converted = T::from_wide(*control);
                value = value + T::from_wide(*entry) * converted;
                let bound = bound + T::conversion_error(*control);
                error += entry.high() * (bound + unit * converted.magnitude());
            }
            self.values[result.start + j] = value;
            self.errors[result.start + j] = inflated(error);
        }
        result
    }

    /// Differentiate a polynomial in plain Bernstein form.
    pub(super) fn derivative(&mut self, polynomial: Polynomial) -> Polynomial {
        if polynomial.vanishes || polynomial.degree == 0 {
            return Polynomial::ZERO;
        }
        let result = self.push(polynomial.degree - 1);
        let factor = polynomial.degree as f64;
        let wide = T::from_wide(DoubleDouble::from(factor));
        let minus = T::from_wide(DoubleDouble::from(-1.0));
        for j in 0..polynomial.degree {
            let index = polynomial.start + j;
            let (low, high) = (self.values[index], self.values[index + 1]);
            let sizes = low.magnitude() + high.magnitude();
            let error = self.errors[index] + self.errors[index + 1] + 3.0 * T::UNIT * sizes;
            self.values[result.start + j] = (high + minus * low) * wide;
            self.errors[result.start + j] = inflated(factor * error);
        }
        result
    }

    /// Write a polynomial in scaled form: coefficients times binomial coefficients.
    pub(super) fn scale(&mut self, polynomial: Polynomial) -> Polynomial {
        self.rescale(polynomial, |value, binomial| value * binomial, |e, b| e * b)
    }

    /// Write a polynomial in plain Bernstein form again.
    pub(super) fn unscale(&mut self, polynomial: Polynomial) -> Polynomial {
        self.rescale(polynomial, |value, binomial| value / binomial, |e, b| e / b)
    }

    fn rescale(
        &mut self,
        polynomial: Polynomial,
        value: impl Fn(T, T) -> T,
        bound: impl Fn(f64, f64) -> f64,
    ) -> Polynomial {
        if polynomial.vanishes {
            return polynomial;
        }
        let degree = polynomial.degree;
        let result = self.push(degree);
        let unit = T::TABLE_ERROR + 2.0 * T::UNIT;
        let (values, new_values) = self.values.split_at_mut(result.start);
        let (errors, new_errors) = self.errors.split_at_mut(result.start);
        let old = values[polynomial.range()]
            .iter()
            .zip(&errors[polynomial.range()]);
        let new = new_values.iter_mut().zip(new_errors);
        for (((old, error), new), binomial) in old.zip(new).zip(binomials(degree)) {
            *new.0 = value(*old, T::from_wide(*binomial));
            *new.1 = inflated(bound(error + unit * old.magnitude(), binomial.high()));
        }
        result
    }

    /// Cut a polynomial on \[0, 1\], in plain Bernstein form, at `at` (a multiple of 2⁻⁵²), by de
    /// Casteljau's algorithm.
    pub(super) fn split(&mut self, polynomial: Polynomial, at: f64) -> (Polynomial, Polynomial) {
        let degree = polynomial.degree;
        let left = self.push(degree);
        let right = self.push(degree);
        let (mut before, mut behind) = (take(&mut self.before), take(&mut self.behind));
        let (values, errors) = self.coefficients(polynomial);
        behind.clear();
        behind.extend(values.iter().copied().zip(errors.iter().copied()));
        before.clone_from(&behind);
        cut(&mut behind, &mut before, mean(at));
        for (part, list) in [(left, &before), (right, &behind)] {
            for (index, (value, error)) in part.range().zip(list) {
                (self.values[index], self.errors[index]) = (*value, *error);
            }
        }
        (self.before, self.behind) = (before, behind);
        (left, right)
    }

    /// Bound the Bernstein coefficients of a polynomial in scaled form, and with them its size.
    pub(super) fn bound(&self, polynomial: Polynomial) -> f64 {
        let (values, errors) = self.coefficients(polynomial);
        let sizes = values.iter().zip(errors).zip(binomials(polynomial.degree));
        let sizes = sizes.map(|((value, error), binomial)| {
            (value.magnitude() + error) / binomial.high() * SLACK
        });
        sizes.fold(0.0, f64::max)
    }

    /// Evaluate a polynomial in scaled form at t in \[0, 1\]: the value, rounded to a double, and
    /// the bound of its error before that. The sign is certain where the value exceeds the
    /// bound by more than a rounding.
    ///
    /// Horner's scheme in t / (1 − t), or from the other end in its inverse.
    pub(super) fn evaluate(&self, polynomial: Polynomial, t: f64) -> (f64, f64) {
        let (values, errors) = self.coefficients(polynomial);
        let coefficients = values.iter().zip(errors);
        let degree = polynomial.degree;
        let forward = T::from_wide(DoubleDouble::from(t));
        let backward = T::from_wide(DoubleDouble::difference(1.0, t));
        let (value, error) = if t <= 0.5 {
            horner(coefficients.rev(), forward / backward)
        } else {
            horner(coefficients, backward / forward)
        };
        let power = t.max(1.0 - t).powi(degree as i32);
        (value * power, error * power)
    }
}

impl<T: Scalar> Ring for Arena<T> {
    type Polynomial = Polynomial;

    /// Add up products in scaled form; those with a factor [`Polynomial::ZERO`] are left out.
    fn sum_of_products(&mut self, terms: &[(i32, &Polynomial, &Polynomial)]) -> Polynomial {
        let present = || {
            terms
                .iter()
                .filter(|term| !(term.1.vanishes || term.2.vanishes))
        };
        let Some(first) = present().next() else {
            return Polynomial::ZERO;
        };
        let result = self.push(first.1.degree + first.2.degree);
        let count: usize = present()
            .map(|term| term.1.degree.min(term.2.degree) + 1)
            .sum();
        let unit = T::UNIT * (count as f64 + 4.0) * SLACK;
        let (values, sums) = self.values.split_at_mut(result.start);
        let (errors, bounds) = self.errors.split_at_mut(result.start);
        for &(factor, &a, &b) in present() {
            let (short, long) = if a.degree < b.degree { (a, b) } else { (b, a) };
            let short = (&values[short.range()], &errors[short.range()]);
            let long = (&values[long.range()], &errors[long.range()]);
            convolve(factor.into(), short, long, unit, (sums, bounds));
        }
        for bound in bounds {
            *bound = inflated(*bound);
        }
        result
    }
}

/// The error bound of a coefficient whose bound came out as `error`.
#[inline]
fn inflated(error: f64) -> f64 {
    error * SLACK + if error > 0.0 { FLOOR } else { 0.0 }
}

/// Add `factor` times the product of two polynomials in scaled form to sums and their bounds.
#[inline]
fn convolve<T: Scalar>(
    factor: f64,
    short: (&[T], &[f64]),
    long: (&[T], &[f64]),
    unit: f64,
    (sums, bounds): (&mut [T], &mut [f64]),
) {
    let wide = T::from_wide(DoubleDouble::from(factor));
    for (offset, (value, error)) in short.0.iter().zip(short.1).enumerate() {
        let times = wide * *value;
        for (sum, other) in sums[offset..].iter_mut().zip(long.0) {
            *sum = *sum + times * *other;
        }
        let size = factor.abs() * value.magnitude();
        let error = factor.abs() * error;
        let (own, foreign) = (error + unit * size, size + error);
        let others = long.0.iter().zip(long.1);
        for (bound, (other, other_error)) in bounds[offset..].iter_mut().zip(others) {
            *bound += own * other.magnitude() + foreign * other_error;
        }
    }
}

/// The mean (1 − t) a + t b of numbers with their bounds.
#[inline(always)]
fn mean<T: Scalar>(at: f64) -> impl Fn(&(T, f64), &(T, f64)) -> (T, f64) {
    let [low, high] = [1.0 - at, at].map(|part| T::from_wide(DoubleDouble::from(part)));
    let (low_bound, high_bound) = ((1.0 - at) * STEP_SLACK, at * STEP_SLACK);
    let unit = 3.0 * T::UNIT;
    move |a, b| {
        let error = low_bound * (a.1 + unit * a.0.magnitude())
            + high_bound * (b.1 + unit * b.0.magnitude());
        let value = low * a.0 + high * b.0;
        (value, error + if error > 0.0 { FLOOR } else { 0.0 })
    }
}

/// Evaluate Σ cᵢ sⁱ, highest coefficient first, for s ≥ 0 known to three roundings.
fn horner<'a, T: Scalar + 'a>(
    coefficients: impl ExactSizeIterator<Item = (&'a T, &'a f64)>,
    s: T,
) -> (f64, f64) {
    let unit = T::UNIT * (6.0 * coefficients.len() as f64 + 8.0);
    let step = s.magnitude();
    let (mut value, mut error) = (T::default(), 0.0);
    for (coefficient, bound) in coefficients {
        value = value * s + *coefficient;
        error = error * step + (bound + unit * coefficient.magnitude());
    }
    (value.rounded(), inflated(error))
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_bigint::BigInt;
    use num_rational::BigRational;

    type Exact = Vec<BigRational>;

    fn exact(value: DoubleDouble) -> BigRational {
        let part = |part| BigRational::from_float(part).unwrap_or_default();
        part(value.high()) + part(value.low())
    }

    fn whole(value: usize) -> BigRational {
        BigRational::from(BigInt::from(value))
    }

    /// Assert that the true coefficients lie within their bounds, and that those are not idle.
    fn assert_holds<T: Scalar + Into<DoubleDouble>>(
        arena: &Arena<T>,
        polynomial: Polynomial,
        expected: &Exact,
    ) {
        let (values, errors) = arena.coefficients(polynomial);
        assert_eq!(values.len(), expected.len());
        for ((value, error), expected) in values.iter().zip(errors).zip(expected) {
            let off = exact((*value).into()) - expected;
            let bound = exact((*error).into());
            assert!(off <= bound && -off <= bound);
            assert!(*error <= 1e4 * T::UNIT, "{error:e}");
        }
    }

    fn halves_of(coefficients: &Exact, at: f64) -> (Exact, Exact) {
        let at = exact(at.into());
        let (mut left, mut right) = (Exact::new(), coefficients.clone());
        for level in (0..coefficients.len()).rev() {
            left.push(right[0].clone());
            for i in 0..level {
                right[i] = &right[i] + (&right[i + 1] - &right[i]) * &at;
            }
        }
        (left, right)
    }

    /// Bernstein coefficients of a product: those of degree N over the binomial coefficients.
    fn product(a: &Exact, b: &Exact) -> Exact {
        let scaled = |list: &Exact| -> Exact {
            let row = binomials(list.len() - 1).iter();
            list.iter()
                .zip(row)
                .map(|(c, row)| c * exact(*row))
                .collect()
        };
        let (a, b) = (scaled(a), scaled(b));
        let mut sums = vec![BigRational::default(); a.len() + b.len() - 1];
        for (i, a) in a.iter().enumerate() {
            for (j, b) in b.iter().enumerate() {
                sums[i + j] += a * b;
            }
        }
        let row = binomials(sums.len() - 1).iter();
        sums.into_iter()
            .zip(row)
            .map(|(c, row)| c / exact(*row))
            .collect()
    }

    fn check<T: Scalar + Into<DoubleDouble>>() {
        let mut arena = Arena::<T>::default();
        let controls: Vec<f64> = (0..10).map(|i| (f64::from(i * i) * 0.37).sin()).collect();
        let wide: Vec<DoubleDouble> = controls.iter().map(|c| (*c).into()).collect();
        let plain = arena.convert(&wide, &[0.0; 10]);
        // The matrix is tested with its table; its rounding is within the same bounds.
        let matrix = bernstein_matrix(9);
        let rows = matrix.chunks(10).map(|row| {
            let terms = row.iter().zip(&controls);
            terms
                .map(|(entry, c)| exact(*entry) * exact((*c).into()))
                .sum()
        });
        let coefficients: Exact = rows.collect();
        assert_holds(&arena, plain, &coefficients);
        let slopes: Exact = coefficients
            .windows(2)
            .map(|pair| (&pair[1] - &pair[0]) * whole(9))
            .collect();
        let derivative = arena.derivative(plain);
        assert_holds(&arena, derivative, &slopes);
        let (a, b) = (arena.scale(plain), arena.scale(derivative));
        let sum = arena.sum_of_products(&[(3, &a, &b), (-1, &b, &a), (1, &a, &Polynomial::ZERO)]);
        let unscaled = arena.unscale(sum);
        let expected: Exact = product(&coefficients, &slopes)
            .into_iter()
            .map(|c| c * whole(2))
            .collect();
        assert_holds(&arena, unscaled, &expected);
        for at in [0.5, 125.0 / 256.0] {
            let (left, right) = arena.split(unscaled, at);
            let expected = halves_of(&expected, at);
            assert_holds(&arena, left, &expected.0);
            assert_holds(&arena, right, &expected.1);
        }
        for t in [0.1, 0.5, 0.77] {
            let (value, error) = arena.evaluate(sum, t);
            let expected = halves_of(&expected, t).1[0].clone();
            let off = exact(value.into()) - expected;
            // The value is rounded to a double, after some roundings of a power of 1 − t.
            let bound = exact((error + 16.0 * f64::EPSILON * value.abs()).into());
            assert!(off <= bound && -off <= bound, "at {t}");
        }
    }

    #[test]
    fn bounds_hold_and_are_tight_with_plain_doubles() {
        check::<f64>();
    }

    #[test]
    fn bounds_hold_and_are_tight_with_twice_the_digits() {
        check::<DoubleDouble>();
    }

    #[test]
    fn zeros_by_structure_stay_exact() {
        let mut arena = Arena::<f64>::default();
        let controls: Vec<DoubleDouble> = [0.0, 0.0, 0.0, 1.0].map(DoubleDouble::from).to_vec();
        let plain = arena.convert(&controls, &[0.0; 4]);
        let scaled = arena.scale(plain);
        let square = arena.sum_of_products(&[(1, &scaled, &scaled)]);
        let square = arena.unscale(square);
        let (values, errors) = arena.coefficients(square);
        assert_eq!((&values[..6], &errors[..6]), (&[0.0; 6][..], &[0.0; 6][..]));
        assert!(values[6] > errors[6]);
    }
}
