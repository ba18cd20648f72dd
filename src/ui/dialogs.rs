//! The few things that stop everything else: unsaved changes, a file that has changed, the list of
//! keys, about.

use eframe::egui::{Context, Id, Key, Label, Modal, RichText, ScrollArea, Ui, vec2};

use super::action::Action;
use super::file_dialogs::AfterDiscard;
use super::theme::{STEP, Tokens};
use super::{keyboard, widgets};
use crate::document::quoted;
use crate::editor::Editor;

/// What is asked or told.
#[derive(Debug)]
pub enum Dialog {
    /// Save, discard or go back, before something replaces the document.
    Unsaved(AfterDiscard),
    /// Reload, save elsewhere, overwrite or go back, before a file is overwritten that another
    /// program has changed; and what goes on once the document is saved.
    Changed(Option<AfterDiscard>),
    /// What keys and mouse do.
    Keys,
    /// What this program is.
    About,
}

/// What the user decided.
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
    /// Save over what another program has written, then go on.
    Overwrite(Option<AfterDiscard>),
    /// Close the dialog.
    Close,
}

/// Show a dialog; returns what was decided, once something is.
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
        true => "Reloading loses the changes made here, overwriting those made there.",
        false => "Overwriting loses the changes made there.",
    };
    widgets::note(
        ui,
        &format!("Another program has changed {name} since it was read or saved here. {what}"),
    );
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

/// What the mouse does, beside the keys that the table of commands lists.
const MOUSE: [(&str, &str); 24] = [
    ("Wheel, pinch", "Zoom to the pointer"),
    ("Middle button, Space and drag", "Pan"),
    ("Right button and drag", "Orbit"),
    ("Right click, menu key", "Menu of what is there"),
    ("Double-click on empty canvas", "Fit all"),
    ("Click, Shift and click", "Select, add to the selection"),
    ("Drag on empty canvas", "Select by a box"),
    ("Drag a vertex", "Move the selection"),
    (
        "Shift while dragging",
        "Lock to an axis, or to steps of 15°",
    ),
    ("X, Y, Z while dragging", "Lock to X, Y, Z"),
    ("Ctrl while dragging", "Toggle snapping"),
    ("K while dragging", "Toggle keeping features"),
    ("Alt", "Hold to compare with the state before"),
    ("Arrows; with Shift, Ctrl", "Nudge; nudge ×10, ×0.1"),
    ("Tab", "Cycle overlapping"),
    ("Wheel, drag on a plot", "Zoom to the pointer, pan"),
    ("Shift and wheel on a plot", "Zoom along the curve alone"),
    ("F6", "Focus panels"),
    ("Enter, Shift and Enter", "Table: confirm and go down, up"),
    ("Tab, Shift and Tab", "Table: confirm and go right, left"),
    ("Arrows, Page Up, Page Down", "Table: go to another cell"),
    ("Digit, sign, letter", "Table: replace the number"),
    ("Space, double-click", "Table: edit the number"),
    ("Esc", "Table: cancel the edit; leave"),
];

/// The width of a column of keys, and of the keys in it.
const COLUMN: [f32; 2] = [340.0, 132.0];

fn keys_ui(ui: &mut Ui) -> Option<Decision> {
    let window = ui.ctx().content_rect().size();
    let columns = ((window.x - 120.0) / COLUMN[0]).floor().clamp(1.0, 3.0);
    ui.set_width(columns * COLUMN[0]);
    ui.strong("Keys and mouse");
    let height = (window.y - 180.0).clamp(120.0, 640.0);
    // Without a least height the list would grow by a little each frame.
    let area = ScrollArea::vertical()
        .auto_shrink([false, true])
        .max_height(height)
        .min_scrolled_height(height);
    area.show(ui, |ui| {
        let commands = Action::all().into_iter().filter_map(|command| {
            let keys = keyboard::shortcut_text(command.shortcut()?);
            Some((keys, command.label()))
        });
        let mouse = MOUSE.map(|(keys, what)| (keys.to_owned(), what.to_owned()));
        let rows: Vec<(String, String)> = mouse.into_iter().chain(commands).collect();
        let long = rows.len().div_ceil(columns as usize);
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            for column in rows.chunks(long) {
                ui.vertical(|ui| column_ui(ui, column));
            }
        });
    });
    close_ui(ui)
}

fn column_ui(ui: &mut Ui, rows: &[(String, String)]) {
    let [width, left] = COLUMN;
    let right = width - left - 6.0 * STEP;
    ui.set_width(width);
    let tokens = Tokens::of(ui);
    for (keys, what) in rows {
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0 * STEP;
            let keys = RichText::new(keys).color(tokens.strong_text);
            for (text, width) in [(keys, left), (RichText::new(what), right)] {
                ui.allocate_ui(vec2(width, 0.0), |ui| {
                    ui.set_width(width);
                    ui.add(Label::new(text).wrap());
                });
            }
        });
    }
}

fn about_ui(ui: &mut Ui) -> Option<Decision> {
    ui.set_width(400.0);
    ui.strong(format!("Batten {}", env!("CARGO_PKG_VERSION")));
    widgets::note(
        ui,
        "A batten is the thin strip that loftsmen bend to draw a fair line. Batten is an editor \
         for fair curves: shape them by their float S-polygons, and see on every frame what that \
         does to curvature and evolute.",
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
