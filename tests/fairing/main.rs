//! Corrections of ends, and harmonising.

mod bridging;
#[path = "../common/mod.rs"]
mod common;
mod corrections;
mod following;
mod harmonising;
mod least_change;
mod through_ends;
mod through_points;

use batten::geometry::end_correction::{EndDifference, EndTarget};
use batten::geometry::{End, FloatPolygon};

/// How far the point of an end that is held may move, in units of the curve's size; its direction by
/// the arc over that size.
const HELD: f64 = 1e-12;

/// Check that the ends keep their points and directions.
#[track_caller]
fn check_ends(before: &FloatPolygon, after: &FloatPolygon) {
    for end in End::BOTH {
        let jet = before.end_jet(end);
        let target = EndTarget {
            point: jet.point,
            direction: jet.tangent(),
            ..EndTarget::default()
        };
        let left = EndDifference::between(after, end, &target).residual(before.size());
        assert!(
            left <= HELD * before.size(),
            "{} off by {left:e}",
            end.name()
        );
    }
}
