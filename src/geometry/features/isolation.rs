//! Proving where a polynomial has which sign on \[0, 1\], by subdivision.

use super::arena::{Arena, Polynomial};
use super::refinement::{Bracket, refine};
use super::scalar::Scalar;
use super::sign_piece::{Sign, SignPiece, append};
use super::variations::Variations;

/// The width to which the interval of a root is narrowed, in the segment's parameter. The
/// domain is not shorter than a segment.
pub(super) const ROOT_WIDTH: f64 = 1e-12;

/// Pieces below this width, in the segment's parameter, are not cut again: 2⁻³¹ < 1e-9.
const SMALLEST_PIECE: f64 = 1.0 / (1_u64 << 31) as f64;

/// Where to cut the whole segment: off the middle, where symmetrical curves have their roots. If
/// the sign at one place cannot be told the next is tried.
const FIRST_CUTS: [f64; 3] = [125.0 / 256.0, 139.0 / 256.0, 107.0 / 256.0];

/// Where to cut its pieces. Few binary digits keep the ends of all pieces exact.
const CUTS: [f64; 3] = [0.5, 0.375, 0.625];

/// Say how far to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Effort {
    /// Give up at the first doubt: another attempt with more digits follows.
    Quick,
    /// Prove all that can be proved and name the rest.
    Thorough,
}

/// Says that a doubt ended a quick attempt.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doubt;

/// Append pieces that cover \[0, 1\] and say where a polynomial in scaled form has which sign.
///
/// Every piece that is neither decided nor lost in rounding is cut in two until it is below
/// 1e-9. Of the pieces of one size no more than a small multiple of the polynomial's degree N
/// remain undecided, because each has a complex root near it, or one of the polynomial plus or
/// minus its error bound; so the cost is at most O(31 N) cuts of O(N²) operations.
///
/// # Errors
/// [`Doubt`] if something stays undecided and the effort is quick.
pub(super) fn isolate<T: Scalar>(
    arena: &mut Arena<T>,
    polynomial: Polynomial,
    effort: Effort,
    pieces: &mut Vec<SignPiece>,
) -> Result<(), Doubt> {
    let mark = arena.mark();
    let whole = arena.unscale(polynomial);
    let mut isolation = Isolation {
        arena,
        polynomial,
        effort,
        pieces,
    };
    let result = isolation.piece(whole, [0.0, 1.0]);
    arena.release(mark);
    result
}

struct Isolation<'a, T> {
    arena: &'a mut Arena<T>,
    /// The polynomial in scaled form on the whole segment.
    polynomial: Polynomial,
    effort: Effort,
    pieces: &'a mut Vec<SignPiece>,
}

impl<T: Scalar> Isolation<'_, T> {
    /// Treat one piece, given in plain Bernstein form.
    fn piece(&mut self, local: Polynomial, [low, high]: [f64; 2]) -> Result<(), Doubt> {
        let (values, errors) = self.arena.coefficients(local);
        match Variations::of(values, errors) {
            Variations::Zero => self.append(Sign::Zero, high),
            Variations::None(sign) => self.append(Sign::from_direction(sign), high),
            Variations::One(sign) => return self.root(local, [low, high], sign),
            Variations::Unknown => return self.unknown(high),
            Variations::UnknownFirst(sign) if low == 0.0 => {
                self.certain_enough()?;
                let width = self.edge(local, [low, high], false);
                self.append(Sign::Edge, width);
                self.append(Sign::from_direction(sign), high);
            }
            Variations::UnknownLast(sign) if high == 1.0 => {
                self.certain_enough()?;
                let width = self.edge(local, [low, high], true);
                self.append(Sign::from_direction(sign), high - width);
                self.append(Sign::Edge, high);
            }
            _ if high - low <= SMALLEST_PIECE => return self.unknown(high),
            _ => return self.parts(local, [low, high]),
        }
        Ok(())
    }

    fn parts(&mut self, local: Polynomial, [low, high]: [f64; 2]) -> Result<(), Doubt> {
        let mark = self.arena.mark();
        let width = high - low;
        let cuts = if width == 1.0 { FIRST_CUTS } else { CUTS };
        // Inside a segment the ends of pieces are exact; where a cut would not be, 2⁻⁵³ has come
        // into sight, and cutting ends.
        let exact = |cut: f64| {
            let middle = low + width * cut;
            (middle - low == width * cut && high - middle == width * (1.0 - cut)).then_some(middle)
        };
        let mut parts = None;
        for (cut, middle) in cuts.iter().filter_map(|cut| Some((*cut, exact(*cut)?))) {
            self.arena.release(mark);
            let (left, right) = self.arena.split(local, cut);
            parts = Some((left, right, middle));
            let (values, errors) = self.arena.coefficients(right);
            if matches!(
                Variations::of(&values[..1], &errors[..1]),
                Variations::None(_)
            ) {
                break;
            }
        }
        let Some((left, right, middle)) = parts else {
            return self.unknown(high);
        };
        self.piece(left, [low, middle])?;
        self.piece(right, [middle, high])?;
        self.arena.release(mark);
        Ok(())
    }

    /// Narrow the interval of a proved root.
    fn root(&mut self, local: Polynomial, ends: [f64; 2], sign: i8) -> Result<(), Doubt> {
        let (values, _) = self.arena.coefficients(local);
        let value = |end: Option<&T>| end.map_or(0.0, |value| value.rounded());
        let values = [value(values.first()), value(values.last())];
        let bracket = Bracket { ends, values, sign };
        let evaluate = |t| self.arena.evaluate(self.polynomial, t);
        let [low, high] = refine(bracket, ROOT_WIDTH, evaluate);
        if high - low > ROOT_WIDTH {
            self.certain_enough()?;
        }
        self.append(Sign::from_direction(sign), low);
        self.append(Sign::Root { value: 0.0 }, high);
        self.append(Sign::from_direction(-sign), ends[1]);
        Ok(())
    }

    fn unknown(&mut self, high: f64) -> Result<(), Doubt> {
        self.certain_enough()?;
        self.append(Sign::Unknown, high);
        Ok(())
    }

    /// Find how small a piece at an end of the segment, the sign of whose last coefficient is
    /// unknown, can be made. The rest of `local` has the sign of its other coefficients.
    fn edge(&mut self, mut local: Polynomial, [low, high]: [f64; 2], at_end: bool) -> f64 {
        const KEPT: f64 = 1.0 / 16.0;
        let mark = self.arena.mark();
        let mut width = high - low;
        while width > 0.5 * ROOT_WIDTH {
            let (left, right) = self
                .arena
                .split(local, if at_end { 1.0 - KEPT } else { KEPT });
            let (edge, rest) = if at_end { (right, left) } else { (left, right) };
            let (values, errors) = self.arena.coefficients(edge);
            let kept = Variations::of(values, errors);
            let (values, errors) = self.arena.coefficients(rest);
            let freed = Variations::of(values, errors);
            let narrower = matches!(
                kept,
                Variations::UnknownFirst(_) | Variations::UnknownLast(_)
            ) && matches!(freed, Variations::None(_));
            if !narrower {
                break;
            }
            (local, width) = (edge, width * KEPT);
        }
        self.arena.release(mark);
        width
    }

    fn certain_enough(&self) -> Result<(), Doubt> {
        match self.effort {
            Effort::Quick => Err(Doubt),
            Effort::Thorough => Ok(()),
        }
    }

    fn append(&mut self, sign: Sign, until: f64) {
        append(self.pieces, sign, until);
    }
}
