//! References as items of a document: their edits, undo, and ends that follow them.

use batten::document::{
    Colour, Curve, CurveId, Document, Edit, EditError, EndMatch, History, MatchPlace, Reference,
};
use batten::geometry::expressions::LengthUnit;
use batten::geometry::references::{Placement, PointList, ReferenceCurve, ReferenceForm};
use batten::geometry::{Continuity, End, FloatPolygon, ParametricCurve};
use glam::{DQuat, DVec3};

/// What is left of a match that is met, in units of the end's size.
const MET: f64 = 1e-9;

fn reference(text: &str) -> Reference {
    Reference::new(text, ReferenceCurve::from_text(text).expect("a reference"))
}

fn polygon() -> FloatPolygon {
    let points = (0..12).map(|i| {
        let x = f64::from(i);
        (x, 0.1 * x * x)
    });
    FloatPolygon::planar(4, &points.collect::<Vec<_>>()).expect("a valid polygon")
}

/// A document with a curve and two references, and their identities.
fn document() -> (Document, [CurveId; 3]) {
    let references = [reference("circle:radius=4"), reference("conical-spiral")];
    let document =
        Document::from_curves([Curve::new("arc", polygon())]).with_references(references);
    let ids: Vec<CurveId> = document.all_ids().collect();
    (document, ids.try_into().expect("three"))
}

fn placed(document: &Document, id: CurveId, placement: Placement) -> Edit {
    let reference = document.reference(id).expect("a reference");
    Edit::SetReference {
        reference: id,
        curve: reference.curve.clone().placed(placement),
    }
}

#[test]
fn curves_and_references_are_counted_together() {
    let (document, [arc, circle, spiral]) = document();
    assert_eq!(document.ids().collect::<Vec<_>>(), [arc]);
    let references: Vec<CurveId> = document.references().map(|(id, _)| id).collect();
    assert_eq!(references, [circle, spiral]);
    assert!(document.curve(circle).is_none() && document.reference(arc).is_none());
    assert_eq!(document.name(circle), Some("circle:radius=4"));
    let edits = [
        Edit::AddReference(Box::new(reference("circle"))),
        Edit::Add(Box::new(Curve::new("second", polygon()))),
    ];
    let [first, second] = {
        let mut next = document.next_ids();
        [next.next().expect("an id"), next.next().expect("an id")]
    };
    let edited = document.edited(edits).expect("valid");
    assert_eq!(edited.name(first), Some("circle"));
    assert_eq!(edited.name(second), Some("second"));
    assert_eq!(edited.free_name("circle"), "circle 2");
    assert!(!edited.is_same(&document));
}

#[test]
fn every_edit_of_a_reference_is_undone_and_redone() {
    let (document, [_, id, _]) = document();
    let placement = Placement::new(DQuat::from_rotation_z(0.3), 2.0, DVec3::Y).expect("valid");
    let colour = Some(Colour([1, 2, 3]));
    let edits = [
        Edit::AddReference(Box::new(reference("clothoid"))),
        placed(&document, id, placement),
        Edit::Rename {
            curve: id,
            name: " round ".to_owned(),
        },
        Edit::Recolour { curve: id, colour },
        Edit::SetVisible {
            curve: id,
            visible: false,
        },
        Edit::SetLocked {
            curve: id,
            locked: true,
        },
        Edit::Reorder {
            curve: id,
            place: 7,
        },
        Edit::Remove(id),
    ];
    for edit in edits {
        let mut history = History::new(document.clone());
        history.apply("Step", vec![edit.clone()]).expect("valid");
        let after = history.document().clone();
        assert!(!after.is_same(&document), "{edit:?}");
        history.undo();
        assert!(history.document().is_same(&document), "{edit:?}");
        history.redo();
        assert!(history.document().is_same(&after), "{edit:?}");
    }
}

#[test]
fn a_drag_starts_from_what_was_there_and_aborts_to_the_bit() {
    let (document, [_, id, _]) = document();
    let mut history = History::new(document.clone());
    history.begin("Move reference");
    for step in 1..50 {
        let by = DVec3::new(0.1 * f64::from(step), 0.0, 0.0);
        let placement = Placement::new(DQuat::IDENTITY, 1.0, by).expect("valid");
        let edit = placed(history.settled(), id, placement);
        history.preview(vec![edit]).expect("valid");
    }
    history.abort();
    let pair = [history.document(), &document].map(|it| it.reference(id).expect("there").clone());
    assert!(std::sync::Arc::ptr_eq(&pair[0], &pair[1]));
}

#[test]
fn hidden_and_locked_references_keep_their_shape() {
    let (document, [_, id, _]) = document();
    let edit = placed(&document, id, Placement::default());
    let name = "circle:radius=4".to_owned();
    let locked = Edit::SetLocked {
        curve: id,
        locked: true,
    };
    let hidden = Edit::SetVisible {
        curve: id,
        visible: false,
    };
    let expected = EditError::Locked { name: name.clone() };
    let refused = document.edited([locked, edit.clone()]);
    assert_eq!(refused.err(), Some(expected));
    let refused = document.edited([hidden, edit]);
    assert_eq!(refused.err(), Some(EditError::Hidden { name }));
}

#[test]
fn edits_of_curves_refuse_references() {
    let (document, [arc, circle, _]) = document();
    let edits = [
        Edit::SetPolygon {
            curve: circle,
            polygon: polygon(),
        },
        Edit::MoveVertices {
            curve: circle,
            moves: Vec::new(),
        },
        Edit::SetReference {
            reference: arc,
            curve: reference("circle").curve,
        },
    ];
    for edit in edits {
        let refused = document.edited([edit.clone()]).err();
        assert_eq!(refused, Some(EditError::NoSuchCurve), "{edit:?}");
    }
}

#[test]
fn an_end_follows_a_reference_at_every_level() {
    let (document, [curve, source, _]) = document();
    for continuity in Continuity::ALL {
        for place in [
            MatchPlace::Parameter(1.3),
            MatchPlace::End(End::Start),
            MatchPlace::End(End::Finish),
        ] {
            let matched = EndMatch {
                curve,
                end: End::Start,
                source,
                place,
                continuity,
                reversed: false,
            };
            let document = document.edited([Edit::SetMatch(matched)]).expect("valid");
            assert!(document.meets(&matched), "{matched:?}");
            // The curve goes along when the reference is placed elsewhere or gets another shape.
            let placement =
                Placement::new(DQuat::from_rotation_z(0.4), 1.5, DVec3::new(1.0, 2.0, 0.0));
            let edit = placed(&document, source, placement.expect("valid"));
            let moved = document.edited([edit]).expect("valid");
            assert!(moved.meets(&matched), "{matched:?}");
            let jet = moved
                .curve(curve)
                .expect("a curve")
                .polygon
                .end_jet(End::Start);
            let shape = moved.shape(source).expect("a reference");
            let expected = place.jet(shape).expect("a place");
            let size = polygon().size();
            assert!(jet.point.distance(expected.point) <= MET * size);
            if continuity >= Continuity::G2 {
                let (found, wanted) = (jet.signed_curvature(), expected.signed_curvature());
                assert!((found - wanted).abs() * size <= 1e-6, "{found} {wanted}");
            }
            let larger = Edit::SetReference {
                reference: source,
                curve: reference("circle:radius=5").curve,
            };
            let larger = moved.edited([larger]).expect("valid");
            assert!(larger.meets(&matched), "{matched:?}");
            // Without the reference the match is gone, and the curve stays.
            let removed = larger.edited([Edit::Remove(source)]).expect("valid");
            assert_eq!(removed.matches().len(), 0);
        }
    }
}

#[test]
fn an_end_in_space_follows_a_spiral() {
    let vertices = (0..12).map(|i| {
        let x = f64::from(i);
        DVec3::new(x, 0.1 * x * x, (0.5 * x).sin())
    });
    let polygon = FloatPolygon::new(5, vertices.collect(), None, false).expect("valid");
    let document = Document::from_curves([Curve::new("arc", polygon)])
        .with_references([reference("conical-spiral")]);
    let ids: Vec<CurveId> = document.all_ids().collect();
    let [curve, source] = ids[..] else {
        panic!("{ids:?}");
    };
    let pieces = document.shape(source).map_or(0, ParametricCurve::pieces);
    for continuity in Continuity::ALL {
        let matched = EndMatch {
            curve,
            end: End::Finish,
            source,
            place: MatchPlace::Parameter(0.5 * pieces as f64),
            continuity,
            reversed: true,
        };
        let document = document.edited([Edit::SetMatch(matched)]).expect("valid");
        assert!(document.meets(&matched), "{matched:?}");
    }
}

#[test]
fn a_curve_that_is_placed_far_away_is_no_point() {
    let circle = reference("circle").curve;
    for far in [1e3, 1e16, 1e90] {
        let placement = Placement::new(DQuat::IDENTITY, 1.0, far * DVec3::X);
        let placement = placement.expect("a placement");
        let made = ReferenceCurve::new(circle.form().clone(), circle.interval(), placement);
        assert!(made.is_ok(), "{far:e}");
    }
}

/// The document that comes of a file of a format.
fn through(document: &Document, extension: &str) -> Document {
    let format = batten::io::formats::find(extension).expect("a format");
    let export = format.write(document, None).expect("written");
    let reading = format.read(&export.bytes).expect("read");
    reading.into_document().expect("a document")
}

#[test]
fn single_points_stay_single_points() {
    let points = [
        DVec3::new(0.1, 0.0, 0.0),
        DVec3::new(5.0, 2.0, -1.0),
        DVec3::new(1.0, 7.0, 1.0 / 3.0),
    ];
    let list = |points: &[DVec3]| PointList::new(points.to_vec()).expect("points");
    let of = |list| ReferenceCurve::of(ReferenceForm::Points(list)).expect("a reference");
    let references = [
        Reference::new("scan", of(list(&points).apart())),
        Reference::new("row", of(list(&points))),
    ];
    let document = Document::default()
        .with_references(references)
        .with_unit(Some(LengthUnit::Millimetre));
    for extension in ["batten", "dxf", "step", "igs", "3dm", "obj", "brep"] {
        let found = through(&document, extension);
        let apart = |is_apart: bool| {
            let mut references = found.references();
            let wanted = |reference: &Reference| match reference.curve.form() {
                ReferenceForm::Points(list) => list.is_apart() == is_apart,
                _ => false,
            };
            let found = references.find(|(_, reference)| wanted(reference));
            found.map(|(_, reference)| reference.points().expect("points"))
        };
        let names: Vec<&str> = found.names().collect();
        assert_eq!(
            apart(true).as_deref(),
            Some(&points[..]),
            "{extension}: {names:?}"
        );
        assert_eq!(
            apart(false).as_deref(),
            Some(&points[..]),
            "{extension}: {names:?}"
        );
    }
}

#[test]
fn arcs_in_any_plane_come_through_dxf() {
    let turns = [
        DQuat::IDENTITY,
        DQuat::from_rotation_x(0.7),
        DQuat::from_rotation_x(std::f64::consts::PI),
        DQuat::from_rotation_y(1.2) * DQuat::from_rotation_z(0.4),
    ];
    let kinds = [
        ("circle:radius=4", [4.0, 4.0]),
        ("ellipse:a=2,b=3", [2.0, 3.0]),
        ("circle:radius=4,from=0.3,to=2", [4.0, 4.0]),
    ];
    for ((text, [a, b]), turn) in kinds
        .into_iter()
        .flat_map(|kind| turns.map(|turn| (kind, turn)))
    {
        let place = DVec3::new(1.0, -2.0, 5.0);
        let placement = Placement::new(turn, 1.5, place).expect("a placement");
        let own = reference(text).curve.placed(placement);
        let document = Document::default()
            .with_references([Reference::new("arc", own.clone())])
            .with_unit(Some(LengthUnit::Millimetre));
        let found = through(&document, "dxf");
        let (_, found) = found.references().next().expect("an arc");
        let at = |curve: &ReferenceCurve, share: f64| {
            let last = curve.pieces() as f64;
            curve.jet(share * last).point
        };
        for step in 0..=20 {
            let point = at(&found.curve, f64::from(step) / 20.0);
            let local = turn.inverse() * (point - place) / 1.5;
            let off = (local.x / a).hypot(local.y / b) - 1.0;
            assert!(
                off.abs() <= 1e-13 && local.z.abs() <= 1e-13,
                "{text}, {turn}: {local}"
            );
        }
        let is_whole = !text.contains("from=");
        let ends = [0.0, 0.5, 1.0].map(|share| at(&own, share));
        let found = [0.0, 0.5, 1.0].map(|share| at(&found.curve, share));
        let is_same = |shares: [usize; 3]| {
            let mut pairs = ends.iter().zip(shares.map(|share| found[share]));
            pairs.all(|(own, found)| own.distance(found) <= 1e-12)
        };
        assert!(
            is_whole || is_same([0, 1, 2]) || is_same([2, 1, 0]),
            "{text}, {turn}: {found:?}"
        );
    }
}
