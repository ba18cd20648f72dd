//! The range of curvature of a curve or a reference, and of its radii.

use eframe::egui::Ui;

use super::{document_unit, figures, widgets};
use crate::editor::CurvatureDisplay;
use crate::geometry::Range;

/// Show a range of curvatures, its range of radii, or both.
pub fn curvature_rows(ui: &mut Ui, display: CurvatureDisplay, curvature: Option<Range>) {
    if display.shows_curvature() {
        let text = figures::range(curvature, |value| figures::significant(value, 6));
        let text = document_unit::curvature(ui.ctx(), text);
        widgets::figure_row(ui, "Curvature", &text);
    }
    if display.shows_radius() {
        let text = document_unit::length(ui.ctx(), figures::radii(curvature, 6));
        widgets::figure_row(ui, "Radius", &text);
    }
}
