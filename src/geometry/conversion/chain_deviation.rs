//! Proved bounds of how far the curve of a float polygon is from that of given Bézier polygons.
//!
//! Both curves are written as chains of Bézier polygons of one degree. A polynomial difference
//! lies in the convex hull of the differences of the vertices. Of rational curves A/a and B/b,
//! with p = B/b and any point c,
//!
//!   A/a − B/b = ((A − B) − c (a − b) − (p − c)(a − b)) / a,
//!
//! a mean, with the positive weights of a, of the same quotients vertex by vertex.

use super::exact_vertices::ExactVertices;
use crate::geometry::bezier_matrix::{chain, float_to_bezier};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::vector::{self, larger};

/// What two doubles a number may lose, in units of the largest coordinate: the sums have up to 26
/// terms.
const LOST: f64 = 1.0 / (1_u128 << 96) as f64;

/// Relative rounding error of a bound in doubles.
const ROUNDINGS: f64 = 1.0 + 16.0 * f64::EPSILON;

/// Bound the largest distance at equal parameters between the curve of given Bézier polygons and
/// that of a float polygon of the same degree and as many segments. It is what the vertices of
/// both are apart, and so at most a few times what is attained. Infinite or not a number where
/// numbers leave their range.
pub(in crate::geometry) fn chain_deviation(given: &ExactVertices<2>, float: &FloatPolygon) -> f64 {
    let degree = float.degree();
    let vertices = ExactVertices::<2>::of(&float.unrolled());
    let matrix = float_to_bezier(degree);
    let found = vertices.map(|axis| chain(degree, &matrix, axis));
    let bound = if given.is_rational() {
        rational(degree, given, &found)
    } else {
        polynomial(given, &found)
    };
    (bound + LOST * reach(given)) * ROUNDINGS
}

/// Find the largest coordinate of the vertices' points.
pub(in crate::geometry) fn reach<const K: usize>(vertices: &ExactVertices<K>) -> f64 {
    vector::reach((0..vertices.len()).map(|index| vertices.rounded(index).0))
}

fn polynomial(given: &ExactVertices<2>, found: &ExactVertices<2>) -> f64 {
    let distances = (0..given.len()).map(|index| {
        let difference = given.difference(found, index);
        vector::length(difference.truncate())
    });
    distances.fold(0.0, larger)
}

fn rational(degree: usize, given: &ExactVertices<2>, found: &ExactVertices<2>) -> f64 {
    let segments = (given.len() - 1) / degree;
    let bounds = (0..segments).map(|segment| {
        let window = segment * degree..=(segment + 1) * degree;
        let (centre, _) = given.rounded(segment * degree);
        let arms = window
            .clone()
            .map(|index| vector::length(given.rounded(index).0 - centre));
        let arm = arms.fold(0.0, larger);
        let quotients = window.map(|index| {
            let difference = found.difference(given, index);
            let about = difference.truncate() - centre * difference.w;
            let (_, weight) = found.rounded(index);
            let bound = vector::length(about) + arm * difference.w.abs();
            if weight > 0.0 {
                bound / weight
            } else {
                f64::INFINITY
            }
        });
        quotients.fold(0.0, larger)
    });
    bounds.fold(0.0, larger)
}
