//! The plots over arc length: curvature with the polygon's discrete curvature, levels of curvature and
//! torsion; and the logarithmic curvature graph.

use eframe::egui::{Checkbox, Color32, Shape, Ui};
use egui_plot::HoverPosition;
use glam::DVec2;

use super::dots::Dots;
use super::drawing::*;
use super::frame::{most_of, padded, within_reason};
use super::level_names::{across_name, axis_name};
use super::pane::Pane;
use super::ticks::Scale;
use super::{Plots, area, discrete, empty_ui, is_held};
use crate::analysis::LevelPlot;
use crate::document::CurveId;
use crate::editor::{Editor, FeatureMark, PlotScene};
use crate::ui::action::Action;
use crate::ui::theme::{STEP, Tokens};
use crate::ui::widgets;
use crate::ui::{document_unit, figures};

/// Where the bar leaves less room than this, in points, the switch is left to the plot's menu.
const SWITCH: f32 = 150.0;

/// Where the bar leaves less room than this, in points, nothing of a remark could be read.
const REMARK: f32 = 120.0;

/// How far beyond the others a peak may reach and still be shown, in units of their extent: of levels,
/// and of the curvature.
const TALLEST: [f64; 2] = [4.0, 20.0];

/// How far beyond the curve dots may reach and still be shown, in units of its extent …
const DOTS: f64 = 0.5;

/// … or of its curvature, for one that is nearly constant.
const DOTS_OF_SIZE: f64 = 0.1;

/// The share of the plot's height that is kept free beyond the outermost dots.
const DOT_ROOM: f64 = 0.06;

impl Plots {
    /// The switch that scales the curve to length 1, and the remark beside it, where there is room.
    pub(super) fn normalised_ui(&self, ui: &mut Ui, commands: &mut Vec<Action>) {
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
        self.remark_ui(ui);
    }

    /// Show the remark up to its first semicolon where there is room; a tooltip shows all of it.
    pub(super) fn remark_ui(&self, ui: &mut Ui) {
        if ui.available_width() < REMARK {
            return;
        }
        let short = self.remark.split(';').next().unwrap_or_default();
        let shown = widgets::remark(ui, short);
        if short != self.remark {
            shown.on_hover_text(&self.remark);
        }
    }

    pub(super) fn levels_ui(&mut self, ui: &mut Ui, editor: &mut Editor, which: LevelPlot) {
        let tokens = Tokens::of(ui);
        let held = is_held(ui, editor);
        let normalised = self.normalises(which);
        let scene = editor.view().plots();
        let is_graph = which == LevelPlot::Logarithmic;
        let is_curvature = which == LevelPlot::CURVATURE;
        let (length, extent) = (scene.length, scene.extent);
        let is_nowhere = scene.series.iter().all(|point| point.is_nan());
        if is_nowhere && scene.part.is_none() && !is_curvature {
            self.remark.clear();
            let text = match which {
                LevelPlot::Torsion(_) if scene.planar => "A planar curve has no torsion.",
                LevelPlot::Logarithmic => "The curvature is constant: there is no graph.",
                _ => "This level is undefined everywhere.",
            };
            return empty_ui(ui, text);
        }
        let (wanted, cut) = wanted(scene, which);
        self.remark = match cut {
            _ if is_graph => slope_remark(editor),
            Some((low, high)) => {
                // A plot is made of samples.
                let [low, high] = [low, high].map(|reach| figures::significant(reach, 2));
                format!("Peaks beyond the plot: about {low} … {high}")
            }
            None if is_curvature && !scene.discrete.is_empty() => {
                discrete::legend(scene.flank).to_owned()
            }
            None => String::new(),
        };
        let mut frame = self.frame((which, normalised));
        // The bounds of a part are not those of the whole plot.
        let whole = frame.whole().filter(|_| scene.part.is_some());
        let bounds = frame.settle(whole.unwrap_or(padded(wanted)), held);
        let area = area(ui);
        let pane = Pane::within(area.size(), bounds);
        let series: Vec<DVec2> = scene.discrete.iter().map(|(_, at)| *at).collect();
        let hovered_dot = scene.hovered_vertex.and_then(|vertex| {
            let mut dots = scene.discrete.iter();
            dots.position(|(index, _)| *index == vertex)
        });
        let dots = Dots::new(&series, &pane, hovered_dot);
        let [unit, units] = document_unit::names(ui.ctx());
        let (across, scale, numbered) = if is_graph {
            let name = format!("radius of curvature ρ ({units})");
            (name, Scale::Logarithmic, [f64::MIN, f64::MAX])
        } else {
            (across_name(normalised, units), Scale::Even, scene.reach())
        };
        let upwards = axis_name(which, scene.planar, normalised, unit);
        let axes = Axes {
            names: [&across, &upwards],
            scale,
            least: if is_curvature && !scene.planar {
                0.0
            } else {
                f64::MIN
            },
            numbered,
        };
        let near = self.near.and_then(|index| scene.features.get(index));
        let back = ui.painter().add(Shape::Noop);
        let plot = plot("levels", &axes, &pane, tokens)
            .width(area.width())
            .height(area.height())
            .label_formatter(|hover| {
                let dot = discrete::hovered_place(hover, &dots).filter(|_| near.is_none());
                match dot {
                    Some(dot) => Some(discrete::discrete_label(scene, dot)),
                    None => label(which, scene.hovered, near, hover),
                }
            });
        let shown = plot.show(ui, |plot| {
            plot.set_plot_bounds(bounds);
            if !is_graph {
                discrete::flanks(plot, scene, bounds, tokens);
                zero_line(plot, tokens);
            }
            if let Some(before) = &scene.before {
                lines(plot, BEFORE, &before.series, before_colour(tokens));
            }
            if let Some(other) = &scene.compared {
                lines(plot, "compared", &other.series, tokens.joints);
                discrete::points_compared(plot, other, &pane, tokens);
            }
            for other in &scene.others {
                lines(
                    plot,
                    "other",
                    &other.series,
                    colour_of(editor, other.id, tokens),
                );
            }
            // Where there are many dots the curve is on top.
            if dots.crowded {
                discrete::show_dots(plot, &series, &dots, &pane, tokens);
            }
            lines(plot, "level", &scene.series, tokens.comb);
            if !dots.crowded {
                discrete::show_dots(plot, &series, &dots, &pane, tokens);
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
        self.levels.insert((which, normalised), frame);
        if is_graph {
            return;
        }
        let nearest = hovered.and_then(|x| discrete::nearest_dot(scene, x));
        self.look_closely(ui, editor, &bounds, length / extent);
        match (hovered, nearest) {
            (Some(x), _) if (0.0..=extent).contains(&x) => {
                editor.view_mut().hover_length(x * length / extent);
            }
            (_, Some(vertex)) => editor.view_mut().hover_vertex(vertex),
            _ => {}
        }
    }
}

/// The colour of a curve or a reference.
fn colour_of(editor: &Editor, id: CurveId, tokens: &Tokens) -> Color32 {
    let document = editor.document();
    let (curve, reference) = (document.curve(id), document.reference(id));
    let own = match reference {
        Some(reference) => reference.colour,
        None => curve.and_then(|curve| curve.colour),
    };
    tokens.of_item(Some(id), own, reference.is_some())
}

/// The bounds that hold the series, and dots near it; if peaks are cut off, also how far they reach.
fn wanted(scene: &PlotScene, which: LevelPlot) -> ((DVec2, DVec2), Option<(f64, f64)>) {
    let is_curvature = which == LevelPlot::CURVATURE;
    let before = scene.before.as_deref().filter(|_| is_curvature);
    let overlaid = [before, scene.compared.as_deref()];
    let overlaid = overlaid.into_iter().flatten().map(|scene| &scene.series);
    let overlaid = overlaid.chain(scene.others.iter().map(|other| &other.series));
    let overlaid = overlaid.flatten();
    let points: Vec<DVec2> = scene.series.iter().chain(overlaid).copied().collect();
    if which == LevelPlot::Logarithmic {
        return (most_of(&points), None);
    }
    let tallest = TALLEST[usize::from(is_curvature)];
    let noise = noise(which, scene.extent.max(f64::MIN_POSITIVE));
    let ((mut low, mut high), cut) = within_reason(&points, noise, tallest);
    let size = low.y.abs().max(high.y.abs());
    let reach = (DOTS * (high.y - low.y)).max(DOTS_OF_SIZE * size);
    let reached = low.y - reach..=high.y + reach;
    let [bottom, top] = [low.y, high.y];
    for (_, dot) in &scene.discrete {
        if reached.contains(&dot.y) {
            low.y = low.y.min(dot.y);
            high.y = high.y.max(dot.y);
        }
    }
    // Dots at the edge are whole.
    let room = DOT_ROOM * (high.y - low.y);
    low.y -= if low.y < bottom { room } else { 0.0 };
    high.y += if high.y > top { room } else { 0.0 };
    low.x = low.x.min(-scene.flank);
    high.x = high.x.max(scene.extent + scene.flank);
    ((low, high), cut)
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

/// The figures of the feature near the pointer, or of the marked place, which is no sample near it. The
/// graph marks no place: its figures are those of the point near the pointer.
fn label(
    which: LevelPlot,
    marked: Option<DVec2>,
    near: Option<&FeatureMark>,
    hover: &HoverPosition<'_>,
) -> Option<String> {
    let kappa = if which == LevelPlot::CURVATURE {
        "κ "
    } else {
        ""
    };
    let figures = |x: f64, y: f64| {
        let radius = match which {
            LevelPlot::CURVATURE => format!(", R {}", figures::radius_of(y, 6)),
            _ => String::new(),
        };
        let y = figures::significant(y, 6);
        (figures::significant(x, 5), y + &radius)
    };
    if let Some(feature) = near {
        let (x, y) = figures(feature.at.x, feature.at.y);
        return Some(format!("{}\n{kappa}{y}\nat {x}", feature.kind.label()));
    }
    if which != LevelPlot::Logarithmic {
        let at = marked.filter(|at| at.is_finite())?;
        let (x, y) = figures(at.x, at.y);
        return Some(format!("{kappa}{y}\nat {x}"));
    }
    let HoverPosition::NearDataPoint { position, .. } = hover else {
        return None;
    };
    let (x, y) = figures(10f64.powf(position.x), 10f64.powf(position.y));
    Some(format!("ρ {x}\n|ρ ds/dρ| {y}"))
}
