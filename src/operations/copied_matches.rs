//! Matches of mirrored copies: each copy follows the copy of what its curve follows, or the image of the place.

use glam::DVec3;

use crate::document::{CurveId, Document, Edit, EndMatch, MatchPlace, quoted};
use crate::geometry::{End, FloatPolygon, Mirror};

/// A place is on a symmetric curve if it is no farther from it than this, in units of the curve's size.
const ON_CURVE: f64 = 1e-9;

/// Directions whose cosine is more than this are one, or opposite.
const ALONG: f64 = 0.999_999;

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
fn unmatched(document: &Document, matched: &EndMatch) -> Option<String> {
    let [own, source] = [matched.curve, matched.source].map(|id| document.name(id).map(quoted));
    let (own, end, source) = (own?, matched.end.name(), source?);
    let why = match document.reference(matched.source) {
        Some(_) => "is a reference",
        None => "is neither mirrored nor its own image",
    };
    Some(format!(
        "The {end} of the copy of {own} is not matched: {source} {why}"
    ))
}
