//! In the panel of a fit: its points, and the scale of the whiskers that show their distances.

use eframe::egui::{Role, Ui, WidgetInfo};
use lucide_icons::Icon;

use super::number_field::NumberField;
use super::operation_fields::label_width;
use super::widgets::{self, IconButton};
use super::{figures, theme::STEP};
use crate::editor::{FittedPoints, OperationInProgress, Whiskers};
use crate::geometry::counted;

/// The width of the field for the scale.
const FIELD: f32 = 76.0;

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
        let switch = ui.checkbox(&mut whiskers.shown, "");
        switch
            .widget_info(|| WidgetInfo::selected(Role::CheckBox, true, whiskers.shown, "Whiskers"));
        switch.on_hover_text("Show the distances of the points from the curve, magnified");
        ui.add_enabled_ui(whiskers.shown, |ui| scale_ui(ui, scale, whiskers));
    });
    ui.add_space(STEP);
}

/// The field for the scale, and the way back to the one that suits the distances.
fn scale_ui(ui: &mut Ui, scale: f64, whiskers: &mut Whiskers) {
    widgets::caption(ui, "×");
    let shown = figures::significant(scale, 4);
    let field = NumberField::new("Whisker scale", scale, shown).width(FIELD);
    let field = field.range(Whiskers::SCALES).speed(0.02 * scale);
    let field = field.help("How many times the whiskers are longer than the distances");
    if let Some(scale) = field.changed(ui) {
        whiskers.scale = Some(scale);
    }
    let reset = IconButton::new(Icon::RotateCcw, "Reset whisker scale");
    let reset = reset.tooltip("Suit the scale to the distances");
    if reset.enabled(whiskers.scale.is_some()).show(ui).clicked() {
        whiskers.scale = None;
    }
}
