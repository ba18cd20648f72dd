//! The side panel beside a selection and without one: the document's properties, the counts of features,
//! the list of keys.

use batten::document::{Curve, Document, Edit};
use batten::editor::Editor;
use batten::geometry::FloatPolygon;
use batten::geometry::expressions::LengthUnit;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use glam::DVec3;

use crate::hand::*;

#[test]
fn the_documents_unit_is_set_in_the_inspector() {
    let mut window = open_window();
    choose(&mut window, &["File", "New"]);
    click(&mut window, "Document unit");
    click(&mut window, "centimetres");
    let unit = window.state().editor().document().unit();
    assert_eq!(unit, Some(LengthUnit::Centimetre));
    window.get_by_label("Unit cm");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(window.state().editor().document().unit(), None);

    // Beside a curve it has a section of its own.
    choose(&mut window, &["File", "Examples", "S-curve"]);
    click(&mut window, "Document");
    click(&mut window, "Document unit");
    click(&mut window, "inches");
    let unit = window.state().editor().document().unit();
    assert_eq!(unit, Some(LengthUnit::Inch));
}

#[test]
fn examples_in_millimetres_say_so() {
    let mut window = open_window();
    for example in ["Bottle", "Waterline"] {
        choose(&mut window, &["File", "Examples", example]);
        window.get_by_label("Unit mm");
    }
    choose(&mut window, &["File", "Examples", "S-curve"]);
    window.get_by_label("Unit none");
}

#[test]
fn the_verdict_counts_what_the_list_has() {
    let vertex = |index: u32| {
        let t = 0.7 * f64::from(index);
        DVec3::new(10.0 * t.cos(), (8.0 + t) * t.sin(), 2.0 * t + t.sin())
    };
    let polygon = FloatPolygon::new(5, (0..14).map(vertex).collect(), None, false);
    let curve = Curve::new("helix", polygon.expect("a polygon"));
    let mut document = Document::default();
    document
        .apply(Edit::Add(Box::new(curve)))
        .expect("a curve is added");
    let window = open_window_with(Editor::with_document(document), 1480.0, 920.0);
    let report = window
        .state()
        .editor()
        .sight()
        .features()
        .expect("features");
    let listed: usize = report.rows.iter().map(|row| row.count).sum();
    let verdict = window
        .query_all_by_label_contains("κ extrem")
        .find_map(|node| node.accesskit_node().value())
        .expect("a verdict in the list of features");
    let numbers = verdict
        .split(' ')
        .filter_map(|word| word.parse::<usize>().ok());
    assert_eq!(numbers.sum::<usize>(), listed, "{verdict}");
    assert!(verdict.contains("τ"), "{verdict}");
}

#[test]
fn the_list_of_keys_has_what_can_be_typed() {
    let mut window = open_window();
    press(&mut window, Modifiers::NONE, Key::F1);
    for keys in [
        "x,y",
        "@dx,dy",
        "@length<angle",
        "2*pi, 10*cos(30deg)",
        "F2",
    ] {
        window.get_by_label(keys);
    }
    assert!(window.query_all_by_label("Rename curve").count() > 0);
}
