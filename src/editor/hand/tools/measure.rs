//! Measure a distance and its direction.

use glam::{DVec2, DVec3};

use super::tool::{Context, Effect, Tool};
use crate::editor::hand::gesture::{Gesture, is_hasty_click};
use crate::editor::hand::input::Key;
use crate::editor::hand::snapping::{Carried, along_axis};
use crate::editor::view::scene::Mark;

/// The measure tool's state. Points are those of the model, so that the figures stay true when it
/// is looked at from another side.
#[derive(Debug, Default)]
pub struct MeasureTool {
    state: State,
}

#[derive(Clone, Copy, Debug, Default)]
enum State {
    #[default]
    Idle,
    /// The first point is set, the second follows the pointer. A drag began where `dragged` says.
    From { from: DVec3, dragged: Option<DVec2> },
    /// Both are set and stay until the next click.
    Between(DVec3, DVec3),
}

impl MeasureTool {
    /// The point of the model that is meant by a place of the view plane: one that snaps, or one
    /// of a curve, otherwise the one on the ground.
    fn point(&self, at: DVec2, context: &Context) -> DVec3 {
        let view = context.viewport;
        if let (State::From { from, .. }, true) = (self.state, context.modifiers.shift) {
            let by = along_axis(at - view.flatten(from));
            return from + view.movement(by, true);
        }
        let on_curve = || {
            // The curve attracts where nothing more definite does.
            let snaps = context.snapping != context.modifiers.ctrl;
            let hit = context.hits.curve(view.to_screen(at)).filter(|_| snaps)?;
            let curve = context.document.shape(hit.curve)?;
            Some(curve.jet(hit.u).point)
        };
        context
            .snapped_point(at, &Carried::default())
            .or_else(on_curve)
            .unwrap_or_else(|| view.grounded(at))
    }

    fn line(&self, context: &Context) -> Option<(DVec3, DVec3)> {
        match self.state {
            State::Idle => None,
            State::From { from, .. } => context.pointer.map(|at| (from, self.point(at, context))),
            State::Between(from, to) => Some((from, to)),
        }
    }

    /// Set the first point, by a click or where a drag begins.
    fn begin(&mut self, place: DVec2, dragged: Option<DVec2>, context: &Context) {
        self.state = State::Idle;
        let from = self.point(context.model(place), context);
        self.state = State::From { from, dragged };
    }
}

/// Say a distance in space and its parts and, within a plane of two axes, its direction.
fn figures(from: DVec3, to: DVec3) -> String {
    const NAMES: [&str; 3] = ["x", "y", "z"];
    let span = to - from;
    let part = |axis: usize| format!("   d{} {:.6}", NAMES[axis], span[axis]);
    let mut text = format!("{:.6}", span.length());
    // The plane z = 0 first: it is where planar curves are.
    match [2, 1, 0].into_iter().find(|normal| span[*normal] == 0.0) {
        Some(normal) => {
            let [across, along] = [[1, 2], [0, 2], [0, 1]][normal];
            let angle = DVec2::new(span[across], span[along]).to_angle();
            text += &part(across);
            text += &part(along);
            text += &format!("   {:.3}°", angle.to_degrees());
        }
        None => (0..3).for_each(|axis| text += &part(axis)),
    }
    text
}

impl Tool for MeasureTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        match (self.state, gesture) {
            // A hasty click is a short drag: it sets one point, as a click does.
            (
                State::From {
                    from,
                    dragged: Some(origin),
                },
                Gesture::DragEnd(place),
            ) if is_hasty_click(origin, place) => {
                self.state = State::From {
                    from,
                    dragged: None,
                };
            }
            (State::From { from, .. }, Gesture::Click(place) | Gesture::DragEnd(place)) => {
                self.state = State::Between(from, self.point(context.model(place), context));
            }
            // The second point is where the drag ends.
            (State::From { .. }, Gesture::DragStart(_)) => {}
            (_, Gesture::Click(place)) => self.begin(place, None, context),
            (_, Gesture::DragStart(place)) => self.begin(place, Some(place), context),
            (State::Idle, Gesture::Key(Key::Escape)) => return vec![Effect::Finish],
            (_, Gesture::Key(Key::Escape) | Gesture::Cancel) => self.state = State::Idle,
            _ => {}
        }
        Vec::new()
    }

    fn hint(&self, context: &Context) -> String {
        match (self.state, self.line(context)) {
            (State::From { .. }, Some((from, to))) => {
                format!("{}   Shift locks to an axis", figures(from, to))
            }
            (State::Between(..), Some((from, to))) => figures(from, to),
            _ => "Click two points, or drag, to measure between them; Esc ends".into(),
        }
    }

    fn undo_label(&self) -> Option<&'static str> {
        matches!(self.state, State::From { .. }).then_some("first point")
    }

    fn undo(&mut self) {
        self.state = State::Idle;
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let view = context.viewport;
        let Some((from, to)) = self.line(context) else {
            let at = context.pointer;
            let snapped = at.and_then(|at| context.snapped_point(at, &Carried::default()));
            let mark = snapped.map(|point| Mark::Snap(view.flatten(point)));
            return mark.into_iter().collect();
        };
        let text = format!("{:.4}", from.distance(to));
        let [from, to] = [from, to].map(|point| view.flatten(point));
        vec![
            Mark::Ruler([from, to]),
            Mark::Label(0.5 * (from + to), text),
        ]
    }
}
