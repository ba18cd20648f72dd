//! The conversions between float and clamped polygon, applied to the vertices that they change.

use glam::DVec3;

use super::exact_vertices::ExactVertices;
use super::expansion::Expansion;

/// Hold the vertices near the ends, the only ones that differ between the float and the clamped
/// polygon of a curve: the first and the last n − 1.
pub(in crate::geometry) struct ConvertedEnds<const K: usize> {
    degree: usize,
    /// The number of vertices of the whole polygon.
    count: usize,
    /// The first n and the last n vertices, or all where that is fewer: a curve of so few
    /// vertices has the same ends.
    vertices: ExactVertices<K>,
    /// The largest weight that entered.
    largest_weight: f64,
}

impl<const K: usize> ConvertedEnds<K> {
    /// Convert the ends of a polygon of degree n; `convert` works on the n and n vertices.
    pub(in crate::geometry) fn new(
        degree: usize,
        points: &[DVec3],
        weights: Option<&[f64]>,
        convert: impl Fn(usize, &mut [Expansion<K>]),
    ) -> Self {
        let count = points.len();
        let kept = count.min(2 * degree);
        let place = |index| placed(index, degree, count);
        let vertex = |index| {
            let weight = weights.and_then(|weights| weights.get(index));
            (points[index], weight.copied().unwrap_or(1.0))
        };
        let ends = (0..kept).map(place).map(vertex);
        let mut vertices = ExactVertices::new(ends, weights.is_some());
        let largest_weight = vertices.largest_weight();
        vertices.change(|axis| convert(degree, axis));
        Self {
            degree,
            count,
            vertices,
            largest_weight,
        }
    }

    /// List the converted vertices, rounded: their numbers in the whole polygon, points, weights.
    pub(in crate::geometry) fn rounded(&self) -> impl Iterator<Item = (usize, DVec3, f64)> + '_ {
        let kept = self.vertices.len();
        let changed = self.degree - 1;
        let ends = (0..kept).filter(move |index| *index < changed || index + changed >= kept);
        ends.map(move |index| {
            let (point, weight) = self.vertices.rounded(index);
            (placed(index, self.degree, self.count), point, weight)
        })
    }

    /// The largest weight that entered the conversion.
    pub(in crate::geometry) fn largest_weight(&self) -> f64 {
        self.largest_weight
    }
}

/// The number that the kept vertex `index` has in a polygon of `count` vertices.
fn placed(index: usize, degree: usize, count: usize) -> usize {
    if index < degree || count <= 2 * degree {
        index
    } else {
        index + count - 2 * degree
    }
}
