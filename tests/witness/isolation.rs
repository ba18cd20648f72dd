//! The roots of a polynomial inside the interval from 0 to 1, each alone in an interval: Descartes'
//! rule in Bernstein form and bisection. Pieces carry 120 bits and a bound of their error; where that
//! hides a sign the piece is computed anew from the whole coefficients.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::polynomial::{Polynomial, shift};

/// One root of a square-free polynomial: alone inside the interval from `numerator` / 2^`level` to
/// the next such number, or exactly there.
#[derive(Clone, Debug)]
pub struct Root {
    numerator: BigInt,
    level: u64,
    /// The sign just behind the interval's start; 0 for a root that is exactly `numerator` /
    /// 2^`level`.
    sign: i32,
}

impl Root {
    /// The root as a number, if it is one whose place is known exactly.
    pub fn exactly(&self) -> Option<BigRational> {
        (self.sign == 0).then(|| self.low())
    }

    /// The number of halvings that lead to the interval.
    pub fn level(&self) -> u64 {
        self.level
    }

    /// Compare the root of `polynomial` that this is with one of another polynomial, `common`
    /// being the common factor of the two.
    pub fn order(
        &self,
        polynomial: &Polynomial,
        other: &Self,
        other_polynomial: &Polynomial,
        common: &Polynomial,
    ) -> Ordering {
        if let Some(t) = other.exactly() {
            return self.compare(polynomial, &t);
        }
        if let Some(t) = self.exactly() {
            return other.compare(other_polynomial, &t).reverse();
        }
        let mut bits = self.level.max(other.level);
        loop {
            bits += 32;
            let [low, high] = self.narrowed(polynomial, bits);
            let [other_low, other_high] = other.narrowed(other_polynomial, bits);
            if low == high {
                return other.compare(other_polynomial, &low).reverse();
            }
            if other_low == other_high {
                return self.compare(polynomial, &other_low);
            }
            if high <= other_low {
                return Ordering::Less;
            }
            if other_high <= low {
                return Ordering::Greater;
            }
            // A common root inside both intervals is the only root of each there.
            let ends = [low.max(other_low), high.min(other_high)];
            let [start, end] = ends.map(|t| common.sign(&t));
            if start * end < 0 {
                return Ordering::Equal;
            }
        }
    }

    fn low(&self) -> BigRational {
        BigRational::new(self.numerator.clone(), BigInt::one() << self.level)
    }

    fn high(&self) -> BigRational {
        BigRational::new(&self.numerator + 1, BigInt::one() << self.level)
    }

    /// Compare the root of `polynomial` that this is with a number.
    pub fn compare(&self, polynomial: &Polynomial, t: &BigRational) -> Ordering {
        let low = self.low();
        if self.sign == 0 {
            return low.cmp(t);
        }
        if *t <= low {
            return Ordering::Greater;
        }
        if *t >= self.high() {
            return Ordering::Less;
        }
        match polynomial.sign(t) {
            0 => Ordering::Equal,
            sign if sign == self.sign => Ordering::Greater,
            _ => Ordering::Less,
        }
    }

    /// Bisect until the interval is 2^−`bits` wide; returns its ends, which are equal if the root
    /// was met.
    pub fn narrowed(&self, polynomial: &Polynomial, bits: u64) -> [BigRational; 2] {
        if self.sign == 0 {
            return [self.low(), self.low()];
        }
        let (mut numerator, mut level) = (self.numerator.clone(), self.level);
        while level < bits {
            level += 1;
            numerator = (numerator << 1) + 1;
            let middle = BigRational::new(numerator.clone(), BigInt::one() << level);
            match polynomial.sign(&middle) {
                0 => return [middle.clone(), middle],
                sign if sign == self.sign => {}
                _ => numerator -= 1,
            }
        }
        let scale = BigInt::one() << level;
        [
            BigRational::new(numerator.clone(), scale.clone()),
            BigRational::new(numerator + 1, scale),
        ]
    }
}

impl Polynomial {
    /// The roots of odd multiplicity inside the interval from 0 to 1, in order.
    pub fn odd_roots(&self) -> Vec<Root> {
        if self.is_zero() {
            return Vec::new();
        }
        self.odd_part().simple_roots()
    }

    /// The roots inside the interval from 0 to 1, in order, of a polynomial without multiple ones.
    pub fn simple_roots(&self) -> Vec<Root> {
        let mut roots = Vec::new();
        if self.degree() > 0 {
            let first = Piece::exact(self, BigInt::zero(), 0);
            isolate(self, first, &mut roots);
        }
        roots
    }
}

fn isolate(polynomial: &Polynomial, mut piece: Piece, roots: &mut Vec<Root>) {
    assert!(piece.level < 4000, "a multiple root");
    if !piece.decided() {
        piece = Piece::exact(polynomial, piece.numerator, piece.level);
    }
    match piece.certain_changes() {
        0 => {}
        1 => roots.push(Root {
            sign: piece.first_sign(),
            numerator: piece.numerator,
            level: piece.level,
        }),
        _ => {
            let [left, right] = piece.halves();
            let (numerator, level) = (right.numerator.clone(), right.level);
            let may_be_root = right.coefficients[0].unsigned_abs() <= right.error as u128;
            isolate(polynomial, left, roots);
            if may_be_root {
                let middle = BigRational::new(numerator.clone(), BigInt::one() << level);
                if polynomial.sign(&middle) == 0 {
                    roots.push(Root {
                        numerator,
                        level,
                        sign: 0,
                    });
                }
            }
            isolate(polynomial, right, roots);
        }
    }
}

/// A polynomial's Bernstein coefficients from `numerator` / 2^`level` to the next such number, but
/// for a positive factor.
struct Piece {
    numerator: BigInt,
    level: u64,
    coefficients: Vec<i128>,
    /// What each of them may be off by.
    error: i128,
    /// Their signs where they are known for certain.
    signs: Option<Vec<i32>>,
}

impl Piece {
    /// The bits that a coefficient has at most, so that two can be added.
    const BITS: u64 = 120;

    fn exact(polynomial: &Polynomial, numerator: BigInt, level: u64) -> Self {
        let degree = polynomial.degree();
        // 2^(N level) p((numerator + x) / 2^level) lives on the interval from 0 to 1.
        let powers = polynomial.coefficients().iter().enumerate();
        let mut local: Vec<BigInt> = powers
            .map(|(power, value)| value << (level * (degree - power) as u64))
            .collect();
        shift(&mut local, &numerator);
        // (1 + x)^N p(1 / (1 + x)) has the Bernstein coefficients times binomial coefficients.
        local.reverse();
        shift(&mut local, &BigInt::one());
        local.reverse();
        let signs = local.iter().map(|value| value.signum());
        let signs = signs.map(|sign| sign.to_i32().expect("a sign")).collect();
        let binomials = binomials(degree);
        let most = local.iter().zip(&binomials);
        let most = most
            .map(|(value, binomial)| (value / binomial).bits())
            .max();
        let most = most.unwrap_or(0);
        let rounded = |(value, binomial): (&BigInt, &BigInt)| {
            let value = if most > Self::BITS {
                value / (binomial << (most - Self::BITS))
            } else {
                (value << (Self::BITS - most)) / binomial
            };
            value.to_i128().expect("few bits")
        };
        Self {
            numerator,
            level,
            coefficients: local.iter().zip(&binomials).map(rounded).collect(),
            error: 1,
            signs: Some(signs),
        }
    }

    /// Whether there are at least two changes of sign, or exactly as many as are certain.
    fn decided(&self) -> bool {
        self.signs.is_some()
            || self.coefficients.iter().all(|value| self.sign(*value) != 0)
            || self.certain_changes() > 1
    }

    fn sign(&self, value: i128) -> i32 {
        if value.unsigned_abs() <= self.error as u128 {
            0
        } else {
            value.signum() as i32
        }
    }

    fn known_signs(&self) -> Vec<i32> {
        let mut signs = match &self.signs {
            Some(signs) => signs.clone(),
            None => self
                .coefficients
                .iter()
                .map(|value| self.sign(*value))
                .collect(),
        };
        signs.retain(|sign| *sign != 0);
        signs
    }

    fn certain_changes(&self) -> usize {
        let signs = self.known_signs();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    fn first_sign(&self) -> i32 {
        self.known_signs()[0]
    }

    /// De Casteljau's algorithm at the middle.
    fn halves(self) -> [Self; 2] {
        let mut right = self.coefficients;
        let size = right.len();
        let mut left = Vec::with_capacity(size);
        for level in (0..size).rev() {
            left.push(right[0]);
            for index in 0..level {
                right[index] = (right[index] + right[index + 1]) >> 1;
            }
        }
        let error = self.error + size as i128;
        let half = |numerator, coefficients| Self {
            numerator,
            level: self.level + 1,
            coefficients,
            error,
            signs: None,
        };
        let start: BigInt = self.numerator << 1;
        [half(start.clone(), left), half(start + 1, right)]
    }
}

fn binomials(degree: usize) -> Vec<BigInt> {
    let mut binomials = vec![BigInt::one()];
    for index in 0..degree {
        let next = &binomials[index] * (degree - index) / (index + 1);
        binomials.push(next);
    }
    binomials
}
