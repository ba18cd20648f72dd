//! The panel of a fit: its points and whiskers, and what each number of extrema reaches.

use batten::document::{Document, Edit, Reference};
use batten::editor::{Editor, Whiskers};
use batten::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use batten::operations::Value;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use glam::DVec3;

use crate::hand::*;
use crate::numbers::enter;

/// A window with points of a parabola, the tenth of them far off, that are fitted.
fn fitting() -> Window {
    let points = (0..24).map(|index| {
        let t = 0.1 * f64::from(index);
        let noise = 0.002 * f64::from((index * 37) % 11 - 5);
        let off = if index == 9 { 0.3 } else { 0.0 };
        DVec3::new(t, 0.2 * t * t + noise + off, 0.0)
    });
    let points = PointList::new(points.collect()).expect("points");
    let curve = ReferenceCurve::of(ReferenceForm::Points(points)).expect("a reference");
    let scan = Edit::AddReference(Box::new(Reference::new("scan", curve)));
    let mut editor = Editor::with_document(Document::default());
    editor.apply("Add scan", vec![scan]).expect("it is added");
    let scan = editor.document().references().next().expect("a scan").0;
    editor.activate(scan);
    let mut window = open_window_with(editor, 1480.0, 1300.0);
    press(&mut window, Modifiers::COMMAND, Key::P);
    window.event(Event::Text("Fit points".to_owned()));
    window.run();
    enter(&mut window);
    window
}

fn whiskers(window: &Window) -> Whiskers {
    window.state().editor().view().whiskers
}

fn value(window: &Window, name: &str) -> Value {
    let operation = window.state().editor().operation().expect("a fit");
    let mut parameters = operation.operation().parameters.iter();
    let parameter = parameters.find(|it| it.name == name).expect("a parameter");
    operation.values().get(parameter).clone()
}

#[test]
fn points_are_counted_and_switched_and_their_whiskers_scaled() {
    let mut window = fitting();
    window.get_by_label("Points: 24 points, 1 left out");
    let operation = window.state().editor().operation().expect("a fit");
    let point = operation.input().points()[4].truncate();
    let at = place(&window, point);
    window.hover_at(at);
    window.run();
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.run();
    window.get_by_label("Points: 24 points, 2 left out");
    assert_eq!(value(&window, "outliers"), Value::List(vec![4.0, 9.0]));

    click(&mut window, "Whisker scale");
    type_over(&mut window, "50");
    enter(&mut window);
    assert_eq!(whiskers(&window).scale, Some(50.0));
    click(&mut window, "Reset whisker scale");
    assert_eq!(whiskers(&window).scale, None);
    assert!(whiskers(&window).shown);
    click(&mut window, "Whiskers");
    assert!(!whiskers(&window).shown);
}

#[test]
fn a_click_on_a_bar_asks_for_its_number_of_extrema_and_the_bars_stay() {
    let mut window = fitting();
    let bars = |window: &Window| window.get_all_by_label_contains(" off").count();
    let before = bars(&window);
    assert!(before >= 3, "{before} bars and points left out");
    let report = window
        .state()
        .editor()
        .operation()
        .and_then(|it| it.report());
    let present = report.and_then(|it| it.figure("extrema"));
    let Some(Value::Whole(present)) = present else {
        panic!("{present:?}");
    };
    let other = format!("{} extrem", present + 1);
    let bar = window.get_all_by_label_contains(&other);
    bar.into_iter().next().expect("a bar").click();
    window.run();
    let asked = Value::List(vec![(present + 1) as f64]);
    assert_eq!(value(&window, "extrema"), asked);
    assert_eq!(bars(&window), before);
}
