//! The workspace and the hand, as far as the view needs them.

use std::sync::Arc;

use glam::DVec2;

use crate::document::{Curve, CurveId, Document};
use crate::editor::selection::Selection;
use crate::editor::view::layers::Layers;
use crate::editor::workspace::Workspace;

/// Borrow the document, the selection and the pointer for one call of the view.
#[derive(Clone, Copy)]
pub struct Shown<'a> {
    /// The document, with its preview and without.
    pub workspace: &'a Workspace,
    /// The selected vertices, and the active curve or reference.
    pub selection: &'a Selection,
    /// The visible layers: the user's choice, as the tool in use changes it.
    pub layers: Layers,
    /// The pointer's place on the canvas, in screen points.
    pub pointer: Option<DVec2>,
    /// Whether the hand drags something.
    pub is_dragging: bool,
    /// Whether the primary button is held on the canvas.
    pub is_holding: bool,
    /// How often Tab was pressed over items that overlap.
    pub cycle: usize,
}

impl<'a> Shown<'a> {
    /// The document, with the preview.
    pub fn document(&self) -> &'a Document {
        self.workspace.document()
    }

    /// The active curve or reference.
    pub fn active(&self) -> Option<CurveId> {
        self.selection.active()
    }

    /// The active curve without the preview.
    pub fn settled_active(&self) -> Option<&'a Arc<Curve>> {
        self.workspace.settled().curve(self.active()?)
    }

    /// The only selected vertex.
    pub fn only_vertex(&self) -> Option<(CurveId, usize)> {
        let mut selected = self.selection.vertices();
        selected.next().filter(|_| selected.next().is_none())
    }
}
