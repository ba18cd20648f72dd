//! Reference curves: curves given by formulas or points, to draw after, to measure by and to
//! approximate, never edited by vertices.
//!
//! A kind is a value ([`ReferenceKind`]): its words, its parameters described once, and one function
//! that expands the curve in a power series. Fields and command line read that description. A new
//! kind is a file here that exports a `pub static KIND`, and a line in the table below.

mod curve;
mod error;
mod form;
mod formula;
mod integral;
mod kind;
mod placement;
mod point_list;
mod text;

pub use curve::ReferenceCurve;
pub use error::{ReferenceError, ReferenceTextError};
pub use form::{AnalyticForm, ReferenceForm};
pub use formula::Formula;
pub use kind::ReferenceKind;
pub use placement::Placement;
pub use point_list::PointList;

/// Declare the modules of kinds, and list their `KIND`s in this order.
macro_rules! table {
    ($($module:ident,)*) => {
        $(pub(super) mod $module;)*

        /// Every kind, in the order in which they are offered.
        pub static KINDS: &[&ReferenceKind] = &[$(&$module::KIND,)*];
    };
}

table! {
    circle,
    ellipse,
    parabola,
    catenary,
    circle_involute,
    logarithmic_spiral,
    archimedean_spiral,
    clothoid,
    nielsen_spiral,
    log_aesthetic,
    superspiral,
    helix,
    cubic_helix,
    conical_helix,
    conical_spiral,
}

/// Find a kind by its name.
pub fn find(name: &str) -> Option<&'static ReferenceKind> {
    KINDS.iter().copied().find(|kind| kind.name == name)
}
