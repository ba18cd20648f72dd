//! Points and derivatives against high precision, closed forms and each other.

use batten::geometry::references::{
    AnalyticForm, KINDS, Placement, PointList, ReferenceCurve, ReferenceError, ReferenceForm,
};
use batten::geometry::{Differentiable, LEVEL_ORDER, ParametricCurve};
use glam::{DQuat, DVec3};

use crate::common::{assert_near, assert_points_near, list, number, points, reference};

/// The point itself, relative to its size and the parameter's.
const POINT: f64 = 1e-12;

/// Derivatives to order 10, relative to the largest Taylor coefficient of the curve there: where a
/// coordinate's own derivative vanishes, those of the others round.
const DERIVATIVES: f64 = 1e-11;

#[test]
fn values_and_derivatives_to_order_10_agree_with_50_digits() {
    for case in list(&reference("reference_curves.json")["values"]) {
        let text = case["reference"].as_str().expect("a text");
        let curve = ReferenceCurve::from_text(text).expect("a reference");
        let t = number(&case["t"]);
        let expected = points(&case["derivatives"]);
        let found = curve.derivatives(t, expected.len() - 1);
        assert_eq!(found.len(), expected.len());
        for (order, (found, expected)) in found.iter().zip(&expected).enumerate() {
            let what = format!("{text} at {t}, derivative {order}");
            let scale = expected.length();
            match order {
                0 => assert_points_near(&what, *found, *expected, POINT, scale.max(1.0)),
                _ => assert_points_near(&what, *found, *expected, DERIVATIVES, scale),
            }
        }
    }
}

/// Every kind with its defaults.
fn kinds() -> impl Iterator<Item = ReferenceCurve> {
    KINDS.iter().map(|kind| {
        let form = AnalyticForm::new(kind, kind.defaults()).expect("defaults are allowed");
        ReferenceCurve::of(ReferenceForm::Analytic(form)).expect("a curve over its interval")
    })
}

#[test]
fn pieces_run_over_the_interval_and_join_smoothly() {
    for curve in kinds() {
        let [from, to] = curve.interval();
        let rate = (to - from) / curve.pieces() as f64;
        for piece in 0..curve.pieces() {
            let mut values = [DVec3::ZERO; LEVEL_ORDER + 1];
            curve.fill_derivatives(piece, 0.25, &mut values);
            let t = from + (piece as f64 + 0.25) * rate;
            let expected = curve.derivatives(t, LEVEL_ORDER);
            let mut factor = 1.0;
            for (order, (found, expected)) in values.iter().zip(&expected).enumerate() {
                let what = format!("{curve}, piece {piece}, derivative {order}");
                let expected = *expected * factor;
                // The parameter itself is rounded.
                let scale = expected.length().max(1.0);
                assert_points_near(&what, *found, expected, 1e-11, scale);
                factor *= rate;
            }
        }
        assert_eq!(curve.parameter(0.0), from);
        assert_eq!(curve.parameter(curve.pieces() as f64), to);
    }
}

#[test]
fn a_placement_rotates_scales_and_translates() {
    let rotation = DQuat::from_rotation_z(0.5) * DQuat::from_rotation_x(-1.0);
    let translation = DVec3::new(3.0, -2.0, 7.0);
    let placement = Placement::new(rotation * 3.0, 2.5, translation).expect("a placement");
    for curve in kinds() {
        let t = curve.parameter(0.3 * curve.pieces() as f64);
        let before = curve.derivatives(t, 4);
        let after = curve.clone().placed(placement).derivatives(t, 4);
        for (order, (before, after)) in before.into_iter().zip(after).enumerate() {
            let shift = if order == 0 { translation } else { DVec3::ZERO };
            let expected = 2.5 * (rotation * before) + shift;
            assert_points_near("placed", after, expected, 1e-14, expected.length());
        }
        assert!(!curve.placed(placement).is_planar());
    }
    let flat = Placement::new(DQuat::from_rotation_z(0.5), 1.0, DVec3::X).expect("a placement");
    let turned_over = Placement::new(DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0), 1.0, DVec3::Y);
    for placement in [flat, turned_over.expect("a placement")] {
        for curve in kinds() {
            let planar = curve.is_planar();
            let curve = curve.placed(placement);
            assert_eq!(curve.is_planar(), planar);
            let point = curve.derivatives(curve.interval()[0], 0)[0];
            assert!(!planar || point.z == 0.0);
        }
    }
}

#[test]
fn placements_that_are_none_are_refused() {
    for (rotation, scale, translation) in [
        (DQuat::IDENTITY, 0.0, DVec3::ZERO),
        (DQuat::IDENTITY, -1.0, DVec3::ZERO),
        (DQuat::IDENTITY, f64::NAN, DVec3::ZERO),
        (DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0), 1.0, DVec3::ZERO),
        (
            DQuat::from_xyzw(0.0, f64::INFINITY, 0.0, 0.0),
            1.0,
            DVec3::ZERO,
        ),
        (DQuat::IDENTITY, 1.0, DVec3::new(0.0, f64::NAN, 0.0)),
    ] {
        let refused = Placement::new(rotation, scale, translation);
        assert_eq!(refused, Err(ReferenceError::BadPlacement));
    }
}

#[test]
fn points_are_drawn_as_straight_lines() {
    let places = vec![
        DVec3::ZERO,
        DVec3::new(2.0, 1.0, 0.0),
        DVec3::new(2.0, 5.0, 0.0),
    ];
    let list = PointList::new(places.clone()).expect("points");
    let curve = ReferenceCurve::of(ReferenceForm::Points(list)).expect("a line");
    assert_eq!((curve.pieces(), curve.continuity()), (2, 0));
    assert!(curve.is_planar());
    // Where the legs meet the piece chooses the side.
    let before = curve.piece_jet(0, 1.0);
    let after = curve.piece_jet(1, 0.0);
    assert_eq!([before.point, after.point], [places[1]; 2]);
    assert_eq!(
        [before.first, after.first],
        [places[1], places[2] - places[1]]
    );
    assert_eq!(before.second, DVec3::ZERO);
    let middle = curve.derivatives(1.5, 2);
    assert_eq!(
        middle,
        [
            DVec3::new(2.0, 3.0, 0.0),
            DVec3::new(0.0, 4.0, 0.0),
            DVec3::ZERO
        ]
    );
}

#[test]
fn points_that_make_no_line_are_refused() {
    let one = PointList::new(vec![DVec3::ZERO]);
    assert_eq!(one, Err(ReferenceError::TooFewPoints { found: 1 }));
    for bad in [f64::NAN, f64::INFINITY, 1e101] {
        let points = vec![DVec3::ZERO, DVec3::ONE, DVec3::new(0.0, 0.0, bad)];
        assert_eq!(
            PointList::new(points),
            Err(ReferenceError::BadPoint { index: 2 })
        );
    }
}

#[test]
fn a_log_aesthetic_curve_has_its_radius_of_curvature() {
    for alpha in [-2.0, -1.0, -1e-9, 0.0, 1e-9, 0.5, 1.0, 1.0 + 1e-9, 2.0] {
        let text = format!("log-aesthetic:alpha={alpha},lambda=0.3,from=-1,to=1");
        let curve = ReferenceCurve::from_text(&text).expect("a reference");
        for index in 0..=8 {
            let s = -1.0 + 0.25 * f64::from(index);
            let jet = curve.jet(0.5 * (s + 1.0) * curve.pieces() as f64);
            let radius = if alpha == 0.0 {
                (0.3 * s).exp()
            } else {
                ((0.3 * alpha * s).ln_1p() / alpha).exp()
            };
            let what = format!("{text} at {s}");
            assert_near(&what, jet.signed_curvature() * radius, 1.0, 1e-13, 1.0);
        }
    }
}

/// A spiral is put together of pieces that are kept: the order in which its points are asked for, and
/// what other spirals are evaluated between them, changes nothing.
#[test]
fn superspirals_do_not_depend_on_what_was_evaluated_before() {
    let curve = |text| ReferenceCurve::from_text(text).expect("a reference");
    let spiral = curve("superspiral:a=0.5,b=1,c=1.5");
    let other = curve("superspiral:a=1,b=1,c=2");
    let places = [40.0, -0.8, 0.0, 3.0, -0.1, 39.5, 0.5, 12.0];
    let alone: Vec<Vec<DVec3>> = places
        .iter()
        .map(|t| {
            other.derivatives(*t, 3);
            spiral.derivatives(*t, 3)
        })
        .collect();
    for (t, expected) in places.iter().zip(&alone) {
        assert_eq!(&spiral.derivatives(*t, 3), expected, "t = {t}");
    }
    for beyond in [-1.0, -28.0, 1e9, f64::NAN] {
        let found = spiral.derivatives(beyond, 1);
        assert!(found.iter().all(|value| value.is_nan()), "t = {beyond}");
    }
}
