//! Curves that are joined, and curves that are closed.

use std::f64::consts::PI;

use batten::document::{Curve, Document, Edit, EndMatch, LockedVertices, MatchPlace};
use batten::geometry::approximation::blend;
use batten::geometry::approximation::merging::merge_blended;
use batten::geometry::end_correction::EndTarget;
use batten::geometry::features::{Feature, Features};
use batten::geometry::{
    BezierPolygon, ClampedPolygon, Continuity, End, FloatPolygon, Progress, arc_length_between,
    curve_crossing,
};
use batten::operations::{Deviation, Operands, Outcome, Report, Value};
use glam::{DQuat, DVec3};
use serde_json::{Value as Json, json};

use crate::common::Random;
use crate::runner::{Runner, operation};

/// An arc of a circle of radius 10 from one angle to another, both in degrees.
fn arc(name: &str, degree: usize, from: f64, to: f64) -> Curve {
    let count = 12;
    let vertices = (0..count).map(|index| {
        let share = f64::from(index) / f64::from(count - 1);
        let angle = (from + share * (to - from)).to_radians();
        10.0 * DVec3::new(angle.cos(), angle.sin(), 0.0)
    });
    let polygon = FloatPolygon::new(degree, vertices.collect(), None, false);
    Curve::new(name, polygon.expect("a polygon"))
}

/// Join the first two curves of a document.
fn join(document: &Document, given: &[(&str, Value)]) -> (Outcome, Document, Report) {
    let input = Operands::new(document, document.ids().take(2)).expect("two curves");
    let join = operation("join");
    let values = join.values(&input, given.iter().cloned()).expect("values");
    let progress = Progress::default();
    let outcome = join.run(&input, &values, &progress).expect("it can run");
    let report = Report::of(join, &input, &outcome, &progress).expect("nobody cancels");
    let after = outcome.applied_to(document).expect("edits");
    (outcome, after, report)
}

fn only(document: &Document) -> &Curve {
    let mut curves = document.curves();
    let (_, curve) = curves.next().expect("a curve");
    assert_eq!(curves.len(), 0);
    curve
}

/// Two arcs that run beside each other: the way from one to the other turns back.
#[test]
fn no_bridge_turns_back_in_a_cusp() {
    let mut second = arc("b", 5, 20.0, 100.0);
    let vertices = second.polygon.vertices().iter();
    let moved: Vec<DVec3> = vertices.map(|it| *it + DVec3::new(1.5, 1.0, 0.0)).collect();
    second.polygon = FloatPolygon::new(5, moved, None, false).expect("a polygon");
    let document = Document::from_curves([arc("a", 5, 20.0, 100.0), second]);
    let ends = [
        ("first-end", Value::Choice(2)),
        ("second-end", Value::Choice(2)),
    ];
    let bridge = [("method", Value::Choice(2))];
    let given: Vec<(&str, Value)> = ends.into_iter().chain(bridge).collect();
    let (outcome, after, _) = join(&document, &given);
    let polygon = &only(&after).polygon;
    let features = Features::proved(polygon, |_| true).expect("a proof");
    let radius = features.largest_curvature(polygon).recip();
    assert!(!outcome.reached || radius > 0.05, "{radius:e}");
}

#[test]
fn parts_of_a_polygon_with_a_gap_of_up_to_three_segments_give_it_back() {
    let mut random = Random(11);
    for gap in 1..=3 {
        let whole: Vec<DVec3> = (0..16)
            .map(|index| {
                let angle = 0.2 * f64::from(index);
                (10.0 + angle + 0.1 * random.between(-1.0, 1.0))
                    * DVec3::new(angle.cos(), angle.sin(), 0.0)
            })
            .collect();
        let part = |name: &str, vertices: &[DVec3]| {
            let polygon = FloatPolygon::new(5, vertices.to_vec(), None, false);
            Curve::new(name, polygon.expect("a polygon"))
        };
        let turned: Vec<DVec3> = whole[8 - 5 + gap..].iter().rev().copied().collect();
        let parts = [part("a", &whole[..8]), part("b", &turned)];
        let document = Document::from_curves(parts);
        let given = [
            ("method", Value::Choice(2)),
            ("first-end", Value::Choice(2)),
            ("second-end", Value::Choice(2)),
        ];
        let (outcome, after, report) = join(&document, &given);
        assert!(outcome.reached, "{}", report.text());
        assert_eq!(only(&after).polygon.vertices(), whole, "gap {gap}");
        assert!(report.text().contains("Bridge vertices: 0"), "gap {gap}");
    }
}

#[test]
fn parts_cut_beside_a_knot_give_the_curve_back() {
    let vertices: Vec<(f64, f64)> = (0..16)
        .map(|index| {
            let angle = 0.2 * f64::from(index);
            ((10.0 + angle) * angle.cos(), (10.0 + angle) * angle.sin())
        })
        .collect();
    let whole = FloatPolygon::planar(5, &vertices).expect("a polygon");
    let last = whole.segments() as f64;
    for [from, to] in [[5.0, 5.5], [4.5, 5.0], [5.25, 5.5], [6.0, 7.5]] {
        let parts = [
            Curve::new("a", whole.trimmed(0.0, from, 4).expect("a part").polygon),
            Curve::new("b", whole.trimmed(to, last, 4).expect("a part").polygon),
        ];
        let document = Document::from_curves(parts);
        let (outcome, after, report) = join(&document, &[]);
        let told = report.text();
        assert!(
            outcome.reached && told.contains("Bridge vertices: 0"),
            "{told}"
        );
        let found = &only(&after).polygon;
        for (one, other) in [(found, &whole), (&whole, found)] {
            let places = (0..=8 * one.segments()).map(|step| one.point(step as f64 / 8.0));
            let off = places.map(|point| other.nearest(point).distance);
            let off = off.fold(0.0, f64::max);
            assert!(off <= 1e-12 * whole.size(), "{from} {to}: {off:e}");
        }
    }
}

#[test]
fn a_joined_curve_that_crosses_itself_is_told() {
    for (start, end, is_told) in [
        ([-5.37, 5.0], [-5.37, -12.1], true),
        ([5.0, -5.0], [5.0, -17.0], false),
    ] {
        let document =
            Document::from_curves([line("a", [-10.0, 0.0], [0.0, 0.0]), line("b", start, end)]);
        let given = [
            ("method", Value::Choice(2)),
            ("first-end", Value::Choice(2)),
            ("second-end", Value::Choice(1)),
        ];
        let (_, after, report) = join(&document, &given);
        assert_eq!(curve_crossing(&only(&after).polygon).is_some(), is_told);
        let told = report.warnings.join(" ").contains("crosses itself now");
        assert_eq!(told, is_told, "{}", report.text());
    }
}

/// Whether some vertices of a polygon are those of another, from a number on, to the bit.
fn has_at(polygon: &FloatPolygon, offset: usize, part: &FloatPolygon) -> bool {
    let found = &polygon.vertices()[offset..][..part.vertices().len()];
    found == part.vertices()
}

#[test]
fn halves_of_a_closed_outline_join_where_they_were_cut() {
    // As the section of a wing: both ends meet at a corner, but for rounding, and the cut meets smoothly.
    let upper = [
        (9.0, 1.0),
        (8.0, 0.0),
        (7.0, -1.0),
        (4.0, -3.0),
        (1.0, -2.0),
    ];
    let lower = upper.iter().rev().map(|(x, y)| (*x, -y));
    let all: Vec<(f64, f64)> = upper
        .iter()
        .copied()
        .chain([(0.0, 0.0)])
        .chain(lower)
        .collect();
    for off in [0.0, 1e-16, -1e-15] {
        let mut points = all.clone();
        points[0].0 += off;
        let whole = FloatPolygon::planar(3, &points).expect("a polygon");
        let [start, end] = End::BOTH.map(|end| whole.end_jet(end).point);
        assert!(start.distance(end) <= 1e-14);
        let (first, second) = whole.split(4.0, 0).expect("two parts");
        let parts = [("first", first), ("second", second)];
        let curves = parts.map(|(name, part)| Curve::new(name.to_owned(), part.polygon));
        let (_, after, report) = join(&Document::from_curves(curves), &[]);
        assert!(report.reached);
        assert_eq!(report.figure("method"), Some(Value::Word("merge")));
        let joined = &only(&after).polygon;
        assert_eq!(joined.vertices(), whole.vertices(), "{off:e}");
    }
}

#[test]
fn the_first_curve_keeps_its_name_its_direction_and_its_vertices() {
    // The second arc begins where the first one ends, or the other way round, and may run against it.
    let first = arc("first", 4, 0.0, 60.0);
    for (second, ends) in [
        (arc("second", 4, 100.0, 160.0), [End::Finish, End::Start]),
        (arc("second", 4, 160.0, 100.0), [End::Finish, End::Finish]),
        (arc("second", 4, -100.0, -40.0), [End::Start, End::Finish]),
        (arc("second", 4, -40.0, -100.0), [End::Start, End::Start]),
    ] {
        let document = Document::from_curves([first.clone(), second.clone()]);
        let (outcome, after, report) = join(&document, &[]);
        let composite = only(&after);
        assert_eq!(composite.name, "first");
        let polygon = &composite.polygon;
        let second = if ends[0] == ends[1] {
            second.polygon.reversed()
        } else {
            second.polygon.clone()
        };
        let Some(Value::Whole(bridge)) = report.figure("bridge") else {
            panic!("{report:?}");
        };
        let count = 12;
        assert_eq!(polygon.vertices().len(), 2 * count + bridge);
        let offsets = if ends[0] == End::Finish {
            [0, count + bridge]
        } else {
            [count + bridge, 0]
        };
        assert!(has_at(polygon, offsets[0], &first.polygon), "{ends:?}");
        assert!(has_at(polygon, offsets[1], &second), "{ends:?}");
        // The gap of 40 degrees takes seven legs of 60/11 degrees.
        assert_eq!(bridge, 6);
        for vertex in polygon.vertices() {
            assert!((vertex.length() - 10.0).abs() < 1e-3, "{vertex}");
        }
        assert_eq!(outcome.annotations.len(), bridge);
        // The same ends, given.
        let choice = |end| Value::Choice(1 + usize::from(end == End::Finish));
        let given = [
            ("first-end", choice(ends[0])),
            ("second-end", choice(ends[1])),
        ];
        let (_, given, _) = join(&document, &given);
        assert_eq!(only(&given).polygon, *polygon);
    }
}

#[test]
fn the_report_tells_the_bridge_and_that_nothing_else_moved() {
    let document =
        Document::from_curves([arc("first", 5, 0.0, 60.0), arc("second", 5, 100.0, 160.0)]);
    let (_, _, report) = join(&document, &[("bridge", Value::List(vec![8.0]))]);
    let json: Json = serde_json::to_value(&report).expect("a report");
    assert_eq!(json["operation"], "join");
    assert_eq!(json["reached"], true);
    assert_eq!(json["deviation"], 0.0);
    assert_eq!(json["bridge"], 8);
    assert_eq!(json["joined"], json!({ "first": "end", "second": "start" }));
    let told = "Joined: end of the first and start of the second";
    assert!(
        report.text().lines().any(|line| line == told),
        "{}",
        report.text()
    );
    assert!(json["largest_jump"].as_f64().expect("a number") < 1e-14);
    assert!(json["bridge_extrema"].is_u64() && json["bridge_inflections"] == 0);
    let names = |key: &str| -> Vec<String> {
        let counts = json[key].as_array().expect("a list").iter();
        counts.map(|curve| curve["name"].to_string()).collect()
    };
    assert_eq!(names("features_before"), ["\"first\"", "\"second\""]);
    assert_eq!(names("features_after"), ["\"first\""]);
}

#[test]
fn the_second_curve_takes_the_degree_of_the_first() {
    let document =
        Document::from_curves([arc("first", 5, 0.0, 60.0), arc("second", 3, 100.0, 160.0)]);
    let (_, after, report) = join(&document, &[]);
    let json: Json = serde_json::to_value(&report).expect("a report");
    let deviation = json["deviation"].as_f64().expect("a number");
    assert!(deviation > 0.0 && deviation < 1e-3, "{deviation}");
    assert_eq!(only(&after).polygon.degree(), 5);
}

#[test]
fn the_second_curve_moves_only_if_it_may() {
    let mut second = arc("second", 4, 100.0, 160.0);
    let away = second.polygon.vertices().iter();
    let away = away.map(|vertex| *vertex + DVec3::new(40.0, 3.0, 0.0));
    second.polygon = FloatPolygon::new(4, away.collect(), None, false).expect("a polygon");
    let document = Document::from_curves([arc("first", 4, 0.0, 60.0), second]);
    let ends = [
        ("first-end", Value::Choice(2)),
        ("second-end", Value::Choice(1)),
    ];
    let moving = [&ends[..], &[("move-second", Value::Switch(true))]].concat();
    let (_, after, report) = join(&document, &moving);
    // The arcs are of one circle, and so is the composite.
    for vertex in only(&after).polygon.vertices() {
        assert!((vertex.length() - 10.0).abs() < 1e-6, "{vertex}");
    }
    assert!(matches!(report.figure("second_move"), Some(Value::Real(far)) if far > 10.0));
    let (_, fixed, report) = join(&document, &ends);
    assert_eq!(report.figure("second_move"), None);
    let after = &only(&fixed).polygon;
    let (_, second) = document.curves().nth(1).expect("the second");
    let [kept, found] = [&second.polygon, after].map(|it| it.end_jet(End::Finish));
    assert!(kept.point.distance(found.point) <= 1e-12 * after.size());
    assert!((kept.signed_curvature() / found.signed_curvature() - 1.0).abs() <= 1e-9);
    // Locked vertices do not move.
    let mut locked = document.clone();
    let curve = locked.ids().nth(1).expect("the second");
    let vertices = vec![3];
    let edit = Edit::SetVerticesLocked {
        curve,
        vertices,
        locked: true,
    };
    locked.apply(edit).expect("a lock");
    let input = Operands::new(&locked, locked.ids()).expect("two curves");
    let join = operation("join");
    let values = join.values(&input, moving).expect("values");
    let refused = join.run(&input, &values, &Progress::default());
    assert!(refused.expect_err("refused").to_string().contains("locked"));
}

#[test]
fn locks_targets_and_matches_stay_with_their_vertices_and_places() {
    let mut first = arc("first", 4, 0.0, 60.0);
    let mut second = arc("second", 4, 160.0, 100.0);
    first.locked_vertices = [1, 4].into_iter().collect();
    second.locked_vertices = [0, 2].into_iter().collect();
    let target = EndTarget {
        point: DVec3::new(-10.0, 3.0, 0.0),
        ..EndTarget::default()
    };
    second.targets.set(End::Start, Some(target));
    first.targets.set(End::Finish, Some(target));
    let followers = ["a", "b", "c"].map(|name| arc(name, 3, 200.0, 260.0));
    let curves = [first.clone(), second.clone()].into_iter().chain(followers);
    let mut document = Document::from_curves(curves);
    let ids: Vec<_> = document.ids().collect();
    let places = [
        (ids[2], ids[0], MatchPlace::End(End::Finish)),
        (ids[3], ids[1], MatchPlace::Parameter(2.5)),
        (ids[4], ids[1], MatchPlace::End(End::Start)),
    ];
    for (curve, source, place) in places {
        let matched = EndMatch {
            curve,
            end: End::Start,
            source,
            place,
            continuity: Continuity::G0,
            reversed: false,
        };
        document.apply(Edit::SetMatch(matched)).expect("a match");
    }
    let before = places.map(|(_, source, place)| {
        let source = document.curve(source).expect("the source");
        place.jet(&source.polygon).expect("a place").point
    });
    let (_, after, _) = join(&document, &[]);
    let composite = after.curve(ids[0]).expect("the composite");
    assert!(after.curve(ids[1]).is_none());
    let count = composite.polygon.vertices().len();
    let expected: LockedVertices = [1, 4, count - 1, count - 3].into_iter().collect();
    assert_eq!(composite.locked_vertices, expected);
    assert_eq!(composite.targets.get(End::Start), None);
    assert_eq!(composite.targets.get(End::Finish), Some(target));
    for ((curve, ..), before) in places.into_iter().zip(before) {
        let matched = after.match_of(curve, End::Start).expect("a match");
        assert_eq!(matched.source, ids[0]);
        let point = matched
            .place
            .jet(&composite.polygon)
            .expect("a place")
            .point;
        assert!(point.distance(before) < 1e-12, "{matched:?}");
    }
}

#[test]
fn a_curve_that_is_closed_keeps_its_vertices_and_has_no_ends() {
    let open = arc("arc", 5, 0.0, 250.0);
    let runner = Runner::curves(vec![open.clone()]).with_target(End::Start, EndTarget::default());
    let (outcome, curves) = runner.done("close", &[]);
    let closed = &curves[0];
    assert!(closed.polygon.is_periodic() && has_at(&closed.polygon, 0, &open.polygon));
    assert!(closed.targets.list().is_empty());
    assert!(!outcome.renumbered);
    let (_, curves) = runner.done("close", &[("bridge", Value::List(vec![3.0]))]);
    assert_eq!(curves[0].polygon.vertices().len(), 15);
    let refused = runner.refused("close", &[("bridge", Value::List(vec![1e9]))]);
    assert!(refused.starts_with("Bridge vertices: 1000000000 is out of range"));
    let periodic = Runner::example("periodic").refused("close", &[]);
    assert!(periodic.contains("periodic"), "{periodic}");
}

/// Curves of one segment whose ends lie apart, and a fair one with long ends.
const ARCHES: [&[(f64, f64)]; 4] = [
    &[
        (0.0, 0.0),
        (13.5, 23.38),
        (36.75, 35.07),
        (63.25, 35.07),
        (86.5, 23.38),
        (100.0, 0.0),
    ],
    &[
        (0.0, 0.0),
        (72.0, 0.0),
        (108.0, 12.0),
        (108.0, 28.0),
        (72.0, 40.0),
        (0.0, 40.0),
    ],
    &[
        (0.0, 0.0),
        (10.0, 30.0),
        (40.0, 55.0),
        (70.0, 50.0),
        (95.0, 20.0),
        (100.0, -10.0),
    ],
    &[
        (-574.41, -328.66),
        (-3.62, -57.12),
        (-15.07, -45.66),
        (58.48, 23.53),
        (136.34, 48.79),
        (149.25, 50.34),
        (180.37, 58.29),
        (242.08, 3.62),
        (255.39, -6.99),
        (1251.92, -834.13),
    ],
];

#[test]
fn what_closes_an_arch_goes_no_long_way_round_and_does_not_cross() {
    for arch in ARCHES {
        let points = arch.iter().map(|(x, y)| DVec3::new(*x, *y, 0.0)).collect();
        let polygon = match arch.len() {
            6 => BezierPolygon::new(5, points, None).expect("one").to_float(),
            _ => FloatPolygon::new(5, points, None, false),
        };
        let polygon = polygon.expect("a polygon");
        let [start, end] = End::BOTH.map(|end| polygon.end_jet(end).point);
        let runner = Runner::of(polygon);
        let report = runner.report("close", &[]);
        let (outcome, curves) = runner.done("close", &[]);
        let told = report.text();
        let [from, to] = outcome.joint.expect("a bridge or a blend");
        let length = arc_length_between(&curves[0].polygon, from, to, 1e-3);
        assert!(length <= 6.0 * start.distance(end), "{told}");
        assert_eq!(curve_crossing(&curves[0].polygon), None, "{told}");
    }
}

/// A straight line from one point to another.
fn line(name: &str, from: [f64; 2], to: [f64; 2]) -> Curve {
    let [from, to] = [from, to].map(|[x, y]| DVec3::new(x, y, 0.0));
    let vertices = (-1..=6).map(|index| from.lerp(to, f64::from(index) / 5.0));
    let polygon = FloatPolygon::new(3, vertices.collect(), None, false).expect("a polygon");
    Curve::new(name, polygon)
}

#[test]
fn of_ends_as_near_those_are_joined_that_point_at_each_other() {
    let first = line("first", [0.0, 0.0], [5.0, 0.0]);
    for (second, ends) in [
        // Nearest alone decides.
        (line("second", [7.0, 1.0], [12.0, 1.0]), ["end", "start"]),
        (line("second", [12.0, 1.0], [7.0, 1.0]), ["end", "end"]),
        (line("second", [-2.0, 1.0], [-7.0, 1.0]), ["start", "start"]),
        (line("second", [-7.0, 1.0], [-2.0, 1.0]), ["start", "end"]),
        // Side by side, at the same distance: neither turns round.
        (line("second", [5.0, 2.0], [0.0, 2.0]), ["end", "start"]),
        // A rail that is tilted at its ends alone: both ends are 3 off, and the start of the second points on.
        (line("second", [5.0, 3.0], [5.0, 9.0]), ["end", "start"]),
        // 3 from both ends of the first, along it and across it.
        (line("second", [8.0, 0.0], [-0.0, 3.0]), ["end", "start"]),
        (line("second", [5.0, 3.0], [-3.0, 0.0]), ["start", "end"]),
    ] {
        let document = Document::from_curves([first.clone(), second.clone()]);
        let (_, _, report) = join(&document, &[("bridge", Value::List(vec![4.0]))]);
        let json: Json = serde_json::to_value(&report).expect("a report");
        let expected = json!({ "first": ends[0], "second": ends[1] });
        assert_eq!(json["joined"], expected, "{:?}", second.polygon);
    }
}

#[test]
fn a_curve_is_not_joined_with_itself() {
    let first = arc("first", 4, 0.0, 60.0);
    let refusal = |second: FloatPolygon, given: &[(&str, Value)]| {
        let document = Document::from_curves([first.clone(), Curve::new("second", second)]);
        let input = Operands::new(&document, document.ids()).expect("two curves");
        let join = operation("join");
        let values = join.values(&input, given.iter().cloned()).expect("values");
        join.run(&input, &values, &Progress::default()).err()
    };
    for copy in [first.polygon.clone(), first.polygon.reversed()] {
        let refused = refusal(copy.clone(), &[]).expect("refused").to_string();
        assert!(refused.contains("close the curve"), "{refused}");
        // A copy that moves goes on from the curve.
        let moving = [("move-second", Value::Switch(true))];
        assert_eq!(refusal(copy, &moving), None);
    }
}

/// A spiral that turns by 290° to its tight end; mirrored where `sense` is −1.
fn spiral(name: &str, sense: f64) -> Curve {
    let vertices = (0..14).map(|index| {
        let angle = 0.4 * f64::from(index);
        10.0 * (-0.25 * angle).exp() * DVec3::new(angle.cos(), sense * angle.sin(), 0.0)
    });
    let polygon = FloatPolygon::new(4, vertices.collect(), None, false);
    Curve::new(name, polygon.expect("a polygon"))
}

#[test]
fn a_second_curve_that_moves_does_not_cross_the_first_unless_told() {
    let joined = |second: Curve| {
        let document = Document::from_curves([spiral("first", 1.0), second]);
        let given = [
            ("first-end", Value::Choice(2)),
            ("second-end", Value::Choice(2)),
            ("move-second", Value::Switch(true)),
        ];
        let (outcome, after, report) = join(&document, &given);
        let crosses = curve_crossing(&only(&after).polygon).is_some();
        (outcome.reached, crosses, report.text())
    };
    // Both bend to one side: in by one spiral, out by the other.
    let (reached, crosses, told) = joined(spiral("second", -1.0));
    assert!(crosses && !reached, "{told}");
    assert!(told.contains("crosses itself now"), "{told}");
    // The other way round the composite is an S.
    let (reached, crosses, told) = joined(spiral("second", 1.0));
    assert!(!crosses && reached, "{told}");
}

#[test]
fn a_match_by_which_the_composite_would_follow_itself_is_dropped_on_demand() {
    let [first, second] = [arc("first", 4, 0.0, 60.0), arc("second", 4, 100.0, 160.0)];
    let mut document = Document::from_curves([first, second, arc("third", 3, 160.0, 200.0)]);
    let ids: Vec<_> = document.ids().collect();
    let follow = |curve, source, place| {
        Edit::SetMatch(EndMatch {
            curve,
            end: End::Finish,
            source,
            place,
            continuity: Continuity::G0,
            reversed: false,
        })
    };
    for edit in [
        follow(ids[1], ids[2], MatchPlace::End(End::Start)),
        follow(ids[2], ids[0], MatchPlace::Parameter(1.0)),
    ] {
        document.apply(edit).expect("a match");
    }
    let join = operation("join");
    let input = Operands::new(&document, ids[..2].iter().copied()).expect("two curves");
    let run = |drops| {
        let values = join.values(&input, [("drop-match", Value::Switch(drops))]);
        join.run(&input, &values.expect("values"), &Progress::default())
    };
    let refused = run(false).expect_err("a circle").to_string();
    assert_eq!(
        refused,
        "“first” would follow “third”, which follows it: “Drop match” (--drop-match) drops that match"
    );
    let outcome = run(true).expect("a composite");
    let after = outcome.applied_to(&document).expect("edits");
    assert_eq!(after.match_of(ids[0], End::Finish), None);
    let kept = after.match_of(ids[2], End::Finish).expect("a match");
    assert_eq!(kept.source, ids[0]);
    let told = "“first” does not follow “third”, which follows it";
    assert!(
        outcome.remarks.iter().any(|it| it == told),
        "{:?}",
        outcome.remarks
    );
}

/// A curve cut in two, the second part changed at the joint so that the ends meet with some continuity.
fn cut_arc(random: &mut Random, degree: usize, level: Continuity) -> [Curve; 2] {
    cut(random, degree, level, Lies::Plane)
}

/// Where a curve lies, and whether it has weights.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Lies {
    Plane,
    PlaneRational,
    Space,
    SpaceRational,
}

fn cut(random: &mut Random, degree: usize, level: Continuity, lies: Lies) -> [Curve; 2] {
    let count = 2 * degree + 8 + (random.bits() % 12) as usize;
    let (mut angle, mut turn) = (random.between(-1.0, 1.0), random.between(0.02, 0.15));
    let growth = random.between(-0.006, 0.01);
    let mut place = DVec3::ZERO;
    let vertices: Vec<DVec3> = (0..count)
        .map(|_| {
            place += DVec3::new(angle.cos(), angle.sin(), 0.0);
            angle += turn;
            turn += growth;
            if matches!(lies, Lies::Space | Lies::SpaceRational) {
                place.z += 0.4 * (0.2 * place.x).cos();
            }
            place
        })
        .collect();
    let is_rational = matches!(lies, Lies::PlaneRational | Lies::SpaceRational);
    let weights = (0..count).map(|index| 1.0 + 0.3 * (0.3 * index as f64).sin());
    let weights = is_rational.then(|| weights.collect());
    let whole = FloatPolygon::new(degree, vertices, weights, false).expect("a polygon");
    let at = (whole.segments() / 2) as f64;
    let (first, second) = whole.split(at, 0).expect("two parts");
    let (first, mut second) = (first.polygon, second.polygon);
    // Scale about the joint: the direction stays, the curvature jumps.
    if level == Continuity::G1 {
        let joint = second.end_jet(End::Start).point;
        let factor = random.between(0.7, 1.4);
        let moves = second.vertices().iter().enumerate();
        let moves = moves.map(|(index, vertex)| (index, joint + factor * (*vertex - joint)));
        let moves: Vec<(usize, DVec3)> = moves.collect();
        second.move_vertices(moves).expect("in range");
    }
    [Curve::new("first", first), Curve::new("second", second)]
}

fn text<'a>(report: &'a Report, name: &str) -> &'a str {
    match report.figure(name) {
        Some(Value::Word(word)) => word,
        other => panic!("{name}: {other:?}"),
    }
}

/// How far points of two curves are from another one, at most.
fn farthest(parts: [&FloatPolygon; 2], merged: &FloatPolygon) -> f64 {
    let dense: Vec<DVec3> = (0..=200 * merged.segments())
        .map(|step| merged.point(step as f64 / 200.0))
        .collect();
    let mut most = 0.0_f64;
    for part in parts {
        for step in 0..=40 * part.segments() {
            let at = part.point(step as f64 / 40.0);
            let legs = dense.windows(2);
            let off = legs.map(|leg| {
                let way = leg[1] - leg[0];
                let along = (at - leg[0]).dot(way) / way.length_squared();
                at.distance(leg[0] + along.clamp(0.0, 1.0) * way)
            });
            most = most.max(off.fold(f64::INFINITY, f64::min));
        }
    }
    most
}

/// Merge pairs of curves that meet smoothly; says how many are merged.
fn check_merged(count: usize, lies: Lies) -> usize {
    let mut refused = 0;
    let mut random = Random(5);
    let mut added = [0; 3];
    for trial in 0..count {
        let degree = 3 + trial % 4;
        let level = [Continuity::G1, Continuity::G3][trial / 4 % 2];
        let curves = cut(&mut random, degree, level, lies);
        let document = Document::from_curves(curves.clone());
        let (outcome, after, report) = join(&document, &[]);
        let told = format!(
            "trial {trial}: degree {degree}, {level:?}, {lies:?}: {}",
            report.text()
        );
        if text(&report, "method") != "merge" {
            println!("{told}");
            refused += 1;
            continue;
        }
        assert!(outcome.reached, "{told}");
        let merged = only(&after);
        assert_eq!(merged.name, "first", "{told}");
        let parts = [&curves[0].polygon, &curves[1].polygon];
        let size = parts.map(|it| it.size()).into_iter().fold(0.0, f64::max);
        let off = farthest(parts, &merged.polygon);
        assert!(off <= 1e-4 * size, "{told}: {off:e}");
        let extrema =
            |polygon: &FloatPolygon| Features::new(polygon).count(Feature::CurvatureExtremum);
        let own = extrema(parts[0]) + extrema(parts[1]);
        let now = extrema(&merged.polygon);
        assert!((own..=own + 2).contains(&now), "{told}: {own} to {now}");
        added[now - own] += 1;
        for (part, end) in [(parts[0], End::Start), (parts[1], End::Finish)] {
            let [a, b] = [part, &merged.polygon].map(|it| it.end_jet(end));
            assert!(a.point.distance(b.point) <= 1e-9 * size, "{told}");
            let turned = a.first.normalize().cross(b.first.normalize()).length();
            assert!(turned <= 1e-9, "{told}");
        }
    }
    println!("{lies:?}: extrema added 0, 1, 2: {added:?}, not merged: {refused}");
    count - refused
}

#[test]
fn curves_that_meet_smoothly_are_merged_within_the_tolerance() {
    for lies in [Lies::Plane, Lies::PlaneRational, Lies::Space] {
        assert_eq!(check_merged(8, lies), 8, "{lies:?}");
    }
    // The others are chained.
    assert!(check_merged(8, Lies::SpaceRational) >= 6);
}

#[test]
#[ignore = "takes minutes"]
fn three_hundred_pairs_are_merged() {
    for lies in [Lies::Plane, Lies::PlaneRational] {
        assert_eq!(check_merged(300, lies), 300, "{lies:?}");
    }
    for lies in [Lies::Space, Lies::SpaceRational] {
        let merged = check_merged(100, lies);
        assert!(merged >= 80, "{lies:?}: {merged} of 100");
    }
}

#[test]
fn a_chain_that_stretches_the_second_curve_is_a_warning() {
    for (start, is_told) in [(20.5, false), (50.0, true)] {
        let document = Document::from_curves([
            line("a", [0.0, 0.0], [20.0, 0.0]),
            line("b", [start, 1.0], [start + 20.0, 5.0]),
        ]);
        let (_, _, report) = join(&document, &[("method", Value::Choice(3))]);
        assert_eq!(text(&report, "method"), "chain");
        let told = report
            .warnings
            .iter()
            .any(|it| it.contains("% of its size"));
        assert_eq!(told, is_told, "{}", report.text());
    }
}

#[test]
fn a_chain_that_throws_the_second_curve_is_reached_only_where_it_is_asked_for() {
    let arch = (-2..13).map(|index| {
        let t = 0.1 * f64::from(index);
        (100.0 * t, 25.0 * (0.9 * PI * t).sin())
    });
    let bow = [
        (90.0, -60.0),
        (92.0, -40.0),
        (100.0, -30.0),
        (110.5, -21.6),
        (116.7, 0.0),
        (116.7, 16.0),
        (108.0, 35.0),
        (100.0, 47.4),
        (85.0, 65.0),
        (75.0, 75.0),
    ];
    let arch: Vec<(f64, f64)> = arch.collect();
    let curves = [("arch", &arch[..]), ("bow", &bow)].map(|(name, points)| {
        Curve::new(name, FloatPolygon::planar(5, points).expect("a polygon"))
    });
    let document = Document::from_curves(curves);
    for (given, reached) in [(vec![], false), (vec![("method", Value::Choice(3))], true)] {
        let (outcome, _, report) = join(&document, &given);
        assert_eq!(text(&report, "method"), "chain");
        assert_eq!(outcome.reached, reached, "{}", report.text());
        assert!(
            report.warnings[0].contains("% of its size"),
            "{}",
            report.text()
        );
    }
}

#[test]
fn of_ends_about_as_close_those_that_point_at_each_other_are_joined() {
    // The start of the second lies ahead of the first, its end beside, 10 away.
    for (ahead, end) in [(10.4, "start"), (11.5, "end")] {
        let document = Document::from_curves([
            line("a", [-20.0, 0.0], [0.0, 0.0]),
            line("b", [ahead, 0.0], [9.0, 19.0_f64.sqrt()]),
        ]);
        let (_, _, report) = join(&document, &[("method", Value::Choice(3))]);
        let joined = format!("Joined: end of the first and {end} of the second");
        assert!(
            report.text().contains(&joined),
            "{ahead}: {}",
            report.text()
        );
    }
}

#[test]
fn a_corner_is_chained_and_not_merged() {
    let document = Document::from_curves([
        line("first", [0.0, 0.0], [10.0, 0.0]),
        line("second", [10.0, 0.0], [14.0, 8.0]),
    ]);
    let (outcome, after, report) = join(&document, &[]);
    assert_eq!(text(&report, "method"), "chain");
    assert!(outcome.reached, "{}", report.text());
    assert_eq!(after.curves().len(), 2);
    let input = Operands::new(&document, document.ids().take(2)).expect("two curves");
    let operation = operation("join");
    let values = operation.values(&input, [("method", Value::Choice(1))]);
    let refused = operation.run(&input, &values.expect("values"), &Progress::default());
    let refused = refused.expect_err("a corner").to_string();
    assert!(
        refused.contains("corner of 63.4°") && refused.contains("Chain"),
        "{refused}"
    );
}

/// A curve turned about its start and moved, both in the plane.
fn placed(curve: &Curve, angle: f64, by: DVec3) -> Curve {
    let from = curve.polygon.point(0.0);
    let turned = DQuat::from_rotation_z(angle);
    let moves = curve.polygon.vertices().iter().enumerate();
    let moves = moves.map(|(index, vertex)| (index, from + turned * (*vertex - from) + by));
    let moves: Vec<(usize, DVec3)> = moves.collect();
    let mut polygon = curve.polygon.clone();
    polygon.move_vertices(moves).expect("in range");
    Curve::new("second", polygon)
}

#[test]
fn a_small_corner_and_a_gap_are_merged_within_the_tolerance_that_is_told() {
    let mut random = Random(11);
    // A corner in degrees, and the second curve's move along and across, in shares of the size.
    let places = [
        (4.6, 0.01, 0.008),
        (-3.0, 0.0, 0.0),
        (8.0, -0.012, 0.004),
        (-12.0, 0.002, -0.01),
    ];
    for (degrees, along, across) in places {
        let [first, second] = cut_arc(&mut random, 4, Continuity::G3);
        let size = first.polygon.size().max(second.polygon.size());
        let ahead = first.polygon.end_jet(End::Finish).tangent().expect("one");
        let by = size * (along * ahead + across * DVec3::Z.cross(ahead));
        let second = placed(&second, f64::to_radians(degrees), by);
        let parts = [first.polygon.clone(), second.polygon.clone()];
        let document = Document::from_curves([first, second]);
        let ends = [
            ("method", Value::Choice(1)),
            ("first-end", Value::Choice(2)),
            ("second-end", Value::Choice(1)),
        ];
        let (missed, _, report) = join(&document, &ends);
        let told = format!("{degrees}°: {}", report.text());
        assert!(!missed.reached, "{told}");
        let mut remarks = report.remarks.iter();
        let possible = remarks.find_map(|it| {
            let number = it.strip_prefix("A merge within ")?;
            let (number, _) = number.split_once(" is possible")?;
            number.parse::<f64>().ok()
        });
        let possible = possible.unwrap_or_else(|| panic!("{told}"));
        assert!(possible <= 0.03 * size, "{told}");

        let within = [&ends[..], &[("tolerance", Value::List(vec![possible]))]].concat();
        let (merged, after, report) = join(&document, &within);
        let told = format!("{degrees}°: {}", report.text());
        assert!(merged.reached, "{told}");
        let polygon = &only(&after).polygon;
        let off = farthest(parts.each_ref(), polygon);
        assert!(off <= possible, "{told}: {off} of {possible}");
        let extrema =
            |polygon: &FloatPolygon| Features::new(polygon).count(Feature::CurvatureExtremum);
        let own: usize = parts.iter().map(extrema).sum();
        assert!(extrema(polygon) <= own + 2, "{told}");
        assert_eq!(curve_crossing(polygon), None, "{told}");
    }
}

/// Two parts of a curve, the second one moved ahead by 2 % of the polygon's size.
fn parted(random: &mut Random) -> [Curve; 2] {
    let [first, mut second] = cut_arc(random, 5, Continuity::G3);
    let jet = first.polygon.end_jet(End::Finish);
    let gap = 0.02 * first.polygon.size() * jet.tangent().expect("one");
    let moves = second.polygon.vertices().iter().enumerate();
    let moves = moves.map(|(index, vertex)| (index, *vertex + gap));
    let moves: Vec<(usize, DVec3)> = moves.collect();
    second.polygon.move_vertices(moves).expect("in range");
    [first, second]
}

/// The size of the larger one.
fn size_of(curves: &[Curve; 2]) -> f64 {
    let sizes = curves.each_ref();
    let sizes = sizes.map(|it| BezierPolygon::from_float(&it.polygon).size());
    sizes[0].max(sizes[1])
}

#[test]
fn a_bridge_that_goes_a_long_way_round_is_told_or_merged_instead() {
    let mut random = Random(8);
    for trial in 0..6 {
        let curves = parted(&mut random);
        let most = 1e-3 * size_of(&curves);
        let document = Document::from_curves(curves);
        let (outcome, _, report) = join(&document, &[]);
        let told = format!("trial {trial}: {}", report.text());
        // A blend keeps both curves; a merge says that it moves them.
        let is_told = match text(&report, "method") {
            "blend" => matches!(outcome.deviation, Deviation::AtMost(moved) if moved <= most),
            "merge" => told.contains("Merged: no plain bridge fits the gap"),
            _ => false,
        };
        assert!(outcome.reached && is_told, "{told}");
        let (bridged, _, report) = join(&document, &[("method", Value::Choice(2))]);
        let told = report.text();
        let said = match bridged.reached {
            true => "Each segment became",
            false => "A bridge is ",
        };
        assert!(told.contains(said), "{told}");
    }
}

#[test]
fn a_gap_of_one_segment_is_bridged_by_halved_segments() {
    let mut random = Random(3);
    for degree in 3..=6 {
        let [first, second] = cut_arc(&mut random, degree, Continuity::G3);
        let parts = [&first.polygon, &second.polygon];
        let mut short = parts[1].split(1.0, 0).expect("two parts").1.polygon;
        // Too little to be seen, and enough that the parts share no vertex.
        let nudged = 1e-9 * DVec3::X;
        let moves = short.vertices().iter().map(|vertex| *vertex + nudged);
        let moves: Vec<(usize, DVec3)> = moves.enumerate().collect();
        short.move_vertices(moves).expect("in range");
        let follower = arc("third", degree, 0.0, 60.0);
        let curves = [first.clone(), Curve::new("second", short), follower];
        let mut document = Document::from_curves(curves);
        let ids: Vec<_> = document.ids().collect();
        let third = ids[2];
        let matched = EndMatch {
            curve: third,
            end: End::Start,
            source: ids[1],
            place: MatchPlace::Parameter(1.5),
            continuity: Continuity::G0,
            reversed: false,
        };
        document.apply(Edit::SetMatch(matched)).expect("an edit");
        let second = document.curve(ids[1]).expect("a curve").polygon.clone();
        let (outcome, after, report) = join(&document, &[("method", Value::Choice(2))]);
        let told = format!("degree {degree}: {}", report.text());
        assert!(
            outcome.reached && told.contains("Each segment became"),
            "{told}"
        );
        let found = &after.curve(ids[0]).expect("a curve").polygon;
        let size = found.size();
        // Both parts stay, with their parameters running faster.
        let halved = |part: &FloatPolygon, from_start: bool| {
            let most = found.segments() as f64 / part.segments() as f64;
            let near = |pace: f64| {
                let begin = match from_start {
                    true => 0.0,
                    false => found.segments() as f64 - pace * part.segments() as f64,
                };
                (0..=8).all(|step| {
                    let u = f64::from(step) / 8.0 * part.segments() as f64;
                    found.point(begin + pace * u).distance(part.point(u)) <= 1e-12 * size
                })
            };
            [2.0, 4.0, 8.0, 16.0]
                .into_iter()
                .filter(|it| *it <= most)
                .find(|pace| near(*pace))
        };
        let paces = [halved(parts[0], true), halved(&second, false)];
        assert!(paces[0].is_some() && paces[0] == paces[1], "{told}");
        // It is about where the curve was that lies between them.
        let gap = parts[1].point(0.0).distance(parts[1].point(1.0));
        let off = farthest([parts[1], parts[0]], found);
        assert!(off <= 0.05 * gap, "{told}: {off:e} {gap}");
        let start = after
            .curve(third)
            .expect("a curve")
            .polygon
            .end_jet(End::Start);
        assert!(
            start.point.distance(second.point(1.5)) <= 1e-9 * size,
            "{told}"
        );
    }
}

#[test]
fn ends_that_meet_are_not_bridged_by_a_loop() {
    let mut random = Random(4);
    let curves = cut_arc(&mut random, 5, Continuity::G1);
    let document = Document::from_curves(curves);
    let (outcome, _, report) = join(&document, &[("method", Value::Choice(2))]);
    assert!(!outcome.reached, "{}", report.text());
    assert!(report.text().contains("A bridge is "), "{}", report.text());
}

#[test]
fn a_corner_stays_in_a_chain_unless_it_is_asked_for() {
    let document = Document::from_curves([
        arc("first", 4, 0.0, 60.0),
        line("second", [5.0, 0.0], [20.0, 0.0]),
    ]);
    let ends = [
        ("first-end", Value::Choice(2)),
        ("second-end", Value::Choice(1)),
    ];
    let automatic = [&ends[..], &[("method", Value::Choice(3))]].concat();
    let (outcome, after, report) = join(&document, &automatic);
    assert!(
        outcome.reached && report.text().contains("up to G0"),
        "{}",
        report.text()
    );
    let [before, now] = [&document, &after].map(|document| {
        let id = document.ids().nth(1).expect("two curves");
        document
            .curve(id)
            .expect("a curve")
            .polygon
            .end_jet(End::Start)
    });
    let turned = before
        .first
        .normalize()
        .cross(now.first.normalize())
        .length();
    assert!(turned <= 0.5, "{turned}");
    let asked = [&automatic[..], &[("continuity", Value::Choice(2))]].concat();
    let (_, _, report) = join(&document, &asked);
    assert!(report.text().contains("up to G1"), "{}", report.text());
}

#[test]
fn merging_keeps_what_follows_the_curves_and_refuses_locked_vertices() {
    let mut random = Random(2);
    let [first, second] = cut_arc(&mut random, 4, Continuity::G3);
    let at = second.polygon.point(2.0);
    let follower = line("follower", [at.x, at.y], [at.x, at.y + 3.0]);
    let mut document = Document::from_curves([first, second, follower]);
    let ids: Vec<_> = document.ids().collect();
    let matched = EndMatch {
        curve: ids[2],
        end: End::Start,
        source: ids[1],
        place: MatchPlace::Parameter(2.0),
        continuity: Continuity::G0,
        reversed: false,
    };
    document.apply(Edit::SetMatch(matched)).expect("an edit");
    let (_, after, _) = join(&document, &[]);
    let kept = after.match_of(ids[2], End::Start).expect("a match");
    assert_eq!(kept.source, ids[0]);
    let start = after
        .curve(ids[2])
        .expect("a curve")
        .polygon
        .end_jet(End::Start);
    assert!(start.point.distance(at) <= 1e-3, "{}", start.point);
    let lock = Edit::SetVerticesLocked {
        curve: ids[0],
        vertices: vec![3],
        locked: true,
    };
    document.apply(lock).expect("an edit");
    let (_, _, report) = join(&document, &[]);
    assert_eq!(text(&report, "method"), "chain");
}

#[test]
fn a_short_curve_beside_the_end_of_a_long_one_is_merged_in_either_order() {
    // A fit to a scan, and a short curve that goes on 12 below its end: a bridge is a loop or a knuckle.
    let scan = [
        (-28.9, -9.2),
        (-27.0, -17.7),
        (-12.2, -6.3),
        (55.0, 32.5),
        (106.4, 45.6),
        (153.6, 34.9),
        (186.4, 21.9),
        (279.5, -30.6),
        (330.2, -141.1),
    ];
    let short = [(188.7, 17.6), (203.2, -0.6), (225.0, -11.5), (246.8, -7.8)];
    let long = FloatPolygon::planar(5, &scan).expect("a polygon");
    let short = FloatPolygon::planar(3, &short).expect("a polygon");
    let size = BezierPolygon::from_float(&long).size();
    for parts in [[&long, &short], [&short, &long]] {
        let curves = parts.map(|polygon| Curve::new("part".to_owned(), polygon.clone()));
        let (outcome, after, report) = join(&Document::from_curves(curves), &[]);
        assert!(outcome.reached, "{}", report.text());
        assert_eq!(text(&report, "method"), "merge");
        let merged = &only(&after).polygon;
        let extrema = Features::new(merged).count(Feature::CurvatureExtremum);
        assert!(extrema <= 2 + 2, "{extrema} {}", report.text());
        assert_eq!(curve_crossing(merged), None);
        assert!(merged.vertices().len() <= 30, "{}", merged.vertices().len());
        let (Deviation::AtMost(moved) | Deviation::Measured(moved)) = outcome.deviation else {
            panic!("{:?}", outcome.deviation);
        };
        assert!(moved <= 0.01 * size, "{moved}");
    }
}

#[test]
fn a_blend_of_arches_that_meet_in_a_nose_bends_to_one_side() {
    let upper = [
        (-148.78442098275337, -86.39257231499809),
        (-74.87759494796592, -41.387918667054336),
        (0.7550434125845413, -0.6982048764401938),
        (73.3569651532714, 43.72243852257673),
        (148.77243971450895, 73.2278827376406),
        (230.6209274612029, 71.23786869569514),
        (298.8428502058479, 43.589314687483665),
        (370.74099619598377, 16.868353214834784),
        (449.10257981269694, -3.7377185101736785),
    ];
    let lower = [
        (291.7, 153.9),
        (309.7, 73.6),
        (308.2, 15.5),
        (287.2, -20.7),
        (249.1, -36.1),
        (202.6, -36.1),
        (158.4, -26.9),
        (121.7, -11.6),
        (93.6, 9.1),
        (74.2, 35.2),
    ];
    let polygons = [&upper[..], &lower].map(|it| FloatPolygon::planar(5, it).expect("a polygon"));
    let [first, second] = &polygons;
    let inflections = |polygon: &FloatPolygon| {
        let features = Features::proved(polygon, |_| true).expect("features");
        features.count(Feature::Inflection)
    };
    // That of the least energy is a bulb with two inflections.
    assert_eq!(inflections(&blend(first, second).expect("a blend")), 0);
    // Without a limit of time the result is the same on every machine.
    let tolerance = 1e-4 * BezierPolygon::from_float(first).size();
    let nose = merge_blended(first, second, tolerance, &Progress::default()).expect("a nose");
    assert!(nose.bounded && nose.deviation <= tolerance, "{nose:?}");
    assert_eq!([inflections(&nose.polygon), nose.waves], [0, 0]);
    assert!(nose.extrema[1] <= 8, "{:?}", nose.extrema);
    assert_eq!(curve_crossing(&nose.polygon), None);
}

#[test]
fn a_blend_leaves_both_curves_within_what_it_tells() {
    let mut random = Random(8);
    for trial in 0..3 {
        let curves = parted(&mut random);
        let polygons = curves.each_ref().map(|curve| curve.polygon.clone());
        let size = size_of(&curves);
        let document = Document::from_curves(curves);
        let blend = ("method", Value::Choice(4));
        let (outcome, after, report) = join(&document, std::slice::from_ref(&blend));
        let told = format!("trial {trial}: {}", report.text());
        assert_eq!(text(&report, "method"), "blend", "{told}");
        let Deviation::AtMost(most) = outcome.deviation else {
            panic!("{told}");
        };
        assert!(outcome.reached && most <= 1e-3 * size, "{told}");
        let blended = &only(&after).polygon;
        let off = farthest([&polygons[0], &polygons[1]], blended);
        assert!(off <= most * (1.0 + 1e-6), "{off} {told}");
        assert_eq!(curve_crossing(blended), None, "{told}");
        for (end, part) in [(End::Start, 0), (End::Finish, 1)] {
            let [own, other] = [&polygons[part], blended].map(|it| it.end_jet(end));
            assert!(own.point.distance(other.point) <= 1e-9 * size, "{told}");
            assert!(own.first.angle_between(other.first) <= 1e-7, "{told}");
        }
        // With a tolerance that nothing keeps, it says what is possible.
        let given = [blend, ("tolerance", Value::List(vec![1e-9 * size]))];
        let (outcome, _, report) = join(&document, &given);
        let told = format!("trial {trial}: {}", report.text());
        assert!(!outcome.reached, "{told}");
        assert!(told.contains("A blend within "), "{told}");
    }
}

#[test]
fn a_given_tolerance_holds_across_a_gap_too() {
    let mut random = Random(8);
    let curves = parted(&mut random);
    let most = 1e-3 * size_of(&curves);
    let document = Document::from_curves(curves);
    let given = [("tolerance", Value::List(vec![most]))];
    let (outcome, _, report) = join(&document, &given);
    let is_kept = match (text(&report, "method"), outcome.deviation) {
        // Both stay, and the second is told to move.
        ("bridge" | "chain", _) => true,
        (_, Deviation::AtMost(moved)) => moved <= most,
        _ => false,
    };
    assert!(is_kept, "{}", report.text());
}

#[test]
fn ends_that_meet_or_leave_a_small_gap_close_near_the_curve() {
    // A circle of four arcs with the usual handles, and one with a gap.
    let handle = 55.23;
    let quarter = |turn: f64| {
        let turned = DQuat::from_rotation_z(turn.to_radians());
        let points = [(100.0, 0.0), (100.0, handle), (handle, 100.0), (0.0, 100.0)];
        let points = points.map(|(x, y)| turned * DVec3::new(x, y, 0.0));
        let bezier = BezierPolygon::new(3, points.to_vec(), None).expect("an arc");
        Curve::new("arc", bezier.to_float().expect("a polygon"))
    };
    let mut document = Document::from_curves([0.0, 90.0, 180.0, 270.0].map(quarter));
    for _ in 0..3 {
        let (outcome, after, report) = join(&document, &[]);
        assert!(outcome.reached, "{}", report.text());
        document = after;
    }
    let whole = document.curves().next().expect("a curve").1.polygon.clone();
    assert_eq!(document.len(), 1);
    let gap = whole
        .trimmed(0.0, whole.segments() as f64 - 1.0, 0)
        .expect("a part")
        .polygon;
    for (open, name) in [(whole, "met"), (gap, "gap")] {
        let runner = Runner::of(open.clone());
        let told = runner.report("close", &[]).text();
        let (_, curves) = runner.done("close", &[]);
        let closed = &curves[0].polygon;
        assert!(closed.is_periodic(), "{name}: {told}");
        assert_eq!(curve_crossing(closed), None, "{name}: {told}");
        // All of it is about as far from the middle.
        let samples = (0..1000).map(|it| f64::from(it) / 1000.0 * closed.segments() as f64);
        for u in samples {
            let radius = closed.point(u).length();
            assert!((radius - 100.0).abs() < 3.0, "{name}: {radius} {told}");
        }
    }
}

#[test]
fn a_small_gap_is_closed_without_a_kink_or_not_at_all() {
    let between = [
        (40.0, 0.0),
        (80.0, 0.0),
        (70.0, 50.0),
        (0.0, 70.0),
        (-60.0, 50.0),
        (-50.0, 0.0),
        (-30.0, 0.0),
    ];
    let gaps = [
        ((0.1, 0.0), (0.0, 0.04), true),
        ((1.0, 0.0), (0.0, 0.1), true),
        ((1.0, 0.0), (0.0, 0.4), false),
        ((5.0, 0.0), (0.0, 0.0), true),
    ];
    for (start, end, must_close) in gaps {
        let points = [&[start], &between[..], &[end]].concat();
        let points = points.iter().map(|(x, y)| DVec3::new(*x, *y, 0.0));
        let clamped = ClampedPolygon::new(3, points.collect(), None).expect("a polygon");
        let open = clamped.to_float().expect("a polygon");
        let runner = Runner::of(open.clone());
        let outcome = runner.run("close", &[]).expect("it can run");
        let told = runner.report("close", &[]).text();
        assert!(outcome.reached || !must_close, "{start:?}: {told}");
        if !outcome.reached {
            continue;
        }
        let after = outcome.applied_to(runner.input.document()).expect("edits");
        let closed = &after.curves().next().expect("a curve").1.polygon;
        let sharpest = |polygon: &FloatPolygon| {
            let samples = (0..=4000).map(|it| f64::from(it) / 4000.0 * polygon.segments() as f64);
            samples
                .map(|u| polygon.jet(u).curvature())
                .fold(0.0, f64::max)
        };
        assert!(
            sharpest(closed) <= 4.0 * sharpest(&open),
            "{start:?}: {told}"
        );
        assert_eq!(curve_crossing(closed), None, "{start:?}: {told}");
    }
}

#[test]
fn a_gap_that_no_bridge_fits_is_closed_by_a_blend() {
    // Fits of a ring whose ends lie beside each other, of an eight with its gap at the crossing, and of an ellipse;
    // with the most extrema, inflections and curvature that closing takes.
    let ring = [
        (-314.468, 40.475),
        (25.783, -131.871),
        (92.788, 27.296),
        (-16.204, 84.072),
        (-83.173, 0.237),
        (-17.88, -84.707),
        (94.08, -32.843),
        (42.449, 140.496),
        (-424.956, 80.672),
    ];
    let eight = [
        (-123.884, -107.063),
        (-33.345, -38.864),
        (9.439, 12.558),
        (39.548, 37.534),
        (58.489, 27.94),
        (63.572, -6.41),
        (53.38, -35.218),
        (30.427, -32.095),
        (0.44, -0.573),
        (-30.912, 32.964),
        (-54.099, 34.865),
        (-63.766, 4.662),
        (-57.802, -29.72),
        (-37.74, -36.758),
        (-8.352, -10.22),
        (27.157, 30.115),
        (165.337, 161.821),
    ];
    let ellipse = [
        (5.864, 1.846),
        (68.363, -43.737),
        (130.692, 2.922),
        (62.451, 43.746),
        (-47.826, 44.942),
        (-114.266, 14.269),
        (-102.281, -23.849),
        (-26.909, -45.955),
        (65.817, -39.64),
        (122.67, -6.087),
        (90.663, 44.225),
        (-152.715, 88.549),
    ];
    // A half circle, whose bridge has a lump.
    let half = [
        (17.132, -48.591),
        (44.301, -33.132),
        (55.429, 0.062),
        (44.415, 32.824),
        (16.787, 52.465),
        (-16.835, 52.439),
        (-44.408, 32.794),
        (-55.436, 0.076),
        (-44.41, -33.383),
        (-16.161, -51.813),
    ];
    let cases = [
        ("half", &half[..], 6, 0, 0.025),
        ("ring", &ring[..], 4, 2, 0.2),
        ("eight", &eight[..], 6, 2, 0.1),
        ("ellipse", &ellipse[..], 4, 0, 0.07),
    ];
    for (name, points, extrema, inflections, sharpest) in cases {
        let open = FloatPolygon::planar(5, points).expect("a polygon");
        let runner = Runner::of(open.clone());
        let (_, curves) = runner.done("close", &[]);
        let closed = &curves[0].polygon;
        let features = Features::new(closed);
        assert!(closed.is_periodic(), "{name}");
        assert!(
            features.count(Feature::CurvatureExtremum) <= extrema,
            "{name}"
        );
        assert!(features.count(Feature::Inflection) <= inflections, "{name}");
        let samples = |polygon: &FloatPolygon| {
            let last = polygon.segments() as f64;
            let polygon = polygon.clone();
            (0..=2000).map(move |it| polygon.jet(f64::from(it) / 2000.0 * last))
        };
        let found = samples(closed)
            .map(|jet| jet.curvature())
            .fold(0.0, f64::max);
        assert!(found <= sharpest, "{name}: {found}");
        // It runs along the curve.
        let near: Vec<DVec3> = samples(closed).map(|jet| jet.point).collect();
        for at in samples(&open) {
            let off = near
                .iter()
                .map(|it| it.distance(at.point))
                .fold(f64::INFINITY, f64::min);
            assert!(off < 0.2, "{name}: {off} at {}", at.point);
        }
    }
}

#[test]
fn a_chain_tells_how_far_apart_the_curves_are_not_how_far_points_slide() {
    let second = Curve::new(
        "second",
        FloatPolygon::planar(
            5,
            &(0..9)
                .map(|it| (10.0 * f64::from(it) - 20.0, 0.0))
                .collect::<Vec<_>>(),
        )
        .expect("a line"),
    );
    // It ends on the line, along it, with a curvature.
    let start = second.polygon.end_jet(End::Start).point;
    let arc = (0..12).map(|it| {
        let angle = 0.1 * f64::from(it) - 1.1;
        start + 30.0 * DVec3::new(angle.sin(), angle.cos() - 1.0, 0.0)
    });
    let arc = FloatPolygon::new(5, arc.collect(), None, false).expect("an arc");
    let document = Document::from_curves([Curve::new("first", arc), second.clone()]);
    let given = [
        ("method", Value::Choice(3)),
        ("continuity", Value::Choice(3)),
    ];
    let (outcome, after, report) = join(&document, &given);
    assert_eq!(text(&report, "method"), "chain", "{}", report.text());
    let chained = &after.curves().nth(1).expect("the second").1.polygon;
    let samples = |polygon: &FloatPolygon| -> Vec<DVec3> {
        let last = polygon.segments() as f64;
        (0..=2000)
            .map(|it| polygon.point(f64::from(it) / 2000.0 * last))
            .collect()
    };
    let [own, other] = [samples(&second.polygon), samples(chained)];
    let off = |from: &[DVec3], to: &[DVec3]| {
        let nearest = |at: &DVec3| {
            to.iter()
                .map(|it| it.distance(*at))
                .fold(f64::INFINITY, f64::min)
        };
        from.iter().map(nearest).fold(0.0, f64::max)
    };
    let apart = off(&own, &other).max(off(&other, &own));
    let Deviation::Measured(told) = outcome.deviation else {
        panic!("{:?}", outcome.deviation);
    };
    assert!(
        (told - apart).abs() <= 0.02 * apart + 0.02,
        "{told}, not {apart}"
    );
}
