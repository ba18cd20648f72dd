//! The matrices between the vertices of one segment's float and Bézier polygon.

use super::knots::clamp;
use crate::geometry::expansion::Expansion;

/// Fill the (n + 1)² matrix, row by row, that takes the float vertices of a segment to its
/// Bézier vertices (SB). Its entries are not negative and each row sums to 1.
pub(in crate::geometry) fn float_to_bezier<const K: usize>(degree: usize) -> Vec<Expansion<K>> {
    let size = degree + 1;
    let mut matrix = vec![Expansion::default(); size * size];
    for column in 0..size {
        let mut unit = vec![Expansion::default(); size];
        unit[column] = Expansion::from(1.0);
        clamp(degree, &mut unit);
        for (row, entry) in unit.into_iter().enumerate() {
            matrix[row * size + column] = entry;
        }
    }
    matrix
}

/// Compute the row that takes the Bézier vertices of a segment to the blossom of its polynomial
/// at integers, counted from the segment's start (BS): the coefficients of the powers of x in
/// ∏ ((1 − k) + k x), which are integers. At the knots of a float vertex their magnitudes sum up
/// to (2n − 1)!! at most, which is 5.8e30 for degree 25.
pub(in crate::geometry) fn blossom_row(arguments: impl Iterator<Item = i64>) -> Vec<i128> {
    let mut row = vec![1];
    for argument in arguments.map(i128::from) {
        row.push(0);
        for index in (0..row.len()).rev() {
            let before = if index == 0 { 0 } else { row[index - 1] };
            row[index] = (1 - argument) * row[index] + argument * before;
        }
    }
    row
}

/// Find the segment whose knots lie in the middle of those of a vertex of an open polygon, as far
/// as there is one: from there an error in the Bézier vertices grows least.
pub(in crate::geometry) fn middle_segment(degree: usize, segments: usize, index: usize) -> usize {
    index.saturating_sub(degree / 2).min(segments - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rows_of_degree_9_are_the_known_integers() {
        let row = blossom_row(-8..=0);
        assert_eq!(row[..2], [362_880, -1_026_576 - 1_212_768]);
        assert_eq!(row.iter().sum::<i128>(), 1);
        let norm: i128 = row.iter().map(|entry| entry.abs()).sum();
        assert_eq!(norm, 34_459_425);
    }

    #[test]
    fn the_matrices_are_inverse_to_each_other_for_every_degree() {
        for degree in 1..=25_usize {
            let there = float_to_bezier::<3>(degree);
            for vertex in 0..=degree {
                let first = vertex as i64 + 1 - degree as i64;
                let back = blossom_row(first..first + degree as i64);
                for column in 0..=degree {
                    let sum =
                        back.iter()
                            .enumerate()
                            .fold(Expansion::default(), |sum, (k, entry)| {
                                sum + Expansion::from(*entry) * there[k * (degree + 1) + column]
                            });
                    let expected = f64::from(u8::from(vertex == column));
                    // 5.8e30 · 2⁻¹⁵⁹ is 8e-18.
                    assert!((sum.value() - expected).abs() <= 1e-16, "degree {degree}");
                }
            }
        }
    }
}
