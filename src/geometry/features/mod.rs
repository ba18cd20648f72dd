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
//!   both are monotone. A curve whose vertices lie in one plane exactly has no torsion.
//! - What is proved of the doubles given but lies within their rounding is left out at the end: straight stretches,
//!   circles and plane curves in space would have features of rounding ([`Features::exact`] has them).
//! - A root at an end of a segment is one of its knot: it counts if the sign changes there.
//! - A root of odd multiplicity is a change of sign, one of even multiplicity is none. Whole numbers
//!   take multiplicities out first: what is left has simple roots only, which pieces that are small
//!   enough separate, and no piece is cut at a root. Rounded numbers leave a piece in doubt if the
//!   sign at its end is. So no cut hides a root.
//! - Cusps inside a segment are the roots that all components of the tangent share: their common
//!   divisor is exact, wherever they are.
//! - What a curvature does at a cusp, and a torsion at a knot without curvature, is left open: a
//!   change of sign there, and all of a piece that touches it on which the function is 0, is
//!   undecided.
//! - Only one other thing stays undecided, and is named ([`Undecided`]), never guessed: segments
//!   whose exact numbers would take too long, if twice the digits are not enough for them. Their
//!   coordinates and weights differ in size by 1e60 and more, at high degrees; or they have so many
//!   roots so close to each other that separating them takes more than a bounded number of steps.

mod arena;
mod certain_digits;
mod common_divisor;
mod curve_features;
mod enclosure;
mod exact_isolation;
mod exact_numerators;
mod exact_polynomial;
mod exact_values;
mod feature;
mod floating;
mod isolation;
mod numerators;
mod power_velocity;
mod ray_forecast;
mod refinement;
mod ring;
mod rounding;
mod scalar;
mod segment_features;
mod segment_shape;
mod separation;
mod sign_piece;
mod sign_walk;
mod square_free;
mod trends;
mod turning;
mod values;
mod variations;

pub use certain_digits::certain_text;
pub use feature::{
    Cusp, Extremum, ExtremumKind, Feature, Features, Root, Trend, TrendPiece, Undecided, Verdict,
};
pub(super) use power_velocity::PowerVelocity;
pub(super) use ray_forecast::RayForecast;
pub use segment_features::{LocalCusp, SegmentFeatures, SegmentProver};
pub use sign_piece::{Sign, SignPiece};
pub use turning::Turning;
