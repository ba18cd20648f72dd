//! The result of an operation that the end-fit panel started.

use crate::document::{Curve, CurveId};
use crate::editor::hand::end_fit::{EndFitAction, LastAction};
use crate::editor::reply::{Note, Reply};
use crate::geometry::End;
use crate::operations::{Report, Value};

/// An action of the end-fit panel.
#[derive(Clone, Copy, Debug)]
pub(in crate::editor) struct EndFitStep {
    /// The action.
    pub action: EndFitAction,
    /// The end that was being corrected.
    pub end: End,
    /// The passes made before it, since the targets last changed.
    pub passes: usize,
}

impl EndFitStep {
    /// What the panel shows of the action, given the corrected curve, the revision of the document,
    /// the reply, and the report of an operation that was applied.
    pub fn last_action(
        self,
        (id, curve): (CurveId, &Curve),
        revision: u64,
        reply: &Reply,
        report: Option<&Report>,
    ) -> LastAction {
        let report = report.filter(|_| reply.is_ok());
        let made = report.map_or(0, |report| self.passes_of(curve, report));
        // The figures of the steps show the result of these two, but not what it costs elsewhere.
        let is_silent = matches!(self.action, EndFitAction::Translate | EndFitAction::Rotate);
        LastAction {
            curve: id,
            end: (!self.is_of_all_ends()).then_some(self.end),
            revision,
            passes: self.passes + made,
            largest_move: report
                .filter(|_| self.is_joint())
                .and_then(|report| report.largest_move),
            reply: match reply {
                Ok(note) if is_silent && !note.warns => Ok(Note::silent()),
                reply => reply.clone(),
            },
        }
    }

    /// Whether it corrects both ends at once.
    pub fn is_joint(self) -> bool {
        self.action == EndFitAction::BothAtOnce
    }

    /// Whether it corrects every end that has a target.
    fn is_of_all_ends(self) -> bool {
        self.is_joint() || self.action == EndFitAction::Repeat
    }

    /// The passes of steps 2 to 6 that the action made.
    fn passes_of(self, curve: &Curve, report: &Report) -> usize {
        match self.action {
            // Without a direction there is no step 6: this was a whole pass.
            EndFitAction::Translate => {
                let targets = curve.targets.list();
                usize::from(targets.iter().all(|(_, target)| target.direction.is_none()))
            }
            EndFitAction::Rotate => 1,
            EndFitAction::Repeat => match report.figure("passes") {
                Some(Value::Whole(passes)) => passes,
                _ => 0,
            },
            _ => 0,
        }
    }
}
