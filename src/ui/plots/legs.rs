//! The plots of leg lengths and turning angles over the vertices.

use eframe::egui::Ui;
use egui_plot::{HoverPosition, PlotUi};
use glam::DVec2;

use super::Plots;
use super::drawing::*;
use super::frame::{bounds_of, padded};
use crate::editor::{Editor, PlotScene};
use crate::ui::figures;
use crate::ui::theme::{STEP, Tokens};

impl Plots {
    pub(super) fn legs_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let tokens = Tokens::of(ui);
        let dragging = editor.hand().is_dragging();
        let scene = editor.view().plots();
        let count = scene.legs.len().max(scene.turns.len()) as f64;
        let width = (0.5 * (ui.available_width() - 2.0 * STEP)).max(80.0);
        let height = ui.available_height();
        let mut hovered = None;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0 * STEP;
            let none = Vec::new();
            let before = scene.before.as_deref();
            let [legs, turns] = [
                before.map_or(&none, |before| &before.legs),
                before.map_or(&none, |before| &before.turns),
            ];
            let series = [
                (
                    "legs",
                    [&scene.legs, legs],
                    "leg length (units)",
                    &mut self.legs,
                ),
                (
                    "turning angles",
                    [&scene.turns, turns],
                    "turning angle (°)",
                    &mut self.turns,
                ),
            ];
            for (name, [points, was], axis, frame) in series {
                let all = points.iter().chain(was).copied();
                let mut wanted = bounds_of(all, name == "legs");
                wanted.0.x = wanted.0.x.min(0.0);
                wanted.1.x = wanted.1.x.max(count - 1.0);
                let bounds = frame.settle(padded(wanted), dragging);
                let plot = plot(name, "vertex", axis, bounds, tokens)
                    .width(width)
                    .height(height);
                let found = plot.label_formatter(vertex_label).show(ui, |plot| {
                    plot.set_plot_bounds(bounds);
                    zero_line(plot, tokens);
                    before_lines(plot, was, tokens);
                    lines(plot, name, points, tokens.float.gamma_multiply(0.6));
                    plot.points(dots_of(name, points, tokens.float));
                    mark_vertex(plot, scene, points, tokens);
                    hovered_x(plot)
                });
                hovered = found.inner.or(hovered);
            }
        });
        let vertex = hovered.map(|x| x.round()).filter(|x| *x >= 0.0);
        if let Some(vertex) = vertex.filter(|x| *x <= count) {
            editor.view_mut().hover_vertex(vertex as usize);
        }
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

fn mark_vertex(plot: &mut PlotUi<'_>, scene: &PlotScene, points: &[DVec2], tokens: &Tokens) {
    if let Some(vertex) = scene.hovered_vertex
        && let Some(at) = points
            .iter()
            .find(|point| point.x.round() as usize == vertex)
    {
        plot.points(ring(*at, tokens));
    }
}
