//! The polygon's discrete curvature as dots in the plot of curvature.

use eframe::egui::Stroke;
use egui_plot::{HoverPosition, MarkerShape, PlotBounds, PlotPoints, PlotUi, Polygon};
use glam::DVec2;

use super::dots::Dots;
use super::drawing::dots_of;
use super::pane::Pane;
use crate::editor::PlotScene;
use crate::ui::figures;
use crate::ui::theme::Tokens;

/// How far arrows stay from the edge, in points.
const ARROW: f64 = 6.0;

/// The legend of the dots and of the shaded flanks.
pub fn legend(flank: f64) -> &'static str {
    match flank > 0.0 {
        true => {
            "Dots: discrete curvature; one a vertex; arrows: beyond the plot; shaded: beyond the ends"
        }
        false => "Dots: discrete curvature; one a vertex; arrows: beyond the plot",
    }
}

/// The dot or arrow that is hovered, by its place in the series.
pub fn hovered_place(hover: &HoverPosition<'_>, dots: &Dots) -> Option<usize> {
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
pub fn show_dots(
    plot: &mut PlotUi<'_>,
    series: &[DVec2],
    dots: &Dots,
    pane: &Pane,
    tokens: &Tokens,
) {
    if series.is_empty() {
        return;
    }
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
pub fn points_compared(plot: &mut PlotUi<'_>, other: &PlotScene, pane: &Pane, tokens: &Tokens) {
    if !other.series.is_empty() {
        return;
    }
    let series: Vec<DVec2> = other.discrete.iter().map(|(_, at)| *at).collect();
    let inside = Dots::new(&series, pane, None).inside;
    let points: Vec<DVec2> = inside.iter().map(|place| series[*place]).collect();
    let dots = dots_of("points", &points, tokens.joints.gamma_multiply(0.7));
    plot.points(dots.radius(2.0).allow_hover(false));
}

/// The tooltip of a vertex's dot.
pub fn discrete_label(scene: &PlotScene, dot: usize) -> String {
    let Some((vertex, at)) = scene.discrete.get(dot) else {
        return String::new();
    };
    let curvature = figures::significant(at.y, 6);
    let radius = figures::radius_of(at.y, 6);
    let place = if at.x < 0.0 {
        "beyond the start".to_owned()
    } else if at.x > scene.extent {
        "beyond the end".to_owned()
    } else {
        format!("at {}", figures::significant(at.x, 5))
    };
    format!("vertex {vertex}, {place}\ndiscrete κ {curvature}, R {radius}")
}

/// The vertex whose dot is nearest along the axis.
pub fn nearest_dot(scene: &PlotScene, x: f64) -> Option<usize> {
    let dots = scene.discrete.iter();
    let nearest = dots.min_by(|a, b| (a.1.x - x).abs().total_cmp(&(b.1.x - x).abs()));
    nearest.map(|dot| dot.0)
}

/// Shade the plot beyond the curve's ends.
pub fn flanks(plot: &mut PlotUi<'_>, scene: &PlotScene, bounds: PlotBounds, tokens: &Tokens) {
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
