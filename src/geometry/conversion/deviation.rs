//! Proved bounds of how far two curves are apart.
//!
//! The difference of two curves at equal parameters is itself a curve, piecewise polynomial or
//! rational. Each piece lies in the convex hull of its Bézier vertices, so the longest of them is
//! a bound; halving the pieces brings the bound down to what the curve attains.

use glam::{DVec3, DVec4};

use super::bezier_polygon::{BezierPolygon, segment_bezier};
use super::clamped_polygon::ClampedPolygon;
use super::exact_polygon::ExactPolygon;
use crate::geometry::cut::cut;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::tables::binomials;
use crate::geometry::vector::{self, larger};

/// Relative gap between a bound and the attained distance.
const GAP: f64 = 1e-3;

/// How often a piece is halved at most. The gap falls to a quarter each time, so it closes long
/// before, unless the difference is nothing but rounding.
const HALVINGS: u32 = 24;

/// What converting and multiplying curves of degree 25 in doubles may lose, in units of the
/// largest coordinate.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

impl FloatPolygon {
    /// Bound the largest distance between this curve and another of as many segments at equal
    /// parameters, which is also a bound of the distance between the curves as sets.
    ///
    /// For two polygons of one degree and the same weights it is the largest |Σ N_i(u) d_i|, d_i
    /// the differences of the vertices, and lies at most 0.1 % above that, but for what rounds the
    /// differences: 2.2e-16 of the largest. For others rounding adds up to 1.4e-14 of the largest coordinate. It is infinite where weights are so unlike
    /// each other that their products vanish.
    ///
    /// # Errors
    /// [`PolygonError::DifferentKnots`] if the numbers of segments differ or one curve only is
    /// periodic; [`PolygonError::BadCoordinate`] if a difference leaves the range of numbers.
    pub fn deviation(&self, other: &Self) -> Result<f64, PolygonError> {
        let (segments, periodic) = (self.segments(), self.is_periodic());
        if segments != other.segments() || periodic != other.is_periodic() {
            return Err(different_knots(segments, other.segments()));
        }
        if self.degree() != other.degree() || self.weights() != other.weights() {
            let (a, b) = (
                BezierPolygon::from_float(self),
                BezierPolygon::from_float(other),
            );
            return Ok(between_chains(&a, &b));
        }
        let weights = self.weights().map(<[f64]>::to_vec);
        let moves = differences(self.vertices(), other.vertices());
        let rounding = rounding_of(&moves);
        let difference = Self::new(self.degree(), moves, weights, periodic)?;
        Ok(reach_of_chain(&BezierPolygon::from_float(&difference)) + rounding)
    }
}

impl ClampedPolygon {
    /// Bound the largest distance between this curve and another of the same degree and as many
    /// segments at equal parameters, as [`FloatPolygon::deviation`] does.
    ///
    /// # Errors
    /// [`PolygonError::DifferentKnots`] if the degrees or the numbers of segments differ;
    /// [`PolygonError::BadCoordinate`] if a difference leaves the range of numbers;
    /// [`PolygonError::WeightLost`] as in [`ClampedPolygon::rounded`].
    pub fn deviation(&self, other: &Self) -> Result<f64, PolygonError> {
        if self.degree() != other.degree() || self.segments() != other.segments() {
            return Err(different_knots(self.segments(), other.segments()));
        }
        if self.weights() != other.weights() {
            let [a, b] = [self, other].map(|c| ExactPolygon::from_clamped(c).to_bezier());
            return Ok(between_chains(&a?, &b?));
        }
        let weights = self.weights().map(<[f64]>::to_vec);
        let moves = differences(self.vertices(), other.vertices());
        let rounding = rounding_of(&moves);
        let difference = Self::new(self.degree(), moves, weights)?;
        let chain = ExactPolygon::from_clamped(&difference).to_bezier()?;
        Ok(reach_of_chain(&chain) + rounding)
    }
}

/// Bound the distance between a curve from u = `start` on, u growing by `step` a segment of
/// `part`, and that polygon's whole curve.
pub(in crate::geometry) fn from_part(
    curve: &FloatPolygon,
    start: f64,
    step: f64,
    part: &FloatPolygon,
) -> f64 {
    let pieces = (0..part.segments()).flat_map(|segment| {
        let polygon = segment_bezier(part, segment);
        let from = start + step * segment as f64;
        let breaks = breaks(from, start + step * (segment + 1) as f64);
        let spans: Vec<[f64; 2]> = breaks.windows(2).map(|span| [span[0], span[1]]).collect();
        spans.into_iter().map(move |[low, high]| {
            let (there, middle) = curve.locate(0.5 * (low + high));
            let origin = 0.5 * (low + high) - middle;
            let here = restricted(polygon.clone(), (low - from) / step, (high - from) / step);
            let whole = segment_bezier(curve, there);
            difference(&restricted(whole, low - origin, high - origin), &here)
        })
    });
    let allowance = ROUNDINGS * vector::reach(curve.vertices()).max(vector::reach(part.vertices()));
    largest_norm(pieces, allowance) + allowance
}

/// Bound the distance between two chains of as many Bézier polygons.
fn between_chains(a: &BezierPolygon, b: &BezierPolygon) -> f64 {
    let pairs = pieces(a).zip(pieces(b));
    let allowance = ROUNDINGS * vector::reach(a.vertices()).max(vector::reach(b.vertices()));
    largest_norm(pairs.map(|(a, b)| difference(&a, &b)), allowance) + allowance
}

/// Bound the largest distance of a chain's curve from the origin.
fn reach_of_chain(chain: &BezierPolygon) -> f64 {
    let rounding = ROUNDINGS * vector::reach(chain.vertices());
    largest_norm(pieces(chain), 0.0) + rounding
}

/// Bound the largest |(x, y, z) / w| of some homogeneous Bézier polygons; what lies below `floor`
/// is not looked at more closely.
fn largest_norm(pieces: impl Iterator<Item = Vec<DVec4>>, floor: f64) -> f64 {
    let norm = |vertex: &DVec4| vector::length(vertex.truncate() / vertex.w);
    let (mut attained, mut bound) = (0.0_f64, 0.0_f64);
    let mut waiting = Vec::new();
    for piece in pieces {
        waiting.push((piece, HALVINGS));
        while let Some((piece, halvings)) = waiting.pop() {
            let ends = [piece.first(), piece.last()];
            attained = ends
                .into_iter()
                .flatten()
                .map(norm)
                .fold(attained, f64::max);
            let upper = piece.iter().map(norm).fold(0.0, larger);
            if halvings == 0 || upper == f64::INFINITY || upper <= floor.max(attained * (1.0 + GAP))
            {
                bound = bound.max(upper);
            } else {
                let (left, right) = halved(piece, 0.5);
                waiting.extend([(left, halvings - 1), (right, halvings - 1)]);
            }
        }
    }
    bound
}

/// Write the difference of two rational Bézier curves as one: with A/a and B/b it is
/// (A b − B a) / (a b), of the degree of both together.
fn difference(first: &[DVec4], second: &[DVec4]) -> Vec<DVec4> {
    let (p, q) = (first.len() - 1, second.len() - 1);
    let [row, column] = [p, q].map(|degree| binomials(degree).iter().map(|entry| entry.value()));
    let (first, second) = (normalised(first), normalised(second));
    let mut product = vec![DVec4::ZERO; p + q + 1];
    for (i, (a, c)) in first.iter().zip(row).enumerate() {
        for (j, (b, d)) in second.iter().zip(column.clone()).enumerate() {
            let numerator = a.truncate() * b.w - b.truncate() * a.w;
            product[i + j] += numerator.extend(a.w * b.w) * c * d;
        }
    }
    for (vertex, binomial) in product.iter_mut().zip(binomials(p + q)) {
        *vertex /= binomial.value();
    }
    product
}

/// Scale a homogeneous polygon to weights of at most 1, so that products stay within range.
fn normalised(polygon: &[DVec4]) -> Vec<DVec4> {
    let largest = polygon
        .iter()
        .fold(0.0_f64, |largest, vertex| largest.max(vertex.w));
    polygon.iter().map(|vertex| *vertex / largest).collect()
}

/// Cut a Bézier polygon at t.
fn halved(mut polygon: Vec<DVec4>, t: f64) -> (Vec<DVec4>, Vec<DVec4>) {
    let mut left = polygon.clone();
    cut(&mut polygon, &mut left, |a, b| a.lerp(*b, t));
    (left, polygon)
}

/// Take the part of a Bézier polygon over \[low, high\].
fn restricted(polygon: Vec<DVec4>, low: f64, high: f64) -> Vec<DVec4> {
    let (low, high) = (low.clamp(0.0, 1.0), high.clamp(0.0, 1.0));
    let (left, _) = if high < 1.0 {
        halved(polygon, high)
    } else {
        (polygon, Vec::new())
    };
    if low > 0.0 {
        halved(left, low / high).1
    } else {
        left
    }
}

/// List `from`, the integers between and `to`.
fn breaks(from: f64, to: f64) -> Vec<f64> {
    let mut breaks = vec![from];
    let mut knot = from.floor() + 1.0;
    while knot < to {
        breaks.push(knot);
        knot += 1.0;
    }
    breaks.push(to);
    breaks
}

fn pieces(chain: &BezierPolygon) -> impl Iterator<Item = Vec<DVec4>> + '_ {
    let degree = chain.degree();
    let vertices: Vec<DVec4> = chain
        .weighted_vertices()
        .map(|(vertex, weight)| (vertex * weight).extend(weight))
        .collect();
    let segments = 0..chain.segments();
    segments.map(move |k| vertices[k * degree..=(k + 1) * degree].to_vec())
}

fn differences(a: &[DVec3], b: &[DVec3]) -> Vec<DVec3> {
    a.iter().zip(b).map(|(a, b)| *a - *b).collect()
}

/// What rounding differences of vertices may move the curve by: as a mean of vertices it moves no
/// further than they do. Vertices of high degree may be far apart though the curves are near.
fn rounding_of(differences: &[DVec3]) -> f64 {
    f64::EPSILON * vector::reach(differences)
}

fn different_knots(segments: usize, other: usize) -> PolygonError {
    PolygonError::DifferentKnots { segments, other }
}
