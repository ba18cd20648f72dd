//! The end-fit panel's fields for what a target has beyond its direction: curvature, osculating plane
//! and slope.

use eframe::egui::{Checkbox, Role, Sense, Ui, WidgetInfo, vec2};
use glam::DVec3;

use super::end_fit_asked::Asked;
use super::end_fit_steps::field_width;
use super::number_field::NumberField;
use super::theme::{ROW, STEP, Tokens};
use super::{figures, widgets};
use crate::editor::{EndFitAction, EndFitReport};
use crate::geometry::expressions::Quantity;

/// The width of a field.
const FIELD: f32 = 96.0;

/// Show the fields. Each can be free: then it tells what the end has now.
pub fn curvature_ui(ui: &mut Ui, report: &EndFitReport) -> Option<Asked> {
    let target = report.target?;
    let curvature = Row {
        name: "Curvature",
        about: "Give the end a curvature κ, positive where it turns left",
        quantity: Quantity::Curvature,
        value: target.curvature,
        actual: report.curvature,
    };
    let mut asked = curvature.show(ui, report, EndFitAction::SetCurvature);
    if !report.planar {
        asked = plane_ui(ui, target.normal, report.normal).or(asked);
    }
    let slope = Row {
        name: "Slope",
        about: "Give the curvature a slope dκ/ds by arc length",
        quantity: Quantity::Number,
        value: target.slope,
        actual: report.slope,
    };
    slope.show(ui, report, EndFitAction::SetSlope).or(asked)
}

/// One number of the target.
struct Row {
    name: &'static str,
    about: &'static str,
    quantity: Quantity,
    /// What it is to be; `None` if it is free.
    value: Option<f64>,
    /// What the end has.
    actual: Option<f64>,
}

impl Row {
    fn show(
        &self,
        ui: &mut Ui,
        report: &EndFitReport,
        action: impl Fn(Option<f64>) -> EndFitAction,
    ) -> Option<Asked> {
        let mut asked = None;
        widgets::form_row(ui, self.name, |ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            match self.value {
                Some(value) => {
                    let name = format!("target {}", self.name.to_lowercase());
                    // A hundredth of what is there, or of what the actual end has.
                    let size = value.abs().max(self.actual.unwrap_or_default().abs());
                    let speed = if size > 0.0 { 0.01 * size } else { 0.001 };
                    let field = NumberField::new(&name, value, figures::significant(value, 6))
                        .speed(speed)
                        .quantity(self.quantity)
                        .width(FIELD);
                    let event = field.show(ui).1;
                    asked = Asked::of_field(event, |value| action(Some(value)));
                }
                None => {
                    let actual = self.actual.map(|it| figures::significant(it, 6));
                    let actual = actual.unwrap_or_else(|| "none".to_owned());
                    let size = vec2(FIELD, ROW);
                    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
                    let text = format!("now {actual}");
                    widgets::number_in(ui, rect, &text, Tokens::of(ui).faint_text);
                    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &text));
                }
            }
            let can_fix = report.tangent.is_some() || self.value.is_some();
            let fixed = fixed_ui(ui, (self.name, self.about), self.value.is_some(), can_fix);
            let actual = self.actual.unwrap_or_default();
            asked = fixed
                .map(|fixed| Asked::Action(action(fixed.then_some(actual))))
                .or(asked.take());
        });
        asked
    }
}

/// The normal of the osculating plane, three components in a row.
fn plane_ui(ui: &mut Ui, normal: Option<DVec3>, actual: Option<DVec3>) -> Option<Asked> {
    let mut asked = None;
    let width = field_width(ui, 3);
    if let Some(normal) = normal {
        widgets::form_row(ui, "Plane", |ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            for axis in 0..3 {
                let name = format!("target normal {}", ["x", "y", "z"][axis]);
                let value = normal[axis];
                let field = NumberField::new(&name, value, format!("{value:.3}"))
                    .speed(0.005)
                    .width(width);
                let event = field.show(ui).1;
                let typed = Asked::of_field(event, |value| {
                    let mut turned = normal;
                    turned[axis] = value;
                    EndFitAction::SetNormal(Some(turned))
                });
                asked = typed.or(asked.take());
            }
        });
    }
    let title = if normal.is_some() { "" } else { "Plane" };
    widgets::form_row(ui, title, |ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        if normal.is_none() {
            widgets::caption(ui, "free");
        }
        let about = "Give the end an osculating plane by its normal";
        let can_fix = normal.or(actual).is_some();
        if let Some(fixed) = fixed_ui(ui, ("Plane", about), normal.is_some(), can_fix) {
            let normal = actual.filter(|_| fixed);
            asked = Some(Asked::Action(EndFitAction::SetNormal(normal)));
        }
    });
    asked
}

/// The switch between free and fixed; tells what it is set to.
fn fixed_ui(ui: &mut Ui, (name, about): (&str, &str), fixed: bool, enabled: bool) -> Option<bool> {
    let mut now = fixed;
    let response = ui.add_enabled(enabled, Checkbox::new(&mut now, "Lock"));
    let response = response.accessible_name(format!("Lock {}", name.to_lowercase()));
    let clicked = response.on_hover_text(about).clicked();
    clicked.then_some(now)
}
