//! Draw a new float S-polygon, click by click.

use glam::{DVec2, DVec3};

use super::tool::{Context, Effect, Entry, Tool};
use crate::document::{Curve, Edit};
use crate::editor::hand::gesture::{Gesture, is_hasty_click};
use crate::editor::hand::input::Key;
use crate::editor::hand::snapping::{Carried, along_axis, by_fifteen_degrees};
use crate::editor::hand::typed_point::{EntryError, TypedPoint};
use crate::editor::view::hit::REACH;
use crate::editor::view::scene::Mark;
use crate::editor::view::viewport::Viewport;
use crate::geometry::{FloatPolygon, MAX_MAGNITUDE, PolygonError, counted};

/// The degree that a drawn curve gets if there is no active curve to take it from.
const DEGREE: usize = 5;

/// The draw tool's state: the vertices so far.
#[derive(Debug, Default)]
pub struct DrawTool {
    points: Vec<DVec3>,
    /// Where the drag that goes on began.
    pressed: Option<DVec2>,
}

/// The degree that is wanted.
pub(in crate::editor) fn drawn_degree(context: &Context) -> usize {
    let active = || context.document.curve(context.selection.active()?);
    let degree = context.settings.draw.degree;
    degree.unwrap_or_else(|| active().map_or(DEGREE, |curve| curve.polygon.degree()))
}

impl DrawTool {
    /// The polygon of some vertices: of the degree that is wanted, or the highest that they have.
    fn polygon(
        &self,
        points: Vec<DVec3>,
        periodic: bool,
        context: &Context,
    ) -> Result<FloatPolygon, PolygonError> {
        if context.settings.draw.through_ends && !periodic {
            return FloatPolygon::through_ends(drawn_degree(context), &points);
        }
        let degree = self.highest_degree(points.len(), context);
        FloatPolygon::new(degree, points, None, periodic)
    }

    /// The degree that is wanted, or the highest that so many vertices have.
    fn highest_degree(&self, vertices: usize, context: &Context) -> usize {
        drawn_degree(context).min(vertices.saturating_sub(1)).max(1)
    }

    /// The vertex that a click at a place of the view plane sets.
    fn vertex_at(&self, at: DVec2, context: &Context) -> DVec3 {
        let free = context.viewport.grounded(self.next(at, context));
        match self.points.last() {
            Some(last) => {
                let locks = context.settings.locks;
                locks.constrained(*last, free, &context.drawing_plane())
            }
            None => free,
        }
    }

    /// Set a vertex, unless it is the last one: the second press of a double click sets none of its own.
    fn set(&mut self, vertex: DVec3, apart: f64) {
        let last = self.points.last();
        if last.is_none_or(|last| last.distance(vertex) > apart) {
            self.points.push(vertex);
        }
    }

    /// Where a click would put the next vertex: Shift keeps to multiples of 15°.
    fn next(&self, at: DVec2, context: &Context) -> DVec2 {
        let last = self.points.last().filter(|_| context.modifiers.shift);
        let Some(last) = last else {
            return context.snapped(at, &Carried::default());
        };
        let last = context.viewport.flatten(*last);
        let leg = at - last;
        let angle = by_fifteen_degrees(leg.to_angle());
        let constrained = DVec2::from_angle(angle);
        if constrained.abs().min_element() < 1e-9 {
            return last + along_axis(leg);
        }
        last + leg.dot(constrained) * constrained
    }

    /// Whether a press that ends here was a click on the first vertex, were it a hasty one.
    fn closes_by_hasty_click(&self, end: DVec2, context: &Context) -> bool {
        let from = self.pressed.filter(|from| is_hasty_click(*from, end));
        from.is_some_and(|from| self.closes(from, context) || self.closes(end, context))
    }

    fn closes(&self, place: DVec2, context: &Context) -> bool {
        let first = self.points.first().filter(|_| self.points.len() >= 3);
        first.is_some_and(|first| {
            let first = context.viewport.flatten(*first);
            context.viewport.to_screen(first).distance(place) <= REACH
        })
    }

    fn finish(&mut self, periodic: bool, context: &Context) -> Vec<Effect> {
        let points = std::mem::take(&mut self.points);
        let wanted = drawn_degree(context);
        match self.polygon(points.clone(), periodic, context) {
            Ok(polygon) => {
                let id = context.document.next_id();
                let name = context.document.free_name("curve 1");
                let (count, degree) = (polygon.vertices().len(), polygon.degree());
                let curve = Curve::new(name, polygon);
                vec![
                    Effect::Apply("Draw curve".into(), vec![Edit::Add(Box::new(curve))]),
                    Effect::Select(Vec::new()),
                    Effect::Activate(id),
                    Effect::Say(format!(
                        "{}, degree {degree}{}",
                        counted(count, "vertex", "vertices"),
                        if degree < wanted {
                            ": add vertices to raise it"
                        } else {
                            ""
                        }
                    )),
                    Effect::Finish,
                ]
            }
            Err(_) if points.is_empty() => vec![Effect::Finish],
            Err(error) => {
                self.points = points;
                vec![Effect::Say(error.to_string())]
            }
        }
    }
}

impl Tool for DrawTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        match gesture {
            Gesture::Click(place) if self.closes(place, context) => self.finish(true, context),
            Gesture::DragStart(place) => {
                self.pressed = Some(place);
                Vec::new()
            }
            Gesture::DragEnd(place) if self.closes_by_hasty_click(place, context) => {
                self.finish(true, context)
            }
            // A hasty click is a short drag: the vertex goes where the button is released.
            Gesture::Click(place) | Gesture::DragEnd(place) => {
                let vertex = self.vertex_at(context.model(place), context);
                self.set(vertex, 2.0 * context.viewport.pixel());
                Vec::new()
            }
            Gesture::DoubleClick(_) | Gesture::SecondaryClick(_) | Gesture::Key(Key::Enter) => {
                self.finish(false, context)
            }
            Gesture::Key(Key::Backspace) => {
                self.undo();
                Vec::new()
            }
            Gesture::Key(Key::Escape) if self.points.is_empty() => vec![Effect::Finish],
            Gesture::Key(Key::Escape) => {
                self.points.clear();
                Vec::new()
            }
            _ => Vec::new(),
        }
    }

    fn undo_label(&self) -> Option<&'static str> {
        (!self.points.is_empty()).then_some("last point")
    }

    fn undo(&mut self) {
        self.points.pop();
    }

    fn hint(&self, context: &Context) -> String {
        match self.points.len() {
            0 => "Click to set the first vertex, or type x,y; Esc ends".into(),
            1 | 2 => "Click the next vertex, or type @dx,dy or @length<angle; Shift snaps to 15°, Backspace removes the last one, Esc starts over"
                .into(),
            count => format!(
                "{}, degree {}: Enter or right click ends; click the first vertex to make it periodic",
                counted(count, "vertex", "vertices"),
                match context.settings.draw.through_ends {
                    true => drawn_degree(context),
                    false => self.highest_degree(count, context),
                }
            ),
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let flat = |point: DVec3| context.viewport.flatten(point);
        let (last, vertex) = self.leg(context);
        let leg = last.zip(vertex);
        let leg = leg.map(|(last, vertex)| Mark::Guide([flat(last), flat(vertex)]));
        let vertices = self.points.iter().copied().chain(vertex);
        let vertices = vertices.map(|point| Mark::NewVertex(flat(point)));
        leg.into_iter().chain(vertices).collect()
    }

    fn entry(&self, viewport: &Viewport) -> Option<Entry> {
        Some(Entry::point(viewport))
    }

    fn leg(&self, context: &Context) -> (Option<DVec3>, Option<DVec3>) {
        let last = self.points.last().copied();
        let vertex = match context.typed {
            Some(typed) => typed.point(last, &context.drawing_plane()).ok(),
            None => context.pointer.map(|at| self.vertex_at(at, context)),
        };
        (last, vertex)
    }

    fn enter(&mut self, typed: TypedPoint, context: &Context) -> Result<Vec<Effect>, EntryError> {
        let last = self.points.last().copied();
        let vertex = typed.point(last, &context.drawing_plane())?;
        if !(vertex.abs().max_element() <= MAX_MAGNITUDE) {
            let most = format!("coordinates go up to {MAX_MAGNITUDE:e}");
            return Err(EntryError::Refused(most));
        }
        if last == Some(vertex) {
            return Err(EntryError::Refused(
                "the last vertex is there already".into(),
            ));
        }
        self.pressed = None;
        self.points.push(vertex);
        Ok(Vec::new())
    }

    fn proposal(&self, context: &Context) -> Option<FloatPolygon> {
        let mut points = self.points.clone();
        let closes = context.typed.is_none()
            && context
                .pointer
                .is_some_and(|at| self.closes(context.viewport.to_screen(at), context));
        if closes {
            return self.polygon(points, true, context).ok();
        }
        if let (_, Some(vertex)) = self.leg(context)
            && points.last() != Some(&vertex)
        {
            points.push(vertex);
        }
        if points.len() < 2 {
            return None;
        }
        self.polygon(points, false, context).ok()
    }
}
