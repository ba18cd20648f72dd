//! What becomes of matches when an operation gives a curve's places other parameters.

use crate::document::{CurveId, Document, Edit, EndMatch, MatchPlace, Renumbering};
use crate::geometry::{End, counted};

/// The edits that let ends matched to a curve follow places of another one instead. `place` gives the new place of
/// an old one, `None` if the match stays; `turned` says whether the other curve runs the other way.
pub(super) fn handed_over(
    document: &Document,
    [source, other]: [CurveId; 2],
    turned: bool,
    place: impl Fn(MatchPlace) -> Option<MatchPlace>,
) -> Vec<Edit> {
    let matches = document.matches();
    let handed_over = matches.filter(|matched| matched.source == source);
    let edit = |matched: &EndMatch| {
        Some(Edit::SetMatch(EndMatch {
            source: other,
            place: place(matched.place)?,
            reversed: matched.reversed != turned,
            ..*matched
        }))
    };
    handed_over.filter_map(edit).collect()
}

/// Count the matches at places of a curve that a renumbering removes, in a remark.
pub(super) fn cut_off(
    document: &Document,
    source: CurveId,
    renumbering: &Renumbering,
) -> Option<String> {
    let is_gone = |matched: &&EndMatch| {
        matched.source == source && renumbering.place(matched.place).is_none()
    };
    match document.matches().filter(is_gone).count() {
        0 => None,
        count => Some(format!(
            "{}: what was followed is cut off",
            counted(count, "match to it is removed", "matches to it are removed")
        )),
    }
}

/// The edit that ends the match of an end, if it has one: its target can be set then.
pub(super) fn without_match(document: &Document, curve: CurveId, end: End) -> Option<Edit> {
    let matched = document.match_of(curve, end);
    matched.map(|_| Edit::RemoveMatch { curve, end })
}
