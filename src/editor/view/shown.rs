//! A curve or a reference, as what is derived from it remembers it.

use std::sync::Arc;

use crate::document::{Curve, CurveId, Document, Reference};

/// A state of a curve or of a reference. Two are equal if they are the very same one.
#[derive(Clone, Debug)]
pub enum Shown {
    /// A curve.
    Curve(Arc<Curve>),
    /// A reference.
    Reference(Arc<Reference>),
}

impl Shown {
    /// Find a curve or a reference of a document.
    pub fn of(document: &Document, id: CurveId) -> Option<Self> {
        match document.curve(id) {
            Some(curve) => Some(Self::Curve(curve.clone())),
            None => Some(Self::Reference(document.reference(id)?.clone())),
        }
    }
}

impl PartialEq for Shown {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Curve(a), Self::Curve(b)) => Arc::ptr_eq(a, b),
            (Self::Reference(a), Self::Reference(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}
