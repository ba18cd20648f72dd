//! Polynomials modulo primes below 2⁶².

use num_bigint::BigInt;
use num_traits::{Euclid, ToPrimitive};

/// Arithmetic modulo one prime.
#[derive(Clone, Copy, Debug)]
pub(super) struct Modulo(u64);

impl Modulo {
    /// The primes below 2⁶², from the largest on.
    pub(super) fn primes() -> impl Iterator<Item = Self> {
        let odd = (1_u64..).map(|index| (1 << 62) + 1 - 2 * index);
        odd.map(Self).filter(|modulo| modulo.is_prime())
    }

    pub(super) fn prime(self) -> u64 {
        self.0
    }

    pub(super) fn residue(self, value: &BigInt) -> u64 {
        let residue = value.rem_euclid(&BigInt::from(self.0));
        residue.to_u64().expect("below the prime")
    }

    pub(super) fn times(self, a: u64, b: u64) -> u64 {
        (u128::from(a) * u128::from(b) % u128::from(self.0)) as u64
    }

    pub(super) fn minus(self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + self.0 - b }
    }

    pub(super) fn inverse(self, a: u64) -> u64 {
        self.power(a, self.0 - 2)
    }

    fn power(self, base: u64, mut exponent: u64) -> u64 {
        let (mut result, mut square) = (1, base % self.0);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = self.times(result, square);
            }
            square = self.times(square, square);
            exponent >>= 1;
        }
        result
    }

    /// Miller's test to the bases that decide all numbers of 64 bits.
    fn is_prime(self) -> bool {
        const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
        let twos = (self.0 - 1).trailing_zeros();
        let odd = (self.0 - 1) >> twos;
        BASES.iter().all(|base| {
            let mut value = self.power(*base, odd);
            value == 1
                || (0..twos).any(|_| {
                    let found = value == self.0 - 1;
                    value = self.times(value, value);
                    found
                })
        })
    }

    /// The greatest common divisor with first coefficient 1 of two polynomials whose last
    /// coefficients are not 0.
    pub(super) fn common_factor(self, mut a: Vec<u64>, mut b: Vec<u64>) -> Vec<u64> {
        while !b.is_empty() {
            let inverse = self.inverse(*b.last().expect("coefficients"));
            while a.len() >= b.len() {
                let factor = self.times(*a.last().expect("coefficients"), inverse);
                let start = a.len() - b.len();
                for (rest, coefficient) in a[start..].iter_mut().zip(&b) {
                    *rest = self.minus(*rest, self.times(factor, *coefficient));
                }
                trim(&mut a);
            }
            std::mem::swap(&mut a, &mut b);
        }
        let inverse = self.inverse(*a.last().expect("coefficients"));
        a.iter().map(|value| self.times(*value, inverse)).collect()
    }
}

pub(super) fn trim(coefficients: &mut Vec<u64>) {
    while coefficients.last() == Some(&0) {
        coefficients.pop();
    }
}
