//! Draw a new float S-polygon, click by click.

use glam::{DVec2, DVec3};

use super::tool::{Context, Effect, Tool};
use crate::document::{Curve, Edit};
use crate::editor::hand::gesture::{Gesture, is_hasty_click};
use crate::editor::hand::input::Key;
use crate::editor::hand::snapping::{Carried, along_axis, by_fifteen_degrees};
use crate::editor::view::hit::REACH;
use crate::editor::view::scene::Mark;
use crate::geometry::{FloatPolygon, counted};

/// The degree that a drawn curve gets if there is no active curve to take it from.
const DEGREE: usize = 5;

/// The draw tool's state: the vertices so far.
#[derive(Debug, Default)]
pub struct DrawTool {
    points: Vec<DVec3>,
    /// Where the drag that goes on began.
    pressed: Option<DVec2>,
}

impl DrawTool {
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
        let wanted = context
            .selection
            .active()
            .and_then(|id| context.document.curve(id))
            .map_or(DEGREE, |curve| curve.polygon.degree());
        let degree = wanted.min(points.len().saturating_sub(1)).max(1);
        match FloatPolygon::new(degree, points.clone(), None, periodic) {
            Ok(polygon) => {
                let id = context.document.next_id();
                let name = context.document.free_name("curve 1");
                let curve = Curve::new(name, polygon);
                vec![
                    Effect::Apply("Draw polygon".into(), vec![Edit::Add(Box::new(curve))]),
                    Effect::Select(Vec::new()),
                    Effect::Activate(id),
                    Effect::Say(format!(
                        "{}, degree {degree}{}",
                        counted(points.len(), "vertex", "vertices"),
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
                let place = self.next(context.model(place), context);
                let point = context.viewport.grounded(place);
                // The second press of a double click sets no vertex of its own.
                let apart = 2.0 * context.viewport.pixel();
                if self
                    .points
                    .last()
                    .is_none_or(|last| last.distance(point) > apart)
                {
                    self.points.push(point);
                }
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

    fn hint(&self, _context: &Context) -> String {
        match self.points.len() {
            0 => "Click to set the first vertex; Esc ends".into(),
            1 | 2 => "Click the next vertex; Shift snaps to 15°, Backspace removes the last one, Esc starts over"
                .into(),
            count => format!(
                "{}: Enter or right click ends; click the first vertex to make it periodic",
                counted(count, "vertex", "vertices")
            ),
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let mut marks: Vec<Mark> = Vec::new();
        let view = context.viewport;
        let points: Vec<DVec2> = self
            .points
            .iter()
            .map(|point| view.flatten(*point))
            .collect();
        marks.extend(points.windows(2).map(|leg| Mark::Guide([leg[0], leg[1]])));
        if let Some(pointer) = context.pointer {
            let next = self.next(pointer, context);
            marks.extend(points.last().map(|last| Mark::Guide([*last, next])));
            marks.push(Mark::NewVertex(next));
        }
        marks.extend(points.into_iter().map(Mark::NewVertex));
        marks
    }
}
