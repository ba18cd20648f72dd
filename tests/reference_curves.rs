//! Random curves of degrees 2 to 10, in the plane and in space, polynomial and rational, against
//! values computed with sixty digits.

mod common;

use batten::geometry::{Batch, ClampedPolygon, FloatPolygon, Jet, Sampler};
use common::{assert_near, assert_points_near, list, number, numbers, point, points, reference};
use serde_json::Value;

/// The accuracy asked for, relative to the value itself.
const RELATIVE: f64 = 1e-9;

/// The accuracy of points, in units of the largest coordinate: a few roundings.
const POINTS: f64 = 8.0 * f64::EPSILON;

/// The accuracy of curvature and torsion levels, relative to the value itself: rounding errs by
/// 1e-14, and one third level is 1e-4 of the terms that cancel in it.
const LEVELS: f64 = 1e-11;

struct Curve {
    value: Value,
    float: FloatPolygon,
}

fn weights(value: &Value) -> Option<Vec<f64>> {
    (!value.is_null()).then(|| numbers(value))
}

fn curves() -> Vec<Curve> {
    let all = reference("curves.json");
    let curves = list(&all["curves"]).iter().map(|value| {
        let degree = number(&value["degree"]) as usize;
        let vertices = points(&value["float"]);
        let float = FloatPolygon::new(degree, vertices, weights(&value["weights"]), false)
            .expect("a valid curve");
        let planar = number(&value["dimension"]) == 2.0;
        assert_eq!(float.is_planar(), planar);
        Curve {
            value: value.clone(),
            float,
        }
    });
    curves.collect()
}

fn check(what: &str, curve: &Curve, jet: &Jet, expected: &Value) {
    let scale = common::reach(curve.float.vertices());
    assert_points_near(what, jet.point, point(&expected["point"]), POINTS, scale);
    for (key, found) in [("d1", jet.first), ("d2", jet.second), ("d3", jet.third)] {
        let wanted = point(&expected[key]);
        let what = format!("{what}: {key}");
        assert_points_near(&what, found, wanted, RELATIVE, wanted.length());
    }
    let curvature = number(&expected["curvature"][0]);
    let found = if curve.float.is_planar() {
        jet.signed_curvature()
    } else {
        let torsion = number(&expected["torsion"][0]);
        let what = format!("{what}: torsion");
        assert_near(&what, jet.torsion(), torsion, RELATIVE, torsion.abs());
        jet.curvature()
    };
    let curvature_at = format!("{what}: curvature");
    assert_near(&curvature_at, found, curvature, RELATIVE, curvature.abs());
    let evolute = point(&expected["evolute"]);
    let found = jet.centre_of_curvature().expect("a centre of curvature");
    let what = format!("{what}: evolute");
    assert_points_near(&what, found, evolute, RELATIVE, evolute.length());
}

#[test]
fn points_derivatives_curvature_and_evolute_at_single_parameters() {
    for (index, curve) in curves().iter().enumerate() {
        for (u, expected) in numbers(&curve.value["u"])
            .into_iter()
            .zip(list(&curve.value["at_u"]))
        {
            let what = format!("curve {index} at {u}");
            check(&what, curve, &curve.float.jet(u), expected);
        }
    }
}

#[test]
fn curvature_and_torsion_levels() {
    for (index, curve) in curves().iter().enumerate() {
        for (u, expected) in numbers(&curve.value["u"])
            .into_iter()
            .zip(list(&curve.value["at_u"]))
        {
            let what = format!("curve {index} at {u}");
            let found = curve.float.curvature_levels(u, 1.0);
            assert_levels_near(&what, &found.curvature, &expected["curvature"]);
            assert_eq!(found.torsion.is_some(), !curve.float.is_planar());
            if let Some(torsion) = found.torsion {
                assert_levels_near(&what, &torsion, &expected["torsion"]);
            }
            let slope = number(&expected["curvature_per_arclength"]);
            assert_near(&what, found.curvature_slopes[0], slope, LEVELS, slope.abs());
        }
    }
}

#[track_caller]
fn assert_levels_near(what: &str, found: &[f64], expected: &Value) {
    let expected = numbers(expected);
    assert_eq!(expected.len(), 3);
    for (level, (found, expected)) in found.iter().zip(expected).enumerate() {
        let what = format!("{what}: level {}", level + 1);
        assert_near(&what, *found, expected, LEVELS, expected.abs());
    }
}

#[test]
fn the_same_in_batches() {
    let mut batch = Batch::default();
    for (index, curve) in curves().iter().enumerate() {
        let degree = curve.float.degree();
        for (u, expected) in numbers(&curve.value["u"])
            .into_iter()
            .zip(list(&curve.value["at_u"]))
        {
            let (segment, t) = curve.float.locate(u);
            // The parameter asked for stands behind others, in the second pass of the loops.
            let mut parameters = vec![0.25; 16];
            parameters.push(t);
            let sampler = Sampler::new(degree, &parameters);
            sampler.segment(&curve.float, segment, 3, &mut batch);
            let what = format!("curve {index} at {u}");
            check(&what, curve, &batch.jet(16), expected);
        }
    }
}

#[test]
fn closed_polygons_and_their_weights() {
    for (index, curve) in curves().iter().enumerate() {
        let scale = common::reach(curve.float.vertices());
        let clamped = ClampedPolygon::from_float(&curve.float);
        let expected = points(&curve.value["closed"]);
        assert_eq!(clamped.vertices().len(), expected.len());
        for (found, expected) in clamped.vertices().iter().zip(expected) {
            let what = format!("curve {index}: closed vertex");
            assert_points_near(&what, *found, expected, POINTS, scale);
        }
        let expected = weights(&curve.value["closed_weights"]);
        assert_eq!(clamped.weights().is_some(), expected.is_some());
        let pairs = clamped.weights().into_iter().flatten();
        for (found, expected) in pairs.zip(expected.into_iter().flatten()) {
            let what = format!("curve {index}: closed weight");
            assert_near(&what, *found, expected, POINTS, expected);
        }
    }
}
