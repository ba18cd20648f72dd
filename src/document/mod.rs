//! What the user has made: curves, the edits that change them, and their history. Nothing in
//! here is derived from anything else, and nothing depends on how it is looked at.

mod curve;
#[allow(clippy::module_inception)]
mod document;
mod edit;
mod history;
mod names;

pub use curve::{Colour, Curve, CurveId, EndTargets};
pub use document::Document;
pub use edit::{Edit, EditError};
pub use history::History;
pub use names::free_name;
