//! Segments that are prescribed exactly, as polynomials with whole coefficients, as float vertices.

use glam::DVec3;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::common::Random;
use crate::form::whole;

/// A polynomial in powers of t.
pub type Powers = Vec<BigRational>;

/// Draw a polynomial with small whole coefficients.
pub fn small(random: &mut Random, degree: usize) -> Powers {
    let mut powers: Powers = (0..=degree).map(|_| number(whole(random, 3))).collect();
    // Never 0 throughout.
    powers[0] = number(whole(random, 1) * 2 + 1);
    powers
}

pub fn number(value: i64) -> BigRational {
    BigRational::from_integer(BigInt::from(value))
}

pub fn times(a: &Powers, b: &Powers) -> Powers {
    let mut product = vec![BigRational::zero(); a.len() + b.len() - 1];
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            product[i + j] += a * b;
        }
    }
    product
}

/// The integral from 0 on.
pub fn integral(powers: &Powers) -> Powers {
    let terms = powers.iter().enumerate();
    let terms = terms.map(|(power, value)| value / BigInt::from(power + 1));
    std::iter::once(BigRational::zero()).chain(terms).collect()
}

/// Π (2^level t − k)^multiplicity.
pub fn with_roots(roots: &[(i64, u32, usize)]) -> Powers {
    let mut product = vec![BigRational::one()];
    for &(k, level, multiplicity) in roots {
        for _ in 0..multiplicity {
            product = times(&product, &vec![number(-k), number(1 << level)]);
        }
    }
    product
}

/// The n + 1 float vertices of a coordinate on the segment from 0 to 1, times a positive number
/// that makes them whole numbers without a common factor. Vertex i is the blossom at i − n + 1 … i.
pub fn float_vertices(degree: usize, powers: &Powers) -> Option<Vec<BigInt>> {
    let last = powers
        .iter()
        .rposition(|value| !value.is_zero())
        .unwrap_or(0);
    if last > degree {
        return None;
    }
    let values: Vec<BigRational> = (0..=degree as i64)
        .map(|vertex| {
            let symmetric = symmetric_functions(vertex - degree as i64 + 1..=vertex);
            let mut binomial = BigInt::one();
            let mut sum = BigRational::zero();
            for (power, value) in powers.iter().enumerate().take(degree + 1) {
                sum += value * &symmetric[power] / &binomial;
                binomial = binomial * (degree - power) / (power + 1);
            }
            sum
        })
        .collect();
    let scale = values.iter().fold(BigInt::one(), |scale, value| {
        let missing = BigRational::new(scale.clone(), value.denom().clone());
        scale * missing.denom()
    });
    let values = values.iter().map(|value| (value * &scale).to_integer());
    let values: Vec<BigInt> = values.collect();
    let content = values.iter().fold(BigInt::zero(), |content, value| {
        if content.is_zero() || value.is_zero() {
            (content + value).abs()
        } else {
            (value / BigRational::new(content, value.clone()).denom()).abs()
        }
    });
    let content = if content.is_zero() {
        BigInt::one()
    } else {
        content
    };
    Some(values.iter().map(|value| value / &content).collect())
}

/// Σ of all products of `power` of the numbers, by power.
fn symmetric_functions(numbers: std::ops::RangeInclusive<i64>) -> Vec<BigInt> {
    let mut functions = vec![BigInt::one()];
    for number in numbers {
        functions.push(BigInt::zero());
        for index in (1..functions.len()).rev() {
            let lower = &functions[index - 1] * number;
            functions[index] += lower;
        }
    }
    functions
}

/// The vertices as doubles, if these hold them exactly.
pub fn doubles(coordinates: [&[BigInt]; 3]) -> Option<Vec<DVec3>> {
    let exactly = |value: &BigInt| {
        let double = value.to_f64()?;
        (BigRational::from_float(double)? == BigRational::from_integer(value.clone()))
            .then_some(double)
    };
    let [x, y, z] = coordinates;
    let vertices = x.iter().zip(y).zip(z);
    vertices
        .map(|((x, y), z)| Some(DVec3::new(exactly(x)?, exactly(y)?, exactly(z)?)))
        .collect()
}
