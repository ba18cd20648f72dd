//! Proved features of a curve: inflections, extrema of curvature and torsion, zeros of torsion,
//! cusps, and whether the curvature is monotone.
//!
//! The given doubles count as exact. On each segment the features are roots of polynomials made
//! of the derivatives (see the numerators' module), multiplied out in Bernstein form with a
//! bound of every rounding. Descartes' rule on the coefficients whose signs the bounds leave no
//! doubt of proves a piece empty, or proves that it holds one simple root; other pieces are
//! cut in two. What plain doubles leave in doubt is repeated with twice the digits, and what is
//! in doubt then with whole numbers of any length. Nothing is divided by the tangent.
//!
//! - A straight line has constant curvature 0, an exact circle a constant one: no extrema, and
//!   both are monotone. A curve whose vertices lie in one plane exactly has no torsion; once
//!   rounding has moved them off it the torsion of the doubles given is proved, however small.
//! - A root at an end of a segment is one of its knot: it counts if the sign changes there.
//! - What a curvature does at a cusp, and a torsion at a knot without curvature, is left open: a
//!   change of sign there, and all of a piece that touches it on which the function is 0, is
//!   undecided.
//! - Only two other things stay undecided, and are named ([`Undecided`]), never guessed: roots
//!   closer than 1e-9, double ones among them, in a piece of that size; and whole segments whose
//!   coordinates and weights differ so much in size that exact numbers would take too long, if
//!   twice the digits are not enough for them: 1e60 and more between two of them, at high degrees.

mod arena;
mod certain_digits;
mod common_divisor;
mod curve_features;
mod double_double;
mod enclosure;
mod exact_isolation;
mod exact_numerators;
mod exact_polynomial;
mod exact_values;
mod feature;
mod floating;
mod isolation;
mod numerators;
mod refinement;
mod scalar;
mod segment_features;
mod segment_shape;
mod separation;
mod sign_piece;
mod sign_walk;
mod square_free;
mod tables;
mod values;
mod variations;
pub(super) mod whole_numbers;

pub use certain_digits::certain_digits;
pub use feature::{
    Cusp, Extremum, ExtremumKind, Features, Quantity, Root, Trend, TrendPiece, Undecided, Verdict,
};
pub use segment_features::{LocalCusp, SegmentFeatures, SegmentProver};
pub use sign_piece::{Sign, SignPiece};
