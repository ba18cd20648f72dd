//! Operations that extend, split, trim and round.

use batten::document::{Colour, Edit};
use batten::geometry::{ClampedPolygon, End};
use batten::operations::{Annotation, Deviation, Value};
use glam::DVec3;

use crate::runner::{ROUNDING, Runner, apart, beside};

fn real(name: &'static str, value: f64) -> (&'static str, Value) {
    (name, Value::Real(value))
}

fn whole(name: &'static str, value: usize) -> (&'static str, Value) {
    (name, Value::Whole(value))
}

#[test]
fn extending_continues_the_polynomial_and_keeps_the_vertices() {
    let runner = Runner::example("s-curve");
    let before = runner.polygon();
    for (option, end) in End::BOTH.into_iter().enumerate() {
        let given = [("end", Value::Choice(option)), whole("segments", 3)];
        let (outcome, curves) = runner.done("extend", &given);
        let polygon = &curves[0].polygon;
        let added = 3 * (1 - option);
        let kept = &polygon.vertices()[added..added + before.vertices().len()];
        assert_eq!(kept, before.vertices());
        assert_eq!(polygon.segments(), before.segments() + 3);
        let off = apart(before, polygon, |u| u + added as f64);
        assert!(off <= ROUNDING * before.size(), "{off:e}");
        assert_eq!(outcome.deviation, Deviation::Exact);
        assert_eq!(
            outcome.annotations,
            [Annotation::Point(before.end_jet(end).point)]
        );
    }
    let message = Runner::example("periodic").refused("extend", &[]);
    assert_eq!(
        message,
        "a periodic curve has no ends and cannot be extended: open it first"
    );
}

#[test]
fn splitting_at_a_knot_is_exact_and_divides_colour_and_targets() {
    let runner = Runner::example("s-curve");
    let targets = End::BOTH.map(|end| beside(runner.polygon(), end, 0.1, 0.2));
    let colour = Some(Colour([1, 2, 3]));
    let curve = runner.id();
    let runner = runner
        .with_target(End::Start, targets[0])
        .with_target(End::Finish, targets[1])
        .edited(Edit::Recolour { curve, colour });
    let before = runner.polygon();
    let (outcome, curves) = runner.done("split", &[real("at", 1.0)]);
    let degree = before.degree();
    assert_eq!(curves.len(), 2);
    assert_eq!(
        curves[0].polygon.vertices(),
        &before.vertices()[..degree + 1]
    );
    assert_eq!(curves[1].polygon.vertices(), &before.vertices()[1..]);
    assert_eq!(outcome.deviation, Deviation::Exact);
    assert_eq!(outcome.annotations, [Annotation::Point(before.point(1.0))]);
    let counts: Vec<Value> = outcome
        .figures
        .iter()
        .map(|figure| figure.value.clone())
        .collect();
    assert_eq!(
        counts,
        [
            Value::Whole(degree + 1),
            Value::Whole(before.vertices().len() - 1)
        ]
    );
    assert_eq!([&curves[0].name, &curves[1].name], ["s-curve", "s-curve 2"]);
    assert_eq!([curves[0].colour, curves[1].colour], [colour; 2]);
    let found = curves
        .iter()
        .map(|curve| (curve.targets.start, curve.targets.finish));
    assert_eq!(
        found.collect::<Vec<_>>(),
        [(Some(targets[0]), None), (None, Some(targets[1]))]
    );
}

#[test]
fn splitting_between_knots_comes_near_or_halves_segments() {
    let runner = Runner::example("hull");
    let before = runner.polygon();
    let (outcome, curves) = runner.done("split", &[real("at", 4.3)]);
    let Deviation::AtMost(bound) = outcome.deviation else {
        panic!("{:?}", outcome.deviation);
    };
    assert!(bound < 1e-2 * before.size(), "{bound:e}");
    let parts = [&curves[0].polygon, &curves[1].polygon];
    let spans = [(0.0, 4.3), (4.3, before.segments() as f64)];
    for (part, (from, to)) in parts.into_iter().zip(spans) {
        let off = apart(part, before, |u| {
            from + (to - from) * u / part.segments() as f64
        });
        assert!(off <= bound, "{off:e} {bound:e}");
    }
    let given = [real("at", 4.25), ("subdivisions", Value::List(vec![2.0]))];
    let (outcome, _) = runner.done("split", &given);
    assert_eq!(outcome.deviation, Deviation::Exact);
    // The knot in the middle is offered.
    let (outcome, _) = runner.done("split", &[]);
    assert_eq!(outcome.annotations, [Annotation::Point(before.point(5.0))]);
    let message = Runner::example("periodic").refused("split", &[]);
    assert!(message.contains("periodic"), "{message}");
}

#[test]
fn trimming_keeps_the_part_and_the_targets_of_kept_ends() {
    let runner = Runner::example("s-curve");
    let targets = End::BOTH.map(|end| beside(runner.polygon(), end, 0.1, 0.2));
    let runner = runner
        .with_target(End::Start, targets[0])
        .with_target(End::Finish, targets[1]);
    let before = runner.polygon();
    let given = [
        real("from", 0.5),
        real("to", 1.75),
        ("subdivisions", Value::List(vec![2.0])),
    ];
    let (outcome, curves) = runner.done("trim", &given);
    assert_eq!(outcome.deviation, Deviation::Exact);
    let part = &curves[0].polygon;
    let off = apart(part, before, |u| 0.5 + u / 4.0);
    assert!(off <= ROUNDING * before.size(), "{off:e}");
    assert!(curves[0].targets.list().is_empty());
    for (given, kept) in [
        ([real("from", 0.0), real("to", 2.0)], End::Start),
        ([real("from", 2.0), real("to", 5.0)], End::Finish),
    ] {
        let (_, curves) = runner.done("trim", &given);
        let left: Vec<End> = curves[0]
            .targets
            .list()
            .iter()
            .map(|(end, _)| *end)
            .collect();
        assert_eq!(left, [kept]);
    }
}

#[test]
fn a_part_of_a_periodic_curve_may_run_across_its_joint() {
    let runner = Runner::example("periodic");
    let before = runner.polygon();
    let last = before.segments() as f64;
    let given = [real("from", last - 2.0), real("to", last + 3.0)];
    let (outcome, curves) = runner.done("trim", &given);
    let part = &curves[0].polygon;
    assert_eq!(outcome.deviation, Deviation::Exact);
    assert!(!part.is_periodic());
    let off = apart(part, before, |u| (u + last - 2.0) % last);
    assert!(off <= ROUNDING * before.size(), "{off:e}");
    let given = [real("from", 1.0), real("to", last + 1.5)];
    let message = runner.refused("trim", &given);
    assert!(message.contains("there is no part"), "{message}");
}

#[test]
fn rounding_tells_what_it_does_to_both_polygons() {
    let runner = Runner::example("arc");
    let before = runner.polygon();
    let (float, curves) = runner.done("round", &[]);
    let Value::Real(moved) = float.figures[0].value else {
        panic!("a length");
    };
    assert!(moved <= 0.5e-3 * 2f64.sqrt() && moved > 1e-4);
    assert!(matches!(float.deviation, Deviation::AtMost(bound) if bound > 0.0 && bound <= moved));
    let decimal = |value: f64| (value * 1e3).round() / 1e3;
    let expected = before.vertices().iter();
    let expected: Vec<DVec3> = expected
        .map(|vertex| DVec3::new(decimal(vertex.x), decimal(vertex.y), 0.0))
        .collect();
    assert_eq!(curves[0].polygon.vertices(), expected);
    // The paper's instability: the float S-polygon moves a thousand times and more as far.
    let report = runner.report("round", &[("polygon", Value::Choice(1))]);
    let Value::Real(moved) = report.figures[0].value else {
        panic!("a length");
    };
    let largest = report.largest_move.expect("the same vertices");
    assert!(
        moved < 1e-3 && largest.distance > 1e3 * moved,
        "{largest:?}"
    );
    let (_, curves) = runner.done(
        "round",
        &[("polygon", Value::Choice(1)), whole("digits", 6)],
    );
    let closed = ClampedPolygon::from_float(&curves[0].polygon);
    for vertex in closed.vertices() {
        for value in vertex.to_array() {
            let nearest = (value * 1e6).round() / 1e6;
            assert!((value - nearest).abs() <= 1e-12, "{value}");
        }
    }
}

#[test]
fn a_closed_polygon_that_is_not_kept_round_is_told() {
    let given = [("polygon", Value::Choice(1))];
    let (kept, _) = Runner::example("arc").done("round", &given);
    assert_eq!(kept.remarks, Vec::<String>::new());
    // One segment of the highest degree: its float S-polygon has vertices that doubles hold to
    // thousands of units only.
    let highest = [whole("degree", 25)];
    let (_, curves) = Runner::example("arc").done("elevate-degree", &highest);
    let (outcome, _) = Runner::curves(curves).done("round", &given);
    let remark = outcome.remarks.first().expect("a remark");
    assert!(
        remark.starts_with("The vertices stay off round numbers"),
        "{remark}"
    );
}

#[test]
fn the_whole_curve_is_offered_to_be_trimmed() {
    let runner = Runner::example("hull");
    let (outcome, curves) = runner.done("trim", &[]);
    assert_eq!(outcome.deviation, Deviation::Exact);
    assert_eq!(&curves[0].polygon, runner.polygon());
}

#[test]
fn a_periodic_curve_stays_periodic_when_its_closed_polygon_is_rounded() {
    let runner = Runner::example("periodic");
    let given = |digits| [("polygon", Value::Choice(1)), whole("digits", digits)];
    let (outcome, curves) = runner.done("round", &given(9));
    let polygon = &curves[0].polygon;
    assert!(polygon.is_periodic());
    let Deviation::AtMost(bound) = outcome.deviation else {
        panic!("{:?}", outcome.deviation);
    };
    let off = apart(runner.polygon(), polygon, |u| u);
    let rounding = ROUNDING * polygon.size();
    assert!(off <= bound + rounding && bound < 1e-9, "{off:e} {bound:e}");
    // With few digits the closed S-polygon closes no longer.
    let message = runner.refused("round", &given(3));
    assert!(
        message.starts_with("the curve does not close smoothly"),
        "{message}"
    );
}
