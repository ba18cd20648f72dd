//! One end of a long curve corrected by the vertices near it.

use glam::DVec3;

use super::joint_correction::{CorrectionError, Corrector, Disturbance};
use crate::geometry::end::End;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// Least number of vertices near an end. The farthest are held: a correction has faded there.
const REACH: usize = 64;

/// Least number of vertices near an end, in units of the degree.
const REACH_OF_DEGREE: usize = 4;

/// Whether both ends of a curve can be corrected by vertices of their own.
pub fn has_ends_apart(polygon: &FloatPolygon) -> bool {
    polygon.vertices().len() >= 2 * reach(polygon)
}

/// Bring one end of an open curve that [has its ends apart](has_ends_apart) to a target by moving only
/// the vertices near it, except the `locked` ones, as `correct` does with the `least` disturbance: in the same time however long
/// the curve is, and with conditions in the size of what is moved. All beyond keeps every bit, and
/// the curve its smoothness.
///
/// # Errors
/// As `correct`, which nothing cancels here.
pub fn correct_near_end(
    polygon: &FloatPolygon,
    (end, target): (End, &EndTarget),
    least: Disturbance,
    locked: &[usize],
    correct: Corrector,
) -> Result<FloatPolygon, CorrectionError> {
    let (degree, count) = (polygon.degree(), polygon.vertices().len());
    let reach = reach(polygon).min(count);
    let (near, far) = match end {
        End::Start => (0..reach, reach - degree..reach),
        End::Finish => (count - reach..count, count - reach..count - reach + degree),
    };
    // About the target as origin, so that no digits are lost to where the curve lies.
    let origin = target.point;
    let mut part = polygon.window(near.clone())?;
    let places = part.vertices().iter().map(|vertex| *vertex - origin);
    let places: Vec<(usize, DVec3)> = places.enumerate().collect();
    part.move_vertices(places)?;
    let target = EndTarget {
        point: DVec3::ZERO,
        ..*target
    };
    let held = |index: &usize| far.contains(index) || locked.contains(index);
    let held_here = near.clone().filter(held).map(|index| index - near.start);
    let held_here: Vec<usize> = held_here.collect();
    let targets = [(end, target)];
    let corrected = correct(&part, &targets, least, &held_here, &Progress::default())?.polygon;
    let moves = near.clone().filter(|index| !held(index));
    let moves: Vec<(usize, DVec3)> = moves
        .map(|index| (index, origin + corrected.vertex(index - near.start)))
        .collect();
    let mut whole = polygon.clone();
    whole.move_vertices(moves)?;
    Ok(whole)
}

fn reach(polygon: &FloatPolygon) -> usize {
    REACH.max(REACH_OF_DEGREE * polygon.degree())
}
