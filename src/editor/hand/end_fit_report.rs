//! The report of the end-fit tool: the figures of the seven steps and the last action.

use super::end_fit::{EndFitReport, LastAction};
use super::hand::Hand;
use super::tools::ToolKind;
use crate::editor::view::View;
use crate::editor::workspace::Workspace;

impl Hand {
    /// Collect the figures of the seven steps, if the end-fit tool is in use and the active curve has ends.
    pub fn end_fit(&self, workspace: &Workspace, view: &View) -> Option<EndFitReport> {
        let (document, active) = (workspace.document(), self.selection.active()?);
        if self.tool() != ToolKind::EndFit || document.curve(active)?.polygon.is_periodic() {
            return None;
        }
        let last = self.last_end_fit_action(workspace);
        let settings = &self.settings.end_fit;
        Some(settings.report(document, active, view.analyses.get(active)?, last))
    }

    /// The last action of the end-fit panel with its result, unless the document has changed since.
    pub(in crate::editor) fn last_end_fit_action(
        &self,
        workspace: &Workspace,
    ) -> Option<&LastAction> {
        let last = self.settings.last_end_fit.as_ref()?;
        let counts = self.tool() == ToolKind::EndFit
            && Some(last.curve) == self.selection.active()
            && last.revision == workspace.revision()
            && workspace.preview().is_none();
        counts.then_some(last)
    }
}
