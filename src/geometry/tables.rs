//! Binomial coefficients and the conversion to Bernstein form, computed once a degree.

use std::sync::OnceLock;

use super::bezier_matrix::float_to_bezier;
use super::error::MAX_DEGREE;
use super::expansion::{DoubleDouble, Expansion};

/// The highest degree of a product: the torsion or curvature numerator of a rational space
/// curve has at most 11 n.
const MAX_PRODUCT: usize = 11 * MAX_DEGREE;

/// List the binomial coefficients of a degree: numbers beyond 106 bits are rounded once.
pub(super) fn binomials(degree: usize) -> &'static [DoubleDouble] {
    static ROWS: [OnceLock<Vec<DoubleDouble>>; MAX_PRODUCT + 1] =
        [const { OnceLock::new() }; MAX_PRODUCT + 1];
    ROWS.get(degree)
        .map_or(&[], |row| row.get_or_init(|| binomial_row(degree)))
}

fn binomial_row(degree: usize) -> Vec<DoubleDouble> {
    let mut value = Expansion::<3>::from(1.0);
    let mut row = vec![value.resized(); degree + 1];
    for k in 1..=degree / 2 {
        value = value * (degree + 1 - k) as f64 / k as f64;
        row[k] = value.resized();
        row[degree - k] = row[k];
    }
    row
}

/// List, row by row, the (m + 1)² matrix that takes the control values of one segment of a
/// uniform B-spline of degree m to its Bernstein coefficients on \[0, 1\].
pub(super) fn bernstein_matrix(degree: usize) -> &'static [DoubleDouble] {
    static MATRICES: [OnceLock<Vec<DoubleDouble>>; MAX_DEGREE + 1] =
        [const { OnceLock::new() }; MAX_DEGREE + 1];
    MATRICES
        .get(degree)
        .map_or(&[], |matrix| matrix.get_or_init(|| float_to_bezier(degree)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_tables_are_the_known_ones() {
        let row: Vec<f64> = binomials(6).iter().map(|value| value.high()).collect();
        assert_eq!(row, [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0]);
        let cubic: Vec<f64> = bernstein_matrix(3)
            .iter()
            .map(|value| value.high() * 6.0)
            .collect();
        let expected = [
            [1.0, 4.0, 1.0, 0.0],
            [0.0, 4.0, 2.0, 0.0],
            [0.0, 2.0, 4.0, 0.0],
            [0.0, 1.0, 4.0, 1.0],
        ];
        for (found, expected) in cubic.iter().zip(expected.as_flattened()) {
            assert!((found - expected).abs() <= 4.0 * f64::EPSILON);
        }
    }

    #[test]
    fn rows_sum_to_what_they_must() {
        for degree in 0..=MAX_DEGREE {
            for row in bernstein_matrix(degree).chunks(degree + 1) {
                let sum = row
                    .iter()
                    .fold(DoubleDouble::default(), |sum, entry| sum + *entry);
                let error = sum - DoubleDouble::from(1.0);
                assert!(error.high().abs() <= 1e-29, "degree {degree}: {error:?}");
                assert!(row.iter().all(|entry| entry.high() >= 0.0));
            }
        }
        let sum = binomials(MAX_PRODUCT)
            .iter()
            .fold(DoubleDouble::default(), |sum, entry| sum + *entry);
        let relative = sum.scaled(2.0_f64.powi(-(MAX_PRODUCT as i32))) - DoubleDouble::from(1.0);
        assert!(relative.high().abs() <= 1e-28);
    }
}
