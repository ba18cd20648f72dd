//! The intervals of proved features: they are apart where doubles can tell, narrow, and end at cusps.

use crate::common::{assert_near, counts, exact};
use batten::geometry::features::{ExtremumKind, Feature, Features};
use batten::geometry::{BezierPolygon, FloatPolygon};
use glam::DVec3;

fn features(degree: usize, points: &[(f64, f64)]) -> Features {
    exact(&FloatPolygon::planar(degree, points).expect("a valid polygon"))
}

/// The middle of bounds.
fn middle([low, high]: [f64; 2]) -> f64 {
    0.5 * (low + high)
}

/// Assert that the intervals of every list are in order and apart, around the joint as well.
fn assert_apart(features: &Features, joint: Option<f64>) {
    let lists: [Vec<[f64; 2]>; 5] = [
        features.inflections.iter().map(|root| root.u).collect(),
        features.curvature_extrema.iter().map(|e| e.u).collect(),
        features.torsion_zeros.iter().map(|root| root.u).collect(),
        features.torsion_extrema.iter().map(|e| e.u).collect(),
        features.cusps.iter().map(|cusp| cusp.u).collect(),
    ];
    for list in lists {
        let apart = list.windows(2).all(|pair| pair[0][1] < pair[1][0]);
        assert!(apart, "{list:?}");
        if let ([first, .., last], Some(joint)) = (&list[..], joint) {
            assert!(last[1] - joint < first[0], "{list:?}");
        }
    }
}

/// The float polygon of one Bézier curve.
fn from_bezier(points: &[(f64, f64)]) -> FloatPolygon {
    let vertices = points
        .iter()
        .map(|(x, y)| DVec3::new(*x, *y, 0.0))
        .collect();
    let bezier = BezierPolygon::new(points.len() - 1, vertices, None).expect("valid");
    bezier.to_float().expect("one segment")
}

#[test]
fn seven_cusps_at_every_place_of_a_cut_are_all_found_and_no_extremum_is_claimed_there() {
    let points = [
        (46566829638320.0, -65949935514904.0),
        (-1395818977360.0, 4639490251352.0),
        (170812580720.0, -985307749912.0),
        (-36518521360.0, 394049918744.0),
        (7487766320.0, -258755207320.0),
        (7487766320.0, 266246852696.0),
        (-36518521360.0, -430564561048.0),
        (170812580720.0, 1156124209688.0),
        (-1395818977360.0, -6035305349656.0),
        (46566829638320.0, 112516769032280.0),
    ];
    let features = features(9, &points);
    let places: Vec<f64> = (5..=11).map(|place| f64::from(place) / 16.0).collect();
    let found: Vec<_> = features
        .cusps
        .iter()
        .map(|cusp| (cusp.u, cusp.proved))
        .collect();
    let expected: Vec<_> = places.iter().map(|place| ([*place; 2], true)).collect();
    assert_eq!(found, expected);
    for extremum in &features.curvature_extrema {
        let [low, high] = extremum.u;
        assert!(!places.iter().any(|place| low <= *place && *place <= high));
        assert!(extremum.value[0].is_finite() && extremum.value[1].is_finite());
    }
    for doubt in &features.undecided {
        let [low, high] = doubt.u;
        assert!(places.iter().any(|place| low <= *place && *place <= high));
    }
    assert_apart(&features, None);
}

#[test]
fn curvature_that_only_touches_zero_is_decided() {
    // y = (2 t − 1)⁴ above x = 4 t: the curvature is 0 in the middle, and positive elsewhere.
    let curve = from_bezier(&[(0.0, 1.0), (1.0, -1.0), (2.0, 1.0), (3.0, -1.0), (4.0, 1.0)]);
    let features = exact(&curve);
    assert_eq!(features.undecided, []);
    assert_eq!(features.inflections, []);
    let holds = |u: [f64; 2]| u[0] <= 0.5 && 0.5 <= u[1];
    let mut extrema = features.curvature_extrema.iter();
    let flattest = extrema
        .find(|extremum| holds(extremum.u))
        .expect("a minimum");
    assert_eq!(flattest.kind, ExtremumKind::Minimum);
    assert_eq!(flattest.value, [0.0, 0.0]);
}

#[test]
fn cusps_are_proved_wherever_they_are() {
    // C′ = 6 (2 t² − 1) (1, t) vanishes at √½; on a line (2 t − 1)² does at ½, without turning.
    let curve = from_bezier(&[
        (0.0, 0.0),
        (-1.5, 0.0),
        (-3.0, -0.5),
        (-3.5, -1.5),
        (-2.0, 0.0),
    ]);
    let line = from_bezier(&[(0.0, 0.0), (1.0, 0.0), (0.0, 0.0), (1.0, 0.0)]);
    for (curve, place) in [(curve, 0.5_f64.sqrt()), (line, 0.5)] {
        let features = exact(&curve);
        let [cusp] = features.cusps[..] else {
            panic!("{features:?}");
        };
        assert!(
            cusp.proved && cusp.u[0] <= place && place <= cusp.u[1],
            "{cusp:?}"
        );
        assert!(cusp.u[1] <= cusp.u[0].next_up(), "{cusp:?}");
    }
}

#[test]
fn roots_beside_a_tangent_that_nearly_vanishes_are_decided() {
    // C′ = (2 s, 3 s² + ε) with s = t − ½: κ = 0 at s² = ε / 3, κ′ = 0 at 0 and near s² = ε. The
    // smallest tangent is ε long.
    let tiny = f64::EPSILON * 2.0;
    let points = [
        (0.0, 0.0),
        (-2.0, 2.25 + tiny),
        (-2.0, 1.5 + 2.0 * tiny),
        (0.0, 3.75 + 3.0 * tiny),
    ];
    let features = features(3, &points);
    assert_eq!(features.undecided, []);
    assert_eq!(features.cusps, []);
    assert_eq!(counts(&features)[..2], [2, 3]);
    let half = (tiny / 3.0).sqrt();
    for (root, s) in features.inflections.iter().zip([-half, half]) {
        assert_near("inflection", middle(root.u), 0.5 + s, 2e-12, 1.0);
    }
    // κ = −2 ε / ε³ where the tangent is smallest: doubles see no digit of it.
    let sharpest = features.curvature_extrema[1];
    let expected = -2.0 / (tiny * tiny);
    assert!(sharpest.u[0] <= 0.5 && 0.5 <= sharpest.u[1]);
    assert!(sharpest.value[0] <= expected && expected <= sharpest.value[1]);
    assert!(sharpest.value[1] - sharpest.value[0] <= 1e-10 * expected.abs());
}

/// A cubic that has an inflection at the knot between its first two segments, because three
/// vertices lie in line, and another one `after` behind it, because the tangent is tiny there.
fn inflections_near_a_knot(after: f64) -> Vec<(f64, f64)> {
    vec![
        (0.0, 1.0),
        (1.0, 0.0),
        (0.0, 0.0),
        (1.0 - 2.0 * after, 0.0),
        (2.0, -1.0),
    ]
}

#[test]
fn a_root_next_to_a_knot_does_not_share_the_knots_interval() {
    let after = 0.5_f64.powi(44);
    let features = features(3, &inflections_near_a_knot(after));
    let [at_knot, behind] = features.inflections[..] else {
        panic!("{features:?}");
    };
    assert_eq!((at_knot.u, at_knot.count, behind.count), ([1.0; 2], 1, 1));
    // The root is at 1 + 2⁻⁴⁴ / (1 − 2⁻⁴⁴).
    let place = 1.0 + after;
    assert_eq!(behind.u, [place, place.next_up()]);
    assert_apart(&features, None);
}

#[test]
fn roots_that_doubles_cannot_tell_apart_share_an_interval_with_their_count() {
    let after = 0.5_f64.powi(54);
    let features = features(3, &inflections_near_a_knot(after));
    let [both] = features.inflections[..] else {
        panic!("{features:?}");
    };
    assert_eq!(both.u, [1.0, 1.0_f64.next_up()]);
    assert_eq!(both.count, 2);
    assert_apart(&features, None);
}

#[test]
fn intervals_are_apart_wherever_the_joint_of_a_periodic_curve_is() {
    for after in [0.5_f64.powi(44), 0.5_f64.powi(50), 0.5_f64.powi(54)] {
        let mut points = inflections_near_a_knot(after);
        points.push((4.0, 3.0));
        let found = (0..points.len()).map(|by| {
            let mut points = points.clone();
            points.rotate_left(by);
            let vertices = points
                .iter()
                .map(|(x, y)| DVec3::new(*x, *y, 0.0))
                .collect();
            let curve = FloatPolygon::new(3, vertices, None, true).expect("valid");
            let features = exact(&curve);
            assert_apart(&features, Some(curve.segments() as f64));
            counts(&features)
        });
        let found: Vec<_> = found.collect();
        assert!(found.iter().all(|counts| *counts == found[0]), "{found:?}");
    }
}

#[test]
fn no_feature_begins_where_an_undecided_piece_ends() {
    // Beside a near-cusp: the knot u = 1 may hold another change than the one right after it.
    let points = [
        (979569.5, 36463586.5, -23124210.5),
        (564194.5, 17280011.5, -11423110.5),
        (1204798.0, 28724386.0, -20208322.0),
        (289969.0, 4855043.0, -3802321.0),
        (29954.75, 271243.25, -272615.25),
        (38189.0, -2977.0, -161621.0),
        (3219.5, -52563.5, 15539.5),
        (-1351.0, -12757.0, 14439.0),
        (-1562.0, 41386.0, -16042.0),
        (117.25, -294.25, -615.25),
        (119.5, -6063.5, 2839.5),
        (-255.5, 4361.5, -560.5),
        (-50.5, 7646.5, -4230.5),
        (367.25, -10164.25, 2694.75),
        (29.75, -14581.75, 8509.75),
        (-29422.0, 899446.0, -233042.0),
        (-15615.25, 670393.25, -230705.25),
        (-173851.0, 8956343.0, -3362861.0),
        (-196640.5, 11605496.5, -4572960.5),
        (-781231.0, 51583523.0, -20990961.0),
        (-708330.5, 51541286.5, -21474110.499999996),
        (-25791762.0, -29015732.0, 19343821.0),
    ];
    let weights = vec![
        2.0, 2.0, 0.5, 1.0, 4.0, 1.0, 2.0, 1.0, 0.5, 4.0, 2.0, 2.0, 2.0, 4.0, 4.0, 0.5, 4.0, 1.0,
        2.0, 1.0, 2.0, 4.0,
    ];
    let points: Vec<DVec3> = points.into_iter().map(DVec3::from).collect();
    let polygon = FloatPolygon::new(20, points, Some(weights), false).expect("a valid polygon");
    let features = exact(&polygon);
    let doubts = features.undecided.iter();
    let doubts = doubts.filter(|doubt| doubt.quantity == Feature::CurvatureExtremum);
    let doubts: Vec<[f64; 2]> = doubts.map(|doubt| doubt.u).collect();
    assert!(!doubts.is_empty());
    for extremum in &features.curvature_extrema {
        for doubt in &doubts {
            let apart = extremum.u[1] < doubt[0] || doubt[1] < extremum.u[0];
            assert!(apart, "{extremum:?} {doubt:?}");
        }
    }
}
