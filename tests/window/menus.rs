//! Context menus: opened by the second button and by the menu key, chosen from by label.

use batten::editor::{Editor, told};
use batten::io::examples::EXAMPLES;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
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

/// Click with the second button.
fn right_click(window: &mut Window, at: Pos2) {
    window.hover_at(at);
    window.run();
    for pressed in [true, false] {
        window.event(Event::PointerButton {
            pos: at,
            button: PointerButton::Secondary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.step();
    }
    window.run();
}

fn has(window: &Window, label: &str) -> bool {
    window.query_all_by_label(label).next().is_some()
}

fn vertices(window: &Window) -> usize {
    curve(window).polygon.vertices().len()
}

/// Choose an entry of the menu: it is shown above everything else of that name.
fn pick(window: &mut Window, label: &str) {
    let entries: Vec<Pos2> = window
        .query_all_by_label(label)
        .map(|entry| entry.rect().center())
        .collect();
    let at = *entries.last().expect("an entry");
    drag(window, at, at);
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
    pick(&mut window, "Vertices locked");
    assert!(curve(&window).locked_vertices.contains(5));
    assert!(!has(&window, "Delete vertices"), "the menu is closed");
    right_click(&mut window, at);
    pick(&mut window, "Vertices locked");
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
    assert!(window.state().editor().is_trying());
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
