//! Rotating and scaling the selection.

use batten::editor::{Command, Input, Mark, Modifiers, NamedView, ToolKind, Transformation};
use batten::geometry::FloatPolygon;
use glam::DVec2;

use super::script::Script;

#[test]
fn rotating_keeps_distances_and_shift_keeps_to_fifteen_degrees() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    script.tool(ToolKind::Rotate);
    script.modifiers(Modifiers::SHIFT);
    let centre = 0.5 * script.editor.view().viewport().size;
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
    assert_eq!(script.editor.workspace().history().undo_steps(), 1);
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
    script.editor.hand_mut().set_pivot(Some(DVec2::ZERO));
    script
        .editor
        .transform(Transformation::Rotate(0.5_f64.to_radians()))
        .expect("moved vertices");
    let turn = DVec2::from_angle(0.5_f64.to_radians());
    for (index, vertex) in script.polygon().vertices().iter().enumerate() {
        let expected = turn.rotate(before.vertex(index).truncate());
        assert!(vertex.truncate().distance(expected) < 1e-12 * before.size());
    }
    script.tool(ToolKind::Scale);
    let pivot = script
        .editor
        .hand()
        .pivot(&script.editor.context())
        .expect("a pivot");
    let turned = script.polygon();
    script
        .editor
        .transform(Transformation::Scale(2.0))
        .expect("moved vertices");
    for (index, vertex) in script.polygon().vertices().iter().enumerate() {
        let expected = pivot + 2.0 * (turned.vertex(index).truncate() - pivot);
        assert!(vertex.truncate().distance(expected) < 1e-12 * before.size());
    }
    assert_eq!(script.editor.workspace().history().undo_steps(), 2);
    // What cannot be used changes nothing.
    let scaled = script.polygon();
    assert!(
        script
            .editor
            .transform(Transformation::Scale(f64::NAN))
            .is_err()
    );
    assert!(
        script
            .editor
            .transform(Transformation::Scale(1e300))
            .is_err()
    );
    assert_eq!(script.polygon(), scaled);
    assert!(
        script.message().contains("finite numbers"),
        "{}",
        script.message()
    );
}

/// Press, and move on without releasing.
fn hold(script: &mut Script, from: DVec2, to: DVec2) {
    script.press(from);
    script.move_to(0.5 * (from + to));
    script.move_to(to);
}

#[test]
fn a_typed_number_is_shown_and_takes_the_place_of_a_drag() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    script.tool(ToolKind::Scale);
    let pivot = script
        .editor
        .hand()
        .pivot(&script.editor.context())
        .expect("a pivot");
    let scaled = |by: f64| {
        let vertices = before.vertices().iter();
        let scaled = vertices.map(|vertex| pivot + by * (vertex.truncate() - pivot));
        scaled.collect::<Vec<DVec2>>()
    };
    let check = |script: &Script, by: f64| {
        let polygon = script.polygon();
        for (vertex, expected) in polygon.vertices().iter().zip(scaled(by)) {
            assert!(vertex.truncate().distance(expected) < 1e-12 * before.size());
        }
    };
    // In mid-drag: the drag goes, and what the pointer does no longer counts.
    let centre = 0.5 * script.editor.view().viewport().size;
    script.input(Input::Moved { at: centre });
    hold(
        &mut script,
        centre + DVec2::new(200.0, 0.0),
        centre + DVec2::new(300.0, 0.0),
    );
    assert_ne!(script.polygon(), before);
    assert!(script.editor.type_entry("2"));
    check(&script, 2.0);
    script.input(Input::Moved {
        at: centre + DVec2::new(350.0, 0.0),
    });
    check(&script, 2.0);
    assert!(!script.editor.type_entry("2"), "nothing new");
    script.editor.type_entry("2.5");
    check(&script, 2.5);
    // What cannot be read yet shows nothing.
    script.editor.type_entry("2.5*");
    assert_eq!(script.polygon(), before);
    script.editor.type_entry("2.5*2");
    check(&script, 5.0);
    script.editor.type_entry("");
    assert_eq!(script.polygon(), before);
    assert_eq!(script.editor.workspace().history().undo_steps(), 0);
    script.editor.type_entry("3");
    script.editor.enter("3").expect("a factor");
    check(&script, 3.0);
    assert_eq!(script.editor.workspace().history().undo_steps(), 1);
    script.editor.type_entry("");
    check(&script, 3.0);
}

#[test]
fn a_handle_at_a_side_scales_one_axis_and_a_corner_both() {
    for (axis, view) in [
        (0, NamedView::Xy),
        (1, NamedView::Xy),
        (0, NamedView::Isometric),
        (1, NamedView::Isometric),
    ] {
        let mut script = Script::example("s-curve");
        script
            .editor
            .execute(Command::View(view))
            .expect("another view");
        let before = script.polygon();
        script.tool(ToolKind::Scale);
        script.editor.refresh();
        let sides = script.editor.view().scene().marks.iter();
        let mut sides = sides.filter_map(|mark| match mark {
            Mark::Corners { sides, .. } => Some(sides.clone()),
            _ => None,
        });
        let handle = sides.next().expect("a box")[2 * axis];
        let viewport = *script.editor.view().viewport();
        let pivot = script
            .editor
            .hand()
            .pivot(&script.editor.context())
            .expect("a pivot");
        let places = [handle, pivot + 3.0 * (handle - pivot)];
        let [from, to] = places.map(|place| viewport.to_screen(place));
        let fixed = viewport.grounded(pivot);
        script.drag(from, to);
        for (vertex, was) in script.polygon().vertices().iter().zip(before.vertices()) {
            let mut expected = *was;
            expected[axis] = fixed[axis] + 3.0 * (was[axis] - fixed[axis]);
            let off = vertex.distance(expected);
            assert!(off < 1e-9 * before.size(), "{axis} {view:?}: {off}");
        }
        assert_eq!(script.editor.workspace().history().undo_steps(), 1);
    }
}

#[test]
fn a_pivot_that_is_dragged_names_what_it_snaps_to() {
    let mut script = Script::example("s-curve");
    script
        .editor
        .execute(Command::ToggleSnapping)
        .expect("snapping");
    script.tool(ToolKind::Rotate);
    let pivot = script
        .editor
        .hand()
        .pivot(&script.editor.context())
        .expect("a pivot");
    let from = script.editor.view().viewport().to_screen(pivot);
    let to = script.at_vertex(2) + DVec2::new(4.0, 3.0);
    hold(&mut script, from, to);
    script.editor.refresh();
    let marks = &script.editor.view().scene().marks;
    let named = marks
        .iter()
        .any(|mark| matches!(mark, Mark::Name(_, name) if name == "Vertex 2"));
    assert!(named, "{marks:?}");
}

#[test]
fn the_pivot_is_the_middle_of_the_curve_and_stays_from_one_turn_to_the_next() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.tool(ToolKind::Rotate);
    let pivot = |script: &Script| script.editor.hand().pivot(&script.editor.context());
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for step in 0..=4000 {
        let share = f64::from(step) / 4000.0;
        let at = before.point(share * before.segments() as f64).truncate();
        (low, high) = (low.min(at), high.max(at));
    }
    let first = pivot(&script).expect("a pivot");
    let off = first.distance(0.5 * (low + high));
    assert!(
        off < 1e-3 * low.distance(high),
        "{off}: not that of the polygon"
    );
    script.editor.enter("30").expect("an angle");
    assert_eq!(pivot(&script), Some(first));
    script.editor.enter("-30").expect("an angle");
    let back = script.polygon();
    let pairs = before.vertices().iter().zip(back.vertices());
    let most = pairs.fold(0.0_f64, |most, (a, b)| most.max(a.distance(*b)));
    assert!(most <= 1e-12 * before.size(), "{most}");
    // Another tool, and it follows the curve again.
    script.tool(ToolKind::Select);
    script.drag_vertex(0, DVec2::new(80.0, 0.0));
    script.tool(ToolKind::Rotate);
    assert_ne!(pivot(&script), Some(first));
}
