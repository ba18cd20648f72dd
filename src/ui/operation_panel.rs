//! The operation panel: the parameters and the result of the operation in progress.

use std::time::Duration;

use eframe::egui::{Button, Frame, Panel, ProgressBar, Ui, vec2};
use lucide_icons::Icon;

use super::atlas::{AtlasView, Values};
use super::feature_comparison::OUTDATED;
use super::fitted_points::fitted_points_ui;
use super::number_field::FieldEvent;
use super::operation_fields::{OperationFields, Refused};
use super::operation_report::{ReportView, failure, summary_ui, three_lines_ui, warning};
use super::theme::{STEP, Tokens};
use super::widgets::{self, IconButton};
use crate::document::CurveId;
use crate::editor::{Editor, OperationInProgress, Run, told};
use crate::operations::Atlas;

/// The heights of the places for the summary, the error and the buttons, one below the other.
const FOOT: [f32; 3] = [16.0 * STEP, 13.0 * STEP, 9.0 * STEP];

/// The time between two looks at a search.
const REFRESH: Duration = Duration::from_millis(100);

/// The panel's own state.
#[derive(Default)]
pub struct OperationPanel {
    fields: OperationFields,
    atlas: AtlasView,
    report: ReportView,
}

/// An action of the user in the panel.
enum PanelAction {
    /// Change values of parameters.
    Change(FieldEvent<Values>),
    /// Take another second curve.
    Second(CurveId),
    Apply,
    /// Stop the search with the best found so far.
    Stop,
    Leave,
}

impl OperationPanel {
    /// Show the panel of the operation in progress: its fields and result, which scroll together, and in a
    /// place of their own the summary and the buttons.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let Some(in_progress) = editor.operation() else {
            *self = Self::default();
            return;
        };
        let atlas = atlas_of(in_progress).copied();
        let refused_before = self.fields.refusal.clone();
        let mut actions = Vec::from_iter(heading_ui(ui, in_progress));
        let foot = self.foot_ui(ui, in_progress, editor.operation_progress());
        ui.add_space(STEP);
        let (mut shows_atlas, mut whiskers) = (false, editor.view().whiskers);
        widgets::scrolling(ui, in_progress.operation().name, |ui| {
            if let Some(points) = in_progress.fitted_points() {
                fitted_points_ui(ui, in_progress, points, &mut whiskers);
            }
            actions.extend(second_ui(ui, in_progress));
            actions.extend(self.fields_ui(ui, in_progress));
            ui.separator();
            if let Some(atlas) = &atlas {
                let view = &mut self.atlas;
                let shown = widgets::section(ui, "Atlas", true, |ui| {
                    view.show(ui, editor, in_progress, atlas)
                });
                shows_atlas = shown.is_some();
                actions.extend(shown.flatten().map(PanelAction::Change));
                ui.add_space(STEP);
            }
            let clicked = self.report.show(ui, in_progress);
            actions.extend(clicked.map(|values| PanelAction::Change(FieldEvent::Set(values))));
        });
        // A click on a button also leaves a field: its text counts first.
        actions.extend(foot);
        editor.view_mut().shows_atlas = shows_atlas;
        editor.view_mut().whiskers = whiskers;
        for action in actions {
            self.perform(action, editor, &refused_before);
        }
    }

    fn perform(&mut self, action: PanelAction, editor: &mut Editor, before: &Option<Refused>) {
        match action {
            PanelAction::Change(FieldEvent::Set(values)) => {
                self.set(editor, &values, before);
                editor.operating().keep_values();
            }
            PanelAction::Change(FieldEvent::Preview(values)) => {
                editor.operating().hold_values();
                self.set(editor, &values, before);
            }
            PanelAction::Change(FieldEvent::Commit) => editor.operating().keep_values(),
            PanelAction::Change(FieldEvent::Abort) => editor.operating().restore_values(),
            PanelAction::Second(second) => editor.operating().choose_second(second),
            PanelAction::Apply => told(editor.operating().apply()),
            PanelAction::Stop => editor.operating().stop(),
            PanelAction::Leave => editor.operating().leave(),
        }
    }

    fn set(&mut self, editor: &mut Editor, values: &Values, before: &Option<Refused>) {
        let refused = editor.operating().set_values(values).err();
        let refused = refused.map(|error| Refused {
            parameter: match values.as_slice() {
                [(parameter, _)] => Some(*parameter),
                _ => None,
            },
            text: error.to_string(),
        });
        // A text that was refused just now gave back the value before it.
        if refused.is_some() || self.fields.refusal == *before {
            self.fields.refusal = refused;
        }
    }

    /// At the lower edge, whatever stands above: the summary, why nothing comes of the values, and the buttons.
    fn foot_ui(
        &self,
        ui: &mut Ui,
        in_progress: &OperationInProgress,
        progress: Option<f64>,
    ) -> Option<PanelAction> {
        let [summary, wrong, buttons] = FOOT;
        // Other values of an applied search are searched for again.
        let has_buttons = !in_progress.is_applied() || in_progress.operation().can_be_stopped();
        let height = if has_buttons { buttons } else { 0.0 };
        let panel = Panel::bottom("operation foot").resizable(false);
        let panel = panel
            .frame(Frame::NONE)
            .exact_size(summary + wrong + height);
        let action = panel.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            ui.allocate_ui(vec2(ui.available_width(), summary), |ui| {
                ui.set_height(summary);
                ui.add_space(STEP);
                summary_ui(ui, in_progress);
            });
            ui.allocate_ui(vec2(ui.available_width(), wrong), |ui| {
                ui.set_height(wrong);
                // A field's own error stands below the field.
                let refused = self.fields.refusal.as_ref();
                let refused = refused.filter(|refused| refused.parameter.is_none());
                let refused = refused.map(|refused| refused.text.clone());
                if let Some(text) = note_on_search(in_progress) {
                    widgets::note(ui, text);
                    return;
                }
                if in_progress.is_pending() {
                    ui.multiply_opacity(OUTDATED);
                }
                if let Some(text) = refused.or_else(|| failure(in_progress)) {
                    three_lines_ui(ui, &text, Tokens::of(ui).error);
                } else if let Some(text) = warning(in_progress) {
                    three_lines_ui(ui, text, Tokens::of(ui).warning);
                }
            });
            has_buttons.then(|| buttons_ui(ui, in_progress, progress))
        });
        action.inner.flatten()
    }

    fn fields_ui(&mut self, ui: &mut Ui, in_progress: &OperationInProgress) -> Vec<PanelAction> {
        let operation = in_progress.operation();
        let parameters = operation.parameters_for(in_progress.input(), in_progress.values());
        let actions = parameters.filter_map(|parameter| {
            let event = self.fields.show(ui, in_progress, parameter)?;
            let change = event.map(|value| vec![(parameter.name, value)]);
            Some(PanelAction::Change(change))
        });
        actions.collect()
    }
}

/// The choice of the second curve, where the operation takes one.
fn second_ui(ui: &mut Ui, in_progress: &OperationInProgress) -> Option<PanelAction> {
    let (others, second) = in_progress.seconds();
    let second = second?;
    widgets::caption(ui, "Second curve");
    let width = ui.available_width();
    let (chosen, list) = widgets::drop_down(ui, "Second curve", width, &second, others);
    list.on_hover_text(
        "The curve that is joined to the active one; a click on the canvas chooses too",
    );
    chosen.map(PanelAction::Second)
}

/// What becomes of a search that runs: that it will be applied, or else what to expect of it.
fn note_on_search(in_progress: &OperationInProgress) -> Option<&str> {
    if in_progress.is_waiting_to_apply() {
        return Some("Applies when ready; Cancel ends it");
    }
    let points = in_progress.fitted_points();
    points.filter(|_| in_progress.is_pending())?.expectation()
}

/// The atlas that the operation offers.
fn atlas_of(in_progress: &OperationInProgress) -> Option<&Atlas> {
    let run = in_progress.run()?.as_ref().ok()?;
    run.outcome.atlas.as_ref()
}

fn heading_ui(ui: &mut Ui, in_progress: &OperationInProgress) -> Option<PanelAction> {
    let mut left = false;
    ui.horizontal(|ui| {
        ui.strong(in_progress.operation().label);
        let beside = in_progress.input().beside();
        if !beside.is_empty() {
            let able = 1 + beside.iter().filter(|(_, it)| it.is_ok()).count();
            widgets::caption(ui, &format!("{able} of {} selected", 1 + beside.len()));
        }
        if in_progress.is_applied() {
            let run = in_progress.run().and_then(|run| run.as_ref().ok());
            let is_changed = !run.is_some_and(Run::changes_nothing);
            widgets::caption(ui, if is_changed { "applied" } else { "unchanged" });
            widgets::at_right(ui, |ui| {
                let close = IconButton::new(Icon::X, "Close operation");
                left = close.size(5.0 * STEP).show(ui).clicked();
            });
        }
    });
    widgets::note(ui, in_progress.operation().help);
    left.then_some(PanelAction::Leave)
}

/// Apply and Cancel of a preview, and how far its run is; their keys are the canvas's, which has the keyboard unless a
/// field has it.
fn buttons_ui(
    ui: &mut Ui,
    in_progress: &OperationInProgress,
    progress: Option<f64>,
) -> Option<PanelAction> {
    let mut action = None;
    let (enabled, reached) = match in_progress.run() {
        None => (true, true),
        Some(Ok(run)) => {
            let is_useful = run.outcome.is_useful();
            (is_useful, run.report.reached || !is_useful)
        }
        Some(Err(_)) => (false, true),
    };
    let enabled = enabled && !in_progress.is_waiting_to_apply();
    ui.horizontal_centered(|ui| {
        if !in_progress.is_applied() {
            let apply = ui.add_enabled_ui(enabled, |ui| match reached {
                true => widgets::primary_button(ui, "Apply"),
                false => ui.button("Apply anyway"),
            });
            if apply.inner.on_hover_text("Enter").clicked() {
                action = Some(PanelAction::Apply);
            }
            if ui.button("Cancel").on_hover_text("Esc").clicked() {
                action = Some(PanelAction::Leave);
            }
        }
        let Some(done) = progress else { return };
        // The bar grows while nothing else happens.
        ui.request_repaint_after(REFRESH);
        widgets::at_right(ui, |ui| {
            if in_progress.is_pending() && in_progress.operation().can_be_stopped() {
                let enabled = in_progress.can_be_stopped();
                let stop = ui.add_enabled(enabled, Button::new("Stop"));
                if stop
                    .on_hover_text("End the search with the best found so far")
                    .clicked()
                {
                    action = Some(PanelAction::Stop);
                }
            }
            let bar = ProgressBar::new(done as f32).show_percentage();
            ui.add(bar.desired_width(ui.available_width()));
        });
    });
    action
}
