//! Selecting and moving vertices.

use batten::document::Edit;
use batten::editor::{Command, Key, Layer, Modifiers};
use glam::{DVec2, DVec3};

use super::script::Script;

#[test]
fn dragging_a_vertex_moves_just_that_vertex_by_the_pointers_way() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    let grabbed = script.at_vertex(3) + DVec2::new(2.0, -1.0);
    script.drag(grabbed, grabbed + DVec2::new(40.0, 25.0));
    let after = script.polygon();
    let way = DVec3::new(40.0, -25.0, 0.0) * script.editor.view().viewport().pixel();
    for (index, vertex) in after.vertices().iter().enumerate() {
        let expected = before.vertex(index) + if index == 3 { way } else { DVec3::ZERO };
        assert!(
            vertex.distance(expected) <= 1e-12 * before.size(),
            "vertex {index}"
        );
    }
}

#[test]
fn one_drag_is_one_step_and_undo_and_redo_are_exact() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    script.drag_vertex(2, DVec2::new(31.0, 17.0));
    let after = script.polygon();
    assert_ne!(before, after);
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
    assert!(!script.editor.workspace().is_modified());
    script.command(Command::Redo);
    assert_eq!(script.polygon(), after);
    assert!(script.editor.workspace().is_modified());
}

#[test]
fn escape_in_mid_drag_restores_bit_for_bit_and_leaves_no_step() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    let at = script.at_vertex(4);
    script.press(at);
    script.move_to(at + DVec2::new(60.0, 10.0));
    assert_ne!(script.polygon(), before);
    script.key(Key::Escape);
    assert_eq!(script.polygon(), before);
    script.move_to(at + DVec2::new(90.0, 10.0));
    script.release(at + DVec2::new(90.0, 10.0));
    assert_eq!(script.polygon(), before);
    assert_eq!(script.steps(), 0);
    assert!(!script.editor.workspace().is_modified());
}

#[test]
fn a_drag_that_ends_where_it_began_leaves_no_step() {
    let mut script = Script::example("arc");
    let at = script.at_vertex(4);
    script.press(at);
    script.move_to(at + 50.0);
    script.move_to(at);
    script.release(at);
    assert_eq!(script.steps(), 0);
    assert!(!script.editor.workspace().is_modified());
}

#[test]
fn a_shaky_click_moves_nothing_and_selects() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    let at = script.at_vertex(4);
    script.drag(at, at + DVec2::new(2.0, 0.0));
    assert_eq!(script.polygon(), before);
    assert_eq!(script.selected(), [4]);
}

#[test]
fn shift_adds_to_the_selection_and_a_box_takes_what_is_inside() {
    let mut script = Script::example("arc");
    script.click(script.at_vertex(0));
    script.modifiers(Modifiers::SHIFT);
    script.click(script.at_vertex(2));
    assert_eq!(script.selected(), [0, 2]);
    script.click(script.at_vertex(0));
    assert_eq!(script.selected(), [2]);
    script.modifiers(Modifiers::NONE);
    // A box around the whole canvas takes everything.
    script.drag(DVec2::new(17.0, 1.0), DVec2::new(999.0, 699.0));
    assert_eq!(script.selected().len(), 10);
    script.click(DVec2::new(30.0, 3.0));
    assert!(script.selected().is_empty());
}

#[test]
fn many_vertices_are_dragged_as_one_body() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.command(Command::SelectAll);
    script.drag_vertex(3, DVec2::new(20.0, 30.0));
    let way = DVec3::new(20.0, -30.0, 0.0) * script.editor.view().viewport().pixel();
    for (index, vertex) in script.polygon().vertices().iter().enumerate() {
        assert!(vertex.distance(before.vertex(index) + way) < 1e-12 * before.size());
    }
    assert_eq!(script.steps(), 1);
}

#[test]
fn shift_keeps_a_drag_to_an_axis() {
    let mut script = Script::example("arc");
    let before = script.polygon().vertex(3);
    script.modifiers(Modifiers::SHIFT);
    let at = script.at_vertex(3);
    script.press(at);
    script.move_to(at + DVec2::new(40.0, 7.0));
    script.release(at + DVec2::new(40.0, 7.0));
    let after = script.polygon().vertex(3);
    assert_eq!(after.y, before.y);
    assert!(after.x > before.x);
}

#[test]
fn a_dragged_vertex_snaps_to_the_grid_and_control_turns_that_round() {
    let mut script = Script::example("arc");
    script.command(Command::ToggleSnapping);
    let goal = DVec2::new(4.0, 4.0);
    let near = script.editor.view().viewport().to_screen(goal) + DVec2::new(2.0, -2.0);
    script.drag(script.at_vertex(5), near);
    assert_eq!(script.polygon().vertex(5).truncate(), goal);
    script.modifiers(Modifiers::CTRL);
    let near = near + DVec2::new(40.0, 0.0);
    script.drag(script.at_vertex(5), near);
    let free = script.editor.view().viewport().to_model(near);
    assert!(script.polygon().vertex(5).truncate().distance(free) < 1e-9);
}

#[test]
fn arrow_keys_nudge_and_shift_nudges_ten_times_as_far() {
    let mut script = Script::example("arc");
    script.click(script.at_vertex(3));
    let before = script.polygon().vertex(3);
    script.key(Key::Right);
    let small = script.polygon().vertex(3).x - before.x;
    script.modifiers(Modifiers::SHIFT);
    script.key(Key::Up);
    let large = script.polygon().vertex(3).y - before.y;
    assert!(
        small > 0.0 && (large / small - 10.0).abs() < 1e-9,
        "{large} against {small}"
    );
}

/// The arc with vertex 7 where vertex 2 is.
fn overlapping() -> Script {
    let mut script = Script::example("arc");
    let curve = script.curve();
    let place = script.polygon().vertex(2);
    let moves = vec![(7, place)];
    script
        .editor
        .apply("overlap", vec![Edit::MoveVertices { curve, moves }])
        .expect("an edit");
    script
}

#[test]
fn tab_cycles_through_vertices_that_overlap() {
    let mut script = overlapping();
    let at = script.at_vertex(2);
    script.click(at);
    let first = script.selected();
    script.key(Key::Tab);
    script.press(at);
    script.release(at);
    let second = script.selected();
    assert_ne!(first, second);
    let mut both = [first, second].concat();
    both.sort_unstable();
    assert_eq!(both, [2, 7]);
}

#[test]
fn tabs_choice_survives_jitter_and_is_what_a_drag_takes() {
    let mut script = overlapping();
    let place = script.polygon().vertex(2);
    let at = script.at_vertex(2);
    script.move_to(at);
    let first = script.editor.sight().hovered_vertex();
    script.key(Key::Tab);
    let chosen = script.editor.sight().hovered_vertex().expect("a vertex");
    assert_ne!(first, Some(chosen));
    script.move_to(at + DVec2::new(1.0, 0.0));
    assert_eq!(script.editor.sight().hovered_vertex(), Some(chosen));
    script.drag(at + DVec2::new(0.0, 1.0), at + DVec2::new(40.0, 30.0));
    assert_ne!(script.polygon().vertex(chosen), place);
    assert_eq!(script.polygon().vertex(9 - chosen), place);
    assert_eq!(script.selected(), [chosen]);
}

#[test]
fn a_leg_that_is_dragged_is_what_is_selected() {
    let mut script = Script::example("arc");
    script.click(script.at_vertex(1));
    let middle = 0.5 * (script.at_vertex(5) + script.at_vertex(6));
    script.press(middle);
    script.move_to(middle + DVec2::new(0.0, 25.0));
    assert_eq!(script.selected(), [5, 6]);
    let hover = script.scene().hover.clone();
    assert_eq!(hover, None, "one vertex that does not move was told");
    script.release(middle + DVec2::new(0.0, 25.0));
}

#[test]
fn a_locked_curve_cannot_be_dragged_and_says_so() {
    let mut script = Script::example("arc");
    script.command(Command::ToggleLocked);
    let before = script.polygon();
    script.drag_vertex(3, DVec2::new(40.0, 40.0));
    assert_eq!(script.polygon(), before);
    assert!(script.message().contains("locked"), "{}", script.message());
    script.click(script.at_vertex(3));
    let hint = script.editor.hint();
    assert!(hint.contains("locked") && !hint.contains("Del"), "{hint}");
}

#[test]
fn a_box_takes_nothing_of_a_hidden_polygon() {
    let mut script = Script::example("arc");
    script.command(Command::ToggleLayer(Layer::Float));
    script.drag(DVec2::new(17.0, 1.0), DVec2::new(999.0, 699.0));
    assert!(script.selected().is_empty());
}
