//! Operations that keep the curve, and dragging the closed S-polygon.

use batten::editor::{Command, HoverScene, Key};
use batten::geometry::{ClampedPolygon, FloatPolygon, rounded_up};
use batten::operations::{Deviation, FeatureCounts, LargestMove, Report, Value};
use glam::{DVec2, DVec3};

use super::script::Script;

/// Rounding of points on a curve, in units of its size.
const ROUNDING: f64 = 1e-13;

/// Where a vertex of the closed S-polygon is on the canvas.
fn at_closed(script: &Script, index: usize) -> DVec2 {
    let clamped = ClampedPolygon::from_float(&script.polygon());
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(clamped.vertices()[index]))
}

#[test]
fn dragging_a_closed_vertex_moves_it_alone_and_the_float_polygon_follows() {
    let mut script = Script::example("arc");
    script.command(Command::ToggleClosedFollow);
    let before = script.polygon();
    let closed = ClampedPolygon::from_float(&before);
    let at = at_closed(&script, 9);
    // A tiny way: the float vertices go hundreds of thousands of times as far.
    script.move_to(at);
    let hover = script.scene().hover.clone();
    assert!(
        matches!(&hover, Some(HoverScene::Handle { text, .. }) if text.contains("float × ")),
        "{hover:?}"
    );
    script.drag(at, at + DVec2::new(5.0, 0.0));
    let after = script.polygon();
    let moved = ClampedPolygon::from_float(&after);
    let way = 5.0 * script.editor.view().viewport().pixel();
    let size = after.size();
    for (index, (a, b)) in closed.vertices().iter().zip(moved.vertices()).enumerate() {
        let expected = if index == 9 { way } else { 0.0 };
        assert!(
            (b.x - a.x - expected).abs() <= ROUNDING * size,
            "vertex {index}"
        );
        assert!((b.y - a.y).abs() <= ROUNDING * size, "vertex {index}");
    }
    // The row of the conversion that the end vertex enters begins with 9! = 362 880.
    let farthest = before.vertices().iter().zip(after.vertices());
    let farthest = farthest.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(farthest > 3e5 * way, "{farthest}");
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
}

#[test]
fn escape_and_locking_keep_the_closed_polygon() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    let at = at_closed(&script, 0);
    script.press(at);
    script.move_to(at + 30.0);
    assert_ne!(script.polygon(), before);
    script.key(Key::Escape);
    assert_eq!(script.polygon(), before);
    script.release(at);
    script.command(Command::ToggleLocked);
    script.drag(at, at + 30.0);
    assert_eq!(script.polygon(), before);
    assert!(script.message().contains("locked"), "{}", script.message());
}

#[test]
fn subdividing_and_extending_keep_the_curve() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    script.operate("subdivide", &[]).expect("the same curve");
    let halved = script.polygon();
    assert_eq!(halved.segments(), 2 * before.segments());
    for step in 0..=40 {
        let u = f64::from(step) / 40.0 * before.segments() as f64;
        let off = halved.point(2.0 * u).distance(before.point(u));
        assert!(off <= ROUNDING * before.size(), "u = {u}: {off:e}");
    }
    script.command(Command::Undo);
    script.operate("extend", &[]).expect("a longer curve");
    let start = [("end", Value::Choice(0))];
    script.operate("extend", &start).expect("a longer curve");
    let longer = script.polygon();
    assert_eq!(longer.segments(), before.segments() + 2);
    assert_eq!(
        &longer.vertices()[1..longer.vertices().len() - 1],
        before.vertices()
    );
}

#[test]
fn one_segment_is_raised_exactly_and_several_come_near() {
    let mut script = Script::example("arc");
    let arc = script.polygon();
    let note = script.operate("elevate-degree", &[]).expect("a degree");
    assert_eq!(script.polygon().degree(), 10);
    assert_eq!(script.trial_report().deviation, Deviation::Exact);
    assert!(note.text.contains(": exact"), "{}", note.text);
    let off = script.polygon().point(0.4).distance(arc.point(0.4));
    assert!(off <= 1e-12 * arc.size(), "{off:e}");
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    let note = script.operate("elevate-degree", &[]).expect("a degree");
    let Deviation::AtMost(bound) = script.trial_report().deviation else {
        panic!("{note:?}");
    };
    let told = format!("the curve moves by at most {}", rounded_up(bound));
    assert!(note.text.contains(&told), "{}", note.text);
    assert!(note.text.contains("double the knots"), "{}", note.text);
    let off = farthest_off(&before, &script.polygon());
    assert!(0.0 < off && off <= bound, "{off:e} {bound:e}");
}

/// How far two curves of equally many segments are apart among even parameters.
fn farthest_off(a: &FloatPolygon, b: &FloatPolygon) -> f64 {
    let last = a.segments() as f64;
    let off = (0..=200).map(|step| {
        let u = f64::from(step) / 200.0 * last;
        a.point(u).distance(b.point(u))
    });
    off.fold(0.0, f64::max)
}

#[test]
fn splitting_at_a_knot_is_exact_and_makes_two_curves() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    let at = |u: f64| [("at", Value::Real(u))];
    let note = script.operate("split", &at(1.0)).expect("the parts");
    let parts: Vec<FloatPolygon> = script
        .editor
        .document()
        .curves()
        .map(|(_, curve)| curve.polygon.clone())
        .collect();
    let degree = before.degree();
    assert_eq!(parts.len(), 2);
    assert_eq!(parts[0].vertices(), &before.vertices()[..degree + 1]);
    assert_eq!(parts[1].vertices(), &before.vertices()[1..]);
    let report = script.trial_report();
    assert_eq!(report.deviation, Deviation::Exact);
    assert!(note.text.contains(": exact"), "{}", note.text);
    let features = report.features.clone().expect("proved features");
    let extrema = |counts: &[FeatureCounts]| -> Vec<usize> {
        counts
            .iter()
            .map(|counts| counts.curvature_extrema)
            .collect()
    };
    assert_eq!(extrema(&features.before), [2]);
    assert_eq!(extrema(&features.after), [1, 1]);
    let summary = report.summary();
    assert!(
        summary.contains("extrema: 2 before, 1 and 1 now"),
        "{summary}"
    );
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    let given = [
        ("from", Value::Real(0.5)),
        ("to", Value::Real(1.75)),
        ("subdivisions", Value::List(vec![2.0])),
    ];
    script.operate("trim", &given).expect("the part");
    assert_eq!(script.trial_report().deviation, Deviation::Exact);
    assert!(script.message().contains(": exact"), "{}", script.message());
    let part = script.polygon();
    let ends = [(0.0, 0.5), (part.segments() as f64, 1.75)];
    for (own, whole) in ends {
        let off = part.point(own).distance(before.point(whole));
        assert!(off <= ROUNDING * before.size(), "{off:e}");
    }
    script.command(Command::Undo);
    let refused = script.operate("split", &at(99.0)).expect_err("no place");
    assert!(refused.0.contains("At u: 99 is out of range"), "{refused}");
    assert_eq!(script.polygon(), before, "there is no such place");
    assert!(
        script
            .editor
            .message()
            .is_some_and(|message| message.is_error)
    );
}

/// The vertex that moves farthest from one polygon to another, and how far.
fn farthest_vertex(before: &FloatPolygon, after: &FloatPolygon) -> LargestMove {
    let moves = before.vertices().iter().zip(after.vertices());
    let moves = moves.enumerate().map(|(vertex, (a, b))| LargestMove {
        distance: a.distance(*b),
        vertex,
    });
    moves
        .reduce(|a, b| if b.distance > a.distance { b } else { a })
        .expect("vertices")
}

#[test]
fn rounding_tells_beforehand_what_it_does() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    let rounding = |report: &Report| match report.figure("rounding") {
        Some(Value::Real(length)) => length,
        other => panic!("{other:?}"),
    };
    script.try_out("round").expect("rounded");
    let float = script.trial_report();
    let moved = rounding(&float);
    assert!(moved <= 0.5e-3 * 2f64.sqrt() && moved > 1e-4, "{moved}");
    let Deviation::AtMost(deviation) = float.deviation else {
        panic!("{float:?}");
    };
    assert!(deviation <= moved && deviation > 0.0);
    let shown = script.polygon();
    assert!(farthest_off(&before, &shown) <= deviation);
    assert_eq!(float.largest_move, Some(farthest_vertex(&before, &shown)));
    script.set("polygon", Value::Choice(1)).expect("the closed");
    let closed = script.trial_report();
    let farthest = closed.largest_move.expect("a move");
    assert_eq!(farthest, farthest_vertex(&before, &script.polygon()));
    // The paper's instability: the float S-polygon moves a thousand times and more as far.
    assert!(farthest.distance > 1e3 * rounding(&closed), "{farthest:?}");
    script.editor.operating().leave();
    assert_eq!(script.polygon(), before);
    script.operate("round", &[]).expect("a rounded curve");
    let rounded = script.polygon();
    assert_eq!(rounded, shown);
    let decimal = |value: f64| (value * 1e3).round() / 1e3;
    let expected = before.vertices().iter();
    let expected: Vec<DVec3> = expected
        .map(|vertex| DVec3::new(decimal(vertex.x), decimal(vertex.y), 0.0))
        .collect();
    assert_eq!(rounded.vertices(), expected);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
}

#[test]
fn why_a_closed_vertex_cannot_go_there_is_told_until_it_can_go_on() {
    let mut script = Script::example("arc");
    let at = at_closed(&script, 9);
    script.press(at);
    script.move_to(at + DVec2::new(5.0, 0.0));
    let shown = script.polygon();
    assert_eq!(script.editor.message(), None);
    script.move_to(DVec2::splat(1e120));
    let message = script.editor.message().expect("why not");
    assert!(message.is_error, "{message:?}");
    assert_eq!(script.polygon(), shown, "what was good stays");
    script.move_to(at + DVec2::new(6.0, 0.0));
    assert_eq!(script.editor.message(), None);
    assert_ne!(script.polygon(), shown);
    script.release(at + DVec2::new(6.0, 0.0));
    assert_eq!(script.steps(), 1);
}
