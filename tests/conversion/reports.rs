//! What operations say of their results: deviations, orders, refusals.

use std::f64::consts::TAU;

use crate::common::{Random, reach};
use batten::geometry::{
    Amplification, BezierPolygon, ClampedPolygon, End, FloatPolygon, PolygonError,
};
use glam::DVec3;

/// By how much a bound of a deviation may lie above the deviation.
const GAP: f64 = 1.001;

/// What may be left between ends that are kept, in units of the curve's size.
const END_TOLERANCE: f64 = 1e-12;

/// The largest difference of two lists of points.
fn distance(a: &[DVec3], b: &[DVec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    let pairs = a.iter().zip(b);
    pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

fn wave(degree: usize, count: usize) -> FloatPolygon {
    arc(degree, count, 0.5)
}

/// Vertices on a circle, at equal angles.
fn arc(degree: usize, count: usize, step: f64) -> FloatPolygon {
    let vertices = (0..count).map(|i| {
        let turn = step * i as f64;
        DVec3::new(10.0 * turn.cos(), 10.0 * turn.sin(), 0.0)
    });
    FloatPolygon::new(degree, vertices.collect(), None, false).expect("valid")
}

#[test]
fn a_bound_of_a_deviation_is_attained_to_a_thousandth() {
    let polygon = wave(3, 10);
    let mut moved = polygon.clone();
    // The largest value of one uniform cubic basis function is 2/3, at the middle knot.
    let vertex = moved.vertices()[5] + DVec3::new(0.3, 0.4, 0.0);
    moved.move_vertices([(5, vertex)]).expect("valid");
    let found = polygon.deviation(&moved).expect("the same knots");
    let expected = 0.5 * 2.0 / 3.0;
    assert!(
        found >= expected * (1.0 - 4.0 * f64::EPSILON) && found <= expected * GAP,
        "{found}"
    );
    assert_eq!(polygon.deviation(&polygon), Ok(0.0));
    assert!(matches!(
        polygon.deviation(&wave(3, 11)),
        Err(PolygonError::DifferentKnots {
            segments: 7,
            other: 8
        })
    ));
}

#[test]
fn other_degrees_approximate_to_the_order_of_the_lower_one() {
    // Half the step between the vertices of a smooth curve: 2^{order} times nearer.
    for (from, to) in [(3, 4), (5, 6), (5, 8), (4, 3), (7, 5), (9, 7)] {
        let [coarse, fine] = [0.4, 0.2].map(|step| {
            let count = (20.0 / step) as usize;
            let changed = arc(from, count, step).with_degree(to).expect("valid");
            assert!(!changed.exact);
            changed.deviation
        });
        let order = (from.min(to) + 1) as f64;
        let found = (coarse / fine).log2();
        assert!(found >= order - 0.1, "{from} to {to}: {coarse:e}, {fine:e}");
    }
}

#[test]
fn lowering_errs_by_the_bernoulli_monospline() {
    // The difference of a polynomial of degree m + 1 and the spline nearest to it on uniform
    // knots is a Bernoulli polynomial: |B_{m+1}| / (m + 1)! times the derivative. On a circle of
    // radius 10 that derivative is 10 h^{m+1}, h the angle, but for the curve's own shrinking.
    let step = TAU / 63.0;
    for (from, to, bernoulli) in [(4, 3, 1.0 / 30.0), (7, 5, 1.0 / 42.0), (9, 5, 1.0 / 42.0)] {
        let factorial: f64 = (1..=to + 1).map(|k| k as f64).product();
        let expected = 10.0 * step.powi(to as i32 + 1) * bernoulli / factorial;
        let open = arc(from, 63, step);
        let circle = FloatPolygon::new(from, open.vertices().to_vec(), None, true).expect("valid");
        // An open curve's ends are kept, where the monospline is furthest off: the rest is off by
        // its whole height, from lowest to highest, less than twice as much.
        for (polygon, most) in [(circle, 1.2), (open, 2.2)] {
            let changed = polygon.with_degree(to).expect("valid");
            let quotient = changed.deviation / expected;
            assert!(
                (0.9..=most).contains(&quotient),
                "{from} to {to}: {quotient}"
            );
        }
    }
}

#[test]
fn curves_of_another_degree_and_parts_of_curves_keep_their_ends() {
    let mut random = Random(21);
    for (degree, other) in [
        (2, 4),
        (3, 5),
        (5, 2),
        (5, 3),
        (5, 9),
        (9, 5),
        (9, 8),
        (7, 12),
    ] {
        for round in 0..8 {
            let count = 2 * degree.max(other) + 2 + round;
            let polygon = random.gentle(degree, count, round % 2 == 0, round % 3 == 0);
            let last = polygon.segments() as f64;
            let changes = [
                (polygon.with_degree(other), 0.0, last),
                (polygon.trimmed(0.3, last - 0.3, 0), 0.3, last - 0.3),
            ];
            for (changed, from, to) in changes {
                let Ok(curve) = changed else {
                    // Beyond the ends weights may change their sign.
                    assert!(polygon.is_rational());
                    continue;
                };
                assert!(!curve.exact);
                for (end, u) in [(End::Start, from), (End::Finish, to)] {
                    let (kept, given) = (curve.polygon.end_jet(end), polygon.jet(u));
                    let off = kept.point.distance(given.point);
                    assert!(
                        off <= END_TOLERANCE * polygon.size(),
                        "{degree} {other}: {off:e}"
                    );
                    let turn = kept.first.normalize().distance(given.first.normalize());
                    assert!(turn <= END_TOLERANCE, "{degree} {other}: {turn:e}");
                }
            }
        }
    }
}

#[test]
fn lowering_finds_a_raised_curve_again() {
    for degree in 2..=9 {
        let polygon = Random(degree as u64).gentle(degree, degree + 1, true, false);
        let raised = polygon.with_degree(degree + 2).expect("valid").polygon;
        let lowered = raised.with_degree(degree).expect("valid");
        // The float vertices of the raised curve are rounded, and lowering extrapolates.
        let norm = (1..=degree).map(|k| (2 * k - 1) as f64).product::<f64>();
        let allowed = f64::EPSILON * norm * reach(raised.vertices());
        let error = distance(lowered.polygon.vertices(), polygon.vertices());
        assert!(error <= allowed, "{degree}: {error:e} > {allowed:e}");
        assert!(
            lowered.deviation <= 1e-12 * reach(raised.vertices()),
            "{degree}"
        );
    }
}

/// Coordinates that arithmetic stumbles over.
const COORDINATES: [f64; 10] = [
    0.0, -0.0, 1.0, 0.1, 5e-324, -1e-300, 1e-160, 1e77, 1e100, -1e100,
];

/// Weights that arithmetic stumbles over.
const WEIGHTS: [f64; 4] = [1.0, 0.5, 1e-100, 1e100];

#[test]
fn nothing_panics_whatever_finite_numbers_come() {
    let mut random = Random(11);
    for round in 0..600_usize {
        let degree = 1 + round % 25;
        let count = degree + 1 + round % 7;
        let mut pick = |all: &[f64]| all[random.bits() as usize % all.len()];
        let vertices = (0..count)
            .map(|_| DVec3::new(pick(&COORDINATES), pick(&COORDINATES), pick(&COORDINATES)));
        let vertices = vertices.collect();
        let weights = (0..count).map(|_| pick(&WEIGHTS)).collect();
        let weights = Some(weights).filter(|_| round % 2 == 0);
        let polygon = FloatPolygon::new(degree, vertices, weights, round % 3 == 0);
        let polygon = polygon.expect("valid");
        let clamped = ClampedPolygon::from_float(&polygon);
        let bezier = BezierPolygon::from_float(&polygon);
        let _ = (
            clamped.to_float(),
            clamped.nearest_periodic_float(),
            clamped.rounded(3),
        );
        let _ = (
            bezier.to_float(),
            bezier.nearest_periodic_float(),
            polygon.rounded(3),
        );
        let _ = (
            polygon.subdivided(),
            polygon.with_degree(1 + (round / 25) % 25),
        );
        let _ = (
            polygon.extended(End::Start, 3),
            polygon.extended(End::Finish, 3),
        );
        let _ = (polygon.trimmed(0.25, 0.75, 2), polygon.trimmed(0.1, 0.7, 2));
        if let Ok(rounded) = polygon.rounded(0) {
            assert!(rounded.deviation >= 0.0, "{}", rounded.deviation);
        }
        if let Ok(changed) = polygon.with_degree(degree.max(2) - 1) {
            assert!(changed.deviation >= 0.0, "{}", changed.deviation);
        }
    }
}

#[test]
fn what_cannot_be_done_is_refused_with_the_place() {
    let polygon = wave(3, 10);
    let closed = FloatPolygon::new(3, polygon.vertices().to_vec(), None, true).expect("valid");
    assert!(matches!(
        polygon.with_degree(0),
        Err(PolygonError::DegreeOutOfRange { degree: 0 })
    ));
    assert!(polygon.with_degree(26).is_err());
    for (from, to) in [(0.0, 8.0), (3.0, 3.0), (5.0, 4.0)] {
        assert!(polygon.trimmed(from, to, 0).is_err(), "{from} {to}");
    }
    for (from, to) in [
        (f64::NAN, 2.0),
        (1.0, f64::NAN),
        (-1.0, 2.0),
        (1.0, f64::INFINITY),
    ] {
        assert!(polygon.trimmed(from, to, 3).is_err(), "{from} {to}");
        assert!(closed.trimmed(from, to, 3).is_err(), "{from} {to}");
    }
    let error = polygon
        .extended(End::Start, usize::MAX)
        .expect_err("far too long");
    assert!(matches!(error, PolygonError::TooManySegments { .. }));
    assert!(polygon.split(0.0, 0).is_err() && polygon.split(7.0, 0).is_err());
    for refused in [
        closed.split(2.5, 3).map(|_| ()),
        closed.extended(End::Start, 1).map(|_| ()),
    ] {
        let error = refused.expect_err("a periodic curve");
        assert!(error.to_string().contains("open it first"), "{error}");
    }
    // A weight that falls by ½ a vertex reaches 0 two vertices on.
    let weights = vec![3.0, 2.5, 2.0, 1.5, 1.0];
    let falling = FloatPolygon::new(1, polygon.vertices()[..5].to_vec(), Some(weights), false);
    let falling = falling.expect("valid");
    assert!(falling.extended(End::Finish, 1).is_ok());
    for (curve, end, index) in [
        (falling.clone(), End::Finish, 6),
        (falling.reversed(), End::Start, 0),
    ] {
        match curve.extended(end, 2) {
            Err(PolygonError::WeightLost { index: found, .. }) => assert_eq!(found, index),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_change_of_degree_names_the_vertex_beyond_the_range_from_either_direction() {
    let mut heights = [0.0; 9];
    heights[..5].copy_from_slice(&[-1e100, 1e100, -1e100, 1e100, -1e100]);
    let vertices = heights.map(|height| DVec3::new(1.0, height, 0.0));
    let polygon = FloatPolygon::new(4, vertices.to_vec(), None, false).expect("valid");
    let overflow = |polygon: &FloatPolygon| match polygon.with_degree(3) {
        Err(PolygonError::Overflow { index, .. }) => index,
        other => panic!("{other:?}"),
    };
    // The polygon of degree 3 has the vertices 0 to 7; those from 5 on are small.
    assert!(overflow(&polygon) < 5);
    assert!(overflow(&polygon.reversed()) > 2);
}

#[test]
fn dragging_a_clamped_vertex_moves_the_float_polygon_as_the_amplification_says() {
    for (degree, count) in [(3, 12), (5, 12), (9, 24), (9, 10)] {
        let clamped = ClampedPolygon::from_float(&wave(degree, count));
        let amplification = clamped.amplification();
        assert_eq!(
            Amplification::of_unclamping(degree, count - degree),
            amplification
        );
        let before = clamped.to_float().expect("polynomial");
        let mut largest = 0.0_f64;
        for index in 0..count {
            let mut vertices = clamped.vertices().to_vec();
            vertices[index].x += 1.0;
            let dragged = ClampedPolygon::new(degree, vertices, None).expect("valid");
            let after = dragged.to_float().expect("polynomial");
            largest = largest.max(distance(after.vertices(), before.vertices()));
        }
        // Adding 1 rounds the vertex, and that too is amplified.
        let error = (largest / amplification.largest - 1.0).abs();
        assert!(
            error <= 1e-13 * amplification.norm.max(10.0),
            "degree {degree}: {error:e}"
        );
    }
}
