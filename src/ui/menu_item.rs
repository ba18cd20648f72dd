//! A line of a menu.

use eframe::egui::{Button, Color32, Response, RichText, Ui, vec2};
use lucide_icons::Icon;

use super::action::Action;
use super::help::{self, Topic};
use super::shell::Shell;
use super::theme::Tokens;
use super::{icons, keyboard};
use crate::editor::{Command, Editor};

/// The least width of an open menu.
pub const WIDTH: f32 = 240.0;

/// Show one action as a line of a menu; returns its response.
pub fn item_ui(
    ui: &mut Ui,
    editor: &Editor,
    shell: &Shell,
    action: Action,
    commands: &mut Vec<Action>,
) -> Response {
    let label = action.label_now(editor);
    let checked = action.is_checked(editor, shell);
    let mark = if checked == Some(true) {
        icons::text(Icon::Check)
    } else {
        blank()
    };
    let mut button = Button::new((mark, label)).min_size(vec2(WIDTH, 0.0));
    if let Some(beside) = beside(action, editor) {
        let beside = RichText::new(beside).color(Tokens::of(ui).faint_text);
        button = button.shortcut_text(beside);
    }
    let response = ui
        .add_enabled(action.is_enabled(editor), button)
        .accessible_name(action.name_now(editor));
    let tooltip = action.tooltip_now(editor);
    let response = response
        .on_hover_text(&tooltip)
        .on_disabled_hover_text(&tooltip);
    if let Action::Command(Command::Operation(operation)) = action {
        help::mark(ui, response.rect, Topic::Operation(operation));
    }
    if response.clicked() {
        commands.push(action);
        ui.close();
    }
    response
}

/// The text at the right of an action: its key, or the error of a change of degree.
pub fn beside(action: Action, editor: &Editor) -> Option<String> {
    let key = action.shortcut().map(keyboard::shortcut_text);
    key.or_else(|| action.foreseen(editor))
}

/// A place as wide as a check mark, so that labels line up.
pub fn blank() -> RichText {
    icons::text(Icon::Check).color(Color32::TRANSPARENT)
}
