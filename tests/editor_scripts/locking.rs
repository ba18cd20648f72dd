//! Locking vertices by L, and what leaves them where they are.

use batten::document::CurveId;
use batten::editor::{
    Command, DrawWay, EndFitAction, Input, Key, Modifiers, ToolKind, Transformation, told,
};
use batten::geometry::FloatPolygon;
use batten::operations::Value;
use glam::{DVec2, DVec3};

use super::script::Script;

const LOCK: Command = Command::ToggleVerticesLocked;

/// Begin with the hull, some of its vertices locked.
fn locked(vertices: &[usize]) -> Script {
    let mut script = Script::example("hull");
    script.click(script.at_vertex(vertices[0]));
    for vertex in &vertices[1..] {
        script.click_with(Modifiers::SHIFT, script.at_vertex(*vertex));
    }
    script.command(LOCK);
    script.command(Command::SelectNone);
    script
}

fn locks_of(script: &Script, curve: CurveId) -> Vec<usize> {
    let curve = script.editor.document().curve(curve).expect("a curve");
    curve.locked_vertices.iter().collect()
}

fn locks(script: &Script) -> Vec<usize> {
    locks_of(script, script.curve())
}

/// The vertices that are elsewhere than in another polygon.
fn moved(script: &Script, before: &FloatPolygon) -> Vec<usize> {
    let polygon = script.polygon();
    let pairs = polygon.vertices().iter().zip(before.vertices());
    let moved = pairs.enumerate().filter(|(_, (a, b))| a != b);
    moved.map(|(index, _)| index).collect()
}

#[test]
fn the_selected_vertices_are_locked_and_unlocked_by_one_key() {
    let mut script = locked(&[2, 4]);
    assert_eq!(locks(&script), [2, 4]);
    assert_eq!(script.steps(), 1);
    let marks = &script.scene().curves[0].vertices;
    let shown: Vec<usize> = marks.iter().filter(|m| m.locked).map(|m| m.index).collect();
    assert_eq!(shown, [2, 4]);

    // As long as one of the selected is free, all are locked.
    script.click(script.at_vertex(2));
    script.click_with(Modifiers::SHIFT, script.at_vertex(3));
    let label = |script: &Script| Command::ToggleVerticesLocked.label_now(&script.editor);
    assert_eq!(label(&script), "Lock vertices");
    script.command(LOCK);
    assert_eq!(locks(&script), [2, 3, 4]);
    assert_eq!(script.message(), "2 vertices locked");
    assert_eq!(label(&script), "Unlock vertices");
    script.command(LOCK);
    assert_eq!(locks(&script), [4]);
    assert_eq!(script.message(), "2 vertices unlocked");
    for expected in [vec![2, 3, 4], vec![2, 4], vec![]] {
        script.command(Command::Undo);
        assert_eq!(locks(&script), expected);
    }
    script.command(Command::Redo);
    assert_eq!(locks(&script), [2, 4]);

    script.command(Command::SelectNone);
    assert!(!Command::ToggleVerticesLocked.is_enabled(&script.editor));
}

#[test]
fn a_locked_vertex_is_not_dragged_and_stays_where_others_go() {
    let mut script = locked(&[2, 7]);
    let before = script.polygon();
    script.drag_vertex(2, DVec2::new(40.0, 30.0));
    assert_eq!(script.polygon(), before);
    assert_eq!(
        script.message(),
        "vertex 2 of “hull” is locked: unlock it to change or delete it"
    );
    assert_eq!(script.steps(), 1);

    // The hint says so too.
    script.click(script.at_vertex(2));
    assert_eq!(script.editor.hint(), "1 vertex selected, locked: L unlocks");

    // The others of a selection, or of a leg, go without it.
    script.click(script.at_vertex(1));
    script.click_with(Modifiers::SHIFT, script.at_vertex(2));
    script.drag_vertex(1, DVec2::new(40.0, 30.0));
    assert_eq!(moved(&script, &before), [1]);
    assert_eq!(
        script.editor.workspace().history().undo_label(),
        Some("Move 1 vertex")
    );
    script.command(Command::Undo);
    script.command(Command::SelectNone);
    // Near by the leg is apart from the curve.
    let leg = |script: &Script| 0.5 * (script.at_vertex(7) + script.at_vertex(8));
    let (at, factor) = (leg(&script), 8.0);
    script.input(Input::Zoomed { at, factor });
    let leg = leg(&script);
    script.drag(leg, leg + DVec2::new(0.0, 40.0));
    assert_eq!(moved(&script, &before), [8]);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
}

#[test]
fn arrow_keys_transformations_and_typed_numbers_leave_it() {
    let mut script = locked(&[2]);
    let before = script.polygon();
    script.command(Command::SelectAll);
    script.key(Key::Right);
    assert!(!moved(&script, &before).contains(&2));
    assert_eq!(moved(&script, &before).len(), before.vertices().len() - 1);
    script.command(Command::Undo);

    for (tool, transformation) in [
        (ToolKind::Rotate, Transformation::Rotate(0.5)),
        (ToolKind::Scale, Transformation::Scale(1.5)),
    ] {
        script.command(Command::Tool(tool));
        told(script.editor.transform(transformation));
        assert!(!moved(&script, &before).contains(&2), "{tool:?}");
        assert!(moved(&script, &before).len() > 3, "{tool:?}");
        script.command(Command::Undo);
        assert_eq!(script.polygon(), before);
    }
    script.command(Command::Tool(ToolKind::Select));

    let curve = script.curve();
    let moves = vec![(2, DVec3::new(9.0, 9.0, 0.0))];
    let edit = batten::document::Edit::MoveVertices { curve, moves };
    let refused = script.editor.apply("Move vertex", vec![edit.clone()]);
    assert!(refused.is_err());
    // A field that is dragged shows nothing of it, and says why.
    script.editor.preview("Move vertex", vec![edit]);
    assert_eq!(script.polygon(), before);
    assert!(script.message().contains("locked"), "{}", script.message());
    script.editor.abort_preview();
}

#[test]
fn the_closed_polygon_and_the_end_fit_cannot_move_it() {
    let mut script = Script::example("arc");
    script.click(script.at_vertex(0));
    script.command(LOCK);
    let before = script.polygon();
    let closed = batten::geometry::ClampedPolygon::from_float(&before);
    let viewport = script.editor.view().viewport();
    let at = viewport.to_screen(viewport.flatten(closed.vertices()[0]));
    script.drag(at, at + 30.0);
    assert_eq!(script.polygon().vertex(0), before.vertex(0));
    script.command(Command::Undo);
    script.command(Command::ToggleClosedFollow);
    script.drag(at, at + 30.0);
    assert_eq!(script.polygon(), before);
    assert!(script.message().contains("locked"), "{}", script.message());

    script.command(Command::Tool(ToolKind::EndFit));
    script.end_fit_action(EndFitAction::Choose(batten::geometry::End::Start));
    let viewport = script.editor.view().viewport();
    let end = before.end_jet(batten::geometry::End::Start).point;
    let at = viewport.to_screen(viewport.flatten(end));
    script.drag(at, at + 50.0);
    assert_eq!(script.polygon(), before);
    assert!(
        script.message().contains("vertex 0"),
        "{}",
        script.message()
    );
    assert_eq!(script.steps(), 1);
}

#[test]
fn locks_keep_to_their_vertices_where_others_come_and_go() {
    let mut script = locked(&[2, 5]);
    let places = |script: &Script| -> Vec<DVec3> {
        let polygon = script.polygon();
        locks(script)
            .iter()
            .map(|index| polygon.vertex(*index))
            .collect()
    };
    let before = places(&script);
    let start = script.editor.document().clone();
    script.command(Command::ToggleKeepShape);

    // A vertex inserted before them, and one added at the start.
    script.command(Command::Tool(ToolKind::Insert));
    script.click(0.5 * (script.at_vertex(0) + script.at_vertex(1)));
    assert_eq!(locks(&script), [3, 6]);
    script.draw_by(DrawWay::Vertices);
    script.command(Command::Tool(ToolKind::AddVertex));
    script.click(script.at_vertex(0) + DVec2::new(-30.0, 5.0));
    assert_eq!(locks(&script), [4, 7]);
    assert_eq!(places(&script), before);

    // One between them deleted, by the tool and by the command.
    script.command(Command::Tool(ToolKind::Delete));
    script.click(script.at_vertex(5));
    assert_eq!(locks(&script), [4, 6]);
    script.command(Command::Tool(ToolKind::Select));
    script.click(script.at_vertex(0));
    script.command(Command::Delete);
    assert_eq!(locks(&script), [3, 5]);
    assert_eq!(places(&script), before);

    // They themselves are not deleted.
    let kept = script.polygon();
    script.click(script.at_vertex(4));
    script.click_with(Modifiers::SHIFT, script.at_vertex(5));
    script.command(Command::Delete);
    assert_eq!(script.polygon(), kept);
    assert!(
        script.message().contains("vertex 5"),
        "{}",
        script.message()
    );
    script.command(Command::Tool(ToolKind::Delete));
    script.click(script.at_vertex(3));
    assert_eq!(script.polygon(), kept);
    assert!(
        script.message().contains("vertex 3"),
        "{}",
        script.message()
    );

    // Turned round, and longer at its start.
    script.operate("reverse", &[]).expect("the same curve");
    let last = kept.vertices().len() - 1;
    assert_eq!(locks(&script), [last - 5, last - 3]);
    let longer = [("end", Value::Choice(0)), ("segments", Value::Whole(2))];
    script.operate("extend", &longer).expect("a longer curve");
    assert_eq!(locks(&script), [last - 3, last - 1]);
    assert_eq!(places(&script), [before[1], before[0]]);

    while script.steps() > 1 {
        script.command(Command::Undo);
    }
    assert!(script.editor.document().is_same(&start));
}

#[test]
fn copies_are_free() {
    let mut script = locked(&[2]);
    script.command(Command::Duplicate);
    assert!(locks(&script).is_empty());
    let text = script
        .editor
        .copy(batten::editor::CopyForm::Own)
        .expect("a curve");
    told(script.editor.paste(&text));
    assert!(locks(&script).is_empty());
    let first = script.editor.document().ids().next().expect("the first");
    assert_eq!(locks_of(&script, first), [2]);
    script.editor.activate(first);
    let text = script
        .editor
        .copy(batten::editor::CopyForm::Own)
        .expect("a curve");
    told(script.editor.paste(&text));
    assert!(locks(&script).is_empty());
}

#[test]
fn what_moves_a_selection_says_that_locked_vertices_stay() {
    let mut script = locked(&[2, 7]);
    let before = script.polygon();
    script.command(Command::SelectAll);
    let at = script.at_vertex(4);
    script.press(at);
    script.move_to(at + DVec2::new(10.0, 10.0));
    let hint = script.editor.hint();
    assert!(hint.contains("(2 locked vertices stay)"), "{hint}");
    script.release(at + DVec2::new(10.0, 10.0));
    assert_eq!(script.message(), "2 locked vertices stay");
    script.key(Key::Up);
    assert_eq!(script.message(), "2 locked vertices stay");
    for tool in [ToolKind::Rotate, ToolKind::Scale] {
        script.tool(tool);
        script.press(at);
        script.move_to(at + DVec2::new(30.0, 10.0));
        let hint = script.editor.hint();
        assert!(hint.starts_with("2 locked vertices stay"), "{hint}");
        script.release(at + DVec2::new(30.0, 10.0));
        assert_eq!(script.message(), "2 locked vertices stay", "{tool:?}");
    }
    told(script.editor.transform(Transformation::Scale(1.5)));
    assert_eq!(script.message(), "2 locked vertices stay");
    for vertex in [2, 7] {
        assert_eq!(script.polygon().vertex(vertex), before.vertex(vertex));
    }
    script.undo_all();
    assert_eq!(script.polygon(), before);
    // Without any of them nothing is said.
    script.tool(ToolKind::Select);
    script.editor.select_vertex(script.curve(), 4, false);
    script.drag_vertex(4, DVec2::new(10.0, 10.0));
    assert_eq!(script.message(), "");
}
