//! What is reported of an operation.

use batten::geometry::features::Verdict;
use batten::geometry::harmony::Match;
use batten::geometry::{End, Progress};
use batten::operations::{FeatureComparison, OperationError, Report, Value};
use serde_json::json;

use crate::runner::{Runner, beside, operation};

#[test]
fn features_are_proved_before_and_afterwards_for_every_curve_concerned() {
    let hull = Runner::example("hull").curve().clone();
    let mut curves = vec![Runner::example("s-curve").curve().clone(), hull];
    curves[0].name = "S".to_owned();
    let runner = Runner::curves(curves);
    let report = runner.report("split", &[("at", Value::Real(1.0))]);
    let features = report.features.as_ref().expect("proved");
    let told = |counts: &[batten::operations::FeatureCounts]| -> Vec<(String, usize, usize)> {
        let told = counts.iter();
        told.map(|c| (c.name.clone(), c.curvature_extrema, c.inflections))
            .collect()
    };
    assert_eq!(told(&features.before), [("S".to_owned(), 2, 1)]);
    assert_eq!(
        told(&features.after),
        [("S".to_owned(), 1, 0), ("S 2".to_owned(), 1, 1)]
    );
    assert_eq!(features.after[0].monotone, Verdict::Disproved);
    assert_eq!(
        report.summary(),
        "Split curve: exact; curvature extrema: 2 before, 1 and 1 now"
    );
}

#[test]
fn figures_are_there_at_once_and_features_can_be_cancelled() {
    let runner = Runner::example("arc");
    let outcome = runner.run("round", &[]).expect("it can run");
    let round = operation("round");
    let report = Report::new(round, &runner.input, &outcome);
    assert_eq!(report.features, None);
    assert!(
        !report.summary().contains("extrema"),
        "{}",
        report.summary()
    );
    let progress = Progress::default();
    let features = FeatureComparison::prove(&runner.input, &outcome, &progress);
    assert_eq!(progress.done(), 1.0);
    assert!(features.is_some());
    let whole = Report::of(round, &runner.input, &outcome, &progress);
    assert_eq!(whole, Some(Report { features, ..report }));
    progress.cancel();
    assert_eq!(
        FeatureComparison::prove(&runner.input, &outcome, &progress),
        None
    );
    assert_eq!(Report::of(round, &runner.input, &outcome, &progress), None);
    let values = round.values(&runner.input, []).expect("defaults");
    assert_eq!(
        round.run(&runner.input, &values, &progress),
        Err(OperationError::Cancelled)
    );
}

#[test]
fn the_largest_move_is_told_where_vertices_have_counterparts() {
    let runner = Runner::example("hull");
    let target = beside(runner.polygon(), End::Finish, 0.02, 0.1);
    let runner = runner.with_target(End::Finish, target);
    let report = runner.report("translate-end", &[]);
    let largest = report.largest_move.expect("the same vertices");
    let expected = 0.02 * runner.polygon().size();
    assert!((largest.distance / expected - 1.0).abs() <= 1e-12);
    let terminal = runner.polygon().terminal_vertices(End::Finish);
    assert!(terminal.contains(&largest.vertex), "{largest:?}");
    for operation in [
        "reverse",
        "subdivide",
        "extend",
        "split",
        "trim",
        "elevate-degree",
        "refine",
    ] {
        assert_eq!(
            runner.report(operation, &[]).largest_move,
            None,
            "{operation}"
        );
    }
    // On a periodic curve a degree gives as many vertices, but other ones.
    let periodic = Runner::example("periodic");
    assert_eq!(periodic.report("elevate-degree", &[]).largest_move, None);
}

#[test]
fn all_reports_have_one_schema() {
    let runner = Runner::example("s-curve");
    let report = runner.report("round", &[("digits", Value::Whole(0))]);
    let found = serde_json::to_value(&report).expect("JSON");
    let counts = |side: &str, extrema: usize| {
        json!([{
            "harmony": found[side][0]["harmony"],
            "name": "s-curve",
            "inflections": 1,
            "curvature_extrema": extrema,
            "torsion_zeros": 0,
            "torsion_extrema": 0,
            "cusps": 0,
            "undecided": 0,
            "largest_curvature": found[side][0]["largest_curvature"],
            "monotone": "disproved",
        }])
    };
    // The radius at the two maxima, to six digits.
    let largest = found["features_before"][0]["largest_curvature"].as_f64();
    assert!(
        largest.is_some_and(|largest| (1.0 / largest - 42.1634).abs() < 1e-4),
        "{largest:?}"
    );
    let extrema = found["features_after"][0]["curvature_extrema"].as_u64();
    let extrema = extrema.expect("a count") as usize;
    assert!(
        found["deviation"]
            .as_f64()
            .is_some_and(|bound| bound > 0.0 && bound < 1.0)
    );
    let expected = json!({
        "operation": "round",
        "reached": true,
        "residual": null,
        "deviation": found["deviation"],
        "deviation_is": "bounded",
        "largest_move": {
            "distance": report.largest_move.map(|largest| largest.distance),
            "vertex": report.largest_move.map(|largest| largest.vertex),
        },
        "features_before": counts("features_before", 2),
        "features_after": counts("features_after", extrema),
        "rounding": found["rounding"],
        "remarks": [],
    });
    assert_eq!(found, expected);
}

#[test]
fn harmony_is_told_before_and_afterwards() {
    let runner = Runner::example("s-curve");
    let report = runner.report("round", &[("digits", Value::Whole(0))]);
    let found = serde_json::to_value(&report).expect("JSON");
    let features = report.features.as_ref().expect("proved");
    for (side, counts) in [
        ("features_before", &features.before),
        ("features_after", &features.after),
    ] {
        let harmony = &counts[0].harmony;
        let json = &found[side][0]["harmony"];
        let keys: Vec<&String> = json.as_object().expect("an object").keys().collect();
        let expected = [
            "bending_energy",
            "discrete_curvature_extrema",
            "highest_order",
            "irregularity",
            "isogeometry",
            "leg_change",
            "length",
            "logarithmic_graph",
            "regular_order",
            "sharpest_extremum",
            "torsion_change",
            "torsion_isogeometry",
            "turning_change",
            "variation",
        ];
        assert_eq!(keys, expected);
        assert_eq!(
            json["bending_energy"],
            json!(harmony.fairness.bending_energy)
        );
        assert_eq!(json["variation"], json!(harmony.fairness.variation));
        assert_eq!(json["regular_order"], json!(harmony.regularity.order));
        let turns = harmony.figures.turns.expect("turning angles");
        let told = json!({ "value": turns.value.to_degrees(), "vertex": turns.vertex });
        assert_eq!(json["turning_change"], told);
        let pieces = json["logarithmic_graph"].as_array().expect("a list");
        assert_eq!(pieces.len(), harmony.slopes.len());
        assert_eq!(pieces[0]["slope"], json!(harmony.slopes[0].slope));
        assert_eq!(json["torsion_isogeometry"], json!(null));
    }
    let [before, after] = [&features.before, &features.after].map(|counts| &counts[0].harmony);
    assert_ne!(before, after);
    // The example is in harmony.
    assert_eq!(before.curvature.verdict, Match::Agrees);
    assert_eq!(
        found["features_before"][0]["harmony"]["isogeometry"]["verdict"],
        "agrees"
    );
    let curve = json!({ "extrema": 2, "sign_changes": 1 });
    assert_eq!(
        found["features_before"][0]["harmony"]["isogeometry"]["curve"],
        curve
    );
}

#[test]
fn angles_are_told_in_degrees_and_lengths_as_they_are() {
    let runner = Runner::example("hull");
    let target = beside(runner.polygon(), End::Finish, 0.0, 0.1);
    let runner = runner.with_target(End::Finish, target);
    let report = serde_json::to_value(runner.report("rotate-end", &[])).expect("JSON");
    let angle = report["rotation"].as_f64().expect("an angle");
    assert!((angle - 0.1_f64.to_degrees()).abs() < 1e-10, "{angle}");
}

#[test]
fn what_is_not_reached_is_told_with_what_is_left() {
    let runner = Runner::example("arc");
    let targets = End::BOTH.map(|end| beside(runner.polygon(), end, 0.02, 0.1));
    let runner = runner
        .with_target(End::Start, targets[0])
        .with_target(End::Finish, targets[1]);
    let report = runner.report("correct-ends", &[("method", Value::Choice(1))]);
    let summary = report.summary();
    assert!(
        summary.starts_with("Correct ends: not reached, nothing is changed; "),
        "{summary}"
    );
    assert!(summary.contains(". Stopped after "), "{summary}");
    let json = serde_json::to_value(&report).expect("JSON");
    assert_eq!(json["reached"], false);
    assert_eq!(json["largest_move"], json!(null));
    assert_eq!(json["features_before"], json["features_after"]);
}
