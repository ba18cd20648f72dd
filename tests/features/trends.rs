//! The pieces on which the curvature rises, falls or is constant: they leave out cusps and extrema.

use crate::common::exact;
use batten::geometry::features::{ExtremumKind, Features, Trend};
use batten::geometry::{BezierPolygon, FloatPolygon};
use glam::DVec3;

fn planar(points: &[(f64, f64)]) -> FloatPolygon {
    FloatPolygon::planar(3, points).expect("a valid polygon")
}

/// Assert that no trend reaches into a cusp's interval, and that trends begin and end there.
fn assert_trends_end_at_cusps(features: &Features) {
    for [low, high] in features.cusps.iter().map(|cusp| cusp.u) {
        for piece in &features.trends {
            assert!(piece.u[1] <= low || high <= piece.u[0], "{features:?}");
        }
        let ends: Vec<f64> = features.trends.iter().map(|piece| piece.u[1]).collect();
        assert!(low == 0.0 || ends.contains(&low), "{low}: {features:?}");
    }
}

#[test]
fn no_trend_goes_through_a_cusp() {
    // The curvature falls towards the first curve's cusp and falls again after it; at the cusp of
    // the second one, t = ½, the slope changes its sign; the third runs along a line and back.
    let falling = [
        (-5.0, 2.0),
        (2.0, -1.0),
        (-3.0, 2.0),
        (-8.0, 5.0),
        (-7.0, 6.0),
        (-8.0, 5.0),
        (-4.0, 1.0),
        (0.0, 3.0),
    ];
    let turning = [(0.0, 0.0), (1.0, 2.0), (3.0, 6.0), (1.0, 2.0), (0.0, 0.0)];
    let cusped =
        [(0.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0, 0.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
    let cusped = BezierPolygon::new(3, cusped.to_vec(), None).expect("valid");
    let cusped = cusped.to_float().expect("one segment");
    for curve in [planar(&falling), cusped, planar(&turning)] {
        let features = exact(&curve);
        assert!(!features.cusps.is_empty());
        assert_trends_end_at_cusps(&features);
    }
}

#[test]
fn no_trend_goes_through_a_piece_that_stands_still() {
    let stalled = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (1.0, 0.0), (1.0, 3.0)];
    for by in 0..stalled.len() {
        let mut points = stalled;
        points.rotate_left(by);
        let vertices = points.iter().map(|(x, y)| DVec3::new(*x, *y, 0.0));
        let curve = FloatPolygon::new(2, vertices.collect(), None, true).expect("valid");
        let features = exact(&curve);
        // The segment of the three equal vertices, and the knots at both of its ends.
        let [cusp] = features.cusps[..] else {
            panic!("{features:?}");
        };
        let length = cusp.u[1] - cusp.u[0];
        assert!(cusp.proved && length >= 1.0, "{cusp:?}");
        for piece in &features.trends {
            let apart =
                |turn: f64| piece.u[1] <= cusp.u[0] + turn || cusp.u[1] + turn <= piece.u[0];
            assert!(apart(0.0) && apart(-5.0), "{features:?}");
        }
    }
}

#[test]
fn an_extremum_just_after_the_joint_is_apart_from_the_one_at_the_joint() {
    // The curvature jumps up at the joint and is greatest 2e-15 after it.
    let points = [
        (-1.0, -3.0),
        (-0.8, -2.8),
        (-0.7000000000000001, -2.5),
        (-0.6000000000000001, -2.2),
    ];
    let vertices = points.iter().map(|(x, y)| DVec3::new(*x, *y, 0.0));
    let curve = FloatPolygon::new(2, vertices.collect(), None, true).expect("valid");
    let features = exact(&curve);
    let [at_joint, after, ..] = features.curvature_extrema[..] else {
        panic!("{features:?}");
    };
    assert_eq!((at_joint.u, at_joint.count), ([0.0; 2], 1));
    assert_eq!(at_joint.kind, ExtremumKind::Minimum);
    assert!(0.0 < after.u[0] && after.u[1] <= 1e-14, "{after:?}");
    assert_eq!((after.count, after.kind), (1, ExtremumKind::Maximum));
    // Between them it rises: what is said of that begins and ends at their intervals.
    assert_eq!(features.trends[0].trend, Trend::Rising);
    assert_eq!(features.trends[0].u, [0.0, after.u[0]]);
}

#[test]
fn no_trend_goes_through_extrema_beside_a_knot() {
    // Two extrema lie closer to the knot 3 than doubles of u tell; the curvature falls before them
    // and jumps down at the knot.
    let points = [
        (-5.028784826658592e27, 4.023027861326874e28),
        (-4.023027861326874e28, 2.5143924133292962e28),
        (3.017270895995155e28, 0.0),
        (-1.0057569653317185e28, -5.028784826658592e27),
        (4.023027861326874e28, -4.023027861326874e28),
        (2.011513930663437e28, -3.5201493786610145e28),
        (4.525906343992733e28, 2.011513930663437e28),
    ];
    let weights = vec![
        4653.30438621133,
        9.303737281153732e46,
        1.6217292293404185e88,
        1.7041068245352402e28,
        938275.5898654959,
        7.287785125722534e74,
        4.9820001631281735e50,
    ];
    let vertices = points.iter().map(|(x, y)| DVec3::new(*x, *y, 0.0));
    let curve = FloatPolygon::new(2, vertices.collect(), Some(weights), false).expect("valid");
    let features = exact(&curve);
    let shared = features.curvature_extrema.iter();
    let shared = shared.filter(|extremum| extremum.u[0] <= 3.0 && 3.0 <= extremum.u[1]);
    let shared: Vec<_> = shared.collect();
    assert!(shared.len() == 1 && shared[0].count > 1, "{features:?}");
    for piece in &features.trends {
        for extremum in &features.curvature_extrema {
            let apart = piece.u[1] <= extremum.u[0] || extremum.u[1] <= piece.u[0];
            assert!(apart, "{piece:?} and {extremum:?}");
        }
    }
}
