//! The document's unit of length.

use crate::document::Edit;
use crate::editor::view::Look;
use crate::editor::{Editor, Note, Reply};
use crate::geometry::expressions::LengthUnit;

impl Editor {
    /// Say in which unit the document's numbers are: they stay.
    pub(in crate::editor) fn set_unit(&mut self, unit: Option<LengthUnit>) -> Reply {
        if self.document().unit() == unit {
            return Ok(Note::silent());
        }
        self.make("Set document unit", vec![Edit::SetUnit(unit)], false)?;
        Ok(Note::done(match unit {
            Some(unit) => format!(
                "The document is in {} now; its numbers stay as they are",
                unit.name()
            ),
            None => "The document has no unit now".to_owned(),
        }))
    }

    /// Convert the document's numbers to a unit, and show everything.
    pub(in crate::editor) fn convert_unit(&mut self, unit: LengthUnit) -> Reply {
        self.make(
            "Convert document unit",
            vec![Edit::ConvertUnit(unit)],
            false,
        )?;
        self.look(Look::All);
        Ok(Note::done(format!(
            "Converted to {}: everything keeps its size",
            unit.name()
        )))
    }
}
