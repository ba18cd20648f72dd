//! The figures and tables of the paper, recomputed and compared with their exact values.

mod common;

use batten::geometry::paper::{
    CircleComparison, RoundingTest, Shortening, evolute_reach, regular_polygon,
};
use batten::geometry::polygon_figures::turning_angle;
use batten::geometry::{BezierPolygon, ClampedPolygon, FloatPolygon};
use common::{
    assert_near, assert_points_near, list, number, numbers, point, points, reach, reference,
};

/// What the reference values, printed with 16 digits, allow.
const EXACT: f64 = 1e-9;

/// The degrees for which `circle_comparison.json` has values.
const DEGREES: std::ops::RangeInclusive<usize> = 2..=15;

/// The evolute of the ninth-degree arc lies within 6e-8 of the centre of a circle of radius 10:
/// rounding alone takes a few millionths of that.
const NINTH_DEGREE: f64 = 1e-5;

/// The rounding test amplifies by millions what a double cannot hold.
const AMPLIFIED: f64 = 1e-6;

/// Roundings that a chain of interpolations may leave, in units of the largest coordinate.
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

#[test]
fn table_1_is_recomputed() {
    let paper = reference("paper.json");
    let table = CircleComparison::paper_table().expect("the paper's own figures are valid");
    assert_eq!(table.len(), list(&paper["table1"]).len());
    for (row, expected) in table.iter().zip(list(&paper["table1"])) {
        assert_eq!(row.degree as f64, number(&expected["degree"]));
        let bspline = number(&expected["bspline"]);
        assert_near("B-spline", row.bspline, bspline, EXACT, bspline);
        let bezier = number(&expected["bezier"]);
        assert_near("Bézier", row.bezier, bezier, EXACT, bezier);
    }
}

#[test]
fn both_ways_to_a_circle_are_compared_for_degrees_2_to_15() {
    let rows = reference("circle_comparison.json");
    let rows = list(&rows["rows"]);
    assert_eq!(rows.len(), 2 * DEGREES.count());
    for expected in rows {
        let [degree, sides] = ["degree", "sides"].map(|key| number(&expected[key]) as usize);
        let found = CircleComparison::new(degree, sides, 10.0).expect("a valid arc");
        for (key, found) in [("bspline", found.bspline), ("bezier", found.bezier)] {
            let expected = number(&expected[key]);
            let what = format!("{key} of degree {degree} on {sides} sides");
            assert_near(&what, found, expected, EXACT, expected);
        }
    }
}

#[test]
fn digits_are_cut_off_as_in_the_paper() {
    let rounding = &reference("paper.json")["rounding"];
    let test = RoundingTest::new(3, Shortening::CutOff).expect("a valid arc");
    assert_eq!(test.after, point(&rounding["by"]));
    let far = number(&rounding["evolute_far"]);
    assert_near("evolute", test.evolute_reach, far, AMPLIFIED, far);
    // With one digit more the error is about a tenth: what is cut off is multiplied, no more.
    let nearest = RoundingTest::new(3, Shortening::Rounded).expect("a valid arc");
    assert!(nearest.before.distance(nearest.after) < test.before.distance(test.after));
    assert!(nearest.evolute_reach < test.evolute_reach && nearest.moved < test.moved);
    let all = RoundingTest::new(17, Shortening::CutOff).expect("a valid arc");
    assert_eq!((all.after, all.moved), (all.before, 0.0));
}

#[test]
fn the_segments_of_table_1_begin_on_the_circle_that_belongs_to_them() {
    for row in list(&reference("paper.json")["table1"]) {
        let [degree, sides] = ["degree", "sides"].map(|key| number(&row[key]) as usize);
        let arc = regular_polygon(degree, sides, number(&row["radius"])).expect("a valid arc");
        let radius = number(&row["end_radius"]);
        for u in [0.0, 1.0] {
            assert_near("radius", arc.point(u).length(), radius, ROUNDINGS, radius);
        }
    }
}

#[test]
fn figure_1_shows_the_closed_polygon_of_the_ninth_degree_arc() {
    let figure = &reference("paper.json")["figure1"];
    let degree = number(&figure["degree"]) as usize;
    let vertices = points(&figure["float"]);
    let scale = reach(&vertices);
    let float = FloatPolygon::new(degree, vertices, None, false).expect("a valid arc");
    let clamped = ClampedPolygon::from_float(&float);
    let expected = points(&figure["closed"]);
    assert_eq!(clamped.vertices().len(), expected.len());
    for (found, expected) in clamped.vertices().iter().zip(expected) {
        assert_points_near("closed vertex", *found, expected, ROUNDINGS, scale);
    }
    let legs = numbers(&figure["closed_legs"]);
    for (leg, expected) in clamped.vertices().windows(2).zip(legs) {
        assert_near("leg", leg[0].distance(leg[1]), expected, EXACT, expected);
    }
    let angles = numbers(&figure["closed_turning_angles"]);
    for (corner, expected) in clamped.vertices().windows(3).zip(angles) {
        let found = turning_angle(corner[0], corner[1], corner[2], true);
        assert_near("turning angle", found, expected, EXACT, expected.abs());
    }
    let far = number(&figure["evolute_far"]);
    assert_near("evolute", evolute_reach(&float), far, NINTH_DEGREE, far);
}

#[test]
fn rounding_one_closed_vertex_moves_the_float_vertices_by_hundreds() {
    let paper = reference("paper.json");
    let (figure, rounding) = (&paper["figure1"], &paper["rounding"]);
    let mut closed = points(&figure["closed"]);
    closed[number(&rounding["replaced_closed_vertex"]) as usize] = point(&rounding["by"]);
    let clamped = ClampedPolygon::new(9, closed, None).expect("a valid polygon");
    let float = clamped.to_float().expect("a float polygon");
    let expected = points(&rounding["float"]);
    let scale = reach(&expected);
    for (found, expected) in float.vertices().iter().zip(expected) {
        assert_points_near("float vertex", *found, expected, AMPLIFIED, scale);
    }
    let far = number(&rounding["evolute_far"]);
    assert_near("evolute", evolute_reach(&float), far, AMPLIFIED, far);
}

#[test]
fn figure_2_compares_the_curvature_of_one_polygon_taken_both_ways() {
    for figure in list(&reference("paper.json")["figure2"]) {
        let degree = number(&figure["degree"]) as usize;
        let polygon = points(&figure["polygon"]);
        let bspline = FloatPolygon::new(degree, polygon.clone(), None, false).expect("valid");
        let bezier = BezierPolygon::new(degree, polygon, None).expect("valid");
        let bezier = bezier.to_float().expect("a float polygon");
        for (key, curve) in [("bspline_curvature", bspline), ("bezier_curvature", bezier)] {
            let at = numbers(&figure["u"]);
            for (u, expected) in at.into_iter().zip(numbers(&figure[key])) {
                let found = curve.jet(u).signed_curvature();
                assert_near(key, found, expected, EXACT, expected);
            }
        }
    }
}

#[test]
fn figure_3_puts_the_vertices_of_a_degree_8_curve_on_a_conical_spiral() {
    let figure = &reference("paper.json")["figure3_conical_spiral"];
    let degree = number(&figure["degree"]) as usize;
    let vertices = points(&figure["vertices"]);
    let scale = reach(&vertices);
    let curve = FloatPolygon::new(degree, vertices, None, false).expect("a valid curve");
    for (u, expected) in numbers(&figure["u"])
        .into_iter()
        .zip(list(&figure["curve_at_u"]))
    {
        let jet = curve.jet(u);
        let found = [jet.point, jet.first, jet.second, jet.third];
        for (key, found) in ["point", "d1", "d2", "d3"].into_iter().zip(found) {
            let expected = point(&expected[key]);
            assert_points_near(key, found, expected, ROUNDINGS, scale);
        }
    }
}
