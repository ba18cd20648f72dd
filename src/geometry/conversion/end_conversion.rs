//! The conversions between float and clamped polygon, applied to the vertices that they change.

use glam::DVec3;

use super::exact_vertices::ExactVertices;
use super::knots::Direction;
use super::whole_vertices::WholeVertices;
use crate::geometry::control_polygon::ControlPolygon;

/// Hold the vertices near the ends, the only ones that differ between the float and the clamped
/// polygon of a curve: the first and the last n − 1.
pub(in crate::geometry) struct ConvertedEnds<const K: usize> {
    degree: usize,
    /// The number of vertices of the whole polygon.
    count: usize,
    /// The first n and the last n vertices, or all where that is fewer: a curve of so few
    /// vertices has the same ends.
    vertices: ExactVertices<K>,
    /// Bound of the sum of magnitudes that entered each coordinate's numbers.
    entered: [f64; 4],
    /// The exact vertices, if some have lost too much.
    whole: Option<WholeVertices>,
    /// The largest weight that entered.
    largest_weight: f64,
}

impl<const K: usize> ConvertedEnds<K> {
    /// Convert the ends of a polygon of degree n by steps whose rows sum up to `norm`.
    pub(in crate::geometry) fn new(
        polygon: &ControlPolygon,
        direction: Direction,
        norm: f64,
    ) -> Self {
        let (degree, count) = (polygon.degree(), polygon.vertices().len());
        let kept = count.min(2 * degree);
        let end = |index| polygon.weighted_vertex(placed(index, degree, count));
        let given = ExactVertices::new((0..kept).map(end), polygon.is_rational());
        let mut vertices = given.clone();
        vertices.change(|axis| direction.convert(degree, axis));
        let entered = given.largest(0..kept).map(|largest| largest * norm);
        let changes = |index: &usize| index + 1 < degree || index + degree > kept;
        let mut changed = (0..kept).filter(changes);
        let whole = if changed.all(|index| vertices.is_sure(index, entered)) {
            None
        } else {
            Some(WholeVertices::new(&given, degree, direction))
        };
        Self {
            degree,
            count,
            vertices,
            entered,
            whole,
            largest_weight: given.largest_weight(),
        }
    }

    /// List the converted vertices, each number rounded by itself: their numbers in the whole
    /// polygon, points, weights.
    pub(in crate::geometry) fn rounded(&self) -> impl Iterator<Item = (usize, DVec3, f64)> + '_ {
        let kept = self.vertices.len();
        let changed = self.degree - 1;
        let ends = (0..kept).filter(move |index| *index < changed || index + changed >= kept);
        ends.map(move |index| {
            let (point, weight) = match &self.whole {
                Some(whole) if !self.vertices.is_sure(index, self.entered) => whole.rounded(index),
                _ => self.vertices.rounded(index),
            };
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
