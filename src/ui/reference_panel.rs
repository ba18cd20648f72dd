//! The inspector of a reference: its shape, its placement and its figures.

use eframe::egui::{Button, Ui, vec2};
use glam::{DQuat, EulerRot};

use super::curvature_rows::curvature_rows;
use super::formula_fields::FormulaFields;
use super::number_field::{FieldEvent, NumberField, field_width, vector_row};
use super::theme::{ROW, STEP};
use super::widgets;
use super::{document_unit, figures};
use crate::document::{CurveId, Reference};
use crate::editor::{CurvatureDisplay, Editor, ReferenceChange, ReferenceReport, told};
use crate::geometry::parameters::Quantity;
use crate::geometry::references::{AnalyticForm, ReferenceCurve, ReferenceForm};
use crate::operations;

/// The width of a field that stands alone.
const FIELD: f32 = 120.0;

/// The width of fields that stand side by side.
const NARROW: f32 = 64.0;

/// Show the shape of a reference: fields from its kind's table of parameters, or its formulas.
pub fn shape_ui(
    ui: &mut Ui,
    editor: &mut Editor,
    formulas: &mut FormulaFields,
    (id, reference): (CurveId, &Reference),
) {
    let curve = &reference.curve;
    match curve.form() {
        ReferenceForm::Analytic(form) => {
            widgets::note(ui, form.kind().help);
            parameters_ui(ui, editor, form);
            interval_ui(ui, editor, curve);
        }
        ReferenceForm::Formula(formula) => {
            widgets::note(ui, "Expressions in t, such as 2*cos(pi*t).");
            formulas.show(ui, editor, id, formula);
            interval_ui(ui, editor, curve);
        }
        ReferenceForm::Points(list) => {
            widgets::figure_row(ui, "Points", &list.points().len().to_string());
            fit_ui(ui, editor);
        }
        ReferenceForm::Nurbs(nurbs) => {
            widgets::note(
                ui,
                "A B-spline on its own knots. Approximate makes a curve of it.",
            );
            widgets::figure_row(ui, "Degree", &nurbs.degree().to_string());
            widgets::figure_row(ui, "Control points", &nurbs.points().len().to_string());
            let is_rational = nurbs.weights().is_some();
            widgets::fact_row(ui, "Weights", if is_rational { "rational" } else { "none" });
            interval_ui(ui, editor, curve);
        }
        // A picture has a panel of its own.
        ReferenceForm::Frame(_) => {}
    }
}

/// The button that fits a curve to points.
fn fit_ui(ui: &mut Ui, editor: &mut Editor) {
    let Some(operation) = operations::find("fit") else {
        return;
    };
    let is_ready = editor.input_of(operation).is_ok();
    let width = ui.available_width();
    let button = ui.add_enabled_ui(is_ready, |ui| {
        ui.add_sized(vec2(width, ROW), Button::new("Fit a curve"))
    });
    if button.inner.on_hover_text(operation.help).clicked() {
        told(editor.preview_operation(operation));
    }
}

fn parameters_ui(ui: &mut Ui, editor: &mut Editor, form: &AnalyticForm) {
    let parameters = form.kind().parameters.iter().zip(form.values());
    for (index, (parameter, value)) in parameters.enumerate() {
        let row = widgets::form_row(ui, parameter.label, |ui| {
            let field = field(parameter.label, *value).quantity(parameter.kind.quantity);
            let event = field.width(FIELD).show(ui);
            send(editor, event, |value| ReferenceChange::Value(index, value));
        });
        row.response.on_hover_text(parameter.help);
    }
}

fn interval_ui(ui: &mut Ui, editor: &mut Editor, curve: &ReferenceCurve) {
    let [from, to] = curve.interval();
    widgets::form_row(ui, "t from", |ui| {
        let t_field = |name, t| field(name, t).quantity(Quantity::Parameter).width(NARROW);
        let event = t_field("t from", from).show(ui);
        send(editor, event, |from| ReferenceChange::Interval([from, to]));
        widgets::caption(ui, "to");
        let event = t_field("t to", to).show(ui);
        send(editor, event, |to| ReferenceChange::Interval([from, to]));
    });
}

/// Show where a reference lies: its origin, how it is turned, and its scale.
pub fn placement_ui(ui: &mut Ui, editor: &mut Editor, curve: &ReferenceCurve) {
    let placement = curve.placement();
    let at = placement.translation();
    let pixel = editor.view().viewport().pixel();
    let event = vector_row(ui, ("Origin", "origin"), 3, at, |name, value| {
        NumberField::new(name, value, figures::short(value))
            .speed(pixel)
            .quantity(Quantity::Length)
    });
    send(editor, event, ReferenceChange::Translate);
    rotation_ui(ui, editor, placement.rotation());
    widgets::form_row(ui, "Scale", |ui| {
        let event = field("reference scale", placement.scale());
        let event = event.width(FIELD).show(ui);
        send(editor, event, ReferenceChange::Scale);
    });
}

/// One angle about the z axis; three where the reference is turned otherwise.
fn rotation_ui(ui: &mut Ui, editor: &mut Editor, rotation: DQuat) {
    let about_z = rotation.x == 0.0 && rotation.y == 0.0;
    if about_z {
        let angle = (2.0 * rotation.z.atan2(rotation.w)).to_degrees();
        // From −180° to 180°.
        let angle = angle - 360.0 * (angle / 360.0).round();
        widgets::form_row(ui, "Angle", |ui| {
            let event = angle_field("reference angle", angle).width(FIELD).show(ui);
            send(editor, event, |angle| {
                ReferenceChange::Rotate(DQuat::from_rotation_z(angle.to_radians()))
            });
        });
        return;
    }
    let (z, y, x) = rotation.to_euler(EulerRot::ZYX);
    let angles = [x, y, z];
    let width = field_width(ui, 3);
    widgets::form_row(ui, "Angles", |ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        for (index, name) in ["angle x", "angle y", "angle z"].into_iter().enumerate() {
            let shown = angles[index].to_degrees();
            let event = angle_field(name, shown).width(width).show(ui);
            send(editor, event, |angle| {
                let mut angles = angles;
                angles[index] = angle.to_radians();
                let [x, y, z] = angles;
                ReferenceChange::Rotate(DQuat::from_euler(EulerRot::ZYX, z, y, x))
            });
        }
    });
}

fn field(name: &str, value: f64) -> NumberField<'_> {
    let speed = (0.01 * value.abs()).max(1e-3);
    NumberField::new(name, value, figures::short(value)).speed(speed)
}

fn angle_field(name: &str, degrees: f64) -> NumberField<'_> {
    let shown = format!("{}°", figures::short(degrees));
    NumberField::new(name, degrees, shown)
        .speed(0.5)
        .quantity(Quantity::Angle)
}

/// Send a field's event to the editor. A preview that is impossible leaves the last one.
fn send<T>(
    editor: &mut Editor,
    event: Option<FieldEvent<T>>,
    change: impl FnOnce(T) -> ReferenceChange,
) {
    if let Some(event) = event {
        event.map(change).send(
            editor,
            |editor, change| drop(change.preview(editor)),
            |editor, change| told(change.apply(editor)),
        );
    }
}

/// Show the figures of a reference, which are those of its samples.
pub fn figures_ui(
    ui: &mut Ui,
    reference: &Reference,
    report: &ReferenceReport,
    display: CurvatureDisplay,
) {
    ui.spacing_mut().item_spacing.y = 0.0;
    let kind = match report.planar {
        true => "planar",
        false => "in space",
    };
    let form = reference.curve.form().label().to_lowercase();
    widgets::fact_row(ui, "Kind", &format!("{kind}, {form}"));
    let length = report.length.map(|length| figures::significant(length, 8));
    let length = length.map(|length| document_unit::length(ui.ctx(), length));
    let length = length.unwrap_or_else(|| "none: it has a gap".to_owned());
    widgets::figure_row(ui, "Length", &length);
    if reference.curve.form().is_smooth() {
        curvature_rows(ui, display, report.curvature);
    }
}
