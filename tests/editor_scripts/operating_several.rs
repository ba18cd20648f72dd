//! Operations on several curves and references, on each by itself.

use batten::document::{Curve, CurveId, Document, Edit, Reference};
use batten::editor::{Command, Key};
use batten::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use batten::geometry::{End, FloatPolygon};
use batten::operations::Value;
use glam::DVec3;

use super::script::Script;
use super::selecting_several::{four, hide, lock, match_starts};

fn polygon(script: &Script, id: CurveId) -> FloatPolygon {
    let curve = script.editor.document().curve(id);
    curve.expect("a curve").polygon.clone()
}

#[test]
fn an_operation_runs_on_each_with_its_own_defaults_as_one_step() {
    let (mut script, [arc, other, short, circle]) = four();
    script
        .editor
        .hand_mut()
        .select_items([arc, other, short, circle]);
    let (before, steps) = (script.editor.document().clone(), script.steps());
    let degrees = [arc, other, short].map(|id| polygon(&script, id).degree());
    assert!(
        degrees.iter().any(|degree| *degree != degrees[0]),
        "{degrees:?}"
    );
    script.try_out("elevate-degree").expect("a preview");
    assert!(!script.editor.document().is_same(&before));
    script.key(Key::Escape);
    assert!(script.editor.document().is_same(&before));
    script.operate("elevate-degree", &[]).expect("it is done");
    for (id, degree) in [arc, other, short].into_iter().zip(degrees) {
        assert_eq!(polygon(&script, id).degree(), degree + 1);
    }
    assert_eq!(script.steps(), steps + 1);
    let message = script.message();
    assert!(message.starts_with("Elevate degree: 3 done"), "{message}");
    assert!(message.contains("“other”: "), "{message}");
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
    // A value that is given counts for all.
    let degree = [("degree", Value::Whole(9))];
    script
        .operate("reinterpret-degree", &[("degree", Value::Whole(2))])
        .expect("it is done");
    for id in [arc, other, short] {
        assert_eq!(polygon(&script, id).degree(), 2);
    }
    let [_, nine, six] = [arc, other, short].map(|id| polygon(&script, id).vertices().len());
    assert!(nine < 10 && six < 10);
    script
        .operate("reinterpret-degree", &degree)
        .expect("the arc has enough vertices");
    assert_eq!(polygon(&script, arc).degree(), 9);
    assert!(
        script.message().contains("1 of 3 done"),
        "{}",
        script.message()
    );
}

#[test]
fn what_an_operation_cannot_run_on_is_named() {
    let (mut script, [arc, other, short, _]) = four();
    lock(&mut script, arc);
    hide(&mut script, short);
    script.editor.hand_mut().select_items([arc, other, short]);
    assert_eq!(script.curve(), arc);
    let before = script.editor.document().clone();
    // The active curve is locked: another one comes first.
    let reverse = batten::operations::find("reverse").expect("an operation");
    script.command(Command::Operation(reverse));
    let reversed = polygon(&script, other);
    assert_eq!(
        reversed,
        before.curve(other).expect("a curve").polygon.reversed()
    );
    let message = script.message();
    for told in ["1 of 3 done", "“short” is hidden", "is locked"] {
        assert!(message.contains(told), "{message}");
    }
    assert!(std::sync::Arc::ptr_eq(
        before.curve(arc).expect("a curve"),
        script.editor.document().curve(arc).expect("a curve"),
    ));
    script.editor.hand_mut().select_items([arc, short]);
    assert!(!Command::Operation(reverse).is_enabled(&script.editor));
}

#[test]
fn matched_curves_are_mirrored_together() {
    let (mut script, [_, other, short, _]) = four();
    match_starts(&mut script, short, other);
    let before = script.editor.document().clone();
    let image = |id: CurveId| -> Vec<DVec3> {
        let vertices = before.curve(id).expect("a curve").polygon.vertices().iter();
        vertices.map(|it| DVec3::new(-it.x, it.y, it.z)).collect()
    };
    // Alone it would go back to its source.
    script.editor.activate(short);
    assert!(script.operate("mirror", &[]).is_err());
    script.editor.hand_mut().select_items([short, other]);
    script.operate("mirror", &[]).expect("both are mirrored");
    for id in [other, short] {
        let size = polygon(&script, id).size();
        for (vertex, image) in polygon(&script, id).vertices().iter().zip(image(id)) {
            assert!(
                vertex.distance(image) < 1e-9 * size,
                "{vertex} instead of {image}"
            );
        }
    }
    let document = script.editor.document();
    assert!(document.matches().all(|matched| document.meets(matched)));
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
    // Copies have names of their own.
    script.editor.hand_mut().select_items([short, other]);
    script
        .operate("mirror", &[("copy", Value::Switch(true))])
        .expect("two copies");
    let mut names: Vec<&str> = script.editor.document().names().collect();
    names.sort_unstable();
    let count = names.len();
    names.dedup();
    assert_eq!((count, names.len()), (6, 6), "{names:?}");
}

#[test]
fn what_lies_together_stays_together_in_an_array() {
    let (mut script, [_, other, short, _]) = four();
    script.editor.hand_mut().select_items([short, other]);
    script.operate("array", &[]).expect("copies of both");
    let document = script.editor.document();
    let moves = |id: CurveId| -> Vec<DVec3> {
        let name = document.name(id).expect("a name");
        let copies = [2, 3].map(|number| {
            let copy = format!("{name} {number}");
            let found = document.curves().find(|(_, curve)| curve.name == copy);
            found.expect("a copy").1.polygon.vertices()[0]
        });
        let own = polygon(&script, id).vertices()[0];
        copies.map(|copy| copy - own).to_vec()
    };
    let [one, two] = [short, other].map(moves);
    for (one, two) in one.into_iter().zip(two) {
        assert!(one.distance(two) < 1e-12 * one.length(), "{one} and {two}");
        assert!(one.x > 0.0 && one.y == 0.0, "{one}");
    }
    // Undone, it leaves selected what it was about.
    script.command(Command::Undo);
    let mut selected = script.editor.hand().selection().items();
    selected.sort_unstable();
    let mut asked = vec![short, other];
    asked.sort_unstable();
    assert_eq!(selected, asked);
}

/// A list of points on a wave, from one place on.
fn points(at: f64) -> Reference {
    let points = (0..60).map(|i| {
        let x = 0.1 * f64::from(i);
        DVec3::new(at + x, x.sin(), 0.0)
    });
    let list = PointList::new(points.collect()).expect("points");
    let curve = ReferenceCurve::of(ReferenceForm::Points(list)).expect("a reference");
    Reference::new("scan", curve)
}

#[test]
fn several_lists_of_points_are_fitted_by_a_curve_each() {
    let mut script = Script::example("arc");
    for at in [0.0, 10.0] {
        let edit = Edit::AddReference(Box::new(points(at)));
        script.editor.apply("add", vec![edit]).expect("an edit");
    }
    let lists: Vec<CurveId> = script
        .editor
        .document()
        .references()
        .map(|(id, _)| id)
        .collect();
    script.editor.hand_mut().select_items(lists.iter().copied());
    let steps = script.steps();
    script.operate("fit", &[]).expect("two curves");
    let document = script.editor.document();
    assert_eq!((document.curves().len(), script.steps()), (3, steps + 1));
    let fitted: Vec<&Curve> = document
        .curves()
        .skip(1)
        .map(|(_, it)| it.as_ref())
        .collect();
    assert_ne!(fitted[0].name, fitted[1].name);
    for (curve, at) in fitted.iter().zip([0.0, 10.0]) {
        let start = curve.polygon.end_jet(End::Start).point;
        assert!(start.distance(DVec3::new(at, 0.0, 0.0)) < 0.1, "{start}");
    }
    assert!(script.message().contains("2 done"), "{}", script.message());
    let before: Document = script.editor.document().clone();
    script.command(Command::Undo);
    script.command(Command::Redo);
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn harmonising_several_reports_each() {
    let (mut script, [arc, other, short, _]) = four();
    script.editor.hand_mut().select_items([arc, other, short]);
    script
        .operate("harmonise", &[])
        .expect("all are harmonised");
    let message = script.message();
    for told in [
        "Harmonise: 3 done",
        "“other”: ",
        "“short”: ",
        "curvature extrema",
    ] {
        assert!(message.contains(told), "{message}");
    }
}
