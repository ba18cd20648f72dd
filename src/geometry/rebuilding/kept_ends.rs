//! Approximations that begin and end where the curve does, in its directions.

use crate::geometry::end::End;
use crate::geometry::end_correction::{EndDifference, EndTarget};
use crate::geometry::fairing::joint_correction::{Disturbance, correct_jointly};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::jet::Jet;
use crate::geometry::progress::Progress;

/// Rounding error of an end's difference, in units of the curve's size.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// Move the vertices of an open curve as little as possible to bring both ends to the points of
/// two jets, and from degree 2 on into their directions where they have one.
///
/// Ends that differ by no more than rounding stay, and so does the curve where the vertices are too
/// few to meet both ends.
pub(super) fn with_ends(polygon: FloatPolygon, jets: [Jet; 2]) -> FloatPolygon {
    let [start, finish] = jets.map(|jet| {
        let mut target = EndTarget::keeping(&jet);
        target.direction = target.direction.filter(|_| polygon.degree() > 1);
        target
    });
    let targets = [(End::Start, start), (End::Finish, finish)];
    let size = polygon.size();
    let met = targets.iter().all(|(end, target)| {
        EndDifference::between(&polygon, *end, target).residual(size) <= ROUNDINGS * size
    });
    if met {
        return polygon;
    }
    match correct_jointly(
        &polygon,
        &targets,
        Disturbance::Differences(1),
        &[],
        &Progress::default(),
    ) {
        Ok(correction) => correction.polygon,
        Err(_) => polygon,
    }
}
