//! Several curves and references, moved, rotated and scaled as a whole.

use std::f64::consts::FRAC_PI_2;

use batten::document::{Curve, CurveId, Document, Edit};
use batten::editor::{Command, Key, ToolKind, Transformation};
use batten::geometry::FloatPolygon;
use glam::{DVec2, DVec3};

use super::script::Script;
use super::selecting_several::{four, hide, lock, match_starts, on};

/// The points that tell where an item is: vertices, or the place of a reference.
fn places(document: &Document, id: CurveId) -> Vec<DVec3> {
    match document.curve(id) {
        Some(curve) => curve.polygon.vertices().to_vec(),
        None => {
            let reference = document.reference(id).expect("a reference");
            vec![reference.curve.placement().translation()]
        }
    }
}

/// How far an item was moved as a whole, to rounding.
#[track_caller]
fn moved(before: &Document, after: &Document, id: CurveId) -> DVec3 {
    let [from, to] = [before, after].map(|document| places(document, id));
    let ways: Vec<DVec3> = from.iter().zip(&to).map(|(from, to)| *to - *from).collect();
    let size = from
        .iter()
        .chain(&to)
        .map(|at| at.length())
        .fold(1.0, f64::max);
    for way in &ways {
        assert!(way.distance(ways[0]) <= 1e-12 * size, "{ways:?}");
    }
    ways[0]
}

#[test]
fn a_drag_of_one_moves_all_that_are_selected() {
    let (mut script, [arc, other, short, circle]) = four();
    script.editor.hand_mut().select_items([arc, other, circle]);
    let (before, steps) = (script.editor.document().clone(), script.steps());
    for grip in [arc, circle] {
        let from = on(&script, grip, 0.43);
        script.press(from);
        script.move_to(from + DVec2::new(40.0, 25.0));
        assert!(!script.editor.document().is_same(&before));
        script.key(Key::Escape);
        assert!(
            script.editor.document().is_same(&before),
            "Esc restores to the bit"
        );
        script.release(from);
        script.drag(from, from + DVec2::new(40.0, 25.0));
        let way = DVec3::new(40.0, -25.0, 0.0) * script.editor.view().viewport().pixel();
        for id in [arc, other, circle] {
            let moved = moved(&before, script.editor.document(), id);
            assert!(moved.distance(way) < 1e-9, "{moved} instead of {way}");
        }
        assert_eq!(moved(&before, script.editor.document(), short), DVec3::ZERO);
        assert_eq!(script.steps(), steps + 1);
        script.command(Command::Undo);
        assert!(script.editor.document().is_same(&before));
    }
    // A drag of nothing changes nothing.
    let from = on(&script, arc, 0.43);
    script.press(from);
    script.move_to(from + DVec2::splat(30.0));
    script.move_to(from);
    script.release(from);
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn vertices_on_a_selected_curve_do_not_keep_it_from_moving_as_a_whole() {
    let (mut script, [arc, ..]) = four();
    let middle = script.at_vertex_of(arc, 2);
    let corner = {
        let viewport = script.editor.view().viewport();
        viewport.to_model(middle + DVec2::new(0.0, 120.0))
    };
    let vertex = |step: usize| (corner.x + 0.1 * step as f64, corner.y);
    let vertices: Vec<(f64, f64)> = (0..7).map(vertex).collect();
    let line = FloatPolygon::planar(3, &vertices).expect("a polygon");
    let edit = Edit::Add(Box::new(Curve::new("line", line)));
    let reply = script.editor.apply("Add", vec![edit]);
    reply.expect("it can be added");
    let line = script.editor.document().ids().last().expect("a curve");
    script.editor.hand_mut().select_items([arc, line]);
    let before = script.editor.document().clone();
    let from = script.at_vertex_of(line, 3);
    script.drag(from, from + DVec2::new(30.0, 20.0));
    let way = DVec3::new(30.0, -20.0, 0.0) * script.editor.view().viewport().pixel();
    for id in [arc, line] {
        let moved = moved(&before, script.editor.document(), id);
        assert!(moved.distance(way) < 1e-9, "{moved} instead of {way}");
    }
    script.command(Command::Undo);
    // Alone it is reshaped there.
    script.editor.hand_mut().select_items([line]);
    script.drag(from, from + DVec2::new(30.0, 20.0));
    let [from, to] = [&before, script.editor.document()].map(|it| places(it, line));
    let moves: Vec<DVec3> = from.iter().zip(&to).map(|(from, to)| *to - *from).collect();
    assert!(
        moves[3].distance(moves[0]) > 0.1 * way.length(),
        "{moves:?}"
    );
}

#[test]
fn a_drag_of_an_item_that_is_not_selected_takes_that_alone() {
    let (mut script, [arc, other, short, _]) = four();
    script.editor.hand_mut().select_items([arc, other]);
    let before = script.editor.document().clone();
    let from = on(&script, short, 0.43);
    script.drag(from, from + DVec2::new(0.0, 20.0));
    assert_eq!(script.curve(), short);
    for id in [arc, other] {
        assert_eq!(moved(&before, script.editor.document(), id), DVec3::ZERO);
    }
    // It is its shape that changes: one curve follows the pointer.
    assert_ne!(
        places(&before, short),
        places(script.editor.document(), short)
    );
}

#[test]
fn arrow_keys_move_all_that_are_selected() {
    let (mut script, [arc, other, _, circle]) = four();
    script.editor.hand_mut().select_items([arc, other, circle]);
    let before = script.editor.document().clone();
    script.key(Key::Right);
    for id in [arc, other, circle] {
        let way = moved(&before, script.editor.document(), id);
        assert!(
            (way - script.editor.hand().nudge_step() * DVec3::X).length() < 1e-12,
            "{way}"
        );
    }
    assert_eq!(
        Command::Undo.label_now(&script.editor),
        "Undo nudge 2 curves and 1 reference"
    );
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn all_that_are_selected_rotate_and_scale_about_one_pivot() {
    let (mut script, [arc, other, short, circle]) = four();
    script.editor.hand_mut().select_items([arc, other, circle]);
    let before = script.editor.document().clone();
    script.tool(ToolKind::Rotate);
    script.editor.hand_mut().set_pivot(Some(DVec2::ZERO));
    script
        .editor
        .transform(Transformation::Rotate(FRAC_PI_2))
        .expect("a turn");
    for id in [arc, other, circle] {
        let after = places(script.editor.document(), id);
        for (from, to) in places(&before, id).iter().zip(after) {
            let turned = DVec3::new(-from.y, from.x, from.z);
            assert!(
                to.distance(turned) < 1e-12 * from.length().max(1.0),
                "{to} of {from}"
            );
        }
    }
    assert_eq!(moved(&before, script.editor.document(), short), DVec3::ZERO);
    script.command(Command::Undo);
    script.tool(ToolKind::Scale);
    script.editor.hand_mut().set_pivot(Some(DVec2::ZERO));
    script
        .editor
        .transform(Transformation::Scale(2.0))
        .expect("a scaling");
    let scale = |script: &Script| {
        let reference = script.editor.document().reference(circle).cloned();
        reference.expect("a circle").curve.placement().scale()
    };
    assert_eq!(scale(&script), 2.0);
    let after = places(script.editor.document(), arc);
    for (from, to) in places(&before, arc).iter().zip(after) {
        assert!(to.distance(2.0 * *from) < 1e-12 * from.length().max(1.0));
    }
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn what_cannot_move_as_a_whole_stays_and_is_named() {
    let (mut script, [arc, other, short, circle]) = four();
    lock(&mut script, other);
    hide(&mut script, circle);
    let locks = Edit::SetVerticesLocked {
        curve: short,
        vertices: vec![2],
        locked: true,
    };
    script.editor.apply("lock", vec![locks]).expect("an edit");
    script
        .editor
        .hand_mut()
        .select_items([arc, other, short, circle]);
    let before = script.editor.document().clone();
    script.key(Key::Up);
    assert_ne!(moved(&before, script.editor.document(), arc), DVec3::ZERO);
    for id in [other, short, circle] {
        assert_eq!(moved(&before, script.editor.document(), id), DVec3::ZERO);
    }
    for told in [
        "“other” (locked)",
        "“short” (has locked vertices)",
        "(hidden) stay",
    ] {
        assert!(script.message().contains(told), "{}", script.message());
    }
    script.command(Command::Undo);
    // One that stays cannot be dragged, and says why.
    let from = on(&script, other, 0.43);
    script.drag(from, from + DVec2::new(30.0, 0.0));
    assert!(script.editor.document().is_same(&before));
    assert!(
        script.message().contains("“other” (locked)"),
        "{}",
        script.message()
    );
}

#[test]
fn matched_curves_follow_a_move_and_keep_their_shape_if_they_go_along() {
    let (mut script, [arc, other, short, _]) = four();
    match_starts(&mut script, short, other);
    let meets = |script: &Script| {
        let document = script.editor.document();
        document.matches().all(|matched| document.meets(matched))
    };
    assert!(meets(&script));
    let before = script.editor.document().clone();
    script.editor.hand_mut().select_items([arc, other]);
    script.key(Key::Right);
    assert!(meets(&script));
    assert_ne!(
        places(&before, short),
        places(script.editor.document(), short)
    );
    script.command(Command::Undo);
    script.editor.hand_mut().select_items([arc, other, short]);
    let from = on(&script, arc, 0.43);
    script.drag(from, from + DVec2::new(-37.0, 21.0));
    assert!(meets(&script));
    let ways = [arc, other, short].map(|id| moved(&before, script.editor.document(), id));
    assert!(ways[0].length() > 0.0 && ways.iter().all(|way| way.distance(ways[0]) < 1e-9));
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
}
