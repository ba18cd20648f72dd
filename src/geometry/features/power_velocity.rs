//! Curves in space whose velocity is a power of a linear function, as that of a Bézier curve on a
//! Mineur–Farin configuration: C′ = n ((1 − t) I + t M)ⁿ⁻¹ a with M = s R, R a rotation.
//!
//! Along the axis of R, and as a complex number across it, the velocity is n (α pⁿ⁻¹, β zⁿ⁻¹) with p real and z
//! complex, both linear. With P = p², q = |z|² and m = n − 2 the square of the curvature is a positive
//! multiple of
//!
//!   q^m D₁ / D₂³,   D₁ = b w q^m + a P^m,   D₂ = a P^{m+1} + b q^{m+1},
//!
//! where a = α², b = |β|² and w is the square of the cosine of half the angle of R. Its derivative has the signs
//! of
//!
//!   m q′ D₁ D₂ + q D₁′ D₂ − 3 q D₁ D₂′,
//!
//! a polynomial of degree 4n − 5.

use super::arena::{Arena, Polynomial};
use super::feature::Verdict;
use super::isolation::{Doubt, isolate};
use super::ring::Ring;
use super::scalar::Scalar;
use super::segment_features::SegmentProver;
use super::sign_piece::{Sign, SignPiece};
use crate::geometry::expansion::DoubleDouble;

/// Least distance of the squared cosine from 0 and 1 at which q has no zero.
const CLEAR: f64 = 1e-12;

/// What the arithmetic of wide numbers adds to what the coefficients of P and q are made of, relative to their
/// size.
const ROUNDING: f64 = f64::EPSILON * f64::EPSILON * 64.0;

/// Hold a velocity of which the direction and the size turn with a power. The doubles given count as exact.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct PowerVelocity {
    /// The square of the part of the unit quaternion of R along the first leg: a, but for a factor of both.
    pub(in crate::geometry) along: f64,
    /// The square of its part across that leg, b; with the square w of its real part all three sum up to 1.
    pub(in crate::geometry) across: f64,
    /// The factor s > 0 that M stretches by.
    pub(in crate::geometry) ratio: f64,
    /// The degree n of the curve.
    pub(in crate::geometry) degree: usize,
}

impl SegmentProver {
    /// Prove whether the curvature for t in \[0, 1\] is monotone; what twice the digits leave in doubt, and curves
    /// of less than degree 3, straight and planar ones, are undecided.
    pub(in crate::geometry) fn power_velocity(&mut self, velocity: &PowerVelocity) -> Verdict {
        let cosine = velocity.cosine().high();
        let turns = cosine > CLEAR && cosine < 1.0 - CLEAR;
        if !turns || velocity.degree < 3 || !(velocity.across > 0.0 && velocity.along > 0.0) {
            return Verdict::Undecided;
        }
        let pieces = velocity.signs(&mut self.quick);
        let pieces = pieces.or_else(|_| velocity.signs(&mut self.precise));
        match pieces {
            Err(_) => Verdict::Undecided,
            Ok(pieces) => match pieces.iter().any(|it| matches!(it.sign, Sign::Root { .. })) {
                true => Verdict::Disproved,
                false => Verdict::Proved,
            },
        }
    }
}

/// A square, its slope, and its powers from 0 to m + 1.
struct Powers {
    square: Polynomial,
    slope: Polynomial,
    powers: Vec<Polynomial>,
}

impl PowerVelocity {
    /// The square w of the cosine of half the angle of R.
    fn cosine(&self) -> DoubleDouble {
        DoubleDouble::difference(1.0, self.along) + -DoubleDouble::from(self.across)
    }

    /// Find the signs of the derivative of the curvature.
    fn signs<T: Scalar>(&self, arena: &mut Arena<T>) -> Result<Vec<SignPiece>, Doubt> {
        arena.clear();
        let slope = self.curvature_slope(arena);
        let mut pieces = Vec::new();
        isolate(arena, slope, &mut pieces)?;
        Ok(pieces)
    }

    /// Multiply out the polynomial that has the signs of the derivative of the curvature.
    fn curvature_slope<T: Scalar>(&self, arena: &mut Arena<T>) -> Polynomial {
        let m = self.degree - 2;
        let [across, along] = [self.across, self.along].map(DoubleDouble::from);
        let mut constant =
            |number: DoubleDouble| arena.plain(&[number], &[ROUNDING * number.high()]);
        let [bent, flat, round] = [across * self.cosine(), along, across].map(&mut constant);
        // q has the coefficients 1, s cos φ and s², P has 1, s and s².
        let ratio = DoubleDouble::from(self.ratio);
        let cosine = self.cosine() + self.cosine() + DoubleDouble::from(-1.0);
        let ends = [
            DoubleDouble::from(1.0),
            DoubleDouble::product(self.ratio, self.ratio),
        ];
        let sizes = [ends[0], ratio, ends[1]];
        let q = powers(arena, [ends[0], ratio * cosine, ends[1]], sizes, m);
        let p = powers(arena, sizes, sizes, m);
        let mut sum = |terms: &[(i32, &Polynomial, &Polynomial)]| arena.sum_of_products(terms);
        let numerator = sum(&[(1, &bent, &q.powers[m]), (1, &flat, &p.powers[m])]);
        let denominator = sum(&[(1, &flat, &p.powers[m + 1]), (1, &round, &q.powers[m + 1])]);
        let bent = sum(&[(1, &bent, &q.slope)]);
        let flat = sum(&[(1, &flat, &p.slope)]);
        let round = sum(&[(1, &round, &q.slope)]);
        // D₁′ / m and D₂′ / (m + 1).
        let numerator_slope = sum(&[(1, &bent, &q.powers[m - 1]), (1, &flat, &p.powers[m - 1])]);
        let denominator_slope = sum(&[(1, &flat, &p.powers[m]), (1, &round, &q.powers[m])]);
        let rising = sum(&[(1, &q.slope, &numerator), (1, &q.square, &numerator_slope)]);
        let whole = sum(&[(1, &q.square, &numerator)]);
        let m = m as i32;
        sum(&[
            (m, &rising, &denominator),
            (-3 * (m + 1), &whole, &denominator_slope),
        ])
    }
}

/// Multiply a square, given by its Bernstein coefficients, which are rounded in units of `sizes`, up to its power
/// m + 1. A power of two brings the largest size to 1.
fn powers<T: Scalar>(
    arena: &mut Arena<T>,
    square: [DoubleDouble; 3],
    sizes: [DoubleDouble; 3],
    m: usize,
) -> Powers {
    let largest = sizes[2].high().max(1.0);
    let unit = (-largest.log2().ceil()).exp2();
    let square = square.map(|coefficient| coefficient.scaled(unit));
    let bounds = sizes.map(|size| ROUNDING * size.high() * unit);
    let plain = arena.plain(&square, &bounds);
    let slope = arena.derivative(plain);
    let [square, slope] = [plain, slope].map(|polynomial| arena.scale(polynomial));
    let mut powers = vec![arena.plain(&[DoubleDouble::from(1.0)], &[0.0])];
    for index in 0..=m {
        let next = arena.sum_of_products(&[(1, &powers[index], &square)]);
        powers.push(next);
    }
    Powers {
        square,
        slope,
        powers,
    }
}
