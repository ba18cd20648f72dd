//! Rotating and scaling by typed figures, about the pivot of the tool in the hand.

use glam::DVec2;

use crate::editor::Editor;
use crate::editor::hand::tools::{self, Transformation, move_edits};
use crate::editor::reply::{Note, Reply};
use crate::geometry::counted;

impl Editor {
    /// The pivot of the rotate or the scale tool, if one of them is in the hand and there is
    /// something to take.
    pub fn pivot(&self) -> Option<DVec2> {
        self.hand.tools.transform()?.pivot(&self.context())
    }

    /// Put the pivot somewhere, or let it follow the selection again.
    pub fn set_pivot(&mut self, pivot: Option<DVec2>) {
        if let Some(tool) = self.hand.tools.transform_mut()
            && pivot.is_none_or(|pivot| pivot.is_finite())
        {
            tool.set_pivot(pivot);
        }
    }

    /// Rotate or scale what is selected, or the active curve, about the pivot, as one step. The
    /// reply is told.
    ///
    /// # Errors
    /// [`crate::editor::Refusal`] if there is nothing to transform.
    pub fn transform(&mut self, transformation: Transformation) -> Reply {
        let context = self.context();
        let tool = self.hand.tools.transform();
        let Some(pivot) = tool.and_then(|tool| tool.pivot(&context)) else {
            return self.tell(Err(tools::NOTHING_TO_TRANSFORM.into()));
        };
        let vertices = context.transformed();
        let count = counted(vertices.len(), "vertex", "vertices");
        let label = match transformation {
            Transformation::Rotate(_) => format!("Rotate {count}"),
            Transformation::Scale(_) => format!("Scale {count}"),
        };
        let moved = vertices
            .into_iter()
            .map(|(id, vertex)| (id, transformation.apply(pivot, vertex, context.viewport)));
        let edits = move_edits(moved);
        let staying = context.staying();
        let reply = self.apply(&label, edits);
        match staying {
            Some(staying) if reply.is_ok() => self.tell(Ok(Note::done(staying))),
            _ => reply,
        }
    }
}
