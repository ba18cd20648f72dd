//! The end-fit panel: the seven steps, each with its live figures and its button.

use eframe::egui::{self, Button, Checkbox, Frame, Ui, vec2};
use glam::DVec3;
use lucide_icons::Icon;

use super::end_fit_curvature::{curvature_ui, direction_row};
use super::end_fit_match::match_ui;
use super::end_fit_steps::{angle_text, figure_pairs, indented, remark_ui, step_button, step_ui};
use super::figures::range;
use super::message::sentence;
use super::number_field::{FieldEvent, NumberField, vector_row};
use super::theme::{ROW, STEP, Tokens};
use super::widgets::IconButton;
use super::{document_unit, figures, widgets};
use crate::editor::{Editor, EndFitAction, EndFitReport, Layer, Refusal, told};
use crate::geometry::end_correction::{EndOverlap, EndTarget};
use crate::geometry::expressions::sin_cos_of_degrees;
use crate::geometry::parameters::Quantity;
use crate::geometry::{End, counted};
use crate::operations::LargestMove;

/// The width of a field for a coordinate.
const FIELD: f32 = 72.0;

/// The height of the place for the last action's message.
const OUTCOME: f32 = 10.0 * STEP;

/// Show the panel: the steps, and below them, in a place of its own, the last action's message.
pub fn end_fit_panel_ui(ui: &mut Ui, editor: &mut Editor) {
    let Some(report) = editor.hand().end_fit(editor.workspace(), editor.view()) else {
        empty_ui(ui, editor);
        return;
    };
    let place = egui::Panel::bottom("end fit outcome").resizable(false);
    let place = place.frame(Frame::NONE).exact_size(OUTCOME);
    place.show(ui, |ui| {
        widgets::scrolling(ui, "end fit outcome", |ui| outcome_ui(ui, &report));
    });
    let mut panel = Panel {
        report: &report,
        closed: !editor.sight().layers().shows(Layer::Float),
        pixel: editor.view().viewport().pixel(),
        event: None,
    };
    widgets::scrolling(ui, "end fit", |ui| {
        // Each end of each curve has fields of its own, so that no text goes to another end.
        ui.push_id((editor.active(), report.end), |ui| panel.show(ui));
    });
    if let Some(event) = panel.event {
        event.send(
            editor,
            |editor, action| action.preview(editor),
            |editor, action| {
                told(editor.end_fit_action(action));
            },
        );
    }
}

fn empty_ui(ui: &mut Ui, editor: &Editor) {
    ui.strong("End fit");
    let periodic = editor.active().and_then(|id| editor.document().curve(id));
    let text = match periodic {
        Some(curve) if curve.polygon.is_periodic() => {
            "A periodic curve has no ends. Open it first (Curve menu)."
        }
        Some(_) => "This curve cannot be corrected.",
        None => "Select an open curve to correct its ends.",
    };
    widgets::note(ui, text);
}

struct Panel<'a> {
    report: &'a EndFitReport,
    /// Whether the closed S-polygon stands in for the float one.
    closed: bool,
    pixel: f64,
    event: Option<FieldEvent<EndFitAction>>,
}

impl Panel<'_> {
    fn show(&mut self, ui: &mut Ui) {
        self.ends_ui(ui);
        self.target_ui(ui);
        if let Some(refusal) = &self.report.refusal {
            widgets::note(ui, &sentence(refusal));
        }
        ui.add_space(STEP);
        self.shape_ui(ui);
        self.closed_ui(ui);
        self.difference_ui(ui);
        step_ui(ui, 4, "Back to float", false, |_| {});
        self.corrections_ui(ui);
        self.repeat_ui(ui);
    }

    fn ask(&mut self, action: EndFitAction) {
        self.event = Some(FieldEvent::Set(action));
    }

    fn ends_ui(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            ui.strong("End fit");
            widgets::at_right(ui, |ui| {
                ui.spacing_mut().item_spacing.x = STEP;
                for (end, name) in [(End::Finish, "End"), (End::Start, "Start")] {
                    let button = Button::selectable(self.report.end == end, name);
                    let response = ui.add_sized(vec2(56.0, ROW), button);
                    if response.clicked() {
                        self.ask(EndFitAction::Choose(end));
                    }
                }
            });
        });
    }

    fn target_ui(&mut self, ui: &mut Ui) {
        let report = self.report;
        self.actual_ui(ui);
        if let Some(EndTarget { point, .. }) = report.target {
            // The source sets a matched end's target.
            ui.add_enabled_ui(report.matched.is_none(), |ui| {
                self.point_ui(ui, point);
                self.direction_ui(ui);
                self.event = curvature_ui(ui, report).or(self.event);
            });
        } else {
            widgets::note(
                ui,
                "No target yet: click the place on the canvas, or set one here.",
            );
        }
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            let free = report.matched.is_none();
            let actual = ui.add_enabled(free, Button::new("Use current end"));
            if actual
                .on_hover_text("Set the target to where the end is now")
                .clicked()
            {
                self.ask(EndFitAction::TargetActual);
            }
            if ui
                .add_enabled(report.target.is_some(), Button::new("Clear"))
                .clicked()
            {
                self.ask(EndFitAction::ClearTarget);
            }
            self.turn_round_ui(ui);
        });
        if let Some(action) = match_ui(ui, report) {
            self.ask(action);
        }
    }

    /// The end as it is: its point, and its tangent, the closed S-polygon's outermost leg.
    fn actual_ui(&self, ui: &mut Ui) {
        let report = self.report;
        let axes = if report.planar { 2 } else { 3 };
        let written = |vector: DVec3, resolution: f64| {
            let figures = (0..axes).map(|axis| figures::to_resolution(vector[axis], resolution));
            figures.collect::<Vec<String>>().join("  ")
        };
        let digits = if axes == 2 { 0.01 } else { 0.1 };
        let point = written(report.actual.point, digits * self.pixel);
        widgets::figure_row(ui, "Current end point", &point);
        let tangent = match report.actual.direction {
            Some(tangent) => match report.angle_of(tangent) {
                Some(angle) => figures::degrees(angle, 3),
                None => written(tangent, 1e-4),
            },
            None => "none: a cusp".to_owned(),
        };
        widgets::figure_row(ui, "Current tangent", &tangent);
    }

    fn point_ui(&mut self, ui: &mut Ui, point: DVec3) {
        let (pixel, axes) = (self.pixel, if self.report.planar { 2 } else { 3 });
        let event = vector_row(ui, ("Target", "target"), axes, point, |name, value| {
            NumberField::new(name, value, figures::to_resolution(value, 0.01 * pixel))
                .speed(pixel)
                .quantity(Quantity::Length)
        });
        let event = event.map(|event| event.map(EndFitAction::SetPoint));
        self.event = event.or(self.event);
    }

    fn direction_ui(&mut self, ui: &mut Ui) {
        let report = self.report;
        let mut caption = "Direction";
        let direction = report.target_direction();
        if let Some(direction) = direction.filter(|_| !report.planar) {
            // Three components fill the row.
            let event = direction_row(ui, (caption, "target direction"), direction);
            let set = |direction| EndFitAction::SetDirection(Some(direction));
            self.event = event.map(|event| event.map(set)).or(self.event);
            caption = "";
        }
        if caption.is_empty() && report.planar {
            return;
        }
        widgets::form_row(ui, caption, |ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            if let Some(angle) = direction.and_then(|direction| report.angle_of(direction)) {
                self.angle_ui(ui, angle);
            }
            self.fixed_ui(ui);
        });
    }

    fn turn_round_ui(&mut self, ui: &mut Ui) {
        let button = IconButton::new(Icon::ArrowLeftRight, "Flip direction");
        let enabled = self.report.target_direction().is_some();
        if button.enabled(enabled).show(ui).clicked() {
            self.ask(EndFitAction::TurnRound);
        }
    }

    fn fixed_ui(&mut self, ui: &mut Ui) {
        let mut fixed = self.report.target_direction().is_some();
        let free = ui.add(Checkbox::new(&mut fixed, "Lock direction"));
        let tooltip = "Require a tangent direction at the end";
        if free.on_hover_text(tooltip).clicked() {
            let actual = self.report.actual.direction.unwrap_or(DVec3::X);
            self.ask(EndFitAction::SetDirection(fixed.then_some(actual)));
        }
    }

    fn angle_ui(&mut self, ui: &mut Ui, angle: f64) {
        let degrees = angle.to_degrees();
        let shown = format!("{degrees:.3}°");
        let field = NumberField::new("target direction", degrees, shown)
            .speed(0.25)
            .quantity(Quantity::Angle)
            .width(FIELD + 8.0);
        let event = field.show(ui).map(|event| {
            event.map(|degrees| {
                let (sine, cosine) = sin_cos_of_degrees(degrees);
                EndFitAction::SetDirection(Some(DVec3::new(cosine, sine, 0.0)))
            })
        });
        self.event = event.or(self.event);
    }

    fn shape_ui(&mut self, ui: &mut Ui) {
        let report = self.report;
        step_ui(ui, 1, "Shape float S-polygon", false, |_| {});
        indented(ui, |ui| {
            let plain = |value: f64| figures::significant(value, 6);
            widgets::figure_row(ui, "Polygon legs", &range(report.legs, plain));
            let angle = |value: f64| figures::degrees(value, 3);
            widgets::figure_row(ui, "Turning angles", &range(report.turns, angle));
        });
    }

    fn closed_ui(&mut self, ui: &mut Ui) {
        let closed = self.closed;
        step_ui(ui, 2, "Closed S-polygon", false, |ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            for (name, wanted) in [("Closed", true), ("Float", false)] {
                let response = ui.add(Button::selectable(closed == wanted, name));
                let response =
                    response.accessible_name(format!("Show {} S-polygon", name.to_lowercase()));
                if response.clicked() && closed != wanted {
                    self.ask(EndFitAction::ShowClosed(wanted));
                }
            }
        });
    }

    fn difference_ui(&mut self, ui: &mut Ui) {
        let report = self.report;
        let is_met = self.is_in_place() && self.is_aligned() && report.is_met();
        step_ui(ui, 3, "Difference to target", is_met, |_| {});
        indented(ui, |ui| {
            if report.target.is_none() {
                widgets::note(ui, "Set a target first.");
                return;
            }
            let d = report.difference;
            let plain = |value: f64| figures::significant(value, 6);
            let mut pairs = vec![("Δx", plain(d.x)), ("Δy", plain(d.y))];
            if !report.planar {
                pairs.push(("Δz", plain(d.z)));
            }
            let length = document_unit::length(ui.ctx(), plain(d.length()));
            pairs.push(("Length", length));
            pairs.push(("Angle", angle_text(report.angle)));
            if let (Some(target), Some(missing)) = (report.target, report.missing) {
                let asked = [
                    ("Δκ", target.curvature.map(|_| plain(missing.curvature))),
                    ("Plane", target.normal.map(|_| angle_text(missing.plane))),
                    ("Slope", target.slope.map(|_| plain(missing.slope))),
                ];
                pairs.extend(asked.into_iter().filter_map(|(name, it)| Some((name, it?))));
            }
            figure_pairs(ui, &pairs);
        });
    }

    fn is_in_place(&self) -> bool {
        let report = self.report;
        report.target.is_some() && report.difference.length() <= report.tolerance
    }

    fn is_aligned(&self) -> bool {
        self.report.angle.abs() <= 1e-9
    }

    /// Show a step whose button performs an action; `name` is the button's name for screen readers.
    fn action_ui(
        &mut self,
        ui: &mut Ui,
        (number, title, done): (usize, &str, bool),
        [label, name, tooltip]: [&str; 3],
        action: Option<EndFitAction>,
    ) {
        step_ui(ui, number, title, done, |ui| {
            let response = step_button(ui, label, action.is_some()).accessible_name(name);
            let clicked = response.on_hover_text(tooltip).clicked();
            if let Some(action) = action.filter(|_| clicked) {
                self.ask(action);
            }
        });
    }

    fn corrections_ui(&mut self, ui: &mut Ui) {
        let report = self.report;
        let count = counted(report.terminal, "vertex", "vertices");
        let has_point = report.target.is_some() && report.can_move();
        let texts = [
            "Translate",
            "Translate terminal vertices",
            "Translate the terminal vertices, as one body, by the difference vector",
        ];
        let action = has_point.then_some(EndFitAction::Translate);
        let title = format!("Move {count}");
        self.action_ui(ui, (5, &title, self.is_in_place()), texts, action);
        let has_direction =
            report.target_direction().is_some() && report.actual.direction.is_some();
        let texts = [
            "Rotate",
            "Rotate terminal vertices",
            "Rotate the terminal vertices about the end point by the difference angle",
        ];
        let action = (has_direction && report.can_move()).then_some(EndFitAction::Rotate);
        let is_done = has_direction && self.is_aligned();
        self.action_ui(ui, (6, &format!("Turn {count}"), is_done), texts, action);
    }

    fn repeat_ui(&mut self, ui: &mut Ui) {
        let report = self.report;
        let can_repeat = report.targets > 0 && report.can_move();
        let texts = [
            "Repeat",
            "Repeat",
            "Repeat steps 2 to 6 on both ends until within the tolerance",
        ];
        let action = can_repeat.then_some(EndFitAction::Repeat);
        self.action_ui(ui, (7, "Refine and repeat", report.within), texts, action);
        indented(ui, |ui| {
            self.both_ui(ui);
            let (distance, angle) = match report.targets {
                0 => ("–".to_owned(), "–".to_owned()),
                _ => (
                    document_unit::length(
                        ui.ctx(),
                        figures::significant(report.remaining_distance, 4),
                    ),
                    angle_text(report.remaining_angle),
                ),
            };
            let passes = report.passes.to_string();
            let tooltip = "The error of the end that is farther from its target";
            widgets::figure_row(ui, "Remaining error, distance", &distance).on_hover_text(tooltip);
            widgets::figure_row(ui, "Remaining error, angle", &angle).on_hover_text(tooltip);
            widgets::figure_row(ui, "Passes", &passes);
            self.tolerance_ui(ui);
        });
        // Once the ends are met, or the loop has said the same, there is nothing to warn of.
        let failed = report.outcome.as_ref().is_some_and(Result::is_err);
        if !report.within && !failed {
            overlap_ui(ui, report);
        }
    }

    fn tolerance_ui(&mut self, ui: &mut Ui) {
        let tolerance = self.report.tolerance;
        widgets::form_row(ui, "Tolerance", |ui| {
            let field =
                NumberField::new("tolerance", tolerance, figures::significant(tolerance, 4))
                    .range(0.0..=f64::MAX)
                    .quantity(Quantity::Length)
                    .width(FIELD + 24.0);
            if let Some(value) = field.typed(ui) {
                self.ask(EndFitAction::SetTolerance(value));
            }
        });
    }

    fn both_ui(&mut self, ui: &mut Ui) {
        let report = self.report;
        let size = vec2(ui.available_width(), ROW);
        let button = Button::new("Both ends at once");
        let response = ui
            .add_enabled_ui(report.targets > 0 && report.can_move(), |ui| {
                ui.add_sized(size, button)
            })
            .inner;
        let tooltip = "Meet all targets at once, with the smallest moves of vertices";
        if response.on_hover_text(tooltip).clicked() {
            self.ask(EndFitAction::BothAtOnce);
        }
        let largest = report.largest_move.map(|LargestMove { distance, vertex }| {
            let distance = document_unit::length(ui.ctx(), figures::significant(distance, 4));
            format!("{distance} at vertex {vertex}")
        });
        widgets::figure_row(ui, "Largest move", &largest.unwrap_or("–".to_owned()));
    }
}

/// Show the last action's message.
fn outcome_ui(ui: &mut Ui, report: &EndFitReport) {
    let (text, failed) = match &report.outcome {
        None => return,
        Some(Ok(note)) => (&note.text, false),
        Some(Err(Refusal(reason))) => (reason, true),
    };
    let tokens = Tokens::of(ui);
    let (icon, colour) = if failed {
        (Icon::TriangleAlert, tokens.error)
    } else {
        (Icon::Check, tokens.good)
    };
    if !text.is_empty() {
        remark_ui(ui, icon, text, colour);
    }
}

/// Warn where the groups of vertices of both ends overlap.
fn overlap_ui(ui: &mut Ui, report: &EndFitReport) {
    let text = match report.overlap {
        EndOverlap::None => return,
        EndOverlap::Partial { shared } => format!(
            "Both ends share {}. Repeating converges slowly, if at all: use “Both ends at once”.",
            counted(shared, "vertex", "vertices")
        ),
        EndOverlap::OneSegment => {
            "Too few vertices to move each end on its own: use “Both ends at once”.".to_owned()
        }
    };
    let warning = Tokens::of(ui).warning;
    indented(ui, |ui| remark_ui(ui, Icon::Info, &text, warning));
}
