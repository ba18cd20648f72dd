//! Numbers that power series have as coefficients.

use std::cmp::Ordering;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Coefficient of a power series: a number, or the bounds of one. A series of bounds encloses that of every number
/// between them, so its arithmetic proves what the same arithmetic of numbers only samples.
pub trait Coefficient:
    Copy
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A coefficient of which nothing is known.
    const UNKNOWN: Self;

    /// A number as it is.
    fn of(number: f64) -> Self;

    /// The value of a function that rises, computed to a few roundings.
    fn rising(self, function: impl Fn(f64) -> f64) -> Self;

    /// Two functions whose slopes are nowhere above 1 or below −1, computed with their largest error.
    fn moving(self, functions: impl Fn(f64) -> ([f64; 2], f64)) -> [Self; 2];

    /// The square, which is never negative.
    fn squared(self) -> Self;

    /// The natural logarithm.
    fn ln(self) -> Self;

    /// A power with a fixed exponent.
    fn power(self, exponent: f64) -> Self;

    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);

    /// The hyperbolic cosine.
    fn cosh(self) -> Self;

    /// The tangent.
    fn tan(self) -> Self;

    /// The slope of the hyperbolic tangent, 1/cosh², which 1 − tanh² would lose far from 0.
    fn tanh_slope(self) -> Self;

    /// The arc sine.
    fn asin(self) -> Self;

    /// The arc cosine.
    fn acos(self) -> Self;

    /// The angle of the vector (x, y) for `self` = y.
    fn direction(self, x: Self) -> Self;

    /// Which of two is larger; `None` if that is not certain.
    fn compared(self, other: Self) -> Option<Ordering>;

    /// The smaller one of two.
    fn lower(self, other: Self) -> Self;

    /// Bounds of both; of two numbers nothing is known.
    fn either(self, other: Self) -> Self;
}

impl Coefficient for f64 {
    const UNKNOWN: Self = Self::NAN;

    fn of(number: f64) -> Self {
        number
    }

    fn rising(self, function: impl Fn(f64) -> f64) -> Self {
        function(self)
    }

    fn moving(self, functions: impl Fn(f64) -> ([f64; 2], f64)) -> [Self; 2] {
        functions(self).0
    }

    fn squared(self) -> Self {
        self * self
    }

    fn ln(self) -> Self {
        self.ln()
    }

    fn power(self, exponent: f64) -> Self {
        self.powf(exponent)
    }

    fn sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }

    fn cosh(self) -> Self {
        self.cosh()
    }

    fn tan(self) -> Self {
        self.tan()
    }

    fn tanh_slope(self) -> Self {
        let inverse = self.cosh().recip();
        inverse * inverse
    }

    fn asin(self) -> Self {
        self.asin()
    }

    fn acos(self) -> Self {
        self.acos()
    }

    fn direction(self, x: Self) -> Self {
        self.atan2(x)
    }

    fn compared(self, other: Self) -> Option<Ordering> {
        self.partial_cmp(&other)
    }

    fn lower(self, other: Self) -> Self {
        if self.is_nan() { self } else { self.min(other) }
    }

    fn either(self, _: Self) -> Self {
        Self::UNKNOWN
    }
}
