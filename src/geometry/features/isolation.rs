//! Proving where a polynomial has which sign on \[0, 1\], by subdivision.

use super::arena::{Arena, Polynomial};
use super::refinement::{Bracket, refine};
use super::scalar::Scalar;
use super::sign_piece::{Sign, SignPiece, append};
use super::variations::{Variations, certain_sign};

/// The width to which the interval of a root is narrowed, in the segment's parameter. The
/// domain is not shorter than a segment.
pub(super) const ROOT_WIDTH: f64 = 1e-12;

/// Pieces below this width, in the segment's parameter, are not cut again: 2⁻³¹ < 1e-9.
const SMALLEST_PIECE: f64 = 1.0 / (1_u64 << 31) as f64;

/// Where to cut the whole segment: off the middle, where symmetrical curves have their roots. If
/// the sign at one place cannot be told the next is tried.
const FIRST_CUTS: [f64; 3] = [125.0 / 256.0, 139.0 / 256.0, 107.0 / 256.0];

/// Cut of its pieces. Few binary digits keep the ends of all pieces exact.
const CUTS: [f64; 3] = [0.5, 0.375, 0.625];

/// Says that rounding leaves signs in doubt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Doubt {
    /// No coefficient's sign is known.
    Everywhere,
    /// Some of them are.
    Somewhere,
}

/// Append pieces that cover \[0, 1\] and say where a polynomial in scaled form has which sign.
///
/// No cut hides a root: where the sign at a cut is not certain, both pieces end with a coefficient
/// of unknown sign, which may be a change, so neither counts as decided.
///
/// A piece that is not decided is cut in two. Of the pieces of one size no more than a small
/// multiple of the polynomial's degree N remain undecided, because each has a complex root near
/// it, or one of the polynomial plus or minus its error bound; so the cost is at most O(31 N)
/// cuts of O(N²) operations.
///
/// # Errors
/// [`Doubt`] if a piece is lost in rounding, or still undecided below 1e-9, as about multiple roots.
pub(super) fn isolate<T: Scalar>(
    arena: &mut Arena<T>,
    polynomial: Polynomial,
    pieces: &mut Vec<SignPiece>,
) -> Result<(), Doubt> {
    let (values, errors) = arena.coefficients(polynomial);
    if Variations::of(values, errors) == Variations::Unknown {
        return Err(Doubt::Everywhere);
    }
    // Cutting brings no other coefficient to an end.
    let known = |end: Option<(&T, &f64)>| {
        end.is_none_or(|(value, error)| certain_sign(value.rounded(), *error).is_some())
    };
    let mut coefficients = values.iter().zip(errors);
    if !known(coefficients.clone().next()) || !known(coefficients.next_back()) {
        return Err(Doubt::Somewhere);
    }
    let mark = arena.mark();
    let whole = arena.unscale(polynomial);
    let mut isolation = Isolation {
        arena,
        polynomial,
        pieces,
    };
    let result = isolation.piece(whole, [0.0, 1.0]);
    arena.release(mark);
    result
}

/// The place of a cut if it is exact: inside a segment the ends of pieces are. Where it would not
/// be, 2⁻⁵³ has come into sight, and cutting ends.
pub(super) fn exact_cut([low, high]: [f64; 2], share: f64) -> Option<f64> {
    let (width, middle) = (high - low, low + (high - low) * share);
    let exact = middle - low == width * share && high - middle == width * (1.0 - share);
    exact.then_some(middle)
}

struct Isolation<'a, T> {
    arena: &'a mut Arena<T>,
    /// The polynomial in scaled form on the whole segment.
    polynomial: Polynomial,
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
            Variations::Unknown => return Err(Doubt::Somewhere),
            _ if high - low <= SMALLEST_PIECE => return Err(Doubt::Somewhere),
            _ => return self.parts(local, [low, high]),
        }
        Ok(())
    }

    fn parts(&mut self, local: Polynomial, [low, high]: [f64; 2]) -> Result<(), Doubt> {
        let mark = self.arena.mark();
        let width = high - low;
        let cuts = if width == 1.0 { FIRST_CUTS } else { CUTS };
        let mut parts = None;
        for (cut, middle) in cuts
            .iter()
            .filter_map(|cut| Some((*cut, exact_cut([low, high], *cut)?)))
        {
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
            return Err(Doubt::Somewhere);
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
            return Err(Doubt::Somewhere);
        }
        self.append(Sign::from_direction(sign), low);
        self.append(Sign::roots(1), high);
        self.append(Sign::from_direction(-sign), ends[1]);
        Ok(())
    }

    fn append(&mut self, sign: Sign, until: f64) {
        append(self.pieces, sign, until);
    }
}
