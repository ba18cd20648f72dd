//! The distance from the active curve or reference to another one, in the inspector.

use eframe::egui::Ui;

use super::{figures, plots, widgets};
use crate::analysis::Distance;
use crate::document::CurveId;
use crate::editor::Editor;

/// Show the choice of the other curve and the distances to it.
pub fn distance_ui(ui: &mut Ui, editor: &mut Editor) {
    if editor.document().all_ids().count() < 2 {
        return;
    }
    widgets::form_row(ui, "Compare with", |ui| {
        plots::compare_choice_ui(ui, editor, "Compare distances with");
    });
    let Some(compared) = editor.sight().compared() else {
        return;
    };
    match editor.sight().distance() {
        Some(distance) => figures_ui(ui, editor, compared, distance),
        None => drop(widgets::note(
            ui,
            "Distances are measured between a curve and another curve or a reference.",
        )),
    }
}

fn figures_ui(ui: &mut Ui, editor: &Editor, compared: CurveId, distance: &Distance) {
    let short = |value: f64| figures::significant(value, 4);
    widgets::figure_row(ui, "Largest distance", &short(distance.largest));
    widgets::figure_row(ui, "Mean distance", &short(distance.mean));
    let document = editor.document();
    let mut both = [editor.active(), Some(compared)].into_iter().flatten();
    let reference = both.find_map(|id| document.reference(id));
    let other = match reference {
        Some(reference) if reference.points().is_some() => format!("point {}", distance.t),
        Some(_) => format!("t = {}", short(distance.t)),
        None => format!("u = {}", short(distance.t)),
    };
    let place = format!("u = {}, {other}", short(distance.u));
    widgets::figure_row(ui, "Largest at", &place);
}
