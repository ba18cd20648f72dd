//! Matches of copies: each follows the copy of what its curve follows, or the mirror image of the place.

use glam::DVec3;

use super::error::OperationError;
use super::operands::Operands;
use super::outcome::{Copying, Outcome};
use crate::document::{CurveId, Document, Edit, EndMatch, MatchPlace, quoted};
use crate::geometry::{End, FloatPolygon, Mirror};

/// A place is on a symmetric curve if it is no farther from it than this, in units of the curve's size.
const ON_CURVE: f64 = 1e-9;

/// Directions whose cosine is more than this are one, or opposite.
const ALONG: f64 = 0.999_999;

/// Match the copies that an operation on one curve adds, behind the edits of its outcome; those of several curves are
/// matched together.
pub(super) fn match_own_copies(
    outcome: &mut Outcome,
    input: &Operands,
) -> Result<(), OperationError> {
    let Some(copying) = outcome.copied.clone().filter(|_| !input.has_others()) else {
        return Ok(());
    };
    let (own, _) = input.curve()?;
    let copies = input.document().next_ids().take(outcome.edits.len());
    let rows: Vec<_> = copies.map(|copy| vec![[own, copy]]).collect();
    match_copies(outcome, input.document(), &copying, &rows);
    Ok(())
}

/// Match copies behind the edits of an outcome. Those of a row belong together, each is given behind its curve. Remarks
/// tell which follow nothing.
pub(super) fn match_copies(
    outcome: &mut Outcome,
    document: &Document,
    copying: &Copying,
    rows: &[Vec<[CurveId; 2]>],
) {
    for row in rows {
        let copy_of = |id: CurveId| row.iter().find(|it| it[0] == id).map(|it| it[1]);
        for [own, copy] in row {
            let matches = End::BOTH.map(|end| document.match_of(*own, end));
            for matched in matches.into_iter().flatten() {
                let copied = match (copy_of(matched.source), copying) {
                    (Some(source), _) => Some(EndMatch { source, ..*matched }),
                    (None, Copying::Mirrored(mirror)) => image(document, matched, mirror),
                    (None, Copying::Moved) => None,
                };
                if let Some(copied) = copied {
                    let curve = *copy;
                    outcome
                        .edits
                        .push(Edit::SetMatch(EndMatch { curve, ..copied }));
                } else if let Some(told) = unmatched(document, matched, copying)
                    && !outcome.remarks.contains(&told)
                {
                    outcome.remarks.push(told);
                }
            }
        }
    }
}

/// The match to the image of a place on the same curve, if that is symmetric.
fn image(document: &Document, matched: &EndMatch, mirror: &Mirror) -> Option<EndMatch> {
    let source = &document.curve(matched.source)?.polygon;
    let jet = matched.place.jet(source)?;
    let nearest = source.nearest(mirror.point(jet.point));
    if nearest.distance > ON_CURVE * source.size() {
        return None;
    }
    // Where the curve crosses itself the place may be another one.
    let directions = [mirror.vector(jet.first), source.jet(nearest.u).first];
    let [image, own] = directions.map(DVec3::normalize_or_zero);
    let along = image.dot(own);
    (along.abs() > ALONG).then_some(EndMatch {
        place: place(source, matched.place, nearest.u),
        reversed: matched.reversed != (along < 0.0),
        ..*matched
    })
}

/// The image of a place of an end is an end.
fn place(source: &FloatPolygon, place: MatchPlace, u: f64) -> MatchPlace {
    match place {
        MatchPlace::End(_) if u < 0.5 * source.segments() as f64 => MatchPlace::End(End::Start),
        MatchPlace::End(_) => MatchPlace::End(End::Finish),
        MatchPlace::Parameter(_) => MatchPlace::Parameter(u),
    }
}

/// Say that a copy follows nothing, though its curve does.
fn unmatched(document: &Document, matched: &EndMatch, copying: &Copying) -> Option<String> {
    let [own, source] = [matched.curve, matched.source].map(|id| document.name(id).map(quoted));
    let (own, end, source) = (own?, matched.end.name(), source?);
    let why = match (document.reference(matched.source), copying) {
        (Some(_), _) => "is a reference",
        (None, Copying::Mirrored(_)) => "is neither mirrored nor its own image",
        (None, Copying::Moved) => "is not copied",
    };
    Some(format!(
        "The {end} of the copy of {own} is not matched: {source} {why}"
    ))
}
