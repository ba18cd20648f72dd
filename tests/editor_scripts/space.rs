//! Views from any side: orbiting, and dragging in them.

use batten::document::{Curve, Edit};
use batten::editor::{Button, Command, HoverScene, Input, NamedView};
use batten::geometry::FloatPolygon;
use glam::{DVec2, DVec3};

use super::script::Script;

/// What a drag may be off: places on the canvas are a few hundred points from its corner.
const PLACE_TOLERANCE: f64 = 1e-12;

/// A helix of degree 4 as the only curve, seen from somewhere.
fn helix(view: NamedView) -> Script {
    let place = |i: u32| {
        let turn = 0.7 * f64::from(i);
        DVec3::new(3.0 * turn.cos(), 3.0 * turn.sin(), 0.5 * f64::from(i))
    };
    let vertices = (0..12).map(place).collect();
    let polygon = FloatPolygon::new(4, vertices, None, false).expect("a polygon");
    let mut script = Script::example("arc");
    let curve = script.editor.active().expect("a curve");
    let edits = vec![
        Edit::Remove(curve),
        Edit::Add(Box::new(Curve::new("helix", polygon))),
    ];
    script.editor.apply("Replace", edits).expect("an edit");
    script.command(Command::View(view));
    script.command(Command::FitAll);
    script
}

/// What a drag of vertex 5 moves it by.
fn dragged(script: &mut Script, by: DVec2) -> DVec3 {
    let before = script.polygon().vertex(5);
    script.drag_vertex(5, by);
    script.polygon().vertex(5) - before
}

#[test]
fn views_along_the_axes_keep_the_third_coordinate_exactly() {
    let by = DVec2::new(40.0, -25.0);
    for (view, kept) in [(NamedView::Xy, 2), (NamedView::Xz, 1), (NamedView::Yz, 0)] {
        let mut script = helix(view);
        let pixel = script.editor.view().viewport().pixel();
        let moved = dragged(&mut script, by);
        assert_eq!(moved[kept], 0.0, "{view:?}");
        let flat: Vec<f64> = (0..3).filter(|a| *a != kept).map(|a| moved[a]).collect();
        let expected = [40.0 * pixel, 25.0 * pixel];
        for (found, expected) in flat.iter().zip(expected) {
            assert!(
                (found - expected).abs() <= PLACE_TOLERANCE * 10.0,
                "{view:?}"
            );
        }
    }
}

#[test]
fn a_drag_from_a_corner_stays_in_the_view_plane_and_under_the_hand() {
    let mut script = helix(NamedView::Isometric);
    let towards = script.editor.view().viewport().orientation.towards();
    let at = script.at_vertex(5);
    let moved = dragged(&mut script, DVec2::new(40.0, -25.0));
    assert!(moved.length() > 0.0);
    assert!(moved.dot(towards).abs() <= PLACE_TOLERANCE);
    let now = script.at_vertex(5);
    assert!(now.distance(at + DVec2::new(40.0, -25.0)) <= 1e-9, "{now}");
}

#[test]
fn an_axis_key_keeps_a_drag_to_its_axis() {
    for axis in 0..3 {
        let mut script = helix(NamedView::Isometric);
        let before = script.polygon().vertex(5);
        let at = script.at_vertex(5);
        script.press(at);
        script.move_to(at + DVec2::new(30.0, -60.0));
        script.input(Input::AxisHeld(Some(axis)));
        let moved = script.polygon().vertex(5) - before;
        for other in 0..3 {
            assert_eq!(moved[other] == 0.0, other != axis, "axis {axis}: {moved}");
        }
        script.input(Input::AxisHeld(None));
        script.release(at + DVec2::new(30.0, -60.0));
    }
}

#[test]
fn a_planar_curve_stays_planar_from_a_corner_unless_it_is_moved_off() {
    let mut script = Script::example("s-curve");
    script.command(Command::View(NamedView::Isometric));
    script.drag_vertex(3, DVec2::new(40.0, -25.0));
    assert!(script.polygon().is_planar());
    let at = script.at_vertex(3);
    script.press(at);
    script.input(Input::AxisHeld(Some(2)));
    script.move_to(at + DVec2::new(0.0, -50.0));
    script.release(at + DVec2::new(0.0, -50.0));
    assert!(script.polygon().vertex(3).z > 0.0);
}

#[test]
fn the_right_button_orbits_and_named_views_come_back() {
    let mut script = helix(NamedView::Xy);
    let before = script.polygon();
    let view = *script.editor.view().viewport();
    let from = DVec2::new(400.0, 300.0);
    script.drag_with(Button::Secondary, from, from + DVec2::new(120.0, -70.0));
    assert_ne!(
        script.editor.view().viewport().orientation,
        view.orientation
    );
    assert!(script.editor.view().viewport().orientation.axes().is_none());
    assert_eq!(script.polygon(), before);
    assert_eq!(
        script.editor.workspace().history().undo_label(),
        Some("Replace")
    );
    script.command(Command::View(NamedView::Xy));
    let back = script.editor.view().viewport();
    assert_eq!(back.orientation, view.orientation);
    assert!(back.centre.distance(view.centre) <= 1e-12);
}

#[test]
fn hovering_finds_the_curve_as_it_is_seen() {
    let mut script = helix(NamedView::Isometric);
    let point = script.polygon().point(3.3);
    let viewport = *script.editor.view().viewport();
    let place = viewport.to_screen(viewport.flatten(point));
    script.move_to(place + DVec2::new(2.0, 1.0));
    let hover = script.scene().hover.clone();
    let Some(HoverScene::Curve {
        u, circle, text, ..
    }) = hover
    else {
        panic!("the curve is not found: {hover:?}");
    };
    assert!((u - 3.3).abs() < 0.05, "{u}");
    assert!(text.contains("\nz "), "{text}");
    assert!(
        circle.len() > 100,
        "the osculating circle is seen as an ellipse"
    );
}
