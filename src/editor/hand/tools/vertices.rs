//! Tools that change the number of vertices: add at an end, insert into a leg, delete.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::drawing::DrawingTool;
use super::tool::{Context, Effect, Tool};
use crate::document::{Curve, CurveId, quoted};
use crate::editor::hand::drawing_plane::LegLocks;
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::snapping::Carried;
use crate::editor::hand::typed_point::{EntryError, TypedPoint};
use crate::editor::polygon_edits::{deletion, inserted, insertion};
use crate::editor::view::hit::LegHit;
use crate::editor::view::scene::Mark;
use crate::geometry::{End, FloatPolygon};

/// Legs are found from this far, in screen points, when a vertex shall be inserted.
const LEG_REACH: f64 = 24.0;

/// What the steps are called.
const ADD: &str = "Add vertex";
const INSERT: &str = "Insert vertex";

/// What is said where there is no leg to insert a vertex into.
const NO_LEG: &str = "There is no leg here: click on a leg of a float S-polygon";

/// Add vertices at the end of the active curve that is nearer to the pointer.
#[derive(Debug, Default)]
pub struct AddVertexTool {
    adding: Option<Adding>,
    locks: LegLocks,
}

/// A vertex that is being added, and dragged until the button is released.
#[derive(Debug)]
struct Adding {
    id: CurveId,
    /// The curve without it.
    curve: Arc<Curve>,
    index: usize,
    /// A point as far from the eye as the new vertex will be.
    like: DVec3,
    /// Where the leg begins that is drawn.
    base: DVec3,
}

impl Adding {
    /// The vertex that is meant by a place of the view plane.
    fn vertex_at(&self, at: DVec2, locks: LegLocks, context: &Context) -> DVec3 {
        let by = at - context.viewport.flatten(self.like);
        let free = self.like + context.movement(by, self.curve.polygon.is_planar());
        locks.constrained(self.base, free, &context.drawing_plane())
    }

    fn typed_vertex(&self, typed: TypedPoint, context: &Context) -> Result<DVec3, EntryError> {
        typed.point(Some(self.base), &context.drawing_plane())
    }

    /// The polygon with the vertex.
    fn polygon(&self, vertex: DVec3) -> Option<FloatPolygon> {
        inserted(&self.curve.polygon, self.index, vertex).ok()
    }

    fn preview(&self, vertex: DVec3) -> Effect {
        match insertion(self.id, &self.curve, self.index, vertex) {
            Ok(edit) => Effect::Preview(vec![edit]),
            Err(error) => Effect::Say(error.to_string()),
        }
    }

    /// All effects of a gesture that places one vertex.
    fn once(&self, label: &str, vertex: DVec3) -> Vec<Effect> {
        vec![
            Effect::Activate(self.id),
            Effect::Begin(label.to_owned()),
            self.preview(vertex),
            Effect::Select(vec![(self.id, self.index)]),
            Effect::Commit,
        ]
    }

    fn start(&self, label: &str, vertex: DVec3) -> Vec<Effect> {
        let mut effects = self.once(label, vertex);
        effects.pop();
        effects
    }

    /// Go on with a drag.
    fn next(
        slot: &mut Option<Self>,
        locks: LegLocks,
        gesture: Gesture,
        context: &Context,
    ) -> Vec<Effect> {
        match (gesture, slot.as_ref()) {
            (Gesture::Drag(place), Some(adding)) => {
                // It was not there before, so every vertex may attract it.
                let at = context.snapped(context.model(place), &Carried::default());
                vec![adding.preview(adding.vertex_at(at, locks, context))]
            }
            (Gesture::DragEnd(_), Some(_)) => {
                *slot = None;
                vec![Effect::Commit]
            }
            (Gesture::Cancel, Some(_)) => {
                *slot = None;
                vec![Effect::Abort]
            }
            (Gesture::Key(crate::editor::hand::input::Key::Escape), None) => vec![Effect::Finish],
            _ => Vec::new(),
        }
    }

    /// End a drag at a vertex that was typed.
    fn end_at(
        slot: &mut Option<Self>,
        typed: TypedPoint,
        context: &Context,
    ) -> Option<Result<Vec<Effect>, EntryError>> {
        let vertex = slot.as_ref()?.typed_vertex(typed, context);
        let ended = vertex.map(|vertex| {
            let preview = slot.take().map(|adding| adding.preview(vertex));
            preview.into_iter().chain([Effect::Commit]).collect()
        });
        Some(ended)
    }
}

impl AddVertexTool {
    /// What is added at the end that is nearer to a place of the view plane.
    fn plan(&self, at: Option<DVec2>, context: &Context) -> Result<(Adding, End), String> {
        let active = context.selection.active();
        let found = active.and_then(|id| Some((id, context.document.curve(id)?)));
        let Some((id, curve)) = found else {
            return Err("There is no curve to add to: draw one with D".into());
        };
        curve
            .check_editable()
            .map_err(|refused| refused.to_string())?;
        let polygon = &curve.polygon;
        let count = polygon.vertices().len();
        let distance =
            |index: usize, at| context.viewport.flatten(polygon.vertex(index)).distance(at);
        let is_start = match at {
            Some(at) => distance(0, at) < distance(count - 1, at),
            // Go on where the last one was added.
            None => context.selection.vertices().eq([(id, 0)]),
        };
        let end = if is_start { End::Start } else { End::Finish };
        let index = match end {
            End::Start => 0,
            End::Finish => count,
        };
        let like = polygon.vertex(index.saturating_sub(1));
        let adding = Adding {
            id,
            curve: curve.clone(),
            index,
            like,
            base: like,
        };
        Ok((adding, end))
    }

    /// What is added where something is typed: a point at the end that is nearer to it, otherwise at
    /// the one that is nearer to the pointer.
    fn plan_typed(
        &self,
        typed: TypedPoint,
        context: &Context,
    ) -> Result<(Adding, DVec3), EntryError> {
        let at = if typed.is_relative() {
            context.pointer
        } else {
            let point = typed.point(None, &context.drawing_plane())?;
            Some(context.viewport.flatten(point))
        };
        let (adding, _) = self.plan(at, context).map_err(EntryError::Refused)?;
        let vertex = adding.typed_vertex(typed, context)?;
        Ok((adding, vertex))
    }

    /// What would be added now.
    fn planned(&self, context: &Context) -> Option<(Adding, DVec3)> {
        if let Some(typed) = context.typed {
            return self.plan_typed(typed, context).ok();
        }
        let at = context.snapped(context.pointer?, &Carried::default());
        let (adding, _) = self.plan(Some(at), context).ok()?;
        let vertex = adding.vertex_at(at, self.locks, context);
        Some((adding, vertex))
    }
}

impl DrawingTool for AddVertexTool {
    fn leg(&self, context: &Context) -> (Option<DVec3>, Option<DVec3>) {
        dragged_leg(self.adding.as_ref(), self.locks, context)
            .unwrap_or_else(|| planned_leg(self.planned(context)))
    }

    fn locks(&self) -> LegLocks {
        self.locks
    }

    fn set_locks(&mut self, locks: LegLocks) {
        self.locks = locks;
    }

    fn enter(&mut self, typed: TypedPoint, context: &Context) -> Result<Vec<Effect>, EntryError> {
        if let Some(ended) = Adding::end_at(&mut self.adding, typed, context) {
            return ended;
        }
        let (adding, vertex) = self.plan_typed(typed, context)?;
        Ok(adding.once(ADD, vertex))
    }

    fn proposal(&self, context: &Context) -> Option<FloatPolygon> {
        let (adding, vertex) = self.planned(context).filter(|_| self.adding.is_none())?;
        adding.polygon(vertex)
    }
}

/// The leg of a vertex that would be set now.
fn planned_leg(planned: Option<(Adding, DVec3)>) -> (Option<DVec3>, Option<DVec3>) {
    planned
        .map(|(adding, vertex)| (adding.base, vertex))
        .unzip()
}

/// The leg of a vertex that is dragged.
fn dragged_leg(
    adding: Option<&Adding>,
    locks: LegLocks,
    context: &Context,
) -> Option<(Option<DVec3>, Option<DVec3>)> {
    let adding = adding?;
    let typed = context
        .typed
        .map(|typed| adding.typed_vertex(typed, context));
    let at = || {
        let at = context.snapped(context.pointer?, &Carried::default());
        Some(adding.vertex_at(at, locks, context))
    };
    let vertex = typed.map_or_else(at, Result::ok);
    Some((Some(adding.base), vertex))
}

impl Tool for AddVertexTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        let (Gesture::Click(place) | Gesture::DragStart(place)) = gesture else {
            return Adding::next(&mut self.adding, self.locks, gesture, context);
        };
        let at = context.snapped(context.model(place), &Carried::default());
        match self.plan(Some(at), context) {
            Err(reason) => vec![Effect::Say(reason)],
            Ok((adding, _)) => {
                let vertex = adding.vertex_at(at, self.locks, context);
                if matches!(gesture, Gesture::Click(_)) {
                    return adding.once(ADD, vertex);
                }
                let effects = adding.start(ADD, vertex);
                self.adding = Some(adding);
                effects
            }
        }
    }

    fn begins(&self, gesture: Gesture, context: &Context) -> bool {
        let (Gesture::Click(place) | Gesture::DragStart(place)) = gesture else {
            return false;
        };
        let at = context.snapped(context.model(place), &Carried::default());
        self.plan(Some(at), context).is_ok()
    }

    fn hint(&self, context: &Context) -> String {
        match context.pointer.map(|at| self.plan(Some(at), context)) {
            Some(Ok((_, end))) => {
                format!(
                    "Click to add a vertex at the {} of the polygon, or type x,y; Esc ends",
                    end.name()
                )
            }
            Some(Err(reason)) => reason,
            None => {
                "Click beside the first or last vertex to add one, or type x,y; Esc ends".into()
            }
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let planned = self.planned(context).filter(|_| self.adding.is_none());
        new_vertex_marks(planned, context)
    }
}

/// The leg to a vertex that would be set, and the vertex.
fn new_vertex_marks(planned: Option<(Adding, DVec3)>, context: &Context) -> Vec<Mark> {
    let Some((adding, vertex)) = planned else {
        return Vec::new();
    };
    let [from, at] = [adding.base, vertex].map(|point| context.viewport.flatten(point));
    vec![Mark::Guide([from, at]), Mark::NewVertex(at)]
}

/// Insert a vertex into a leg.
#[derive(Debug, Default)]
pub struct InsertTool {
    adding: Option<Adding>,
    locks: LegLocks,
}

impl InsertTool {
    fn plan(hit: LegHit, context: &Context) -> Result<Adding, String> {
        let Some(found) = context.document.curve(hit.curve) else {
            return Err(String::new());
        };
        found
            .check_editable()
            .map_err(|refused| refused.to_string())?;
        let vertices = found.polygon.vertices();
        let ends = vertices
            .get(hit.index)
            .zip(vertices.iter().cycle().nth(hit.index + 1));
        let Some((from, to)) = ends else {
            return Err(String::new());
        };
        Ok(Adding {
            id: hit.curve,
            curve: found.clone(),
            index: hit.index + 1,
            like: from.lerp(*to, hit.share),
            base: *from,
        })
    }

    /// The leg that the pointer is at.
    fn hit(context: &Context) -> Option<LegHit> {
        let place = context.viewport.to_screen(context.pointer?);
        context.hits.leg(place, LEG_REACH)
    }

    /// What would be inserted now.
    fn planned(&self, context: &Context) -> Option<(Adding, DVec3)> {
        let hit = Self::hit(context)?;
        let adding = Self::plan(hit, context).ok()?;
        let vertex = match context.typed {
            Some(typed) => adding.typed_vertex(typed, context).ok()?,
            None => adding.vertex_at(hit.point, self.locks, context),
        };
        Some((adding, vertex))
    }
}

impl DrawingTool for InsertTool {
    fn leg(&self, context: &Context) -> (Option<DVec3>, Option<DVec3>) {
        dragged_leg(self.adding.as_ref(), self.locks, context)
            .unwrap_or_else(|| planned_leg(self.planned(context)))
    }

    fn locks(&self) -> LegLocks {
        self.locks
    }

    fn set_locks(&mut self, locks: LegLocks) {
        self.locks = locks;
    }

    fn enter(&mut self, typed: TypedPoint, context: &Context) -> Result<Vec<Effect>, EntryError> {
        if let Some(ended) = Adding::end_at(&mut self.adding, typed, context) {
            return ended;
        }
        let hit = Self::hit(context).ok_or_else(|| EntryError::Refused(NO_LEG.into()))?;
        let adding = Self::plan(hit, context).map_err(EntryError::Refused)?;
        let vertex = adding.typed_vertex(typed, context)?;
        Ok(adding.once(INSERT, vertex))
    }

    fn proposal(&self, context: &Context) -> Option<FloatPolygon> {
        let (adding, vertex) = self.planned(context).filter(|_| self.adding.is_none())?;
        adding.polygon(vertex)
    }
}

impl Tool for InsertTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        let (Gesture::Click(place) | Gesture::DragStart(place)) = gesture else {
            return Adding::next(&mut self.adding, self.locks, gesture, context);
        };
        let Some(hit) = context.hits.leg(place, LEG_REACH) else {
            return vec![Effect::Say(NO_LEG.into())];
        };
        match Self::plan(hit, context) {
            Err(reason) => vec![Effect::Say(reason)],
            Ok(adding) => {
                let vertex = adding.vertex_at(hit.point, self.locks, context);
                if matches!(gesture, Gesture::Click(_)) {
                    return adding.once(INSERT, vertex);
                }
                let effects = adding.start(INSERT, vertex);
                self.adding = Some(adding);
                effects
            }
        }
    }

    fn begins(&self, gesture: Gesture, context: &Context) -> bool {
        let (Gesture::Click(place) | Gesture::DragStart(place)) = gesture else {
            return false;
        };
        let hit = context.hits.leg(place, LEG_REACH);
        hit.is_some_and(|hit| Self::plan(hit, context).is_ok())
    }

    fn hint(&self, _context: &Context) -> String {
        match self.adding {
            Some(_) => "Release to place the new vertex; Esc cancels".into(),
            None => {
                "Click on a leg to split it, or drag or type where the new vertex goes; Esc ends"
                    .into()
            }
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let planned = self.planned(context).filter(|_| self.adding.is_none());
        new_vertex_marks(planned, context)
    }
}

/// Delete the vertices that are clicked.
#[derive(Debug, Default)]
pub struct DeleteTool;

impl Tool for DeleteTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        match gesture {
            Gesture::Click(place) => match context.hits.vertex(place) {
                Some((curve, index)) => delete(curve, index, context),
                None => Vec::new(),
            },
            Gesture::Key(crate::editor::hand::input::Key::Escape) => vec![Effect::Finish],
            _ => Vec::new(),
        }
    }

    fn begins(&self, gesture: Gesture, context: &Context) -> bool {
        matches!(gesture, Gesture::Click(place) if context.hits.vertex(place).is_some())
    }

    fn hint(&self, _context: &Context) -> String {
        "Click a vertex to delete it; Esc ends".into()
    }
}

fn delete(curve: CurveId, index: usize, context: &Context) -> Vec<Effect> {
    let Some(found) = context.document.curve(curve) else {
        return Vec::new();
    };
    match deletion(curve, found, &[index]) {
        Ok(edit) => vec![
            Effect::Select(Vec::new()),
            Effect::Activate(curve),
            Effect::Apply("Delete vertex".into(), vec![edit]),
            Effect::Say(format!("Vertex {index} of {} deleted", quoted(&found.name))),
        ],
        Err(refused) => vec![Effect::Say(refused.to_string())],
    }
}
