//! The end-fit tool on the canvas: targets, the body of terminal vertices, and the ring.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3};

use super::tool::{Context, Cursor, Effect, Tool};
use crate::document::{Curve, CurveId, Edit, EditError, EndMatch, MatchPlace, quoted};
use crate::editor::hand::end_fit::{
    EndFitAction, EndFitSettings, LastAction, nearest_other_end, other_ends,
};
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::input::Key;
use crate::editor::hand::snapping::{Carried, along_axis, by_fifteen_degrees};
use crate::editor::view::end_marks::{ARROW, RING};
use crate::editor::view::hit::REACH;
use crate::editor::view::osculating_circle::OsculatingCircle;
use crate::editor::view::scene::Mark;
use crate::geometry::end_correction::{
    EndDifference, EndTarget, align_end, rotate_end, translate_end,
};
use crate::geometry::{Continuity, End, figure};

/// The ring snaps to the target direction within this angle.
const SNAP_ANGLE: f64 = 2.5;

/// The end-fit tool's state.
#[derive(Debug, Default)]
pub struct EndFitTool {
    /// What it works on, and how.
    pub settings: EndFitSettings,
    /// What the last action of its panel came to.
    pub last: Option<LastAction>,
    /// The correction that is still worked out, and the passes that were made before it.
    pub awaited: Option<(EndFitAction, usize)>,
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

/// What of the tool's own handles is under a place.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Handle {
    Target,
    Direction,
    Ring,
    Body,
    Circle,
    OtherEnd(End),
}

/// The curve that the tool works on, as it was when the gesture began.
struct Subject<'a> {
    id: CurveId,
    curve: &'a Curve,
    end: End,
    point: DVec2,
    target: Option<EndTarget>,
}

impl<'a> Subject<'a> {
    fn of(context: &Context<'a>, end: End, before: bool) -> Result<Self, String> {
        let document = if before {
            context.before
        } else {
            context.document
        };
        let found = context
            .selection
            .active()
            .and_then(|id| Some((id, document.curve(id)?)));
        let Some((id, curve)) = found else {
            return Err("Choose the curve whose ends shall be corrected".into());
        };
        if curve.polygon.is_periodic() {
            return Err(format!(
                "{} is periodic and has no ends: open it in the Curve menu",
                quoted(&curve.name)
            ));
        }
        curve
            .check_visible()
            .map_err(|refused| refused.to_string())?;
        Ok(Self {
            id,
            curve,
            end,
            point: context.viewport.flatten(curve.polygon.end_jet(end).point),
            target: curve.targets.get(end),
        })
    }

    /// The place of the target direction's handle.
    fn direction_tip(&self, context: &Context) -> Option<DVec2> {
        let target = self.target?;
        let view = context.viewport;
        let direction = view.flatten(target.direction?).try_normalize()?;
        Some(view.flatten(target.point) + ARROW * context.viewport.pixel() * direction)
    }

    fn handle(&self, place: DVec2, context: &Context) -> Option<Handle> {
        let near = |model: DVec2| context.viewport.to_screen(model).distance(place) <= REACH;
        if self.direction_tip(context).is_some_and(near) {
            return Some(Handle::Direction);
        }
        if self
            .target
            .is_some_and(|target| near(context.viewport.flatten(target.point)))
        {
            // Where the end has met its target it is the end that is taken, but for Alt.
            let met = self.is_met(context);
            return Some(if met && !context.modifiers.alt {
                Handle::Body
            } else {
                Handle::Target
            });
        }
        if near(self.point) {
            return Some(Handle::Body);
        }
        // The ring comes before the vertices that it crosses: there are others to take.
        let from_end = context.viewport.to_screen(self.point).distance(place);
        if (from_end - RING).abs() <= 0.75 * REACH {
            return Some(Handle::Ring);
        }
        let terminal = self.curve.polygon.terminal_vertices(self.end);
        let mut vertices = self.curve.polygon.vertices()[terminal].iter();
        if vertices.any(|vertex| near(context.viewport.flatten(*vertex))) {
            return Some(Handle::Body);
        }
        let circle = self.circle(context);
        if circle.is_some_and(|circle| near_chain(&circle, place, context)) {
            return Some(Handle::Circle);
        }
        let other = self.end.other();
        let other_end = self.curve.polygon.end_jet(other).point;
        near(context.viewport.flatten(other_end)).then_some(Handle::OtherEnd(other))
    }

    /// The target's osculating circle, as it is seen.
    fn circle(&self, context: &Context) -> Option<Vec<DVec2>> {
        let target = self.target?;
        let circle = OsculatingCircle::of(&target, self.curve, self.end)?;
        Some(circle.chain(context.viewport))
    }

    /// Whether the end lies on its target, as far as the eye can tell.
    fn is_met(&self, context: &Context) -> bool {
        let target = self
            .target
            .map(|target| context.viewport.flatten(target.point));
        target.is_some_and(|target| target.distance(self.point) <= context.viewport.pixel())
    }

    fn is_planar(&self) -> bool {
        self.curve.polygon.is_planar()
    }

    /// Why the target cannot be set, if it is what a match makes it.
    fn refused_by_match(&self, context: &Context) -> Option<String> {
        let mut tried = context.document.clone();
        let (curve, end, target) = (self.id, self.end, self.target);
        let set = Edit::SetTarget { curve, end, target };
        let refused = tried.apply(set).err()?;
        Some(refused.to_string())
    }

    /// The target's curvature and radius, in words.
    fn curvature(&self) -> String {
        let curvature = self.target.and_then(|target| target.curvature);
        let curvature = curvature.unwrap_or_default();
        format!(
            "κ = {}, radius {}",
            figure(curvature),
            figure(1.0 / curvature.abs())
        )
    }

    /// Refuse if the terminal vertices cannot be moved as one body.
    fn check_movable(&self) -> Result<(), EditError> {
        let terminal = self.curve.polygon.terminal_vertices(self.end);
        self.curve.check_editable()?;
        self.curve.check_vertices_unlocked(terminal)
    }

    /// What does not attract the end's target: the target itself, and the curve's own vertices.
    fn carried(&self) -> Carried {
        let all = 0..self.curve.polygon.vertices().len();
        Carried {
            vertices: all.map(|index| (self.id, index)).collect(),
            target: Some((self.id, self.end)),
        }
    }

    fn with_target(&self, target: EndTarget) -> Edit {
        Edit::SetTarget {
            curve: self.id,
            end: self.end,
            target: Some(target),
        }
    }

    fn set_target(&self, label: &str, target: EndTarget) -> Effect {
        Effect::Apply(label.to_owned(), vec![self.with_target(target)])
    }
}

impl Tool for EndFitTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        let subject = match Subject::of(context, self.settings.end, true) {
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

    fn hint(&self, context: &Context) -> String {
        let subject = match Subject::of(context, self.settings.end, false) {
            Ok(subject) => subject,
            Err(reason) => return reason,
        };
        if self.settings.picking {
            return format!(
                "Click another curve, at its end or at any point, to match it up to {} ({}); Esc ends",
                self.settings.continuity.name(),
                self.settings.continuity.label()
            );
        }
        let name = subject.end.name();
        match &self.state {
            State::Target { .. } => "Drag the target point; Shift keeps to an axis".into(),
            State::Direction => "Drag the target direction; Shift keeps to 15°".into(),
            State::Circle => format!("Drag the osculating circle: {}", subject.curvature()),
            State::Body { .. } => format!(
                "Step 5: drag the {} terminal vertices as one body; the {name} snaps to the target, Ctrl frees it",
                subject.curve.polygon.terminal_vertices(subject.end).len()
            ),
            State::Ring { angle, .. } => format!(
                "Step 6: turned by {:.3}°; the tangent snaps to the target direction, Ctrl frees it",
                angle.to_degrees()
            ),
            State::Idle => {
                let place = context
                    .pointer
                    .map(|pointer| context.viewport.to_screen(pointer));
                match place.and_then(|place| subject.handle(place, context)) {
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
        if self.settings.picking {
            let own = context.selection.active();
            let ends = other_ends(context.document, own)
                .map(|(_, _, jet)| context.viewport.flatten(jet.point));
            return ends.map(Mark::Snap).collect();
        }
        match &self.state {
            State::Body {
                snapped: Some(place),
                ..
            } => vec![Mark::Snap(*place)],
            _ => Vec::new(),
        }
    }

    fn cursor(&self, context: &Context) -> Cursor {
        let place = context
            .pointer
            .map(|pointer| context.viewport.to_screen(pointer));
        let handle = Subject::of(context, self.settings.end, false)
            .ok()
            .zip(place)
            .and_then(|(subject, place)| subject.handle(place, context));
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
    /// Begin anew, on the same end with the same tolerance, as when the tool is taken up again.
    pub fn reset(&mut self) {
        self.state = State::Idle;
        self.settings.picking = false;
        self.settings.closed = false;
    }

    fn click(&mut self, place: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
        if self.settings.picking {
            return self.pick(place, subject, context);
        }
        match subject.handle(place, context) {
            Some(Handle::OtherEnd(end)) => {
                self.settings.end = end;
                Vec::new()
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
                vec![subject.set_target("Set target point", target)]
            }
            None => match context.hits.curve(place) {
                Some(hit) if hit.curve != subject.id => vec![Effect::Activate(hit.curve)],
                _ => Vec::new(),
            },
        }
    }

    fn pick(&mut self, place: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
        let Some(picked) = picked(place, subject, context) else {
            return vec![Effect::Say(
                "There is no other curve here: click on one, or near its end".into(),
            )];
        };
        let matched = EndMatch {
            continuity: self.settings.continuity,
            ..picked
        };
        let Some(target) = matched.target(context.document) else {
            return Vec::new();
        };
        self.settings.picking = false;
        if self.settings.live {
            return vec![Effect::Apply(
                "Match end".into(),
                vec![Edit::SetMatch(matched)],
            )];
        }
        let (curve, end) = (subject.id, subject.end);
        let edits = vec![
            Edit::RemoveMatch { curve, end },
            subject.with_target(target),
        ];
        vec![Effect::Apply("Pick target".into(), edits)]
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
            Some(Handle::Direction) => (State::Direction, format!("Turn target of {name}")),
            Some(Handle::Circle) => (State::Circle, format!("Curve target of {name}")),
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
        let shapes = matches!(state, State::Body { .. } | State::Ring { .. });
        if !shapes && let Some(refused) = subject.refused_by_match(context) {
            return vec![Effect::Say(refused)];
        }
        if shapes && let Err(refused) = subject.check_movable() {
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
                let free = if context.modifiers.shift {
                    by_fifteen_degrees(turned)
                } else {
                    turned
                };
                let missing = missing_angle(free, subject, context);
                *angle = missing.unwrap_or(free);
                drag_ring(*angle, missing.is_some(), subject, context)
            }
        }
    }
}

fn drag_target(wanted: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
    let Some(target) = subject.target else {
        return Vec::new();
    };
    let from = context.viewport.flatten(target.point);
    let to = if context.modifiers.shift {
        from + along_axis(wanted - from)
    } else {
        context.snapped(wanted, &subject.carried())
    };
    let movement = context.movement(to - from, subject.is_planar());
    let point = target.point + movement;
    let moved = subject.with_target(EndTarget { point, ..target });
    vec![Effect::Preview(vec![moved])]
}

fn drag_direction(at: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
    let Some(target) = subject.target else {
        return Vec::new();
    };
    let view = &context.viewport.orientation;
    let free = (at - view.flatten(target.point)).to_angle();
    let angle = if context.modifiers.shift {
        by_fifteen_degrees(free)
    } else {
        free
    };
    let push = DVec2::from_angle(angle);
    let direction = Some(if subject.is_planar() {
        context.viewport.movement(push, true).normalize_or(DVec3::X)
    } else {
        // What the direction has along the line of sight is kept.
        let before = target.direction.and_then(DVec3::try_normalize);
        let height = before.map_or(0.0, |d| view.depth(d));
        let flat = push * (1.0 - height * height).max(0.0).sqrt();
        view.lift(flat) + height * view.towards()
    });
    let target = EndTarget {
        direction,
        ..target
    };
    vec![Effect::Preview(vec![subject.with_target(target)])]
}

/// Give the target the curvature of the circle that touches its direction and passes through a
/// place of the view plane: κ = 2 n·q / |q|², q the place as seen from the target.
fn drag_circle(at: DVec2, subject: &Subject, context: &Context) -> Vec<Effect> {
    let circle = subject.target.and_then(|target| {
        Some((
            target,
            OsculatingCircle::of(&target, subject.curve, subject.end)?,
        ))
    });
    let Some((target, circle)) = circle else {
        return Vec::new();
    };
    let Some(curvature) = circle.curvature_through(at, context.viewport) else {
        return Vec::new();
    };
    let planar = subject.is_planar();
    let turned = |normal: DVec3| if curvature < 0.0 { -normal } else { normal };
    let target = EndTarget {
        curvature: Some(if planar { curvature } else { curvature.abs() }),
        normal: if planar {
            target.normal
        } else {
            target.normal.map(turned)
        },
        ..target
    };
    vec![Effect::Preview(vec![subject.with_target(target)])]
}

/// What a click picks of another curve: an end that is near, or the point that is hit.
fn picked(place: DVec2, subject: &Subject, context: &Context) -> Option<EndMatch> {
    let own = (subject.id, subject.end);
    let at = context.model(place);
    let end = nearest_other_end(context.document, own, at, context.viewport);
    end.or_else(|| {
        let hit = context.hits.curve(place)?;
        (hit.curve != subject.id).then_some(EndMatch {
            curve: subject.id,
            end: subject.end,
            source: hit.curve,
            place: MatchPlace::Parameter(hit.u),
            continuity: Continuity::default(),
            reversed: false,
        })
    })
}

fn near_chain(chain: &[DVec2], place: DVec2, context: &Context) -> bool {
    let at = context.model(place);
    let reach = 0.75 * REACH * context.viewport.pixel();
    chain.windows(2).any(|ends| {
        let along = ends[1] - ends[0];
        let share = (at - ends[0]).dot(along) / along.length_squared();
        ends[0].lerp(ends[1], share.clamp(0.0, 1.0)).distance(at) <= reach
    })
}

fn is_near(place: DVec2, target: &EndTarget, context: &Context) -> bool {
    let seen = context.viewport.flatten(target.point);
    seen.distance(place) <= REACH * context.viewport.pixel()
}

/// Translate the terminal vertices, onto a target if they snap to it.
fn drag_body(
    free: DVec2,
    snapped: Option<EndTarget>,
    subject: &Subject,
    context: &Context,
) -> Vec<Effect> {
    let (polygon, end) = (&subject.curve.polygon, subject.end);
    let vector = match snapped {
        Some(target) => EndDifference::between(polygon, end, &target).vector,
        None if context.modifiers.shift => context.movement(along_axis(free), subject.is_planar()),
        None => context.movement(free, subject.is_planar()),
    };
    shaped(subject, translate_end(polygon, end, vector))
}

/// The angle that turns the tangent into the target direction, if a free one snaps to it.
fn missing_angle(free: f64, subject: &Subject, context: &Context) -> Option<f64> {
    let polygon = &subject.curve.polygon;
    let snaps = !context.modifiers.ctrl
        && context.viewport.orientation.is_from_above()
        && polygon.is_planar();
    let target = subject
        .target
        .filter(|target| snaps && target.direction.is_some())?;
    let missing = EndDifference::between(polygon, subject.end, &target).angle;
    // Angles are the same a whole turn apart: the nearest way counts.
    let between = (missing - free + PI).rem_euclid(TAU) - PI;
    (between.abs() < SNAP_ANGLE.to_radians()).then_some(missing)
}

/// Rotate the terminal vertices, exactly into the target direction if they snap to it.
fn drag_ring(angle: f64, snapped: bool, subject: &Subject, context: &Context) -> Vec<Effect> {
    let (polygon, end) = (&subject.curve.polygon, subject.end);
    let direction = subject.target.and_then(|target| target.direction);
    let turned = match direction.filter(|_| snapped) {
        Some(direction) => align_end(polygon, end, direction),
        None => rotate_end(polygon, end, turned_by(angle, subject, context)),
    };
    shaped(subject, turned)
}

/// The rotation that turns what is seen by an angle: of a planar curve within its plane.
fn turned_by(angle: f64, subject: &Subject, context: &Context) -> DMat3 {
    let towards = context.viewport.orientation.towards();
    if subject.is_planar() {
        let seen_from_below = towards.z < 0.0;
        DMat3::from_rotation_z(if seen_from_below { -angle } else { angle })
    } else {
        DMat3::from_axis_angle(towards, angle)
    }
}

fn shaped<E: std::fmt::Display>(
    subject: &Subject,
    polygon: Result<crate::geometry::FloatPolygon, E>,
) -> Vec<Effect> {
    match polygon {
        Ok(polygon) => {
            let curve = subject.id;
            vec![Effect::Preview(vec![Edit::SetPolygon { curve, polygon }])]
        }
        Err(error) => vec![Effect::Say(error.to_string())],
    }
}
