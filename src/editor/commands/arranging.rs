//! Aligning and distributing what is selected.

use crate::editor::hand::tools::Transformed;
use crate::editor::reply::{Note, Reply, with_lines};
use crate::editor::{Arrangement, Editor, Refusal};
use crate::geometry::counted;

/// Arrange the selected vertices, or the selected curves and references, as one step.
///
/// # Errors
/// [`Refusal`] if too few can move.
pub(super) fn arrange(editor: &mut Editor, arrangement: Arrangement) -> Reply {
    let context = editor.context();
    let items = Transformed::of(&context);
    let least = arrangement.least();
    if items.parts().len() < least {
        let few = counted(least, "unlocked vertex", "unlocked vertices");
        return Err(Refusal(format!("Select {few}, or as many curves")));
    }
    let edits = arrangement.edits(&items, &context);
    let edits = edits.map_err(|error| Refusal(error.to_string()))?;
    let staying = context.staying();
    let note = editor.apply(arrangement.label(), edits)?;
    Ok(match staying {
        Some(staying) => Note {
            warns: note.warns,
            ..Note::done(with_lines(note.text, &staying))
        },
        None => note,
    })
}
