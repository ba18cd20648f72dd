//! The tools at the left edge, as icons with or without names.

use eframe::egui::{Color32, Response, Role, Sense, Ui, Vec2, WidgetInfo, vec2};
use lucide_icons::Icon;

use super::action::Action;
use super::theme::{STEP, Tokens};
use super::{icons, keyboard, widgets};
use crate::editor::{Command, Editor, ToolKind};
use crate::operations::{ALL, Inputs};

/// The rail's width in points, without and with names.
const WIDTHS: [f32; 2] = [48.0, 176.0];

/// The least and the largest side of a button.
const SIDES: [f32; 2] = [24.0, 40.0];

/// The space between buttons.
const GAP: f32 = 0.5 * STEP;

/// The height of a line between groups, with the space below it.
const DIVIDER: f32 = 1.0 + GAP;

/// The rail's width in points.
pub fn width(names: bool) -> f32 {
    WIDTHS[usize::from(names)]
}

/// Show the tools, with their `names` or as icons alone, then the operations that create curves. The buttons are as large as all of them fit.
pub fn tool_rail_ui(ui: &mut Ui, editor: &Editor, names: bool, commands: &mut Vec<Action>) {
    ui.spacing_mut().item_spacing = Vec2::splat(GAP);
    let groups = groups();
    let count = groups.iter().map(Vec::len).sum::<usize>();
    let free = ui.available_height() - (groups.len() - 1) as f32 * DIVIDER;
    let side = (free / count as f32 - GAP)
        .floor()
        .clamp(SIDES[0], SIDES[1]);
    ui.vertical_centered(|ui| {
        for (index, group) in groups.into_iter().enumerate() {
            if index > 0 {
                divider_ui(ui);
            }
            for command in group {
                button_ui(ui, editor, command, (side, names), commands);
            }
        }
    });
}

/// The buttons, group by group.
fn groups() -> Vec<Vec<Command>> {
    let mut groups = vec![Vec::new()];
    for tool in ToolKind::ALL {
        if tool.row().starts_group {
            groups.push(Vec::new());
        }
        if let Some(group) = groups.last_mut() {
            group.push(Command::Tool(tool));
        }
    }
    let makers = ALL.iter().copied();
    let makers = makers.filter(|it| matches!(it.inputs, Inputs::None | Inputs::UpToTwo));
    groups.push(makers.map(Command::Operation).collect());
    groups.push(vec![Command::Fit]);
    groups
}

fn divider_ui(ui: &mut Ui) {
    let (rect, _) =
        ui.allocate_exact_size(vec2(ui.available_width() - 4.0 * STEP, 1.0), Sense::hover());
    ui.painter().rect_filled(rect, 0, Tokens::of(ui).outline);
}

fn button_ui(
    ui: &mut Ui,
    editor: &Editor,
    command: Command,
    (side, names): (f32, bool),
    commands: &mut Vec<Action>,
) {
    let enabled = command.is_enabled(editor);
    let checked = command.is_checked(editor);
    let name = command.label();
    let icon = icons::of_action(command.into()).unwrap_or(Icon::CircleQuestionMark);
    let button = ui.add_enabled_ui(enabled, |ui| {
        let tokens = Tokens::of(ui);
        let is_on = checked == Some(true);
        let rest = if is_on {
            tokens.strong_text
        } else {
            tokens.text
        };
        let colours = [rest, tokens.strong_text];
        let response = match names {
            true => named_ui(ui, side, (icon, &name), colours, is_on),
            false => {
                let size = vec2(SIDES[1], side);
                widgets::pressable_icon(ui, size, icon, colours, is_on).1
            }
        };
        response.widget_info(|| match checked {
            Some(on) => WidgetInfo::selected(Role::Button, ui.is_enabled(), on, &name),
            None => WidgetInfo::labeled(Role::Button, ui.is_enabled(), &name),
        });
        response
    });
    let title = keyboard::with_key(&name, command.shortcut());
    let tooltip = format!("{title}\n{}", command.tooltip());
    widgets::tooltip_at_right(&button.inner, &tooltip);
    if button.inner.clicked() {
        commands.push(command.into());
    }
}

/// A button with an icon and a name, across the rail.
fn named_ui(
    ui: &mut Ui,
    side: f32,
    (icon, name): (Icon, &str),
    [rest, hot]: [Color32; 2],
    is_on: bool,
) -> Response {
    let size = vec2(ui.available_width(), side);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    widgets::row_background(ui, rect, &response, is_on);
    let colour = if response.hovered() { hot } else { rest };
    let (left, right) = rect.split_left_right_at_x(rect.left() + SIDES[1]);
    widgets::icon(ui, left, icon, colour);
    widgets::label_in(ui, right, name, colour);
    response
}
