//! Chains of points made of samples, broken where they leap.

use glam::DVec2;

use crate::analysis::Sample;
use crate::editor::view::outline::GAP;

/// Turn samples into a chain of points with a gap wherever the curve leaps, or the curvature changes
/// sign, if the points follow the curvature through infinity there.
pub fn chain(
    samples: &[Sample],
    place: impl Fn(&Sample) -> DVec2 + Copy,
) -> impl Iterator<Item = DVec2> {
    let mut before: Option<&Sample> = None;
    samples.iter().flat_map(move |sample| {
        let point = place(sample);
        let gap = before.is_some_and(|before| {
            let runs = turned(before, sample) && leaps(place(before), point, before, sample);
            runs || sample.leaps
        });
        before = Some(sample);
        gap.then_some(GAP).into_iter().chain([point])
    })
}

/// Whether the curve turns to its other side between two samples.
pub fn turned(a: &Sample, b: &Sample) -> bool {
    a.curvature * b.curvature < 0.0 || a.normal.dot(b.normal) < 0.0
}

/// Whether a layer's points leap between two samples: it moves farther than the curve itself by
/// an order of magnitude.
pub fn leaps(from: DVec2, to: DVec2, a: &Sample, b: &Sample) -> bool {
    from.distance_squared(to) > 400.0 * a.point.distance_squared(b.point)
}

/// Turn a point that is not finite into a gap.
pub fn finite(point: DVec2) -> DVec2 {
    if point.is_finite() { point } else { GAP }
}
