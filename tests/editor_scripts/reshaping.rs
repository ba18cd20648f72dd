//! Operations that keep the curve, and dragging the closed S-polygon.

use batten::document::Edit;
use batten::editor::{Command, Division, HoverScene, Key};
use batten::geometry::{ClampedPolygon, End, FloatPolygon, PolygonKind};
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
    assert_eq!(script.editor.workspace().history().undo_steps(), 1);
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
    script.command(Command::Subdivide);
    let halved = script.polygon();
    assert_eq!(halved.segments(), 2 * before.segments());
    for step in 0..=40 {
        let u = f64::from(step) / 40.0 * before.segments() as f64;
        let off = halved.point(2.0 * u).distance(before.point(u));
        assert!(off <= ROUNDING * before.size(), "u = {u}: {off:e}");
    }
    script.command(Command::Undo);
    script.command(Command::Extend(End::Finish));
    script.command(Command::Extend(End::Start));
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
    script.command(Command::RaiseCurveDegree);
    assert_eq!(script.polygon().degree(), 10);
    assert!(
        script.message().contains("the curve is the same"),
        "{}",
        script.message()
    );
    let off = script.polygon().point(0.4).distance(arc.point(0.4));
    assert!(off <= 1e-12 * arc.size(), "{off:e}");
    let mut script = Script::example("s-curve");
    script.command(Command::RaiseCurveDegree);
    let message = script.message();
    assert!(message.contains("off the curve by at most"), "{message}");
    assert!(message.contains("double the knots"), "{message}");
}

#[test]
fn splitting_at_a_knot_is_exact_and_makes_two_curves() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    script
        .editor
        .divide(Division::Split(1.0), 0)
        .expect("the parts");
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
    let message = script.message();
    assert!(
        message.contains("extrema: 2 before, 1 and 1 now"),
        "{message}"
    );
    assert_eq!(script.editor.workspace().history().undo_steps(), 1);
    script.command(Command::Undo);
    script
        .editor
        .divide(Division::Trim(0.5, 1.75), 2)
        .expect("the parts");
    assert!(
        script.message().contains("the curve is the same"),
        "{}",
        script.message()
    );
    let part = script.polygon();
    let ends = [(0.0, 0.5), (part.segments() as f64, 1.75)];
    for (own, whole) in ends {
        let off = part.point(own).distance(before.point(whole));
        assert!(off <= ROUNDING * before.size(), "{off:e}");
    }
    script.command(Command::Undo);
    assert!(script.editor.divide(Division::Split(99.0), 0).is_err());
    assert_eq!(script.polygon(), before, "there is no such place");
    assert!(
        script
            .editor
            .message()
            .is_some_and(|message| message.is_error)
    );
}

#[test]
fn rounding_tells_beforehand_what_it_does() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    let float = script
        .editor
        .try_rounding(PolygonKind::Float, 3)
        .expect("rounded");
    assert!(float.moved <= 0.5e-3 * 2f64.sqrt() && float.moved > 1e-4);
    assert!(float.deviation <= float.moved && float.deviation > 0.0);
    let closed = script
        .editor
        .try_rounding(PolygonKind::Clamped, 3)
        .expect("rounded");
    // The paper's instability: the float S-polygon moves a thousand times and more as far.
    assert!(
        closed.float_moved > 1e3 * closed.moved,
        "{}",
        closed.float_moved
    );
    script
        .editor
        .round(PolygonKind::Float, 3)
        .expect("a rounded curve");
    let rounded = script.polygon();
    assert_eq!(rounded, float.polygon);
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
    assert_eq!(script.editor.workspace().history().undo_steps(), 1);
}

#[test]
fn a_periodic_curve_says_why_its_closed_polygon_cannot_be_dragged() {
    let mut script = Script::example("periodic");
    let before = script.polygon();
    let at = at_closed(&script, 0);
    script.drag(at, at + 40.0);
    assert_eq!(script.polygon(), before);
    assert!(
        script.message().contains("periodic"),
        "{}",
        script.message()
    );
}

#[test]
fn rounding_and_dividing_prove_no_more_than_a_frame_has_time_for() {
    // More segments than are proved at once, and few enough for the former limit on dividing.
    let points: Vec<(f64, f64)> = (0..990)
        .map(|i| (f64::from(i), 10.0 * (0.05 * f64::from(i)).sin()))
        .collect();
    let weights = (0..990).map(|i| 1.0 + 0.1 * f64::from(i % 3)).collect();
    let planar = FloatPolygon::planar(3, &points).expect("a polygon");
    let vertices = planar.vertices().to_vec();
    let polygon = FloatPolygon::new(3, vertices, Some(weights), false).expect("a polygon");
    let mut script = Script::example("arc");
    let curve = script.curve();
    let edit = Edit::SetPolygon { curve, polygon };
    script.editor.apply("long", vec![edit]).expect("an edit");
    let mut report = script
        .editor
        .try_rounding(PolygonKind::Float, 2)
        .expect("rounded");
    assert_eq!(report.extrema(), [None, None]);
    let counts = std::iter::repeat_with(|| report.extrema()).take(100);
    let counts = counts.last().expect("counts");
    assert!(counts.iter().all(Option::is_some), "{counts:?}");
    script
        .editor
        .round(PolygonKind::Float, 2)
        .expect("a rounded curve");
    let still = |script: &Script| script.message().contains("still being proved");
    assert!(still(&script), "{}", script.message());
    script
        .editor
        .divide(Division::Split(500.0), 0)
        .expect("the parts");
    assert!(still(&script), "{}", script.message());
}
