//! Drawing by typed points, through the widgets' labels.

use batten::editor::ToolKind;
use batten::geometry::End;
use eframe::egui::{Event, Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;
use glam::DVec3;

use crate::hand::*;

/// Type on the canvas as a keyboard does: each character is a key and its text.
fn type_keys(window: &mut Window, text: &str) {
    for character in text.chars() {
        let key = Key::from_name(&character.to_string());
        let event = |pressed| {
            key.map(|key| Event::Key {
                key,
                physical_key: None,
                pressed,
                repeat: false,
                modifiers: Modifiers::NONE,
            })
        };
        let text = Some(Event::Text(character.to_string()));
        for event in [event(true), text, event(false)].into_iter().flatten() {
            window.event(event);
        }
    }
    window.run();
}

fn type_point(window: &mut Window, text: &str) {
    type_keys(window, text);
    press(window, Modifiers::NONE, Key::Enter);
}

fn drawing() -> Window {
    let mut window = open_window();
    choose(&mut window, &["File", "New"]);
    // The tool, its way (all clicks are vertices) and the first digits come in one frame.
    type_keys(&mut window, "dt1,2");
    window
}

#[test]
fn a_curve_is_drawn_by_typing_alone() {
    let mut window = drawing();
    press(&mut window, Modifiers::NONE, Key::Enter);
    for text in ["@3,0", "@2<90", "@1,1", "-4,7.5", ".5,8"] {
        type_point(&mut window, text);
    }
    // The canvas has the keyboard again: Enter ends.
    press(&mut window, Modifiers::NONE, Key::Enter);
    let polygon = curve(&window).polygon;
    let expected = [
        (1.0, 2.0),
        (4.0, 2.0),
        (4.0, 4.0),
        (5.0, 5.0),
        (-4.0, 7.5),
        (0.5, 8.0),
    ];
    assert_eq!(
        polygon.vertices(),
        expected.map(|(x, y)| DVec3::new(x, y, 0.0))
    );
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(window.state().editor().document().is_empty());
}

#[test]
fn keys_typed_into_the_field_are_no_shortcuts_and_escape_gives_the_canvas_back() {
    let mut window = drawing();
    let layers = window.state().editor().sight().layers();
    type_keys(&mut window, "34");
    assert_eq!(window.state().editor().sight().layers(), layers);
    // Letters are no tools while something is typed.
    type_keys(&mut window, "v");
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Draw);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Draw);
    type_keys(&mut window, "v");
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Select);
}

#[test]
fn wrong_text_stays_with_what_is_wrong_and_its_column() {
    let mut window = drawing();
    press(&mut window, Modifiers::NONE, Key::Enter);
    type_point(&mut window, "3,four");
    window.get_by_label_contains("Column 3");
    assert_eq!(
        window.get_by_label("typed point").value().as_deref(),
        Some("3,four")
    );
    for _ in 0..4 {
        press(&mut window, Modifiers::NONE, Key::Backspace);
    }
    assert_eq!(window.query_all_by_label_contains("Column 3").count(), 0);
    type_point(&mut window, "4");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(curve(&window).polygon.vertex(1), DVec3::new(3.0, 4.0, 0.0));
}

#[test]
fn length_angle_and_degree_are_typed_into_their_fields() {
    let mut window = drawing();
    press(&mut window, Modifiers::NONE, Key::Enter);
    for (label, text) in [
        ("leg length", "5"),
        ("leg angle", "90"),
        ("drawn degree", "3"),
    ] {
        click(&mut window, label);
        type_over(&mut window, text);
        press(&mut window, Modifiers::NONE, Key::Enter);
    }
    click(&mut window, "On clicks");
    let canvas = window.state().canvas_rect().expect("a canvas");
    let at = canvas.min + vec2(300.0, 120.0);
    for at in [at, at + vec2(100.0, 0.0)] {
        drag(&mut window, at, at);
    }
    click(&mut window, "Unlock leg length");
    assert!(
        window
            .state()
            .editor()
            .hand()
            .leg_locks()
            .expect("locks")
            .length
            .is_none()
    );
    press(&mut window, Modifiers::NONE, Key::Enter);
    let polygon = curve(&window).polygon;
    assert_eq!(polygon.degree(), 3);
    let ends = End::BOTH.map(|end| polygon.end_jet(end).point);
    for (end, expected) in ends.into_iter().zip([(1.0, 2.0), (1.0, 12.0)]) {
        let off = end.distance(DVec3::new(expected.0, expected.1, 0.0));
        assert!(off < 1e-12 * polygon.size(), "{end}");
    }
}

#[test]
fn a_typed_angle_rotates() {
    let mut window = open_window();
    let before = curve(&window).polygon;
    type_keys(&mut window, "r90");
    press(&mut window, Modifiers::NONE, Key::Enter);
    let leg = |polygon: &batten::geometry::FloatPolygon| polygon.vertex(1) - polygon.vertex(0);
    let turned = leg(&curve(&window).polygon).truncate();
    assert!(turned.distance(leg(&before).truncate().perp()) < 1e-12 * before.size());
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window).polygon, before);
}

#[test]
fn a_typed_factor_is_shown_before_it_is_entered() {
    let mut window = open_window();
    let before = curve(&window).polygon;
    type_keys(&mut window, "s2");
    let shown = curve(&window).polygon;
    let leg = |polygon: &batten::geometry::FloatPolygon| polygon.vertex(1) - polygon.vertex(0);
    assert!((leg(&shown) - 2.0 * leg(&before)).length() < 1e-12 * before.size());
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(curve(&window).polygon, before, "Esc takes it back");
    type_keys(&mut window, "3");
    assert!((leg(&curve(&window).polygon) - 3.0 * leg(&before)).length() < 1e-12 * before.size());
    press(&mut window, Modifiers::NONE, Key::Enter);
    let entered = curve(&window).polygon;
    assert!((leg(&entered) - 3.0 * leg(&before)).length() < 1e-12 * before.size());
    assert_eq!(
        window.state().editor().workspace().history().undo_steps(),
        1
    );
}

#[test]
fn the_degree_so_far_and_the_unit_are_told_and_an_empty_enter_leaves() {
    let mut window = open_window();
    let convert = ["Edit", "Document unit", "Document unit: millimetres"];
    choose(&mut window, &convert);
    press(&mut window, Modifiers::NONE, Key::D);
    press(&mut window, Modifiers::NONE, Key::T);
    let canvas = window.state().canvas_rect().expect("a canvas");
    for by in [vec2(-200.0, 0.0), vec2(-80.0, -90.0), vec2(60.0, 40.0)] {
        let at = canvas.center() + by;
        window.drag_at(at);
        window.step();
        window.drop_at(at);
        window.run();
    }
    window.hover_at(canvas.center() + vec2(150.0, -60.0));
    window.run();
    let editor = window.state().editor();
    let (hand, context) = (editor.hand(), editor.context());
    let degree = hand.drawn_degree(&context);
    assert_eq!(degree, Some(9), "that of the active curve");
    assert_eq!(hand.degree_so_far(&context), Some(3));
    let length = window
        .get_by_label("leg length")
        .value()
        .unwrap_or_default();
    // The field draws the unit behind the number.
    assert!(length.parse::<f64>().is_ok(), "{length}");
    let proposal = &window.state().editor().view().scene().proposal;
    let next = window.state().editor().document().next_id();
    assert_eq!(proposal.id, Some(next), "in the colour of the next curve");
    press(&mut window, Modifiers::NONE, Key::Escape);
    click(&mut window, "typed point");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Select);
}

#[test]
fn what_is_typed_is_dropped_where_another_tab_hides_its_field() {
    let mut window = open_window();
    let before = curve(&window).polygon;
    type_keys(&mut window, "r30");
    assert_ne!(curve(&window).polygon, before);
    click(&mut window, "Inspector");
    window.run();
    assert_eq!(curve(&window).polygon, before);
    // The next digits bring the field back.
    click(&mut window, "Canvas");
    type_keys(&mut window, "90");
    window.get_by_label("typed angle");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(curve(&window).polygon, before);
}
