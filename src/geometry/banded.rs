//! A banded, symmetric, positive definite system: the differences of vertex moves.

use super::basis::undifferenced;

/// Hold the Cholesky factor of H = DᵀD + μI, where D takes the k-th differences of a sequence.
pub(super) struct BandedCholesky {
    /// For each row, the entries from the diagonal leftwards.
    rows: Vec<Vec<f64>>,
}

impl BandedCholesky {
    /// Factor H for sequences of `count` numbers, differences of the given order, and μ > 0.
    pub(super) fn of_differences(count: usize, order: usize, fidelity: f64) -> Self {
        let stencil = difference_stencil(order);
        let mut rows: Vec<Vec<f64>> = (0..count)
            .map(|row| vec![0.0; order.min(row) + 1])
            .collect();
        for first in 0..count.saturating_sub(order) {
            for (i, a) in stencil.iter().enumerate() {
                for (j, b) in stencil.iter().enumerate().take(i + 1) {
                    rows[first + i][i - j] += a * b;
                }
            }
        }
        for row in &mut rows {
            row[0] += fidelity;
        }
        Self::factor(rows)
    }

    fn factor(mut rows: Vec<Vec<f64>>) -> Self {
        for row in 0..rows.len() {
            let (done, rest) = rows.split_at_mut(row);
            let current = &mut rest[0];
            for offset in (1..current.len()).rev() {
                let column = &done[row - offset];
                let mut value = current[offset];
                for k in 1..current.len() - offset {
                    value -= current[offset + k] * column.get(k).copied().unwrap_or(0.0);
                }
                current[offset] = value / column[0];
            }
            let squares: f64 = current[1..].iter().map(|value| value * value).sum();
            current[0] = (current[0] - squares).sqrt();
        }
        Self { rows }
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
fn difference_stencil(order: usize) -> Vec<f64> {
    (0..order).fold(vec![1.0], |stencil, _| undifferenced(&stencil, 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_the_matrix_made() {
        for order in 1..=3 {
            let (count, fidelity) = (12, 1e-3);
            let x: Vec<f64> = (0..count).map(|i| (i as f64 * 0.7).sin()).collect();
            let stencil = difference_stencil(order);
            let mut right: Vec<f64> = x.iter().map(|value| fidelity * value).collect();
            for first in 0..count - order {
                let difference: f64 = (0..=order).map(|i| stencil[i] * x[first + i]).sum();
                for i in 0..=order {
                    right[first + i] += stencil[i] * difference;
                }
            }
            let solved = BandedCholesky::of_differences(count, order, fidelity).solve(&right);
            for (a, b) in solved.iter().zip(&x) {
                assert!((a - b).abs() < 1e-9, "order {order}: {a} against {b}");
            }
        }
    }
}
