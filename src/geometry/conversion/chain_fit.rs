//! The float polygon whose curve is nearest to given Bézier polygons, by least squares.
//!
//! Bézier vertices in doubles are those of a smooth curve only up to their rounding. Converting
//! one segment, or each vertex from another, multiplies that rounding by up to (2n − 1)!!. The
//! least-squares polygon does not: its Bézier vertices are at most as far from the given ones as
//! those of the polygon that they were computed from. The normal equations alone would leave the
//! float vertices themselves free to take any size where the curve hardly depends on them, so
//! each is drawn to a place near the curve with a force as small as the rounding of doubles:
//!
//!   minimise Σ_r s_r² |Σ_i M_ri P_i − B_r|² + Σ_i f_i² |P_i − p_i|²,
//!
//! with s_r the inverse weight of the vertex. The system is banded, and of condition 2¹⁰⁶ at most,
//! which is what numbers of two or three doubles are for.

use super::exact_vertices::ExactVertices;
use crate::geometry::bezier_matrix::float_to_bezier;
use crate::geometry::expansion::Expansion;

/// Hold the least-squares system of one chain of Bézier polygons.
pub(in crate::geometry) struct ChainFit<'a, const K: usize> {
    degree: usize,
    segments: usize,
    periodic: bool,
    given: &'a ExactVertices<K>,
    /// SB, row by row.
    matrix: Vec<Expansion<K>>,
    /// The factor s of each Bézier vertex: a power of two.
    scales: Vec<f64>,
    /// MᵀS²M, banded: for each row, the entries from the diagonal leftwards.
    system: Vec<Vec<Expansion<K>>>,
}

impl<'a, const K: usize> ChainFit<'a, K> {
    /// Set up the system for the chain of Bézier polygons of an open curve, or of a periodic one
    /// of at least n + 1 segments.
    pub(in crate::geometry) fn new(
        degree: usize,
        given: &'a ExactVertices<K>,
        periodic: bool,
    ) -> Self {
        let segments = (given.len() - 1) / degree;
        let scale = |index| 2.0_f64.powi(-(given.rounded(index).1.log2().floor() as i32));
        let mut fit = Self {
            degree,
            segments,
            periodic,
            given,
            matrix: float_to_bezier(degree),
            scales: (0..given.len()).map(scale).collect(),
            system: Vec::new(),
        };
        fit.fill();
        fit
    }

    /// The number of float vertices.
    pub(in crate::geometry) fn count(&self) -> usize {
        self.segments + if self.periodic { 0 } else { self.degree }
    }

    /// Take for each float vertex the Bézier vertex in the middle of its knots, as far as there
    /// is one.
    pub(in crate::geometry) fn places(&self) -> ExactVertices<K> {
        let places = self.place_indices();
        self.given
            .map(|axis| places.iter().map(|place| axis[*place]).collect())
    }

    /// List the forces that draw every vertex alike, `force` in units of the curve's own.
    pub(in crate::geometry) fn even_forces(&self, force: f64) -> Vec<f64> {
        let places = self.place_indices();
        places
            .into_iter()
            .map(|place| force * self.scales[place])
            .collect()
    }

    /// List the forces that draw every vertex as much as the curve depends on it: what rounding
    /// it may do to the curve.
    pub(in crate::geometry) fn curve_forces(&self, force: f64) -> Vec<f64> {
        let mut forces = vec![0.0_f64; self.count()];
        for segment in 0..self.segments {
            for (row, entries) in self.matrix.chunks(self.degree + 1).enumerate() {
                let scale = force * self.scales[segment * self.degree + row];
                for (offset, entry) in entries.iter().enumerate() {
                    let vertex = self.vertex(segment + offset);
                    forces[vertex] = forces[vertex].max(scale * entry.value());
                }
            }
        }
        forces
    }

    /// Solve for the vertices that are drawn to `places` with these forces; `None` if the numbers
    /// leave their range.
    pub(in crate::geometry) fn solved(
        &self,
        places: &ExactVertices<K>,
        forces: &[f64],
    ) -> Option<ExactVertices<K>> {
        let mut system = self.system.clone();
        for (vertex, force) in forces.iter().enumerate() {
            let diagonal = &mut system[self.position(vertex)][0];
            *diagonal = *diagonal + Expansion::product(*force, *force);
        }
        let factors = Factors::new(system)?;
        Some(self.given.map_with(places, |given, places| {
            let mut right = self.transposed(given);
            for (vertex, force) in forces.iter().enumerate() {
                let square = Expansion::product(*force, *force);
                let sum = &mut right[self.position(vertex)];
                *sum = sum.plus_product(square, places[vertex]);
            }
            factors.solve(&mut right);
            (0..right.len()).map(|i| right[self.position(i)]).collect()
        }))
    }

    fn place_indices(&self) -> Vec<usize> {
        let (degree, last) = (self.degree as i64, (self.given.len() - 1) as i64);
        // Greville abscissa i − (n − 1)/2, n Bézier vertices a segment.
        let place = |vertex: usize| (2 * vertex as i64 + 1 - degree) * degree / 2;
        let vertices = (0..self.count()).map(place);
        let inside = |place: i64| {
            if self.periodic {
                place.rem_euclid(last)
            } else {
                place.clamp(0, last)
            }
        };
        vertices.map(|place| inside(place) as usize).collect()
    }

    fn fill(&mut self) {
        let size = self.degree + 1;
        let band = if self.periodic {
            2 * self.degree
        } else {
            self.degree
        };
        let mut system: Vec<Vec<Expansion<K>>> = (0..self.count())
            .map(|row| vec![Expansion::default(); band.min(row) + 1])
            .collect();
        let alike = self.scales.iter().all(|scale| *scale == 1.0);
        let mut products = self.products(0);
        for segment in 0..self.segments {
            if !alike && segment > 0 {
                products = self.products(segment);
            }
            let vertices: Vec<usize> = (0..size)
                .map(|offset| self.position(self.vertex(segment + offset)))
                .collect();
            for (a, row) in vertices.iter().enumerate() {
                for (b, column) in vertices.iter().enumerate().take(a + 1) {
                    let (high, low) = (*row.max(column), *row.min(column));
                    let entry = &mut system[high][high - low];
                    *entry = *entry + products[a * size + b];
                }
            }
        }
        self.system = system;
    }

    /// Multiply the columns of one segment's matrix with each other, rows scaled; only products
    /// with columns before and the own one are needed.
    fn products(&self, segment: usize) -> Vec<Expansion<K>> {
        let size = self.degree + 1;
        let mut products = vec![Expansion::default(); size * size];
        for (index, row) in self.matrix.chunks(size).enumerate() {
            let scale = self.scales[segment * self.degree + index];
            let scaled: Vec<Expansion<K>> = row.iter().map(|entry| *entry * scale).collect();
            for a in 0..size {
                for b in 0..=a {
                    let product = &mut products[a * size + b];
                    *product = product.plus_product(scaled[a], scaled[b]);
                }
            }
        }
        products
    }

    /// Compute MᵀS²B for one coordinate.
    fn transposed(&self, given: &[Expansion<K>]) -> Vec<Expansion<K>> {
        let size = self.degree + 1;
        let mut sums = vec![Expansion::default(); self.count()];
        for segment in 0..self.segments {
            for (index, row) in self.matrix.chunks(size).enumerate() {
                let place = segment * self.degree + index;
                let scale = self.scales[place];
                let number = given[place] * scale * scale;
                for (offset, entry) in row.iter().enumerate() {
                    let sum = &mut sums[self.position(self.vertex(segment + offset))];
                    *sum = sum.plus_product(number, *entry);
                }
            }
        }
        sums
    }

    fn vertex(&self, index: usize) -> usize {
        if self.periodic {
            index % self.segments
        } else {
            index
        }
    }

    /// The row of a vertex. Those of a periodic curve are taken from both sides of the joint by
    /// turns, so that vertices near each other stay so.
    fn position(&self, vertex: usize) -> usize {
        let count = self.count();
        if !self.periodic {
            vertex
        } else if 2 * vertex < count {
            2 * vertex
        } else {
            2 * (count - 1 - vertex) + 1
        }
    }
}

/// Hold the factors LDLᵀ of a banded, symmetric, positive definite matrix: L from the diagonal
/// leftwards, with D in place of its ones.
struct Factors<const K: usize>(Vec<Vec<Expansion<K>>>);

impl<const K: usize> Factors<K> {
    fn new(mut rows: Vec<Vec<Expansion<K>>>) -> Option<Self> {
        for row in 0..rows.len() {
            let (done, rest) = rows.split_at_mut(row);
            let current = &mut rest[0];
            // First L·D, which needs no division.
            for offset in (1..current.len()).rev() {
                let column = &done[row - offset];
                let shared = column.len().min(current.len() - offset);
                let mut value = current[offset];
                for k in 1..shared {
                    value = value.plus_product(-current[offset + k], column[k]);
                }
                current[offset] = value;
            }
            for offset in 1..current.len() {
                let quotient = current[offset] / done[row - offset][0];
                current[0] = current[0].plus_product(-current[offset], quotient);
                current[offset] = quotient;
            }
            let pivot = current[0].value();
            if !(pivot > 0.0 && pivot.is_finite()) {
                return None;
            }
        }
        Some(Self(rows))
    }

    fn solve(&self, right: &mut [Expansion<K>]) {
        for (row, entries) in self.0.iter().enumerate() {
            for (offset, entry) in entries.iter().enumerate().skip(1) {
                right[row] = right[row].plus_product(-*entry, right[row - offset]);
            }
        }
        for (row, entries) in self.0.iter().enumerate() {
            right[row] = right[row] / entries[0];
        }
        for (row, entries) in self.0.iter().enumerate().rev() {
            for (offset, entry) in entries.iter().enumerate().skip(1) {
                right[row - offset] = right[row - offset].plus_product(-*entry, right[row]);
            }
        }
    }
}
