//! Binomial coefficients and the conversion to Bernstein form, computed once a degree.

use std::sync::OnceLock;

use crate::geometry::error::MAX_DEGREE;
use crate::geometry::expansion::DoubleDouble;

/// The highest degree of a product: the torsion or curvature numerator of a rational space
/// curve has at most 11 n.
const MAX_PRODUCT: usize = 11 * MAX_DEGREE;

/// Operations behind one entry of [`binomials`], at most, by the degree.
pub(super) fn binomial_operations(degree: usize) -> f64 {
    (degree + 1) as f64
}

/// Operations behind one entry of [`bernstein_matrix`], at most, by the degree.
pub(super) fn matrix_operations(degree: usize) -> f64 {
    (4 * degree + 1) as f64
}

/// List the binomial coefficients of a degree: numbers beyond 106 bits are rounded.
pub(super) fn binomials(degree: usize) -> &'static [DoubleDouble] {
    static ROWS: [OnceLock<Vec<DoubleDouble>>; MAX_PRODUCT + 1] =
        [const { OnceLock::new() }; MAX_PRODUCT + 1];
    ROWS.get(degree)
        .map_or(&[], |row| row.get_or_init(|| binomial_row(degree)))
}

fn binomial_row(degree: usize) -> Vec<DoubleDouble> {
    let mut value = DoubleDouble::from(1.0);
    let mut row = vec![value; degree + 1];
    for k in 1..=degree / 2 {
        let [rising, falling] = [degree + 1 - k, k].map(|count| DoubleDouble::from(count as f64));
        value = value * rising / falling;
        row[k] = value;
        row[degree - k] = value;
    }
    row
}

/// List, row by row, the (m + 1)² matrix that takes the control values of one segment of a
/// uniform B-spline of degree m to its Bernstein coefficients on \[0, 1\].
///
/// Coefficient j is the blossom at m − j zeros and j ones. All entries are positive or 0 and
/// arise without cancellation, each row sums to 1 (Farin, "Curves and Surfaces for CAGD").
pub(super) fn bernstein_matrix(degree: usize) -> &'static [DoubleDouble] {
    static MATRICES: [OnceLock<Vec<DoubleDouble>>; MAX_DEGREE + 1] =
        [const { OnceLock::new() }; MAX_DEGREE + 1];
    MATRICES
        .get(degree)
        .map_or(&[], |matrix| matrix.get_or_init(|| blossoms(degree)))
}

fn blossoms(degree: usize) -> Vec<DoubleDouble> {
    let size = degree + 1;
    let mut matrix = vec![DoubleDouble::default(); size * size];
    for ones in 0..size {
        for control in 0..size {
            matrix[ones * size + control] = blossom(degree, ones, control);
        }
    }
    matrix
}

/// De Boor's algorithm at m − `ones` zeros and `ones` ones, for control values that are 0 but
/// for a 1 at `control`.
fn blossom(degree: usize, ones: usize, control: usize) -> DoubleDouble {
    let mut values = vec![DoubleDouble::default(); degree + 1];
    values[control] = DoubleDouble::from(1.0);
    for level in 1..=degree {
        let argument = if level <= ones { 1 } else { 0 };
        let width = DoubleDouble::from((degree + 1 - level) as f64);
        for index in 0..=degree - level {
            // The knots that this step takes out are index − m + level and index + 1.
            let falling = DoubleDouble::from((index + 1 - argument) as f64);
            let rising = DoubleDouble::from((argument + degree - level - index) as f64);
            values[index] = (values[index] * falling + values[index + 1] * rising) / width;
        }
    }
    values[0]
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
