//! The document's unit of length, and the step of arrow keys.

use std::ops::RangeInclusive;

use crate::document::Edit;
use crate::editor::hand::NudgeStep;
use crate::editor::view::Look;
use crate::editor::{Editor, Note, Reply};
use crate::geometry::expressions::LengthUnit;

impl Editor {
    /// The steps that arrow keys can have.
    pub const NUDGE_STEPS: RangeInclusive<f64> = 1e-12..=1e12;

    /// Let an arrow key move the selection by a step, whatever the zoom; what is no step is passed over.
    pub fn set_nudge_step(&mut self, step: f64) {
        if Self::NUDGE_STEPS.contains(&step) {
            self.hand.nudge_step = NudgeStep(step);
        }
    }

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
