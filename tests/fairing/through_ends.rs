//! Float polygons whose curves begin and end at given points.

use batten::geometry::{End, FloatPolygon, MAX_DEGREE, PolygonError};
use glam::DVec3;

use crate::common::Random;

/// How far an end may be from its point, in units of the curve's size.
const MET: f64 = 1e-12;

/// How far the smallest sum of squares may be from another that is larger, in units of it.
const LEAST: f64 = 1e-9;

/// Points as a hand sets them: a walk with turns and unequal legs.
fn walk(random: &mut Random, count: usize, planar: bool) -> Vec<DVec3> {
    let (mut at, mut heading) = (DVec3::ZERO, 0.0_f64);
    let mut points = Vec::new();
    for _ in 0..count {
        points.push(at);
        heading += random.between(-0.8, 0.8);
        let leg = random.between(0.5, 2.0);
        let rise = if planar {
            0.0
        } else {
            random.between(-0.5, 0.5)
        };
        at += leg * DVec3::new(heading.cos(), heading.sin(), rise);
    }
    points
}

fn check(degree: usize, points: &[DVec3]) -> FloatPolygon {
    let polygon = FloatPolygon::through_ends(degree, points).expect("a polygon");
    let added = degree / 2 + 1;
    let last = points.len() - 1;
    assert_eq!(polygon.degree(), degree);
    assert_eq!(polygon.vertices().len(), last - 1 + 2 * added);
    for (end, point) in [(End::Start, points[0]), (End::Finish, points[last])] {
        let off = polygon.end_jet(end).point.distance(point);
        assert!(
            off <= MET * polygon.size(),
            "degree {degree}, {} points: the {} is off by {off:e} of {}",
            points.len(),
            end.name(),
            polygon.size()
        );
    }
    // The points between are vertices to the bit.
    let kept = &polygon.vertices()[added..polygon.vertices().len() - added];
    assert_eq!(kept, &points[1..last]);
    polygon
}

#[test]
fn curves_begin_and_end_where_was_asked_of_every_degree_in_plane_and_space() {
    let mut random = Random(5);
    for degree in 1..=MAX_DEGREE {
        for count in (2..=12).chain([40]) {
            for planar in [true, false] {
                let points = walk(&mut random, count, planar);
                assert_eq!(check(degree, &points).is_planar(), planar || count < 2);
            }
        }
    }
}

#[test]
fn two_points_give_an_evenly_divided_straight_line() {
    let points = [DVec3::new(1.0, 2.0, 0.0), DVec3::new(7.0, -1.0, 0.0)];
    for degree in 1..=MAX_DEGREE {
        let polygon = check(degree, &points);
        let legs: Vec<DVec3> = polygon
            .vertices()
            .windows(2)
            .map(|it| it[1] - it[0])
            .collect();
        for leg in &legs {
            let off = leg.distance(legs[0]);
            assert!(off <= 1e-9 * legs[0].length(), "degree {degree}: {off:e}");
        }
    }
}

#[test]
fn degree_one_is_the_polygon_itself() {
    let points = walk(&mut Random(6), 7, false);
    assert_eq!(check(1, &points).vertices(), points);
}

/// The sum of the squares of the third differences and 0.3 times that of the second ones, which weigh more among the
/// vertices of an end and the one beside them where the first leg of the points is short.
fn roughness(vertices: &[DVec3], tail: usize, points: &[DVec3]) -> f64 {
    let last = points.len() - 1;
    let stiffness = [[0, 1, 2], [last, last - 1, last - 2]].map(|[a, b, c]| {
        let [first, second] = [(a, b), (b, c)].map(|(a, b)| points[a].distance(points[b]));
        (second / first).max(1.0).powi(4)
    });
    let second = |(first, p): (usize, &[DVec3])| {
        let weight = match first {
            _ if first + 2 <= tail => stiffness[0],
            _ if first + 1 >= vertices.len() - tail => stiffness[1],
            _ => 1.0,
        };
        weight * (p[2] - 2.0 * p[1] + p[0]).length_squared()
    };
    let third = |p: &[DVec3]| (p[3] - 3.0 * p[2] + 3.0 * p[1] - p[0]).length_squared();
    let [second, third] = [
        vertices.windows(3).enumerate().map(second).sum::<f64>(),
        vertices.windows(4).map(third).sum(),
    ];
    0.3 * second + third
}

/// Moves of the added vertices that leave the ends where they are only make the polygon rougher.
#[test]
fn differences_are_the_least_that_meet_the_ends() {
    let mut random = Random(7);
    for degree in 2..=9 {
        for count in [3, 4, 9] {
            let points = walk(&mut random, count, false);
            let polygon = check(degree, &points);
            let (vertices, added) = (polygon.vertices(), degree / 2 + 1);
            let least = roughness(vertices, added, &points);
            for _ in 0..50 {
                let mut moved = vertices.to_vec();
                let numbers = (0..added).chain(vertices.len() - added..vertices.len());
                for number in numbers {
                    moved[number] += random.vector(1e-3, true);
                }
                // Put the ends back by the added vertices alone: the weights of both are needed, as
                // an end's point may depend on vertices that the other end added.
                let met = with_ends(degree, moved, added, [points[0], points[count - 1]]);
                assert!(
                    roughness(&met, added, &points) >= least * (1.0 - LEAST),
                    "degree {degree}, {count} points: {} below {least}",
                    roughness(&met, added, &points)
                );
            }
        }
    }
}

/// Move the outer added vertices so that the curve's ends are where they should be.
fn with_ends(
    degree: usize,
    mut vertices: Vec<DVec3>,
    added: usize,
    ends: [DVec3; 2],
) -> Vec<DVec3> {
    for _ in 0..200 {
        for (end, point) in End::BOTH.into_iter().zip(ends) {
            let polygon = FloatPolygon::new(degree, vertices.clone(), None, false);
            let missing = point - polygon.expect("a polygon").end_jet(end).point;
            let last = vertices.len() - 1;
            for step in 0..added {
                let number = if end == End::Start { step } else { last - step };
                vertices[number] += missing;
            }
        }
    }
    vertices
}

#[test]
fn an_arc_of_evenly_spaced_points_bends_up_to_its_ends() {
    for degree in 2..=7 {
        let points = (0..=8).map(|step| {
            let angle = 0.25 * f64::from(step);
            10.0 * DVec3::new(angle.cos(), angle.sin(), 0.0)
        });
        let polygon = check(degree, &points.collect::<Vec<_>>());
        let middle = polygon
            .jet(0.5 * polygon.segments() as f64)
            .curvature_of(true);
        for end in End::BOTH {
            let curvature = polygon.end_jet(end).curvature_of(true);
            // Of odd degrees the ends lie on vertices. Of even ones they lie between two of them, so the
            // legs there are shorter, and the bend sharper.
            let bend = if degree % 2 == 1 { 0.55..1.0 } else { 1.0..3.5 };
            let ratio = curvature / middle;
            assert!(bend.contains(&ratio), "degree {degree}: {ratio}");
        }
    }
}

/// With third differences alone one in ten had an end that bends 7 times as much as the curve in its middle.
#[test]
fn ends_do_not_hook() {
    let mut random = Random(8);
    let mut ratios = Vec::new();
    for _ in 0..200 {
        let turn = random.between(0.1, 0.5);
        let (mut at, mut heading) = (DVec3::ZERO, 0.0_f64);
        let points = (0..7).map(|_| {
            let here = at;
            heading += turn + random.between(-0.15, 0.15);
            at += random.between(1.0, 3.0) * DVec3::new(heading.cos(), heading.sin(), 0.0);
            here
        });
        let polygon = check(5, &points.collect::<Vec<_>>());
        let count = 8 * polygon.segments();
        let inner = (0..=count).map(|it| polygon.jet(it as f64 / 8.0).curvature());
        let mut inner: Vec<f64> = inner.collect();
        inner.sort_by(f64::total_cmp);
        let ends = End::BOTH.map(|end| polygon.end_jet(end).curvature());
        ratios.push(ends[0].max(ends[1]) / inner[count / 2]);
    }
    ratios.sort_by(f64::total_cmp);
    let [half, most] = [ratios[100], ratios[180]];
    assert!((0.5..2.0).contains(&half), "{half}");
    assert!(most < 5.5, "{most}");
}

/// A first click close to the second one sets the direction; the curve must not leave it backward.
#[test]
fn a_short_first_leg_does_not_turn_the_start_round() {
    let mut random = Random(9);
    for case in 0..300 {
        // The parabolas of degree 2 turn within the first leg.
        let degree = 3 + case % 7;
        let short = random.between(0.02, 0.5);
        let (mut at, mut heading) = (DVec3::ZERO, 0.0_f64);
        let points = (0..6).map(|step| {
            let here = at;
            let leg = if step == 0 { short } else { 1.0 } * random.between(8.0, 12.0);
            at += leg * DVec3::new(heading.cos(), heading.sin(), 0.0);
            heading += random.between(-0.6, 0.6);
            here
        });
        let points: Vec<DVec3> = points.collect();
        let first_leg = points[1] - points[0];
        for end in End::BOTH {
            let ordered = match end {
                End::Start => points.clone(),
                End::Finish => points.iter().rev().copied().collect(),
            };
            let polygon = check(degree, &ordered);
            let jet = polygon.end_jet(end);
            let out = if end == End::Start {
                jet.first
            } else {
                -jet.first
            };
            let off = out.angle_between(first_leg).to_degrees();
            assert!(off < 45.0, "degree {degree}, leg {short}: {off}° off");
            let begin = if end == End::Start {
                0.0
            } else {
                polygon.segments() as f64 - 1.0
            };
            let samples = (0..=32).map(|it| polygon.jet(begin + f64::from(it) / 32.0).curvature());
            let sharpest = samples.fold(0.0, f64::max) * first_leg.length();
            assert!(sharpest < 2.0, "degree {degree}, leg {short}: {sharpest}");
        }
    }
}

#[test]
fn one_point_is_refused() {
    let refused = FloatPolygon::through_ends(3, &[DVec3::ONE]);
    assert!(matches!(
        refused,
        Err(PolygonError::TooFewVertices { found: 1, .. })
    ));
    assert!(FloatPolygon::through_ends(0, &[DVec3::ONE, DVec3::ZERO]).is_err());
    assert!(FloatPolygon::through_ends(MAX_DEGREE + 1, &[DVec3::ONE, DVec3::ZERO]).is_err());
}

/// A polygon as a hand sets it, with weights of up to twice each other or without.
fn polygon(random: &mut Random, degree: usize, count: usize, planar: bool) -> FloatPolygon {
    let vertices = walk(random, count, planar);
    let weights = (0..count).map(|_| random.between(1.0, 2.0));
    let weights = degree.is_multiple_of(3).then(|| weights.collect());
    FloatPolygon::new(degree, vertices, weights, false).expect("a polygon")
}

#[test]
fn a_curve_goes_on_to_a_point_from_either_end() {
    let mut random = Random(9);
    for degree in 1..=12 {
        for count in [degree + 1, degree + 2, 2 * degree + 3] {
            for planar in [true, false] {
                let before = polygon(&mut random, degree, count, planar);
                let to = before.point(0.3) + random.vector(2.0, !planar);
                for end in End::BOTH {
                    let after = before.continued(end, to).expect("a polygon");
                    let told = format!("degree {degree}, {count}, {}", end.name());
                    let off = after.end_jet(end).point.distance(to);
                    assert!(off <= MET * after.size(), "{told}: {off:e}");
                    // The rest stays to the bit, and the end is a vertex.
                    let (own, tail) = (before.vertices(), before.tail(end));
                    let from = before.end_jet(end).point;
                    let (kept, point, rest) = match end {
                        End::Start => {
                            let (new, rest) = after.vertices().split_at(tail.end + 1);
                            (rest, new[tail.end], &own[tail.end..])
                        }
                        End::Finish => {
                            let (rest, new) = after.vertices().split_at(tail.start);
                            (rest, new[0], &own[..tail.start])
                        }
                    };
                    assert_eq!(kept, rest, "{told}");
                    assert_eq!(point, from, "{told}");
                }
                // The same from the other end of the reversed curve.
                let start = before.continued(End::Start, to).expect("a polygon");
                let finish = before.reversed().continued(End::Finish, to).expect("one");
                let pairs = start.vertices().iter().zip(finish.vertices().iter().rev());
                let off = pairs.fold(0.0_f64, |most, (a, b)| most.max(a.distance(*b)));
                assert!(off <= 1e-9 * start.size(), "degree {degree}: {off:e}");
            }
        }
    }
}

#[test]
fn a_curve_that_was_made_of_points_goes_on_as_one_of_a_point_more() {
    let mut random = Random(10);
    for degree in 1..=9 {
        let points = walk(&mut random, 24, degree % 2 == 0);
        let [before, whole] = [&points[..23], &points[..]].map(|points| check(degree, points));
        let after = before
            .continued(End::Finish, points[23])
            .expect("a polygon");
        let pairs = after.vertices().iter().zip(whole.vertices());
        let off = pairs.fold(0.0_f64, |most, (a, b)| most.max(a.distance(*b)));
        assert!(off <= 1e-10 * whole.size(), "degree {degree}: {off:e}");
    }
}

#[test]
fn a_periodic_curve_does_not_go_on() {
    let points = walk(&mut Random(11), 7, true);
    let polygon = FloatPolygon::new(3, points, None, true).expect("a polygon");
    let refused = polygon.continued(End::Finish, DVec3::ZERO);
    assert!(matches!(refused, Err(PolygonError::PeriodicCurve { .. })));
}
