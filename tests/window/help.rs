//! The manual, and the page that F1 opens.

use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;

use crate::hand::*;

fn choose_first(window: &mut Window, label: &str) {
    let link = window.get_all_by_label(label).next();
    link.expect("a link").click();
    window.run();
}

fn press_f1_over(window: &mut Window, label: &str) {
    let at = window.get_by_label(label).rect().center();
    window.hover_at(at);
    window.run();
    press(window, Modifiers::NONE, Key::F1);
}

#[test]
fn f1_over_a_panel_opens_its_page() {
    for (label, text) in [
        ("Curvature", "level 1 is the curvature"),
        ("Features", "A feature is an interval"),
        ("Inspector", "A curve is a B-spline"),
        ("Measure", "click where the curve goes on to"),
    ] {
        let mut window = open_window();
        press_f1_over(&mut window, label);
        assert!(
            window.query_all_by_label_contains(text).count() > 0,
            "{label}: {text}"
        );
    }
}

/// The window refuses letters that its fonts do not have.
#[test]
fn every_page_is_shown_with_all_its_letters() {
    let mut window = open_window();
    choose(&mut window, &["Help", "Manual"]);
    for title in [
        "Curves and polygons",
        "Ends and matches",
        "Plots and levels",
        "Proofs",
        "Harmony",
        "Operations",
        "References",
        "Files",
        "Command line",
        "FreeCAD",
        "Rhino",
        "Inkscape",
        "Blender",
    ] {
        let link = window.get_all_by_label(title).last();
        link.expect("a link").click();
        window.run();
        choose_first(&mut window, "First steps");
    }
}

#[test]
fn escape_closes_the_manual_and_leaves_the_tool_alone() {
    let mut window = open_window();
    press(&mut window, Modifiers::NONE, Key::D);
    choose(&mut window, &["Help", "Manual"]);
    let tool = window.state().editor().hand().tool();
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Search the manual").is_none());
    assert_eq!(window.state().editor().hand().tool(), tool);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_ne!(window.state().editor().hand().tool(), tool);
}

#[test]
fn f1_over_the_canvas_lists_the_keys() {
    let mut window = open_window();
    let at = window.state().canvas_rect().expect("a canvas").center();
    window.hover_at(at);
    window.run();
    press(&mut window, Modifiers::NONE, Key::F1);
    window.get_by_label("@length<angle");
    assert!(window.query_by_label("Search the manual").is_none());
}

#[test]
fn f1_in_an_open_menu_opens_the_page_of_the_operation_under_the_pointer() {
    let mut window = open_window();
    // The menu comes before the legend's entry of the same name.
    let menus = window.get_all_by_label("Curve");
    menus
        .min_by(|a, b| a.rect().top().total_cmp(&b.rect().top()))
        .expect("a menu")
        .click();
    window.run();
    press_f1_over(&mut window, "Reverse direction");
    assert!(
        window
            .query_all_by_label_contains("batten apply reverse")
            .count()
            > 0
    );
}

#[test]
fn links_and_search_lead_to_pages() {
    let mut window = open_window();
    choose(&mut window, &["Help", "Manual"]);
    window.get_by_label_contains("Click a few times");
    choose_first(&mut window, "Proofs");
    assert!(
        window
            .query_all_by_label_contains("A feature is an interval")
            .count()
            > 0
    );
    click(&mut window, "Search the manual");
    window.event(Event::Text("osculating plane".to_owned()));
    window.run();
    choose_first(&mut window, "Curvature at an end");
    assert!(
        window
            .query_all_by_label_contains("drag its dashed circle")
            .count()
            > 0
    );
}
