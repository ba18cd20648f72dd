//! Curves on Mineur–Farin configurations, their handles and their atlas.

use batten::document::Document;
use batten::geometry::Progress;
use batten::geometry::features::Verdict;
use batten::geometry::mineur_farin::Format;
use batten::operations::{
    Deviation, Operands, OperationError, Outcome, Report, Sets, Value, Values,
};
use glam::DVec3;

use crate::runner::operation;

const FLOAT: Value = Value::Choice(0);
const BEZIER: Value = Value::Choice(1);
const BOTH: Value = Value::Choice(2);

fn nothing() -> Operands {
    Operands::new(&Document::default(), []).expect("nothing is there")
}

fn values(given: &[(&str, Value)]) -> Values {
    let values = operation("mineur-farin").values(&nothing(), given.iter().cloned());
    values.expect("values in range")
}

fn run(given: &[(&str, Value)]) -> Result<Outcome, OperationError> {
    operation("mineur-farin").run(&nothing(), &values(given), &Progress::default())
}

/// The example of the paper's figure 2: five points.
fn figure_2(degree: usize, polygon: Value) -> Vec<(&'static str, Value)> {
    vec![
        ("legs", Value::Whole(4)),
        ("ratio", Value::Real(2.0)),
        ("angle", Value::Real(90.0_f64.to_radians())),
        ("degree", Value::Whole(degree)),
        ("polygon", polygon),
    ]
}

fn report(given: &[(&str, Value)]) -> Report {
    let outcome = run(given).expect("a curve");
    let operation = operation("mineur-farin");
    let report = Report::of(operation, &nothing(), &outcome, &Progress::default());
    report.expect("nobody cancels")
}

#[test]
fn both_curves_of_figure_2_lie_on_the_same_points() {
    let outcome = run(&figure_2(4, BOTH)).expect("two curves");
    let after = outcome
        .applied_to(&Document::default())
        .expect("a document");
    let curves: Vec<_> = after.curves().map(|(_, curve)| curve.clone()).collect();
    let [float, bezier] = &curves[..] else {
        panic!("{} curves", curves.len());
    };
    assert_eq!(
        (&*float.name, &*bezier.name),
        ("Mineur–Farin", "Mineur–Farin Bézier")
    );
    let points = [
        (0.0, 0.0),
        (1.0, 0.0),
        (1.0, 2.0),
        (-3.0, 2.0),
        (-3.0, -6.0),
    ];
    for (vertex, (x, y)) in float.polygon.vertices().iter().zip(points) {
        assert!(vertex.distance(DVec3::new(x, y, 0.0)) < 1e-14, "{vertex}");
    }
    // The ends of the Bézier curve are the first and the last point.
    for (u, (x, y)) in [(0.0, points[0]), (1.0, points[4])] {
        let end = bezier.polygon.point(u);
        assert!(end.distance(DVec3::new(x, y, 0.0)) < 1e-13, "{end}");
    }
    let report = report(&figure_2(4, BOTH));
    let features = report.features.as_ref().expect("features");
    assert!(features.before.is_empty());
    let verdicts: Vec<Verdict> = features
        .after
        .iter()
        .map(|counts| counts.monotone)
        .collect();
    assert_eq!(verdicts, [Verdict::Proved, Verdict::Disproved]);
    assert_eq!(report.figure("bezier_monotone"), Some(Value::Switch(false)));
    let Some(Value::Real(extremum)) = report.figure("bezier_extremum") else {
        panic!("{report:?}");
    };
    assert!((extremum - 0.2).abs() < 1e-15);
    assert!(matches!(report.deviation, Deviation::AtMost(most) if most < 1e-14));
}

#[test]
fn names_are_free_in_the_document() {
    let operation = operation("mineur-farin");
    let mut document = Document::default();
    let mut names = Vec::new();
    for _ in 0..2 {
        let input = Operands::new(&document, []).expect("nothing is chosen");
        let values = operation.values(&input, figure_2(4, BOTH)).expect("values");
        let outcome = operation.run(&input, &values, &Progress::default());
        document = outcome
            .expect("curves")
            .applied_to(&document)
            .expect("edits");
    }
    names.extend(document.curves().map(|(_, curve)| curve.name.clone()));
    let expected = [
        "Mineur–Farin",
        "Mineur–Farin Bézier",
        "Mineur–Farin 2",
        "Mineur–Farin Bézier 2",
    ];
    assert_eq!(names, expected);
}

#[test]
fn the_degree_of_a_bezier_polygon_is_its_number_of_legs() {
    let alike = run(&figure_2(4, BEZIER)).expect("a curve");
    assert!(alike.remarks.is_empty());
    let other = run(&figure_2(5, BEZIER)).expect("a curve");
    assert_eq!(other.remarks, ["A Bézier polygon of 4 legs has degree 4"]);
    let curves = |outcome: &Outcome| {
        let after = outcome
            .applied_to(&Document::default())
            .expect("a document");
        after
            .curves()
            .map(|(_, curve)| curve.polygon.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(curves(&alike), curves(&other));
    assert_eq!(curves(&alike)[0].degree(), 4);
}

#[test]
fn configurations_that_make_no_curve_are_refused() {
    let few = run(&figure_2(5, FLOAT)).expect_err("too few points");
    let expected = "5 vertices are too few: an open curve of degree 5 needs at least 6";
    assert_eq!(few.to_string(), expected);
    let mut still = figure_2(4, FLOAT);
    still.push(("first-leg", Value::List(vec![0.0, 0.0])));
    let still = run(&still).expect_err("no direction");
    let expected =
        "First leg: a vector of length 0 is out of range: a vector with a direction is needed";
    assert_eq!(still.to_string(), expected);
    let mut far = figure_2(4, FLOAT);
    far.push(("legs", Value::Whole(1000)));
    far.push(("ratio", Value::Real(10.0)));
    assert!(matches!(run(&far), Err(OperationError::Polygon(_))));
}

/// A handle set to where it is gives back the values it was made of, wherever the curve lies.
#[test]
fn handles_give_back_their_values() {
    for (leg, torsion) in [
        (vec![3.0, -1.0], 0.0),
        (vec![3.0, -1.0], 0.4),
        (vec![1.0, 2.0, -2.0], 0.7),
        (vec![0.0, 0.0, 2.0], -0.2),
    ] {
        for (ratio, angle) in [(2.0, 1.5), (0.7, -0.6), (1.0, 3.0)] {
            let given = [
                ("ratio", Value::Real(ratio)),
                ("angle", Value::Real(angle)),
                ("torsion", Value::Real(torsion)),
                ("start", Value::List(vec![5.0, 6.0])),
                ("first-leg", Value::List(leg.clone())),
            ];
            let outcome = run(&given).expect("a curve");
            assert_eq!(outcome.handles.len(), 4);
            for handle in &outcome.handles {
                for (name, value) in handle.values(handle.at) {
                    let (_, expected) = given
                        .iter()
                        .find(|(given, _)| *given == name)
                        .expect("given");
                    let numbers = |value: &Value| match value {
                        Value::Real(number) => vec![*number],
                        Value::List(numbers) => numbers.clone(),
                        other => panic!("{other:?}"),
                    };
                    let (found, expected) = (numbers(&value), numbers(expected));
                    assert_eq!(found.len(), expected.len(), "{name}");
                    for (found, expected) in found.iter().zip(expected) {
                        assert!(
                            (found - expected).abs() < 1e-13,
                            "{name}: {found} {expected}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn a_handle_sets_the_values_that_bring_its_point_where_it_is_dragged() {
    let mut given = figure_2(4, FLOAT);
    let outcome = run(&given).expect("a curve");
    let to = DVec3::new(0.25, -1.5, 0.0);
    for handle in outcome.handles.into_iter().rev() {
        for (name, value) in handle.values(to) {
            given.retain(|(other, _)| *other != name);
            given.push((name, value));
        }
        let index = match handle.sets {
            Sets::Point(_) => 0,
            Sets::Vector { .. } => 1,
            Sets::RatioAndAngle { .. } => 2,
            Sets::LastPoint { .. } => 3,
            other => panic!("{other:?}"),
        };
        // The leg that the handle belongs to ends there, and those before stay.
        if index == 1 {
            given.push(("start", Value::List(vec![0.0, 0.0])));
        }
        let moved = run(&given).expect("a curve").handles[index].at;
        // The last point is led there by steps that end at rounding.
        let allowed = if index == 3 { 1e-12 } else { 1e-14 };
        assert!(moved.distance(to) < allowed, "{index}: {moved}");
    }
}

#[test]
fn the_atlas_is_that_of_the_format_and_sets_angle_and_ratio() {
    for (polygon, format, bounded) in [
        (FLOAT, Format::Float { degree: 4 }, false),
        (BEZIER, Format::Bezier, true),
        (BOTH, Format::Float { degree: 4 }, true),
    ] {
        let given = figure_2(4, polygon);
        let atlas = run(&given).expect("a curve").atlas.expect("an atlas");
        assert_eq!(atlas.plane.format, format);
        assert_eq!(atlas.bound.is_some(), bounded);
        let place = atlas.place(&values(&given));
        assert!((place[0] - 0.5).abs() < 1e-15 && (place[1] - 0.75).abs() < 1e-15);
        let [(across, angle), (up, ratio)] = atlas.values(place);
        assert_eq!((across, up), ("angle", "ratio"));
        assert_eq!((angle, ratio), (given[2].1.clone(), given[1].1.clone()));
    }
    // A ratio that is far from 1 has its place, too.
    let far = [("ratio", Value::Real(40.0)), ("angle", Value::Real(-0.3))];
    let atlas = run(&far).expect("a curve").atlas.expect("an atlas");
    let place = atlas.place(&values(&far));
    assert!(
        place.iter().all(|share| (0.0..=1.0).contains(share)),
        "{place:?}"
    );
    let [(_, Value::Real(angle)), _] = atlas.values(place) else {
        panic!("{atlas:?}");
    };
    assert!((angle + 0.3).abs() < 1e-14);
}

#[test]
fn a_bezier_curve_whose_float_polygon_loses_digits_says_by_how_much() {
    let given = |legs| {
        vec![
            ("legs", Value::Whole(legs)),
            ("ratio", Value::Real(1.5)),
            ("angle", Value::Real(60.0_f64.to_radians())),
            ("polygon", BEZIER),
        ]
    };
    let told = |legs| {
        let report = report(&given(legs));
        // The panel and the command line show the same remarks, and the same deviation.
        let Deviation::AtMost(off) = report.deviation else {
            return (report.text(), 0.0);
        };
        (report.text(), off)
    };
    let (text, off) = told(20);
    let said = "At degree 20 doubles cannot hold the float S-polygon of the Bézier curve: the curve is off by up to ";
    assert!(text.contains(said), "{text}");
    assert!(off > 0.0 && off.is_finite(), "{off}");
    let (text, off) = told(5);
    assert!(!text.contains("doubles cannot hold"), "{text}");
    assert!(off < 1e-12, "{off}");
}
