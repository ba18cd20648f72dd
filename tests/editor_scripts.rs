//! The editor without a window, driven by scripts of pointer and key events.

mod script;

use batten::document::Edit;
use batten::editor::{
    Button, Command, EndFitAction, HoverScene, Input, Key, Layer, Modifiers, ToolKind,
    Transformation,
};
use batten::geometry::end_correction::EndOverlap;
use batten::geometry::{End, FloatPolygon};
use glam::{DVec2, DVec3};
use script::Script;

#[test]
fn dragging_a_vertex_moves_just_that_vertex_by_the_pointers_way() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    let grabbed = script.at_vertex(3) + DVec2::new(2.0, -1.0);
    script.drag(grabbed, grabbed + DVec2::new(40.0, 25.0));
    let after = script.polygon();
    let way = DVec3::new(40.0, -25.0, 0.0) * script.editor.viewport().pixel();
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
    assert_eq!(script.editor.history().undo_steps(), 1);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
    assert!(!script.editor.is_modified());
    script.command(Command::Redo);
    assert_eq!(script.polygon(), after);
    assert!(script.editor.is_modified());
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
    assert_eq!(script.editor.history().undo_steps(), 0);
    assert!(!script.editor.is_modified());
}

#[test]
fn a_drag_that_ends_where_it_began_leaves_no_step() {
    let mut script = Script::example("arc");
    let at = script.at_vertex(4);
    script.press(at);
    script.move_to(at + 50.0);
    script.move_to(at);
    script.release(at);
    assert_eq!(script.editor.history().undo_steps(), 0);
    assert!(!script.editor.is_modified());
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
fn a_drag_does_the_same_zoomed_and_panned() {
    let way = DVec2::new(0.75, -0.5);
    let moved = |prepare: &dyn Fn(&mut Script)| {
        let mut script = Script::example("arc");
        prepare(&mut script);
        let at = script.at_vertex(5);
        let to = at + DVec2::new(way.x, -way.y) * script.editor.viewport().scale;
        script.drag(at, to);
        script.polygon().vertex(5)
    };
    let plain = moved(&|_| {});
    let zoomed = moved(&|script| {
        let at = script.at_vertex(5);
        script.input(Input::Zoomed { at, factor: 3.7 });
        script.input(Input::Panned {
            by: DVec2::new(-40.0, 13.0),
        });
    });
    assert!(plain.distance(zoomed) <= 1e-12, "{plain} against {zoomed}");
}

#[test]
fn zooming_keeps_the_place_under_the_pointer() {
    let mut script = Script::example("arc");
    let at = DVec2::new(200.0, 300.0);
    let before = script.editor.viewport().to_model(at);
    for factor in [1.7, 0.2, 40.0] {
        script.input(Input::Zoomed { at, factor });
        assert!(script.editor.viewport().to_model(at).distance(before) < 1e-10);
    }
    let scale = script.editor.viewport().scale;
    script.input(Input::Zoomed {
        at,
        factor: f64::NAN,
    });
    script.input(Input::Zoomed { at, factor: 0.0 });
    assert_eq!(script.editor.viewport().scale, scale);
}

#[test]
fn the_middle_button_and_space_push_the_view_and_change_nothing() {
    let mut script = Script::example("arc");
    let before = (script.polygon(), script.editor.viewport().centre);
    let at = script.at_vertex(4);
    script.input(Input::SpaceHeld(true));
    script.drag(at, at + DVec2::new(50.0, 0.0));
    script.input(Input::SpaceHeld(false));
    assert_eq!(script.polygon(), before.0);
    let moved = before.1 - script.editor.viewport().centre;
    assert!((moved.x * script.editor.viewport().scale - 50.0).abs() < 1e-9);
    script.drag_with(Button::Middle, at, at - DVec2::new(50.0, 0.0));
    assert!(script.editor.viewport().centre.distance(before.1) < 1e-9);
    assert_eq!(script.polygon(), before.0);
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
    script.drag(DVec2::new(1.0, 1.0), DVec2::new(999.0, 699.0));
    assert_eq!(script.selected().len(), 10);
    script.click(DVec2::new(3.0, 3.0));
    assert!(script.selected().is_empty());
}

#[test]
fn many_vertices_are_dragged_as_one_body() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.command(Command::SelectAll);
    script.drag_vertex(3, DVec2::new(20.0, 30.0));
    let way = DVec3::new(20.0, -30.0, 0.0) * script.editor.viewport().pixel();
    for (index, vertex) in script.polygon().vertices().iter().enumerate() {
        assert!(vertex.distance(before.vertex(index) + way) < 1e-12 * before.size());
    }
    assert_eq!(script.editor.history().undo_steps(), 1);
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
    let near = script.editor.viewport().to_screen(goal) + DVec2::new(2.0, -2.0);
    script.drag(script.at_vertex(5), near);
    assert_eq!(script.polygon().vertex(5).truncate(), goal);
    script.modifiers(Modifiers::CTRL);
    let near = near + DVec2::new(40.0, 0.0);
    script.drag(script.at_vertex(5), near);
    let free = script.editor.viewport().to_model(near);
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

#[test]
fn tab_cycles_through_vertices_that_overlap() {
    let mut script = Script::example("arc");
    let curve = script.curve();
    let place = script.polygon().vertex(2);
    let moves = vec![(7, place)];
    script
        .editor
        .apply("overlap", vec![Edit::MoveVertices { curve, moves }]);
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
fn the_add_tool_adds_at_the_nearer_end() {
    for (end, index) in [(0, 0), (9, 10)] {
        let mut script = Script::example("arc");
        script.tool(ToolKind::AddVertex);
        let place = script.at_vertex(end) + DVec2::new(5.0, 20.0);
        script.click(place);
        let polygon = script.polygon();
        assert_eq!(polygon.vertices().len(), 11);
        let expected = script.editor.viewport().to_model(place);
        assert!(polygon.vertex(index).truncate().distance(expected) < 1e-9);
        assert_eq!(script.editor.history().undo_steps(), 1);
    }
}

#[test]
fn the_insert_tool_splits_the_leg_under_the_pointer() {
    let mut script = Script::example("arc");
    let before = script.polygon();
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
    assert_eq!(script.editor.history().undo_steps(), 1);
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
    script.editor.set_degree(script.curve(), 5);
    script.click(script.at_vertex(4));
    assert_eq!(script.polygon().vertices().len(), 9);
}

#[test]
fn drawing_ends_with_enter_and_a_click_on_the_first_vertex_makes_it_periodic() {
    for periodic in [false, true] {
        let mut script = Script::example("arc");
        script.tool(ToolKind::Draw);
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
        assert_eq!(script.editor.tool(), ToolKind::Select);
        script.command(Command::Undo);
        assert_eq!(script.editor.document().len(), 1);
    }
}

#[test]
fn rotating_keeps_distances_and_shift_keeps_to_fifteen_degrees() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    script.tool(ToolKind::Rotate);
    script.modifiers(Modifiers::SHIFT);
    let centre = 0.5 * script.editor.viewport().size;
    script.drag(
        centre + DVec2::new(200.0, 0.0),
        centre + DVec2::new(0.0, -190.0),
    );
    let after = script.polygon();
    let leg = |polygon: &FloatPolygon| polygon.vertex(5) - polygon.vertex(0);
    let turned = leg(&before)
        .truncate()
        .angle_to(leg(&after).truncate())
        .to_degrees();
    assert!(
        (turned / 15.0 - (turned / 15.0).round()).abs() < 1e-9,
        "{turned}"
    );
    assert!(turned.abs() > 1.0);
    assert!((leg(&before).length() - leg(&after).length()).abs() < 1e-9);
    assert_eq!(script.editor.history().undo_steps(), 1);
}

#[test]
fn scaling_takes_only_the_selection_and_its_pivot_can_be_moved() {
    let mut script = Script::example("s-curve");
    script.click(script.at_vertex(0));
    script.modifiers(Modifiers::SHIFT);
    script.click(script.at_vertex(1));
    script.modifiers(Modifiers::NONE);
    script.tool(ToolKind::Scale);
    let before = script.polygon();
    let pivot = 0.5 * (script.at_vertex(0) + script.at_vertex(1));
    // The pivot goes to vertex 0, which then stays where it is.
    let fixed = script.at_vertex(0);
    script.drag(pivot, fixed);
    assert_eq!(script.polygon(), before);
    script.drag(
        fixed + DVec2::new(50.0, 0.0),
        fixed + DVec2::new(100.0, 0.0),
    );
    let after = script.polygon();
    assert!(after.vertex(0).distance(before.vertex(0)) < 1e-9 * before.size());
    let ratio =
        after.vertex(1).distance(after.vertex(0)) / before.vertex(1).distance(before.vertex(0));
    assert!((ratio - 2.0).abs() < 1e-9, "{ratio}");
    assert_eq!(after.vertex(2), before.vertex(2));
}

#[test]
fn typed_figures_rotate_and_scale_as_dragging_does() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    script.tool(ToolKind::Rotate);
    script.editor.set_pivot(Some(DVec2::ZERO));
    script
        .editor
        .transform(Transformation::Rotate(0.5_f64.to_radians()));
    let turn = DVec2::from_angle(0.5_f64.to_radians());
    for (index, vertex) in script.polygon().vertices().iter().enumerate() {
        let expected = turn.rotate(before.vertex(index).truncate());
        assert!(vertex.truncate().distance(expected) < 1e-12 * before.size());
    }
    script.tool(ToolKind::Scale);
    let pivot = script.editor.pivot().expect("a pivot");
    let turned = script.polygon();
    script.editor.transform(Transformation::Scale(2.0));
    for (index, vertex) in script.polygon().vertices().iter().enumerate() {
        let expected = pivot + 2.0 * (turned.vertex(index).truncate() - pivot);
        assert!(vertex.truncate().distance(expected) < 1e-12 * before.size());
    }
    assert_eq!(script.editor.history().undo_steps(), 2);
    // What cannot be used changes nothing.
    let scaled = script.polygon();
    script.editor.transform(Transformation::Scale(f64::NAN));
    script.editor.transform(Transformation::Scale(1e300));
    assert_eq!(script.polygon(), scaled);
    assert!(
        script.message().contains("finite numbers"),
        "{}",
        script.message()
    );
}

#[test]
fn measuring_says_the_distance_and_changes_nothing() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.tool(ToolKind::Measure);
    script.drag(DVec2::new(100.0, 100.0), DVec2::new(400.0, 500.0));
    let length = 500.0 * script.editor.viewport().pixel();
    assert!(
        script.editor.hint().starts_with(&format!("{length:.6}")),
        "{}",
        script.editor.hint()
    );
    assert_eq!(script.polygon(), before);
    assert!(!script.editor.is_modified());
}

#[test]
fn hovering_tells_of_vertices_and_of_the_curve() {
    let mut script = Script::example("arc");
    script.move_to(script.at_vertex(6));
    match script.editor.scene().hover.clone() {
        Some(HoverScene::Vertex { text, .. }) => assert!(text.starts_with("vertex 6\n"), "{text}"),
        other => panic!("{other:?}"),
    }
    let middle = script.polygon().point(0.5).truncate();
    script.move_to(script.editor.viewport().to_screen(middle));
    match script.editor.scene().hover.clone() {
        Some(HoverScene::Curve {
            u, centre, text, ..
        }) => {
            assert!((u - 0.5).abs() < 1e-6, "{u}");
            assert!(centre.expect("a centre").length() < 1e-6);
            assert!(text.contains("κ -0.112"), "{text}");
        }
        other => panic!("{other:?}"),
    }
    let readout = script.editor.readout();
    assert!((readout.u.expect("u") - 0.5).abs() < 1e-6);
}

#[test]
fn a_locked_curve_cannot_be_dragged_and_says_so() {
    let mut script = Script::example("arc");
    script.command(Command::ToggleLocked);
    let before = script.polygon();
    script.drag_vertex(3, DVec2::new(40.0, 40.0));
    assert_eq!(script.polygon(), before);
    assert!(script.message().contains("locked"), "{}", script.message());
}

#[test]
fn copy_and_paste_add_a_curve_aside_as_one_step() {
    let mut script = Script::example("arc");
    let Some(batten::editor::Request::CopyText(text)) = script.editor.execute(Command::Copy) else {
        panic!("no text was copied");
    };
    script.editor.paste_text(&text);
    assert_eq!(script.editor.document().len(), 2);
    let names: Vec<String> = script
        .editor
        .document()
        .curves()
        .map(|(_, c)| c.name.clone())
        .collect();
    assert_ne!(names[0], names[1]);
    script.command(Command::Undo);
    assert_eq!(script.editor.document().len(), 1);
    script.editor.paste_text("no curve at all");
    assert_eq!(script.editor.document().len(), 1);
    assert!(
        script
            .editor
            .message()
            .is_some_and(|message| message.is_error)
    );
}

#[test]
fn the_comb_is_scaled_by_the_tip_of_a_tooth() {
    let mut script = Script::example("arc");
    script.command(Command::ToggleLayer(Layer::Comb));
    let scene = script.editor.scene().clone();
    let teeth = &scene.curves[0].teeth;
    let tooth = teeth[teeth.len() / 2];
    let viewport = *script.editor.viewport();
    let before = script.editor.comb().scale;
    let longer = tooth[0] + 1.5 * (tooth[1] - tooth[0]);
    script.drag(viewport.to_screen(tooth[1]), viewport.to_screen(longer));
    let after = script.editor.comb().scale;
    assert!(
        (after / before - 1.5).abs() < 0.01,
        "{after} against {before}"
    );
    assert_eq!(script.editor.history().undo_steps(), 0);
}

#[test]
fn only_segments_that_depend_on_a_vertex_are_redone() {
    let mut script = Script::example("arc");
    let points: Vec<DVec3> = (0..200)
        .map(|i| {
            let i = f64::from(i);
            DVec3::new(i, (0.1 * i).sin(), 0.0)
        })
        .collect();
    let polygon = FloatPolygon::new(9, points, None, false).expect("a polygon");
    let curve = script.curve();
    script
        .editor
        .apply("long", vec![Edit::SetPolygon { curve, polygon }]);
    script.editor.scene();
    script.editor.apply(
        "move",
        vec![Edit::MoveVertices {
            curve,
            moves: vec![(100, DVec3::new(100.0, 3.0, 0.0))],
        }],
    );
    script.editor.scene();
    assert_eq!(script.editor.segments_redone(curve), Some(10));
}

#[test]
fn the_end_follows_its_target_by_dragging_the_body_and_the_ring() {
    let mut script = Script::example("s-curve");
    script.tool(ToolKind::EndFit);
    let end = script.polygon().end_jet(End::Finish);
    let goal = end.point + DVec3::new(0.5, 0.25, 0.0) * script.polygon().size() * 0.1;
    let direction = DVec2::from_angle(0.2)
        .rotate(end.first.truncate())
        .extend(0.0);
    script.editor.end_fit_action(EndFitAction::SetPoint(goal));
    script
        .editor
        .end_fit_action(EndFitAction::SetDirection(Some(direction)));
    let steps = script.editor.history().undo_steps();
    let viewport = *script.editor.viewport();
    // The body is taken by a terminal vertex and let go a few points beside the target.
    let last = script.polygon().vertices().len() - 1;
    let way = (goal - end.point).truncate() * viewport.scale;
    let from = script.at_vertex(last);
    script.drag(from, from + DVec2::new(way.x, -way.y) + 3.0);
    let report = script.editor.end_fit().expect("figures");
    assert!(
        report.difference.length() < 1e-12 * script.polygon().size(),
        "{}",
        report.difference
    );
    // The ring is turned to about the missing angle and snaps.
    let now = script.polygon().end_jet(End::Finish).point.truncate();
    let centre = viewport.to_screen(now);
    let on_ring = |angle: f64| centre + 40.0 * DVec2::new(angle.cos(), -angle.sin());
    let start = clear_of_handles(&mut script, &on_ring);
    script.drag(on_ring(start), on_ring(start + report.angle + 0.01));
    let report = script.editor.end_fit().expect("figures");
    assert!(report.angle.abs() < 1e-12, "{}", report.angle);
    assert!(report.difference.length() < 1e-12 * script.polygon().size());
    assert_eq!(script.editor.history().undo_steps(), steps + 2);
}

/// Find an angle at which the ring is not covered by another handle.
fn clear_of_handles(script: &mut Script, on_ring: &dyn Fn(f64) -> DVec2) -> f64 {
    let angles = (0..72).map(|step| f64::from(step).to_radians() * 5.0);
    let mut free = angles.filter(|angle| {
        script.move_to(on_ring(*angle));
        script.editor.hint().contains("ring")
    });
    free.next().expect("a free place on the ring")
}

#[test]
fn the_loop_stops_on_the_papers_arc_and_both_ends_at_once_correct_it() {
    let mut script = Script::example("arc");
    script.tool(ToolKind::EndFit);
    for end in End::BOTH {
        script.editor.end_fit_action(EndFitAction::Choose(end));
        let jet = script.polygon().end_jet(end);
        let point = jet.point + DVec3::new(0.3, -0.2, 0.0);
        script.editor.end_fit_action(EndFitAction::SetPoint(point));
        let direction = DVec2::from_angle(0.1)
            .rotate(jet.first.truncate())
            .extend(0.0);
        script
            .editor
            .end_fit_action(EndFitAction::SetDirection(Some(direction)));
    }
    let before = script.polygon();
    script.editor.end_fit_action(EndFitAction::Repeat);
    assert_eq!(script.polygon(), before);
    let report = script.editor.end_fit().expect("figures");
    assert_eq!(report.overlap, EndOverlap::OneSegment);
    let (text, failed) = report.outcome.expect("an outcome");
    assert!(failed && text.contains("Nothing was changed"), "{text}");
    script.editor.end_fit_action(EndFitAction::BothAtOnce);
    let report = script.editor.end_fit().expect("figures");
    assert!(report.within, "{report:?}");
    assert!(
        report.residual <= 1e-12 * before.size(),
        "{}",
        report.residual
    );
    assert!(report.largest_move.is_some_and(|(length, _)| length > 0.0));
    assert!(!script.editor.scene().ghost.is_empty());
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
    assert!(script.editor.scene().ghost.is_empty());
}

#[test]
fn a_target_is_picked_from_another_curves_end() {
    let mut script = Script::example("arc");
    script.command(Command::Duplicate);
    let curves: Vec<_> = script.editor.document().ids().collect();
    let other = script.polygon().end_jet(End::Start);
    script.editor.activate(curves[0]);
    script.tool(ToolKind::EndFit);
    script
        .editor
        .end_fit_action(EndFitAction::Choose(End::Start));
    script.editor.end_fit_action(EndFitAction::PickFromCurve);
    let place = script.editor.viewport().to_screen(other.point.truncate());
    script.click(place);
    let report = script.editor.end_fit().expect("figures");
    assert_eq!(report.target_point, Some(other.point));
    assert!(!report.picking);
}

#[test]
fn every_command_can_be_given_at_any_time() {
    for example in ["arc", "periodic"] {
        for command in Command::all(7) {
            let mut script = Script::example(example);
            script.command(command);
            script.check();
            // Also in the middle of a drag.
            let mut script = Script::example(example);
            let at = script.at_vertex(1);
            script.press(at);
            script.move_to(at + 30.0);
            script.command(command);
            script.move_to(at + 60.0);
            script.release(at + 60.0);
            script.check();
        }
    }
}

#[test]
fn commands_have_names_and_keys_of_their_own() {
    let commands = Command::all(7);
    for (index, command) in commands.iter().enumerate() {
        assert!(!command.label().is_empty() && !command.tooltip().is_empty());
        for other in &commands[index + 1..] {
            assert_ne!(command.label(), other.label());
            if let Some(shortcut) = command.shortcut() {
                assert_ne!(
                    Some(shortcut),
                    other.shortcut(),
                    "{command:?} and {other:?}"
                );
            }
        }
    }
}

#[test]
fn an_empty_document_says_what_to_do() {
    let mut script = Script::example("arc");
    script.editor.execute(Command::New);
    assert!(script.editor.document().is_empty());
    assert!(
        script.editor.hint().contains("draw"),
        "{}",
        script.editor.hint()
    );
    for tool in ToolKind::ALL {
        script.tool(tool);
        script.click(DVec2::new(300.0, 300.0));
        script.drag(DVec2::new(100.0, 100.0), DVec2::new(200.0, 200.0));
        script.key(Key::Enter);
        script.key(Key::Escape);
        script.check();
    }
}

#[test]
fn a_box_takes_nothing_of_a_hidden_polygon() {
    let mut script = Script::example("arc");
    script.command(Command::ToggleLayer(Layer::Float));
    script.drag(DVec2::new(1.0, 1.0), DVec2::new(999.0, 699.0));
    assert!(script.selected().is_empty());
}

#[test]
fn steps_by_hand_count_as_passes_and_meet_the_target() {
    let mut script = Script::example("hull");
    script.tool(ToolKind::EndFit);
    let jet = script.polygon().end_jet(End::Finish);
    let size = script.polygon().size();
    script.editor.end_fit_action(EndFitAction::SetPoint(
        jet.point + DVec3::new(0.01 * size, 0.02 * size, 0.0),
    ));
    let direction = DVec2::from_angle(0.1)
        .rotate(jet.first.truncate())
        .extend(0.0);
    script
        .editor
        .end_fit_action(EndFitAction::SetDirection(Some(direction)));
    script.editor.end_fit_action(EndFitAction::Translate);
    script.editor.end_fit_action(EndFitAction::Rotate);
    let report = script.editor.end_fit().expect("figures");
    assert_eq!(report.passes, 1);
    assert!(
        report.within && report.residual <= 1e-12 * size,
        "{report:?}"
    );
    let corrected = script.polygon().end_jet(End::Finish);
    let change = corrected.signed_curvature() / jet.signed_curvature() - 1.0;
    assert!(
        change.abs() < 1e-9,
        "the end's curvature changed by {change}"
    );
}

#[test]
fn on_the_ring_the_ring_is_taken_although_a_vertex_lies_there() {
    let mut script = Script::example("hull");
    script.tool(ToolKind::EndFit);
    let end = script.polygon().end_jet(End::Finish).point.truncate();
    let centre = script.editor.viewport().to_screen(end);
    // Zoom about the end until a terminal vertex lies on the ring.
    let last = script.polygon().vertices().len() - 1;
    let reach = script.at_vertex(last).distance(centre);
    script.input(Input::Zoomed {
        at: centre,
        factor: 40.0 / reach,
    });
    script.move_to(script.at_vertex(last));
    assert!(
        script.editor.hint().contains("ring"),
        "{}",
        script.editor.hint()
    );
}

#[test]
fn several_files_open_as_one_document_and_a_bad_one_changes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut script = Script::example("arc");
    let paths = ["a", "b"].map(|name| folder.path().join(format!("{name}.batten")));
    for path in &paths {
        assert!(script.editor.save(path), "{}", script.message());
    }
    let mut editor = batten::editor::Editor::new();
    editor.open_all(&paths).expect("two files");
    assert_eq!(editor.document().len(), 2);
    assert_eq!(editor.path(), None);
    editor.open_all(&paths[..1]).expect("a file");
    assert_eq!(editor.path(), Some(paths[0].as_path()));
    let missing = folder.path().join("missing.batten");
    let error = editor
        .open_all(&[paths[1].clone(), missing])
        .expect_err("a missing file");
    assert!(error.to_string().contains("missing.batten"), "{error}");
    assert_eq!(editor.path(), Some(paths[0].as_path()));
}
