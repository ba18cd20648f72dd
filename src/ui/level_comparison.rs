//! The features of two curves side by side, level by level.

use eframe::egui::{Align2, Color32, Role, Sense, Ui, WidgetInfo, vec2};

use super::theme::{self, STEP, Tokens};
use super::{figures, widgets};
use crate::geometry::approximation::{LevelComparison, LevelFeature};
use crate::geometry::counted;

/// The height of a row.
const LINE: f32 = 4.5 * STEP;

/// Show whether each level has the features of its reference, and below that both lists in two
/// columns; the first difference is marked.
pub fn level_comparisons_ui(ui: &mut Ui, levels: &[LevelComparison]) {
    for level in levels {
        level_ui(ui, level);
    }
}

fn level_ui(ui: &mut Ui, level: &LevelComparison) {
    let difference = level.first_difference();
    let text = match difference {
        None => format!("same {}", counted(level.there.len(), "feature", "features")),
        Some(index) => format!("differs from feature {} on", index + 1),
    };
    let name = level.name();
    heading_ui(ui, &name, &text, difference.is_some());
    if level.there.is_empty() && level.here.is_empty() {
        return;
    }
    let tokens = Tokens::of(ui);
    let heading = ["reference", "curve"].map(str::to_owned);
    row_ui(ui, &name, heading, tokens.faint_text, false);
    for (index, (there, here)) in level.side_by_side().enumerate() {
        let there = there.map(|(t, feature)| told("t", t, feature));
        let here = here.map(|(u, feature)| told("u", u, feature));
        let texts = [there, here].map(|text| text.unwrap_or_else(|| "–".to_owned()));
        let (colour, is_first) = match difference == Some(index) {
            true => (tokens.strong_text, true),
            false => (tokens.text, false),
        };
        row_ui(ui, &name, texts, colour, is_first);
    }
    ui.add_space(STEP);
}

/// A feature's kind and parameter.
fn told(parameter: &str, at: f64, feature: LevelFeature) -> String {
    let at = figures::significant(at, 4);
    format!("{} at {parameter} = {at}", feature.name())
}

fn heading_ui(ui: &mut Ui, name: &str, text: &str, differs: bool) {
    let tokens = Tokens::of(ui);
    let size = vec2(ui.available_width(), 5.0 * STEP);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    widgets::label_in(ui, rect, name, tokens.text);
    let colour = if differs { tokens.error } else { tokens.good };
    let (align, font) = (Align2::RIGHT_CENTER, theme::small_font());
    widgets::text_in(ui, rect, align, text, font, colour);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, format!("{name}: {text}")));
}

/// Show a row, marked if it has the first features that differ.
fn row_ui(ui: &mut Ui, level: &str, texts: [String; 2], colour: Color32, is_difference: bool) {
    let size = vec2(ui.available_width(), LINE);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    if is_difference {
        let fill = Tokens::of(ui).error.gamma_multiply(0.18);
        ui.painter().rect_filled(rect, 2, fill);
    }
    let middle = rect.center().x;
    let columns = [rect.with_max_x(middle), rect.with_min_x(middle)];
    for (column, text) in columns.into_iter().zip(&texts) {
        let column = column.with_min_x(column.left() + STEP);
        let (at, font) = (column.left_center(), theme::small_font());
        ui.painter_at(column)
            .text(at, Align2::LEFT_CENTER, text, font, colour);
    }
    let difference = if is_difference {
        "first difference, "
    } else {
        ""
    };
    let told = format!("{level}: {difference}{} | {}", texts[0], texts[1]);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, told.clone()));
}
