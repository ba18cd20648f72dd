//! Handles that an operation offers on the canvas: dragging them sets its parameters.

use glam::{DVec2, DVec3};

use crate::editor::Editor;
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::handle_drag::HandleDrag;
use crate::editor::hand::snapping::Carried;
use crate::editor::reply::{Message, Refusal};
use crate::editor::view::Look;
use crate::editor::view::hit::REACH;
use crate::editor::view::scene::{HoverScene, Mark};
use crate::geometry::figure;
use crate::operations::{Handle, Parameter, Unit, Value};

/// To what angles are constrained, in degrees.
const ANGLE_STEP: f64 = 15.0;

impl Editor {
    /// Take a gesture that is meant for a handle; returns whether it is.
    pub(in crate::editor) fn drag_handle(&mut self, gesture: Gesture) -> bool {
        match gesture {
            Gesture::DragStart(at) => self.begin_handle_drag(at),
            Gesture::Click(at) | Gesture::DoubleClick(at) => self.handle_at(at).is_some(),
            Gesture::Drag(at) => {
                let Some(drag) = self.dragged_handle().cloned() else {
                    return false;
                };
                let given = self.dragged_values(&drag, at);
                if let Err(error) = self.set_values(&given) {
                    self.tell_of_update(Some(Refusal(error.to_string())));
                }
                true
            }
            Gesture::DragEnd(_) => {
                let drags = self.end_handle_drag();
                if drags {
                    self.keep_values();
                }
                drags
            }
            Gesture::Cancel => {
                let drags = self.end_handle_drag();
                if drags {
                    self.restore_values();
                }
                drags
            }
            _ => false,
        }
    }

    /// Leave a gesture beside the handles without effect on the operation that offers them; a double click on
    /// nothing still shows everything.
    pub(in crate::editor) fn leave_beside_handles(&mut self, gesture: Gesture) {
        match gesture {
            Gesture::DoubleClick(at) if !self.is_over_curve(at) => self.look(Look::All),
            Gesture::DragStart(at) if self.is_over_curve(at) => {
                let label = self.trial().map_or("", |trial| trial.operation().label);
                let first = format!("Apply or cancel {label} before you edit curves on the canvas");
                self.message = Message::of(&Err(Refusal(first)));
            }
            _ => {}
        }
    }

    fn is_over_curve(&self, at: DVec2) -> bool {
        let hits = self.context().hits;
        hits.vertex(at).is_some() || hits.curve(at).is_some() || hits.leg(at, 0.5 * REACH).is_some()
    }

    fn begin_handle_drag(&mut self, at: DVec2) -> bool {
        let Some(handle) = self.handle_at(at).copied() else {
            return false;
        };
        let planar = self.handles().iter().all(|handle| handle.at.z == 0.0);
        let from = self.view.viewport.to_model(at);
        self.hold_values();
        if let Some(trial) = &mut self.operations.trial {
            trial.dragged = Some(HandleDrag {
                handle,
                planar,
                from,
            });
        }
        true
    }

    /// Whether a handle of the operation that is tried out is dragged.
    pub fn drags_handle(&self) -> bool {
        self.dragged_handle().is_some()
    }

    /// Whether the operation that is tried out offers handles: the canvas is for them then.
    pub(in crate::editor) fn offers_handles(&self) -> bool {
        !self.handles().is_empty()
    }

    /// Let go of the handle that is dragged; returns whether one was.
    pub(in crate::editor) fn end_handle_drag(&mut self) -> bool {
        let trial = self.operations.trial.as_mut();
        trial.is_some_and(|trial| trial.dragged.take().is_some())
    }

    /// What the canvas shows of the handles.
    pub(in crate::editor) fn handle_marks(&self) -> Vec<Mark> {
        let pointer = self.hand.gestures.pointer();
        let dragged = self.dragged_handle().map(|drag| drag.handle.label);
        let under = pointer.filter(|_| dragged.is_none());
        let under = under.and_then(|at| self.handle_at(at));
        let marked = dragged.or(under.map(|handle| handle.label));
        let marks = self.handles().iter().map(|handle| Mark::Handle {
            at: self.view.viewport.flatten(handle.at),
            marked: marked == Some(handle.label),
        });
        marks.collect()
    }

    /// What the pointer is over, if it is a handle, or drags one: what that sets, and to what.
    pub(in crate::editor) fn handle_hover(&self) -> Option<HoverScene> {
        let handle = match self.dragged_handle() {
            Some(drag) => {
                let label = drag.handle.label;
                self.handles().iter().find(|handle| handle.label == label)?
            }
            None => self.handle_at(self.hand.gestures.pointer()?)?,
        };
        let parameters = self.trial()?.operation().parameters;
        let set = handle.values(handle.at);
        let lines = set.iter().filter_map(|(name, value)| {
            let mut parameters = parameters.iter();
            let parameter = parameters.find(|parameter| parameter.name == *name)?;
            Some(told(parameter, value))
        });
        Some(HoverScene::Handle {
            at: self.view.viewport.flatten(handle.at),
            text: lines.collect::<Vec<_>>().join("\n"),
        })
    }

    /// Whether the pointer rests on a handle.
    pub(in crate::editor) fn is_over_handle(&self) -> bool {
        let pointer = self.hand.gestures.pointer();
        pointer.is_some_and(|at| self.handle_at(at).is_some())
    }

    /// The handles of the operation that is tried out.
    fn handles(&self) -> &[Handle] {
        let trial = self.trial().filter(|trial| !trial.is_applied());
        trial.map_or(&[], |trial| &trial.handles)
    }

    /// The handle at a place on the canvas; of equal ones the last.
    fn handle_at(&self, place: DVec2) -> Option<&Handle> {
        let viewport = &self.view.viewport;
        let distance = |handle: &Handle| {
            viewport
                .to_screen(viewport.flatten(handle.at))
                .distance(place)
        };
        let near = self
            .handles()
            .iter()
            .filter(|handle| distance(handle) <= REACH);
        near.rev()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    fn dragged_handle(&self) -> Option<&HandleDrag> {
        let trial = self.trial().filter(|trial| !trial.is_applied())?;
        trial.dragged.as_ref()
    }

    /// The values that a drag to a place on the canvas sets. Shift locks to an axis of the view, and to
    /// whole multiples of 15°.
    fn dragged_values(&self, drag: &HandleDrag, at: DVec2) -> Vec<(&'static str, Value)> {
        let context = self.context();
        let shift = context.modifiers.shift;
        let angles = |name: &str| {
            let parameters = self
                .trial()
                .map_or(&[][..], |trial| trial.operation().parameters);
            let mut parameters = parameters.iter();
            parameters.any(|parameter| parameter.name == name && parameter.unit() == Unit::Angle)
        };
        let mut values = drag.handle.values(drag.handle.at);
        let turns = values.iter().any(|(name, _)| angles(name));
        let mut by = self.view.viewport.to_model(at) - drag.from;
        if shift && !turns {
            by = if by.x.abs() >= by.y.abs() {
                by.with_y(0.0)
            } else {
                by.with_x(0.0)
            };
        }
        let moved = drag.handle.at + context.movement(by, drag.planar);
        let seen = self.view.viewport.flatten(moved);
        let snapped = context.snapped_point(seen, &Carried::default());
        let point: DVec3 = snapped.filter(|_| !shift).unwrap_or(moved);
        values = drag.handle.values(point);
        for (name, value) in &mut values {
            if let Value::Real(angle) = value
                && shift
                && angles(name)
            {
                let steps = (angle.to_degrees() / ANGLE_STEP).round();
                *angle = (steps * ANGLE_STEP).to_radians();
            }
        }
        values
    }
}

/// Say what a parameter is set to.
fn told(parameter: &Parameter, value: &Value) -> String {
    let unit = parameter.unit();
    let number = |number: &f64| figure(unit.shown(*number));
    let text = match value {
        Value::Real(angle) if unit == Unit::Angle => format!("{}°", number(angle)),
        Value::Real(length) => number(length),
        Value::List(numbers) => numbers.iter().map(number).collect::<Vec<_>>().join(", "),
        other => parameter.text(other),
    };
    format!("{} {text}", parameter.label)
}
