//! The plots of several selected curves: over one another, or end to end where the curves meet in a chain.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;

use crate::analysis::{CurveJoint, Item};
use crate::document::CurveId;
use crate::geometry::End;

/// The place of a curve in a chain, by the arc length of the active one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Where it begins.
    pub start: f64,
    /// Whether the chain passes it the other way.
    pub turned: bool,
}

/// Another selected curve or reference whose plot is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Beside {
    /// Which it is.
    pub id: CurveId,
    /// It as it is.
    pub item: Item,
    /// Its place; `None` where it does not meet the active curve.
    pub placed: Option<Placed>,
}

/// The plot of another selected curve or reference.
#[derive(Clone, Debug)]
pub struct OtherPlot {
    /// Which it is.
    pub id: CurveId,
    /// Its series; NaN points are gaps.
    pub series: Vec<DVec2>,
}

/// The ends that go on from each end, with the angles.
type Next = BTreeMap<(CurveId, End), Vec<(f64, (CurveId, End))>>;

/// Place curves that meet in a chain with the active one, both ways from it. Where several go on, the one with the
/// smallest angle does.
pub(super) fn chain(
    joints: &[CurveJoint],
    active: CurveId,
    others: &[CurveId],
    length: impl Fn(CurveId) -> f64,
) -> BTreeMap<CurveId, Placed> {
    let mut free: BTreeSet<CurveId> = others.iter().copied().collect();
    let mut next = Next::new();
    for joint in joints {
        let [one, other] = joint.ends;
        for (from, to) in [(one, other), (other, one)] {
            next.entry(from).or_default().push((joint.joint.angle, to));
        }
    }
    let mut placed = BTreeMap::new();
    for way in [End::Finish, End::Start] {
        let mut at = (active, way);
        let mut reached = match way {
            End::Finish => length(active),
            End::Start => 0.0,
        };
        while let Some((id, end)) = smoothest(&next, at, &free) {
            let own = length(id);
            let start = match way {
                End::Finish => reached,
                End::Start => reached - own,
            };
            let turned = end == way;
            free.remove(&id);
            placed.insert(id, Placed { start, turned });
            reached = match way {
                End::Finish => start + own,
                End::Start => start,
            };
            at = (id, end.other());
        }
    }
    placed
}

/// The end of a free curve that goes on from an end with the smallest angle.
fn smoothest(next: &Next, at: (CurveId, End), free: &BTreeSet<CurveId>) -> Option<(CurveId, End)> {
    let here = next.get(&at)?.iter();
    let here = here.filter(|(_, (id, _))| free.contains(id));
    let best = here.min_by(|one, other| one.0.total_cmp(&other.0));
    best.map(|(_, end)| *end)
}

impl Placed {
    /// Move the series of a curve of this length to its place; signed values turn round with it.
    pub(super) fn place(self, series: &mut [DVec2], length: f64, is_signed: bool) {
        for point in series.iter_mut() {
            if self.turned {
                point.x = length - point.x;
                point.y *= if is_signed { -1.0 } else { 1.0 };
            }
            point.x += self.start;
        }
        if self.turned {
            series.reverse();
        }
    }
}
