//! Conversions between the float, the clamped and the Bézier polygon in whole numbers of any length.
//!
//! Numbers of two or three doubles lose what cancels by more digits than they hold: a vertex at 0
//! on a curve of size 1e50, say. Multiplied once by a common denominator of all steps, whole
//! numbers stay whole, so the steps are exact.

use glam::DVec3;
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::exact_vertices::{ExactVertices, RoundedVertices};
use super::knots::Direction;
use crate::geometry::bezier_matrix::{chain, float_to_bezier};
use crate::geometry::blend::Blend;
use crate::geometry::power_of_two::times_power_of_two;
use crate::geometry::whole_numbers::scaled_numbers;

/// The primes that can divide the steps' divisors, which are at most twice the degree.
const PRIMES: [u32; 15] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47];

/// Hold converted homogeneous vertices as fractions with one denominator.
pub(in crate::geometry) struct WholeVertices {
    /// Numerators, and the exponent of two that goes with them; those not in use are left out.
    axes: [Option<(Vec<BigInt>, i32)>; 4],
    denominator: BigInt,
}

impl WholeVertices {
    /// Convert vertices exactly.
    pub(in crate::geometry) fn new<const K: usize>(
        given: &ExactVertices<K>,
        degree: usize,
        direction: Direction,
    ) -> Self {
        let mut denominators = vec![Denominator([0; PRIMES.len()]); given.len()];
        direction.convert(degree, &mut denominators);
        let common = denominators
            .iter()
            .fold(Denominator([0; PRIMES.len()]), |a, b| a.joined(b));
        let denominator = common.value();
        let convert = |axis: &[[f64; K]]| {
            let (parts, exponent) = scaled_numbers(axis.as_flattened());
            let sums = parts.chunks(K).map(|parts| parts.iter().sum::<BigInt>());
            let mut numbers: Vec<Whole> = sums.map(|sum| Whole(sum * &denominator)).collect();
            direction.convert(degree, &mut numbers);
            let numerators = numbers.into_iter().map(|number| number.0);
            (numerators.collect(), exponent)
        };
        Self {
            axes: given.parts().map(|axis| axis.map(|axis| convert(&axis))),
            denominator,
        }
    }

    /// Round a vertex to doubles, each coordinate by itself: the point and its weight.
    pub(in crate::geometry) fn rounded(&self, index: usize) -> (DVec3, f64) {
        let number = |axis: usize| {
            let (numerators, exponent) = self.axes[axis].as_ref()?;
            Some((&numerators[index], *exponent))
        };
        let (below, lower) = number(3).unwrap_or((&self.denominator, 0));
        let point = [0, 1, 2].map(|axis| {
            number(axis).map_or(0.0, |(above, upper)| quotient(above, below, upper - lower))
        });
        let weight = number(3).map_or(1.0, |(weight, exponent)| {
            quotient(weight, &self.denominator, exponent)
        });
        (DVec3::from(point), weight)
    }
}

/// Convert a float polygon, segment by segment, to the chain of its Bézier polygons, each number
/// the exact one rounded.
pub(in crate::geometry) fn rounded_chain(
    degree: usize,
    given: &ExactVertices<2>,
) -> RoundedVertices {
    let matrix = float_to_bezier::<2>(degree);
    let exact = given.map(|axis| chain(degree, &matrix, axis));
    let (mut points, mut weights) = exact.all_rounded();
    for segment in 0..given.len() - degree {
        let window = segment..segment + degree + 1;
        let entered = given.largest(window.clone());
        let first = segment * degree;
        let mut unsure = (0..=degree)
            .filter(|row| !exact.is_sure(first + row, entered))
            .peekable();
        if unsure.peek().is_none() {
            continue;
        }
        // Clamping one segment makes its Bézier polygon.
        let whole = WholeVertices::new(&given.part(window), degree, Direction::Clamp);
        for row in unsure {
            let (point, weight) = whole.rounded(row);
            points[first + row] = point;
            if let Some(weights) = &mut weights {
                weights[first + row] = weight;
            }
        }
    }
    (points, weights)
}

/// A whole number that every divisor of the steps divides.
struct Whole(BigInt);

impl Blend for Whole {
    fn blend(p: f64, a: &Self, q: f64, b: &Self, divisor: f64) -> Self {
        Self((&a.0 * p as i64 + &b.0 * q as i64) / divisor as i64)
    }
}

/// A number that some fraction's denominator divides, by the exponents of its primes.
#[derive(Clone)]
struct Denominator([u32; PRIMES.len()]);

impl Denominator {
    fn joined(mut self, other: &Self) -> Self {
        for (exponent, other) in self.0.iter_mut().zip(other.0) {
            *exponent = other.max(*exponent);
        }
        self
    }

    fn value(&self) -> BigInt {
        let powers = PRIMES.into_iter().zip(self.0);
        powers
            .map(|(prime, exponent)| BigInt::from(prime).pow(exponent))
            .product()
    }
}

impl Blend for Denominator {
    fn blend(_: f64, a: &Self, _: f64, b: &Self, divisor: f64) -> Self {
        let mut joined = a.clone().joined(b);
        let mut rest = divisor as u32;
        for (prime, exponent) in PRIMES.into_iter().zip(&mut joined.0) {
            while rest.is_multiple_of(prime) && rest > 0 {
                rest /= prime;
                *exponent += 1;
            }
        }
        joined
    }
}

/// Round a · 2^`exponent` / b to the nearest double; an infinite or undefined one where b is 0.
fn quotient(a: &BigInt, b: &BigInt, exponent: i32) -> f64 {
    if b.is_zero() {
        return a.to_f64().unwrap_or(f64::NAN) / 0.0;
    }
    // 66 bits at least, and one that says whether there are more.
    let shift = 66 + b.bits() as i64 - a.bits() as i64;
    let (above, below) = match u64::try_from(shift) {
        Ok(shift) => (a.abs() << shift, b.abs()),
        Err(_) => (a.abs(), b.abs() << shift.unsigned_abs()),
    };
    let rest = !(&above % &below).is_zero();
    let digits: BigInt = (above / below) << 1;
    let digits = if rest { digits + BigInt::one() } else { digits };
    let value = digits.to_f64().unwrap_or(f64::NAN);
    let far = i64::from(i32::MAX);
    let exponent = (i64::from(exponent) - shift - 1).clamp(-far, far);
    let scaled = times_power_of_two(value, exponent as i32);
    if a.is_negative() == b.is_negative() {
        scaled
    } else {
        -scaled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_are_rounded_to_the_nearest_double() {
        for (a, b) in [
            (1, 3),
            (-7, 11),
            (22, 7),
            (0, 5),
            (i64::MAX, 3),
            (5, -i64::MAX),
        ] {
            let whole = |value: i64| BigInt::from(value);
            // Each of these numbers is a double.
            let (a, b) = (a as f64 as i64, b as f64 as i64);
            let found = quotient(&whole(a), &whole(b), 0);
            assert_eq!(found, a as f64 / b as f64, "{a} / {b}");
            assert_eq!(
                quotient(&whole(a), &whole(b), -600),
                found * 2.0_f64.powi(-600)
            );
        }
    }
}
