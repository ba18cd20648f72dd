//! Removing vertices and curves: never one by a command that is meant for the other.

use crate::document::{Document, quoted};
use crate::editor::Editor;
use crate::editor::commands::command::Command;
use crate::editor::commands::items::{self, Change};
use crate::editor::reply::{Message, Note, Refusal, Reply};
use crate::editor::same_shape::{Removal, removal};
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
        let removals = removals(&self.hand.selection, self.document(), vertices_stay)?;
        let count = counted(self.hand.selection.vertices().len(), "vertex", "vertices");
        let adds = removals.iter().any(|it| it.adds);
        let mut told = vec![format!("{count} {done}")];
        told.extend(removals.iter().filter_map(|it| it.told.clone()));
        let edits = removals.into_iter().map(|it| it.edit);
        self.apply(&format!("{verb} {count}"), edits.collect())?;
        self.hand.selection.clear();
        Ok(Note {
            warns: adds,
            ..Note::done(told.join(". "))
        })
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

/// The deletions of the selected vertices, one a curve. A curve is never removed that way.
fn removals(
    selection: &Selection,
    document: &Document,
    vertices_stay: bool,
) -> Result<Vec<Removal>, String> {
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
    let mut removals = Vec::new();
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
        let way = (vertices_stay, document.unit());
        removals.push(removal(id, curve, &indices, way)?);
    }
    Ok(removals)
}
