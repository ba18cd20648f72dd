//! What becomes of matches when an operation gives a curve's places other parameters.

use crate::document::{CurveId, Document, Edit, EndMatch, MatchPlace, Renumbering};
use crate::geometry::{End, FloatPolygon, counted};

/// Parameters that differ by no more than this share of all are one.
const ROUNDING: f64 = 1e-12;

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

/// The edits by which ends that follow points of a curve stay there where it gets another polygon near its own, whose
/// parameters run otherwise: each place goes to the nearest point that is passed alike.
pub(super) fn kept_places(document: &Document, source: CurveId, now: &FloatPolygon) -> Vec<Edit> {
    let Some(before) = document.curve(source).map(|curve| &curve.polygon) else {
        return Vec::new();
    };
    let of_source = document.matches().filter(|it| it.source == source);
    let edit = |matched: &EndMatch| {
        let MatchPlace::Parameter(u) = matched.place else {
            return None;
        };
        let jet = before.jet(u);
        let nearest = now.nearest(jet.point).u;
        let is_alike = now.jet(nearest).first.dot(jet.first) > 0.0;
        let stays = (nearest - u).abs() <= ROUNDING * now.segments() as f64;
        (is_alike && !stays).then_some(Edit::SetMatch(EndMatch {
            place: MatchPlace::Parameter(nearest),
            ..*matched
        }))
    };
    of_source.filter_map(edit).collect()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Curve;
    use crate::geometry::Continuity;
    use std::f64::consts::PI;

    /// Half a circle of radius 10 by so many vertices, nearly.
    fn arc(count: usize) -> FloatPolygon {
        let points = (0..count).map(|index| {
            let (sin, cos) = (PI * index as f64 / (count - 1) as f64).sin_cos();
            (10.0 * cos, 10.0 * sin)
        });
        FloatPolygon::planar(4, &points.collect::<Vec<_>>()).expect("a polygon")
    }

    #[test]
    fn what_follows_a_point_stays_there_where_parameters_run_otherwise() {
        let curves = [Curve::new("a", arc(12)), Curve::new("b", arc(9))];
        let document = Document::from_curves(curves);
        let ids: Vec<CurveId> = document.ids().collect();
        let matched = |end, place| EndMatch {
            curve: ids[1],
            end,
            source: ids[0],
            place,
            continuity: Continuity::G0,
            reversed: false,
        };
        let matches = [
            matched(End::Start, MatchPlace::Parameter(2.3)),
            matched(End::Finish, MatchPlace::End(End::Finish)),
        ];
        let document = document.with_matches(matches).expect("matches");
        let now = arc(19);
        let edits = kept_places(&document, ids[0], &now);
        let [Edit::SetMatch(kept)] = &edits[..] else {
            panic!("an end stays an end: {edits:?}");
        };
        let MatchPlace::Parameter(u) = kept.place else {
            panic!("{kept:?}");
        };
        let angle = |polygon: &FloatPolygon, u: f64| {
            let point = polygon.jet(u).point;
            point.y.atan2(point.x)
        };
        let off = angle(&now, u) - angle(&arc(12), 2.3);
        assert!(off.abs() < 1e-8, "{off}");
        assert!((u - 2.3).abs() > 1.0, "{u}");
        let same = kept_places(&document, ids[0], &arc(12));
        assert!(same.is_empty(), "{same:?}");
    }
}
