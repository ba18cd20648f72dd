//! The selection: curves and references, one of them active, and vertices of the curves.

use std::collections::BTreeSet;

use crate::document::{CurveId, Document};

/// A vertex of a curve.
pub type VertexId = (CurveId, usize);

/// Hold the selected curves and references, the selected vertices of curves, and the active item, which panels
/// show.
///
/// The active item is selected, unless nothing is: then it is the one that panels go on to show. A curve with
/// selected vertices is selected. Where any vertex is selected, one of the active curve is: what panels show and
/// what keys act on never differ.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    vertices: BTreeSet<VertexId>,
    items: BTreeSet<CurveId>,
    active: Option<CurveId>,
}

impl Selection {
    /// The active curve or reference.
    pub fn active(&self) -> Option<CurveId> {
        self.active
    }

    /// Select a curve or a reference alone, with those of its vertices that are selected.
    pub fn activate(&mut self, item: CurveId) {
        self.vertices.retain(|(id, _)| *id == item);
        self.items = BTreeSet::from([item]);
        self.active = Some(item);
    }

    /// Make a curve or a reference the active one of those that are selected, or select it alone. Unless some of
    /// its vertices are selected, none is any more.
    pub fn focus(&mut self, item: CurveId) {
        if !self.items.contains(&item) {
            return self.activate(item);
        }
        if self.of_curve(item).next().is_none() {
            self.vertices.clear();
        }
        self.active = Some(item);
    }

    /// The selected vertices, by curve and number.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + '_ {
        self.vertices.iter().copied()
    }

    /// The selected vertices of one curve, in rising order.
    pub fn of_curve(&self, curve: CurveId) -> impl Iterator<Item = usize> + '_ {
        let range = (curve, 0)..=(curve, usize::MAX);
        self.vertices.range(range).map(|(_, index)| *index)
    }

    /// The items that commands work on: the selected ones, or else the active one.
    pub fn items(&self) -> Vec<CurveId> {
        match self.items.is_empty() {
            true => self.active.into_iter().collect(),
            false => self.items.iter().copied().collect(),
        }
    }

    /// Whether a curve or a reference is selected.
    pub fn has_item(&self, item: CurveId) -> bool {
        self.items.contains(&item)
    }

    /// Whether no curve and no reference is selected.
    pub fn has_no_item(&self) -> bool {
        self.items.is_empty()
    }

    /// Whether more than one curve or reference is selected.
    pub fn has_several_items(&self) -> bool {
        self.items.len() > 1
    }

    /// Whether several curves or references are selected, and no vertex: drags and keys move them as a whole.
    pub fn is_of_whole_items(&self) -> bool {
        self.has_several_items() && self.is_empty()
    }

    /// Whether a vertex is selected.
    pub fn contains(&self, vertex: VertexId) -> bool {
        self.vertices.contains(&vertex)
    }

    /// Whether no vertex is selected.
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// Select just these vertices. Their curves stay selected with others, or else are selected alone; the active
    /// curve becomes that of the first.
    pub fn set(&mut self, vertices: impl IntoIterator<Item = VertexId>) {
        self.vertices = vertices.into_iter().collect();
        let mut curves = self.vertices.iter().map(|(curve, _)| *curve);
        if !curves.all(|curve| self.items.contains(&curve)) {
            self.items = self.vertices.iter().map(|(curve, _)| *curve).collect();
        }
        self.follow();
    }

    /// Select these vertices too, with their curves.
    pub fn add(&mut self, vertices: impl IntoIterator<Item = VertexId>) {
        self.vertices.extend(vertices);
        let curves = self.vertices.iter().map(|(curve, _)| *curve);
        self.items.extend(curves);
        self.follow();
    }

    /// Select a vertex that is not selected, and the other way round.
    pub fn toggle(&mut self, vertex: VertexId) {
        if self.vertices.remove(&vertex) {
            self.follow();
        } else {
            self.vertices.insert(vertex);
            self.items.insert(vertex.0);
            self.active = Some(vertex.0);
        }
    }

    /// Select just these curves and references; of their vertices those stay selected that are. The active one stays
    /// if it is among them.
    pub fn set_items(&mut self, items: impl IntoIterator<Item = CurveId>) {
        self.items = items.into_iter().collect();
        self.vertices.retain(|(id, _)| self.items.contains(id));
        self.follow();
    }

    /// Select a curve or a reference that is not selected, and the other way round.
    pub fn toggle_item(&mut self, item: CurveId) {
        if !self.items.insert(item) {
            self.items.remove(&item);
            self.vertices.retain(|(id, _)| *id != item);
        }
        self.follow();
    }

    /// Select no vertex; the curves stay selected.
    pub fn clear(&mut self) {
        self.vertices.clear();
    }

    /// Deselect what the document no longer has, and vertices that it does not show. Where the active item is gone
    /// another selected one becomes active, or else the first visible one of the document, or the first.
    pub fn retain_valid(&mut self, document: &Document) {
        let valid = |(curve, index): &VertexId| {
            let curve = document.curve(*curve);
            curve.is_some_and(|curve| curve.visible && *index < curve.polygon.vertices().len())
        };
        if !self.vertices.iter().all(valid) {
            self.vertices.retain(valid);
        }
        self.items.retain(|item| document.name(*item).is_some());
        if self
            .active
            .is_none_or(|active| document.name(active).is_none())
        {
            let seen = document.all_ids().find(|id| document.is_visible(*id));
            self.active = seen.or_else(|| document.all_ids().next());
            if self.items.is_empty() {
                self.items.extend(self.active);
            }
        }
        self.follow();
    }

    /// Let the active item be a selected one, and one of those that have selected vertices, if there are any.
    fn follow(&mut self) {
        let is_followed = self.active.is_some_and(|active| match self.is_empty() {
            true => self.items.contains(&active),
            false => self.of_curve(active).next().is_some(),
        });
        if is_followed {
            return;
        }
        let vertex = self.vertices.first().map(|(curve, _)| *curve);
        let other = vertex.or(self.items.first().copied());
        self.active = other.or(self.active);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Curve;
    use crate::geometry::FloatPolygon;

    /// A document of so many curves with three vertices each, and their identities.
    fn document(count: usize) -> (Document, Vec<CurveId>) {
        let polygon = FloatPolygon::planar(2, &[(0.0, 0.0), (1.0, 2.0), (3.0, 0.0)]);
        let curve = Curve::new("arc", polygon.expect("a polygon"));
        let document = Document::from_curves(vec![curve; count]);
        let ids = document.ids().collect();
        (document, ids)
    }

    #[test]
    fn a_visible_curve_is_active_before_a_hidden_one() {
        let polygon = FloatPolygon::planar(2, &[(0.0, 0.0), (1.0, 2.0), (3.0, 0.0)]);
        let curve = Curve::new("arc", polygon.expect("a polygon"));
        let mut hidden = curve.clone();
        hidden.visible = false;
        for (curves, active) in [(vec![hidden.clone(), curve], 1), (vec![hidden; 2], 0)] {
            let document = Document::from_curves(curves);
            let mut selection = Selection::default();
            selection.retain_valid(&document);
            assert_eq!(selection.active(), document.ids().nth(active));
        }
    }

    #[test]
    fn the_active_item_is_one_of_those_that_are_selected() {
        let (document, ids) = document(3);
        let mut selection = Selection::default();
        selection.retain_valid(&document);
        assert_eq!(
            (selection.active(), selection.items()),
            (Some(ids[0]), vec![ids[0]])
        );
        selection.toggle_item(ids[2]);
        assert_eq!(selection.active(), Some(ids[0]));
        selection.toggle_item(ids[0]);
        assert_eq!(
            (selection.active(), selection.items()),
            (Some(ids[2]), vec![ids[2]])
        );
        // The last one stays active, though it is not selected.
        selection.toggle_item(ids[2]);
        assert!(selection.has_no_item());
        assert_eq!(
            (selection.active(), selection.items()),
            (Some(ids[2]), vec![ids[2]])
        );
        selection.set_items(ids[..2].iter().copied());
        assert_eq!(selection.active(), Some(ids[0]));
    }

    #[test]
    fn vertices_are_of_selected_curves() {
        let (_, ids) = document(3);
        let mut selection = Selection::default();
        selection.set_items(ids[..2].iter().copied());
        selection.set([(ids[1], 0)]);
        assert_eq!(
            (selection.items(), selection.active()),
            (ids[..2].to_vec(), Some(ids[1]))
        );
        selection.add([(ids[2], 1)]);
        assert_eq!(selection.items(), ids);
        selection.toggle_item(ids[1]);
        assert_eq!(selection.vertices().collect::<Vec<_>>(), [(ids[2], 1)]);
        assert_eq!(selection.active(), Some(ids[2]));
        selection.set([(ids[1], 2)]);
        assert_eq!(selection.items(), [ids[1]]);
    }

    #[test]
    fn what_is_gone_is_not_selected() {
        let (document, ids) = document(3);
        let mut selection = Selection::default();
        selection.set_items(ids[1..].iter().copied());
        let left = document.edited([crate::document::Edit::Remove(ids[1])]);
        selection.retain_valid(&left.expect("a document"));
        assert_eq!(
            (selection.items(), selection.active()),
            (vec![ids[2]], Some(ids[2]))
        );
    }
}
