//! Ends that a drag of the other end takes from their targets.

use crate::document::{CurveId, Document, quoted};
use crate::geometry::end_correction::EndDifference;
use crate::geometry::{End, significant};

/// An end whose target is missed by no more than this share of the curve's size meets it.
const MET: f64 = 1e-9;

/// Say that an end of a curve met its target, and does so no more.
pub(super) fn left_target(
    [before, after]: [&Document; 2],
    curve: CurveId,
    end: End,
) -> Option<String> {
    let [then, now] = [before.curve(curve)?, after.curve(curve)?];
    let target = then.targets.get(end)?;
    let size = then.polygon.size();
    let [was, is] = [then, now].map(|it| EndDifference::between(&it.polygon, end, &target));
    let [met, meets] = [&was, &is].map(|it| it.residual(size) <= MET * size);
    (met && !meets).then(|| {
        let by = significant(is.vector.length(), 3);
        let (end, name) = (end.name(), quoted(&now.name));
        format!("The {end} of {name} leaves its target by {by}: correct both ends at once")
    })
}
