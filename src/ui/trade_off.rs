//! What each number of curvature extrema reaches, as a small plot: a click asks for one.

use eframe::egui::{
    Align2, CursorIcon, Rect, Response, Role, Sense, StrokeKind, Ui, WidgetInfo, pos2, vec2,
};

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

/// Distances that differ by less than this factor are compared by themselves, others by their logarithms.
const DECADE: f64 = 10.0;

/// What a number of extrema reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    extrema: usize,
    vertices: usize,
    largest: f64,
}

impl Row {
    fn name(&self) -> String {
        let extrema = counted(self.extrema, "extremum", "extrema");
        format!(
            "{extrema}, {}",
            counted(self.vertices, "vertex", "vertices")
        )
    }

    fn distance(&self) -> String {
        figures::significant(self.largest, 4)
    }
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
        if self.others != others {
            self.rows.clear();
            self.others = others;
        }
        // A wished number tells of itself and of a few others.
        self.rows
            .retain(|known| rows.iter().all(|row| row.extrema != known.extrema));
        self.rows.extend(rows);
        self.rows.sort_by_key(|row| row.extrema);
    }

    /// Show the bars, higher where the curve is farther off, and below them the figures of the hovered one or the
    /// present one; returns what a click on one asks for.
    pub fn show(&self, ui: &mut Ui, present: Option<usize>) -> Option<Values> {
        if self.rows.len() < 2 {
            return None;
        }
        let caption = widgets::caption(ui, "Largest distance by curvature extrema");
        caption.on_hover_text("Click a bar to ask for its number of extrema");
        let [height, below] = HEIGHTS;
        let room = vec2(ui.available_width(), height + below);
        let (rect, _) = ui.allocate_exact_size(room, Sense::hover());
        let width = (rect.width() / self.rows.len() as f32).clamp(WIDTHS[0], WIDTHS[1]);
        let (mut clicked, mut hovered) = (None, None);
        for (index, row) in self.rows.iter().enumerate() {
            let left = rect.left() + index as f32 * width;
            let right = (left + width).min(rect.right());
            let cell = Rect::from_min_max(pos2(left, rect.top()), pos2(right, rect.bottom()));
            let response = self.bar_ui(ui, cell, row, present == Some(row.extrema));
            if response.clicked() {
                clicked = Some(row.extrema);
            }
            if response.hovered() || response.has_focus() {
                hovered = Some(row);
            }
        }
        let is_present = |row: &&Row| Some(row.extrema) == present;
        let told = hovered.or_else(|| self.rows.iter().find(is_present));
        let name = told.map_or_else(|| "No number of these".to_owned(), Row::name);
        let distance = told.map_or_else(|| "–".to_owned(), Row::distance);
        widgets::figure_row(ui, &name, &distance);
        let extrema = clicked?;
        Some(vec![(EXTREMA, Value::List(vec![extrema as f64]))])
    }

    /// Show one bar with its number.
    fn bar_ui(&self, ui: &Ui, cell: Rect, row: &Row, is_present: bool) -> Response {
        let tokens = Tokens::of(ui);
        let id = ui.scope_id().with(("trade-off", row.extrema));
        let words = format!("{}: {} off", row.name(), row.distance());
        let response = ui.interact(cell, id, Sense::click());
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_present, &words));
        // Its figures stand below the bars, where a tooltip would hide them.
        let response = response.on_hover_cursor(CursorIcon::PointingHand);
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
        response
    }

    /// The height of a bar as a share: by its distance, or by the logarithm where distances differ by much.
    fn share(&self, largest: f64) -> f64 {
        let all = self.rows.iter().map(|row| row.largest);
        let all = all.map(|largest| largest.max(f64::MIN_POSITIVE));
        let low = all.clone().fold(f64::INFINITY, f64::min);
        let high = all.fold(f64::MIN_POSITIVE, f64::max);
        match high / low < DECADE {
            true => largest / high,
            false => LEAST + (1.0 - LEAST) * (largest.max(low) / low).ln() / (high / low).ln(),
        }
    }
}
