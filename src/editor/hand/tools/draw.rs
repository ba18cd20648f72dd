//! Draw a new curve, click by click.

use glam::{DVec2, DVec3};

use super::draw_way::DrawWay;
use super::tool::{Context, Effect, Entry, Tool};
use crate::document::{Curve, Edit, Reference};
use crate::editor::hand::gesture::{Gesture, is_hasty_click};
use crate::editor::hand::input::Key;
use crate::editor::hand::snapping::{along_axis, by_fifteen_degrees};
use crate::editor::hand::typed_point::{EntryError, TypedPoint};
use crate::editor::view::hit::REACH;
use crate::editor::view::scene::Mark;
use crate::editor::view::viewport::Viewport;
use crate::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use crate::geometry::{FloatPolygon, MAX_MAGNITUDE, PolygonError, counted};

/// The degree that a drawn curve gets if there is no active curve to take it from.
const DEGREE: usize = 5;

/// The draw tool's state: the vertices so far.
#[derive(Debug, Default)]
pub struct DrawTool {
    points: Vec<DVec3>,
    /// The points that undo took back, the last one first.
    undone: Vec<DVec3>,
    /// The points that Esc took away.
    discarded: Vec<DVec3>,
    /// Where the drag that goes on began.
    pressed: Option<DVec2>,
    /// Where the pointer rested on the canvas when the last point was typed: until it moves it proposes none.
    typed_at: Option<DVec2>,
}

/// A curve through points that is longer than so many times their polyline is marked.
const LONG: f64 = 1.1;

/// The relative precision of lengths that are compared with that.
const PRECISION: f64 = 1e-3;

/// A pointer that moves by less has not moved, in points of the screen.
const RESTING: f64 = 2.0;

/// The samples of a segment among which the farthest from the polyline is found.
const SAMPLES: usize = 8;

/// The degree that is wanted.
pub(in crate::editor) fn drawn_degree(context: &Context) -> usize {
    let active = || context.document.curve(context.selection.active()?);
    let degree = context.settings.draw.degree;
    degree.unwrap_or_else(|| active().map_or(DEGREE, |curve| curve.polygon.degree()))
}

/// The polygon of some clicks.
fn polygon(
    points: &[DVec3],
    periodic: bool,
    context: &Context,
) -> Result<FloatPolygon, PolygonError> {
    let way = context.settings.draw.way;
    way.polygon(drawn_degree(context), points, periodic)
}

/// A curve that is much longer than the polyline of the points that it passes.
struct Detour {
    /// By how much, as a share.
    longer: f64,
    /// Its point that is farthest from the polyline.
    at: DVec3,
}

impl Detour {
    fn text(&self) -> String {
        let percent = (100.0 * self.longer).round();
        format!("{percent} % longer than the polyline of the points: set more points there")
    }

    fn mark(&self, context: &Context) -> Mark {
        Mark::Extreme {
            at: context.viewport.flatten(self.at),
            text: self.text(),
        }
    }
}

/// The detour that a curve through points makes, if it is one.
fn detour(
    points: &[DVec3],
    polygon: &FloatPolygon,
    periodic: bool,
    context: &Context,
) -> Option<Detour> {
    if context.settings.draw.way != DrawWay::ThroughPoints {
        return None;
    }
    let closing = points.first().filter(|_| periodic);
    let outline: Vec<DVec3> = points.iter().chain(closing).copied().collect();
    let straight: f64 = outline.windows(2).map(|leg| leg[0].distance(leg[1])).sum();
    let length = polygon.arc_length(PRECISION);
    if !(length > LONG * straight) {
        return None;
    }
    let off = |point: &DVec3| {
        let legs = outline.windows(2).map(|leg| {
            let along = leg[1] - leg[0];
            let share = (*point - leg[0]).dot(along) / along.length_squared();
            let share = if share.is_nan() {
                0.0
            } else {
                share.clamp(0.0, 1.0)
            };
            (leg[0] + share * along).distance(*point)
        });
        legs.fold(f64::INFINITY, f64::min)
    };
    let samples = 0..=SAMPLES * polygon.segments();
    let samples = samples.map(|sample| polygon.point(sample as f64 / SAMPLES as f64));
    let at = samples.max_by(|a, b| off(a).total_cmp(&off(b)))?;
    Some(Detour {
        longer: length / straight - 1.0,
        at,
    })
}

impl DrawTool {
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
            self.push(vertex);
        }
    }

    fn push(&mut self, vertex: DVec3) {
        self.discarded.clear();
        self.undone.clear();
        self.points.push(vertex);
    }

    /// Where the pointer is in the view plane, unless it has not moved since a point was typed.
    fn pointer(&self, context: &Context) -> Option<DVec2> {
        let at = context.pointer?;
        let moved = |typed_at: DVec2| context.viewport.to_screen(at).distance(typed_at) > RESTING;
        self.typed_at.is_none_or(moved).then_some(at)
    }

    /// Where a click would put the next vertex: Shift keeps to multiples of 15°.
    fn next(&self, at: DVec2, context: &Context) -> DVec2 {
        let last = self.points.last().filter(|_| context.modifiers.shift);
        let Some(last) = last else {
            let snap = context.drawn_snap(at);
            return snap.map_or(at, |snap| context.viewport.flatten(snap.point));
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
        self.undone.clear();
        let points = std::mem::take(&mut self.points);
        if context.settings.draw.way == DrawWay::Points {
            return self.finish_points(points, periodic, context);
        }
        let wanted = drawn_degree(context);
        match polygon(&points, periodic, context) {
            Ok(polygon) => {
                let id = context.document.next_id();
                let name = context.document.free_name("curve 1");
                let (count, degree) = (polygon.vertices().len(), polygon.degree());
                let more = match degree < wanted {
                    true => ": add vertices to raise it".to_owned(),
                    false => detour(&points, &polygon, periodic, context)
                        .map_or_else(String::new, |detour| format!("; {}", detour.text())),
                };
                let vertices = counted(count, "vertex", "vertices");
                let said = format!("{vertices}, degree {degree}{more}");
                let curve = Curve::new(name, polygon);
                vec![
                    Effect::Apply("Draw curve".into(), vec![Edit::Add(Box::new(curve))]),
                    Effect::Select(Vec::new()),
                    Effect::Activate(id),
                    Effect::Say(said),
                    Effect::Finish,
                ]
            }
            Err(_) if points.is_empty() => vec![Effect::Finish],
            Err(error) => {
                let text = match points.len() {
                    1 => "One point makes no curve: set another".to_owned(),
                    _ => error.to_string(),
                };
                self.points = points;
                vec![Effect::Say(text)]
            }
        }
    }

    /// Add the clicks as a reference, to which a curve can be fitted.
    fn finish_points(
        &mut self,
        points: Vec<DVec3>,
        periodic: bool,
        context: &Context,
    ) -> Vec<Effect> {
        if points.is_empty() {
            return vec![Effect::Finish];
        }
        let closing = points.first().copied().filter(|_| periodic);
        let list = PointList::new(points.iter().copied().chain(closing).collect());
        let curve = list.and_then(|list| ReferenceCurve::of(ReferenceForm::Points(list)));
        match curve {
            Ok(curve) => {
                let id = context.document.next_id();
                let name = context.document.free_name("points 1");
                let said = format!(
                    "{}: fit a curve to them",
                    counted(points.len(), "point", "points")
                );
                let reference = Box::new(Reference::new(name, curve));
                vec![
                    Effect::Apply("Draw points".into(), vec![Edit::AddReference(reference)]),
                    Effect::Select(Vec::new()),
                    Effect::Activate(id),
                    Effect::Say(said),
                    Effect::Finish,
                ]
            }
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
            Gesture::Key(Key::Character('t')) => {
                let way = context.settings.draw.way.next();
                vec![
                    context.set(|settings| settings.draw.way = way),
                    Effect::Say(way.label().to_owned()),
                ]
            }
            Gesture::Key(Key::Escape) if self.points.is_empty() => vec![Effect::Finish],
            Gesture::Key(Key::Escape) => {
                self.discarded = std::mem::take(&mut self.points);
                self.undone.clear();
                vec![Effect::Say(
                    "Drawing cancelled: Ctrl+Z brings it back".into(),
                )]
            }
            _ => Vec::new(),
        }
    }

    fn undo_label(&self) -> Option<&'static str> {
        match (&self.points[..], &self.discarded[..]) {
            ([], []) => None,
            ([], _) => Some("cancelled drawing"),
            _ => Some("last point"),
        }
    }

    fn drawn(&self) -> &[DVec3] {
        &self.points
    }

    fn undo(&mut self) {
        if self.points.is_empty() {
            self.points = std::mem::take(&mut self.discarded);
        } else {
            self.undone.extend(self.points.pop());
        }
    }

    fn redo_label(&self) -> Option<&'static str> {
        (!self.undone.is_empty()).then_some("last point")
    }

    fn redo(&mut self) {
        self.points.extend(self.undone.pop());
    }

    fn hint(&self, context: &Context) -> String {
        match self.points.len() {
            0 => format!(
                "{}: click to set the first point, or type x,y; T changes the way, Esc leaves",
                context.settings.draw.way.label()
            ),
            1 if context.document.is_empty() => {
                "Click the next point, or type it: the distance sets the size of the view".into()
            }
            1 | 2 => {
                "Click the next point, or type @dx,dy or @length<angle; Shift snaps to 15°".into()
            }
            count => format!(
                "{}, degree {}: Enter or right click ends; click the first point to make it periodic",
                counted(count, "point", "points"),
                polygon(&self.points, false, context)
                    .map_or_else(|_| drawn_degree(context), |polygon| polygon.degree()),
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
        let detour = self.proposed(context).and_then(|(points, periodic)| {
            let polygon = polygon(&points, periodic, context).ok()?;
            Some(detour(&points, &polygon, periodic, context)?.mark(context))
        });
        leg.into_iter().chain(vertices).chain(detour).collect()
    }

    fn entry(&self, viewport: &Viewport) -> Option<Entry> {
        Some(Entry::point(viewport))
    }

    fn leg(&self, context: &Context) -> (Option<DVec3>, Option<DVec3>) {
        let last = self.points.last().copied();
        let vertex = match context.typed {
            Some(typed) => typed.point(last, &context.drawing_plane()).ok(),
            None => self.pointer(context).map(|at| self.vertex_at(at, context)),
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
        self.typed_at = context.pointer.map(|at| context.viewport.to_screen(at));
        if self.points.len() >= 3 && self.points.first() == Some(&vertex) {
            return Ok(self.finish(true, context));
        }
        self.push(vertex);
        Ok(Vec::new())
    }

    fn proposal(&self, context: &Context) -> Option<FloatPolygon> {
        let (points, periodic) = self.proposed(context)?;
        polygon(&points, periodic, context).ok()
    }
}

impl DrawTool {
    /// The points with the one that would be set now, and whether that closes the curve.
    fn proposed(&self, context: &Context) -> Option<(Vec<DVec3>, bool)> {
        let mut points = self.points.clone();
        let closes = context.typed.is_none()
            && self
                .pointer(context)
                .is_some_and(|at| self.closes(context.viewport.to_screen(at), context));
        if closes {
            return Some((points, true));
        }
        if let (_, Some(vertex)) = self.leg(context)
            && points.last() != Some(&vertex)
        {
            points.push(vertex);
        }
        (points.len() >= 2).then_some((points, false))
    }
}
