//! The few things that stop everything else: unsaved changes, a file that has changed, the list of
//! keys, about.

use eframe::egui::{Context, Id, Key, Ui};

use super::file_dialogs::AfterDiscard;
use super::key_list::key_list_ui;
use super::widgets;
use crate::document::quoted;
use crate::editor::{ColumnQuestion, Editor};
use crate::geometry::counted;
use crate::geometry::expressions::LengthUnit;
use crate::io::ColumnChoice;

/// So many losses are named; more would hide the buttons.
const MOST_LOSSES: usize = 8;

/// The contents of a modal dialog.
#[derive(Debug)]
pub enum Dialog {
    /// Save, discard or go back, before something replaces the document.
    Unsaved(AfterDiscard),
    /// Reload, save elsewhere, overwrite or go back, before a file is overwritten that another
    /// program has changed; then the next step.
    Changed(Option<AfterDiscard>),
    /// Accept what the edited file's format loses, save elsewhere or go back; then the next step.
    Losses(Vec<String>, Option<AfterDiscard>),
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
    /// Accept what the edited file's format loses and save, then go on.
    Accept(Option<AfterDiscard>),
    /// Close the dialog.
    Close,
}

/// Show a dialog; returns the user's decision.
pub fn dialog_ui(context: &Context, dialog: &Dialog, editor: &Editor) -> Option<Decision> {
    widgets::modal(context, "dialog", Decision::Close, |ui| match dialog {
        Dialog::Unsaved(after) => unsaved_ui(ui, after, editor),
        Dialog::Changed(after) => changed_ui(ui, after, editor),
        Dialog::Losses(losses, after) => losses_ui(ui, losses, after, editor),
        Dialog::Keys => {
            key_list_ui(ui);
            buttons_ui(ui, [("Close", Decision::Close)])
        }
        Dialog::About => about_ui(ui),
    })
}

/// Ask for the unit of a document that receives curves in another unit. Returns the answer once there is one:
/// `None` adds nothing.
pub fn unit_ui(context: &Context, incoming: LengthUnit) -> Option<Option<LengthUnit>> {
    widgets::modal(context, "unit", None, |ui| {
        ui.set_width(400.0);
        ui.strong("Choose the document's unit");
        let name = incoming.name();
        let text = format!("The curves to add are in {name}; the document states no unit.");
        widgets::note(ui, &text);
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
    })
}

/// Ask for the columns of x, y, z and weights in a table. Returns the answer once there is one: `None` reads nothing.
pub fn columns_ui(context: &Context, question: &ColumnQuestion) -> Option<Option<ColumnChoice>> {
    let id = Id::unique("columns of a table");
    let answer = widgets::modal(context, "columns", None, |ui| {
        ui.set_width(400.0);
        ui.strong("Choose the columns");
        let name = question.path.file_name().unwrap_or_default();
        let name = quoted(&name.to_string_lossy());
        widgets::note(
            ui,
            &format!("{name} does not say which columns are x and y."),
        );
        let mut numbers = question.columns.iter().map(|it| it.number);
        let offered = [numbers.next(), numbers.next(), None, None];
        let mut picked = ui.data(|data| data.get_temp(id)).unwrap_or(offered);
        let columns = question.columns.iter();
        let columns = columns.map(|column| (Some(column.number), column.to_string()));
        let columns: Vec<(Option<usize>, String)> = columns.collect();
        let none = (None, "none".to_owned());
        let with_none = [vec![none], columns.clone()].concat();
        let offers = [
            ("x", columns.clone()),
            ("y", columns),
            ("z", with_none.clone()),
            ("weights", with_none),
        ];
        for (axis, (name, all)) in picked.iter_mut().zip(offers) {
            widgets::form_row(ui, name, |ui| {
                let (other, _) = widgets::drop_down(ui, name, 240.0, axis, all);
                *axis = other.unwrap_or(*axis);
            });
        }
        let choice = column_choice(picked);
        ui.data_mut(|data| data.insert_temp(id, picked));
        let is_entered = ui.input(|input| input.key_pressed(Key::Enter));
        let mut answer = None;
        ui.horizontal(|ui| {
            widgets::at_right(ui, |ui| {
                let button = |ui: &mut Ui| widgets::primary_button(ui, "Read");
                let read = ui.add_enabled_ui(choice.is_some(), button).inner;
                if (read.clicked() || is_entered) && choice.is_some() {
                    answer = Some(choice);
                }
                if ui.button("Cancel").clicked() {
                    answer = Some(None);
                }
            });
        });
        answer
    });
    if answer.is_some() {
        context.data_mut(|data| data.remove_temp::<[Option<usize>; 4]>(id));
    }
    answer
}

/// The columns of x, y, z and weights by their numbers; `None` if one is missing or there twice.
fn column_choice([x, y, z, weight]: [Option<usize>; 4]) -> Option<ColumnChoice> {
    let coordinates: Vec<usize> = [x, y, z].into_iter().flatten().collect();
    let choice = ColumnChoice::of_numbers(&coordinates)?;
    match weight {
        None => Some(choice),
        Some(weight) if coordinates.contains(&weight) => None,
        Some(weight) => choice.with_weights(&weight.to_string()).ok(),
    }
}

/// Show a dialog's buttons from the right edge on. Enter presses the first.
fn buttons_ui<const N: usize>(ui: &mut Ui, all: [(&str, Decision); N]) -> Option<Decision> {
    let is_entered = ui.input(|input| input.key_pressed(Key::Enter));
    let mut decision = None;
    ui.horizontal(|ui| {
        widgets::at_right(ui, |ui| {
            for (place, (label, own)) in all.into_iter().enumerate() {
                let is_pressed = match place {
                    0 => widgets::primary_button(ui, label).clicked() || is_entered,
                    _ => ui.button(label).clicked(),
                };
                if is_pressed {
                    decision = Some(own);
                }
            }
        });
    });
    decision
}

fn unsaved_ui(ui: &mut Ui, after: &AfterDiscard, editor: &Editor) -> Option<Decision> {
    ui.set_width(400.0);
    ui.strong("Save changes?");
    let name = name_of(editor);
    widgets::note(ui, &format!("Unsaved changes to {name} will be lost."));
    if let Some(previewed) = editor.previewed_operation() {
        let label = previewed.operation().label;
        let text = format!("“{label}” is not applied, and not saved: cancel to go back to it.");
        widgets::warning(ui, &text);
    }
    let buttons = [
        ("Save", Decision::Save(after.clone())),
        ("Discard", Decision::Discard(after.clone())),
        ("Cancel", Decision::Close),
    ];
    buttons_ui(ui, buttons)
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
    let buttons = [
        ("Save as…", Decision::SaveAs(after.clone())),
        ("Overwrite", Decision::Overwrite(after.clone())),
        ("Reload", Decision::Reload),
        ("Cancel", Decision::Close),
    ];
    buttons_ui(ui, buttons)
}

fn losses_ui(
    ui: &mut Ui,
    losses: &[String],
    after: &Option<AfterDiscard>,
    editor: &Editor,
) -> Option<Decision> {
    ui.set_width(440.0);
    ui.strong("Save with losses?");
    let name = name_of(editor);
    widgets::note(ui, &format!("The format of {name} cannot hold everything:"));
    for line in losses.iter().take(MOST_LOSSES) {
        widgets::note(ui, line);
    }
    let rest = losses.len().saturating_sub(MOST_LOSSES);
    if rest > 0 {
        widgets::note(
            ui,
            &format!("And {}.", counted(rest, "more loss", "more losses")),
        );
    }
    let buttons = [
        ("Save", Decision::Accept(after.clone())),
        ("Save a copy…", Decision::SaveAs(None)),
        ("Cancel", Decision::Close),
    ];
    buttons_ui(ui, buttons)
}

/// What dialogs call the document.
fn name_of(editor: &Editor) -> String {
    let name = editor.workspace().path().and_then(|path| path.file_name());
    name.map_or("the document".to_owned(), |name| {
        quoted(&name.to_string_lossy())
    })
}

fn about_ui(ui: &mut Ui) -> Option<Decision> {
    ui.set_width(400.0);
    ui.strong(format!("Batten {}", env!("CARGO_PKG_VERSION")));
    let what = "Batten is an editor for fair curves. Shape a curve by its float S-polygon; curvature \
        and evolute follow on every frame. A batten is the thin strip that loftsmen bend to draw a \
        fair line.";
    widgets::note(ui, what);
    let licence = "Licensed under MIT or Apache-2.0, at your option. Icons: Lucide (ISC).";
    widgets::note(ui, licence);
    buttons_ui(ui, [("Close", Decision::Close)])
}
