//! Rotate and scale the selection about a movable pivot.

use glam::DVec2;

use super::tool::{Context, Effect, Entry, Tool};
use super::transformation::Transformation;
use super::transformed::Transformed;
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::input::Key;
use crate::editor::hand::snapping::Carried;
use crate::editor::view::hit::REACH;
use crate::editor::view::scene::Mark;
use crate::editor::view::viewport::Viewport;
use crate::geometry::degrees_text;

/// The message where there is nothing to rotate or scale.
pub const NOTHING_TO_TRANSFORM: &str =
    "Nothing to transform: select vertices or a curve; what is locked or hidden stays";

/// The radius of the ring that rotates, in screen points.
const RING: f64 = 88.0;

/// Half the side of the box that scales, in screen points.
const HALF_BOX: f64 = 64.0;

/// The rotate or the scale tool's state.
#[derive(Debug)]
pub struct TransformTool {
    /// The transformation that changes nothing.
    resting: Transformation,
    state: State,
}

#[derive(Debug, Default)]
enum State {
    #[default]
    Idle,
    MovingPivot {
        before: Option<DVec2>,
    },
    Turning(Box<Turning>),
    /// The typed figure is previewed.
    Typed(Transformation),
}

/// A drag that rotates or scales.
#[derive(Clone, Debug)]
struct Turning {
    pivot: DVec2,
    origin: DVec2,
    /// The axis along which alone it scales, 0 or 1 of the plane that is drawn in.
    axis: Option<usize>,
    taken: Transformed,
    now: DVec2,
}

impl TransformTool {
    /// Take the tool that rotates.
    pub fn rotate() -> Self {
        Self::resting(Transformation::Rotate(0.0))
    }

    /// Take the tool that scales.
    pub fn scale() -> Self {
        Self::resting(Transformation::Scale(1.0))
    }

    fn resting(resting: Transformation) -> Self {
        let state = State::Idle;
        Self { resting, state }
    }

    fn rotates(&self) -> bool {
        matches!(self.resting, Transformation::Rotate(_))
    }

    fn start(&mut self, place: DVec2, context: &Context) -> Vec<Effect> {
        let taken = Transformed::of(context);
        let Some(pivot) = pivot(context) else {
            return vec![Effect::Say(NOTHING_TO_TRANSFORM.into())];
        };
        let from_pivot = context.viewport.to_screen(pivot).distance(place);
        if from_pivot <= REACH {
            let before = context.settings.pivot;
            self.state = State::MovingPivot { before };
            return Vec::new();
        }
        if context.selection.vertices().len() == 1 && context.settings.pivot.is_none() {
            return vec![Effect::Say(ONE_VERTEX.into())];
        }
        let label = taken.label_of(self.resting);
        let origin = context.model(place);
        let axis = self.sides(pivot, &taken, context).into_iter();
        let mut axis =
            axis.filter(|(_, at)| context.viewport.to_screen(*at).distance(place) <= REACH);
        let axis = axis.next().map(|(axis, _)| axis);
        self.state = State::Turning(Box::new(Turning {
            pivot,
            origin,
            axis,
            taken,
            now: origin,
        }));
        vec![Effect::Begin(label)]
    }

    /// The handles that scale along one axis, with the axis.
    fn sides(&self, pivot: DVec2, taken: &Transformed, context: &Context) -> Vec<(usize, DVec2)> {
        if self.rotates() || !taken.can_stretch() {
            return Vec::new();
        }
        let reach = HALF_BOX * context.viewport.pixel();
        let side = |axis: usize| {
            let by = reach * seen_axis(axis, context)?;
            Some([(axis, pivot + by), (axis, pivot - by)])
        };
        [0, 1].into_iter().filter_map(side).flatten().collect()
    }

    /// The transformation of the drag, with a label.
    fn action(&self, turning: &Turning, context: &Context) -> (Transformation, String) {
        let (from, to) = (turning.origin - turning.pivot, turning.now - turning.pivot);
        if self.rotates() {
            let angle = context.angle(from.angle_to(to));
            let label = degrees_text(angle.to_degrees(), 2);
            return (Transformation::Rotate(angle), label);
        }
        let Some(axis) = turning.axis else {
            let factor = context.factor(to.length() / from.length(), 1.0);
            return (Transformation::Scale(factor), format!("× {factor:.3}"));
        };
        let along = seen_axis(axis, context).unwrap_or(DVec2::X);
        let factor = context.factor(to.dot(along) / from.dot(along), f64::NEG_INFINITY);
        let names = context.drawing_plane().names();
        let name = names.get(axis).copied().unwrap_or_default();
        let label = format!("{name} × {factor:.3}");
        (Transformation::Stretch(axis, factor), label)
    }
}

/// What is said of one vertex that would be turned or scaled about itself.
const ONE_VERTEX: &str =
    "One vertex stays where its pivot is: select more, move the pivot, or Esc for the whole curve";

/// The pivot: where it was put, or where it was for the same selection, or the middle of what would be transformed, if
/// there is anything.
pub(in crate::editor) fn pivot(context: &Context) -> Option<DVec2> {
    pivot_of(context.settings.pivot, context)
}

fn pivot_of(put: Option<DVec2>, context: &Context) -> Option<DVec2> {
    let turned = context.settings.turned.as_ref();
    let stays = turned.filter(|(_, selection)| selection == context.selection);
    let stays = stays.map(|(pivot, _)| *pivot);
    put.or(stays)
        .or_else(|| Transformed::of(context).middle(context))
}

/// Put the pivot somewhere, or let it follow the selection again.
fn put_pivot(pivot: Option<DVec2>, context: &Context) -> Effect {
    context.set(|settings| settings.pivot = pivot)
}

/// The direction in which an axis of the plane that is drawn in is seen.
fn seen_axis(axis: usize, context: &Context) -> Option<DVec2> {
    let direction = context.drawing_plane().axis(axis);
    context.viewport.flatten(direction).try_normalize()
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
            (State::Idle, Gesture::DoubleClick(_)) => vec![context.set(|settings| {
                settings.pivot = None;
                settings.turned = None;
            })],
            (State::Idle, Gesture::Key(Key::Escape)) => vec![Effect::Finish],
            (State::MovingPivot { before }, Gesture::Drag(place)) => {
                self.state = State::MovingPivot { before };
                let pivot = context.snapped(context.model(place), &Carried::default());
                vec![put_pivot(Some(pivot), context)]
            }
            (State::MovingPivot { before }, Gesture::Cancel) => vec![put_pivot(before, context)],
            (State::Turning(mut turning), Gesture::Drag(place)) => {
                turning.now = context.model(place);
                let (action, _) = self.action(&turning, context);
                let edits = turning.taken.edits(action, turning.pivot, context.viewport);
                self.state = State::Turning(turning);
                vec![Effect::preview(edits)]
            }
            (State::Turning(turning), Gesture::DragEnd(_)) => {
                let turned = Some((turning.pivot, context.selection.clone()));
                let stays = context.set(|settings| settings.turned = turned);
                let staying = context.staying().map(Effect::Say);
                [Effect::Commit, stays].into_iter().chain(staying).collect()
            }
            (State::Turning(_), Gesture::Cancel) => vec![Effect::Abort],
            // A typed figure that was not entered is dropped.
            (State::Typed(_), gesture) => {
                let effects = self.gesture(gesture, context);
                [Effect::Abort].into_iter().chain(effects).collect()
            }
            (State::MovingPivot { .. }, Gesture::DragEnd(_)) => Vec::new(),
            (state, _) => {
                self.state = state;
                Vec::new()
            }
        }
    }

    fn entry(&self, _viewport: &Viewport) -> Option<Entry> {
        Some(match self.rotates() {
            true => Entry::Angle,
            false => Entry::Factor,
        })
    }

    fn type_number(&mut self, typed: Option<Transformation>, context: &Context) -> Vec<Effect> {
        let mut put = context.settings.pivot;
        let mut effects = match std::mem::take(&mut self.state) {
            State::Typed(shown) if typed == Some(shown) => {
                self.state = State::Typed(shown);
                return Vec::new();
            }
            State::Idle => Vec::new(),
            State::MovingPivot { before } => {
                put = before;
                vec![put_pivot(before, context)]
            }
            State::Turning(_) | State::Typed(_) => vec![Effect::Abort],
        };
        let Some((typed, pivot)) = typed.zip(pivot_of(put, context)) else {
            return effects;
        };
        // The middle of what is previewed lies elsewhere.
        let turned = Some((pivot, context.selection.clone()));
        effects.push(context.set(|settings| settings.turned = turned));
        let taken = Transformed::of(context);
        effects.push(Effect::Begin(taken.label_of(typed)));
        effects.push(Effect::preview(taken.edits(typed, pivot, context.viewport)));
        self.state = State::Typed(typed);
        effects
    }

    fn begins(&self, gesture: Gesture, context: &Context) -> bool {
        let Gesture::DragStart(place) = gesture else {
            return false;
        };
        let pivot = pivot(context).map(|at| context.viewport.to_screen(at));
        pivot.is_some_and(|pivot| pivot.distance(place) > REACH)
    }

    fn hint(&self, context: &Context) -> String {
        let [verb, steps, one_axis] = match self.rotates() {
            true => ["rotate", "15°", ""],
            false => ["scale", "tenths", ", a round handle for one axis"],
        };
        match self.state {
            State::Turning(_) => {
                let staying = context.staying().map(|staying| format!("{staying}; "));
                let staying = staying.unwrap_or_default();
                format!("{staying}Shift snaps to {steps}, hold Alt to compare, Esc cancels")
            }
            State::MovingPivot { .. } => "Release to leave the pivot here".into(),
            State::Idle if Transformed::of(context).is_empty() => {
                format!("Select vertices or a curve to {verb}; Esc ends")
            }
            State::Typed(_) => "Enter applies what is typed, Esc takes it back".into(),
            State::Idle => format!(
                "Drag to {verb}{one_axis}, or type a number; drag the pivot to move it; Esc ends"
            ),
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        if let State::Turning(turning) = &self.state {
            let (pivot, origin) = (turning.pivot, turning.origin);
            let (action, label) = self.action(turning, context);
            let from = (origin - pivot).to_angle();
            let arm = match action {
                Transformation::Rotate(angle) => DVec2::from_angle(angle).rotate(origin - pivot),
                _ => turning.now - pivot,
            };
            return vec![
                self.gizmo(pivot, from, action, &turning.taken, context),
                Mark::Guide([pivot, origin]),
                Mark::Guide([pivot, pivot + arm]),
                Mark::Pivot(pivot),
                Mark::Label(turning.now, label),
            ];
        }
        let action = match &self.state {
            State::Typed(typed) => *typed,
            _ => self.resting,
        };
        let pivot = pivot(context);
        let marks = pivot.map(|pivot| {
            let taken = Transformed::of(context);
            [
                self.gizmo(pivot, 0.0, action, &taken, context),
                Mark::Pivot(pivot),
            ]
        });
        let snap = match self.state {
            State::MovingPivot { .. } => context.pointer,
            _ => None,
        };
        let snap = snap.map(|at| context.snap_marks(at, &Carried::default()));
        let marks = marks.into_iter().flatten();
        marks.chain(snap.into_iter().flatten()).collect()
    }
}

impl TransformTool {
    /// The ring of a rotation that began at an angle, or the box of a scaling.
    fn gizmo(
        &self,
        pivot: DVec2,
        from: f64,
        action: Transformation,
        taken: &Transformed,
        context: &Context,
    ) -> Mark {
        let pixel = context.viewport.pixel();
        let factors = match action {
            Transformation::Rotate(swept) => {
                return Mark::Ring {
                    centre: pivot,
                    handle: pivot + RING * pixel * DVec2::from_angle(from + swept),
                    swept,
                };
            }
            Transformation::Scale(factor) => DVec2::splat(factor),
            Transformation::Move(_) => DVec2::ONE,
            Transformation::Stretch(axis, factor) => {
                let mut factors = DVec2::ONE;
                factors[axis] = factor;
                factors
            }
        };
        let corner = |x, y| pivot + HALF_BOX * pixel * factors * DVec2::new(x, y);
        let sides = self.sides(pivot, taken, context).into_iter();
        let scaled = |(axis, at): (usize, DVec2)| pivot + factors[axis] * (at - pivot);
        Mark::Corners {
            corners: [
                corner(1.0, 1.0),
                corner(-1.0, 1.0),
                corner(-1.0, -1.0),
                corner(1.0, -1.0),
            ],
            sides: sides.map(scaled).collect(),
        }
    }
}
