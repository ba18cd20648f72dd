//! Locking the selected vertices.

use std::collections::BTreeSet;

use crate::document::{CurveId, Document, Edit};
use crate::editor::selection::Selection;

/// The edits that lock the selected vertices, or unlock them if all of them are locked; with the new state.
pub(super) fn edits(selection: &Selection, document: &Document) -> (Vec<Edit>, bool) {
    let locked = !is_locked(selection, document);
    let curves: BTreeSet<CurveId> = selection.vertices().map(|(curve, _)| curve).collect();
    let edit = |curve| Edit::SetVerticesLocked {
        curve,
        vertices: selection.of_curve(curve).collect(),
        locked,
    };
    (curves.into_iter().map(edit).collect(), locked)
}

/// The name of the command that locks or unlocks the selected vertices.
pub(super) fn command_label(selection: &Selection, document: &Document) -> &'static str {
    label(!is_locked(selection, document))
}

/// The name of the step that locks or unlocks vertices.
pub(super) fn label(locked: bool) -> &'static str {
    if locked {
        "Lock vertices"
    } else {
        "Unlock vertices"
    }
}

/// Whether vertices are selected and all of them are locked.
fn is_locked(selection: &Selection, document: &Document) -> bool {
    let mut vertices = selection.vertices();
    let is_locked = |(curve, vertex)| {
        let curve = document.curve(curve);
        curve.is_some_and(|curve| curve.locked_vertices.contains(vertex))
    };
    !selection.is_empty() && vertices.all(is_locked)
}
