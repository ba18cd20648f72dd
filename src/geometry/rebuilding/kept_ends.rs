//! Approximations that begin and end where the curve does, in its directions.

use crate::geometry::end::End;
use crate::geometry::end_correction::{EndTarget, largest_residual};
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
    if largest_residual(&polygon, &targets, size) <= ROUNDINGS * size {
        return polygon;
    }
    let (least, progress) = (Disturbance::Differences(1), Progress::default());
    match correct_jointly(&polygon, &targets, least, &[], &progress) {
        Ok(correction) => correction.polygon,
        Err(_) => polygon,
    }
}
