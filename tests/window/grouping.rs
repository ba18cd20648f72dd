//! Groups in the window: headings in the list of curves, and the inspector's field.

use batten::document::{Curve, CurveId, Document, Group, Reference};
use batten::editor::Editor;
use batten::geometry::FloatPolygon;
use batten::geometry::references::ReferenceCurve;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::hand::*;

/// A window with curves in groups, and a circle.
fn grouped(groups: &[(&str, &str)], circle: &str) -> Window {
    let curve = |(place, (name, group)): (usize, &(&str, &str))| {
        let points = [0.0, 1.0, 2.0, 3.0].map(|x| (x, x * x + place as f64));
        let polygon = FloatPolygon::planar(3, &points).expect("a polygon");
        Curve::new(*name, polygon).in_group((*group).into())
    };
    let shape = ReferenceCurve::from_text("circle").expect("a circle");
    let circle = Reference::new("round", shape).in_group(circle.into());
    let document = Document::from_curves(groups.iter().enumerate().map(curve));
    let document = document.with_references([circle]);
    open_window_with(Editor::with_document(document), 1480.0, 920.0)
}

fn ship() -> Window {
    let curves = [("a", "Deck"), ("b", ""), ("c", "Deck/Port"), ("d", "Hull")];
    grouped(&curves, "Deck")
}

fn document(window: &Window) -> &Document {
    window.state().editor().document()
}

fn ids(window: &Window) -> Vec<CurveId> {
    document(window).all_ids().collect()
}

/// The labels of the list's rows that are shown, from the top.
fn shown(window: &Window) -> Vec<&'static str> {
    const ROWS: [&str; 8] = [
        "group Deck",
        "curve a",
        "reference round",
        "group Deck/Port",
        "curve c",
        "curve b",
        "group Hull",
        "curve d",
    ];
    let rows = ROWS.into_iter();
    let found = rows.filter_map(|label| Some((label, window.query_by_label(label)?.rect().top())));
    let mut found: Vec<(&str, f32)> = found.collect();
    found.sort_by(|a, b| a.1.total_cmp(&b.1));
    found.into_iter().map(|(label, _)| label).collect()
}

fn groups(window: &Window) -> Vec<String> {
    let document = document(window);
    let groups = document.all_ids().filter_map(|id| document.group(id));
    groups.map(Group::to_string).collect()
}

fn undo(window: &mut Window) {
    press(window, Modifiers::COMMAND, Key::Z);
}

fn steps(window: &Window) -> usize {
    window.state().editor().workspace().history().undo_steps()
}

#[test]
fn headings_fold_what_is_in_them_and_leave_the_document() {
    let mut window = ship();
    let all = [
        "group Deck",
        "curve a",
        "reference round",
        "group Deck/Port",
        "curve c",
        "curve b",
        "group Hull",
        "curve d",
    ];
    let mut rows = shown(&window);
    // Within a heading its own items stand together, where the first of them stands.
    assert_eq!(rows, all);
    click(&mut window, "group Deck/Port");
    rows.retain(|row| *row != "curve c");
    assert_eq!(shown(&window), rows);
    click(&mut window, "group Deck");
    let folded = ["group Deck", "curve b", "group Hull", "curve d"];
    assert_eq!(shown(&window), folded);
    assert_eq!(steps(&window), 0);
    click(&mut window, "group Deck");
    assert_eq!(shown(&window), rows, "the inner one is still folded");
    click(&mut window, "group Deck/Port");
    assert_eq!(shown(&window), all);
}

#[test]
fn the_tab_key_passes_over_folded_rows() {
    let mut window = ship();
    click(&mut window, "group Deck");
    window.get_by_label("group Deck").focus();
    window.run();
    let mut passed = Vec::new();
    for _ in 0..6 {
        press(&mut window, Modifiers::NONE, Key::Tab);
        let rows = ["curve a", "reference round", "curve c", "curve b"];
        let focused = |label: &&str| {
            let row = window.query_by_label(label);
            row.is_some_and(|row| row.accesskit_node().is_focused())
        };
        passed.extend(rows.into_iter().find(focused));
    }
    assert_eq!(passed, ["curve b"]);
}

#[test]
fn the_switches_of_a_heading_act_on_all_as_one_step() {
    let mut window = ship();
    let [a, b, c, d, round] = ids(&window)[..] else {
        panic!("five items");
    };
    let visible = |window: &Window| [a, b, c, d, round].map(|id| document(window).is_visible(id));
    click(&mut window, "Show group Deck");
    assert_eq!(visible(&window), [false, true, false, true, false]);
    assert_eq!(steps(&window), 1);
    click(&mut window, "Show c");
    // As long as one is hidden, all are shown.
    click(&mut window, "Show group Deck");
    assert_eq!(visible(&window), [true; 5]);
    undo(&mut window);
    undo(&mut window);
    undo(&mut window);
    assert_eq!(visible(&window), [true; 5]);
    assert_eq!(steps(&window), 0);

    let locked = |window: &Window| {
        let curves = document(window).curves().map(|(_, curve)| curve.locked);
        let references = document(window).references().map(|(_, it)| it.locked);
        curves.chain(references).collect::<Vec<_>>()
    };
    click(&mut window, "Lock c");
    click(&mut window, "Lock group Deck");
    assert_eq!(locked(&window), [true, false, true, false, true]);
    click(&mut window, "Lock group Deck");
    assert_eq!(locked(&window), [false; 5]);
    undo(&mut window);
    assert_eq!(locked(&window), [true, false, true, false, true]);
    undo(&mut window);
    assert_eq!(locked(&window), [false, false, true, false, false]);
}

#[test]
fn the_inspector_types_the_group() {
    let mut window = ship();
    click(&mut window, "curve b");
    click(&mut window, "Group");
    type_over(&mut window, " Deck / Port ");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(
        groups(&window),
        ["Deck", "Deck/Port", "Deck/Port", "Hull", "Deck"]
    );
    assert_eq!(steps(&window), 1);
    click(&mut window, "Group");
    type_over(&mut window, "Hull");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(groups(&window)[1], "Deck/Port", "Esc keeps the group");
    undo(&mut window);
    assert_eq!(groups(&window)[1], "");
    click(&mut window, "reference round");
    click(&mut window, "Group");
    press(&mut window, Modifiers::COMMAND, Key::A);
    press(&mut window, Modifiers::NONE, Key::Backspace);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(groups(&window)[4], "");
    assert_eq!(steps(&window), 1);
}

#[test]
fn a_double_click_on_a_heading_renames_the_group() {
    let mut window = ship();
    let at = window.get_by_label("group Deck").rect().center();
    double_click(&mut window, at);
    window.get_by_label("Group path");
    type_over(&mut window, "Ship/Deck");
    press(&mut window, Modifiers::NONE, Key::Enter);
    let renamed = ["Ship/Deck", "", "Ship/Deck/Port", "Hull", "Ship/Deck"];
    assert_eq!(groups(&window), renamed);
    assert_eq!(steps(&window), 1);
    undo(&mut window);
    assert_eq!(groups(&window), ["Deck", "", "Deck/Port", "Hull", "Deck"]);
}

#[test]
fn renaming_an_item_unfolds_its_group() {
    let mut window = ship();
    click(&mut window, "curve c");
    click(&mut window, "group Deck");
    press(&mut window, Modifiers::NONE, Key::F2);
    window.get_by_label("Curve name");
    assert!(shown(&window).contains(&"curve c"));
}

#[test]
fn a_row_that_is_dropped_on_a_heading_moves_to_the_group() {
    let mut window = ship();
    let [from, to] = ["curve b", "group Hull"].map(|row| window.get_by_label(row).rect().center());
    drag(&mut window, from, to);
    assert_eq!(
        groups(&window),
        ["Deck", "Hull", "Deck/Port", "Hull", "Deck"]
    );
    assert_eq!(steps(&window), 1);
}

#[test]
fn moving_up_passes_over_rows_of_other_groups() {
    let mut window = grouped(&[("a", "Hull"), ("b", ""), ("c", "Hull")], "");
    click(&mut window, "curve c");
    click(&mut window, "Move curve up");
    let names: Vec<&str> = document(&window).names().collect();
    assert_eq!(names, ["c", "a", "b", "round"]);
}

#[test]
fn without_groups_the_rows_are_as_before() {
    let window = grouped(&[("a", ""), ("b", "")], "");
    let rows = ["curve a", "curve b", "reference round"].map(|row| window.get_by_label(row).rect());
    assert!(
        rows.windows(2)
            .all(|pair| pair[0].bottom() == pair[1].top())
    );
    assert!(window.query_by_label_contains("group ").is_none());
    let top = window.get_by_label("Collapse curve list").rect().top();
    let below = window.get_by_label("Inspector").rect().top();
    let in_group = grouped(&[("a", "Deck"), ("b", "")], "");
    let grown = in_group.get_by_label("Inspector").rect().top();
    assert_eq!(
        in_group.get_by_label("Collapse curve list").rect().top(),
        top
    );
    assert!(
        (grown - below - rows[0].height()).abs() < 1.0,
        "{below} {grown}"
    );
}
