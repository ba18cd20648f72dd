//! Operations that bring ends to their targets.

use batten::geometry::end_correction::{EndDifference, EndTarget};
use batten::geometry::features::{Feature, Features};
use batten::geometry::{End, FloatPolygon, Progress};
use batten::operations::{Annotation, Deviation, Report, Value};
use glam::DVec3;

use crate::runner::{Runner, apart, beside, operation};

/// What is left at an end that meets its target, in units of the curve's size.
const MET: f64 = 1e-12;

const STEPS: (&str, Value) = ("method", Value::Choice(1));

/// An example with targets at both ends.
fn both(name: &str) -> Runner {
    let runner = Runner::example(name);
    let targets = End::BOTH.map(|end| beside(runner.polygon(), end, 0.02, 0.1));
    runner
        .with_target(End::Start, targets[0])
        .with_target(End::Finish, targets[1])
}

fn residual(polygon: &FloatPolygon, end: End, target: EndTarget) -> f64 {
    EndDifference::between(polygon, end, &target).residual(polygon.size())
}

#[test]
fn a_translation_and_a_rotation_meet_the_target_and_keep_the_curvature() {
    let runner = Runner::example("hull");
    let (end, size) = (End::Finish, runner.polygon().size());
    let target = beside(runner.polygon(), end, 0.02, 0.1);
    let runner = runner.with_target(end, target);
    let jet = runner.polygon().end_jet(end);
    let (translated, curves) = runner.done("translate-end", &[]);
    assert!(translated.residual.is_some_and(|left| left <= MET * size));
    let actual = curves[0].polygon.end_jet(end);
    assert!(actual.point.distance(target.point) <= MET * size);
    let tangents = [jet, actual].map(|jet| jet.tangent().expect("a tangent"));
    assert!(tangents[0].distance(tangents[1]) <= MET);
    let Value::Real(way) = translated.figures[0].value else {
        panic!("a length");
    };
    assert!((way / (0.02 * size) - 1.0).abs() <= MET, "{way}");
    let arrow = Annotation::Arrow {
        from: jet.point,
        to: target.point,
    };
    assert_eq!(
        translated.annotations,
        [arrow, Annotation::Point(target.point)]
    );
    let Deviation::AtMost(bound) = translated.deviation else {
        panic!("{:?}", translated.deviation);
    };
    assert!(apart(runner.polygon(), &curves[0].polygon, |u| u) <= bound);
    let (rotated, curves) = Runner::curves(curves).done("rotate-end", &[]);
    assert!(rotated.residual.is_some_and(|left| left <= MET * size));
    assert!(residual(&curves[0].polygon, end, target) <= MET * size);
    let Value::Real(angle) = rotated.figures[0].value else {
        panic!("an angle");
    };
    assert!((angle - 0.1).abs() <= 1e-12, "{angle}");
    let change = curves[0].polygon.end_jet(end).signed_curvature() / jet.signed_curvature();
    assert!((change - 1.0).abs() < 1e-9, "{change}");
}

#[test]
fn both_methods_correct_ends_that_share_no_vertex() {
    let runner = both("bottle");
    let size = runner.polygon().size();
    for given in [&[][..], &[STEPS]] {
        let (outcome, curves) = runner.done("correct-ends", given);
        let left = outcome.residual.expect("a residual");
        assert!(left <= 1e-9 * size, "{left:e}");
        for (end, target) in runner.curve().targets.list() {
            assert!(residual(&curves[0].polygon, end, target) <= left.max(MET * size));
        }
        assert_eq!(outcome.figures[0].value, Value::Whole(1));
        assert_eq!(outcome.annotations.len(), 4);
    }
}

#[test]
fn the_loop_stops_on_the_papers_arc_and_both_ends_at_once_correct_it() {
    let runner = both("arc");
    let outcome = runner.run("correct-ends", &[STEPS]).expect("it can run");
    assert!(!outcome.reached);
    assert_eq!(outcome.edits, []);
    let left = outcome.residual.expect("a residual");
    assert!(left > 1e-3, "{left}");
    let remark = &outcome.remarks[0];
    assert!(remark.starts_with("Stopped after "), "{remark}");
    assert!(
        remark.contains("the curve is one segment") && remark.ends_with("Use “both ends at once”"),
        "{remark}"
    );
    let (outcome, _) = runner.done("correct-ends", &[]);
    let left = outcome.residual.expect("a residual");
    assert!(left <= MET * runner.polygon().size(), "{left:e}");
}

#[test]
fn an_end_without_a_target_keeps_its_point_and_direction() {
    let runner = Runner::example("arc");
    let target = beside(runner.polygon(), End::Finish, 0.02, 0.1);
    let runner = runner.with_target(End::Finish, target);
    let (_, curves) = runner.done("correct-ends", &[]);
    let [before, after] =
        [runner.polygon(), &curves[0].polygon].map(|polygon| polygon.end_jet(End::Start));
    let size = runner.polygon().size();
    assert!(before.point.distance(after.point) <= MET * size);
    let tangents = [before, after].map(|jet| jet.tangent().expect("a tangent"));
    assert!(tangents[0].distance(tangents[1]) <= MET);
}

#[test]
fn steps_reach_nothing_where_they_move_an_end_without_a_target() {
    for (degree, count) in [(5, 6), (1, 2), (3, 5)] {
        let angle = |index: usize| 0.4 * index as f64;
        let vertices = (0..count).map(|index| (angle(index).cos(), angle(index).sin()));
        let vertices: Vec<(f64, f64)> = vertices.collect();
        let polygon = FloatPolygon::planar(degree, &vertices).expect("a polygon");
        let target = beside(&polygon, End::Start, 0.1, 0.5);
        let kept = EndTarget::keeping(&polygon.end_jet(End::Finish));
        let runner = Runner::of(polygon.clone()).with_target(End::Start, target);
        let outcome = runner.run("correct-ends", &[STEPS]).expect("it can run");
        let after = outcome.applied_to(runner.input.document()).expect("edits");
        let (_, after) = after.curves().next().expect("a curve");
        let left = residual(&after.polygon, End::Finish, kept);
        assert!(left <= 1e-8 * polygon.size(), "{degree}, {count}: {left:e}");
        if !outcome.reached {
            let (left, remark) = (outcome.residual, &outcome.remarks[0]);
            assert!(left.is_some_and(|left| left > 1e-3), "{left:?}");
            assert!(remark.ends_with("Use “both ends at once”"), "{remark}");
        }
    }
}

/// A wave along the x axis.
fn wave() -> FloatPolygon {
    let vertex = |index: usize| (0.1 * index as f64, 0.02 * (0.5 * index as f64).sin());
    let vertices: Vec<(f64, f64)> = (0..24).map(vertex).collect();
    FloatPolygon::planar(5, &vertices).expect("a polygon")
}

#[test]
fn a_correction_that_changes_the_whole_curve_says_what_keeps_it() {
    let end = wave().end_jet(End::Finish);
    let up = EndTarget {
        point: end.point + 0.01 * DVec3::Y,
        ..EndTarget::default()
    };
    let over = EndTarget {
        direction: Some(DVec3::new(-1.0, 0.1, 0.0)),
        ..EndTarget::keeping(&end)
    };
    // Between locked vertices the end hardly follows those beside them.
    let locked = ("locked", Value::List(vec![20.0, 21.0, 22.0]));
    let told = |target: EndTarget, given: &[(&str, Value)]| {
        let runner = Runner::of(wave()).with_target(End::Finish, target);
        let outcome = runner.run("correct-ends", given).expect("an outcome");
        outcome.warnings.join("\n")
    };
    assert_eq!(told(up, &[]), "");
    let vertices = ("order", Value::Choice(1));
    for (warnings, begin) in [
        (
            told(up, &[locked.clone(), vertices.clone()]),
            "The curve moves by up to ",
        ),
        (
            told(over, std::slice::from_ref(&vertices)),
            "The curve turns by -189° in all, before by ",
        ),
        (
            told(over, std::slice::from_ref(&vertices)),
            "The target direction turns the end by 1",
        ),
    ] {
        let mut lines = warnings.lines();
        assert!(lines.any(|line| line.starts_with(begin)), "{warnings}");
        assert!(
            warnings.contains("“Also hold vertices” (--locked)"),
            "{warnings}"
        );
    }
}

#[test]
fn the_curve_moves_least_where_its_vertices_would_take_it_far() {
    // Few vertices, whose outer ones hardly matter: a straight end takes them far.
    let vertices = [
        (-0.163, 4.148),
        (2.116, -0.355),
        (0.863, -0.003),
        (0.317, 0.212),
        (-0.028, 0.043),
        (-0.047, -0.071),
        (0.223, 0.062),
        (0.855, -0.066),
        (2.037, -0.149),
        (4.841, 6.394),
    ];
    let polygon = FloatPolygon::planar(5, &vertices).expect("a polygon");
    let straight = [
        ("start-curvature", Value::List(vec![0.0])),
        ("end-curvature", Value::List(vec![0.0])),
    ];
    let run = |order: usize| {
        let runner = Runner::of(polygon.clone());
        let given = [&straight[..], &[("order", Value::Choice(order))]].concat();
        let outcome = runner.run("correct-ends", &given).expect("it can run");
        let after = outcome.applied_to(runner.input.document()).expect("edits");
        let found = &after.curve(runner.id()).expect("a curve").polygon;
        for end in End::BOTH {
            let [before, after] = [&polygon, found].map(|it| it.end_jet(end));
            assert!(before.point.distance(after.point) <= 1e-9);
            assert!(after.signed_curvature().abs() <= 1e-9);
        }
        // What becomes another curve is not reached.
        assert_eq!(
            outcome.reached,
            order != 1,
            "{order}: {:?}",
            outcome.remarks
        );
        let samples = (0..=100).map(|step| f64::from(step) / 20.0);
        let moved = samples.map(|u| polygon.point(u).distance(found.point(u)));
        (moved.fold(0.0, f64::max), outcome.remarks.join("\n"))
    };
    let [(automatic, said), (by_vertices, _), (by_curve, _)] = [0, 1, 4].map(run);
    assert!(
        by_vertices > 0.5 && by_curve < 0.04,
        "{by_vertices} {by_curve}"
    );
    assert_eq!(automatic, by_curve);
    assert!(said.contains("The curve moves least"), "{said}");
}

#[test]
fn an_end_that_turns_does_not_bend_sharply() {
    // A handle that leaves its body 24° too flat, and bends less than it.
    let vertices = [
        (-17.7, 182.8),
        (2.1, 218.4),
        (23.2, 243.4),
        (46.0, 254.6),
        (70.0, 248.2),
        (90.2, 229.6),
        (96.9, 200.8),
        (92.0, 177.8),
        (79.9, 155.7),
        (63.8, 141.6),
        (45.7, 132.8),
        (26.5, 127.4),
    ];
    let polygon = FloatPolygon::planar(5, &vertices).expect("a polygon");
    let sharpest = |polygon: &FloatPolygon| {
        let samples = (0..=700).map(|step| polygon.jet(f64::from(step) / 100.0));
        let curvatures = samples.map(|jet| jet.signed_curvature().abs());
        curvatures.fold(0.0, f64::max)
    };
    let extrema = |polygon: &FloatPolygon| {
        let features = Features::proved(polygon, |_| true).expect("not cancelled");
        features.count(Feature::CurvatureExtremum)
    };
    let body = EndTarget {
        direction: Some(DVec3::new(0.449, 0.894, 0.0)),
        curvature: Some(-0.0225),
        ..EndTarget::keeping(&polygon.end_jet(End::Start))
    };
    let speed = polygon.end_jet(End::Start).speed();
    assert!((0.029..0.031).contains(&sharpest(&polygon)));
    let corrected = |order: usize| {
        let runner = Runner::of(polygon.clone()).with_target(End::Start, body);
        let given = ("order", Value::Choice(order));
        let (_, curves) = runner.done("correct-ends", &[given]);
        curves[0].polygon.clone()
    };
    let found = corrected(0);
    // The end turns as a whole.
    let turned = found.end_jet(End::Start).speed();
    assert!((turned / speed - 1.0).abs() <= MET, "{turned}");
    assert!(extrema(&found) <= extrema(&polygon));
    let moves = polygon.vertices().iter().zip(found.vertices());
    let farthest = moves.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(farthest < 0.3 * polygon.size(), "{farthest}");
    // The least moves shorten its derivative, and bend it sharply.
    let [turned, least] = [found, corrected(1)].map(|it| sharpest(&it));
    assert!(turned < 0.05 && least > 0.06, "{turned} {least}");
}

#[test]
fn a_target_outside_its_plane_leads_a_planar_curve_into_space() {
    let runner = Runner::of(wave());
    let target = EndTarget {
        point: DVec3::new(2.3, 0.0, 0.1),
        ..EndTarget::default()
    };
    let runner = runner.with_target(End::Finish, target);
    let (outcome, curves) = runner.done("correct-ends", &[]);
    assert!(!curves[0].polygon.is_planar());
    let remark = "A target lies outside the plane z = 0: the curve becomes a curve in space";
    assert!(
        outcome.warnings.iter().any(|it| it == remark),
        "{outcome:?}"
    );
}

#[test]
fn what_is_within_the_tolerance_is_left_as_it_is() {
    let runner = both("hull");
    let loose = ("tolerance", Value::Real(runner.polygon().size()));
    for given in [&[loose.clone()][..], &[loose, STEPS]] {
        let (outcome, _) = runner.done("correct-ends", given);
        assert_eq!(outcome.edits, []);
        assert_eq!(outcome.figures[0].value, Value::Whole(0));
        assert_eq!(outcome.remarks, ["Already within the tolerance"]);
    }
}

#[test]
fn what_cannot_be_reached_is_told_with_what_is_left() {
    // Two points cannot have two directions that are not their chord's.
    let polygon = FloatPolygon::planar(1, &[(0.0, 0.0), (1.0, 0.0)]).expect("a polygon");
    let target = |x| EndTarget {
        point: DVec3::new(x, 0.0, 0.0),
        direction: Some(DVec3::Y),
        ..EndTarget::default()
    };
    let runner = Runner::of(polygon)
        .with_target(End::Start, target(0.0))
        .with_target(End::Finish, target(1.0));
    let outcome = runner.run("correct-ends", &[]).expect("it can run");
    assert!(!outcome.reached && outcome.edits.is_empty());
    assert!(outcome.residual.is_some_and(|left| left > 0.1));
    assert!(
        outcome.remarks[0].contains("end conditions cannot be met"),
        "{}",
        outcome.remarks[0]
    );
    // A tolerance below rounding is not reached either.
    let tiny = ("tolerance", Value::Real(f64::MIN_POSITIVE));
    let outcome = both("hull")
        .run("correct-ends", &[tiny])
        .expect("it can run");
    assert!(outcome.reached == (outcome.residual == Some(0.0)));
    assert_eq!(outcome.edits.is_empty(), !outcome.reached);
    // A cusp has no direction to turn.
    let cusp = FloatPolygon::planar(2, &[(0.0, 0.0), (0.0, 0.0), (1.0, 0.0)]);
    let runner = Runner::of(cusp.expect("a polygon")).with_target(End::Start, target(0.0));
    for (operation, given) in [
        ("rotate-end", ("end", Value::Choice(0))),
        ("correct-ends", STEPS),
    ] {
        let outcome = runner.run(operation, &[given]).expect("it can run");
        assert!(!outcome.reached && outcome.edits.is_empty());
        assert_eq!(
            outcome.remarks,
            ["The curve has no direction at its start: a cusp"]
        );
    }
}

#[test]
fn a_step_that_moves_the_other_end_too_says_so() {
    let vertex = |index: usize| {
        let x = 12.0 * index as f64;
        (x, 25.0 - 0.01 * (x - 48.0) * (x - 48.0))
    };
    // Of degree 5, nine vertices: both ends share one of them, with ten they share none.
    for (count, shares) in [(9, true), (10, false)] {
        let vertices: Vec<_> = (0..count).map(vertex).collect();
        let polygon = FloatPolygon::planar(5, &vertices).expect("a polygon");
        let start = polygon.end_jet(End::Start);
        let target = beside(&polygon, End::Finish, 0.05, 0.1);
        let runner = Runner::of(polygon).with_target(End::Finish, target);
        for operation in ["translate-end", "rotate-end"] {
            let (outcome, curves) = runner.done(operation, &[]);
            let moved = curves[0]
                .polygon
                .end_jet(End::Start)
                .point
                .distance(start.point);
            let told: Vec<_> = outcome.warnings.iter().collect();
            assert_eq!(moved > 0.0, shares, "{operation}: {moved}");
            assert_eq!(told.len(), usize::from(shares), "{operation}: {told:?}");
            if let [warning] = told[..] {
                assert!(warning.starts_with("The start moves by "), "{warning}");
                let written = warning
                    .split(' ')
                    .nth(4)
                    .and_then(|it| it.parse::<f64>().ok());
                let written = written.unwrap_or_else(|| panic!("{warning}"));
                assert!((written / moved - 1.0).abs() < 1e-2, "{warning} {moved}");
            }
        }
        // What the warning advises keeps it.
        let (_, curves) = runner.done("correct-ends", &[]);
        let kept = curves[0].polygon.end_jet(End::Start).point;
        assert!(kept.distance(start.point) <= MET * curves[0].polygon.size());
    }
}

#[test]
fn missing_targets_and_directions_are_refused() {
    let runner = Runner::example("hull");
    for operation in ["translate-end", "rotate-end", "correct-ends"] {
        assert_eq!(
            runner.refused(operation, &[]),
            "no end of the curve has a target: set one first, or give “Correct ends” what you want by values"
        );
    }
    let target = EndTarget {
        point: DVec3::ZERO,
        direction: None,
        ..EndTarget::default()
    };
    let runner = runner.with_target(End::Finish, target);
    assert_eq!(
        runner.refused("translate-end", &[("end", Value::Choice(0))]),
        "the start has no target: set one first"
    );
    assert_eq!(
        runner.refused("rotate-end", &[]),
        "the target of the end has no direction: set a target direction first"
    );
    let message = Runner::example("periodic").refused("correct-ends", &[]);
    assert!(message.ends_with("open it first"), "{message}");
}

#[test]
fn a_correction_tells_the_inflections_that_it_makes() {
    let vertex = |index: usize| {
        let angle = 0.15 * index as f64;
        (angle.cos(), angle.sin())
    };
    let vertices: Vec<(f64, f64)> = (0..14).map(vertex).collect();
    let arc = FloatPolygon::planar(4, &vertices).expect("a polygon");
    let end = arc.end_jet(End::Finish);
    let tangent = end.tangent().expect("a tangent");
    let target = EndTarget {
        direction: Some(tangent + 0.8 * DVec3::new(tangent.y, -tangent.x, 0.0)),
        ..EndTarget::keeping(&end)
    };
    let runner = Runner::of(arc).with_target(End::Finish, target);
    let outcome = runner.run("correct-ends", &[]).expect("an outcome");
    let input = &runner.input;
    let report = Report::of(
        operation("correct-ends"),
        input,
        &outcome,
        &Progress::default(),
    );
    let remarks = report.expect("nobody cancels").warnings;
    let mut told = remarks.iter();
    assert!(
        told.any(|it| it.starts_with("Inflections: 0 before, ")),
        "{remarks:?}"
    );
}

#[test]
fn a_correction_that_makes_a_cusp_is_not_reached() {
    let section = [
        (1.0, 7.3323e-05),
        (0.93985, 0.014831),
        (0.81713, 0.04266),
        (0.55337, 0.093169),
        (0.28018, 0.095779),
        (0.043504, 0.054452),
        (-0.0010207, -0.0063084),
        (-0.011984, 0.0033779),
        (0.04796, -0.016915),
        (0.14752, 5.7093e-05),
        (0.48309, 0.033224),
        (0.80317, 0.01305),
        (0.94118, 0.0032901),
        (1.0, -4.7195e-06),
    ];
    let runner = Runner::of(FloatPolygon::planar(5, &section).expect("a polygon"));
    let ends = [
        ("start", Value::List(vec![1.0, 0.002])),
        ("end", Value::List(vec![1.0, -0.002])),
    ];
    let by = |order: usize| [&ends[..], &[("order", Value::Choice(order))]].concat();
    let (automatic, harmony) = (0, 5);
    assert!(
        runner
            .run("correct-ends", &by(automatic))
            .expect("it can run")
            .reached
    );
    let outcome = runner
        .run("correct-ends", &by(harmony))
        .expect("it can run");
    assert!(!outcome.reached);
    assert!(
        outcome.warnings[0].contains("nearly a cusp"),
        "{:?}",
        outcome.warnings
    );
    let report = runner.report("correct-ends", &by(harmony));
    let told = report
        .warnings
        .iter()
        .any(|it| it.starts_with("Smallest radius: "));
    assert!(told, "{:?}", report.warnings);
}

#[test]
fn ends_that_turn_may_take_the_curve_along() {
    let line: Vec<(f64, f64)> = (0..6)
        .map(|it| (10.0 * f64::from(it) - 20.0, 0.0))
        .collect();
    let line = FloatPolygon::planar(5, &line).expect("a line");
    let turned = |degrees: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        Value::List(vec![cosine, sine])
    };
    let given = [
        ("start-direction", turned(20.0)),
        ("end-direction", turned(-20.0)),
        ("start-curvature", Value::List(vec![-0.05])),
        ("end-curvature", Value::List(vec![-0.05])),
        ("end-slope", Value::List(vec![0.001])),
    ];
    let (outcome, curves) = Runner::of(line.clone()).done("correct-ends", &given);
    assert!(
        outcome
            .residual
            .is_some_and(|left| left <= MET * line.size())
    );
    for (end, sign) in [(End::Start, 1.0), (End::Finish, -1.0)] {
        let jet = curves[0].polygon.end_jet(end);
        let angle = jet.first.y.atan2(jet.first.x).to_degrees();
        assert!((angle - sign * 20.0).abs() <= 1e-9, "{angle}");
        assert!((jet.signed_curvature() + 0.05).abs() <= 1e-11);
    }
    // What is missed by more than rounding is not said to be rounding.
    let given = [
        ("start-direction", turned(20.0)),
        ("end-direction", turned(30.0)),
        ("start-curvature", Value::List(vec![-0.1])),
        ("end-curvature", Value::List(vec![0.0])),
        ("end-slope", Value::List(vec![0.05])),
    ];
    let outcome = Runner::of(line)
        .run("correct-ends", &given)
        .expect("it can run");
    let told = outcome.remarks.join("; ");
    assert!(outcome.reached || !told.contains("Rounding"), "{told}");
}
