//! The document and its history: gestures, undo and redo, locked curves, edits that fail.

use batten::document::Reference;
use batten::document::{
    Colour, Curve, CurveId, Document, Edit, EditError, EndMatch, Group, History, MatchPlace,
    Renumbering,
};
use batten::geometry::end_correction::EndTarget;
use batten::geometry::expressions::LengthUnit;
use batten::geometry::references::ReferenceCurve;
use batten::geometry::{Continuity, Differentiable, End, FloatPolygon};
use glam::DVec3;

fn cubic() -> FloatPolygon {
    let points = [(0.1, 0.2), (1.3, 0.7), (2.1, -0.3), (3.7, 0.9), (4.1, 1.1)];
    FloatPolygon::planar(3, &points).expect("a valid polygon")
}

/// The renumbering to another polygon whose vertices have the same numbers.
fn same_numbers(polygon: &FloatPolygon) -> Renumbering {
    Renumbering::of_vertices(&Curve::new("first", cubic()), polygon, Some)
}

fn history() -> (History, CurveId) {
    let curves = [Curve::new("first", cubic()), Curve::new("second", cubic())];
    let document = Document::from_curves(curves);
    let id = document.ids().next().expect("a curve");
    (History::new(document), id)
}

fn moved(curve: CurveId, x: f64) -> Vec<Edit> {
    let moves = vec![(2, DVec3::new(x, 0.5, 0.0))];
    vec![Edit::MoveVertices { curve, moves }]
}

/// Every bit of the document's numbers, so that −0 and 0 differ.
fn bits(document: &Document) -> Vec<(CurveId, String, Vec<[u64; 3]>)> {
    let curves = document.curves().map(|(id, curve)| {
        let vertices = curve.polygon.vertices().iter();
        let bits = vertices.map(|vertex| vertex.to_array().map(f64::to_bits));
        (id, curve.name.clone(), bits.collect())
    });
    curves.collect()
}

#[test]
fn a_drag_is_one_step_and_undo_restores_it_bit_for_bit() {
    let (mut history, id) = history();
    let before = bits(history.document());
    history.begin("Move vertex");
    for step in 0..100 {
        let previewed = history.preview(moved(id, 0.1 * f64::from(step)));
        assert_eq!(previewed, Ok(()));
        assert_eq!(bits(history.settled()), before);
    }
    assert!(history.commit());
    assert_eq!(history.undo_steps(), 1);
    let after = bits(history.document());
    assert_eq!(history.undo_label(), Some("Move vertex"));
    assert_eq!(history.redo_label(), None);

    assert_eq!(history.undo().as_deref(), Some("Move vertex"));
    assert_eq!(bits(history.document()), before);
    assert_eq!(history.undo(), None);
    assert_eq!(history.redo_label(), Some("Move vertex"));
    assert_eq!(history.redo().as_deref(), Some("Move vertex"));
    assert_eq!(bits(history.document()), after);
    assert_eq!(history.redo(), None);
}

#[test]
fn an_aborted_drag_leaves_the_document_as_it_was_and_keeps_what_can_be_redone() {
    let (mut history, id) = history();
    history.apply("Move vertex", moved(id, 7.0)).expect("valid");
    history.undo();
    let before = bits(history.document());
    history.begin("Move vertex");
    history.preview(moved(id, 9.0)).expect("valid");
    history.abort();
    assert_eq!(bits(history.document()), before);
    assert_eq!(history.undo_steps(), 0);
    assert_eq!(history.redo_label(), Some("Move vertex"));
    history.abort();
    assert_eq!(bits(history.document()), before);
}

#[test]
fn undo_in_the_middle_of_a_drag_aborts_it() {
    let (mut history, id) = history();
    history.apply("Move vertex", moved(id, 7.0)).expect("valid");
    let before = bits(history.document());
    history.begin("Rotate");
    history.preview(moved(id, 9.0)).expect("valid");
    assert_eq!(history.undo_label(), Some("Rotate"));
    assert_eq!(history.redo(), None);
    assert_eq!(history.undo().as_deref(), Some("Rotate"));
    assert_eq!(bits(history.document()), before);
    assert_eq!(history.undo_steps(), 1);
}

#[test]
fn gestures_that_change_nothing_leave_no_step() {
    let (mut history, id) = history();
    let before = bits(history.document());
    history.begin("Move vertex");
    assert!(!history.commit());
    assert!(!history.commit(), "there is no gesture any more");

    // A drag that comes back to where it began.
    let start = history
        .document()
        .curve(id)
        .expect("there")
        .polygon
        .vertex(2);
    history.begin("Move vertex");
    history.preview(moved(id, 5.0)).expect("valid");
    let back = Edit::MoveVertices {
        curve: id,
        moves: vec![(2, DVec3::new(start.x, start.y, -0.0))],
    };
    history.preview(vec![back]).expect("valid");
    assert!(!history.commit());
    assert_eq!(history.undo_steps(), 0);
    assert_eq!(bits(history.document()), before);
    assert!(!history.is_modified());

    for edit in [
        Edit::Rename {
            curve: id,
            name: " first ".into(),
        },
        Edit::Recolour {
            curve: id,
            colour: None,
        },
        Edit::SetVisible {
            curve: id,
            visible: true,
        },
        Edit::SetLocked {
            curve: id,
            locked: false,
        },
        Edit::SetTarget {
            curve: id,
            end: End::Start,
            target: None,
        },
        Edit::Reorder {
            curve: id,
            place: 0,
        },
        Edit::SetPolygon {
            curve: id,
            polygon: cubic(),
        },
        Edit::Renumber {
            curve: id,
            polygon: cubic(),
            renumbering: same_numbers(&cubic()),
        },
        Edit::SetVerticesLocked {
            curve: id,
            vertices: vec![0, 4],
            locked: false,
        },
    ] {
        history.apply("Nothing", vec![edit.clone()]).expect("valid");
        assert_eq!(history.undo_steps(), 0, "{edit:?} left a step");
    }
}

#[test]
fn every_edit_is_undone_and_redone() {
    let (mut history, id) = history();
    let target = EndTarget {
        point: DVec3::ONE,
        direction: None,
        ..EndTarget::default()
    };
    let added = Box::new(Curve::new("third", cubic()));
    let edits = [
        Edit::MoveVertices {
            curve: id,
            moves: vec![(0, DVec3::ONE)],
        },
        Edit::SetPolygon {
            curve: id,
            polygon: cubic().reversed(),
        },
        Edit::SetWeight {
            curve: id,
            vertex: 1,
            weight: 2.0,
        },
        Edit::SetVerticesLocked {
            curve: id,
            vertices: vec![3],
            locked: true,
        },
        Edit::Renumber {
            curve: id,
            polygon: cubic(),
            renumbering: same_numbers(&cubic()),
        },
        Edit::Rename {
            curve: id,
            name: "stem".into(),
        },
        Edit::Recolour {
            curve: id,
            colour: Some(Colour([1, 2, 3])),
        },
        Edit::SetTarget {
            curve: id,
            end: End::Finish,
            target: Some(target),
        },
        Edit::SetVisible {
            curve: id,
            visible: false,
        },
        Edit::SetLocked {
            curve: id,
            locked: true,
        },
        Edit::Add(added),
        Edit::Reorder {
            curve: id,
            place: 99,
        },
        Edit::Remove(id),
    ];
    let mut states = vec![history.document().clone()];
    for edit in edits.clone() {
        history
            .apply(format!("{edit:?}"), vec![edit])
            .expect("valid");
        states.push(history.document().clone());
    }
    assert_eq!(history.undo_steps(), edits.len());
    assert!(history.is_modified());
    for (state, edit) in states.iter().zip(&edits).rev() {
        assert_eq!(history.undo(), Some(format!("{edit:?}")));
        assert!(history.document().is_same(state));
    }
    assert!(!history.is_modified());
    for (state, edit) in states[1..].iter().zip(&edits) {
        assert_eq!(history.redo(), Some(format!("{edit:?}")));
        assert!(history.document().is_same(state));
    }
}

#[test]
fn a_new_step_forgets_what_could_be_redone() {
    let (mut history, id) = history();
    history.apply("One", moved(id, 1.0)).expect("valid");
    history.undo();
    history.apply("Two", moved(id, 2.0)).expect("valid");
    assert_eq!(history.redo_label(), None);
    assert_eq!(history.undo_label(), Some("Two"));
}

#[test]
fn a_gesture_begun_in_another_commits_the_other() {
    let (mut history, id) = history();
    history.begin("One");
    history.preview(moved(id, 1.0)).expect("valid");
    history.begin("Two");
    history.preview(moved(id, 2.0)).expect("valid");
    assert!(history.commit());
    assert_eq!(history.undo().as_deref(), Some("Two"));
    assert_eq!(history.undo().as_deref(), Some("One"));
}

#[test]
fn saving_is_remembered_across_undo() {
    let (mut history, id) = history();
    history.apply("One", moved(id, 1.0)).expect("valid");
    history.mark_saved(history.settled().clone());
    assert!(!history.is_modified());
    history.undo();
    assert!(history.is_modified());
    history.redo();
    assert!(!history.is_modified());
}

#[track_caller]
fn check_refused(history: &mut History, edits: Vec<Edit>, expected: &str) {
    let before = bits(history.document());
    let steps = history.undo_steps();
    let refused = history.apply("Refused", edits);
    let message = refused.expect_err("an edit that must fail").to_string();
    assert_eq!(message, expected);
    assert_eq!(bits(history.document()), before);
    assert_eq!(history.undo_steps(), steps);
    assert!(!history.commit(), "no gesture goes on");
}

#[test]
fn failed_edits_change_nothing() {
    let (mut history, id) = history();
    let good = moved(id, 3.0);
    let far = Edit::MoveVertices {
        curve: id,
        moves: vec![(9, DVec3::ZERO)],
    };
    let infinite = Edit::MoveVertices {
        curve: id,
        moves: vec![(0, DVec3::ONE), (1, DVec3::splat(f64::INFINITY))],
    };
    let weight = Edit::SetWeight {
        curve: id,
        vertex: 0,
        weight: -1.0,
    };
    let nameless = Edit::Rename {
        curve: id,
        name: "  ".into(),
    };
    for (bad, expected) in [
        (
            far,
            "“first”: vertex 9 does not exist: the polygon has 5 vertices, counted from 0",
        ),
        (
            infinite,
            "“first”: vertex 1: coordinate x is inf, and only finite numbers up to 1e100 can be \
             used",
        ),
        (
            weight,
            "“first”: vertex 0: weight -1.0 cannot be used: weights are positive numbers from \
             1e-100 to 1e100",
        ),
        (
            nameless,
            "a curve needs a name: type at least one character",
        ),
    ] {
        let mut edits = good.clone();
        edits.push(bad);
        check_refused(&mut history, edits, expected);
    }
    let gone = Edit::Remove(id);
    history.apply("Remove", vec![gone.clone()]).expect("valid");
    check_refused(
        &mut history,
        vec![gone],
        "the curve is no longer in the document",
    );
    check_refused(&mut history, good, "the curve is no longer in the document");
}

#[test]
fn targets_without_usable_numbers_are_refused() {
    let (mut history, curve) = history();
    let expected = "a target needs numbers up to 1e100, and a direction that is not 0";
    for bad in [f64::NAN, f64::INFINITY, 2e100] {
        for axis in 0..3 {
            let mut vector = DVec3::ONE;
            vector[axis] = bad;
            for (point, direction) in [
                (vector, None),
                (vector, Some(DVec3::ONE)),
                (DVec3::ONE, Some(vector)),
            ] {
                check_target_refused(
                    &mut history,
                    curve,
                    EndTarget {
                        point,
                        direction,
                        ..EndTarget::default()
                    },
                    expected,
                );
            }
        }
    }
    let nowhere = EndTarget {
        point: DVec3::ONE,
        direction: Some(DVec3::ZERO),
        ..EndTarget::default()
    };
    check_target_refused(&mut history, curve, nowhere, expected);
}

#[track_caller]
fn check_target_refused(history: &mut History, curve: CurveId, target: EndTarget, expected: &str) {
    let mut added = Curve::new("third", cubic());
    added.targets.finish = Some(target);
    for edit in [
        Edit::SetTarget {
            curve,
            end: End::Start,
            target: Some(target),
        },
        Edit::Add(Box::new(added)),
    ] {
        check_refused(history, vec![edit], expected);
    }
}

#[test]
fn a_failed_preview_keeps_the_last_good_one() {
    let (mut history, id) = history();
    history.begin("Move vertex");
    history.preview(moved(id, 3.0)).expect("valid");
    let shown = bits(history.document());
    assert!(history.preview(moved(id, f64::NAN)).is_err());
    assert_eq!(bits(history.document()), shown);
    assert!(history.commit());
}

#[test]
fn locked_curves_keep_their_shape() {
    let (mut history, id) = history();
    let lock = |locked| vec![Edit::SetLocked { curve: id, locked }];
    history.apply("Lock", lock(true)).expect("valid");
    let expected = "“first” is locked: unlock it in the list of curves to change its shape";
    check_refused(&mut history, moved(id, 3.0), expected);
    let polygon = cubic().reversed();
    check_refused(
        &mut history,
        vec![Edit::SetPolygon { curve: id, polygon }],
        expected,
    );
    let weight = Edit::SetWeight {
        curve: id,
        vertex: 0,
        weight: 2.0,
    };
    check_refused(&mut history, vec![weight], expected);
    let rename = Edit::Rename {
        curve: id,
        name: "stem".into(),
    };
    assert_eq!(history.apply("Rename", vec![rename]), Ok(()));
    history.apply("Unlock", lock(false)).expect("valid");
    assert_eq!(history.apply("Move", moved(id, 3.0)), Ok(()));
    let refused = history
        .document()
        .clone()
        .apply(Edit::Remove(CurveId::clone(&id)));
    assert_eq!(refused, Ok(()));
    let gone = EditError::NoSuchCurve.to_string();
    assert_eq!(gone, "the curve is no longer in the document");
}

#[test]
fn identities_are_never_given_twice() {
    let (mut history, id) = history();
    let next = history.document().next_id();
    let add = || vec![Edit::Add(Box::new(Curve::new("new", cubic())))];
    history.apply("Add", add()).expect("valid");
    assert!(history.document().curve(next).is_some());
    history
        .apply("Remove", vec![Edit::Remove(next)])
        .expect("valid");
    history.apply("Add", add()).expect("valid");
    assert!(history.document().curve(next).is_none());
    assert!(history.document().curve(id).is_some());
}

#[test]
fn no_edit_moves_a_locked_vertex() {
    let (mut history, id) = history();
    let lock = Edit::SetVerticesLocked {
        curve: id,
        vertices: vec![2, 0],
        locked: true,
    };
    history.apply("Lock vertices", vec![lock]).expect("valid");
    let before = bits(history.document());
    let locked = history.document().clone();

    let mut shifted = cubic();
    let moves = [(2, DVec3::new(2.1, -0.3, 1e-300))];
    shifted.move_vertices(moves).expect("a valid place");
    let mut heavier = cubic();
    heavier.set_weight(0, 2.0).expect("a valid weight");
    let set = |polygon| Edit::SetPolygon { curve: id, polygon };
    let renumber = |polygon, vertices: [usize; 1]| Edit::Renumber {
        curve: id,
        renumbering: same_numbers(&polygon).with_locked_vertices(vertices.into_iter().collect()),
        polygon,
    };
    let weigh = Edit::SetWeight {
        curve: id,
        vertex: 2,
        weight: 2.0,
    };
    for (edit, vertex) in [
        (moved(id, 3.0).remove(0), 2),
        (set(cubic().reversed()), 0),
        (set(shifted.clone()), 2),
        (set(heavier), 0),
        (weigh, 2),
        (renumber(cubic(), [1]), 1),
        (renumber(shifted, [2]), 2),
        (renumber(cubic(), [9]), 9),
    ] {
        let refused = history.apply("Move", vec![edit.clone()]);
        let name = "first".to_owned();
        let expected = Err(EditError::LockedVertex { name, vertex });
        assert_eq!(refused, expected, "{edit:?}");
        assert_eq!(bits(history.document()), before);
    }

    // What leaves them where they are can be done, and a lock can go with its point.
    let moves = vec![(1, DVec3::ONE), (2, cubic().vertex(2))];
    let around = Edit::MoveVertices { curve: id, moves };
    let reversed = renumber(cubic().reversed(), [4]);
    for edits in [vec![around], vec![reversed]] {
        history.apply("Move", edits).expect("valid");
        history.undo();
        assert_eq!(bits(history.document()), before);
        assert!(history.document().is_same(&locked));
    }
    history.undo();
    assert!(!history.document().is_same(&locked));
    history.apply("Move", moved(id, 3.0)).expect("not locked");
}

#[test]
fn a_polygon_with_other_numbers_of_vertices_needs_a_renumbering() {
    let (mut history, id) = history();
    let vertices = cubic().vertices().to_vec();
    let refused = [
        FloatPolygon::new(3, vertices[1..].to_vec(), None, false),
        FloatPolygon::new(2, vertices.clone(), None, false),
        FloatPolygon::new(3, vertices, None, true),
    ];
    for polygon in refused.map(|polygon| polygon.expect("a valid polygon")) {
        let set = Edit::SetPolygon { curve: id, polygon };
        let name = "first".to_owned();
        let refused = history.apply("Set", vec![set]);
        assert_eq!(refused, Err(EditError::OtherNumbers { name }));
    }
    assert_eq!(history.undo_steps(), 0);
}

#[test]
fn only_vertices_that_there_are_can_be_locked() {
    let (mut history, id) = history();
    let lock = |vertices| Edit::SetVerticesLocked {
        curve: id,
        vertices,
        locked: true,
    };
    let error = history.apply("Lock", vec![lock(vec![4, 5])]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "“first”: vertex 5 does not exist: the polygon has 5 vertices, counted from 0"
    );
    let mut curve = Curve::new("third", cubic());
    curve.locked_vertices.set(5, true);
    let error = history.apply("Add", vec![Edit::Add(Box::new(curve))]);
    assert!(matches!(error, Err(EditError::Polygon { .. })), "{error:?}");
    assert_eq!(history.undo_steps(), 0);

    let hide = Edit::SetVisible {
        curve: id,
        visible: false,
    };
    history.apply("Hide", vec![hide]).expect("valid");
    let refused = history.apply("Lock", vec![lock(vec![0])]);
    assert!(matches!(refused, Err(EditError::Hidden { .. })));
}

/// The second curve's start matched to an end of the first.
fn matched(history: &History) -> EndMatch {
    let ids: Vec<CurveId> = history.document().ids().collect();
    EndMatch {
        curve: ids[1],
        end: End::Start,
        source: ids[0],
        place: MatchPlace::End(End::Finish),
        continuity: Continuity::G1,
        reversed: false,
    }
}

#[test]
fn a_matched_end_follows_within_the_step_and_is_undone_with_it() {
    let (mut history, id) = history();
    let matched = matched(&history);
    let start = bits(history.document());
    history
        .apply("Match", vec![Edit::SetMatch(matched)])
        .expect("valid");
    let ends = |history: &History| {
        let document = history.document();
        let [first, second] = [matched.source, matched.curve]
            .map(|id| document.curve(id).expect("a curve").polygon.clone());
        (
            first.end_jet(End::Finish).point,
            second.end_jet(End::Start).point,
        )
    };
    let (from, to) = ends(&history);
    assert!(from.distance(to) < 1e-14);
    let before = bits(history.document());

    history.begin("Move vertex");
    for step in 0..10 {
        history
            .preview(moved(id, 0.3 * f64::from(step)))
            .expect("valid");
        let (from, to) = ends(&history);
        assert!(from.distance(to) < 1e-13, "{step}");
    }
    assert!(history.commit());
    let after = bits(history.document());
    assert_ne!(after, before);
    history.undo();
    assert_eq!(bits(history.document()), before);
    history.redo();
    assert_eq!(bits(history.document()), after);
    history.undo();
    history.undo();
    assert_eq!(bits(history.document()), start);
    assert_eq!(history.document().matches().len(), 0);
}

#[test]
fn what_does_not_concern_a_match_changes_no_bit_of_its_curves() {
    let (mut history, _) = history();
    let matched = matched(&history);
    history
        .apply("Match", vec![Edit::SetMatch(matched)])
        .expect("valid");
    let before = bits(history.document());
    let other = Curve::new("third", cubic());
    history
        .apply("Add", vec![Edit::Add(Box::new(other))])
        .expect("valid");
    assert_eq!(bits(history.document())[..2], before[..]);
    let again = history.apply("Match", vec![Edit::SetMatch(matched)]);
    assert_eq!(
        (again, history.undo_steps()),
        (Ok(()), 2),
        "it is matched already"
    );
}

#[test]
fn removing_a_curve_removes_its_matches_and_undo_brings_them_back() {
    let (mut history, id) = history();
    let matched = matched(&history);
    history
        .apply("Match", vec![Edit::SetMatch(matched)])
        .expect("valid");
    let before = history.document().clone();
    for removed in [id, matched.curve] {
        history
            .apply("Remove", vec![Edit::Remove(removed)])
            .expect("valid");
        assert_eq!(history.document().matches().len(), 0);
        let dissolved = history.document().dissolved_since(&before).count();
        assert_eq!(dissolved, usize::from(removed == id));
        history.undo();
        assert!(history.document().is_same(&before));
    }
}

#[test]
fn a_unit_relabels_and_converting_it_keeps_every_size() {
    let mut first = Curve::new("first", cubic());
    first.locked = true;
    first.targets.start = Some(EndTarget {
        point: DVec3::new(1.0, 2.0, 0.0),
        direction: Some(DVec3::X),
        curvature: Some(0.5),
        slope: Some(-2.0),
        ..EndTarget::default()
    });
    let mut second = Curve::new("second", cubic());
    second.visible = false;
    let circle = ReferenceCurve::from_text("circle:radius=3").expect("a reference");
    let document =
        Document::from_curves([first, second]).with_references([Reference::new("round", circle)]);
    let ids: Vec<CurveId> = document.all_ids().collect();
    let convert = |unit| vec![Edit::ConvertUnit(unit)];
    let mut history = History::new(document.clone());
    let refused = history.apply("Convert", convert(LengthUnit::Metre));
    assert_eq!(refused, Err(EditError::NoUnit));

    let inches = vec![Edit::SetUnit(Some(LengthUnit::Inch))];
    history.apply("Set unit", inches).expect("an edit");
    assert_eq!(bits(history.document()), bits(&document), "numbers stay");
    assert!(history.is_modified());
    history
        .apply("Convert", convert(LengthUnit::Millimetre))
        .expect("an edit");
    assert_eq!(history.undo_steps(), 2);
    let converted = history.document().clone();
    assert_eq!(converted.unit(), Some(LengthUnit::Millimetre));
    for id in &ids[..2] {
        let [before, after] = [&document, &converted].map(|it| it.curve(*id).expect("a curve"));
        let vertices = before.polygon.vertices().iter().map(|at| *at * 25.4);
        assert_eq!(after.polygon.vertices(), vertices.collect::<Vec<_>>());
        assert_eq!(
            (after.locked, after.visible),
            (before.locked, before.visible)
        );
    }
    let target = converted
        .curve(ids[0])
        .and_then(|curve| curve.targets.start);
    let target = target.expect("a target");
    assert_eq!(target.point, DVec3::new(25.4, 50.8, 0.0));
    assert_eq!(target.direction, Some(DVec3::X));
    assert_eq!(target.curvature, Some(0.5 / 25.4));
    assert_eq!(target.slope, Some(-2.0 / 25.4_f64.powi(2)));
    let round = &converted.reference(ids[2]).expect("a reference").curve;
    let at = round.derivatives(0.0, 0)[0];
    assert!((at - DVec3::X * 76.2).length() < 1e-13);

    history.undo();
    history.undo();
    assert!(history.document().is_same(&document) && !history.is_modified());
    history.redo();
    history.redo();
    assert!(history.document().is_same(&converted));
}

/// A document of three curves and a reference, with the groups of some, and their identities.
fn grouped() -> (Document, Vec<CurveId>) {
    let curve = |name: &str, group: &str| Curve::new(name, cubic()).in_group(group.into());
    let circle = ReferenceCurve::from_text("circle").expect("a reference");
    let curves = [curve("a", "Deck/Port"), curve("b", ""), curve("c", "Deck")];
    let circle = Reference::new("circle", circle).in_group("Deck/Port".into());
    let document = Document::from_curves(curves).with_references([circle]);
    let ids = document.all_ids().collect();
    (document, ids)
}

fn groups(document: &Document) -> Vec<String> {
    let groups = document.all_ids().filter_map(|id| document.group(id));
    groups.map(Group::to_string).collect()
}

#[test]
fn items_move_to_groups_and_undo_takes_them_back() {
    let (document, ids) = grouped();
    let mut history = History::new(document);
    let group = Group::from("Hull");
    let edits = [ids[0], ids[1], ids[3]].map(|curve| Edit::SetGroup {
        curve,
        group: group.clone(),
    });
    history.apply("Group", edits.into()).expect("edits");
    assert_eq!(groups(history.document()), ["Hull", "Hull", "Deck", "Hull"]);
    let members: Vec<CurveId> = history.document().members(&group).collect();
    assert_eq!(members, [ids[0], ids[1], ids[3]]);
    let leave = Edit::SetGroup {
        curve: ids[0],
        group: Group::default(),
    };
    history.apply("Leave", vec![leave]).expect("an edit");
    assert_eq!(groups(history.document()), ["", "Hull", "Deck", "Hull"]);
    history.undo();
    history.undo();
    let before = ["Deck/Port", "", "Deck", "Deck/Port"];
    assert_eq!(groups(history.document()), before);
    assert!(!history.is_modified());
}

#[test]
fn a_group_is_renamed_with_the_groups_in_it() {
    let (document, ids) = grouped();
    let mut history = History::new(document);
    let locked = Edit::SetLocked {
        curve: ids[0],
        locked: true,
    };
    history.apply("Lock", vec![locked]).expect("an edit");
    let rename = |group: &str, to: &str| {
        let (group, to) = (group.into(), to.into());
        vec![Edit::RenameGroup { group, to }]
    };
    let renamed = rename("Deck", "Ship/1\\/2");
    history.apply("Rename", renamed).expect("an edit");
    let expected = ["Ship/1\\/2/Port", "", "Ship/1\\/2", "Ship/1\\/2/Port"];
    assert_eq!(groups(history.document()), expected);
    let refused = history.apply("Rename", rename("Deck", "Hull"));
    let group = "Deck".to_owned();
    assert_eq!(refused, Err(EditError::NoSuchGroup { group }));
    let dissolved = rename("Ship", "");
    history.apply("Dissolve", dissolved).expect("an edit");
    let expected = ["1\\/2/Port", "", "1\\/2", "1\\/2/Port"];
    assert_eq!(groups(history.document()), expected);
    history.undo();
    history.undo();
    let before = ["Deck/Port", "", "Deck", "Deck/Port"];
    assert_eq!(groups(history.document()), before);
}

#[test]
fn merged_and_converted_documents_keep_groups() {
    let (document, _) = grouped();
    let incoming = document.with_unit(Some(LengthUnit::Inch));
    let own = Document::from_curves([Curve::new("own", cubic()).in_group("Own".into())]);
    let own = own.with_unit(Some(LengthUnit::Millimetre));
    let merge = own.merging(&incoming, None).expect("a merge");
    let merged = own.edited(merge.edits).expect("edits");
    let expected = ["Own", "Deck/Port", "", "Deck", "Deck/Port"];
    assert_eq!(groups(&merged), expected);
}
