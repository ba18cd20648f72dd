//! Removing vertices and curves: never one by a command that is meant for the other.

use crate::document::{Document, Edit, quoted};
use crate::editor::Editor;
use crate::editor::commands::command::Command;
use crate::editor::reply::{Note, Reply};
use crate::editor::same_shape::removal;
use crate::editor::selection::Selection;
use crate::geometry::counted;

impl Editor {
    /// Remove the selected vertices, or the active reference, which has none. The others stay in their places, or all
    /// move so that the curve keeps its shape.
    pub(in crate::editor) fn delete(
        &mut self,
        verb: &str,
        done: &str,
        vertices_stay: bool,
    ) -> Reply {
        let active = self.active().filter(|_| self.hand.selection.is_empty());
        if let Some(id) = active.filter(|id| self.document().reference(*id).is_some()) {
            return self.change(Edit::Remove(id));
        }
        let (edits, told) = edits(&self.hand.selection, self.document(), vertices_stay)?;
        let count = counted(self.hand.selection.vertices().len(), "vertex", "vertices");
        self.apply(&format!("{verb} {count}"), edits)?;
        self.hand.selection.clear();
        let told = [vec![format!("{count} {done}")], told].concat();
        Ok(Note::done(told.join(". ")))
    }
}

/// The edits that remove the selected vertices, and what they do to the curves. A curve is never removed that way.
fn edits(
    selection: &Selection,
    document: &Document,
    vertices_stay: bool,
) -> Result<(Vec<Edit>, Vec<String>), String> {
    if selection.is_empty() {
        let active = selection.active().and_then(|id| document.name(id));
        let Some(name) = active else {
            return Err("There is no curve".into());
        };
        return Err(format!(
            "No vertex is selected. To remove {} as a whole, use “{}”",
            quoted(name),
            Command::DeleteCurve.label()
        ));
    }
    let (mut edits, mut told) = (Vec::new(), Vec::new());
    for (id, curve) in document.curves() {
        let indices: Vec<usize> = selection.of_curve(id).collect();
        if indices.is_empty() {
            continue;
        }
        curve
            .check_editable()
            .map_err(|refused| refused.to_string())?;
        if indices.len() == curve.polygon.vertices().len() {
            return Err(format!(
                "The selection holds all vertices of {}. To remove it as a whole, use “{}”",
                quoted(&curve.name),
                Command::DeleteCurve.label()
            ));
        }
        let (edit, curve_told) = removal(id, curve, &indices, (vertices_stay, document.unit()))?;
        edits.push(edit);
        told.extend(curve_told);
    }
    Ok((edits, told))
}
