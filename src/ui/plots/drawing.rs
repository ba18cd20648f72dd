//! What all plots are drawn of: axes, lines, dots, cursors.

use std::ops::RangeInclusive;

use eframe::egui::{Color32, Vec2};
use egui_plot::{
    GridInput, GridMark, Line, MarkerShape, Plot, PlotBounds, PlotPoint, PlotPoints, PlotUi,
    Points, VLine, uniform_grid_spacer,
};
use glam::DVec2;

use crate::ui::figures;
use crate::ui::theme::Tokens;

/// A plot that shows the bounds it is given and cannot be pushed about.
pub fn plot<'a>(
    id: &'a str,
    x: &'a str,
    y: &'a str,
    bounds: PlotBounds,
    tokens: &Tokens,
) -> Plot<'a> {
    let resolution = 1e-3 * (bounds.height()).abs();
    Plot::new(id)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .show_crosshair(false)
        .grid_color(tokens.grid_major)
        .grid_fade(0.0)
        .set_margin_fraction(Vec2::ZERO)
        .x_axis_label(x)
        .y_axis_label(y)
        .y_axis_min_width(56.0)
        .x_grid_spacer(uniform_grid_spacer(|input| steps(input, 10.0)))
        .y_grid_spacer(uniform_grid_spacer(|input| steps(input, 4.0)))
        .x_axis_formatter(axis_number)
        .y_axis_formatter(move |mark, _| axis_figure(mark.value, mark.step_size.max(resolution)))
        .show_background(false)
}

/// Choose the steps of an axis: one family of lines, each with its number, at 1, 2 or 5 times a
/// power of ten and `times` the least spacing apart.
pub fn steps(input: GridInput, times: f64) -> [f64; 3] {
    let least = (times * input.base_step_size).max(f64::MIN_POSITIVE);
    let power = 10f64.powf(least.log10().floor());
    let factors = [1.0, 2.0, 5.0, 10.0].into_iter();
    let step = factors
        .map(|factor| factor * power)
        .find(|step| *step >= least);
    [step.unwrap_or(10.0 * power); 3]
}

pub fn axis_number(mark: GridMark, _: &RangeInclusive<f64>) -> String {
    axis_figure(mark.value, mark.step_size)
}

pub fn axis_figure(value: f64, step: f64) -> String {
    if value.abs() < 1e-9 * step {
        "0".to_owned()
    } else {
        figures::to_resolution(value, step)
    }
}

pub fn zero_line(plot: &mut PlotUi<'_>, tokens: &Tokens) {
    let line = egui_plot::HLine::new("zero", 0.0)
        .color(tokens.axes)
        .width(1.0);
    plot.hline(line.allow_hover(false));
}

/// Draw a chain, one line for each of its pieces.
pub fn lines(plot: &mut PlotUi<'_>, name: &str, chain: &[DVec2], colour: Color32) {
    for piece in chain
        .split(|point| point.is_nan())
        .filter(|piece| !piece.is_empty())
    {
        let line = Line::new(name.to_owned(), series(piece))
            .color(colour)
            .width(1.5);
        plot.line(line);
    }
}

/// Draw a chain as it was, faintly; it tells nothing when it is hovered.
pub fn before_lines(plot: &mut PlotUi<'_>, chain: &[DVec2], tokens: &Tokens) {
    let pieces = chain.split(|point| point.is_nan());
    for piece in pieces.filter(|piece| !piece.is_empty()) {
        let line = Line::new("before", series(piece))
            .color(tokens.strong_text.gamma_multiply(0.3))
            .width(1.5);
        plot.line(line.allow_hover(false));
    }
}

pub fn dots_of(name: &str, points: &[DVec2], colour: Color32) -> Points<'static> {
    let finite: Vec<DVec2> = points
        .iter()
        .copied()
        .filter(|point| point.is_finite())
        .collect();
    let dots = Points::new(name.to_owned(), series(&finite));
    dots.color(colour)
        .radius(3.0)
        .shape(MarkerShape::Circle)
        .filled(true)
}

pub fn ring(at: DVec2, tokens: &Tokens) -> Points<'static> {
    let ring = Points::new("hovered", series(&[at]));
    ring.color(tokens.accent)
        .radius(6.0)
        .filled(false)
        .allow_hover(false)
}

pub fn series(points: &[DVec2]) -> PlotPoints<'static> {
    PlotPoints::Owned(
        points
            .iter()
            .map(|point| PlotPoint::new(point.x, point.y))
            .collect(),
    )
}

/// Mark what is hovered on the canvas.
pub fn cursor(plot: &mut PlotUi<'_>, at: DVec2, tokens: &Tokens) {
    let line = VLine::new("hovered", at.x)
        .color(tokens.accent.gamma_multiply(0.6))
        .width(1.0);
    plot.vline(line.allow_hover(false));
    if at.is_finite() {
        plot.points(ring(at, tokens));
    }
}

/// The abscissa under the pointer, if it is over the plot.
pub fn hovered_x(plot: &PlotUi<'_>) -> Option<f64> {
    let is_over = plot.response().hovered();
    is_over
        .then(|| plot.pointer_coordinate())
        .flatten()
        .map(|point| point.x)
}
