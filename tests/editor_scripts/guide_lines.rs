//! Guides dragged from the rulers, and what snaps to them.

use batten::document::{Curve, Document, Edit, GuideLine};
use batten::editor::{
    Command, Editor, EndFitAction, Input, Key, Layer, Look, Mark, NamedView, PaneLayout, RULER,
    Scene, ToolKind,
};
use batten::geometry::expressions::LengthUnit;
use batten::geometry::{End, FloatPolygon};
use glam::{DVec2, DVec3};

use super::common::check_symmetry;
use super::script::Script;

/// A place on the ruler at the left, and one on that below, on a canvas of 1000 by 700.
const RULERS: [DVec2; 2] = [
    DVec2::new(0.5 * RULER, 300.0),
    DVec2::new(400.0, 700.0 - 0.5 * RULER),
];

/// A script with one curve of four vertices.
fn script() -> Script {
    let vertices = [(13.0, 0.0), (37.0, 41.0), (82.0, 57.0), (120.0, 11.0)];
    let polygon = FloatPolygon::planar(3, &vertices).expect("a polygon");
    let document = Document::from_curves([Curve::new("arc", polygon)]);
    let mut script = Script {
        editor: Editor::with_document(document),
    };
    script.editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    script.check();
    script.command(Command::FitAll);
    script
}

fn guides(script: &Script) -> Vec<GuideLine> {
    script.editor.document().guide_lines().to_vec()
}

/// Where a point of the model is on the canvas.
fn seen(script: &Script, x: f64, y: f64) -> DVec2 {
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(DVec3::new(x, y, 0.0)))
}

/// The names of snaps in a scene.
fn names(scene: &Scene) -> Vec<String> {
    let names = scene.marks.iter().filter_map(|mark| match mark {
        Mark::Name(_, name) => Some(name.clone()),
        Mark::Drag(readout) => readout.remarks.first().cloned(),
        _ => None,
    });
    names.collect()
}

#[test]
fn a_drag_from_a_ruler_places_a_guide_with_any_tool_and_undo_removes_it() {
    for tool in ToolKind::ALL {
        let mut script = script();
        script.tool(tool);
        let before = script.polygon();
        for (axis, ruler) in RULERS.into_iter().enumerate() {
            let to = DVec2::new(531.0, 223.0);
            let pointed = script.editor.view().viewport().to_model(to)[axis];
            script.drag(ruler, to);
            let placed = guides(&script);
            assert_eq!(placed.len(), axis + 1, "{tool:?}");
            let GuideLine { axis: own, at } = placed[axis];
            assert_eq!(own, axis, "{tool:?}");
            // The line is under the pointer, wherever the ruler was taken.
            let pixel = script.editor.view().viewport().pixel();
            assert!((at - pointed).abs() < 1e-9 * pixel.max(1.0), "{tool:?}");
        }
        assert_eq!(script.polygon(), before);
        assert_eq!(script.editor.hand().tool(), tool);
        script.command(Command::Undo);
        assert_eq!(guides(&script).len(), 1, "{tool:?}");
        script.undo_all();
        assert!(guides(&script).is_empty());
    }
}

#[test]
fn a_click_on_a_ruler_does_nothing() {
    for tool in ToolKind::ALL {
        let mut script = script();
        script.tool(tool);
        let (steps, document) = (script.steps(), script.editor.document().clone());
        script.click(RULERS[0]);
        script.drag(RULERS[1], RULERS[1] + DVec2::new(50.0, 0.0));
        assert!(script.editor.document().is_same(&document), "{tool:?}");
        assert_eq!(script.steps(), steps, "{tool:?}");
    }
}

#[test]
fn a_guide_snaps_to_vertices_and_vertices_snap_to_it_to_the_bit() {
    let mut script = script();
    script.command(Command::ToggleSnapping);
    // Upright through vertex 2, far from it.
    let to = seen(&script, 82.0, 20.0) + DVec2::new(2.5, 0.0);
    script.drag(RULERS[0], to);
    assert_eq!(guides(&script), [GuideLine { axis: 0, at: 82.0 }]);
    let level = seen(&script, 60.0, 33.3);
    script.command(Command::ToggleSnapping);
    script.drag(RULERS[1], level);
    script.command(Command::ToggleSnapping);
    let at = guides(&script)[1].at;
    // A vertex at the crossing of both.
    let from = script.at_vertex(3);
    script.press(from);
    script.move_to(seen(&script, 82.0, at) + DVec2::new(3.0, -2.0));
    assert_eq!(names(script.scene()), ["On the guide, On the guide"]);
    script.release(seen(&script, 82.0, at) + DVec2::new(3.0, -2.0));
    assert_eq!(script.polygon().vertex(3), DVec3::new(82.0, at, 0.0));
    // Hidden guides attract nothing, alignment lines or not.
    script.command(Command::Undo);
    script.command(Command::ToggleLayer(Layer::Guides));
    script.press(from);
    script.move_to(seen(&script, 100.0, at));
    let names = names(script.scene());
    assert!(
        names.iter().all(|name| !name.contains("guide")),
        "{names:?}"
    );
    script.input(Input::Key(Key::Escape));
    script.release(from);
}

#[test]
fn a_guide_is_moved_and_removed_over_a_ruler() {
    let mut script = script();
    let lines = vec![
        GuideLine { axis: 0, at: 60.0 },
        GuideLine { axis: 1, at: 25.0 },
    ];
    let edit = Edit::SetGuideLines(lines.clone());
    script.editor.apply("Guides", vec![edit]).expect("guides");
    let on = seen(&script, 60.0, 5.0);
    let steps = script.steps();
    // A drag of nothing changes nothing.
    script.press(on);
    script.move_to(on + DVec2::new(9.0, 0.0));
    script.move_to(on);
    script.release(on);
    assert_eq!((guides(&script), script.steps()), (lines.clone(), steps));
    script.drag(on, seen(&script, 70.0, 5.0));
    assert_eq!(guides(&script)[0], GuideLine { axis: 0, at: 70.0 });
    script.press(seen(&script, 70.0, 5.0));
    script.move_to(seen(&script, 75.0, 5.0));
    script.input(Input::Key(Key::Escape));
    script.release(seen(&script, 75.0, 5.0));
    assert_eq!(guides(&script)[0].at, 70.0);
    script.drag(seen(&script, 70.0, 5.0), RULERS[0]);
    assert_eq!(guides(&script), [lines[1]]);
    script.command(Command::Undo);
    assert_eq!(guides(&script).len(), 2);
    script.command(Command::RemoveGuides);
    assert!(guides(&script).is_empty());
    assert!(!Command::RemoveGuides.is_enabled(&script.editor));
}

#[test]
fn guides_are_planes_that_every_pane_shows() {
    let mut script = script();
    script.command(Command::View(NamedView::Xz));
    script.drag(RULERS[1], DVec2::new(400.0, 350.0));
    assert_eq!(guides(&script)[0].axis, 2);
    script.command(Command::View(NamedView::Xy));
    let count = |scene: &Scene| {
        let lines = scene.marks.iter();
        lines
            .filter(|mark| matches!(mark, Mark::GuideLine(_)))
            .count()
    };
    assert_eq!(count(script.scene()), 0);
    let upright = Edit::SetGuideLines(vec![GuideLine { axis: 0, at: 60.0 }]);
    script
        .editor
        .apply("Guides", vec![upright])
        .expect("a guide");
    script.command(Command::Panes(PaneLayout::Four));
    script.editor.refresh();
    let seen: Vec<usize> = script
        .editor
        .view()
        .panes()
        .map(|pane| count(pane.scene))
        .collect();
    // From above and from the front, not from a corner nor from the side.
    assert_eq!(seen.iter().sum::<usize>(), 2, "{seen:?}");
}

#[test]
fn an_axis_of_symmetry_is_dragged_with_its_curve() {
    let half = [(8.0, 0.0), (30.0, 4.0), (42.0, 30.0), (34.0, 60.0)];
    let image = half.iter().rev().map(|(x, y)| (-x, *y));
    let vertices: Vec<(f64, f64)> = image.chain(half).collect();
    let polygon = FloatPolygon::planar(4, &vertices).expect("a polygon");
    let mut script = script();
    let edits = vec![
        Edit::SetGuideLines(vec![GuideLine { axis: 0, at: 17.25 }]),
        Edit::Add(Box::new(Curve::new("vase", polygon))),
    ];
    script.editor.apply("Vase", edits).expect("a vase");
    let vase = script.editor.document().ids().last().expect("the vase");
    script.editor.activate(vase);
    script.command(Command::FitAll);
    script.command(Command::ToggleSymmetric);
    script.command(Command::ToggleSnapping);
    let before = script.polygon();
    let on = seen(&script, 0.0, -3.0);
    script.press(on);
    script.move_to(seen(&script, 17.0, -3.0));
    assert_eq!(names(script.scene()), ["On the guide"]);
    script.release(seen(&script, 17.0, -3.0));
    let curve = script.editor.document().curve(vase).expect("the vase");
    let [through, normal] = curve
        .symmetry
        .expect("a rule")
        .planes()
        .next()
        .expect("a plane");
    assert_eq!(through.x, 17.25);
    assert_eq!(normal, DVec3::X);
    let moved = script.polygon();
    let pairs = moved.vertices().iter().zip(before.vertices());
    for (now, then) in pairs {
        assert!((*now - *then - DVec3::new(17.25, 0.0, 0.0)).length() < 1e-13);
    }
    // Wherever it goes, it stays an upright axis.
    script.command(Command::ToggleSnapping);
    let mut from = 17.25;
    for to in [29.371, -4.13, 33.337, 0.1] {
        script.drag(seen(&script, from, -3.0), seen(&script, to, -3.0));
        let curve = script.editor.document().curve(vase).expect("the vase");
        let symmetry = curve.symmetry.expect("a rule");
        let [through, normal] = symmetry.planes().next().expect("a plane");
        assert_eq!(normal, DVec3::X);
        assert!((through.x - to).abs() < 1e-9);
        check_symmetry(curve).expect("a symmetric curve");
        from = to;
    }
}

#[test]
fn an_end_on_an_axis_gets_a_tangent_perpendicular_to_it() {
    let vertices = [
        (0.0, 0.0),
        (12.0, 3.0),
        (37.0, 41.0),
        (82.0, 57.0),
        (120.0, 11.0),
    ];
    let polygon = FloatPolygon::planar(3, &vertices).expect("a polygon");
    let mut script = script();
    let start = polygon.end_jet(End::Start).point;
    let edits = vec![
        Edit::SetGuideLines(vec![GuideLine {
            axis: 0,
            at: start.x,
        }]),
        Edit::Add(Box::new(Curve::new("half", polygon))),
    ];
    script.editor.apply("Half", edits).expect("a half");
    let half = script.editor.document().ids().last().expect("the half");
    script.editor.activate(half);
    script.tool(ToolKind::EndFit);
    script.end_fit_action(EndFitAction::Choose(End::Finish));
    assert_eq!(script.end_fit().expect("a report").axis, None);
    script.end_fit_action(EndFitAction::Choose(End::Start));
    let axis = script.end_fit().expect("a report").axis.expect("the guide");
    assert_eq!(axis.name, "guide");
    assert_eq!(axis.target.direction, Some(DVec3::X));
    script.end_fit_action(EndFitAction::SetTarget(axis.target));
    script.end_fit_action(EndFitAction::BothAtOnce);
    let jet = script.polygon().end_jet(End::Start);
    assert!((jet.point.x - start.x).abs() < 1e-12 * 120.0);
    let tangent = jet.tangent().expect("a tangent");
    assert!(tangent.y.abs() < 1e-9 && tangent.x > 0.0, "{tangent}");
}

#[test]
fn guides_are_converted_and_merged_with_their_documents() {
    let lines = [GuideLine { axis: 1, at: 1.0 }];
    let document = script().editor.document().clone();
    let inch = document
        .with_unit(Some(LengthUnit::Inch))
        .with_guide_lines(lines);
    let mm = Edit::ConvertUnit(LengthUnit::Millimetre);
    let converted = inch.edited([mm]).expect("millimetres");
    assert_eq!(converted.guide_lines(), [GuideLine { axis: 1, at: 25.4 }]);
    let merge = converted.merging(&inch, None).expect("a merge");
    let merged = converted.edited(merge.edits).expect("both");
    // The same place counts once.
    assert_eq!(merged.guide_lines(), converted.guide_lines());
}
