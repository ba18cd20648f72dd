//! The numerators in whole numbers: what rounded numbers leave in doubt.
//!
//! Doubles are whole numbers times powers of two, and so is, but for a common positive factor,
//! a segment in Bernstein form. The formulas are those of the numerators' module.

use std::array::from_fn;
use std::cell::OnceCell;

use num_bigint::BigInt;
use num_traits::{One, Zero};

use super::exact_polynomial::ExactPolynomial;
use super::feature::Quantity;
use super::floating::Floating;
use super::numerators::Function;
use super::whole_numbers::{scaled_numbers, whole_numbers};
use crate::geometry::conversion::bezier_matrix::whole_basis;
use crate::geometry::float_polygon::FloatPolygon;

/// The most binary digits of a segment's Bernstein coefficients, whatever the degree: 53 for a
/// coordinate and for a weight, up to 110 for n! and binomial coefficients, and what the sizes
/// differ by.
const MOST_BITS: u64 = 512;

/// The most of them times the degree: low degrees may have more.
const MOST_BITS_TIMES_DEGREE: u64 = 6144;

/// A vector of polynomials.
pub(super) type Vector = [ExactPolynomial; 3];

/// Hold the homogeneous derivatives H, H′, … H⁗ of a segment, all times one positive number.
#[derive(Debug)]
pub(super) struct ExactSegment {
    planar: bool,
    /// The length that is 1 here.
    unit: Floating,
    curve: [Vector; 5],
    weight: [ExactPolynomial; 5],
    flat: OnceCell<Option<ExactPolynomial>>,
}

impl ExactSegment {
    /// Read a segment of a curve. `planar` says that curvature has a sign. `None` if its
    /// coordinates and weights are so different in size that their products would take too long.
    pub(super) fn new(polygon: &FloatPolygon, segment: usize, planar: bool) -> Option<Self> {
        let [segment] = Self::some(polygon, segment, planar);
        let numbers = segment.curve[0].iter().chain(&segment.weight[..1]);
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
                let [weight, _] = segment.weight[0].ends();
                segment.unit = segment.unit / Floating::new(&weight, 0);
                segment.weight = Default::default();
                segment.weight[0] = ExactPolynomial::constant(1);
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
            curve: from_fn(|order| from_fn(|axis| std::mem::take(&mut axes[axis][order]))),
            weight: w,
            flat: OnceCell::new(),
        }
    }

    /// Multiply out the polynomial that has a function's signs.
    pub(super) fn numerator(&self, function: Function) -> ExactPolynomial {
        match function {
            Function::Feature(Quantity::Inflection) => self.bend(2),
            Function::Feature(Quantity::CurvatureExtremum) => self.curvature_slope(),
            Function::Feature(Quantity::TorsionZero) => self.torsion(3),
            Function::Feature(Quantity::TorsionExtremum) => self.torsion_slope(),
            Function::Speed => dot(&self.tangent(1), &self.tangent(1)),
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

    /// Whether curvature has a sign.
    pub(super) fn is_planar(&self) -> bool {
        self.planar
    }

    /// The length that is 1 here.
    pub(super) fn unit(&self) -> Floating {
        self.unit
    }

    /// W.
    pub(super) fn weight(&self) -> &ExactPolynomial {
        &self.weight[0]
    }

    /// Whether the curvature is 0 at the end of the segment but not all along it.
    pub(super) fn flattens(&self, at_end: bool) -> bool {
        let bending = self.bending(2);
        bending.ends()[usize::from(at_end)].is_zero() && !bending.is_zero()
    }

    /// Tell the sign of the jump of curvature at degree 2, or torsion at degree 3, at the knot
    /// to the next segment. All else in them is the same on both sides.
    pub(super) fn jump(&self, next: &Self, quantity: Quantity) -> i8 {
        let jumping = |segment: &Self| match quantity {
            Quantity::TorsionExtremum => segment.torsion(3),
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
        let tangent = self.tangent(1);
        let (speed, change) = (dot(&tangent, &tangent), dot(&tangent, &self.tangent(2)));
        let [bend, slope] = if self.planar {
            [self.bend(2), self.bend(3)]
        } else {
            [self.bending(2), self.bending(3)]
        };
        let rising = self.weighted_slope(3, [&bend, &slope]).times(&speed);
        rising.plus(-3, &self.weight[0].times(&bend).times(&change))
    }

    fn torsion_slope(&self) -> ExactPolynomial {
        let torsion = self.torsion(3);
        if torsion.is_zero() {
            return ExactPolynomial::default();
        }
        let rising = self.weighted_slope(2, [&torsion, &self.torsion(4)]);
        let falling = self.weight[0].times(&torsion).times(&self.bending(3));
        rising.times(&self.bending(2)).plus(-2, &falling)
    }

    /// p W′f + W f′.
    fn weighted_slope(&self, power: u32, [f, slope]: [&ExactPolynomial; 2]) -> ExactPolynomial {
        self.weight[0]
            .times(slope)
            .plus(power, &self.weight[1].times(f))
    }

    /// C⁽ᵏ⁾W − C W⁽ᵏ⁾: A for the order k = 1, A′ for 2.
    pub(super) fn tangent(&self, order: usize) -> Vector {
        from_fn(|axis| {
            let slope = self.curve[order][axis].times(&self.weight[0]);
            slope.plus(-1, &self.curve[0][axis].times(&self.weight[order]))
        })
    }

    /// L = C × C′.
    fn moment(&self) -> Vector {
        cross(&self.curve[0], &self.curve[1])
    }

    /// A × C⁽ᵏ⁾ + L W⁽ᵏ⁾: N for the order k = 2, N′ for 3.
    fn normal(&self, order: usize) -> Vector {
        let turning = cross(&self.tangent(1), &self.curve[order]);
        if self.weight[order].is_zero() {
            return turning;
        }
        let mut moment = self.moment().into_iter();
        turning.map(|part| {
            let moment = moment.next().unwrap_or_default();
            part.plus(1, &moment.times(&self.weight[order]))
        })
    }

    /// The only component that the normal of a planar curve has: D for the order k = 2, D′ for 3.
    pub(super) fn bend(&self, order: usize) -> ExactPolynomial {
        let [_, _, bend] = self.normal(order);
        bend
    }

    /// N · N⁽ᵏ⁻²⁾: Q for the order k = 2, R for 3.
    pub(super) fn bending(&self, order: usize) -> ExactPolynomial {
        dot(&self.normal(2), &self.normal(order))
    }

    /// N · C⁽ᵏ⁾ + M W⁽ᵏ⁾, M = −L · C″: T for the order k = 3, T′ for 4.
    pub(super) fn torsion(&self, order: usize) -> ExactPolynomial {
        let volume = dot(&self.normal(2), &self.curve[order]);
        if self.weight[order].is_zero() {
            return volume;
        }
        let offset = dot(&self.moment(), &self.curve[2]);
        volume.plus(-1, &offset.times(&self.weight[order]))
    }
}

fn derivatives(polynomial: ExactPolynomial) -> [ExactPolynomial; 5] {
    let mut next = polynomial;
    from_fn(|_| {
        let derivative = next.derivative();
        std::mem::replace(&mut next, derivative)
    })
}

/// The scalar product.
pub(super) fn dot(a: &Vector, b: &Vector) -> ExactPolynomial {
    let terms = a.iter().zip(b);
    terms.fold(ExactPolynomial::default(), |sum, (a, b)| {
        sum.plus(1, &a.times(b))
    })
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i].times(&b[j]).plus(-1, &a[j].times(&b[i])))
}
