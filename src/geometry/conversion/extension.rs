//! Longer curves: the end segment's polynomial continued.

use super::exact_vertices::{ExactVertices, check_weight, converted_float, weight_loss};
use crate::geometry::end::End;
use crate::geometry::error::PolygonError;
use crate::geometry::expansion::Expansion;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_kind::PolygonKind;

/// The most segments that one extension adds: the vertices would long be out of proportion.
pub const MAX_ADDED_SEGMENTS: usize = 10_000;

type Number = Expansion<3>;

impl FloatPolygon {
    /// Extend an open curve by whole segments at one end: they continue the polynomial of the end
    /// segment, so the (n + 1)-th differences of the vertices vanish there. The given vertices
    /// stay as they are, bit for bit; at the start their numbers rise by `segments`.
    ///
    /// Far out the vertices grow as the n-th power of the number of segments, and so do the
    /// errors that the given ones have. Each is the exact one rounded: the differences carry
    /// three doubles a number.
    ///
    /// # Errors
    /// [`PolygonError::PeriodicCurve`]; [`PolygonError::TooManySegments`] beyond
    /// [`MAX_ADDED_SEGMENTS`]; [`PolygonError::WeightLost`] if a rational curve's new
    /// vertex has a weight that is not positive, [`PolygonError::Overflow`] if it leaves the range
    /// of numbers. Vertices are counted as in the extended polygon.
    pub fn extended(&self, end: End, segments: usize) -> Result<Self, PolygonError> {
        self.check_open("extended")?;
        if segments > MAX_ADDED_SEGMENTS {
            let most = MAX_ADDED_SEGMENTS;
            return Err(PolygonError::TooManySegments { segments, most });
        }
        if end == End::Start {
            let extended = self.reversed().extended(End::Finish, segments);
            let last = self.vertices().len() + segments - 1;
            return match extended {
                Ok(extended) => Ok(extended.reversed()),
                Err(error) => Err(error.counted_backwards(last)),
            };
        }
        let added = self.added_vertices(segments)?;
        let mut vertices = self.vertices().to_vec();
        let mut weights = self.weights().map(<[f64]>::to_vec);
        let (new_vertices, new_weights) = added.all_rounded();
        vertices.extend(new_vertices);
        if let (Some(weights), Some(new_weights)) = (&mut weights, new_weights) {
            weights.extend(new_weights);
        }
        converted_float(self.degree(), (vertices, weights), false)
    }

    fn added_vertices(&self, segments: usize) -> Result<ExactVertices<3>, PolygonError> {
        let (to, count) = (PolygonKind::Float, self.vertices().len());
        let given = (count - self.degree() - 1..count)
            .map(|index| (self.vertex(index), self.weight(index)));
        let given = ExactVertices::<3>::new(given, self.is_rational());
        let added = given.map(|axis| continued(axis, segments));
        if self.is_rational() {
            let mut growth = growth(self.degree());
            for index in 0..segments {
                let (_, weight) = added.rounded(index);
                let loses = weight_loss(given.largest_weight() * growth());
                check_weight(to, count + index, weight, loses)?;
            }
        }
        Ok(added)
    }
}

/// Continue a polynomial sequence of degree n, given by n + 1 numbers, by `count` more.
fn continued(given: &[Number], count: usize) -> Vec<Number> {
    let mut differences = given.to_vec();
    // Leave the k-th difference that ends at the last number in place n − k.
    for first in 1..differences.len() {
        for index in 0..differences.len() - first {
            differences[index] = differences[index + 1] - differences[index];
        }
    }
    let next = |_| {
        for index in 1..differences.len() {
            differences[index] = differences[index] + differences[index - 1];
        }
        differences.last().copied().unwrap_or(Number::default())
    };
    (0..count).map(next).collect()
}

/// Bound, one vertex after another, the sum of the magnitudes of the numbers that enter it: the
/// vertices ±1 whose differences are the largest, continued.
fn growth(degree: usize) -> impl FnMut() -> f64 {
    let mut differences: Vec<f64> = (0..=degree)
        .map(|index| 2.0_f64.powi((degree - index) as i32))
        .collect();
    move || {
        for index in 1..differences.len() {
            differences[index] += differences[index - 1];
        }
        differences.last().copied().unwrap_or(1.0)
    }
}
