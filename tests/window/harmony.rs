//! The harmony in the window: strips under the canvas, sentences in the inspector.

use batten::editor::PlotKind;
use eframe::egui::{Event, Key, Modifiers, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::hand::*;

/// The sentences of the inspector, from the first on that holds some words.
fn said(window: &Window, words: &str) -> String {
    let found = window.query_all_by_label_contains(words).next();
    let node = found.unwrap_or_else(|| panic!("nothing says {words:?}"));
    let node = node.accesskit_node();
    // What is only told has its text as a value.
    node.label().or_else(|| node.value()).unwrap_or_default()
}

#[test]
fn sentences_tell_the_harmony_and_follow_a_drag_and_its_undo() {
    let mut window = open_window_of(1480.0, 1280.0);
    choose(&mut window, &["File", "Examples", "Waterline"]);
    assert!(
        window.state().editor().sight().harmony().is_none(),
        "nothing shows it"
    );
    click(&mut window, "Harmony");
    let follows = said(&window, "Discrete curvature follows the curve");
    assert!(
        follows.ends_with(": 1 extremum, no inflections in the same order"),
        "{follows}"
    );
    said(&window, "Regular to order 5, the highest of this degree");
    said(&window, "Bending energy: ");
    said(&window, "Variation: ");
    said(&window, "slope α ");
    let legs = said(&window, "Legs least even at vertex ");
    let from = vertex(&window, 8);
    drag(&mut window, from, from + vec2(0.0, -12.0));
    assert_ne!(said(&window, "Legs least even at vertex "), legs);
    let differs = said(&window, "Discrete curvature differs first at ");
    assert_ne!(differs, follows);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(
        said(&window, "Discrete curvature follows the curve"),
        follows
    );
    assert_eq!(said(&window, "Legs least even at vertex "), legs);
}

#[test]
fn a_sentence_marks_its_vertex_and_selects_it() {
    let mut window = open_window_of(1480.0, 1280.0);
    choose(&mut window, &["File", "Examples", "Waterline"]);
    click(&mut window, "Harmony");
    let sentence = said(&window, "Turning least even at vertex ");
    let number = sentence.split("vertex ").nth(1).expect("a vertex");
    let number = number.split(':').next().expect("a number");
    let vertex: usize = number.parse().expect("a number");
    let at = window.get_by_label(&sentence).rect().center();
    window.hover_at(at);
    window.run();
    assert_eq!(
        window.state().editor().sight().hovered_vertex(),
        Some(vertex)
    );
    click(&mut window, &sentence);
    let editor = window.state().editor();
    let curve = editor.active().expect("a curve");
    let selected: Vec<usize> = editor.hand().selection().of_curve(curve).collect();
    assert_eq!(selected, [vertex]);
    assert!(!editor.workspace().is_modified());
}

#[test]
fn a_strip_and_the_canvas_mark_the_same_vertex() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Waterline"]);
    click(&mut window, "Harmony strips");
    let shown = window.state().editor().view().plot;
    assert_eq!(shown, Some(PlotKind::Harmony));
    let canvas = window.state().canvas_rect().expect("the canvas was shown");
    window.hover_at(canvas.center_bottom() + vec2(0.0, 80.0));
    window.run();
    let hovered = window.state().editor().sight().hovered_vertex();
    let count = curve(&window).polygon.vertices().len();
    // The middle of the strips, beside which there is room for the axis alone.
    assert!(
        hovered.is_some_and(|vertex| vertex.abs_diff(count / 2) <= 2),
        "{hovered:?}"
    );
    window.hover_at(vertex(&window, 3));
    window.run();
    let plots = window.state().editor().view().plots();
    assert_eq!(plots.hovered_vertex, Some(3));
}

#[test]
fn strips_are_compared_with_another_curve_that_is_chosen() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Waterline"]);
    click(&mut window, "Harmony strips");
    press(&mut window, Modifiers::COMMAND, Key::D);
    let editor = window.state().editor();
    let ids: Vec<_> = editor.document().ids().collect();
    assert_eq!(ids.len(), 2, "a copy");
    let other = ids.into_iter().find(|id| editor.active() != Some(*id));
    let name = editor
        .document()
        .curve(other.expect("two curves"))
        .expect("a curve")
        .name
        .clone();
    click(&mut window, "Curve to compare with");
    let choices = window.query_all_by_label(&name).count();
    assert!(choices > 0, "{name}");
    let choice = window.query_all_by_label(&name).last().expect("a choice");
    choice.click();
    window.run();
    let shown = window.state().editor().view().plot;
    assert_eq!(shown, Some(PlotKind::Harmony));
    assert_eq!(window.state().editor().sight().compared(), other);
    assert!(window.state().editor().view().plots().compared.is_some());
    // The other curve stays beside this one in every plot.
    for tab in ["Curvature", "κ level 2"] {
        click(&mut window, tab);
        let plots = window.state().editor().view().plots();
        let other = plots.compared.as_ref().expect("another curve");
        let series = [&other.series, &other.series];
        assert!(series.iter().any(|series| !series.is_empty()), "{tab}");
    }
}

#[test]
fn an_operation_tells_the_harmony_before_and_afterwards() {
    let mut window = open_window();
    choose(&mut window, &["File", "Examples", "Waterline"]);
    press(&mut window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text("Round coordinates".to_owned()));
    window.run();
    press(&mut window, Modifiers::NONE, Key::Enter);
    for figure in [
        "Discrete κ follows",
        "Regular to order",
        "Leg change",
        "Turning change",
        "Discrete κ extrema",
        "Bending energy",
        "Variation",
        "Slope α",
    ] {
        let told = said(&window, figure);
        assert!(
            told.contains(" before, ") && told.ends_with(" after"),
            "{told}"
        );
    }
    assert_eq!(
        said(&window, "Regular to order"),
        "Regular to order: 5 of 5 before, 5 of 5 after"
    );
    let torsion = window.query_all_by_label_contains("Torsion change").count();
    assert_eq!(torsion, 0, "a planar curve has none");
}
