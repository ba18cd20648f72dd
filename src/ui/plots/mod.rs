//! The plots under the canvas: curvature over arc length, and the polygon's legs and turns.

mod curvature;
mod drawing;
mod frame;
mod legs;

use eframe::egui::{Button, Ui};
use lucide_icons::Icon;

use super::theme::STEP;
use super::widgets::{self, IconButton};
use crate::editor::{Command, Editor};
use frame::Frame;

/// The height of the bar with the tabs.
pub const BAR: f32 = 32.0;

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
    legend: &'static str,
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
                    widgets::caption(ui, self.legend);
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
}
