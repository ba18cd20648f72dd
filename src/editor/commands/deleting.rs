//! Removing vertices and curves: never one by a command that is meant for the other.

use crate::document::{Document, Edit, quoted};
use crate::editor::Editor;
use crate::editor::commands::command::Command;
use crate::editor::commands::items::{self, Change};
use crate::editor::reply::{Message, Note, Refusal, Reply};
use crate::editor::same_shape::removal;
use crate::editor::selection::Selection;
use crate::geometry::counted;

impl Editor {
    /// Remove the selected vertices. The others stay in their places, or all move so that the curve keeps its shape.
    pub(in crate::editor) fn delete(
        &mut self,
        verb: &str,
        done: &str,
        vertices_stay: bool,
    ) -> Reply {
        let (edits, told) = edits(&self.hand.selection, self.document(), vertices_stay)?;
        let count = counted(self.hand.selection.vertices().len(), "vertex", "vertices");
        self.apply(&format!("{verb} {count}"), edits)?;
        self.hand.selection.clear();
        let told = [vec![format!("{count} {done}")], told].concat();
        Ok(Note::done(told.join(". ")))
    }
}

/// The question before curves are removed, which names them; `None` where the message that is shown is that question.
/// References alone, which are seen selected, are removed without one.
pub(super) fn question(
    selection: &Selection,
    document: &Document,
    shown: Option<&Message>,
) -> Result<Option<Note>, Refusal> {
    if selection.has_no_item() {
        return Err("Nothing is selected: click a curve or a vertex".into());
    }
    let change = Change::removal(document, &selection.items())?;
    let names = items::named(document, &change.taken);
    let asked = Note::told(format!("Press Del again to delete {names}"));
    let of_curves = change.taken.iter().any(|id| document.curve(*id).is_some());
    let is_answered = shown == Message::of(&Ok(asked.clone())).as_ref();
    Ok((of_curves && !is_answered).then_some(asked))
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
