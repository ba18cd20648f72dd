//! Operations that are tried out, applied, changed afterwards and cancelled.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use batten::document::{Curve, Document, Edit};
use batten::editor::{
    Command, Editor, EndFitAction, Input, Key, Look, Note, OperationInProgress, REACH, ToolKind,
};
use batten::geometry::features::Features;
use batten::geometry::{End, FloatPolygon};
use batten::io::disk;
use batten::operations::{ALL, Inputs, Operation, Value};
use glam::{DVec2, DVec3};

use super::script::{Script, operation};
use super::several::two;
use super::snapshot::Snapshot;

/// Longer than any operation here takes: whoever waits so long has failed.
const LONG: Duration = Duration::from_secs(60);

/// Something that is done, and what it is.
type Done = (&'static str, fn(&mut Script));

/// How far the drags go, in screen points.
const BY: DVec2 = DVec2::new(40.0, -25.0);

/// The s-curve in coordinates that can be rounded, with a vertex selected, and its document.
fn s_curve() -> (Script, Document) {
    let example = Script::example("s-curve").polygon();
    let vertices = example.vertices().iter();
    let vertices = vertices.map(|vertex| 1.000_123_456_789 * *vertex).collect();
    let polygon = FloatPolygon::new(example.degree(), vertices, None, false);
    let mut script = script_of(polygon.expect("a polygon"));
    script.editor.select_vertex(script.curve(), 2, false);
    let before = script.editor.document().clone();
    (script, before)
}

/// The values that let an operation change the s-curve: to be trimmed, all of it is offered.
fn given(name: &str) -> Vec<(&'static str, Value)> {
    match name {
        "trim" => vec![("from", Value::Real(1.0))],
        _ => Vec::new(),
    }
}

/// An operation with parameters that is tried out on the s-curve, and the document without it.
fn trying(name: &str) -> (Script, Document) {
    let (mut script, before) = s_curve();
    let begun = script.try_out(name).expect("an operation");
    assert_eq!(begun, Note::silent());
    assert!(script.editor.previewed_operation().is_some());
    for (parameter, value) in given(name) {
        let set = script.editor.operating().set_values(&[(parameter, value)]);
        set.expect("a value");
    }
    assert!(!script.editor.document().is_same(&before), "it is shown");
    (script, before)
}

/// An operation that is applied to the s-curve after it was tried out, and the document before.
fn applied(name: &str) -> (Script, Document) {
    let (mut script, before) = trying(name);
    let note = script.editor.operating().apply().expect("a step");
    assert!(note.offers_undo, "{note:?}");
    script.check();
    (script, before)
}

/// A script with one curve, which counts as saved.
fn script_of(polygon: FloatPolygon) -> Script {
    let document = Document::from_curves([Curve::new("curve", polygon)]);
    let mut editor = Editor::with_document(document);
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let mut script = Script { editor };
    script.check();
    script
}

fn is_applied(script: &Script) -> bool {
    script
        .editor
        .operation()
        .is_some_and(OperationInProgress::is_applied)
}

/// The document is another one to the bit.
#[track_caller]
fn check_is(script: &Script, expected: &Document) {
    let shown = Snapshot::of(script.editor.document());
    assert_eq!(shown, Snapshot::of(expected));
}

/// Nothing is tried out, and nothing is left of it.
#[track_caller]
fn check_left(script: &Script, before: &Document) {
    assert!(script.editor.operation().is_none());
    assert_eq!(script.editor.workspace().preview(), None);
    check_is(script, before);
    assert_eq!(script.steps(), 0);
    assert_eq!(script.selected(), [2]);
    assert!(!Command::Redo.is_enabled(&script.editor));
}

/// The operations with parameters that can be tried out on the s-curve and change it.
const CHANGING: [&str; 8] = [
    "mirror",
    "reinterpret-degree",
    "elevate-degree",
    "reduce-degree",
    "extend",
    "split",
    "trim",
    "round",
];

#[test]
fn cancel_escape_and_undo_leave_no_trace() {
    for name in CHANGING {
        let (mut script, before) = trying(name);
        script.editor.operating().leave();
        check_left(&script, &before);
        let (mut script, before) = trying(name);
        script.key(Key::Escape);
        check_left(&script, &before);
        let (mut script, before) = trying(name);
        // Values that were given come first.
        for _ in given(name) {
            script.command(Command::Undo);
            assert!(script.editor.previewed_operation().is_some());
        }
        script.command(Command::Undo);
        check_left(&script, &before);
        // What was selected meanwhile is taken back, too.
        let (mut script, before) = trying(name);
        script.editor.select_vertex(script.curve(), 0, true);
        assert!(script.editor.previewed_operation().is_some());
        assert_eq!(script.selected(), [0, 2]);
        script.key(Key::Escape);
        check_left(&script, &before);
    }
}

#[test]
fn applying_makes_one_step_with_the_operations_name() {
    for name in CHANGING {
        for by_key in [false, true] {
            let (mut script, before) = trying(name);
            let shown = script.editor.document().clone();
            if by_key {
                script.key(Key::Enter);
            } else {
                script.editor.operating().apply().expect("a step");
            }
            assert!(is_applied(&script), "{name}");
            assert!(script.editor.previewed_operation().is_none());
            check_is(&script, &shown);
            assert_eq!(script.steps(), 1);
            let label = operation(name).label;
            assert!(script.message().starts_with(label), "{}", script.message());
            let expected = format!("Undo {}{}", label[..1].to_lowercase(), &label[1..]);
            assert_eq!(Command::Undo.label_now(&script.editor), expected);
            script.command(Command::Undo);
            check_is(&script, &before);
            assert_eq!(script.steps(), 0);
            script.command(Command::Redo);
            check_is(&script, &shown);
        }
    }
}

#[test]
fn what_is_tried_out_is_what_is_applied_at_once() {
    for name in CHANGING {
        let (script, _) = trying(name);
        let (mut at_once, _) = s_curve();
        at_once.operate(name, &given(name)).expect("a step");
        assert!(is_applied(&at_once));
        check_is(&at_once, script.editor.document());
    }
}

#[test]
fn operations_without_parameters_are_applied_at_once() {
    for name in ["reverse", "subdivide"] {
        let (mut script, before) = s_curve();
        script.command(Command::Operation(operation(name)));
        assert!(script.editor.previewed_operation().is_none());
        assert_eq!(script.steps(), 1);
        assert!(!script.editor.document().is_same(&before));
        script.command(Command::Undo);
        check_is(&script, &before);
    }
}

#[test]
fn a_value_changes_what_is_shown() {
    let (mut script, before) = trying("extend");
    for segments in [3, 1, 2] {
        let set = script.set("segments", Value::Whole(segments));
        set.expect("a number of segments");
        let (mut at_once, _) = s_curve();
        let given = [("segments", Value::Whole(segments))];
        at_once.operate("extend", &given).expect("a step");
        check_is(&script, at_once.editor.document());
        assert!(script.editor.workspace().settled().is_same(&before));
        assert_eq!(script.steps(), 0);
    }
}

#[test]
fn a_value_changed_after_applying_amends_the_step() {
    let (mut script, before) = applied("extend");
    for segments in [3, 2] {
        let set = script.set("segments", Value::Whole(segments));
        set.expect("a number of segments");
        assert!(is_applied(&script));
        assert_eq!(script.steps(), 1);
        let (mut at_once, _) = s_curve();
        let given = [("segments", Value::Whole(segments))];
        at_once.operate("extend", &given).expect("a step");
        check_is(&script, at_once.editor.document());
    }
    let amended = script.editor.document().clone();
    script.command(Command::Undo);
    check_is(&script, &before);
    assert_eq!(script.steps(), 0);
    script.command(Command::Redo);
    check_is(&script, &amended);
    assert!(script.editor.operation().is_none(), "redo ended it");
}

#[test]
fn amending_what_changed_nothing_keeps_the_step_before() {
    let (mut script, _) = s_curve();
    script.drag_vertex(3, BY);
    let dragged = script.editor.document().clone();
    let degree = script.polygon().degree();
    let same = [("degree", Value::Whole(degree))];
    script.operate("reinterpret-degree", &same).expect("a note");
    check_is(&script, &dragged);
    assert_eq!(script.steps(), 1);
    // There is no step of its own yet: the first change makes one, after the drag.
    for (given, expected) in [(degree - 1, 2), (degree, 1), (degree - 2, 2)] {
        script.set("degree", Value::Whole(given)).expect("a degree");
        assert_eq!(script.steps(), expected);
        assert_eq!(script.polygon().degree(), given);
    }
    script.command(Command::Undo);
    check_is(&script, &dragged);
    assert_eq!(script.steps(), 1);
}

/// The paper's arc, one segment, with a target beside each end.
fn arc_with_targets() -> Script {
    let mut script = Script::example("arc");
    script.tool(ToolKind::EndFit);
    for end in End::BOTH {
        script.end_fit_action(EndFitAction::Choose(end));
        let jet = script.polygon().end_jet(end);
        let point = jet.point + DVec3::new(0.3, -0.2, 0.0);
        script.end_fit_action(EndFitAction::SetPoint(point));
    }
    script.tool(ToolKind::Select);
    script
}

const STEPS: Value = Value::Choice(1);
const JOINT: Value = Value::Choice(0);

#[test]
fn what_does_not_reach_its_target_is_refused_with_what_is_left() {
    let mut script = arc_with_targets();
    let (before, made) = (script.editor.document().clone(), script.steps());
    script.try_out("correct-ends").expect("an operation");
    script.set("method", STEPS).expect("a method");
    let report = script.trial_report();
    assert!(!report.reached);
    assert!(report.residual.is_some_and(|left| left > 0.0));
    check_is(&script, &before);
    let refused = script.editor.operating().apply().expect_err("a refusal");
    assert_eq!(script.message(), refused.0);
    assert!(
        refused.0.contains("not reached, nothing is changed"),
        "{refused}"
    );
    assert!(refused.0.contains("missed by"), "{refused}");
    check_is(&script, &before);
    assert_eq!(script.steps(), made);
    // Another method can still be chosen.
    assert!(script.editor.previewed_operation().is_some());
    script.set("method", JOINT).expect("a method");
    assert!(script.trial_report().reached);
    script.editor.operating().apply().expect("a step");
    assert_eq!(script.steps(), made + 1);
    // Back to the method that fails: the applied step stays, and the message says why.
    let corrected = script.editor.document().clone();
    script.set("method", STEPS).expect("a method");
    check_is(&script, &corrected);
    assert_eq!(script.steps(), made + 1);
    assert!(is_applied(&script));
    assert_eq!(script.message(), refused.0);
    script.set("method", JOINT).expect("a method");
    check_is(&script, &corrected);
    assert_eq!(script.steps(), made + 1);
    script.command(Command::Undo);
    check_is(&script, &before);
    // Applied at once it is refused as well, and nothing stays tried out.
    let refused = script.operate("correct-ends", &[("method", STEPS)]);
    assert!(refused.is_err_and(|refusal| refusal.0.contains("missed by")));
    assert!(script.editor.operation().is_none());
    assert_eq!(script.editor.workspace().preview(), None);
    check_is(&script, &before);
}

#[test]
fn a_value_that_is_not_allowed_is_refused_and_the_values_stay() {
    for is_applied in [false, true] {
        let (mut script, _) = trying("split");
        if is_applied {
            script.editor.operating().apply().expect("a step");
        }
        let (shown, made) = (script.editor.document().clone(), script.steps());
        let values = |script: &Script| {
            let trial = script.editor.operation().expect("an operation");
            trial.values().clone()
        };
        let given = values(&script);
        for (parameter, value, message) in [
            ("at", Value::Real(99.0), "At u: 99 is out of range"),
            ("at", Value::Real(0.0), "At u: 0 is out of range"),
            ("at", Value::Real(f64::NAN), "At u: "),
            ("at", Value::Whole(1), "is needed"),
            ("subdivisions", Value::List(vec![1.5]), "whole number"),
            ("subdivisions", Value::List(vec![99.0]), "out of range"),
            ("nowhere", Value::Real(1.0), "no parameter “nowhere”"),
        ] {
            let refused = script.set(parameter, value.clone()).expect_err("a refusal");
            assert!(refused.to_string().contains(message), "{refused}");
            assert_eq!(values(&script), given, "{value:?}");
            assert!(script.trial_report().reached);
            check_is(&script, &shown);
            assert_eq!(script.steps(), made);
        }
        script.set("at", Value::Real(0.5)).expect("a place");
        assert_ne!(values(&script), given);
    }
}

#[test]
fn values_that_make_no_curve_together_are_told_and_not_applied() {
    let (mut script, before) = trying("trim");
    // Each is in its range, but the part would end before it begins.
    script.set("from", Value::Real(1.5)).expect("a place");
    script.set("to", Value::Real(0.5)).expect("a place");
    let run = script
        .editor
        .operation()
        .and_then(OperationInProgress::run)
        .expect("a run");
    let error = run.as_ref().expect_err("no curve").to_string();
    check_is(&script, &before);
    let refused = script.editor.operating().apply().expect_err("a refusal");
    assert_eq!(refused.0, error);
    assert!(script.editor.previewed_operation().is_some());
    assert_eq!(script.steps(), 0);
    script.set("from", Value::Real(0.25)).expect("a place");
    script.editor.operating().apply().expect("a step");
    assert_eq!(script.steps(), 1);
}

/// Whether an operation makes a curve of its own, and needs none.
fn is_maker(operation: &Operation) -> bool {
    matches!(operation.inputs, Inputs::None | Inputs::UpToTwo)
}

#[test]
fn operations_are_offered_where_they_can_run() {
    let offered = |script: &Script| -> Vec<&str> {
        let enabled = ALL.iter().filter(|operation| {
            let command = Command::Operation(operation);
            let is_enabled = command.is_enabled(&script.editor);
            assert_eq!(script.editor.input_of(operation).is_ok(), is_enabled);
            is_enabled
        });
        enabled.map(|operation| operation.name).collect()
    };
    // Both ends at once can be told in the panel where they shall be.
    let corrections = ["translate-end", "rotate-end"];
    let all: Vec<&str> = ALL.iter().map(|operation| operation.name).collect();
    let (mut script, _) = s_curve();
    // One curve is there, no points and no reference.
    let others = ["join", "fit", "to-float"];
    let offered_here = |name: &&str| !corrections.contains(name) && !others.contains(name);
    let here: Vec<&str> = all.iter().copied().filter(offered_here).collect();
    assert_eq!(offered(&script), here);
    // What makes a curve of its own needs none.
    let makers = ALL.iter().filter(|operation| is_maker(operation));
    let makers: Vec<&str> = makers.map(|operation| operation.name).collect();
    let curve = script.curve();
    script
        .editor
        .change(Edit::SetLocked {
            curve,
            locked: true,
        })
        .expect("a curve");
    assert_eq!(offered(&script), makers);
    script
        .editor
        .change(Edit::SetLocked {
            curve,
            locked: false,
        })
        .expect("a curve");
    script
        .editor
        .change(Edit::SetVisible {
            curve,
            visible: false,
        })
        .expect("a curve");
    assert_eq!(offered(&script), makers);
    let script = Script::example("periodic");
    for (name, is_offered) in [
        ("reverse", true),
        ("mirror", true),
        ("array", true),
        ("make-symmetric", true),
        ("reinterpret-degree", true),
        ("elevate-degree", true),
        ("reduce-degree", true),
        ("refine", true),
        ("subdivide", true),
        ("extend", false),
        ("split", false),
        ("trim", true),
        ("round", true),
        ("translate-end", false),
        ("rotate-end", false),
        ("correct-ends", false),
    ] {
        assert_eq!(offered(&script).contains(&name), is_offered, "{name}");
    }
    let mut script = Script::example("arc");
    script.editor.begin_empty();
    let none = |it: &&&Operation| is_maker(it) || it.inputs == Inputs::OneOrNone;
    let without_curves: Vec<&str> = ALL.iter().filter(none).map(|it| it.name).collect();
    assert_eq!(offered(&script), without_curves);
}

#[test]
fn what_cannot_run_is_not_begun() {
    let on_one = ALL
        .iter()
        .filter(|it| matches!(it.inputs, Inputs::One | Inputs::OneOrNone));
    for operation in on_one {
        let (mut script, _) = s_curve();
        let curve = script.curve();
        script
            .editor
            .change(Edit::SetLocked {
                curve,
                locked: true,
            })
            .expect("a curve");
        let (before, made) = (script.editor.document().clone(), script.steps());
        let given = script.editor.execute(Command::Operation(operation));
        let given = given.expect("it is not offered, and says why");
        assert!(given.text.contains("locked"), "{given:?}");
        let refused = script.editor.preview_operation(operation);
        let refused = refused.expect_err("a refusal");
        assert!(refused.0.contains("locked"), "{refused}");
        assert_eq!(script.message(), refused.0);
        assert!(script.editor.operation().is_none());
        assert_eq!(script.editor.workspace().preview(), None);
        check_is(&script, &before);
        assert_eq!(script.steps(), made);
    }
}

/// Do everything that only looks, and save; what is tried out, or was applied last, goes on.
fn check_goes_on(script: &mut Script, name: &str) {
    let shown = script.editor.document().clone();
    let stage = is_applied(script);
    let goes_on = |script: &mut Script, what: &str| {
        script.check();
        let trial = script.editor.operation();
        let trial = trial.unwrap_or_else(|| panic!("{name} ended by {what}"));
        assert_eq!(trial.operation().name, name);
        assert_eq!(trial.is_applied(), stage, "{what}");
        assert!(script.editor.document().is_same(&shown), "{what}");
    };
    for command in Command::all().into_iter().filter(|c| c.only_shows()) {
        script.command(command);
        goes_on(script, &command.label());
    }
    let at = DVec2::new(300.0, 200.0);
    script.input(Input::Zoomed { at, factor: 1.5 });
    goes_on(script, "zooming");
    script.input(Input::Panned { by: BY });
    goes_on(script, "panning");
    script.editor.look(Look::Orbit(BY));
    goes_on(script, "turning the view");
    script.move_to(at);
    goes_on(script, "moving the pointer");
    script.editor.select_vertex(script.curve(), 1, true);
    goes_on(script, "selecting a vertex");
    script.editor.activate(script.curve());
    goes_on(script, "clicking the curve in the list");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("own.batten");
    script.editor.save(&path).expect("a file");
    goes_on(script, "saving");
    let read = disk::read_file(&path).expect("what was saved").curves;
    let settled = script.editor.workspace().settled();
    let held: Vec<Arc<Curve>> = settled.curves().map(|(_, curve)| curve.clone()).collect();
    assert_eq!(read, held, "without what is tried out");
}

#[test]
fn looking_selecting_and_saving_end_nothing() {
    for name in ["extend", "split", "round"] {
        let (mut script, before) = trying(name);
        check_goes_on(&mut script, name);
        assert!(script.editor.workspace().settled().is_same(&before));
        script.key(Key::Escape);
        check_is(&script, &before);
        assert!(!script.editor.workspace().is_modified(), "{name}");
        let (mut script, before) = applied(name);
        check_goes_on(&mut script, name);
        script.command(Command::Undo);
        check_is(&script, &before);
    }
}

#[test]
fn every_other_command_takes_the_preview_back() {
    let is_ending = |command: &Command| {
        !command.only_shows() && !matches!(command, Command::Undo | Command::Redo)
    };
    for command in Command::all().into_iter().filter(is_ending) {
        let (mut script, before) = trying("round");
        let preview = script.editor.workspace().preview();
        if !command.is_enabled(&script.editor) {
            continue;
        }
        script.command(command);
        assert_ne!(script.editor.workspace().preview(), preview, "{command:?}");
        let trial = script.editor.operation();
        assert!(
            trial.is_none_or(|trial| command == Command::Operation(trial.operation())),
            "{command:?}"
        );
        script.editor.operating().leave();
        script.undo_all();
        check_is(&script, &before);
    }
}

#[test]
fn a_drag_takes_the_preview_back() {
    let (mut script, before) = trying("round");
    let at = script.at_vertex(3);
    script.press(at);
    script.move_to(at + BY);
    assert!(script.editor.operation().is_none());
    assert!(script.editor.hand().is_dragging());
    assert!(script.editor.workspace().settled().is_same(&before));
    let moved: Vec<bool> = moved_vertices(&before, &script);
    let expected: Vec<bool> = (0..moved.len()).map(|vertex| vertex == 3).collect();
    assert_eq!(moved, expected, "nothing is rounded");
    script.release(at + BY);
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    check_is(&script, &before);
}

#[test]
fn a_click_works_on_the_document_without_the_preview() {
    let (mut script, before) = s_curve();
    script.tool(ToolKind::Delete);
    let settled: Vec<DVec2> = (0..script.polygon().vertices().len())
        .map(|vertex| script.at_vertex(vertex))
        .collect();
    script.try_out("elevate-degree").expect("an operation");
    let previewed = (0..script.polygon().vertices().len()).map(|vertex| script.at_vertex(vertex));
    let apart = |at: &DVec2| {
        settled
            .iter()
            .all(|vertex| vertex.distance(*at) > 4.0 * REACH)
    };
    let at = previewed.into_iter().find(apart).expect("a new place");
    script.click(at);
    // Only the preview has a vertex there: it ends, and no other vertex is deleted.
    assert!(script.editor.operation().is_none());
    check_is(&script, &before);
    assert_eq!(script.steps(), 0);
}

/// Which vertices of the active curve are not where they were.
fn moved_vertices(before: &Document, script: &Script) -> Vec<bool> {
    let before = before.curve(script.curve()).expect("the curve");
    let now = script.polygon();
    let pairs = before.polygon.vertices().iter().zip(now.vertices());
    pairs.map(|(a, b)| a != b).collect()
}

#[test]
fn a_number_field_takes_the_preview_back() {
    let (mut script, before) = trying("round");
    let edit = Edit::MoveVertices {
        curve: script.curve(),
        moves: vec![(3, DVec3::new(1.5, 2.5, 0.0))],
    };
    script.editor.preview("Set coordinate", vec![edit]);
    script.check();
    assert!(script.editor.operation().is_none());
    assert!(script.editor.workspace().settled().is_same(&before));
    let moved = moved_vertices(&before, &script);
    assert_eq!(moved.iter().filter(|moved| **moved).count(), 1);
    script.editor.commit_preview();
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    check_is(&script, &before);
}

#[test]
fn another_operation_takes_the_preview_back() {
    let (mut script, before) = trying("round");
    script.try_out("extend").expect("an operation");
    let trial = script.editor.operation().expect("an operation");
    assert_eq!(trial.operation().name, "extend");
    assert!(trial.input().document().is_same(&before));
    script.editor.operating().apply().expect("a step");
    assert_eq!(script.steps(), 1);
    let (mut at_once, _) = s_curve();
    at_once.operate("extend", &[]).expect("a step");
    check_is(&script, at_once.editor.document());
}

#[test]
fn another_curve_ends_what_is_tried_out_and_what_was_applied() {
    let (mut script, [arc, other]) = two();
    let (before, made) = (script.editor.document().clone(), script.steps());
    script.try_out("round").expect("an operation");
    script.editor.activate(other);
    assert!(script.editor.operation().is_none());
    check_is(&script, &before);
    script.editor.activate(arc);
    assert!(script.editor.operation().is_none(), "it does not come back");
    script.try_out("round").expect("an operation");
    script.editor.select_vertex(other, 1, false);
    assert!(script.editor.operation().is_none());
    check_is(&script, &before);
    assert_eq!(script.selected_of(other), [1]);
    script.editor.activate(arc);
    script.operate("round", &[]).expect("a step");
    assert!(is_applied(&script));
    script.editor.activate(other);
    assert!(script.editor.operation().is_none());
    assert_eq!(script.steps(), made + 1);
    // A value that comes too late changes nothing.
    let rounded = script.editor.document().clone();
    assert_eq!(script.set("digits", Value::Whole(0)), Ok(()));
    check_is(&script, &rounded);
}

#[test]
fn the_panel_of_what_was_applied_ends_with_the_next_step_undo_or_redo() {
    let ends: [Done; 6] = [
        ("a drag", |script| script.drag_vertex(3, BY)),
        ("an arrow key", |script| script.key(Key::Up)),
        ("a command", |script| script.command(Command::Duplicate)),
        ("undo", |script| script.command(Command::Undo)),
        ("redo", |script| {
            script.command(Command::Undo);
            script.command(Command::Redo);
        }),
        ("a field", |script| {
            let curve = script.curve();
            let moves = vec![(3, DVec3::new(1.5, 2.5, 0.0))];
            let edits = vec![Edit::MoveVertices { curve, moves }];
            script.editor.preview("Set coordinate", edits);
        }),
    ];
    for (name, end) in ends {
        let (mut script, before) = applied("round");
        script.editor.select_vertex(script.curve(), 2, false);
        end(&mut script);
        assert!(script.editor.operation().is_none(), "{name}");
        let shown = script.editor.document().clone();
        assert_eq!(script.set("digits", Value::Whole(0)), Ok(()));
        check_is(&script, &shown);
        script.editor.interrupt();
        script.undo_all();
        check_is(&script, &before);
    }
}

#[test]
fn what_a_drag_took_back_does_not_bring_its_selection_back() {
    let (mut script, _) = trying("round");
    let at = script.at_vertex(3);
    script.drag(at, at + BY);
    script.editor.select_vertex(script.curve(), 1, false);
    let outside = [("digits", Value::Whole(99))];
    script.operate("round", &outside).expect_err("too many");
    assert_eq!(script.selected(), [1]);
    script.editor.operating().leave();
    assert_eq!(script.selected(), [1]);
}

#[test]
fn what_is_selected_meanwhile_is_what_the_next_command_is_about() {
    let (mut script, before) = trying("round");
    let vertex = before
        .curve(script.curve())
        .expect("the curve")
        .polygon
        .vertex(0);
    script.editor.select_vertex(script.curve(), 0, false);
    script.command(Command::Delete);
    assert!(script.editor.operation().is_none());
    assert_eq!(script.steps(), 1);
    assert!(!script.polygon().vertices().contains(&vertex));
    // Where vertices get other numbers, what was selected before counts.
    let (mut script, _) = trying("split");
    let last = script.polygon().vertices().len() - 1;
    script.editor.select_vertex(script.curve(), last, false);
    script.tool(ToolKind::Measure);
    assert!(script.editor.operation().is_none());
    assert_eq!(script.selected(), [2]);
}

#[test]
fn the_preview_is_not_what_is_selected_or_deleted() {
    let (mut script, before) = trying("split");
    assert_eq!(script.editor.document().len(), 2);
    script.command(Command::SelectAll);
    assert!(script.editor.operation().is_none());
    check_is(&script, &before);
    let count = script.polygon().vertices().len();
    assert_eq!(script.selected(), (0..count).collect::<Vec<usize>>());
}

/// Let operations run in the background from now on, never waited for, and tell when there is
/// something to see.
fn run_in_background(script: &mut Script) -> Receiver<()> {
    let (sender, woken) = channel();
    let wake = move || sender.send(()).unwrap_or_default();
    script.editor.run_in_background(Duration::ZERO, wake);
    woken
}

/// A curve of so many segments that no operation on it is done before it can be looked for.
fn long() -> (Script, Document) {
    let points: Vec<(f64, f64)> = (0..5000)
        .map(|index| (f64::from(index), (0.37 * f64::from(index)).sin()))
        .collect();
    let polygon = FloatPolygon::planar(3, &points).expect("a polygon");
    let script = script_of(polygon);
    let before = script.editor.document().clone();
    (script, before)
}

/// Begin frames, each when there is something new to see, until that is so.
#[track_caller]
fn wait_until(script: &mut Script, woken: &Receiver<()>, is: impl Fn(&Script) -> bool) {
    loop {
        script.editor.begin_frame();
        if is(script) {
            return;
        }
        woken.recv_timeout(LONG).expect("the frame is woken");
    }
}

fn has_run(script: &Script) -> bool {
    script
        .editor
        .operation()
        .is_some_and(|trial| trial.run().is_some() && !trial.is_pending())
}

fn segments(script: &Script) -> usize {
    script.polygon().segments()
}

#[test]
fn a_late_result_is_taken_when_a_frame_begins() {
    let (mut script, before) = long();
    let woken = run_in_background(&mut script);
    script
        .editor
        .preview_operation(operation("elevate-degree"))
        .expect("begun");
    assert!(script.editor.previewed_operation().is_some());
    woken.recv_timeout(LONG).expect("the frame is woken");
    check_is(&script, &before);
    script.editor.begin_frame();
    assert!(has_run(&script));
    assert_eq!(script.polygon().degree(), 4);
    script.editor.operating().leave();
    check_is(&script, &before);
}

#[test]
fn only_the_newest_values_count() {
    let (mut script, _) = long();
    let before = segments(&script);
    let woken = run_in_background(&mut script);
    script
        .editor
        .preview_operation(operation("extend"))
        .expect("begun");
    for added in 2..=9 {
        let set = script
            .editor
            .operating()
            .set_values(&[("segments", Value::Whole(added))]);
        set.expect("a number of segments");
    }
    // What answers the questions before is never shown from now on.
    let shown = segments(&script);
    loop {
        script.editor.begin_frame();
        if has_run(&script) {
            break;
        }
        assert_eq!(segments(&script), shown);
        woken.recv_timeout(LONG).expect("the frame is woken");
    }
    assert_eq!(segments(&script), before + 9);
}

#[test]
fn what_is_applied_before_it_is_known_is_applied_when_it_is() {
    let (mut script, before) = long();
    let woken = run_in_background(&mut script);
    script
        .editor
        .preview_operation(operation("elevate-degree"))
        .expect("begun");
    assert!(!has_run(&script), "it is not waited for");
    let waits = script.editor.operating().apply().expect("it waits");
    assert_eq!(waits.text, "Applies when ready; Esc cancels");
    assert_eq!(script.steps(), 0);
    wait_until(&mut script, &woken, is_applied);
    assert_eq!(script.steps(), 1);
    let message = script.editor.message().expect("what it came to");
    assert!(
        message.text.starts_with(operation("elevate-degree").label),
        "{message:?}"
    );
    assert!(message.offers_undo && !message.is_error);
    script.command(Command::Undo);
    check_is(&script, &before);
}

#[test]
fn what_is_refused_late_is_told_and_changes_nothing() {
    let mut script = arc_with_targets();
    let (before, made) = (script.editor.document().clone(), script.steps());
    let woken = run_in_background(&mut script);
    let given = [("method", STEPS)];
    // It may be known at once: then the reply is the refusal.
    let at_once = script
        .editor
        .apply_operation(operation("correct-ends"), &given);
    let is_refused = |script: &Script| script.message().contains("not reached");
    wait_until(&mut script, &woken, is_refused);
    assert!(
        at_once.is_ok_and(|note| note == Note::silent()) || script.editor.operation().is_none()
    );
    check_is(&script, &before);
    assert_eq!(script.steps(), made);
    assert!(
        script
            .editor
            .message()
            .is_some_and(|message| message.is_error)
    );
}

#[test]
fn what_is_left_before_it_is_known_never_comes() {
    let leaves: [Done; 4] = [
        ("cancel", |script| script.editor.operating().leave()),
        ("Esc", |script| script.editor.input(Input::Key(Key::Escape))),
        ("undo", |script| {
            script.editor.execute(Command::Undo).expect("undone");
        }),
        ("a command", |script| {
            script.editor.execute(Command::SelectAll).expect("selected");
        }),
    ];
    for (name, leave) in leaves {
        for applies in [false, true] {
            let (mut script, before) = long();
            let woken = run_in_background(&mut script);
            script
                .editor
                .preview_operation(operation("elevate-degree"))
                .expect("begun");
            if applies {
                script.editor.operating().apply().expect("it waits");
            }
            leave(&mut script);
            assert!(script.editor.operation().is_none(), "{name}");
            woken.recv_timeout(LONG).expect("the frame is woken");
            script.editor.begin_frame();
            assert!(script.editor.operation().is_none(), "{name}");
            check_is(&script, &before);
            assert_eq!(script.steps(), 0, "{name}");
        }
    }
}

#[test]
fn a_value_that_fails_after_applying_keeps_the_applied_step() {
    let (mut script, before) = trying("trim");
    script.set("from", Value::Real(1.5)).expect("a place");
    script.editor.operating().apply().expect("a step");
    let trimmed = script.editor.document().clone();
    // The part would end before it begins.
    script.set("to", Value::Real(0.5)).expect("a place");
    let run = script
        .editor
        .operation()
        .and_then(OperationInProgress::run)
        .expect("a run");
    let error = run.as_ref().expect_err("no curve").to_string();
    assert_eq!(script.message(), error);
    check_is(&script, &trimmed);
    assert_eq!(script.steps(), 1);
    // The next success amends the same step.
    script.set("from", Value::Real(0.25)).expect("a place");
    assert!(!script.editor.document().is_same(&trimmed));
    assert!(is_applied(&script));
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    check_is(&script, &before);
}

#[test]
fn a_value_that_is_worked_out_while_its_step_is_undone_changes_nothing() {
    let (mut script, before) = long();
    script
        .editor
        .apply_operation(operation("extend"), &[])
        .expect("a step");
    let woken = run_in_background(&mut script);
    script
        .editor
        .apply_operation(operation("round"), &[])
        .expect("asked for");
    wait_until(&mut script, &woken, is_applied);
    assert_eq!(script.steps(), 2);
    let set = script
        .editor
        .operating()
        .set_values(&[("digits", Value::Whole(0))]);
    set.expect("a number of digits");
    script.editor.execute(Command::Undo).expect("undone");
    script.editor.execute(Command::Undo).expect("undone");
    check_is(&script, &before);
    woken.recv_timeout(LONG).expect("the frame is woken");
    script.editor.begin_frame();
    check_is(&script, &before);
    assert_eq!(script.steps(), 0);
}

#[test]
fn a_late_value_amends_the_step() {
    let (mut script, before) = long();
    let woken = run_in_background(&mut script);
    script
        .editor
        .apply_operation(operation("extend"), &[])
        .expect("asked for");
    wait_until(&mut script, &woken, is_applied);
    let once = segments(&script);
    let set = script
        .editor
        .operating()
        .set_values(&[("segments", Value::Whole(4))]);
    set.expect("a number of segments");
    wait_until(&mut script, &woken, |script| segments(script) == once + 3);
    assert!(is_applied(&script));
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    check_is(&script, &before);
}

#[test]
fn what_is_done_is_told_before_its_features_are_proved() {
    let (mut script, _) = long();
    let expected = |script: &Script| Features::new(&script.polygon()).curvature_extrema.len();
    let before = expected(&script);
    let woken = run_in_background(&mut script);
    script
        .editor
        .preview_operation(operation("round"))
        .expect("begun");
    wait_until(&mut script, &woken, has_run);
    assert_eq!(script.trial_report().features, None);
    let note = script.editor.operating().apply().expect("a step");
    assert!(!note.text.contains("extrema"), "{}", note.text);
    let told = script.editor.message().map(|it| it.text.clone());
    assert_eq!(told, Some(note.text));
    let is_proved = |script: &Script| script.trial_report().features.is_some();
    wait_until(&mut script, &woken, is_proved);
    let features = script.trial_report().features.expect("proved features");
    assert_eq!(features.before[0].curvature_extrema, before);
    assert_eq!(features.after[0].curvature_extrema, expected(&script));
    assert!(before > 500);
    // What was told of the step is completed.
    let message = script.editor.message().expect("a message");
    assert!(message.text.contains("curvature extrema: "), "{message:?}");
}

#[test]
fn the_end_fit_panel_tells_added_extrema_once_they_are_proved() {
    let (mut script, _) = long();
    script.tool(ToolKind::EndFit);
    script.end_fit_action(EndFitAction::Choose(End::Finish));
    let point = script.polygon().end_jet(End::Finish).point;
    script.end_fit_action(EndFitAction::SetPoint(point + DVec3::new(0.0, 0.5, 0.0)));
    let woken = run_in_background(&mut script);
    script.end_fit_action(EndFitAction::BothAtOnce);
    let is_told = |script: &Script| {
        let editor = &script.editor;
        let report = editor.hand().end_fit(editor.workspace(), editor.view());
        let outcome = report.and_then(|it| it.outcome);
        matches!(outcome, Some(Ok(note)) if note.text.contains("curvature extrema: "))
    };
    wait_until(&mut script, &woken, is_told);
    assert_eq!(script.steps(), 2);
}
