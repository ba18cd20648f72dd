//! Curvature and torsion at an end of a segment, between bounds.

use super::arena::{Arena, Polynomial};
use super::numerators::Numerators;
use super::scalar::Scalar;
use super::segment_shape::SegmentShape;

/// Rounding error of a dozen operations, with room to spare.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// An interval that is known to hold a number.
pub(super) type Enclosure = [f64; 2];

/// Nothing is known.
pub(super) const UNKNOWN: Enclosure = [f64::NEG_INFINITY, f64::INFINITY];

/// Enclose the curvature (signed in the plane) and the torsion at both ends of a segment.
pub(super) fn at_ends(
    arena: &Arena<f64>,
    numerators: &Numerators,
    shape: &SegmentShape,
    planar: bool,
) -> [[Enclosure; 2]; 2] {
    [false, true].map(|at_end| {
        let value = |polynomial: Polynomial| end_value(arena, polynomial, at_end);
        at_place(value, numerators, (shape, planar))
    })
}

/// Enclose the curvature (signed in the plane) and the torsion at a place from enclosures of
/// the numerators there: W³ D / S^{3/2}, W³ (Q / S³)^{1/2} and W² T / Q.
pub(super) fn at_place(
    value: impl Fn(Polynomial) -> Enclosure,
    numerators: &Numerators,
    (shape, planar): (&SegmentShape, bool),
) -> [Enclosure; 2] {
    let per_length = 1.0 / shape.unit;
    let weight = if shape.rational {
        value(numerators.weight)
    } else {
        [1.0, 1.0]
    };
    let speed = value(numerators.speed);
    if speed[0] <= 0.0 || weight[0] <= 0.0 {
        return [UNKNOWN; 2];
    }
    let bending = value(numerators.bending);
    let root = if planar {
        value(numerators.curvature)
    } else {
        bending.map(|square| square.max(0.0).sqrt())
    };
    let cube = |bounds: Enclosure| bounds.map(|bound| bound * bound * bound);
    let cubed_speed = cube(speed.map(f64::sqrt));
    let curvature = times(divided(root, cubed_speed), cube(weight), per_length);
    let torsion = if !planar && bending[0] > 0.0 {
        let square = weight.map(|bound| bound * bound);
        let share = divided(value(numerators.torsion), bending);
        times(share, square, per_length)
    } else {
        UNKNOWN
    };
    [curvature, torsion]
}

/// Bound a polynomial in scaled form at an end, where its binomial coefficient is 1.
fn end_value(arena: &Arena<f64>, polynomial: Polynomial, at_end: bool) -> Enclosure {
    let (values, errors) = arena.coefficients(polynomial);
    let index = if at_end { polynomial.degree } else { 0 };
    let (value, error) = values
        .get(index)
        .zip(errors.get(index))
        .unwrap_or((&0.0, &0.0));
    widened([value.rounded() - error, value.rounded() + error])
}

/// Take the part that two enclosures of one number share.
pub(super) fn narrower(a: Enclosure, b: Enclosure) -> Enclosure {
    [a[0].max(b[0]), a[1].min(b[1])]
}

/// Divide by an interval of positive numbers.
fn divided(a: Enclosure, b: Enclosure) -> Enclosure {
    let low = if a[0] < 0.0 { b[0] } else { b[1] };
    let high = if a[1] < 0.0 { b[1] } else { b[0] };
    widened([a[0] / low, a[1] / high])
}

/// Multiply by an interval of positive numbers and a positive number.
fn times(a: Enclosure, b: Enclosure, factor: f64) -> Enclosure {
    let low = if a[0] < 0.0 { b[1] } else { b[0] };
    let high = if a[1] < 0.0 { b[0] } else { b[1] };
    let product = widened([a[0] * low * factor, a[1] * high * factor]);
    if product.iter().any(|bound| bound.is_nan()) {
        UNKNOWN
    } else {
        product
    }
}

/// Widen bounds by the rounding of their computation.
pub(super) fn widened([low, high]: Enclosure) -> Enclosure {
    // An exact 0 stays exact.
    let tiny = |bound: f64| if bound == 0.0 { 0.0 } else { f64::MIN_POSITIVE };
    let by = |bound: f64| ROUNDING * bound.abs() + tiny(bound);
    [low - by(low), high + by(high)]
}
