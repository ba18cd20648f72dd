//! Short rows over the vertices, and the symmetric band matrix that they make.

use super::mirror::Mirror;

/// Where the unknowns of the vertices stand.
///
/// Vertex v has the unknowns 2 p(v) and 2 p(v) + 1, for x and y. On an open curve p(v) = v; on a periodic one
/// the vertices are folded, 0, N − 1, 1, N − 2, …, so that neighbours stay near each other.
pub(super) struct Layout {
    places: Vec<usize>,
    is_folded: bool,
    /// The unknowns of the entries of rows, by first vertex, and how many each row has.
    columns: Vec<usize>,
    width: usize,
    /// The number of diagonals from the main one downwards.
    pub(super) band: usize,
}

/// Rows of a matrix whose entries belong to successive vertices: x, y, x, y, …
#[derive(Clone)]
pub(super) struct Rows {
    width: usize,
    pub(super) firsts: Vec<usize>,
    pub(super) entries: Vec<f64>,
}

/// The lower part of a symmetric band matrix, column by column from the diagonal.
#[derive(Clone)]
pub(super) struct BandMatrix {
    band: usize,
    pub(super) columns: Vec<f64>,
}

/// The Cholesky factor L of a band matrix LLᵀ.
pub(super) struct BandFactor(BandMatrix);

impl Layout {
    /// Lay out `count` vertices, of which rows reach over `reach`.
    pub(super) fn new(count: usize, reach: usize, periodic: bool) -> Self {
        let half = count.div_ceil(2);
        let place = |vertex: usize| match (periodic, vertex < half) {
            (false, _) => vertex,
            (true, true) => 2 * vertex,
            (true, false) => 2 * (count - 1 - vertex) + 1,
        };
        let band = if periodic { 4 * reach } else { 2 * reach };
        let places: Vec<usize> = (0..count).map(place).collect();
        let width = 2 * reach;
        let columns = (0..count).flat_map(|first| {
            let column = |entry: usize| 2 * places[(first + entry / 2) % count] + entry % 2;
            (0..width).map(column).collect::<Vec<usize>>()
        });
        Self {
            columns: columns.collect(),
            width,
            is_folded: periodic,
            places,
            band: band.min(2 * count),
        }
    }

    /// The number of unknowns.
    pub(super) fn unknowns(&self) -> usize {
        2 * self.places.len()
    }

    /// The first unknown of a vertex.
    pub(super) fn unknown(&self, vertex: usize) -> usize {
        2 * self.places[vertex % self.places.len()]
    }

    /// The unknown of the same coordinate of the vertex as far from the other end.
    fn mirrored(&self) -> Vec<usize> {
        let count = self.places.len();
        let mut mirrored = vec![0; self.unknowns()];
        for vertex in 0..count {
            let [own, other] = [self.unknown(vertex), self.unknown(count - 1 - vertex)];
            mirrored[own] = other;
            mirrored[own + 1] = other + 1;
        }
        mirrored
    }

    /// Make equations of vertices those of curves that are their own mirror images: the mean of them and their
    /// images.
    pub(super) fn symmetrise(&self, mirror: Mirror, matrix: &mut BandMatrix) {
        let (mirrored, band) = (self.mirrored(), matrix.band);
        let old = matrix.columns.clone();
        for (column, entries) in matrix.columns.chunks_exact_mut(band).enumerate() {
            let rows = (column..mirrored.len()).zip(entries);
            for (row, entry) in rows {
                let (a, b) = (mirrored[row], mirrored[column]);
                let (first, apart) = (a.min(b), a.abs_diff(b));
                let image = if apart < band {
                    old[first * band + apart]
                } else {
                    0.0
                };
                *entry = 0.5 * (*entry + mirror.sign(row, column) * image);
            }
        }
    }

    /// Do so with the right side of the equations.
    pub(super) fn symmetrise_right(&self, mirror: Mirror, right: &mut [f64]) {
        let old = right.to_vec();
        for (unknown, other) in self.mirrored().into_iter().enumerate() {
            right[unknown] = 0.5 * (old[unknown] + mirror.factor(unknown) * old[other]);
        }
    }

    /// The unknowns of a row's entries.
    fn columns(&self, first: usize) -> &[usize] {
        &self.columns[first * self.width..(first + 1) * self.width]
    }

    /// Multiply rows and a vector.
    pub(super) fn times(&self, rows: &Rows, vector: &[f64]) -> Vec<f64> {
        let products = rows.iter().map(|(first, row)| match self.is_folded {
            false => {
                let part = &vector[2 * first..];
                row.iter().zip(part).map(|(factor, it)| factor * it).sum()
            }
            true => {
                let columns = self.columns(first).iter();
                row.iter()
                    .zip(columns)
                    .map(|(factor, it)| factor * vector[*it])
                    .sum()
            }
        });
        products.collect()
    }

    /// Add the transposed rows times a vector.
    pub(super) fn add_transposed(&self, rows: &Rows, vector: &[f64], sum: &mut [f64]) {
        for ((first, row), factor) in rows.iter().zip(vector).filter(|(_, it)| **it != 0.0) {
            if self.is_folded {
                for (value, column) in row.iter().zip(self.columns(first)) {
                    sum[*column] += factor * value;
                }
            } else {
                for (sum, value) in sum[2 * first..].iter_mut().zip(row) {
                    *sum += factor * value;
                }
            }
        }
    }

    /// Add Σ wᵣ cᵣ cᵣᵀ over the rows.
    pub(super) fn add_squares(&self, rows: &Rows, weights: &[f64], sum: &mut BandMatrix) {
        let band = sum.band;
        let mut block = vec![0.0; rows.width * rows.width];
        // Rows of the same vertices are summed up before they go into the band.
        for (first, entries, weights) in rows.by_vertices(weights) {
            block.fill(0.0);
            match rows.width {
                8 => add_to_block::<8>(&mut block, entries, weights),
                12 => add_to_block::<12>(&mut block, entries, weights),
                16 => add_to_block::<16>(&mut block, entries, weights),
                20 => add_to_block::<20>(&mut block, entries, weights),
                width => add_to_any_block(&mut block, width, entries, weights),
            }
            let lines = block.chunks_exact(rows.width.max(1)).enumerate();
            if self.is_folded {
                let columns = self.columns(first);
                for ((_, line), below) in lines.zip(columns) {
                    for (value, column) in line.iter().zip(columns).filter(|(_, it)| *it <= below) {
                        sum.columns[column * band + below - column] += value;
                    }
                }
            } else {
                let columns = sum.columns[2 * first * band..].chunks_exact_mut(band);
                for ((a, line), column) in lines.zip(columns) {
                    for (sum, value) in column.iter_mut().zip(&line[a..]) {
                        *sum += value;
                    }
                }
            }
        }
    }
}

/// Add Σ w r rᵀ over rows of `WIDTH` entries, four at a time: the loops have fixed lengths, which compilers turn
/// into vector instructions.
fn add_to_block<const WIDTH: usize>(block: &mut [f64], entries: &[f64], weights: &[f64]) {
    let (lines, _) = block.as_chunks_mut::<WIDTH>();
    let (rows, _) = entries.as_chunks::<WIDTH>();
    let (fours, left) = rows.as_chunks::<4>();
    let (weights_of_fours, weights_left) = weights.as_chunks::<4>();
    for ([p, q, r, s], [wp, wq, wr, ws]) in fours.iter().zip(weights_of_fours) {
        for (a, line) in lines.iter_mut().enumerate() {
            let [fp, fq, fr, fs] = [wp * p[a], wq * q[a], wr * r[a], ws * s[a]];
            for (b, sum) in line.iter_mut().enumerate() {
                *sum += fp * p[b] + fq * q[b] + fr * r[b] + fs * s[b];
            }
        }
    }
    for (row, weight) in left.iter().zip(weights_left) {
        for (a, line) in lines.iter_mut().enumerate() {
            let factor = weight * row[a];
            for (sum, value) in line.iter_mut().zip(row) {
                *sum += factor * value;
            }
        }
    }
}

/// Do so with rows of any length.
fn add_to_any_block(block: &mut [f64], width: usize, entries: &[f64], weights: &[f64]) {
    for (row, weight) in entries.chunks_exact(width).zip(weights) {
        for (line, own) in block.chunks_exact_mut(width).zip(row) {
            for (sum, value) in line.iter_mut().zip(row) {
                *sum += weight * own * value;
            }
        }
    }
}

impl Rows {
    /// Begin with no rows of `vertices` vertices each.
    pub(super) fn new(vertices: usize) -> Self {
        Self {
            width: 2 * vertices,
            firsts: Vec::new(),
            entries: Vec::new(),
        }
    }

    /// Add a row; what it lacks at its end is 0.
    pub(super) fn push(&mut self, first: usize, entries: impl IntoIterator<Item = f64>) {
        self.firsts.push(first);
        self.entries.extend(entries.into_iter().take(self.width));
        self.entries.resize(self.firsts.len() * self.width, 0.0);
    }

    /// The rows with their first vertices.
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, &[f64])> {
        let rows = self.entries.chunks_exact(self.width.max(1));
        self.firsts.iter().copied().zip(rows)
    }

    /// The entries and weights of successive rows of the same vertices, with their first vertex.
    fn by_vertices<'r>(
        &'r self,
        weights: &'r [f64],
    ) -> impl Iterator<Item = (usize, &'r [f64], &'r [f64])> {
        let mut begin = 0;
        self.firsts.chunk_by(|a, b| a == b).map(move |firsts| {
            let rows = begin..begin + firsts.len();
            begin = rows.end;
            let entries = &self.entries[rows.start * self.width..rows.end * self.width];
            (firsts[0], entries, &weights[rows])
        })
    }

    /// The rows with their first vertices, to be changed.
    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = (usize, &mut [f64])> {
        let rows = self.entries.chunks_exact_mut(self.width.max(1));
        self.firsts.iter().copied().zip(rows)
    }
}

impl BandMatrix {
    /// A matrix of zeros for a layout.
    pub(super) fn new(layout: &Layout) -> Self {
        Self {
            band: layout.band,
            columns: vec![0.0; layout.unknowns() * layout.band],
        }
    }

    /// The diagonal.
    pub(super) fn diagonal(&self) -> impl Iterator<Item = f64> {
        self.columns.chunks_exact(self.band).map(|column| column[0])
    }

    /// Add a number to each entry of the diagonal.
    pub(super) fn add_to_diagonal(&mut self, number: f64) {
        for column in self.columns.chunks_exact_mut(self.band) {
            column[0] += number;
        }
    }

    /// Multiply by a vector.
    pub(super) fn times(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; vector.len()];
        for (j, column) in self.columns.chunks_exact(self.band).enumerate() {
            product[j] += column[0] * vector[j];
            let below = vector.len().min(j + self.band) - j;
            for (i, value) in column.iter().enumerate().take(below).skip(1) {
                product[j + i] += value * vector[j];
                product[j] += value * vector[j + i];
            }
        }
        product
    }

    /// Factor the matrix; `None` if it is not positive definite.
    pub(super) fn factor(mut self) -> Option<BandFactor> {
        let band = self.band;
        let count = self.columns.len() / band;
        for j in 0..count {
            let below = band.min(count - j);
            let (here, behind) = self.columns[j * band..].split_at_mut(band);
            let root = here[0].sqrt();
            if !(root > 0.0) {
                return None;
            }
            here[0] = root;
            for value in &mut here[1..below] {
                *value /= root;
            }
            let behind = behind.chunks_exact_mut(band).take(below - 1);
            for (shift, column) in behind.enumerate() {
                let factor = here[shift + 1];
                if factor != 0.0 {
                    let own = here[shift + 1..below].iter();
                    for (value, own) in column.iter_mut().zip(own) {
                        *value -= factor * own;
                    }
                }
            }
        }
        Some(BandFactor(self))
    }
}

impl BandFactor {
    /// Solve LLᵀ x = `right`.
    pub(super) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let band = self.0.band;
        let mut x = right.to_vec();
        for (j, column) in self.0.columns.chunks_exact(band).enumerate() {
            x[j] /= column[0];
            let value = x[j];
            for (later, factor) in x[j + 1..].iter_mut().zip(&column[1..]) {
                *later -= factor * value;
            }
        }
        for (j, column) in self.0.columns.chunks_exact(band).enumerate().rev() {
            let later = x[j + 1..].iter().zip(&column[1..]);
            let known: f64 = later.map(|(value, factor)| value * factor).sum();
            x[j] = (x[j] - known) / column[0];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(index: usize) -> f64 {
        (0.7 * index as f64).sin()
    }

    #[test]
    fn rows_make_a_matrix_that_is_solved_for_open_and_periodic_curves() {
        for periodic in [false, true] {
            let (count, reach) = (9, 3);
            let layout = Layout::new(count, reach, periodic);
            let mut rows = Rows::new(reach);
            for first in 0..if periodic { count } else { count - reach + 1 } {
                rows.push(
                    first,
                    (0..6).map(|entry| wave(7 * first + 3 * entry + entry * entry)),
                );
            }
            let mut matrix = BandMatrix::new(&layout);
            let weights: Vec<f64> = (0..rows.firsts.len()).map(|it| 1.0 + it as f64).collect();
            layout.add_squares(&rows, &weights, &mut matrix);
            matrix.add_to_diagonal(0.1);
            let x: Vec<f64> = (0..layout.unknowns()).map(|it| wave(it + 5)).collect();
            let weighed = layout.times(&rows, &x);
            let weighed: Vec<f64> = weighed.iter().zip(&weights).map(|(a, b)| a * b).collect();
            let mut right: Vec<f64> = x.iter().map(|it| 0.1 * it).collect();
            layout.add_transposed(&rows, &weighed, &mut right);
            for (a, b) in matrix.times(&x).iter().zip(&right) {
                assert!((a - b).abs() < 1e-12, "{a} against {b}");
            }
            let found = matrix
                .factor()
                .expect("a positive definite matrix")
                .solve(&right);
            for (a, b) in found.iter().zip(&x) {
                assert!((a - b).abs() < 1e-12, "{a} against {b}");
            }
        }
    }
}
