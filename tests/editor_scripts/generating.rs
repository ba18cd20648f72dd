//! Curves that an operation makes of its parameters alone: preview, handles on the canvas, atlas.

use batten::editor::{Button, Command, Editor, HoverScene, Input, Key, Mark, Modifiers, ToolKind};
use batten::geometry::features::Verdict;
use batten::operations::{Handle, Value};
use glam::{DVec2, DVec3};

use super::script::*;

const NAME: &str = "mineur-farin";

/// The example of the paper's figure 2, tried out beside a curve that is there.
fn figure_2() -> Script {
    let mut script = Script::example("arc");
    script.try_out(NAME).expect("it can run");
    for (name, value) in [
        ("legs", Value::Whole(4)),
        ("degree", Value::Whole(4)),
        ("ratio", Value::Real(2.0)),
        ("angle", Value::Real(90.0_f64.to_radians())),
    ] {
        script.set(name, value).expect("a value in range");
    }
    script.command(Command::FitAll);
    script
}

fn handle(editor: &Editor, index: usize) -> Handle {
    let run = editor.operation().and_then(|trial| trial.run());
    run.expect("a run")
        .as_ref()
        .expect("a curve")
        .outcome
        .handles[index]
}

fn at_handle(script: &Script, index: usize) -> DVec2 {
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(handle(&script.editor, index).at))
}

fn value(script: &Script, name: &str) -> Value {
    let trial = script.editor.operation().expect("an operation");
    let mut parameters = trial.operation().parameters.iter();
    let parameter = parameters.find(|parameter| parameter.name == name);
    trial.values().get(parameter.expect("a parameter")).clone()
}

fn real(script: &Script, name: &str) -> f64 {
    match value(script, name) {
        Value::Real(number) => number,
        other => panic!("{other:?}"),
    }
}

fn marks(script: &mut Script) -> Vec<bool> {
    let marks = script.scene().marks.iter();
    let marked = marks.filter_map(|mark| match mark {
        Mark::Handle { marked, .. } => Some(*marked),
        _ => None,
    });
    marked.collect()
}

#[test]
fn a_curve_that_would_be_a_speck_is_gone_to_with_a_comb_of_its_size() {
    let tried_beside = |name, command| {
        let mut script = Script::example(name);
        script.command(command);
        let before = (
            *script.editor.view().viewport(),
            script.editor.view().comb(),
        );
        script.try_out(NAME).expect("it can run");
        (script, before)
    };
    // Ten units beside a hull of 8 400.
    let (script, (view, comb)) = tried_beside("hull", Command::FitAll);
    let apart = at_handle(&script, 0).distance(at_handle(&script, 3));
    assert!(apart > 150.0, "{apart}");
    assert!(script.editor.view().viewport().scale > 10.0 * view.scale);
    assert!(script.editor.view().comb().scale < 1e-2 * comb.scale);
    // What is seen well stays where it is.
    let (script, (view, comb)) = tried_beside("arc", Command::ZoomOut);
    assert_eq!(*script.editor.view().viewport(), view);
    assert_eq!(script.editor.view().comb(), comb);
}

#[test]
fn the_curve_that_is_made_is_active_and_in_view_while_it_is_tried_out() {
    let mut script = Script::example("s-curve");
    let (own, before) = (script.curve(), script.editor.document().clone());
    // Look somewhere else: what is made comes into view.
    script.input(Input::Panned {
        by: DVec2::new(1e5, 0.0),
    });
    script.try_out(NAME).expect("it can run");
    let made = script.curve();
    assert_ne!(made, own);
    assert_eq!(script.made_curves(), [made]);
    let view = script.editor.view().viewport().view_box();
    for vertex in script.polygon().vertices() {
        let seen = vertex.truncate();
        assert!(seen.cmpge(view.low).all() && seen.cmple(view.high).all());
    }
    script.key(Key::Escape);
    assert!(script.editor.document().is_same(&before));
    assert_eq!(script.curve(), own);
    assert_eq!(script.steps(), 0);
}

#[test]
fn it_is_applied_as_one_step_and_may_be_changed_afterwards() {
    let mut script = figure_2();
    let before = script.editor.workspace().settled().clone();
    script.key(Key::Enter);
    let made = script.curve();
    assert_eq!(script.steps(), 1);
    assert_eq!(script.editor.document().len(), before.len() + 1);
    script.set("legs", Value::Whole(7)).expect("a count");
    assert_eq!((script.steps(), script.curve()), (1, made));
    assert_eq!(script.polygon().vertices().len(), 8);
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
    script.command(Command::Redo);
    assert_eq!(script.polygon().vertices().len(), 8);
}

#[test]
fn it_begins_in_an_empty_document_too() {
    let mut script = Script::example("arc");
    script.editor.begin_empty();
    script.try_out(NAME).expect("it can run");
    assert_eq!(script.editor.document().len(), 1);
    script.key(Key::Escape);
    assert!(script.editor.document().is_empty());
    script.try_out(NAME).expect("it can run");
    script.key(Key::Enter);
    assert_eq!((script.editor.document().len(), script.steps()), (1, 1));
}

#[test]
fn the_third_point_sets_ratio_and_angle() {
    let mut script = figure_2();
    assert_eq!(marks(&mut script), [false; 4]);
    let (from, by) = (at_handle(&script, 2), DVec2::new(40.0, -25.0));
    // A pointer beside the middle of the handle keeps its distance to it.
    let off = DVec2::new(3.0, 2.0);
    script.move_to(from + off);
    assert_eq!(marks(&mut script), [false, false, true, false]);
    let Some(HoverScene::Handle { text, .. }) = script.scene().hover.clone() else {
        panic!("{:?}", script.scene().hover);
    };
    assert_eq!(text, "Length ratio s 2.000000\nTurning angle θ 90.00000°");
    assert!(script.editor.hint().contains("Drag the handle"));
    script.press(from + off);
    script.move_to(from + off + 0.5 * by);
    script.move_to(from + off + by);
    assert!(script.drags_handle());
    assert!(at_handle(&script, 2).distance(from + by) < 1e-6);
    let to = handle(&script.editor, 2).at - DVec3::X;
    assert!((real(&script, "ratio") - to.length()).abs() < 1e-12);
    assert!((real(&script, "angle") - to.y.atan2(to.x)).abs() < 1e-12);
    // The first two points stay.
    assert_eq!(handle(&script.editor, 1).at, DVec3::X);
    script.release(from + off + by);
    assert!(!script.drags_handle());
    assert!(script.editor.previewed_operation().is_some());
    script.key(Key::Enter);
    assert_eq!(script.steps(), 1);
    assert_eq!(marks(&mut script), [false; 0]);
}

#[test]
fn escape_puts_a_handle_back_and_then_ends_the_operation() {
    let mut script = figure_2();
    let before = script.editor.workspace().settled().clone();
    let shown = script.editor.document().clone();
    for index in 0..3 {
        let from = at_handle(&script, index);
        script.press(from);
        script.move_to(from + DVec2::new(30.0, 40.0));
        assert!(!script.editor.document().is_same(&shown));
        script.key(Key::Escape);
        assert!(script.editor.document().is_same(&shown), "handle {index}");
        assert!(script.editor.previewed_operation().is_some() && !script.drags_handle());
        script.release(from);
    }
    script.key(Key::Escape);
    assert!(script.editor.previewed_operation().is_none());
    assert!(script.editor.document().is_same(&before));
}

/// A place on the canvas far from every handle and curve.
const NOWHERE: DVec2 = DVec2::new(7.0, 9.0);

#[test]
fn a_press_beside_the_handles_leaves_the_operation_alone() {
    for tool in [ToolKind::Select, ToolKind::Draw] {
        let mut script = Script::example("arc");
        script.tool(tool);
        script.try_out(NAME).expect("it can run");
        script.set("ratio", Value::Real(1.7)).expect("a ratio");
        script.command(Command::FitAll);
        let shown = script.editor.document().clone();
        let vertex = script.at_vertex(4);
        for from in [NOWHERE, vertex] {
            script.click(from);
            script.drag(from, from + DVec2::new(30.0, 20.0));
            assert!(
                script.editor.previewed_operation().is_some(),
                "{tool:?} at {from}"
            );
            assert!(script.editor.document().is_same(&shown));
            assert_eq!(real(&script, "ratio"), 1.7);
        }
    }
    // The view stays free.
    let mut script = figure_2();
    let before = script.editor.view().viewport().centre;
    script.drag_with(Button::Middle, NOWHERE, NOWHERE + DVec2::new(30.0, 20.0));
    assert_ne!(script.editor.view().viewport().centre, before);
    script.input(Input::DoubleClicked { at: NOWHERE });
    assert!(script.editor.previewed_operation().is_some());
    // A vertex says what comes first.
    let vertex = script.at_vertex(3);
    script.press(vertex);
    script.move_to(vertex + DVec2::new(30.0, 20.0));
    assert!(script.message().starts_with("Apply or cancel"));
    script.release(vertex);
}

#[test]
fn undo_takes_a_drag_of_a_handle_back_then_changes_of_values_and_only_then_the_operation() {
    let mut script = figure_2();
    let (ratio, angle) = (real(&script, "ratio"), real(&script, "angle"));
    let shown = script.editor.document().clone();
    let (from, by) = (at_handle(&script, 2), DVec2::new(40.0, -25.0));
    script.press(from);
    script.move_to(from + 0.5 * by);
    script.move_to(from + by);
    script.command(Command::Undo);
    assert!(script.editor.previewed_operation().is_some() && !script.drags_handle());
    assert!(script.editor.document().is_same(&shown));
    // The rest of the drag does nothing.
    script.move_to(from + 2.0 * by);
    script.release(from + 2.0 * by);
    assert!(script.editor.document().is_same(&shown));
    // A drag is one change, however far it went, and so is a field's.
    script.drag(from, from + by);
    script.editor.operating().hold_values();
    for ratio in [1.1, 1.2, 1.3] {
        script.set("ratio", Value::Real(ratio)).expect("a ratio");
    }
    script.editor.operating().keep_values();
    assert_eq!(
        Command::Undo.label_now(&script.editor),
        "Undo change of values"
    );
    script.command(Command::Undo);
    let dragged = (real(&script, "ratio"), real(&script, "angle"));
    assert_ne!(dragged, (ratio, angle));
    assert!(at_handle(&script, 2).distance(from + by) < 1e-6);
    script.command(Command::Undo);
    assert_eq!(
        (real(&script, "ratio"), real(&script, "angle")),
        (ratio, angle)
    );
    assert!(script.editor.document().is_same(&shown));
    // Four values were given at first.
    for _ in 0..4 {
        script.command(Command::Undo);
        assert!(script.editor.previewed_operation().is_some());
    }
    script.command(Command::Undo);
    assert!(script.editor.previewed_operation().is_none());
    assert_eq!(script.message(), "Mineur–Farin curve: cancelled");
}

#[test]
fn the_last_point_sets_ratio_and_angle_so_that_it_follows() {
    let mut script = figure_2();
    script.command(Command::ToggleSnapping);
    script.set("ratio", Value::Real(1.2)).expect("a ratio");
    let angle = Value::Real(25f64.to_radians());
    script.set("angle", angle).expect("an angle");
    script.set("legs", Value::Whole(6)).expect("legs");
    script.command(Command::FitAll);
    let from = at_handle(&script, 3);
    for by in [
        DVec2::new(40.0, -25.0),
        DVec2::new(-90.0, 60.0),
        DVec2::new(3.0, 140.0),
    ] {
        let before = (real(&script, "ratio"), real(&script, "angle"));
        script.press(from);
        script.move_to(from + 0.5 * by);
        script.move_to(from + by);
        assert!(at_handle(&script, 3).distance(from + by) < 1e-6, "{by}");
        let last = script.polygon().vertex(6);
        assert!(last.distance(handle(&script.editor, 3).at) < 1e-9);
        assert_ne!((real(&script, "ratio"), real(&script, "angle")), before);
        // The first leg stays.
        assert_eq!(handle(&script.editor, 1).at, DVec3::X);
        script.key(Key::Escape);
        assert_eq!((real(&script, "ratio"), real(&script, "angle")), before);
        script.release(from);
    }
    // Of two legs the last point is the third.
    script.set("degree", Value::Whole(2)).expect("a degree");
    script.set("legs", Value::Whole(2)).expect("legs");
    assert_eq!(marks(&mut script).len(), 3);
}

#[test]
fn start_and_first_leg_are_dragged_and_shift_constrains() {
    let mut script = figure_2();
    script.command(Command::ToggleSnapping);
    script.modifiers(Modifiers::SHIFT);
    let from = at_handle(&script, 0);
    script.drag(from, from + DVec2::new(50.0, 9.0));
    let Value::List(start) = value(&script, "start") else {
        panic!("no list");
    };
    assert!(start[0] > 0.0 && start[1] == 0.0, "{start:?}");
    let from = at_handle(&script, 1);
    script.drag(from, from + DVec2::new(-5.0, -60.0));
    let Value::List(leg) = value(&script, "first-leg") else {
        panic!("no list");
    };
    assert!(leg[0] == 1.0 && leg[1] > 0.0, "{leg:?}");
    let from = at_handle(&script, 2);
    script.drag(from, from + DVec2::new(33.0, -21.0));
    let angle = real(&script, "angle").to_degrees() / 15.0;
    assert!((angle - angle.round()).abs() < 1e-12, "{angle}");
    script.modifiers(Modifiers::NONE);
}

#[test]
fn a_handle_that_would_make_no_curve_says_so_and_stays() {
    let mut script = figure_2();
    script.command(Command::ToggleSnapping);
    let [second, third] = [1, 2].map(|index| at_handle(&script, index));
    script.press(third);
    script.move_to(0.5 * (second + third));
    let ratio = real(&script, "ratio");
    // A third point on the second has no ratio.
    script.move_to(second);
    assert_eq!(real(&script, "ratio"), ratio);
    assert!(
        script.message().contains("Length ratio s"),
        "{}",
        script.message()
    );
    script.move_to(third);
    assert_eq!(script.message(), "");
    script.release(third);
}

#[test]
fn applying_in_the_middle_of_a_drag_ends_it() {
    let mut script = figure_2();
    let from = at_handle(&script, 2);
    script.press(from);
    script.move_to(from + DVec2::new(30.0, 0.0));
    script.key(Key::Enter);
    assert_eq!(script.steps(), 1);
    let made = script.editor.document().clone();
    script.move_to(from + DVec2::new(90.0, 0.0));
    script.release(from + DVec2::new(90.0, 0.0));
    assert!(script.editor.document().is_same(&made));
    assert_eq!(script.steps(), 1);
}

#[test]
fn something_else_that_is_begun_takes_it_back() {
    let mut script = figure_2();
    let before = script.editor.workspace().settled().clone();
    let from = at_handle(&script, 1);
    script.press(from);
    script.move_to(from + DVec2::new(30.0, 0.0));
    script.try_out("reverse").expect("it can run");
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn both_polygons_make_two_curves_of_which_one_is_active() {
    let mut script = figure_2();
    script.set("polygon", Value::Choice(2)).expect("both");
    let made = script.made_curves();
    assert_eq!(made.len(), 2);
    assert_eq!(script.curve(), made[0]);
    assert_eq!(script.editor.sight().compared(), Some(made[1]));
    // The other one may be looked at.
    script.editor.activate(made[1]);
    script.set("ratio", Value::Real(1.9)).expect("a ratio");
    assert_eq!(script.curve(), made[1]);
    assert_eq!(script.editor.sight().compared(), Some(made[0]));
    script.key(Key::Enter);
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    assert_eq!(script.editor.document().len(), 1);
}

#[test]
fn the_atlas_is_proved_from_coarse_to_fine_while_it_is_shown() {
    let mut script = figure_2();
    assert!(script.editor.view().atlas().is_none());
    script.editor.view_mut().shows_atlas = true;
    let mut pictures = 0;
    loop {
        script.editor.refresh();
        pictures += 1;
        let found = script.editor.view().atlas().expect("a picture").1;
        if found.is_finest() {
            break;
        }
    }
    assert_eq!(pictures, 4);
    let run = script.editor.operation().and_then(|trial| trial.run());
    let atlas = run.expect("a run").as_ref().expect("a curve").outcome.atlas;
    let atlas = atlas.expect("an atlas");
    // The verdict at a place is that of the curve that it makes.
    for (place, expected) in [
        ([0.5025, 0.7525], Verdict::Proved),
        ([0.8025, 0.7525], Verdict::Disproved),
    ] {
        let cell = place.map(|share: f64| (share * 200.0) as usize);
        let found = script.editor.view().atlas().expect("a picture").1;
        assert_eq!(found.verdict(cell[0], cell[1]), expected);
        script
            .editor
            .operating()
            .set_values(&atlas.values(place))
            .expect("values");
        script.editor.refresh();
        let features = script.trial_report().features.expect("features");
        assert_eq!(features.after[0].monotone, expected);
    }
    // Another degree is another question.
    script.set("degree", Value::Whole(3)).expect("a degree");
    let found = script.editor.view().atlas().expect("a picture").1;
    assert!(!found.is_finest());
    script.editor.view_mut().shows_atlas = false;
    script.editor.refresh();
    assert!(script.editor.view().atlas().is_none());
}
