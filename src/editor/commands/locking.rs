//! Locking vertices.

use std::collections::BTreeSet;

use crate::document::{CurveId, Edit};
use crate::editor::Editor;
use crate::editor::reply::{Note, Reply};
use crate::geometry::counted;

impl Editor {
    /// Lock vertices of a curve or unlock them, as one step. The reply is told.
    ///
    /// # Errors
    /// [`crate::editor::Refusal`] if the curve is hidden or has no such vertices.
    pub fn lock_vertices(&mut self, curve: CurveId, vertices: Vec<usize>, locked: bool) -> Reply {
        let edit = Edit::SetVerticesLocked {
            curve,
            vertices,
            locked,
        };
        self.apply(label(locked), vec![edit])
    }

    /// Lock the selected vertices; unlock them if all of them are locked.
    pub(in crate::editor) fn toggle_vertices_locked(&mut self) -> Reply {
        let selection = &self.hand.selection;
        let locked = !self.is_selection_locked();
        let curves: BTreeSet<CurveId> = selection.vertices().map(|(curve, _)| curve).collect();
        let edit = |curve| Edit::SetVerticesLocked {
            curve,
            vertices: selection.of_curve(curve).collect(),
            locked,
        };
        let edits = curves.into_iter().map(edit).collect();
        let count = counted(selection.vertices().len(), "vertex", "vertices");
        self.apply(label(locked), edits)?;
        let done = if locked { "locked" } else { "unlocked" };
        Ok(Note::done(format!("{count} {done}")))
    }

    /// What the command does now that locks or unlocks the selected vertices.
    pub(in crate::editor) fn locking_label(&self) -> &'static str {
        label(!self.is_selection_locked())
    }

    /// Whether vertices are selected and all of them are locked.
    fn is_selection_locked(&self) -> bool {
        let selection = &self.hand.selection;
        let mut vertices = selection.vertices();
        let is_locked = |(curve, vertex)| {
            let curve = self.document().curve(curve);
            curve.is_some_and(|curve| curve.locked_vertices.contains(vertex))
        };
        !selection.is_empty() && vertices.all(is_locked)
    }
}

fn label(locked: bool) -> &'static str {
    if locked {
        "Lock vertices"
    } else {
        "Unlock vertices"
    }
}
