//! Arithmetic, units and changes typed into number fields of every kind.

use batten::geometry::expressions::LengthUnit;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;

use crate::hand::*;
use crate::numbers::{click_events, enter, state, table_of, wave, window_of, x, y};

/// Type a text that may begin in a cell.
fn write(window: &mut Window, text: &str) {
    for character in text.chars() {
        window.event(Event::Text(character.to_string()));
    }
    window.run();
}

/// Type a number into a cell of the table.
fn write_cell(window: &mut Window, cell: &str, text: &str) {
    click(window, cell);
    write(window, text);
    enter(window);
}

#[test]
fn cells_take_arithmetic_functions_commas_and_changes() {
    let mut window = table_of(vec![wave(8, 3)]);
    let before = state(&window);
    let mut expected = x(&window, 1);
    for (text, value) in [
        ("-8+1/2", -7.5),
        ("10*cos(60deg)", 5.0),
        ("+=2", 7.0),
        ("*=1,5", 10.5),
        ("-=0.5", 10.0),
        ("/=4", 2.5),
        ("sqrt(16)", 4.0),
        ("pi", std::f64::consts::PI),
        ("(1+2)*1e-3", 0.003),
        ("max(3,5)", 5.0),
        ("3,5", 3.5),
    ] {
        write_cell(&mut window, "vertex 1 x", text);
        assert_eq!(x(&window, 1), value, "{text}");
        press(&mut window, Modifiers::COMMAND, Key::Z);
        assert_eq!(x(&window, 1), expected, "one step back from {text}");
        press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
        expected = value;
    }
    for _ in 0..11 {
        press(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(state(&window), before);
}

#[test]
fn a_mistake_is_told_at_the_field_with_its_column_and_changes_nothing() {
    let mut window = table_of(vec![wave(8, 3)]);
    let before = state(&window);
    for (text, words) in [
        ("2*foo(3)", "Column 3: “foo” means nothing here"),
        (
            "30deg",
            "Column 1: an angle is given where a length is needed",
        ),
        (
            "1+12mm",
            "Column 5: the document has no unit to convert “mm” to",
        ),
        ("1/0", "Column 1: “1/0” divides by zero"),
        (
            "2*(3",
            "Column 5: expected an operator or a closing parenthesis, found the end",
        ),
    ] {
        write_cell(&mut window, "vertex 1 x", text);
        window.get_by_label_contains(words);
        press(&mut window, Modifiers::NONE, Key::Escape);
        assert_eq!(state(&window), before, "{text}");
    }
    // What may still become a number is not marked before Enter.
    click(&mut window, "vertex 1 x");
    write(&mut window, "2*sq");
    assert!(window.query_by_label_contains("Column 3:").is_none());
    // Left, the old number stays, and the remark tells what was typed.
    click(&mut window, "Canvas");
    window.get_by_label_contains("“2*sq”, column 3: “sq” means nothing here");
    assert_eq!(state(&window), before);
}

#[test]
fn lengths_are_converted_to_the_documents_unit() {
    let mut window = table_of(vec![wave(8, 3)]);
    click(&mut window, "Unit none");
    click(&mut window, "Document unit: centimetres");
    window.get_by_label("Unit cm");
    let unit = |window: &Window| window.state().editor().document().unit();
    assert_eq!(unit(&window), Some(LengthUnit::Centimetre));
    press(&mut window, Modifiers::NONE, Key::Escape);
    for (text, value) in [
        ("12mm", 1.2),
        ("1/2in", 1.27),
        ("2.5 cm", 2.5),
        ("+=1mm", 2.6),
    ] {
        write_cell(&mut window, "vertex 2 y", text);
        assert_eq!(y(&window, 2), value, "{text}");
    }
    let convert = "Convert document to millimetres";
    choose(&mut window, &["Edit", "Document unit", convert]);
    window.get_by_label("Unit mm");
    assert_eq!(y(&window, 2), 26.0);
    for _ in 0..6 {
        press(&mut window, Modifiers::COMMAND, Key::Z);
    }
    window.get_by_label("Unit none");
}

#[test]
fn panels_take_them_too() {
    let mut window = window_of(vec![wave(8, 3)]);
    click(&mut window, "Degree");
    type_over(&mut window, "2+2");
    enter(&mut window);
    assert_eq!(curve(&window).polygon.degree(), 4);
    click(&mut window, "Canvas");
    press(&mut window, Modifiers::COMMAND, Key::A);
    click(&mut window, "Rotate");
    let before = x(&window, 7);
    click(&mut window, "typed angle");
    type_over(&mut window, "2mm");
    enter(&mut window);
    window.get_by_label_contains("Column 1: a length is given where an angle is needed");
    type_over(&mut window, "2*pi/4 rad");
    click(&mut window, "Apply rotation");
    assert!((x(&window, 7) - before).abs() > 1.0, "turned by 90°");
}

#[test]
fn the_nudge_step_is_typed_and_does_not_depend_on_the_zoom() {
    let mut window = table_of(vec![wave(8, 3)]);
    click(&mut window, "Unit none");
    click(&mut window, "Nudge step");
    type_over(&mut window, "1/4");
    enter(&mut window);
    press(&mut window, Modifiers::NONE, Key::Escape);
    press(&mut window, Modifiers::NONE, Key::Escape);
    for (zoom, modifiers, by) in [
        ("Zoom in", Modifiers::NONE, 0.25),
        ("Zoom out", Modifiers::SHIFT, 2.5),
        ("Fit all", Modifiers::COMMAND, 0.025),
    ] {
        choose(&mut window, &["View", zoom]);
        let at = vertex(&window, 3);
        window.hover_at(at);
        window.run();
        for event in click_events(at) {
            window.event(event);
        }
        window.run();
        let before = x(&window, 3);
        press(&mut window, modifiers, Key::ArrowRight);
        assert!((x(&window, 3) - before - by).abs() < 1e-12, "{zoom}");
    }
}
