//! The plot of curvature over arc length, with the polygon's discrete curvature.

use std::ops::RangeInclusive;

use eframe::egui::{Stroke, Ui};
use egui_plot::{GridMark, HoverPosition, PlotBounds, PlotPoints, PlotUi, Polygon};
use glam::DVec2;

use super::Plots;
use super::drawing::*;
use super::frame::{bounds_of, padded};
use crate::analysis::LevelPlot;
use crate::editor::{Editor, PlotScene};
use crate::ui::figures;
use crate::ui::theme::Tokens;

/// Say what the dots are, and what the shaded flanks hold.
fn legend(flank: f64) -> &'static str {
    if flank > 0.0 {
        "Dots: discrete curvature of the float S-polygon; shaded: vertices beyond the ends, evenly spaced"
    } else {
        "Dots: discrete curvature of the float S-polygon"
    }
}

impl Plots {
    pub(super) fn curvature_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let tokens = Tokens::of(ui);
        let dragging = editor.hand().is_dragging();
        let scene = editor.view().plots();
        self.legend = legend(scene.flank);
        let whole = scene.length;
        let normalised = self.normalised && whole > 0.0;
        let scaled = normalised.then(|| scene.at_length_one());
        let scene = scaled.as_ref().unwrap_or(scene);
        let length = scene.length;
        let dots = scene.discrete.iter().map(|(_, point)| *point);
        let of = |scene: Option<&PlotScene>| scene.map_or(Vec::new(), |it| it.curvature.clone());
        let (was, other) = (of(scene.before.as_deref()), of(scene.compared.as_deref()));
        let points = scene.curvature.iter().chain(&was).chain(&other).copied();
        let mut wanted = bounds_of(points.chain(dots));
        wanted.0.x = wanted.0.x.min(-scene.flank);
        wanted.1.x = wanted.1.x.max(length + scene.flank);
        let frame = self.levels.entry((LevelPlot::Curvature(1), normalised));
        let bounds = frame.or_default().settle(padded(wanted), dragging);
        let signed = match (scene.planar, normalised) {
            (true, false) => "signed curvature κ (1/unit)",
            (false, false) => "curvature κ (1/unit)",
            (true, true) => "signed curvature κ, length 1",
            (false, true) => "curvature κ, length 1",
        };
        let across = if normalised {
            "share of the arc length"
        } else {
            "arc length (units)"
        };
        let numbers = move |mark: GridMark, range: &RangeInclusive<f64>| {
            let on_curve = (-1e-9 * length..=length * (1.0 + 1e-9)).contains(&mark.value);
            if on_curve {
                axis_number(mark, range)
            } else {
                String::new()
            }
        };
        let plot = plot("curvature", across, signed, bounds, tokens)
            .x_axis_formatter(numbers)
            .label_formatter(|hover| {
                if let HoverPosition::NearDataPoint {
                    position,
                    plot_name: "discrete",
                    index,
                } = hover
                {
                    let curvature = figures::significant(position.y, 6);
                    return Some(discrete_label(scene, *index, &curvature));
                }
                // The figures are those of the place that is marked, not of a sample near it.
                let at = scene.hovered?;
                let (x, y) = (figures::significant(at.x, 5), figures::significant(at.y, 6));
                Some(format!("κ {y}\nat {x}"))
            });
        let hovered = plot
            .show(ui, |plot| {
                plot.set_plot_bounds(bounds);
                flanks(plot, scene, bounds, tokens);
                zero_line(plot, tokens);
                before_lines(plot, &was, tokens);
                lines(plot, "compared", &other, tokens.joints);
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
        let beyond = hovered.filter(|x| !(0.0..=length).contains(x));
        let vertex = beyond.and_then(|x| nearest_dot(scene, x));
        let along = hovered.filter(|x| (0.0..=length).contains(x));
        let along = along.map(|x| x * whole / length);
        if let Some(along) = along {
            editor.view_mut().hover_length(along);
        }
        if let Some(vertex) = vertex {
            editor.view_mut().hover_vertex(vertex);
        }
    }
}

/// Say which vertex a dot belongs to.
fn discrete_label(scene: &PlotScene, dot: usize, curvature: &str) -> String {
    let Some((vertex, at)) = scene.discrete.get(dot) else {
        return format!("discrete κ {curvature}");
    };
    let place = if at.x < 0.0 {
        "beyond the start".to_owned()
    } else if at.x > scene.length {
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

/// Shade what lies beyond the curve's ends.
fn flanks(plot: &mut PlotUi<'_>, scene: &PlotScene, bounds: PlotBounds, tokens: &Tokens) {
    if !(scene.flank > 0.0) {
        return;
    }
    let ([left, bottom], [right, top]) = (bounds.min(), bounds.max());
    for (from, to) in [(left, 0.0), (scene.length, right)] {
        let corners = [[from, bottom], [to, bottom], [to, top], [from, top]];
        let shade = Polygon::new("flank", PlotPoints::from_iter(corners))
            .fill_color(tokens.grid_major.gamma_multiply(0.35))
            .stroke(Stroke::NONE)
            .allow_hover(false);
        plot.polygon(shade);
    }
}
