//! The plots of curvature and torsion levels, and the logarithmic curvature graph.

use eframe::egui::{Checkbox, Shape, Ui};
use egui_plot::{HoverPosition, Plot};
use glam::DVec2;

use super::drawing::*;
use super::frame::{most_of, padded, within_reason};
use super::level_names::{across_name, axis_name};
use super::pane::Pane;
use super::ticks::Scale;
use super::{Plots, area, is_held, peaks};
use crate::analysis::LevelPlot;
use crate::editor::{Editor, PlotFeature};
use crate::ui::action::Action;
use crate::ui::theme::{STEP, Tokens};
use crate::ui::widgets;
use crate::ui::{document_unit, figures};

/// Where the bar leaves less room than this, in points, the switch is left to the plot's menu.
const SWITCH: f32 = 150.0;

/// Where the bar leaves less room than this, in points, nothing of a remark could be read.
const REMARK: f32 = 120.0;

/// How far beyond the others a peak may reach and still be shown, in units of their extent.
const TALLEST: f64 = 4.0;

impl Plots {
    /// The switch that scales the curve to length 1, and a remark beside it, where there is room.
    pub(super) fn normalised_ui(&self, ui: &mut Ui, remark: &str, commands: &mut Vec<Action>) {
        if ui.available_width() < SWITCH {
            return;
        }
        ui.spacing_mut().item_spacing.x = 2.0 * STEP;
        let action = Action::NormaliseLength;
        let mut normalised = self.normalised;
        let switch = ui.add(Checkbox::new(&mut normalised, action.label()));
        if switch.on_hover_text(action.tooltip()).clicked() {
            commands.push(action);
        }
        Self::remark_ui(ui, remark);
    }

    /// Show the remark up to its first semicolon where there is room; a tooltip shows all of it.
    pub(super) fn remark_ui(ui: &mut Ui, remark: &str) {
        if ui.available_width() < REMARK {
            return;
        }
        let short = remark.split(';').next().unwrap_or_default();
        let shown = widgets::remark(ui, short);
        if short != remark {
            shown.on_hover_text(remark);
        }
    }

    pub(super) fn levels_ui(&mut self, ui: &mut Ui, editor: &mut Editor, which: LevelPlot) {
        let tokens = Tokens::of(ui);
        let held = is_held(ui, editor);
        let normalised = self.normalises(which);
        let scene = editor.view().plots();
        let is_graph = which == LevelPlot::Logarithmic;
        let (length, extent) = (scene.length, scene.extent);
        if scene.part.is_none() && scene.series.iter().all(|point| point.is_nan()) {
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
        let other = other.map_or(&[][..], |other| &other.series);
        let all: Vec<DVec2> = scene.series.iter().chain(other).copied().collect();
        let (mut wanted, cut) = if is_graph {
            (most_of(&all), None)
        } else {
            within_reason(&all, noise(which, extent), TALLEST)
        };
        self.remark = match cut {
            _ if is_graph => slope_remark(editor),
            Some(cut) => peaks(cut),
            None => String::new(),
        };
        if !is_graph {
            wanted.0.x = wanted.0.x.min(0.0);
            wanted.1.x = wanted.1.x.max(extent);
        }
        let mut frame = self.frame((which, normalised));
        // The bounds of a part are not those of the whole plot.
        let whole = frame.whole().filter(|_| scene.part.is_some());
        let bounds = frame.settle(whole.unwrap_or(padded(wanted)), held);
        let area = area(ui);
        let pane = Pane::within(area.size(), bounds);
        let [unit, units] = document_unit::names(ui.ctx());
        let across = match is_graph {
            true => format!("radius of curvature ρ ({units})"),
            false => across_name(normalised, units),
        };
        let upwards = axis_name(which, normalised, unit);
        let axes = Axes {
            names: [&across, &upwards],
            scale: match is_graph {
                true => Scale::Logarithmic,
                false => Scale::Even,
            },
            least: f64::MIN,
            numbered: match is_graph {
                true => [f64::MIN, f64::MAX],
                false => [0.0, extent],
            },
        };
        let marked = scene.hovered.filter(|_| !is_graph);
        let near = self.near.and_then(|index| scene.features.get(index));
        let back = ui.painter().add(Shape::Noop);
        let plot = plot("levels", &axes, &pane, tokens);
        let plot = plot.width(area.width()).height(area.height());
        let shown = labelled(plot, marked, near, is_graph).show(ui, |plot| {
            plot.set_plot_bounds(bounds);
            if !is_graph {
                zero_line(plot, tokens);
            }
            if let Some(before) = &scene.before {
                before_lines(plot, &before.series, tokens);
            }
            lines(plot, "compared", other, tokens.joints);
            lines(plot, "level", &scene.series, tokens.comb);
            if let Some(at) = scene.hovered {
                cursor(plot, at, tokens);
            }
            hovered_x(plot)
        });
        let hovered = self.marked(ui, scene, &shown, (back, area), &mut frame);
        let along = hovered
            .filter(|x| !is_graph && (0.0..=extent).contains(x))
            .map(|x| x * length / extent);
        self.levels.insert((which, normalised), frame);
        if !is_graph {
            self.look_closely(ui, editor, &bounds, length / extent);
        }
        if let Some(along) = along {
            editor.view_mut().hover_length(along);
        }
    }
}

/// The slope and straightness of the logarithmic graph on its longest monotone piece.
fn slope_remark(editor: &Editor) -> String {
    let Some(harmony) = editor.sight().harmony() else {
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

/// Label a plot with the figures of the marked place; label the graph, which marks none, with those of
/// the point near the pointer.
fn labelled<'a>(
    plot: Plot<'a>,
    marked: Option<DVec2>,
    near: Option<&'a PlotFeature>,
    is_graph: bool,
) -> Plot<'a> {
    plot.label_formatter(move |hover| {
        if let Some(feature) = near {
            let [x, y] = [feature.at.x, feature.at.y].map(|value| figures::significant(value, 6));
            return Some(format!("{}\n{y}\nat {x}", feature.kind.label()));
        }
        let at = match hover {
            HoverPosition::NearDataPoint { position, .. } if is_graph => {
                Some(DVec2::new(position.x, position.y))
            }
            _ => marked.filter(|at| at.is_finite()),
        };
        let at = at?;
        let at = if is_graph {
            DVec2::new(10f64.powf(at.x), 10f64.powf(at.y))
        } else {
            at
        };
        let (x, y) = (figures::significant(at.x, 5), figures::significant(at.y, 6));
        Some(if is_graph {
            format!("ρ {x}\n|ρ ds/dρ| {y}")
        } else {
            format!("{y}\nat {x}")
        })
    })
}
