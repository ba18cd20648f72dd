//! A small, symmetric, positive semidefinite system: the Gram matrix of a few conditions.

/// Hold the Cholesky factor of a symmetric positive semidefinite matrix, with the rows in the
/// order of falling pivots, and as many of them as are independent.
pub(super) struct PivotedCholesky {
    /// The lower triangle, row by row; its rows are those of `order`.
    rows: Vec<Vec<f64>>,
    /// The number of the matrix's row that stands at each place.
    order: Vec<usize>,
    rank: usize,
}

impl PivotedCholesky {
    /// Factor the matrix of `size` rows with the entries `entry(row, column)`. Rows whose
    /// remainder is below `tolerance` of the largest pivot count as depending on those before.
    ///
    /// `None` if an entry is not finite.
    pub(super) fn new(
        size: usize,
        entry: impl Fn(usize, usize) -> f64,
        tolerance: f64,
    ) -> Option<Self> {
        let mut order: Vec<usize> = (0..size).collect();
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(size);
        for row in 0..size {
            rows.push((0..=row).map(|column| entry(row, column)).collect());
        }
        if !rows.iter().flatten().all(|value| value.is_finite()) {
            return None;
        }
        let at = |rows: &[Vec<f64>], a: usize, b: usize| rows[a.max(b)][a.min(b)];
        // Outer products, with the remainder kept in the places of `rows` in their old order.
        let mut columns: Vec<Vec<f64>> = Vec::with_capacity(size);
        let mut largest = 0.0_f64;
        for step in 0..size {
            let diagonal = |place: usize| at(&rows, order[place], order[place]);
            let best = (step..size).max_by(|&a, &b| diagonal(a).total_cmp(&diagonal(b)))?;
            let pivot = diagonal(best);
            largest = largest.max(pivot);
            if pivot <= tolerance * largest {
                break;
            }
            order.swap(step, best);
            let root = pivot.sqrt();
            let column: Vec<f64> = (0..size)
                .map(|row| at(&rows, row, order[step]) / root)
                .collect();
            for (row, values) in rows.iter_mut().enumerate() {
                for (other, value) in values.iter_mut().enumerate() {
                    *value -= column[row] * column[other];
                }
            }
            columns.push(column);
        }
        let rank = columns.len();
        let factor = order.iter().take(rank).enumerate().map(|(place, row)| {
            let left = columns.iter().take(place + 1);
            left.map(|column| column[*row]).collect()
        });
        Some(Self {
            rows: factor.collect(),
            order,
            rank,
        })
    }

    /// The number of independent rows.
    pub(super) fn rank(&self) -> usize {
        self.rank
    }

    /// Solve the system for the independent rows; the unknowns of the others are 0.
    pub(super) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut places: Vec<f64> = self.order.iter().map(|row| right[*row]).collect();
        for place in 0..self.rank {
            let row = &self.rows[place];
            let known: f64 = row[..place].iter().zip(&places).map(|(a, b)| a * b).sum();
            places[place] = (places[place] - known) / row[place];
        }
        for place in (0..self.rank).rev() {
            places[place] /= self.rows[place][place];
            for before in 0..place {
                places[before] -= self.rows[place][before] * places[place];
            }
        }
        let mut solution = vec![0.0; right.len()];
        for (place, row) in self.order.iter().enumerate().take(self.rank) {
            solution[*row] = places[place];
        }
        solution
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_regular_systems_and_consistent_singular_ones() {
        let regular = [[4.0, 2.0, 1.0], [2.0, 9.0, 3.0], [1.0, 3.0, 16.0]];
        // The third row is the sum of the first two.
        let singular = [[2.0, 1.0, 3.0], [1.0, 5.0, 6.0], [3.0, 6.0, 9.0]];
        for (matrix, rank) in [(regular, 3), (singular, 2)] {
            let times = |x: &[f64]| -> Vec<f64> {
                let rows = matrix.iter();
                rows.map(|row| row.iter().zip(x).map(|(a, b)| a * b).sum())
                    .collect()
            };
            let factor = PivotedCholesky::new(3, |row, column| matrix[row][column], 1e-13);
            let factor = factor.expect("finite entries");
            assert_eq!(factor.rank, rank);
            let right = times(&[1.0, -2.0, 3.0]);
            for (found, expected) in times(&factor.solve(&right)).iter().zip(&right) {
                assert!((found - expected).abs() <= 1e-13, "{found} {expected}");
            }
        }
        assert!(PivotedCholesky::new(1, |_, _| f64::NAN, 1e-13).is_none());
    }
}
