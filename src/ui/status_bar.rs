//! The status bar: the mouse's next action, and its place.

use eframe::egui::{Label, Response, RichText, Role, Sense, Stroke, Ui, Vec2, WidgetInfo};

use super::action::Action;
use super::figures;
use super::shell::Shell;
use super::theme::{self, STEP, Tokens};
use super::unit_menu::{CELL, unit_cell_ui};
use super::widgets;
use crate::editor::{Editor, Readout};
use crate::geometry::expressions::LengthUnit;

/// The bar's height in points.
pub const HEIGHT: f32 = 28.0;

/// The width that is kept for the hint.
const HINT: f32 = 280.0;

/// The space between cells.
const GAP: f32 = 4.0 * STEP;

/// The cells that give way where there is too little room, the first one first.
const GIVING_WAY: [&str; 3] = ["u", "t", "κ"];

/// Show the bar; `hint` describes the mouse's next action.
pub fn status_bar_ui(
    ui: &mut Ui,
    editor: &mut Editor,
    shell: &Shell,
    (hint, actions): (&str, &mut Vec<Action>),
) {
    let readout = editor.sight().readout();
    let width = ui.available_width();
    widgets::at_right(ui, |ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        unit_cell_ui(ui, editor, shell, actions);
        let unit = editor.document().unit();
        let cells = fitting(cells(&readout, unit), width - CELL.x - GAP);
        for (name, text, width) in cells.into_iter().rev() {
            cell_ui(ui, name, &text, width);
        }
        ui.with_layout(
            eframe::egui::Layout::left_to_right(eframe::egui::Align::Center),
            |ui| {
                let hint = RichText::new(hint).color(Tokens::of(ui).text);
                ui.add(Label::new(hint).truncate());
            },
        );
    });
}

/// A cell: its name, its text and its width.
type Cell = (&'static str, String, f32);

/// The cells that there is room for beside the hint.
fn fitting(mut cells: Vec<Cell>, width: f32) -> Vec<Cell> {
    for name in GIVING_WAY {
        let taken: f32 = cells.iter().map(|(_, _, width)| width + GAP).sum();
        if taken + HINT > width {
            cells.retain(|(other, ..)| *other != name);
        }
    }
    cells
}

/// The cells from left to right. Widths are fixed, so that no number
/// moves its neighbours.
fn cells(readout: &Readout, unit: Option<LengthUnit>) -> Vec<Cell> {
    let pixel = 1.0 / readout.scale.max(f64::MIN_POSITIVE);
    let coordinate = |value: Option<f64>| {
        value.map_or_else(blank, |value| figures::to_resolution(value, 0.5 * pixel))
    };
    let pointer = readout.pointer;
    let axes = if readout.in_space { 3 } else { 2 };
    let place = ["x", "y", "z"].into_iter().enumerate().take(axes);
    let place = place.map(|(axis, name)| (name, coordinate(pointer.map(|at| at[axis])), 96.0));
    let mut cells: Vec<(&'static str, String, f32)> = place.collect();
    cells.extend([
        (
            readout.parameter_name,
            readout
                .parameter
                .map_or_else(blank, |parameter| format!("{parameter:.3}")),
            64.0,
        ),
        (
            "κ",
            readout
                .curvature
                .map_or_else(blank, |k| figures::significant(k, 5)),
            88.0,
        ),
    ]);
    let degree = readout
        .degree
        .map_or_else(blank, |degree| degree.to_string());
    cells.push(("degree", degree, 60.0));
    cells.push(("scale", zoom(readout.scale, unit), 136.0));
    cells
}

fn blank() -> String {
    "–".to_owned()
}

/// The zoom: how many points a unit of the model spans.
fn zoom(scale: f64, unit: Option<LengthUnit>) -> String {
    let unit = unit.map_or("unit", LengthUnit::symbol);
    format!("{} px/{unit}", figures::significant(scale, 3))
}

fn cell_ui(ui: &mut Ui, name: &str, text: &str, width: f32) -> Response {
    let (rect, response) =
        ui.allocate_exact_size(Vec2::new(width, HEIGHT - 2.0 * STEP), Sense::hover());
    let tokens = Tokens::of(ui);
    let font = theme::small_font();
    let divider = rect.left() - 2.0 * STEP;
    ui.painter()
        .vline(divider, rect.y_range(), Stroke::new(1.0, tokens.outline));
    ui.painter().text(
        rect.left_center(),
        eframe::egui::Align2::LEFT_CENTER,
        name,
        font,
        tokens.faint_text,
    );
    widgets::number_in(ui, rect, text, tokens.text);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{name} {text}")));
    response
}
