//! Neighbours that follow a moved vertex or the target of an end: by harmony, or by a falloff.

use glam::DVec3;

use super::joint_correction::{CorrectionError, Disturbance, correct_jointly};
use super::objective::Objective;
use super::problem::{self, Problem};
use crate::geometry::conversion::ClampedPolygon;
use crate::geometry::end::End;
use crate::geometry::end_correction::{EndDifference, EndTarget, correct_end, largest_residual};
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// The order of the differences of curvature that are kept small.
const ORDER: usize = 2;

/// Weight of the moves beside their differences while followers first meet the held conditions.
const FIDELITY: f64 = 1e-3;

/// The most Gauss–Newton steps: a frame has no time for more.
const MOST_STEPS: usize = 8;

/// The residual, in units of the curve's size, up to which an end counts as held.
const HELD: f64 = 1e-9;

/// The vertices that the user moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Moved {
    /// Vertices of the float polygon, with their new places.
    Vertices(Vec<(usize, DVec3)>),
    /// A vertex of the closed S-polygon, with its new place.
    Clamped(usize, DVec3),
}

/// Let the neighbours of moved vertices follow so that the polygon is harmonious there.
///
/// The vertices up to `span` places from a moved one minimise the functional of
/// [`harmonise`](super::harmonising::harmonise), with their own moves weighed by `stiffness` > 0.
/// The `locked` vertices and all others stay, and so do the points and directions of the ends,
/// as far as enough vertices follow: a moved vertex of the closed S-polygon that is the end's point
/// or direction itself frees that. Without neighbours only what is moved moves.
///
/// # Errors
/// [`PolygonError`] if a vertex does not exist, would leave the range of numbers, or a periodic
/// curve has no closed S-polygon.
pub fn follow_in_harmony(
    polygon: &FloatPolygon,
    moved: &Moved,
    span: usize,
    stiffness: f64,
    locked: &[usize],
) -> Result<FloatPolygon, PolygonError> {
    let count = polygon.vertices().len();
    let mut begun;
    let mut held = End::BOTH.map(|end| kept(polygon, end)).to_vec();
    let mut near = vec![false; count];
    let mut fixed = vec![false; count];
    for vertex in locked.iter().filter(|vertex| **vertex < count) {
        fixed[*vertex] = true;
    }
    let clamped = match moved {
        Moved::Vertices(moves) => {
            // From a falloff the way to harmony is short and does not fold the polygon.
            begun = follow_softly(polygon, moves, span, locked)?;
            begun.move_vertices(moves.iter().copied())?;
            for (vertex, _) in moves {
                mark_near(&mut near, *vertex, span, polygon.is_periodic());
                fixed[*vertex] = true;
            }
            None
        }
        Moved::Clamped(index, place) => {
            begun = polygon.with_clamped_vertex(*index, *place)?;
            for vertex in 0..count {
                if begun.vertex(vertex) != polygon.vertex(vertex) {
                    mark_near(&mut near, vertex, span, false);
                }
            }
            free(&mut held, *index, count);
            Some((clamped_weights(polygon, *index)?, *place))
        }
    };
    let planar = polygon.is_planar() && begun.is_planar();
    let reaches = |end: End| polygon.terminal_vertices(end).any(|vertex| near[vertex]);
    let mut ends = End::BOTH.to_vec();
    ends.retain(|end| !polygon.is_periodic() && reaches(*end));
    loop {
        let moves = |vertex: usize| near[vertex] && !fixed[vertex];
        let mut problem = Problem::new(&begun, planar, moves);
        if problem.freedoms() == 0 {
            return Ok(begun);
        }
        for end in &ends {
            let target = &held[usize::from(*end == End::Finish)];
            if let Some(target) = target {
                problem.hold(end.parameter(polygon), target, None);
            }
        }
        if let Some((weights, place)) = &clamped {
            problem.hold_point(weights.clone(), *place);
        }
        let least = Objective::Disturbance {
            order: 1,
            fidelity: FIDELITY,
        };
        let met = problem.meet(least, begun.vertices(), problem::MOST_STEPS);
        let met = met.map_or_else(|| begun.vertices().to_vec(), |met| met.vertices);
        problem.moved_from(polygon.vertices());
        let harmony = problem.harmony(problem.measure(), ORDER, stiffness);
        let followed = problem.descend(harmony, &met, MOST_STEPS);
        let followed = problem.polygon(&followed.vertices)?;
        // Release an end that too few vertices could hold.
        let lost = ends.iter().position(|end| {
            let target = &held[usize::from(*end == End::Finish)];
            target.is_some_and(|target| {
                let left = EndDifference::between(&followed, *end, &target);
                left.residual(polygon.size()) > HELD * polygon.size()
            })
        });
        match lost {
            Some(lost) => {
                ends.remove(lost);
            }
            None => return Ok(followed),
        }
    }
}

/// Let an end of an open curve go to a target, and the vertices near it follow so that the polygon is
/// harmonious there.
///
/// The n terminal vertices of the end and up to `span` others beside them minimise the functional of
/// [`follow_in_harmony`], with the target as a condition. The `locked` vertices and all others stay,
/// and so do the point and direction of the other end.
///
/// # Errors
/// [`CorrectionError`] if the curve is periodic, a direction is 0, or the target cannot be met.
pub fn follow_target(
    polygon: &FloatPolygon,
    end: End,
    target: &EndTarget,
    span: usize,
    stiffness: f64,
    locked: &[usize],
) -> Result<FloatPolygon, CorrectionError> {
    let mut near = vec![false; polygon.vertices().len()];
    for vertex in polygon.terminal_vertices(end) {
        mark_near(&mut near, vertex, span, false);
    }
    let moves = |vertex: usize| near[vertex] && !locked.contains(&vertex);
    let mut targets = vec![(end, *target)];
    let other = end.other();
    if polygon.terminal_vertices(other).any(|vertex| near[vertex]) {
        targets.extend(kept(polygon, other).map(|kept| (other, kept)));
    }
    let held = (0..near.len()).filter(|vertex| !moves(*vertex));
    let held: Vec<usize> = held.collect();
    let begun = carried(polygon, end, target, span, locked)?;
    let (least, progress) = (Disturbance::Differences(1), Progress::default());
    let met = correct_jointly(&begun, &targets, least, &held, &progress)?.polygon;
    let planar = polygon.is_planar() && met.is_planar();
    let mut problem = Problem::new(&met, planar, moves);
    for (end, target) in &targets {
        problem.hold(end.parameter(polygon), target, None);
    }
    problem.moved_from(polygon.vertices());
    let harmony = problem.harmony(problem.measure(), ORDER, stiffness);
    let followed = problem.descend(harmony, met.vertices(), MOST_STEPS);
    let followed = problem.polygon(&followed.vertices)?;
    let left = |reached: &FloatPolygon| largest_residual(reached, &targets, reached.size());
    // Curvatures are no linear conditions: a step may lose them.
    let allowed = left(&met).max(HELD * met.size());
    Ok(if left(&followed) <= allowed {
        followed
    } else {
        met
    })
}

/// Carry the terminal vertices of an end to a target's point and direction as one body, and their
/// neighbours along by a falloff: from there the way to harmony is short.
fn carried(
    polygon: &FloatPolygon,
    end: End,
    target: &EndTarget,
    span: usize,
    locked: &[usize],
) -> Result<FloatPolygon, PolygonError> {
    let body = correct_end(polygon, end, target)?;
    let terminal = polygon.terminal_vertices(end);
    let moves: Vec<(usize, DVec3)> = terminal.map(|index| (index, body.vertex(index))).collect();
    follow_softly(polygon, &moves, span, locked)
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

/// The present point and direction of an end, as a target.
fn kept(polygon: &FloatPolygon, end: End) -> Option<EndTarget> {
    (!polygon.is_periodic()).then(|| EndTarget::keeping(&polygon.end_jet(end)))
}

/// Free what a moved vertex of the closed S-polygon is itself: the point, or the direction.
fn free(held: &mut [Option<EndTarget>], clamped: usize, count: usize) {
    let last = count - 1;
    for (end, from_end) in [clamped, last - clamped.min(last)].into_iter().enumerate() {
        match from_end {
            0 => held[end] = None,
            1 => {
                if let Some(target) = &mut held[end] {
                    target.direction = None;
                }
            }
            _ => {}
        }
    }
}

fn mark_near(near: &mut [bool], vertex: usize, span: usize, periodic: bool) {
    let count = near.len();
    let span = span.min(count);
    for offset in 0..=2 * span {
        let place = vertex + offset;
        if periodic {
            near[(place + count * 2 - span) % count] = true;
        } else if let Some(place) = place.checked_sub(span).filter(|place| *place < count) {
            near[place] = true;
        }
    }
}

/// The weights with which the float vertices enter a vertex of the closed S-polygon.
///
/// # Errors
/// [`PolygonError`] if the closed polygon has no such vertex.
fn clamped_weights(
    polygon: &FloatPolygon,
    index: usize,
) -> Result<Vec<(usize, f64)>, PolygonError> {
    let (degree, count) = (polygon.degree(), polygon.vertices().len());
    // Only the first and last n − 1 vertices differ, and each depends on n float vertices.
    let reach = (2 * degree).min(count);
    let window = if index < degree {
        0..reach
    } else if index + degree >= count {
        count - reach..count
    } else {
        return Ok(vec![(index, 1.0)]);
    };
    let mut weights = Vec::with_capacity(window.len());
    for vertex in window.clone() {
        let unit = window
            .clone()
            .map(|other| DVec3::new(f64::from(u8::from(other == vertex)), 0.0, 0.0));
        let unit = FloatPolygon::new(degree, unit.collect(), None, false)?;
        let clamped = ClampedPolygon::from_float(&unit);
        let value = clamped
            .vertices()
            .get(index - window.start)
            .map_or(0.0, |it| it.x);
        weights.push((vertex, value * polygon.weight(vertex)));
    }
    let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
    weights.iter_mut().for_each(|(_, weight)| *weight /= sum);
    weights.retain(|(_, weight)| *weight != 0.0);
    Ok(weights)
}
