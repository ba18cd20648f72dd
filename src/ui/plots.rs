//! The plots under the canvas: curvature over arc length, and the polygon's legs and turns.

use std::ops::RangeInclusive;

use eframe::egui::{Button, Color32, Ui, Vec2};
use egui_plot::{
    GridInput, GridMark, HoverPosition, Line, MarkerShape, Plot, PlotBounds, PlotPoint, PlotPoints,
    PlotUi, Points, VLine, uniform_grid_spacer,
};
use glam::DVec2;
use lucide_icons::Icon;

use super::figures;
use super::theme::{STEP, Tokens};
use super::widgets::{self, IconButton};
use crate::editor::{Command, Editor, PlotScene};

/// The height of the bar with the tabs.
pub const BAR: f32 = 32.0;

/// How much of a plot's height is kept free above and below.
const MARGIN: f64 = 0.08;

/// Values that differ by less than this share of their size are shown as equal: a plot that
/// blows up the last digits of a constant tells nothing.
const FLAT: f64 = 1e-3;

/// Which plots are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tab {
    /// Curvature over arc length.
    #[default]
    Curvature,
    /// Leg lengths and turning angles over the vertices.
    Legs,
}

/// The plots' own state: what they show now, so that they keep still while the curve is dragged.
#[derive(Default)]
pub struct Plots {
    tab: Tab,
    curvature: Frame,
    legs: Frame,
    turns: Frame,
    /// Whether a plot marks something on the canvas.
    hovering: bool,
    /// What the curvature plot's dots are.
    legend: String,
}

/// The bounds of one plot, kept from frame to frame.
#[derive(Clone, Copy, Debug, Default)]
struct Frame {
    bounds: Option<(DVec2, DVec2)>,
}

impl Frame {
    /// Choose the bounds: all that is to be seen, but while a drag goes on they only widen, and
    /// afterwards they only shrink when much would stay empty.
    fn settle(&mut self, wanted: (DVec2, DVec2), dragging: bool) -> PlotBounds {
        let settled = match self.bounds {
            Some((low, high)) if dragging => (low.min(wanted.0), high.max(wanted.1)),
            Some((low, high)) if !is_better(wanted, (low, high)) => (low, high),
            _ => wanted,
        };
        self.bounds = Some(settled);
        PlotBounds::from_min_max(settled.0.to_array(), settled.1.to_array())
    }
}

/// Say what the dots are, and where those are that are missing.
fn legend(beyond_ends: usize) -> String {
    let dots = "Dots: discrete curvature of the float S-polygon";
    match beyond_ends {
        0 => dots.to_owned(),
        count => format!("{dots}; {count} vertices lie beyond the ends"),
    }
}

/// Whether new bounds are worth a change: something lies outside the old ones, or a quarter of
/// them would stay empty.
fn is_better(new: (DVec2, DVec2), old: (DVec2, DVec2)) -> bool {
    let spill = 0.04 * (old.1 - old.0);
    let is_outside = (new.0 + spill).cmplt(old.0).any() || (new.1 - spill).cmpgt(old.1).any();
    let is_small = (new.1 - new.0).cmplt(0.75 * (old.1 - old.0)).any();
    is_outside || is_small
}

/// The bounds that hold some points, with a margin above and below.
fn bounds_of(points: impl Iterator<Item = DVec2>, from_zero: bool) -> (DVec2, DVec2) {
    let finite = points.filter(|point| point.is_finite());
    let (mut low, mut high) = finite.fold(
        (DVec2::INFINITY, DVec2::NEG_INFINITY),
        |(low, high), point| (low.min(point), high.max(point)),
    );
    if !(low.x <= high.x) {
        return (DVec2::ZERO, DVec2::ONE);
    }
    if from_zero {
        low.y = low.y.min(0.0);
        high.y = high.y.max(0.0);
    }
    let size = low.y.abs().max(high.y.abs()).max(1e-300);
    let short = (20.0 * FLAT * size - (high.y - low.y)).max(0.0);
    let margin = 0.5 * short + MARGIN * (high.y - low.y + short);
    if high.x == low.x {
        high.x = low.x + 1.0;
    }
    (
        low - DVec2::new(0.0, margin),
        high + DVec2::new(0.0, margin),
    )
}

impl Plots {
    /// Which tab is in front.
    pub fn tab(&self) -> Tab {
        self.tab
    }

    /// Put a tab in front.
    pub fn set_tab(&mut self, tab: Tab) {
        self.tab = tab;
    }

    /// Show the bar with the tabs and the button that folds the plots.
    pub fn bar_ui(&mut self, ui: &mut Ui, shown: bool, commands: &mut Vec<Command>) {
        ui.horizontal_centered(|ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            let tabs = [
                (Tab::Curvature, "Curvature"),
                (Tab::Legs, "Legs and turning angles"),
            ];
            for (tab, name) in tabs {
                let response = ui.add(Button::selectable(shown && self.tab == tab, name));
                if response.clicked() {
                    self.tab = tab;
                    if !shown {
                        commands.push(Command::TogglePlots);
                    }
                }
            }
            widgets::at_right(ui, |ui| {
                let (icon, name) = if shown {
                    (Icon::ChevronDown, "Fold the plots")
                } else {
                    (Icon::ChevronUp, "Unfold the plots")
                };
                if IconButton::new(icon, name).show(ui).clicked() {
                    commands.push(Command::TogglePlots);
                }
                if shown && self.tab == Tab::Curvature {
                    widgets::caption(ui, &self.legend);
                }
            });
        });
    }

    /// Show the plots of the tab in front.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor) {
        if editor.active().is_none() {
            widgets::note(ui, "Select a curve to see its plots.");
            // The panel keeps its height.
            ui.take_available_space();
            return;
        }
        match self.tab {
            Tab::Curvature => self.curvature_ui(ui, editor),
            Tab::Legs => self.legs_ui(ui, editor),
        }
    }

    fn curvature_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let tokens = Tokens::of(ui);
        let dragging = editor.is_dragging();
        let scene = editor.plots();
        self.legend = legend(scene.beyond_ends);
        let length = scene.length;
        let dots = scene.discrete.iter().map(|(_, point)| *point);
        let points = scene.curvature.iter().copied().chain(dots);
        let mut wanted = bounds_of(points, false);
        wanted.0.x = wanted.0.x.min(0.0);
        wanted.1.x = wanted.1.x.max(length);
        let bounds = self.curvature.settle(padded(wanted), dragging);
        let signed = if scene.planar {
            "signed curvature κ (1/unit)"
        } else {
            "curvature κ (1/unit)"
        };
        let plot = plot("curvature", "arc length (units)", signed, bounds, tokens).label_formatter(
            |hover| {
                let HoverPosition::NearDataPoint {
                    position,
                    plot_name,
                    index,
                } = hover
                else {
                    return None;
                };
                let place = format!("at {}", figures::significant(position.x, 5));
                let curvature = figures::significant(position.y, 6);
                Some(match *plot_name {
                    "discrete" => format!("discrete κ {curvature}\n{place}, dot {index}"),
                    _ => format!("κ {curvature}\n{place}"),
                })
            },
        );
        let hovered = plot
            .show(ui, |plot| {
                plot.set_plot_bounds(bounds);
                zero_line(plot, tokens);
                lines(plot, "curvature", &scene.curvature, tokens.comb);
                let dots: Vec<DVec2> = scene.discrete.iter().map(|(_, point)| *point).collect();
                plot.points(dots_of("discrete", &dots, tokens.float));
                if let Some(at) = scene.hovered {
                    cursor(plot, at, tokens);
                }
                if let Some(vertex) = scene.hovered_vertex {
                    let found = scene.discrete.iter().find(|(index, _)| *index == vertex);
                    if let Some((_, at)) = found {
                        plot.points(ring(*at, tokens));
                    }
                }
                hovered_x(plot)
            })
            .inner;
        let hovered = hovered.filter(|x| (0.0..=length).contains(x));
        if hovered.is_some() || self.hovering {
            editor.hover_length(hovered);
        }
        self.hovering = hovered.is_some();
    }

    fn legs_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let tokens = Tokens::of(ui);
        let dragging = editor.is_dragging();
        let scene = editor.leg_plots();
        let count = scene.legs.len().max(scene.turns.len()) as f64;
        let width = (0.5 * (ui.available_width() - 2.0 * STEP)).max(80.0);
        let height = ui.available_height();
        let mut hovered = None;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0 * STEP;
            let series = [
                ("legs", &scene.legs, "leg length (units)", &mut self.legs),
                (
                    "turning angles",
                    &scene.turns,
                    "turning angle (°)",
                    &mut self.turns,
                ),
            ];
            for (name, points, axis, frame) in series {
                let mut wanted = bounds_of(points.iter().copied(), name == "legs");
                wanted.0.x = wanted.0.x.min(0.0);
                wanted.1.x = wanted.1.x.max(count - 1.0);
                let bounds = frame.settle(padded(wanted), dragging);
                let plot = plot(name, "vertex", axis, bounds, tokens)
                    .width(width)
                    .height(height);
                let found = plot.label_formatter(vertex_label).show(ui, |plot| {
                    plot.set_plot_bounds(bounds);
                    zero_line(plot, tokens);
                    lines(plot, name, points, tokens.float.gamma_multiply(0.6));
                    plot.points(dots_of(name, points, tokens.float));
                    mark_vertex(plot, scene, points, tokens);
                    hovered_x(plot)
                });
                hovered = found.inner.or(hovered);
            }
        });
        let vertex = hovered.map(|x| x.round()).filter(|x| *x >= 0.0);
        if vertex.is_some() || self.hovering {
            let vertices = count as usize + 1;
            editor.hover_vertex(vertex.map(|x| x as usize).filter(|index| *index < vertices));
        }
        self.hovering = vertex.is_some();
    }
}

fn vertex_label(hover: &HoverPosition<'_>) -> Option<String> {
    let HoverPosition::NearDataPoint {
        position,
        plot_name,
        ..
    } = hover
    else {
        return None;
    };
    let value = figures::significant(position.y, 6);
    Some(match *plot_name {
        "legs" => format!("leg {} … {}\n{value}", position.x, position.x + 1.0),
        _ => format!("vertex {}\n{value}°", position.x),
    })
}

/// A little room at the left and right, so that the outermost dots are whole.
fn padded((low, high): (DVec2, DVec2)) -> (DVec2, DVec2) {
    let room = DVec2::new(0.015 * (high.x - low.x), 0.0);
    (low - room, high + room)
}

/// A plot that shows the bounds it is given and cannot be pushed about.
fn plot<'a>(id: &'a str, x: &'a str, y: &'a str, bounds: PlotBounds, tokens: &Tokens) -> Plot<'a> {
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
fn steps(input: GridInput, times: f64) -> [f64; 3] {
    let least = (times * input.base_step_size).max(f64::MIN_POSITIVE);
    let power = 10f64.powf(least.log10().floor());
    let factors = [1.0, 2.0, 5.0, 10.0].into_iter();
    let step = factors
        .map(|factor| factor * power)
        .find(|step| *step >= least);
    [step.unwrap_or(10.0 * power); 3]
}

fn axis_number(mark: GridMark, _: &RangeInclusive<f64>) -> String {
    axis_figure(mark.value, mark.step_size)
}

fn axis_figure(value: f64, step: f64) -> String {
    if value.abs() < 1e-9 * step {
        "0".to_owned()
    } else {
        figures::to_resolution(value, step)
    }
}

fn zero_line(plot: &mut PlotUi<'_>, tokens: &Tokens) {
    let line = egui_plot::HLine::new("zero", 0.0)
        .color(tokens.axes)
        .width(1.0);
    plot.hline(line.allow_hover(false));
}

/// Draw a chain, one line for each of its pieces.
fn lines(plot: &mut PlotUi<'_>, name: &str, chain: &[DVec2], colour: Color32) {
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

fn dots_of(name: &str, points: &[DVec2], colour: Color32) -> Points<'static> {
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

fn ring(at: DVec2, tokens: &Tokens) -> Points<'static> {
    let ring = Points::new("hovered", series(&[at]));
    ring.color(tokens.accent)
        .radius(6.0)
        .filled(false)
        .allow_hover(false)
}

fn series(points: &[DVec2]) -> PlotPoints<'static> {
    PlotPoints::Owned(
        points
            .iter()
            .map(|point| PlotPoint::new(point.x, point.y))
            .collect(),
    )
}

/// Mark what is hovered on the canvas.
fn cursor(plot: &mut PlotUi<'_>, at: DVec2, tokens: &Tokens) {
    let line = VLine::new("hovered", at.x)
        .color(tokens.accent.gamma_multiply(0.6))
        .width(1.0);
    plot.vline(line.allow_hover(false));
    if at.is_finite() {
        plot.points(ring(at, tokens));
    }
}

fn mark_vertex(plot: &mut PlotUi<'_>, scene: &PlotScene, points: &[DVec2], tokens: &Tokens) {
    if let Some(vertex) = scene.hovered_vertex
        && let Some(at) = points
            .iter()
            .find(|point| point.x.round() as usize == vertex)
    {
        plot.points(ring(*at, tokens));
    }
}

/// The abscissa under the pointer, if it is over the plot.
fn hovered_x(plot: &PlotUi<'_>) -> Option<f64> {
    let is_over = plot.response().hovered();
    is_over
        .then(|| plot.pointer_coordinate())
        .flatten()
        .map(|point| point.x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(before: (f64, f64), wanted: (f64, f64), dragging: bool, expected: (f64, f64)) {
        let tall = |(low, high): (f64, f64)| (DVec2::new(0.0, low), DVec2::new(1.0, high));
        let mut frame = Frame {
            bounds: Some(tall(before)),
        };
        frame.settle(tall(wanted), dragging);
        assert_eq!(frame.bounds, Some(tall(expected)));
    }

    #[test]
    fn bounds_keep_still_while_dragging_and_settle_afterwards() {
        check((0.0, 10.0), (2.0, 4.0), true, (0.0, 10.0));
        check((0.0, 10.0), (2.0, 14.0), true, (0.0, 14.0));
        check((0.0, 10.0), (2.0, 4.0), false, (2.0, 4.0));
        check((0.0, 10.0), (0.5, 9.8), false, (0.0, 10.0));
    }

    #[test]
    fn nearly_constant_values_look_constant() {
        let points = [DVec2::new(0.0, 0.112), DVec2::new(1.0, 0.112 + 1e-9)];
        let (low, high) = bounds_of(points.into_iter(), false);
        assert!(high.y - low.y > 0.001, "{low} {high}");
    }
}
