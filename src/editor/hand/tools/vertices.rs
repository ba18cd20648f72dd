//! Tools that make new vertices: at an end, or into a leg.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::draw_way::DrawWay;
use super::tool::{Context, Effect, Entry, Tool, pointer_label};
use crate::document::{Curve, CurveId, Edit};
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::input::Key;
use crate::editor::hand::snapping::Carried;
use crate::editor::hand::typed_point::{EntryError, TypedPoint};
use crate::editor::polygon_edits::{continuation, insertion, number_of_inserted, replacement};
use crate::editor::same_shape::{LastSameShape, SameShape};
use crate::editor::view::hit::LegHit;
use crate::editor::view::scene::Mark;
use crate::editor::view::viewport::Viewport;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::{End, FloatPolygon, PolygonError, rounded_up};
use crate::operations::feature_change;

/// Legs are found from this far, in screen points, when a vertex shall be inserted.
const LEG_REACH: f64 = 24.0;

/// The message where there is no leg to insert a vertex into.
const NO_LEG: &str = "There is no leg here: click on a curve or on a leg of its float S-polygon";

/// Make new vertices of a polygon.
#[derive(Debug)]
pub struct NewVertexTool {
    place: NewVertex,
    /// The vertex that is dragged until the button is released.
    dragged: Option<Adding>,
    last_shape: LastSameShape,
}

/// Where a new vertex goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NewVertex {
    /// To the end of the active curve that is nearer to the pointer.
    AtEnd,
    /// Into the leg under the pointer.
    IntoLeg,
}

/// A vertex that is being added.
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
    /// The polygon with it that keeps the shape, unless the other vertices stay.
    same: Option<Arc<SameShape>>,
    /// The end from which the curve goes on to the point, unless it is a vertex of the polygon.
    end: Option<End>,
    /// Where a drag began of a vertex that keeps the shape, and so was not under the pointer.
    pressed: Option<DVec2>,
}

impl Adding {
    /// The vertex that is added to the active curve at the end nearer to a place of the view plane.
    fn at_end(at: Option<DVec2>, context: &Context) -> Result<Self, String> {
        let active = context.selection.active();
        let found = active.and_then(|id| Some((id, context.document.curve(id)?)));
        let Some((id, curve)) = found else {
            return Err("There is no curve to add to: draw one with D".into());
        };
        curve.check_editable().map_err(|error| error.to_string())?;
        let polygon = &curve.polygon;
        let goes_on = context.settings.draw.way.ends_on_clicks() && !polygon.is_periodic();
        let last = polygon.vertices().len() - 1;
        let [start, finish] = match goes_on {
            true => [End::Start, End::Finish].map(|end| polygon.end_jet(end).point),
            false => [0, last].map(|index| polygon.vertex(index)),
        };
        let is_start = match at {
            Some(at) => {
                let distance = |point| context.viewport.flatten(point).distance(at);
                distance(start) < distance(finish)
            }
            // Go on where the last one was added.
            None => context.selection.vertices().eq([(id, 0)]),
        };
        let (index, like, end) = match is_start {
            true => (0, start, End::Start),
            false => (last + 1, finish, End::Finish),
        };
        if goes_on {
            let tail = polygon.tail(end);
            let unlocked = curve.check_vertices_unlocked(tail);
            unlocked.map_err(|error| error.to_string())?;
        }
        Ok(Self {
            id,
            curve: curve.clone(),
            index,
            like,
            base: like,
            same: None,
            end: goes_on.then_some(end),
            pressed: None,
        })
    }

    /// What the new vertex does to the curve where it does not keep its shape: which numbers of features it changes, and
    /// how far the curve moves that goes on from an end.
    fn changes(&self, vertex: DVec3, unit: Option<LengthUnit>) -> Option<String> {
        let before = &self.curve.polygon;
        let change = feature_change(before, &self.polygon(vertex)?);
        let moved = self.moved(vertex, unit);
        let told: Vec<String> = moved.into_iter().chain(change).collect();
        (!told.is_empty()).then(|| told.join("; "))
    }

    /// How far the curve moves that goes on from an end to a point.
    fn moved(&self, to: DVec3, unit: Option<LengthUnit>) -> Option<String> {
        let (end, before) = (self.end?, &self.curve.polygon);
        let longer = before.continued(end, to).ok()?;
        let count = before.vertices().len();
        let part = match end {
            End::Start => 1..count + 1,
            End::Finish => 0..count,
        };
        let weights = longer.weights().map(|it| it[part.clone()].to_vec());
        let vertices = longer.vertices()[part].to_vec();
        let part = FloatPolygon::new(before.degree(), vertices, weights, false).ok()?;
        let most = rounded_up(before.deviation(&part).ok()?);
        Some(format!(
            "The curve before it moves by at most {}",
            LengthUnit::behind(unit, most)
        ))
    }

    /// The vertex that is inserted into a leg.
    fn into_leg(
        hit: LegHit,
        last_shape: &LastSameShape,
        context: &Context,
    ) -> Result<Self, String> {
        let curve = context.document.curve(hit.curve).ok_or_else(String::new)?;
        curve.check_editable().map_err(|error| error.to_string())?;
        let vertices = curve.polygon.vertices();
        let to = vertices.iter().cycle().nth(hit.index + 1);
        let (from, to) = vertices.get(hit.index).zip(to).ok_or_else(String::new)?;
        let same = match context.settings.vertices_stay {
            true => None,
            false => Some(last_shape.of(curve, 1)?),
        };
        let index = hit.index + 1;
        let like = same.as_ref().map(|same| same.polygon.vertex(index));
        Ok(Self {
            id: hit.curve,
            curve: curve.clone(),
            index,
            like: like.unwrap_or(from.lerp(*to, hit.share)),
            base: *from,
            same,
            end: None,
            pressed: None,
        })
    }

    /// The vertex that is meant by a place of the view plane. What keeps the shape stands where it must.
    fn vertex_at(&self, at: DVec2, context: &Context) -> DVec3 {
        match self.same {
            Some(_) => self.like,
            None => self.moved_to(at, context),
        }
    }

    /// The vertex where a drag is. It was not there before, so every vertex may attract it.
    fn dragged_to(&self, at: DVec2, context: &Context) -> DVec3 {
        let at = match self.pressed {
            Some(pressed) => context.viewport.flatten(self.like) + (at - pressed),
            None => at,
        };
        self.moved_to(context.snapped(at, &Carried::default()), context)
    }

    fn moved_to(&self, at: DVec2, context: &Context) -> DVec3 {
        let by = at - context.viewport.flatten(self.like);
        if by == DVec2::ZERO {
            return self.like;
        }
        let free = self.like + context.movement(by, self.curve.polygon.is_planar());
        let locks = context.settings.locks;
        locks.constrained(self.base, free, &context.drawing_plane())
    }

    fn typed_vertex(&self, typed: TypedPoint, context: &Context) -> Result<DVec3, EntryError> {
        typed.point(Some(self.base), &context.drawing_plane())
    }

    fn preview(&self, vertex: DVec3) -> Effect {
        Effect::preview(self.edit(vertex).map(|edit| vec![edit]))
    }

    fn edit(&self, vertex: DVec3) -> Result<Edit, PolygonError> {
        let (id, curve) = (self.id, &self.curve);
        match (&self.same, self.end) {
            (None, None) => insertion(id, curve, self.index, vertex),
            (None, Some(end)) => continuation(id, curve, end, vertex),
            (Some(same), _) => {
                let mut polygon = same.polygon.clone();
                let mut moves = vec![(self.index, vertex)];
                if let Some(symmetry) = curve.symmetry {
                    let symmetry = symmetry.renumbered(&polygon);
                    polygon = symmetry.completed(&polygon, |_| true)?;
                    moves = symmetry.with_images(&moves, polygon.vertices().len());
                }
                polygon.move_vertices(moves)?;
                Ok(replacement(id, curve, polygon))
            }
        }
    }

    /// The number of the new vertex.
    fn number(&self) -> usize {
        match (&self.same, self.end) {
            (None, None) => number_of_inserted(&self.curve, self.index),
            (Some(_), _) | (_, Some(_)) => self.index,
        }
    }

    /// The polygon with the vertex.
    fn polygon(&self, vertex: DVec3) -> Option<FloatPolygon> {
        match self.edit(vertex) {
            Ok(Edit::Renumber { polygon, .. }) => Some(polygon),
            _ => None,
        }
    }
}

/// The leg near a place, or beside the curve there.
fn leg_at(place: DVec2, context: &Context) -> Option<LegHit> {
    let near = context.hits.leg(place, LEG_REACH);
    near.or_else(|| {
        let curve = context.hits.curve(place)?.curve;
        let leg = context.hits.leg(place, f64::INFINITY);
        leg.filter(|leg| leg.curve == curve)
    })
}

impl NewVertexTool {
    /// Take a tool that makes new vertices in one place.
    pub fn new(place: NewVertex) -> Self {
        Self {
            place,
            dragged: None,
            last_shape: LastSameShape::default(),
        }
    }

    /// The vertex that a click adds at a place, given on the canvas and in the view plane.
    fn plan(&self, [place, at]: [DVec2; 2], context: &Context) -> Result<(Adding, DVec3), String> {
        let (adding, at) = match self.place {
            NewVertex::AtEnd => {
                let at = context.snapped(at, &Carried::default());
                (Adding::at_end(Some(at), context)?, at)
            }
            NewVertex::IntoLeg => {
                let hit = leg_at(place, context).ok_or(NO_LEG)?;
                (Adding::into_leg(hit, &self.last_shape, context)?, hit.point)
            }
        };
        let vertex = adding.vertex_at(at, context);
        Ok((adding, vertex))
    }

    /// What is added where something is typed: a point at the end that is nearer to it, otherwise where the
    /// pointer says.
    fn plan_typed(
        &self,
        typed: TypedPoint,
        context: &Context,
    ) -> Result<(Adding, DVec3), EntryError> {
        let adding = match self.place {
            NewVertex::AtEnd if typed.is_relative => Adding::at_end(context.pointer, context),
            NewVertex::AtEnd => {
                let point = typed.point(None, &context.drawing_plane())?;
                Adding::at_end(Some(context.viewport.flatten(point)), context)
            }
            NewVertex::IntoLeg => {
                let place = context.place();
                let hit = place.and_then(|place| leg_at(place, context));
                let hit = hit.ok_or_else(|| NO_LEG.to_owned());
                hit.and_then(|hit| Adding::into_leg(hit, &self.last_shape, context))
            }
        };
        let adding = adding.map_err(EntryError::Refused)?;
        let vertex = adding.typed_vertex(typed, context)?;
        Ok((adding, vertex))
    }

    /// The vertex that a click adds now, unless a vertex is dragged.
    fn planned(&self, context: &Context) -> Option<(Adding, DVec3)> {
        if self.dragged.is_some() {
            return None;
        }
        match context.typed {
            Some(typed) => self.plan_typed(typed, context).ok(),
            None => self
                .plan([context.place()?, context.pointer?], context)
                .ok(),
        }
    }

    /// What a click would do: into a leg to the curve that keeps its shape, or why it cannot; beyond an end to the curve
    /// that goes on there.
    fn told(&self, context: &Context) -> Option<String> {
        if self.place == NewVertex::AtEnd {
            let (adding, vertex) = self.planned(context)?;
            return adding.moved(vertex, context.document.unit());
        }
        let is_asked = self.dragged.is_none();
        let place = context
            .place()
            .filter(|_| is_asked && !context.settings.vertices_stay)?;
        let hit = context.hits.leg(place, LEG_REACH)?;
        match Adding::into_leg(hit, &self.last_shape, context) {
            Ok(adding) => Some(adding.same?.told(context.document.unit())),
            Err(refused) => Some(refused),
        }
    }

    /// Let the next click end the curve, or add a vertex of the polygon.
    fn change_way(&self, context: &Context) -> Vec<Effect> {
        let way = match context.settings.draw.way.ends_on_clicks() {
            true => DrawWay::Vertices,
            false => DrawWay::OnClicks,
        };
        vec![
            context.set(|settings| settings.draw.way = way),
            Effect::Say(way.label().to_owned()),
        ]
    }

    /// The effects of beginning a gesture that makes a vertex.
    fn begin(&self, adding: &Adding, vertex: DVec3) -> Vec<Effect> {
        let label = match self.place {
            NewVertex::AtEnd => "Add vertex",
            NewVertex::IntoLeg => "Insert vertex",
        };
        vec![
            Effect::Activate(adding.id),
            Effect::Begin(label.to_owned()),
            adding.preview(vertex),
            Effect::Select(vec![(adding.id, adding.number())]),
        ]
    }

    /// Go on with a drag.
    fn go_on(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        match (gesture, self.dragged.take()) {
            (Gesture::Drag(place), Some(adding)) => {
                let vertex = adding.dragged_to(context.model(place), context);
                let preview = adding.preview(vertex);
                self.dragged = Some(adding);
                vec![preview]
            }
            (Gesture::DragEnd(_), Some(_)) => vec![Effect::Commit],
            (Gesture::Cancel, Some(_)) => vec![Effect::Abort],
            (Gesture::Key(Key::Escape), None) => vec![Effect::Finish],
            (_, dragged) => {
                self.dragged = dragged;
                Vec::new()
            }
        }
    }
}

impl Tool for NewVertexTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        if gesture == Gesture::Key(Key::Character('t')) && self.place == NewVertex::AtEnd {
            return self.change_way(context);
        }
        let (Gesture::Click(place) | Gesture::DragStart(place)) = gesture else {
            return self.go_on(gesture, context);
        };
        let (adding, vertex) = match self.plan([place, context.model(place)], context) {
            Ok(planned) => planned,
            Err(reason) => return vec![Effect::Say(reason)],
        };
        let mut effects = self.begin(&adding, vertex);
        match gesture {
            Gesture::Click(_) => {
                effects.push(Effect::Commit);
                let same = adding.same.as_ref();
                let unit = context.document.unit();
                let told = match same {
                    Some(same) => Some(same.told(unit)),
                    None => adding.changes(vertex, unit),
                };
                let warns = same.is_some_and(|same| same.adds());
                effects.extend(told.map(if warns { Effect::Warn } else { Effect::Say }));
            }
            _ => {
                let pressed = adding.same.as_ref().map(|_| context.model(place));
                self.dragged = Some(Adding { pressed, ..adding });
            }
        }
        effects
    }

    fn begins(&self, gesture: Gesture, context: &Context) -> bool {
        let (Gesture::Click(place) | Gesture::DragStart(place)) = gesture else {
            return false;
        };
        self.plan([place, context.model(place)], context).is_ok()
    }

    fn hint(&self, context: &Context) -> String {
        let hint = match (self.place, &self.dragged) {
            (NewVertex::AtEnd, _) => {
                match context.pointer.map(|at| Adding::at_end(Some(at), context)) {
                    Some(Ok(adding)) => {
                        let end = if adding.index == 0 {
                            End::Start
                        } else {
                            End::Finish
                        };
                        let name = end.name();
                        return match adding.end {
                            Some(_) => format!(
                                "Click where the curve's {name} goes on to, or type x,y; Esc ends"
                            ),
                            None => format!(
                                "Click to add a vertex at the {name} of the polygon, or type x,y; Esc ends"
                            ),
                        };
                    }
                    Some(Err(reason)) => return reason,
                    None if context.settings.draw.way.ends_on_clicks() => {
                        "Click where the curve goes on to, or type x,y; Esc ends"
                    }
                    None => {
                        "Click beside the first or last vertex to add one, or type x,y; Esc ends"
                    }
                }
            }
            (NewVertex::IntoLeg, Some(_)) => "Release to place the new vertex; Esc cancels",
            (NewVertex::IntoLeg, None) if !context.settings.vertices_stay => {
                match self.told(context) {
                    Some(told) => return format!("Click or drag to insert a vertex. {told}"),
                    None => "Click on the curve or on a leg to insert a vertex; Esc ends",
                }
            }
            (NewVertex::IntoLeg, None) => {
                "Click on a leg to split it, or drag or type where the new vertex goes; Esc ends"
            }
        };
        hint.to_owned()
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let told = pointer_label(self.told(context), context);
        let Some((adding, vertex)) = self.planned(context) else {
            return told.into_iter().collect();
        };
        let [from, at] = [adding.base, vertex].map(|point| context.viewport.flatten(point));
        let marks = [Mark::Guide([from, at]), Mark::NewVertex(at)];
        marks.into_iter().chain(told).collect()
    }

    fn entry(&self, viewport: &Viewport) -> Option<Entry> {
        Some(Entry::point(viewport))
    }

    fn enter(&mut self, typed: TypedPoint, context: &Context) -> Result<Vec<Effect>, EntryError> {
        let mut effects = match &self.dragged {
            Some(adding) => vec![adding.preview(adding.typed_vertex(typed, context)?)],
            None => {
                let (adding, vertex) = self.plan_typed(typed, context)?;
                self.begin(&adding, vertex)
            }
        };
        self.dragged = None;
        effects.push(Effect::Commit);
        Ok(effects)
    }

    fn leg(&self, context: &Context) -> (Option<DVec3>, Option<DVec3>) {
        let Some(adding) = &self.dragged else {
            let planned = self.planned(context);
            return planned
                .map(|(adding, vertex)| (adding.base, vertex))
                .unzip();
        };
        let vertex = match context.typed {
            Some(typed) => adding.typed_vertex(typed, context).ok(),
            None => context.pointer.map(|at| adding.dragged_to(at, context)),
        };
        (Some(adding.base), vertex)
    }

    fn proposal(&self, context: &Context) -> Option<FloatPolygon> {
        let (adding, vertex) = self.planned(context)?;
        adding.polygon(vertex)
    }
}
