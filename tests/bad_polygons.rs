//! Polygons that are none: every reason with its message, and nothing changed.

use batten::geometry::{BezierPolygon, ClampedPolygon, FloatPolygon, MAX_DEGREE, PolygonError};
use glam::DVec3;

fn line(count: usize) -> Vec<DVec3> {
    (0..count).map(|i| DVec3::new(i as f64, 0.0, 0.0)).collect()
}

fn with(count: usize, index: usize, vertex: DVec3) -> Vec<DVec3> {
    let mut vertices = line(count);
    vertices[index] = vertex;
    vertices
}

#[track_caller]
fn check<T>(input: Result<T, PolygonError>, expected: &str) {
    match input {
        Ok(_) => panic!("this was taken: {expected}"),
        Err(error) => assert_eq!(error.to_string(), expected),
    }
}

#[track_caller]
fn check_float(degree: usize, vertices: Vec<DVec3>, weights: Option<Vec<f64>>, expected: &str) {
    let clamped = ClampedPolygon::new(degree, vertices.clone(), weights.clone());
    check(clamped, expected);
    check(
        FloatPolygon::new(degree, vertices, weights, false),
        expected,
    );
}

#[test]
fn degrees() {
    for degree in [0, 26, usize::MAX] {
        let expected = format!("degree {degree} is out of range: a degree from 1 to 25 is needed");
        check_float(degree, line(30), None, &expected);
        check(BezierPolygon::new(degree, line(30), None), &expected);
    }
    for degree in 1..=MAX_DEGREE {
        assert!(FloatPolygon::new(degree, line(degree + 1), None, false).is_ok());
    }
}

#[test]
fn too_few_vertices() {
    let expected = "3 vertices are too few: an open curve of degree 3 needs at least 4";
    check_float(3, line(3), None, expected);
    check(BezierPolygon::new(3, line(3), None), expected);
    let expected = "0 vertices are too few: an open curve of degree 1 needs at least 2";
    check_float(1, line(0), None, expected);
    let expected = "3 vertices are too few: a periodic curve of degree 3 needs at least 4";
    check(FloatPolygon::new(3, line(3), None, true), expected);
}

#[test]
fn coordinates() {
    for (vertex, axis, value) in [
        (DVec3::new(f64::NAN, 0.0, 0.0), 'x', "NaN"),
        (DVec3::new(0.0, f64::INFINITY, 0.0), 'y', "inf"),
        (DVec3::new(0.0, 0.0, f64::NEG_INFINITY), 'z', "-inf"),
        (DVec3::new(0.0, 2e100, 0.0), 'y', "2e100"),
    ] {
        let expected = format!(
            "vertex 2: coordinate {axis} is {value}, and only finite numbers up to 1e100 can be \
             used"
        );
        check_float(3, with(5, 2, vertex), None, &expected);
        check(BezierPolygon::new(2, with(5, 2, vertex), None), &expected);
        let mut polygon = FloatPolygon::new(3, line(5), None, false).expect("valid");
        let before = polygon.clone();
        check(
            polygon.move_vertices([(1, DVec3::ONE), (2, vertex)]),
            &expected,
        );
        assert_eq!(polygon, before);
    }
}

#[test]
fn weights() {
    for (weight, value) in [
        (0.0, "0.0"),
        (-1.0, "-1.0"),
        (f64::NAN, "NaN"),
        (f64::INFINITY, "inf"),
        (1e-101, "1e-101"),
    ] {
        let expected = format!(
            "vertex 1: weight {value} cannot be used: weights are positive numbers from 1e-100 to \
             1e100"
        );
        let weights = vec![1.0, weight, 1.0, 1.0];
        check_float(3, line(4), Some(weights.clone()), &expected);
        check(BezierPolygon::new(3, line(4), Some(weights)), &expected);
        let mut polygon = FloatPolygon::new(3, line(4), None, false).expect("valid");
        let before = polygon.clone();
        check(polygon.set_weight(1, weight), &expected);
        assert_eq!(polygon, before);
    }
    let expected = "3 weights for 4 vertices: give one weight a vertex, or none at all";
    check_float(3, line(4), Some(vec![1.0; 3]), expected);
}

#[test]
fn vertices_that_do_not_exist() {
    let mut polygon = FloatPolygon::new(3, line(4), None, false).expect("valid");
    let before = polygon.clone();
    let expected = "vertex 4 does not exist: the polygon has 4 vertices, counted from 0";
    check(polygon.move_vertices([(4, DVec3::ZERO)]), expected);
    check(polygon.set_weight(4, 1.0), expected);
    assert_eq!(polygon, before);
}

#[test]
fn bezier_chains() {
    check(
        BezierPolygon::new(3, line(6), None),
        "6 vertices do not make Bézier polygons of degree 3: the number must be a multiple of 3, \
         plus 1",
    );
    let kinked = with(7, 2, DVec3::new(2.0, 1.0, 0.0));
    let chain = BezierPolygon::new(3, kinked, None).expect("valid");
    let message = match chain.to_float() {
        Err(error @ PolygonError::NotSmooth { .. }) => error.to_string(),
        other => panic!("a kink was not noticed: {other:?}"),
    };
    assert!(
        message.starts_with("the Bézier polygons do not join as one B-spline curve: at vertex")
    );
    assert!(message.ends_with("import the segments one by one"));
}

#[test]
fn conversions_that_have_no_result() {
    // Extrapolating the weights 1, 10, 1 gives negative ones.
    let weights = Some(vec![1.0, 10.0, 1.0]);
    let clamped = ClampedPolygon::new(2, line(3), weights).expect("valid");
    check(
        clamped.to_float(),
        "the float polygon would have weight -8e0 at vertex 0: a curve with these weights has no \
         float polygon with positive weights",
    );
    let mut vertices = line(3);
    vertices[0].x = 1e100;
    vertices[1].x = -1e100;
    let clamped = ClampedPolygon::new(2, vertices, None).expect("valid");
    check(
        clamped.to_float(),
        "the float polygon would have vertex 0 outside the range of numbers",
    );
}
