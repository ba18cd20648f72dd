//! Vertices on curves and vertices by quasi-interpolation.

use batten::geometry::approximation::{ApproximationError, Placing, UniformKnots, float_polygon};
use batten::geometry::distance::MeasuredDeviation;
use batten::geometry::references::ReferenceCurve;
use batten::geometry::{Differentiable, FloatPolygon, PolygonError, Progress};
use glam::DVec3;

use crate::common::{assert_near, list, number, reference};

/// What is measured may err by this share of itself.
const MEASURED: f64 = 1e-3;

fn curve(text: &str) -> ReferenceCurve {
    ReferenceCurve::from_text(text).expect("a reference")
}

fn deviation(
    curve: &dyn Differentiable,
    knots: &UniformKnots,
    polygon: &FloatPolygon,
) -> MeasuredDeviation {
    let parameter = |u: f64| knots.curve_parameter(u);
    MeasuredDeviation::measure(
        polygon,
        curve,
        &parameter,
        knots.reach(),
        &Progress::default(),
    )
    .expect("a curve with points")
}

#[test]
fn deviations_agree_with_dense_evaluation_in_34_digits() {
    for case in list(&reference("approximations.json")["values"]) {
        let text = case["reference"].as_str().expect("a text");
        let curve = curve(text);
        let whole = |key: &str| number(&case[key]) as usize;
        let (degree, count) = (whole("degree"), whole("count"));
        let (first, step) = (number(&case["first"]), number(&case["step"]));
        let placing = match case["method"].as_str() {
            Some("quasi") => Placing::Quasi,
            _ => Placing::OnCurve,
        };
        let knots = UniformKnots::of_vertices(degree, first, step, count).expect("knots");
        let polygon = float_polygon(&curve, &knots, placing).expect("a polygon");
        let found = deviation(&curve, &knots, &polygon);
        let expected = number(&case["largest"]);
        let what = format!("{text}, degree {degree}, step {step}, {placing:?}");
        assert_near(&what, found.largest, expected, MEASURED, expected);
        assert!(found.mean > 0.0 && found.mean < found.largest);
    }
}

#[test]
fn the_paper_s_figure_3_lies_off_its_spiral() {
    let spiral = curve("conical-spiral");
    let off = |step: f64, count: usize, placing: Placing| {
        let knots = UniformKnots::of_vertices(8, 0.0, step, count).expect("knots");
        let polygon = float_polygon(&spiral, &knots, placing).expect("a polygon");
        assert_eq!((polygon.degree(), polygon.vertices().len()), (8, count));
        deviation(&spiral, &knots, &polygon).largest
    };
    let on_curve = off(1.0, 20, Placing::OnCurve);
    assert!((4.9..4.91).contains(&on_curve), "{on_curve}");
    let quasi = off(1.0, 20, Placing::Quasi);
    assert!(quasi <= 0.0012, "{quasi}");
    let fine = off(0.5, 39, Placing::Quasi);
    assert!(fine <= 1.7e-6, "{fine}");
}

#[test]
fn vertices_on_the_curve_are_its_points() {
    let spiral = curve("conical-spiral");
    let knots = UniformKnots::of_vertices(8, 0.0, 1.0, 20).expect("knots");
    let polygon = float_polygon(&spiral, &knots, Placing::OnCurve).expect("a polygon");
    for (index, vertex) in polygon.vertices().iter().enumerate() {
        let t = index as f64;
        assert_eq!(*vertex, DVec3::new(t * t.cos(), t * t.sin(), t));
    }
}

#[test]
fn the_error_of_quasi_interpolation_is_of_order_degree_plus_1() {
    let references = [
        "circle:from=0,to=3",
        "clothoid:from=0.25,to=2",
        "log-aesthetic:alpha=2,lambda=0.5,from=6,to=12",
        "log-aesthetic:alpha=0.5,lambda=0.25,from=4,to=9",
        "conical-spiral:from=1,to=5",
    ];
    let mut others = Vec::new();
    for text in references {
        let curve = curve(text);
        for degree in 3..=9 {
            let error = |segments: usize| {
                let knots = UniformKnots::between(degree, curve.interval(), degree + segments)
                    .expect("knots");
                let polygon = float_polygon(&curve, &knots, Placing::Quasi).expect("a polygon");
                deviation(&curve, &knots, &polygon).largest
            };
            // Coarse enough that rounding does not show, fine enough that the order does.
            let segments = match degree {
                ..5 => 16,
                5..8 => 10,
                _ => 9,
            };
            let [coarse, fine] = [segments, 2 * segments].map(error);
            let order = (coarse / fine).log2();
            // At even degrees the leading error of a curve that is nearly a circle lies along it.
            let orders = (degree as f64 + 0.5)..(degree as f64 + [2.5, 1.5][degree % 2]);
            if !orders.contains(&order) || fine < 1e-14 {
                others.push(format!(
                    "{text}, degree {degree}: order {order:.2}, {coarse:.2e} and {fine:.2e}"
                ));
            }
        }
    }
    assert!(others.is_empty(), "{others:#?}");
}

#[test]
fn polynomials_of_the_degree_are_reproduced() {
    let points = [(0.0, 0.0), (1.0, 2.0), (3.0, 1.0), (4.0, -1.0), (6.0, 0.5)];
    let given = FloatPolygon::planar(4, &points).expect("a curve");
    for (degree, count) in [(4, 5), (4, 9), (5, 6), (9, 25)] {
        let knots = UniformKnots::between(degree, [0.0, 1.0], count).expect("knots");
        let polygon = float_polygon(&given, &knots, Placing::Quasi).expect("a polygon");
        let found = deviation(&given, &knots, &polygon);
        assert!(found.largest <= 1e-13, "{degree} {count}: {found:?}");
        assert!(polygon.is_planar());
        if (degree, count) == (4, 5) {
            for (found, given) in polygon.vertices().iter().zip(given.vertices()) {
                assert!(found.distance(*given) <= 1e-13);
            }
        }
    }
}

#[test]
fn where_a_curve_ends_it_is_expanded_there() {
    // This clothoid ends at s = 2, where it is straight; the last vertices belong beyond.
    let curve = curve("log-aesthetic:alpha=-1,lambda=0.5,from=0,to=1.99");
    let knots = UniformKnots::between(7, curve.interval(), 24).expect("knots");
    assert!(knots.vertex_parameter(20) < 2.0 && knots.vertex_parameter(21) > 2.0);
    let polygon = float_polygon(&curve, &knots, Placing::Quasi).expect("a polygon");
    let found = deviation(&curve, &knots, &polygon);
    assert!(found.largest <= 1e-9, "{found:?}");
    let refused = float_polygon(&curve, &knots, Placing::OnCurve);
    assert!(
        matches!(
            refused,
            Err(ApproximationError::NotFinite { vertex: 21, .. })
        ),
        "{refused:?}"
    );
}

#[test]
fn knots_that_are_none_are_refused() {
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = UniformKnots::of_vertices(3, 0.0, step, 4);
        assert!(matches!(refused, Err(ApproximationError::BadStep { .. })));
    }
    assert_eq!(
        UniformKnots::between(26, [0.0, 1.0], 40),
        Err(PolygonError::DegreeOutOfRange { degree: 26 }.into())
    );
    let few = UniformKnots::between(5, [0.0, 1.0], 5);
    assert!(matches!(
        few,
        Err(ApproximationError::Polygon(
            PolygonError::TooFewVertices { .. }
        ))
    ));
}
