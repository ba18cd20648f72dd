//! References, curves and points that operations approximate, tried out and applied.

use batten::document::{Document, Edit, Reference};
use batten::editor::{Command, Editor, Look};
use batten::geometry::references::{PointList, ReferenceCurve, ReferenceForm, find};
use batten::operations::Value;
use glam::{DVec2, DVec3};

use super::script::Script;

/// The paper's arc and a conical spiral, which is active.
fn spiral() -> Script {
    let mut script = Script::example("arc");
    let kind = find("conical-spiral").expect("a kind");
    script.command(Command::AddReference(kind));
    script
}

#[test]
fn a_reference_that_is_active_is_approximated_and_compared_in_the_plots() {
    let mut script = spiral();
    let reference = script.editor.active().expect("a reference");
    let before = script.editor.document().clone();
    let steps = script.steps();
    script.try_out("approximate").expect("it can run");
    let made = script.editor.active().expect("a curve");
    assert!(before.curve(made).is_none() && made != reference);
    assert_eq!(script.editor.sight().compared(), Some(reference));
    let plots = script.plots();
    let other = plots.compared.as_ref().expect("the reference");
    assert!(!other.series.is_empty());
    let far = |script: &Script| {
        let report = serde_json::to_value(script.trial_report()).expect("a report");
        report["deviation"].as_f64().expect("a number")
    };
    let coarse = far(&script);
    let vertices = Value::List(vec![60.0]);
    script.set("count", vertices).expect("a count");
    assert!(far(&script) < 1e-3 * coarse);
    assert_eq!(script.polygon().vertices().len(), 60);
    script.editor.operating().apply().expect("it is reached");
    assert_eq!(script.steps(), steps + 1);
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn a_curve_takes_another_degree_and_count_and_esc_gives_it_back() {
    let mut script = Script::example("s-curve");
    let before = script.editor.document().clone();
    script.try_out("approximate").expect("it can run");
    for (name, value) in [
        ("degree", Value::Whole(7)),
        ("count", Value::List(vec![30.0])),
    ] {
        script.set(name, value).expect("a value");
    }
    let polygon = script.polygon();
    assert_eq!((polygon.degree(), polygon.vertices().len()), (7, 30));
    assert_eq!(script.editor.document().len(), before.len());
    script.editor.operating().leave();
    assert!(script.editor.document().is_same(&before));
    script.command(Command::ToggleLocked);
    script.try_out("approximate").expect_err("it is locked");
}

#[test]
fn points_that_are_active_are_fitted() {
    let points = (0..80).map(|index| {
        let t = 0.05 * f64::from(index);
        let noise = 0.002 * f64::from((index * 37) % 11 - 5);
        DVec3::new(t, 0.2 * t * t + noise, 0.0)
    });
    let points = PointList::new(points.collect()).expect("points");
    let curve = ReferenceCurve::of(ReferenceForm::Points(points)).expect("a reference");
    let scan = Edit::AddReference(Box::new(Reference::new("scan", curve)));
    let mut editor = Editor::with_document(Document::default());
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    editor.apply("Add scan", vec![scan]).expect("it is added");
    let scan = editor.document().references().next().expect("a scan").0;
    editor.activate(scan);
    let mut script = Script { editor };
    script.try_out("fit").expect("it can run");
    script
        .set("extrema", Value::List(vec![1.0]))
        .expect("a count");
    let report = serde_json::to_value(script.trial_report()).expect("a report");
    assert_eq!(report["reached"], true, "{report}");
    script.editor.operating().apply().expect("it is reached");
    assert_eq!(script.editor.document().len(), 1);
    script.command(Command::Undo);
    assert_eq!(script.editor.document().len(), 0);
    assert!(script.editor.document().reference(scan).is_some());
}

#[test]
fn only_what_follows_a_reference_is_compared_with_the_active_one() {
    for (name, is_compared) in [
        ("between", false),
        ("mineur-farin", false),
        ("approximate", true),
    ] {
        let mut script = spiral();
        let reference = script.curve();
        script.try_out(name).expect("it can run");
        let compared = script.editor.sight().compared();
        assert_eq!(compared == Some(reference), is_compared, "{name}");
    }
}
