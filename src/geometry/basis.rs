//! The basis of a uniform B-spline: the same on every segment.

use std::ops::{Add, Sub};

/// Evaluate the n + 1 basis functions of one segment at the local parameter t in \[0, 1\].
///
/// Function j weighs the segment's vertex j, has the support \[j − n, j + 1\] (as t counts), is
/// not negative, and all of them sum to 1 (the Cox–de Boor recurrence on integer knots).
pub fn uniform_basis(degree: usize, t: f64) -> Vec<f64> {
    let mut values = vec![0.0; degree + 1];
    values[0] = 1.0;
    for level in 1..=degree {
        uniform_basis_step(level, t, &mut values);
    }
    values
}

/// Take the basis of degree `level` − 1 to that of degree `level`, in place: one level of the
/// recurrence. Values beyond the basis must be 0.
pub(super) fn uniform_basis_step(level: usize, t: f64, values: &mut [f64]) {
    let divisor = level as f64;
    for index in (1..=level).rev() {
        let falling = (index + 1) as f64 - t;
        let rising = (level - index) as f64 + t;
        values[index] = (values[index] * falling + values[index - 1] * rising) / divisor;
    }
    values[0] *= (1.0 - t) / divisor;
}

/// Evaluate the `order`-th derivatives by t of the n + 1 basis functions of one segment.
///
/// They are the `order`-th differences of the basis of degree n − order; all zero above the
/// degree.
pub fn uniform_basis_derivative(degree: usize, order: usize, t: f64) -> Vec<f64> {
    if order > degree {
        return vec![0.0; degree + 1];
    }
    let mut values = uniform_basis(degree - order, t);
    for _ in 0..order {
        values = undifferenced(&values, 0.0);
    }
    values
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
        let cubic = uniform_basis(3, 0.0);
        let expected = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0];
        for (value, expected) in cubic.iter().zip(expected) {
            assert!((value - expected).abs() <= f64::EPSILON);
        }
        // Degree 5: 1, 26, 66, 26, 1 over 120.
        let quintic = uniform_basis(5, 0.0);
        for (value, eulerian) in quintic.iter().zip([1.0, 26.0, 66.0, 26.0, 1.0, 0.0]) {
            assert!((value * 120.0 - eulerian).abs() <= 1e-13);
        }
    }

    #[test]
    fn the_basis_is_a_partition_of_unity_for_every_degree() {
        for degree in 1..=25 {
            for t in [0.0, 0.1, 0.5, 0.77, 1.0] {
                let values = uniform_basis(degree, t);
                assert!(values.iter().all(|value| *value >= 0.0));
                let sum: f64 = values.iter().sum();
                assert!((sum - 1.0).abs() <= 1e-14, "degree {degree}, t {t}: {sum}");
                let slopes: f64 = uniform_basis_derivative(degree, 1, t).iter().sum();
                assert!(slopes.abs() <= 1e-14);
            }
        }
    }
}
