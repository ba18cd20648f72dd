//! Rotating and scaling the selection.

use batten::editor::{Modifiers, ToolKind, Transformation};
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
    script.editor.set_pivot(Some(DVec2::ZERO));
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
    let pivot = script.editor.pivot().expect("a pivot");
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
