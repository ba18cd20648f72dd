//! The choice of a curve or reference to compare the active one with.

use eframe::egui::{ComboBox, Ui};

use crate::document::CurveId;
use crate::editor::Editor;
use crate::ui::widgets;

/// The least and the greatest width of the choice.
const WIDTH: [f32; 2] = [56.0, 120.0];

/// The room that the bar keeps beside the choice.
const BESIDE: f32 = 64.0;

/// Where the bar leaves less room than this, in points, the choice is left to the plot's menu.
const NARROW: f32 = 320.0;

/// Show the choice with a caption at its left, where there is room.
pub fn compare_ui(ui: &mut Ui, editor: &mut Editor) {
    if ui.available_width() >= NARROW {
        choice_ui(ui, editor, "Curve to compare with");
        widgets::caption(ui, "Compare with");
    }
}

/// Show the choice; `name` is its name for screen readers.
pub fn choice_ui(ui: &mut Ui, editor: &mut Editor, name: &str) {
    let width = (ui.available_width() - BESIDE).clamp(WIDTH[0], WIDTH[1]);
    let others = others(editor);
    let compared = editor.view().compared;
    let chosen = others.iter().find(|(id, _)| Some(*id) == compared);
    let text = chosen.map_or("nothing", |(_, name)| name).to_owned();
    ui.add_enabled_ui(!others.is_empty(), |ui| {
        let choice = ComboBox::from_id_salt(name)
            .selected_text(text)
            .width(width)
            .truncate();
        let choice = choice.show_ui(ui, |ui| {
            let mut compared = compared;
            ui.selectable_value(&mut compared, None, "nothing");
            for (id, name) in &others {
                ui.selectable_value(&mut compared, Some(*id), name);
            }
            editor.view_mut().compared = compared;
        });
        let response = choice.response.accessible_name(name);
        response.on_hover_text(
            "Plot another curve or reference beside this one, and measure their distance",
        );
    });
}

/// The curves and references beside the active one, with their names.
pub fn others(editor: &Editor) -> Vec<(CurveId, String)> {
    let document = editor.document();
    let curves = document
        .curves()
        .map(|(id, curve)| (id, curve.name.clone()));
    let references = document.references();
    let references = references.map(|(id, reference)| (id, reference.name.clone()));
    let all = curves.chain(references);
    all.filter(|(id, _)| Some(*id) != editor.active()).collect()
}
