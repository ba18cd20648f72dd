//! The rotate and the scale tool in figures: the pivot, and an angle or a factor to apply.

use eframe::egui::{Button, Ui};
use glam::DVec2;

use super::figures;
use super::number_field::NumberField;
use super::widgets;
use crate::editor::{Editor, ToolKind, Transformation, told};
use crate::geometry::parameters::Quantity;

/// The numbers in the fields, until they are applied.
pub struct TransformPanel {
    degrees: f64,
    factor: f64,
}

impl Default for TransformPanel {
    fn default() -> Self {
        Self {
            degrees: 90.0,
            factor: 2.0,
        }
    }
}

impl TransformPanel {
    /// Show the panel, if one of its tools is in the hand.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor) {
        match editor.hand().tool() {
            ToolKind::Rotate => widgets::section(ui, "Rotate", true, |ui| {
                pivot_ui(ui, editor);
                widgets::form_row(ui, "Angle", |ui| self.angle_ui(ui, editor));
            }),
            ToolKind::Scale => widgets::section(ui, "Scale", true, |ui| {
                pivot_ui(ui, editor);
                widgets::form_row(ui, "Factor", |ui| self.factor_ui(ui, editor));
            }),
            _ => None,
        };
    }

    fn angle_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let shown = format!("{}°", figures::significant(self.degrees, 6));
        let field = NumberField::new("rotation angle", self.degrees, shown);
        let field = field.speed(0.5).quantity(Quantity::Angle);
        self.degrees = field.changed(ui).unwrap_or(self.degrees);
        if apply_ui(ui, editor, "Apply rotation") {
            told(editor.transform(Transformation::Rotate(self.degrees.to_radians())));
        }
    }

    fn factor_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let shown = figures::significant(self.factor, 6);
        let field = NumberField::new("scale factor", self.factor, shown);
        self.factor = field.speed(0.01).changed(ui).unwrap_or(self.factor);
        if apply_ui(ui, editor, "Apply scaling") {
            told(editor.transform(Transformation::Scale(self.factor)));
        }
    }
}

fn pivot_ui(ui: &mut Ui, editor: &mut Editor) {
    let Some(pivot) = editor.hand().pivot(&editor.context()) else {
        let text = "Select vertices, or a curve that is neither locked nor hidden.";
        widgets::note(ui, text);
        return;
    };
    widgets::form_row(ui, "Pivot", |ui| {
        let pixel = editor.view().viewport().pixel();
        let axes = [("pivot x", DVec2::X), ("pivot y", DVec2::Y)];
        for (name, axis) in axes {
            let value = pivot.dot(axis);
            let shown = figures::significant(value, 6);
            let field = NumberField::new(name, value, shown).speed(pixel);
            if let Some(changed) = field.quantity(Quantity::Length).changed(ui) {
                let pivot = pivot + axis * (changed - value);
                editor.hand_mut().set_pivot(Some(pivot));
            }
        }
    });
}

fn apply_ui(ui: &mut Ui, editor: &Editor, name: &str) -> bool {
    let button = Button::new("Apply");
    let response = ui.add_enabled(editor.hand().pivot(&editor.context()).is_some(), button);
    response.accessible_name(name).clicked()
}
