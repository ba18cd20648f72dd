//! The plots under the canvas: curvature over arc length, and the flow of the polygon's vertices.

mod compare;
mod discrete;
mod dots;
mod drawing;
mod frame;
mod harmony;
mod level_names;
mod levels;
mod marks;
mod navigation;
mod pane;
mod ticks;

pub use compare::{choice_ui as compare_choice_ui, others};

use std::collections::HashMap;

use eframe::egui::layers::ShapeIdx;
use eframe::egui::{Button, Context, Rect, Ui};
use egui_plot::{PlotBounds, PlotResponse};
use lucide_icons::Icon;

use super::theme::{STEP, Tokens};
use super::widgets::{self, IconButton};
use crate::analysis::{Flow, LevelPlot};
use crate::document::CurveId;
use crate::editor::{Editor, MenuSubject, PlotKind, PlotScene};
use crate::geometry::LEVELS;
use crate::ui::action::Action;
use crate::ui::keyboard::{is_covered, with_key};
use compare::compare_ui;
use frame::Frame;
use level_names::{explanation, tab_name};
use navigation::Navigation;
use pane::RIGHT;

/// The height of the bar with the tabs.
pub const BAR: f32 = 32.0;

/// A bar with less room than this for each tab gives them short names.
const SHORT: f32 = 105.0;

/// Which plots are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tab {
    /// A level of curvature or torsion, or the logarithmic graph.
    Levels(LevelPlot),
    /// The flow of the polygon's vertices, in strips.
    Harmony,
}

impl Tab {
    /// Curvature over arc length.
    pub const CURVATURE: Self = Self::Levels(LevelPlot::CURVATURE);
}

impl Default for Tab {
    fn default() -> Self {
        Self::CURVATURE
    }
}

/// The label of a tab; `short` where there is little room.
fn name(tab: Tab, short: bool) -> String {
    match tab {
        Tab::Levels(plot) => tab_name(plot, short),
        Tab::Harmony => "Harmony".to_owned(),
    }
}

/// The tooltip of the strips.
const STRIPS: &str =
    "Leg lengths, angles and discrete curvature over the vertices; circles: least even";

/// The plots' own state: their bounds, which keep still while the curve is dragged.
#[derive(Default)]
pub struct Plots {
    /// The tab in front.
    pub tab: Tab,
    strips: [Frame; Flow::ALL.len()],
    /// The legend of the plot in front, or the reach of its peaks.
    remark: String,
    /// Whether levels are those of the curve scaled to length 1.
    pub normalised: bool,
    levels: HashMap<(LevelPlot, bool), Frame>,
    /// The feature whose glyph the pointer is near, by its place in the plot's list.
    near: Option<usize>,
    /// How the pointer zooms and pans.
    pub navigation: Navigation,
    /// Where the plot in front was in the last frame, without its bar.
    rect: Option<Rect>,
    /// Whose plots they are.
    shown_of: Option<CurveId>,
}

/// Whether the plots keep still: while something is dragged, on the canvas or in a panel.
fn is_held(ui: &Ui, editor: &Editor) -> bool {
    let is_down = ui.input(|input| input.pointer.any_down());
    editor.hand().is_dragging() || is_down && editor.workspace().preview().is_some()
}

/// A part of a plot is looked at closely if it is less than this share of the whole …
const CLOSE: f64 = 0.4;

/// … with as much again at either side, until less than this share of it is seen.
const STALE: f64 = 0.15;

/// The part of a curve, between two arc lengths, to look at closely when a range of it is seen: the
/// one that is known as long as it does.
fn close_part(known: Option<[f64; 2]>, [from, to]: [f64; 2], length: f64) -> Option<[f64; 2]> {
    let extent = to - from;
    // Beside the curve stand others of its chain.
    let is_beside = to <= 0.0 || from >= length;
    if is_beside || !(extent < CLOSE * length) {
        return None;
    }
    let does = |[first, last]: &[f64; 2]| {
        let holds = *first <= from.max(0.0) && *last >= to.min(length);
        holds && extent >= STALE * (last - first)
    };
    let part = || [(from - extent).max(0.0), (to + extent).min(length)];
    known.filter(does).or_else(|| Some(part()))
}

/// Show a text in place of a plot; the panel keeps its height.
fn empty_ui(ui: &mut Ui, text: &str) {
    widgets::note(ui, text);
    ui.take_available_space();
}

/// The status bar's hint over a plot.
const HINT: &str = "Wheel zooms, drag pans, double-click fits; right-click for more";

/// The area of a plot with its numbers.
fn area(ui: &Ui) -> Rect {
    let whole = ui.available_rect_before_wrap();
    whole.with_max_x((whole.right() - RIGHT).max(whole.left()))
}

impl Plots {
    /// Add the canvas's marks to a plot that was drawn, `back` behind its lines, and let the user zoom and
    /// pan it. Returns the hovered abscissa.
    fn marked(
        &mut self,
        ui: &Ui,
        scene: &PlotScene,
        shown: &PlotResponse<Option<f64>>,
        (back, area): (ShapeIdx, Rect),
        frame: &mut Frame,
    ) -> Option<f64> {
        let tokens = Tokens::of(ui);
        let transform = &shown.transform;
        let painter = ui.painter_at(*transform.frame());
        painter.set(back, marks::behind(scene, transform, tokens));
        let pointer = shown.response.hover_pos();
        let near = marks::features(&painter, scene, transform, pointer, tokens);
        marks::legend(&painter, scene, transform.frame(), tokens);
        self.navigation
            .navigate(ui, &shown.response, area, transform, frame);
        if self.near != near {
            self.near = near;
            ui.ctx().request_repaint();
        }
        // A hovered glyph is marked at its own place.
        let feature = near.and_then(|index| scene.features.get(index));
        feature.map_or(shown.inner, |feature| Some(feature.at.x))
    }
}

impl Plots {
    /// The frame of a plot over arc length, or of the graph.
    fn frame(&self, of: (LevelPlot, bool)) -> Frame {
        self.levels.get(&of).copied().unwrap_or_default()
    }

    /// Show all of the plot in front again.
    pub fn fit(&mut self) {
        match self.frame_key() {
            Some(key) => self.levels.entry(key).or_default().fit(),
            None => self.strips.iter_mut().for_each(Frame::fit),
        }
    }

    /// Whether the user has zoomed or moved the plot in front.
    fn is_moved(&self) -> bool {
        match self.frame_key() {
            Some(key) => self.frame(key).is_chosen(),
            None => self.strips.iter().any(Frame::is_chosen),
        }
    }

    /// Under which key the frame of the plot in front is kept; `None` for the strips.
    fn frame_key(&self) -> Option<(LevelPlot, bool)> {
        match self.tab {
            Tab::Levels(plot) => Some((plot, self.normalises(plot))),
            Tab::Harmony => None,
        }
    }

    /// The status bar's hint while the pointer is over a plot.
    pub fn hint(&self, context: &Context) -> Option<&'static str> {
        let pointer = context.pointer_hover_pos()?;
        let is_over = self.rect?.contains(pointer) && !is_covered(context);
        is_over.then_some(HINT)
    }

    /// Forget the zoom of another curve.
    fn follow_active(&mut self, editor: &Editor) {
        let active = editor.active();
        if self.shown_of != active {
            self.shown_of = active;
            self.levels.clear();
            self.strips = Default::default();
        }
    }

    /// Sample the visible part of the active curve more finely; `scale` is the number of its units in one of
    /// the plot's.
    fn look_closely(&self, ui: &Ui, editor: &mut Editor, bounds: &PlotBounds, scale: f64) {
        let plots = editor.view().plots();
        let seen = [bounds.min()[0], bounds.max()[0]].map(|x| x * scale);
        let part = close_part(plots.part, seen, plots.length);
        if part != plots.part {
            editor.view_mut().plot_part = part;
            ui.ctx().request_repaint();
        }
    }

    /// The tabs that the active curve has: a planar one has no torsion.
    fn tabs(&self, editor: &Editor) -> Vec<Tab> {
        let mut tabs = vec![Tab::Harmony];
        tabs.extend((1..=LEVELS).map(|level| Tab::Levels(LevelPlot::Curvature(level))));
        let is_own = |tab: &Tab| self.tab == *tab;
        let torsion = (1..=LEVELS).map(|level| Tab::Levels(LevelPlot::Torsion(level)));
        let planar = editor.active().and_then(|id| editor.sight().is_planar(id));
        let has_torsion = planar == Some(false);
        tabs.extend(torsion.filter(|tab| has_torsion || is_own(tab)));
        tabs.push(Tab::Levels(LevelPlot::Logarithmic));
        // The polygon's own plots come last.
        tabs.rotate_left(1);
        tabs
    }

    /// Show the bar with the tabs and the button that folds the plots.
    pub fn bar_ui(
        &mut self,
        ui: &mut Ui,
        editor: &mut Editor,
        shown: bool,
        commands: &mut Vec<Action>,
    ) {
        if !shown {
            self.rect = None;
        }
        ui.horizontal_centered(|ui| {
            ui.spacing_mut().item_spacing.x = STEP;
            let tabs = self.tabs(editor);
            let short = ui.available_width() < SHORT * tabs.len() as f32;
            for tab in tabs {
                let button = Button::selectable(shown && self.tab == tab, name(tab, short));
                // The inspector has a section of harmony too.
                let (name, tooltip) = match tab {
                    Tab::Levels(plot) => (tab_name(plot, false), explanation(plot)),
                    Tab::Harmony => ("Harmony strips".to_owned(), STRIPS.to_owned()),
                };
                let response = ui.add(button).accessible_name(name);
                if response.on_hover_text(tooltip).clicked() {
                    self.tab = tab;
                    if !shown {
                        commands.push(Action::TogglePlots);
                    }
                }
            }
            widgets::at_right(ui, |ui| {
                let (icon, name) = match shown {
                    true => (Icon::ChevronDown, "Collapse plots"),
                    false => (Icon::ChevronUp, "Expand plots"),
                };
                if IconButton::new(icon, name).show(ui).clicked() {
                    commands.push(Action::TogglePlots);
                }
                if shown {
                    let tooltip = with_key(&Action::FitPlot.tooltip(), Action::FitPlot.shortcut());
                    let fit = IconButton::new(Icon::Maximize, "Fit the plot").tooltip(tooltip);
                    if fit.enabled(self.is_moved()).show(ui).clicked() {
                        commands.push(Action::FitPlot);
                    }
                    let more = IconButton::new(Icon::Ellipsis, "Plot menu");
                    if more.show(ui).clicked() {
                        editor.hand_mut().ask_for_menu(MenuSubject::Plot);
                    }
                    compare_ui(ui, editor);
                }
                match self.tab {
                    Tab::Levels(LevelPlot::Logarithmic) if shown => self.remark_ui(ui),
                    Tab::Levels(_) if shown => self.normalised_ui(ui, commands),
                    _ => {}
                }
            });
        });
    }

    /// The kind of plot of the tab in front.
    fn kind(&self) -> PlotKind {
        match self.tab {
            Tab::Levels(plot) => PlotKind::Levels {
                plot,
                normalised: self.normalises(plot),
            },
            Tab::Harmony => PlotKind::Harmony,
        }
    }

    /// Whether a plot of levels is that of the curve scaled to length 1: the graph does not depend on
    /// its size.
    fn normalises(&self, plot: LevelPlot) -> bool {
        self.normalised && plot != LevelPlot::Logarithmic
    }

    /// Show the plots of the tab in front.
    pub fn show(&mut self, ui: &mut Ui, editor: &mut Editor) {
        self.rect = None;
        let Some(active) = editor.active() else {
            return empty_ui(ui, "Select a curve to see its plots.");
        };
        if let Some(reference) = editor.document().reference(active) {
            if self.tab == Tab::Harmony {
                return empty_ui(ui, "A reference has no S-polygon to plot.");
            }
            if !reference.curve.form().is_smooth() {
                let text = match reference.picture {
                    Some(_) => "A picture has no curvature. Trace it to see the plots of a curve.",
                    None => "Points have no curvature. Fit a curve to them to see its plots.",
                };
                return empty_ui(ui, text);
            }
        }
        self.rect = Some(ui.available_rect_before_wrap());
        self.follow_active(editor);
        let kind = self.kind();
        if editor.view().plot != Some(kind) {
            editor.view_mut().plot = Some(kind);
            editor.refresh();
        }
        match self.tab {
            Tab::Levels(plot) => self.levels_ui(ui, editor, plot),
            Tab::Harmony => self.harmony_ui(ui, editor),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::close_part;

    #[test]
    fn a_part_is_looked_at_closely_until_it_does_no_longer() {
        let length = 100.0;
        for seen in [[-2.0, 102.0], [-20.0, -10.0], [100.0, 110.0]] {
            assert_eq!(close_part(None, seen, length), None);
        }
        let part = close_part(None, [20.0, 30.0], length);
        assert_eq!(part, Some([10.0, 40.0]));
        for seen in [[11.0, 21.0], [28.0, 39.0], [20.0, 25.0]] {
            assert_eq!(close_part(part, seen, length), part);
        }
        assert_eq!(close_part(part, [9.0, 19.0], length), Some([0.0, 29.0]));
        assert_eq!(close_part(part, [20.0, 22.0], length), Some([18.0, 24.0]));
        assert_eq!(close_part(part, [0.0, 60.0], length), None);
        let end = close_part(None, [95.0, 105.0], length);
        assert_eq!(end, Some([85.0, 100.0]));
        assert_eq!(close_part(end, [94.0, 104.0], length), end);
    }
}
