//! Lengths and directions of vectors whose squares would leave the range of numbers, and the larger
//! of two lengths.

use std::borrow::Borrow;

use glam::DVec3;

/// Components between this and its inverse can be squared and cubed without harm.
const SMALL: f64 = 1e-50;

/// Measure |v|, also where the squares of its components overflow or vanish.
pub(super) fn length(vector: DVec3) -> f64 {
    let largest = vector.abs().max_element();
    if is_moderate(largest) {
        vector.length()
    } else {
        largest * (vector / largest).length()
    }
}

/// Find the direction of a vector; `None` if it is zero or not finite.
pub(super) fn direction(vector: DVec3) -> Option<DVec3> {
    let (scaled, _) = scaled(vector);
    scaled.try_normalize()
}

/// Write a vector as (v, factor) with v · factor the vector and v of a size that can be squared
/// and cubed. Vectors of such a size, zero among them, come back as they are, with factor 1.
pub(super) fn scaled(vector: DVec3) -> (DVec3, f64) {
    let largest = vector.abs().max_element();
    if is_moderate(largest) {
        (vector, 1.0)
    } else {
        (vector / largest, largest)
    }
}

/// The larger of two numbers; infinite if one is none, which `f64::max` would pass over.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::INFINITY
    } else {
        a.max(b)
    }
}

/// Find the corners of the smallest box that holds points, inside out if there are none.
pub fn bounds(points: impl IntoIterator<Item = impl Borrow<DVec3>>) -> (DVec3, DVec3) {
    let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let points = points.into_iter();
    points.fold(none, |(low, high), point| {
        (low.min(*point.borrow()), high.max(*point.borrow()))
    })
}

/// Widen a box by a point, unless it is not finite.
pub fn widen(bounds: &mut Option<[DVec3; 2]>, point: DVec3) {
    if point.is_finite() {
        let [low, high] = bounds.unwrap_or([point; 2]);
        *bounds = Some([low.min(point), high.max(point)]);
    }
}

/// The largest absolute coordinate of points.
pub(super) fn reach(points: impl IntoIterator<Item = impl Borrow<DVec3>>) -> f64 {
    let reach = points
        .into_iter()
        .map(|point| point.borrow().abs().max_element());
    reach.fold(0.0, f64::max)
}

fn is_moderate(largest: f64) -> bool {
    largest == 0.0 || !largest.is_finite() || (SMALL..=1.0 / SMALL).contains(&largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_and_directions_hold_over_the_whole_range_of_numbers() {
        for scale in [1e-308, 1e-300, 1e-160, 1.0, 1e160, 1e300] {
            let vector = DVec3::new(2.0, -3.0, 6.0) * scale;
            let relative = length(vector) / (7.0 * scale) - 1.0;
            assert!(
                relative.abs() <= 4.0 * f64::EPSILON,
                "{scale:e}: {relative:e}"
            );
            let along = direction(vector).map(|unit| unit * 7.0);
            let expected = DVec3::new(2.0, -3.0, 6.0);
            assert!(along.is_some_and(|along| along.distance(expected) <= 1e-14));
        }
        assert_eq!(direction(DVec3::ZERO), None);
        assert_eq!(length(DVec3::ZERO), 0.0);
    }
}
