//! Fields for a movement of what is selected, and the button that makes it.

use eframe::egui::{Button, Ui};
use glam::DVec3;

use super::figures;
use super::number_field::{NumberField, field_width};
use super::theme::STEP;
use crate::editor::{Editor, Transformation, told};
use crate::geometry::parameters::Quantity;

/// The fields' own state.
#[derive(Default)]
pub struct MoveFields {
    /// How far the button moves what is selected.
    by: DVec3,
}

impl MoveFields {
    /// Show fields for the selected vertices, or else the selected curves and references; three where they lie
    /// `in_space`.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor, in_space: bool) {
        let names = ["move x", "move y", "move z"];
        let axes = if in_space || self.by.z != 0.0 { 3 } else { 2 };
        let (width, pixel) = (field_width(ui, axes), editor.view().viewport().pixel());
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            for (axis, name) in names.into_iter().enumerate().take(axes) {
                let shown = figures::significant(self.by[axis], 6);
                let field = NumberField::new(name, self.by[axis], shown).speed(pixel);
                let field = field.width(width).quantity(Quantity::Length);
                if let Some(by) = field.changed(ui) {
                    self.by[axis] = by;
                }
            }
        });
        let button = ui.add_enabled(self.by != DVec3::ZERO, Button::new("Apply"));
        if button.accessible_name("Apply movement").clicked() {
            told(editor.transform(Transformation::Move(self.by)));
        }
    }
}
