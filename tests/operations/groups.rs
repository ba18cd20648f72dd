//! The groups of curves that operations make.

use batten::document::{Curve, CurveId, Document, Group, Reference};
use batten::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use batten::geometry::{FloatPolygon, Progress};
use batten::operations::{Operands, Value};
use glam::DVec3;

use crate::runner::operation;

fn arc(name: &str, from: f64, group: &str) -> Curve {
    let points = (0..12).map(|index| {
        let x = from + f64::from(index);
        (x, 0.01 * x * x)
    });
    let polygon = FloatPolygon::planar(3, &points.collect::<Vec<_>>());
    Curve::new(name, polygon.expect("a polygon")).in_group(group.into())
}

fn reference(form: &str, group: &str) -> Reference {
    let curve = ReferenceCurve::from_text(form).expect("a reference");
    Reference::new(form, curve).in_group(group.into())
}

/// The names and groups of all curves after an operation on items of a document, the first of them active.
fn after(
    document: &Document,
    name: &str,
    given: &[(&str, Value)],
    items: &[CurveId],
) -> Vec<(String, String)> {
    let operation = operation(name);
    let (active, others) = items.split_first().expect("an item");
    let input = Operands::choose(document, operation.inputs, Some(*active), others);
    let input = input.expect("operands");
    let values = operation.values(&input, given.iter().cloned());
    let outcome = operation.run(&input, &values.expect("values"), &Progress::default());
    let after = outcome.expect("it can run").applied_to(document);
    let after = after.expect("edits");
    let curves = after.curves();
    let curves = curves.map(|(_, curve)| (curve.name.clone(), curve.group.to_string()));
    curves.collect()
}

fn groups(curves: &[(String, String)]) -> Vec<&str> {
    curves.iter().map(|(_, group)| group.as_str()).collect()
}

#[test]
fn parts_of_a_curve_stay_in_its_group() {
    let document = Document::from_curves([arc("keel", 0.0, "Hull/Keel")]);
    let ids: Vec<CurveId> = document.ids().collect();
    let split = after(&document, "split", &[("at", Value::Real(2.0))], &ids);
    assert_eq!(groups(&split), ["Hull/Keel"; 2]);
    let trimmed = after(&document, "trim", &[("to", Value::Real(2.0))], &ids);
    assert_eq!(groups(&trimmed), ["Hull/Keel"]);
}

#[test]
fn a_joined_curve_stays_in_the_group_of_the_first() {
    let document = Document::from_curves([arc("a", 0.0, "Hull"), arc("b", 13.0, "Deck")]);
    let ids: Vec<CurveId> = document.ids().collect();
    let bridge = ("method", Value::Choice(2));
    let joined = after(&document, "join", std::slice::from_ref(&bridge), &ids);
    assert_eq!(groups(&joined), ["Hull"]);
    let turned: Vec<CurveId> = ids.iter().rev().copied().collect();
    let joined = after(&document, "join", &[bridge], &turned);
    assert_eq!(groups(&joined), ["Deck"]);
}

#[test]
fn a_curve_made_of_a_reference_goes_to_its_group() {
    let points = (0..40).map(|index| {
        let x = 0.1 * f64::from(index);
        DVec3::new(x, x.sin(), 0.0)
    });
    let points = PointList::new(points.collect()).expect("points");
    let points = ReferenceCurve::of(ReferenceForm::Points(points)).expect("a reference");
    let points = Reference::new("points", points).in_group("Scan/1".into());
    let references = [reference("circle", "Round"), points];
    let document = Document::from_curves([arc("a", 0.0, "Hull")]).with_references(references);
    let ids: Vec<CurveId> = document.all_ids().collect();
    let made = after(&document, "approximate", &[], &ids[1..2]);
    assert_eq!(groups(&made), ["Hull", "Round"]);
    let fitted = after(&document, "fit", &[], &ids[2..]);
    assert_eq!(groups(&fitted), ["Hull", "Scan/1"]);
    // Another reference is given than the active curve.
    let circle = ReferenceCurve::from_text("circle").expect("a reference");
    let given = ("reference", Value::Reference(Some(Box::new(circle))));
    let made = after(&document, "approximate", &[given], &ids[..1]);
    assert_eq!(groups(&made), ["Hull", "Round"]);
}

#[test]
fn a_curve_made_of_nothing_has_no_group() {
    let document = Document::from_curves([arc("a", 0.0, "Hull")]);
    let ids: Vec<CurveId> = document.ids().collect();
    let made = after(&document, "mineur-farin", &[], &ids);
    assert!(
        groups(&made)[1..].iter().all(|group| group.is_empty()),
        "{made:?}"
    );
    assert!(made.len() > 1);
    assert_eq!(Group::default().to_string(), "");
}

#[test]
fn a_segment_between_curves_goes_to_the_group_of_the_first() {
    let document = Document::from_curves([arc("a", 0.0, "Hull"), arc("b", 20.0, "Deck")]);
    let ids: Vec<CurveId> = document.ids().collect();
    let made = after(&document, "between", &[("kind", Value::Choice(2))], &ids);
    assert_eq!(groups(&made), ["Hull", "Deck", "Hull"]);
}
