//! SPLINE by control points and by fit points.

use glam::DVec3;

use super::{assert_near, drawing, entities, nurbs, remark};
use crate::io::exchange::drawing::{Drawing, Kind, Nurbs};

fn spline(text: &str) -> Drawing {
    drawing(&entities(&format!("0 SPLINE; 8 0; 71 3; {text}")))
}

fn list(code: i32, values: &[f64]) -> String {
    values
        .iter()
        .map(|value| format!("{code} {value:?};"))
        .collect()
}

fn control(xs: &[f64]) -> String {
    xs.iter()
        .map(|x| format!("10 {x:?}; 20 1; 30 2;"))
        .collect()
}

fn fit(points: &[(f64, f64)]) -> String {
    points
        .iter()
        .map(|(x, y)| format!("11 {x:?}; 21 {y:?};"))
        .collect()
}

#[test]
fn control_points_knots_and_weights_are_kept() {
    let knots = [0.0, 0.0, 0.0, 0.0, 0.1, 1.0, 1.0, 1.0, 1.0];
    let weights = [1.0, 0.3, 1.0, 1.0, 2.0];
    let xs = [0.1, 0.2, 0.3, 0.7, 1e-17];
    let lists = list(40, &knots) + &list(41, &weights) + &control(&xs);
    let drawing = spline(&format!("70 4; {lists}"));
    let expected = Nurbs {
        degree: 3,
        knots: knots.to_vec(),
        points: xs.iter().map(|x| DVec3::new(*x, 1.0, 2.0)).collect(),
        weights: Some(weights.to_vec()),
        periodic: false,
    };
    assert_eq!(*nurbs(&drawing), expected);
    assert_eq!(drawing.items[0].kind, Kind::Spline);
    assert_eq!(drawing.remarks, [""; 0]);
}

#[test]
fn weights_that_are_alike_are_none() {
    let knots = list(40, &[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
    let lists = knots + &list(41, &[2.0; 4]) + &control(&[0.0, 1.0, 2.0, 3.0]);
    let drawing = spline(&format!("70 2; {lists}"));
    assert_eq!(nurbs(&drawing).weights, None);
    assert!(nurbs(&drawing).periodic);
}

#[test]
fn the_knots_of_one_period_are_continued() {
    let lists = list(40, &[0.0, 1.0, 3.0, 4.0, 5.0]) + &control(&[0.0, 1.0, 2.0, 3.0]);
    let drawing = spline(&format!("70 3; {lists}"));
    let nurbs = nurbs(&drawing);
    assert_eq!(
        nurbs.knots,
        [-4.0, -2.0, -1.0, 0.0, 1.0, 3.0, 4.0, 5.0, 6.0, 8.0, 9.0]
    );
    let xs: Vec<_> = nurbs.points.iter().map(|point| point.x).collect();
    assert_eq!(xs, [0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0]);
    assert_eq!(drawing.remarks.len(), 1);
}

#[test]
fn missing_knots_are_uniform() {
    let drawing = spline(&control(&[0.0, 1.0, 2.0, 3.0, 4.0]));
    assert_eq!(
        nurbs(&drawing).knots,
        [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 2.0]
    );
    assert_eq!(
        drawing.remarks,
        ["line 6: SPLINE has no knots; clamped uniform ones are taken"]
    );
}

#[test]
fn numbers_that_make_no_spline_are_refused() {
    let cases = [
        (
            vec![0.0, 0.0, 1.0, 1.0],
            vec![],
            "4 control points of degree 3 take 8 knots, not 4",
        ),
        (
            vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.5, 1.0],
            vec![],
            "its knots fall",
        ),
        (vec![1.0; 8], vec![], "its knots leave no curve"),
        (
            vec![],
            vec![1.0, 2.0],
            "4 control points take as many weights, not 2",
        ),
        (
            vec![],
            vec![1.0, 2.0, -0.5, 1.0],
            "weight -0.5 is not above 0",
        ),
    ];
    for (knots, weights, expected) in cases {
        let lists = list(40, &knots) + &list(41, &weights) + &control(&[0.0, 1.0, 2.0, 3.0]);
        let remark = remark(&format!("0 SPLINE; 71 3; {lists}"));
        assert_eq!(remark, format!("line 6: SPLINE skipped: {expected}"));
    }
    let few = remark(&format!("0 SPLINE; 71 3; {}", control(&[0.0, 1.0, 2.0])));
    assert_eq!(
        few,
        "line 6: SPLINE skipped: degree 3 does not fit 3 control points"
    );
    let without = remark(&format!("0 SPLINE; {}", control(&[0.0, 1.0, 2.0])));
    assert_eq!(without, "line 6: SPLINE skipped: its degree is missing");
}

#[test]
fn two_fit_points_with_tangents_are_a_hermite_cubic() {
    let tangents = "12 0; 22 1; 32 0; 13 0; 23 -5; 33 0;";
    let drawing = spline(&format!(
        "70 0; {tangents} {}",
        fit(&[(0.0, 0.0), (3.0, 0.0)])
    ));
    let nurbs = nurbs(&drawing);
    assert_eq!(nurbs.knots, [0.0, 0.0, 0.0, 0.0, 3.0, 3.0, 3.0, 3.0]);
    let expected = [(0.0, 0.0), (0.0, 1.0), (3.0, 1.0), (3.0, 0.0)];
    for (point, (x, y)) in nurbs.points.iter().zip(expected) {
        assert_near(*point, x, y, 0.0);
    }
    assert_eq!(drawing.remarks, [""; 0]);
}

/// y = x³/50 - x/2 is a spline on any knots, but x has to be the chord length: so it lies on a line.
#[test]
fn fit_points_on_a_line_have_their_chords_as_knots() {
    let tangents = "12 1; 22 0; 32 0; 13 1; 23 0; 33 0;";
    let points = fit(&[(0.0, 0.0), (1.0, 0.0), (4.0, 0.0), (6.0, 0.0)]);
    let drawing = spline(&format!("{tangents} {points}"));
    let nurbs = nurbs(&drawing);
    assert_eq!(
        nurbs.knots,
        [0.0, 0.0, 0.0, 0.0, 1.0, 4.0, 6.0, 6.0, 6.0, 6.0]
    );
    let greville = [0.0, 1.0 / 3.0, 5.0 / 3.0, 11.0 / 3.0, 16.0 / 3.0, 6.0];
    for (point, x) in nurbs.points.iter().zip(greville) {
        assert_near(*point, x, 0.0, 0.0);
    }
}

#[test]
fn free_ends_have_no_curvature_and_a_remark() {
    let drawing = spline(&fit(&[(0.0, 0.0), (1.0, 1.0), (1.0, 1.0), (2.0, 0.0)]));
    let nurbs = nurbs(&drawing);
    let [first, second, third, ..] = nurbs.points.as_slice() else {
        panic!("{nurbs:?}");
    };
    // With equal chords the second difference on knots 0, 0, 0, 0, h, 2h vanishes.
    assert_near(*second * 3.0 - *first * 2.0 - *third, 0.0, 0.0, 0.0);
    let expected = [
        "line 6: SPLINE repeats 1 fit points, which are left out",
        "line 6: SPLINE by fit points is approximated: it has no end tangents",
    ];
    assert_eq!(drawing.remarks, expected);
}

#[test]
fn a_closed_curve_without_tangents_is_periodic() {
    let square = fit(&[(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]);
    let drawing = spline(&format!("70 1; {square}"));
    let nurbs = nurbs(&drawing);
    assert!(nurbs.periodic);
    assert_eq!((nurbs.points.len(), nurbs.knots.len()), (7, 11));
    // On uniform knots (P₀ + 4 P₁ + P₂)/6 is a fit point: by symmetry P = 3/2 of it.
    let expected = [
        (0.0, -1.5),
        (1.5, 0.0),
        (0.0, 1.5),
        (-1.5, 0.0),
        (0.0, -1.5),
        (1.5, 0.0),
        (0.0, 1.5),
    ];
    for (point, (x, y)) in nurbs.points.iter().zip(expected) {
        assert_near(*point, x, y, 0.0);
    }
}

#[test]
fn fit_points_that_make_no_curve_are_refused() {
    let remark = remark(&format!(
        "0 SPLINE; 71 3; {}",
        fit(&[(1.0, 1.0), (1.0, 1.0)])
    ));
    assert!(
        remark.ends_with("SPLINE skipped: its fit points make no curve"),
        "{remark}"
    );
}

#[test]
fn a_helix_is_its_spline() {
    let knots = list(40, &[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
    let lists = knots + &control(&[0.0, 1.0, 2.0, 3.0]);
    let axis = "100 AcDbHelix; 10 9; 20 9; 30 9; 40 2";
    let drawing = drawing(&entities(&format!(
        "0 HELIX; 100 AcDbSpline; 71 3; {lists} {axis}"
    )));
    assert_eq!(nurbs(&drawing).points.len(), 4);
}
