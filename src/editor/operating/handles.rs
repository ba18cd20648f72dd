//! Handles of a previewed operation on the canvas: a drag sets the parameters.

use glam::{DVec2, DVec3};

use super::in_progress::HandleDrag;
use super::{Operating, OperationInProgress};
use crate::editor::hand::snapping::{Carried, along_axis};
use crate::editor::hand::tools::Context;
use crate::editor::reply::{Message, Refusal};
use crate::editor::view::scene::{HoverScene, Mark};
use crate::editor::view::{REACH, Viewport};
use crate::geometry::figure;
use crate::geometry::parameters::Quantity;
use crate::operations::{Handle, Parameter, Sets, Value};

/// Shift turns angles by multiples of this, in degrees.
const ANGLE_STEP: f64 = 15.0;

impl Operating<'_> {
    /// Begin to drag the handle at a place on the canvas. Returns whether there is one.
    pub(in crate::editor) fn begin_handle_drag(&mut self, at: DVec2) -> bool {
        let viewport = &self.view.pane.viewport;
        let from = viewport.to_model(at);
        let drag = self.current().and_then(|current| {
            Some(HandleDrag {
                handle: *current.handle_at(viewport, at)?,
                planar: current.handles().iter().all(|handle| handle.at.z == 0.0),
                from,
            })
        });
        let Some((current, drag)) = self.operations.operation.as_mut().zip(drag) else {
            return false;
        };
        current.dragged = Some(drag);
        self.hold_values();
        true
    }

    /// Set the values that the dragged handle has reached. Returns whether one is dragged.
    pub(in crate::editor) fn go_on_with_handle(
        &mut self,
        given: Option<Vec<(&'static str, Value)>>,
    ) -> bool {
        let Some(given) = given else {
            return false;
        };
        if let Err(error) = self.set_values(&given) {
            Message::tell_update(self.message, Some(Refusal(error.to_string())));
        }
        true
    }

    /// End the drag of a handle. Returns whether there was one.
    pub(in crate::editor) fn end_handle_drag(&mut self) -> bool {
        let current = self.operations.operation.as_mut();
        current.is_some_and(|current| current.dragged.take().is_some())
    }
}

impl OperationInProgress {
    /// Whether a handle is dragged.
    pub fn drags_handle(&self) -> bool {
        self.dragged_handle().is_some()
    }

    /// The parameter of this name.
    pub(super) fn parameter(&self, name: &str) -> Option<&'static Parameter> {
        let mut parameters = self.operation.parameters.iter();
        parameters.find(|parameter| parameter.name == name)
    }

    /// Whether there are handles: then the canvas belongs to them.
    pub(in crate::editor) fn offers_handles(&self) -> bool {
        !self.handles().is_empty()
    }

    /// The handle at a place on the canvas; of equally near ones the last.
    pub(in crate::editor) fn handle_at(
        &self,
        viewport: &Viewport,
        place: DVec2,
    ) -> Option<&Handle> {
        let distance = |handle: &Handle| {
            let at = viewport.to_screen(viewport.flatten(handle.at));
            at.distance(place)
        };
        let near = self.handles().iter();
        near.filter(|handle| distance(handle) <= REACH)
            .rev()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// The handles as the canvas shows them; the dragged one or the one under the pointer is marked.
    pub(in crate::editor) fn handle_marks(
        &self,
        viewport: &Viewport,
        pointer: Option<DVec2>,
    ) -> Vec<Mark> {
        let marked = self.handle_of(viewport, pointer);
        let marked = marked.map(|handle| handle.label);
        let marks = self.handles().iter().map(|handle| Mark::Handle {
            at: viewport.flatten(handle.at),
            marked: marked == Some(handle.label),
        });
        marks.collect()
    }

    /// The parameters and values of the handle that is dragged or under the pointer.
    pub(in crate::editor) fn handle_hover(
        &self,
        viewport: &Viewport,
        pointer: Option<DVec2>,
    ) -> Option<HoverScene> {
        let handle = self.handle_of(viewport, pointer)?;
        let names = handle.parameters().into_iter();
        let parameters = names.filter_map(|name| self.parameter(name));
        let lines = parameters.map(|parameter| told(parameter, self.values.get(parameter)));
        Some(HoverScene::Handle {
            at: viewport.flatten(handle.at),
            text: lines.collect::<Vec<_>>().join("\n"),
        })
    }

    /// The values that a drag of the handle to a place on the canvas sets. Shift keeps to an axis of the
    /// view, and to multiples of 15°. `None` if none is dragged.
    pub(in crate::editor) fn dragged_values(
        &self,
        at: DVec2,
        context: &Context<'_>,
    ) -> Option<Vec<(&'static str, Value)>> {
        let drag = self.dragged_handle()?;
        let shift = context.modifiers.shift;
        let is_angle = |name: &str| {
            let parameter = self.parameter(name);
            parameter.is_some_and(|parameter| parameter.quantity() == Quantity::Angle)
        };
        let turns = drag.handle.parameters().into_iter().any(is_angle);
        let mut by = context.viewport.to_model(at) - drag.from;
        if let Sets::OnCurve(on_curve) = &drag.handle.sets {
            let place = context.viewport.flatten(drag.handle.at) + by;
            return Some(self.values_on_curve(&drag.handle, on_curve, place, context));
        }
        if shift && !turns {
            by = along_axis(by);
        }
        let moved = drag.handle.at + context.movement(by, drag.planar);
        let seen = context.viewport.flatten(moved);
        let snapped = context.snapped_point(seen, &Carried::default());
        let point: DVec3 = snapped.filter(|_| !shift).unwrap_or(moved);
        let mut values = drag.handle.values(point);
        for (name, value) in &mut values {
            if let Value::Real(angle) = value
                && shift
                && is_angle(name)
            {
                let steps = (angle.to_degrees() / ANGLE_STEP).round();
                *angle = (steps * ANGLE_STEP).to_radians();
            }
        }
        Some(values)
    }

    /// The handle that is dragged, where it is now, or the one under the pointer.
    fn handle_of(&self, viewport: &Viewport, pointer: Option<DVec2>) -> Option<&Handle> {
        match self.dragged_handle() {
            Some(drag) => {
                let label = drag.handle.label;
                self.handles().iter().find(|handle| handle.label == label)
            }
            None => self.handle_at(viewport, pointer?),
        }
    }

    pub(super) fn handles(&self) -> &[Handle] {
        match self.is_applied() {
            true => &[],
            false => &self.handles,
        }
    }

    fn dragged_handle(&self) -> Option<&HandleDrag> {
        self.dragged.as_ref().filter(|_| !self.is_applied())
    }
}

/// The label of a parameter with its value.
fn told(parameter: &Parameter, value: &Value) -> String {
    let quantity = parameter.quantity();
    let number = |number: &f64| figure(quantity.shown(*number));
    let text = match value {
        Value::Real(angle) if quantity == Quantity::Angle => format!("{}°", number(angle)),
        Value::Real(length) => number(length),
        Value::List(numbers) => numbers.iter().map(number).collect::<Vec<_>>().join(", "),
        other => parameter.text(other),
    };
    format!("{} {text}", parameter.label)
}
