//! Curves with derivatives of any order by one parameter.

use glam::DVec3;

/// A curve over one parameter t that can be expanded anywhere.
pub trait Differentiable {
    /// Compute the point at t and its derivatives by t up to `order`: `order` + 1 vectors. What the curve
    /// does not have there is infinite or not a number.
    fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3>;
}
