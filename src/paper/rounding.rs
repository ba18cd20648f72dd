//! The rounding test in the editor: a curve that loses digits while a slider moves.

use super::documents::SHORTENED;
use crate::document::{Curve, CurveId, Edit};
use crate::editor::Editor;
use crate::geometry::paper::RoundingTest;

/// Tell whether the document still has the curve of the rounding test, unlocked and of its degree and size.
pub fn has_shortened(editor: &Editor) -> bool {
    shortened(editor).is_some()
}

/// Show the result of a rounding test. While nothing was edited since the page was opened this leaves no step
/// and nothing to save. Otherwise it is a preview, which [`Editor::commit_preview`] keeps.
pub fn show_shortened(editor: &mut Editor, test: &RoundingTest) {
    let Some(curve) = shortened(editor) else {
        return;
    };
    let polygon = test.polygon.clone();
    let edits = vec![Edit::SetPolygon { curve, polygon }];
    if !editor.amend_opened(&edits) {
        editor.preview("Shorten coordinates", edits);
    }
}

fn shortened(editor: &Editor) -> Option<CurveId> {
    let degree = RoundingTest::arc().ok()?.degree();
    let fits = |curve: &Curve| {
        let polygon = &curve.polygon;
        curve.name == SHORTENED
            && polygon.degree() == degree
            && polygon.vertices().len() == degree + 1
            && curve.check_editable().is_ok()
    };
    let mut curves = editor.document().curves();
    curves.find(|(_, curve)| fits(curve)).map(|(id, _)| id)
}
