//! A state of a curve or of a reference, the key of derived data.

use std::sync::Arc;

use crate::document::{Curve, CurveId, Document, Reference};

/// A state of a curve or of a reference. Two are equal if they are the very same state: no vertex is
/// compared.
#[derive(Clone, Debug)]
pub enum Item {
    /// A curve.
    Curve(Arc<Curve>),
    /// A reference.
    Reference(Arc<Reference>),
}

impl Item {
    /// Find a curve or a reference of a document.
    pub fn of(document: &Document, id: CurveId) -> Option<Self> {
        match document.curve(id) {
            Some(curve) => Some(Self::Curve(curve.clone())),
            None => Some(Self::Reference(document.reference(id)?.clone())),
        }
    }

    /// Whether a curve or a reference of a document is in this state.
    pub fn is_of(&self, document: &Document, id: CurveId) -> bool {
        match self {
            Self::Curve(own) => document.curve(id).is_some_and(|it| Arc::ptr_eq(own, it)),
            Self::Reference(own) => document
                .reference(id)
                .is_some_and(|it| Arc::ptr_eq(own, it)),
        }
    }
}

impl PartialEq for Item {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Curve(own), Self::Curve(other)) => Arc::ptr_eq(own, other),
            (Self::Reference(own), Self::Reference(other)) => Arc::ptr_eq(own, other),
            _ => false,
        }
    }
}
