//! Fractions that are never reduced: reducing long numbers costs more than all the rest.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

/// A fraction with a positive denominator.
#[derive(Clone, Debug)]
pub struct Fraction {
    numerator: BigInt,
    denominator: BigInt,
}

impl Fraction {
    /// The quotient of two numbers, the second of which is not 0.
    pub fn new(numerator: BigInt, denominator: BigInt) -> Self {
        match denominator.sign() {
            Sign::Minus => Self {
                numerator: -numerator,
                denominator: -denominator,
            },
            Sign::Plus => Self {
                numerator,
                denominator,
            },
            Sign::NoSign => panic!("a denominator of 0"),
        }
    }

    pub fn zero() -> Self {
        Self::new(BigInt::zero(), BigInt::from(1))
    }

    pub fn negated(self) -> Self {
        Self::new(-self.numerator, self.denominator)
    }

    /// The lesser and the greater of two numbers, moved apart by the first one's distance from
    /// another.
    pub fn widened([a, b]: [Self; 2], other: &Self) -> [Self; 2] {
        let denominator = &a.denominator * &b.denominator * &other.denominator;
        let over = |value: &Self| &value.numerator * (&denominator / &value.denominator);
        let slack = (over(&a) - over(other)).abs();
        let [low, high] = [over(&a).min(over(&b)), over(&a).max(over(&b))];
        [low - &slack, high + slack].map(|end| Self::new(end, denominator.clone()))
    }

    /// Whether two numbers differ by less than 2⁻⁷⁰ of the first.
    pub fn agree([a, b]: &[Self; 2]) -> bool {
        let [p, q] = [&a.numerator * &b.denominator, &b.numerator * &a.denominator];
        (&p - &q).abs() << 70_u32 <= p.abs()
    }

    pub fn rational(&self) -> BigRational {
        BigRational::new(self.numerator.clone(), self.denominator.clone())
    }

    /// The number rounded to about nine digits, for messages.
    pub fn written(&self) -> String {
        let [numerator, denominator] = [&self.numerator, &self.denominator].map(|value| {
            let spare = value.bits().saturating_sub(60);
            ((value >> spare).to_string(), spare as i64)
        });
        let number = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
        let digits = number(&numerator.0) / number(&denominator.0);
        let power = (numerator.1 - denominator.1) as f64 * 2f64.log10();
        let exponent = if digits == 0.0 {
            0.0
        } else {
            (digits.abs().log10() + power).floor()
        };
        let digits = digits * 10f64.powf(power - exponent);
        format!("{digits:.9}e{exponent}")
    }
}

impl Ord for Fraction {
    fn cmp(&self, other: &Self) -> Ordering {
        let [a, b] = [
            &self.numerator * &other.denominator,
            &other.numerator * &self.denominator,
        ];
        a.cmp(&b)
    }
}

impl PartialOrd for Fraction {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Fraction {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Fraction {}

impl From<BigRational> for Fraction {
    fn from(value: BigRational) -> Self {
        let (numerator, denominator) = value.into();
        Self::new(numerator, denominator)
    }
}
