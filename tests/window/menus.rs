//! Context menus: opened by the second button and by the menu key, chosen from by label.

use batten::editor::{Editor, PlotKind, told};
use batten::geometry::rounded_up;
use batten::io::examples::EXAMPLES;
use eframe::egui::{Event, Key, Modifiers, PointerButton, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::hand::*;

/// A window with a curve of more vertices than its degree asks for.
fn open_s_curve() -> Window {
    let mut editor = Editor::new();
    let index = EXAMPLES
        .iter()
        .position(|example| example.name == "s-curve");
    told(editor.open_example(index.expect("an example")));
    open_window_with(editor, 1480.0, 920.0)
}

fn has(window: &Window, label: &str) -> bool {
    window.query_all_by_label(label).next().is_some()
}

fn vertices(window: &Window) -> usize {
    curve(window).polygon.vertices().len()
}

/// Open the menu of that name: a layer has it too.
fn open_curve_menu(window: &mut Window) {
    let menu = window.query_all_by_label("Curve").next();
    menu.expect("the menu").click();
    window.run();
}

/// Open the menu of operations on vertices and degree.
fn open_degree_menu(window: &mut Window) {
    open_curve_menu(window);
    click(window, "Vertices and degree");
}

#[test]
fn a_vertex_is_locked_and_deleted_by_its_menu() {
    let mut window = open_s_curve();
    let count = vertices(&window);
    let at = vertex(&window, 5);
    right_click(&mut window, at);
    let selected: Vec<_> = window
        .state()
        .editor()
        .hand()
        .selection()
        .vertices()
        .collect();
    assert_eq!(selected.len(), 1);
    pick(&mut window, "Lock vertices");
    assert!(curve(&window).locked_vertices.contains(5));
    assert!(!has(&window, "Delete vertices"), "the menu is closed");
    right_click(&mut window, at);
    pick(&mut window, "Unlock vertices");
    right_click(&mut window, at);
    pick(&mut window, "Delete vertices");
    assert_eq!(vertices(&window), count - 1);
}

#[test]
fn a_curve_has_its_operations_and_the_canvas_its_layers() {
    let mut window = open_window();
    let middle = curve(&window).polygon.jet(0.5).point.truncate();
    let at = place(&window, middle);
    right_click(&mut window, at);
    assert!(has(&window, "Operations"));
    click(&mut window, "Operations");
    click(&mut window, "Round coordinates…");
    assert!(window.state().editor().previewed_operation().is_some());
    press(&mut window, Modifiers::NONE, Key::Escape);

    let canvas = window.state().canvas_rect().expect("a canvas");
    let corner = canvas.right_bottom() - vec2(60.0, 60.0);
    right_click(&mut window, corner);
    assert!(!has(&window, "Operations"));
    click(&mut window, "Layers");
    press(&mut window, Modifiers::NONE, Key::Escape);
    right_click(&mut window, corner);
    click(&mut window, "Add reference");
    click(&mut window, "Circle");
    assert_eq!(window.state().editor().document().references().len(), 1);
}

#[test]
fn rows_and_plots_have_menus_and_a_drag_opens_none() {
    let mut window = open_window();
    let row = window.get_by_label("curve arc").rect().center();
    right_click(&mut window, row - vec2(40.0, 0.0));
    pick(&mut window, "Duplicate curve");
    assert_eq!(window.state().editor().document().len(), 2);
    right_click(&mut window, row - vec2(40.0, 0.0));
    pick(&mut window, "Visible");
    let hidden = window.state().editor().document().curves();
    assert_eq!(hidden.filter(|(_, curve)| !curve.visible).count(), 1);

    let fold = window.get_by_label("Collapse plots").rect().center();
    right_click(&mut window, fold + vec2(-400.0, 90.0));
    pick(&mut window, "Plots");
    assert!(has(&window, "Expand plots"));

    // A drag with the second button orbits.
    let canvas = window.state().canvas_rect().expect("a canvas").center();
    window.hover_at(canvas);
    window.run();
    let event = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Secondary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    window.event(event(canvas, true));
    window.step();
    window.hover_at(canvas + vec2(50.0, 20.0));
    window.step();
    window.event(event(canvas + vec2(50.0, 20.0), false));
    window.run();
    assert!(!has(&window, "Operations") && !has(&window, "View from"));
}

#[test]
fn the_menu_key_opens_a_menu_that_keys_go_through() {
    let mut window = open_s_curve();
    let count = vertices(&window);
    let at = vertex(&window, 5);
    drag(&mut window, at, at);
    press(&mut window, Modifiers::NONE, Key::Menu);
    let focused = window.query_all_by_label("Delete vertices");
    assert!(
        focused
            .into_iter()
            .any(|entry| entry.accesskit_node().is_focused())
    );
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!has(&window, "Delete vertices"));
    press(&mut window, Modifiers::SHIFT, Key::F10);
    assert!(has(&window, "Delete vertices"));
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(vertices(&window), count - 1);
}

#[test]
fn what_elevating_the_degree_costs_stands_beside_it() {
    let mut window = open_s_curve();
    let before = curve(&window).polygon;
    let elevated = before.with_degree(before.degree() + 1).expect("a curve");
    let told = format!("± {}", rounded_up(elevated.deviation));
    let entry = format!("Elevate degree… {told}");
    assert!(!has(&window, &entry));
    open_degree_menu(&mut window);
    assert!(has(&window, &entry), "{entry}");
    press(&mut window, Modifiers::NONE, Key::Escape);
    let at = place(&window, before.jet(1.5).point.truncate());
    right_click(&mut window, at);
    click(&mut window, "Operations");
    assert!(has(&window, &entry));
    press(&mut window, Modifiers::NONE, Key::Escape);
    press(&mut window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text("Elevate".to_owned()));
    window.run();
    assert!(has(&window, &entry));
    press(&mut window, Modifiers::NONE, Key::Escape);

    // The document's unit is that of the length, and the curve that is shown counts.
    click(&mut window, "Unit none");
    click(&mut window, "Document unit: millimetres");
    press(&mut window, Modifiers::NONE, Key::Escape);
    let from = vertex(&window, 5);
    drag(&mut window, from, from + vec2(0.0, 20.0));
    let moved = curve(&window).polygon;
    let elevated = moved.with_degree(moved.degree() + 1).expect("a curve");
    open_degree_menu(&mut window);
    let told = format!("± {} mm", rounded_up(elevated.deviation));
    assert!(has(&window, &format!("Elevate degree… {told}")));
    press(&mut window, Modifiers::NONE, Key::Escape);

    choose(&mut window, &["File", "Examples", "Ninth-degree arc"]);
    click(&mut window, "Discard");
    open_degree_menu(&mut window);
    assert!(has(&window, "Elevate degree… exact"));
    press(&mut window, Modifiers::NONE, Key::Escape);
    click(&mut window, "Locked");
    open_degree_menu(&mut window);
    assert!(has(&window, "Elevate degree…"));
}

#[test]
fn a_feature_has_a_menu_in_its_row() {
    let mut window = open_s_curve();
    let row = window
        .query_all_by_label_contains("κ maximum, ")
        .next()
        .expect("a row");
    let row = row.rect().center();
    let scale = |window: &Window| window.state().editor().view().viewport().scale;
    let before = scale(&window);
    for _ in 0..2 {
        // A second time it stays chosen.
        right_click(&mut window, row);
        assert!(window.state().editor().view().chosen_feature().is_some());
        press(&mut window, Modifiers::NONE, Key::Escape);
    }
    assert_eq!(scale(&window), before, "a menu moves nothing");
    right_click(&mut window, row);
    pick(&mut window, "Go to feature");
    assert!(scale(&window) > before);
    right_click(&mut window, row);
    pick(&mut window, "Split curve…");
    assert!(window.state().editor().previewed_operation().is_some());
}

#[test]
fn the_plots_menu_has_its_own_commands() {
    let mut window = open_s_curve();
    press(&mut window, Modifiers::COMMAND, Key::D);
    let editor = window.state().editor();
    let active = editor.active();
    let others: Vec<_> = editor.document().curves().collect();
    let (other, curve) = others
        .iter()
        .find(|(id, _)| Some(*id) != active)
        .expect("two curves");
    let (other, name) = (*other, curve.name.clone());
    click(&mut window, "κ level 2");
    click(&mut window, "Plot menu");
    pick(&mut window, "Compare with");
    pick(&mut window, &name);
    assert_eq!(window.state().editor().sight().compared(), Some(other));
    let fold = window.get_by_label("Collapse plots").rect().center();
    let plot = fold + vec2(-400.0, 90.0);
    right_click(&mut window, plot);
    pick(&mut window, "Compare with");
    pick(&mut window, "Compare with nothing");
    assert_eq!(window.state().editor().sight().compared(), None);

    right_click(&mut window, plot);
    pick(&mut window, "Normalise length");
    window.run();
    let is_normalised = |window: &Window| {
        let kind = window.state().editor().view().plot;
        matches!(
            kind,
            Some(PlotKind::Levels {
                normalised: true,
                ..
            })
        )
    };
    assert!(is_normalised(&window));
    // The switch in the bar is the same.
    click(&mut window, "Normalise length");
    window.run();
    assert!(!is_normalised(&window));

    drag(&mut window, plot, plot + vec2(-80.0, 0.0));
    let is_moved = |window: &Window| {
        let button = window.get_by_label("Fit the plot");
        !button.accesskit_node().is_disabled()
    };
    assert!(is_moved(&window));
    right_click(&mut window, plot);
    pick(&mut window, "Fit plot");
    window.run();
    assert!(!is_moved(&window));
}
