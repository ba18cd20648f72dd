//! What the canvas, its badge and its messages do with clicks and keys.

use batten::editor::{Command, Follow, Layer, Orientation};
use eframe::egui::accesskit::Toggled;
use eframe::egui::{Event, Key, Modifiers, PointerButton, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::hand::*;

#[test]
fn digits_typed_while_drawing_switch_no_layers() {
    let mut window = open_window();
    let layers = window.state().editor().layers();
    press(&mut window, Modifiers::NONE, Key::D);
    let first = vertex(&window, 2);
    drag(&mut window, first, first);
    for key in [Key::Num1, Key::Num2, Key::Num5, Key::Minus] {
        press(&mut window, Modifiers::NONE, key);
    }
    assert_eq!(window.state().editor().layers(), layers);
    press(&mut window, Modifiers::NONE, Key::Escape);
    press(&mut window, Modifiers::NONE, Key::V);
    press(&mut window, Modifiers::NONE, Key::Num1);
    assert!(!window.state().editor().layers().shows(Layer::Float));
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
    assert!(window.query_by_label("Orbited · F2").is_none());
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
    click(&mut window, "Orbited · F2");
    assert_eq!(
        window.state().editor().view().viewport().orientation,
        Orientation::XY
    );
    assert!(window.query_by_label("Orbited · F2").is_none());
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
fn ways_of_following_are_switches_that_show_whether_they_are_on() {
    let mut window = open_window();
    for (label, follow) in [
        ("Live harmony", Follow::InHarmony),
        ("Soft drag", Follow::Softly),
    ] {
        let is_on = |window: &Window| {
            let node = window.get_by_label(label).accesskit_node();
            let shown = node.toggled() == Some(Toggled::True);
            let editor = window.state().editor();
            let checked = editor.is_checked(Command::Follow(follow));
            assert_eq!(checked, Some(shown), "{label}");
            shown
        };
        assert!(!is_on(&window), "{label}");
        click(&mut window, label);
        assert!(is_on(&window), "{label}");
        click(&mut window, label);
        assert!(!is_on(&window), "{label}");
    }
}
