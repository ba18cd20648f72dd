//! What is drawn of a polygon where its vertices crowd on the screen, and what is hit there.

use batten::document::{Curve, Document};
use batten::editor::{Command, Editor, HoverScene, Input, Layer, Look, VertexMark};
use batten::geometry::FloatPolygon;
use glam::{DVec2, DVec3};

use super::script::Script;

/// Zoom so that a unit of the model spans some screen points, about the middle of the canvas.
fn scale_to(script: &mut Script, scale: f64) {
    let factor = scale / script.editor.view().viewport().scale;
    let at = DVec2::new(500.0, 350.0);
    script.input(Input::Zoomed { at, factor });
}

/// A script about a curve whose vertices are 1 apart in x, near a sine.
fn even(count: usize) -> Script {
    let vertex = |index: usize| {
        let x = index as f64;
        (x, 0.5 * (0.1 * x).sin())
    };
    let points: Vec<(f64, f64)> = (0..count).map(vertex).collect();
    let polygon = FloatPolygon::planar(3, &points).expect("a polygon");
    let mut editor = Editor::with_document(Document::from_curves([Curve::new("even", polygon)]));
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    Script { editor }
}

fn marks(script: &mut Script) -> Vec<VertexMark> {
    script.scene().curves[0].vertices.clone()
}

/// The share of its full size of the smallest and of the largest disc, of those that are not at an end.
fn sizes(script: &mut Script) -> Option<[f32; 2]> {
    let marks = marks(script);
    let sizes = marks.iter().map(|mark| mark.size);
    let smallest = sizes.clone().reduce(f32::min)?;
    Some([smallest, sizes.reduce(f32::max)?])
}

#[test]
fn discs_shrink_below_14_points_of_spacing_and_vanish_below_6() {
    let mut script = even(60);
    for (scale, expected) in [(15.0, 1.0), (12.0, 0.75), (10.0, 0.5), (7.0, 0.125)] {
        scale_to(&mut script, scale);
        let [smallest, largest] = sizes(&mut script).expect("discs");
        let near = |size: f32| (size - expected).abs() < 0.01;
        assert!(
            near(smallest) && near(largest),
            "{scale}: {smallest} … {largest}"
        );
    }
    for scale in [5.9, 3.5, 1.0] {
        scale_to(&mut script, scale);
        assert_eq!(sizes(&mut script), None, "{scale}");
    }
}

#[test]
fn legs_fade_below_6_points_of_spacing_and_vanish_below_3() {
    let mut script = even(60);
    let strongest = |script: &mut Script| {
        let legs = script.scene().curves[0].float.clone();
        let drawn = legs.chains().filter(|(chain, _)| !chain.is_empty());
        drawn.map(|(_, strength)| strength).reduce(f32::max)
    };
    for (scale, expected) in [
        (6.5, Some(1.0)),
        (4.5, Some(0.6)),
        (3.4, Some(0.2)),
        (2.9, None),
        (0.5, None),
    ] {
        scale_to(&mut script, scale);
        assert_eq!(strongest(&mut script), expected, "{scale}");
        assert!(
            !script.scene().curves[0].curve.is_empty(),
            "the curve stays"
        );
    }
}

#[test]
fn sizes_hardly_differ_between_neighbours() {
    // Legs that grow by a tenth from one to the next, as in a spiral.
    let place = |index: i32| (1.1f64.powi(index), 0.2 * (0.2 * f64::from(index)).sin());
    let points: Vec<(f64, f64)> = (0..60).map(place).collect();
    let polygon = FloatPolygon::planar(3, &points).expect("a polygon");
    let mut editor = Editor::with_document(Document::from_curves([Curve::new("growing", polygon)]));
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let mut script = Script { editor };
    let marks = marks(&mut script);
    assert!(marks[0].index > 0 && marks[0].size < 0.3, "{:?}", marks[0]);
    for pair in marks.windows(2) {
        assert_eq!(pair[1].index, pair[0].index + 1);
        let growth = pair[1].size - pair[0].size;
        assert!((0.0..0.25).contains(&growth), "{pair:?}");
    }
    assert_eq!(marks.last().map(|mark| mark.size), Some(1.0));
}

#[test]
fn closed_vertices_that_lie_on_float_ones_are_not_drawn() {
    let mut script = even(60);
    scale_to(&mut script, 16.0);
    let closed = script.scene().curves[0].clamped_vertices.clone();
    // Of degree 3 the outermost vertex at either end is seen on the second of the float polygon, and the one
    // next to it a third of a leg beside.
    assert_eq!(closed.len(), 2);
    let float = marks(&mut script);
    let pixel = script.editor.view().viewport().pixel();
    for mark in &closed {
        assert!(float.iter().all(|it| it.at.distance(mark.at) > pixel));
    }
    let legs = script.scene().curves[0].clamped.clone();
    let points: usize = legs.chains().map(|(chain, _)| chain.len()).sum();
    assert!((1..=10).contains(&points), "only the ends: {points} points");
    script.command(Command::ToggleLayer(Layer::Float));
    assert_eq!(script.scene().curves[0].clamped_vertices.len(), 60);
}

#[test]
fn selected_and_locked_vertices_are_drawn_in_any_crowd() {
    let mut script = even(2_000);
    scale_to(&mut script, 0.4);
    assert_eq!(sizes(&mut script), None);
    let curve = script.curve();
    script.editor.select_vertex(curve, 1_000, false);
    script.command(Command::ToggleVerticesLocked);
    script.editor.select_vertex(curve, 700, false);
    let drawn: Vec<(usize, bool, bool, f32)> = marks(&mut script)
        .iter()
        .map(|mark| (mark.index, mark.selected, mark.locked, mark.size))
        .collect();
    assert_eq!(drawn, [(700, true, false, 1.0), (1_000, false, true, 1.0)]);
    script.command(Command::SelectAll);
    let all = marks(&mut script);
    assert_eq!(all.len(), 2_000);
    assert!(all.iter().all(|mark| mark.size < 0.5), "small together");
}

#[test]
fn where_nothing_of_the_polygon_is_seen_the_curve_is_hit() {
    let mut script = even(2_000);
    let hovered = |script: &mut Script| {
        let at = script.at_vertex(1_000);
        script.move_to(at);
        let hover = script.scene().hover.clone();
        (
            matches!(hover, Some(HoverScene::Vertex { .. })),
            matches!(hover, Some(HoverScene::Curve { .. })),
        )
    };
    for (scale, expected) in [
        (20.0, (true, false)),
        // Legs, but no discs: what is not seen is not taken.
        (4.0, (false, true)),
        (2.0, (false, true)),
        (0.1, (false, true)),
    ] {
        scale_to(&mut script, scale);
        assert_eq!(hovered(&mut script), expected, "{scale}");
    }
    let before = script.polygon();
    let at = script.at_vertex(1_000);
    script.drag(at, at + DVec2::new(0.0, 60.0));
    let dragged = script.polygon();
    let moved = dragged.vertex(1_000) - before.vertex(1_000);
    let beside = dragged.vertex(1_001) - before.vertex(1_001);
    assert!(
        beside.y < 0.9 * moved.y && moved.y < 0.0,
        "the curve, not an unseen vertex: {moved}"
    );
    script.command(Command::Undo);
    let curve = script.curve();
    script.editor.select_vertex(curve, 1_000, false);
    let at = script.at_vertex(1_000);
    script.drag(at, at + DVec2::new(0.0, 60.0));
    let moved = script.polygon().vertex(1_000) - before.vertex(1_000);
    assert!(moved.y < 0.0 && moved != DVec3::ZERO, "{moved}");
}

#[test]
fn bands_are_shown_on_the_canvas_by_choice() {
    let mut script = Script::example("bottle");
    let bands = |script: &mut Script| {
        let pieces = script.scene().curves[0].pieces.clone();
        pieces.iter().any(|chain| !chain.is_empty())
    };
    assert!(bands(&mut script));
    script.command(Command::ToggleBands);
    assert!(!bands(&mut script));
    assert!(!script.scene().curves[0].features.is_empty(), "glyphs stay");
    script.command(Command::ToggleBands);
    assert!(bands(&mut script));
}

#[test]
fn joints_of_a_curve_with_many_segments_are_drawn_where_they_are_apart() {
    let mut script = even(3000);
    for (scale, some) in [(0.3, false), (5.0, false), (12.0, true), (40.0, true)] {
        scale_to(&mut script, scale);
        let joints = script.scene().curves[0].joints.clone();
        assert_eq!(!joints.is_empty(), some, "{scale}");
        // One each unit over the canvas and its border, in the order of the curve.
        let seen = 1000.0 / scale;
        let expected = if some { seen } else { 0.0 };
        assert!(
            (joints.len() as f64 - expected).abs() < 5.0,
            "{scale}: {}",
            joints.len()
        );
        for [[from, _], [to, _]] in joints.array_windows() {
            assert!((to.x - from.x - 1.0).abs() < 1e-9, "{from} {to}");
        }
    }
}
