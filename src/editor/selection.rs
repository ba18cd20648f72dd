//! The selection: vertices, and the active curve or reference that panels show.

use std::collections::BTreeSet;

use crate::document::{CurveId, Document};

/// A vertex of a curve.
pub type VertexId = (CurveId, usize);

/// Hold the selected vertices and the active curve. Where any vertex is selected, one of the active
/// curve is: what panels show and what keys act on never differ.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    vertices: BTreeSet<VertexId>,
    active: Option<CurveId>,
}

impl Selection {
    /// The active curve or reference.
    pub fn active(&self) -> Option<CurveId> {
        self.active
    }

    /// Make a curve or a reference the active one. Unless some of its vertices are selected, none is any more.
    pub fn activate(&mut self, curve: CurveId) {
        self.active = Some(curve);
        if self.of_curve(curve).next().is_none() {
            self.vertices.clear();
        }
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

    /// The items that are selected: curves with selected vertices, or else the active curve or reference.
    pub fn items(&self) -> Vec<CurveId> {
        let mut items: Vec<CurveId> = self.vertices.iter().map(|(curve, _)| *curve).collect();
        items.dedup();
        match items.is_empty() {
            true => self.active.into_iter().collect(),
            false => items,
        }
    }

    /// Whether a vertex is selected.
    pub fn contains(&self, vertex: VertexId) -> bool {
        self.vertices.contains(&vertex)
    }

    /// Whether no vertex is selected.
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// Select just these vertices; the active curve becomes that of the first.
    pub fn set(&mut self, vertices: impl IntoIterator<Item = VertexId>) {
        self.vertices = vertices.into_iter().collect();
        self.follow();
    }

    /// Select these vertices too.
    pub fn add(&mut self, vertices: impl IntoIterator<Item = VertexId>) {
        self.vertices.extend(vertices);
        self.follow();
    }

    /// Select a vertex that is not selected, and the other way round.
    pub fn toggle(&mut self, vertex: VertexId) {
        if self.vertices.remove(&vertex) {
            self.follow();
        } else {
            self.vertices.insert(vertex);
            self.active = Some(vertex.0);
        }
    }

    /// Select a curve beside the active one, all vertices of both, or take it back.
    pub fn toggle_curve(&mut self, curve: CurveId, document: &Document) {
        if self.of_curve(curve).next().is_some() {
            self.vertices.retain(|(id, _)| *id != curve);
            return self.follow();
        }
        // The active curve goes along, unless some of its vertices are selected.
        let active = self.active;
        let active = active.filter(|id| self.of_curve(*id).next().is_none());
        let all = |id: CurveId| {
            let found = document.curve(id);
            let count = found.map_or(0, |it| it.polygon.vertices().len());
            (0..count).map(move |vertex| (id, vertex))
        };
        self.add(active.into_iter().chain([curve]).flat_map(all));
    }

    /// Select no vertex; the active curve stays.
    pub fn clear(&mut self) {
        self.vertices.clear();
    }

    /// Deselect vertices that the document no longer has or does not show.
    pub fn retain_valid(&mut self, document: &Document) {
        let valid = |(curve, index): &VertexId| {
            let curve = document.curve(*curve);
            curve.is_some_and(|curve| curve.visible && *index < curve.polygon.vertices().len())
        };
        if !self.vertices.iter().all(valid) {
            self.vertices.retain(valid);
        }
        if self
            .active
            .is_none_or(|active| document.name(active).is_none())
        {
            self.active = document.all_ids().next();
        }
        self.follow();
    }

    /// Let the active curve be one of those that have selected vertices, if there are any.
    fn follow(&mut self) {
        let holds_active = self
            .active
            .is_some_and(|active| self.of_curve(active).next().is_some());
        if !holds_active && let Some((curve, _)) = self.vertices.first() {
            self.active = Some(*curve);
        }
    }
}
