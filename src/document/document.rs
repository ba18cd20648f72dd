//! A document: an ordered list of curves.

use std::sync::Arc;

use super::curve::{Curve, CurveId};
use super::end_match::EndMatch;
use super::extras::Extras;
use super::names::free_name;

/// Hold the curves of a project, in the order in which they are listed and drawn.
///
/// Curves are shared between snapshots, so copying a document is cheap.
#[derive(Clone, Debug, Default)]
pub struct Document {
    pub(super) curves: Vec<(CurveId, Arc<Curve>)>,
    pub(super) next: u64,
    pub(super) matches: Vec<EndMatch>,
    extras: Extras,
}

impl Document {
    /// Make a document of some curves.
    pub fn from_curves(curves: impl IntoIterator<Item = Curve>) -> Self {
        let mut document = Self::default();
        for curve in curves {
            document.push(curve);
        }
        document
    }

    /// Add what the project's file said that this program does not know. Every edit keeps it.
    pub fn with_extras(self, extras: Extras) -> Self {
        Self { extras, ..self }
    }

    /// What the project's file said that this program does not know.
    pub fn extras(&self) -> &Extras {
        &self.extras
    }

    /// Whether the project or a curve has something that this program does not know.
    pub fn has_extras(&self) -> bool {
        let mut curves = self.curves();
        !self.extras.is_empty() || curves.any(|(_, curve)| !curve.extras.is_empty())
    }

    /// Find a name that no curve has: this one, or with another number behind it.
    pub fn free_name(&self, name: &str) -> String {
        free_name(name, |name| {
            self.curves().any(|(_, curve)| curve.name == name)
        })
    }

    /// List the curves with their identities.
    pub fn curves(&self) -> impl ExactSizeIterator<Item = (CurveId, &Arc<Curve>)> {
        self.curves.iter().map(|(id, curve)| (*id, curve))
    }

    /// Find a curve.
    pub fn curve(&self, id: CurveId) -> Option<&Arc<Curve>> {
        self.position(id).map(|index| &self.curves[index].1)
    }

    /// The identities of all curves, in order.
    pub fn ids(&self) -> impl Iterator<Item = CurveId> + '_ {
        self.curves.iter().map(|(id, _)| *id)
    }

    /// The number of curves.
    pub fn len(&self) -> usize {
        self.curves.len()
    }

    /// Whether there is no curve.
    pub fn is_empty(&self) -> bool {
        self.curves.is_empty()
    }

    /// Whether the other document holds equal curves in the same order, and the same matches. Curves that both share
    /// are not compared number by number.
    pub fn is_same(&self, other: &Self) -> bool {
        let mut pairs = self.curves.iter().zip(&other.curves);
        self.curves.len() == other.curves.len()
            && self.matches == other.matches
            && pairs.all(|(a, b)| a.0 == b.0 && (Arc::ptr_eq(&a.1, &b.1) || a.1 == b.1))
    }

    /// The identity that the next added curve will get.
    pub fn next_id(&self) -> CurveId {
        CurveId(self.next)
    }

    /// The identities that the next added curves will get.
    pub fn next_ids(&self) -> impl Iterator<Item = CurveId> {
        (self.next..).map(CurveId)
    }

    pub(super) fn push(&mut self, curve: Curve) -> CurveId {
        let id = self.next_id();
        self.next += 1;
        self.curves.push((id, Arc::new(curve)));
        id
    }

    pub(super) fn position(&self, id: CurveId) -> Option<usize> {
        self.curves.iter().position(|(other, _)| *other == id)
    }
}
