//! Why an edit cannot be made.

use thiserror::Error;

use super::wording::quoted;
use crate::geometry::PolygonError;
use crate::geometry::references::ReferenceError;

/// Why an edit cannot be made; the document is as it was.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum EditError {
    /// The curve is not in the document.
    #[error("the curve is no longer in the document")]
    NoSuchCurve,
    /// Nothing in the document is in the group.
    #[error("there is no group {}", quoted(.group))]
    NoSuchGroup {
        /// The path of the group.
        group: String,
    },
    /// The curve is locked.
    #[error("{} is locked: unlock it in the list of curves to change its shape", quoted(.name))]
    Locked {
        /// The curve's name.
        name: String,
    },
    /// The curve is hidden: nobody would see the change.
    #[error("{} is hidden: show it in the list of curves to change it", quoted(.name))]
    Hidden {
        /// The curve's name.
        name: String,
    },
    /// A vertex is locked.
    #[error("vertex {vertex} of {} is locked: unlock it to change or delete it", quoted(.name))]
    LockedVertex {
        /// The curve's name.
        name: String,
        /// The vertex, counted from 0.
        vertex: usize,
    },
    /// The curve's new shape is not one.
    #[error("{}: {error}", quoted(.name))]
    Polygon {
        /// The curve's name.
        name: String,
        /// The reason.
        error: PolygonError,
    },
    /// A polygon has other numbers of vertices than the curve: the edit needs a renumbering.
    #[error("{}: the new polygon has another degree or number of vertices, or opens or closes the curve", quoted(.name))]
    OtherNumbers {
        /// The curve's name.
        name: String,
    },
    /// A target has a number that cannot be used.
    #[error("a target needs numbers up to 1e100, and a direction that is not 0")]
    BadTarget,
    /// The target of an end is what its match makes it.
    #[error("the {end} of {} is matched to {}: remove the match to set its target", quoted(.name), quoted(.source_name))]
    MatchedEnd {
        /// The curve's name.
        name: String,
        /// The end.
        end: &'static str,
        /// The name of the curve that it is matched to.
        source_name: String,
    },
    /// A curve would follow itself.
    #[error("{} cannot be matched to itself: choose another curve", quoted(.name))]
    MatchToItself {
        /// The curve's name.
        name: String,
    },
    /// Curves would follow each other in a circle.
    #[error("{} follows {} already: remove that match first", quoted(.source_name), quoted(.name))]
    MatchCycle {
        /// The name of the curve that would follow.
        name: String,
        /// The name of the one that it would follow.
        source_name: String,
    },
    /// One of the curves does not have the matched place.
    #[error("{} cannot be matched to {}: an end needs an open curve, and u must lie on the curve", quoted(.name), quoted(.source_name))]
    NoMatch {
        /// The name of the curve that would follow.
        name: String,
        /// The name of the one that it would follow.
        source_name: String,
    },
    /// Both ends of a symmetric curve would be matched.
    #[error("{} cannot be symmetric and follow with both ends: one is the image of the other", quoted(.name))]
    SymmetricEnds {
        /// The curve's name.
        name: String,
    },
    /// A reference cannot be where it would be put.
    #[error("{}: {error}", quoted(.name))]
    Reference {
        /// The reference's name.
        name: String,
        /// The reason.
        error: ReferenceError,
    },
    /// The document has no unit that could be converted.
    #[error("the document has no unit: set one first")]
    NoUnit,
    /// A name is empty.
    #[error("a curve needs a name: type at least one character")]
    EmptyName,
}
