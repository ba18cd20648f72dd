//! Rotate and scale the selection about a movable pivot.

use glam::DVec2;

use super::tool::{Context, Effect, Tool};
use super::transformed::{Action, Transformed};
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::input::Key;
use crate::editor::hand::snapping::{Carried, by_fifteen_degrees};
use crate::editor::view::hit::REACH;
use crate::editor::view::scene::Mark;

/// What is said where there is nothing to rotate or scale.
pub const NOTHING_TO_TRANSFORM: &str =
    "Nothing to transform: select vertices or a curve; what is locked or hidden stays";

/// The radius of the ring that rotates, in screen points.
const RING: f64 = 88.0;

/// Half the side of the box that scales, in screen points.
const HALF_BOX: f64 = 64.0;

/// What a drag does to the vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transform {
    /// Turn them about the pivot.
    Rotate,
    /// Scale them about the pivot.
    Scale,
}

/// The rotate or the scale tool's state.
#[derive(Debug)]
pub struct TransformTool {
    transform: Transform,
    /// Where the user has put the pivot; `None` while it follows the selection.
    pivot: Option<DVec2>,
    state: State,
}

#[derive(Debug, Default)]
enum State {
    #[default]
    Idle,
    MovingPivot {
        before: Option<DVec2>,
    },
    Turning {
        pivot: DVec2,
        origin: DVec2,
        taken: Box<Transformed>,
        now: DVec2,
        label: String,
    },
}

impl TransformTool {
    /// Take a tool that rotates or scales.
    pub fn new(transform: Transform) -> Self {
        Self {
            transform,
            pivot: None,
            state: State::Idle,
        }
    }

    /// Put the pivot somewhere, or let it follow the selection again.
    pub fn set_pivot(&mut self, pivot: Option<DVec2>) {
        self.pivot = pivot;
    }

    /// The pivot: where it was put, or the middle of what would be transformed, if there is
    /// anything.
    pub fn pivot(&self, context: &Context) -> Option<DVec2> {
        if let Some(pivot) = self.pivot {
            return Some(pivot);
        }
        Transformed::of(context).middle(context)
    }

    fn start(&mut self, place: DVec2, context: &Context) -> Vec<Effect> {
        let taken = Transformed::of(context);
        let Some(pivot) = self.pivot(context) else {
            return vec![Effect::Say(NOTHING_TO_TRANSFORM.into())];
        };
        let from_pivot = context.viewport.to_screen(pivot).distance(place);
        if from_pivot <= REACH {
            self.state = State::MovingPivot { before: self.pivot };
            return Vec::new();
        }
        let verb = match self.transform {
            Transform::Rotate => "Rotate",
            Transform::Scale => "Scale",
        };
        let label = format!("{verb} {}", taken.noun());
        let origin = context.model(place);
        self.state = State::Turning {
            pivot,
            origin,
            taken: Box::new(taken),
            now: origin,
            label: String::new(),
        };
        vec![Effect::Begin(label)]
    }

    /// What the drag from `origin` to `now` does, with a label of it.
    fn action(
        &self,
        pivot: DVec2,
        origin: DVec2,
        now: DVec2,
        context: &Context,
    ) -> (Action, String) {
        let (from, to) = (origin - pivot, now - pivot);
        match self.transform {
            Transform::Rotate => {
                let free = from.angle_to(to);
                let angle = if context.modifiers.shift {
                    by_fifteen_degrees(free)
                } else {
                    free
                };
                (Action::Rotate(angle), format!("{:.2}°", angle.to_degrees()))
            }
            Transform::Scale => {
                let free = to.length() / from.length();
                let factor = if context.modifiers.shift {
                    (free * 10.0).round().max(1.0) / 10.0
                } else {
                    free
                };
                (Action::Scale(factor), format!("× {factor:.3}"))
            }
        }
    }
}

/// Make the reference under a place the active one.
fn reference_at(place: DVec2, context: &Context) -> Vec<Effect> {
    let hit = context.hits.curve(place).map(|hit| hit.curve);
    match hit.filter(|id| context.document.reference(*id).is_some()) {
        Some(reference) => vec![Effect::Select(Vec::new()), Effect::Activate(reference)],
        None => Vec::new(),
    }
}

impl Tool for TransformTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        match (std::mem::take(&mut self.state), gesture) {
            (State::Idle, Gesture::DragStart(place)) => self.start(place, context),
            (State::Idle, Gesture::Click(place)) => match context.hits.vertex(place) {
                Some(vertex) if context.modifiers.shift => vec![Effect::ToggleSelected(vertex)],
                Some(vertex) => vec![Effect::Select(vec![vertex])],
                None => reference_at(place, context),
            },
            (State::Idle, Gesture::DoubleClick(_)) => {
                self.pivot = None;
                Vec::new()
            }
            (State::Idle, Gesture::Key(Key::Escape)) => vec![Effect::Finish],
            (State::MovingPivot { before }, Gesture::Drag(place)) => {
                self.pivot = Some(context.snapped(context.model(place), &Carried::default()));
                self.state = State::MovingPivot { before };
                Vec::new()
            }
            (State::MovingPivot { before }, Gesture::Cancel) => {
                self.pivot = before;
                Vec::new()
            }
            (
                State::Turning {
                    pivot,
                    origin,
                    taken,
                    ..
                },
                Gesture::Drag(place),
            ) => {
                let now = context.model(place);
                let (action, label) = self.action(pivot, origin, now, context);
                let effect = match taken.edits(action, pivot, context.viewport) {
                    Ok(edits) => Effect::Preview(edits),
                    Err(error) => Effect::Say(error.to_string()),
                };
                self.state = State::Turning {
                    pivot,
                    origin,
                    taken,
                    now,
                    label,
                };
                vec![effect]
            }
            (State::Turning { .. }, Gesture::DragEnd(_)) => {
                let staying = context.staying().map(Effect::Say);
                [Effect::Commit].into_iter().chain(staying).collect()
            }
            (State::Turning { .. }, Gesture::Cancel) => vec![Effect::Abort],
            (State::MovingPivot { .. }, Gesture::DragEnd(_)) => Vec::new(),
            (state, _) => {
                self.state = state;
                Vec::new()
            }
        }
    }

    fn hint(&self, context: &Context) -> String {
        let verb = match self.transform {
            Transform::Rotate => "rotate",
            Transform::Scale => "scale",
        };
        match self.state {
            State::Turning { .. } => {
                let steps = match self.transform {
                    Transform::Rotate => "15°",
                    Transform::Scale => "tenths",
                };
                let staying = context.staying().map(|staying| format!("{staying}; "));
                let staying = staying.unwrap_or_default();
                format!("{staying}Shift snaps to {steps}, hold Alt to compare, Esc cancels")
            }
            State::MovingPivot { .. } => "Release to leave the pivot here".into(),
            State::Idle if Transformed::of(context).is_empty() => {
                format!("Select vertices or a curve to {verb}; Esc ends")
            }
            State::Idle => {
                format!(
                    "Drag to {verb} about the pivot; drag the pivot itself to move it, double-click to centre it; Esc ends"
                )
            }
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let State::Turning {
            pivot,
            origin,
            now,
            label,
            ..
        } = &self.state
        else {
            let pivot = self.pivot(context);
            let still = match self.transform {
                Transform::Rotate => Action::Rotate(0.0),
                Transform::Scale => Action::Scale(1.0),
            };
            let marks = pivot.map(|pivot| [gizmo(pivot, 0.0, still, context), Mark::Pivot(pivot)]);
            return marks.into_iter().flatten().collect();
        };
        let (action, _) = self.action(*pivot, *origin, *now, context);
        vec![
            gizmo(*pivot, (*origin - *pivot).to_angle(), action, context),
            Mark::Guide([*pivot, *origin]),
            Mark::Arm([*pivot, *now]),
            Mark::Pivot(*pivot),
            Mark::Label(*now, label.clone()),
        ]
    }
}

/// The ring of a rotation that began at an angle, or the box of a scaling.
fn gizmo(pivot: DVec2, from: f64, action: Action, context: &Context) -> Mark {
    let pixel = context.viewport.pixel();
    match action {
        Action::Rotate(swept) => Mark::Ring {
            centre: pivot,
            handle: pivot + RING * pixel * DVec2::from_angle(from + swept),
            swept,
        },
        Action::Scale(factor) => {
            let corner = |x, y| pivot + HALF_BOX * pixel * factor * DVec2::new(x, y);
            Mark::Corners([
                corner(1.0, 1.0),
                corner(-1.0, 1.0),
                corner(-1.0, -1.0),
                corner(1.0, -1.0),
            ])
        }
    }
}
