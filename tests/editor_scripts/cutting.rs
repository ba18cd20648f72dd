//! Trim, Split and Extend on the canvas: handles on the curve, clicks, intersections.

use batten::document::{Curve, CurveId, Document, Edit};
use batten::editor::{Command, Editor, Key, Look, ToolKind};
use batten::geometry::FloatPolygon;
use batten::operations::{Handle, Value};
use glam::{DVec2, DVec3};

use super::script::Script;

/// A wave of degree 4, a line across it, and a looped curve, side by side; the wave is active.
fn curves() -> (Script, [CurveId; 3]) {
    let wave: Vec<(f64, f64)> = (0..12)
        .map(|i| (2.0 * f64::from(i), 3.0 * (0.6 * f64::from(i)).sin()))
        .collect();
    let line = [(7.3, -8.0), (8.1, 8.0)];
    let looped = [
        (-20.0, 0.0),
        (-4.0, 0.0),
        (-4.0, 6.0),
        (-10.0, 6.0),
        (-8.0, -4.0),
        (-8.0, -9.0),
    ];
    let curves = [(4, &wave[..]), (1, &line[..]), (2, &looped[..])].map(|(degree, vertices)| {
        let polygon = FloatPolygon::planar(degree, vertices).expect("a polygon");
        Curve::new("curve", polygon)
    });
    let mut editor = Editor::with_document(Document::from_curves(curves));
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    editor.look(Look::All);
    let mut script = Script { editor };
    let ids: Vec<CurveId> = script.editor.document().curves().map(|it| it.0).collect();
    script.editor.activate(ids[0]);
    script.command(Command::ToggleSnapping);
    script.check();
    (script, [ids[0], ids[1], ids[2]])
}

fn handles(script: &Script) -> Vec<Handle> {
    let operation = script.editor.previewed_operation().expect("an operation");
    let run = operation.run().expect("a run").as_ref().expect("a success");
    run.outcome.handles.clone()
}

fn value(script: &Script, name: &str) -> f64 {
    let operation = script.editor.previewed_operation().expect("an operation");
    let mut parameters = operation.operation().parameters.iter();
    let parameter = parameters.find(|it| it.name == name).expect("a parameter");
    match operation.values().get(parameter) {
        Value::Real(u) => *u,
        Value::Whole(count) => *count as f64,
        other => panic!("{other:?}"),
    }
}

fn on_screen(script: &Script, point: DVec3) -> DVec2 {
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(point))
}

/// Where two curves meet, by bisection of the distance across the line.
fn crossing(wave: &FloatPolygon, line: &FloatPolygon) -> f64 {
    let [from, to] = [0.0, 1.0].map(|u| line.point(u));
    let across = |u: f64| (wave.point(u) - from).cross(to - from).z;
    let (mut low, mut high) = (0.0, wave.segments() as f64);
    assert!(across(low) * across(high) < 0.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        match across(low) * across(middle) <= 0.0 {
            true => high = middle,
            false => low = middle,
        }
    }
    low
}

#[test]
fn ends_of_the_part_are_dragged_along_the_curve() {
    let (mut script, _) = curves();
    let polygon = script.polygon();
    script.try_out("trim").expect("an operation");
    let [start, _] = handles(&script)[..] else {
        panic!("two handles");
    };
    assert_eq!(start.at, polygon.point(0.0));
    script.command(Command::ToggleSnapping);
    let at = on_screen(&script, polygon.point(2.4));
    script.press(on_screen(&script, start.at));
    script.move_to(at);
    assert!((value(&script, "from") - 2.4).abs() < 1e-6);
    // Back to the start gives back what was.
    script.move_to(on_screen(&script, start.at));
    assert!(value(&script, "from").abs() < 1e-9);
    script.move_to(at);
    script.release(at);
    assert!(script.editor.previewed_operation().is_some());
    assert!((value(&script, "from") - 2.4).abs() < 1e-6);
    assert_eq!(value(&script, "to"), 8.0);
    // The start cannot pass the end.
    let moved = handles(&script)[0].at;
    script.press(on_screen(&script, moved));
    script.move_to(on_screen(&script, polygon.point(8.0)));
    assert!(value(&script, "from") < 8.0);
    script.key(Key::Escape);
    assert!((value(&script, "from") - 2.4).abs() < 1e-6);
}

#[test]
fn a_trim_that_cuts_nothing_says_so_and_makes_no_step() {
    let (mut script, _) = curves();
    let (before, steps) = (script.polygon(), script.steps());
    script.try_out("trim").expect("an operation");
    script.key(Key::Enter);
    let told = script.message();
    assert!(told.starts_with("Nothing is changed. Trim curve"), "{told}");
    assert!(!script.editor.message().is_some_and(|it| it.offers_undo));
    assert_eq!((script.polygon(), script.steps()), (before, steps));
}

#[test]
fn presses_beside_the_handles_stay_in_the_operation() {
    let (mut script, ids) = curves();
    for name in ["trim", "split", "extend", "between"] {
        script.try_out(name).expect("an operation");
        let other = script.editor.document().curve(ids[2]).expect("a curve");
        let on_other = on_screen(&script, other.polygon.point(1.5));
        for at in [DVec2::new(30.0, 650.0), on_other] {
            script.click(at);
            script.drag(at, at + DVec2::new(25.0, -10.0));
            assert!(script.editor.previewed_operation().is_some(), "{name}");
        }
        script.key(Key::Escape);
        assert_eq!((script.steps(), script.curve()), (0, ids[0]), "{name}");
    }
}

#[test]
fn a_trim_that_changes_nothing_says_so_and_makes_no_step() {
    let (mut script, _) = curves();
    let before = script.editor.document().clone();
    script.try_out("trim").expect("an operation");
    let remarks = script.trial_report().remarks;
    assert!(
        remarks
            .iter()
            .any(|it| it.starts_with("Nothing is cut off")),
        "{remarks:?}"
    );
    script.key(Key::Enter);
    assert_eq!(script.steps(), 0);
    assert!(script.editor.document().is_same(&before));
    let offers_undo = script.editor.message().is_some_and(|it| it.offers_undo);
    assert!(!offers_undo, "it would take back the step before");
}

#[test]
fn a_click_sets_the_nearer_end_at_the_intersection() {
    let (mut script, [wave, line, _]) = curves();
    let polygon = script.polygon();
    let other = script.editor.document().curve(line).expect("the line");
    let expected = crossing(&polygon, &other.polygon);
    let at = on_screen(&script, polygon.point(expected)) + DVec2::new(3.0, 2.0);
    script.try_out("trim").expect("an operation");
    script.click(at);
    let from = value(&script, "from");
    assert!(
        (from - expected).abs() < 1e-13 * expected,
        "{from} {expected}"
    );
    // A click on what is cut off takes the end back there.
    script.click(on_screen(&script, polygon.point(1.0)) + DVec2::new(2.0, 1.0));
    assert_eq!(value(&script, "from"), 1.0, "a knot attracts");
    script.click(at);
    script.key(Key::Enter);
    assert_eq!(script.steps(), 1);
    let trimmed = script.editor.document().curve(wave).expect("the wave");
    let start = trimmed.polygon.point(0.0);
    assert!(start.distance(polygon.point(expected)) < 1e-3 * polygon.size());
}

#[test]
fn a_hidden_curve_does_not_attract() {
    let (mut script, [_, line, _]) = curves();
    let polygon = script.polygon();
    let other = script.editor.document().curve(line).expect("the line");
    let expected = crossing(&polygon, &other.polygon);
    let hide = Edit::SetVisible {
        curve: line,
        visible: false,
    };
    script.editor.apply("hide", vec![hide]).expect("an edit");
    script.check();
    script.try_out("split").expect("an operation");
    script.click(on_screen(&script, polygon.point(expected)) + DVec2::new(0.0, 3.0));
    let at = value(&script, "at");
    assert!(
        at != expected && (at - expected).abs() < 0.3,
        "{at} {expected}"
    );
}

#[test]
fn a_curve_is_split_where_it_crosses_itself() {
    let (mut script, [_, _, looped]) = curves();
    script.editor.activate(looped);
    let polygon = script.polygon();
    // The crossing, by a dense search.
    let points: Vec<(f64, DVec3)> = (0..=4000)
        .map(|i| (f64::from(i) / 1000.0, polygon.point(f64::from(i) / 1000.0)))
        .collect();
    let pairs = points
        .iter()
        .flat_map(|one| points.iter().map(move |other| (one, other)));
    let apart = pairs.filter(|(one, other)| other.0 - one.0 > 1.0);
    let (one, other) = apart
        .min_by(|a, b| a.0.1.distance(a.1.1).total_cmp(&b.0.1.distance(b.1.1)))
        .expect("a pair");
    script.try_out("split").expect("an operation");
    script.click(on_screen(&script, one.1) + DVec2::new(2.0, 2.0));
    let at = value(&script, "at");
    assert!(
        (at - one.0).abs() < 2e-3 || (at - other.0).abs() < 2e-3,
        "{at}"
    );
    let own = polygon.point(at);
    let again = polygon.passes(own, 1e-9 * polygon.size());
    assert_eq!(again.len(), 2, "the curve passes there twice");
    assert!(
        again.iter().all(|it| it.distance < 1e-14 * polygon.size()),
        "{again:?}"
    );
}

#[test]
fn a_part_of_a_periodic_curve_goes_over_the_seam() {
    let vertices: Vec<DVec3> = (0..8)
        .map(|i| {
            let angle = f64::from(i) * std::f64::consts::TAU / 8.0;
            DVec3::new(5.0 * angle.cos(), 4.0 * angle.sin(), 0.0)
        })
        .collect();
    let polygon = FloatPolygon::new(3, vertices, None, true).expect("a polygon");
    let mut script = Script::example("arc");
    script.set_polygon(polygon.clone());
    script.editor.look(Look::All);
    script.command(Command::ToggleSnapping);
    script.try_out("trim").expect("an operation");
    for (name, u) in [("from", 5.0), ("to", 7.0)] {
        script.set(name, Value::Real(u)).expect("a value");
    }
    let end = handles(&script)[1];
    let to = on_screen(&script, polygon.point(1.0)) + DVec2::new(1.0, 1.0);
    script.drag(on_screen(&script, end.at), to);
    assert_eq!((value(&script, "from"), value(&script, "to")), (5.0, 9.0));
}

#[test]
fn a_handle_extends_by_whole_segments() {
    let (mut script, _) = curves();
    let polygon = script.polygon();
    script.try_out("extend").expect("an operation");
    let handle = handles(&script)[0];
    assert!(handle.at.distance(polygon.point(9.0)) < 1e-13 * polygon.size());
    let two = on_screen(&script, polygon.point(10.0)) + DVec2::new(3.0, -2.0);
    script.drag(on_screen(&script, handle.at), two);
    assert_eq!(value(&script, "segments"), 2.0);
    // Towards the curve the first segment stays.
    let handle = handles(&script)[0];
    let back = on_screen(&script, polygon.point(7.0));
    script.drag(on_screen(&script, handle.at), back);
    assert_eq!(value(&script, "segments"), 1.0);
}

#[test]
fn every_tool_snaps_to_intersections() {
    let (mut script, [_, line, _]) = curves();
    let polygon = script.polygon();
    let other = script.editor.document().curve(line).expect("the line");
    let point = polygon.point(crossing(&polygon, &other.polygon));
    script.tool(ToolKind::Draw);
    script.click(on_screen(&script, point) + DVec2::new(-3.0, 3.0));
    script.click(on_screen(&script, point + DVec3::new(0.0, 9.0, 0.0)));
    script.key(Key::Enter);
    let drawn = script.polygon();
    let ends = [drawn.vertex(0), drawn.point(0.0)];
    let nearest = ends
        .map(|it| it.distance(point))
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-13 * polygon.size(), "{nearest}");
}
