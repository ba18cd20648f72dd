//! Two curves, the second matched to the first.

use batten::document::{Curve, CurveId, Document, Edit, EndMatch, MatchPlace};
use batten::geometry::{Continuity, End, FloatPolygon};

/// Two parabolas of nine vertices, the second by `shift` to the right of the first and matched to its finish.
pub fn matched(continuity: Continuity, shift: f64) -> (Document, [CurveId; 2]) {
    let curve = |name: &str, shift: f64| {
        let points: Vec<(f64, f64)> = (0..9)
            .map(|index| (shift + f64::from(index), 0.1 * f64::from(index * index)))
            .collect();
        Curve::new(name, FloatPolygon::planar(4, &points).expect("valid"))
    };
    let document = Document::from_curves([curve("first", 0.0), curve("second", shift)]);
    let ids: Vec<CurveId> = document.ids().collect();
    let matched = EndMatch {
        curve: ids[1],
        end: End::Start,
        source: ids[0],
        place: MatchPlace::End(End::Finish),
        continuity,
        reversed: false,
    };
    let document = document
        .edited([Edit::SetMatch(matched)])
        .expect("it can be matched");
    (document, [ids[0], ids[1]])
}
