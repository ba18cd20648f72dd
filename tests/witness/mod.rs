//! Exact arithmetic: segments of curves as polynomials with whole coefficients, and the exact
//! number of their roots.
#![allow(dead_code)] // Each test uses a part of it.

use batten::geometry::FloatPolygon;
use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// A polynomial with exact coefficients, the constant one first.
#[derive(Clone, Debug)]
pub struct Polynomial(Vec<BigInt>);

impl Polynomial {
    pub fn is_zero(&self) -> bool {
        self.0.iter().all(Zero::is_zero)
    }

    fn plus(&self, other: &Self, factor: i64) -> Self {
        let size = self.0.len().max(other.0.len());
        let at = |list: &[BigInt], index: usize| list.get(index).cloned().unwrap_or_default();
        let sum = |index| at(&self.0, index) + at(&other.0, index) * factor;
        Self((0..size).map(sum).collect())
    }

    fn times(&self, other: &Self) -> Self {
        let mut product = vec![BigInt::zero(); (self.0.len() + other.0.len()).saturating_sub(1)];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        Self(product)
    }

    fn derivative(&self) -> Self {
        let terms = self.0.iter().enumerate().skip(1);
        Self(
            terms
                .map(|(power, coefficient)| coefficient * power)
                .collect(),
        )
    }

    /// The sign at a double.
    pub fn sign_at(&self, t: f64) -> i32 {
        let t = BigRational::from_float(t).expect("a finite number");
        // Σ cᵢ pⁱ q^(N − i) has the sign of the polynomial at p / q, q > 0.
        let (mut sum, mut scale) = (BigInt::zero(), BigInt::one());
        for coefficient in self.0.iter().rev() {
            sum = sum * t.numer() + coefficient * &scale;
            scale *= t.denom();
        }
        match sum.sign() {
            Sign::Plus => 1,
            Sign::NoSign => 0,
            Sign::Minus => -1,
        }
    }

    /// The sign next to the start or the end of the interval from 0 to 1, seen from inside.
    pub fn end_sign(&self, at_end: bool) -> i32 {
        let mut coefficients = self.0.clone();
        if at_end {
            // p(1 − x).
            shift_by_one(&mut coefficients);
            for odd in coefficients.iter_mut().skip(1).step_by(2) {
                *odd = -&*odd;
            }
        }
        let first = coefficients
            .iter()
            .find(|coefficient| !coefficient.is_zero());
        first.map_or(0, |first| if first.is_positive() { 1 } else { -1 })
    }

    /// The exact value at the start or the end of that interval.
    fn end_value(&self, at_end: bool) -> BigRational {
        let values = self.0.iter();
        let value = if at_end {
            values.sum()
        } else {
            values.take(1).sum::<BigInt>()
        };
        BigRational::from(value)
    }

    /// Count the changes of sign inside the interval from 0 to 1 exactly: roots of odd
    /// multiplicity, each once. Descartes' rule and bisection (Vincent, Collins, Akritas).
    pub fn roots_inside(&self) -> usize {
        /// Simple roots are found sooner.
        const DEEP: usize = 64;
        /// The roots of a polynomial without multiple ones are found sooner.
        const DEEPEST: usize = 4000;
        let count = |polynomial: &Self, depth| {
            let first = polynomial
                .0
                .iter()
                .position(|coefficient| !coefficient.is_zero());
            count_inside(polynomial.0[first.unwrap_or(0)..].to_vec(), depth)
        };
        let simple = self.trimmed();
        count(&simple, DEEP).unwrap_or_else(|| {
            let simple = simple.with_simple_roots();
            count(&simple, DEEPEST).expect("simple roots")
        })
    }

    /// The polynomial, or if it has a multiple root inside the interval, the one that has its sign
    /// but for roots of even multiplicity.
    pub fn changing(&self) -> Self {
        let trimmed = self.trimmed();
        let first = trimmed
            .0
            .iter()
            .position(|coefficient| !coefficient.is_zero());
        match count_inside(trimmed.0[first.unwrap_or(0)..].to_vec(), 64) {
            Some(_) => self.clone(),
            None => trimmed.with_simple_roots(),
        }
    }

    /// Multiply the factors of odd multiplicity: p, p/g₁, g₁/g₂, … with gₖ₊₁ = gcd(gₖ, gₖ′) give
    /// the factors of multiplicity k and more.
    fn with_simple_roots(&self) -> Self {
        let mut at_least = Vec::new();
        let mut rest = self.primitive();
        while rest.0.len() > 1 {
            let next = rest.common_divisor(&rest.derivative());
            at_least.push(rest.divided(&next));
            rest = next;
        }
        at_least.push(Self(vec![BigInt::one()]));
        let exactly = at_least.windows(2).map(|pair| pair[0].divided(&pair[1]));
        let odd = exactly.step_by(2).reduce(|a, b| a.times(&b));
        let odd = odd.unwrap_or_else(|| Self(vec![BigInt::one()]));
        // A square is positive.
        let sign = |polynomial: &Self| polynomial.0.last().map(Signed::is_negative);
        if sign(self) == sign(&odd) {
            odd
        } else {
            odd.times(&Self(vec![-BigInt::one()]))
        }
    }

    fn trimmed(&self) -> Self {
        let mut coefficients = self.0.clone();
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    fn primitive(&self) -> Self {
        let mut factor = BigInt::zero();
        for coefficient in &self.0 {
            let mut other = coefficient.abs();
            while !other.is_zero() {
                (factor, other) = (other.clone(), factor % other);
            }
        }
        if factor.is_zero() {
            return self.clone();
        }
        Self(
            self.0
                .iter()
                .map(|coefficient| coefficient / &factor)
                .collect(),
        )
    }

    /// Euclid's algorithm with pseudo-remainders.
    fn common_divisor(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.trimmed(), other.trimmed());
        while let Some(last) = b.0.last().cloned() {
            while a.0.len() >= b.0.len() {
                let lead = a.0.pop().expect("a coefficient");
                let offset = a.0.len() + 1 - b.0.len();
                for coefficient in &mut a.0 {
                    *coefficient *= &last;
                }
                for (place, coefficient) in a.0[offset..].iter_mut().zip(&b.0) {
                    *place -= &lead * coefficient;
                }
            }
            (a, b) = (b, a.trimmed().primitive());
        }
        a.primitive()
    }

    /// Divide by a polynomial that divides this one but for a factor.
    fn divided(&self, other: &Self) -> Self {
        let last = other.0.last().expect("not 0");
        let mut rest = self.0.clone();
        let size = rest.len() + 1 - other.0.len();
        let mut quotient = vec![BigInt::zero(); size];
        for offset in (0..size).rev() {
            for value in rest.iter_mut().chain(&mut quotient) {
                *value *= last;
            }
            let share = &rest[offset + other.0.len() - 1] / last;
            for (place, coefficient) in rest[offset..].iter_mut().zip(&other.0) {
                *place -= &share * coefficient;
            }
            quotient[offset] = share;
        }
        assert!(rest.iter().all(Zero::is_zero), "a rest");
        Self(quotient).primitive()
    }
}

/// Count simple roots inside the interval from 0 to 1; `None` if that takes more than so many
/// bisections.
fn count_inside(coefficients: Vec<BigInt>, depth: usize) -> Option<usize> {
    // (1 + x)^N p(1 / (1 + x)) has a positive root for each of p between 0 and 1.
    let mut turned: Vec<BigInt> = coefficients.iter().rev().cloned().collect();
    shift_by_one(&mut turned);
    let changes = variations(&turned);
    if changes <= 1 {
        return Some(changes);
    }
    let depth = depth.checked_sub(1)?;
    // 2^N p(x / 2) lives on the left half; shifted by 1 it lives on the right half.
    let degree = coefficients.len() - 1;
    let left: Vec<BigInt> = coefficients
        .into_iter()
        .enumerate()
        .map(|(power, coefficient)| coefficient << (degree - power))
        .collect();
    let mut right = left.clone();
    shift_by_one(&mut right);
    if right
        .get(..2)
        .is_some_and(|low| low.iter().all(Zero::is_zero))
    {
        // A multiple root in the middle.
        return None;
    }
    let mut middle = 0;
    if right.first().is_some_and(Zero::is_zero) {
        right.remove(0);
        middle = 1;
    }
    Some(count_inside(left, depth)? + middle + count_inside(right, depth)?)
}

/// Replace p(x) by p(x + 1).
fn shift_by_one(coefficients: &mut [BigInt]) {
    let size = coefficients.len();
    for level in 0..size.saturating_sub(1) {
        for index in (level..size - 1).rev() {
            let (low, high) = coefficients.split_at_mut(index + 1);
            low[index] += &high[0];
        }
    }
}

fn variations(coefficients: &[BigInt]) -> usize {
    let signs: Vec<bool> = coefficients
        .iter()
        .filter(|coefficient| !coefficient.is_zero())
        .map(Signed::is_positive)
        .collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

type Vector = [Polynomial; 3];

/// The derivatives of one segment: C⁽ᵏ⁾ = `derivatives`[k − 1] / W^(k + 1), by repeated use of
/// the quotient rule.
pub struct ExactSegment {
    derivatives: Vec<Vector>,
    weight: Polynomial,
}

impl ExactSegment {
    /// Read all segments of a curve, whose doubles are exact, times one power of two.
    pub fn all(curve: &FloatPolygon) -> Vec<Self> {
        let exact = |value| BigRational::from_float(value).expect("a finite number");
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
            Self::new(&vertices.collect::<Vec<_>>(), &basis, curve.is_rational())
        };
        (0..curve.segments()).map(segment).collect()
    }

    fn new(homogeneous: &[&[BigInt; 4]], basis: &[Polynomial], rational: bool) -> Self {
        let coordinate = |axis: usize| {
            let mut sum = Polynomial(vec![BigInt::zero()]);
            for (vertex, function) in homogeneous.iter().zip(basis) {
                sum = sum.plus(&function.times(&Polynomial(vec![vertex[axis].clone()])), 1);
            }
            sum
        };
        let weight = if rational {
            coordinate(3)
        } else {
            Polynomial(vec![BigInt::one()])
        };
        let slope = weight.derivative();
        let mut derivatives = vec![[0, 1, 2].map(coordinate)];
        for order in 0..4 {
            let next = derivatives[order].clone().map(|numerator| {
                let rising = numerator.derivative().times(&weight);
                rising.plus(&numerator.times(&slope), -(order as i64 + 1))
            });
            derivatives.push(next);
        }
        derivatives.remove(0);
        Self {
            derivatives,
            weight,
        }
    }

    /// κ|κ| at an end, signed if the curve is planar, but for a factor that all segments share;
    /// `None` at a cusp.
    pub fn end_curvature(&self, at_end: bool, planar: bool) -> Option<BigRational> {
        let [first, second, ..] = self.derivatives();
        let normal = cross(first, second);
        let square = dot(&normal, &normal).end_value(at_end);
        let negative = planar && normal[2].end_value(at_end).is_negative();
        let weight = self.weight.end_value(at_end);
        let speed = dot(first, first).end_value(at_end);
        if speed.is_zero() {
            return None;
        }
        let value = square * &weight * &weight / (&speed * &speed * &speed);
        Some(if negative { -value } else { value })
    }

    /// τ at an end, with the same proviso; `None` where the curvature is 0.
    pub fn end_torsion(&self, at_end: bool) -> Option<BigRational> {
        let [first, second, ..] = self.derivatives();
        let normal = cross(first, second);
        let square = dot(&normal, &normal).end_value(at_end);
        let weighted = self.torsion().end_value(at_end) * self.weight.end_value(at_end);
        (!square.is_zero()).then(|| weighted / square)
    }

    /// x′y″ − y′x″.
    pub fn curvature(&self) -> Polynomial {
        let [_, _, z] = cross(&self.derivatives[0], &self.derivatives[1]);
        z
    }

    /// (r′·r′)(r′×r‴) − 3 (r′·r″)(r′×r″).
    pub fn curvature_slope(&self) -> Polynomial {
        let [first, second, third, _] = self.derivatives();
        let [_, _, turning] = cross(first, third);
        let rising = dot(first, first).times(&turning);
        rising.plus(&dot(first, second).times(&self.curvature()), -3)
    }

    /// The derivative of |C′ × C″|² / |C′|⁶, as far as its sign goes.
    pub fn space_curvature_slope(&self) -> Polynomial {
        let [first, second, third, _] = self.derivatives();
        let normal = cross(first, second);
        let slope = cross(first, third);
        let rising = dot(first, first).times(&dot(&normal, &slope));
        rising.plus(&dot(first, second).times(&dot(&normal, &normal)), -3)
    }

    /// The determinant of C′, C″ and C‴.
    pub fn torsion(&self) -> Polynomial {
        let [first, second, third, _] = self.derivatives();
        dot(&cross(first, second), third)
    }

    /// The derivative of the determinant over |C′ × C″|², as far as its sign goes.
    pub fn torsion_slope(&self) -> Polynomial {
        let [first, second, third, fourth] = self.derivatives();
        let normal = cross(first, second);
        let rising = dot(&normal, fourth).times(&dot(&normal, &normal));
        let change = dot(&normal, &cross(first, third));
        rising.plus(&self.torsion().times(&change), -2)
    }

    fn derivatives(&self) -> [&Vector; 4] {
        [0, 1, 2, 3].map(|order| &self.derivatives[order])
    }
}

fn dot(a: &Vector, b: &Vector) -> Polynomial {
    let [x, y, z] = [0, 1, 2].map(|axis| a[axis].times(&b[axis]));
    x.plus(&y, 1).plus(&z, 1)
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i].times(&b[j]).plus(&a[j].times(&b[i]), -1))
}

/// The n + 1 basis functions of one segment times n!, in powers of t.
fn basis(degree: usize) -> Vec<Polynomial> {
    let mut functions = vec![Polynomial(vec![BigInt::one()])];
    for level in 1..=degree as i64 {
        let zero = Polynomial(vec![BigInt::zero()]);
        functions = (0..=level)
            .map(|index| {
                let falling = Polynomial(vec![BigInt::from(index + 1), BigInt::from(-1)]);
                let rising = Polynomial(vec![BigInt::from(level - index), BigInt::one()]);
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
