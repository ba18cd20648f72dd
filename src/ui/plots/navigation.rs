//! Zooming and panning of a plot.

use eframe::egui::{CursorIcon, PointerButton, Pos2, Rect, Response, Ui, Vec2};
use egui_plot::PlotTransform;
use glam::DVec2;

use super::frame::Frame;
use crate::ui::canvas::WHEEL_POINTS;

/// The pointer's state between frames.
#[derive(Clone, Copy, Debug, Default)]
pub struct Navigation {
    /// Whether fingers on a touchpad turn the wheel: they move a plot.
    pub fingers: bool,
    /// The place of the plot that is dragged.
    grabbed: Option<DVec2>,
}

impl Navigation {
    /// Zoom and pan by the pointer: the wheel zooms to the pointer, with Shift or below
    /// the plot only across, at its left only upwards; a drag moves it; a double click shows all of
    /// it. `area` is the plot with its numbers.
    pub fn navigate(
        &mut self,
        ui: &Ui,
        plot: &Response,
        area: Rect,
        transform: &PlotTransform,
        frame: &mut Frame,
    ) {
        let before = *frame;
        if plot.double_clicked() {
            frame.fit();
        } else if plot.dragged_by(PointerButton::Primary) || plot.dragged_by(PointerButton::Middle)
        {
            self.drag(ui, plot, transform, frame);
        } else if ui.rect_contains_pointer(area) {
            self.turn(ui, transform, frame);
        }
        if *frame != before {
            // The plot is painted already.
            ui.ctx().request_repaint();
        }
    }

    /// Keep the place that was pressed under the pointer.
    fn drag(&mut self, ui: &Ui, plot: &Response, transform: &PlotTransform, frame: &mut Frame) {
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
        let value = |at: Pos2| {
            let value = transform.value_from_position(at);
            DVec2::new(value.x, value.y)
        };
        if plot.drag_started() {
            let origin = ui.input(|input| input.pointer.press_origin());
            self.grabbed = origin.map(value);
        }
        if let Some((grabbed, pointer)) = self.grabbed.zip(plot.interact_pointer_pos()) {
            frame.pan(transform.bounds(), grabbed - value(pointer));
        }
    }

    /// Zoom or move by the wheel.
    fn turn(&self, ui: &Ui, transform: &PlotTransform, frame: &mut Frame) {
        let (pointer, scrolled, pinched) = ui.input(|input| {
            let pointer = input.pointer.hover_pos();
            (pointer, input.smooth_scroll_delta(), input.zoom_delta())
        });
        let Some(pointer) = pointer else {
            return;
        };
        let bounds = transform.bounds();
        if self.fingers {
            frame.pan(bounds, -values(transform, scrolled));
        }
        let plot = transform.frame();
        let along = |turned: f32| (f64::from(turned) / WHEEL_POINTS).exp();
        // With Shift the wheel turns sideways.
        let (both, across) = match self.fingers {
            true => (f64::from(pinched), 1.0),
            false => (f64::from(pinched) * along(scrolled.y), along(scrolled.x)),
        };
        let is_left = pointer.x < plot.left();
        let is_below = pointer.y > plot.bottom();
        let factors = DVec2::new(
            if is_left { 1.0 } else { both * across },
            if is_below && !is_left { 1.0 } else { both },
        );
        let at = transform.value_from_position(pointer.clamp(plot.min, plot.max));
        frame.zoom(bounds, DVec2::new(at.x, at.y), factors);
    }
}

/// How far a distance on the screen reaches, in the plot's values.
fn values(transform: &PlotTransform, by: Vec2) -> DVec2 {
    let from = transform.frame().center();
    let [from, to] = [from, from + by].map(|at| transform.value_from_position(at));
    DVec2::new(
        if by.x == 0.0 { 0.0 } else { to.x - from.x },
        if by.y == 0.0 { 0.0 } else { to.y - from.y },
    )
}
