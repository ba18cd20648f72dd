//! Polynomials on \[0, 1\] with whole coefficients, and proving where they have which sign when
//! rounded numbers leave it in doubt.

use num_bigint::BigInt;
use num_traits::{One, Zero};

use super::isolation::{ROOT_WIDTH, SMALLEST_PIECE, exact_cut};
use super::refinement::{Bracket, refine};
use super::sign_piece::{Sign, SignPiece, append};
use super::values::Floating;
use super::whole_numbers::fraction;

/// Where to cut a piece, in sixteenths; if there is a root the next is tried.
const CUTS: [u8; 7] = [8, 6, 10, 7, 9, 5, 11];

/// Hold a polynomial Σ sᵢ tⁱ (1 − t)ᴺ⁻ⁱ: its Bernstein coefficients times binomial coefficients.
/// Without coefficients it is 0.
#[derive(Clone, Debug, Default)]
pub(super) struct ExactPolynomial(Vec<BigInt>);

impl ExactPolynomial {
    /// Take the coefficients sᵢ.
    pub(super) fn new(coefficients: Vec<BigInt>) -> Self {
        Self(coefficients)
    }

    /// Take a number for a polynomial of degree 0.
    pub(super) fn constant(value: u32) -> Self {
        Self(vec![BigInt::from(value)])
    }

    /// Whether it is 0 everywhere.
    pub(super) fn is_zero(&self) -> bool {
        self.0.iter().all(Zero::is_zero)
    }

    /// The number of binary digits of its largest coefficient.
    pub(super) fn bits(&self) -> u64 {
        self.0.iter().map(BigInt::bits).max().unwrap_or(0)
    }

    /// Multiply two polynomials.
    pub(super) fn times(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::default();
        }
        let mut product = vec![BigInt::zero(); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate().filter(|(_, a)| !a.is_zero()) {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        Self(product)
    }

    /// Add a multiple of another polynomial, of the same degree or 0.
    pub(super) fn plus(mut self, factor: impl Into<BigInt>, other: &Self) -> Self {
        let factor = factor.into();
        if self.0.is_empty() {
            self.0.resize(other.0.len(), BigInt::zero());
        }
        for (sum, term) in self.0.iter_mut().zip(&other.0) {
            *sum += &factor * term;
        }
        self
    }

    /// Differentiate.
    pub(super) fn derivative(&self) -> Self {
        let degree = self.0.len().saturating_sub(1);
        let slopes = self.0.windows(2).enumerate();
        let slopes = slopes.map(|(i, pair)| (i + 1) * &pair[1] - (degree - i) * &pair[0]);
        Self(slopes.collect())
    }

    /// The values at t = 0 and t = 1.
    pub(super) fn ends(&self) -> [BigInt; 2] {
        [self.0.first(), self.0.last()].map(|end| end.cloned().unwrap_or_default())
    }

    /// Tell the sign at p/q, for 0 ≤ p ≤ q.
    pub(super) fn sign_at(&self, place: &[BigInt; 2]) -> i8 {
        sign(&self.scaled_value(place))
    }

    /// Evaluate at t, a double from 0 to 1.
    pub(super) fn value_at(&self, t: f64) -> Floating {
        let place = fraction(t);
        let [_, q] = &place;
        let power = q.trailing_zeros().unwrap_or(0) as i64;
        let degree = self.0.len().saturating_sub(1) as i64;
        Floating::new(&self.scaled_value(&place), -power * degree)
    }

    /// Evaluate at p/q, times qᴺ.
    fn scaled_value(&self, [p, q]: &[BigInt; 2]) -> BigInt {
        let rest = q - p;
        let (mut sum, mut power) = (BigInt::zero(), BigInt::one());
        for coefficient in self.0.iter().rev() {
            sum = sum * p + coefficient * &power;
            power *= &rest;
        }
        sum
    }

    /// Append pieces that cover \[0, 1\] and say where the polynomial has which sign.
    ///
    /// Only pieces below 1e-9 remain unknown, about roots that are not simple, or closer than
    /// that.
    pub(super) fn append_signs(&self, pieces: &mut Vec<SignPiece>) {
        if self.is_zero() {
            append(pieces, Sign::Zero, 1.0);
        } else {
            self.append_piece(self, [0.0, 1.0], pieces);
        }
    }

    /// Treat one piece: what `local` is on \[0, 1\] the polynomial is there.
    fn append_piece(&self, local: &Self, [low, high]: [f64; 2], pieces: &mut Vec<SignPiece>) {
        let signs = local.0.iter().map(sign).filter(|sign| *sign != 0);
        let signs: Vec<i8> = signs.collect();
        let Some(first) = signs.first() else {
            return append(pieces, Sign::Zero, high);
        };
        // Descartes' rule of signs.
        match signs.windows(2).filter(|pair| pair[0] != pair[1]).count() {
            0 => append(pieces, Sign::from_direction(*first), high),
            1 => {
                let root = self.root([low, high], *first);
                append(pieces, Sign::from_direction(*first), root[0]);
                append(pieces, Sign::Root { value: 0.0 }, root[1]);
                append(pieces, Sign::from_direction(-first), high);
            }
            _ => match local.place_to_cut([low, high]) {
                Some((sixteenths, middle)) => {
                    let [left, right] = local.cut(sixteenths);
                    self.append_piece(&left, [low, middle], pieces);
                    self.append_piece(&right, [middle, high], pieces);
                }
                None => append(pieces, Sign::Unknown, high),
            },
        }
    }

    /// Choose where to cut \[0, 1\], the local form of a piece, if possible not at a root: in
    /// sixteenths, with the parameter there. `None` if the piece is too small.
    fn place_to_cut(&self, [low, high]: [f64; 2]) -> Option<(u8, f64)> {
        if high - low <= SMALLEST_PIECE {
            return None;
        }
        let mut cuts = CUTS.iter().filter_map(|sixteenths| {
            let middle = exact_cut([low, high], f64::from(*sixteenths) / 16.0)?;
            Some((*sixteenths, middle))
        });
        let first = cuts.next();
        let is_root = |sixteenths| self.sign_at(&[sixteenths, 16].map(BigInt::from)) == 0;
        let chosen = first.filter(|(sixteenths, _)| !is_root(*sixteenths));
        let chosen = chosen.or_else(|| cuts.find(|(sixteenths, _)| !is_root(*sixteenths)));
        chosen.or(first)
    }

    /// Write the parts of \[0, 1\] on both sides of a cut as polynomials on \[0, 1\], but for
    /// positive factors.
    fn cut(&self, sixteenths: u8) -> [Self; 2] {
        let reversed = Self(self.0.iter().rev().cloned().collect());
        let mut left = reversed.behind(16 - sixteenths);
        left.0.reverse();
        [left, self.behind(sixteenths)]
    }

    /// The part behind a cut: with t = (a (1 − τ) + 16 τ) / 16 and 1 − t = (16 − a) (1 − τ) / 16.
    fn behind(&self, sixteenths: u8) -> Self {
        let mut coefficients = self.0.clone();
        let mut power = BigInt::one();
        for coefficient in coefficients.iter_mut().rev() {
            *coefficient *= &power;
            power *= 16 - sixteenths;
        }
        let last = coefficients.len().saturating_sub(1);
        for from in 0..last {
            for index in (from..last).rev() {
                let carried = sixteenths * &coefficients[index + 1];
                coefficients[index] += carried;
            }
        }
        for (index, coefficient) in coefficients.iter_mut().enumerate() {
            *coefficient <<= 4 * index;
        }
        let spare = coefficients.iter().filter_map(BigInt::trailing_zeros).min();
        for coefficient in &mut coefficients {
            *coefficient >>= spare.unwrap_or(0);
        }
        Self(coefficients)
    }

    /// Narrow an interval that holds one root.
    fn root(&self, ends: [f64; 2], sign: i8) -> [f64; 2] {
        let bracket = Bracket {
            ends,
            values: [0.0; 2],
            sign,
        };
        let evaluate = |t| (f64::from(self.sign_at(&fraction(t))), 0.0);
        refine(bracket, ROOT_WIDTH, evaluate)
    }
}

fn sign(value: &BigInt) -> i8 {
    match value.sign() {
        num_bigint::Sign::Minus => -1,
        num_bigint::Sign::NoSign => 0,
        num_bigint::Sign::Plus => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Multiply factors a t − b (1 − t), which have the roots b / (a + b).
    fn with_roots(factors: &[(i64, i64)]) -> ExactPolynomial {
        let factor =
            |(a, b): &(i64, i64)| ExactPolynomial::new([-b, *a].map(BigInt::from).to_vec());
        let one = ExactPolynomial::constant(1);
        factors
            .iter()
            .map(factor)
            .fold(one, |product, factor| product.times(&factor))
    }

    fn signs(polynomial: &ExactPolynomial) -> Vec<SignPiece> {
        let mut pieces = Vec::new();
        polynomial.append_signs(&mut pieces);
        pieces
    }

    #[test]
    fn simple_roots_are_found_wherever_they_are() {
        // At the ends, where it would be cut, close to each other and to an end.
        let cases: [&[(i64, i64)]; 6] = [
            &[(1, 1)],
            &[(1, 1), (5, 3), (3, 5)],
            &[(1, 0), (0, 1), (2, 1)],
            &[(1_000_000, 999_999), (1, 1)],
            &[(1_000_000_000_000, 1)],
            &[(2, 7), (7, 2), (1, 4), (9, 1)],
        ];
        for factors in cases {
            let pieces = signs(&with_roots(factors));
            let inside = factors.iter().filter(|(a, b)| *a > 0 && *b > 0);
            let mut roots: Vec<f64> = inside.map(|(a, b)| *b as f64 / (a + b) as f64).collect();
            roots.sort_by(f64::total_cmp);
            let (mut start, mut found) = (0.0, Vec::new());
            for piece in pieces {
                if matches!(piece.sign, Sign::Root { .. }) {
                    assert!(piece.until - start <= ROOT_WIDTH);
                    found.push([start, piece.until]);
                }
                start = piece.until;
            }
            assert_eq!(found.len(), roots.len(), "{factors:?}");
            for (found, root) in found.iter().zip(roots) {
                assert!(found[0] <= root && root <= found[1], "{found:?} {root}");
            }
        }
    }

    #[test]
    fn double_roots_stay_unknown_in_a_tiny_piece() {
        let pieces = signs(&with_roots(&[(2, 1), (2, 1), (5, 2)]));
        let unknown: Vec<_> = (0..pieces.len())
            .filter(|k| pieces[*k].sign == Sign::Unknown)
            .collect();
        let [k] = unknown[..] else {
            panic!("{pieces:?}");
        };
        assert!(pieces[k - 1].until < 1.0 / 3.0 && 1.0 / 3.0 < pieces[k].until);
        assert!(pieces[k].until - pieces[k - 1].until < 1e-9);
        assert_eq!(signs(&ExactPolynomial::default())[0].sign, Sign::Zero);
    }

    #[test]
    fn derivatives_are_those_of_the_polynomial() {
        // (2 t − (1 − t))² = (3 t − 1)² has the derivative 6 (3 t − 1).
        let square = with_roots(&[(2, 1), (2, 1)]);
        let expected = with_roots(&[(12, 6)]);
        assert_eq!(square.derivative().0, expected.0);
        assert!(ExactPolynomial::constant(3).derivative().is_zero());
    }
}
