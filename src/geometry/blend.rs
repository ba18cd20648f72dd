//! Means of two values with whole weights.

use glam::DVec4;

/// What conversions, bases and cuts work on: coordinates, points, coordinates of many digits, and
/// exact ones.
pub trait Blend {
    /// Compute (p·a + q·b) / divisor.
    fn blend(p: f64, a: &Self, q: f64, b: &Self, divisor: f64) -> Self;
}

impl Blend for f64 {
    #[inline(always)]
    fn blend(p: f64, a: &Self, q: f64, b: &Self, divisor: f64) -> Self {
        (p * *a + q * *b) / divisor
    }
}

impl Blend for DVec4 {
    #[inline(always)]
    fn blend(p: f64, a: &Self, q: f64, b: &Self, divisor: f64) -> Self {
        (p * *a + q * *b) / divisor
    }
}
