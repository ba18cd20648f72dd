//! Keeping the intervals of features apart.

use std::cmp::Ordering;

use super::exact_numerators::ExactSegment;
use super::feature::Feature;
use super::numerators::Function;
use super::refinement::bisect;
use super::sign_walk::Change;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::whole_numbers::fraction;

/// Changes of sign in one interval of u.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChangeInterval {
    /// The interval.
    pub(super) u: [f64; 2],
    /// Their number.
    pub(super) count: usize,
    /// The first one.
    pub(super) change: Change,
    /// Whether the interval was narrowed beyond that of the places.
    pub(super) is_narrow: bool,
}

impl ChangeInterval {
    /// Start with one change, and the interval of u of its places.
    pub(super) fn new(change: Change, u: [f64; 2]) -> Self {
        Self {
            u,
            count: change.count,
            change,
            is_narrow: false,
        }
    }

    /// Narrow the interval of a root to neighbouring doubles of u, or to the root if it is one.
    pub(super) fn narrow(&mut self, polygon: &FloatPolygon, quantity: Feature) {
        let [low, high] = self.change.places;
        if self.is_narrow || !self.change.is_root || self.count != 1 || low.segment != high.segment
        {
            return;
        }
        self.is_narrow = true;
        let segment = low.segment % polygon.segments();
        let exact = ExactSegment::new(polygon, segment, polygon.is_planar());
        let function = Function::Feature(quantity);
        let Some(simple) = exact.and_then(|exact| exact.numerator(function).odd_part()) else {
            return;
        };
        self.u = bisect(self.u, |u| {
            // Exact for doubles of this segment.
            let t = u - segment as f64;
            let sign = simple.sign_at(&fraction(t.clamp(0.0, 1.0)));
            if t <= low.t || t < high.t && sign == self.change.from {
                Ordering::Less
            } else if t >= high.t || sign != 0 {
                Ordering::Greater
            } else {
                Ordering::Equal
            }
        });
    }
}

/// Narrow the intervals that touch the next one: of a curve with a joint at `joint`, the last
/// and the first as well.
pub(super) fn narrow_neighbours(
    found: &mut [ChangeInterval],
    joint: Option<f64>,
    narrow: impl Fn(&mut ChangeInterval),
) {
    for index in 1..found.len() {
        if let [first, second] = &mut found[index - 1..=index]
            && first.u[1] >= second.u[0]
        {
            narrow(first);
            narrow(second);
        }
    }
    if let ([first, .., last], Some(joint)) = (found, joint)
        && last.u[1] - joint >= first.u[0]
    {
        narrow(first);
        narrow(last);
    }
}

/// Join intervals that touch: doubles of u cannot tell their features apart.
pub(super) fn join_neighbours(found: &mut Vec<ChangeInterval>, joint: Option<f64>) {
    found.dedup_by(|next, last| {
        let touch = last.u[1] >= next.u[0];
        if touch {
            last.u[1] = last.u[1].max(next.u[1]);
            last.count += next.count;
        }
        touch
    });
    if let ([first, .., last], Some(joint)) = (found.as_mut_slice(), joint)
        && last.u[1] - joint >= first.u[0]
    {
        let high = first.u[1] + joint;
        let high = if high - joint < first.u[1] {
            high.next_up()
        } else {
            high
        };
        last.u[1] = last.u[1].max(high);
        last.count += first.count;
        found.remove(0);
    }
}
