//! References in the window: added by the menu, changed in the inspector, hidden and locked in the list.

use batten::document::Reference;
use batten::geometry::ParametricCurve;
use batten::geometry::references::{KINDS, ReferenceForm};
use eframe::egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;

use crate::hand::*;

fn reference(window: &Window) -> Reference {
    let document = window.state().editor().document();
    let (_, reference) = document.references().next().expect("a reference");
    Reference::clone(reference)
}

fn values(window: &Window) -> Vec<f64> {
    match reference(window).curve.form() {
        ReferenceForm::Analytic(form) => form.values().to_vec(),
        form => panic!("{form:?}"),
    }
}

/// Add a reference by the menu; a layer is called “Curve” too.
fn add(window: &mut Window, kind: &str) {
    let menu = window.query_all_by_label("Curve").next();
    menu.expect("the menu").click();
    window.run();
    choose(window, &["Add reference", kind]);
}

#[test]
fn every_kind_is_added_by_the_menu_with_fields_for_its_parameters() {
    for kind in KINDS {
        let mut window = open_window();
        add(&mut window, kind.label);
        for parameter in kind.parameters {
            window.get_by_label(parameter.label);
        }
        let row = format!("reference {}", reference(&window).name);
        window.get_by_label(&row);
        press(&mut window, Modifiers::COMMAND, Key::Z);
        assert_eq!(window.state().editor().document().references().len(), 0);
    }
}

#[test]
fn parameters_and_places_are_typed_and_each_is_a_step() {
    let mut window = open_window();
    add(&mut window, "Circle");
    let before = reference(&window);
    click(&mut window, "Radius");
    type_over(&mut window, "7.5");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(values(&window), [7.5]);
    click(&mut window, "origin x");
    type_over(&mut window, "-2");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(reference(&window).curve.placement().translation().x, -2.0);
    click(&mut window, "reference angle");
    type_over(&mut window, "90");
    press(&mut window, Modifiers::NONE, Key::Enter);
    let turned = reference(&window);
    let angle = 2.0 * turned.curve.placement().rotation().z.asin();
    assert!((angle.to_degrees() - 90.0).abs() < 1e-12, "{angle}");

    // What is out of range is refused beside the field, and the circle stays.
    click(&mut window, "Radius");
    type_over(&mut window, "-1");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(values(&window), [7.5]);
    press(&mut window, Modifiers::NONE, Key::Escape);
    for _ in 0..3 {
        press(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(reference(&window), before);
}

#[test]
fn it_is_hidden_locked_renamed_and_deleted_in_the_list() {
    let mut window = open_window();
    add(&mut window, "Circle");
    click(&mut window, "Lock circle");
    assert!(reference(&window).locked);
    click(&mut window, "Lock circle");
    click(&mut window, "Show circle");
    assert!(!reference(&window).visible);
    click(&mut window, "Show circle");
    click(&mut window, "Name");
    press(&mut window, Modifiers::COMMAND, Key::A);
    type_over(&mut window, "fillet");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(reference(&window).name, "fillet");
    click(&mut window, "Delete reference");
    assert_eq!(window.state().editor().document().references().len(), 0);
}

#[test]
fn its_features_are_said_to_be_sampled() {
    let mut window = open_window();
    add(&mut window, "Clothoid");
    assert!(window.query_all_by_label_contains("sampled").count() > 0);
}

#[test]
fn a_formula_is_shown_while_it_is_typed_and_a_mistake_is_told() {
    let mut window = open_window();
    add(&mut window, "Formula");
    let before = reference(&window);
    click(&mut window, "x(t)");
    type_over(&mut window, "3*cos(t)");
    let shown = reference(&window);
    assert_ne!(shown, before, "what is typed is shown at once");
    type_over(&mut window, "3*cos(t)+");
    assert_eq!(reference(&window), shown, "the last good form stays");
    type_over(&mut window, "3*cosine(t)");
    assert!(window.query_all_by_label_contains("cosine").count() > 0);
    assert_eq!(reference(&window), shown);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(reference(&window), shown);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(reference(&window), before);

    click(&mut window, "y(t)");
    type_over(&mut window, "t^2");
    assert_ne!(reference(&window), before);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(reference(&window), before, "Esc calls it off");
}

#[test]
fn undo_in_the_middle_of_a_drag_takes_back_the_drag_alone() {
    let mut window = open_window();
    add(&mut window, "Circle");
    let steps = |window: &Window| window.state().editor().workspace().history().undo_steps();
    for label in ["origin x", "Radius"] {
        let before = reference(&window);
        let from = window.get_by_label(label).rect().center();
        window.hover_at(from);
        window.run();
        window.drag_at(from);
        window.step();
        for by in [20.0, 40.0] {
            window.hover_at(from + vec2(by, 0.0));
            window.step();
        }
        assert_ne!(reference(&window), before, "{label}");
        press(&mut window, Modifiers::COMMAND, Key::Z);
        assert_eq!(reference(&window), before, "{label}");
        // The rest of the drag does nothing.
        window.hover_at(from + vec2(60.0, 0.0));
        window.step();
        window.drop_at(from + vec2(60.0, 0.0));
        window.run();
        assert_eq!(reference(&window), before, "{label}");
        assert_eq!(steps(&window), 1);
    }
    let start = reference(&window).curve.jet(0.0).point.truncate();
    let (before, from) = (reference(&window), place(&window, start));
    window.hover_at(from);
    window.run();
    window.drag_at(from);
    window.step();
    for by in [20.0, 40.0] {
        window.hover_at(from + vec2(by, by));
        window.step();
    }
    assert_ne!(reference(&window), before);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    window.drop_at(from);
    window.run();
    assert_eq!(reference(&window), before);
    assert_eq!(steps(&window), 1);
}
