//! The tools at the left edge: icon and key.

use eframe::egui::scroll_area::ScrollBarVisibility;
use eframe::egui::{Align2, Role, ScrollArea, Sense, Ui, Vec2, WidgetInfo};

use super::action::Action;
use super::theme::{self, RADIUS, STEP, Tokens};
use super::{icons, keyboard, widgets};
use crate::editor::{Command, Editor, Follow, ToolKind};
use crate::operations::{ALL, Inputs};

/// The rail's width in points.
pub const WIDTH: f32 = 48.0;

/// The side of a tool's button.
const SIDE: f32 = 40.0;

/// Show the tools, then what makes curves of its own, and below what acts on every tool.
pub fn tool_rail_ui(ui: &mut Ui, editor: &Editor, commands: &mut Vec<Action>) {
    ui.spacing_mut().item_spacing = Vec2::splat(STEP);
    let area = ScrollArea::vertical().scroll_bar_visibility(ScrollBarVisibility::AlwaysHidden);
    area.show(ui, |ui| {
        ui.vertical_centered(|ui| tools_ui(ui, editor, commands));
    });
}

fn tools_ui(ui: &mut Ui, editor: &Editor, commands: &mut Vec<Action>) {
    for tool in ToolKind::ALL {
        let starts_group = matches!(
            tool,
            ToolKind::AddVertex | ToolKind::Rotate | ToolKind::Measure
        );
        if starts_group {
            divider(ui);
        }
        button_ui(ui, editor, Command::Tool(tool), commands);
    }
    divider(ui);
    let makers = ALL
        .iter()
        .filter(|operation| matches!(operation.inputs, Inputs::None | Inputs::UpToTwo));
    for operation in makers {
        button_ui(ui, editor, Command::Operation(operation), commands);
    }
    divider(ui);
    for command in [
        Command::ToggleSnapping,
        Command::Follow(Follow::InHarmony),
        Command::Follow(Follow::Softly),
        Command::ToggleKeeping,
        Command::Fit,
    ] {
        button_ui(ui, editor, command, commands);
    }
}

fn divider(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(Vec2::new(SIDE - 4.0 * STEP, 1.0), Sense::hover());
    ui.painter().rect_filled(rect, 0, Tokens::of(ui).outline);
}

fn button_ui(ui: &mut Ui, editor: &Editor, command: Command, commands: &mut Vec<Action>) {
    let enabled = editor.is_enabled(command);
    let checked = editor.is_checked(command);
    let name = command.label();
    let response = ui
        .add_enabled_ui(enabled, |ui| {
            let (rect, response) = ui.allocate_exact_size(Vec2::splat(SIDE), Sense::click());
            let tokens = Tokens::of(ui);
            let is_on = checked == Some(true);
            let is_hot = response.hovered() || response.has_focus();
            if is_on || is_hot {
                let fill = if is_on {
                    tokens.selection
                } else {
                    tokens.button[1]
                };
                ui.painter().rect_filled(rect, RADIUS, fill);
            }
            if response.has_focus() {
                widgets::focus_ring(ui, rect);
            }
            let colour = if is_on || is_hot {
                tokens.strong_text
            } else {
                tokens.text
            };
            if let Some(icon) = icons::of_action(command.into()) {
                widgets::icon(ui, rect.translate(Vec2::new(-2.0, -2.0)), icon, colour);
            }
            if let Some(shortcut) = command.shortcut() {
                let at = rect.right_bottom() - Vec2::splat(STEP);
                let key = keyboard::shortcut_text(shortcut);
                let faint = if is_on {
                    tokens.strong_text
                } else {
                    tokens.faint_text
                };
                ui.painter()
                    .text(at, Align2::RIGHT_BOTTOM, key, theme::small_font(), faint);
            }
            response.widget_info(|| match checked {
                Some(on) => WidgetInfo::selected(Role::Button, ui.is_enabled(), on, &name),
                None => WidgetInfo::labeled(Role::Button, ui.is_enabled(), &name),
            });
            response
        })
        .inner;
    if response
        .on_hover_text(format!("{name}\n{}", command.tooltip()))
        .clicked()
    {
        commands.push(command.into());
    }
}
