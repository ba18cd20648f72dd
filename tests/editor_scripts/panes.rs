//! Several panes at once: they share the selection and drags, and pan and zoom alone.

use batten::document::{Curve, Document};
use batten::editor::{
    Button, Command, Editor, Input, Key, Look, NamedView, Orientation, PaneLayout, ToolKind,
    Viewport,
};
use batten::geometry::FloatPolygon;
use glam::{DVec2, DVec3};

use super::script::Script;

const CANVAS: DVec2 = DVec2::new(1002.0, 702.0);

/// A curve in space on a canvas with four panes: from above, isometric, from the front and from the right.
fn four() -> Script {
    let vertex = |index: u32| {
        let turn = 0.6 * f64::from(index);
        DVec3::new(
            3.0 * turn.cos(),
            2.0 * turn.sin(),
            f64::from(index * index) / 20.0,
        )
    };
    let vertices = (0..10).map(vertex).collect();
    let polygon = FloatPolygon::new(4, vertices, None, false).expect("a polygon");
    let curve = Curve::new("spiral", polygon);
    let mut editor = Editor::with_document(Document::from_curves([curve]));
    editor.look(Look::Canvas(CANVAS));
    let mut script = Script { editor };
    script.command(Command::Panes(PaneLayout::Four));
    script.scene();
    script
}

/// The corner and the viewport of each pane.
fn panes(script: &Script) -> Vec<(DVec2, Viewport)> {
    let panes = script.editor.view().panes();
    panes.map(|pane| (pane.corner, *pane.viewport)).collect()
}

/// Where a pane shows a point, on the canvas.
fn on_canvas(script: &Script, pane: usize, point: DVec3) -> DVec2 {
    let (corner, viewport) = panes(script)[pane];
    corner + viewport.to_screen(viewport.flatten(point))
}

fn used(script: &Script) -> usize {
    let used = script.editor.view().panes().position(|pane| pane.is_used);
    used.expect("one is used")
}

/// Where each pane draws a vertex of the curve, in its view plane.
fn drawn(script: &Script, index: usize) -> Vec<DVec2> {
    let vertices = script.editor.view().panes().map(|pane| {
        let marks = &pane.scene.curves[0].vertices;
        let mark = marks.iter().find(|mark| mark.index == index);
        mark.expect("it is drawn").at
    });
    vertices.collect()
}

/// Check that each pane draws a vertex where the document has it.
#[track_caller]
fn check_drawn(script: &mut Script, index: usize) {
    script.scene();
    let vertex = script.polygon().vertex(index);
    let seen = panes(script).into_iter().map(|(_, it)| it.flatten(vertex));
    assert_eq!(drawn(script, index), seen.collect::<Vec<_>>());
}

#[test]
fn four_panes_show_all_from_four_sides() {
    let script = four();
    let polygon = script.polygon();
    let points: Vec<DVec3> = (0..=60)
        .map(|it| polygon.point(0.1 * f64::from(it)))
        .collect();
    let sides: Vec<Orientation> = panes(&script).iter().map(|it| it.1.orientation).collect();
    use NamedView::{Isometric, Xy, Xz, Yz};
    assert_eq!(sides, [Xy, Isometric, Xz, Yz].map(NamedView::orientation));
    for (pane, (corner, viewport)) in panes(&script).into_iter().enumerate() {
        assert_eq!(viewport.size, DVec2::new(500.0, 350.0));
        for point in &points {
            let at = on_canvas(&script, pane, *point) - corner;
            assert_eq!(at, at.clamp(DVec2::ZERO, viewport.size), "pane {pane}");
        }
    }
    assert_eq!(used(&script), 0);
}

#[test]
fn a_drag_in_a_pane_moves_in_its_plane_and_shows_in_all() {
    for (pane, kept) in [(0, Some(2)), (1, None), (2, Some(1)), (3, Some(0))] {
        let mut script = four();
        let before = script.polygon().vertex(5);
        let at = on_canvas(&script, pane, before);
        let to = at + DVec2::new(30.0, -20.0);
        script.press(at);
        assert_eq!(used(&script), pane);
        script.move_to(to);
        check_drawn(&mut script, 5);
        assert_eq!(script.selected(), [5]);
        let during = script.polygon().vertex(5);
        assert!(during.distance(before) > 0.1, "pane {pane}");
        if let Some(axis) = kept {
            assert_eq!(during[axis], before[axis], "pane {pane}");
        }
        assert!(on_canvas(&script, pane, during).distance(to) < 1e-9);
        script.release(to);
        assert_eq!(script.polygon().vertex(5), during);
        script.command(Command::Undo);
        assert_eq!(script.polygon().vertex(5), before);
        check_drawn(&mut script, 5);
    }
}

#[test]
fn a_drag_stays_in_its_pane_and_escape_takes_it_back() {
    let mut script = four();
    let before = script.polygon();
    let at = on_canvas(&script, 0, before.vertex(5));
    script.press(at);
    // Over the pane below.
    let to = DVec2::new(at.x, 600.0);
    script.move_to(to);
    assert_eq!(used(&script), 0);
    let vertex = script.polygon().vertex(5);
    assert_eq!(vertex.z, before.vertex(5).z);
    assert!(on_canvas(&script, 0, vertex).distance(to) < 1e-9);
    script.key(Key::Escape);
    assert_eq!(script.polygon(), before);
    script.release(to);
    script.move_to(to);
    assert_eq!(used(&script), 2);
    check_drawn(&mut script, 5);
}

#[test]
fn a_pane_pans_zooms_and_turns_alone() {
    let mut script = four();
    let before = panes(&script);
    let at = DVec2::new(700.0, 500.0);
    script.move_to(at);
    script.input(Input::Zoomed { at, factor: 2.0 });
    script.drag_with(Button::Middle, at, at + DVec2::new(20.0, 10.0));
    let after = panes(&script);
    assert_eq!(before[..3], after[..3]);
    assert_ne!(before[3], after[3]);
    // The place under the pointer stays there.
    let model = |it: &(DVec2, Viewport), at: DVec2| it.1.to_model(at - it.0);
    let moved = model(&after[3], at + DVec2::new(20.0, 10.0));
    assert!(moved.distance(model(&before[3], at)) < 1e-9);
    script.drag_with(Button::Secondary, at, at + DVec2::new(20.0, 10.0));
    let turned = panes(&script);
    assert_eq!(before[..3], turned[..3]);
    assert_ne!(turned[3].1.orientation, after[3].1.orientation);
    // All panes show everything again, on one scale.
    script.command(Command::FitAll);
    let scales: Vec<f64> = panes(&script).iter().map(|it| it.1.scale).collect();
    assert!(scales.iter().all(|scale| *scale == scales[0]), "{scales:?}");
    script.command(Command::View(NamedView::Yz));
    script.command(Command::FitAll);
    assert_eq!(before, panes(&script));
    check_drawn(&mut script, 2);
}

#[test]
fn a_pivot_does_not_go_to_another_pane() {
    let mut script = four();
    script.command(Command::SelectAll);
    script.tool(ToolKind::Rotate);
    // After a rotation the pivot stays where it was, in its pane.
    let at = on_canvas(&script, 3, script.polygon().vertex(2));
    script.drag(at, at + DVec2::new(15.0, 20.0));
    let pivot = |script: &Script| {
        let editor = &script.editor;
        editor.hand().pivot(&editor.context()).expect("a pivot")
    };
    let turned = pivot(&script);
    script.move_to(at + DVec2::new(3.0, 2.0));
    assert_eq!(pivot(&script), turned);
    // In another one it is in the middle of what is seen there.
    script.click(DVec2::new(5.0, 690.0));
    assert_eq!(used(&script), 2);
    let (_, viewport) = panes(&script)[2];
    let vertices = script.polygon();
    let seen = vertices.vertices().iter().map(|it| viewport.flatten(*it));
    let (low, high) = seen.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), at| {
        (low.min(at), high.max(at))
    });
    assert!(pivot(&script).distance(0.5 * (low + high)) < 1e-9);
}

#[test]
fn menus_mean_the_pane_that_was_pressed_last() {
    let mut script = four();
    script.move_to(DVec2::new(700.0, 500.0));
    assert_eq!(used(&script), 3);
    script.input(Input::Left);
    assert_eq!(used(&script), 0);
    script.click(DVec2::new(520.0, 690.0));
    script.move_to(DVec2::new(700.0, 100.0));
    assert_eq!(used(&script), 1);
    script.input(Input::Left);
    assert_eq!(used(&script), 3);
    script.command(Command::View(NamedView::Xy));
    let sides: Vec<Orientation> = panes(&script).iter().map(|it| it.1.orientation).collect();
    assert_eq!(sides[3], Orientation::XY);
    assert_eq!(sides[1], Orientation::isometric());
}

#[test]
fn layouts_come_and_go_without_a_trace() {
    let mut script = four();
    let comb = script.editor.view().comb();
    let before = script.polygon();
    for (layout, count) in [
        (PaneLayout::Two, 2),
        (PaneLayout::Four, 4),
        (PaneLayout::One, 1),
        (PaneLayout::Two, 2),
        (PaneLayout::One, 1),
    ] {
        script.command(Command::Panes(layout));
        check_drawn(&mut script, 3);
        let panes = panes(&script);
        assert_eq!(panes.len(), count);
        // The view that was there stays in its place of the layout.
        assert!(panes.iter().any(|it| it.1.orientation == Orientation::XY));
        assert_eq!(script.editor.view().comb(), comb);
        let sum: f64 = panes.iter().map(|it| it.1.size.x * it.1.size.y).sum();
        assert!(sum > 0.99 * CANVAS.x * CANVAS.y, "{sum}");
    }
    assert_eq!(script.polygon(), before);
    assert_eq!(script.steps(), 0);
    // From nowhere in particular all four are new.
    let at = DVec2::new(500.0, 300.0);
    script.drag_with(Button::Secondary, at, at + DVec2::new(40.0, 30.0));
    script.command(Command::Panes(PaneLayout::Four));
    let sides: Vec<Orientation> = panes(&script).iter().map(|it| it.1.orientation).collect();
    assert_eq!(sides[0], Orientation::XY);
    script.editor.look(Look::Canvas(0.5 * CANVAS));
    check_drawn(&mut script, 3);
    let sizes = panes(&script).into_iter().map(|it| it.1.size);
    assert!(
        sizes
            .into_iter()
            .all(|size| size == DVec2::new(249.5, 174.5))
    );
}

#[test]
fn a_curve_is_drawn_click_by_click_in_one_of_several_panes() {
    for pane in [0, 2] {
        let mut script = four();
        script.command(Command::DeleteCurve);
        script.tool(ToolKind::Draw);
        let (corner, _) = panes(&script)[pane];
        for at in [
            [100.0, 100.0],
            [200.0, 150.0],
            [300.0, 120.0],
            [350.0, 250.0],
        ] {
            script.click(corner + DVec2::from(at));
        }
        // What a click would make is shown in all panes.
        script.move_to(corner + DVec2::new(400.0, 300.0));
        script.scene();
        for pane in script.editor.view().panes() {
            assert!(!pane.scene.proposal.float.is_empty());
        }
        script.key(Key::Enter);
        assert_eq!(script.editor.document().curves().count(), 1);
        let kept = [2, 1, 1][pane];
        let vertices = script.polygon();
        let vertices = vertices.vertices().iter();
        assert!(vertices.clone().all(|vertex| vertex[kept] == 0.0));
        assert!(vertices.count() >= 4);
    }
}
