//! Reference curves: curves given by formulas, points or knots of their own, to draw after, to measure by and to
//! approximate, never edited by vertices.
//!
//! A kind is a value ([`ReferenceKind`]): its words, its parameters described once, and one function
//! that expands the curve in a power series. Fields and command line read that description. A new
//! kind is a row in [`formulas`], or a file of its own if its points are integrals, and a line in
//! [`KINDS`].

pub(super) mod clothoid;
mod curve;
mod error;
mod form;
mod formula;
pub mod formulas;
mod frame;
mod integral;
mod kind;
pub(super) mod log_aesthetic;
mod nielsen_spiral;
mod nurbs;
mod nurbs_float;
mod placement;
mod point_list;
pub(super) mod superspiral;
mod text;

pub use curve::ReferenceCurve;
pub use error::{ReferenceError, ReferenceTextError};
pub use form::{AnalyticForm, ReferenceForm};
pub use formula::Formula;
pub use frame::Frame;
pub use kind::ReferenceKind;
pub use nurbs::{Nurbs, NurbsError};
pub use placement::Placement;
pub use point_list::PointList;

/// Every kind, in the order in which they are offered.
pub static KINDS: &[&ReferenceKind] = &[
    &formulas::CIRCLE,
    &formulas::ELLIPSE,
    &formulas::PARABOLA,
    &formulas::CATENARY,
    &formulas::CIRCLE_INVOLUTE,
    &formulas::LOGARITHMIC_SPIRAL,
    &formulas::ARCHIMEDEAN_SPIRAL,
    &clothoid::KIND,
    &nielsen_spiral::KIND,
    &log_aesthetic::KIND,
    &superspiral::KIND,
    &formulas::HELIX,
    &formulas::CUBIC_HELIX,
    &formulas::CONICAL_HELIX,
    &formulas::CONICAL_SPIRAL,
];

/// Find a kind by its name.
pub fn find(name: &str) -> Option<&'static ReferenceKind> {
    KINDS.iter().copied().find(|kind| kind.name == name)
}
