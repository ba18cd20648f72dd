//! Drags of vertices, of points of the curve and of closed vertices, which all else follows with the least change.

use batten::geometry::fairing::least_change::{
    Dragged, LeastChangeError, Reach, least_change, magnification,
};
use batten::geometry::features::Features;
use batten::geometry::{ClampedPolygon, End, FloatPolygon};
use glam::DVec3;

use crate::check_ends;
use crate::common::Random;

/// How exactly what is dragged is where it is dragged, in units of the curve's size.
const MET: f64 = 1e-12;

/// How exactly half a drag makes half the change, in units of the change.
const LINEAR: f64 = 1e-9;

fn reach(span: usize, locked: &[usize]) -> Reach<'_> {
    Reach {
        span,
        stiffness: 0.0,
        locked,
    }
}

/// A whole number below another.
fn below(random: &mut Random, most: usize) -> usize {
    (random.bits() % most as u64) as usize
}

/// A random curve: planar or in space, polynomial or rational, open or periodic, of any degree up to 9.
fn curve(random: &mut Random) -> FloatPolygon {
    let degree = 1 + below(random, 9);
    let (in_space, periodic, rational) = (
        below(random, 4) == 0,
        below(random, 4) == 0,
        below(random, 4) == 0,
    );
    let count = degree + 1 + below(random, 30);
    let mut place = DVec3::ZERO;
    let vertices = (0..count).map(|_| {
        place += DVec3::X + random.vector(0.8, in_space);
        place
    });
    let vertices: Vec<DVec3> = vertices.collect();
    let weights = rational.then(|| {
        (0..count)
            .map(|_| 0.5 + 1.5 * random.between(0.0, 1.0))
            .collect()
    });
    FloatPolygon::new(degree, vertices, weights, periodic).expect("a polygon")
}

/// Something to drag of a curve.
fn dragged(random: &mut Random, polygon: &FloatPolygon, by: DVec3) -> Dragged {
    let vertex = below(random, polygon.vertices().len());
    match below(random, 3) {
        0 => Dragged::Vertices(vec![(vertex, polygon.vertex(vertex) + by)]),
        1 if !polygon.is_periodic() => Dragged::Clamped(vertex, by),
        _ => Dragged::Point(random.between(0.0, 1.0) * polygon.segments() as f64, by),
    }
}

/// The same drag, half as far.
fn half(dragged: &Dragged, polygon: &FloatPolygon) -> Dragged {
    match dragged {
        Dragged::Vertices(places) => {
            let half = |(vertex, place): &(usize, DVec3)| {
                (*vertex, polygon.vertex(*vertex).lerp(*place, 0.5))
            };
            Dragged::Vertices(places.iter().map(half).collect())
        }
        Dragged::Clamped(index, by) => Dragged::Clamped(*index, 0.5 * *by),
        Dragged::Point(u, by) => Dragged::Point(*u, 0.5 * *by),
    }
}

/// Where what is dragged is.
fn place(dragged: &Dragged, polygon: &FloatPolygon) -> DVec3 {
    match dragged {
        Dragged::Vertices(places) => polygon.vertex(places[0].0),
        Dragged::Clamped(index, _) => ClampedPolygon::from_float(polygon).vertices()[*index],
        Dragged::Point(u, _) => polygon.point(*u),
    }
}

fn moves(before: &FloatPolygon, after: &FloatPolygon) -> Vec<DVec3> {
    let pairs = before.vertices().iter().zip(after.vertices());
    pairs.map(|(before, after)| *after - *before).collect()
}

#[test]
fn drags_are_met_linear_and_zero_for_zero() {
    let mut random = Random(20);
    let mut refused = 0;
    for trial in 0..2000 {
        let polygon = curve(&mut random);
        let size = polygon.size();
        let in_space = !polygon.is_planar();
        let by = random.vector(0.5, in_space);
        let what = dragged(&mut random, &polygon, by);
        let span = 1 + below(&mut random, 6);
        let told = format!("trial {trial}: degree {}, {what:?}", polygon.degree());
        let after = match least_change(&polygon, &what, &reach(span, &[])) {
            Ok(after) => after,
            Err(LeastChangeError::NoFreedom) => {
                // Points beside an end that stays, and curves of few vertices.
                refused += 1;
                continue;
            }
            Err(error) => panic!("{told}: {error}"),
        };
        let off = place(&what, &after).distance(place(&what, &polygon) + by);
        assert!(off <= MET * size, "{told}: {off:e}");
        let whole = moves(&polygon, &after);
        let most = whole.iter().fold(0.0_f64, |most, it| most.max(it.length()));
        let less = least_change(&polygon, &half(&what, &polygon), &reach(span, &[]));
        let less = moves(&polygon, &less.expect("half of it"));
        for (whole, half) in whole.iter().zip(&less) {
            // A rounded vertex has no more digits.
            let allowed = LINEAR * most + 4.0 * f64::EPSILON * size;
            let off = (*whole - 2.0 * *half).length();
            assert!(off <= allowed, "{told}: {off:e} of {most:e}, {size}");
        }
        let zero = match &what {
            Dragged::Vertices(places) => {
                let vertex = places[0].0;
                Dragged::Vertices(vec![(vertex, polygon.vertex(vertex))])
            }
            Dragged::Clamped(index, _) => Dragged::Clamped(*index, DVec3::ZERO),
            Dragged::Point(u, _) => Dragged::Point(*u, DVec3::ZERO),
        };
        assert_eq!(
            least_change(&polygon, &zero, &reach(span, &[])),
            Ok(polygon.clone()),
            "{told}"
        );
        assert_eq!(after.is_planar(), !in_space, "{told}");
    }
    assert!(refused < 200, "{refused} of 2000 refused");
}

#[test]
fn vertices_out_of_reach_locked_ones_and_ends_stay() {
    let mut random = Random(4);
    for trial in 0..400 {
        let polygon = curve(&mut random);
        let (count, degree) = (polygon.vertices().len(), polygon.degree());
        if count < 2 * degree + 12 {
            continue;
        }
        let span = 3;
        let by = random.vector(0.5, !polygon.is_planar());
        let vertex = below(&mut random, count);
        let locked = [(vertex + 2) % count];
        let what = Dragged::Vertices(vec![(vertex, polygon.vertex(vertex) + by)]);
        let after = least_change(&polygon, &what, &reach(span, &locked)).expect("a change");
        for index in 0..count {
            let apart = index.abs_diff(vertex);
            let apart = match polygon.is_periodic() {
                true => apart.min(count - apart),
                false => apart,
            };
            if apart > span || locked.contains(&index) {
                assert_eq!(after.vertex(index), polygon.vertex(index), "trial {trial}");
            }
        }
        let u = 0.5 * polygon.segments() as f64;
        let what = Dragged::Point(u, by);
        let after = least_change(&polygon, &what, &reach(1, &[])).expect("a change");
        let moved = moves(&polygon, &after)
            .iter()
            .filter(|it| **it != DVec3::ZERO)
            .count();
        assert!(moved <= degree + 3, "trial {trial}: {moved}");
        if !polygon.is_periodic() {
            check_ends(&polygon, &after);
        }
    }
}

#[test]
fn features_out_of_reach_stay_to_the_bit() {
    let mut random = Random(9);
    let mut told = [0; 2];
    for trial in 0..60 {
        let (degree, count, span) = (5, 25 + below(&mut random, 36), 5);
        let wave = random.between(0.3, 0.8);
        let vertices = (0..count).map(|index| {
            let x = index as f64;
            DVec3::new(x, 3.0 * (wave * x).sin(), 0.0) + random.vector(0.05, false)
        });
        let vertices: Vec<DVec3> = vertices.collect();
        let polygon = FloatPolygon::new(degree, vertices, None, false).expect("a polygon");
        let vertex = below(&mut random, count);
        let by = random.vector(0.03 * polygon.size(), false);
        let what = Dragged::Vertices(vec![(vertex, polygon.vertex(vertex) + by)]);
        let after = least_change(&polygon, &what, &reach(span, &[])).expect("a change");
        // A vertex acts on n + 1 segments.
        let begin = vertex.saturating_sub(span + degree) as f64;
        let end = (vertex + span + 1) as f64;
        let outside = |polygon: &FloatPolygon| {
            let features = Features::new(polygon);
            let all = features.curvature_extrema.into_iter();
            let far = all.filter(|it| it.u[1] < begin || it.u[0] > end);
            far.map(|it| it.u).collect::<Vec<_>>()
        };
        let [before, now] = [&polygon, &after].map(outside);
        assert_eq!(before, now, "trial {trial}: vertex {vertex} of {count}");
        told[0] += before.len();
        told[1] += 1;
    }
    assert!(told[0] > 5 * told[1], "extrema far away: {told:?}");
}

#[test]
fn closed_vertices_at_the_ends_are_handles_of_point_and_tangent() {
    let mut random = Random(9);
    for degree in 2..=7 {
        let vertices = (0..24).map(|it| {
            let angle = 0.08 * f64::from(it);
            DVec3::new(10.0 * angle.sin(), 10.0 * angle.cos(), 0.0)
        });
        let polygon = FloatPolygon::new(degree, vertices.collect(), None, false).expect("one");
        let by = random.vector(0.5, false);
        for (index, end) in [(0, End::Start), (23, End::Finish)] {
            let what = Dragged::Clamped(index, by);
            let after = least_change(&polygon, &what, &reach(3, &[])).expect("a change");
            let [before, now] = [&polygon, &after].map(|it| it.end_jet(end));
            assert!(now.point.distance(before.point + by) <= MET * polygon.size());
            let turned = before.first.normalize().cross(now.first.normalize());
            assert!(turned.length() <= 1e-12, "degree {degree}");
        }
        for (index, end) in [(1, End::Start), (22, End::Finish)] {
            let what = Dragged::Clamped(index, by);
            let after = least_change(&polygon, &what, &reach(3, &[])).expect("a change");
            let [before, now] = [&polygon, &after].map(|it| it.end_jet(end));
            assert!(now.point.distance(before.point) <= MET * polygon.size());
            // The first leg of the closed polygon is the derivative over the degree.
            let leg = match end {
                End::Start => now.first - before.first,
                End::Finish => before.first - now.first,
            };
            assert!(
                (leg / degree as f64).distance(by) <= 1e-11,
                "degree {degree}"
            );
        }
    }
}

#[test]
fn closed_vertices_beside_an_end_do_not_swing_the_curve() {
    let vertices = (0..25).map(|it| {
        let angle = 0.08 * f64::from(it);
        DVec3::new(10.0 * angle.sin(), 10.0 * angle.cos(), 0.0)
    });
    let polygon = FloatPolygon::new(5, vertices.collect(), None, false).expect("one");
    let by = DVec3::new(0.0, 0.01, 0.0);
    // By degree 5, the lever of the curvature is longer than that of the tangent.
    for (index, most) in [(1, 1.5), (2, 0.7), (3, 0.5), (22, 0.7), (23, 1.5)] {
        let what = Dragged::Clamped(index, by);
        // Few others follow, or all.
        for span in [1, 24] {
            let after = least_change(&polygon, &what, &reach(span, &[])).expect("a change");
            let places = (0..=400).map(|it| f64::from(it) / 20.0);
            let moves = places.map(|u| after.point(u).distance(polygon.point(u)));
            let farthest = moves.fold(0.0, f64::max) / by.length();
            assert!(farthest < most, "{index}, {span}: {farthest}");
        }
    }
}

#[test]
fn a_change_is_no_corner() {
    let vertices = (0..40).map(|it| DVec3::new(f64::from(it), 0.0, 0.0));
    let polygon = FloatPolygon::new(5, vertices.collect(), None, false).expect("one");
    let by = DVec3::new(0.0, 3.0, 0.0);
    let what = Dragged::Point(17.5, by);
    let after = least_change(&polygon, &what, &reach(8, &[])).expect("a change");
    let heights: Vec<f64> = after.vertices().iter().map(|it| it.y).collect();
    let bends = heights
        .windows(3)
        .map(|it| (it[0] - 2.0 * it[1] + it[2]).abs());
    // A single vertex that moves so far bends by twice the drag at least.
    let sharpest = bends.fold(0.0, f64::max);
    assert!(sharpest < 0.1 * by.y, "{sharpest}");
    let times = magnification(&polygon, &what, &reach(8, &[])).expect("a change");
    assert!((1.0..1.2).contains(&times), "{times}");
}

#[test]
fn what_has_no_freedom_is_refused() {
    let points = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
    let line = FloatPolygon::planar(1, &points[..2]).expect("one");
    let all = Dragged::Point(0.5, DVec3::Y);
    let free = least_change(&line, &all, &reach(1, &[]));
    assert_eq!(free, Err(LeastChangeError::NoFreedom));
    let arc = FloatPolygon::planar(2, &points).expect("one");
    let locked = least_change(&arc, &all, &reach(1, &[0, 1, 2]));
    assert_eq!(locked, Err(LeastChangeError::NoFreedom));
    let missing = least_change(&arc, &Dragged::Clamped(9, DVec3::Y), &reach(1, &[]));
    assert!(matches!(missing, Err(LeastChangeError::Polygon(_))));
}
