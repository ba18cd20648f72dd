//! The plots under the canvas: zoomed by the wheel, moved by a drag, fitted again.

use eframe::egui::{Event, Key, Modifiers, MouseWheelUnit, Pos2, TouchPhase, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::hand::*;

/// A place on the plot: a share of its width from its left edge.
fn on_plot(window: &Window, share: f32) -> Pos2 {
    let canvas = window.state().canvas_rect().expect("the canvas was shown");
    let width = canvas.width() - 110.0;
    canvas.left_bottom() + vec2(90.0 + share * width, 110.0)
}

/// The parameter of the curve that is marked while the pointer is on the plot.
fn hovered(window: &mut Window, share: f32) -> f64 {
    let at = on_plot(window, share);
    window.hover_at(at);
    window.run();
    window.run();
    let u = window.state().editor().sight().readout().parameter;
    u.unwrap_or_else(|| panic!("nothing is hovered at {share}"))
}

fn turn(window: &mut Window, modifiers: Modifiers, lines: f32) {
    window.event(Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: vec2(0.0, lines),
        phase: TouchPhase::Move,
        modifiers,
        source: eframe::egui::MouseWheelSource::Wheel,
    });
    window.run();
    window.run();
}

/// Whether the plot in front can be fitted: it has been zoomed or moved.
fn is_moved(window: &Window) -> bool {
    let button = window.get_by_label("Fit the plot");
    !button.accesskit_node().is_disabled()
}

const SHARES: [f32; 4] = [0.15, 0.35, 0.6, 0.85];

fn all(window: &mut Window) -> [f64; 4] {
    SHARES.map(|share| hovered(window, share))
}

fn same(a: &[f64], b: &[f64]) -> bool {
    a.iter()
        .zip(b)
        .all(|(a, b)| (a - b).abs() < 2e-3 * (1.0 + a.abs()))
}

#[test]
fn the_wheel_zooms_to_the_pointer_and_a_double_click_fits() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Waterline"]);
    click(&mut window, "Curvature");
    let before = all(&mut window);
    assert!(before.is_sorted() && !is_moved(&window));
    hovered(&mut window, 0.35);
    turn(&mut window, Modifiers::NONE, 4.0);
    let zoomed = all(&mut window);
    assert!(is_moved(&window));
    // What is under the pointer stays there, all else moves away from it.
    assert!(same(&zoomed[1..2], &before[1..2]), "{zoomed:?} {before:?}");
    assert!(zoomed[0] > before[0] && zoomed[3] < before[3]);
    // Other tabs have views of their own, and this one keeps its.
    click(&mut window, "Harmony strips");
    assert!(!is_moved(&window));
    click(&mut window, "Curvature");
    assert!(is_moved(&window));
    assert!(same(&all(&mut window), &zoomed));
    let at = on_plot(&window, 0.6);
    double_click(&mut window, at);
    assert!(!is_moved(&window));
    assert!(same(&all(&mut window), &before));
}

#[test]
fn a_drag_moves_the_plot_and_its_button_and_key_fit_it() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Waterline"]);
    let before = all(&mut window);
    let [from, to] = [0.6, 0.35].map(|share| on_plot(&window, share));
    drag(&mut window, from, to);
    let moved = hovered(&mut window, 0.35);
    assert!(same(&[moved], &before[2..3]), "{moved} {before:?}");
    click(&mut window, "Fit the plot");
    window.run();
    assert!(same(&all(&mut window), &before));
    drag(&mut window, from, to);
    assert!(is_moved(&window));
    press(&mut window, Modifiers::SHIFT, Key::F8);
    window.run();
    assert!(!is_moved(&window));
    assert!(same(&all(&mut window), &before));
}

#[test]
fn the_view_of_a_plot_stays_while_a_vertex_is_dragged() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Waterline"]);
    hovered(&mut window, 0.15);
    turn(&mut window, Modifiers::NONE, 3.0);
    let zoomed = all(&mut window);
    // A vertex at the far end leaves what is looked at as it is.
    let count = curve(&window).polygon.vertices().len();
    let from = vertex(&window, count - 2);
    drag(&mut window, from, from + vec2(0.0, -20.0));
    assert!(is_moved(&window));
    let after = all(&mut window);
    assert!(same(&after[..1], &zoomed[..1]), "{after:?} {zoomed:?}");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(same(&all(&mut window), &zoomed));
}

#[test]
fn another_curve_is_seen_as_a_whole() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Waterline"]);
    hovered(&mut window, 0.35);
    turn(&mut window, Modifiers::NONE, 3.0);
    assert!(is_moved(&window));
    choose(&mut window, &["File", "Examples", "Bottle"]);
    hovered(&mut window, 0.5);
    let is_first = window.state().editor().document().len() == 1;
    assert!(is_first);
    assert!(window.state().editor().active().is_some());
}

#[test]
fn strips_are_zoomed_together_and_one_direction_alone_with_shift() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Waterline"]);
    click(&mut window, "Harmony strips");
    let vertex = |window: &mut Window, share: f32, down: f32| {
        let at = on_plot(window, share) + vec2(0.0, down);
        window.hover_at(at);
        window.run();
        window.run();
        let found = window.state().editor().sight().hovered_vertex();
        found.unwrap_or_else(|| panic!("no vertex at {share}"))
    };
    let last = vertex(&mut window, 0.95, 0.0);
    vertex(&mut window, 0.5, 0.0);
    turn(&mut window, Modifiers::SHIFT, 4.0);
    for down in [0.0, 60.0] {
        assert!(vertex(&mut window, 0.95, down) < last);
    }
    assert!(is_moved(&window));
    click(&mut window, "Fit the plot");
    assert_eq!(vertex(&mut window, 0.95, 0.0), last);
}

#[test]
fn hovering_a_feature_in_the_plot_marks_it_exactly() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Bottle"]);
    let editor = window.state().editor();
    let report = editor.sight().features().expect("features").clone();
    let length = editor.view().plots().length;
    let feature = editor.view().plots().features[1];
    assert_eq!(feature.kind, report.rows[1].kind);
    // Where the pointer is far above or below the glyph, the curve is marked where the pointer is.
    let share = 0.02 + 0.94 * (feature.at.x / length) as f32;
    let canvas = window.state().canvas_rect().expect("the canvas was shown");
    let mut exactly = 0;
    for step in 0..30 {
        let at = on_plot(&window, share) + vec2(step as f32 - 15.0, 0.0);
        let down = (0..10).map(|row| canvas.bottom() + 44.0 + 16.0 * row as f32);
        for y in down {
            window.hover_at(Pos2::new(at.x, y));
            window.step();
            window.step();
            let u = window.state().editor().sight().readout().parameter;
            exactly += u32::from(u.is_some_and(|u| (u - report.rows[1].middle).abs() < 1e-9));
        }
    }
    assert!(exactly >= 4, "{exactly}: {feature:?}");
}

#[test]
fn the_status_bar_says_what_the_mouse_does_to_the_plot() {
    let mut window = open_window();
    let says = |window: &Window| {
        let hints = window.query_all_by_label_contains("Wheel zooms, drag pans");
        hints.count() > 0
    };
    let at = on_plot(&window, 0.5);
    window.hover_at(at);
    window.run();
    assert!(says(&window));
    let canvas = window.state().canvas_rect().expect("the canvas was shown");
    window.hover_at(canvas.center());
    window.run();
    assert!(!says(&window));
    press(&mut window, Modifiers::NONE, Key::F8);
    window.hover_at(at);
    window.run();
    assert!(!says(&window), "there is no plot");
}
