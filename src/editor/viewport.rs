//! The part of the plane that the canvas shows.

use glam::DVec2;

use crate::analysis::{Bounds, ViewBox};

/// Screen points left free around what is fitted.
const MARGIN: f64 = 56.0;

/// The smallest and largest scale, in screen points a unit.
const SCALES: (f64, f64) = (1e-12, 1e12);

/// Map the model's plane (y up) to the canvas (screen points, y down).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// The model point in the middle of the canvas.
    pub centre: DVec2,
    /// Screen points a unit of the model.
    pub scale: f64,
    /// The canvas's width and height in screen points.
    pub size: DVec2,
}

impl Default for Viewport {
    fn default() -> Self {
        Self {
            centre: DVec2::ZERO,
            scale: 20.0,
            size: DVec2::new(800.0, 600.0),
        }
    }
}

impl Viewport {
    /// Map a model point to the canvas.
    pub fn to_screen(&self, point: DVec2) -> DVec2 {
        let offset = (point - self.centre) * self.scale;
        0.5 * self.size + DVec2::new(offset.x, -offset.y)
    }

    /// Map a place on the canvas to the model.
    pub fn to_model(&self, place: DVec2) -> DVec2 {
        let offset = (place - 0.5 * self.size) / self.scale;
        self.centre + DVec2::new(offset.x, -offset.y)
    }

    /// The size of a screen point, in units of the model.
    pub fn pixel(&self) -> f64 {
        1.0 / self.scale
    }

    /// What is visible.
    pub fn view_box(&self) -> ViewBox {
        let half = 0.5 * self.size / self.scale;
        ViewBox {
            low: self.centre - half,
            high: self.centre + half,
            pixel: self.pixel(),
        }
    }

    /// Scale by `factor` about a place on the canvas, which keeps its model point.
    pub fn zoom(&mut self, place: DVec2, factor: f64) {
        if !(factor > 0.0 && factor.is_finite()) {
            return;
        }
        let fixed = self.to_model(place);
        self.scale = (self.scale * factor).clamp(SCALES.0, SCALES.1);
        self.centre += fixed - self.to_model(place);
    }

    /// Push what is shown by some screen points.
    pub fn pan(&mut self, by: DVec2) {
        let moved = DVec2::new(-by.x, by.y) / self.scale;
        if moved.is_finite() {
            self.centre += moved;
        }
    }

    /// The viewport that shows all of a box with a margin; a box without extent is centred at
    /// the present scale.
    pub fn fitted(&self, bounds: &Bounds) -> Self {
        if bounds.is_empty() {
            return *self;
        }
        let extent = bounds.high - bounds.low;
        let free = (self.size - 2.0 * MARGIN).max(0.25 * self.size);
        let ratio = free / extent;
        let scale = if extent.max_element() > 0.0 {
            ratio.min_element()
        } else {
            self.scale
        };
        Self {
            centre: 0.5 * (bounds.low + bounds.high),
            scale: scale.clamp(SCALES.0, SCALES.1),
            size: self.size,
        }
    }
}
