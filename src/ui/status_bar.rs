//! The status bar: what the mouse will do now, and where it is.

use eframe::egui::{Label, Response, RichText, Role, Sense, Stroke, Ui, Vec2, WidgetInfo};

use super::figures;
use super::theme::{self, STEP, Tokens};
use super::widgets;
use crate::editor::{Editor, Readout};

/// The bar's height in points.
pub const HEIGHT: f32 = 28.0;

/// The width from which on there is room for degree and zoom beside a long hint.
const WIDE: f32 = 1212.0;

/// Show the bar.
pub fn status_bar_ui(ui: &mut Ui, editor: &Editor) {
    let readout = editor.readout();
    let width = ui.available_width();
    widgets::at_right(ui, |ui| {
        ui.spacing_mut().item_spacing.x = 4.0 * STEP;
        for (name, text, width) in cells(&readout, width).into_iter().rev() {
            cell_ui(ui, name, &text, width);
        }
        ui.with_layout(
            eframe::egui::Layout::left_to_right(eframe::egui::Align::Center),
            |ui| {
                let hint = RichText::new(editor.hint()).color(Tokens::of(ui).text);
                ui.add(Label::new(hint).truncate());
            },
        );
    });
}

/// The cells from left to right: name, text and width. Widths are fixed, so that no number
/// moves its neighbours.
fn cells(readout: &Readout, width: f32) -> Vec<(&'static str, String, f32)> {
    let pixel = 1.0 / readout.scale.max(f64::MIN_POSITIVE);
    let coordinate = |value: Option<f64>| {
        value.map_or_else(blank, |value| figures::to_resolution(value, 0.5 * pixel))
    };
    let pointer = readout.pointer;
    let mut cells = vec![
        (readout.axes[0], coordinate(pointer.map(|at| at.x)), 96.0),
        (readout.axes[1], coordinate(pointer.map(|at| at.y)), 96.0),
        (
            "u",
            readout.u.map_or_else(blank, |u| format!("{u:.3}")),
            64.0,
        ),
        (
            "κ",
            readout
                .curvature
                .map_or_else(blank, |k| figures::significant(k, 5)),
            88.0,
        ),
    ];
    if width >= WIDE {
        let degree = readout
            .degree
            .map_or_else(blank, |degree| degree.to_string());
        cells.push(("degree", degree, 60.0));
        cells.push(("scale", zoom(readout.scale), 136.0));
    }
    cells
}

fn blank() -> String {
    "–".to_owned()
}

/// The zoom: how many points a unit of the model spans.
fn zoom(scale: f64) -> String {
    format!("{} px/unit", figures::significant(scale, 3))
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
