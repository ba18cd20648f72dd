//! The elements of all plots: axes, lines, dots, cursors.

use std::ops::RangeInclusive;

use eframe::egui::{Color32, Rangef, Vec2};
use egui_plot::{
    AxisHints, GridMark, HLine, Line, MarkerShape, Plot, PlotPoint, PlotPoints, PlotUi, Points,
    VLine,
};
use glam::DVec2;

use super::pane::{LEFT, Pane, RIGHT};
use super::ticks::Scale;
use crate::ui::theme::{self, Tokens};

/// Half the width of a letter beside a tick, in points.
const HALF_LETTER: f64 = 3.2;

/// Half the height of a letter beside a tick, in points.
const HALF_LINE: f64 = 7.0;

/// Points of a line that are nearer to the last one than this, in points of the screen, are left
/// out: the eye cannot distinguish them.
const FINE: f64 = 0.7;

/// What rounding may add to a range, as a share of it.
const SLACK: f64 = 1e-9;

/// The names of a plot's axes, across and upwards, and the meaning of their numbers.
pub struct Axes<'a> {
    pub names: [&'a str; 2],
    pub scale: Scale,
    /// The least number upwards: below it there are no values.
    pub least: f64,
    /// The range of the horizontal axis in which ticks have numbers.
    pub numbered: [f64; 2],
}

/// A plot of the given bounds; the caller moves them.
pub fn plot<'a>(id: &'a str, axes: &Axes<'a>, pane: &Pane, tokens: &Tokens) -> Plot<'a> {
    let (scale, size, [first, last]) = (axes.scale, pane.size, axes.numbered);
    let least = axes.least;
    let slack = SLACK * (last - first);
    let numbered = first - slack..=last + slack;
    let [across, upwards] = [AxisHints::new_x(), AxisHints::new_y()].map(|axis| {
        axis.label_spacing(Rangef::new(1.0, 2.0))
            .tick_label_font(theme::small_font())
            .tick_label_color(tokens.faint_text)
    });
    let across = across.label(axes.names[0]).formatter(move |mark, range| {
        match numbered.contains(&mark.value) {
            true => across_number(scale, mark, range, size.x),
            false => String::new(),
        }
    });
    let upwards = upwards
        .label(axes.names[1])
        .min_thickness(LEFT)
        .formatter(move |mark, range| match mark.value < least {
            true => String::new(),
            false => upwards_number(scale, mark, range, size.y),
        });
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
        .custom_x_axes(vec![across])
        .custom_y_axes(vec![upwards])
        .x_grid_spacer(move |input| scale.across(input))
        .y_grid_spacer(move |input| scale.upwards(input))
        .show_background(false)
}

/// The number below a tick, unless it would run over the right edge of the window's part.
pub fn across_number(
    scale: Scale,
    mark: GridMark,
    range: &RangeInclusive<f64>,
    width: f64,
) -> String {
    let text = scale.number(mark, range);
    let share = (range.end() - mark.value) / (range.end() - range.start());
    let room = share * width + f64::from(RIGHT);
    match text.chars().count() as f64 * HALF_LETTER > room {
        true => String::new(),
        false => text,
    }
}

/// The number beside a tick, unless it would run over the upper or the lower edge.
pub fn upwards_number(
    scale: Scale,
    mark: GridMark,
    range: &RangeInclusive<f64>,
    height: f64,
) -> String {
    let room = HALF_LINE / height.max(1.0) * (range.end() - range.start());
    match mark.value < range.start() + room || mark.value > range.end() - room {
        true => String::new(),
        false => scale.number(mark, range),
    }
}

pub fn zero_line(plot: &mut PlotUi<'_>, tokens: &Tokens) {
    let line = HLine::new("zero", 0.0).color(tokens.axes).width(1.0);
    plot.hline(line.allow_hover(false));
}

/// The name of lines of the curve before the change.
pub const BEFORE: &str = "before";

/// Draw a chain, one line for each of its pieces between gaps, thinned to points that differ on screen. The
/// lines before a change have no tooltip.
pub fn lines(plot: &mut PlotUi<'_>, name: &str, chain: &[DVec2], colour: Color32) {
    let bounds = plot.plot_bounds();
    let size = plot.transform().frame().size();
    let size = DVec2::new(f64::from(size.x), f64::from(size.y)).max(DVec2::ONE);
    let point = DVec2::new(bounds.width(), bounds.height()) / size;
    let pieces = chain.split(|point| point.is_nan());
    for piece in pieces.filter(|piece| !piece.is_empty()) {
        let line = Line::new(name.to_owned(), series(&told_apart(piece, point)));
        let line = line.color(colour).width(1.5);
        plot.line(line.allow_hover(name != BEFORE));
    }
}

/// Leave out points less than a screen point from the last one; `point` is the extent of a point of
/// the screen.
fn told_apart(piece: &[DVec2], point: DVec2) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::with_capacity(piece.len());
    let mut skipped = None;
    for at in piece {
        let is_near = |last: &DVec2| ((*at - *last) / point).length_squared() < FINE * FINE;
        if kept.last().is_some_and(is_near) {
            skipped = Some(*at);
        } else {
            kept.push(*at);
            skipped = None;
        }
    }
    kept.extend(skipped);
    kept
}

/// The colour of a chain before the change.
pub fn before_colour(tokens: &Tokens) -> Color32 {
    tokens.strong_text.gamma_multiply(0.3)
}

pub fn dots_of(name: &str, points: &[DVec2], colour: Color32) -> Points<'static> {
    let finite = points.iter().copied().filter(|point| point.is_finite());
    let dots = Points::new(name.to_owned(), series(&finite.collect::<Vec<_>>()));
    let dots = dots.color(colour).radius(3.0);
    dots.shape(MarkerShape::Circle).filled(true)
}

pub fn ring(at: DVec2, tokens: &Tokens) -> Points<'static> {
    let ring = Points::new("hovered", series(&[at]));
    ring.color(tokens.accent)
        .radius(6.0)
        .filled(false)
        .allow_hover(false)
}

pub fn series(points: &[DVec2]) -> PlotPoints<'static> {
    let points = points.iter().map(|point| PlotPoint::new(point.x, point.y));
    PlotPoints::Owned(points.collect())
}

/// Mark the place that is hovered on the canvas.
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
    let is_over = plot.response().hovered() && !plot.response().dragged();
    let pointer = plot.pointer_coordinate().filter(|_| is_over);
    pointer.map(|point| point.x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_keeps_its_ends_and_all_that_can_be_seen() {
        let wave = |index: usize| {
            let x = 1e-3 * index as f64;
            DVec2::new(x, (9.0 * x).sin())
        };
        let chain: Vec<DVec2> = (0..=10_000).map(wave).collect();
        let point = DVec2::new(10.0, 2.0) / DVec2::new(1000.0, 100.0);
        let kept = told_apart(&chain, point);
        // The line is some 3000 points of the screen long.
        assert!(kept.len() < 4500, "{}", kept.len());
        assert_eq!((kept[0], kept.last()), (chain[0], chain.last()));
        for at in &chain {
            let near = |other: &DVec2| ((*at - *other) / point).length() < FINE;
            assert!(kept.iter().any(near));
        }
    }

    #[test]
    fn numbers_that_would_be_clipped_are_left_out() {
        let range = 0.0..=10.0;
        let mark = |value| GridMark {
            value,
            step_size: 0.5,
        };
        let across = |value| across_number(Scale::Even, mark(value), &range, 500.0);
        assert_eq!(across(10.0), "10.0");
        let narrow = GridMark {
            value: 10.0,
            step_size: 1e-4,
        };
        assert_eq!(across_number(Scale::Even, narrow, &range, 500.0), "");
        let upwards = |value| upwards_number(Scale::Even, mark(value), &range, 100.0);
        assert_eq!([upwards(0.5), upwards(1.0), upwards(9.5)], ["", "1.0", ""]);
    }
}
