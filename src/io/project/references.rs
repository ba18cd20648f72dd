//! References in project files: what is kept of them, and what is refused.

use super::*;
use crate::document::{Colour, Curve, CurveId, Edit, EndMatch, MatchPlace, Reference};
use crate::geometry::references::{
    AnalyticForm, KINDS, Placement, PointList, ReferenceCurve, ReferenceForm,
};
use crate::geometry::{Continuity, End, FloatPolygon};
use crate::io::{DXF, TABLE};
use glam::{DQuat, DVec3};

/// A project with one reference.
fn with_reference(reference: &str) -> String {
    format!(
        r#"{{"format":"batten","version":2,"curves":[],
        "references":[{reference}]}}"#
    )
}

fn back(document: &Document) -> Document {
    let export = PROJECT.write(document, None).unwrap();
    assert!(export.losses.is_empty());
    read(&export.bytes).unwrap().into_document().unwrap()
}

#[test]
fn every_kind_comes_back_exactly() {
    let placement = Placement::new(
        DQuat::from_xyzw(0.1, -0.2, 0.3, 0.9),
        1.0 / 3.0,
        DVec3::new(0.1, -7.0, 1e-9),
    );
    let placement = placement.unwrap();
    let mut references = Vec::new();
    for kind in KINDS {
        let form = AnalyticForm::new(kind, kind.defaults()).unwrap();
        let curve = ReferenceCurve::of(ReferenceForm::Analytic(form)).unwrap();
        let mut reference = Reference::new(kind.label, curve.clone());
        references.push(reference.clone());
        reference.curve = curve.placed(placement);
        reference.colour = Some(Colour([1, 2, 3]));
        reference.visible = false;
        reference.locked = true;
        reference.extras.push("mine", "[1.50]");
        references.push(reference);
    }
    for points in [
        vec![DVec3::ZERO, DVec3::new(0.1, 0.2, 0.0)],
        vec![DVec3::ZERO, DVec3::new(0.1, 0.2, -0.3), DVec3::ONE],
    ] {
        let list = ReferenceForm::Points(PointList::new(points).unwrap());
        let curve = ReferenceCurve::of(list).unwrap();
        references.push(Reference::new("points", curve.placed(placement)));
    }
    let document = Document::default().with_references(references.clone());
    let read = back(&document);
    let read = read
        .references()
        .map(|(_, reference)| Reference::clone(reference));
    assert_eq!(read.collect::<Vec<_>>(), references);
}

#[test]
fn the_layout_of_references_is_as_described() {
    let curve = ReferenceCurve::from_text("circle:radius=2.5,from=0,to=1").unwrap();
    let placement = Placement::new(DQuat::IDENTITY, 2.0, DVec3::X).unwrap();
    let circle = Reference::new("round", curve.placed(placement));
    let document = Document::default().with_references([circle]);
    let export = PROJECT.write(&document, None).unwrap();
    let text = String::from_utf8(export.bytes).unwrap();
    let text: String = text.split_whitespace().collect();
    assert_eq!(
        text,
        "{\"format\":\"batten\",\"version\":2,\"curves\":[],\"references\":[{\"name\":\"round\",\
         \"kind\":\"circle\",\"values\":{\"radius\":2.5},\"interval\":[0.0,1.0],\
         \"rotation\":[0.0,0.0,0.0,1.0],\"scale\":2.0,\"translation\":[1.0,0.0]}]}"
    );
}

#[test]
fn what_is_left_out_has_its_default() {
    let text = with_reference(r#"{"kind":"circle"}"#);
    let reading = read(text.as_bytes()).unwrap();
    let expected = ReferenceCurve::from_text("circle").unwrap();
    assert_eq!(
        reading.references,
        [Reference::new("reference 1", expected).into()]
    );
}

#[test]
fn a_match_to_a_reference_comes_back() {
    let polygon = FloatPolygon::planar(3, &[(0.0, 0.0), (1.0, 0.0), (2.0, 1.0), (3.0, 1.0)]);
    let circle = ReferenceCurve::from_text("circle:radius=4").unwrap();
    let document = Document::from_curves([Curve::new("arc", polygon.unwrap())])
        .with_references([Reference::new("round", circle)]);
    let (curve, source) = {
        let mut ids = document.all_ids();
        (ids.next().unwrap(), ids.next().unwrap())
    };
    for place in [MatchPlace::Parameter(1.25), MatchPlace::End(End::Finish)] {
        let matched = EndMatch {
            curve,
            end: End::Start,
            source,
            place,
            continuity: Continuity::G2,
            reversed: true,
        };
        let document = document.clone().with_matches([matched]).unwrap();
        let read = back(&document);
        assert_eq!(read.matches().collect::<Vec<_>>(), [&matched]);
    }
}

#[test]
fn unknown_keys_of_references_are_told_and_kept() {
    let text = with_reference(r#"{"name":"a","kind":"circle","extra":[1.50]}"#);
    let reading = read(text.as_bytes()).unwrap();
    assert_eq!(
        reading.remarks.to_string(),
        "reference 1 “a”: the key “extra” is not known and has no effect"
    );
    let document = reading.into_document().unwrap();
    assert!(document.has_extras());
    let bytes = PROJECT.write(&document, None).unwrap().bytes;
    assert!(
        String::from_utf8(bytes)
            .unwrap()
            .contains(r#""extra": [1.50]"#)
    );
}

#[test]
fn references_that_cannot_be_are_refused_with_their_place() {
    for (reference, expected) in [
        (
            r#"{"name":"a"}"#,
            "reference 1 “a”: a reference is one of four things: a kind with values, a formula, points or a B-spline",
        ),
        (
            r#"{"kind":"circle","points":[[0,0],[1,1]]}"#,
            "reference 1 “reference 1”: a reference is one of four things: a kind with values, a formula, points or a B-spline",
        ),
        (
            r#"{"kind":"circle","values":{"size":2}}"#,
            "reference 1 “reference 1”: circle has no value “size”",
        ),
        (
            r#"{"kind":"circle","values":{"radius":0}}"#,
            "reference 1 “reference 1”: Radius: 0 is out of range: 1e-30 to 1e30 is needed",
        ),
        (
            r#"{"kind":"circle","interval":[1,1]}"#,
            "reference 1 “reference 1”: the interval from t = 1 to t = 1 is empty: give two numbers, the smaller one first",
        ),
        (
            r#"{"kind":"circle","scale":0}"#,
            "reference 1 “reference 1”: a placement needs a rotation, a scale from 1e-30 to 1e30 and a translation of finite numbers",
        ),
        (
            r#"{"points":[[0,0]]}"#,
            "reference 1 “reference 1”: 1 point makes no line: at least 2 are needed",
        ),
    ] {
        let error = read(with_reference(reference).as_bytes()).unwrap_err();
        assert_eq!(error.to_string(), expected, "{reference}");
    }
    let error = read(with_reference(r#"{"kind":"square"}"#).as_bytes()).unwrap_err();
    let told = error.to_string();
    assert!(
        told.contains("“square” is not a kind of reference"),
        "{told}"
    );
    let error = read(with_reference(r#"{"kind":"circle","scale":"x"}"#).as_bytes()).unwrap_err();
    assert_eq!(
        (error.place.line, error.place.reference),
        (Some(2), Some(1))
    );
}

#[test]
fn matches_of_references_that_are_not_there_are_refused() {
    for (source, expected) in [
        (
            r#""reference":1"#,
            "a match names reference 1, and there are 1, counted from 0",
        ),
        (
            r#""source":0,"reference":0"#,
            "a match follows one thing: a curve, as source, or a reference",
        ),
        (
            r#""reversed":false"#,
            "a match follows one thing: a curve, as source, or a reference",
        ),
    ] {
        let text = format!(
            r#"{{"format":"batten","version":2,"references":[{{"kind":"circle"}}],
            "curves":[{{"name":"b","degree":1,"vertices":[[1,2],[3,3]]}}],
            "matches":[{{"curve":0,"end":"start",{source},"at":0,"continuity":"G0"}}]}}"#
        );
        assert_eq!(read(text.as_bytes()).unwrap_err().to_string(), expected);
    }
}

#[test]
fn other_formats_tell_that_references_are_not_exported() {
    let spiral = ReferenceCurve::from_text("clothoid:a=3").unwrap();
    let polygon = FloatPolygon::planar(1, &[(0.0, 0.0), (1.0, 1.0)]).unwrap();
    let document = Document::from_curves([Curve::new("line", polygon)])
        .with_references([Reference::new("round", spiral)]);
    for (format, name) in [(&TABLE, "CSV table"), (&DXF, "DXF")] {
        let export = format.write(&document, None).unwrap();
        let told = export.losses.to_string();
        let expected = format!("“round”: references aren't stored in the {name}");
        assert!(told.contains(&expected), "{told}");
    }
}

#[test]
fn the_numbers_of_curves_and_references_come_back() {
    let line = |name: &str| {
        let vertices = vec![DVec3::ZERO, DVec3::X];
        Curve::new(name, FloatPolygon::new(1, vertices, None, false).unwrap())
    };
    let numbers = |document: &Document| {
        let ids = document.all_ids();
        ids.map(CurveId::number).collect::<Vec<u64>>()
    };
    let mut document = Document::from_curves([line("a"), line("b"), line("c")]);
    let list = PointList::new(vec![DVec3::ZERO, DVec3::X]).unwrap();
    let list = ReferenceCurve::of(ReferenceForm::Points(list)).unwrap();
    document = document.with_references([Reference::new("d", list)]);
    let text = |document: &Document| {
        let export = PROJECT.write(document, None).unwrap();
        String::from_utf8(export.bytes).unwrap()
    };
    assert!(!text(&document).contains("numbers"), "they count from 0");
    let first = document.ids().next().unwrap();
    document.apply(Edit::Remove(first)).unwrap();
    let written = text(&document);
    assert!(written.contains("\"numbers\": [1, 2, 3]"), "{written}");
    let back = back(&document);
    assert_eq!(numbers(&back), [1, 2, 3]);
    assert_eq!(back.next_id().number(), 4);
    // What does not fit has no effect.
    for wrong in ["[1, 2]", "[1, 1, 2]", "[1, 2, 1e300]", "[]"] {
        let text = written.replace("[1, 2, 3]", wrong);
        let counted = read(text.as_bytes()).unwrap().into_document().unwrap();
        assert_eq!(numbers(&counted), [0, 1, 2], "{wrong}");
    }
    assert!(read(written.replace("[1, 2, 3]", "[1, 2, 0.5]").as_bytes()).is_err());
}
