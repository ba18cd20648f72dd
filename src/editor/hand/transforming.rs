//! Rotating and scaling by typed figures, about the pivot of the tool in the hand.

use glam::DVec2;

use crate::editor::Editor;
use crate::editor::hand::tools::{self, Transformation, Transformed};
use crate::editor::reply::{Note, Refusal, Reply};

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

    /// Show what a typed angle or factor does, or take that back; a drag that goes on ends. Returns whether that
    /// changes anything.
    pub(in crate::editor) fn type_transformation(&mut self, typed: Option<Transformation>) -> bool {
        self.view.analyse(self.workspace.document());
        let mut tools = std::mem::take(&mut self.hand.tools);
        let effects = tools
            .transform_mut()
            .map(|tool| tool.type_number(typed, &self.context()));
        self.hand.tools = tools;
        let effects = effects.unwrap_or_default();
        let changes = !effects.is_empty();
        if changes {
            self.hand.gestures.reset();
            self.take_effects(effects, false);
        }
        changes
    }

    /// Rotate or scale what is selected, or the active curve or reference, about the pivot, as one step. The
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
        let taken = Transformed::of(&context);
        let label = taken.label(transformation);
        let edits = match taken.edits(transformation, pivot, context.viewport) {
            Ok(edits) => edits,
            Err(error) => return self.tell(Err(Refusal(error.to_string()))),
        };
        let staying = context.staying();
        let reply = self.apply(&label, edits);
        match staying {
            Some(staying) if reply.is_ok() => self.tell(Ok(Note::done(staying))),
            _ => reply,
        }
    }
}
