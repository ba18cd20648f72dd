//! Proved features of a curve: inflections, extrema of curvature and torsion, zeros of torsion,
//! cusps, and whether the curvature is monotone.
//!
//! The given doubles count as exact. On each segment the features are roots of polynomials made
//! of the derivatives (see the numerators' module), multiplied out in Bernstein form with a
//! bound of every rounding. Descartes' rule on the coefficients whose signs the bounds leave no
//! doubt of proves a piece empty, or proves that it holds one simple root; other pieces are
//! cut in two. What plain doubles leave in doubt is repeated with twice the digits, and what is
//! in doubt then is named, never guessed: see [`Undecided`]. Nothing is divided by the tangent.
//!
//! - A straight line has constant curvature 0: no extrema, and it is monotone.
//! - Vertices that lie on a line exactly are recognised, also a straight piece next to a bend.
//! - Curvature that is exactly constant but not 0, as on a circle written as a rational curve, is
//!   undecided: rounded numbers cannot tell a slope of 0 from a tiny one. So is the torsion of a
//!   plane curve in space, unless z is constant or rounding has moved the vertices off the plane;
//!   then the torsion of the doubles given is proved, however small. The work stays bounded.
//! - Two roots closer than 1e-9, and a root that the end of an open curve cannot be told from,
//!   are undecided, in a piece of that size. So is a knot of a curve of degree 2 (torsion: 3)
//!   at which both sides agree within rounding while the trend does not change.
//! - Coordinates below 1e-60 of a segment's size pass for rounding.

mod arena;
mod curve_features;
mod double_double;
mod enclosure;
mod feature;
mod isolation;
mod numerators;
mod refinement;
mod scalar;
mod segment_features;
mod segment_shape;
mod sign_piece;
mod sign_walk;
mod tables;
mod variations;

pub use feature::{
    Cusp, Extremum, ExtremumKind, Features, Quantity, Trend, TrendPiece, Undecided, Verdict,
};
pub use segment_features::{LocalCusp, SegmentFeatures, SegmentProver};
pub use sign_piece::{Sign, SignPiece};
