//! Proving where a polynomial with whole coefficients has which sign on \[0, 1\].

use std::cell::Cell;

use num_bigint::BigInt;

use super::exact_polynomial::ExactPolynomial;
use super::isolation::{ROOT_WIDTH, exact_cut};
use super::refinement::{Bracket, refine};
use super::sign_piece::{Sign, SignPiece, append};
use crate::geometry::whole_numbers::{fraction, sign};

/// Where to cut a piece: odd numbers of these shares, the middle first. A polynomial has at most
/// as many roots as its degree says, below 512, so that not all of these places are roots.
const SHARES: std::ops::RangeInclusive<u32> = 1..=10;

/// The most additions of single digits, of 64 bits, for one polynomial: below a tenth
/// of a second.
const MOST_WORK: u64 = 40_000_000;

impl ExactPolynomial {
    /// Append pieces that cover \[0, 1\] and say where the polynomial has which sign.
    ///
    /// Multiple roots are taken out first ([`ExactPolynomial::odd_part`]). No cut lies at a root,
    /// so none can hide between two pieces, and since all roots are simple, pieces that are small
    /// enough have one or none. Roots that doubles of t cannot tell apart share a piece. The rest
    /// is unknown if it would take too long.
    pub(super) fn append_signs(&self, pieces: &mut Vec<SignPiece>) {
        if self.is_zero() {
            append(pieces, Sign::Zero, 1.0);
        } else if let Some(simple) = self.odd_part() {
            simple.append_simple_roots(pieces);
        } else {
            append(pieces, Sign::Unknown, 1.0);
        }
    }

    /// The same for a polynomial without multiple roots, not 0 at the ends.
    pub(super) fn append_simple_roots(&self, pieces: &mut Vec<SignPiece>) {
        let mut isolation = Isolation {
            polynomial: self,
            pieces,
            work: Cell::new(MOST_WORK),
        };
        isolation.piece(self, [0.0, 1.0]);
    }

    /// Narrow an interval that holds one root.
    fn narrowed(&self, ends: [f64; 2], sign: i8) -> [f64; 2] {
        let bracket = Bracket {
            ends,
            values: [0.0; 2],
            sign,
        };
        let evaluate = |t| (f64::from(self.sign_at(&fraction(t))), 0.0);
        refine(bracket, ROOT_WIDTH, evaluate)
    }

    /// The signs of the coefficients that are not 0.
    fn signs(&self) -> Vec<i8> {
        let signs = self.coefficients().iter().map(sign);
        signs.filter(|sign| *sign != 0).collect()
    }
}

struct Isolation<'a> {
    polynomial: &'a ExactPolynomial,
    pieces: &'a mut Vec<SignPiece>,
    /// Remaining budget of work.
    work: Cell<u64>,
}

impl Isolation<'_> {
    /// Treat one piece: what `local` is on \[0, 1\] the polynomial is there.
    fn piece(&mut self, local: &ExactPolynomial, [low, high]: [f64; 2]) {
        let signs = local.signs();
        let [first, .., last] = signs[..] else {
            // A constant, which is not 0.
            let sign = signs
                .first()
                .map_or(Sign::Zero, |sign| Sign::from_direction(*sign));
            return append(self.pieces, sign, high);
        };
        match variations(&signs) {
            0 => append(self.pieces, Sign::from_direction(first), high),
            1 => {
                let root = self.polynomial.narrowed([low, high], first);
                self.root(root, high, [first, last], 1);
            }
            _ => match self.cut(local, Some([low, high])) {
                Cut::Parts([left, right], middle) => {
                    self.piece(&left, [low, middle]);
                    self.piece(&right, [middle, high]);
                }
                Cut::TooSmall => match self.count(local) {
                    Some(0) => append(self.pieces, Sign::from_direction(first), high),
                    Some(count) => self.root([low, high], high, [first, last], count),
                    None => append(self.pieces, Sign::Unknown, high),
                },
                Cut::TooLong => append(self.pieces, Sign::Unknown, high),
            },
        }
    }

    fn root(&mut self, root: [f64; 2], until: f64, [before, after]: [i8; 2], count: usize) {
        append(self.pieces, Sign::from_direction(before), root[0]);
        append(self.pieces, Sign::roots(count), root[1]);
        append(self.pieces, Sign::from_direction(after), until);
    }

    /// Count the roots of a polynomial without multiple roots inside \[0, 1\], which stands for
    /// a piece too small for doubles. `None` if it would take too long.
    fn count(&self, local: &ExactPolynomial) -> Option<usize> {
        let variations = variations(&local.signs());
        if variations < 2 {
            return Some(variations);
        }
        match self.cut(local, None) {
            Cut::Parts([left, right], _) => Some(self.count(&left)? + self.count(&right)?),
            _ => None,
        }
    }

    /// Cut the local form of a piece at a place that is not a root. Its parameter is a double if
    /// the ends of the piece are given.
    fn cut(&self, local: &ExactPolynomial, ends: Option<[f64; 2]>) -> Cut {
        let cost = local.cost();
        let Some(left) = self.work.get().checked_sub(cost) else {
            return Cut::TooLong;
        };
        self.work.set(left);
        for bits in SHARES {
            let count = 1_u32 << bits;
            let half = count / 2;
            // From the middle outwards.
            let places = (0..half).flat_map(|step| [half.checked_sub(step), Some(half + step)]);
            for place in places.flatten().filter(|place| place % 2 == 1) {
                let share = f64::from(place) / f64::from(count);
                let middle = match ends {
                    Some(ends) => exact_cut(ends, share),
                    None => Some(share),
                };
                let Some(middle) = middle else {
                    continue;
                };
                if local.sign_at(&[place, count].map(BigInt::from)) != 0 {
                    return Cut::Parts(local.cut(place, bits), middle);
                }
            }
            if ends.is_some_and(|ends| exact_cut(ends, 1.0 / f64::from(count)).is_none()) {
                break;
            }
        }
        Cut::TooSmall
    }
}

/// Result of cutting a piece.
enum Cut {
    /// Both parts, and the parameter between them.
    Parts([ExactPolynomial; 2], f64),
    /// No place inside it, but for roots, is a double.
    TooSmall,
    /// Too much was done already.
    TooLong,
}

/// Count changes of sign. By Descartes' rule there are no more roots.
fn variations(signs: &[i8]) -> usize {
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

#[cfg(test)]
mod tests {
    use super::super::exact_polynomial::tests::with_roots;
    use super::*;

    fn signs(polynomial: &ExactPolynomial) -> Vec<SignPiece> {
        let mut pieces = Vec::new();
        polynomial.append_signs(&mut pieces);
        pieces
    }

    /// Intervals of roots and their counts.
    fn roots(polynomial: &ExactPolynomial) -> Vec<([f64; 2], usize)> {
        let (mut start, mut found) = (0.0, Vec::new());
        for piece in signs(polynomial) {
            match piece.sign {
                Sign::Root { count, .. } => found.push(([start, piece.until], count)),
                Sign::Unknown => panic!("undecided"),
                _ => {}
            }
            start = piece.until;
        }
        found
    }

    #[test]
    fn simple_roots_are_found_wherever_they_are() {
        // At the ends, where it would be cut, close to each other and to an end.
        let cases: [&[(i64, i64)]; 7] = [
            &[(1, 1)],
            &[(1, 1), (5, 3), (3, 5)],
            &[(1, 0), (0, 1), (2, 1)],
            &[(1_000_000, 999_999), (1, 1)],
            &[(1_000_000_000_000, 1)],
            &[(2, 7), (7, 2), (1, 4), (9, 1)],
            &[(5, 11), (6, 10), (7, 9), (8, 8), (9, 7), (10, 6), (11, 5)],
        ];
        for factors in cases {
            let inside = factors.iter().filter(|(a, b)| *a > 0 && *b > 0);
            let mut expected: Vec<f64> = inside.map(|(a, b)| *b as f64 / (a + b) as f64).collect();
            expected.sort_by(f64::total_cmp);
            let found = roots(&with_roots(factors));
            assert_eq!(found.len(), expected.len(), "{factors:?}");
            for ((found, count), root) in found.iter().zip(expected) {
                assert!(found[0] <= root && root <= found[1], "{found:?} {root}");
                assert!(found[1] - found[0] <= ROOT_WIDTH && *count == 1);
            }
        }
    }

    #[test]
    fn roots_of_even_multiplicity_change_no_sign_and_odd_ones_do() {
        let double = with_roots(&[(2, 1), (2, 1), (5, 2)]);
        assert_eq!(roots(&double).len(), 1);
        assert_eq!(signs(&double)[0].sign, Sign::Negative);
        assert_eq!(roots(&with_roots(&[(-2, -1), (2, 1)])), []);
        assert_eq!(
            signs(&with_roots(&[(-2, -1), (2, 1)]))[0].sign,
            Sign::Negative
        );
        let triple = with_roots(&[(2, 1), (2, 1), (2, 1), (5, 2), (5, 2), (3, 3)]);
        let [(third, 1), (half, 1)] = roots(&triple)[..] else {
            panic!("{:?}", roots(&triple));
        };
        assert!(third[0] < 1.0 / 3.0 && 1.0 / 3.0 < third[1]);
        assert!(half[0] <= 0.5 && 0.5 <= half[1]);
        assert_eq!(signs(&ExactPolynomial::default())[0].sign, Sign::Zero);
    }

    #[test]
    fn no_cut_hides_a_root() {
        // Every place that is tried first is a root, of any multiplicity.
        for power in 1..=4 {
            let places = (5..=11).map(|place| (place, 16 - place));
            let factors: Vec<_> = places.flat_map(|factor| vec![factor; power]).collect();
            let expected = if power % 2 == 1 { 7 } else { 0 };
            assert_eq!(
                roots(&with_roots(&factors)).len(),
                expected,
                "power {power}"
            );
        }
    }

    #[test]
    fn roots_too_close_for_doubles_share_an_interval() {
        // At (2⁷⁰ ± 1) / 2⁷¹ and ½, and a fourth one far away.
        let one = BigInt::from(1);
        let near = |by: i32| {
            let root = (&one << 70_u8) + by;
            ExactPolynomial::new(vec![-&root, (&one << 71_u8) - root])
        };
        let close = near(-1).times(&near(1)).times(&near(0));
        let found = roots(&close.times(&with_roots(&[(3, 1)])));
        assert_eq!(
            found.iter().map(|(_, count)| *count).collect::<Vec<_>>(),
            [1, 3]
        );
        assert!(found[1].0[0] < 0.5 && 0.5 < found[1].0[1]);
        assert!(found[1].0[1] - found[1].0[0] < 1e-15);
    }
}
