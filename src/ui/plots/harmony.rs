//! The flow of the float S-polygon's vertices as strips, one below the other.

use eframe::egui::{Color32, Rect, Shape, Stroke, Ui, Vec2, vec2};
use egui_plot::{HoverPosition, PlotResponse, PlotUi};
use glam::DVec2;

use super::drawing::*;
use super::frame::bounds_of;
use super::marks::behind;
use super::pane::{BELOW, LEFT, Pane};
use super::ticks::Scale;
use super::{Plots, area, is_held};
use crate::analysis::Flow;
use crate::editor::{Editor, PlotScene};
use crate::ui::figures;
use crate::ui::theme::{self, STEP, Tokens};

/// The room at the left of a strip for its name.
const NAME: f32 = 112.0;

/// The least height of a strip.
const LOWEST: f32 = 24.0;

/// The share of a strip's extent that is kept free above and below, beside that of every plot.
const EDGE: f64 = 0.08;

/// Dots nearer together than the first of these, in points, are smaller, and than the second are
/// not drawn.
const CROWDED: [f32; 2] = [14.0, 6.0];

/// The name of a strip.
fn name(flow: Flow) -> &'static str {
    match flow {
        Flow::Legs => "Leg length",
        Flow::Turns => "Turning angle (°)",
        Flow::Curvatures => "Discrete curvature",
        Flow::TorsionAngles => "Torsion angle (°)",
    }
}

impl Plots {
    pub(super) fn harmony_ui(&mut self, ui: &mut Ui, editor: &mut Editor) {
        let held = is_held(ui, editor);
        let scene = editor.view().plots();
        let mut strips = Flow::ALL.to_vec();
        strips.retain(|flow| *flow != Flow::TorsionAngles || !scene.planar);
        let count = last_vertex(scene) + 1.0;
        let whole = area(ui);
        let (width, height) = (whole.width(), whole.height() - BELOW);
        let height = (height / strips.len() as f32).max(LOWEST);
        // Vertices begin at the right of the strips' names.
        let room = (width - LEFT - NAME).max(1.0);
        let left = -0.5 - f64::from(NAME / room) * count;
        let across = [left, count - 0.5];
        let mut hovered = None;
        let mut moved = None;
        ui.spacing_mut().item_spacing.y = 0.0;
        for flow in &strips {
            let is_last = Some(flow) == strips.last();
            let frame = &mut self.strips[*flow as usize];
            let bounds = frame.settle(wanted(scene, *flow, across), held);
            let below = if is_last { BELOW } else { 0.0 };
            let size = vec2(width, height + below);
            let pane = Pane {
                bounds,
                size: DVec2::new(f64::from(width - LEFT), f64::from(height)),
            };
            let (flow, last) = (*flow, count - 1.0);
            let strip = Strip {
                flow,
                scene,
                pane,
                last,
            };
            let shown = strip.show(ui, size, is_last);
            hovered = shown.inner.or(hovered);
            let area = Rect::from_min_size(ui.min_rect().left_bottom() - vec2(0.0, size.y), size);
            let before = *frame;
            self.navigation
                .navigate(ui, &shown.response, area, &shown.transform, frame);
            if *frame != before {
                moved = Some(*frame);
            }
        }
        // All strips show the same vertices.
        if let Some(moved) = moved {
            for frame in &mut self.strips {
                frame.follow_across(&moved);
                if !moved.is_chosen() {
                    frame.fit();
                }
            }
        }
        let vertex = hovered.map(f64::round);
        if let Some(vertex) = vertex.filter(|x| (0.0..count).contains(x)) {
            editor.view_mut().hover_vertex(vertex as usize);
        }
        // The strips are painted already: they mark it in the next frame.
        if editor.sight().hovered_vertex() != editor.view().plots().hovered_vertex {
            ui.ctx().request_repaint();
        }
    }
}

/// The curves of a strip, from back to front.
fn shown(scene: &PlotScene) -> [Option<&PlotScene>; 3] {
    let (before, compared) = (scene.before.as_deref(), scene.compared.as_deref());
    [before, compared, Some(scene)]
}

/// The greatest number of a vertex in any strip.
fn last_vertex(scene: &PlotScene) -> f64 {
    let all = shown(scene).into_iter().flatten();
    let all = all.flat_map(|scene| &scene.flow);
    let last = all.filter_map(|series| series.last()).map(|point| point.x);
    last.fold(1.0, f64::max) + 1.0
}

/// The bounds that hold all that a strip shows: the same from left to right for all strips.
fn wanted(scene: &PlotScene, flow: Flow, [left, right]: [f64; 2]) -> (DVec2, DVec2) {
    let all = shown(scene).into_iter().flatten();
    let points = all.flat_map(|scene| &scene.flow[flow as usize]).copied();
    let (low, high) = bounds_of(points);
    // Dots and circles at the edge of a low strip are whole.
    let room = EDGE * (high.y - low.y);
    let (low, high) = (low.y - room, high.y + room);
    (DVec2::new(left, low), DVec2::new(right, high))
}

/// One strip as it is drawn.
struct Strip<'a> {
    flow: Flow,
    scene: &'a PlotScene,
    pane: Pane,
    /// The number of the last vertex.
    last: f64,
}

impl Strip<'_> {
    /// Show the strip; returns the abscissa under the pointer.
    fn show(&self, ui: &mut Ui, size: Vec2, with_axis: bool) -> PlotResponse<Option<f64>> {
        let (flow, tokens) = (self.flow, Tokens::of(ui));
        let is_signed = match flow {
            Flow::Legs => false,
            Flow::Turns | Flow::Curvatures => self.scene.planar,
            Flow::TorsionAngles => true,
        };
        let axes = Axes {
            names: [if with_axis { "vertex" } else { "" }, ""],
            scale: Scale::Even,
            least: if is_signed { f64::MIN } else { 0.0 },
            numbered: [0.0, self.last],
        };
        let plot = plot(name(flow), &axes, &self.pane, tokens)
            .width(size.x)
            .height(size.y)
            .show_axes([with_axis, true])
            .y_grid_spacer(|input| Scale::Even.in_strip(input))
            .label_formatter(move |hover| label(flow, hover));
        let back = ui.painter().add(Shape::Noop);
        let shown = plot.show(ui, |plot| {
            plot.set_plot_bounds(self.pane.bounds);
            self.draw(plot, tokens);
            hovered_x(plot)
        });
        let rect = shown.response.rect;
        let painter = ui.painter_at(rect);
        painter.set(back, behind(self.scene, &shown.transform, tokens));
        let edge = Stroke::new(1.0, tokens.axes);
        painter.hline(rect.x_range(), rect.top(), edge);
        let corner = rect.left_top() + vec2(STEP, 0.5 * STEP);
        let font = theme::small_font();
        let galley = painter.layout_no_wrap(name(flow).to_owned(), font, tokens.faint_text);
        let plate = Rect::from_min_size(corner, galley.size());
        painter.rect_filled(plate, 2.0, tokens.panel.gamma_multiply(0.8));
        painter.galley(corner, galley, tokens.faint_text);
        shown
    }

    fn draw(&self, plot: &mut PlotUi<'_>, tokens: &Tokens) {
        let (flow, scene) = (self.flow as usize, self.scene);
        zero_line(plot, tokens);
        if let Some(before) = &scene.before {
            lines(plot, BEFORE, &before.flow[flow], before_colour(tokens));
        }
        if let Some(compared) = &scene.compared {
            self.series(plot, "compared", &compared.flow[flow], tokens.joints);
        }
        self.series(plot, "active", &scene.flow[flow], tokens.float);
        if let Some(at) = scene.worst[flow] {
            plot.points(ring(at, tokens).name("worst").color(tokens.warning));
        }
        if let Some(vertex) = scene.hovered_vertex {
            let number = |point: &&DVec2| point.x.round() as usize == vertex;
            let found = scene.flow[flow].iter().find(number);
            let y = found.map_or(f64::NAN, |point| point.y);
            cursor(plot, DVec2::new(vertex as f64, y), tokens);
        }
    }

    fn series(&self, plot: &mut PlotUi<'_>, name: &str, points: &[DVec2], colour: Color32) {
        lines(plot, name, points, colour.gamma_multiply(0.6));
        // How far two vertices are apart, in points.
        let spacing = 1.0 / self.pane.point().x as f32;
        let radius = if spacing >= CROWDED[0] { 3.0 } else { 2.0 };
        if spacing >= CROWDED[1] {
            plot.points(dots_of(name, points, colour).radius(radius));
        }
    }
}

fn label(flow: Flow, hover: &HoverPosition<'_>) -> Option<String> {
    let HoverPosition::NearDataPoint {
        position: at,
        plot_name,
        ..
    } = hover
    else {
        return None;
    };
    let value = figures::significant(at.y, 6);
    let place = match flow {
        Flow::Legs | Flow::TorsionAngles => format!("leg {} … {}", at.x, at.x + 1.0),
        Flow::Turns | Flow::Curvatures => format!("vertex {}", at.x),
    };
    let is_other = *plot_name == "compared";
    let of = if is_other { ", other curve" } else { "" };
    Some(format!("{place}{of}\n{value}"))
}
