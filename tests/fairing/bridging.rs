//! Bridges between parts: what stays, how smooth they are, how many features they have.

use batten::geometry::fairing::bridging::{
    Bridge, BridgeError, Bridged, close, join, largest_jump,
};
use batten::geometry::features::{Feature, Features};
use batten::geometry::{FloatPolygon, PolygonError, Progress};
use glam::{DMat3, DVec3};

use crate::common::Random;

/// What is left of jumps that are 0 in exact numbers.
const ROUNDING: f64 = 1e-14;

/// The largest relative error of two dots of moved points, legs and angles.
const RIGID: f64 = 1e-12;

const FIXED: Bridge = Bridge {
    vertices: None,
    second_moves: false,
};

const MOVING: Bridge = Bridge {
    vertices: None,
    second_moves: true,
};

fn joined(first: &FloatPolygon, second: &FloatPolygon, bridge: &Bridge) -> Bridged {
    join(first, second, bridge, &Progress::default()).expect("a composite")
}

/// A run of vertices on a spiral whose curvature is linear in its length, with some rise.
fn spiral(count: usize, curvature: [f64; 2], rise: f64) -> Vec<DVec3> {
    let mut angle: f64 = 0.0;
    let mut point = DVec3::ZERO;
    let mut vertices = vec![point];
    for index in 1..count {
        let share = index as f64 / count as f64;
        angle += curvature[0] + share * (curvature[1] - curvature[0]);
        point += DVec3::new(angle.cos(), angle.sin(), rise * share);
        vertices.push(point);
    }
    vertices
}

/// Cut a bridge's length out of a spiral: the parts of degree n before and after.
fn parts(degree: usize, weighted: bool, rise: f64) -> [FloatPolygon; 2] {
    let beside = degree + 5;
    let gap = degree + 3;
    let all = spiral(2 * beside + gap, [0.02, 0.12], rise);
    let part = |range: std::ops::Range<usize>| {
        let weights = range.clone().map(|index| 1.0 + 0.01 * index as f64);
        let weights = weighted.then(|| weights.collect());
        FloatPolygon::new(degree, all[range].to_vec(), weights, false).expect("a part")
    };
    [part(0..beside), part(beside + gap..all.len())]
}

/// The two parts of the composite to the bit, and a single polygon: all derivatives up to n − 1
/// continuous. Derivatives are evaluated segment by segment, from both sides of every knot.
fn check_composite(found: &Bridged, [first, second]: [&FloatPolygon; 2]) {
    let polygon = &found.polygon;
    let count = polygon.vertices().len();
    assert_eq!(found.bridge.start, first.vertices().len());
    assert_eq!(found.bridge.end, count - second.vertices().len());
    for (part, offset) in [(first, 0), (second, found.bridge.end)] {
        for index in 0..part.vertices().len() {
            assert_eq!(polygon.vertex(offset + index), part.vertex(index));
            assert_eq!(polygon.weight(offset + index), part.weight(index));
        }
        for segment in 0..part.segments() {
            for t in [0.0, 0.3, 1.0] {
                let whole = polygon.segment_jet(offset + segment, t);
                assert_eq!(whole, part.segment_jet(segment, t));
            }
        }
    }
    assert!(largest_jump(polygon, &found.bridge) < ROUNDING);
    // The jets at the knots, beside the general formula.
    for knot in 1..polygon.segments() {
        let [left, right] = [(knot - 1, 1.0), (knot, 0.0)].map(|(s, t)| polygon.segment_jet(s, t));
        let size = polygon.size();
        assert!(left.point.distance(right.point) <= 1e-13 * size);
        if polygon.degree() > 1 {
            assert!(left.first.distance(right.first) <= 1e-12 * size);
        }
        if polygon.degree() > 3 {
            assert!(left.third.distance(right.third) <= 1e-11 * size);
        }
    }
}

#[test]
fn composites_of_every_degree_are_smooth_and_keep_their_parts_to_the_bit() {
    for degree in 1..=12 {
        for weighted in [false, true] {
            for rise in [0.0, 0.3] {
                let [first, second] = parts(degree, weighted, rise);
                let found = joined(&first, &second, &FIXED);
                check_composite(&found, [&first, &second]);
                for vertices in [0, 1, degree + 3] {
                    let bridge = Bridge {
                        vertices: Some(vertices),
                        ..FIXED
                    };
                    let found = joined(&first, &second, &bridge);
                    assert_eq!(found.bridge.len(), vertices);
                    check_composite(&found, [&first, &second]);
                }
            }
        }
    }
}

#[test]
fn a_gap_cut_out_of_a_spiral_is_closed_as_it_was() {
    for degree in 3..=9 {
        let [first, second] = parts(degree, false, 0.0);
        let all = spiral(2 * (degree + 5) + degree + 3, [0.02, 0.12], 0.0);
        let found = joined(&first, &second, &FIXED);
        assert_eq!(found.bridge.len(), degree + 3, "degree {degree}");
        for index in found.bridge.clone() {
            let apart = found.polygon.vertex(index).distance(all[index]);
            assert!(apart < 1e-2, "degree {degree}: {apart}");
        }
        let features = Features::new(&found.polygon);
        assert_eq!(features.count(Feature::CurvatureExtremum), 0);
        assert_eq!((found.counts.extrema, found.undecided), (0, 0));
    }
}

#[test]
fn a_second_part_moves_rigidly_to_where_it_fits() {
    let mut random = Random(5);
    for degree in 1..=9 {
        for rise in [0.0, 0.2] {
            let [first, second] = parts(degree, false, rise);
            let angle = random.between(0.0, 6.0);
            let turn = DMat3::from_rotation_z(angle);
            let by = random.vector(30.0, rise > 0.0);
            let moved = second.vertices().iter().map(|vertex| turn * *vertex + by);
            let moved = FloatPolygon::new(degree, moved.collect(), None, false).expect("a part");
            let found = joined(&first, &moved, &MOVING);
            let after = &found.polygon.vertices()[found.bridge.end..];
            // Distances stay, and in space the sense of turning.
            for a in 0..after.len() {
                for b in 0..a {
                    let before = moved.vertex(a).distance(moved.vertex(b));
                    let apart = (after[a].distance(after[b]) - before).abs();
                    assert!(apart <= RIGID * moved.size(), "{apart}");
                }
            }
            let volume = |vertices: &[DVec3]| {
                let legs = [1, 2, 3].map(|index| vertices[index] - vertices[0]);
                legs[0].cross(legs[1]).dot(legs[2])
            };
            if after.len() > 3 {
                let [a, b] = [volume(moved.vertices()), volume(after)];
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
            assert_eq!(found.polygon.is_planar(), rise == 0.0);
            for (a, b) in first.vertices().iter().zip(found.polygon.vertices()) {
                assert_eq!(a, b);
            }
            if degree > 2 && rise == 0.0 {
                assert_eq!(found.counts.extrema, 0, "degree {degree}");
            }
        }
    }
}

#[test]
fn a_curve_that_was_cut_is_whole_again_and_one_that_was_opened_is_periodic_again() {
    for degree in 1..=9 {
        let whole = FloatPolygon::new(degree, spiral(4 * degree + 6, [0.0, 0.2], 0.0), None, false);
        let whole = whole.expect("a curve");
        let (first, second) = whole.split((degree + 2) as f64, 0).expect("two parts");
        let found = joined(&first.polygon, &second.polygon, &FIXED);
        assert_eq!(found.polygon, whole);
        assert!(found.bridge.is_empty());
        let round = (0..degree + 8).map(|index| {
            let angle = std::f64::consts::TAU * index as f64 / (degree + 8) as f64;
            DVec3::new(3.0 * angle.cos(), angle.sin(), 0.0)
        });
        let periodic = FloatPolygon::new(degree, round.collect(), None, true).expect("periodic");
        let closed = close(&periodic.unrolled(), None, &Progress::default());
        assert_eq!(closed.expect("it closes").polygon, periodic);
    }
}

#[test]
fn a_closed_curve_keeps_its_part_and_is_smooth_all_round() {
    for degree in 3..=12 {
        // Three quarters of a circle of 24 vertices.
        let vertices = (0..18.max(degree + 2)).map(|index| {
            let angle = std::f64::consts::TAU * index as f64 / 24.0;
            DVec3::new(angle.cos(), angle.sin(), 0.0)
        });
        let open = FloatPolygon::new(degree, vertices.collect(), None, false).expect("open");
        let found = close(&open, None, &Progress::default()).expect("it closes");
        assert!(found.polygon.is_periodic());
        assert_eq!(found.bridge.end, found.polygon.vertices().len());
        let kept = &found.polygon.vertices()[..open.vertices().len()];
        assert_eq!(kept, open.vertices());
        assert!(largest_jump(&found.polygon, &found.bridge) < ROUNDING);
        for index in found.bridge {
            let radius = found.polygon.vertex(index).length();
            assert!((radius - 1.0).abs() < 1e-3, "degree {degree}: {radius}");
        }
    }
}

#[test]
fn what_cannot_be_joined_is_refused() {
    let [first, second] = parts(3, false, 0.0);
    let [other, _] = parts(4, false, 0.0);
    let progress = Progress::default();
    assert_eq!(
        join(&first, &other, &FIXED, &progress),
        Err(BridgeError::Degrees {
            first: 3,
            second: 4
        })
    );
    let round = FloatPolygon::new(3, first.vertices().to_vec(), None, true).expect("periodic");
    let refused = Err(BridgeError::Polygon(PolygonError::PeriodicCurve {
        done: "joined",
    }));
    assert_eq!(join(&first, &round, &FIXED, &progress), refused);
    let away = second
        .vertices()
        .iter()
        .map(|vertex| *vertex + 1e6 * DVec3::X);
    let away = FloatPolygon::new(3, away.collect(), None, false).expect("a part");
    let refused = join(&first, &away, &FIXED, &progress);
    assert!(matches!(refused, Err(BridgeError::TooFar { needed }) if needed > 500_000));
    // A given number is as many as are asked for.
    let given = Bridge {
        vertices: Some(20),
        ..FIXED
    };
    assert_eq!(joined(&first, &away, &given).bridge.len(), 20);
    progress.cancel();
    assert_eq!(
        join(&first, &second, &FIXED, &progress),
        Err(BridgeError::Cancelled)
    );
}

/// The integral of the squared curvature over a curve's length.
fn bending_energy(polygon: &FloatPolygon) -> f64 {
    let steps = 64;
    let places = (0..polygon.segments() * steps).map(|place| {
        let t = ((place % steps) as f64 + 0.5) / steps as f64;
        let jet = polygon.segment_jet(place / steps, t);
        jet.signed_curvature().powi(2) * jet.first.length() / steps as f64
    });
    places.sum()
}

#[test]
fn a_wide_gap_is_bridged_without_a_long_way_round() {
    // Both arcs end at their crests and run to the right: many vertices would dive deep between them.
    let arc = |degree: usize, centre: f64, axes: [f64; 2], from: f64| {
        let vertices = (0..degree + 6).map(|index| {
            let angle = (from - 8.0 * index as f64).to_radians();
            DVec3::new(centre + axes[0] * angle.cos(), axes[1] * angle.sin(), 0.0)
        });
        FloatPolygon::new(degree, vertices.collect(), None, false).expect("an arc")
    };
    for degree in 3..=9 {
        let begin = 90.0 + 8.0 * (degree + 5) as f64;
        let first = arc(degree, 0.0, [5.0, 6.5], begin);
        let second = arc(degree, 13.0, [3.0, 6.2], 90.0);
        let found = joined(&first, &second, &FIXED);
        let few = Bridge {
            vertices: Some(6),
            ..FIXED
        };
        let few = bending_energy(&joined(&first, &second, &few).polygon);
        let energy = bending_energy(&found.polygon);
        println!("{degree}: {} {energy} {few}", found.bridge.len());
        assert!(energy < 1.5 * few, "degree {degree}: {energy} {few}");
        assert!(found.bridge.len() <= 20, "degree {degree}");
    }
}
