//! Keeping features in drags and steps of the hand.

use std::sync::Arc;

use super::hand::Hand;
use super::keeping::Keeping;
use super::kept_curves::{moves_others, moves_whole};
use crate::analysis::AnalysisCache;
use crate::document::{Curve, CurveId, Edit};
use crate::editor::reply::Refusal;
use crate::editor::workspace::Workspace;
use crate::geometry::features::SegmentFeatures;

impl Hand {
    /// Change the edits of a drag so that it adds no feature, if features are kept.
    pub(in crate::editor) fn kept(
        &mut self,
        edits: Vec<Edit>,
        workspace: &Workspace,
        analyses: &AnalysisCache,
    ) -> Vec<Edit> {
        if !self.keeps_features() || workspace.preview().is_none() {
            return edits;
        }
        let try_out = |edits| workspace.previewed(edits);
        let (settled, known) = (workspace.settled(), known_features(analyses));
        self.keeping.keep(edits, settled, &try_out, &known)
    }

    /// Find what a drag adds that reshapes curves, unless features are kept.
    pub(in crate::editor) fn find_added(
        &mut self,
        workspace: &Workspace,
        analyses: &AnalysisCache,
    ) {
        if self.keeps_features() || !self.is_dragging() {
            return self.keeping.forget_added();
        }
        let known = known_features(analyses);
        let (after, settled) = (workspace.document(), workspace.settled());
        // All vertices together move without a change of shape.
        if !self.turns_following() && moves_whole(settled, after) {
            return self.keeping.forget_added();
        }
        self.keeping.find_added(after, settled, &known);
    }

    /// Tell the features that a drag adds which moves more vertices than those that are dragged: neighbours that follow a
    /// point, or the terminal vertices of an end.
    pub(in crate::editor) fn added_beyond_the_drag(&self, workspace: &Workspace) -> Option<String> {
        let added = self.keeping.added()?;
        let (before, now) = (workspace.settled(), workspace.document());
        moves_others(before, now, &self.selection)
            .then(|| format!("{added} by this drag: with K drags add none"))
    }

    /// End a drag, or the preview of a field, and keep it as one step. Where features are kept, a match that takes
    /// long to meet is met only if that adds none.
    pub(in crate::editor) fn commit_kept(
        &mut self,
        workspace: &mut Workspace,
        analyses: &AnalysisCache,
    ) {
        if self.keeps_features() {
            let settled = workspace.settled().clone();
            let (keeping, known) = (&mut self.keeping, known_features(analyses));
            workspace.take_time(|after| keeping.allows(after, &settled, &known));
        }
        self.keeping.end();
        workspace.commit();
    }

    /// Refuse moves of vertices in one step that add a feature, if features are kept.
    ///
    /// # Errors
    /// [`Refusal`] names the feature.
    pub(in crate::editor) fn check_kept(
        &self,
        edits: &[Edit],
        workspace: &Workspace,
        analyses: &AnalysisCache,
    ) -> Result<(), Refusal> {
        let is_move = |edit: &Edit| matches!(edit, Edit::MoveVertices { .. });
        if !self.keeps_features() || !edits.iter().all(is_move) {
            return Ok(());
        }
        let known = known_features(analyses);
        match Keeping::refusal(edits.to_vec(), workspace.settled(), &known) {
            None => Ok(()),
            Some(reason) => Err(Refusal(format!("Features are kept (K): {reason}"))),
        }
    }
}

/// The features that are proved of curves as they are shown.
fn known_features(
    analyses: &AnalysisCache,
) -> impl Fn(CurveId, &Arc<Curve>) -> Option<Vec<SegmentFeatures>> + '_ {
    |id, curve| {
        let analysis = analyses.get(id)?;
        let known = analysis.proved_segments()?;
        Arc::ptr_eq(analysis.curve(), curve).then(|| known.to_vec())
    }
}
