//! Curves with derivatives of any order by one parameter.

use glam::DVec3;

use super::error::MAX_DEGREE;
use super::float_polygon::FloatPolygon;
use super::interval::Interval;
use super::power_series::PowerSeries;

/// A curve over one parameter t that can be expanded anywhere.
pub trait Differentiable {
    /// Compute the point at t and its derivatives by t up to `order`: `order` + 1 vectors. What the curve
    /// does not have there is infinite or not a number.
    fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3>;

    /// Bound the series of the coordinates for bounds of the series of t: they hold for every t between them, so
    /// that the curve cannot leave them between samples. `None` if nothing is known of the curve between samples.
    fn enclosed(&self, _: &PowerSeries<Interval>) -> Option<[PowerSeries<Interval>; 3]> {
        None
    }
}

impl Differentiable for FloatPolygon {
    /// Beyond its ends an open curve continues its first and last segment's polynomials; at a knot the
    /// later segment counts. Of a rational curve no derivatives above the highest degree are known.
    fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3> {
        let (segment, local) = self.locate(t);
        // Distances take two derivatives, of very many points.
        if order <= 2 {
            let values = self.segment_derivatives::<3>(segment, local);
            return values[..=order].to_vec();
        }
        let known = self.segment_derivatives::<{ MAX_DEGREE + 1 }>(segment, local);
        let beyond = match self.is_rational() {
            true => DVec3::NAN,
            false => DVec3::ZERO,
        };
        let known = known.into_iter().chain(std::iter::repeat(beyond));
        known.take(order + 1).collect()
    }

    fn enclosed(&self, t: &PowerSeries<Interval>) -> Option<[PowerSeries<Interval>; 3]> {
        self.enclosed_over(t)
    }
}
