//! The viewport: orientation, centre and scale of the canvas.

use glam::{DVec2, DVec3};

use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::{Bounds, ViewBox};

/// Screen points left free around a fitted box.
const MARGIN: f64 = 56.0;

/// A view that looks along a plane more than this (the sine of its elevation) shows the plane as
/// hardly more than a line: nothing can be placed in it by hand.
const EDGE_ON: f64 = 0.1;

/// The smallest and largest scale, in screen points a unit.
const SCALES: (f64, f64) = (1e-102, 1e102);

/// Map the model to the view plane, and the view plane (y up) to the canvas (screen points, y
/// down).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// From where the model is seen.
    pub orientation: Orientation,
    /// The view plane's point in the middle of the canvas.
    pub centre: DVec2,
    /// Screen points a unit of the model.
    pub scale: f64,
    /// The canvas's width and height in screen points.
    pub size: DVec2,
}

impl Default for Viewport {
    fn default() -> Self {
        Self {
            orientation: Orientation::default(),
            centre: DVec2::ZERO,
            scale: 20.0,
            size: DVec2::new(800.0, 600.0),
        }
    }
}

impl Viewport {
    /// Map a point of the model to the view plane.
    pub fn flatten(&self, point: DVec3) -> DVec2 {
        self.orientation.flatten(point)
    }

    /// The point of the model seen at a place of the view plane. Along an axis of the model it
    /// lies in the plane of the other two; otherwise in the plane z = 0, unless that is seen from
    /// its edge.
    pub fn grounded(&self, place: DVec2) -> DVec3 {
        self.movement(place, true)
    }

    /// The vector of space by which a vertex moves that is pushed by a vector of the view plane:
    /// within the view plane, the third coordinate is kept. With `keeps_plane`, a view that is
    /// turned against the model keeps z instead, so that planar curves stay planar.
    pub fn movement(&self, by: DVec2, keeps_plane: bool) -> DVec3 {
        let view = &self.orientation;
        if !keeps_plane || view.axes().is_some() || self.is_edge_on() {
            return view.lift(by);
        }
        let (right, up) = (view.right().truncate(), view.up().truncate());
        let determinant = right.perp_dot(up);
        let x = (by.x * up.y - by.y * right.y) / determinant;
        let y = (by.y * right.x - by.x * up.x) / determinant;
        DVec3::new(x, y, 0.0)
    }

    /// Whether the plane z = 0 is seen as hardly more than a line.
    pub fn is_edge_on(&self) -> bool {
        self.orientation.towards().z.abs() < EDGE_ON
    }

    /// The movement along one axis of the model (0 x, 1 y, 2 z) that a push shows; none along an
    /// axis that points to the eye.
    pub fn movement_along(&self, axis: usize, by: DVec2) -> DVec3 {
        let Some(direction) = DVec3::AXES.get(axis).copied() else {
            return DVec3::ZERO;
        };
        let seen = self.flatten(direction);
        if seen.length() < EDGE_ON {
            return DVec3::ZERO;
        }
        direction * (by.dot(seen) / seen.length_squared())
    }

    /// Map a point of the view plane to the canvas.
    pub fn to_screen(&self, point: DVec2) -> DVec2 {
        let offset = (point - self.centre) * self.scale;
        0.5 * self.size + DVec2::new(offset.x, -offset.y)
    }

    /// Map a place on the canvas to the view plane.
    pub fn to_model(&self, place: DVec2) -> DVec2 {
        let offset = (place - 0.5 * self.size) / self.scale;
        self.centre + DVec2::new(offset.x, -offset.y)
    }

    /// The size of a screen point, in units of the model.
    pub fn pixel(&self) -> f64 {
        1.0 / self.scale
    }

    /// The visible part of the view plane.
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

    /// Move the view by some screen points.
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
            ..*self
        }
    }
}
