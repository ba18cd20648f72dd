//! Every field for a number: the keys that are typed into it are its own.

use batten::geometry::FloatPolygon;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;

use crate::hand::*;
use crate::numbers::*;

/// Press every key that is a shortcut somewhere, with what it writes.
fn strike_all(window: &mut Window) {
    for character in "123456789vaixdrsmegfh".chars() {
        let text = character.to_string();
        let key = Key::from_name(&text.to_uppercase()).expect("a key");
        for event in stroke(key, &text) {
            window.event(event);
        }
    }
    for (key, text) in [(Key::Plus, "+"), (Key::Minus, "-"), (Key::Space, " ")] {
        for event in stroke(key, text) {
            window.event(event);
        }
    }
    window.run();
    for key in [
        Key::ArrowLeft,
        Key::ArrowRight,
        Key::Backspace,
        Key::Delete,
        Key::Home,
    ] {
        press(window, Modifiers::NONE, key);
    }
}

fn check_field(window: &mut Window, label: &str) {
    let before = state(window);
    let at = window.get_by_label(label).rect().center();
    let mut events = click_events(at);
    events.extend(digit('5'));
    in_one_frame(window, events);
    assert_eq!(
        state(window),
        before,
        "{label}: a digit right after the click"
    );
    strike_all(window);
    assert_eq!(state(window), before, "{label}");
}

#[test]
fn keys_typed_into_any_field_are_no_shortcuts() {
    let mut window = window_of(vec![wave(8, 3)]);
    check_field(&mut window, "Degree");
    press(&mut window, Modifiers::NONE, Key::Escape);
    show_vertices(&mut window);
    click(&mut window, "vertex 1");
    click(&mut window, "Column z");
    click(&mut window, "Column Weights");
    press(&mut window, Modifiers::NONE, Key::Num5);
    let table = ["vertex 1 x", "vertex 2 y", "vertex 3 z", "vertex 4 weight"];
    let fields = ["Comb scale", "Comb density"];
    for label in table.into_iter().chain(fields) {
        check_field(&mut window, label);
        press(&mut window, Modifiers::NONE, Key::Escape);
        press(&mut window, Modifiers::NONE, Key::Escape);
        click(&mut window, "vertex 1");
    }
    for (tool, labels) in [
        (Key::R, vec!["typed angle", "pivot x", "pivot y"]),
        (Key::S, vec!["typed factor"]),
        (
            Key::E,
            vec!["target x", "target y", "target direction", "tolerance"],
        ),
    ] {
        press(&mut window, Modifiers::NONE, tool);
        if tool == Key::E {
            click(&mut window, "Use current end");
        }
        for label in labels {
            check_field(&mut window, label);
            press(&mut window, Modifiers::NONE, Key::Escape);
        }
    }
    press(&mut window, Modifiers::NONE, Key::V);
    for (operation, labels) in [
        ("Split curve", ["At u", "Refine at most"].as_slice()),
        (
            "Trim curve",
            ["From u", "To u", "Refine at most"].as_slice(),
        ),
        ("Round coordinates", ["Digits"].as_slice()),
    ] {
        for label in labels {
            press(&mut window, Modifiers::COMMAND, Key::P);
            window.event(Event::Text(operation.to_owned()));
            window.run();
            enter(&mut window);
            check_field(&mut window, label);
            click(&mut window, "Cancel");
        }
    }
}

#[test]
fn one_thing_is_not_called_several() {
    let points = [(0.0, 0.0), (1.0, 2.0), (2.0, -2.0), (3.0, 0.0)];
    let window = window_of(vec![FloatPolygon::planar(3, &points).expect("a polygon")]);
    let counts = window.query_all_by_label_contains("1 inflection");
    assert!(counts.count() > 0);
}
