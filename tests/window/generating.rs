//! The panel of a curve made of its parameters alone: fields, handles on the canvas, atlas.

use batten::editor::PlotKind;
use batten::operations::Value;
use eframe::egui::{Event, Key, Modifiers, Pos2, Rect, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::hand::*;
use crate::numbers::enter;

/// A window in which the example of the paper's figure 2 is tried out beside the arc.
fn figure_2() -> Window {
    let mut window = open_window_of(1480.0, 1300.0);
    press(&mut window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text("Mineur–Farin curve".to_owned()));
    window.run();
    enter(&mut window);
    for (field, text) in [
        ("Legs", "4"),
        ("Degree", "4"),
        ("Length ratio s", "2"),
        ("Turning angle θ", "90"),
    ] {
        click(&mut window, field);
        type_over(&mut window, text);
        enter(&mut window);
    }
    assert!(window.state().editor().previewed_operation().is_some());
    window
}

fn real(window: &Window, name: &str) -> f64 {
    let trial = window.state().editor().operation().expect("an operation");
    let mut parameters = trial.operation().parameters.iter();
    let parameter = parameters.find(|parameter| parameter.name == name);
    match trial.values().get(parameter.expect("a parameter")) {
        Value::Real(number) => *number,
        other => panic!("{other:?}"),
    }
}

/// Where the atlas is, once it is proved.
fn atlas(window: &mut Window) -> Rect {
    let is_done = |window: &Window| {
        let verdicts = window.state().editor().view().atlas();
        verdicts.is_some_and(|(_, verdicts)| verdicts.is_finest())
    };
    for _ in 0..8 {
        window.run();
        if is_done(window) {
            break;
        }
    }
    assert!(is_done(window));
    window.get_by_label_contains("Atlas: ").rect()
}

/// The point of a rectangle at shares of its width and height.
fn within(rect: Rect, across: f32, up: f32) -> Pos2 {
    rect.left_bottom() + vec2(across * rect.width(), -up * rect.height())
}

#[test]
fn the_panel_tells_the_proved_verdict_beside_the_atlas() {
    let mut window = figure_2();
    atlas(&mut window);
    window.get_by_label("Atlas: Turning angle θ 90, Length ratio s 2");
    window.get_by_label("Monotone: – before, yes after");
    click(&mut window, "Bézier");
    window.get_by_label("Monotone: – before, no after");
    window.get_by_label("Bézier monotone, closed form: no");
    window.get_by_label("Bézier curves: closed form");
    click(&mut window, "Both");
    window.get_by_label("Monotone: – before, yes, no after");
    // Both curvatures are plotted.
    let editor = window.state().editor();
    let operation = editor.operation().expect("an operation");
    let made = operation.made_curves(editor.document());
    let view = window.state().editor().view();
    assert_eq!(view.plot, Some(PlotKind::CURVATURE));
    assert_eq!(editor.sight().compared(), Some(made[1]));
    let plots = window.state().editor().view().plots();
    assert!(
        plots
            .compared
            .as_ref()
            .is_some_and(|other| !other.series.is_empty())
    );
}

#[test]
fn a_click_and_a_drag_in_the_atlas_set_angle_and_ratio_at_once() {
    let mut window = figure_2();
    let rect = atlas(&mut window);
    let pixel = 181.0 / f64::from(rect.width());
    let at = |window: &Window| (real(window, "angle").to_degrees(), real(window, "ratio"));
    let near = |(angle, ratio): (f64, f64), (expected, other): (f64, f64)| {
        (angle - expected).abs() < pixel && (ratio.log2() - other.log2()).abs() < 0.03
    };
    let from = within(rect, 0.25, 0.5);
    window.hover_at(from);
    window.run();
    window.drag_at(from);
    window.step();
    window.drop_at(from);
    window.run();
    assert!(near(at(&window), (45.0, 1.0)), "{:?}", at(&window));
    drag(&mut window, from, within(rect, 0.75, 0.25));
    assert!(near(at(&window), (135.0, 0.5)), "{:?}", at(&window));
    // Beyond the edge it stays at the edge.
    drag(
        &mut window,
        within(rect, 0.75, 0.25),
        within(rect, 0.5, 1.2),
    );
    assert!(near(at(&window), (90.0, 4.0)), "{:?}", at(&window));
    window.get_by_label("Apply").click();
    window.run();
    let history = window.state().editor().workspace().history();
    assert_eq!(history.undo_steps(), 1);
    // What is applied may still be changed there, as the same step.
    let rect = atlas(&mut window);
    drag(&mut window, within(rect, 0.5, 0.9), within(rect, 0.25, 0.5));
    assert!(near(at(&window), (45.0, 1.0)), "{:?}", at(&window));
    let history = window.state().editor().workspace().history();
    assert_eq!(history.undo_steps(), 1);
}

#[test]
fn escape_puts_the_point_of_the_atlas_back() {
    let mut window = figure_2();
    let rect = atlas(&mut window);
    let shown = curve(&window);
    let from = within(rect, 0.5, 0.75);
    window.hover_at(from);
    window.run();
    window.drag_at(from);
    window.step();
    window.hover_at(within(rect, 0.3, 0.4));
    window.step();
    assert_ne!(curve(&window), shown);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(curve(&window), shown);
    assert!(window.state().editor().previewed_operation().is_some());
    window.hover_at(within(rect, 0.2, 0.2));
    window.step();
    window.drop_at(within(rect, 0.2, 0.2));
    window.run();
    assert_eq!(curve(&window), shown);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.state().editor().previewed_operation().is_none());
    assert_eq!(window.state().editor().document().len(), 1);
}

#[test]
fn undo_in_a_drag_in_the_atlas_takes_back_the_drag_alone() {
    let mut window = figure_2();
    let rect = atlas(&mut window);
    let shown = curve(&window);
    let from = within(rect, 0.5, 0.75);
    window.hover_at(from);
    window.run();
    window.drag_at(from);
    window.step();
    for across in [0.4, 0.3] {
        window.hover_at(within(rect, across, 0.4));
        window.step();
    }
    assert_ne!(curve(&window), shown);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window), shown);
    window.hover_at(within(rect, 0.2, 0.2));
    window.step();
    window.drop_at(within(rect, 0.2, 0.2));
    window.run();
    assert_eq!(curve(&window), shown);
    assert!(window.state().editor().previewed_operation().is_some());
    // A drag that comes to its end is one change.
    drag(&mut window, from, within(rect, 0.3, 0.4));
    assert_ne!(curve(&window), shown);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window), shown);
    assert!(window.state().editor().previewed_operation().is_some());
}

#[test]
fn a_handle_on_the_canvas_changes_the_fields() {
    let mut window = figure_2();
    let from = vertex(&window, 2);
    window.hover_at(from);
    window.run();
    drag(&mut window, from, from + vec2(30.0, 0.0));
    let field = real(&window, "ratio");
    assert!(field > 2.0, "{field}");
    let label = window.get_by_label("Length ratio s");
    let shown = label.accesskit_node().value().unwrap_or_default();
    assert!(
        shown.starts_with(&field.to_string()[..4]),
        "{shown} {field}"
    );
    enter(&mut window);
    assert!(window.state().editor().previewed_operation().is_none());
}
