//! The choice of a curve or reference to compare the active one with.

use eframe::egui::Ui;

use crate::document::CurveId;
use crate::editor::{Command, Editor, told};
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
    let compared = editor.sight().compared();
    ui.add_enabled_ui(!others.is_empty(), |ui| {
        let others = others.into_iter().map(|(id, name)| (Some(id), name));
        let all = [(None, "nothing".to_owned())].into_iter().chain(others);
        let (chosen, list) = widgets::drop_down(ui, name, width, &compared, all);
        if let Some(chosen) = chosen {
            told(editor.execute(Command::Compare(chosen)));
        }
        let help = "Plot another curve or reference beside this one, and measure their distance";
        list.on_hover_text(help);
    });
}

/// The curves and references beside the active one, with their names: no pictures, which have no distances.
pub fn others(editor: &Editor) -> Vec<(CurveId, String)> {
    let document = editor.document();
    let named = |id| Some((id, document.name(id)?.to_owned()));
    let is_picture = |id| {
        document
            .reference(id)
            .is_some_and(|it| it.picture.is_some())
    };
    let others = document.all_ids().filter(|id| Some(*id) != editor.active());
    others
        .filter(|id| !is_picture(*id))
        .filter_map(named)
        .collect()
}
