//! Joints: where ends of curves meet, their figures, marks and matches, live.

use batten::analysis::CurveJoint;
use batten::document::{Curve, CurveId, Document, Edit, Reference};
use batten::editor::{Command, Editor, Key, Layer, Look, Mark, PlotKind, told};
use batten::geometry::references::{Nurbs, PointList, ReferenceCurve, ReferenceForm};
use batten::geometry::{Continuity, End, FloatPolygon};
use glam::{DVec2, DVec3};

use super::script::Script;

/// Three parts of a curve, cut at knots, the middle one turned round; in space they lie on a slope.
fn parts(in_space: bool) -> Script {
    let at = |it: i32| {
        let x = f64::from(it);
        DVec3::new(x, (0.7 * x).sin(), if in_space { 0.3 * x } else { 0.0 })
    };
    let whole = FloatPolygon::new(5, (0..20).map(at).collect(), None, false);
    let whole = whole.expect("a polygon");
    let cut = |from: f64, to: f64| whole.trimmed(from, to, 0).expect("a part").polygon;
    let parts = [cut(0.0, 5.0), cut(5.0, 9.0).reversed(), cut(9.0, 15.0)];
    let names = ["first", "second", "third"];
    let curves = names
        .into_iter()
        .zip(parts)
        .map(|(name, part)| Curve::new(name, part));
    script(Document::from_curves(curves))
}

fn script(document: Document) -> Script {
    let mut editor = Editor::with_document(document);
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let mut script = Script { editor };
    script.check();
    script
}

fn ids(script: &Script) -> Vec<CurveId> {
    script.editor.document().ids().collect()
}

/// The joints that are listed, once the frame is drawn.
fn listed(script: &mut Script) -> Vec<CurveJoint> {
    script.editor.refresh();
    let listed = script.editor.sight().listed_joints();
    listed.map(|(_, joint)| *joint).collect()
}

/// The joints that are marked, and whether each is named.
fn marked(script: &mut Script) -> Vec<bool> {
    let marks = script.scene().marks.iter();
    let named = marks.filter_map(|mark| match mark {
        Mark::Joint { name, .. } => Some(name.is_some()),
        _ => None,
    });
    named.collect()
}

/// Make one of the two curves of a joint follow the other.
fn follow(script: &mut Script, joint: &CurveJoint, follower: usize, level: Continuity) {
    let edits = joint.matching(script.editor.document(), follower, level);
    told(script.editor.apply("Match end", edits));
    script.check();
}

#[test]
fn the_joints_of_the_selected_items_are_listed_and_named() {
    for in_space in [false, true] {
        let mut script = parts(in_space);
        let ids = ids(&script);
        for (selected, count) in [(vec![0], 1), (vec![1], 2), (vec![2], 1), (vec![0, 2], 2)] {
            let selected = selected.into_iter().map(|it: usize| ids[it]);
            script.editor.hand_mut().select_items(selected);
            let found = listed(&mut script);
            assert_eq!(found.len(), count);
            // A degree of 5 is C⁴ at its knots.
            assert!(found.iter().all(|it| it.continuity == Some(Continuity::G3)));
            let marked = marked(&mut script);
            assert_eq!(marked.len(), 2, "all are marked");
            assert_eq!(marked.iter().filter(|it| **it).count(), count);
        }
        script.editor.view_mut().hover_joint(1);
        assert_eq!(marked(&mut script), [false, true]);
        script.command(Command::ToggleLayer(Layer::Joints));
        assert!(marked(&mut script).is_empty());
        script.editor.look(Look::Joint(0));
        assert_eq!(marked(&mut script).len(), 1, "the other is out of sight");
        script.editor.activate(ids[1]);
        script.command(Command::ToggleVisible);
        assert_eq!(listed(&mut script), []);
        script.command(Command::Undo);
        assert_eq!(listed(&mut script).len(), 2);
    }
}

#[test]
fn a_drag_changes_the_joint_as_it_goes_and_esc_brings_it_back() {
    let mut script = parts(false);
    let first = ids(&script)[0];
    script.editor.activate(first);
    let before = listed(&mut script);
    let last = script.polygon().vertices().len() - 1;
    script.editor.view_mut().joint_tolerance = Some(10.0);
    let from = script.at_vertex(last);
    script.press(from);
    script.move_to(from + DVec2::new(0.0, 40.0));
    let dragged = listed(&mut script)[0];
    assert!(dragged.joint.gap > 0.0 && dragged.continuity < Some(Continuity::G2));
    let [end, start] = [(0, End::Finish), (1, End::Finish)].map(|(index, end)| {
        let (_, curve) = script.editor.document().curves().nth(index).expect("one");
        curve.polygon.end_jet(end)
    });
    assert_eq!(dragged.joint.gap, end.point.distance(start.point));
    script.key(Key::Escape);
    script.release(from);
    script.editor.view_mut().joint_tolerance = None;
    assert_eq!(listed(&mut script), before);
    assert_eq!(script.steps(), 0);
}

#[test]
fn a_match_of_a_joint_is_live_can_be_turned_round_and_is_one_step() {
    for in_space in [false, true] {
        let mut script = parts(in_space);
        let ids = ids(&script);
        script.editor.activate(ids[0]);
        let joint = listed(&mut script)[0];
        let follower = joint.ends.iter().position(|it| it.0 == ids[1]);
        let follower = follower.expect("the second");
        follow(&mut script, &joint, follower, Continuity::G2);
        assert_eq!(script.steps(), 1);
        let last = script.polygon().vertices().len() - 1;
        script.drag_vertex(last, DVec2::new(0.0, 12.0));
        let after = listed(&mut script)[0];
        assert_eq!(after.ends, joint.ends);
        assert!(after.continuity >= Some(Continuity::G2), "{after:?}");
        assert!(after.point.distance(joint.point) > 1e-3);
        // The other one follows instead: the first match goes, in the same step.
        let steps = script.steps();
        follow(&mut script, &after, 1 - follower, Continuity::G3);
        assert_eq!(script.steps(), steps + 1);
        let document = script.editor.document();
        assert_eq!(document.matches().len(), 1);
        let kept = after.match_in(document, 1 - follower).expect("a match");
        assert_eq!(kept.continuity, Continuity::G3);
        script.undo_all();
        assert_eq!(script.editor.document().matches().len(), 0);
    }
}

#[test]
fn plots_of_a_chain_stand_end_to_end() {
    for in_space in [false, true] {
        let mut script = parts(in_space);
        let ids = ids(&script);
        script.editor.view_mut().plot = Some(PlotKind::CURVATURE);
        for active in 0..3 {
            script.editor.hand_mut().select_items(ids.clone());
            script.editor.activate(ids[active]);
            script.editor.hand_mut().select_items(ids.clone());
            assert_eq!(script.editor.active(), Some(ids[active]));
            let plots = script.plots().clone();
            assert_eq!(plots.others.len(), 2);
            // In the order of the chain; the one that is turned round is active or not.
            let mut all: Vec<Vec<DVec2>> =
                plots.others.iter().map(|it| it.series.clone()).collect();
            all.push(plots.series.clone());
            all.sort_by(|one, other| one[0].x.total_cmp(&other[0].x));
            let size = plots.extent;
            for pair in all.windows(2) {
                let [before, after] =
                    [pair[0].last(), pair[1].first()].map(|it| *it.expect("a point"));
                assert!(
                    (before.x - after.x).abs() <= 1e-12 * size,
                    "{before} {after}"
                );
                assert!(
                    (before.y - after.y).abs() * size <= 1e-9,
                    "{before} {after}"
                );
            }
            let reach = plots.reach();
            let lengths = ids.iter().map(|id| {
                script
                    .editor
                    .document()
                    .curve(*id)
                    .expect("one")
                    .polygon
                    .arc_length(1e-12)
            });
            assert!((reach[1] - reach[0] - lengths.sum::<f64>()).abs() <= 1e-6 * size);
        }
    }
}

#[test]
fn references_have_joints_points_and_periodic_curves_have_none() {
    let mut script = parts(false);
    let end = {
        let (_, curve) = script.editor.document().curves().nth(2).expect("one");
        curve.polygon.end_jet(End::Finish)
    };
    let straight = [0.0, 1.0, 2.0, 3.0].map(|it| end.point + it * end.first.normalize());
    let line = Nurbs::new(
        1,
        vec![0.0, 0.0, 1.0, 1.0],
        vec![straight[0], straight[3]],
        None,
        false,
    );
    let points = PointList::new(straight.to_vec()).expect("points");
    let forms = [
        ReferenceForm::Nurbs(line.expect("a line")),
        ReferenceForm::Points(points),
    ];
    for form in forms {
        let reference = ReferenceCurve::of(form).expect("a reference");
        let reference = Reference::new("reference", reference);
        let add = Edit::AddReference(Box::new(reference));
        told(script.editor.apply("Add", vec![add]));
    }
    let ring = FloatPolygon::new(3, straight.to_vec(), None, true).expect("a polygon");
    let ring = Edit::Add(Box::new(Curve::new("ring", ring)));
    told(script.editor.apply("Add", vec![ring]));
    script.check();
    let third = ids(&script)[2];
    // Points have no joints: all are listed, not none.
    let points = script.editor.document().references().nth(1);
    let points = points.expect("the points").0;
    script.editor.activate(points);
    assert_eq!(listed(&mut script).len(), 3);
    script.editor.activate(third);
    let found = listed(&mut script);
    assert_eq!(found.len(), 2);
    let own = script.editor.document().references().next().map(|it| it.0);
    let with_line = found
        .iter()
        .find(|it| it.ends.iter().any(|(id, _)| Some(*id) == own));
    let joint = with_line.expect("the line's");
    assert_eq!(joint.continuity, Some(Continuity::G1));
    // The reference stays where it is: the curve follows it.
    let follower = usize::from(Some(joint.ends[0].0) == own);
    follow(&mut script, joint, follower, Continuity::G2);
    let after = listed(&mut script);
    assert!(
        after
            .iter()
            .any(|it| it.ends == joint.ends && it.continuity >= Some(Continuity::G2))
    );
}

#[test]
fn a_match_that_is_not_met_stays_in_the_list() {
    let mut script = parts(false);
    let ids = ids(&script);
    script.editor.activate(ids[0]);
    let joint = listed(&mut script)[0];
    let follower = joint.ends.iter().position(|it| it.0 == ids[1]);
    follow(
        &mut script,
        &joint,
        follower.expect("the second"),
        Continuity::G1,
    );
    let lock = Edit::SetLocked {
        curve: ids[1],
        locked: true,
    };
    told(script.editor.apply("Lock", vec![lock]));
    let last = script.polygon().vertices().len() - 1;
    script.drag_vertex(last, DVec2::new(0.0, 60.0));
    let found = listed(&mut script);
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].continuity, found[0].name()), (None, "open"));
    assert_eq!(found[0].ends, joint.ends);
    // Without the match it is no joint.
    let (curve, end) = joint.ends[follower.expect("the second")];
    let unlock = Edit::SetLocked {
        curve: ids[1],
        locked: false,
    };
    told(
        script
            .editor
            .apply("Remove", vec![unlock, Edit::RemoveMatch { curve, end }]),
    );
}
