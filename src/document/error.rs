//! Why an edit cannot be made.

use thiserror::Error;

use super::wording::quoted;
use crate::geometry::PolygonError;

/// Why an edit cannot be made; the document is as it was.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum EditError {
    /// The curve is not in the document.
    #[error("the curve is no longer in the document")]
    NoSuchCurve,
    /// The curve is locked.
    #[error("{} is locked: unlock it in the list of curves to change its shape", quoted(.name))]
    Locked {
        /// The curve's name.
        name: String,
    },
    /// The curve is hidden: nobody would see what is done to it.
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
        /// What is wrong with it.
        error: PolygonError,
    },
    /// A target has a number that cannot be used.
    #[error("a target needs numbers up to 1e100, and a direction that is not 0")]
    BadTarget,
    /// A name is empty.
    #[error("a curve needs a name: type at least one character")]
    EmptyName,
}
