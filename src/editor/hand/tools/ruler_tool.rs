//! The rulers: a drag from one places a guide.

use super::line_drag::LineDrag;
use super::tool::{Context, Cursor, Effect, Tool};
use crate::editor::hand::gesture::Gesture;
use crate::editor::view::layers::Layer;
use crate::editor::view::rulers;
use crate::editor::view::scene::Mark;

/// The tool that takes the place of the one in use while a guide is dragged from a ruler.
#[derive(Debug, Default)]
pub struct RulerTool {
    drag: Option<LineDrag>,
}

impl RulerTool {
    /// Whether a gesture is about a ruler: it begins there. Clicks there do nothing.
    pub fn takes(gesture: Gesture, context: &Context) -> bool {
        let (Gesture::DragStart(place) | Gesture::Click(place) | Gesture::DoubleClick(place)) =
            gesture
        else {
            return false;
        };
        let is_shown = context.hits.layers().shows(Layer::Guides);
        is_shown && rulers::guide_at(place, context.viewport).is_some()
    }

    /// Whether a drag goes on.
    pub fn drags(&self) -> bool {
        self.drag.is_some()
    }
}

impl Tool for RulerTool {
    fn gesture(&mut self, gesture: Gesture, context: &Context) -> Vec<Effect> {
        match (self.drag.take(), gesture) {
            (None, Gesture::DragStart(place)) => {
                let begun = LineDrag::from_ruler(place, context);
                let begun = begun.map(|(drag, effect)| {
                    self.drag = Some(drag);
                    effect
                });
                begun.into_iter().collect()
            }
            (Some(_), Gesture::DragEnd(_)) => vec![Effect::Commit],
            (Some(_), Gesture::Cancel) => vec![Effect::Abort],
            (Some(mut drag), Gesture::Drag(place)) => {
                let effect = drag.drag(place, context);
                self.drag = Some(drag);
                vec![effect]
            }
            (drag, _) => {
                self.drag = drag;
                Vec::new()
            }
        }
    }

    fn hint(&self, context: &Context) -> String {
        let hint = self.drag.as_ref().map(|drag| drag.hint(context));
        hint.unwrap_or_default()
    }

    fn marks(&self, context: &Context) -> Vec<Mark> {
        let marks = self.drag.as_ref().map(|drag| drag.marks(context));
        marks.unwrap_or_default()
    }

    fn cursor(&self, _: &Context) -> Cursor {
        Cursor::Move
    }
}
