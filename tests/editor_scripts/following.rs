//! Drags with neighbours that follow.

use batten::document::Edit;
use batten::editor::{Command, EndFitAction, Follow, Input, Key, Modifiers, ToolKind};
use batten::geometry::End;
use batten::geometry::end_correction::EndTarget;
use glam::{DVec2, DVec3};

use super::script::Script;

const BY: DVec2 = DVec2::new(12.0, -20.0);

fn held(script: &Script) -> [glam::DVec3; 4] {
    let polygon = script.polygon();
    let jets = End::BOTH.map(|end| polygon.end_jet(end));
    let tangents = jets.map(|jet| jet.tangent().expect("a tangent"));
    [jets[0].point, jets[1].point, tangents[0], tangents[1]]
}

#[test]
fn each_way_of_following_is_one_step_and_undone_to_the_bit() {
    for follow in Follow::ALL {
        for name in ["bottle", "s-curve", "periodic"] {
            let mut script = Script::example(name);
            script.command(Command::Follow(follow));
            assert_eq!(
                Command::Follow(follow).is_checked(&script.editor),
                Some(true)
            );
            let before = script.polygon();
            let vertex = before.vertices().len() / 2;
            let steps = script.steps();
            script.drag_vertex(vertex, BY);
            assert_eq!(script.steps(), steps + 1, "{name}");
            let after = script.polygon();
            let pairs = before.vertices().iter().zip(after.vertices());
            let moved = pairs.filter(|(a, b)| a != b).count();
            assert!(moved > 2, "{name}: {moved} moved");
            script.undo_all();
            assert_eq!(script.polygon(), before, "{name}");
            script.command(Command::Redo);
            assert_eq!(script.polygon(), after, "{name}");
        }
    }
}

#[test]
fn ends_are_held_while_a_neighbour_of_an_end_is_dragged_in_harmony() {
    let mut script = Script::example("bottle");
    script.command(Command::Follow(Follow::InHarmony));
    let before = held(&script);
    script.drag_vertex(3, BY);
    let size = script.polygon().size();
    for (a, b) in before.into_iter().zip(held(&script)) {
        assert!(a.distance(b) <= 1e-12 * size.max(1.0));
    }
}

#[test]
fn the_wheel_sets_how_many_follow_and_how_stiff_they_are_while_dragging() {
    let mut script = Script::example("bottle");
    script.command(Command::Follow(Follow::InHarmony));
    let before = script.polygon();
    let from = script.at_vertex(12);
    script.press(from);
    script.move_to(from + BY);
    let zoom = *script.editor.view().viewport();
    let few = script.polygon();
    let span = script.editor.hand().following().span();
    let at = from + BY;
    script.input(Input::Zoomed { at, factor: 1.5 });
    assert!(script.editor.hand().following().span() > span);
    assert_ne!(
        script.polygon(),
        few,
        "more follow under the resting pointer"
    );
    assert_eq!(*script.editor.view().viewport(), zoom, "the view stays");
    let stiffness = script.editor.hand().following().stiffness();
    script.modifiers(Modifiers::SHIFT);
    script.input(Input::Zoomed { at, factor: 1.1 });
    script.modifiers(Modifiers::NONE);
    assert!(script.editor.hand().following().stiffness() > stiffness);
    assert!(script.editor.hint().contains("the wheel sets how many"));
    script.key(Key::Escape);
    assert_eq!(script.polygon(), before);
    // Without a drag the wheel zooms.
    script.release(at);
    script.input(Input::Zoomed { at, factor: 1.5 });
    assert_ne!(*script.editor.view().viewport(), zoom);
}

#[test]
fn a_vertex_of_the_closed_polygon_lets_the_float_one_follow_in_harmony() {
    let mut script = Script::example("s-curve");
    script.command(Command::Follow(Follow::InHarmony));
    let before = script.polygon();
    let start = before.end_jet(End::Start).point.truncate();
    let from = script.editor.view().viewport().to_screen(start);
    script.drag(from, from + BY);
    let after = script.polygon();
    let moved = after.end_jet(End::Start).point.truncate();
    let reached = script.editor.view().viewport().to_screen(moved);
    assert!(reached.distance(from + BY) <= 1e-6, "{reached}");
    script.undo_all();
    assert_eq!(script.polygon(), before);
}

#[test]
fn a_way_of_following_is_turned_off_by_itself_and_by_the_other() {
    let mut script = Script::example("arc");
    script.command(Command::Follow(Follow::Softly));
    script.command(Command::Follow(Follow::InHarmony));
    assert_eq!(
        Command::Follow(Follow::Softly).is_checked(&script.editor),
        Some(false)
    );
    script.command(Command::Follow(Follow::InHarmony));
    assert_eq!(script.editor.hand().following().words(), None);
}

/// Give an end of an example a target beside it, with the end-fit tool in the hand and live harmony on.
fn with_target(name: &str, end: End) -> Script {
    let mut script = Script::example(name);
    script.tool(ToolKind::EndFit);
    script.end_fit_action(EndFitAction::Choose(end));
    let size = script.polygon().size();
    let point = script.polygon().end_jet(end).point + 0.05 * size * DVec3::new(0.3, 1.0, 0.0);
    script.end_fit_action(EndFitAction::SetPoint(point));
    script.command(Command::Follow(Follow::InHarmony));
    script
}

fn target(script: &Script, end: End) -> EndTarget {
    let curve = script.editor.document().curve(script.curve());
    let targets = curve.expect("the curve").targets;
    targets.get(end).expect("a target")
}

fn on_canvas(script: &Script, point: DVec3) -> DVec2 {
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(point))
}

/// What an end lacks of its target's point and direction, in units of the curve's size.
fn missing(script: &mut Script) -> f64 {
    let report = script.end_fit().expect("figures");
    let missing = report.missing.expect("a target");
    missing.residual(report.size) / report.size
}

#[test]
fn an_end_follows_its_target_in_harmony_in_every_frame_as_one_step() {
    for (name, end) in [
        ("bottle", End::Finish),
        ("s-curve", End::Start),
        ("arc", End::Start),
    ] {
        let mut script = with_target(name, end);
        let (before, set) = (script.polygon(), target(&script, end));
        let steps = script.steps();
        let far = script.polygon().end_jet(end.other());
        let at = on_canvas(&script, set.point);
        script.move_to(at);
        assert!(
            script.editor.hint().contains("follows it in harmony"),
            "{name}"
        );
        script.press(at);
        let mut last = before.clone();
        for step in 1..=6 {
            script.move_to(at + 0.4 * f64::from(step) * BY);
            let left = missing(&mut script);
            assert!(left <= 1e-10, "{name} {step}: {left:e}");
            assert_ne!(script.polygon(), last, "{name} {step}");
            last = script.polygon();
            let now = last.end_jet(end.other());
            let size = last.size();
            assert!(
                now.point.distance(far.point) <= 1e-12 * size,
                "{name} {step}"
            );
            let turned = now
                .tangent()
                .expect("one")
                .angle_between(far.tangent().expect("one"));
            assert!(turned <= 1e-7, "{name} {step}: {turned:e}");
        }
        script.release(at + 2.4 * BY);
        assert_eq!(script.steps(), steps + 1, "{name}");
        script.command(Command::Undo);
        assert_eq!(
            (script.polygon(), target(&script, end)),
            (before.clone(), set)
        );
        script.command(Command::Redo);
        assert_eq!(script.polygon(), last, "{name}");

        // The end lies on its target now, and still it is the target that is dragged.
        let at = on_canvas(&script, target(&script, end).point);
        script.press(at);
        script.move_to(at + BY);
        assert!(missing(&mut script) <= 1e-10, "{name}: again");
        assert_ne!(target(&script, end).point, set.point);
        script.key(Key::Escape);
        script.release(at);
        assert_eq!(script.polygon(), last, "{name}: called off to the bit");
    }
}

#[test]
fn an_end_follows_the_direction_of_its_target() {
    let mut script = with_target("bottle", End::Finish);
    let before = script.polygon();
    let pixel = script.editor.view().viewport().pixel();
    let set = target(&script, End::Finish);
    let direction = set.direction.expect("a direction");
    // Somewhere along the arrow is its tip.
    let tips = (20..120).map(|points| set.point + f64::from(points) * pixel * direction);
    let tips: Vec<DVec2> = tips.map(|tip| on_canvas(&script, tip)).collect();
    let tip = tips.into_iter().find(|tip| {
        script.press(*tip);
        script.move_to(*tip + DVec2::new(4.0, 4.0));
        let drags = target(&script, End::Finish).direction != set.direction;
        script.key(Key::Escape);
        script.release(*tip);
        drags && script.polygon() == before
    });
    let tip = tip.expect("the tip");
    let steps = script.steps();
    script.drag(tip, tip + DVec2::new(14.0, 10.0));
    assert_ne!(target(&script, End::Finish).direction, set.direction);
    assert!(missing(&mut script) <= 1e-10);
    assert_eq!(script.steps(), steps + 1);
}

#[test]
fn the_wheel_sets_how_many_follow_a_target() {
    let mut script = with_target("bottle", End::Finish);
    let at = on_canvas(&script, target(&script, End::Finish).point);
    script.press(at);
    script.move_to(at + BY);
    let (few, view) = (script.polygon(), *script.editor.view().viewport());
    let span = script.editor.hand().following().span();
    let label = script.scene().marks.len();
    assert!(label > 0, "the followers are told on the canvas");
    script.input(Input::Zoomed {
        at: at + BY,
        factor: 2.0,
    });
    assert!(script.editor.hand().following().span() > span);
    assert_ne!(script.polygon(), few);
    assert!(missing(&mut script) <= 1e-10);
    assert_eq!(*script.editor.view().viewport(), view);
    let hint = script.editor.hint();
    assert!(hint.starts_with("The end follows its target"), "{hint}");
}

#[test]
fn locked_vertices_stay_while_an_end_follows_and_a_locked_or_hidden_curve_refuses() {
    let mut script = with_target("bottle", End::Finish);
    let curve = script.curve();
    let count = script.polygon().vertices().len();
    let lock = |vertices: Vec<usize>, locked| Edit::SetVerticesLocked {
        curve,
        vertices,
        locked,
    };
    let held = vec![count - 2, count - 6];
    told_of(script.editor.apply("Lock", vec![lock(held.clone(), true)]));
    let before = script.polygon();
    let at = on_canvas(&script, target(&script, End::Finish).point);
    script.press(at);
    script.move_to(at + BY);
    assert!(missing(&mut script) <= 1e-10);
    for vertex in held {
        assert_eq!(script.polygon().vertex(vertex), before.vertex(vertex));
    }
    script.key(Key::Escape);
    script.release(at);

    // Nothing is left that could move.
    let all = (0..count).collect();
    told_of(script.editor.apply("Lock", vec![lock(all, true)]));
    let set = target(&script, End::Finish);
    script.press(at);
    script.move_to(at + BY);
    assert_eq!(script.polygon(), before);
    let message = script.message();
    assert!(message.contains("cannot follow"), "{message}");
    script.release(at + BY);
    assert_eq!(target(&script, End::Finish), set);

    script.command(Command::ToggleLocked);
    script.drag(at, at + BY);
    assert_eq!(target(&script, End::Finish), set);
    let message = script.message();
    assert!(message.contains("locked"), "{message}");
    script.command(Command::ToggleLocked);
    script.command(Command::ToggleVisible);
    script.drag(at, at + BY);
    assert_eq!(target(&script, End::Finish), set);
}

#[track_caller]
fn told_of(reply: batten::editor::Reply) {
    reply.expect("an edit");
}

#[test]
fn without_live_harmony_the_curve_stays_while_its_target_is_dragged() {
    let mut script = with_target("bottle", End::Finish);
    let before = script.polygon();
    for follow in [None, Some(Follow::Softly)] {
        // The one is turned off, and the other on.
        script.command(Command::Follow(follow.unwrap_or(Follow::InHarmony)));
        let set = target(&script, End::Finish);
        let at = on_canvas(&script, set.point);
        script.drag(at, at + BY);
        assert_ne!(target(&script, End::Finish).point, set.point);
        assert_eq!(script.polygon(), before);
    }
}
