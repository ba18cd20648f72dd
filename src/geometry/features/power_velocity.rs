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

use super::feature::Verdict;
use super::isolation::isolate;
use super::ring::Ring;
use super::segment_features::SegmentProver;
use super::sign_piece::Sign;

/// How far from 0 and 1 the square of the cosine must be, so that q has no zero.
const CLEAR: f64 = 1e-12;

/// What rounding the coefficients of P and q may add to each, relative to its size.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Hold a velocity of which the direction and the size turn with a power.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct PowerVelocity {
    /// The square a of the part along the axis.
    pub(in crate::geometry) along: f64,
    /// The square b of the part across it.
    pub(in crate::geometry) across: f64,
    /// The square w of the cosine of half the angle that M rotates by.
    pub(in crate::geometry) cosine: f64,
    /// The factor s > 0 that M stretches by.
    pub(in crate::geometry) ratio: f64,
    /// The degree n of the curve.
    pub(in crate::geometry) degree: usize,
}

impl SegmentProver {
    /// Prove whether the curvature for t in \[0, 1\] is monotone; what rounding leaves in doubt, and curves of
    /// less than degree 3, straight and planar ones, are undecided.
    pub(in crate::geometry) fn power_velocity(&mut self, velocity: &PowerVelocity) -> Verdict {
        let PowerVelocity {
            along,
            across,
            cosine,
            ratio,
            degree,
        } = *velocity;
        let turns = cosine > CLEAR && cosine < 1.0 - CLEAR && across > 0.0 && along > 0.0;
        if !turns || degree < 3 {
            return Verdict::Undecided;
        }
        let arena = &mut self.quick;
        arena.clear();
        let power = degree - 2;
        let sizes = [1.0, ratio, ratio * ratio].map(|size| size / ratio.max(1.0).powi(2));
        let bounds = sizes.map(|size| ROUNDING * size);
        let linear = [sizes[0], sizes[1] * (2.0 * cosine - 1.0), sizes[2]];
        let mut constant = |number: f64| arena.plain(&[number], &[ROUNDING * number]);
        let weights = [constant(across * cosine), constant(along), constant(across)];
        let one = arena.plain(&[1.0], &[0.0]);
        // q and P, their slopes and powers up to m + 1.
        let bases = [linear, sizes].map(|coefficients| {
            let plain = arena.plain(&coefficients, &bounds);
            let slope = arena.derivative(plain);
            let [base, slope] = [plain, slope].map(|it| arena.scale(it));
            let mut powers = vec![one];
            for index in 0..=power {
                let next = arena.sum_of_products(&[(1, &powers[index], &base)]);
                powers.push(next);
            }
            (base, slope, powers)
        });
        let [(square, square_slope, squares), (_, flat_slope, flats)] = &bases;
        let [bent, flat, round] = &weights;
        let numerator = arena.sum_of_products(&[(1, bent, &squares[power]), (1, flat, &flats[power])]);
        let denominator =
            arena.sum_of_products(&[(1, flat, &flats[power + 1]), (1, round, &squares[power + 1])]);
        let [bent, flat_change, round] = [(bent, square_slope), (flat, flat_slope), (round, square_slope)]
            .map(|(weight, slope)| arena.sum_of_products(&[(1, weight, slope)]));
        // D₁′ / m and D₂′ / (m + 1).
        let below = power - 1;
        let numerator_slope =
            arena.sum_of_products(&[(1, &bent, &squares[below]), (1, &flat_change, &flats[below])]);
        let denominator_slope =
            arena.sum_of_products(&[(1, &flat_change, &flats[power]), (1, &round, &squares[power])]);
        let rising =
            arena.sum_of_products(&[(1, square_slope, &numerator), (1, square, &numerator_slope)]);
        let whole = arena.sum_of_products(&[(1, square, &numerator)]);
        let power = power as i32;
        let slope = arena.sum_of_products(&[
            (power, &rising, &denominator),
            (-3 * (power + 1), &whole, &denominator_slope),
        ]);
        let mut pieces = Vec::new();
        match isolate(arena, slope, &mut pieces) {
            Err(_) => Verdict::Undecided,
            Ok(()) => match pieces.iter().any(|it| matches!(it.sign, Sign::Root { .. })) {
                true => Verdict::Disproved,
                false => Verdict::Proved,
            },
        }
    }
}
