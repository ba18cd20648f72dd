//! The switches of what a drag does, as named chips in the status bar.

use eframe::egui::{Align2, Role, Sense, Ui, WidgetInfo, vec2};

use super::action::Action;
use super::theme::{self, RADIUS, ROW, STEP, Tokens};
use super::{keyboard, widgets};
use crate::editor::{Command, Editor, Follow};

/// A chip: its command, the text on it, and its width.
type Chip = (Command, &'static str, f32);

/// The chips from left to right. Their widths are fixed, so that a switch moves none of its neighbours.
const CHIPS: [Chip; 6] = [
    (Command::Follow(Follow::InHarmony), "Harmony", 54.0),
    (Command::Follow(Follow::Softly), "Soft", 34.0),
    (Command::ToggleKeeping, "Features", 54.0),
    (Command::ToggleSnapping, "Snap", 38.0),
    (Command::ToggleClosedFollow, "Closed", 46.0),
    (Command::ToggleKeepShape, "Keep shape", 70.0),
];

/// The width that all chips take, with the space between them.
pub const WIDTH: f32 = {
    let (mut sum, mut chip) = (0.0, 0);
    while chip < CHIPS.len() {
        sum += CHIPS[chip].2 + STEP;
        chip += 1;
    }
    // And to the cells beside them.
    sum + 4.0 * STEP
};

/// Show the chips, flush right; a click switches.
pub fn chips_ui(ui: &mut Ui, editor: &Editor, actions: &mut Vec<Action>) {
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.x = STEP;
        // The bar runs from right to left.
        for chip in CHIPS.into_iter().rev() {
            chip_ui(ui, editor, chip, actions);
        }
    });
}

fn chip_ui(ui: &mut Ui, editor: &Editor, (command, text, width): Chip, actions: &mut Vec<Action>) {
    let is_on = command.is_checked(editor) == Some(true);
    let (rect, response) = ui.allocate_exact_size(vec2(width, ROW - STEP), Sense::click());
    let tokens = Tokens::of(ui);
    let colour = if is_on {
        tokens.strong_text
    } else {
        tokens.faint_text
    };
    if is_on {
        ui.painter().rect_filled(rect, RADIUS, tokens.selection);
    } else if response.hovered() {
        ui.painter().rect_filled(rect, RADIUS, tokens.button[1]);
    }
    let edge = if response.has_focus() {
        tokens.accent
    } else {
        tokens.outline
    };
    widgets::outline(ui, rect, 1.0, edge);
    let font = theme::small_font();
    widgets::text_in(ui, rect, Align2::CENTER_CENTER, text, font, colour);
    let name = command.label();
    response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, is_on, &name));
    let title = keyboard::with_key(&name, command.shortcut());
    if response
        .on_hover_text(format!("{title}\n{}", command.tooltip()))
        .clicked()
    {
        actions.push(command.into());
    }
}
