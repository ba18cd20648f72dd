//! The status bar: the mouse's next action, and its place.

use eframe::egui::text::LayoutJob;
use eframe::egui::{Align, Label, Layout, Role, Sense, Ui, WidgetInfo, vec2};

use super::action::Action;
use super::chips::{self, chips_ui};
use super::figures;
use super::shell::Shell;
use super::theme::{self, STEP, Tokens};
use super::unit_menu::{CELL, unit_cell_ui};
use super::widgets;
use crate::editor::{CurvatureDisplay, Editor, Readout};
use crate::geometry::expressions::LengthUnit;

/// The bar's height in points.
pub const HEIGHT: f32 = 34.0;

/// The width that is kept for the hint: the longest ones that are usual fit in two lines of it, also in a small window
/// with the scale.
const HINT: f32 = 170.0;

/// The lines that the hint takes at most.
const HINT_ROWS: usize = 2;

/// The space between cells.
const GAP: f32 = 4.0 * STEP;

/// The cells that give way where there is too little room, the first one first.
const GIVING_WAY: [&str; 6] = ["degree", "u", "t", "κ", "R", "scale"];

/// Show the bar; `hint` describes the mouse's next action.
pub fn status_bar_ui(
    ui: &mut Ui,
    editor: &mut Editor,
    shell: &Shell,
    (hint, actions): (&str, &mut Vec<Action>),
) {
    let readout = editor.sight().readout();
    let display = editor.view().curvature_display;
    let width = ui.available_width() - chips::WIDTH;
    widgets::at_right(ui, |ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        unit_cell_ui(ui, editor, shell, actions);
        let unit = editor.document().unit();
        let cells = fitting(cells(&readout, display, unit), width - CELL.x - GAP);
        for (name, text, width) in cells.into_iter().rev() {
            let (size, font) = (vec2(width, CELL.y), theme::number_font());
            let cell = widgets::cell(ui, size, Sense::hover(), [name, &text], font);
            let name = format!("{name} {text}");
            cell.widget_info(|| WidgetInfo::labeled(Role::Label, true, &name));
        }
        chips_ui(ui, editor, actions);
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            hint_ui(ui, hint);
        });
    });
}

/// The hint, in as many lines as it needs and may take; one that is cut shows all of it under the pointer.
fn hint_ui(ui: &mut Ui, hint: &str) {
    let (font, colour) = (theme::small_font(), Tokens::of(ui).text);
    let mut job = LayoutJob::simple(hint.to_owned(), font, colour, ui.available_width());
    job.wrap.max_rows = HINT_ROWS;
    let galley = ui.painter().layout_job(job);
    ui.add(Label::new(galley));
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
fn cells(readout: &Readout, display: CurvatureDisplay, unit: Option<LengthUnit>) -> Vec<Cell> {
    let pixel = 1.0 / readout.scale.max(f64::MIN_POSITIVE);
    let coordinate = |value: Option<f64>| Some(figures::to_resolution(value?, 0.5 * pixel));
    let axes = if readout.in_space { 3 } else { 2 };
    let place = ["x", "y", "z"].into_iter().enumerate().take(axes);
    let place = place.map(|(axis, name)| {
        let value = readout.pointer.map(|at| at[axis]);
        (name, coordinate(value), 96.0)
    });
    let parameter = readout.parameter.map(|parameter| format!("{parameter:.3}"));
    let curvature = readout.curvature.map(|k| figures::significant(k, 5));
    let radius = |k| LengthUnit::behind(unit, figures::radius_of(k, 5));
    let radius = readout.curvature.map(radius);
    let degree = readout.degree.map(|degree| degree.to_string());
    let others = [
        (readout.parameter_name, parameter, 64.0),
        ("κ", curvature, 88.0),
        ("R", radius, 104.0),
        ("degree", degree, 60.0),
        ("scale", Some(zoom(readout.scale, unit)), 136.0),
    ];
    let is_shown = |name: &str| match name {
        "κ" => display.shows_curvature(),
        "R" => display.shows_radius(),
        _ => true,
    };
    let all = place.chain(others).filter(|(name, ..)| is_shown(name));
    all.map(|(name, text, width)| (name, text.unwrap_or("–".to_owned()), width))
        .collect()
}

/// The zoom: how many points a unit of the model spans.
fn zoom(scale: f64, unit: Option<LengthUnit>) -> String {
    let unit = unit.map_or("unit", LengthUnit::symbol);
    format!("{} px/{unit}", figures::significant(scale, 3))
}
