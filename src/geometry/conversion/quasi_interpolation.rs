//! Uniform B-splines near a curve whose knots are not theirs, vertex by vertex.
//!
//! Each new vertex takes the even derivatives of the curve of degree n at the middle of its own m
//! knots, the Greville abscissa ξ:
//!
//!   Q = Σ_k a_k h^{2k} C^{(2k)}(ξ),   Σ a_k x^{2k} = (x/2 / sinh(x/2))^{m+1},   2k ≤ n,
//!
//! h the distance of the knots. Up to 2k ≤ m this is the blossom of the Taylor polynomial at ξ,
//! so polynomials of degree m are reproduced; the terms beyond, where the curve has them, take
//! off the mean of the error. It is local, keeps the symmetry of a curve and a smooth polygon
//! smooth, and has an error of order h^{m+1}. Where ξ is a knot of the curve the mean of both
//! sides is taken; beyond the ends their polynomials are continued.

use super::exact_vertices::{ExactVertices, check_weight, converted_float, weight_loss};
use crate::geometry::basis::uniform_basis_derivative;
use crate::geometry::bezier_matrix::dot;
use crate::geometry::error::PolygonError;
use crate::geometry::expansion::Expansion;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::polygon_kind::PolygonKind;

type Number = Expansion<3>;

/// The knots of a new spline on an old curve.
pub(in crate::geometry) struct NewKnots {
    /// The degree of the spline.
    pub(in crate::geometry) degree: usize,
    /// The old parameter u of its knot 0.
    pub(in crate::geometry) start: f64,
    /// The distance of its knots in u.
    pub(in crate::geometry) step: f64,
    /// The number of its segments.
    pub(in crate::geometry) segments: usize,
    /// Whether it is periodic; the curve must be, and the knots must run round it once.
    pub(in crate::geometry) periodic: bool,
}

/// Compute the polygon on new knots.
///
/// # Errors
/// [`PolygonError::WeightLost`] and [`PolygonError::Overflow`] as for conversions,
/// [`PolygonError::TooFewVertices`] if a periodic spline of that degree needs more segments.
pub(in crate::geometry) fn quasi_interpolated(
    curve: &FloatPolygon,
    knots: &NewKnots,
) -> Result<FloatPolygon, PolygonError> {
    let rows = rows(curve, knots);
    let given = ExactVertices::<3>::of(curve);
    let vertices = given.map(|axis| {
        let around: Vec<Number> = axis.iter().chain(axis).copied().collect();
        let rows = rows.iter();
        rows.map(|(first, row)| dot(row, &around[*first..]))
            .collect()
    });
    let rounded = vertices.all_rounded();
    for ((index, weight), (_, row)) in rounded.1.iter().flatten().enumerate().zip(&rows) {
        let loses = weight_loss(magnitude(row) * given.largest_weight());
        check_weight(PolygonKind::Float, index, *weight, loses)?;
    }
    converted_float(knots.degree, rounded, knots.periodic)
}

/// For each new vertex the first old vertex that acts, and the row of weights from there on.
fn rows(curve: &FloatPolygon, knots: &NewKnots) -> Vec<(usize, Vec<Number>)> {
    let count = knots.segments + if knots.periodic { 0 } else { knots.degree };
    let factors = greville_factors(knots.degree, curve.degree() / 2, knots.step);
    let mut known: Option<(f64, bool, Vec<Number>)> = None;
    let greville = |index: usize| {
        let middle = index as f64 - 0.5 * (knots.degree as f64 - 1.0);
        knots.start + knots.step * middle
    };
    let row = |index| {
        let (segment, t) = curve.locate(greville(index));
        let at_knot = t == 0.0 && (segment > 0 || curve.is_periodic());
        let row = match &known {
            Some((last, knot, row)) if *last == t && *knot == at_knot => row.clone(),
            _ if at_knot => knot_row(curve.degree(), &factors),
            _ => taylor_row(curve.degree(), t, &factors),
        };
        known = Some((t, at_knot, row.clone()));
        // The mean at a knot begins one segment before, in a periodic curve perhaps the last.
        let before = segment.checked_sub(1).unwrap_or(curve.segments() - 1);
        (if at_knot { before } else { segment }, row)
    };
    (0..count).map(row).collect()
}

/// The numbers a_k h^{2k} for a spline of this degree, k = 0 … `last`, by which the even derivatives at
/// the Greville abscissa make a vertex: a power of the series
/// sinh(x/2) / (x/2) = Σ x^{2k} / (4^k (2k + 1)!), by the recurrence that follows from its
/// derivative.
pub(in crate::geometry) fn greville_factors(degree: usize, last: usize, step: f64) -> Vec<Number> {
    let mut sine = vec![Number::from(1.0)];
    for k in 1..=last {
        let divisor = (4 * (2 * k) * (2 * k + 1)) as f64;
        sine.push(sine[k - 1] * step * step / divisor);
    }
    let exponent = -(degree as f64 + 1.0);
    let mut power = vec![Number::from(1.0)];
    for k in 1..=last {
        let sum = (1..=k).fold(Number::default(), |sum, j| {
            let factor = exponent * j as f64 - (k - j) as f64;
            sum.plus_product(sine[j] * factor, power[k - j])
        });
        power.push(sum / k as f64);
    }
    power
}

/// The weights of the n + 1 vertices of a segment in Σ_k factor_k C^{(2k)}(t).
fn taylor_row(degree: usize, t: f64, factors: &[Number]) -> Vec<Number> {
    let mut row = vec![Number::default(); degree + 1];
    for (k, factor) in factors.iter().enumerate() {
        let values: Vec<Number> = uniform_basis_derivative(degree, 2 * k, t);
        for (entry, value) in row.iter_mut().zip(values) {
            *entry = *entry + value * *factor;
        }
    }
    row
}

/// The mean of the rows at the end of one segment and the start of the next: n + 2 weights.
fn knot_row(degree: usize, factors: &[Number]) -> Vec<Number> {
    let mut row = vec![Number::default(); degree + 2];
    for (first, t) in [(0, 1.0), (1, 0.0)] {
        let side = taylor_row(degree, t, factors);
        for (entry, value) in row[first..].iter_mut().zip(side) {
            *entry = *entry + value * 0.5;
        }
    }
    row
}

fn magnitude(row: &[Number]) -> f64 {
    row.iter().map(|entry| entry.value().abs()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_factors_are_those_of_the_series() {
        // (x/2 / sinh(x/2))^{n+1} = 1 − (n + 1)/24 x² + (n + 1)(5n + 7)/5760 x⁴ − …
        for degree in 1..=25 {
            let n = degree as f64;
            let expected = [1.0, -(n + 1.0) / 24.0, (n + 1.0) * (5.0 * n + 7.0) / 5760.0];
            for (found, expected) in greville_factors(degree, 2, 1.0).into_iter().zip(expected) {
                assert!((found.value() / expected - 1.0).abs() <= 4.0 * f64::EPSILON);
            }
        }
    }

    #[test]
    fn the_factors_make_blossoms_of_taylor_polynomials() {
        // The blossom of (u − ξ)^{2k} is the elementary symmetric mean of the knots about ξ.
        for degree in 2..=25_usize {
            let mut symmetric = vec![1.0];
            for index in 0..degree {
                let knot = index as f64 - 0.5 * (degree as f64 - 1.0);
                symmetric.push(0.0);
                for power in (1..symmetric.len()).rev() {
                    symmetric[power] += knot * symmetric[power - 1];
                }
            }
            let factors = greville_factors(degree, degree / 2, 1.0);
            for (k, factor) in factors.into_iter().enumerate() {
                let falling = (0..2 * k).fold(1.0, |f, j| f * (degree - j) as f64);
                let expected = symmetric[2 * k] / falling;
                // Summing up knots of both signs in doubles cancels some digits.
                assert!(
                    (factor.value() / expected - 1.0).abs() <= 1e-12,
                    "{degree} {k}"
                );
            }
        }
    }

    #[test]
    fn on_its_own_knots_a_spline_of_even_degree_is_reproduced() {
        // Its Greville abscissae lie in the middle of segments, on one polynomial.
        for degree in (2..=24).step_by(2) {
            let row = taylor_row(degree, 0.5, &greville_factors(degree, degree / 2, 1.0));
            for (index, entry) in row.into_iter().enumerate() {
                let expected = f64::from(u8::from(index == degree / 2));
                assert!((entry.value() - expected).abs() <= f64::EPSILON);
            }
        }
    }
}
