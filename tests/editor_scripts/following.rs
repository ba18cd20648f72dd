//! Drags with neighbours that follow.

use batten::editor::{Command, Follow, Input, Key, Modifiers};
use batten::geometry::End;
use glam::DVec2;

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
                script.editor.is_checked(Command::Follow(follow)),
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
        script.editor.is_checked(Command::Follow(Follow::Softly)),
        Some(false)
    );
    script.command(Command::Follow(Follow::InHarmony));
    assert_eq!(script.editor.hand().following().words(), None);
}
