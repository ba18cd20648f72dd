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

use std::array::from_fn;

use super::arena::{Arena, Polynomial};
use super::feature::Feature;
use super::ring::Ring;
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
    /// The function whose sign changes make the feature.
    Feature(Feature),
    /// The speed: the square of A.
    Speed,
    /// The velocity on a straight line of this direction.
    Along([f64; 3]),
}

impl Numerators {
    /// The polynomial that has a function's signs.
    pub(super) fn of(&self, function: Function) -> Polynomial {
        match function {
            Function::Feature(Feature::Inflection) => self.curvature,
            Function::Feature(Feature::CurvatureExtremum) => self.curvature_slope,
            Function::Feature(Feature::TorsionZero) => self.torsion,
            Function::Feature(Feature::TorsionExtremum) => self.torsion_slope,
            Function::Speed => self.speed,
            // A line is turned into the x axis.
            Function::Along(_) => self.tangent[0],
        }
    }
}

/// A vector of polynomials.
pub(super) type Vector<P> = [P; 3];

/// Hold the derivatives of the homogeneous curve.
#[derive(Debug)]
pub(super) struct Derivatives<P> {
    /// C, C′, … C⁗. Of a polynomial curve C is not asked for.
    pub(super) curve: [Vector<P>; 5],
    /// W, W′, … W⁗ of a rational curve; W is 1 without them.
    pub(super) weight: Option<[P; 5]>,
}

impl<P: Clone> Derivatives<P> {
    /// C⁽ᵏ⁾W − C W⁽ᵏ⁾: A for the order k = 1, A′ for 2.
    pub(super) fn tangent<R: Ring<Polynomial = P>>(&self, ring: &mut R, order: usize) -> Vector<P> {
        let [point, slope] = [&self.curve[0], &self.curve[order]];
        let Some(weight) = &self.weight else {
            return slope.clone();
        };
        from_fn(|axis| {
            let falling = (-1, &point[axis], &weight[order]);
            ring.sum_of_products(&[(1, &slope[axis], &weight[0]), falling])
        })
    }

    /// L = C × C′ of a rational curve.
    pub(super) fn moment<R: Ring<Polynomial = P>>(&self, ring: &mut R) -> Option<Vector<P>> {
        let [point, first, ..] = &self.curve;
        self.weight.as_ref().map(|_| cross(ring, point, first))
    }

    /// A × C⁽ᵏ⁾ + L W⁽ᵏ⁾: N for the order k = 2, N′ for 3.
    pub(super) fn normal<R: Ring<Polynomial = P>>(
        &self,
        ring: &mut R,
        (tangent, moment): (&Vector<P>, &Option<Vector<P>>),
        order: usize,
    ) -> Vector<P> {
        let slope = &self.curve[order];
        let (Some(weight), Some(moment)) = (&self.weight, moment) else {
            return cross(ring, tangent, slope);
        };
        AXES.map(|(i, j, k)| {
            let turning = [(1, &tangent[i], &slope[j]), (-1, &tangent[j], &slope[i])];
            ring.sum_of_products(&[turning[0], turning[1], (1, &moment[k], &weight[order])])
        })
    }

    /// −M = L · C″ of a rational curve.
    pub(super) fn offset<R: Ring<Polynomial = P>>(
        &self,
        ring: &mut R,
        moment: &Option<Vector<P>>,
    ) -> Option<P> {
        let moment = moment.as_ref()?;
        Some(dot(ring, moment, &self.curve[2]))
    }

    /// N · C⁽ᵏ⁾ + M W⁽ᵏ⁾: T for the order k = 3, T′ for 4.
    pub(super) fn torsion<R: Ring<Polynomial = P>>(
        &self,
        ring: &mut R,
        (normal, offset): (&Vector<P>, &Option<P>),
        order: usize,
    ) -> P {
        let slope = &self.curve[order];
        let (Some(weight), Some(offset)) = (&self.weight, offset) else {
            return dot(ring, normal, slope);
        };
        let [x, y, z] = [0, 1, 2].map(|axis| (1, &normal[axis], &slope[axis]));
        ring.sum_of_products(&[x, y, z, (-1, offset, &weight[order])])
    }

    /// (p W′f + W f′) g − p W f h: all derivatives of curvature and torsion have such numerators.
    pub(super) fn slope<R: Ring<Polynomial = P>>(
        &self,
        ring: &mut R,
        power: i32,
        [f, slope]: [&P; 2],
        [g, h]: [&P; 2],
    ) -> P {
        let Some([weight, weight_slope, ..]) = &self.weight else {
            return ring.sum_of_products(&[(1, slope, g), (-power, f, h)]);
        };
        let rising = ring.sum_of_products(&[(power, weight_slope, f), (1, weight, slope)]);
        let weighted = ring.sum_of_products(&[(1, weight, f)]);
        ring.sum_of_products(&[(1, &rising, g), (-power, &weighted, h)])
    }
}

/// The axes of each component of a vector product, and the component.
const AXES: [(usize, usize, usize); 3] = [(1, 2, 0), (2, 0, 1), (0, 1, 2)];

/// The scalar product.
pub(super) fn dot<R: Ring>(
    ring: &mut R,
    a: &Vector<R::Polynomial>,
    b: &Vector<R::Polynomial>,
) -> R::Polynomial {
    ring.sum_of_products(&[0, 1, 2].map(|axis| (1, &a[axis], &b[axis])))
}

fn cross<R: Ring>(
    ring: &mut R,
    a: &Vector<R::Polynomial>,
    b: &Vector<R::Polynomial>,
) -> Vector<R::Polynomial> {
    AXES.map(|(i, j, _)| ring.sum_of_products(&[(1, &a[i], &b[j]), (-1, &a[j], &b[i])]))
}

impl Numerators {
    /// Multiply out the numerators of a segment; those that are asked for in space only are 0
    /// in the plane.
    pub(super) fn new<T: Scalar>(arena: &mut Arena<T>, shape: &SegmentShape, planar: bool) -> Self {
        arena.clear();
        let segment = derivatives(arena, shape);
        let [tangent, tangent_slope] = [1, 2].map(|order| segment.tangent(arena, order));
        let moment = segment.moment(arena);
        let frame = (&tangent, &moment);
        let [normal, normal_slope] = [2, 3].map(|order| segment.normal(arena, frame, order));
        let speed = dot(arena, &tangent, &tangent);
        let change = dot(arena, &tangent, &tangent_slope);
        let bending = dot(arena, &normal, &normal);
        let weight = segment
            .weight
            .map_or(Polynomial::ZERO, |[weight, ..]| weight);
        if planar {
            let [[.., bend], [.., bend_slope]] = [&normal, &normal_slope];
            return Self {
                curvature: *bend,
                curvature_slope: segment.slope(arena, 3, [bend, bend_slope], [&speed, &change]),
                torsion: Polynomial::ZERO,
                torsion_slope: Polynomial::ZERO,
                tangent,
                speed,
                bending,
                weight,
            };
        }
        let bending_change = dot(arena, &normal, &normal_slope);
        let offset = segment.offset(arena, &moment);
        let frame = (&normal, &offset);
        let [torsion, twist] = [3, 4].map(|order| segment.torsion(arena, frame, order));
        let bends = [&bending, &bending_change];
        Self {
            curvature: Polynomial::ZERO,
            curvature_slope: segment.slope(arena, 3, bends, [&speed, &change]),
            torsion,
            torsion_slope: segment.slope(arena, 2, [&torsion, &twist], bends),
            tangent,
            speed,
            bending,
            weight,
        }
    }
}

fn derivatives<T: Scalar>(arena: &mut Arena<T>, shape: &SegmentShape) -> Derivatives<Polynomial> {
    let mut axes = [[Polynomial::ZERO; 5]; 4];
    let first = usize::from(!shape.rational);
    for (axis, orders) in axes.iter_mut().enumerate() {
        let controls = &shape.controls[axis][..shape.count];
        let bounds = &shape.bounds[axis][..shape.count];
        let absent = controls.iter().all(|control| control.high() == 0.0)
            && bounds.iter().all(|bound| *bound == 0.0);
        if absent {
            continue;
        }
        let mut plain = arena.convert(controls, bounds);
        for order in &mut orders[first..] {
            *order = arena.scale(plain);
            plain = arena.derivative(plain);
        }
    }
    Derivatives {
        curve: from_fn(|order| from_fn(|axis| axes[axis][order])),
        weight: shape.rational.then_some(axes[3]),
    }
}
