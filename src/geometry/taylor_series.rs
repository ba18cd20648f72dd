//! Truncated power series: arithmetic that carries exact derivatives along (Taylor arithmetic;
//! Griewank and Walther, "Evaluating Derivatives", chapter 13).

use std::array::from_fn;
use std::ops::{Add, Mul, Sub};

use super::coefficient::Coefficient;

/// Hold the first `LENGTH` coefficients of the power series of a function about a parameter u:
/// f(u + h) = Σ cₖ hᵏ, where cₖ is the k-th derivative at u over k!.
///
/// Sums and products are those of the truncated series, so all coefficients of a result are
/// exact up to rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TaylorSeries<const LENGTH: usize>(pub [f64; LENGTH]);

/// Sum up coefficient k of the product of two series: Σ aⱼ bₖ₋ⱼ, j = 0 … k.
#[inline(always)]
pub(super) fn product_coefficient<T: Coefficient>(a: &[T], b: &[T], k: usize) -> T {
    let mut sum = T::of(0.0);
    for j in 0..=k {
        sum = sum + a[j] * b[k - j];
    }
    sum
}

/// Sum up what coefficient k ≥ 1 of the power g = fᵃ follows from. With g′ f = a f′ g it is
/// gₖ = Σ (a j − (k − j)) fⱼ gₖ₋ⱼ / (k f₀), j = 1 … k; this is the sum, without the division.
#[inline(always)]
pub(super) fn power_sum<T: Coefficient>(exponent: f64, f: &[T], g: &[T], k: usize) -> T {
    let mut sum = T::of(0.0);
    for j in 1..=k {
        let factor = exponent * j as f64 - (k - j) as f64;
        sum = sum + T::of(factor) * f[j] * g[k - j];
    }
    sum
}

impl<const LENGTH: usize> TaylorSeries<LENGTH> {
    /// The series of the constant 0.
    pub const ZERO: Self = Self([0.0; LENGTH]);

    /// The value of the function at the parameter itself.
    pub fn value(&self) -> f64 {
        const { assert!(LENGTH > 0) };
        self.0[0]
    }

    /// Drop the last coefficients.
    #[inline(always)]
    pub fn truncated<const SHORTER: usize>(&self) -> TaylorSeries<SHORTER> {
        const { assert!(SHORTER <= LENGTH) };
        TaylorSeries(from_fn(|k| self.0[k]))
    }

    /// Differentiate, which leaves at least one coefficient less.
    #[inline(always)]
    pub fn derivative<const SHORTER: usize>(&self) -> TaylorSeries<SHORTER> {
        const { assert!(SHORTER < LENGTH) };
        TaylorSeries(from_fn(|k| (k + 1) as f64 * self.0[k + 1]))
    }

    /// Raise to the power `halves`/2.
    ///
    /// The coefficients follow from each other: see [`power_sum`]. Where f₀ = 0 the root is not smooth: all coefficients but the first are then infinite or not
    /// numbers. Where f₀ < 0 none is a number.
    #[inline(always)]
    pub fn half_power(&self, halves: i32) -> Self {
        let exponent = 0.5 * f64::from(halves);
        let mut power = Self::ZERO;
        power.0[0] = self.value().sqrt().powi(halves);
        let inverse = 1.0 / self.value();
        for k in 1..LENGTH {
            power.0[k] = power_sum(exponent, &self.0, &power.0, k) * inverse / k as f64;
        }
        power
    }
}

impl<const LENGTH: usize> Add for TaylorSeries<LENGTH> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl<const LENGTH: usize> Sub for TaylorSeries<LENGTH> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl<const LENGTH: usize> Mul for TaylorSeries<LENGTH> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(from_fn(|k| product_coefficient(&self.0, &other.0, k)))
    }
}

impl<const LENGTH: usize> Mul<f64> for TaylorSeries<LENGTH> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|coefficient| coefficient * factor))
    }
}

#[cfg(test)]
mod tests {
    use num_bigint::BigInt;
    use num_rational::BigRational;
    use num_traits::{ToPrimitive, Zero};

    use super::*;

    const LENGTH: usize = 10;

    /// A few roundings for each coefficient summed.
    const ROUNDINGS: f64 = 16.0 * f64::EPSILON;

    type Exact = Vec<BigRational>;

    fn ratio(numerator: i64, denominator: i64) -> BigRational {
        BigRational::new(BigInt::from(numerator), BigInt::from(denominator))
    }

    /// Coefficients that are exact in binary and decrease as those of a curve do.
    fn exact(seed: i64) -> Exact {
        let coefficient = |k: i64| ratio((seed * (3 * k + 2) * (k + 7)) % 23 - 11, 8 << k);
        let mut series: Exact = (0..LENGTH as i64).map(coefficient).collect();
        series[0] = ratio(seed % 5 + 2, 1);
        series
    }

    fn rounded(exact: &Exact) -> TaylorSeries<LENGTH> {
        TaylorSeries(from_fn(|k| exact[k].to_f64().expect("in range")))
    }

    fn product(a: &Exact, b: &Exact) -> Exact {
        let coefficient = |k: usize| {
            (0..=k).fold(BigRational::zero(), |sum, j| {
                sum + a[j].clone() * b[k - j].clone()
            })
        };
        (0..LENGTH).map(coefficient).collect()
    }

    fn inverse(a: &Exact) -> Exact {
        let mut inverse = vec![a[0].recip()];
        for k in 1..LENGTH {
            let sum = (1..=k).fold(BigRational::zero(), |sum, j| {
                sum + a[j].clone() * inverse[k - j].clone()
            });
            inverse.push(-sum / a[0].clone());
        }
        inverse
    }

    #[track_caller]
    fn assert_series_near(found: TaylorSeries<LENGTH>, expected: &Exact) {
        let expected = rounded(expected);
        let scale = expected
            .0
            .iter()
            .fold(0.0_f64, |scale, c| scale.max(c.abs()));
        for (found, expected) in found.0.iter().zip(expected.0) {
            let error = (found - expected).abs();
            assert!(error <= ROUNDINGS * scale, "{found} instead of {expected}");
        }
    }

    #[test]
    fn products_are_those_of_exact_rational_arithmetic() {
        for seed in 1..12 {
            let (a, b) = (exact(seed), exact(seed + 5));
            assert_series_near(rounded(&a) * rounded(&b), &product(&a, &b));
        }
    }

    #[test]
    fn half_powers_of_exact_squares_are_exact_powers() {
        for seed in 1..12 {
            let root = exact(seed);
            let square = rounded(&product(&root, &root));
            let reciprocal = inverse(&root);
            let cube = product(&reciprocal, &product(&reciprocal, &reciprocal));
            assert_series_near(square.half_power(1), &root);
            assert_series_near(square.half_power(-1), &reciprocal);
            assert_series_near(square.half_power(-3), &cube);
        }
    }

    #[test]
    fn the_derivative_of_the_exponential_is_itself() {
        let mut exponential = TaylorSeries::<LENGTH>::ZERO;
        let mut factorial = 1.0;
        for (k, coefficient) in exponential.0.iter_mut().enumerate() {
            factorial *= k.max(1) as f64;
            *coefficient = 1.0 / factorial;
        }
        let derivative = exponential.derivative::<9>();
        for (found, expected) in derivative.0.iter().zip(exponential.truncated::<9>().0) {
            assert!((found - expected).abs() <= ROUNDINGS * expected);
        }
    }

    #[test]
    fn a_root_at_zero_has_a_value_and_no_derivatives() {
        let root = TaylorSeries([0.0, 1.0, 0.0]).half_power(1);
        assert_eq!(root.value(), 0.0);
        assert!(
            root.0[1..]
                .iter()
                .all(|coefficient| !coefficient.is_finite())
        );
    }
}
