//! Drags that keep features: no place of them adds any.

use batten::document::{Curve, CurveId, Document, Edit, EndMatch, MatchPlace};
use batten::editor::{Command, Editor, Input, Key, Look, Modifiers, NamedView};
use batten::geometry::features::Features;
use batten::geometry::vertex_moves::FeatureRise;
use batten::geometry::{Continuity, End, FloatPolygon};
use glam::{DVec2, DVec3};

use super::script::Script;

/// The examples and the vertices of them that are dragged.
const DRAGS: [(&str, usize); 5] = [
    ("bottle", 5),
    ("hull", 6),
    ("s-curve", 3),
    ("figure2", 4),
    ("periodic", 0),
];

fn rise(before: &FloatPolygon, after: &FloatPolygon) -> FeatureRise {
    FeatureRise::between(&Features::new(before), &Features::new(after))
}

/// The places of a wild drag about a vertex, in screen points.
fn wild() -> impl Iterator<Item = DVec2> {
    (1..=40).map(|step| {
        let turn = 0.45 * f64::from(step);
        (6.0 + 2.5 * f64::from(step)) * DVec2::from_angle(turn)
    })
}

/// Drag a vertex wildly; returns at how many places a feature was added.
fn drag_wildly(script: &mut Script, vertex: usize) -> usize {
    let before = script.polygon();
    let at = script.at_vertex(vertex);
    script.press(at);
    let mut added = 0;
    for by in wild() {
        script.move_to(at + by);
        added += usize::from(!rise(&before, &script.polygon()).is_none());
    }
    added
}

#[test]
fn every_place_of_a_kept_drag_adds_nothing_and_it_is_one_step() {
    for (name, vertex) in DRAGS {
        let mut script = Script::example(name);
        let before = script.polygon();
        assert!(drag_wildly(&mut script, vertex) > 0, "{name}: freely");
        script.key(Key::Escape);
        assert_eq!(script.polygon(), before, "{name}");
        let at = script.at_vertex(vertex);
        script.release(at);

        script.input(Input::KeepingHeld(true));
        assert_eq!(drag_wildly(&mut script, vertex), 0, "{name}: kept");
        let hint = script.editor.hint();
        assert!(hint.starts_with("Held at the last place"), "{hint}");
        let held = script.polygon();
        script.release(at + DVec2::new(200.0, 0.0));
        script.input(Input::KeepingHeld(false));
        assert_eq!((script.polygon(), script.steps()), (held, 1), "{name}");
        script.command(Command::Undo);
        assert_eq!(script.polygon(), before, "{name}: undone to the bit");
    }
}

#[test]
fn a_kept_drag_goes_where_it_is_safe_and_near_to_where_it_is_not() {
    let mut script = Script::example("hull");
    let before = script.polygon();
    script.input(Input::KeepingHeld(true));
    let at = script.at_vertex(6);
    let pixel = script.editor.view().viewport().pixel();
    script.press(at);
    // Straight up until it is held back.
    let mut last = 0.0;
    let mut step = 0;
    while script.editor.hint().starts_with("Features are kept") || step == 0 {
        step += 1;
        assert!(step < 200, "never held back");
        script.move_to(at + DVec2::new(0.0, -4.0 * f64::from(step)));
        let went = (script.polygon().vertex(6) - before.vertex(6)).y / pixel;
        assert!(went >= last, "{went} {last}");
        last = went;
    }
    let border = 4.0 * f64::from(step);
    assert!(last > border - 4.0 && last <= border, "{last} {border}");
    assert!(rise(&before, &script.polygon()).is_none());
    // Back to where it began, to the bit.
    script.move_to(at);
    assert_eq!(script.polygon(), before);
}

#[test]
fn the_switch_keeps_features_and_the_key_turns_it_round() {
    let mut script = Script::example("hull");
    script.command(Command::ToggleKeeping);
    assert_eq!(
        Command::ToggleKeeping.is_checked(&script.editor),
        Some(true)
    );
    assert_eq!(drag_wildly(&mut script, 6), 0);
    // In the middle of the drag the vertex comes to the pointer, and goes back again.
    let before = script.editor.workspace().settled().curve(script.curve());
    let before = before.expect("the curve").polygon.clone();
    script.input(Input::KeepingHeld(true));
    assert!(!rise(&before, &script.polygon()).is_none());
    script.input(Input::KeepingHeld(false));
    assert!(rise(&before, &script.polygon()).is_none());
    script.key(Key::Escape);
    assert_eq!(script.polygon(), before);
    script.command(Command::ToggleKeeping);
    let at = script.at_vertex(6);
    script.release(at);
    assert!(drag_wildly(&mut script, 6) > 0);
}

#[test]
fn several_vertices_of_several_curves_stay_together() {
    let mut script = Script::example("hull");
    let curve = script.curve();
    let polygon = script.polygon();
    let copy: Vec<DVec3> = polygon
        .vertices()
        .iter()
        .map(|v| *v + 3.0 * DVec3::Y)
        .collect();
    let copy = FloatPolygon::new(polygon.degree(), copy, None, false).expect("a polygon");
    let add = Edit::Add(Box::new(Curve::new("other", copy.clone())));
    script.editor.apply("add", vec![add]).expect("an edit");
    let mut curves = script.editor.document().ids();
    let other = curves.find(|id| *id != curve).expect("the other curve");
    drop(curves);
    script.command(Command::FitAll);
    script.editor.select_vertex(curve, 6, false);
    script.editor.select_vertex(other, 6, true);
    script.input(Input::KeepingHeld(true));
    let at = script.at_vertex_of(curve, 6);
    script.press(at);
    for by in wild() {
        script.move_to(at + by);
        let document = script.editor.document();
        let after = [curve, other].map(|id| document.curve(id).expect("a curve").polygon.clone());
        assert!(rise(&polygon, &after[0]).is_none());
        assert!(rise(&copy, &after[1]).is_none());
        let moved = [&polygon, &copy]
            .into_iter()
            .zip(&after)
            .map(|(before, after)| after.vertex(6) - before.vertex(6));
        let moved: Vec<DVec3> = moved.collect();
        assert!(moved[0].distance(moved[1]) < 1e-12 * polygon.size());
    }
    script.key(Key::Escape);
    let document = script.editor.document();
    assert_eq!(document.curve(curve).expect("a curve").polygon, polygon);
    assert_eq!(document.curve(other).expect("a curve").polygon, copy);
}

#[test]
fn a_vertex_of_the_closed_polygon_is_held_back_too() {
    let mut script = Script::example("hull");
    script.input(Input::KeepingHeld(true));
    script.command(Command::ToggleLayer(batten::editor::Layer::Float));
    let before = script.polygon();
    let clamped = script.scene().curves[0].clamped_vertices[2].at;
    let at = script.editor.view().viewport().to_screen(clamped);
    script.press(at);
    let mut moved = false;
    for by in wild() {
        script.move_to(at + by);
        moved |= script.polygon() != before;
        assert!(rise(&before, &script.polygon()).is_none());
    }
    assert!(moved);
    script.key(Key::Escape);
    assert_eq!(script.polygon(), before);
}

#[test]
fn in_space_a_kept_drag_says_that_it_is_for_planar_curves() {
    let mut script = Script::example("arc");
    let place = |i: u32| {
        let turn = 0.7 * f64::from(i);
        DVec3::new(3.0 * turn.cos(), 3.0 * turn.sin(), 0.5 * f64::from(i))
    };
    let helix = FloatPolygon::new(4, (0..9).map(place).collect(), None, false);
    script.set_polygon(helix.expect("a polygon"));
    script.command(Command::FitAll);
    let before = script.polygon();
    script.input(Input::KeepingHeld(true));
    let at = script.at_vertex(4);
    script.press(at);
    script.move_to(at + DVec2::new(30.0, 20.0));
    assert_eq!(script.polygon(), before);
    let hint = script.editor.hint();
    assert!(hint.contains("planar curves"), "{hint}");
    // Without the key it goes along.
    script.input(Input::KeepingHeld(false));
    assert_ne!(script.polygon(), before);
}

#[test]
fn a_planar_curve_is_not_pulled_out_of_its_plane() {
    let mut script = Script::example("hull");
    script.command(Command::View(NamedView::Xz));
    script.input(Input::KeepingHeld(true));
    script.input(Input::AxisHeld(Some(2)));
    let before = script.polygon();
    let at = script.at_vertex(6);
    script.press(at);
    script.move_to(at + DVec2::new(0.0, -50.0));
    assert!(script.polygon().is_planar());
    assert_eq!(script.polygon(), before);
}

#[test]
fn shift_and_snapping_hold_for_what_is_kept() {
    let mut script = Script::example("hull");
    script.input(Input::KeepingHeld(true));
    script.modifiers(Modifiers::SHIFT);
    let before = script.polygon().vertex(6);
    let at = script.at_vertex(6);
    script.press(at);
    script.move_to(at + DVec2::new(3.0, 1.0));
    let after = script.polygon().vertex(6);
    assert_eq!(after.y, before.y);
}

/// A curve, and another whose start follows its end up to a level.
fn followed(level: Continuity) -> (Script, [CurveId; 2]) {
    let curve = |name: &str, points: &[(f64, f64)]| {
        Curve::new(name, FloatPolygon::planar(4, points).expect("a polygon"))
    };
    let along = |from: f64| (0..9).map(move |i| from + 0.11 * f64::from(i));
    // Parts of a spiral, whose curvature grows.
    let spiral = |turn: f64| {
        let radius = 12.0 - 3.0 * turn;
        (radius * turn.sin(), -radius * turn.cos())
    };
    let first: Vec<_> = along(0.0).map(spiral).collect();
    let second: Vec<_> = along(0.6).map(spiral).collect();
    let curves = [curve("first", &first), curve("second", &second)];
    let document = Document::from_curves(curves);
    let ids: Vec<CurveId> = document.ids().collect();
    let mut editor = Editor::with_document(document);
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let matched = Edit::SetMatch(EndMatch {
        curve: ids[1],
        end: End::Start,
        source: ids[0],
        place: MatchPlace::End(End::Finish),
        continuity: level,
        reversed: false,
    });
    editor.apply("Match", vec![matched]).expect("a match");
    editor.activate(ids[0]);
    (Script { editor }, [ids[0], ids[1]])
}

fn polygons(script: &Script, ids: [CurveId; 2]) -> [FloatPolygon; 2] {
    ids.map(|id| {
        let curve = script.editor.document().curve(id);
        curve.expect("a curve").polygon.clone()
    })
}

#[test]
fn a_kept_drag_adds_nothing_to_a_curve_that_follows() {
    // A vertex near the end is dragged, or the whole curve, which adds nothing to itself.
    for (level, whole) in [
        (Continuity::G1, false),
        (Continuity::G2, false),
        (Continuity::G1, true),
    ] {
        let (mut script, ids) = followed(level);
        if whole {
            script.command(Command::SelectAll);
        }
        let before = polygons(&script, ids);
        let steps = script.steps();
        let at = script.at_vertex(7);
        let adds = |script: &Script| {
            let now = polygons(script, ids);
            [0, 1].map(|curve| !rise(&before[curve], &now[curve]).is_none())
        };
        let places: Vec<DVec2> = wild().map(|by| at + 0.3 * by).collect();
        script.press(at);
        let mut freely = Vec::new();
        for place in &places {
            script.move_to(*place);
            freely.push(adds(&script));
        }
        assert!(freely.iter().any(|adds| adds[1]), "{level:?} {whole}");
        assert!(!whole || freely.iter().all(|adds| !adds[0]));
        script.key(Key::Escape);
        script.release(at);
        assert_eq!(polygons(&script, ids), before);

        script.input(Input::KeepingHeld(true));
        script.press(at);
        let mut went = false;
        for (place, freely) in places.iter().zip(freely) {
            script.move_to(*place);
            assert_eq!(adds(&script), [false; 2], "{level:?} {whole}");
            went |= polygons(&script, ids) != before;
            if freely == [false, true] {
                let hint = script.editor.hint();
                assert!(hint.contains("to “second”, which follows"), "{hint}");
            }
        }
        assert!(went, "{level:?} {whole}");
        let held = polygons(&script, ids);
        script.release(at);
        assert_eq!(polygons(&script, ids), held);
        assert_eq!(script.steps(), steps + 1);
        script.command(Command::Undo);
        assert_eq!(polygons(&script, ids), before, "{level:?} {whole}");
    }
}

#[test]
fn a_nudge_that_would_add_a_feature_is_refused() {
    let mut script = Script::example("hull");
    let before = script.polygon();
    script.editor.select_vertex(script.curve(), 6, false);
    script.modifiers(Modifiers::SHIFT);
    script.command(Command::ToggleKeeping);
    let mut nudges = 0;
    while script.message().is_empty() {
        script.key(Key::Up);
        assert!(rise(&before, &script.polygon()).is_none());
        nudges += 1;
        assert!(nudges < 500, "never refused");
    }
    let message = script.message();
    assert!(
        message.starts_with("Features are kept (K): it would add to "),
        "{message}"
    );
    let (held, steps) = (script.polygon(), script.steps());
    script.key(Key::Up);
    assert_eq!((script.polygon(), script.steps()), (held.clone(), steps));
    script.command(Command::ToggleKeeping);
    script.key(Key::Up);
    assert_ne!(script.polygon(), held);
    assert!(!rise(&before, &script.polygon()).is_none());
    script.undo_all();
    assert_eq!(script.polygon(), before);
}

#[test]
fn a_coordinate_that_would_add_a_feature_is_refused() {
    let mut script = Script::example("hull");
    let (curve, before) = (script.curve(), script.polygon());
    let put = |y: f64| {
        let moves = vec![(6, DVec3::new(before.vertex(6).x, y, 0.0))];
        vec![Edit::MoveVertices { curve, moves }]
    };
    let y = before.vertex(6).y;
    let (near, far) = (y + 1e-3 * before.size(), y + 0.3 * before.size());
    script.command(Command::ToggleKeeping);
    script.editor.apply("Set y", put(far)).expect_err("refused");
    assert_eq!((script.polygon(), script.steps()), (before.clone(), 0));
    script.editor.apply("Set y", put(near)).expect("safe");
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);

    // A field that is dragged goes as far as it is safe, and says so.
    script.editor.preview("Set y", put(near));
    assert_eq!(script.polygon().vertex(6).y, near);
    script.editor.preview("Set y", put(far));
    script.check();
    assert!(rise(&before, &script.polygon()).is_none());
    assert!(script.polygon().vertex(6).y >= near);
    let message = script.message();
    assert!(message.starts_with("Held at the last place"), "{message}");
    script.editor.commit_preview();
    assert_eq!(script.steps(), 1);
    script.undo_all();
    assert_eq!(script.polygon(), before);

    script.command(Command::ToggleKeeping);
    script.editor.apply("Set y", put(far)).expect("freely");
    assert!(!rise(&before, &script.polygon()).is_none());
}
