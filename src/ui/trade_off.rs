//! What each number of curvature extrema reaches, as a small plot: a click asks for one.

use eframe::egui::{Align2, CursorIcon, Rect, Role, Sense, StrokeKind, Ui, WidgetInfo, pos2, vec2};

use super::atlas::Values;
use super::theme::{self, STEP, Tokens};
use super::{figures, widgets};
use crate::geometry::counted;
use crate::operations::Value;

/// The height of the bars, and that of the numbers below.
const HEIGHTS: [f32; 2] = [14.0 * STEP, 4.0 * STEP];

/// The least and the most width of a bar with its gap.
const WIDTHS: [f32; 2] = [2.5 * STEP, 8.0 * STEP];

/// The height of the lowest bar, as a share.
const LEAST: f64 = 0.1;

/// What a number of extrema reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    extrema: usize,
    vertices: usize,
    largest: f64,
}

/// The plot, which keeps its bars while only the number of extrema changes.
#[derive(Default)]
pub struct TradeOff {
    rows: Vec<Row>,
    /// The other values with which they were found.
    others: Vec<(&'static str, Value)>,
}

/// The name of the parameter that a click sets.
const EXTREMA: &str = "extrema";

impl TradeOff {
    /// Take the rows of a report that was made with some values.
    pub fn take(&mut self, table: &[Vec<f64>], values: Values) {
        let rows = table.iter().filter_map(|row| match row[..] {
            [extrema, vertices, _, largest] => Some(Row {
                extrema: extrema as usize,
                vertices: vertices as usize,
                largest,
            }),
            _ => None,
        });
        let rows: Vec<Row> = rows.collect();
        let others: Values = values
            .into_iter()
            .filter(|(name, _)| *name != EXTREMA)
            .collect();
        if self.others != others || rows.len() > 1 {
            self.rows = rows;
            self.others = others;
        }
    }

    /// Show the bars, higher where the curve is farther off; returns what a click on one asks for.
    pub fn show(&self, ui: &mut Ui, present: Option<usize>) -> Option<Values> {
        if self.rows.len() < 2 {
            return None;
        }
        widgets::caption(ui, "Largest distance by curvature extrema");
        let [height, below] = HEIGHTS;
        let room = vec2(ui.available_width(), height + below);
        let (rect, _) = ui.allocate_exact_size(room, Sense::hover());
        let width = (rect.width() / self.rows.len() as f32).clamp(WIDTHS[0], WIDTHS[1]);
        let mut clicked = None;
        for (index, row) in self.rows.iter().enumerate() {
            let left = rect.left() + index as f32 * width;
            let right = (left + width).min(rect.right());
            let cell = Rect::from_min_max(pos2(left, rect.top()), pos2(right, rect.bottom()));
            if self.bar_ui(ui, cell, row, present == Some(row.extrema)) {
                clicked = Some(row.extrema);
            }
        }
        let extrema = clicked?;
        Some(vec![(EXTREMA, Value::List(vec![extrema as f64]))])
    }

    /// Show one bar with its number; returns whether it was clicked.
    fn bar_ui(&self, ui: &Ui, cell: Rect, row: &Row, is_present: bool) -> bool {
        let tokens = Tokens::of(ui);
        let id = ui.scope_id().with(("trade-off", row.extrema));
        let words = format!(
            "{}: {} off, {}",
            counted(row.extrema, "extremum", "extrema"),
            figures::significant(row.largest, 3),
            counted(row.vertices, "vertex", "vertices"),
        );
        let response = ui.interact(cell, id, Sense::click());
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_present, &words));
        let response = response
            .on_hover_cursor(CursorIcon::PointingHand)
            .on_hover_text(words);
        let [height, below] = HEIGHTS;
        let share = self.share(row.largest) as f32;
        let foot = cell.bottom() - below;
        let bar = Rect::from_min_max(
            pos2(cell.left() + 1.0, foot - share * height),
            pos2(cell.right() - 1.0, foot),
        );
        let colour = match (is_present, response.hovered()) {
            (true, _) => tokens.accent,
            (false, true) => tokens.text,
            (false, false) => tokens.faint_text,
        };
        let painter = ui.painter();
        painter.rect_filled(bar, 1.0, colour);
        if response.has_focus() {
            painter.rect_stroke(cell, 1.0, (1.0, tokens.accent), StrokeKind::Inside);
        }
        let middle = pos2(cell.center().x, foot + 0.5 * STEP);
        let font = theme::small_font();
        painter.text(
            middle,
            Align2::CENTER_TOP,
            row.extrema.to_string(),
            font,
            colour,
        );
        response.clicked()
    }

    /// The height of a bar, by the logarithm of its distance, as a share.
    fn share(&self, largest: f64) -> f64 {
        let all = self
            .rows
            .iter()
            .map(|row| row.largest.max(f64::MIN_POSITIVE).ln());
        let low = all.clone().fold(f64::INFINITY, f64::min);
        let high = all.fold(f64::NEG_INFINITY, f64::max);
        let place = (largest.max(f64::MIN_POSITIVE).ln() - low) / (high - low).max(f64::EPSILON);
        LEAST + (1.0 - LEAST) * place
    }
}
