//! The window with the arc of the examples fitted into its canvas.

use anyhow::Result;
use batten::editor::{Editor, Look};
use batten::geometry::{End, FloatPolygon};
use egui::{Pos2, Rect, vec2};
use glam::DVec2;

use crate::Window;

/// The arc.
pub fn arc() -> FloatPolygon {
    let editor = editor();
    let curve = editor
        .active()
        .and_then(|id| editor.document().curve(id).cloned());
    curve.expect("the arc").polygon.clone()
}

/// An editor as it opens, with the arc chosen.
fn editor() -> Editor {
    let mut editor = Editor::new();
    editor.open_example(0).expect("the arc");
    editor
}

/// Choose the arc in the menu.
pub fn open(window: &mut Window) -> Result<()> {
    for label in ["File", "Examples", "Ninth-degree arc"] {
        window.click(label)?;
    }
    Ok(())
}

/// An editor whose canvas has the window's size: it fits the arc as the window did.
pub fn fitted(canvas: Rect) -> Editor {
    let mut editor = editor();
    editor.look(Look::Canvas(DVec2::new(
        canvas.width().into(),
        canvas.height().into(),
    )));
    editor
}

/// The place of a vertex in the window, as long as the view is the fitted one.
pub fn place(canvas: Rect, polygon: &FloatPolygon, vertex: usize) -> Pos2 {
    on_canvas(canvas, &fitted(canvas), polygon.vertex(vertex).truncate())
}

/// The place of a point of the model in the window, as an editor's view shows it.
pub fn on_canvas(canvas: Rect, editor: &Editor, point: DVec2) -> Pos2 {
    let at = editor.view().viewport().to_screen(point);
    canvas.min + vec2(at.x as f32, at.y as f32)
}

/// Set the target of the curve's end by a click, and meet both ends at once.
pub fn correct_an_end(window: &mut Window, canvas: Rect) -> Result<()> {
    window.click("End fit")?;
    let end = arc().end_jet(End::Finish).point.truncate();
    let at = on_canvas(canvas, &fitted(canvas), end + DVec2::new(0.75, 0.35));
    window.click_at(at)?;
    window.click("Both ends at once")?;
    window.find_beginning("Correct ends: ")?;
    Ok(())
}
