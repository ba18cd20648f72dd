//! Matches of mirrored copies: each copy follows the copy of what its curve follows, or the image of the place.

use super::each::Share;
use crate::document::{CurveId, Document, Edit, EndMatch, MatchPlace, quoted};
use crate::geometry::{End, FloatPolygon, Mirror};

/// A place is on a symmetric curve if it is no farther from it than this, in units of the curve's size.
const ON_CURVE: f64 = 1e-9;

/// What becomes of the matches of curves whose mirror images are added.
#[derive(Debug, Default)]
pub(super) struct CopiedMatches {
    /// The matches of the copies.
    pub(super) edits: Vec<Edit>,
    /// Which copies follow nothing, a line each.
    pub(super) remarks: Vec<String>,
}

impl CopiedMatches {
    /// Match copies, given with the curves that they are the mirror images of.
    pub(super) fn of(document: &Document, mirror: &Mirror, copies: &[[CurveId; 2]]) -> Self {
        let mut found = Self::default();
        let copy_of = |id: CurveId| copies.iter().find(|it| it[0] == id).map(|it| it[1]);
        for [own, copy] in copies {
            let matches = End::BOTH.map(|end| document.match_of(*own, end));
            for matched in matches.into_iter().flatten() {
                let image = match copy_of(matched.source) {
                    Some(source) => Some(EndMatch { source, ..*matched }),
                    None => image(document, matched, mirror),
                };
                match image {
                    Some(image) => found.edits.push(Edit::SetMatch(EndMatch {
                        curve: *copy,
                        ..image
                    })),
                    None => found.remarks.extend(unmatched(document, matched)),
                }
            }
        }
        found
    }
}

/// Match the copies that several runs of one operation add, behind all of their edits.
pub(super) fn match_copies(document: &Document, shares: &mut [Share]) {
    let mut ids = document.next_ids();
    let mut copies = Vec::new();
    let mut mirror = None;
    for share in &*shares {
        let Ok(outcome) = &share.outcome else {
            continue;
        };
        let is_added = |edit: &&Edit| matches!(edit, Edit::Add(_) | Edit::AddReference(_));
        let count = outcome.edits.iter().filter(is_added).count();
        let added: Vec<CurveId> = ids.by_ref().take(count).collect();
        if let (Some(by), Some(own), [copy]) = (outcome.copied, share.item, &added[..]) {
            mirror = Some(by);
            copies.push([own, *copy]);
        }
    }
    let Some(mirror) = mirror else {
        return;
    };
    let CopiedMatches { edits, remarks } = CopiedMatches::of(document, &mirror, &copies);
    let outcomes = shares.iter_mut().rev();
    if let Some(last) = outcomes.filter_map(|it| it.outcome.as_mut().ok()).next() {
        last.edits.extend(edits);
        last.remarks.extend(remarks);
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
    let along = mirror.vector(jet.first).dot(source.jet(nearest.u).first);
    Some(EndMatch {
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
fn unmatched(document: &Document, matched: &EndMatch) -> Option<String> {
    let [own, source] = [matched.curve, matched.source].map(|id| document.name(id).map(quoted));
    let (own, end, source) = (own?, matched.end.name(), source?);
    Some(format!(
        "The {end} of the copy of {own} is not matched: {source} is neither mirrored nor its own image"
    ))
}
