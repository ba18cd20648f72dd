//! A segment between two ends: preview, handles for points and directions, ends of chosen curves.

use batten::editor::{Command, Input, Key, Mark};
use batten::geometry::features::{Features, Verdict};
use batten::geometry::{BezierPolygon, End, curve_crossing};
use batten::operations::{Handle, Value};
use glam::{DVec2, DVec3};

use super::script::*;

const NAME: &str = "between";

/// A segment tried out in an empty document.
fn alone() -> Script {
    let mut script = Script::example("arc");
    script.editor.begin_empty();
    script.try_out(NAME).expect("it can run");
    script.command(Command::FitAll);
    script
}

fn handles(script: &Script) -> Vec<Handle> {
    let run = script.editor.operation().and_then(|trial| trial.run());
    let run = run.expect("a run").as_ref().expect("an answer");
    run.outcome.handles.clone()
}

fn at_handle(script: &Script, index: usize) -> DVec2 {
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(handles(script)[index].at))
}

/// Drag a handle, without a release; tell where the pointer is.
fn drag(script: &mut Script, index: usize, by: DVec2) -> DVec2 {
    let from = at_handle(script, index);
    script.move_to(from);
    script.press(from);
    script.move_to(from + 0.5 * by);
    script.move_to(from + by);
    from + by
}

/// The point and direction of an end of the last curve.
fn end(script: &Script, end: End) -> (DVec3, DVec3) {
    let curves = script.editor.document().curves();
    let (_, curve) = curves.last().expect("a curve");
    let jet = curve.polygon.end_jet(end);
    (jet.point, jet.first)
}

fn verdict(script: &Script) -> Verdict {
    let curves = script.editor.document().curves();
    let (_, curve) = curves.last().expect("a curve");
    Features::new(&curve.polygon).monotone
}

#[test]
fn points_and_directions_are_dragged_and_the_segment_follows() {
    let mut script = alone();
    assert_eq!(handles(&script).len(), 4);
    assert_eq!(verdict(&script), Verdict::Proved);
    let arrows = script.scene().marks.iter();
    assert!(arrows.filter(|mark| matches!(mark, Mark::Ruler(_))).count() >= 2);
    // The point of the start takes its direction along.
    let before = handles(&script);
    let at = drag(&mut script, 0, DVec2::new(-30.0, 12.0));
    let after = handles(&script);
    let moved = after[0].at - before[0].at;
    assert!(moved.length() > 0.0);
    assert!((after[1].at - before[1].at).distance(moved) <= 1e-12);
    assert_eq!(after[2..], before[2..]);
    script.release(at);
    let (point, _) = end(&script, End::Start);
    assert!(point.distance(after[0].at) <= 1e-12);
    // The direction of the end turns.
    let at = drag(&mut script, 3, DVec2::new(-8.0, 30.0));
    script.release(at);
    let shown = handles(&script);
    let (_, direction) = end(&script, End::Finish);
    let wanted = shown[3].at - shown[2].at;
    assert!(direction.cross(wanted).length() <= 1e-12 * direction.length() * wanted.length());
    assert!(direction.dot(wanted) > 0.0);
    assert_eq!(verdict(&script), Verdict::Proved);
    // All of it is one step.
    script.key(batten::editor::Key::Enter);
    assert_eq!((script.steps(), script.editor.document().len()), (1, 1));
    script.command(Command::Undo);
    assert!(script.editor.document().is_empty());
}

#[test]
fn where_there_is_none_the_handles_stay_and_lead_back() {
    let mut script = alone();
    script
        .set("alpha", Value::List(vec![2.0]))
        .expect("a number");
    script
        .set("from-direction", Value::List(vec![0.1, 3.0]))
        .expect("a vector");
    assert!(!script.trial_report().reached);
    assert!(script.editor.document().is_empty());
    let refused = script
        .editor
        .operating()
        .apply()
        .expect_err("nothing to keep");
    assert!(refused.0.contains("There is no segment"), "{}", refused.0);
    script
        .set("from-direction", Value::List(vec![2.0, 1.2]))
        .expect("a vector");
    assert!(script.trial_report().reached);
    assert_eq!(script.editor.document().len(), 1);
}

#[test]
fn a_segment_goes_on_from_the_end_of_a_curve_and_escape_restores_it() {
    let mut script = Script::example("arc");
    let before = script.editor.document().clone();
    let polygon = script.polygon().clone();
    script.try_out(NAME).expect("it can run");
    let shown = handles(&script);
    let end = polygon.end_jet(End::Finish);
    assert_eq!(shown[0].at, end.point);
    let reach = shown[2].at.distance(end.point) / BezierPolygon::from_float(&polygon).size();
    assert!((reach - 0.5).abs() < 1e-9, "half the curve's size: {reach}");
    let made = script.polygon();
    let start = made.end_jet(End::Start);
    let turned = start.first.angle_between(end.first);
    assert!(turned < 1e-6, "{turned}");
    let sides = [start, end].map(|jet| jet.signed_curvature().signum());
    assert_eq!(sides[0], sides[1], "it bends to the same side");
    assert_eq!(curve_crossing(&made), None);
    script.key(batten::editor::Key::Escape);
    assert!(script.editor.document().is_same(&before));
    assert_eq!(script.steps(), 0);
}

#[test]
fn beside_a_chosen_curve_the_new_segment_is_the_active_one() {
    let mut script = Script::example("s-curve");
    let (own, before) = (script.curve(), script.editor.document().clone());
    script.try_out(NAME).expect("it can run");
    let made = script.curve();
    assert_ne!(made, own);
    assert_eq!(script.made_curves(), [made]);
    // Values are changed, a handle is dragged, and it stays the active one.
    script.set("degree", Value::Whole(4)).expect("a degree");
    let at = drag(&mut script, 1, DVec2::new(8.0, 5.0));
    script.release(at);
    assert!(script.editor.previewed_operation().is_some());
    assert_eq!(script.editor.active(), Some(made));
    assert!(script.plots().before.is_none(), "the curve is as it was");
    // The curve that was chosen may be looked at.
    script.editor.activate(own);
    assert!(script.editor.previewed_operation().is_some());
    script.key(Key::Escape);
    assert_eq!(script.curve(), own);
    assert!(script.editor.document().is_same(&before));
    script.try_out(NAME).expect("it can run");
    script.key(Key::Enter);
    assert_eq!((script.curve(), script.steps()), (made, 1));
    // What was applied may be changed as long as nothing else is active than these two.
    script.set("degree", Value::Whole(6)).expect("a degree");
    assert_eq!((script.polygon().degree(), script.steps()), (6, 1));
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn numbers_of_kinds_that_are_not_chosen_are_not_offered() {
    let mut script = alone();
    let shown = |script: &Script| -> Vec<&str> {
        let trial = script.editor.operation().expect("an operation");
        let operation = trial.operation();
        let shown = operation.parameters_for(trial.input(), trial.values());
        shown.map(|parameter| parameter.name).collect()
    };
    for (kind, expected) in [
        (0, &["alpha"][..]),
        (1, &["a", "b", "c"]),
        (2, &[]),
        (3, &[]),
    ] {
        script.set("kind", Value::Choice(kind)).expect("a kind");
        let shown = shown(&script);
        let own = ["alpha", "a", "b", "c"];
        let own: Vec<&str> = own
            .into_iter()
            .filter(|name| shown.contains(name))
            .collect();
        assert_eq!(own, expected);
        assert!(shown.contains(&"degree"));
    }
}

#[test]
fn escape_restores_the_view_and_the_comb_unless_the_user_has_turned_it() {
    let seen = |script: &Script| {
        let view = script.editor.view();
        (*view.viewport(), view.comb())
    };
    let mut script = Script::example("s-curve");
    script.input(Input::Zoomed {
        at: DVec2::new(100.0, 100.0),
        factor: 6.0,
    });
    let before = seen(&script);
    script.try_out(NAME).expect("it can run");
    assert_ne!(seen(&script), before, "the segment is brought into sight");
    script.key(Key::Escape);
    assert_eq!(seen(&script), before);
    script.try_out(NAME).expect("it can run");
    script.input(Input::Zoomed {
        at: DVec2::new(100.0, 100.0),
        factor: 0.9,
    });
    let turned = seen(&script);
    script.key(Key::Escape);
    assert_eq!(seen(&script), turned);
}
