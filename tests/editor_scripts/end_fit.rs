//! The end-fit tool.

use batten::editor::{Command, EndFitAction, Input, Key, Layer, Mark, ToolKind};
use batten::geometry::end_correction::EndOverlap;
use batten::geometry::features::{Feature, Features};
use batten::geometry::{End, FloatPolygon};
use glam::{DVec2, DVec3};

use super::script::Script;

#[test]
fn the_end_follows_its_target_by_dragging_the_body_and_the_ring() {
    let mut script = Script::example("s-curve");
    script.tool(ToolKind::EndFit);
    let end = script.polygon().end_jet(End::Finish);
    let goal = end.point + DVec3::new(0.5, 0.25, 0.0) * script.polygon().size() * 0.1;
    let direction = DVec2::from_angle(0.2)
        .rotate(end.first.truncate())
        .extend(0.0);
    script.end_fit_action(EndFitAction::SetPoint(goal));
    script.end_fit_action(EndFitAction::SetDirection(Some(direction)));
    let steps = script.steps();
    let viewport = *script.editor.view().viewport();
    // The body is taken by a terminal vertex and let go a few points beside the target.
    let last = script.polygon().vertices().len() - 1;
    let way = (goal - end.point).truncate() * viewport.scale;
    let from = script.at_vertex(last);
    script.drag(from, from + DVec2::new(way.x, -way.y) + 3.0);
    let report = script.end_fit().expect("figures");
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
    let report = script.end_fit().expect("figures");
    assert!(report.angle.abs() < 1e-12, "{}", report.angle);
    assert!(report.difference.length() < 1e-12 * script.polygon().size());
    assert_eq!(script.steps(), steps + 2);
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
        script.end_fit_action(EndFitAction::Choose(end));
        let jet = script.polygon().end_jet(end);
        let point = jet.point + DVec3::new(0.3, -0.2, 0.0);
        script.end_fit_action(EndFitAction::SetPoint(point));
        let direction = DVec2::from_angle(0.1)
            .rotate(jet.first.truncate())
            .extend(0.0);
        script.end_fit_action(EndFitAction::SetDirection(Some(direction)));
    }
    let before = script.polygon();
    let refused = script.editor.end_fit_action(EndFitAction::Repeat);
    assert_eq!(script.polygon(), before);
    let report = script.end_fit().expect("figures");
    assert_eq!(report.overlap, EndOverlap::OneSegment);
    let refusal = refused.expect_err("a refusal");
    assert_eq!(report.outcome, Some(Err(refusal.clone())));
    let text = refusal.to_string();
    assert!(text.contains("not reached, nothing is changed"), "{text}");
    assert!(text.contains("missed by"), "{text}");
    assert!(text.contains("one segment"), "{text}");
    script.end_fit_action(EndFitAction::BothAtOnce);
    let report = script.end_fit().expect("figures");
    assert!(report.within, "{report:?}");
    assert!(
        report.remaining_distance <= 1e-12 * before.size() && report.remaining_angle <= 1e-12,
        "{report:?}"
    );
    assert!(
        report
            .largest_move
            .is_some_and(|largest| largest.distance > 0.0)
    );
    assert!(!script.scene().ghost.curve.is_empty());
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
    assert!(script.scene().ghost.curve.is_empty());
}

#[test]
fn a_target_is_picked_from_another_curves_end() {
    let mut script = Script::example("arc");
    script.command(Command::Duplicate);
    let curves: Vec<_> = script.editor.document().ids().collect();
    let other = script.polygon().end_jet(End::Start);
    script.editor.activate(curves[0]);
    script.tool(ToolKind::EndFit);
    script.end_fit_action(EndFitAction::Choose(End::Start));
    script.end_fit_action(EndFitAction::PickFromCurve);
    let place = script
        .editor
        .view()
        .viewport()
        .to_screen(other.point.truncate());
    script.click(place);
    let report = script.end_fit().expect("figures");
    assert_eq!(report.target.map(|target| target.point), Some(other.point));
    // Two starts run towards each other: this one is to leave where the other arrives.
    let along = other.tangent().expect("a tangent");
    assert_eq!(report.target_direction(), Some(-along));
    assert!(!report.picking);
    script.end_fit_action(EndFitAction::TurnRound);
    let report = script.end_fit().expect("figures");
    assert_eq!(report.target_direction(), Some(along));
}

#[test]
fn showing_the_closed_polygon_ends_with_the_tool() {
    let mut script = Script::example("arc");
    script.tool(ToolKind::EndFit);
    script.end_fit_action(EndFitAction::ShowClosed(true));
    assert!(!script.editor.sight().layers().shows(Layer::Float));
    assert!(script.editor.view().layers.shows(Layer::Float));
    script.tool(ToolKind::Select);
    assert!(script.editor.sight().layers().shows(Layer::Float));
}

#[test]
fn a_target_that_no_file_could_hold_is_refused() {
    let mut script = Script::example("arc");
    script.tool(ToolKind::EndFit);
    for point in [DVec3::new(1e300, 0.0, 0.0), DVec3::new(0.0, f64::NAN, 0.0)] {
        let refused = script.editor.end_fit_action(EndFitAction::SetPoint(point));
        let refusal = refused.expect_err("a refusal");
        let report = script.end_fit().expect("figures");
        assert_eq!(report.target, None);
        assert_eq!(report.outcome, Some(Err(refusal.clone())));
        assert!(refusal.to_string().contains("up to 1e100"), "{refusal}");
    }
    assert!(!script.editor.workspace().is_modified());
}

#[test]
fn steps_by_hand_count_as_passes_and_meet_the_target() {
    let mut script = Script::example("hull");
    script.tool(ToolKind::EndFit);
    let jet = script.polygon().end_jet(End::Finish);
    let size = script.polygon().size();
    script.end_fit_action(EndFitAction::SetPoint(
        jet.point + DVec3::new(0.01 * size, 0.02 * size, 0.0),
    ));
    let direction = DVec2::from_angle(0.1)
        .rotate(jet.first.truncate())
        .extend(0.0);
    script.end_fit_action(EndFitAction::SetDirection(Some(direction)));
    script.end_fit_action(EndFitAction::Translate);
    script.end_fit_action(EndFitAction::Rotate);
    let report = script.end_fit().expect("figures");
    assert_eq!(report.passes, 1);
    assert!(
        report.within
            && report.remaining_distance <= 1e-12 * size
            && report.remaining_angle <= 1e-12,
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
fn a_dragged_target_is_not_held_by_its_own_old_place() {
    let mut script = Script::example("hull");
    script.tool(ToolKind::EndFit);
    let end = script.polygon().end_jet(End::Finish).point;
    let view = *script.editor.view().viewport();
    let target = view.to_model(view.to_screen(end.truncate()) + DVec2::new(63.0, 77.0));
    script.end_fit_action(EndFitAction::SetPoint(target.extend(0.0)));
    script.command(Command::ToggleSnapping);
    // Off the grid, and nearer to the old place than snapping reaches.
    script.input(Input::Zoomed {
        at: view.to_screen(target),
        factor: 1.37,
    });
    let from = script.editor.view().viewport().to_screen(target);
    script.drag(from, from + DVec2::new(6.0, 0.0));
    let moved = script.end_fit().and_then(|report| report.target);
    let moved = moved.map(|target| target.point);
    assert_ne!(moved, Some(target.extend(0.0)));
}

#[test]
fn a_turned_end_tells_what_it_adds() {
    for (turn, adds) in [(0.01_f64, false), (30.0, true)] {
        let mut script = Script::example("s-curve");
        script.tool(ToolKind::EndFit);
        let end = script.polygon().end_jet(End::Finish).point.truncate();
        let centre = script.editor.view().viewport().to_screen(end);
        let on_ring = |angle: f64| centre + 40.0 * DVec2::new(angle.cos(), -angle.sin());
        let start = clear_of_handles(&mut script, &on_ring);
        let [from, to] = [start, start + turn.to_radians()].map(on_ring);
        let count = |script: &mut Script| {
            let features = Features::proved(&script.polygon(), |_| true).expect("nobody cancels");
            features.count(Feature::CurvatureExtremum) + features.count(Feature::Inflection)
        };
        let before = count(&mut script);
        script.press(from);
        script.move_to(to);
        let marks = script.scene().marks.clone();
        let is_told = |mark: &Mark| matches!(mark, Mark::Label(_, text) if text.contains("extrem"));
        assert_eq!(marks.iter().any(is_told), adds, "{marks:?}");
        script.release(to);
        assert_eq!(count(&mut script) > before, adds);
        let message = script
            .editor
            .message()
            .map(|it| it.text.clone())
            .unwrap_or_default();
        assert_eq!(message.contains("by this drag"), adds, "{message}");
    }
}

#[test]
fn the_ring_snaps_to_the_target_direction_across_a_half_turn() {
    for sense in [1.0, -1.0] {
        let mut script = Script::example("s-curve");
        script.tool(ToolKind::EndFit);
        let end = script.polygon().end_jet(End::Finish);
        script.end_fit_action(EndFitAction::TargetActual);
        // Half a turn, less a little: reached from the other side it is more than half a turn.
        let turn = sense * 179.5_f64.to_radians();
        let direction = DVec2::from_angle(turn).rotate(end.first.truncate());
        script.end_fit_action(EndFitAction::SetDirection(Some(direction.extend(0.0))));
        let centre = script
            .editor
            .view()
            .viewport()
            .to_screen(end.point.truncate());
        let on_ring = |angle: f64| centre + 40.0 * DVec2::new(angle.cos(), -angle.sin());
        let start = clear_of_handles(&mut script, &on_ring);
        let past = start + turn + sense * 1.0_f64.to_radians();
        script.drag(on_ring(start), on_ring(past));
        let report = script.end_fit().expect("figures");
        assert!(report.angle.abs() < 1e-12, "{}", report.angle);
    }
}

#[test]
fn on_the_ring_the_ring_is_taken_although_a_vertex_lies_there() {
    let mut script = Script::example("hull");
    script.tool(ToolKind::EndFit);
    let end = script.polygon().end_jet(End::Finish).point.truncate();
    let centre = script.editor.view().viewport().to_screen(end);
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
fn the_panel_calls_off_a_drag_instead_of_keeping_half_of_it() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    let at = script.at_vertex(3);
    script.press(at);
    script.move_to(at + 30.0);
    assert_ne!(script.polygon(), before);
    script.end_fit_action(EndFitAction::TargetActual);
    assert!(!script.editor.hand().is_dragging());
    script.move_to(at + 60.0);
    script.release(at + 60.0);
    assert_eq!(script.polygon(), before);
    assert_eq!(script.steps(), 1);
}

#[test]
fn a_joint_correction_that_warns_is_shown_before_it_is_applied() {
    for applies in [true, false] {
        let mut script = Script::example("s-curve");
        script.tool(ToolKind::EndFit);
        script.end_fit_action(EndFitAction::Choose(End::Finish));
        let jet = script.polygon().end_jet(End::Finish);
        let point = jet.point + DVec3::new(0.3, -0.2, 0.0);
        script.end_fit_action(EndFitAction::SetPoint(point));
        // Turned back the curve makes a hook.
        script.end_fit_action(EndFitAction::SetDirection(Some(-jet.first)));
        let (before, steps) = (script.polygon(), script.steps());
        let note = script.editor.end_fit_action(EndFitAction::BothAtOnce);
        let note = note.expect("a preview");
        assert!(
            note.warns && note.text.starts_with("Not applied yet"),
            "{note:?}"
        );
        assert_eq!(script.steps(), steps);
        let previewed = script.editor.previewed_operation().expect("a preview");
        assert!(!previewed.report().expect("a report").warnings.is_empty());
        if applies {
            script.editor.operating().apply().expect("it is seen now");
            assert_eq!(script.steps(), steps + 1);
            let report = script.end_fit().expect("figures");
            assert!(report.within, "{report:?}");
            assert!(matches!(report.outcome, Some(Ok(note)) if note.warns));
            script.command(Command::Undo);
        } else {
            script.key(Key::Escape);
            assert!(script.editor.previewed_operation().is_none());
            assert_eq!(script.steps(), steps);
        }
        assert_eq!(script.polygon(), before);
    }
}

#[test]
fn a_step_by_button_says_that_it_moves_the_other_end() {
    // Of degree 5, nine vertices: both ends share one; with ten they share none.
    for (count, shares) in [(9, true), (10, false)] {
        let mut script = Script::example("s-curve");
        let points: Vec<_> = (0..count)
            .map(|index| {
                let x = 12.0 * f64::from(index) - 48.0;
                (x, -0.01 * x * x)
            })
            .collect();
        script.set_polygon(FloatPolygon::planar(5, &points).expect("a polygon"));
        script.tool(ToolKind::EndFit);
        script.end_fit_action(EndFitAction::Choose(End::Finish));
        let end = script.polygon().end_jet(End::Finish).point;
        script.end_fit_action(EndFitAction::SetPoint(end + DVec3::X));
        let start = script.polygon().end_jet(End::Start).point;
        script.end_fit_action(EndFitAction::Translate);
        let moves = script.polygon().end_jet(End::Start).point != start;
        assert_eq!(moves, shares);
        let report = script.end_fit().expect("figures");
        let Some(Ok(note)) = report.outcome else {
            panic!("{:?}", report.outcome);
        };
        // Without it the note may warn of the features that the step adds.
        assert!(note.warns || !shares, "{note:?}");
        assert_eq!(note.text.contains("The start moves by"), shares, "{note:?}");
    }
}

#[test]
fn the_result_at_one_end_is_not_shown_at_the_other() {
    let mut script = Script::example("s-curve");
    script.tool(ToolKind::EndFit);
    script.end_fit_action(EndFitAction::Choose(End::Finish));
    script.end_fit_action(EndFitAction::TargetActual);
    script.end_fit_action(EndFitAction::Choose(End::Start));
    script.end_fit_action(EndFitAction::SetPoint(DVec3::new(-60.0, 0.0, 0.0)));
    script.end_fit_action(EndFitAction::Translate);
    let outcome = |script: &mut Script| script.end_fit().expect("figures").outcome;
    assert!(outcome(&mut script).is_some());
    script.end_fit_action(EndFitAction::Choose(End::Finish));
    assert_eq!(outcome(&mut script), None);
    script.end_fit_action(EndFitAction::Choose(End::Start));
    assert!(outcome(&mut script).is_some());
    // What corrects all ends is told at each.
    script.end_fit_action(EndFitAction::SetPoint(DVec3::new(-61.0, 0.0, 0.0)));
    script.end_fit_action(EndFitAction::Repeat);
    script.end_fit_action(EndFitAction::Choose(End::Finish));
    assert!(outcome(&mut script).is_some());
}
