//! Curves with derivatives of any order by one parameter.

use glam::DVec3;

use super::error::MAX_DEGREE;
use super::float_polygon::FloatPolygon;

/// A curve over one parameter t that can be expanded anywhere.
pub trait Differentiable {
    /// Compute the point at t and its derivatives by t up to `order`: `order` + 1 vectors. What the curve
    /// does not have there is infinite or not a number.
    fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3>;
}

impl Differentiable for FloatPolygon {
    /// Beyond its ends an open curve continues its first and last segment's polynomials; at a knot the
    /// later segment counts. Of a rational curve no derivatives above the highest degree are known.
    fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3> {
        let (segment, local) = self.locate(t);
        let known = self.segment_derivatives::<{ MAX_DEGREE + 1 }>(segment, local);
        let beyond = match self.is_rational() {
            true => DVec3::NAN,
            false => DVec3::ZERO,
        };
        let known = known.into_iter().chain(std::iter::repeat(beyond));
        known.take(order + 1).collect()
    }
}
