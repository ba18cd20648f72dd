//! A forecast of where the numbers of features change along a ray that a vertex goes.

use std::ops::Range;

use glam::{DVec2, DVec3};

use super::numerators::{Derivatives, dot};
use super::ring::Ring;
use crate::geometry::cut::cut;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;

/// Evenly spaced samples of each segment.
const SAMPLES: usize = 31;

/// Samples beside its knots, where features come in threes as one passes: from the knot, in the
/// segment's parameter. On a knot itself a root would change the signs of both of its sides at once.
const BESIDE_KNOTS: [f64; 3] = [1e-5, 1e-3, 1e-2];

/// Precision of a change, as a share of the ray.
const PRECISION: f64 = 1e-6;

/// Cut off the middle, where a root of symmetrical curves would lie on it.
const CUT: f64 = 0.53125;

/// Forecast of a vertex's effect on the signs of curvature and its slope at samples of a planar curve.
///
/// All derivatives of the curve are linear in the vertex, so along a ray the numerator of the
/// curvature is linear in the distance at every sample, and that of its slope of degree 3: their
/// signs change at roots that are found without evaluating the curve again. A pair of features
/// that lies between two samples is not seen; what is seen is not proved.
#[derive(Debug)]
pub(in crate::geometry) struct RayForecast {
    samples: Vec<Sample>,
    /// Whether the last sample is followed by the first.
    is_cyclic: bool,
}

/// A place of the curve: its first three derivatives, and how far a vertex takes each along.
#[derive(Clone, Copy, Debug)]
struct Sample {
    derivatives: [DVec2; 3],
    influence: [f64; 3],
}

/// A polynomial of degree 3 in the share of the ray, by rising powers.
type RayPolynomial = [f64; 4];

impl RayForecast {
    /// Sample the segments that depend on a vertex.
    ///
    /// # Errors
    /// [`PolygonError`] if the vertex does not exist.
    pub(in crate::geometry) fn new(
        polygon: &FloatPolygon,
        vertex: usize,
    ) -> Result<Self, PolygonError> {
        let mut single = vec![DVec3::ZERO; polygon.vertices().len()];
        let count = single.len();
        let missing = PolygonError::NoSuchVertex {
            index: vertex,
            count,
        };
        *single.get_mut(vertex).ok_or(missing)? = DVec3::X;
        let (degree, weights) = (polygon.degree(), polygon.weights().map(<[f64]>::to_vec));
        let influence = FloatPolygon::new(degree, single, weights, polygon.is_periodic())?;
        let mut samples = Vec::new();
        let segments = in_order(polygon, vertex);
        for segment in segments.clone() {
            let segment = segment % polygon.segments();
            for t in parameters(polygon, segment) {
                let jet = polygon.segment_jet(segment, t);
                let own = influence.segment_jet(segment, t);
                samples.push(Sample {
                    derivatives: [jet.first, jet.second, jet.third].map(DVec3::truncate),
                    influence: [own.first.x, own.second.x, own.third.x],
                });
            }
        }
        Ok(Self {
            samples,
            is_cyclic: polygon.is_periodic() && segments.len() == polygon.segments(),
        })
    }

    /// List the distances along a ray, in rising order, at which a number of features changes as far
    /// as the samples show.
    pub(in crate::geometry) fn changes(&self, direction: DVec2, limit: f64) -> Vec<f64> {
        let numerators = self.samples.iter();
        let numerators = numerators.map(|sample| sample.numerators(direction, limit));
        let (curvature, slope): (Vec<_>, Vec<_>) = numerators.unzip();
        let mut changes = Vec::new();
        for function in [curvature, slope] {
            self.append_changes(&function, &mut changes);
        }
        changes.sort_by(f64::total_cmp);
        changes.iter().map(|share| share * limit).collect()
    }

    /// Append the shares of the ray at which the number of sign changes along the samples changes.
    fn append_changes(&self, function: &[RayPolynomial], changes: &mut Vec<f64>) {
        // A sample where the function is 0 tells nothing.
        let known = function.iter().filter(|values| values[0] != 0.0);
        let known: Vec<&RayPolynomial> = known.collect();
        let mut signs: Vec<bool> = known.iter().map(|values| values[0] > 0.0).collect();
        let mut flips: Vec<(f64, usize)> = Vec::new();
        let mut roots = Vec::new();
        for (index, values) in known.iter().enumerate() {
            roots.clear();
            append_roots(bernstein(values), [0.0, 1.0], &mut roots);
            flips.extend(roots.iter().map(|root| (*root, index)));
        }
        flips.sort_by(|a, b| a.0.total_cmp(&b.0));
        let count = signs.len();
        for (share, index) in flips {
            let before = (index > 0 || self.is_cyclic).then(|| signs[(index + count - 1) % count]);
            let behind = (index + 1 < count || self.is_cyclic).then(|| signs[(index + 1) % count]);
            let own = signs[index];
            let differing = |own: bool| {
                let neighbours = [before, behind].into_iter().flatten();
                neighbours.filter(|sign| *sign != own).count()
            };
            if differing(own) != differing(!own) {
                changes.push(share);
            }
            signs[index] = !own;
        }
    }
}

impl Sample {
    /// The numerators of curvature and slope along a ray.
    fn numerators(&self, direction: DVec2, limit: f64) -> (RayPolynomial, RayPolynomial) {
        let vector = |order: usize| {
            let (start, by) = (
                self.derivatives[order] / limit,
                self.influence[order] * direction,
            );
            [
                [start.x, by.x, 0.0, 0.0],
                [start.y, by.y, 0.0, 0.0],
                NOTHING,
            ]
        };
        let derivatives = Derivatives {
            curve: [[NOTHING; 3], vector(0), vector(1), vector(2), [NOTHING; 3]],
            weight: None,
        };
        let ring = &mut RayRing;
        let [tangent, change] = [1, 2].map(|order| derivatives.tangent(ring, order));
        let [bend, bend_slope] = [2, 3].map(|order| {
            let [.., upwards] = derivatives.normal(ring, (&tangent, &None), order);
            upwards
        });
        let speed = dot(ring, &tangent, &tangent);
        let change = dot(ring, &tangent, &change);
        let slope = derivatives.slope(ring, 3, [&bend, &bend_slope], [&speed, &change]);
        (bend, slope)
    }
}

const NOTHING: RayPolynomial = [0.0; 4];

/// Polynomials in the share of a ray: what is of a degree above 3 vanishes, as a vector is parallel to
/// itself.
struct RayRing;

impl Ring for RayRing {
    type Polynomial = RayPolynomial;

    fn sum_of_products(
        &mut self,
        terms: &[(i32, &RayPolynomial, &RayPolynomial)],
    ) -> RayPolynomial {
        let mut sum = NOTHING;
        for (factor, a, b) in terms {
            for (i, a) in a.iter().enumerate() {
                for (sum, b) in sum[i..].iter_mut().zip(*b) {
                    *sum += f64::from(*factor) * a * b;
                }
            }
        }
        sum
    }
}

/// List the parameters at which a segment is sampled, in rising order. Where the curve ends there is a
/// sample at its end.
fn parameters(polygon: &FloatPolygon, segment: usize) -> Vec<f64> {
    let ends = |is_outermost: bool| is_outermost && !polygon.is_periodic();
    let mut parameters = Vec::with_capacity(SAMPLES + 2 * BESIDE_KNOTS.len() + 2);
    parameters.extend(ends(segment == 0).then_some(0.0));
    parameters.extend(BESIDE_KNOTS);
    let even = 1..=SAMPLES;
    parameters.extend(even.map(|step| step as f64 / (SAMPLES + 1) as f64));
    parameters.extend(BESIDE_KNOTS.iter().rev().map(|beside| 1.0 - beside));
    parameters.extend(ends(segment + 1 == polygon.segments()).then_some(1.0));
    parameters
}

/// The segments that depend on a vertex in the order of the curve, with half of the one before and
/// behind; on a periodic curve they count on behind its end.
fn in_order(polygon: &FloatPolygon, vertex: usize) -> Range<usize> {
    let (degree, segments) = (polygon.degree(), polygon.segments());
    if !polygon.is_periodic() {
        return vertex.saturating_sub(degree + 1)..(vertex + 2).min(segments);
    }
    let length = (degree + 3).min(segments);
    let first = (vertex + 2 * segments - (degree + 1) % segments) % segments;
    first..first + length
}

/// Write a polynomial by its Bernstein coefficients on \[0, 1\].
fn bernstein([a, b, c, d]: &RayPolynomial) -> RayPolynomial {
    [*a, a + b / 3.0, a + (2.0 * b + c) / 3.0, a + b + c + d]
}

/// Append where a polynomial, given by its Bernstein coefficients on a piece, changes its sign.
fn append_roots(coefficients: RayPolynomial, [low, high]: [f64; 2], roots: &mut Vec<f64>) {
    let [first, .., last] = coefficients;
    let alike = |sign: fn(&f64) -> bool| coefficients.iter().all(sign);
    if alike(|value| *value >= 0.0) || alike(|value| *value <= 0.0) {
        return;
    }
    if high - low <= PRECISION {
        if (first > 0.0) != (last > 0.0) {
            roots.push(0.5 * (low + high));
        }
        return;
    }
    if !coefficients.iter().all(|value| value.is_finite()) {
        return;
    }
    let (mut behind, mut before) = (coefficients, NOTHING);
    cut(&mut behind, &mut before, |a, b| a + CUT * (b - a));
    let middle = low + CUT * (high - low);
    append_roots(before, [low, middle], roots);
    append_roots(behind, [middle, high], roots);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_a_cubic_are_found_in_order() {
        // (x − 1/5)(x − 1/2)(x − 4/5)
        let cubic = [-0.08, 0.66, -1.5, 1.0];
        let mut roots = Vec::new();
        append_roots(bernstein(&cubic), [0.0, 1.0], &mut roots);
        assert_eq!(roots.len(), 3, "{roots:?}");
        for (root, expected) in roots.iter().zip([0.2, 0.5, 0.8]) {
            assert!((root - expected).abs() <= PRECISION, "{root}");
        }
        // A double root changes no sign.
        roots.clear();
        append_roots(bernstein(&[0.25, -1.0, 1.0, 0.0]), [0.0, 1.0], &mut roots);
        assert!(roots.is_empty(), "{roots:?}");
    }
}
