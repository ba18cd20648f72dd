//! What the canvas, its badge and its messages do with clicks and keys.

use batten::editor::{Command, Follow, Layer, Orientation};
use eframe::egui::accesskit::Toggled;
use eframe::egui::{Event, Key, Modifiers, PointerButton, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::hand::*;

#[test]
fn digits_typed_while_drawing_switch_no_layers() {
    let mut window = open_window();
    let layers = window.state().editor().sight().layers();
    press(&mut window, Modifiers::NONE, Key::D);
    let first = vertex(&window, 2);
    drag(&mut window, first, first);
    for key in [Key::Num1, Key::Num2, Key::Num5, Key::Minus] {
        press(&mut window, Modifiers::NONE, key);
    }
    assert_eq!(window.state().editor().sight().layers(), layers);
    press(&mut window, Modifiers::NONE, Key::Escape);
    press(&mut window, Modifiers::NONE, Key::V);
    press(&mut window, Modifiers::NONE, Key::Num1);
    assert!(!window.state().editor().sight().layers().shows(Layer::Float));
}

#[test]
fn digits_typed_during_a_drag_switch_no_layers() {
    let mut window = open_window();
    let layers = window.state().editor().sight().layers();
    let from = vertex(&window, 2);
    window.hover_at(from);
    window.run();
    window.drag_at(from);
    window.step();
    window.hover_at(from + vec2(30.0, 10.0));
    window.step();
    for key in [Key::Num1, Key::Num2, Key::Num5] {
        press(&mut window, Modifiers::NONE, key);
    }
    assert!(window.state().editor().hand().is_holding());
    assert_eq!(window.state().editor().sight().layers(), layers);
    window.drop_at(from + vec2(30.0, 10.0));
    window.run();
    press(&mut window, Modifiers::NONE, Key::Num1);
    assert!(!window.state().editor().sight().layers().shows(Layer::Float));
}

#[test]
fn a_message_about_a_deletion_undoes_it() {
    let mut window = open_window();
    let before = curve(&window);
    press(&mut window, Modifiers::COMMAND, Key::Delete);
    assert!(window.state().editor().document().is_empty());
    click(&mut window, "Undo");
    assert_eq!(curve(&window), before);
    assert!(window.query_by_label("Dismiss message").is_some());
}

#[test]
fn a_badge_leads_back_from_a_stray_turn_of_the_view() {
    let mut window = open_window();
    assert!(window.query_by_label("Not from above · F3").is_none());
    let canvas = window.state().canvas_rect().expect("the canvas was shown");
    let from = canvas.center();
    window.hover_at(from);
    for (pos, pressed) in [(from, true), (from + vec2(20.0, 35.0), false)] {
        window.event(Event::PointerMoved(pos));
        window.event(Event::PointerButton {
            pos,
            button: PointerButton::Secondary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.run();
    }
    assert_ne!(
        window.state().editor().view().viewport().orientation,
        Orientation::XY
    );
    click(&mut window, "Not from above · F3");
    assert_eq!(
        window.state().editor().view().viewport().orientation,
        Orientation::XY
    );
    assert!(window.query_by_label("Not from above · F3").is_none());
}

#[test]
fn vertices_are_dragged_in_panes() {
    let mut window = open_window();
    let whole = window.state().canvas_rect().expect("a canvas");
    choose(&mut window, &["View", "Panes", "Four panes"]);
    for name in ["Top", "Isometric", "Front", "Right"] {
        assert!(
            window.query_by_label(&format!("Pane: {name}")).is_some(),
            "{name}"
        );
    }
    // The gizmo and the badge belong to a single view.
    assert!(window.query_by_label_contains("Axes: drag").is_none());
    for (along, height, kept) in [(-0.25, -0.25, 2), (-0.25, 0.25, 1), (0.25, 0.25, 0)] {
        let middle = whole.center();
        let away = vec2(along * whole.width(), height * whole.height());
        window.hover_at(middle + away);
        window.run();
        let pane = window.state().canvas_rect().expect("a pane");
        assert!(pane.contains(middle + away) && pane.width() < 0.5 * whole.width());
        let before = curve(&window);
        let viewport = *window.state().editor().view().viewport();
        let at = viewport.to_screen(viewport.flatten(before.polygon.vertex(3)));
        let at = pane.min + vec2(at.x as f32, at.y as f32);
        drag(&mut window, at, at + vec2(12.0, -9.0));
        // Seen from the edge another vertex may lie before it.
        let after = curve(&window);
        let vertices = after.polygon.vertices().iter();
        let moved = vertices.zip(before.polygon.vertices());
        assert!(moved.clone().any(|(now, then)| now != then), "{kept}");
        assert!(moved.into_iter().all(|(now, then)| now[kept] == then[kept]));
    }
    // A menu opens where it was asked for.
    let at = window.state().canvas_rect().expect("a pane").center() + vec2(90.0, 60.0);
    right_click(&mut window, at);
    let item = window.get_by_label_contains("Select all").rect();
    assert!(
        item.left() > at.x - 5.0 && item.top() > at.y - 250.0,
        "{item:?} {at:?}"
    );
    press(&mut window, Modifiers::NONE, Key::Escape);
    // Two panes may see the model from the same side.
    press(&mut window, Modifiers::NONE, Key::F3);
    assert_eq!(window.query_all_by_label("Pane: Top").count(), 2);
    choose(&mut window, &["View", "Panes", "One pane"]);
    assert_eq!(window.state().canvas_rect(), Some(whole));
}

#[test]
fn an_arrow_key_that_is_held_makes_one_step() {
    let mut window = open_window();
    let at = vertex(&window, 3);
    window.hover_at(at);
    window.drag_at(at);
    window.drop_at(at);
    window.run();
    let before = curve(&window);
    for (pressed, repeat) in [(true, false), (true, true), (true, true), (false, false)] {
        window.event(Event::Key {
            key: Key::ArrowUp,
            physical_key: None,
            pressed,
            repeat,
            modifiers: Modifiers::NONE,
        });
        window.run();
    }
    assert_ne!(curve(&window), before);
    assert_eq!(
        window.state().editor().workspace().history().undo_steps(),
        1
    );
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window), before);
}

#[test]
fn modes_of_dragging_are_chips_that_show_whether_they_are_on() {
    let mut window = open_window();
    for (label, command, at_first) in [
        ("Live harmony", Command::Follow(Follow::InHarmony), false),
        ("Soft drag", Command::Follow(Follow::Softly), false),
        ("Keep features", Command::ToggleKeeping, false),
        ("Snapping", Command::ToggleSnapping, false),
        ("Closed vertices follow", Command::ToggleClosedFollow, true),
    ] {
        let is_on = |window: &Window| {
            let node = window.get_by_label(label).accesskit_node();
            let shown = node.toggled() == Some(Toggled::True);
            let editor = window.state().editor();
            let checked = command.is_checked(editor);
            assert_eq!(checked, Some(shown), "{label}");
            shown
        };
        let bar = window.get_by_label(label).rect();
        assert_eq!(is_on(&window), at_first, "{label}");
        click(&mut window, label);
        assert_eq!(is_on(&window), !at_first, "{label}");
        click(&mut window, label);
        assert_eq!(is_on(&window), at_first, "{label}");
        assert_eq!(
            window.get_by_label(label).rect(),
            bar,
            "{label} stays in place"
        );
    }
}

#[test]
fn the_chip_counts_and_holds_the_legend() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Bottle"]);
    assert!(
        window
            .query_all_by_label("1 inflection · 4 extrema")
            .count()
            > 0
    );
    assert!(window.query_by_label("Curvature rises").is_none());
    window.get_by_label("Verdict").hover();
    window.run_steps(60);
    for meaning in [
        "Proved exactly for this polygon, not sampled.",
        "Curvature rises",
        "Curvature falls",
        "Curvature maximum",
        "Inflection",
        "Closed S-polygon",
        "Locked vertex",
        "Evolute",
    ] {
        assert!(window.query_all_by_label(meaning).count() > 0, "{meaning}");
    }
}

#[test]
fn the_view_has_a_name_and_the_status_bar_tells_the_model() {
    let mut window = open_window();
    let tells_z = |window: &Window| {
        let cells = window.query_all_by_label_contains("z ");
        let mut texts = cells.filter_map(|cell| {
            let node = cell.accesskit_node();
            node.label().or_else(|| node.value())
        });
        texts.any(|text| text.starts_with("z "))
    };
    let hovered = |window: &mut Window| {
        let at = vertex(window, 4);
        window.hover_at(at);
        window.run();
        window.state().editor().sight().readout().pointer
    };
    let expected = Some(curve(&window).polygon.vertex(4));
    window.get_by_label("Seen from: Top");
    assert_eq!(hovered(&mut window), expected);
    assert!(!tells_z(&window), "planar and seen from above");
    press(&mut window, Modifiers::NONE, Key::F7);
    window.get_by_label("Seen from: Isometric");
    assert!(tells_z(&window));
}

#[test]
fn the_first_window_shows_an_s_curve_with_its_comb() {
    let window = open_window_with(batten::editor::Editor::new(), 1440.0, 900.0);
    assert_eq!(curve(&window).name, "s-curve");
    let scene = window.state().editor().view().scene();
    assert!(!scene.curves[0].teeth.is_empty());
    let canvas = window.state().canvas_rect().expect("a canvas");
    let view = window.state().editor().view().viewport();
    let places = scene.curves[0]
        .curve
        .iter()
        .map(|point| view.to_screen(*point).x);
    let (low, high) = places.fold((f64::MAX, f64::MIN), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    assert!(
        high - low > 0.4 * f64::from(canvas.width()),
        "at a good size"
    );
}
