//! Select and move: click, shift-click, box; drag one vertex or many; nudge with the arrows.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3};

use super::item_drag::ItemDrag;
use super::line_drag::LineDrag;
use super::move_drag::MoveDrag;
use super::moving_point::MovingPoint;
use super::reference_drags::{Frame, ReferenceDrag};
use super::tool::{Context, Cursor, Effect, Tool, move_edits, named_snap};
use super::transformed::Transformed;
use crate::document::{CurveId, Document, EditError};
use crate::editor::hand::clean_step::stepped;
use crate::editor::hand::following::{Follow, Followers, Following, PointKind};
use crate::editor::hand::gesture::{Gesture, THRESHOLD};
use crate::editor::hand::input::Key;
use crate::editor::hand::snapping::Carried;
use crate::editor::selection::VertexId;
use crate::editor::view::Look;
use crate::editor::view::hit::{CurveHit, LegHit, REACH};
use crate::editor::view::scene::Mark;
use crate::geometry::counted;

/// How near to a leg the pointer must be to take it, in screen points: less than to a vertex.
const LEG_REACH: f64 = 0.5 * REACH;

/// How much nearer than the curve a leg must be to take a press, in screen points: legs hug fair curves.
const CLEARLY: f64 = 3.0;

/// The shortest comb that a drag of a tip makes, by what it was: one that nobody sees is not found again.
const SHORTEST: f64 = 0.05;

/// The select tool's state.
#[derive(Debug, Default)]
pub struct SelectTool {
    state: State,
}

#[derive(Debug, Default)]
enum State {
    #[default]
    Idle,
    /// Vertices are dragged.
    Moving(Moving),
    /// A vertex of the closed S-polygon, or a point of the curve, is dragged.
    MovingPoint(MovingPoint),
    /// A reference is moved, rotated or scaled.
    Reference(ReferenceDrag),
    /// All selected curves and references are moved.
    Items(ItemDrag),
    /// A guide or an axis is moved.
    Line(LineDrag),
    /// A box is drawn, by its corners on the canvas.
    Boxing { from: DVec2, to: DVec2 },
    /// The comb is scaled by the tip of a tooth.
    Scaling { foot: DVec2, tip: DVec2, scale: f64 },
}

/// A drag of vertices.
#[derive(Debug)]
struct Moving {
    drag: MoveDrag,
    vertices: Vec<(VertexId, DVec3)>,
    /// The curves that lie in the plane z = 0.
    planar: BTreeSet<CurveId>,
    /// The vertex that the readout tells of.
    grip: VertexId,
}

impl Moving {
    fn drag(&mut self, place: DVec2, context: &Context) -> Effect {
        let by = self.drag.go_on(place, context);
        let places = self.vertices.iter().map(|(id, at)| {
            let is_planar = self.planar.contains(&id.0);
            (*id, *at + context.movement(by, is_planar))
        });
        Effect::preview(context.following.edits(context.before, places))
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let (id, index) = self.grip;
        let vertex = |document: &Document| {
            let curve = document.curve(id)?;
            curve.polygon.vertices().get(index).copied()
        };
        let ends = vertex(context.before).zip(vertex(context.document));
        let in_space = !self.planar.contains(&id);
        let lag = ends.and_then(|(from, to)| self.drag.lag(id, [from, to], !in_space, context));
        let remark = lag.map(str::to_owned).or_else(|| context.following.words());
        let readout =
            ends.map(|(from, to)| self.drag.readout([from, to], in_space, remark, context));
        self.drag.marks(readout, context)
    }
}

impl Tool for SelectTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        if let Gesture::Drag(place) = gesture {
            return self.drag(place, context);
        }
        match (std::mem::take(&mut self.state), gesture) {
            (State::Idle, Gesture::Click(place)) => click(place, context),
            (State::Idle, Gesture::DoubleClick(place)) => double_click(place, context),
            (State::Idle, Gesture::DragStart(place)) => self.start(place, context),
            (State::Idle, Gesture::Key(key)) => nudge(key, context),
            (State::Moving(_) | State::Items(_), Gesture::DragEnd(_)) => {
                let staying = context.staying().map(Effect::Say);
                [Effect::Commit].into_iter().chain(staying).collect()
            }
            (State::MovingPoint(_) | State::Reference(_) | State::Line(_), Gesture::DragEnd(_)) => {
                vec![Effect::Commit]
            }
            (
                State::Moving(_)
                | State::MovingPoint(_)
                | State::Reference(_)
                | State::Items(_)
                | State::Line(_),
                Gesture::Cancel,
            ) => {
                vec![Effect::Abort]
            }
            (State::Boxing { from, .. }, Gesture::DragEnd(to)) => boxed(from, to, context),
            (State::Scaling { scale, .. }, Gesture::Cancel) => {
                let mut comb = context.hits.view.comb;
                comb.scale = scale;
                vec![Effect::Look(Look::Comb(comb))]
            }
            (_, Gesture::Cancel | Gesture::DragEnd(_)) => Vec::new(),
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
        takes_vertex(place, context)
            || takes_reference(place, context)
            || context.hits.leg(place, LEG_REACH).is_some()
            || point_of_curve(place, context).is_some()
            || context.hits.plane_line(place).is_some()
    }

    fn wheel_turns(&self, following: &Following) -> Option<Followers> {
        match &self.state {
            State::MovingPoint(moving) => moving.wheel_turns(following),
            _ => following.follow.map(|_| Followers::OfVertices),
        }
    }

    fn hint(&self, context: &Context) -> String {
        match &self.state {
            State::Moving(_) if context.following.follow.is_some() => {
                let words = context.following.words().unwrap_or_default();
                let stiffness = match context.following.follow {
                    Some(Follow::InHarmony) => ", with Shift how stiff",
                    _ => "; Alt compares",
                };
                format!("{words}: the wheel sets how many{stiffness}")
            }
            State::Moving(Moving { vertices, .. }) => {
                let staying = context.staying().map(|staying| format!(" ({staying})"));
                format!(
                    "Moving {}{}: Shift, X, Y or Z locks an axis; Ctrl: snapping {}; Alt compares",
                    counted(vertices.len(), "vertex", "vertices"),
                    staying.unwrap_or_default(),
                    if context.snapping { "off" } else { "on" },
                )
            }
            State::MovingPoint(moving) => moving.hint(context),
            State::Reference(drag) => drag.hint(context.snapping),
            State::Items(drag) => drag.hint(context),
            State::Line(drag) => drag.hint(context),
            State::Boxing { .. } => {
                match context.selection.has_no_item() {
                    true => "Release to select the curves in the box; Shift adds to the selection",
                    false => "Release to select the vertices of selected curves in the box, or else the curves; Shift adds",
                }
                .into()
            }
            State::Scaling { .. } => "Drag the tip to scale the curvature comb".into(),
            State::Idle => {
                let selected = context.selection.vertices().len();
                if selected > 0 && context.places(context.selection.vertices()).is_empty() {
                    let vertices = counted(selected, "vertex", "vertices");
                    let refused = context.selection.vertices().find_map(|id| why(id, context));
                    match refused {
                        Some(EditError::LockedVertex { .. }) => {
                            format!("{vertices} selected, locked: L unlocks")
                        }
                        _ => format!(
                            "{vertices} selected, of a locked curve: unlock it in the list of curves to edit"
                        ),
                    }
                } else if selected > 0 {
                    format!(
                        "{} selected: drag, or nudge with arrow keys (Shift ×10, Ctrl ×0.1); Del deletes",
                        counted(selected, "vertex", "vertices")
                    )
                } else if context.selection.is_of_whole_items() {
                    let count = context.selection.items().len();
                    format!(
                        "{count} selected: drag one or press arrow keys to move all; R rotates, S scales, Del deletes"
                    )
                } else if Frame::of(context).is_some() {
                    "Drag the reference, a corner of its frame to scale it, the handle above to rotate it".into()
                } else if context.document.is_empty() {
                    "Nothing here yet: draw a polygon with D, or open a file with Ctrl+O".into()
                } else {
                    "Drag a vertex or the curve; arrow keys nudge it, a double-click takes it whole".into()
                }
            }
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        match &self.state {
            State::Boxing { from, to } => {
                vec![Mark::SelectionBox([
                    context.model(*from),
                    context.model(*to),
                ])]
            }
            State::Moving(moving) => moving.marks(context),
            State::MovingPoint(moving) => moving.marks(context),
            State::Reference(drag) => drag.marks(context),
            State::Items(drag) => drag.marks(context),
            State::Line(drag) => drag.marks(context),
            State::Idle => {
                let frame = Frame::of(context).map(|frame| frame.mark());
                let tooth = context.place();
                let tooth = tooth.and_then(|place| rested_tooth(place, context));
                let tip = tooth.map(|[_, tip]| named_snap(tip, "Comb scale".to_owned()));
                frame.into_iter().chain(tip.into_iter().flatten()).collect()
            }
            _ => Vec::new(),
        }
    }

    fn cursor(&self, context: &Context) -> Cursor {
        let place = context.place();
        match self.state {
            State::Moving(_)
            | State::MovingPoint(_)
            | State::Reference(_)
            | State::Items(_)
            | State::Line(_)
            | State::Scaling { .. } => Cursor::Move,
            State::Idle
                if place.is_some_and(|place| {
                    takes_vertex(place, context)
                        || point_of_curve(place, context).is_some()
                        || rested_tooth(place, context).is_some()
                }) =>
            {
                Cursor::Move
            }
            State::Idle if place.is_some_and(|place| takes_reference(place, context)) => {
                Cursor::Grab
            }
            State::Idle if place.is_some_and(|it| context.hits.plane_line(it).is_some()) => {
                Cursor::Move
            }
            _ => Cursor::Default,
        }
    }
}

impl SelectTool {
    fn drag(&mut self, place: DVec2, context: &Context) -> Vec<Effect> {
        match &mut self.state {
            State::Idle => Vec::new(),
            State::Moving(moving) => vec![moving.drag(place, context)],
            State::MovingPoint(moving) => vec![moving.drag(place, context)],
            State::Reference(drag) => vec![drag.drag(place, context)],
            State::Items(drag) => vec![drag.drag(place, context)],
            State::Line(drag) => vec![drag.drag(place, context)],
            State::Boxing { to, .. } => {
                *to = place;
                Vec::new()
            }
            State::Scaling { foot, tip, scale } => {
                let arm = *tip - *foot;
                let reach = (context.model(place) - *foot).dot(arm) / arm.length_squared();
                let mut comb = context.hits.view.comb;
                comb.scale = *scale * reach.max(SHORTEST);
                vec![Effect::Look(Look::Comb(comb))]
            }
        }
    }

    fn start(&mut self, place: DVec2, context: &Context) -> Vec<Effect> {
        if let Some(frame) = Frame::of(context)
            && let Some(handle) = frame.handle(place, context)
        {
            return self.start_reference(ReferenceDrag::by_handle(handle, &frame, place, context));
        }
        // Vertices may lie on the curves: what is selected as a whole moves as a whole.
        if let Some(grip) = context.hits.curve(place)
            && let Some((drag, effects)) = ItemDrag::begin(place, grip, context)
        {
            self.state = drag.map_or(State::Idle, State::Items);
            return effects;
        }
        if let Some(vertex) = context.hits.vertex(place) {
            return self.start_moving(place, vertex, context);
        }
        if let Some((curve, index)) = context.hits.clamped_vertex(place) {
            return self.start_moving_point(place, curve, PointKind::Clamped(index), context);
        }
        let curve = point_of_curve(place, context);
        if let Some(hit) = curve.filter(|hit| is_whole(hit.curve, context)) {
            return self.start_moving_whole(place, hit, context);
        }
        if let Some(leg) = leg_before(place, curve, context) {
            return self.start_moving_leg(place, leg, context);
        }
        if let Some(hit) = curve {
            let point = PointKind::OnCurve(hit.u);
            return self.start_moving_point(place, hit.curve, point, context);
        }
        if let Some([foot, tip]) = rested_tooth(place, context) {
            let scale = context.hits.view.comb.scale;
            self.state = State::Scaling { foot, tip, scale };
            return Vec::new();
        }
        if let Some(hit) = context.hits.curve(place)
            && let Some(drag) = ReferenceDrag::by_body(hit, place, context)
        {
            let mut effects = vec![Effect::Select(Vec::new()), Effect::Activate(hit.curve)];
            effects.extend(self.start_reference(Some(drag)));
            return effects;
        }
        if let Some((drag, effect)) = LineDrag::on_canvas(place, context) {
            self.state = State::Line(drag);
            return vec![effect];
        }
        self.state = State::Boxing {
            from: place,
            to: place,
        };
        Vec::new()
    }

    fn start_reference(&mut self, drag: Option<(ReferenceDrag, Effect)>) -> Vec<Effect> {
        let begun = drag.map(|(drag, effect)| {
            self.state = State::Reference(drag);
            effect
        });
        begun.into_iter().collect()
    }

    fn start_moving(&mut self, place: DVec2, hit: VertexId, context: &Context) -> Vec<Effect> {
        let taken: Vec<VertexId> = if context.selection.contains(hit) {
            context.selection.vertices().collect()
        } else if context.modifiers.shift {
            context.selection.vertices().chain([hit]).collect()
        } else {
            vec![hit]
        };
        let Some((_, at)) = context.places([hit]).pop() else {
            return vec![refused(hit, context)];
        };
        let held = context.viewport.flatten(at);
        self.move_these(place, (hit, held), taken, None, context)
    }

    /// A leg moves as its two vertices do: they are selected, or all that is selected goes along
    /// if both were.
    fn start_moving_leg(&mut self, place: DVec2, leg: LegHit, context: &Context) -> Vec<Effect> {
        let count = vertex_count(leg.curve, context).max(1);
        let ends = [leg.index, (leg.index + 1) % count].map(|index| (leg.curve, index));
        let Some((grip, _)) = context.places(ends).first().copied() else {
            return vec![refused(ends[0], context)];
        };
        let (taken, label) = if ends.iter().all(|end| context.selection.contains(*end)) {
            (context.selection.vertices().collect(), None)
        } else {
            (ends.into(), Some("Move leg"))
        };
        self.move_these(place, (grip, leg.point), taken, label, context)
    }

    /// All vertices of a curve are selected: it moves as a whole, by any place on it.
    fn start_moving_whole(
        &mut self,
        place: DVec2,
        hit: CurveHit,
        context: &Context,
    ) -> Vec<Effect> {
        let taken: Vec<VertexId> = context.selection.vertices().collect();
        match context.places(taken.iter().copied()).first() {
            Some((grip, _)) => self.move_these(place, (*grip, hit.point), taken, None, context),
            None => vec![refused((hit.curve, 0), context)],
        }
    }

    fn start_moving_point(
        &mut self,
        place: DVec2,
        curve: CurveId,
        kind: PointKind,
        context: &Context,
    ) -> Vec<Effect> {
        match MovingPoint::begin(place, curve, kind, context) {
            Ok((moving, label)) => {
                self.state = State::MovingPoint(moving);
                vec![
                    Effect::Select(Vec::new()),
                    Effect::Activate(curve),
                    Effect::Begin(label),
                ]
            }
            Err(refused) => vec![Effect::Say(refused)],
        }
    }

    fn move_these(
        &mut self,
        place: DVec2,
        (grip, held): (VertexId, DVec2),
        taken: Vec<VertexId>,
        label: Option<&str>,
        context: &Context,
    ) -> Vec<Effect> {
        let vertices = context.places(taken.iter().copied());
        let label = match label {
            Some(label) => label.to_owned(),
            None => format!("Move {}", counted(vertices.len(), "vertex", "vertices")),
        };
        let planar = context.planar_curves(&vertices);
        let carried = Carried {
            vertices: taken.iter().copied().collect(),
            is_off_ground: !planar.contains(&grip.0),
            ..Carried::default()
        };
        self.state = State::Moving(Moving {
            drag: MoveDrag::begin(place, held, carried, context),
            planar,
            vertices,
            grip,
        });
        vec![
            Effect::Select(taken),
            Effect::Activate(grip.0),
            Effect::Begin(label),
        ]
    }
}

/// The point of a curve, of no reference, that a press takes. A curve of degree 1 is its legs, which are dragged instead.
fn point_of_curve(place: DVec2, context: &Context) -> Option<CurveHit> {
    let hit = context.hits.curve(place)?;
    let curve = context.document.curve(hit.curve)?;
    (curve.polygon.degree() > 1).then_some(hit)
}

/// Whether all vertices of a curve are selected.
fn is_whole(curve: CurveId, context: &Context) -> bool {
    let selected = context.selection.of_curve(curve).count();
    selected > 0 && selected == vertex_count(curve, context)
}

/// The leg that a press takes, if it is clearly nearer than the curve; none of another curve where the active one runs.
fn leg_before(place: DVec2, curve: Option<CurveHit>, context: &Context) -> Option<LegHit> {
    let leg = context.hits.leg(place, LEG_REACH)?;
    if context.selection.active() != Some(leg.curve) && context.hits.is_active_under(place) {
        return None;
    }
    let at = context.model(place);
    let clearly = CLEARLY * context.viewport.pixel();
    let is_nearer = |curve: CurveHit| leg.point.distance(at) + clearly < curve.point.distance(at);
    curve.is_none_or(is_nearer).then_some(leg)
}

fn takes_vertex(place: DVec2, context: &Context) -> bool {
    context.hits.vertex(place).is_some() || context.hits.clamped_vertex(place).is_some()
}

/// The tooth of the comb whose tip a press takes: the pointer has rested there, and shows it.
fn rested_tooth(place: DVec2, context: &Context) -> Option<[DVec2; 2]> {
    let rests = context
        .rested
        .is_some_and(|at| at.distance(place) < THRESHOLD);
    rests.then(|| context.hits.tooth(place)).flatten()
}

/// Whether a press would take a reference, or a handle of its frame.
fn takes_reference(place: DVec2, context: &Context) -> bool {
    let frame = Frame::of(context);
    frame.is_some_and(|frame| frame.handle(place, context).is_some())
        || context.hits.curve(place).is_some_and(|hit| {
            let reference = context.document.reference(hit.curve);
            reference.is_some_and(|reference| reference.check_editable().is_ok())
        })
}

fn vertex_count(curve: CurveId, context: &Context) -> usize {
    let curve = context.document.curve(curve);
    curve.map_or(0, |curve| curve.polygon.vertices().len())
}

/// Say why a vertex cannot be moved.
fn refused(vertex: VertexId, context: &Context) -> Effect {
    let refused = why(vertex, context);
    Effect::Say(refused.map_or_else(String::new, |refused| refused.to_string()))
}

/// Why a vertex cannot be moved, if that is so.
fn why((curve, vertex): VertexId, context: &Context) -> Option<EditError> {
    let curve = context.document.curve(curve)?;
    let checked = curve.check_editable();
    let checked = checked.and_then(|()| curve.check_vertices_unlocked([vertex]));
    checked.err()
}

fn click(place: DVec2, context: &Context) -> Vec<Effect> {
    if let Some(vertex) = context.hits.vertex(place) {
        return vec![if context.modifiers.shift {
            Effect::ToggleSelected(vertex)
        } else {
            Effect::Select(vec![vertex])
        }];
    }
    if let Some((curve, feature)) = context.hits.feature(place)
        && !context.modifiers.shift
    {
        let select = Effect::Select(Vec::new());
        return vec![
            select,
            Effect::Activate(curve),
            Effect::Look(Look::Feature(feature.middle)),
        ];
    }
    let curve = context.hits.curve(place).map(|hit| hit.curve);
    let curve = curve.or_else(|| context.hits.leg(place, LEG_REACH).map(|hit| hit.curve));
    match curve {
        // A click that misses a vertex of the curve takes back no selected vertex.
        Some(curve)
            if context.modifiers.shift && context.selection.of_curve(curve).next().is_some() =>
        {
            Vec::new()
        }
        Some(curve) if context.modifiers.shift => vec![Effect::ToggleItem(curve)],
        Some(curve) => vec![Effect::Select(Vec::new()), Effect::SelectItems(vec![curve])],
        None if context.modifiers.shift => Vec::new(),
        None => vec![deselected(context)],
    }
}

/// Deselect the vertices, or the curves and references where no vertex is selected.
fn deselected(context: &Context) -> Effect {
    match context.selection.is_empty() {
        true => Effect::SelectItems(Vec::new()),
        false => Effect::Select(Vec::new()),
    }
}

/// Select what is in a box: vertices of selected curves, or else curves and references.
fn boxed(from: DVec2, to: DVec2, context: &Context) -> Vec<Effect> {
    let vertices = context.hits.vertices_in_box(from, to);
    let adds = context.modifiers.shift;
    if !vertices.is_empty() {
        return vec![match adds {
            true => Effect::SelectMore(vertices),
            false => Effect::Select(vertices),
        }];
    }
    let items = context.hits.items_in_box(from, to);
    match (adds, items.is_empty()) {
        (true, true) => Vec::new(),
        (false, true) => vec![deselected(context)],
        (true, false) => {
            let selected = context.document.all_ids();
            let selected = selected.filter(|id| context.selection.has_item(*id));
            vec![Effect::SelectItems(selected.chain(items).collect())]
        }
        (false, false) => vec![Effect::Select(Vec::new()), Effect::SelectItems(items)],
    }
}

fn double_click(place: DVec2, context: &Context) -> Vec<Effect> {
    if context.hits.vertex(place).is_some() {
        return Vec::new();
    }
    match context.hits.curve(place) {
        Some(hit) => {
            let all = (0..vertex_count(hit.curve, context)).map(|index| (hit.curve, index));
            vec![
                Effect::SelectItems(vec![hit.curve]),
                Effect::Select(all.collect()),
            ]
        }
        None => vec![Effect::Look(Look::All)],
    }
}

/// Move references, or several curves and references, by an arrow key.
fn nudge_items(items: &Transformed, by: DVec2, context: &Context) -> Vec<Effect> {
    let staying = context.staying().map(Effect::Say).into_iter();
    if items.is_empty() {
        return staying.collect();
    }
    match items.moved(|planar| context.movement(by, planar), stepped, context) {
        Ok(edits) => [Effect::Apply(items.label("Nudge"), edits)]
            .into_iter()
            .chain(staying)
            .collect(),
        Err(error) => vec![Effect::Say(error.to_string())],
    }
}

/// Move the selection by an arrow key: by the nudge step, ten times as far with Shift, a tenth with Ctrl.
fn nudge(key: Key, context: &Context) -> Vec<Effect> {
    let direction = match key {
        Key::Left => DVec2::NEG_X,
        Key::Right => DVec2::X,
        Key::Up => DVec2::Y,
        Key::Down => DVec2::NEG_Y,
        Key::Escape => return vec![deselected(context)],
        _ => return Vec::new(),
    };
    let step = match (context.modifiers.shift, context.modifiers.ctrl) {
        (true, false) => 10.0 * context.nudge_step,
        (false, true) => 0.1 * context.nudge_step,
        _ => context.nudge_step,
    };
    let items = Transformed::of(context);
    if context.selection.is_empty() || !items.can_stretch() {
        return nudge_items(&items, direction * step, context);
    }
    let vertices = context.places(context.selection.vertices());
    let planar = context.planar_curves(&vertices);
    if vertices.is_empty() {
        let first = context.selection.vertices().next();
        let refused = first.map(|id| refused(id, context));
        return refused.into_iter().collect();
    }
    let label = format!("Nudge {}", counted(vertices.len(), "vertex", "vertices"));
    let places = vertices.iter().map(|(id, at)| {
        let by = context.movement(direction * step, planar.contains(&id.0));
        (*id, stepped(*at, by))
    });
    let staying = context.staying().map(Effect::Say);
    let nudge = Effect::Apply(label, move_edits(places));
    [nudge].into_iter().chain(staying).collect()
}
