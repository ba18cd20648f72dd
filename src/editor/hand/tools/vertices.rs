//! Tools that change the number of vertices: add at an end, insert into a leg, delete.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::tool::{Context, Effect, Tool};
use crate::document::{Curve, CurveId, quoted};
use crate::editor::commands::polygon_edits::{deletion, insertion};
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::snapping::Carried;
use crate::editor::view::hit::LegHit;
use crate::editor::view::scene::Mark;
use crate::geometry::End;

/// Legs are found from this far, in screen points, when a vertex shall be inserted.
const LEG_REACH: f64 = 24.0;

/// Add vertices at the end of the active curve that is nearer to the pointer.
#[derive(Debug, Default)]
pub struct AddVertexTool {
    adding: Option<Adding>,
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
}

impl Adding {
    fn preview(&self, at: DVec2, context: &Context) -> Effect {
        let by = at - context.viewport.flatten(self.like);
        let vertex = self.like + context.movement(by, self.curve.polygon.is_planar());
        match insertion(self.id, &self.curve, self.index, vertex) {
            Ok(edit) => Effect::Preview(vec![edit]),
            Err(error) => Effect::Say(error.to_string()),
        }
    }

    /// All effects of a gesture that places one vertex.
    fn once(&self, label: &str, at: DVec2, context: &Context) -> Vec<Effect> {
        vec![
            Effect::Activate(self.id),
            Effect::Begin(label.to_owned()),
            self.preview(at, context),
            Effect::Select(vec![(self.id, self.index)]),
            Effect::Commit,
        ]
    }

    fn start(&self, label: &str, at: DVec2, context: &Context) -> Vec<Effect> {
        let mut effects = self.once(label, at, context);
        effects.pop();
        effects
    }

    fn next(slot: &mut Option<Self>, gesture: Gesture, context: &Context) -> Vec<Effect> {
        match (gesture, slot.as_ref()) {
            (Gesture::Drag(place), Some(adding)) => {
                // It was not there before, so every vertex may attract it.
                let at = context.snapped(context.model(place), &Carried::default());
                vec![adding.preview(at, context)]
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
}

impl AddVertexTool {
    fn plan(&self, at: DVec2, context: &Context) -> Result<(Adding, End), String> {
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
        let distance = |index: usize| context.viewport.flatten(polygon.vertex(index)).distance(at);
        let end = if distance(0) < distance(count - 1) {
            End::Start
        } else {
            End::Finish
        };
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
        };
        Ok((adding, end))
    }
}

impl Tool for AddVertexTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        let (Gesture::Click(place) | Gesture::DragStart(place)) = gesture else {
            return Adding::next(&mut self.adding, gesture, context);
        };
        let at = context.snapped(context.model(place), &Carried::default());
        match self.plan(at, context) {
            Err(reason) => vec![Effect::Say(reason)],
            Ok((adding, _)) if matches!(gesture, Gesture::Click(_)) => {
                adding.once("Add vertex", at, context)
            }
            Ok((adding, _)) => {
                let effects = adding.start("Add vertex", at, context);
                self.adding = Some(adding);
                effects
            }
        }
    }

    fn hint(&self, context: &Context) -> String {
        match context.pointer.map(|at| self.plan(at, context)) {
            Some(Ok((_, end))) => {
                format!(
                    "Click to add a vertex at the {} of the polygon; Esc ends",
                    end.name()
                )
            }
            Some(Err(reason)) => reason,
            None => "Click beside the first or last vertex to add one; Esc ends".into(),
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let (None, Some(pointer)) = (&self.adding, context.pointer) else {
            return Vec::new();
        };
        let at = context.snapped(pointer, &Carried::default());
        let Ok((adding, _)) = self.plan(at, context) else {
            return Vec::new();
        };
        let beside = adding.index.saturating_sub(1);
        let from = context
            .viewport
            .flatten(adding.curve.polygon.vertex(beside));
        vec![Mark::Guide([from, at]), Mark::NewVertex(at)]
    }
}

/// Insert a vertex into a leg.
#[derive(Debug, Default)]
pub struct InsertTool {
    adding: Option<Adding>,
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
        })
    }
}

impl Tool for InsertTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        let (Gesture::Click(place) | Gesture::DragStart(place)) = gesture else {
            return Adding::next(&mut self.adding, gesture, context);
        };
        let Some(hit) = context.hits.leg(place, LEG_REACH) else {
            return vec![Effect::Say(
                "There is no leg here: click on a leg of a float S-polygon".into(),
            )];
        };
        match Self::plan(hit, context) {
            Err(reason) => vec![Effect::Say(reason)],
            Ok(adding) if matches!(gesture, Gesture::Click(_)) => {
                adding.once("Insert vertex", hit.point, context)
            }
            Ok(adding) => {
                let effects = adding.start("Insert vertex", hit.point, context);
                self.adding = Some(adding);
                effects
            }
        }
    }

    fn hint(&self, _context: &Context) -> String {
        match self.adding {
            Some(_) => "Release to place the new vertex; Esc cancels".into(),
            None => "Click on a leg to split it; press and drag to place the new vertex; Esc ends"
                .into(),
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let place = context
            .pointer
            .map(|pointer| context.viewport.to_screen(pointer));
        let hit = place
            .filter(|_| self.adding.is_none())
            .and_then(|p| context.hits.leg(p, LEG_REACH));
        hit.map(|hit| Mark::NewVertex(hit.point))
            .into_iter()
            .collect()
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
