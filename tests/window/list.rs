//! The list of curves: rows selected together, found by a filter, dragged, and made only where they are seen.

use batten::document::{Curve, CurveId, Document};
use batten::editor::Editor;
use batten::geometry::FloatPolygon;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

use crate::hand::*;

/// An editor with curves of these names.
fn editor_of<'a>(names: impl IntoIterator<Item = &'a str>) -> Editor {
    let curve = |(place, name): (usize, &str)| {
        let points = [0.0, 1.0, 2.0, 3.0].map(|x| (x, x * x + place as f64));
        Curve::new(name, FloatPolygon::planar(3, &points).expect("a polygon"))
    };
    let document = Document::from_curves(names.into_iter().enumerate().map(curve));
    Editor::with_document(document)
}

/// A window with curves of these names.
fn with_curves<'a>(names: impl IntoIterator<Item = &'a str>) -> Window {
    open_window_with(editor_of(names), 1480.0, 920.0)
}

fn click_with(window: &mut Window, modifiers: Modifiers, label: &str) {
    window.get_by_label(label).click_modifiers(modifiers);
    window.run();
}

fn names(window: &Window, is_named: impl Fn(CurveId) -> bool) -> Vec<String> {
    let document = window.state().editor().document();
    let ids = document.all_ids().filter(|id| is_named(*id));
    ids.filter_map(|id| document.name(id).map(str::to_owned))
        .collect()
}

fn selected(window: &Window) -> Vec<String> {
    let selection = window.state().editor().hand().selection();
    names(window, |id| selection.has_item(id))
}

#[test]
fn ctrl_takes_single_rows_and_shift_all_between() {
    let mut window = with_curves(["a", "b", "c", "d", "e"]);
    click(&mut window, "curve b");
    click_with(&mut window, Modifiers::COMMAND, "curve e");
    assert_eq!(selected(&window), ["b", "e"]);
    click_with(&mut window, Modifiers::COMMAND, "curve e");
    assert_eq!(selected(&window), ["b"]);
    click_with(&mut window, Modifiers::SHIFT, "curve d");
    assert_eq!(selected(&window), ["b", "c", "d"]);
    click_with(&mut window, Modifiers::SHIFT, "curve a");
    assert_eq!(selected(&window), ["a", "b"], "from the active row on");
    click_with(&mut window, Modifiers::COMMAND, "curve e");
    click_with(
        &mut window,
        Modifiers::COMMAND | Modifiers::SHIFT,
        "curve c",
    );
    assert_eq!(selected(&window), ["a", "b", "c", "e"]);
    click(&mut window, "curve c");
    assert_eq!(selected(&window), ["c"]);
}

#[test]
fn the_inspector_of_several_sets_what_they_have_in_common() {
    let mut window = with_curves(["a", "b", "c"]);
    click(&mut window, "curve a");
    click_with(&mut window, Modifiers::COMMAND, "curve c");
    window.get_by_label("2 curves selected");
    click(&mut window, "Locked");
    let locked = |window: &Window| {
        let document = window.state().editor().document().clone();
        names(window, |id| document.curve(id).is_some_and(|it| it.locked))
    };
    assert_eq!(locked(&window), ["a", "c"]);
    click(&mut window, "curve b");
    click(&mut window, "Group");
    type_over(&mut window, "Deck");
    press(&mut window, Modifiers::NONE, Key::Enter);
    click_with(&mut window, Modifiers::SHIFT, "curve c");
    click(&mut window, "Group of all");
    type_over(&mut window, "Hull");
    press(&mut window, Modifiers::NONE, Key::Enter);
    let document = window.state().editor().document();
    let groups = document.ids().filter_map(|id| document.group(id));
    let groups: Vec<String> = groups.map(ToString::to_string).collect();
    assert_eq!(groups, ["", "Hull", "Hull"]);
    // Mixed: a click locks all.
    click(&mut window, "Locked");
    assert_eq!(locked(&window), ["a", "b", "c"]);
}

#[test]
fn a_filter_shows_the_rows_whose_names_contain_it() {
    let mut window = with_curves(["keel", "Waterline 1", "waterline 2"]);
    click(&mut window, "Filter curves");
    type_over(&mut window, "WATER");
    assert!(window.query_by_label("curve keel").is_none());
    window.get_by_label("curve Waterline 1");
    click(&mut window, "curve waterline 2");
    assert_eq!(selected(&window), ["waterline 2"]);
    click(&mut window, "Filter of curves");
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.get_by_label("curve keel");
}

#[test]
fn selected_rows_are_dragged_together() {
    let mut window = with_curves(["a", "b", "c", "d"]);
    click(&mut window, "curve a");
    click_with(&mut window, Modifiers::SHIFT, "curve b");
    let [from, to] = ["curve a", "curve d"].map(|row| window.get_by_label(row).rect().center());
    drag(&mut window, from, to);
    assert_eq!(names(&window, |_| true), ["c", "d", "a", "b"]);
    let steps = window.state().editor().workspace().history().undo_steps();
    assert_eq!(steps, 1);
}

#[test]
fn of_many_rows_only_those_in_sight_are_made() {
    let all: Vec<String> = (0..3000).map(|place| format!("line {place:04}")).collect();
    for place in [0, 2999] {
        let mut editor = editor_of(all.iter().map(String::as_str));
        let active = editor.document().ids().nth(place);
        editor.activate(active.expect("a curve"));
        let window = open_window_with(editor, 1480.0, 920.0);
        window.get_by_label(&format!("curve line {place:04}"));
        let made = window.query_all_by_label_contains("curve line").count();
        assert!((5..60).contains(&made), "{made} rows");
    }
}
