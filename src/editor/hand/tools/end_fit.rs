//! The end-fit tool on the canvas: targets, the body of terminal vertices, and the ring.

use glam::DVec2;

use super::end_fit_drags::{
    drag_body, drag_circle, drag_direction, drag_ring, drag_target, is_near, missing_angle,
};
use super::end_fit_subject::{Handle, Subject};
use super::end_pick::{EndPick, pick_marks};
use super::tool::{Context, Cursor, Effect, Tool, named_snap, pointer_label};
use crate::document::Edit;
use crate::editor::hand::end_fit::MATCH_END;
use crate::editor::hand::following::{Followers, Following};
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::input::Key;
use crate::editor::view::scene::Mark;
use crate::geometry::degrees_text;
use crate::geometry::end_correction::EndTarget;

/// The end-fit tool's state.
#[derive(Debug, Default)]
pub struct EndFitTool {
    state: State,
}

#[derive(Debug, Default)]
enum State {
    #[default]
    Idle,
    /// The target point is dragged; `offset` is from the pointer to it.
    Target { offset: DVec2 },
    /// The target direction is dragged by its tip.
    Direction,
    /// The target's osculating circle is dragged.
    Circle,
    /// The terminal vertices are translated as one body.
    Body {
        origin: DVec2,
        snapped: Option<DVec2>,
    },
    /// The terminal vertices are rotated about the end point.
    Ring { origin: DVec2, angle: f64 },
}

impl Tool for EndFitTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        let subject = match Subject::before(context) {
            Ok(subject) => subject,
            Err(reason) => return without_subject(gesture, reason, context),
        };
        match (std::mem::take(&mut self.state), gesture) {
            (State::Idle, Gesture::Click(place)) => self.click(place, &subject, context),
            (State::Idle, Gesture::DragStart(place)) => self.start(place, &subject, context),
            (State::Idle, Gesture::Key(Key::Escape)) => vec![Effect::Finish],
            (state @ State::Idle, _) => {
                self.state = state;
                Vec::new()
            }
            (_, Gesture::DragEnd(_)) => vec![Effect::Commit],
            (_, Gesture::Cancel) => vec![Effect::Abort],
            (state, Gesture::Drag(place)) => {
                self.state = state;
                self.drag(context.model(place), &subject, context)
            }
            (state, _) => {
                self.state = state;
                Vec::new()
            }
        }
    }

    fn begins(&self, gesture: Gesture, context: &Context) -> bool {
        let Gesture::DragStart(place) = gesture else {
            return false;
        };
        let subject = Subject::before(context);
        subject.is_ok_and(|subject| subject.handle(place, context).is_some())
    }

    fn wheel_turns(&self, following: &Following) -> Option<Followers> {
        let drags_target = matches!(
            self.state,
            State::Target { .. } | State::Direction | State::Circle
        );
        let follows = drags_target && following.follows_targets();
        follows.then_some(Followers::OfVertices)
    }

    fn hint(&self, context: &Context) -> String {
        let subject = match Subject::now(context) {
            Ok(subject) => subject,
            Err(reason) => return reason,
        };
        if context.settings.end_fit.picking {
            return format!(
                "Click another curve, at an end or anywhere, to match it up to {}; Esc ends",
                context.settings.end_fit.continuity.name()
            );
        }
        let name = subject.end.name();
        if let Some(words) = context.following.words()
            && self.follows(context)
        {
            return format!(
                "The {name} follows its target, {words}: the wheel sets how many; Esc cancels"
            );
        }
        match &self.state {
            State::Target { .. } => "Drag the target point; Shift locks to an axis".into(),
            State::Direction => "Drag the target direction; Shift snaps to 15°".into(),
            State::Circle => format!("Drag the osculating circle: {}", subject.curvature()),
            State::Body { .. } => format!(
                "Step 5: drag {} vertices as one body; the {name} snaps to the target, Ctrl frees it",
                subject.curve.polygon.terminal_vertices(subject.end).len()
            ),
            State::Ring { angle, .. } => format!(
                "Step 6: turned by {}; the tangent snaps to the target direction, Ctrl frees it",
                degrees_text(angle.to_degrees(), 3)
            ),
            State::Idle => {
                let place = context.place();
                let handle = place.and_then(|place| subject.handle(place, context));
                let is_target = matches!(
                    handle,
                    Some(Handle::Target | Handle::Direction | Handle::Circle)
                );
                if is_target && context.following.follows_targets() {
                    return format!(
                        "Drag the target, and the {name} follows it in harmony; N lets the curve stay"
                    );
                }
                match handle {
                    Some(Handle::Target) => "Drag to move the target point".into(),
                    Some(Handle::Direction) => "Drag to turn the target direction".into(),
                    Some(Handle::Circle) => format!(
                        "Drag the osculating circle to change the target's curvature: {}",
                        subject.curvature()
                    ),
                    Some(Handle::Ring) => "Step 6: drag the ring to rotate the terminal vertices about the end point".into(),
                    Some(Handle::Body) if subject.is_met(context) => {
                        "Step 5: drag to translate the terminal vertices; Alt-drag takes the target".into()
                    }
                    Some(Handle::Body) => "Step 5: drag to translate the terminal vertices as one body".into(),
                    Some(Handle::OtherEnd(end)) => format!("Click to work on the {}", end.name()),
                    None if subject.target.is_none() => format!("Click to set the target of the {name}, or use the panel"),
                    None => "Drag the target, its arrow, the end or its ring; the panel lists the seven steps".into(),
                }
            }
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        if context.settings.end_fit.picking {
            return pick_marks(Subject::now(context).ok().as_ref(), context);
        }
        match &self.state {
            State::Body {
                snapped: Some(place),
                ..
            } => {
                let name = format!("Target of the {}", context.settings.end_fit.end.name());
                named_snap(*place, name)
                    .into_iter()
                    .chain(self.told(context))
                    .collect()
            }
            _ => self
                .told(context)
                .into_iter()
                .chain(self.snap_marks(context))
                .collect(),
        }
    }

    fn cursor(&self, context: &Context) -> Cursor {
        let subject = Subject::now(context).ok().zip(context.place());
        let handle = subject.and_then(|(subject, place)| subject.handle(place, context));
        match (&self.state, handle) {
            (State::Idle, None) => Cursor::Crosshair,
            (State::Idle, Some(_)) => Cursor::Grab,
            _ => Cursor::Grabbing,
        }
    }
}

fn without_subject(gesture: Gesture, reason: String, context: &Context) -> Vec<Effect> {
    match gesture {
        Gesture::Click(place) => match context.hits.curve(place) {
            Some(hit) => vec![Effect::Activate(hit.curve)],
            None => vec![Effect::Say(reason)],
        },
        Gesture::Key(Key::Escape) => vec![Effect::Finish],
        _ => Vec::new(),
    }
}

impl EndFitTool {
    /// Whether the end follows the target that is dragged.
    fn follows(&self, context: &Context) -> bool {
        self.wheel_turns(&context.following).is_some()
    }

    /// Say beside the pointer how the end follows its target, and what the drag adds.
    fn told(&self, context: &Context) -> Option<Mark> {
        let follows = self.follows(context).then(|| context.following.words());
        let lines = [follows.flatten(), context.added.map(str::to_owned)];
        let lines: Vec<String> = lines.into_iter().flatten().collect();
        pointer_label((!lines.is_empty()).then(|| lines.join("; ")), context)
    }

    /// The snap of a dragged target.
    fn snap_marks(&self, context: &Context) -> Vec<Mark> {
        let (State::Target { offset }, false, Some(at)) =
            (&self.state, context.modifiers.shift, context.pointer)
        else {
            return Vec::new();
        };
        let subject = Subject::now(context);
        let marks = subject.map(|subject| context.snap_marks(at + *offset, &subject.carried()));
        marks.unwrap_or_default()
    }

    fn click(&self, place: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
        if context.settings.end_fit.picking {
            return self.pick(place, subject, context);
        }
        match subject.handle(place, context) {
            Some(Handle::OtherEnd(end)) => {
                vec![context.set(|settings| settings.end_fit.end = end)]
            }
            Some(_) => Vec::new(),
            None if subject.target.is_none() => {
                let at = context.snapped(context.model(place), &subject.carried());
                let jet = subject.curve.polygon.end_jet(subject.end);
                let by = at - context.viewport.flatten(jet.point);
                let target = EndTarget {
                    point: jet.point + context.movement(by, subject.is_planar()),
                    direction: jet.tangent(),
                    ..EndTarget::default()
                };
                let edits = vec![subject.with_target(target)];
                vec![Effect::Apply("Set target point".to_owned(), edits)]
            }
            None => match context.hits.curve(place) {
                Some(hit) if hit.curve != subject.id => vec![Effect::Activate(hit.curve)],
                _ => Vec::new(),
            },
        }
    }

    fn pick(&self, place: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
        let Some(picked) = EndPick::at(place, subject, context) else {
            return vec![Effect::Say(
                "There is no other curve here: click on one, or near its end".into(),
            )];
        };
        if let Err(refused) = picked.check(context.document) {
            return vec![Effect::Say(refused)];
        }
        let matched = picked.matched;
        let Some(target) = matched.target(context.document) else {
            return Vec::new();
        };
        let (curve, end) = (subject.id, subject.end);
        let (label, edits) = match context.settings.end_fit.live {
            true => (MATCH_END, vec![Edit::SetMatch(matched)]),
            false => {
                let remove = Edit::RemoveMatch { curve, end };
                ("Pick target", vec![remove, subject.with_target(target)])
            }
        };
        vec![
            context.set(|settings| {
                settings.end_fit.picking = false;
                settings.end_fit.picked = Some(matched);
            }),
            Effect::Apply(label.to_owned(), edits),
        ]
    }

    fn start(&mut self, place: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
        let origin = context.model(place);
        let name = subject.end.name();
        let (state, label) = match subject.handle(place, context) {
            Some(Handle::Target) => {
                let target = subject
                    .target
                    .map_or(origin, |target| context.viewport.flatten(target.point));
                let offset = target - origin;
                (State::Target { offset }, format!("Move target of {name}"))
            }
            Some(Handle::Direction) => (State::Direction, format!("Rotate target of {name}")),
            Some(Handle::Circle) => (State::Circle, format!("Change target curvature of {name}")),
            Some(Handle::Body) => {
                let state = State::Body {
                    origin,
                    snapped: None,
                };
                (state, format!("Translate {name}"))
            }
            Some(Handle::Ring) => {
                let state = State::Ring { origin, angle: 0.0 };
                (state, format!("Rotate {name}"))
            }
            Some(Handle::OtherEnd(_)) | None => return Vec::new(),
        };
        let allowed = match state {
            State::Body { .. } | State::Ring { .. } => subject.check_movable(),
            _ => subject.check_target(context),
        };
        if let Err(refused) = allowed {
            return vec![Effect::Say(refused.to_string())];
        }
        self.state = state;
        vec![Effect::Begin(label)]
    }

    fn drag(&mut self, at: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
        match &mut self.state {
            State::Idle => Vec::new(),
            State::Target { offset } => drag_target(at + *offset, subject, context),
            State::Direction => drag_direction(at, subject, context),
            State::Circle => drag_circle(at, subject, context),
            State::Body { origin, snapped } => {
                let free = at - *origin;
                let target = subject.target.filter(|_| !context.modifiers.ctrl);
                let target = target.filter(|target| is_near(subject.point + free, target, context));
                *snapped = target.map(|target| context.viewport.flatten(target.point));
                drag_body(free, target, subject, context)
            }
            State::Ring { origin, angle } => {
                let turned = (*origin - subject.point).angle_to(at - subject.point);
                let free = context.angle(turned);
                let missing = missing_angle(free, subject, context);
                *angle = missing.unwrap_or(free);
                drag_ring(*angle, missing.is_some(), subject, context)
            }
        }
    }
}
