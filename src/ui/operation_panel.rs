//! The operation panel: the parameters of the operation that is tried out, and what it does.

use eframe::egui::{Frame, Panel, ProgressBar, Ui, vec2};
use lucide_icons::Icon;

use super::atlas::{self, AtlasView};
use super::operation_fields::{self, OperationFields, Refused};
use super::operation_report::{ReportView, error_ui, failure, summary_ui};
use super::theme::STEP;
use super::widgets::{self, IconButton};
use crate::editor::{Editor, OperationInProgress, told};
use crate::operations::{Atlas, Parameter, Value};

/// The heights of the places for the summary, for what is wrong and for the buttons, one below the other.
const FOOT: [f32; 3] = [16.0 * STEP, 9.0 * STEP, 9.0 * STEP];

/// The panel's own state.
#[derive(Default)]
pub struct OperationPanel {
    fields: OperationFields,
    atlas: AtlasView,
    report: ReportView,
}

/// What the user asks for.
enum Asked {
    /// What is asked for in the field of a parameter.
    Field(&'static Parameter, operation_fields::Asked),
    /// What is asked for in the atlas.
    Atlas(atlas::Asked),
    Apply,
    Leave,
}

impl OperationPanel {
    /// Show the panel of the operation that is tried out, or was applied last: its fields and below them what
    /// it came to, which scroll together, and what matters most of it with the buttons in a place of their own.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let Some(in_progress) = editor.operation() else {
            *self = Self::default();
            return;
        };
        let atlas = atlas_of(in_progress).copied();
        let told_before = self.fields.refusal.clone();
        let mut asked = Vec::from_iter(heading_ui(ui, in_progress));
        let foot = self.foot_ui(ui, in_progress, editor.operation_progress());
        ui.add_space(STEP);
        let mut shows_atlas = false;
        widgets::scrolling(ui, in_progress.operation().name, |ui| {
            asked.extend(self.fields_ui(ui, in_progress));
            ui.separator();
            if let Some(atlas) = &atlas {
                let view = &mut self.atlas;
                let shown = widgets::section(ui, "Atlas", true, |ui| {
                    view.show(ui, editor, in_progress, atlas)
                });
                shows_atlas = shown.is_some();
                asked.extend(shown.flatten().map(Asked::Atlas));
                ui.add_space(STEP);
            }
            self.report.show(ui, in_progress);
        });
        // A click on a button also leaves a field: what was typed there counts first.
        asked.extend(foot);
        editor.view_mut().show_atlas(shows_atlas);
        for asked in asked {
            self.take(asked, editor, &told_before);
        }
    }

    /// Do what the user asks for.
    fn take(&mut self, asked: Asked, editor: &mut Editor, told_before: &Option<Refused>) {
        use operation_fields::Asked as Field;
        match asked {
            Asked::Field(parameter, Field::Set(value)) => {
                self.set(editor, &[(parameter.name, value)], told_before);
                editor.operating().keep_values();
            }
            Asked::Field(parameter, Field::Try(value)) => {
                editor.operating().hold_values();
                self.set(editor, &[(parameter.name, value)], told_before);
            }
            Asked::Atlas(atlas::Asked::Set(values)) => self.set(editor, &values, told_before),
            Asked::Atlas(atlas::Asked::Drag(values)) => {
                editor.operating().hold_values();
                self.set(editor, &values, told_before);
            }
            Asked::Field(_, Field::Keep) | Asked::Atlas(atlas::Asked::Release) => {
                editor.operating().keep_values();
            }
            Asked::Field(_, Field::Restore) | Asked::Atlas(atlas::Asked::CallOff) => {
                editor.operating().restore_values();
            }
            Asked::Apply => told(editor.operating().apply()),
            Asked::Leave => editor.operating().leave(),
        }
    }

    fn set(
        &mut self,
        editor: &mut Editor,
        values: &[(&'static str, Value)],
        told_before: &Option<Refused>,
    ) {
        let refused = editor.operating().set_values(values).err();
        let refused = refused.map(|error| Refused {
            parameter: match values {
                [(parameter, _)] => Some(*parameter),
                _ => None,
            },
            text: error.to_string(),
        });
        // A text that was refused just now gave back the value before it.
        if refused.is_some() || self.fields.refusal == *told_before {
            self.fields.refusal = refused;
        }
    }

    /// At the lower edge, whatever stands above: the summary, why nothing comes of the values, and the buttons.
    fn foot_ui(
        &self,
        ui: &mut Ui,
        in_progress: &OperationInProgress,
        progress: Option<f64>,
    ) -> Option<Asked> {
        let [summary, wrong, buttons] = FOOT;
        let height = if in_progress.is_applied() {
            0.0
        } else {
            buttons
        };
        let panel = Panel::bottom("operation foot").resizable(false);
        let panel = panel
            .frame(Frame::NONE)
            .exact_size(summary + wrong + height);
        let asked = panel.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            ui.allocate_ui(vec2(ui.available_width(), summary), |ui| {
                ui.set_height(summary);
                ui.add_space(STEP);
                summary_ui(ui, in_progress);
            });
            ui.allocate_ui(vec2(ui.available_width(), wrong), |ui| {
                ui.set_height(wrong);
                // What is wrong in a field stands below that.
                let refused = self.fields.refusal.as_ref();
                let refused = refused.filter(|refused| refused.parameter.is_none());
                let refused = refused.map(|refused| refused.text.clone());
                if let Some(text) = refused.or_else(|| failure(in_progress)) {
                    error_ui(ui, &text);
                }
            });
            (!in_progress.is_applied()).then(|| buttons_ui(ui, in_progress, progress))
        });
        asked.inner.flatten()
    }

    fn fields_ui(&mut self, ui: &mut Ui, in_progress: &OperationInProgress) -> Vec<Asked> {
        let operation = in_progress.operation();
        let parameters = operation.parameters_for(in_progress.input(), in_progress.values());
        let asked = parameters.filter_map(|parameter| {
            let set = self.fields.show(ui, in_progress, parameter);
            set.map(|set| Asked::Field(parameter, set))
        });
        asked.collect()
    }
}

/// The atlas that the operation offers.
fn atlas_of(in_progress: &OperationInProgress) -> Option<&Atlas> {
    let run = in_progress.run()?.as_ref().ok()?;
    run.outcome.atlas.as_ref()
}

fn heading_ui(ui: &mut Ui, in_progress: &OperationInProgress) -> Option<Asked> {
    let mut left = false;
    ui.horizontal(|ui| {
        ui.strong(in_progress.operation().label);
        if in_progress.is_applied() {
            widgets::caption(ui, "applied");
            widgets::at_right(ui, |ui| {
                let close = IconButton::new(Icon::X, "Close operation");
                left = close.size(5.0 * STEP).show(ui).clicked();
            });
        }
    });
    widgets::note(ui, in_progress.operation().help);
    left.then_some(Asked::Leave)
}

/// Apply and Cancel; their keys are the canvas's, which has the keyboard unless a field has it.
fn buttons_ui(
    ui: &mut Ui,
    in_progress: &OperationInProgress,
    progress: Option<f64>,
) -> Option<Asked> {
    let mut asked = None;
    let fails = |run: &Result<crate::editor::Run, _>| {
        run.as_ref().map_or(true, |run| !run.outcome.is_useful())
    };
    let enabled = !in_progress.run().is_some_and(fails);
    ui.horizontal_centered(|ui| {
        let apply = ui.add_enabled_ui(enabled, |ui| widgets::primary_button(ui, "Apply"));
        if apply.inner.on_hover_text("Enter").clicked() {
            asked = Some(Asked::Apply);
        }
        if ui.button("Cancel").on_hover_text("Esc").clicked() {
            asked = Some(Asked::Leave);
        }
        if let Some(done) = progress {
            ui.add(ProgressBar::new(done as f32).show_percentage());
        }
    });
    asked
}
