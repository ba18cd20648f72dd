//! Exact arithmetic: segments of curves as polynomials with whole coefficients, their roots with
//! multiplicities, and from them the true features of whole curves.
//!
//! It works in powers of t, takes multiplicities out with greatest common divisors modulo primes,
//! and differentiates Wronskians; the library works in Bernstein form and differentiates
//! homogeneous vectors.
#![allow(dead_code, unused_imports)] // Each test uses a part of it.

mod common_factor;
mod fraction;
mod isolation;
mod modular;
mod polynomial;
mod segment;
mod truth;

pub use fraction::Fraction;
pub use isolation::Root;
pub use polynomial::Polynomial;
pub use segment::ExactSegment;
pub use truth::{Change, Place, Singular, Truth};

use num_bigint::BigInt;
use num_rational::BigRational;

/// A double as the rational number it is.
pub fn exact(value: f64) -> BigRational {
    BigRational::from_float(value).expect("a finite number")
}

/// 2^exponent.
pub fn power_of_two(exponent: i64) -> BigRational {
    let power = BigInt::from(1) << exponent.unsigned_abs();
    if exponent < 0 {
        BigRational::new(BigInt::from(1), power)
    } else {
        BigRational::from_integer(power)
    }
}
