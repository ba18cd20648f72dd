//! What a drag did beyond what was dragged.

use crate::document::Document;
use crate::editor::hand::Hand;
use crate::editor::hand::tools::ToolKind;
use crate::editor::reply::with_lines;
use crate::editor::sharper::sharp_drag;
use crate::operations::{followers, moved_with, told_of_bent};

/// Say what a drag did that nobody asked for, a line each: features that it `added`, a sharp bend, an end that left its
/// target, followers that bend. Empty if there is nothing to say.
pub(super) fn drag_report(hand: &Hand, documents: [&Document; 2], added: Option<String>) -> String {
    let told = [added, sharp_drag(documents), left_target(hand, documents)];
    let told: Vec<String> = told.into_iter().flatten().collect();
    with_lines(told.join("\n"), &told_of_bent(&followers(documents, &[])))
}

/// Say how End fit moves the end that is not dragged, if that one has a target.
fn left_target(hand: &Hand, documents: [&Document; 2]) -> Option<String> {
    if hand.tool() != ToolKind::EndFit {
        return None;
    }
    let active = hand.selection.active()?;
    let end = hand.settings.end_fit.end.other();
    let [before, after] = documents.map(|document| document.curve(active));
    let before = before.filter(|curve| curve.targets.get(end).is_some())?;
    moved_with(&before.polygon, end, &after?.polygon)
}
