//! What splitting and trimming share.

use super::matches::without_match;
use super::outcome::Deviation;
use super::parameter::{Kind, Parameter};
use crate::document::{Curve, CurveId, Document, Edit};
use crate::geometry::{End, MAX_SUBDIVISIONS};

/// How often segments may be halved to bring a knot to where the curve is cut.
pub(super) const SUBDIVISIONS: Parameter = Parameter {
    name: "subdivisions",
    label: "Refine at most",
    help: "How often segments are halved to put a knot at the cut; only a cut at a knot is exact",
    kind: Kind::whole(0, MAX_SUBDIVISIONS as usize, 0),
};

/// Say what brings parts nearer that are not exact.
pub(super) fn remark_on_nearness(deviation: Deviation) -> Option<String> {
    (deviation != Deviation::Exact)
        .then(|| "No knot lies at the cut: “Refine at most” brings the part nearer".to_owned())
}

/// Forget the target of an end that is cut off, if it has one, and its match.
pub(super) fn without_target(
    document: &Document,
    id: CurveId,
    curve: &Curve,
    end: End,
) -> impl Iterator<Item = Edit> {
    let target = curve.targets.get(end).map(|_| Edit::SetTarget {
        curve: id,
        end,
        target: None,
    });
    without_match(document, id, end).into_iter().chain(target)
}
