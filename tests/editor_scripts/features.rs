//! Proved features on the canvas and in the list.

use batten::analysis::PieceTrend;
use batten::editor::{Command, FeatureKind, HoverScene, Layer};
use batten::geometry::features::Verdict;
use glam::DVec2;

use super::script::Script;

#[test]
fn the_list_holds_every_feature_in_order_and_choosing_one_goes_there() {
    let mut script = Script::example("bottle");
    let report = script.editor.features().expect("features");
    assert_eq!(report.monotone, Verdict::Disproved);
    let extrema = [FeatureKind::CurvatureMaximum, FeatureKind::CurvatureMinimum];
    assert_eq!(report.count(&extrema), 4);
    assert_eq!(report.count(&[FeatureKind::Inflection]), 1);
    assert!(report.rows.is_sorted_by(|a, b| a.u[0] <= b.u[0]));
    let scale = script.editor.viewport().scale;
    let row = report.rows[2];
    script.editor.go_to(row.middle());
    let viewport = *script.editor.viewport();
    assert!(viewport.scale > scale);
    let at = viewport.flatten(script.polygon().point(row.middle()));
    let middle = 0.5 * viewport.size;
    assert!(viewport.to_screen(at).distance(middle) < 1e-6);
}

#[test]
fn the_canvas_marks_features_and_colours_monotone_pieces() {
    let mut script = Script::example("s-curve");
    let report = script.editor.features().expect("features");
    let scene = script.editor.scene();
    let curve = &scene.curves[0];
    assert_eq!(curve.features.len(), report.rows.len());
    let [rising, falling, undecided] = &curve.pieces;
    assert!(rising.len() > 10 && falling.len() > 10);
    assert!(undecided.iter().all(|point| point.is_nan()));
    assert_eq!(PieceTrend::ALL.len(), curve.pieces.len());
    // Pieces end where the extrema are.
    let polygon = script.polygon();
    for row in report.rows.iter().filter(|row| row.value.is_some()) {
        let at = polygon.point(row.middle()).truncate();
        let curve = &script.editor.scene().curves[0];
        let near = |chain: &[DVec2]| chain.iter().any(|point| point.distance(at) < 1e-9);
        assert!(near(&curve.pieces[0]) && near(&curve.pieces[1]), "{row:?}");
    }
    script.command(Command::ToggleLayer(Layer::Features));
    assert!(script.editor.scene().curves[0].features.is_empty());
}

#[test]
fn hovering_a_mark_names_the_feature() {
    let mut script = Script::example("s-curve");
    let mark = script.editor.scene().curves[0].features[0];
    let place = script.editor.viewport().to_screen(mark.at);
    script.move_to(place + DVec2::new(3.0, 2.0));
    let hover = script.editor.scene().hover.clone();
    let Some(HoverScene::Curve { u, text, .. }) = hover else {
        panic!("nothing is hovered: {hover:?}");
    };
    assert_eq!(u, mark.u);
    assert!(text.starts_with(mark.kind.label()), "{text}");
}

#[test]
fn features_follow_a_drag() {
    let mut script = Script::example("hull");
    let before = script.editor.features().expect("features");
    let at = script.at_vertex(6);
    script.press(at);
    script.move_to(at + DVec2::new(0.0, 60.0));
    let during = script.editor.features().expect("features");
    assert_ne!(before.rows, during.rows);
    assert!(script.editor.scene().curves[0].features.len() > 1);
    script.release(at + DVec2::new(0.0, 60.0));
    script.command(Command::Undo);
    assert_eq!(script.editor.features().expect("features"), before);
}
