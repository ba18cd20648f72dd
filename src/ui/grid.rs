//! The grid and its axes.

use eframe::egui::Stroke;
use glam::{DVec2, DVec3};

use super::brush::Brush;
use crate::editor::{grid_steps, ground_grid};

/// The most lines that are drawn one way: a guard, steps are chosen so that fewer suffice.
const MOST: i64 = 1000;

/// Paint the grid's lines and axes behind everything else. A view that is turned against the
/// model shows the grid on the ground, and the model's three axes.
pub fn paint(brush: &Brush<'_>) {
    let (viewport, tokens) = (brush.screen.viewport, brush.tokens);
    let hair = 1.0 / brush.painter.pixels_per_point();
    if viewport.orientation.axes().is_none() {
        paint_ground(brush, hair);
        paint_model_axes(brush);
        return;
    }
    let (minor, major) = grid_steps(viewport);
    for (step, colour) in [(minor, tokens.grid_minor), (major, tokens.grid_major)] {
        for axis in [0, 1] {
            for (_, place) in lines(brush, axis, step) {
                line(brush, axis, place, Stroke::new(hair, colour));
            }
        }
    }
    let zero = brush.screen.exact(DVec2::ZERO);
    let rect = brush.rect;
    for axis in [0, 1] {
        let extent = f64::from(rect.min[axis])..=f64::from(rect.max[axis]);
        if extent.contains(&zero[axis]) {
            let stroke = Stroke::new(hair.max(1.0), tokens.axes);
            line(brush, axis, zero[axis] as f32, stroke);
        }
    }
}

fn paint_ground(brush: &Brush<'_>, hair: f32) {
    let grid = ground_grid(brush.screen.viewport);
    for (lines, colour) in [
        (grid.minor, brush.tokens.grid_minor),
        (grid.major, brush.tokens.grid_major),
    ] {
        let stroke = Stroke::new(hair, colour.gamma_multiply(grid.strength));
        for line in lines {
            brush.segment(line, stroke);
        }
    }
}

fn paint_model_axes(brush: &Brush<'_>) {
    let viewport = brush.screen.viewport;
    let view = viewport.view_box();
    // Long enough to leave the canvas, wherever the origin is.
    let far = view.low.abs().max(view.high.abs()).length() * 4.0;
    for (direction, colour) in DVec3::AXES.into_iter().zip(brush.tokens.model_axes) {
        let seen = viewport.flatten(direction);
        let along = far * seen / seen.length().max(1e-3);
        for (end, strength) in [(-along, 0.15), (along, 0.35)] {
            let stroke = Stroke::new(1.0, colour.gamma_multiply(strength));
            brush.segment([DVec2::ZERO, end], stroke);
        }
    }
}

/// The visible multiples of a step on an axis, 0 across and 1 upwards, each with its place on the screen.
pub fn lines(brush: &Brush<'_>, axis: usize, step: f64) -> Vec<(f64, f32)> {
    let view = brush.screen.viewport.view_box();
    let (first, last) = (
        (view.low[axis] / step).ceil(),
        (view.high[axis] / step).floor(),
    );
    // Far from the origin a step may be less than the doubles' own spacing.
    if !(last - first < MOST as f64) || first.abs().max(last.abs()) > 1e15 {
        return Vec::new();
    }
    let place = |value: f64| brush.screen.exact(value * DVec2::AXES[axis])[axis] as f32;
    let values = (first as i64..=last as i64).map(|number| number as f64 * step);
    values.map(|value| (value, place(value))).collect()
}

fn line(brush: &Brush<'_>, axis: usize, place: f32, stroke: Stroke) {
    match axis {
        0 => brush.painter.vline(place, brush.rect.y_range(), stroke),
        _ => brush.painter.hline(brush.rect.x_range(), place, stroke),
    };
}
