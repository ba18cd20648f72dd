//! Two curves that are joined: chosen, tried out, applied and undone.

use batten::document::{Curve, CurveId, Edit};
use batten::editor::{Command, Key, Legs, Note};
use batten::geometry::FloatPolygon;
use batten::operations::Value;
use glam::DVec2;

use super::script::{Script, operation};
use super::several::two;

fn add(script: &mut Script, name: &str, at: f64) {
    let points: Vec<_> = (0..6).map(|i| (f64::from(i) * 3.0 + at, at)).collect();
    let polygon = FloatPolygon::planar(3, &points).expect("a polygon");
    let added = Edit::Add(Box::new(Curve::new(name, polygon)));
    script.editor.apply("add", vec![added]).expect("an edit");
}

#[test]
fn two_curves_are_joined_as_one_step_and_undone_to_the_bit() {
    let (mut script, [arc, other]) = two();
    let before = script.editor.document().clone();
    let steps = script.editor.workspace().history().undo_steps();
    let begun = script.try_out("join").expect("an operation");
    assert_eq!(begun, Note::silent());
    // The preview has the composite, which plots and strips show.
    assert!(script.editor.document().curve(other).is_none());
    let shown = script.editor.document().curve(arc).expect("the first");
    let count = shown.polygon.vertices().len();
    script
        .editor
        .operating()
        .set_values(&[("bridge", Value::List(vec![7.0]))])
        .expect("a value");
    let shown = script.editor.document().curve(arc).expect("the first");
    // Six segments, of the degree of the first.
    assert_eq!(shown.polygon.vertices().len(), 10 + 7 + (6 + 9));
    assert_ne!(count, 0);
    let shown = shown.clone();
    script.editor.operating().apply().expect("a step");
    script.check();
    assert_eq!(script.editor.workspace().history().undo_steps(), steps + 1);
    assert_eq!(script.editor.document().curve(arc), Some(&shown));
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
    // The first curve is the active one again, and both are selected.
    assert_eq!(script.editor.hand().selection().active(), Some(arc));
    assert!(script.editor.hand().selection().has_item(other));
    script.command(Command::Redo);
    assert_eq!(script.editor.document().curve(arc), Some(&shown));
    script.command(Command::Undo);
    // Another curve stays as it is after the operation was left.
    script.try_out("join").expect("an operation");
    script.editor.operating().leave();
    assert!(script.editor.document().is_same(&before));
}

/// The points of the legs of a polygon that are drawn.
fn points(legs: &Legs) -> Vec<DVec2> {
    legs.chains()
        .flat_map(|(chain, _)| chain.to_vec())
        .collect()
}

#[test]
fn the_ghost_shows_both_curves_as_they_were() {
    let (mut script, [arc, other]) = two();
    let chains = script.scene().curves.iter();
    let alone: Vec<usize> = [arc, other]
        .iter()
        .map(|id| {
            chains
                .clone()
                .find(|it| it.id == Some(*id))
                .map_or(0, |it| points(&it.float).len())
        })
        .collect();
    script.try_out("join").expect("an operation");
    let curve = |script: &Script, id| script.editor.workspace().settled().curve(id).cloned();
    let vertices = [arc, other].map(|id| curve(&script, id).expect("a curve").polygon.clone());
    let viewport = *script.editor.view().viewport();
    let scene = script.scene();
    let ghost = points(&scene.ghost.float);
    for polygon in &vertices {
        for vertex in polygon.vertices() {
            let seen = viewport.flatten(*vertex);
            assert!(ghost.contains(&seen), "{seen}");
        }
    }
    assert!(ghost.len() >= alone.iter().sum::<usize>());
    assert!(!scene.ghost.curve.is_empty());
    script.editor.operating().apply().expect("a step");
    assert!(script.scene().ghost.curve.is_empty());
}

#[test]
fn of_more_curves_those_with_selected_vertices_are_joined() {
    let (mut script, [arc, other]) = two();
    add(&mut script, "third", 40.0);
    script.editor.select_vertex(arc, 2, false);
    script.editor.select_vertex(other, 2, true);
    let active = script.curve();
    script.try_out("join").expect("an operation");
    script.editor.operating().apply().expect("a step");
    script.check();
    let document = script.editor.document();
    assert_eq!(document.curves().len(), 2);
    assert!(document.curve(active).is_some());
    // A hidden or a locked curve is refused.
    script.command(Command::Undo);
    for edit in [
        Edit::SetLocked {
            curve: other,
            locked: true,
        },
        Edit::SetVisible {
            curve: other,
            visible: false,
        },
    ] {
        script.editor.apply("edit", vec![edit]).expect("an edit");
        script.editor.activate(arc);
        // The other one is taken, as long as it can be.
        let input = script
            .editor
            .input_of(operation("join"))
            .expect("two curves");
        assert_ne!(input.curves()[1].0, other);
        script.command(Command::Undo);
    }
}

#[test]
fn the_second_curve_is_the_nearest_until_another_one_is_clicked_or_selected() {
    let (mut script, [arc, other]) = two();
    add(&mut script, "third", 30.0);
    script.command(Command::FitAll);
    script.editor.activate(arc);
    let ids: Vec<CurveId> = script.editor.document().ids().collect();
    let third = ids[2];
    let polygon = |id| {
        script
            .editor
            .document()
            .curve(id)
            .expect("a curve")
            .polygon
            .clone()
    };
    let of_third = polygon(third);
    let before = script.editor.document().clone();
    let second = |script: &Script| {
        let operation = script.editor.previewed_operation();
        operation.and_then(|operation| operation.seconds().1)
    };
    script.try_out("join").expect("an operation");
    assert_eq!(second(&script), Some(other), "the nearest");
    // A click on the canvas.
    let on = |script: &Script, polygon: &FloatPolygon| {
        let viewport = script.editor.view().viewport();
        viewport.to_screen(viewport.flatten(polygon.point(1.5)))
    };
    let at = on(&script, &of_third);
    script.click(at);
    assert_eq!(second(&script), Some(third));
    assert!(
        script.editor.document().curve(third).is_none(),
        "it is joined"
    );
    assert!(script.editor.document().curve(other).is_some());
    script.editor.operating().choose_second(other);
    assert_eq!(second(&script), Some(other));
    // A locked one is refused, and nothing changes.
    script.key(Key::Escape);
    assert!(script.editor.document().is_same(&before));
    let lock = Edit::SetLocked {
        curve: third,
        locked: true,
    };
    script.editor.apply("lock", vec![lock]).expect("an edit");
    script.try_out("join").expect("an operation");
    script.click(at);
    assert_eq!(second(&script), Some(other));
    assert!(script.message().contains("locked"), "{}", script.message());
    script.key(Key::Escape);
    script.command(Command::Undo);
    // By its row, beside the active one.
    script.editor.hand_mut().toggle_item(third);
    assert_eq!(script.curve(), arc);
    script.try_out("join").expect("an operation");
    assert_eq!(second(&script), Some(third));
    script.key(Key::Escape);
    script.editor.hand_mut().toggle_item(third);
    script.try_out("join").expect("an operation");
    assert_eq!(second(&script), Some(other));
}
