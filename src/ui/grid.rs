//! The grid, its axes and their numbers.

use eframe::egui::{Align2, Painter, Rect, Stroke, pos2};
use glam::{DVec2, DVec3};

use super::chains::Screen;
use super::figures;
use super::labels;
use super::theme::{self, STEP, Tokens};
use crate::editor::{Viewport, grid_steps, ground_grid};

/// The most lines that are drawn one way: a guard, steps are chosen so that fewer suffice.
const MOST: i64 = 1000;

/// Which coordinate a family of lines holds fixed.
#[derive(Clone, Copy, PartialEq)]
enum Axis {
    X,
    Y,
}

/// Paint the grid's lines and axes behind everything else. A view that is turned against the
/// model shows the grid on the ground, and the model's three axes.
pub fn paint(painter: &Painter, rect: Rect, viewport: &Viewport, tokens: &Tokens) {
    if viewport.orientation.axes().is_none() {
        paint_ground(painter, rect, viewport, tokens);
        paint_model_axes(painter, rect, viewport, tokens);
        return;
    }
    let hair = 1.0 / painter.pixels_per_point();
    let (minor, major) = grid_steps(viewport);
    for (step, colour) in [(minor, tokens.grid_minor), (major, tokens.grid_major)] {
        for axis in [Axis::X, Axis::Y] {
            for (_, place) in lines(axis, step, viewport, rect) {
                line(painter, rect, axis, place, Stroke::new(hair, colour));
            }
        }
    }
    let zero = viewport.to_screen(DVec2::ZERO);
    for (axis, place) in [(Axis::X, zero.x), (Axis::Y, zero.y)] {
        let place = place + f64::from(origin(axis, rect));
        let (low, high) = extent(axis, rect);
        if (low..=high).contains(&place) {
            line(
                painter,
                rect,
                axis,
                place as f32,
                Stroke::new(hair.max(1.0), tokens.axes),
            );
        }
    }
}

fn paint_ground(painter: &Painter, rect: Rect, viewport: &Viewport, tokens: &Tokens) {
    let screen = Screen::new(viewport, rect);
    let hair = 1.0 / painter.pixels_per_point();
    let grid = ground_grid(viewport);
    for (lines, colour) in [
        (grid.minor, tokens.grid_minor),
        (grid.major, tokens.grid_major),
    ] {
        let stroke = Stroke::new(hair, colour.gamma_multiply(grid.strength));
        for line in lines.into_iter().filter_map(|line| screen.segment(line)) {
            painter.line_segment(line, stroke);
        }
    }
}

fn paint_model_axes(painter: &Painter, rect: Rect, viewport: &Viewport, tokens: &Tokens) {
    let screen = Screen::new(viewport, rect);
    let view = viewport.view_box();
    // Long enough to leave the canvas, wherever the origin is.
    let far = view.low.abs().max(view.high.abs()).length() * 4.0;
    for (direction, colour) in DVec3::AXES.into_iter().zip(tokens.model_axes) {
        let seen = viewport.flatten(direction);
        let along = far * seen / seen.length().max(1e-3);
        let faint = Stroke::new(1.0, colour.gamma_multiply(0.35));
        if let Some(negative) = screen.segment([DVec2::ZERO, -along]) {
            painter.line_segment(negative, Stroke::new(1.0, colour.gamma_multiply(0.15)));
        }
        if let Some(positive) = screen.segment([DVec2::ZERO, along]) {
            painter.line_segment(positive, faint);
        }
    }
}

/// The visible multiples of a step, each with its place on the screen.
fn lines(axis: Axis, step: f64, viewport: &Viewport, rect: Rect) -> Vec<(f64, f32)> {
    let view = viewport.view_box();
    let (low, high) = match axis {
        Axis::X => (view.low.x, view.high.x),
        Axis::Y => (view.low.y, view.high.y),
    };
    let (first, last) = ((low / step).ceil(), (high / step).floor());
    // Far from the origin a step may be less than the doubles' own spacing.
    if !(last - first < MOST as f64) || first.abs().max(last.abs()) > 1e15 {
        return Vec::new();
    }
    let numbers = first as i64..=last as i64;
    let place = |value: f64| match axis {
        Axis::X => viewport.to_screen(DVec2::new(value, 0.0)).x,
        Axis::Y => viewport.to_screen(DVec2::new(0.0, value)).y,
    };
    let origin = f64::from(origin(axis, rect));
    let on_screen = |value: f64| (value, (origin + place(value)) as f32);
    numbers
        .map(|number| on_screen(number as f64 * step))
        .collect()
}

fn origin(axis: Axis, rect: Rect) -> f32 {
    match axis {
        Axis::X => rect.left(),
        Axis::Y => rect.top(),
    }
}

fn extent(axis: Axis, rect: Rect) -> (f64, f64) {
    match axis {
        Axis::X => (f64::from(rect.left()), f64::from(rect.right())),
        Axis::Y => (f64::from(rect.top()), f64::from(rect.bottom())),
    }
}

fn line(painter: &Painter, rect: Rect, axis: Axis, place: f32, stroke: Stroke) {
    match axis {
        Axis::X => painter.vline(place, rect.y_range(), stroke),
        Axis::Y => painter.hline(rect.x_range(), place, stroke),
    };
}

/// Write the numbers along the lower and the left edge, over the curves that pass there. Where
/// they would touch, only every second, fifth, tenth … is written.
pub fn paint_numbers(painter: &Painter, rect: Rect, viewport: &Viewport, tokens: &Tokens) {
    if viewport.orientation.axes().is_none() {
        return;
    }
    let (_, major) = grid_steps(viewport);
    let font = theme::small_font();
    let text = |value: f64| figures::to_resolution(value, major);
    let across = lines(Axis::X, major, viewport, rect);
    let widest = across
        .iter()
        .map(|(value, _)| labels::size(painter, &text(*value), font.clone()).x)
        .fold(0.0, f32::max);
    let spacing = (major * viewport.scale) as f32;
    let stride = stride(widest + 4.0 * STEP, spacing);
    let foot = rect.bottom() - STEP;
    let left_numbers_end =
        rect.left() + 2.0 * STEP + widest_at_left(painter, rect, viewport, major);
    for (value, place) in across {
        let half = 0.5 * labels::size(painter, &text(value), font.clone()).x;
        let is_clear = place - half > left_numbers_end && place + half < rect.right() - STEP;
        if is_clear && is_multiple(value, major, stride) {
            let at = pos2(place, foot);
            labels::paint(
                painter,
                at,
                Align2::CENTER_BOTTOM,
                &text(value),
                font.clone(),
                tokens.faint_text,
                tokens,
            );
        }
    }
    for (value, place) in lines(Axis::Y, major, viewport, rect) {
        if place > rect.top() + 3.0 * STEP && place < rect.bottom() - 7.0 * STEP {
            let at = pos2(rect.left() + 1.5 * STEP, place);
            labels::paint(
                painter,
                at,
                Align2::LEFT_CENTER,
                &text(value),
                font.clone(),
                tokens.faint_text,
                tokens,
            );
        }
    }
}

fn widest_at_left(painter: &Painter, rect: Rect, viewport: &Viewport, major: f64) -> f32 {
    let font = theme::small_font();
    let values = lines(Axis::Y, major, viewport, rect);
    let width =
        |value: f64| labels::size(painter, &figures::to_resolution(value, major), font.clone()).x;
    values
        .iter()
        .map(|(value, _)| width(*value))
        .fold(0.0, f32::max)
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
