//! The plots of curvature and torsion levels, and the logarithmic curvature graph.

use eframe::egui::{Checkbox, Ui};
use egui_plot::{HoverPosition, Plot};
use glam::DVec2;

use super::Plots;
use super::drawing::*;
use super::frame::{most_of, padded, within_reason};
use super::level_names::axis_name;
use crate::analysis::LevelPlot;
use crate::editor::Editor;
use crate::ui::figures;
use crate::ui::theme::{STEP, Tokens};
use crate::ui::widgets;

/// Where the bar leaves less room than this, in points, the switch has a short name.
const NARROW: f32 = 150.0;

impl Plots {
    /// What the bar says of a plot of levels: the switch that normalises, and what is cut off.
    pub(super) fn level_bar_ui(&mut self, ui: &mut Ui, plot: LevelPlot) {
        if plot == LevelPlot::Logarithmic {
            widgets::remark(ui, &self.remark);
            return;
        }
        let remark = std::mem::take(&mut self.remark);
        self.normalised_ui(ui, &remark);
        self.remark = remark;
    }

    /// The switch that scales the curve to length 1, and a remark beside it.
    pub(super) fn normalised_ui(&mut self, ui: &mut Ui, remark: &str) {
        ui.spacing_mut().item_spacing.x = 2.0 * STEP;
        let tooltip = "Show the levels of the curve scaled to length 1, over shares of its length";
        let name = "Normalise length";
        let text = if ui.available_width() < NARROW {
            "1/L"
        } else {
            name
        };
        ui.add(Checkbox::new(&mut self.normalised, text))
            .accessible_name(name)
            .on_hover_text(tooltip);
        widgets::remark(ui, remark);
    }

    pub(super) fn levels_ui(&mut self, ui: &mut Ui, editor: &mut Editor, which: LevelPlot) {
        let tokens = Tokens::of(ui);
        let dragging = editor.hand().is_dragging();
        let normalised = self.normalises(which);
        let scene = editor.view().plots();
        let is_graph = which == LevelPlot::Logarithmic;
        let length = scene.length;
        let extent = if normalised { 1.0 } else { length };
        if scene.levels.iter().all(|point| point.is_nan()) {
            self.remark.clear();
            let text = match which {
                LevelPlot::Torsion(_) if scene.planar => "A planar curve has no torsion.",
                LevelPlot::Logarithmic => "The curvature is constant: there is no graph.",
                _ => "This level is undefined everywhere.",
            };
            widgets::note(ui, text);
            ui.take_available_space();
            return;
        }
        let other = scene.compared.as_deref();
        let other = other.map_or(&[][..], |other| &other.levels);
        let all: Vec<DVec2> = scene.levels.iter().chain(other).copied().collect();
        let (wanted, cut) = if is_graph {
            (most_of(&all), None)
        } else {
            within_reason(&all, noise(which, extent))
        };
        self.remark = match cut {
            _ if is_graph => slope_remark(editor),
            Some((low, high)) => format!(
                "Peaks beyond the plot: {} … {}",
                figures::significant(low, 4),
                figures::significant(high, 4)
            ),
            None => String::new(),
        };
        let mut wanted = wanted;
        if !is_graph {
            wanted.0.x = wanted.0.x.min(0.0);
            wanted.1.x = wanted.1.x.max(extent);
        }
        let frame = self.levels.entry((which, normalised)).or_default();
        let bounds = frame.settle(padded(wanted), dragging);
        let across = match (is_graph, normalised) {
            (true, _) => "log₁₀ ρ",
            (_, true) => "share of the arc length",
            _ => "arc length (units)",
        };
        let upwards = axis_name(which, normalised);
        let marked = scene.hovered_level.filter(|_| !is_graph);
        let plot = plot("levels", across, &upwards, bounds, tokens);
        let hovered = labelled(plot, marked, is_graph)
            .show(ui, |plot| {
                plot.set_plot_bounds(bounds);
                if !is_graph {
                    zero_line(plot, tokens);
                }
                if let Some(before) = &scene.before {
                    before_lines(plot, &before.levels, tokens);
                }
                lines(plot, "compared", other, tokens.joints);
                lines(plot, "level", &scene.levels, tokens.comb);
                if let Some(at) = scene.hovered_level {
                    cursor(plot, at, tokens);
                }
                hovered_x(plot)
            })
            .inner;
        let along = hovered
            .filter(|x| !is_graph && (0.0..=extent).contains(x))
            .map(|x| x * length / extent);
        if let Some(along) = along {
            editor.view_mut().hover_length(along);
        }
    }
}

/// Say how straight the logarithmic graph is on the longest piece of monotone curvature.
fn slope_remark(editor: &Editor) -> String {
    let Some(harmony) = editor.harmony() else {
        return String::new();
    };
    let longest = harmony.longest_slope();
    longest.map_or(String::new(), |piece| {
        let [from, to] = piece.u.map(|u| figures::significant(u, 4));
        let slope = figures::significant(piece.slope, 4);
        let straightness = figures::to_resolution(piece.straightness, 1e-4);
        let of = match harmony.slopes.len() {
            1 => String::new(),
            count => format!(", longest of {count} monotone pieces"),
        };
        format!("Slope α {slope}, R² {straightness} (u {from} … {to}{of})")
    })
}

/// Values below this are rounding: 1e-9 in the unit that the curve's length gives.
fn noise(plot: LevelPlot, length: f64) -> f64 {
    let power = match plot {
        LevelPlot::Curvature(level) | LevelPlot::Torsion(level) => 2 * level as i32 - 1,
        LevelPlot::Logarithmic => 0,
    };
    1e-9 * length.powi(-power)
}

/// Let a plot tell the figures of the place that is marked in it; of the graph, which has none, of
/// the point near the pointer.
fn labelled(plot: Plot<'_>, marked: Option<DVec2>, is_graph: bool) -> Plot<'_> {
    plot.label_formatter(move |hover| {
        let at = match hover {
            HoverPosition::NearDataPoint { position, .. } if is_graph => {
                Some(DVec2::new(position.x, position.y))
            }
            _ => marked.filter(|at| at.is_finite()),
        };
        let at = at?;
        let (x, y) = (figures::significant(at.x, 5), figures::significant(at.y, 6));
        Some(if is_graph {
            format!("log ρ {x}\nlog |ρ ds/dρ| {y}")
        } else {
            format!("{y}\nat {x}")
        })
    })
}
