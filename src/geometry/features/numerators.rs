//! The polynomials whose signs are those of curvature, torsion and their derivatives.
//!
//! With H = (C, W) the homogeneous curve (W = 1 if polynomial), A = C′W − CW′ and L = C × C′,
//!
//! - N = A × C″ + L W″, of which a planar curve has one component, D: κ = W³ |N| / |A|³;
//! - N̂ = A × C‴ + L W‴ = N′, M = −L · C″, M̂ = −L · C‴;
//! - T = N · C‴ + M W‴ and T′ = N · C⁗ + M W⁗: τ = W² T / |N|².
//!
//! With S = A·A, B = A·A′, Q = N·N and R = N·N′ the derivatives have the signs of
//!
//! - κ′ in the plane: (3 W′D + W D′) S − 3 W D B;
//! - κ′ in space: (3 W′Q + W R) S − 3 W Q B;
//! - τ′: (2 W′T + W T′) Q − 2 W T R.
//!
//! Where A = 0 (a cusp) D, T and both derivatives vanish to at least the second order, and T and
//! the numerator of τ′ do so where N = 0: a simple root of any of them is an ordinary point.

use super::arena::{Arena, Polynomial};
use super::feature::Quantity;
use super::scalar::Scalar;
use super::segment_shape::SegmentShape;

/// Name the numerators of one segment, in scaled Bernstein form.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numerators {
    /// The signed curvature of a planar curve.
    pub(super) curvature: Polynomial,
    /// The derivative of the curvature.
    pub(super) curvature_slope: Polynomial,
    /// The torsion.
    pub(super) torsion: Polynomial,
    /// The derivative of the torsion.
    pub(super) torsion_slope: Polynomial,
    /// The components of A, which is a positive multiple of the tangent.
    pub(super) tangent: [Polynomial; 3],
    /// S, the square of A.
    pub(super) speed: Polynomial,
    /// Q, the square of N; of D in the plane.
    pub(super) bending: Polynomial,
    /// W, or 0 if the segment is polynomial.
    pub(super) weight: Polynomial,
}

/// Name a function of which the signs are wanted.
#[derive(Clone, Copy, Debug)]
pub(super) enum Function {
    /// What a quantity changes its sign with.
    Feature(Quantity),
    /// The speed: the square of A.
    Speed,
    /// The velocity on a straight line of this direction.
    Along([f64; 3]),
}

impl Numerators {
    /// The polynomial that has a function's signs.
    pub(super) fn of(&self, function: Function) -> Polynomial {
        match function {
            Function::Feature(Quantity::Inflection) => self.curvature,
            Function::Feature(Quantity::CurvatureExtremum) => self.curvature_slope,
            Function::Feature(Quantity::TorsionZero) => self.torsion,
            Function::Feature(Quantity::TorsionExtremum) => self.torsion_slope,
            Function::Speed => self.speed,
            // A line is turned into the x axis.
            Function::Along(_) => self.tangent[0],
        }
    }
}

/// A vector of polynomials.
type Vector = [Polynomial; 3];

/// The derivatives of the homogeneous curve.
struct Derivatives {
    /// C, C′, … C⁗. A polynomial curve has no C here and needs none.
    curve: [Vector; 5],
    /// W, W′, … W⁗; all 0 for a polynomial curve, whose W is 1.
    weight: [Polynomial; 5],
}

impl Numerators {
    /// Multiply out the numerators of a segment; those that are asked for in space only are 0
    /// in the plane.
    pub(super) fn new<T: Scalar>(arena: &mut Arena<T>, shape: &SegmentShape, planar: bool) -> Self {
        arena.clear();
        let derivatives = derivatives(arena, shape);
        let frame = if shape.rational {
            rational_frame(arena, &derivatives)
        } else {
            polynomial_frame(arena, &derivatives)
        };
        let weights = [derivatives.weight[0], derivatives.weight[1]];
        let speed = dot(arena, frame.tangent, frame.tangent);
        let change = dot(arena, frame.tangent, frame.tangent_slope);
        if planar {
            let [_, _, normal] = frame.normal;
            let [_, _, normal_slope] = frame.normal_slope;
            let rising = weighted(arena, 3.0, weights, normal, normal_slope);
            let weighted = weigh(arena, weights[0], normal);
            let slope = [(1.0, rising, speed), (-3.0, weighted, change)];
            return Self {
                curvature: normal,
                curvature_slope: arena.sum_of_products(&slope),
                torsion: Polynomial::ZERO,
                torsion_slope: Polynomial::ZERO,
                tangent: frame.tangent,
                speed,
                bending: arena.sum_of_products(&[(1.0, normal, normal)]),
                weight: weights[0],
            };
        }
        let bending = dot(arena, frame.normal, frame.normal);
        let bending_change = dot(arena, frame.normal, frame.normal_slope);
        let rising = weighted(arena, 3.0, weights, bending, bending_change);
        let weighted_bending = weigh(arena, weights[0], bending);
        let slope = [(1.0, rising, speed), (-3.0, weighted_bending, change)];
        let curvature_slope = arena.sum_of_products(&slope);
        let twisting = weighted(arena, 2.0, weights, frame.torsion, frame.torsion_slope);
        let weighted_torsion = weigh(arena, weights[0], frame.torsion);
        let slope = [
            (1.0, twisting, bending),
            (-2.0, weighted_torsion, bending_change),
        ];
        Self {
            curvature: Polynomial::ZERO,
            curvature_slope,
            torsion: frame.torsion,
            torsion_slope: arena.sum_of_products(&slope),
            tangent: frame.tangent,
            speed,
            bending,
            weight: weights[0],
        }
    }
}

/// A, A′, N, N′, T and T′.
struct Frame {
    tangent: Vector,
    tangent_slope: Vector,
    normal: Vector,
    normal_slope: Vector,
    torsion: Polynomial,
    torsion_slope: Polynomial,
}

fn polynomial_frame<T: Scalar>(arena: &mut Arena<T>, derivatives: &Derivatives) -> Frame {
    let [_, first, second, third, fourth] = derivatives.curve;
    let normal = cross(arena, first, second);
    Frame {
        tangent: first,
        tangent_slope: second,
        normal,
        normal_slope: cross(arena, first, third),
        torsion: dot(arena, normal, third),
        torsion_slope: dot(arena, normal, fourth),
    }
}

fn rational_frame<T: Scalar>(arena: &mut Arena<T>, derivatives: &Derivatives) -> Frame {
    let [point, first, second, third, fourth] = derivatives.curve;
    let [w, w1, w2, w3, w4] = derivatives.weight;
    let mut minor = |slope: Vector, weight_slope: Polynomial| {
        [0, 1, 2].map(|axis| {
            arena.sum_of_products(&[(1.0, slope[axis], w), (-1.0, point[axis], weight_slope)])
        })
    };
    let tangent = minor(first, w1);
    let tangent_slope = minor(second, w2);
    let moment = cross(arena, point, first);
    let mut plane = |slope: Vector, weight_slope: Polynomial| {
        [(1, 2, 0), (2, 0, 1), (0, 1, 2)].map(|(i, j, k)| {
            arena.sum_of_products(&[
                (1.0, tangent[i], slope[j]),
                (-1.0, tangent[j], slope[i]),
                (1.0, moment[k], weight_slope),
            ])
        })
    };
    let normal = plane(second, w2);
    let normal_slope = plane(third, w3);
    let offset = dot(arena, moment, second);
    let mut volume = |slope: Vector, weight_slope: Polynomial| {
        arena.sum_of_products(&[
            (1.0, normal[0], slope[0]),
            (1.0, normal[1], slope[1]),
            (1.0, normal[2], slope[2]),
            (-1.0, offset, weight_slope),
        ])
    };
    Frame {
        tangent,
        tangent_slope,
        normal,
        normal_slope,
        torsion: volume(third, w3),
        torsion_slope: volume(fourth, w4),
    }
}

fn derivatives<T: Scalar>(arena: &mut Arena<T>, shape: &SegmentShape) -> Derivatives {
    let mut result = Derivatives {
        curve: [[Polynomial::ZERO; 3]; 5],
        weight: [Polynomial::ZERO; 5],
    };
    let first = usize::from(!shape.rational);
    for axis in 0..4 {
        let controls = &shape.controls[axis][..shape.count];
        let bounds = &shape.bounds[axis][..shape.count];
        let absent = controls.iter().all(|control| control.high() == 0.0)
            && bounds.iter().all(|bound| *bound == 0.0);
        if absent {
            continue;
        }
        let mut plain = arena.convert(controls, bounds);
        for order in first..5 {
            let scaled = arena.scale(plain);
            if axis < 3 {
                result.curve[order][axis] = scaled;
            } else {
                result.weight[order] = scaled;
            }
            plain = arena.derivative(plain);
        }
    }
    result
}

fn dot<T: Scalar>(arena: &mut Arena<T>, a: Vector, b: Vector) -> Polynomial {
    arena.sum_of_products(&[(1.0, a[0], b[0]), (1.0, a[1], b[1]), (1.0, a[2], b[2])])
}

fn cross<T: Scalar>(arena: &mut Arena<T>, a: Vector, b: Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)]
        .map(|(i, j)| arena.sum_of_products(&[(1.0, a[i], b[j]), (-1.0, a[j], b[i])]))
}

/// The numerator of (W^`power` f)′: `power` · W′ f + W f′; f′ if the weight is 1.
fn weighted<T: Scalar>(
    arena: &mut Arena<T>,
    power: f64,
    [weight, weight_slope]: [Polynomial; 2],
    f: Polynomial,
    slope: Polynomial,
) -> Polynomial {
    if weight.vanishes() {
        return slope;
    }
    arena.sum_of_products(&[(power, weight_slope, f), (1.0, weight, slope)])
}

/// W f, or f if the weight is 1.
fn weigh<T: Scalar>(arena: &mut Arena<T>, weight: Polynomial, f: Polynomial) -> Polynomial {
    if weight.vanishes() {
        return f;
    }
    arena.sum_of_products(&[(1.0, weight, f)])
}
