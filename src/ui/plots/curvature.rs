//! The plot of curvature over arc length, with the polygon's discrete curvature.

use eframe::egui::{Shape, Stroke, Ui};
use egui_plot::{HoverPosition, MarkerShape, PlotBounds, PlotPoints, PlotUi, Polygon};
use glam::DVec2;

use super::dots::Dots;
use super::drawing::*;
use super::frame::{padded, within_reason};
use super::level_names::across_name;
use super::pane::Pane;
use super::ticks::Scale;
use super::{Plots, area, is_held, peaks};
use crate::analysis::LevelPlot;
use crate::editor::{Editor, PlotFeature, PlotScene};
use crate::ui::theme::Tokens;
use crate::ui::{document_unit, figures};

/// How far beyond the rest of the curve a peak may reach and still be shown, in units of the
/// extent of the rest.
const TALLEST: f64 = 20.0;

/// How far beyond the curve dots may reach and still be shown, in units of its extent …
const DOTS: f64 = 0.5;

/// … or of its curvature, for one that is nearly constant.
const DOTS_OF_SIZE: f64 = 0.1;

/// The share of the plot's height that is kept free beyond the outermost dots.
const DOT_ROOM: f64 = 0.06;

/// How far arrows stay from the edge, in points.
const ARROW: f64 = 6.0;

/// Curvatures that differ by less than this, times the length of the curve, look constant.
const ROUNDING: f64 = 1e-9;

/// The legend of the dots and of the shaded flanks.
fn legend(flank: f64) -> &'static str {
    if flank > 0.0 {
        "Dots: discrete curvature; one for each float vertex; arrows: beyond the plot; shaded: beyond the ends"
    } else {
        "Dots: discrete curvature; one for each float vertex; arrows: beyond the plot"
    }
}

impl Plots {
    pub(super) fn curvature_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let tokens = Tokens::of(ui);
        let held = is_held(ui, editor);
        let scene = editor.view().plots();
        let (whole, length, normalised) = (scene.length, scene.extent, self.normalised);
        let (wanted, cut) = wanted(scene);
        if scene.part.is_none() {
            self.legend = cut.map_or_else(|| legend(scene.flank).to_owned(), peaks);
        }
        let mut frame = self.frame((LevelPlot::Curvature(1), normalised));
        // The bounds of a part are not those of the whole plot.
        let whole_plot = frame.whole().filter(|_| scene.part.is_some());
        let bounds = frame.settle(whole_plot.unwrap_or(padded(wanted)), held);
        let area = area(ui);
        let pane = Pane::within(area.size(), bounds);
        let series: Vec<DVec2> = scene.discrete.iter().map(|(_, at)| *at).collect();
        let hovered_dot = scene.hovered_vertex.and_then(|vertex| {
            let mut dots = scene.discrete.iter();
            dots.position(|(index, _)| *index == vertex)
        });
        let dots = Dots::new(&series, &pane, hovered_dot);
        let [unit, units] = document_unit::names(ui.ctx());
        let across = across_name(normalised, units);
        let upwards = upwards_name(scene.planar, normalised, unit);
        let axes = Axes {
            names: [&across, &upwards],
            scale: Scale::Even,
            least: if scene.planar { f64::MIN } else { 0.0 },
            numbered: [0.0, length],
        };
        let near = self.near.and_then(|index| scene.features.get(index));
        let back = ui.painter().add(Shape::Noop);
        let plot = plot("curvature", &axes, &pane, tokens)
            .width(area.width())
            .height(area.height())
            .label_formatter(|hover| {
                if let Some(feature) = near {
                    return Some(feature_label(feature));
                }
                if let Some(dot) = hovered_place(hover, &dots) {
                    return Some(discrete_label(scene, dot));
                }
                // The figures are those of the place that is marked, not of a sample near it.
                let at = scene.hovered?;
                let (x, y) = (figures::significant(at.x, 5), figures::significant(at.y, 6));
                Some(format!("κ {y}\nat {x}"))
            });
        let shown = plot.show(ui, |plot| {
            plot.set_plot_bounds(bounds);
            flanks(plot, scene, bounds, tokens);
            zero_line(plot, tokens);
            if let Some(before) = &scene.before {
                before_lines(plot, &before.series, tokens);
            }
            if let Some(other) = &scene.compared {
                lines(plot, "compared", &other.series, tokens.joints);
                points_compared(plot, other, &pane, tokens);
            }
            // Where there are many dots the curve is on top.
            if dots.crowded {
                show_dots(plot, &series, &dots, &pane, tokens);
            }
            lines(plot, "curvature", &scene.series, tokens.comb);
            if !dots.crowded {
                show_dots(plot, &series, &dots, &pane, tokens);
            }
            if let Some(at) = scene.hovered {
                cursor(plot, at, tokens);
            }
            if let Some(at) = hovered_dot.and_then(|dot| series.get(dot)) {
                let [low, high] = pane.corners();
                plot.points(ring(at.clamp(low, high), tokens));
            }
            hovered_x(plot)
        });
        let hovered = self.marked(ui, scene, &shown, (back, area), &mut frame);
        let beyond = hovered.filter(|x| !(0.0..=length).contains(x));
        let vertex = beyond.and_then(|x| nearest_dot(scene, x));
        let along = hovered.filter(|x| (0.0..=length).contains(x));
        let along = along.map(|x| x * whole / length);
        self.levels
            .insert((LevelPlot::Curvature(1), normalised), frame);
        self.look_closely(ui, editor, &bounds, whole / length);
        if let Some(along) = along {
            editor.view_mut().hover_length(along);
        }
        if let Some(vertex) = vertex {
            editor.view_mut().hover_vertex(vertex);
        }
    }
}

/// The bounds that hold the curve, and dots near it; if peaks of the curve are cut off, also how far
/// they reach.
fn wanted(scene: &PlotScene) -> ((DVec2, DVec2), Option<(f64, f64)>) {
    let overlaid = [scene.before.as_deref(), scene.compared.as_deref()];
    let overlaid = overlaid.into_iter().flatten();
    let overlaid = overlaid.flat_map(|scene| &scene.series);
    let points: Vec<DVec2> = scene.series.iter().chain(overlaid).copied().collect();
    let noise = ROUNDING / scene.extent.max(f64::MIN_POSITIVE);
    let ((mut low, mut high), cut) = within_reason(&points, noise, TALLEST);
    let size = low.y.abs().max(high.y.abs());
    let reach = (DOTS * (high.y - low.y)).max(DOTS_OF_SIZE * size);
    let reached = low.y - reach..=high.y + reach;
    let near = scene.discrete.iter().map(|(_, dot)| dot.y);
    let near: Vec<f64> = near.filter(|y| reached.contains(y)).collect();
    let [bottom, top] = [low.y, high.y];
    for y in near {
        low.y = low.y.min(y);
        high.y = high.y.max(y);
    }
    // Dots at the edge are whole.
    let room = DOT_ROOM * (high.y - low.y);
    low.y -= if low.y < bottom { room } else { 0.0 };
    high.y += if high.y > top { room } else { 0.0 };
    low.x = low.x.min(-scene.flank);
    high.x = high.x.max(scene.extent + scene.flank);
    ((low, high), cut)
}

fn upwards_name(planar: bool, normalised: bool, unit: &str) -> String {
    let name = if planar { "signed κ" } else { "κ" };
    match normalised {
        true => format!("{name}, length 1"),
        false => format!("{name} (1/{unit})"),
    }
}

/// The dot or arrow that is hovered, by its place in the series.
fn hovered_place(hover: &HoverPosition<'_>, dots: &Dots) -> Option<usize> {
    let HoverPosition::NearDataPoint {
        plot_name, index, ..
    } = hover
    else {
        return None;
    };
    let places = match *plot_name {
        "discrete" => &dots.inside,
        "above" => &dots.above,
        "below" => &dots.below,
        _ => return None,
    };
    places.get(*index).copied()
}

/// Show the dots, and arrows at the edges for those beyond.
fn show_dots(plot: &mut PlotUi<'_>, series: &[DVec2], dots: &Dots, pane: &Pane, tokens: &Tokens) {
    let [low, high] = pane.corners();
    let edge = ARROW * pane.point().y;
    let at = |places: &[usize]| -> Vec<DVec2> {
        let points = places.iter().filter_map(|place| series.get(*place));
        points.copied().collect()
    };
    let radius = if dots.crowded { 2.0 } else { 3.0 };
    let inside = dots_of("discrete", &at(&dots.inside), tokens.float);
    plot.points(inside.radius(radius));
    for (name, places, y, shape) in [
        ("above", &dots.above, high.y - edge, MarkerShape::Up),
        ("below", &dots.below, low.y + edge, MarkerShape::Down),
    ] {
        let points: Vec<DVec2> = at(places).iter().map(|at| DVec2::new(at.x, y)).collect();
        let arrows = dots_of(name, &points, tokens.float);
        plot.points(arrows.shape(shape).radius(4.0));
    }
}

/// Show the discrete curvature of points that a curve is compared with, as far as there is room.
fn points_compared(plot: &mut PlotUi<'_>, other: &PlotScene, pane: &Pane, tokens: &Tokens) {
    if !other.series.is_empty() {
        return;
    }
    let series: Vec<DVec2> = other.discrete.iter().map(|(_, at)| *at).collect();
    let inside = Dots::new(&series, pane, None).inside;
    let points: Vec<DVec2> = inside.iter().map(|place| series[*place]).collect();
    let dots = dots_of("points", &points, tokens.joints.gamma_multiply(0.7));
    plot.points(dots.radius(2.0).allow_hover(false));
}

/// The tooltip of a feature's glyph.
fn feature_label(feature: &PlotFeature) -> String {
    let (x, y) = (
        figures::significant(feature.at.x, 5),
        figures::significant(feature.at.y, 6),
    );
    format!("{}\nκ {y}\nat {x}", feature.kind.label())
}

/// The tooltip of a vertex's dot.
fn discrete_label(scene: &PlotScene, dot: usize) -> String {
    let Some((vertex, at)) = scene.discrete.get(dot) else {
        return String::new();
    };
    let curvature = figures::significant(at.y, 6);
    let place = if at.x < 0.0 {
        "beyond the start".to_owned()
    } else if at.x > scene.extent {
        "beyond the end".to_owned()
    } else {
        format!("at {}", figures::significant(at.x, 5))
    };
    format!("vertex {vertex}, {place}\ndiscrete κ {curvature}")
}

/// The vertex whose dot is nearest along the axis.
fn nearest_dot(scene: &PlotScene, x: f64) -> Option<usize> {
    let distance = |dot: &&(usize, DVec2)| (dot.1.x - x).abs();
    let nearest = |a: &&(usize, DVec2), b: &&(usize, DVec2)| distance(a).total_cmp(&distance(b));
    scene.discrete.iter().min_by(nearest).map(|dot| dot.0)
}

/// Shade the plot beyond the curve's ends.
fn flanks(plot: &mut PlotUi<'_>, scene: &PlotScene, bounds: PlotBounds, tokens: &Tokens) {
    if !(scene.flank > 0.0) {
        return;
    }
    let ([left, bottom], [right, top]) = (bounds.min(), bounds.max());
    for (from, to) in [(left, 0.0), (scene.extent, right)] {
        let corners = [[from, bottom], [to, bottom], [to, top], [from, top]];
        let shade = Polygon::new("flank", PlotPoints::from_iter(corners))
            .fill_color(tokens.grid_major.gamma_multiply(0.35))
            .stroke(Stroke::NONE)
            .allow_hover(false);
        plot.polygon(shade);
    }
}
