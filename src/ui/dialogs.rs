//! The few things that stop everything else: unsaved changes, the list of keys, about.

use eframe::egui::{Context, Grid, Id, Key, Modal, RichText, ScrollArea, Ui, vec2};

use super::action::Action;
use super::file_dialogs::AfterDiscard;
use super::theme::{self, STEP, Tokens};
use super::{keyboard, widgets};
use crate::document::quoted;
use crate::editor::Editor;

/// What is asked or told.
#[derive(Debug)]
pub enum Dialog {
    /// Save, discard or go back, before something replaces the document.
    Unsaved(AfterDiscard),
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
    let name = editor.workspace().path().and_then(|path| path.file_name());
    let name = name.map_or("the document".to_owned(), |name| {
        quoted(&name.to_string_lossy())
    });
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

/// What the mouse does, beside the keys that the table of commands lists.
const MOUSE: [(&str, &str); 21] = [
    ("Wheel, pinch", "Zoom to the pointer"),
    ("Middle button, Space and drag", "Pan"),
    ("Right button and drag", "Orbit"),
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
    ("Arrows, Shift and arrows", "Nudge, nudge ×10"),
    ("Tab", "Cycle overlapping"),
    ("F6", "Focus panels"),
    ("Enter, Shift and Enter", "Table: confirm and go down, up"),
    ("Tab, Shift and Tab", "Table: confirm and go right, left"),
    ("Arrows, Page Up, Page Down", "Table: go to another cell"),
    ("Digit, sign, point", "Table: replace the number"),
    ("Space, double-click", "Table: edit the number"),
    ("Esc", "Table: cancel the edit; leave"),
];

fn keys_ui(ui: &mut Ui) -> Option<Decision> {
    let window = ui.ctx().content_rect().size();
    ui.set_width((window.x - 80.0).clamp(200.0, 1080.0));
    ui.strong("Keys and mouse");
    let height = (window.y - 200.0).clamp(120.0, 560.0);
    // Without a least height the list would grow by a little each frame.
    let area = ScrollArea::both()
        .auto_shrink([false, true])
        .max_height(height)
        .min_scrolled_height(height);
    area.show(ui, |ui| {
        let keys: Vec<(String, String)> = Action::all()
            .into_iter()
            .filter_map(|command| {
                Some((
                    keyboard::shortcut_text(command.shortcut()?),
                    command.label(),
                ))
            })
            .collect();
        let mouse: Vec<(String, String)> = MOUSE
            .map(|(keys, what)| (keys.to_owned(), what.to_owned()))
            .into();
        let half = keys.len().div_ceil(2);
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 8.0 * STEP;
            list_ui(ui, "keys", &keys[..half]);
            list_ui(ui, "more keys", &keys[half..]);
            list_ui(ui, "mouse", &mouse);
        });
    });
    close_ui(ui)
}

fn list_ui(ui: &mut Ui, id: &str, rows: &[(String, String)]) {
    let tokens = Tokens::of(ui);
    Grid::new(id)
        .num_columns(2)
        .min_row_height(5.0 * STEP)
        .spacing(vec2(4.0 * STEP, 0.0))
        .show(ui, |ui| {
            for (keys, what) in rows {
                ui.label(
                    RichText::new(keys)
                        .font(theme::number_font())
                        .color(tokens.strong_text),
                );
                ui.label(what);
                ui.end_row();
            }
        });
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
