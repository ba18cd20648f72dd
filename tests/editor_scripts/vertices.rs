//! Adding, inserting, deleting, drawing and measuring.

use batten::editor::{Command, DrawWay, Key, ToolKind};
use batten::operations::Value;
use glam::DVec2;

use super::script::Script;

#[test]
fn the_add_tool_adds_at_the_nearer_end() {
    for (end, index) in [(0, 0), (9, 10)] {
        let mut script = Script::example("arc");
        script.tool(ToolKind::AddVertex);
        let place = script.at_vertex(end) + DVec2::new(5.0, 20.0);
        script.click(place);
        let polygon = script.polygon();
        assert_eq!(polygon.vertices().len(), 11);
        let expected = script.editor.view().viewport().to_model(place);
        assert!(polygon.vertex(index).truncate().distance(expected) < 1e-9);
        assert_eq!(script.editor.workspace().history().undo_steps(), 1);
    }
}

#[test]
fn the_insert_tool_splits_the_leg_under_the_pointer() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.command(Command::ToggleKeepShape);
    script.tool(ToolKind::Insert);
    let middle = 0.5 * (script.at_vertex(3) + script.at_vertex(4));
    script.click(middle);
    let polygon = script.polygon();
    assert_eq!(polygon.vertices().len(), 11);
    let expected = 0.5 * (before.vertex(3) + before.vertex(4));
    assert!(polygon.vertex(4).distance(expected) < 1e-9);
    assert_eq!(polygon.vertex(5), before.vertex(4));
}

#[test]
fn inserting_and_dragging_is_one_step_and_escape_takes_it_back() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.tool(ToolKind::Insert);
    let middle = 0.5 * (script.at_vertex(3) + script.at_vertex(4));
    script.press(middle);
    script.move_to(middle + 40.0);
    script.key(Key::Escape);
    script.release(middle + 40.0);
    assert_eq!(script.polygon(), before);
    script.drag(middle, middle + 40.0);
    assert_eq!(script.polygon().vertices().len(), 11);
    assert_eq!(script.editor.workspace().history().undo_steps(), 1);
}

#[test]
fn a_vertex_that_the_degree_needs_is_not_deleted() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.tool(ToolKind::Delete);
    script.click(script.at_vertex(4));
    assert_eq!(script.polygon(), before);
    assert!(
        script.message().contains("needs at least 10"),
        "{}",
        script.message()
    );
    let degree = [("degree", Value::Whole(5))];
    let changed = script.operate("reinterpret-degree", &degree);
    changed.expect("another degree");
    script.click(script.at_vertex(4));
    assert_eq!(script.polygon().vertices().len(), 9);
}

#[test]
fn drawing_ends_with_enter_and_a_click_on_the_first_vertex_makes_it_periodic() {
    for periodic in [false, true] {
        let mut script = Script::example("arc");
        script.tool(ToolKind::Draw);
        script.draw_by(DrawWay::Vertices);
        let corners = [
            (100.0, 100.0),
            (300.0, 120.0),
            (400.0, 300.0),
            (250.0, 400.0),
            (90.0, 300.0),
        ];
        for (x, y) in corners {
            script.click(DVec2::new(x, y));
        }
        if periodic {
            script.click(DVec2::new(100.0, 100.0));
        } else {
            script.key(Key::Enter);
        }
        assert_eq!(script.editor.document().len(), 2);
        let polygon = script.polygon();
        assert_eq!(polygon.vertices().len(), 5);
        assert_eq!(polygon.is_periodic(), periodic);
        assert_eq!(polygon.degree(), 4);
        assert_eq!(script.editor.hand().tool(), ToolKind::Select);
        script.command(Command::Undo);
        assert_eq!(script.editor.document().len(), 1);
    }
}

#[test]
fn measuring_says_the_distance_and_changes_nothing() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.tool(ToolKind::Measure);
    script.drag(DVec2::new(100.0, 100.0), DVec2::new(400.0, 500.0));
    let length = 500.0 * script.editor.view().viewport().pixel();
    let hint = script.editor.hint();
    let first = hint.split_whitespace().nth(1);
    let told: f64 = first.and_then(|it| it.parse().ok()).expect("a figure");
    // Eight digits are told.
    assert!((told - length).abs() <= 0.5e-7 * length, "{hint}");
    assert_eq!(script.polygon(), before);
    assert!(!script.editor.workspace().is_modified());
}
