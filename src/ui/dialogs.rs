//! The few things that stop everything else: unsaved changes, a file that has changed, the list of
//! keys, about.

use eframe::egui::{Context, Id, Key, Modal, Ui};

use super::file_dialogs::AfterDiscard;
use super::key_list::key_list_ui;
use super::theme::STEP;
use super::widgets;
use crate::document::quoted;
use crate::editor::Editor;
use crate::geometry::expressions::LengthUnit;

/// The contents of a modal dialog.
#[derive(Debug)]
pub enum Dialog {
    /// Save, discard or go back, before something replaces the document.
    Unsaved(AfterDiscard),
    /// Reload, save elsewhere, overwrite or go back, before a file is overwritten that another
    /// program has changed; then the next step.
    Changed(Option<AfterDiscard>),
    /// The list of keys and mouse actions.
    Keys,
    /// What this program is.
    About,
}

/// The user's decision.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// Save, then go on.
    Save(AfterDiscard),
    /// Go on without saving.
    Discard(AfterDiscard),
    /// Open the document's file again, without the changes made here.
    Reload,
    /// Save to another file, then go on.
    SaveAs(Option<AfterDiscard>),
    /// Save over another program's changes, then go on.
    Overwrite(Option<AfterDiscard>),
    /// Close the dialog.
    Close,
}

/// Show a dialog; returns the user's decision.
pub fn dialog_ui(context: &Context, dialog: &mut Dialog, editor: &Editor) -> Option<Decision> {
    let frame = widgets::dialog_frame(&context.global_style());
    let modal = Modal::new(Id::unique("dialog"))
        .frame(frame)
        .show(context, |ui| {
            ui.spacing_mut().item_spacing.y = 2.0 * STEP;
            match dialog {
                Dialog::Unsaved(after) => unsaved_ui(ui, after, editor),
                Dialog::Changed(after) => changed_ui(ui, after, editor),
                Dialog::Keys => keys_ui(ui),
                Dialog::About => about_ui(ui),
            }
        });
    let closes = modal.should_close();
    modal.inner.or(closes.then_some(Decision::Close))
}

/// Ask for the unit of a document that receives curves in another unit. Returns the answer once there is one:
/// `None` adds nothing.
pub fn unit_ui(context: &Context, incoming: LengthUnit) -> Option<Option<LengthUnit>> {
    let frame = widgets::dialog_frame(&context.global_style());
    let modal = Modal::new(Id::unique("unit"))
        .frame(frame)
        .show(context, |ui| {
            ui.spacing_mut().item_spacing.y = 2.0 * STEP;
            ui.set_width(400.0);
            ui.strong("Choose the document's unit");
            let name = incoming.name();
            widgets::note(
                ui,
                &format!("The curves to add are in {name}; the document states no unit."),
            );
            let mut answer = None;
            ui.horizontal(|ui| {
                for unit in LengthUnit::ALL {
                    if ui.button(unit.name()).clicked() {
                        answer = Some(Some(unit));
                    }
                }
                widgets::at_right(ui, |ui| {
                    if ui.button("Cancel").clicked() {
                        answer = Some(None);
                    }
                });
            });
            answer
        });
    let closes = modal.should_close();
    modal.inner.or(closes.then_some(None))
}

fn unsaved_ui(ui: &mut Ui, after: &AfterDiscard, editor: &Editor) -> Option<Decision> {
    ui.set_width(400.0);
    ui.strong("Save changes?");
    let name = name_of(editor);
    widgets::note(ui, &format!("Unsaved changes to {name} will be lost."));
    let mut decision = None;
    ui.horizontal(|ui| {
        widgets::at_right(ui, |ui| {
            let save = widgets::primary_button(ui, "Save");
            if save.clicked() || ui.input(|input| input.key_pressed(Key::Enter)) {
                decision = Some(Decision::Save(after.clone()));
            }
            if ui.button("Discard").clicked() {
                decision = Some(Decision::Discard(after.clone()));
            }
            if ui.button("Cancel").clicked() {
                decision = Some(Decision::Close);
            }
        });
    });
    decision
}

fn changed_ui(ui: &mut Ui, after: &Option<AfterDiscard>, editor: &Editor) -> Option<Decision> {
    ui.set_width(440.0);
    ui.strong("The file has changed on disk");
    let name = name_of(editor);
    let what = match editor.workspace().is_modified() {
        true => {
            "Reload replaces your changes (Undo brings them back). Overwrite loses the other program's changes."
        }
        false => "Overwrite loses its changes.",
    };
    widgets::note(ui, &format!("Another program has changed {name}. {what}"));
    let mut decision = None;
    ui.horizontal(|ui| {
        widgets::at_right(ui, |ui| {
            let save_as = widgets::primary_button(ui, "Save as…");
            if save_as.clicked() || ui.input(|input| input.key_pressed(Key::Enter)) {
                decision = Some(Decision::SaveAs(after.clone()));
            }
            if ui.button("Overwrite").clicked() {
                decision = Some(Decision::Overwrite(after.clone()));
            }
            if ui.button("Reload").clicked() {
                decision = Some(Decision::Reload);
            }
            if ui.button("Cancel").clicked() {
                decision = Some(Decision::Close);
            }
        });
    });
    decision
}

/// What dialogs call the document.
fn name_of(editor: &Editor) -> String {
    let name = editor.workspace().path().and_then(|path| path.file_name());
    name.map_or("the document".to_owned(), |name| {
        quoted(&name.to_string_lossy())
    })
}

fn keys_ui(ui: &mut Ui) -> Option<Decision> {
    key_list_ui(ui);
    close_ui(ui)
}

fn about_ui(ui: &mut Ui) -> Option<Decision> {
    ui.set_width(400.0);
    ui.strong(format!("Batten {}", env!("CARGO_PKG_VERSION")));
    widgets::note(
        ui,
        "Batten is an editor for fair curves. Shape a curve by its float S-polygon; curvature and \
         evolute follow on every frame. A batten is the thin strip that loftsmen bend to draw a fair line.",
    );
    widgets::note(
        ui,
        "Licensed under MIT or Apache-2.0, at your option. Icons: Lucide (ISC).",
    );
    close_ui(ui)
}

fn close_ui(ui: &mut Ui) -> Option<Decision> {
    let mut closed = false;
    ui.horizontal(|ui| {
        widgets::at_right(ui, |ui| {
            closed = widgets::primary_button(ui, "Close").clicked()
        })
    });
    let entered = ui.input(|input| input.key_pressed(Key::Enter));
    (closed || entered).then_some(Decision::Close)
}
