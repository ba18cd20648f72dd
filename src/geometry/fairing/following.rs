//! Neighbours that follow moved vertices by a falloff, or the target of an end by least change.

use glam::DVec3;

use super::joint_correction::{CorrectionError, Disturbance, correct_jointly};
use super::least_change::{ORDER, mark_near};
use crate::geometry::end::End;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// Let an end of an open curve go to a target, and the vertices near it follow with the least second differences of
/// their moves.
///
/// The n terminal vertices of the end and up to `span` others beside them move. The `locked` vertices and all others
/// stay, and so do the point and direction of the other end.
///
/// # Errors
/// [`CorrectionError`] if the curve is periodic, a direction is 0, or the target cannot be met.
pub fn follow_target(
    polygon: &FloatPolygon,
    end: End,
    target: &EndTarget,
    span: usize,
    locked: &[usize],
) -> Result<FloatPolygon, CorrectionError> {
    let mut near = vec![false; polygon.vertices().len()];
    for vertex in polygon.terminal_vertices(end) {
        mark_near(&mut near, vertex, span, false);
    }
    let mut targets = vec![(end, *target)];
    let other = end.other();
    let reaches_other = polygon.terminal_vertices(other).any(|vertex| near[vertex]);
    if reaches_other && !polygon.is_periodic() {
        targets.push((other, EndTarget::keeping(&polygon.end_jet(other))));
    }
    let held = (0..near.len()).filter(|vertex| !near[*vertex] || locked.contains(vertex));
    let held: Vec<usize> = held.collect();
    let (least, progress) = (Disturbance::Differences(ORDER), Progress::default());
    Ok(correct_jointly(polygon, &targets, least, &held, &progress)?.polygon)
}

/// Let the neighbours of moved vertices follow by a falloff, without any solving: a vertex that is
/// d ≤ `span` places from the nearest moved one follows its move by (1 + cos(π d/(span + 1)))/2.
/// The `locked` vertices stay.
///
/// # Errors
/// [`PolygonError`] if a vertex does not exist or would leave the range of numbers.
pub fn follow_softly(
    polygon: &FloatPolygon,
    moves: &[(usize, DVec3)],
    span: usize,
    locked: &[usize],
) -> Result<FloatPolygon, PolygonError> {
    let count = polygon.vertices().len();
    for (vertex, _) in moves {
        polygon.check_index(*vertex)?;
    }
    let distance = |a: usize, b: usize| {
        let apart = a.abs_diff(b);
        if polygon.is_periodic() {
            apart.min(count - apart)
        } else {
            apart
        }
    };
    let followers = (0..count).filter(|vertex| !locked.contains(vertex));
    let places = followers.filter_map(|vertex| {
        let nearest = moves
            .iter()
            .min_by_key(|(other, _)| distance(*other, vertex))?;
        let far = distance(nearest.0, vertex);
        if far == 0 {
            return Some((vertex, nearest.1));
        }
        let share = far as f64 / (span as f64 + 1.0);
        let falloff = 0.5 + 0.5 * (std::f64::consts::PI * share).cos();
        let by = nearest.1 - polygon.vertex(nearest.0);
        (far <= span).then(|| (vertex, polygon.vertex(vertex) + falloff * by))
    });
    let places: Vec<(usize, DVec3)> = places.collect();
    let mut followed = polygon.clone();
    followed.move_vertices(places)?;
    Ok(followed)
}
