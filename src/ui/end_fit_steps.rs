//! The looks of the seven steps: numbered rows, figures in pairs, remarks.

use eframe::egui::{
    Align2, Button, Color32, Label, Rect, Response, RichText, Role, Sense, Stroke, StrokeKind, Ui,
    WidgetInfo, vec2,
};
use lucide_icons::Icon;

use super::theme::{self, RADIUS, ROW, STEP, Tokens};
use super::{figures, icons, widgets};

/// The indentation of what belongs to a step.
const INDENT: f32 = 28.0;

/// The width of a step's button.
const BUTTON: f32 = 76.0;

/// A remark with its icon, wrapped; its text can be selected.
pub fn remark_ui(ui: &mut Ui, icon: Icon, text: &str, colour: Color32) {
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 1.5 * STEP;
        ui.label(icons::text(icon).color(colour));
        ui.add(
            Label::new(RichText::new(text).color(colour))
                .wrap()
                .selectable(true),
        );
    });
}

/// The button at the right end of a step's row.
pub fn step_button(ui: &mut Ui, name: &str, enabled: bool) -> Response {
    ui.add_enabled(enabled, Button::new(name).min_size(vec2(BUTTON, ROW)))
}

/// Figures in two columns.
pub fn figure_pairs(ui: &mut Ui, pairs: &[(&str, String)]) {
    let gap = 4.0 * STEP;
    let width = 0.5 * (ui.available_width() - gap);
    for row in pairs.chunks(2) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = gap;
            for (name, figures) in row {
                ui.allocate_ui(vec2(width, 5.0 * STEP), |ui| {
                    ui.set_width(width);
                    widgets::figure_row(ui, name, figures);
                });
            }
        });
    }
}

/// Write an angle in degrees; a tiny one with its own digits.
pub fn angle_text(radians: f64) -> String {
    let degrees = radians.to_degrees();
    if degrees != 0.0 && degrees.abs() < 1e-3 {
        figures::significant(degrees, 3) + "°"
    } else {
        figures::degrees(radians, 4)
    }
}

/// One step's row: its number, its title with a check mark once it is done, and its button.
pub fn step_ui(ui: &mut Ui, number: usize, title: &str, done: bool, button: impl FnOnce(&mut Ui)) {
    ui.add_space(0.5 * STEP);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        ui.set_min_height(ROW);
        let (rect, response) = ui.allocate_exact_size(vec2(INDENT, ROW), Sense::hover());
        let tokens = Tokens::of(ui);
        let badge = Rect::from_center_size(rect.left_center() + vec2(9.0, 0.0), vec2(18.0, 18.0));
        let colour = if done { tokens.good } else { tokens.faint_text };
        ui.painter()
            .rect_stroke(badge, RADIUS, Stroke::new(1.0, colour), StrokeKind::Inside);
        let font = theme::small_font();
        let text = number.to_string();
        ui.painter().text(
            badge.center(),
            Align2::CENTER_CENTER,
            text,
            font,
            tokens.text,
        );
        response.widget_info(|| {
            let state = if done { "done" } else { "open" };
            WidgetInfo::labeled(Role::Label, true, format!("step {number}: {state}"))
        });
        ui.label(RichText::new(title).color(tokens.strong_text));
        if done {
            ui.add_space(1.5 * STEP);
            ui.label(icons::text(Icon::Check).color(tokens.good));
        }
        widgets::at_right(ui, button);
    });
}

/// Put contents below the title of their step.
pub fn indented(ui: &mut Ui, contents: impl FnOnce(&mut Ui)) {
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        ui.add_space(INDENT);
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing = vec2(2.0 * STEP, 0.5 * STEP);
            contents(ui);
        });
    });
}
