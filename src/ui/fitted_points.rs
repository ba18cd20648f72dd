//! In the panel of a fit: its points, and the scale of the whiskers that show their distances.

use eframe::egui::Ui;

use super::operation_fields::label_width;
use super::theme::STEP;
use super::whisker_fields::whisker_fields_ui;
use super::widgets;
use crate::editor::{FittedPoints, OperationInProgress, Whiskers};
use crate::geometry::counted;

/// Show how many points are left out, and the switch and the scale of their whiskers.
pub fn fitted_points_ui(
    ui: &mut Ui,
    in_progress: &OperationInProgress,
    points: &FittedPoints,
    whiskers: &mut Whiskers,
) {
    let all = counted(in_progress.input().points().len(), "point", "points");
    let left_out = format!("{all}, {} left out", points.left_out().len());
    let scale = in_progress.whisker_scale(whiskers);
    let help = "Click a point on the canvas to leave it out, or to take it back";
    widgets::fact_row(ui, "Points", &left_out).on_hover_text(help);
    let label = label_width(ui, in_progress);
    widgets::wide_form_row(ui, "Whiskers", label, |ui| {
        whisker_fields_ui(ui, scale, whiskers)
    });
    ui.add_space(STEP);
}
