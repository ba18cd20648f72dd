//! Matching an end of the active curve to the end of another curve that it meets.

use crate::analysis::CurveJoint;
use crate::document::{CurveId, Edit};
use crate::editor::Editor;
use crate::geometry::Continuity;

/// The curves and references with an end that meets the end of the active curve which the end-fit tool corrects.
pub fn met_curves(editor: &Editor) -> Vec<CurveId> {
    let joints = joints(editor);
    let others = joints.map(|(joint, follower)| joint.ends[1 - follower].0);
    others.collect()
}

/// The edits that let the end follow another curve that it meets; `None` if it cannot.
pub(super) fn edits(editor: &Editor, source: CurveId, level: Continuity) -> Option<Vec<Edit>> {
    let document = editor.document();
    let curve = editor.active().and_then(|id| document.curve(id))?;
    curve.check_editable().ok()?;
    let (joint, follower) = with(editor, source)?;
    Some(joint.matching(document, follower, level))
}

/// The level up to which the end follows another curve.
pub(super) fn level(editor: &Editor, source: CurveId) -> Option<Continuity> {
    let (joint, follower) = with(editor, source)?;
    Some(joint.match_in(editor.document(), follower)?.continuity)
}

/// The joint with another curve, and which of its ends is that of the active curve.
fn with(editor: &Editor, source: CurveId) -> Option<(&CurveJoint, usize)> {
    joints(editor).find(|(joint, follower)| joint.ends[1 - follower].0 == source)
}

fn joints(editor: &Editor) -> impl Iterator<Item = (&CurveJoint, usize)> {
    let own = editor
        .active()
        .map(|id| (id, editor.hand.settings.end_fit.end));
    let joints = editor.sight().joints().all().iter();
    joints.filter_map(move |joint| {
        let follower = joint.ends.iter().position(|end| Some(*end) == own)?;
        // A curve cannot follow itself.
        let is_other = joint.ends[1 - follower].0 != joint.ends[follower].0;
        is_other.then_some((joint, follower))
    })
}
