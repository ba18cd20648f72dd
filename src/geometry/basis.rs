//! The basis of a uniform B-spline: the same on every segment.

use std::ops::{Add, Sub};

use super::blend::Blend;
use super::error::MAX_DEGREE;

/// Evaluate the `order`-th derivatives by t of the n + 1 basis functions of one segment at the
/// local parameter t in \[0, 1\]; the functions themselves for order 0.
///
/// Function j weighs the segment's vertex j, has the support \[j − n, j + 1\] (as t counts), is
/// not negative, and all of them sum to 1. The derivatives are the `order`-th differences of the
/// basis of degree n − order; all zero above the degree.
pub fn uniform_basis_derivative<T>(degree: usize, order: usize, t: f64) -> Vec<T>
where
    T: Blend + Copy + Default + From<f64> + Add<Output = T> + Sub<Output = T>,
{
    let mut values = vec![T::default(); (degree + 1).saturating_sub(order)];
    let Some(first) = values.first_mut() else {
        return vec![T::default(); degree + 1];
    };
    *first = T::from(1.0);
    for level in 1..values.len() {
        uniform_basis_step(level, t, &mut values);
    }
    for _ in 0..order {
        values = undifferenced(&values, T::default());
    }
    values
}

/// Evaluate the bases of degrees n, n − 1, … at t, those below degree 0 being 0: the weights of the
/// differences of the vertices in the derivatives.
pub(super) fn derivative_bases<const COUNT: usize>(
    degree: usize,
    t: f64,
) -> [[f64; MAX_DEGREE + 1]; COUNT] {
    let mut bases = [[0.0; MAX_DEGREE + 1]; COUNT];
    let mut basis = [0.0; MAX_DEGREE + 1];
    basis[0] = 1.0;
    for level in 0..=degree {
        if level > 0 {
            uniform_basis_step(level, t, &mut basis);
        }
        if let Some(row) = bases.get_mut(degree - level) {
            *row = basis;
        }
    }
    bases
}

/// Raise the basis at t from degree `level` − 1 to degree `level`, in place. Values beyond the
/// basis must be 0.
#[inline(always)]
fn uniform_basis_step<T: Blend + Default>(level: usize, t: f64, values: &mut [T]) {
    raise_basis(level, values, |falling, here, rising, below| {
        let (falling, rising) = (falling as f64 - t, rising as f64 + t);
        T::blend(falling, here, rising, below, level as f64)
    });
}

/// Raise the basis from degree k − 1 to k = `level`, in place, by the recurrence of Cox and de Boor
/// on whole knots: k Nⱼ = (j + 1 − t) Nⱼ + (k − j + t) Nⱼ₋₁. `blend` computes
/// ((a − t) x + (b + t) y) / k, or a multiple of it, from a, x, b and y.
#[inline(always)]
pub(super) fn raise_basis<T: Default>(
    level: usize,
    values: &mut [T],
    blend: impl Fn(usize, &T, usize, &T) -> T,
) {
    for index in (1..=level).rev() {
        values[index] = blend(index + 1, &values[index], level - index, &values[index - 1]);
    }
    values[0] = blend(1, &values[0], level, &T::default());
}

/// The factors of numbers from the factors of their differences: Σ fᵢ (cᵢ₊₁ − cᵢ) = Σ gᵢ cᵢ.
pub(super) fn undifferenced<T>(factors: &[T], zero: T) -> Vec<T>
where
    T: Copy + Add<Output = T> + Sub<Output = T>,
{
    let mut result = vec![zero; factors.len() + 1];
    for (index, factor) in factors.iter().enumerate() {
        result[index] = result[index] - *factor;
        result[index + 1] = result[index + 1] + *factor;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_an_end_knot_the_basis_is_eulerian_numbers_over_factorials() {
        let cubic: Vec<f64> = uniform_basis_derivative(3, 0, 0.0);
        let expected = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0];
        for (value, expected) in cubic.iter().zip(expected) {
            assert!((value - expected).abs() <= f64::EPSILON);
        }
        // Degree 5: 1, 26, 66, 26, 1 over 120.
        let quintic: Vec<f64> = uniform_basis_derivative(5, 0, 0.0);
        for (value, eulerian) in quintic.iter().zip([1.0, 26.0, 66.0, 26.0, 1.0, 0.0]) {
            assert!((value * 120.0 - eulerian).abs() <= 1e-13);
        }
    }

    #[test]
    fn the_basis_is_a_partition_of_unity_for_every_degree() {
        for degree in 1..=25 {
            for t in [0.0, 0.1, 0.5, 0.77, 1.0] {
                let values: Vec<f64> = uniform_basis_derivative(degree, 0, t);
                assert!(values.iter().all(|value| *value >= 0.0));
                let sum: f64 = values.iter().sum();
                assert!((sum - 1.0).abs() <= 1e-14, "degree {degree}, t {t}: {sum}");
                let slopes: f64 = uniform_basis_derivative::<f64>(degree, 1, t).iter().sum();
                assert!(slopes.abs() <= 1e-14);
            }
        }
    }
}
