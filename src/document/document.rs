//! A document: an ordered list of curves, and one of references.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::curve::{Curve, CurveId};
use super::end_match::EndMatch;
use super::extras::Extras;
use super::group::Group;
use super::guide_line::GuideLine;
use super::names::free_name;
use super::picture::{Picture, PictureSource};
use super::reference::Reference;
use crate::geometry::ParametricCurve;
use crate::geometry::expressions::LengthUnit;

/// Hold the curves of a project and its references, each in the order in which they are listed and drawn.
///
/// Both are shared between snapshots, so copying a document is cheap.
#[derive(Clone, Debug, Default)]
pub struct Document {
    pub(super) curves: Vec<(CurveId, Arc<Curve>)>,
    pub(super) references: Vec<(CurveId, Arc<Reference>)>,
    pub(super) next: u64,
    pub(super) matches: Vec<EndMatch>,
    pub(super) unit: Option<LengthUnit>,
    pub(super) guide_lines: Vec<GuideLine>,
    extras: Extras,
}

impl Document {
    /// Make a document of some curves.
    pub fn from_curves(curves: impl IntoIterator<Item: Into<Arc<Curve>>>) -> Self {
        let mut document = Self::default();
        for curve in curves {
            document.push(curve);
        }
        document
    }

    /// Add references behind those that there are.
    pub fn with_references(
        mut self,
        references: impl IntoIterator<Item: Into<Arc<Reference>>>,
    ) -> Self {
        for reference in references {
            self.push_reference(reference);
        }
        self
    }

    /// Give the curves, then the references, the numbers that they had when the document was saved: their
    /// colours follow them. Numbers that are not one for each, or not distinct, are passed over.
    pub fn with_numbers(mut self, numbers: &[u64]) -> Self {
        let distinct: BTreeSet<u64> = numbers.iter().copied().collect();
        let fit = distinct.len() == self.curves.len() + self.references.len()
            && distinct.len() == numbers.len();
        let next = distinct.last().and_then(|last| last.checked_add(1));
        if let (true, Some(next)) = (fit, next) {
            let curves = self.curves.iter_mut().map(|(id, _)| id);
            let ids = curves.chain(self.references.iter_mut().map(|(id, _)| id));
            for (id, number) in ids.zip(numbers) {
                *id = CurveId(*number);
            }
            self.next = next;
        }
        self
    }

    /// Say in which unit the numbers of the document are lengths; `None` if nothing is said of it.
    pub fn with_unit(self, unit: Option<LengthUnit>) -> Self {
        Self { unit, ..self }
    }

    /// The unit of length of all coordinates. New documents have none: nothing is claimed that nobody said.
    pub fn unit(&self) -> Option<LengthUnit> {
        self.unit
    }

    /// Replace the guide lines. Two at one place count as one; those that are no planes are left out.
    #[must_use]
    pub fn with_guide_lines(mut self, lines: impl IntoIterator<Item = GuideLine>) -> Self {
        self.set_guide_lines(lines);
        self
    }

    /// The guide lines, in the order in which they were placed.
    pub fn guide_lines(&self) -> &[GuideLine] {
        &self.guide_lines
    }

    pub(super) fn set_guide_lines(&mut self, lines: impl IntoIterator<Item = GuideLine>) {
        self.guide_lines.clear();
        for line in lines.into_iter().filter(|it| it.is_usable()) {
            if !self.guide_lines.contains(&line) {
                self.guide_lines.push(line);
            }
        }
    }

    /// Set the unknown keys of the project's file. Every edit keeps them.
    pub fn with_extras(self, extras: Extras) -> Self {
        Self { extras, ..self }
    }

    /// The unknown keys of the project's file.
    pub fn extras(&self) -> &Extras {
        &self.extras
    }

    /// Whether the project, a curve or a reference has something that this program does not know.
    pub fn has_extras(&self) -> bool {
        let mut curves = self.curves();
        let mut references = self.references();
        !self.extras.is_empty()
            || curves.any(|(_, curve)| !curve.extras.is_empty())
            || references.any(|(_, reference)| !reference.extras.is_empty())
    }

    /// The names of all curves, then of all references.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let curves = self.curves().map(|(_, curve)| curve.name.as_str());
        curves.chain(self.references().map(|(_, it)| it.name.as_str()))
    }

    /// Find a name that neither a curve nor a reference has: this one, or with another number behind it.
    pub fn free_name(&self, name: &str) -> String {
        free_name(name, |name| self.names().any(|taken| taken == name))
    }

    /// List the curves with their identities.
    pub fn curves(&self) -> impl ExactSizeIterator<Item = (CurveId, &Arc<Curve>)> {
        self.curves.iter().map(|(id, curve)| (*id, curve))
    }

    /// Find a curve.
    pub fn curve(&self, id: CurveId) -> Option<&Arc<Curve>> {
        self.position(id).map(|index| &self.curves[index].1)
    }

    /// List the references with their identities.
    pub fn references(&self) -> impl ExactSizeIterator<Item = (CurveId, &Arc<Reference>)> {
        let references = self.references.iter();
        references.map(|(id, reference)| (*id, reference))
    }

    /// Give the files of pictures other paths.
    #[must_use]
    pub fn with_picture_files(mut self, path: impl Fn(&Path) -> PathBuf) -> Self {
        let has_file = |it: &Reference| it.picture.as_ref().is_some_and(|it| it.file().is_some());
        for (_, reference) in self.references.iter_mut().filter(|(_, it)| has_file(it)) {
            if let Some(Picture {
                source: PictureSource::File(file),
                ..
            }) = &mut Arc::make_mut(reference).picture
            {
                *file = path(file);
            }
        }
        self
    }

    /// The document without its pictures, and their names.
    pub fn without_pictures(&self) -> (Self, Vec<String>) {
        let mut document = self.clone();
        let is_picture = |it: &Reference| it.picture.is_some();
        let pictures = self.references().filter(|(_, it)| is_picture(it));
        let names = pictures.map(|(_, it)| it.name.clone()).collect();
        document.references.retain(|(_, it)| !is_picture(it));
        (document, names)
    }

    /// Find a reference.
    pub fn reference(&self, id: CurveId) -> Option<&Arc<Reference>> {
        let index = self.reference_position(id)?;
        self.references.get(index).map(|(_, reference)| reference)
    }

    /// Find the shape of a curve, or of a reference.
    pub fn shape(&self, id: CurveId) -> Option<&dyn ParametricCurve> {
        match self.curve(id) {
            Some(curve) => Some(&curve.polygon),
            None => Some(&self.reference(id)?.curve),
        }
    }

    /// The name of a curve, or of a reference.
    pub fn name(&self, id: CurveId) -> Option<&str> {
        match self.curve(id) {
            Some(curve) => Some(&curve.name),
            None => Some(&self.reference(id)?.name),
        }
    }

    /// The group of a curve, or of a reference.
    pub fn group(&self, id: CurveId) -> Option<&Group> {
        match self.curve(id) {
            Some(curve) => Some(&curve.group),
            None => Some(&self.reference(id)?.group),
        }
    }

    /// The curves, then the references, that a group or a group within it holds.
    pub fn members<'a>(&'a self, group: &'a Group) -> impl Iterator<Item = CurveId> + 'a {
        let curves = self.curves().map(|(id, curve)| (id, &curve.group));
        let references = self.references().map(|(id, it)| (id, &it.group));
        let members = curves.chain(references).filter(|(_, own)| group.holds(own));
        members.map(|(id, _)| id)
    }

    /// Whether a curve, or a reference, is there and drawn.
    pub fn is_visible(&self, id: CurveId) -> bool {
        self.curve(id).is_some_and(|curve| curve.visible)
            || self.reference(id).is_some_and(|it| it.visible)
    }

    /// The identities of all curves, in order.
    pub fn ids(&self) -> impl Iterator<Item = CurveId> + '_ {
        self.curves.iter().map(|(id, _)| *id)
    }

    /// The identities of all curves, then of all references, in order.
    pub fn all_ids(&self) -> impl Iterator<Item = CurveId> + '_ {
        self.ids().chain(self.references.iter().map(|(id, _)| *id))
    }

    /// The number of curves.
    pub fn len(&self) -> usize {
        self.curves.len()
    }

    /// Whether there is neither a curve nor a reference.
    pub fn is_empty(&self) -> bool {
        self.curves.is_empty() && self.references.is_empty()
    }

    /// Whether the other document holds equal curves and equal references in the same order, the same matches,
    /// unit, guide lines and unknown keys. Shared curves are not compared number by number.
    pub fn is_same(&self, other: &Self) -> bool {
        self.unit == other.unit
            && self.matches == other.matches
            && self.guide_lines == other.guide_lines
            && self.extras == other.extras
            && are_same(&self.curves, &other.curves)
            && are_same(&self.references, &other.references)
    }

    /// The identity that the next added curve or reference will get.
    pub fn next_id(&self) -> CurveId {
        CurveId(self.next)
    }

    /// The identities that the next added curves and references will get.
    pub fn next_ids(&self) -> impl Iterator<Item = CurveId> {
        (self.next..).map(CurveId)
    }

    pub(super) fn push(&mut self, curve: impl Into<Arc<Curve>>) -> CurveId {
        let id = self.next_id();
        self.next += 1;
        self.curves.push((id, curve.into()));
        id
    }

    pub(super) fn push_reference(&mut self, reference: impl Into<Arc<Reference>>) -> CurveId {
        let id = self.next_id();
        self.next += 1;
        self.references.push((id, reference.into()));
        id
    }

    pub(super) fn reference_position(&self, id: CurveId) -> Option<usize> {
        position(&self.references, id)
    }

    pub(super) fn position(&self, id: CurveId) -> Option<usize> {
        position(&self.curves, id)
    }
}

/// The place of an item. Items that nobody has reordered stand in the order of their identities: of thousands one is found
/// at once.
fn position<T>(items: &[(CurveId, T)], id: CurveId) -> Option<usize> {
    let sorted = items.binary_search_by_key(&id, |(other, _)| *other);
    let linear = |_| items.iter().position(|(other, _)| *other == id).ok_or(());
    sorted.or_else(linear).ok()
}

/// Whether two lists hold equal items with the same identities.
fn are_same<T: PartialEq>(a: &[(CurveId, Arc<T>)], b: &[(CurveId, Arc<T>)]) -> bool {
    let mut pairs = a.iter().zip(b);
    a.len() == b.len() && pairs.all(|(a, b)| a.0 == b.0 && (Arc::ptr_eq(&a.1, &b.1) || a.1 == b.1))
}
