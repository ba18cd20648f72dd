//! Measure a distance and its direction.

use std::collections::BTreeSet;

use glam::DVec2;

use super::tool::{Context, Effect, Tool};
use crate::analysis::Orientation;
use crate::editor::gesture::Gesture;
use crate::editor::input::Key;
use crate::editor::scene::Mark;
use crate::editor::snapping::along_axis;

/// The measure tool's state.
#[derive(Debug, Default)]
pub struct MeasureTool {
    state: State,
}

#[derive(Clone, Copy, Debug, Default)]
enum State {
    #[default]
    Idle,
    /// The first point is set, the second follows the pointer.
    From(DVec2),
    /// Both are set and stay until the next click.
    Between(DVec2, DVec2),
}

impl MeasureTool {
    fn place(&self, at: DVec2, context: &Context) -> DVec2 {
        if let (State::From(from), true) = (self.state, context.modifiers.shift) {
            return from + along_axis(at - from);
        }
        let snapped = context.snapped(at, &BTreeSet::new());
        if snapped != at || context.snapping == context.modifiers.ctrl {
            return snapped;
        }
        // The curve attracts where nothing more definite does.
        let hit = context.hits.curve(context.viewport.to_screen(at));
        hit.map_or(at, |hit| hit.point)
    }

    fn line(&self, context: &Context) -> Option<(DVec2, DVec2)> {
        match self.state {
            State::Idle => None,
            State::From(from) => context.pointer.map(|at| (from, self.place(at, context))),
            State::Between(from, to) => Some((from, to)),
        }
    }
}

/// Say a distance as it is seen, its parts and its direction.
fn figures(from: DVec2, to: DVec2, view: &Orientation) -> String {
    let span = to - from;
    let names = view.axes().map_or([" right", " up"], |axes| {
        axes.map(|axis| ["x", "y", "z"][axis])
    });
    let [across, upwards] = names;
    format!(
        "{:.6}   d{across} {:.6}   d{upwards} {:.6}   {:.3}°",
        span.length(),
        span.x,
        span.y,
        span.to_angle().to_degrees()
    )
}

impl Tool for MeasureTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        match (self.state, gesture) {
            (State::From(from), Gesture::Click(place) | Gesture::DragEnd(place)) => {
                self.state = State::Between(from, self.place(context.model(place), context));
            }
            (_, Gesture::Click(place) | Gesture::DragStart(place)) => {
                self.state = State::Idle;
                self.state = State::From(self.place(context.model(place), context));
            }
            (State::Idle, Gesture::Key(Key::Escape)) => return vec![Effect::Finish],
            (_, Gesture::Key(Key::Escape) | Gesture::Cancel) => self.state = State::Idle,
            _ => {}
        }
        Vec::new()
    }

    fn hint(&self, context: &Context) -> String {
        let view = &context.viewport.orientation;
        match (self.state, self.line(context)) {
            (State::From(_), Some((from, to))) => {
                format!("{}   Shift keeps to an axis", figures(from, to, view))
            }
            (State::Between(..), Some((from, to))) => figures(from, to, view),
            _ => "Click two points, or drag, to measure between them; Esc ends".into(),
        }
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let Some((from, to)) = self.line(context) else {
            let at = context.pointer.map(|at| (at, self.place(at, context)));
            let snap = at.filter(|(free, snapped)| free != snapped);
            return snap.map(|(_, at)| Mark::Snap(at)).into_iter().collect();
        };
        let text = format!("{:.4}", from.distance(to));
        vec![
            Mark::Ruler([from, to]),
            Mark::Label(0.5 * (from + to), text),
        ]
    }
}
