//! The end-fit panel's fields for the target beyond its direction: curvature, osculating plane
//! and curvature slope.

use eframe::egui::{Checkbox, Role, Sense, Ui, WidgetInfo, vec2};
use glam::DVec3;

use super::number_field::{FieldEvent, NumberField, vector_row};
use super::theme::{ROW, STEP, Tokens};
use super::{figures, widgets};
use crate::editor::{EndFitAction, EndFitReport};
use crate::geometry::parameters::Quantity;

/// The width of a field.
const FIELD: f32 = 96.0;

/// Show the fields. A free one shows the figure that the end has now.
pub fn curvature_ui(ui: &mut Ui, report: &EndFitReport) -> Option<FieldEvent<EndFitAction>> {
    let target = report.target?;
    let has_tangent = report.actual.direction.is_some();
    let curvature = NumberRow {
        name: "Curvature",
        help: "Require a curvature κ at the end, positive where it turns left",
        quantity: Quantity::Curvature,
        value: target.curvature,
        actual: report.actual.curvature,
        has_tangent,
    };
    let mut event = curvature.show(ui, EndFitAction::SetCurvature);
    if !report.planar {
        event = plane_ui(ui, target.normal, report.actual.normal).or(event);
    }
    let slope = NumberRow {
        name: "Slope",
        help: "Require a curvature slope dκ/ds at the end",
        quantity: Quantity::Number,
        value: target.slope,
        actual: report.actual.slope,
        has_tangent,
    };
    slope.show(ui, EndFitAction::SetSlope).or(event)
}

/// One number of the target.
struct NumberRow {
    name: &'static str,
    help: &'static str,
    quantity: Quantity,
    /// The required number; `None` if it is free.
    value: Option<f64>,
    /// The number that the end has.
    actual: Option<f64>,
    has_tangent: bool,
}

impl NumberRow {
    fn show(
        &self,
        ui: &mut Ui,
        action: impl Fn(Option<f64>) -> EndFitAction,
    ) -> Option<FieldEvent<EndFitAction>> {
        let row = widgets::form_row(ui, self.name, |ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            let event = match self.value {
                Some(value) => self.field_ui(ui, value),
                None => {
                    self.actual_ui(ui);
                    None
                }
            };
            let can_fix = self.has_tangent || self.value.is_some();
            let fixed = fixed_ui(ui, self.name, self.help, (self.value.is_some(), can_fix));
            let actual = self.actual.unwrap_or_default();
            let fixed = fixed.map(|fixed| FieldEvent::Set(action(fixed.then_some(actual))));
            fixed.or(event.map(|event| event.map(|value| action(Some(value)))))
        });
        row.inner
    }

    fn field_ui(&self, ui: &mut Ui, value: f64) -> Option<FieldEvent> {
        let name = format!("target {}", self.name.to_lowercase());
        let size = value.abs().max(self.actual.unwrap_or_default().abs());
        let speed = if size > 0.0 { 0.01 * size } else { 0.001 };
        let field = NumberField::new(&name, value, figures::significant(value, 6));
        let field = field.speed(speed).quantity(self.quantity);
        field.width(FIELD).show(ui)
    }

    fn actual_ui(&self, ui: &mut Ui) {
        let actual = self.actual.map(|actual| figures::significant(actual, 6));
        let text = format!("now {}", actual.unwrap_or_else(|| "none".to_owned()));
        let (rect, response) = ui.allocate_exact_size(vec2(FIELD, ROW), Sense::hover());
        widgets::number_in(ui, rect, &text, Tokens::of(ui).faint_text);
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &text));
    }
}

/// Show the normal of the osculating plane, three components in a row.
fn plane_ui(
    ui: &mut Ui,
    normal: Option<DVec3>,
    actual: Option<DVec3>,
) -> Option<FieldEvent<EndFitAction>> {
    let event = normal.and_then(|normal| {
        let event = direction_row(ui, ("Plane", "target normal"), normal)?;
        Some(event.map(|normal| EndFitAction::SetNormal(Some(normal))))
    });
    let caption = if normal.is_some() { "" } else { "Plane" };
    let row = widgets::form_row(ui, caption, |ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        if normal.is_none() {
            widgets::caption(ui, "free");
        }
        let help = "Require an osculating plane at the end, by its normal";
        let can_fix = normal.or(actual).is_some();
        let fixed = fixed_ui(ui, "Plane", help, (normal.is_some(), can_fix))?;
        let normal = actual.filter(|_| fixed);
        Some(FieldEvent::Set(EndFitAction::SetNormal(normal)))
    });
    row.inner.or(event)
}

/// Show a direction in space, three components in a row.
pub fn direction_row(
    ui: &mut Ui,
    names: (&str, &str),
    direction: DVec3,
) -> Option<FieldEvent<DVec3>> {
    vector_row(ui, names, 3, direction, |name, value| {
        NumberField::new(name, value, format!("{value:.3}")).speed(0.005)
    })
}

/// Show the switch between free and required; returns its new state.
fn fixed_ui(ui: &mut Ui, name: &str, help: &str, (fixed, enabled): (bool, bool)) -> Option<bool> {
    let mut now = fixed;
    let response = ui.add_enabled(enabled, Checkbox::new(&mut now, "Lock"));
    let response = response.accessible_name(format!("Lock {}", name.to_lowercase()));
    response.on_hover_text(help).clicked().then_some(now)
}
