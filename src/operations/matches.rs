//! What becomes of matches when an operation gives a curve's places other parameters.

use crate::document::{CurveId, Document, Edit, EndMatch, MatchPlace, quoted};
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

/// Say what became of matches by some edits: which are gone or no longer met, and which curves were
/// corrected afterwards so that they are.
pub(super) fn remarks(before: &Document, edits: &[Edit], after: &Document) -> Vec<String> {
    let name = |id| after.curve(id).map(|curve| quoted(&curve.name));
    let said = before.matches().filter_map(|matched| {
        let (name, end) = (name(matched.curve)?, matched.end.name());
        match after.match_of(matched.curve, matched.end) {
            None => Some(format!("The {end} of {name} is no longer matched")),
            Some(now) if before.meets(matched) && !after.meets(now) => {
                Some(format!("The {end} of {name} does not meet its match now"))
            }
            Some(_) => None,
        }
    });
    let corrected = edits.iter().filter_map(|edit| {
        let (Edit::SetPolygon { curve, polygon } | Edit::Renumber { curve, polygon, .. }) = edit
        else {
            return None;
        };
        let now = after.curve(*curve)?;
        let name = quoted(&now.name);
        (now.polygon != *polygon)
            .then(|| format!("{name} was corrected afterwards, so that it meets its match"))
    });
    said.chain(corrected).collect()
}
