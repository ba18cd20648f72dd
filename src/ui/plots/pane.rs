//! The part of a window in which a plot's values are drawn.

use eframe::egui::Vec2;
use egui_plot::PlotBounds;
use glam::DVec2;

/// The room at the left of every plot for its numbers and the axis name, in points.
pub const LEFT: f32 = 76.0;

/// The room below a plot for its numbers and the axis name, in points.
pub const BELOW: f32 = 38.0;

/// The room at the right of a plot, for the half of its last number, in points.
pub const RIGHT: f32 = 16.0;

/// The bounds and the size of a plot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pane {
    /// The values at its edges.
    pub bounds: PlotBounds,
    /// Its width and height in points.
    pub size: DVec2,
}

impl Pane {
    /// The pane of a plot that takes a whole area, with its numbers at the left and below.
    pub fn within(area: Vec2, bounds: PlotBounds) -> Self {
        let size = DVec2::new(f64::from(area.x - LEFT), f64::from(area.y - BELOW));
        let size = size.max(DVec2::ONE);
        Self { bounds, size }
    }

    /// The lowest and the highest values.
    pub fn corners(&self) -> [DVec2; 2] {
        [self.bounds.min(), self.bounds.max()].map(DVec2::from_array)
    }

    /// Where values are, in points from the lower left corner.
    pub fn place(&self, at: DVec2) -> DVec2 {
        let [low, high] = self.corners();
        (at - low) / (high - low) * self.size
    }

    /// The extent of one point, in values.
    pub fn point(&self) -> DVec2 {
        let [low, high] = self.corners();
        (high - low) / self.size.max(DVec2::ONE)
    }
}
