//! One segment of a curve in powers of t, and the numerators of what is differentiated of it.

use std::ops::Mul;

use batten::geometry::FloatPolygon;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::fraction::Fraction;
use super::polynomial::Polynomial;
use super::{exact, power_of_two};

/// A vector of polynomials.
pub type Vector = [Polynomial; 3];

/// One segment H = (X, Y, Z, W) with C = (X, Y, Z) / W, in powers of t. With subscripts for
/// Wronskians: C′ = a / W², C′ × C″ = b / W³ with b = (w(Y, Z, W), w(Z, X, W), w(X, Y, W)), and
/// the determinant of C′, C″, C‴ is e / W⁴ with e = −w(X, Y, Z, W).
#[derive(Debug)]
pub struct ExactSegment {
    /// W and its derivative.
    weight: [Polynomial; 2],
    /// a: the tangent but for a positive factor.
    tangent: Vector,
    normal: Vector,
    determinant: Polynomial,
}

impl ExactSegment {
    /// Read all segments of a curve, whose doubles are exact.
    pub fn all(curve: &FloatPolygon) -> Vec<Self> {
        let homogeneous = |index: usize| {
            let weight = exact(curve.weight(index));
            let [x, y, z] = curve.vertex(index).to_array();
            [
                exact(x) * &weight,
                exact(y) * &weight,
                exact(z) * &weight,
                weight,
            ]
        };
        let vertices: Vec<_> = (0..curve.vertices().len()).map(homogeneous).collect();
        let denominators = vertices.iter().flatten().map(BigRational::denom);
        let scale = denominators.max().expect("a number").clone();
        let whole = |value: &BigRational| (value * &scale).to_integer();
        let vertices: Vec<_> = vertices
            .iter()
            .map(|vertex| vertex.each_ref().map(whole))
            .collect();
        let basis = basis(curve.degree());
        let segment = |k: usize| {
            let vertices = (0..=curve.degree()).map(|j| &vertices[(k + j) % vertices.len()]);
            let vertices: Vec<_> = vertices.collect();
            Self::new([0, 1, 2, 3].map(|axis| coordinate(&vertices, axis, &basis)))
        };
        (0..curve.segments()).map(segment).collect()
    }

    fn new([x, y, z, w]: [Polynomial; 4]) -> Self {
        let jets = [x, y, z, w].map(|function| {
            let first = function.derivative();
            let second = first.derivative();
            let third = second.derivative();
            [function, first, second, third]
        });
        let [x, y, z, w] = &jets;
        let tangent = [x, y, z].map(|f| f[1].times(&w[0]).plus(&f[0].times(&w[1]), -1));
        let normal = [[y, z, w], [z, x, w], [x, y, w]].map(wronskian);
        let [a, b, c] = [(x, 0), (y, 1), (z, 2)].map(|(f, axis)| f[3].times(&normal[axis]));
        let last = w[3].times(&wronskian([x, y, z]));
        let determinant = a.plus(&b, 1).plus(&c, 1).plus(&last, -1);
        Self {
            weight: [w[0].clone(), w[1].clone()],
            tangent,
            normal,
            determinant,
        }
    }

    /// C′ but for a positive factor.
    pub fn tangent(&self) -> &Vector {
        &self.tangent
    }

    /// Whether the tangent, or else C′ × C″, is the zero vector at the start or the end.
    pub fn end_vanishes(&self, at_end: bool, vector: impl Fn(&Self) -> &Vector) -> bool {
        let t = end(at_end);
        vector(self).iter().all(|component| component.sign(&t) == 0)
    }

    /// C′ × C″ but for a positive factor.
    pub fn normal(&self) -> &Vector {
        &self.normal
    }

    /// κ|κ| at a number, signed if the curve is planar; `None` at a cusp.
    pub fn curvature_at(&self, t: &BigRational, planar: bool) -> Option<Fraction> {
        let [normal, speed] = [&self.normal, &self.tangent].map(|vector| Scaled::square(vector, t));
        if speed.value.is_zero() {
            return None;
        }
        let negative = planar && self.normal[2].sign(t) < 0;
        let weight = Scaled::of(&self.weight[0], t);
        let value = (normal * weight.power(6)).over(&speed.power(3), t);
        Some(if negative { value.negated() } else { value })
    }

    /// τ at a number; `None` where the curvature is 0.
    pub fn torsion_at(&self, t: &BigRational) -> Option<Fraction> {
        let square = Scaled::square(&self.normal, t);
        let weight = Scaled::of(&self.weight[0], t);
        let product = Scaled::of(&self.determinant, t) * weight.power(2);
        (!square.value.is_zero()).then(|| product.over(&square, t))
    }

    /// κ|κ| at an end.
    pub fn end_curvature(&self, at_end: bool, planar: bool) -> Option<Fraction> {
        self.curvature_at(&end(at_end), planar)
    }

    /// τ at an end.
    pub fn end_torsion(&self, at_end: bool) -> Option<Fraction> {
        self.torsion_at(&end(at_end))
    }

    /// The sign of the curvature of a planar curve.
    pub fn curvature(&self) -> Polynomial {
        self.normal[2].primitive()
    }

    /// The derivative of κ = b W³ / |a|³ as far as its sign goes.
    pub fn curvature_slope(&self) -> Polynomial {
        let [.., b] = &self.normal;
        self.slope(b, &b.derivative())
    }

    /// Half the derivative of κ² = |b|² W⁶ / |a|⁶ as far as its sign goes.
    pub fn space_curvature_slope(&self) -> Polynomial {
        let b = &self.normal;
        self.slope(&dot(b, b), &dot(b, &derivative(b)))
    }

    /// (q W + 3 p W′) a·a − 3 p W a·a′.
    fn slope(&self, p: &Polynomial, q: &Polynomial) -> Polynomial {
        let (a, [w, w1]) = (&self.tangent, &self.weight);
        let rising = q.times(w).plus(&p.times(w1), 3).times(&dot(a, a));
        let falling = p.times(w).times(&dot(a, &derivative(a)));
        rising.plus(&falling, -3).primitive()
    }

    /// The determinant of C′, C″ and C‴ as far as its sign goes.
    pub fn torsion(&self) -> Polynomial {
        self.determinant.primitive()
    }

    /// The derivative of τ = e W² / |b|² as far as its sign goes.
    pub fn torsion_slope(&self) -> Polynomial {
        let (e, b, [w, w1]) = (&self.determinant, &self.normal, &self.weight);
        let rising = e.derivative().times(w).plus(&e.times(w1), 2);
        let falling = e.times(w).times(&dot(b, &derivative(b)));
        let rising = rising.times(&dot(b, b));
        rising.plus(&falling, -2).primitive()
    }
}

fn end(at_end: bool) -> BigRational {
    power_of_two(0) * BigInt::from(i32::from(at_end))
}

/// A number times a power of the denominator of t.
struct Scaled {
    value: BigInt,
    power: u32,
}

impl Scaled {
    fn of(polynomial: &Polynomial, t: &BigRational) -> Self {
        Self {
            value: polynomial.scaled_value(t),
            power: polynomial.degree() as u32,
        }
    }

    fn square(vector: &Vector, t: &BigRational) -> Self {
        let power = vector.iter().map(Polynomial::degree).max();
        let power = power.expect("components") as u32;
        let squares = vector.iter().map(|component| {
            let Self { value, power: own } = Self::of(component, t);
            (value * t.denom().pow(power - own)).pow(2)
        });
        Self {
            value: squares.sum(),
            power: 2 * power,
        }
    }

    fn power(&self, exponent: u32) -> Self {
        Self {
            value: self.value.pow(exponent),
            power: self.power * exponent,
        }
    }

    fn over(&self, other: &Self, t: &BigRational) -> Fraction {
        let missing = t.denom().pow(self.power.abs_diff(other.power));
        if self.power < other.power {
            Fraction::new(&self.value * missing, other.value.clone())
        } else {
            Fraction::new(self.value.clone(), &other.value * missing)
        }
    }
}

impl Mul for Scaled {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            power: self.power + other.power,
        }
    }
}

fn derivative(vector: &Vector) -> Vector {
    vector.each_ref().map(Polynomial::derivative)
}

fn dot(a: &Vector, b: &Vector) -> Polynomial {
    let [x, y, z] = [0, 1, 2].map(|axis| a[axis].times(&b[axis]));
    x.plus(&y, 1).plus(&z, 1)
}

/// The determinant of three functions, their first and their second derivatives.
fn wronskian([f, g, h]: [&[Polynomial; 4]; 3]) -> Polynomial {
    let minor =
        |a: &[Polynomial; 4], b: &[Polynomial; 4]| a[0].times(&b[1]).plus(&b[0].times(&a[1]), -1);
    let [x, y, z] = [(f, g, h), (g, h, f), (h, f, g)].map(|(a, b, c)| minor(a, b).times(&c[2]));
    x.plus(&y, 1).plus(&z, 1)
}

fn coordinate(vertices: &[&[BigInt; 4]], axis: usize, basis: &[Polynomial]) -> Polynomial {
    let mut sum = Polynomial::new(Vec::new());
    for (vertex, function) in vertices.iter().zip(basis) {
        sum = sum.plus(
            &function.times(&Polynomial::constant(vertex[axis].clone())),
            1,
        );
    }
    sum
}

/// The n + 1 basis functions of one segment times n!, in powers of t.
fn basis(degree: usize) -> Vec<Polynomial> {
    let zero = Polynomial::new(Vec::new());
    let mut functions = vec![Polynomial::constant(1)];
    for level in 1..=degree as i64 {
        functions = (0..=level)
            .map(|index| {
                let falling = Polynomial::new(vec![BigInt::from(index + 1), -BigInt::one()]);
                let rising = Polynomial::new(vec![BigInt::from(level - index), BigInt::one()]);
                let at = |index: i64| {
                    let index = usize::try_from(index).ok();
                    index
                        .and_then(|index| functions.get(index))
                        .unwrap_or(&zero)
                        .clone()
                };
                at(index)
                    .times(&falling)
                    .plus(&at(index - 1).times(&rising), 1)
            })
            .collect();
    }
    functions
}
