//! The end of a drawing that something else interrupts.

use crate::document::quoted;
use crate::editor::Editor;
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::input::Key;
use crate::editor::reply::Note;

/// End an unfinished drawing as Enter does, so that what comes next does not lose it, and tell of the curve. One point
/// makes no curve and stays.
pub fn end_drawing(editor: &mut Editor) -> Note {
    let draws = |editor: &Editor| !editor.hand.tools.used().drawn().is_empty();
    if !draws(editor) {
        return Note::silent();
    }
    editor.deliver(Gesture::Key(Key::Enter), false);
    match editor.active().and_then(|id| editor.document().name(id)) {
        Some(name) if !draws(editor) => Note::done(format!("The drawing became {}", quoted(name))),
        _ => Note::silent(),
    }
}
