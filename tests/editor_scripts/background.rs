//! Features that are proved on a thread of its own.

use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use batten::document::{Curve, Document, Edit};
use batten::editor::{Command, Editor, FeatureKind, Key, Look, OperationInProgress, ToolKind};
use batten::geometry::FloatPolygon;
use batten::geometry::expressions::LengthUnit;
use batten::geometry::features::Features;
use batten::operations::Value;
use glam::{DVec2, DVec3};

use super::script::{Script, operation};

/// Longer than any proof here takes: whoever waits so long has failed.
const LONG: Duration = Duration::from_secs(60);

/// Prove in the background from now on, and tell when there is something to see.
fn prove_in_background(script: &mut Script, patience: Duration) -> Receiver<()> {
    let (sender, woken) = channel();
    let wake = move || sender.send(()).unwrap_or_default();
    script.editor.run_in_background(patience, wake);
    woken
}

/// A script with a curve of many segments.
fn long() -> Script {
    let points: Vec<(f64, f64)> = (0..5000)
        .map(|index| (f64::from(index), (0.37 * f64::from(index)).sin()))
        .collect();
    let polygon = FloatPolygon::planar(3, &points).expect("a polygon");
    let document = Document::from_curves([Curve::new("long", polygon)]);
    let mut editor = Editor::with_document(document);
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let mut script = Script { editor };
    script.check();
    script
}

const EXTREMA: [FeatureKind; 2] = [FeatureKind::CurvatureMaximum, FeatureKind::CurvatureMinimum];

/// Make frames, each when there is something new to see, until all features are known.
#[track_caller]
fn check_proved_in_later_frames(script: &mut Script, woken: &Receiver<()>) {
    let expected = Features::new(&script.polygon());
    let mut before = 0.0;
    let report = loop {
        if let Some(report) = script.features() {
            break report;
        }
        script.scene();
        let share = script.editor.sight().proof_progress().expect("a curve");
        assert!((before..=1.0).contains(&share), "{before} {share}");
        before = share;
        woken.recv_timeout(LONG).expect("the frame is woken");
    };
    assert_eq!(report.monotone, expected.monotone);
    assert_eq!(report.count(&EXTREMA), expected.curvature_extrema.len());
    assert_eq!(
        report.count(&[FeatureKind::Inflection]),
        expected.inflections.len()
    );
    assert!(report.count(&EXTREMA) > 500);
    // The pieces that rise and fall are drawn, though frames before had nothing to draw.
    let [rising, falling, _] = &script.scene().curves[0].pieces;
    let is_drawn = |chain: &[DVec2]| chain.iter().any(|point| point.is_finite());
    assert!(is_drawn(rising) && is_drawn(falling));
}

#[test]
fn the_features_of_a_long_curve_are_there_in_a_later_frame() {
    let mut script = long();
    let woken = prove_in_background(&mut script, Duration::ZERO);
    check_proved_in_later_frames(&mut script, &woken);
}

#[test]
fn a_curve_that_changes_while_it_is_proved_gets_its_own_features() {
    let mut script = long();
    let woken = prove_in_background(&mut script, Duration::ZERO);
    script.features();
    let curve = script.curve();
    // Some frames of a drag: none waits for the proof of the one before.
    for step in 1..=5 {
        let moves = vec![(2500, DVec3::new(2500.0, f64::from(step), 0.0))];
        let edit = Edit::MoveVertices { curve, moves };
        script.editor.apply("move", vec![edit]).expect("an edit");
        script.features();
    }
    check_proved_in_later_frames(&mut script, &woken);
    // What was proved before is not proved again.
    script.command(Command::Undo);
    check_proved_in_later_frames(&mut script, &woken);
    let analysis = script.editor.view().analysis(curve).expect("an analysis");
    assert_eq!(analysis.segments_proved(), 4);
}

#[test]
fn nothing_flickers_while_a_small_curve_is_dragged() {
    let mut script = Script::example("hull");
    // So patient that a machine with much else to do makes no difference.
    let woken = prove_in_background(&mut script, LONG);
    let at = script.at_vertex(6);
    script.press(at);
    for step in 1..=20 {
        script.move_to(at + DVec2::new(0.0, 3.0 * f64::from(step)));
        assert!(script.features().is_some(), "in the same frame");
        let scene = script.scene();
        assert!(!scene.curves[0].features.is_empty());
    }
    assert!(woken.try_recv().is_err(), "no frame is made for it");
}

#[test]
fn apply_during_a_run_waits_and_says_so_and_can_be_cancelled() {
    let mut script = long();
    let woken = prove_in_background(&mut script, Duration::ZERO);
    let waits = |editor: &Editor| {
        let operation = editor.operation();
        operation.is_some_and(OperationInProgress::is_waiting_to_apply)
    };
    let begin = |editor: &mut Editor| {
        let begun = editor.preview_operation(operation("elevate-degree"));
        begun.expect("a preview");
        editor.operating().apply().expect("nothing is refused");
        assert!(waits(editor));
    };
    begin(&mut script.editor);
    assert_eq!(script.message(), "Applies when ready; Esc cancels");
    script.key(Key::Escape);
    assert!(script.editor.operation().is_none());
    assert_eq!(script.steps(), 0);

    // What else begins says that the result never came.
    begin(&mut script.editor);
    let begun = script.editor.preview_operation(operation("trim"));
    begun.expect("a preview");
    let dropped = format!(
        "{}: not applied, it was not ready",
        operation("elevate-degree").label
    );
    assert_eq!(script.message(), dropped);
    script.key(Key::Escape);
    begin(&mut script.editor);
    script.command(Command::Undo);
    assert_eq!(script.message(), dropped);
    assert_eq!(script.steps(), 0);

    // So does a command: one that shows a panel, one that says something itself, and one that is refused.
    for command in [
        Command::Operation(operation("trim")),
        Command::Tool(ToolKind::Draw),
        Command::SetUnit(Some(LengthUnit::Inch)),
        Command::AddFormula,
    ] {
        let held = script.editor.document().clone();
        begin(&mut script.editor);
        script.command(command);
        let message = script.message();
        assert!(message.starts_with(&dropped), "{command:?}: {message}");
        script.key(Key::Escape);
        if !script.editor.document().is_same(&held) {
            script.command(Command::Undo);
        }
        script.command(Command::Tool(ToolKind::Select));
    }

    // The reply of an operation that is applied at once comes later, and tells it too.
    begin(&mut script.editor);
    script.command(Command::Operation(operation("reverse")));
    while script
        .editor
        .operation()
        .is_some_and(OperationInProgress::is_pending)
    {
        woken.recv_timeout(LONG).expect("the frame is woken");
        script.editor.begin_frame();
    }
    let message = script.message();
    assert!(
        message.starts_with(&dropped) && message.contains("Reverse"),
        "{message}"
    );
    script.command(Command::Undo);

    // To take back a value takes back that it is applied.
    let begun = script.editor.preview_operation(operation("elevate-degree"));
    begun.expect("a preview");
    let set = script
        .editor
        .operating()
        .set_values(&[("degree", Value::Whole(5))]);
    set.expect("a degree");
    script
        .editor
        .operating()
        .apply()
        .expect("nothing is refused");
    script.command(Command::Undo);
    assert!(!waits(&script.editor));
    let changed = format!(
        "{}: not applied, its values have changed",
        operation("elevate-degree").label
    );
    assert_eq!(script.message(), changed);
    script.key(Key::Escape);

    begin(&mut script.editor);
    // The result of other values is to be seen first.
    let other = [("degree", Value::Whole(6))];
    let set = script.editor.operating().set_values(&other);
    set.expect("a degree");
    assert!(!waits(&script.editor));
    script
        .editor
        .operating()
        .apply()
        .expect("nothing is refused");
    while waits(&script.editor) {
        woken.recv_timeout(LONG).expect("the frame is woken");
        script.editor.begin_frame();
    }
    assert_eq!(script.steps(), 1);
    assert_eq!(script.polygon().degree(), 6);
}

/// Wait for the run of the operation that is previewed.
fn finish(script: &mut Script, woken: &Receiver<()>) {
    let is_pending = |editor: &Editor| {
        let operation = editor.operation();
        operation.is_some_and(OperationInProgress::is_pending)
    };
    while is_pending(&script.editor) {
        woken.recv_timeout(LONG).expect("the frame is woken");
        script.editor.begin_frame();
    }
}

#[track_caller]
fn check_held_back(script: &Script) {
    assert_eq!(script.steps(), 0);
    assert!(script.editor.previewed_operation().is_some());
    let message = script.editor.message().expect("a message");
    assert!(
        message.warns && message.text.starts_with("Not applied yet"),
        "{message:?}"
    );
}

/// A preview of a chain that moves the second curve by more than its length, in the background.
fn far_chain() -> (Script, Receiver<()>) {
    let line = |name: &str, from: (f64, f64), to: (f64, f64)| {
        let at = |step: u8| {
            let share = f64::from(step) / 7.0;
            (
                from.0 + share * (to.0 - from.0),
                from.1 + share * (to.1 - from.1),
            )
        };
        let points: Vec<(f64, f64)> = (0..8).map(at).collect();
        Curve::new(name, FloatPolygon::planar(3, &points).expect("a polygon"))
    };
    let curves = [
        line("a", (0.0, 0.0), (20.0, 0.0)),
        line("b", (50.0, 1.0), (70.0, 5.0)),
    ];
    let mut script = Script {
        editor: Editor::with_document(Document::from_curves(curves)),
    };
    let woken = prove_in_background(&mut script, Duration::ZERO);
    script.try_out("join").expect("an operation");
    script.set("method", Value::Choice(3)).expect("a method");
    (script, woken)
}

#[test]
fn a_result_that_warns_is_shown_before_it_is_applied() {
    let (mut script, woken) = far_chain();
    let operating = &mut script.editor.operating();
    operating.apply().expect("nothing is refused");
    finish(&mut script, &woken);
    check_held_back(&script);
    script.editor.operating().apply().expect("it is seen now");
    assert_eq!(script.steps(), 1);
}

#[test]
fn a_warning_that_was_seen_holds_nothing_back() {
    let (mut script, woken) = far_chain();
    finish(&mut script, &woken);
    let report = script
        .editor
        .operation()
        .and_then(OperationInProgress::report);
    assert!(report.is_some_and(|report| report.warnings.len() == 1));
    // Nothing is matched: the result stays the same.
    let drop = ("drop-match", Value::Switch(true));
    script.set(drop.0, drop.1).expect("a value");
    let operating = &mut script.editor.operating();
    operating.apply().expect("nothing is refused");
    finish(&mut script, &woken);
    assert_eq!(script.steps(), 1);
}

#[test]
fn the_best_found_is_shown_before_it_is_applied() {
    let wave = |index: u8| {
        let angle = 0.2 * f64::from(index);
        let radius = 10.0 + 0.3 * f64::from(index % 3);
        (radius * angle.cos(), radius * angle.sin())
    };
    let points: Vec<(f64, f64)> = (0..16).map(wave).collect();
    let polygon = FloatPolygon::planar(4, &points).expect("a polygon");
    let mut script = Script {
        editor: Editor::with_document(Document::from_curves([Curve::new("wave", polygon)])),
    };
    let woken = prove_in_background(&mut script, Duration::ZERO);
    script.try_out("harmonise").expect("an operation");
    script
        .set("extrema", Value::List(vec![0.0]))
        .expect("a number");
    let none = Value::List(vec![1e-9]);
    script.set("max-deviation", none).expect("a number");
    script
        .editor
        .operating()
        .apply()
        .expect("nothing is refused");
    finish(&mut script, &woken);
    check_held_back(&script);
    script.key(Key::Escape);
    let message = script.editor.message().expect("a message");
    assert_eq!(message.text, "Harmonise: cancelled");
    assert!(script.editor.previewed_operation().is_none());
}
