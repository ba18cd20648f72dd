//! The matrices between the vertices of one segment's float and Bézier polygon, and products with
//! them.

use super::basis::raise_basis;
use super::expansion::Expansion;

/// Fill the (n + 1)² matrix, row by row, that takes the float vertices of a segment to its
/// Bézier vertices (SB). Its entries are not negative and each row sums to 1; each is the exact
/// one but for one rounding.
pub(super) fn float_to_bezier<const K: usize>(degree: usize) -> Vec<Expansion<K>> {
    let factorial: i128 = (1..=degree as i128).product();
    let columns = whole_basis(degree);
    let mut matrix = Vec::with_capacity(columns.len() * columns.len());
    let mut binomial = 1;
    for row in 0..=degree {
        let divisor = Expansion::<3>::from(factorial * binomial);
        let entry = |column: &Vec<i128>| (Expansion::from(column[row]) / divisor).resized();
        matrix.extend(columns.iter().map(entry));
        binomial = binomial * (degree - row) as i128 / (row + 1) as i128;
    }
    matrix
}

/// List, for each of the n + 1 basis functions of a segment, the whole numbers sᵢ with
/// n! N(t) = Σ sᵢ tⁱ (1 − t)ⁿ⁻ⁱ. They have 107 binary digits at most.
pub(super) fn whole_basis(degree: usize) -> Vec<Vec<i128>> {
    let mut basis = vec![Vec::new(); degree + 1];
    basis[0] = vec![1];
    for level in 1..=degree {
        raise_basis(level, &mut basis, |falling, here, rising, below| {
            let mut sum = vec![0; level + 1];
            let (falling, rising) = (falling as i128, rising as i128);
            for (polynomial, line) in [
                (here, [falling, falling - 1]),
                (below, [rising, rising + 1]),
            ] {
                for (power, coefficient) in polynomial.iter().enumerate() {
                    sum[power] += line[0] * coefficient;
                    sum[power + 1] += line[1] * coefficient;
                }
            }
            sum
        });
    }
    basis
}

/// Compute the row that takes the Bézier vertices of a segment to the blossom of its polynomial
/// at integers, counted from the segment's start (BS): the coefficients of the powers of x in
/// ∏ ((1 − k) + k x), which are integers. At the knots of a float vertex their magnitudes sum up
/// to (2n − 1)!! at most, which is 5.8e30 for degree 25.
pub(super) fn blossom_row(arguments: impl Iterator<Item = i64>) -> Vec<i128> {
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
pub(super) fn middle_segment(degree: usize, segments: usize, index: usize) -> usize {
    index.saturating_sub(degree / 2).min(segments - 1)
}

/// Sum up the products of a row and as many numbers.
pub(super) fn dot<const K: usize>(row: &[Expansion<K>], numbers: &[Expansion<K>]) -> Expansion<K> {
    let products = row.iter().zip(numbers);
    products.fold(Expansion::default(), |sum, (a, b)| sum.plus_product(*a, *b))
}

/// Convert one coordinate of a float polygon to that of the chain of Bézier polygons.
pub(super) fn chain<const K: usize>(
    degree: usize,
    matrix: &[Expansion<K>],
    axis: &[Expansion<K>],
) -> Vec<Expansion<K>> {
    let size = degree + 1;
    let mut chain = Vec::with_capacity(degree * (axis.len() - degree) + 1);
    for (segment, window) in axis.windows(size).enumerate() {
        let shared = usize::from(segment > 0);
        chain.extend(matrix.chunks(size).skip(shared).map(|row| dot(row, window)));
    }
    chain
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
