//! Short rows over the vertices, and the symmetric band matrix that they make.

use std::ops::Range;

use super::symmetry_axis::SymmetryAxis;

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

/// The numbers that are added or multiplied at a time.
const LANES: usize = 4;

/// Rows of a matrix whose entries belong to successive vertices: x, y, x, y, …
#[derive(Clone)]
pub(super) struct Rows {
    width: usize,
    /// From one row's entries to the next: the width, filled up with zeros to whole [`LANES`].
    stride: usize,
    pub(super) firsts: Vec<usize>,
    entries: Vec<f64>,
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
    pub(super) fn symmetrise(&self, mirror: SymmetryAxis, matrix: &mut BandMatrix) {
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
    pub(super) fn symmetrise_right(&self, mirror: SymmetryAxis, right: &mut [f64]) {
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
        let mut products = Vec::with_capacity(rows.firsts.len());
        let mut local = vec![0.0; rows.stride];
        for (first, own) in rows.by_vertices() {
            for (value, column) in local.iter_mut().zip(self.columns(first)).take(rows.width) {
                *value = vector[*column];
            }
            let entries = rows.entries_of(own).chunks_exact(rows.stride);
            products.extend(entries.map(|row| dot(row, &local)));
        }
        products
    }

    /// Add the transposed rows times a vector.
    pub(super) fn add_transposed(&self, rows: &Rows, vector: &[f64], sum: &mut [f64]) {
        let mut local = vec![0.0; rows.stride];
        for (first, own) in rows.by_vertices() {
            local.fill(0.0);
            let factors = &vector[own.clone()];
            let entries = rows.entries_of(own).chunks_exact(rows.stride);
            for (row, factor) in entries.zip(factors) {
                add(&mut local, *factor, row);
            }
            for (value, column) in local.iter().zip(self.columns(first)).take(rows.width) {
                sum[*column] += value;
            }
        }
    }

    /// Add Σ wᵣ cᵣ cᵣᵀ over the rows.
    pub(super) fn add_squares(&self, rows: &Rows, weights: &[f64], sum: &mut BandMatrix) {
        let (band, stride) = (sum.band, rows.stride);
        let mut block = vec![0.0; stride * rows.width];
        // Rows of the same vertices are summed up before they go into the band.
        for (first, own) in rows.by_vertices() {
            block.fill(0.0);
            let weights = &weights[own.clone()];
            let entries = rows.entries_of(own).chunks_exact(stride);
            for (row, weight) in entries.zip(weights).filter(|(_, it)| **it != 0.0) {
                for (line, own) in block.chunks_exact_mut(stride).zip(row) {
                    add(line, weight * own, row);
                }
            }
            let columns = &self.columns(first)[..rows.width];
            let lines = block.chunks_exact(stride).enumerate();
            if self.is_folded {
                for ((_, line), below) in lines.zip(columns) {
                    for (value, column) in line.iter().zip(columns).filter(|(_, it)| *it <= below) {
                        sum.columns[column * band + below - column] += value;
                    }
                }
            } else {
                let columns = sum.columns[2 * first * band..].chunks_exact_mut(band);
                for ((a, line), column) in lines.zip(columns) {
                    for (sum, value) in column.iter_mut().zip(&line[a..rows.width]) {
                        *sum += value;
                    }
                }
            }
        }
    }
}

/// Add `factor` times numbers, four at a time: such loops become vector instructions.
fn add(sums: &mut [f64], factor: f64, values: &[f64]) {
    let (sums, _) = sums.as_chunks_mut::<LANES>();
    let (values, _) = values.as_chunks::<LANES>();
    for (sums, values) in sums.iter_mut().zip(values) {
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += factor * value;
        }
    }
}

/// The sum of products, four at a time.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    let (a, _) = a.as_chunks::<LANES>();
    let (b, _) = b.as_chunks::<LANES>();
    for (a, b) in a.iter().zip(b) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    sums.iter().sum()
}

impl Rows {
    /// Begin with no rows of `vertices` vertices each.
    pub(super) fn new(vertices: usize) -> Self {
        let width = 2 * vertices;
        Self {
            width,
            stride: width.next_multiple_of(LANES),
            firsts: Vec::new(),
            entries: Vec::new(),
        }
    }

    /// Add a row; what it lacks at its end is 0.
    pub(super) fn push(&mut self, first: usize, entries: impl IntoIterator<Item = f64>) {
        self.firsts.push(first);
        self.entries.extend(entries.into_iter().take(self.width));
        self.entries.resize(self.firsts.len() * self.stride, 0.0);
    }

    /// The rows with their first vertices, to be changed.
    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = (usize, &mut [f64])> {
        let width = self.width;
        let rows = self.entries.chunks_exact_mut(self.stride.max(1));
        let rows = rows.map(move |row| &mut row[..width]);
        self.firsts.iter().copied().zip(rows)
    }

    /// The numbers of successive rows of the same vertices, with their first vertex.
    fn by_vertices(&self) -> impl Iterator<Item = (usize, Range<usize>)> {
        let mut begin = 0;
        self.firsts.chunk_by(|a, b| a == b).map(move |firsts| {
            let rows = begin..begin + firsts.len();
            begin = rows.end;
            (firsts[0], rows)
        })
    }

    /// The entries of some rows.
    fn entries_of(&self, rows: Range<usize>) -> &[f64] {
        &self.entries[rows.start * self.stride..rows.end * self.stride]
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
