//! Number types of the polynomial arithmetic.

use std::ops::{Add, Div, Mul};

use crate::geometry::expansion::DoubleDouble;

/// The smallest error bound of a number that is not an exact 0. Curves come normalised to
/// size 1, so that products of two such bounds, and their roundings, stay within the range of
/// numbers.
pub(super) const FLOOR: f64 = 1.0 / (1_u128 << 100) as f64 / (1_u128 << 100) as f64;

/// A type of floating-point number whose operations have a known error.
pub(super) trait Scalar:
    Copy + Default + Add<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// A bound of the error of one operation, relative to the result; of a sum, to the sum of its
    /// terms' magnitudes.
    const UNIT: f64;

    /// A bound of the relative error of an entry of a table.
    const TABLE_ERROR: f64;

    /// Convert from the wide type, rounding.
    fn from_wide(value: DoubleDouble) -> Self;

    /// The rounding error of that conversion.
    fn conversion_error(value: DoubleDouble) -> f64;

    /// The nearest double.
    fn rounded(self) -> f64;

    /// Bound the absolute value from above, up to a relative 2⁻⁵⁰.
    fn magnitude(self) -> f64 {
        self.rounded().abs()
    }
}

impl Scalar for f64 {
    const UNIT: f64 = f64::EPSILON / 2.0;
    const TABLE_ERROR: f64 = Self::UNIT + DoubleDouble::TABLE_ERROR;

    #[inline]
    fn from_wide(value: DoubleDouble) -> Self {
        value.high()
    }

    #[inline]
    fn conversion_error(value: DoubleDouble) -> f64 {
        value.low().abs()
    }

    #[inline]
    fn rounded(self) -> f64 {
        self
    }
}

impl Scalar for DoubleDouble {
    // 2⁻¹⁰².
    const UNIT: f64 = f64::EPSILON * f64::EPSILON * 4.0;
    const TABLE_ERROR: f64 = Self::UNIT;

    #[inline]
    fn from_wide(value: DoubleDouble) -> Self {
        value
    }

    #[inline]
    fn conversion_error(_: DoubleDouble) -> f64 {
        0.0
    }

    #[inline]
    fn rounded(self) -> f64 {
        self.high()
    }
}
