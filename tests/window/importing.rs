//! The import panel.

use batten::editor::Editor;
use batten::geometry::expressions::LengthUnit;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

use super::files::drop_file;
use super::hand::*;
use crate::drawings::dxf;

const LINES: [(&str, [f64; 2]); 3] = [
    ("Deck", [120.0, 45.0]),
    ("Deck", [60.0, 20.0]),
    ("Keel", [10.0, 0.0]),
];

fn references(window: &Window) -> usize {
    window.state().editor().document().references().count()
}

#[test]
fn layers_kinds_and_units_of_a_drawing_are_chosen_before_it_comes_in() {
    let mut window = open_window_of(1000.0, 700.0);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("hull.dxf");
    std::fs::write(&path, dxf(None, &LINES, 2)).expect("the file");
    drop_file(&mut window, &path);
    window.get_by_label("Add “hull.dxf” to the document");
    window.get_by_label_contains("Not understood, left out: 2 HATCH, the first at line");
    window.get_by_label("Taken: 3 references; 120 × 45");
    click(&mut window, "Keel, line: 1");
    window.get_by_label("Taken: 2 references; 120 × 45");
    click(&mut window, "inches");
    window.get_by_label("Taken: 2 references; 120 × 45 in");
    assert_eq!(references(&window), 0, "nothing yet");
    click(&mut window, "Cancel");
    assert_eq!(references(&window), 0);
    drop_file(&mut window, &path);
    window.get_by_label("Taken: 3 references; 120 × 45");
    click(&mut window, "Take none");
    click(&mut window, "Deck, line: 2");
    click(&mut window, "Add");
    assert_eq!(references(&window), 2);
    window.get_by_label_contains("1 item not chosen, left out");
}

#[test]
fn enter_takes_the_likely_unit() {
    for (scale, unit) in [(1.0, LengthUnit::Millimetre), (0.001, LengthUnit::Metre)] {
        let mut editor = Editor::default();
        editor.begin_empty();
        let mut window = open_window_with(editor, 1000.0, 700.0);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("hull.dxf");
        let lines = LINES.map(|(layer, [x, y])| (layer, [scale * x, scale * y]));
        std::fs::write(&path, dxf(None, &lines, 0)).expect("the file");
        drop_file(&mut window, &path);
        press(&mut window, Modifiers::NONE, Key::Enter);
        assert_eq!(references(&window), 3);
        assert_eq!(window.state().editor().document().unit(), Some(unit));
    }
}

#[test]
fn a_plain_drawing_says_what_came_and_leads_to_the_panel() {
    let mut window = open_window();
    choose(
        &mut window,
        &["Edit", "Document unit", "Document unit: millimetres"],
    );
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("plain.dxf");
    std::fs::write(&path, dxf(Some(4), &LINES[..2], 0)).expect("the file");
    drop_file(&mut window, &path);
    assert_eq!(references(&window), 2, "nothing to choose");
    window.get_by_label_contains("2 references added");
    click(&mut window, "Choose…");
    window.get_by_label("Taken: 2 references; 120 × 45 mm");
    click(&mut window, "Add");
    assert_eq!(references(&window), 2, "once, not twice");
    choose(&mut window, &["File", "Choose imported…"]);
    click(&mut window, "Cancel");
    assert_eq!(references(&window), 2);
}

#[test]
fn the_sum_counts_what_comes_in() {
    let mut window = open_window_of(1000.0, 700.0);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("shapes.svg");
    let shapes = "<path d='M10 10C20 0 30 0 40 10'/><circle cx='50' cy='50' r='10'/>\
                  <rect x='60' y='60' width='20' height='10' rx='2'/>";
    let text = format!("<svg xmlns='http://www.w3.org/2000/svg'>{shapes}</svg>");
    std::fs::write(&path, text).expect("the file");
    drop_file(&mut window, &path);
    // The rounded rectangle is four lines and four arcs.
    window.get_by_label_contains("Taken: 1 curve and 9 references");
    window.get_by_label_contains("Make float polygons of 5 smooth references");
    let curves = |window: &Window| window.state().editor().document().curves().count();
    let before = [curves(&window), references(&window)];
    click(&mut window, "Add");
    assert_eq!(curves(&window) - before[0], 1);
    assert_eq!(references(&window) - before[1], 9);
}
