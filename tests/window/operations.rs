//! The operation panel: what it shows, and which keys are its own.

use batten::document::{Curve, Document};
use batten::editor::Editor;
use batten::geometry::{Continuity, End, FloatPolygon};
use batten::operations::Value;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use glam::DVec3;

use crate::hand::*;
use crate::numbers::{enter, wave};

/// Begin an operation from the palette.
fn begin(window: &mut Window, name: &str) {
    press(window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text(name.to_owned()));
    window.run();
    enter(window);
}

/// A window with a curve of five segments, an operation that is tried out on it, and the curve
/// before.
fn trying(name: &str) -> (Window, Curve) {
    let document = Document::from_curves([Curve::new("curve", wave(8, 3))]);
    let editor = Editor::with_document(document);
    let mut window = open_window_with(editor, 1480.0, 1300.0);
    let before = curve(&window);
    begin(&mut window, name);
    assert!(window.state().editor().previewed_operation().is_some());
    (window, before)
}

fn polygon(window: &Window) -> FloatPolygon {
    curve(window).polygon
}

fn steps(window: &Window) -> usize {
    let editor = window.state().editor();
    editor.workspace().history().undo_steps()
}

fn is_applied(window: &Window) -> bool {
    let trial = window.state().editor().operation();
    trial.is_some_and(|trial| trial.is_applied())
}

/// Type a number into a field of the panel.
fn give(window: &mut Window, field: &str, text: &str) {
    click(window, field);
    type_over(window, text);
    enter(window);
}

#[test]
fn the_panel_stands_where_the_inspector_is_and_leaves_the_canvas_free() {
    let (mut window, before) = trying("Extend curve");
    for label in ["Extend curve", "End", "Segments", "Apply", "Cancel"] {
        assert!(window.query_all_by_label(label).count() > 0, "{label}");
    }
    window.get_by_label_contains("Continue an end of the curve");
    assert_eq!(window.query_all_by_label("Name").count(), 0);
    window.get_by_label("Canvas");
    assert_ne!(curve(&window), before, "it is shown on the canvas");
    // Looking about leaves the panel where it is.
    let shown = curve(&window);
    press(&mut window, Modifiers::NONE, Key::Plus);
    press(&mut window, Modifiers::NONE, Key::H);
    press(&mut window, Modifiers::NONE, Key::Num1);
    assert!(window.state().editor().previewed_operation().is_some());
    assert_eq!(curve(&window), shown);
    click(&mut window, "Cancel");
    assert_eq!(curve(&window), before);
    assert_eq!(steps(&window), 0);
    window.get_by_label("Name");
    assert_eq!(window.query_all_by_label("Apply").count(), 0);
}

#[test]
fn the_report_is_shown_beside_the_values() {
    let (mut window, _) = trying("Split curve");
    window.get_by_label("Deviation: none, exact");
    window.get_by_label("Vertices of the first part: 5");
    window.get_by_label("Vertices of the second part: 6");
    window.get_by_label_contains("Curvature extrema: ");
    give(&mut window, "At u", "1");
    window.get_by_label("Vertices of the first part: 4");
    window.get_by_label("Vertices of the second part: 7");
    give(&mut window, "At u", "1.3");
    window.get_by_label_contains("Deviation: at most ");
    press(&mut window, Modifiers::NONE, Key::Escape);
    begin(&mut window, "Round coordinates");
    window.get_by_label_contains("Largest rounding of a vertex: ");
    window.get_by_label_contains("Largest move: ");
}

#[test]
fn enter_in_a_field_gives_the_value_and_enter_outside_applies() {
    let (mut window, before) = trying("Extend curve");
    let segments = before.polygon.segments();
    give(&mut window, "Segments", "3");
    assert!(
        window.state().editor().previewed_operation().is_some(),
        "the field's Enter"
    );
    assert_eq!(polygon(&window).segments(), segments + 3);
    assert_eq!(steps(&window), 0);
    click(&mut window, "Segments");
    type_over(&mut window, "9");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(
        window.state().editor().previewed_operation().is_some(),
        "the field's Esc"
    );
    assert_eq!(polygon(&window).segments(), segments + 3);
    enter(&mut window);
    assert!(is_applied(&window));
    assert_eq!(steps(&window), 1);
    assert_eq!(polygon(&window).segments(), segments + 3);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window), before);
}

#[test]
fn escape_cancels() {
    let (mut window, before) = trying("Round coordinates");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.state().editor().operation().is_none());
    assert_eq!(curve(&window), before);
    assert_eq!(steps(&window), 0);
    window.get_by_label("Name");
}

#[test]
fn a_number_that_is_typed_counts_when_the_button_is_clicked() {
    let (mut window, before) = trying("Extend curve");
    click(&mut window, "Segments");
    type_over(&mut window, "3");
    click(&mut window, "Apply");
    assert!(is_applied(&window));
    assert_eq!(steps(&window), 1);
    assert_eq!(polygon(&window).segments(), before.polygon.segments() + 3);
    let (mut window, before) = trying("Extend curve");
    click(&mut window, "Segments");
    type_over(&mut window, "3");
    click(&mut window, "Cancel");
    assert!(window.state().editor().operation().is_none());
    assert_eq!(curve(&window), before);
}

#[test]
fn after_apply_the_panel_stays_and_another_value_amends() {
    let (mut window, before) = trying("Extend curve");
    click(&mut window, "Apply");
    window.get_by_label("applied");
    assert_eq!(window.query_all_by_label("Apply").count(), 0);
    show_inspector(&mut window);
    window.get_by_label("Name");
    assert_eq!(window.query_all_by_label("Segments").count(), 0);
    click(&mut window, "Operation");
    let segments = before.polygon.segments();
    assert_eq!(polygon(&window).segments(), segments + 1);
    give(&mut window, "Segments", "4");
    assert_eq!(polygon(&window).segments(), segments + 4);
    assert_eq!(steps(&window), 1);
    assert!(is_applied(&window));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window), before);
    assert_eq!(window.query_all_by_label("applied").count(), 0);
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(polygon(&window).segments(), segments + 4);
}

#[test]
fn the_panel_of_the_last_operation_can_be_closed() {
    let (mut window, _) = trying("Extend curve");
    enter(&mut window);
    let applied = curve(&window);
    click(&mut window, "Close operation");
    assert_eq!(window.query_all_by_label("applied").count(), 0);
    assert_eq!(curve(&window), applied);
    assert_eq!(steps(&window), 1);
    // Esc does not take a step back either.
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(curve(&window), applied);
}

#[test]
fn a_number_out_of_range_is_refused_beside_its_field() {
    let (mut window, _) = trying("Extend curve");
    let shown = curve(&window);
    give(&mut window, "Segments", "0");
    window.get_by_label_contains("Only numbers from 1 to");
    assert_eq!(curve(&window), shown);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(
        window.state().editor().previewed_operation().is_some(),
        "the field's Esc"
    );
    enter(&mut window);
    assert_eq!(curve(&window), shown);
    assert!(is_applied(&window));
}

#[test]
fn values_that_make_no_curve_together_cannot_be_applied() {
    let (mut window, before) = trying("Trim curve");
    give(&mut window, "To u", "1");
    give(&mut window, "From u", "4");
    assert_eq!(curve(&window), before, "nothing is shown");
    enter(&mut window);
    click(&mut window, "Apply");
    assert!(window.state().editor().previewed_operation().is_some());
    assert_eq!(steps(&window), 0);
    give(&mut window, "From u", "0.5");
    enter(&mut window);
    assert!(is_applied(&window));
    assert_eq!(steps(&window), 1);
}

#[test]
fn a_field_that_is_dragged_is_called_off_by_escape_and_the_panel_stays() {
    use eframe::egui::vec2;
    let (mut window, _) = trying("Split curve");
    let shown = curve(&window);
    let field = window.get_by_label("At u").rect().center();
    window.hover_at(field);
    window.run();
    window.drag_at(field);
    window.step();
    window.hover_at(field + vec2(40.0, 0.0));
    window.step();
    window.step();
    assert_ne!(curve(&window), shown, "the drag is previewed");
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.drop_at(field + vec2(60.0, 0.0));
    window.run();
    assert!(window.state().editor().previewed_operation().is_some());
    assert_eq!(curve(&window), shown);
    click(&mut window, "Cancel");
    assert_eq!(steps(&window), 0);
}

#[test]
fn lists_of_numbers_are_typed_and_may_stay_empty() {
    let (mut window, before) = trying("Harmonise");
    give(&mut window, "Curvature extrema", "0");
    give(&mut window, "Inflections", "0");
    window.get_by_label("Extrema asked for: 0");
    assert!(
        window.state().editor().previewed_operation().is_some(),
        "Enter belongs to the field"
    );
    let harmonised = polygon(&window);
    assert_ne!(harmonised, before.polygon);
    give(&mut window, "Inflections", "x");
    window.get_by_label_contains("Inflections: a whole number is needed");
    assert_eq!(polygon(&window), harmonised);
    // Esc leaves the field as it was, and only then the panel.
    click(&mut window, "Inflections");
    type_over(&mut window, "3");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.state().editor().previewed_operation().is_some());
    assert_eq!(polygon(&window), harmonised);
    // No such curve is found, so that it is said twice.
    click(&mut window, "Apply anyway");
    assert_eq!(steps(&window), 1);
    assert_eq!(polygon(&window), harmonised);
}

#[test]
fn many_options_are_a_list_that_opens() {
    let (mut window, _) = trying("Harmonise");
    window.get_by_label("Keep ends");
    window.get_by_label("Keep ends").click();
    window.run();
    click(&mut window, "Curvature slope");
    let editor = window.state().editor();
    let trial = editor.operation().expect("it is tried out");
    let keep = trial.values().get(&trial.operation().parameters[0]);
    assert_eq!(*keep, batten::operations::Value::Choice(4));
}

/// A window of a size that many screens have, with an operation that is tried out on a noisy curve.
fn trying_in(width: f32, height: f32, name: &str, in_space: bool) -> Window {
    let vertices = (0..14).map(|index| {
        let x = f64::from(index);
        let z = if in_space { (0.3 * x).sin() } else { 0.0 };
        DVec3::new(x, (0.4 * x).cos() + 0.05 * (5.0 * x).sin(), z)
    });
    let polygon = FloatPolygon::new(4, vertices.collect(), None, false).expect("a polygon");
    let mut curve = Curve::new("curve", polygon);
    for end in End::BOTH {
        let mut target = Continuity::G1.target(&curve.polygon.end_jet(end), !in_space);
        target.point.x += 0.1;
        curve.targets.set(end, Some(target));
    }
    let editor = Editor::with_document(Document::from_curves([curve]));
    let mut window = open_window_with(editor, width, height);
    begin(&mut window, name);
    assert!(
        window.state().editor().previewed_operation().is_some(),
        "{name}"
    );
    window
}

#[test]
fn the_report_is_in_sight_without_scrolling() {
    for (width, height) in [(1440.0, 900.0), (1600.0, 1000.0)] {
        for name in [
            "Correct ends",
            "Harmonise",
            "Elevate degree",
            "Round coordinates",
        ] {
            for in_space in [false, true] {
                let mut window = trying_in(width, height, name, in_space);
                let in_sight = |window: &Window, when: &str| {
                    for label in ["Deviation: ", "Largest move: ", "Monotone: "] {
                        for row in window.query_all_by_label_contains(label) {
                            let bottom = row.rect().bottom();
                            assert!(
                                bottom < height - 24.0,
                                "{name} {when}, {label} at {bottom} of {height}"
                            );
                        }
                    }
                    let rows = window.query_all_by_label_contains("Monotone: ");
                    assert_eq!(rows.count(), 1, "{name} {when}");
                };
                in_sight(&window, "tried");
                enter(&mut window);
                if is_applied(&window) {
                    in_sight(&window, "applied");
                }
            }
        }
    }
}

#[test]
fn fields_of_curves_in_space_are_offered_for_those_alone() {
    for (name, field) in [
        ("Harmonise", "Torsion extrema"),
        ("Correct ends", "Start normal"),
    ] {
        for in_space in [false, true] {
            let window = trying_in(1480.0, 1300.0, name, in_space);
            let shown = window.query_all_by_label(field).count();
            assert_eq!(shown, usize::from(in_space), "{name}");
        }
    }
}

#[test]
fn a_list_counts_while_it_is_typed() {
    let mut window = trying_in(1480.0, 1300.0, "Correct ends", false);
    let shown = polygon(&window);
    click(&mut window, "Start curvature");
    type_over(&mut window, "-");
    assert_eq!(polygon(&window), shown, "no number yet");
    type_over(&mut window, "-0.5");
    let curved = |window: &Window| polygon(window).end_jet(End::Start).signed_curvature();
    assert!((curved(&window) + 0.5).abs() < 1e-9, "{}", curved(&window));
    // What is typed on goes on in the same field.
    window.event(Event::Text("5".to_owned()));
    window.run();
    assert!((curved(&window) + 0.55).abs() < 1e-9, "{}", curved(&window));
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(
        window.state().editor().previewed_operation().is_some(),
        "the field's Esc"
    );
    assert_eq!(polygon(&window), shown);
    give(&mut window, "Start curvature", "0.25");
    assert!((curved(&window) - 0.25).abs() < 1e-9, "{}", curved(&window));
    assert_eq!(steps(&window), 0);
}

#[test]
fn a_name_that_an_example_has_too_begins_the_operation() {
    let (window, _) = trying("Mineur");
    let trial = window.state().editor().operation().expect("an operation");
    assert_eq!(trial.operation().name, "mineur-farin");
}

#[test]
fn features_of_both_curves_are_told_with_their_parameters() {
    let (window, _) = trying("Approximate");
    let rows = window.query_all_by_label_contains("curvature level 1: ");
    assert!(rows.count() > 1);
    assert!(window.query_all_by_label_contains(" at t = ").count() > 0);
}

#[test]
fn arrow_keys_choose_in_a_drop_down() {
    let (mut window, _) = trying("Harmonise");
    let chosen = |window: &Window| {
        let operation = window.state().editor().operation().expect("an operation");
        let mut parameters = operation.operation().parameters.iter();
        let keep = parameters
            .find(|it| it.name == "keep")
            .expect("a parameter");
        operation.values().get(keep).clone()
    };
    assert_eq!(chosen(&window), Value::Choice(2));
    window.get_by_label("Keep ends").focus();
    window.run();
    for (key, expected) in [
        (Key::ArrowDown, 3),
        (Key::ArrowDown, 4),
        (Key::ArrowUp, 3),
        (Key::ArrowUp, 2),
        (Key::ArrowUp, 1),
        (Key::ArrowUp, 0),
        (Key::ArrowUp, 0),
    ] {
        press(&mut window, Modifiers::NONE, key);
        assert_eq!(chosen(&window), Value::Choice(expected), "{key:?}");
    }
}
