//! Drags of the curve itself and of closed vertices: the float S-polygon follows with the least change.

use batten::document::Edit;
use batten::editor::{Command, Editor, Follow, Input, Key};
use batten::geometry::{ClampedPolygon, Continuity, End, FloatPolygon};
use glam::{DVec2, DVec3};

use super::common::matched;
use super::script::Script;

const BY: DVec2 = DVec2::new(9.0, -14.0);

/// How exactly a dragged point follows the pointer, in screen points.
const FOLLOWED: f64 = 1e-6;

fn on_canvas(script: &Script, point: DVec3) -> DVec2 {
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(point))
}

fn at_closed(script: &Script, index: usize) -> DVec2 {
    let clamped = ClampedPolygon::from_float(&script.polygon());
    on_canvas(script, clamped.vertices()[index])
}

/// A place on the curve that a press takes, away from vertices and legs, near a share of it.
fn place_on_curve(script: &Script, share: f64) -> (f64, DVec2) {
    let polygon = script.polygon();
    let last = polygon.segments() as f64;
    let float: Vec<DVec2> = (0..polygon.vertices().len())
        .map(|index| script.at_vertex(index))
        .collect();
    let closed: Vec<DVec2> = match polygon.is_periodic() {
        true => Vec::new(),
        false => {
            let closed = ClampedPolygon::from_float(&polygon);
            let closed = closed.vertices().iter();
            closed.map(|vertex| on_canvas(script, *vertex)).collect()
        }
    };
    let clear = |u: &f64| {
        let at = on_canvas(script, polygon.point(*u));
        let on_canvas = at.cmpgt(DVec2::ZERO).all() && at.cmplt(DVec2::new(1000.0, 700.0)).all();
        on_canvas
            && float.iter().all(|vertex| vertex.distance(at) > 8.5)
            && closed.iter().all(|vertex| vertex.distance(at) > 8.5)
    };
    let places = (1..400).map(|step| (share + f64::from(step) * 0.0025).fract() * last);
    let u = places.into_iter().find(clear).expect("a clear place");
    (u, on_canvas(script, polygon.point(u)))
}

fn moved(before: &FloatPolygon, after: &FloatPolygon) -> usize {
    let pairs = before.vertices().iter().zip(after.vertices());
    pairs.filter(|(before, after)| before != after).count()
}

fn keeps_ends(before: &FloatPolygon, after: &FloatPolygon) {
    for end in End::BOTH {
        let [a, b] = [before, after].map(|polygon| polygon.end_jet(end));
        assert!(a.point.distance(b.point) <= 1e-12 * before.size());
        let turned = a.first.normalize().cross(b.first.normalize()).length();
        assert!(turned <= 1e-9, "{turned:e}");
    }
}

#[test]
fn a_point_of_the_curve_follows_the_pointer_in_one_step() {
    for (name, share) in [
        ("bottle", 0.4),
        ("s-curve", 0.5),
        ("periodic", 0.2),
        ("arc", 0.5),
        ("hull", 0.5),
    ] {
        let mut script = Script::example(name);
        let before = script.polygon();
        let (_, at) = place_on_curve(&script, share);
        script.press(at);
        script.move_to(at + BY);
        let during = script.polygon();
        assert_ne!(during, before, "{name}");
        script.release(at + BY);
        let after = script.polygon();
        assert_eq!((script.steps(), &during), (1, &after), "{name}");
        let reached = nearest(&script, &after, at + BY);
        assert!(reached <= 0.05, "{name}: {reached}");
        assert!(moved(&before, &after) <= before.degree() + 3, "{name}");
        if !before.is_periodic() {
            keeps_ends(&before, &after);
        }
        script.command(Command::Undo);
        assert_eq!(script.polygon(), before, "{name}");
        script.command(Command::Redo);
        assert_eq!(script.polygon(), after, "{name}");
    }
}

/// How far the curve passes by a place on the canvas, in screen points.
fn nearest(script: &Script, polygon: &FloatPolygon, place: DVec2) -> f64 {
    let last = polygon.segments() as f64;
    let places = (0..=20_000).map(|step| f64::from(step) / 20_000.0 * last);
    let off = places.map(|u| on_canvas(script, polygon.point(u)).distance(place));
    off.fold(f64::INFINITY, f64::min)
}

#[test]
fn no_drag_and_escape_change_nothing_and_a_click_selects() {
    let mut script = Script::example("bottle");
    let before = script.polygon();
    let (_, at) = place_on_curve(&script, 0.4);
    script.click(at);
    assert_eq!((script.polygon(), script.steps()), (before.clone(), 0));
    script.press(at);
    script.move_to(at + BY);
    script.move_to(at);
    assert_eq!(script.polygon(), before, "back at the start");
    script.move_to(at + BY);
    script.key(Key::Escape);
    assert_eq!(script.polygon(), before);
    script.release(at);
    script.command(Command::ToggleLocked);
    script.drag(at, at + BY);
    assert_eq!(script.polygon(), before);
    assert!(script.message().contains("locked"), "{}", script.message());
}

#[test]
fn the_wheel_lets_more_vertices_follow_a_point() {
    let mut script = Script::example("bottle");
    let before = script.polygon();
    let (_, at) = place_on_curve(&script, 0.4);
    script.press(at);
    script.move_to(at + BY);
    let few = moved(&before, &script.polygon());
    let at = at + BY;
    for _ in 0..6 {
        script.input(Input::Zoomed { at, factor: 1.5 });
    }
    assert!(moved(&before, &script.polygon()) > few);
    assert!(script.editor.hint().contains("the wheel sets how many"));
    script.release(at);
}

#[test]
fn locked_vertices_stay_where_the_curve_is_dragged() {
    let mut script = Script::example("bottle");
    let before = script.polygon();
    let (u, at) = place_on_curve(&script, 0.4);
    let locked = u as usize + 2;
    let lock = Edit::SetVerticesLocked {
        curve: script.curve(),
        vertices: vec![locked],
        locked: true,
    };
    script.editor.apply("lock", vec![lock]).expect("an edit");
    script.drag(at, at + BY);
    let after = script.polygon();
    assert_ne!(after, before);
    assert_eq!(after.vertex(locked), before.vertex(locked));
}

#[test]
fn a_press_beside_an_end_takes_the_end() {
    let mut script = Script::example("arc");
    let points = [
        (0.0, 0.0),
        (10.0, 30.0),
        (20.0, 0.0),
        (30.0, 30.0),
        (40.0, 0.0),
        (50.0, 30.0),
    ];
    script.set_polygon(FloatPolygon::planar(3, &points).expect("a polygon"));
    script.editor.look(batten::editor::Look::All);
    script.command(Command::ToggleLayer(batten::editor::Layer::Clamped));
    let before = script.polygon();
    let at = on_canvas(&script, before.point(0.02));
    script.drag(at, at + BY);
    let after = script.polygon();
    let [old, new] = [&before, &after].map(|it| it.end_jet(End::Start));
    let way = on_canvas(&script, new.point) - on_canvas(&script, old.point);
    assert!(way.distance(BY) <= FOLLOWED, "{way}");
    let turned = old.first.normalize().cross(new.first.normalize()).length();
    assert!(turned <= 1e-9, "{turned:e}");
}

#[test]
fn closed_vertices_are_handles_unless_the_others_stay() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    let at = at_closed(&script, 0);
    script.drag(at, at + BY);
    let after = script.polygon();
    assert!(at_closed(&script, 0).distance(at + BY) <= FOLLOWED);
    let farthest = before.vertices().iter().zip(after.vertices());
    let farthest = farthest.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    let way = BY.length() * script.editor.view().viewport().pixel();
    assert!(farthest < 10.0 * way, "{farthest} for {way}");
    script.command(Command::Undo);

    script.command(Command::ToggleClosedFollow);
    assert_eq!(
        Command::ToggleClosedFollow.is_checked(&script.editor),
        Some(false)
    );
    let closed = ClampedPolygon::from_float(&before);
    script.drag(at, at + BY);
    let stayed = ClampedPolygon::from_float(&script.polygon());
    for (index, (a, b)) in closed.vertices().iter().zip(stayed.vertices()).enumerate() {
        assert!(
            index == 0 || a.distance(*b) <= 1e-12 * before.size(),
            "{index}"
        );
    }
}

#[test]
fn a_press_on_an_end_takes_it_and_not_a_vertex_beside_it() {
    let mut script = Script::example("arc");
    let viewport = *script.editor.view().viewport();
    // The end lies 6 points from the second vertex.
    let places = [
        (300, 282),
        (400, 300),
        (500, 282),
        (600, 330),
        (700, 420),
        (750, 520),
    ];
    let vertices = places.map(|(x, y)| {
        let place = viewport.to_model(DVec2::new(f64::from(x), f64::from(y)));
        (place.x, place.y)
    });
    script.set_polygon(FloatPolygon::planar(3, &vertices).expect("a polygon"));
    let before = script.polygon();
    let (end, vertex) = (at_closed(&script, 0), script.at_vertex(1));
    assert!((end.distance(vertex) - 6.0).abs() < 1e-6);
    script.drag(end, end + BY);
    assert!(at_closed(&script, 0).distance(end + BY) <= FOLLOWED);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
    script.drag(vertex, vertex + BY);
    assert!(script.at_vertex(1).distance(vertex + BY) <= FOLLOWED);
    assert_eq!(moved(&before, &script.polygon()), 1);
}

#[test]
fn live_harmony_begins_where_the_curve_is() {
    // The neighbours reach both ends.
    let mut script = Script::example("arc");
    script.command(Command::Follow(Follow::InHarmony));
    let before = script.polygon();
    let at = script.at_vertex(3);
    let far = |script: &mut Script, by: DVec2| {
        script.press(at);
        script.move_to(at + BY);
        script.move_to(at + by);
        let after = script.polygon();
        script.key(Key::Escape);
        script.release(at);
        let pairs = before.vertices().iter().zip(after.vertices());
        pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
    };
    assert_eq!(far(&mut script, DVec2::ZERO), 0.0);
    let pixel = script.editor.view().viewport().pixel();
    for step in [0.01, 0.1, 1.0] {
        let moved = far(&mut script, DVec2::new(step, 0.0));
        assert!(moved <= 20.0 * step * pixel, "{step}: {moved}");
    }
}

#[test]
fn at_a_matched_end_the_tangent_slides_and_the_end_is_held() {
    for continuity in [Continuity::G0, Continuity::G1, Continuity::G2] {
        let (document, [_, second]) = matched(continuity, 5.0);
        let mut script = Script {
            editor: Editor::with_document(document),
        };
        script.command(Command::FitAll);
        script.editor.activate(second);
        let before = script.polygon();
        let jet = before.end_jet(End::Start);
        let handle = |polygon: &FloatPolygon| ClampedPolygon::from_float(polygon).vertices()[1];
        // Up and to the right, mostly across the tangent.
        let from = at_closed(&script, 1);
        script.drag(from, from + DVec2::new(8.0, -12.0));
        let after = script.polygon();
        let now = handle(&after);
        assert!(now != handle(&before), "{continuity:?}");
        let tangent = jet.first.normalize();
        let across = (now - jet.point).cross(tangent).length();
        let end = after.end_jet(End::Start).point;
        assert!(end.distance(jet.point) <= 1e-9 * before.size());
        let slides = across <= 1e-7 * before.size();
        assert_eq!(
            slides,
            continuity != Continuity::G0,
            "{continuity:?}: {across}"
        );
        // What follows moves about as far as the handle.
        let by = now.distance(handle(&before));
        let steps = (0..=80).map(|step| f64::from(step) / 80.0 * before.segments() as f64);
        let off = steps
            .map(|u| after.point(u).distance(before.point(u)))
            .fold(0.0, f64::max);
        assert!(off <= 2.0 * by, "{continuity:?}: {off} for {by}");
        script.command(Command::Undo);
        assert_eq!(script.polygon(), before);

        let from = at_closed(&script, 0);
        script.drag(from, from + BY);
        assert_eq!(script.polygon(), before);
        assert!(
            script.message().contains("the match holds it"),
            "{}",
            script.message()
        );
    }
}

#[test]
fn a_curve_whose_vertices_are_all_selected_moves_as_a_whole() {
    let mut script = Script::example("bottle");
    let before = script.polygon();
    let (_, at) = place_on_curve(&script, 0.4);
    script.command(Command::SelectAll);
    let count = before.vertices().len();
    assert_eq!(script.selected().len(), count);
    script.drag(at, at + BY);
    let after = script.polygon();
    let pairs = before.vertices().iter().zip(after.vertices());
    let moves: Vec<DVec3> = pairs.map(|(before, after)| *after - *before).collect();
    assert!(moves[0].length() > 0.0);
    let size = before.size();
    let apart = moves.iter().map(|by| by.distance(moves[0]));
    assert!(apart.fold(0.0, f64::max) <= 1e-13 * size, "{moves:?}");
    assert_eq!((script.selected().len(), script.steps()), (count, 1));
}
