//! What becomes of matches when an operation gives a curve's places other parameters.

use crate::document::{CurveId, Document, Edit, EndMatch, MatchPlace};
use crate::geometry::End;

/// Where a place of a curve is afterwards.
pub(super) enum Moved {
    /// On this curve, there; and whether that runs the other way.
    To(CurveId, MatchPlace, bool),
    /// It is cut off.
    Gone,
}

/// The edits that let those who follow a curve follow the same places afterwards.
pub(super) fn followers(
    document: &Document,
    source: CurveId,
    place: impl Fn(MatchPlace) -> Moved,
) -> Vec<Edit> {
    let following = document
        .matches()
        .filter(|matched| matched.source == source);
    let edit = |matched: &EndMatch| match place(matched.place) {
        Moved::Gone => {
            let (curve, end) = (matched.curve, matched.end);
            Edit::RemoveMatch { curve, end }
        }
        Moved::To(source, place, turned) => Edit::SetMatch(EndMatch {
            source,
            place,
            reversed: matched.reversed != turned,
            ..*matched
        }),
    };
    following.map(edit).collect()
}

/// The edit that ends the match of an end, if it has one: its target can be set then.
pub(super) fn without_match(document: &Document, curve: CurveId, end: End) -> Option<Edit> {
    let matched = document.match_of(curve, end);
    matched.map(|_| Edit::RemoveMatch { curve, end })
}
