//! The rulers along the left and the lower edge of a pane: the numbers of the grid, and where guides come from.

use eframe::egui::epaint::TextShape;
use eframe::egui::{Align2, Rect, Stroke, pos2, vec2};

use super::brush::Brush;
use super::grid::lines;
use super::theme::{self, STEP};
use super::{figures, labels};
use crate::editor::{RULER, grid_steps};

/// The length of the ticks between numbers.
const TICK: f32 = 4.0;

/// From a tick to its number.
const GAP: f32 = 3.0;

/// Paint the rulers over all that passes there; none in a view that is turned against the model.
pub fn paint(brush: &Brush<'_>) {
    let viewport = brush.screen.viewport;
    if viewport.orientation.axes().is_none() {
        return;
    }
    let breadth = RULER as f32;
    let (left, below) = brush
        .rect
        .split_left_right_at_x(brush.rect.left() + breadth);
    let (_, below) = below.split_top_bottom_at_y(below.bottom() - breadth);
    let hair = Stroke::new(1.0 / brush.painter.pixels_per_point(), brush.tokens.outline);
    for band in [left, below] {
        brush.painter.rect_filled(band, 0, brush.tokens.panel);
    }
    brush.painter.vline(left.right(), left.y_range(), hair);
    brush.painter.hline(below.x_range(), below.top(), hair);
    let corner = Rect::from_min_max(left.left_bottom() - vec2(0.0, breadth), left.right_bottom());
    ticks(brush, 0, below);
    ticks(brush, 1, left.with_max_y(corner.top()));
}

/// Paint the ticks and the numbers of a ruler, 0 across and 1 upwards. Where numbers would touch, only every second,
/// fifth, tenth … is written.
fn ticks(brush: &Brush<'_>, axis: usize, band: Rect) {
    let (minor, major) = grid_steps(brush.screen.viewport);
    let stroke = Stroke::new(1.0, brush.tokens.faint_text.gamma_multiply(0.6));
    let extent = [band.x_range(), band.y_range()][axis];
    let tick = |place: f32, length: f32| match axis {
        0 => [pos2(place, band.top()), pos2(place, band.top() + length)],
        _ => [
            pos2(band.right() - length, place),
            pos2(band.right(), place),
        ],
    };
    for (step, length) in [(minor, TICK), (major, band.size().min_elem())] {
        let seen = lines(brush, axis, step).into_iter();
        for (_, place) in seen.filter(|(_, place)| extent.contains(*place)) {
            brush.painter.line_segment(tick(place, length), stroke);
        }
    }
    let text = |value: f64| figures::to_resolution(value, major);
    let width = |value: f64| labels::size(brush.painter, &text(value), theme::small_font()).x;
    let numbers = lines(brush, axis, major);
    let widest = numbers.iter().map(|(value, _)| width(*value));
    let room = widest.fold(0.0, f32::max) + GAP + 2.0 * STEP;
    let stride = stride(room, (major * brush.screen.viewport.scale) as f32);
    for (value, place) in numbers {
        let end = if axis == 0 {
            place + room
        } else {
            place - room
        };
        let fits = extent.contains(place) && extent.contains(end);
        if fits && is_multiple(value, major, stride) {
            number(brush, axis, band, place, text(value));
        }
    }
}

/// Write a number behind its tick, along the ruler.
fn number(brush: &Brush<'_>, axis: usize, band: Rect, place: f32, text: String) {
    let (font, colour) = (theme::small_font(), brush.tokens.faint_text);
    if axis == 0 {
        let at = pos2(place + GAP, band.center().y + 1.0);
        brush
            .painter
            .text(at, Align2::LEFT_CENTER, text, font, colour);
        return;
    }
    let galley = brush.painter.layout_no_wrap(text, font, colour);
    let at = pos2(band.center().x - 0.5 * galley.size().y - 1.0, place - GAP);
    let shape = TextShape::new(at, galley, colour);
    brush
        .painter
        .add(shape.with_angle(-std::f32::consts::FRAC_PI_2));
}

/// How many steps apart numbers must stand so that they don't touch.
fn stride(width: f32, spacing: f32) -> i64 {
    let strides = [1, 2, 5, 10, 20, 50, 100];
    strides
        .into_iter()
        .find(|stride| *stride as f32 * spacing >= width)
        .unwrap_or(1000)
}

fn is_multiple(value: f64, step: f64, stride: i64) -> bool {
    (value / step).round() as i64 % stride == 0
}
