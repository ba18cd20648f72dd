//! The numerators in whole numbers, where rounded numbers leave a doubt.
//!
//! Doubles are whole numbers times powers of two, and so is, but for a common positive factor,
//! a segment in Bernstein form.

use std::array::from_fn;
use std::cell::OnceCell;

use num_bigint::BigInt;
use num_traits::{One, Zero};

use super::exact_polynomial::ExactPolynomial;
use super::feature::Feature;
use super::floating::Floating;
use super::numerators::{Derivatives, Function, Vector, dot};
use super::ring::Ring;
use crate::geometry::bezier_matrix::whole_basis;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::whole_numbers::{scaled_numbers, whole_numbers};

/// The most binary digits of a segment's Bernstein coefficients, whatever the degree: 53 for a
/// coordinate and for a weight, up to 110 for n! and binomial coefficients, and what the sizes
/// differ by.
const MOST_BITS: u64 = 512;

/// The most of them times the degree: low degrees may have more.
const MOST_BITS_TIMES_DEGREE: u64 = 6144;

/// The arithmetic of polynomials with whole coefficients.
struct WholeNumbers;

impl Ring for WholeNumbers {
    type Polynomial = ExactPolynomial;

    fn sum_of_products(
        &mut self,
        terms: &[(i32, &ExactPolynomial, &ExactPolynomial)],
    ) -> ExactPolynomial {
        let none = ExactPolynomial::default();
        let terms = terms.iter();
        terms.fold(none, |sum, (factor, a, b)| sum.plus(*factor, &a.times(b)))
    }
}

/// Hold the homogeneous derivatives H, H′, … H⁗ of a segment, all times one positive number.
#[derive(Debug)]
pub(super) struct ExactSegment {
    pub(super) planar: bool,
    /// The length that is 1 here.
    pub(super) unit: Floating,
    derivatives: Derivatives<ExactPolynomial>,
    flat: OnceCell<Option<ExactPolynomial>>,
}

impl ExactSegment {
    /// Read a segment of a curve. `planar` says that curvature has a sign. `None` if its
    /// coordinates and weights are so different in size that their products would take too long.
    pub(super) fn new(polygon: &FloatPolygon, segment: usize, planar: bool) -> Option<Self> {
        let [segment] = Self::some(polygon, segment, planar);
        let weight = segment.derivatives.weight.iter().map(|weight| &weight[0]);
        let numbers = segment.derivatives.curve[0].iter().chain(weight);
        let most = MOST_BITS.max(MOST_BITS_TIMES_DEGREE / polygon.degree() as u64);
        (numbers.map(ExactPolynomial::bits).max() <= Some(most)).then_some(segment)
    }

    /// Read a segment and the next one, both in the same units.
    pub(super) fn pair(polygon: &FloatPolygon, segment: usize, planar: bool) -> [Self; 2] {
        Self::some(polygon, segment, planar)
    }

    fn some<const COUNT: usize>(
        polygon: &FloatPolygon,
        first: usize,
        planar: bool,
    ) -> [Self; COUNT] {
        let degree = polygon.degree();
        let range = first..first + degree + COUNT;
        let places = range.clone().flat_map(|j| polygon.vertex(j).to_array());
        let (places, exponent) = scaled_numbers(&places.collect::<Vec<_>>());
        let weights = range.map(|j| polygon.weight(j));
        let weights = whole_numbers(&weights.collect::<Vec<_>>());
        let vertices = places.chunks_exact(3).zip(&weights).map(|(place, weight)| {
            let [x, y, z] = from_fn(|axis| &place[axis] * weight);
            [x, y, z, weight.clone()]
        });
        let vertices: Vec<_> = vertices.collect();
        let constant = weights.windows(2).all(|pair| pair[0] == pair[1]);
        let bases = whole_basis(degree).into_iter();
        let bases = bases.map(|basis| basis.into_iter().map(BigInt::from).collect());
        let bases: Vec<_> = bases.map(ExactPolynomial::new).collect();
        from_fn(|k| {
            let mut segment = Self::from_vertices(&bases, &vertices[k..=k + degree], planar);
            segment.unit = Floating::new(&BigInt::one(), exponent.into());
            if constant {
                // Another unit of length makes up for it.
                let [weight, _] = segment.weight().ends();
                segment.unit = segment.unit / Floating::new(&weight, 0);
                segment.derivatives.weight = None;
            }
            segment
        })
    }

    fn from_vertices(bases: &[ExactPolynomial], vertices: &[[BigInt; 4]], planar: bool) -> Self {
        let [x, y, z, w] = from_fn(|axis| {
            let terms = bases.iter().zip(vertices);
            let sum = terms.fold(ExactPolynomial::default(), |sum, (basis, vertex)| {
                sum.plus(vertex[axis].clone(), basis)
            });
            derivatives(sum)
        });
        let mut axes = [x, y, z];
        Self {
            planar,
            unit: Floating::new(&BigInt::one(), 0),
            derivatives: Derivatives {
                curve: from_fn(|order| from_fn(|axis| std::mem::take(&mut axes[axis][order]))),
                weight: Some(w),
            },
            flat: OnceCell::new(),
        }
    }

    /// Multiply out the polynomial that has a function's signs.
    pub(super) fn numerator(&self, function: Function) -> ExactPolynomial {
        match function {
            Function::Feature(Feature::Inflection) => self.bend(2),
            Function::Feature(Feature::CurvatureExtremum) => self.curvature_slope(),
            Function::Feature(Feature::TorsionZero) => self.torsion(3),
            Function::Feature(Feature::TorsionExtremum) => self.torsion_slope(),
            Function::Speed => self.speed(1),
            Function::Along(direction) => {
                let direction = whole_numbers(&direction);
                let terms = direction.iter().zip(self.tangent(1));
                terms.fold(ExactPolynomial::default(), |sum, (factor, part)| {
                    sum.plus(factor.clone(), &part)
                })
            }
        }
    }

    /// Find the polynomial whose roots are the zeros of the tangent inside the segment, each once:
    /// 0 if it vanishes everywhere. `None` if it would take too long.
    pub(super) fn tangent_zeros(&self) -> Option<ExactPolynomial> {
        ExactPolynomial::shared_roots(self.tangent(1).iter())
    }

    /// Whether the tangent vanishes at an end of the segment.
    pub(super) fn tangent_vanishes(&self, at_end: bool) -> bool {
        let vanishes = |part: &ExactPolynomial| part.ends()[usize::from(at_end)].is_zero();
        self.tangent(1).iter().all(vanishes)
    }

    /// Find the polynomial whose roots are the places inside the segment where the curvature of a
    /// space curve is 0, each once. `None` if it would take too long.
    pub(super) fn flat(&self) -> Option<&ExactPolynomial> {
        let find = || ExactPolynomial::shared_roots(self.normal(2).iter());
        self.flat.get_or_init(find).as_ref()
    }

    /// W.
    pub(super) fn weight(&self) -> ExactPolynomial {
        let weight = self.derivatives.weight.as_ref();
        weight.map_or_else(
            || ExactPolynomial::constant(1),
            |[weight, ..]| weight.clone(),
        )
    }

    /// Whether the curvature is 0 at the end of the segment but not all along it.
    pub(super) fn flattens(&self, at_end: bool) -> bool {
        let bending = self.bending(2);
        bending.ends()[usize::from(at_end)].is_zero() && !bending.is_zero()
    }

    /// Tell the sign of the jump of curvature at degree 2, or torsion at degree 3, at the knot
    /// to the next segment. All else in them is the same on both sides.
    pub(super) fn jump(&self, next: &Self, quantity: Feature) -> i8 {
        let jumping = |segment: &Self| match quantity {
            Feature::TorsionExtremum => segment.torsion(3),
            _ if self.planar => segment.bend(2),
            _ => segment.bending(2),
        };
        let ([_, before], [behind, _]) = (jumping(self).ends(), jumping(next).ends());
        match behind.cmp(&before) {
            std::cmp::Ordering::Less => -1,
            std::cmp::Ordering::Equal => 0,
            std::cmp::Ordering::Greater => 1,
        }
    }

    fn curvature_slope(&self) -> ExactPolynomial {
        let [bend, slope] = if self.planar {
            [self.bend(2), self.bend(3)]
        } else {
            [self.bending(2), self.bending(3)]
        };
        let speeds = [&self.speed(1), &self.speed(2)];
        self.derivatives
            .slope(&mut WholeNumbers, 3, [&bend, &slope], speeds)
    }

    fn torsion_slope(&self) -> ExactPolynomial {
        let torsion = self.torsion(3);
        if torsion.is_zero() {
            return ExactPolynomial::default();
        }
        let torsions = [&torsion, &self.torsion(4)];
        let bends = [&self.bending(2), &self.bending(3)];
        self.derivatives
            .slope(&mut WholeNumbers, 2, torsions, bends)
    }

    /// A for the order k = 1, A′ for 2.
    fn tangent(&self, order: usize) -> Vector<ExactPolynomial> {
        self.derivatives.tangent(&mut WholeNumbers, order)
    }

    /// A · A⁽ᵏ⁻¹⁾: S for the order k = 1, B for 2.
    pub(super) fn speed(&self, order: usize) -> ExactPolynomial {
        dot(&mut WholeNumbers, &self.tangent(1), &self.tangent(order))
    }

    /// N for the order k = 2, N′ for 3.
    fn normal(&self, order: usize) -> Vector<ExactPolynomial> {
        let moment = self.derivatives.moment(&mut WholeNumbers);
        let frame = (&self.tangent(1), &moment);
        self.derivatives.normal(&mut WholeNumbers, frame, order)
    }

    /// The only component that the normal of a planar curve has: D for the order k = 2, D′ for 3.
    pub(super) fn bend(&self, order: usize) -> ExactPolynomial {
        let [_, _, bend] = self.normal(order);
        bend
    }

    /// N · N⁽ᵏ⁻²⁾: Q for the order k = 2, R for 3.
    pub(super) fn bending(&self, order: usize) -> ExactPolynomial {
        dot(&mut WholeNumbers, &self.normal(2), &self.normal(order))
    }

    /// T for the order k = 3, T′ for 4.
    pub(super) fn torsion(&self, order: usize) -> ExactPolynomial {
        let moment = self.derivatives.moment(&mut WholeNumbers);
        let offset = self.derivatives.offset(&mut WholeNumbers, &moment);
        let frame = (&self.normal(2), &offset);
        self.derivatives.torsion(&mut WholeNumbers, frame, order)
    }
}

fn derivatives(polynomial: ExactPolynomial) -> [ExactPolynomial; 5] {
    let mut next = polynomial;
    from_fn(|_| {
        let derivative = next.derivative();
        std::mem::replace(&mut next, derivative)
    })
}
