//! A symmetric, positive definite system whose rows are short.

use super::basis::undifferenced;

/// Hold the Cholesky factor of a symmetric positive definite matrix in skyline form.
#[derive(Clone, Debug)]
pub(super) struct BandedCholesky {
    /// For each row, the entries from the diagonal leftwards.
    rows: Vec<Vec<f64>>,
}

impl BandedCholesky {
    /// Factor the matrix with these entries of every row, from the diagonal leftwards. `None` if it
    /// is not positive definite, or an entry is not finite.
    pub(super) fn new(mut rows: Vec<Vec<f64>>) -> Option<Self> {
        for row in 0..rows.len() {
            let (done, rest) = rows.split_at_mut(row);
            let current = &mut rest[0];
            for offset in (1..current.len()).rev() {
                let column = &done[row - offset];
                let shared = column.len().min(current.len() - offset);
                let known: f64 = current[offset + 1..offset + shared.max(1)]
                    .iter()
                    .zip(&column[1..shared.max(1)])
                    .map(|(a, b)| a * b)
                    .sum();
                current[offset] = (current[offset] - known) / column[0];
            }
            let squares: f64 = current[1..].iter().map(|value| value * value).sum();
            current[0] = (current[0] - squares).sqrt();
            if !(current[0] > 0.0 && current[0].is_finite()) {
                return None;
            }
        }
        Some(Self { rows })
    }

    /// Solve H x = `right`.
    pub(super) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut x = right.to_vec();
        for (row, entries) in self.rows.iter().enumerate() {
            let known: f64 = (1..entries.len()).map(|k| entries[k] * x[row - k]).sum();
            x[row] = (x[row] - known) / entries[0];
        }
        for (row, entries) in self.rows.iter().enumerate().rev() {
            x[row] /= entries[0];
            for k in 1..entries.len() {
                x[row - k] -= entries[k] * x[row];
            }
        }
        x
    }
}

/// The coefficients of the k-th difference: (−1, 1), (1, −2, 1), …
pub(super) fn difference_stencil(order: usize) -> Vec<f64> {
    (0..order).fold(vec![1.0], |stencil, _| undifferenced(&stencil, 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_the_matrix_made_also_with_rows_of_different_lengths() {
        for order in 1..=3 {
            let (count, fidelity) = (12, 1e-3);
            let x: Vec<f64> = (0..count).map(|i| (i as f64 * 0.7).sin()).collect();
            let stencil = difference_stencil(order);
            let mut rows: Vec<Vec<f64>> = vec![vec![fidelity]; count];
            let mut right: Vec<f64> = x.iter().map(|value| fidelity * value).collect();
            for first in 0..count - order {
                let difference: f64 = (0..=order).map(|i| stencil[i] * x[first + i]).sum();
                for i in 0..=order {
                    right[first + i] += stencil[i] * difference;
                    let row = &mut rows[first + i];
                    row.resize(row.len().max(i + 1), 0.0);
                    for j in 0..=i {
                        row[i - j] += stencil[i] * stencil[j];
                    }
                }
            }
            // One entry far from the diagonal.
            rows[8].resize(8, 0.0);
            rows[8][7] = 1e-3;
            right[8] += 1e-3 * x[1];
            right[1] += 1e-3 * x[8];
            let factor = BandedCholesky::new(rows).expect("a positive definite matrix");
            for (a, b) in factor.solve(&right).iter().zip(&x) {
                assert!((a - b).abs() < 1e-8, "order {order}: {a} against {b}");
            }
        }
        assert!(BandedCholesky::new(vec![vec![1.0], vec![1.0, 1.0]]).is_none());
    }
}
