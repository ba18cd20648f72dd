//! Greatest common divisors of polynomials and what is made with them: factors that bear one
//! multiplicity each.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::modular::{Modulo, trim};
use super::polynomial::{Polynomial, common_divisor};

impl Polynomial {
    /// The greatest common divisor, without a common factor of its coefficients: remainders
    /// modulo primes, put together until the result divides both.
    pub fn common_factor(&self, other: &Self) -> Self {
        if self.is_zero() {
            return other.primitive();
        }
        if other.is_zero() {
            return self.primitive();
        }
        let [a, b] = [self.primitive(), other.primitive()];
        let [last_a, last_b] = [&a, &b].map(|p| p.coefficients().last().expect("not 0"));
        let last = common_divisor(last_a, last_b);
        let mut found: Option<Residues> = None;
        for modulo in Modulo::primes() {
            let [left, right] = [&a, &b].map(|p| residues(modulo, p));
            if left.len() != a.coefficients().len() || right.len() != b.coefficients().len() {
                continue;
            }
            let mut factor = modulo.common_factor(left, right);
            if factor.len() == 1 {
                return Self::constant(1);
            }
            let scale = modulo.residue(&last);
            for coefficient in &mut factor {
                *coefficient = modulo.times(*coefficient, scale);
            }
            let settled = match &mut found {
                Some(known) if known.values.len() < factor.len() => continue,
                Some(known) if known.values.len() == factor.len() => known.add(modulo, &factor),
                _ => {
                    found = Some(Residues::new(modulo, &factor));
                    false
                }
            };
            if settled && let Some(known) = &found {
                let candidate = known.polynomial().primitive();
                if a.divided_by(&candidate).is_some() && b.divided_by(&candidate).is_some() {
                    return candidate;
                }
            }
        }
        unreachable!("there are enough primes")
    }

    /// Write it as a number times Π fₖᵏ with square-free fₖ that have no common roots; the list
    /// begins with f₁. Every real root of fₖ is one of multiplicity k.
    pub fn factors_by_multiplicity(&self) -> Vec<Self> {
        let mut rest = self.primitive();
        let mut radicals = Vec::new();
        while rest.degree() > 0 {
            let repeated = rest.common_factor(&rest.derivative());
            radicals.push(quotient(&rest, &repeated));
            rest = repeated;
        }
        radicals.push(Self::constant(1));
        radicals
            .windows(2)
            .map(|pair| quotient(&pair[0], &pair[1]))
            .collect()
    }

    /// The polynomial whose simple roots are the roots of odd multiplicity; elsewhere it has the
    /// same sign, but at the roots of even multiplicity.
    pub fn odd_part(&self) -> Self {
        let factors = self.factors_by_multiplicity().into_iter().step_by(2);
        let product = factors.fold(Self::constant(1), |product, factor| product.times(&factor));
        // What is left out is a square times a number.
        let [own, other] = [self, &product].map(|p| p.coefficients().last().map_or(0, sign_of));
        product.times(&Self::constant(own * other))
    }

    /// The polynomial whose simple roots are all roots.
    pub fn radical(&self) -> Self {
        let factors = self.factors_by_multiplicity().into_iter();
        factors.fold(Self::constant(1), |product, factor| product.times(&factor))
    }
}

fn sign_of(value: &BigInt) -> i32 {
    i32::from(value.is_positive()) - i32::from(value.is_negative())
}

fn quotient(a: &Polynomial, b: &Polynomial) -> Polynomial {
    a.divided_by(b).expect("a divisor").primitive()
}

fn residues(modulo: Modulo, polynomial: &Polynomial) -> Vec<u64> {
    let values = polynomial.coefficients().iter();
    let mut values: Vec<u64> = values.map(|value| modulo.residue(value)).collect();
    trim(&mut values);
    values
}

/// Coefficients modulo a product of primes, between plus and minus half of it.
struct Residues {
    values: Vec<BigInt>,
    modulus: BigInt,
}

impl Residues {
    fn new(modulo: Modulo, values: &[u64]) -> Self {
        let mut first = Self {
            values: vec![BigInt::zero(); values.len()],
            modulus: BigInt::one(),
        };
        first.add(modulo, values);
        first
    }

    /// Add what is known modulo one more prime; returns whether that was nothing new.
    fn add(&mut self, modulo: Modulo, values: &[u64]) -> bool {
        let inverse = modulo.inverse(modulo.residue(&self.modulus));
        let next = &self.modulus * modulo.prime();
        let half: BigInt = &next >> 1;
        let mut settled = true;
        for (known, value) in self.values.iter_mut().zip(values) {
            let missing = modulo.minus(*value, modulo.residue(known));
            let steps = modulo.times(missing, inverse);
            if steps != 0 {
                settled = false;
                *known += &self.modulus * steps;
                if *known > half {
                    *known -= &next;
                }
            }
        }
        self.modulus = next;
        settled
    }

    fn polynomial(&self) -> Polynomial {
        Polynomial::new(self.values.clone())
    }
}
