//! The end-fit panel's target: what the end must have, picked from another curve or typed.

use eframe::egui::{
    Button, Checkbox, Label, Response, RichText, Role, Sense, Ui, WidgetInfo, vec2,
};
use glam::DVec3;
use lucide_icons::Icon;

use super::number_field::{FieldEvent, NumberField, vector_row};
use super::theme::{ROW, STEP, Tokens};
use super::widgets::{self, IconButton, above_noise};
use super::{document_unit, figures, icons};
use crate::document::{MatchPlace, quoted};
use crate::editor::{EndFitAction, EndFitReport, EndNoise, MatchReport};
use crate::geometry::Continuity;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::expressions::sin_cos_of_degrees;
use crate::geometry::parameters::Quantity;

/// The width of a field.
const FIELD: f32 = 88.0;

/// The width of the captions of conditions.
const CONDITION: f32 = 104.0;

/// The width of the buttons beside a match.
const BUTTONS: f32 = 2.0 * ROW + 4.0 * STEP;

/// A user's action on the panel.
type Event = FieldEvent<EndFitAction>;

/// A condition that a target may require beyond its place.
struct Condition {
    name: &'static str,
    help: &'static str,
    /// Whether the target requires it.
    is_required: bool,
    /// The action that requires it as the end has it now; `None` where the end has none.
    require: Option<EndFitAction>,
    free: EndFitAction,
}

impl Condition {
    /// Show the switch between free and required.
    fn lock_ui(&self, ui: &mut Ui) -> Option<Event> {
        let mut is_required = self.is_required;
        let is_enabled = is_required || self.require.is_some();
        let response = ui.add_enabled(is_enabled, Checkbox::new(&mut is_required, "Require"));
        let response = response.accessible_name(format!("Require {}", self.name.to_lowercase()));
        let is_clicked = response.on_hover_text(self.help).clicked();
        let action = if is_required {
            self.require
        } else {
            Some(self.free)
        };
        action.filter(|_| is_clicked).map(FieldEvent::Set)
    }

    /// Show a number: its field where it is required, otherwise the number that the end has.
    fn number_ui(
        &self,
        ui: &mut Ui,
        quantity: Quantity,
        [value, actual]: [Option<f64>; 2],
        set: impl Fn(f64) -> EndFitAction,
    ) -> Option<Event> {
        let shown = |value: f64| match quantity {
            Quantity::Angle => figures::degrees_text(value, 3),
            _ => figures::significant(value, 4),
        };
        let row = widgets::wide_form_row(ui, self.name, CONDITION, |ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            let Some(value) = value else {
                let radius = actual.filter(|_| quantity == Quantity::Curvature);
                let now = now_ui(ui, &actual.map_or("none".to_owned(), shown));
                if let Some(curvature) = radius {
                    now.on_hover_text(radius_text(ui, curvature));
                }
                return self.lock_ui(ui);
            };
            let size = value.abs().max(actual.unwrap_or_default().abs());
            let speed = match quantity {
                Quantity::Angle => 0.25,
                _ if size > 0.0 => 0.01 * size,
                _ => 0.001,
            };
            let name = format!("target {}", self.name.to_lowercase());
            let field = NumberField::new(&name, value, shown(value)).speed(speed);
            let radius = radius_text(ui, value);
            let field = match quantity {
                Quantity::Curvature => field.help(&radius),
                _ => field,
            };
            let event = field.quantity(quantity).width(FIELD).show(ui);
            self.lock_ui(ui).or(event.map(|event| event.map(set)))
        });
        row.inner
    }

    /// Show a direction in space: three components in a row, and the switch below.
    fn direction_ui(
        &self,
        ui: &mut Ui,
        direction: Option<DVec3>,
        set: impl Fn(Option<DVec3>) -> EndFitAction,
    ) -> Option<Event> {
        let mut caption = self.name;
        let event = direction.and_then(|direction| {
            let names = (caption, &*format!("target {}", caption.to_lowercase()));
            caption = "";
            vector_row(ui, names, 3, direction, |name, value| {
                NumberField::new(name, value, format!("{value:.3}")).speed(0.005)
            })
        });
        let row = widgets::wide_form_row(ui, caption, CONDITION, |ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            self.lock_ui(ui)
        });
        let event = event.map(|event| event.map(|direction| set(Some(direction))));
        row.inner.or(event)
    }
}

/// The radius of a curvature.
fn radius_text(ui: &Ui, curvature: f64) -> String {
    let radius = document_unit::length(ui.ctx(), figures::radius_of(curvature, 6));
    format!("R {radius}")
}

fn now_ui(ui: &mut Ui, actual: &str) -> Response {
    let text = format!("now {actual}");
    let (rect, response) = ui.allocate_exact_size(vec2(FIELD, ROW), Sense::hover());
    widgets::number_in(ui, rect, actual, Tokens::of(ui).faint_text);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &text));
    response
}

/// Show the end as it is, and its target.
pub fn target_ui(ui: &mut Ui, report: &EndFitReport, pixel: f64) -> Option<Event> {
    actual_ui(ui, report, pixel);
    // Without a target the fields show the end as it is: another value sets a target.
    let target = report.target.unwrap_or(EndTarget {
        curvature: None,
        normal: None,
        slope: None,
        ..report.actual
    });
    let mut event = None;
    // The source sets a matched end's target.
    let is_own = report.matched.is_none();
    ui.add_enabled_ui(is_own, |ui| {
        let axes = if report.planar { 2 } else { 3 };
        let place = vector_row(
            ui,
            ("Target", "target"),
            axes,
            target.point,
            |name, value| {
                NumberField::new(name, value, figures::to_resolution(value, 0.01 * pixel))
                    .speed(pixel)
                    .quantity(Quantity::Length)
            },
        );
        let place = place.map(|event| event.map(EndFitAction::SetPoint));
        event = conditions_ui(ui, report, &target).or(place);
    });
    let buttons = ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        let actual = ui.add_enabled(report.matched.is_none(), Button::new("Use current end"));
        let actual = actual.on_hover_text("Set the target to where the end is now");
        let clear = ui.add_enabled(report.target.is_some(), Button::new("Clear"));
        let across = report.axis.as_ref().and_then(|axis| {
            let button = Button::new(format!("Perpendicular to {}", axis.name));
            let response = ui.add_enabled(is_own, button);
            let help = "Require a tangent perpendicular to the axis, and the end on it";
            let target = EndFitAction::SetTarget(axis.target);
            response.on_hover_text(help).clicked().then_some(target)
        });
        let flip = IconButton::new(Icon::ArrowLeftRight, "Flip direction");
        let flip = flip.enabled(report.target_direction().is_some()).show(ui);
        [
            actual.clicked().then_some(EndFitAction::TargetActual),
            clear.clicked().then_some(EndFitAction::ClearTarget),
            flip.clicked().then_some(EndFitAction::TurnRound),
            across,
        ]
    });
    let action = match_ui(ui, report).or(buttons.inner.into_iter().flatten().next());
    action.map(FieldEvent::Set).or(event)
}

/// The end as it is: its point, and its tangent, the closed S-polygon's outermost leg.
fn actual_ui(ui: &mut Ui, report: &EndFitReport, pixel: f64) {
    let axes = if report.planar { 2 } else { 3 };
    let written = |vector: DVec3, resolution: f64| {
        let figures = (0..axes).map(|axis| figures::to_resolution(vector[axis], resolution));
        figures.collect::<Vec<String>>().join("  ")
    };
    let digits = if report.planar { 0.01 } else { 0.1 };
    let point = written(report.actual.point, digits * pixel);
    let point = document_unit::length(ui.ctx(), point);
    let tangent = match report.actual.direction {
        Some(tangent) => match report.angle_of(tangent) {
            Some(angle) => figures::degrees(angle, 3),
            None => written(tangent, 1e-4),
        },
        None => "none: a cusp".to_owned(),
    };
    if report.planar {
        widgets::figure_row(ui, "Current end", &format!("{point}  {tangent}"));
    } else {
        widgets::figure_row(ui, "Current end point", &point);
        widgets::figure_row(ui, "Current tangent", &tangent);
    }
}

/// Show what the target requires beyond its place: direction, curvature, plane and slope.
fn conditions_ui(ui: &mut Ui, report: &EndFitReport, target: &EndTarget) -> Option<Event> {
    let actual = &report.actual;
    let direction = Condition {
        name: "Direction",
        help: "Require a tangent direction at the end",
        is_required: target.direction.is_some(),
        require: Some(EndFitAction::SetDirection(Some(
            actual.direction.unwrap_or(DVec3::X),
        ))),
        free: EndFitAction::SetDirection(None),
    };
    let mut event = if report.planar {
        let angle = |direction: Option<DVec3>| Some(report.angle_of(direction?)?.to_degrees());
        let degrees = [target.direction, actual.direction].map(angle);
        direction.number_ui(ui, Quantity::Angle, degrees, |degrees| {
            let (sine, cosine) = sin_cos_of_degrees(degrees);
            EndFitAction::SetDirection(Some(DVec3::new(cosine, sine, 0.0)))
        })
    } else {
        direction.direction_ui(ui, target.direction, EndFitAction::SetDirection)
    };
    // At a cusp there is nothing to require.
    let required = |number: Option<f64>| actual.direction.map(|_| number.unwrap_or_default());
    let curvature = Condition {
        name: "Curvature",
        help: "Require a curvature κ at the end, positive where it turns left",
        is_required: target.curvature.is_some(),
        require: required(actual.curvature).map(|it| EndFitAction::SetCurvature(Some(it))),
        free: EndFitAction::SetCurvature(None),
    };
    let numbers = [target.curvature, actual.curvature];
    let set = |value| EndFitAction::SetCurvature(Some(value));
    event = curvature
        .number_ui(ui, Quantity::Curvature, numbers, set)
        .or(event);
    if !report.planar {
        let plane = Condition {
            name: "Plane",
            help: "Require an osculating plane at the end, by its normal",
            is_required: target.normal.is_some(),
            require: actual.normal.map(|it| EndFitAction::SetNormal(Some(it))),
            free: EndFitAction::SetNormal(None),
        };
        event = plane
            .direction_ui(ui, target.normal, EndFitAction::SetNormal)
            .or(event);
    }
    let slope = Condition {
        name: "Curvature slope",
        help: "Require a curvature slope dκ/ds at the end",
        is_required: target.slope.is_some(),
        require: required(actual.slope).map(|it| EndFitAction::SetSlope(Some(it))),
        free: EndFitAction::SetSlope(None),
    };
    let numbers = [target.slope, actual.slope];
    let set = |value| EndFitAction::SetSlope(Some(value));
    slope
        .number_ui(ui, Quantity::Number, numbers, set)
        .or(event)
}

/// Show the level that is picked or kept, the match that there is, and the curves that follow.
fn match_ui(ui: &mut Ui, report: &EndFitReport) -> Option<EndFitAction> {
    let mut action = None;
    let matched = report.matched.as_ref();
    let now = matched.map_or(report.continuity, |it| it.matched.continuity);
    widgets::form_row(ui, "Match", |ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        for level in Continuity::ALL {
            let button = Button::selectable(now == level, level.name());
            let response = ui.add_sized(vec2(40.0, ROW), button);
            let tooltip = format!("Match up to the {}", level.label());
            if response.on_hover_text(tooltip).clicked() {
                action = Some(EndFitAction::SetContinuity(level));
            }
        }
    });
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0 * STEP;
        let pick = ui.add(Button::new("Pick from curve").selected(report.picking));
        let tooltip = "Then click another curve: the target takes its place and direction there";
        if pick.on_hover_text(tooltip).clicked() {
            action = Some(EndFitAction::PickFromCurve);
        }
        let mut live = matched.is_some() || report.live;
        let (label, tooltip) = match matched {
            Some(_) => (
                "Keep matched",
                "Match the end again whenever the other curve changes",
            ),
            None => (
                "Keep picks matched",
                "Match the end to a picked place again whenever that curve changes",
            ),
        };
        let keep = ui.add(Checkbox::new(&mut live, label));
        if keep.on_hover_text(tooltip).clicked() {
            action = Some(EndFitAction::KeepMatched(live));
        }
    });
    if let Some(matched) = matched {
        action = matched_ui(ui, matched, report.noise).or(action);
        if !matched.met {
            let why = match &report.refusal {
                Some(_) => "Not met: unlock the curve to match it.",
                None => "Not met: match a lower level, unlock vertices, or add more.",
            };
            let error = Tokens::of(ui).error;
            widgets::remark_with_icon(ui, Icon::TriangleAlert, why, error);
        }
    }
    for (name, end) in &report.followers {
        let (end, name) = (end.name(), quoted(name));
        widgets::note(ui, &format!("The {end} of {name} is matched to this curve"));
    }
    action
}

/// The source of a matched end, and the error of each level.
fn matched_ui(ui: &mut Ui, report: &MatchReport, noise: EndNoise) -> Option<EndFitAction> {
    let mut action = None;
    let place = match report.matched.place {
        MatchPlace::End(end) => format!("its {}", end.name()),
        MatchPlace::Parameter(u) => format!("u = {}", figures::significant(u, 5)),
    };
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 1.5 * STEP;
        let tokens = Tokens::of(ui);
        ui.label(icons::text(Icon::Link).color(tokens.target));
        let text = format!("Matched to {} at {place}", quoted(&report.source));
        let text = RichText::new(text).color(tokens.strong_text);
        let width = ui.available_width() - BUTTONS;
        ui.allocate_ui(vec2(width, ROW), |ui| {
            ui.set_width(width);
            ui.add(Label::new(text).truncate());
        });
        widgets::at_right(ui, |ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            if IconButton::new(Icon::X, "Remove match").show(ui).clicked() {
                action = Some(EndFitAction::KeepMatched(false));
            }
            let turn = IconButton::new(Icon::ArrowLeftRight, "Flip match");
            if turn.show(ui).clicked() {
                action = Some(EndFitAction::TurnRound);
            }
        });
    });
    let missing = &report.missing;
    let plain = |value: f64| figures::significant(value, 4);
    let errors = [
        (
            "G0 error",
            above_noise(missing.vector.length(), noise.length, plain),
        ),
        (
            "G1 error",
            above_noise(missing.angle, noise.angle, figures::angle),
        ),
        (
            "G2 error",
            above_noise(missing.curvature, noise.curvature, plain),
        ),
        ("G3 error", above_noise(missing.slope, noise.slope, plain)),
    ];
    widgets::figure_pairs(ui, &errors);
    action
}
