//! The pages about the paper in the window.

use batten::geometry::paper::{RoundingTest, Shortening};
use eframe::egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;

use crate::hand::*;

fn turn_to(window: &mut Window, page: usize) {
    for _ in 0..page {
        click(window, "Next");
    }
}

#[test]
fn pages_open_their_curves_and_close() {
    let mut window = open_window();
    choose(&mut window, &["Help", "The paper"]);
    assert_eq!(curve(&window).name, "arc");
    window.get_by_label_contains("Exact: 5.90129e-8");
    window.get_by_label_contains("The active curve now: 5.9012");
    turn_to(&mut window, 2);
    let names = ["5.92221e-8", "5.90129e-8", "2.78956e-14", "1.56125e-2"];
    for name in names {
        window.get_by_label_contains(name);
    }
    // Any place of a row opens its curves, that of the printed figures too.
    let row = |degree: usize| format!("Degree {degree}: ");
    for (degree, across, down) in [(15, 0.1, 0.5), (9, 0.9, 0.9), (3, 0.5, 0.2), (7, 0.6, 0.8)] {
        let rect = window.get_by_label_contains(&row(degree)).rect();
        let at = rect.left_top() + vec2(across * rect.width(), down * rect.height());
        drag(&mut window, at, at);
        assert_eq!(curve(&window).polygon.degree(), degree);
    }
    click(&mut window, "Close the paper");
    assert!(window.query_by_label("Next").is_none());
}

#[test]
fn the_slider_takes_digits_from_the_closed_polygon() {
    let mut window = open_window();
    choose(&mut window, &["Help", "The paper"]);
    turn_to(&mut window, 1);
    let slider = window.get_by_role(eframe::egui::accesskit::Role::Slider);
    slider.focus();
    window.run();
    for _ in 0..12 {
        press(&mut window, Modifiers::NONE, Key::ArrowLeft);
    }
    window.get_by_label_contains("Vertex x: -1.807");
    window.get_by_label_contains("Evolute from centre: 3.06354e-1");
    window.get_by_label_contains("Printed in the paper: 3.06354e-1");
    let test = RoundingTest::new(3, Shortening::CutOff).expect("a test");
    assert_eq!(curve(&window).polygon, test.polygon);
    click(&mut window, "Round");
    window.get_by_label_contains("Vertex y: 8.749");
    let test = RoundingTest::new(3, Shortening::Rounded).expect("a test");
    assert_eq!(curve(&window).polygon, test.polygon);
    // Nothing of that is an edit: nothing asks to be saved, and another page opens at once.
    let workspace = |window: &Window| {
        let workspace = window.state().editor().workspace();
        (workspace.is_modified(), workspace.history().undo_steps())
    };
    assert_eq!(workspace(&window), (false, 0));
    click(&mut window, "Next");
    assert!(window.query_by_label("Discard").is_none());
    click(&mut window, "Previous");
}

#[test]
fn unsaved_changes_are_asked_about_before_a_page_takes_their_place() {
    let mut window = open_window();
    choose(&mut window, &["Help", "The paper"]);
    let from = vertex(&window, 4);
    drag(&mut window, from, from + vec2(0.0, -30.0));
    let changed = curve(&window).polygon;
    click(&mut window, "Next");
    click(&mut window, "Cancel");
    assert_eq!(curve(&window).polygon, changed);
    window.get_by_label_contains("Exact: 5.90129e-8");
    click(&mut window, "Next");
    click(&mut window, "Discard");
    assert_eq!(curve(&window).name, "shortened");
}

#[test]
fn the_button_to_the_next_page_stays_in_place() {
    let mut window = open_window();
    choose(&mut window, &["Help", "The paper"]);
    let first = window.get_by_label("Next").rect();
    for page in 1..5 {
        click(&mut window, "Next");
        assert_eq!(window.get_by_label("Next").rect(), first, "page {page}");
    }
}
