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

#[test]
fn view_chooses_between_curvature_and_radius() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Bottle"]);
    let has = |window: &Window, text: &str| window.query_all_by_label_contains(text).count() > 0;
    for (choice, curvature, radius) in [
        ("Curvature as both", true, true),
        ("Curvature as κ", true, false),
        ("Curvature as R", false, true),
    ] {
        choose(&mut window, &["View", "Show curvature", choice]);
        assert_eq!(has(&window, "Curvature: "), curvature, "{choice}");
        assert_eq!(has(&window, "Radius: "), radius, "{choice}");
        let cells = [has(&window, "κ –"), has(&window, "R –")];
        assert_eq!(cells, [curvature, radius], "{choice}");
    }
}

#[test]
fn the_list_of_curves_is_as_tall_as_its_rows_up_to_a_share() {
    let height = |count: usize| {
        let curve = |place: usize| {
            let at = |x: f64| DVec3::new(x, x * x, place as f64);
            let vertices = (0..4).map(|vertex| at(f64::from(vertex))).collect();
            let polygon = FloatPolygon::new(3, vertices, None, false).expect("a polygon");
            Curve::new(format!("number {place}"), polygon)
        };
        let document = Document::from_curves((0..count).map(curve));
        let window = open_window_with(Editor::with_document(document), 1440.0, 900.0);
        let top = window.get_by_label("Collapse curve list").rect().top();
        window.get_by_label("Inspector").rect().top() - top
    };
    let [few, more, many] = [3, 6, 60].map(height);
    assert!((more - few - 3.0 * 24.0).abs() < 1.0, "{few} {more}");
    assert!(more < many && many < 0.45 * 900.0, "{many}");
    let mut window = open_window();
    let tabs = |window: &Window| window.get_by_label("Inspector").rect().top();
    let before = tabs(&window);
    click(&mut window, "Collapse curve list");
    assert!(tabs(&window) < before - 40.0);
    click(&mut window, "Expand curve list");
    assert_eq!(tabs(&window), before);
}

#[test]
fn tools_show_their_names_on_demand() {
    let mut window = open_window();
    let width = |window: &Window| window.get_by_label("Measure").rect().width();
    let before = width(&window);
    choose(&mut window, &["Tools", "Tool names"]);
    assert!(width(&window) > before + 80.0);
    choose(&mut window, &["Tools", "Tool names"]);
    assert_eq!(width(&window), before);
}
