//! Bounds of the curvature and torsion at extrema.

use super::arena::{Arena, Polynomial};
use super::enclosure::{Enclosure, UNKNOWN, at_place, widened};
use super::feature::Feature;
use super::numerators::Numerators;
use super::scalar::Scalar;
use super::segment_shape::SegmentShape;

/// Absolute rounding error of a bound that is small itself.
const ROUNDING: f64 = 1.0 + 1e-9;

/// Bounds are close enough if they differ by this share of the value.
const CLOSE: f64 = 1e-11;

/// Whether bounds leave nothing open that is worth more work.
pub(super) fn is_known([low, high]: Enclosure) -> bool {
    let size = low.abs().max(high.abs());
    size.is_finite() && high - low <= CLOSE * size
}

/// Enclose the curvature or torsion at an extremum, which is the only one between the places
/// `ends`.
///
/// Up to it the quantity rises (a maximum) or falls, and less than w · (w · max |F′| · G), for
/// the derivative is F G, with F of the numerators, 0 at the extremum, and G = W² / S^{5/2},
/// W² / (Q^{1/2} S^{5/2}) in space, and W / Q² for the torsion: a term that hardly counts.
pub(super) fn at_extremum<T: Scalar>(
    arena: &Arena<T>,
    numerators: &Numerators,
    (shape, planar): (&SegmentShape, bool),
    quantity: Feature,
    (ends, is_maximum): ([f64; 2], bool),
) -> Enclosure {
    let value = |polynomial: Polynomial| {
        let (value, error) = arena.evaluate(polynomial, ends[0]);
        // The power that the value comes with is rounded.
        let error = error + value.abs() * f64::EPSILON * (polynomial.degree as f64 + 2.0);
        widened([value - error, value + error])
    };
    let [curvature, torsion] = at_place(value, numerators, (shape, planar));
    let width = ends[1] - ends[0];
    let reach = |polynomial: Polynomial| width * slope_bound(arena, polynomial);
    let least = |polynomial: Polynomial| (value(polynomial)[0] - reach(polynomial)).max(0.0);
    let weight = if shape.rational {
        value(numerators.weight)[1] + reach(numerators.weight)
    } else {
        1.0
    };
    let (at_start, slope, factor) = match quantity {
        Feature::CurvatureExtremum => {
            let root = if planar {
                1.0
            } else {
                least(numerators.bending).sqrt()
            };
            let speed = least(numerators.speed);
            let factor = weight * weight / (speed * speed * speed.sqrt() * root);
            (curvature, numerators.curvature_slope, factor)
        }
        _ => {
            let bending = least(numerators.bending);
            let factor = weight / (bending * bending);
            (torsion, numerators.torsion_slope, factor)
        }
    };
    let change = width * reach(slope) * factor / shape.unit * ROUNDING;
    let [low, high] = at_start;
    let bounds = if is_maximum {
        [low, (high + change).next_up()]
    } else {
        [(low - change).next_down(), high]
    };
    if bounds.iter().any(|bound| bound.is_nan()) {
        UNKNOWN
    } else {
        bounds
    }
}

/// Bound the derivative of a polynomial in scaled form on \[0, 1\].
fn slope_bound<T: Scalar>(arena: &Arena<T>, polynomial: Polynomial) -> f64 {
    2.0 * polynomial.degree as f64 * arena.bound(polynomial) * ROUNDING
}
