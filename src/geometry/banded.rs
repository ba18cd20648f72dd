//! Linear least squares with short rows: the smallest |J x − r|², by orthogonal transformations.

use super::basis::undifferenced;

/// Hold the factors of J = QR with short rows: the triangle R and, of the right side, Qᵀr.
///
/// RᵀR = JᵀJ, but the condition number of R is only the square root of that of JᵀJ: long waves of a
/// long polygon, which the differences of a functional hardly see, are still found in doubles.
#[derive(Clone, Debug)]
pub(super) struct BandedQr {
    /// For each row of R, the entries from the diagonal rightwards.
    rows: Vec<Vec<f64>>,
    /// Qᵀr.
    right: Vec<f64>,
}

/// A row of J from its first entry on, with its entry of r.
#[derive(Clone, Debug)]
pub(super) struct BandedRow {
    /// The column of the first entry.
    pub(super) first: usize,
    /// The entries of successive columns.
    pub(super) entries: Vec<f64>,
    /// The right side.
    pub(super) right: f64,
}

impl BandedQr {
    /// Factor the matrix of these rows, with so many columns. `None` if its columns are not
    /// independent, or an entry is not finite.
    pub(super) fn new(mut rows: Vec<BandedRow>, columns: usize) -> Option<Self> {
        // In this order a row never reaches further right than its neighbours do.
        rows.sort_by_key(|row| row.first);
        let mut factors = Self {
            rows: vec![Vec::new(); columns],
            right: vec![0.0; columns],
        };
        for row in rows {
            factors.insert(row);
        }
        let regular = |row: &Vec<f64>| {
            row.first().is_some_and(|diagonal| *diagonal != 0.0)
                && row.iter().all(|entry| entry.is_finite())
        };
        factors.rows.iter().all(regular).then_some(factors)
    }

    /// Rotate a row into the triangle, entry by entry (Givens).
    fn insert(&mut self, row: BandedRow) {
        let BandedRow {
            first,
            mut entries,
            mut right,
        } = row;
        let mut done = 0;
        while let Some(entry) = entries.get(done).copied() {
            let column = first + done;
            let Some(triangle) = self.rows.get_mut(column) else {
                return;
            };
            if entry == 0.0 {
                done += 1;
                continue;
            }
            if triangle.is_empty() {
                entries.drain(..done);
                *triangle = entries;
                self.right[column] = right;
                return;
            }
            let length = triangle.len().max(entries.len() - done);
            triangle.resize(length, 0.0);
            entries.resize(done + length, 0.0);
            let diagonal = triangle[0];
            let radius = (diagonal * diagonal + entry * entry).sqrt();
            let (cosine, sine) = (diagonal / radius, entry / radius);
            let rotate = |a: &mut f64, b: &mut f64| {
                (*a, *b) = (cosine * *a + sine * *b, cosine * *b - sine * *a);
            };
            for (a, b) in triangle.iter_mut().zip(&mut entries[done..]) {
                rotate(a, b);
            }
            rotate(&mut self.right[column], &mut right);
            done += 1;
        }
    }

    /// Find the x with the smallest |J x − r|.
    pub(super) fn solution(&self) -> Vec<f64> {
        self.back(self.right.clone())
    }

    /// Solve JᵀJ x = `right`.
    pub(super) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut x = right.to_vec();
        for (row, entries) in self.rows.iter().enumerate() {
            x[row] /= entries[0];
            for k in 1..entries.len() {
                x[row + k] -= entries[k] * x[row];
            }
        }
        self.back(x)
    }

    /// The rows of R, whose sum of squares at any x is that of J.
    pub(super) fn triangle(self) -> Vec<BandedRow> {
        let rows = self.rows.into_iter().enumerate();
        let rows = rows.map(|(first, entries)| BandedRow {
            first,
            entries,
            right: 0.0,
        });
        rows.collect()
    }

    /// Solve R x = `right`.
    fn back(&self, mut x: Vec<f64>) -> Vec<f64> {
        for (row, entries) in self.rows.iter().enumerate().rev() {
            let known: f64 = (1..entries.len()).map(|k| entries[k] * x[row + k]).sum();
            x[row] = (x[row] - known) / entries[0];
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

    /// Differences of some order, a small share of each unknown, and one row with its entries far
    /// apart.
    fn rows(order: usize, count: usize, fidelity: f64) -> Vec<BandedRow> {
        let shares = (0..count).map(|first| (first, vec![fidelity]));
        let stencil = difference_stencil(order);
        let differences = (0..count - order).map(|first| (first, stencil.clone()));
        let mut apart = vec![0.0; 8];
        (apart[0], apart[7]) = (1e-3, 2e-3);
        let all = shares.chain(differences).chain([(1, apart)]);
        all.map(|(first, entries)| BandedRow {
            first,
            entries,
            right: 0.0,
        })
        .collect()
    }

    fn times(row: &BandedRow, x: &[f64]) -> f64 {
        let entries = row.entries.iter().zip(&x[row.first..]);
        entries.map(|(entry, x)| entry * x).sum()
    }

    #[test]
    fn finds_what_the_matrix_made_from_the_rows_and_from_the_normal_equations() {
        for order in 1..=3 {
            let count = 12;
            let x: Vec<f64> = (0..count).map(|i| (i as f64 * 0.7).sin()).collect();
            let mut rows = rows(order, count, 1e-2);
            let mut normal = vec![0.0; count];
            for row in &mut rows {
                row.right = times(row, &x);
                for (k, entry) in row.entries.iter().enumerate() {
                    normal[row.first + k] += entry * row.right;
                }
            }
            let factors = BandedQr::new(rows, count).expect("independent columns");
            for found in [factors.solution(), factors.solve(&normal)] {
                for (a, b) in found.iter().zip(&x) {
                    assert!((a - b).abs() < 1e-11, "order {order}: {a} against {b}");
                }
            }
        }
    }

    #[test]
    fn the_triangle_has_the_sum_of_squares_of_all_rows() {
        let count = 12;
        let rows = rows(2, count, 0.1);
        let sum = |rows: &[BandedRow], x: &[f64]| -> f64 {
            rows.iter().map(|row| times(row, x).powi(2)).sum()
        };
        let factors = BandedQr::new(rows.clone(), count).expect("independent columns");
        let triangle = factors.triangle();
        assert_eq!(triangle.len(), count);
        for phase in 0..8 {
            let x = (0..count).map(|index| (index as f64 * 0.7 + f64::from(phase)).sin());
            let x: Vec<f64> = x.collect();
            let [all, few] = [&rows, &triangle].map(|rows| sum(rows, &x));
            assert!((all - few).abs() <= 1e-14 * all, "{all} {few}");
        }
    }

    #[test]
    fn the_smallest_residual_is_orthogonal_to_all_columns() {
        let count = 12;
        let mut rows = rows(2, count, 0.1);
        for (index, row) in rows.iter_mut().enumerate() {
            row.right = (index as f64 * 1.3).cos();
        }
        let factors = BandedQr::new(rows.clone(), count).expect("independent columns");
        let x = factors.solution();
        let mut products = vec![0.0; count];
        for row in &rows {
            let left = times(row, &x) - row.right;
            for (k, entry) in row.entries.iter().enumerate() {
                products[row.first + k] += entry * left;
            }
        }
        for product in products {
            assert!(product.abs() < 1e-14, "{product}");
        }
    }

    #[test]
    fn differences_of_high_order_lose_no_more_digits_than_their_condition() {
        // The normal equations of these have a condition number of about 1e24.
        let (count, order, fidelity) = (400, 4, 1e-11);
        let x: Vec<f64> = (0..count).map(|i| (i as f64 * 0.01).sin()).collect();
        let mut rows = rows(order, count, fidelity);
        for row in &mut rows {
            row.right = times(row, &x);
        }
        let factors = BandedQr::new(rows, count).expect("independent columns");
        for (a, b) in factors.solution().iter().zip(&x) {
            assert!((a - b).abs() < 1e-3, "{a} against {b}");
        }
    }

    #[test]
    fn refuses_columns_that_depend_on_each_other_and_what_is_not_finite() {
        let row = |entries: [f64; 2]| BandedRow {
            first: 0,
            entries: entries.to_vec(),
            right: 1.0,
        };
        assert!(BandedQr::new(vec![row([1.0, 2.0]), row([2.0, 4.0])], 2).is_none());
        assert!(BandedQr::new(vec![row([1.0, f64::NAN]), row([0.0, 1.0])], 2).is_none());
        assert!(BandedQr::new(vec![row([1.0, 2.0])], 2).is_none());
    }
}
