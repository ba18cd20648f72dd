//! What the user has made: curves, references, matches between their ends, the edits that change them, and their
//! history. Nothing in here is derived from anything else but where matched ends go, and nothing
//! depends on how it is looked at.

mod curve;
#[allow(clippy::module_inception)]
mod document;
mod edit;
mod end_match;
mod error;
mod extras;
mod following;
mod group;
mod guide_line;
mod history;
mod locked_vertices;
mod merging;
mod names;
mod picture;
mod reference;
mod renumbering;
mod symmetric;
mod unit_conversion;
mod wording;

pub use curve::{Colour, Curve, CurveId, EndTargets};
pub use document::Document;
pub use edit::Edit;
pub use end_match::{EndMatch, MatchPlace};
pub use error::EditError;
pub use extras::Extras;
pub use group::Group;
pub use guide_line::GuideLine;
pub use history::History;
pub use locked_vertices::LockedVertices;
pub use merging::{Merge, MergeError, UnitRemark};
pub use names::free_name;
pub use picture::{Picture, PictureSource};
pub use reference::Reference;
pub use renumbering::{ParameterSpan, Renumbering};
pub use wording::{cut, escaped, first_quoted, quoted};
