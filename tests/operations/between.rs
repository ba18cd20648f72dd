//! Segments between two ends: what is given, what chosen curves offer, and what is told.

use batten::document::{Curve, Document};
use batten::geometry::features::Verdict;
use batten::geometry::parameters::OutOfRange;
use batten::geometry::{End, FloatPolygon, Progress};
use batten::operations::{
    Annotation, Deviation, Operands, OperationError, Outcome, Report, Sets, Value,
};
use glam::{DVec2, DVec3};

use crate::runner::operation;

const ANY: Value = Value::Choice(2);

fn nothing() -> Operands {
    Operands::new(&Document::default(), []).expect("nothing is there")
}

/// Two points with directions, and nothing else.
fn ends(from: [f64; 4], to: [f64; 4]) -> Vec<(&'static str, Value)> {
    let list = |numbers: &[f64]| Value::List(numbers.to_vec());
    vec![
        ("from", list(&from[..2])),
        ("from-direction", list(&from[2..])),
        ("to", list(&to[..2])),
        ("to-direction", list(&to[2..])),
    ]
}

fn run(input: &Operands, given: &[(&str, Value)]) -> Result<Outcome, OperationError> {
    let operation = operation("between");
    let values = operation.values(input, given.iter().cloned())?;
    operation.run(input, &values, &Progress::default())
}

/// Where the arrow of an end begins.
fn point(outcome: &Outcome, end: usize) -> DVec3 {
    match outcome.annotations[end] {
        Annotation::Arrow { from, .. } => from,
        other => panic!("{other:?}"),
    }
}

/// The curve that is made.
fn made(input: &Operands, outcome: &Outcome) -> Curve {
    let after = outcome.applied_to(input.document()).expect("a document");
    let (_, curve) = after.curves().last().expect("a curve");
    Curve::clone(curve)
}

fn number(outcome: &Outcome, name: &str) -> Vec<f64> {
    let mut figures = outcome.figures.iter();
    match figures
        .find(|figure| figure.name == name)
        .map(|it| &it.value)
    {
        Some(Value::List(numbers)) => numbers.clone(),
        Some(Value::Real(number)) => vec![*number],
        other => panic!("{name}: {other:?}"),
    }
}

/// Check that an end of a curve has a point and a direction.
#[track_caller]
fn check_end(polygon: &FloatPolygon, end: End, point: DVec2, direction: DVec2) {
    let (jet, size) = (polygon.end_jet(end), polygon.size());
    assert!(
        jet.point.truncate().distance(point) <= 1e-12 * size,
        "{}",
        jet.point
    );
    let angle = jet.first.truncate().angle_to(direction);
    assert!(angle.abs() <= 1e-12, "{angle:e}");
}

#[test]
fn what_is_given_is_met_and_told() {
    let given = ends([1.0, 2.0, 0.0, 3.0], [11.0, 7.0, 2.0, -0.5]);
    let outcome = run(&nothing(), &given).expect("a segment");
    assert!(outcome.reached);
    let curve = made(&nothing(), &outcome);
    assert_eq!((&*curve.name, curve.polygon.degree()), ("segment 1", 5));
    check_end(&curve.polygon, End::Start, DVec2::new(1.0, 2.0), DVec2::Y);
    check_end(
        &curve.polygon,
        End::Finish,
        DVec2::new(11.0, 7.0),
        DVec2::new(4.0, -1.0),
    );
    let Deviation::Measured(deviation) = outcome.deviation else {
        panic!("{:?}", outcome.deviation);
    };
    let length = number(&outcome, "length")[0];
    assert!(deviation <= 1e-6 * length);
    assert_eq!(number(&outcome, "alpha"), [-1.0]);
    let curvatures = End::BOTH.map(|end| curve.polygon.end_jet(end).signed_curvature());
    assert_eq!(number(&outcome, "curvatures"), curvatures);
    let report = Report::of(
        operation("between"),
        &nothing(),
        &outcome,
        &Progress::default(),
    );
    let features = report.expect("nobody cancels").features.expect("features");
    assert_eq!(features.after[0].monotone, Verdict::Proved);
}

#[test]
fn a_tolerance_that_is_given_counts() {
    let mut given = ends([0.0, 0.0, 1.0, 1.0], [10.0, 0.0, 2.0, -1.0]);
    let mut segments = Vec::new();
    for tolerance in [1e-2, 1e-5, 1e-9] {
        given.push(("tolerance", Value::List(vec![tolerance])));
        let outcome = run(&nothing(), &given).expect("a segment");
        assert!(outcome.reached);
        assert!(matches!(outcome.deviation, Deviation::Measured(it) if it <= tolerance));
        segments.push(made(&nothing(), &outcome).polygon.segments());
    }
    assert!(
        segments.is_sorted() && segments[0] < segments[2],
        "{segments:?}"
    );
    given.push(("tolerance", Value::List(vec![0.0])));
    let refused = run(&nothing(), &given).expect_err("no tolerance");
    assert!(matches!(
        refused,
        OperationError::OutOfRange(OutOfRange {
            label: "Tolerance",
            ..
        })
    ));
}

#[test]
fn where_there_is_none_the_limits_are_told_and_nothing_is_made() {
    let mut given = ends([0.0, 0.0, 1.0, 6.0], [10.0, 0.0, 6.0, -1.0]);
    given.push(("alpha", Value::List(vec![2.0])));
    let outcome = run(&nothing(), &given).expect("an answer");
    assert!(!outcome.reached && outcome.edits.is_empty());
    let [remark] = &outcome.remarks[..] else {
        panic!("{:?}", outcome.remarks);
    };
    assert!(remark.starts_with("There is no segment of a log-aesthetic curve with α = 2 here"));
    assert!(remark.contains("80.54°"), "{remark}");
    given.push(("kind", ANY));
    let outcome = run(&nothing(), &given).expect("a segment");
    assert!(outcome.reached, "{:?}", outcome.remarks);
}

#[test]
fn a_search_for_any_curve_ends_in_time_with_the_best_so_far() {
    let mut given = ends(
        [
            -676686.0771898838,
            -584254.9577265265,
            0.002468966244952032,
            0.014055409997627883,
        ],
        [
            191771.59821489485,
            -1164465.7114317538,
            -0.003403583925860599,
            0.0008233938633449265,
        ],
    );
    given.push(("kind", ANY));
    given.push(("degree", Value::Whole(25)));
    given.push(("from-curvature", Value::List(vec![-1.9981802471017786e-07])));
    given.push(("time-limit", Value::List(vec![1e-6])));
    let outcome = run(&nothing(), &given).expect("an answer");
    let remarks = outcome.remarks.join("\n");
    assert!(!outcome.reached);
    assert!(
        remarks.contains("The time limit of 1e-6 s ended the search"),
        "{remarks}"
    );
}

#[test]
fn an_arc_counts_as_reached_though_it_is_not_monotone() {
    let mut given = ends([0.0, 0.0, 1.0, 1.0], [10.0, 0.0, 1.0, -1.0]);
    given.push(("kind", ANY));
    let outcome = run(&nothing(), &given).expect("an arc");
    assert!(outcome.reached);
    let remarks = outcome.remarks.join("\n");
    assert!(
        remarks.contains("An arc need not be monotone to count as reached"),
        "{remarks}"
    );
}

#[test]
fn the_curvature_of_one_end_chooses_alpha() {
    let mut given = ends([0.0, 0.0, 1.0, 1.0], [10.0, 0.0, 3.0, -2.0]);
    given.push(("alpha", Value::List(vec![0.75])));
    let first = run(&nothing(), &given).expect("a segment");
    let curvature = number(&first, "curvatures")[0];
    given.push(("alpha", Value::List(Vec::new())));
    given.push(("from-curvature", Value::List(vec![curvature])));
    let outcome = run(&nothing(), &given).expect("a segment");
    assert!(outcome.reached, "{:?}", outcome.remarks);
    // The polygon's curvature, not the true segment's, was asked for.
    assert!((number(&outcome, "alpha")[0] - 0.75).abs() <= 1e-2);
    assert!((number(&outcome, "curvatures")[0] / curvature - 1.0).abs() <= 1e-9);
}

#[test]
fn ends_that_are_none_are_refused() {
    let refused = run(
        &nothing(),
        &ends([1.0, 1.0, 1.0, 0.0], [1.0, 1.0, 0.0, 1.0]),
    );
    let refused = refused.expect_err("one point").to_string();
    assert_eq!(refused, "both ends are at the same point: move one of them");
    let refused = run(
        &nothing(),
        &ends([1.0, 1.0, 0.0, 0.0], [2.0, 1.0, 0.0, 1.0]),
    );
    let refused = refused.expect_err("no direction").to_string();
    assert_eq!(
        refused,
        "an end has a direction of length 0: give it a direction"
    );
}

#[test]
fn remarks_name_what_is_missed_and_straight_ends() {
    let mut given = ends([0.0, 0.0, 1.0, 1.0], [10.0, 0.0, 2.0, -1.0]);
    given.push(("tolerance", Value::List(vec![1e-30])));
    let outcome = run(&nothing(), &given).expect("an answer");
    assert!(!outcome.reached);
    let remarks = outcome.remarks.join("\n");
    assert!(remarks.contains("off the true segment"), "{remarks}");
    assert!(!remarks.contains("not monotone"), "{remarks}");
    let straight = ends([0.0, 0.0, 5.0, 3.0], [5.0, 3.0, 5.0, 3.0]);
    let outcome = run(&nothing(), &straight).expect("a line");
    let [remark] = &outcome.remarks[..] else {
        panic!("{:?}", outcome.remarks);
    };
    assert!(remark.starts_with("The ends lie on a straight line"));
}

#[test]
fn handles_give_points_and_directions_back() {
    let given = ends([1.0, 2.0, 0.0, 3.0], [11.0, 7.0, 2.0, -0.5]);
    let outcome = run(&nothing(), &given).expect("a segment");
    let at = [(1.0, 2.0), (1.0, 5.0), (11.0, 7.0), (13.0, 6.5)];
    let names = ["from", "from-direction", "to", "to-direction"];
    for ((handle, (x, y)), name) in outcome.handles.iter().zip(at).zip(names) {
        assert_eq!(handle.at, DVec3::new(x, y, 0.0));
        let named = match handle.sets {
            Sets::Point(parameter) | Sets::Vector { parameter, .. } => parameter,
            other => panic!("{other:?}"),
        };
        assert_eq!(named, name);
        let back = handle.values(handle.at);
        let expected = given.iter().find(|(given, _)| *given == name).cloned();
        assert_eq!(back.first(), expected.as_ref());
    }
    assert_eq!(outcome.handles.len(), 4);
}

/// An open curve in the plane with ends that bend.
fn curve(name: &str, points: &[[f64; 2]]) -> Curve {
    let vertices = points.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0));
    let polygon = FloatPolygon::new(3, vertices.collect(), None, false);
    Curve::new(name, polygon.expect("a polygon"))
}

fn two_curves() -> (Curve, Curve) {
    let first = curve(
        "first",
        &[[0.0, 0.0], [2.0, 0.5], [4.0, 1.5], [5.0, 3.0], [5.5, 5.0]],
    );
    let second = curve(
        "second",
        &[
            [14.0, 20.0],
            [12.0, 19.5],
            [10.0, 18.0],
            [8.5, 16.0],
            [7.5, 13.5],
        ],
    );
    (first, second)
}

#[test]
fn two_curves_offer_their_nearest_ends() {
    let (first, second) = two_curves();
    let document = Document::from_curves(vec![first.clone(), second.clone()]);
    let input = Operands::new(&document, document.ids()).expect("both are there");
    let outcome = run(&input, &[("kind", ANY)]).expect("a segment");
    let polygon = made(&input, &outcome).polygon;
    let (leaves, arrives) = (
        first.polygon.end_jet(End::Finish),
        second.polygon.end_jet(End::Finish),
    );
    check_end(
        &polygon,
        End::Start,
        leaves.point.truncate(),
        leaves.first.truncate(),
    );
    check_end(
        &polygon,
        End::Finish,
        arrives.point.truncate(),
        -arrives.first.truncate(),
    );
    // With their curvatures, too: passed through backwards the second curve's changes its sign.
    let switch = ("curvatures", Value::Switch(true));
    let outcome = run(&input, &[("kind", ANY), switch]).expect("a segment");
    let polygon = made(&input, &outcome).polygon;
    let found = End::BOTH.map(|end| polygon.end_jet(end).signed_curvature());
    let expected = [leaves.signed_curvature(), -arrives.signed_curvature()];
    for (found, expected) in found.into_iter().zip(expected) {
        assert!(
            (found - expected).abs() <= 1e-9 * expected.abs(),
            "{found} {expected}"
        );
    }
    // What is given counts more.
    let outcome = run(&input, &[("to", Value::List(vec![3.0, 30.0]))]).expect("a segment");
    assert_eq!(point(&outcome, 1), DVec3::new(3.0, 30.0, 0.0));
}

#[test]
fn a_segment_goes_on_from_one_curve_and_curves_without_ends_offer_none() {
    let (first, _) = two_curves();
    let document = Document::from_curves(vec![first.clone()]);
    let input = Operands::new(&document, document.ids()).expect("it is there");
    let outcome = run(&input, &[]).expect("an answer");
    let end = first.polygon.end_jet(End::Finish);
    assert_eq!(point(&outcome, 0), end.point);
    assert!(outcome.reached);
    let start = made(&input, &outcome).polygon.end_jet(End::Start);
    assert!(start.first.angle_between(end.first) < 1e-6);
    let sides = [start, end].map(|jet| jet.signed_curvature().signum());
    assert_eq!(sides[0], sides[1]);
    let points = (0..8).map(|index| DVec3::from((DVec2::from_angle(f64::from(index)), 0.0)));
    let polygon = FloatPolygon::new(3, points.collect(), None, true).expect("a polygon");
    let document = Document::from_curves(vec![Curve::new("ring", polygon)]);
    let input = Operands::new(&document, document.ids()).expect("it is there");
    let outcome = run(&input, &[]).expect("a segment");
    assert!(outcome.reached);
    assert_eq!(point(&outcome, 0), DVec3::ZERO);
}
