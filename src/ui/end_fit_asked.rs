//! What the end-fit panel asks of the editor.

use super::number_field::FieldEvent;
use crate::editor::EndFitAction;

/// What the end-fit panel asks of the editor.
pub enum Asked {
    /// To do something.
    Action(EndFitAction),
    /// To show what it would do while a field is dragged.
    Preview(EndFitAction),
    /// To keep what the field shows.
    Commit,
    /// To take it back.
    Abort,
}

impl Asked {
    /// What a field asks for whose number stands for an action.
    pub fn of_field(event: FieldEvent, action: impl Fn(f64) -> EndFitAction) -> Option<Self> {
        match event {
            FieldEvent::Idle => None,
            FieldEvent::Preview(value) => Some(Self::Preview(action(value))),
            FieldEvent::Typed(value) => Some(Self::Action(action(value))),
            FieldEvent::Commit => Some(Self::Commit),
            FieldEvent::Abort => Some(Self::Abort),
        }
    }
}
