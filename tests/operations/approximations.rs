//! Approximations of references and curves.

use batten::document::{Curve, Document};
use batten::geometry::references::ReferenceCurve;
use batten::geometry::{FloatPolygon, Progress};
use batten::operations::{Deviation, Input, OperationError, Outcome, Report, Value, find};
use serde_json::json;

use super::runner::Runner;

/// Run it on nothing but its parameters, as they are typed.
fn run(given: &[(&str, &str)]) -> Result<(Input, Outcome), OperationError> {
    let operation = find("approximate").expect("it is there");
    let input = Input::new(&Document::default(), [])?;
    let read = |(name, text): &(&'static str, &str)| {
        let mut parameters = operation.parameters.iter();
        let parameter = parameters.find(|parameter| parameter.name == *name);
        Ok::<_, OperationError>((*name, parameter.expect("a parameter").read(text)?))
    };
    let given: Vec<(&'static str, &str)> = given
        .iter()
        .map(|(name, text)| {
            let mut parameters = operation.parameters.iter();
            let parameter = parameters.find(|parameter| parameter.name == *name);
            (parameter.expect("a parameter").name, *text)
        })
        .collect();
    let given: Result<Vec<(&str, Value)>, OperationError> = given.iter().map(read).collect();
    let values = operation.values(&input, given?)?;
    let outcome = operation.run(&input, &values, &Progress::default())?;
    Ok((input, outcome))
}

fn curve(input: &Input, outcome: &Outcome) -> Curve {
    let after = outcome
        .applied_to(input.document())
        .expect("edits that can be made");
    let mut curves = after.curves();
    Curve::clone(curves.next().expect("a curve").1)
}

#[test]
fn a_reference_becomes_a_new_curve() {
    let given = [
        ("reference", "conical-spiral"),
        ("from", "0"),
        ("step", "1"),
        ("count", "20"),
    ];
    let (input, outcome) = run(&given).expect("it can run");
    assert!(outcome.reached);
    let curve = curve(&input, &outcome);
    assert_eq!(curve.name, "conical spiral");
    assert_eq!(
        (curve.polygon.degree(), curve.polygon.vertices().len()),
        (8, 20)
    );
    let Deviation::Measured(deviation) = outcome.deviation else {
        panic!("{:?}", outcome.deviation);
    };
    assert!(deviation > 0.001 && deviation <= 0.0012, "{deviation}");
    assert!(!outcome.marks.is_empty());
}

#[test]
fn the_report_compares_level_by_level() {
    let operation = find("approximate").expect("it is there");
    let given = [
        ("reference", "conical-spiral"),
        ("from", "0"),
        ("step", "1"),
        ("count", "20"),
    ];
    let (input, outcome) = run(&given).expect("it can run");
    let report = json!(Report::new(operation, &input, &outcome));
    let levels = report["equivalence"].as_array().expect("a list");
    let equal: Vec<bool> = levels
        .iter()
        .filter_map(|level| level["equal"].as_bool())
        .collect();
    assert_eq!(equal, [true, true, true, false]);
    assert_eq!(levels[3]["of"], "torsion");
    assert_eq!(levels[3]["level"], 2);
    assert!(levels[3]["first_difference"].is_u64());
    assert!(report["mean_deviation"].as_f64().expect("a number") > 0.0);
    assert_eq!(report["vertices"], 20);
    let summary = Report::new(operation, &input, &outcome).summary();
    assert!(
        summary.contains("another shape: torsion level 2 differs"),
        "{summary}"
    );
}

#[test]
fn a_tolerance_is_reached_or_said_to_be_missed() {
    let given = [
        ("reference", "clothoid:from=0,to=3"),
        ("tolerance", "1e-6"),
        ("fit-ends", "on"),
    ];
    let (input, outcome) = run(&given).expect("it can run");
    assert!(outcome.reached);
    assert!(matches!(outcome.deviation, Deviation::Measured(off) if off <= 1e-6));
    let polygon = curve(&input, &outcome).polygon;
    let clothoid = ReferenceCurve::from_text("clothoid:from=0,to=3").expect("a reference");
    let end = batten::geometry::Differentiable::derivatives(&clothoid, 3.0, 0)[0];
    assert!(polygon.point(polygon.segments() as f64).distance(end) < 1e-12);
    let given = [&given[..2], &[("count", "10")]].concat();
    let (_, outcome) = run(&given).expect("it can run");
    assert!(!outcome.reached && outcome.is_useful());
}

#[test]
fn a_curve_gets_another_degree_and_count() {
    let runner = Runner::example("s-curve");
    let given = [
        ("degree", Value::Whole(7)),
        ("count", Value::List(vec![60.0])),
    ];
    let (outcome, curves) = runner.done("approximate", &given);
    let polygon: &FloatPolygon = &curves[0].polygon;
    assert_eq!(
        (curves.len(), polygon.degree(), polygon.vertices().len()),
        (1, 7, 60)
    );
    let size = runner.polygon().size();
    assert!(matches!(outcome.deviation, Deviation::Measured(off) if off < 1e-4 * size));
    let ends = [0.0, 1.0].map(|share| {
        let [before, after] = [runner.polygon(), polygon]
            .map(|polygon| polygon.point(share * polygon.segments() as f64));
        before.distance(after)
    });
    assert!(ends.into_iter().all(|off| off < 1e-4 * size), "{ends:?}");
}

#[test]
fn what_cannot_be_is_refused() {
    let refused = |given: &[(&str, &str)], words: &str| {
        let error = run(given).expect_err("refused").to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(&[], "choose a curve, or give a reference");
    refused(&[("reference", "circle:radius=x")], "column 15");
    let step = [("reference", "circle"), ("step", "1")];
    refused(
        &[&step[..], &[("to", "3")]].concat(),
        "Step and To cannot both be given",
    );
    refused(
        &[&step[..], &[("tolerance", "3")]].concat(),
        "Step and Tolerance cannot",
    );
    refused(
        &[("reference", "circle"), ("tolerance", "0")],
        "Tolerance: 0 is out of range",
    );
    refused(
        &[("reference", "circle"), ("count", "3")],
        "3 vertices are too few",
    );
    refused(
        &[("reference", "circle"), ("from", "9")],
        "must be a positive number",
    );
    refused(
        &[
            ("reference", "formula:x=t;y=1/t;from=1;to=2"),
            ("from", "0"),
        ],
        "the curve has no point",
    );
    let periodic = Runner::example("periodic");
    let error = periodic
        .run("approximate", &[])
        .expect_err("refused")
        .to_string();
    assert!(error.contains("open it first"), "{error}");
}
