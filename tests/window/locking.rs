//! Locking vertices in the table.

use eframe::egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;

use crate::hand::*;
use crate::numbers::{wave, window_of};

#[test]
fn a_vertex_is_locked_in_its_row_and_its_numbers_can_only_be_read() {
    let mut window = window_of(vec![wave(6, 3)]);
    show_vertices(&mut window);
    let is_locked = |window: &Window| curve(window).locked_vertices.contains(2);
    click(&mut window, "vertex 2 locked");
    assert!(is_locked(&window));
    let before = curve(&window).polygon;

    // Neither a drag nor typing changes a number of it.
    window.get_by_label("vertex 2 x").click();
    window.run();
    crate::numbers::strike(&mut window, "7");
    assert_eq!(curve(&window).polygon, before);
    assert!(
        window
            .query_by_label_contains("ertex 2 of “curve” is locked")
            .is_some()
    );
    let at = window.get_by_label("vertex 2 y").rect().center();
    drag(&mut window, at, at + vec2(40.0, 0.0));
    assert_eq!(curve(&window).polygon, before);

    click(&mut window, "vertex 2 locked");
    assert!(!is_locked(&window));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(is_locked(&window));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(!is_locked(&window));
}

#[test]
fn the_menu_locks_what_is_selected() {
    let mut window = window_of(vec![wave(6, 3)]);
    show_vertices(&mut window);
    click(&mut window, "vertex 1");
    choose(&mut window, &["Edit", "Lock vertices"]);
    let locked: Vec<usize> = curve(&window).locked_vertices.iter().collect();
    assert_eq!(locked, [1]);
}
