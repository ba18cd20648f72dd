//! Proved features on the canvas and in the list.

use batten::analysis::LevelPlot;
use batten::editor::{Command, FeatureKind, HoverScene, Layer, Look, PieceTrend};
use batten::geometry::features::Verdict;
use batten::geometry::{FloatPolygon, LEVELS};
use glam::{DVec2, DVec3};

use super::script::Script;

#[test]
fn the_list_holds_every_feature_in_order_and_choosing_one_goes_there() {
    let mut script = Script::example("bottle");
    let report = script.features().expect("features");
    assert_eq!(report.monotone, Verdict::Disproved);
    let extrema = [FeatureKind::CurvatureMaximum, FeatureKind::CurvatureMinimum];
    assert_eq!(report.count(&extrema), 4);
    assert_eq!(report.count(&[FeatureKind::Inflection]), 1);
    assert!(report.rows.is_sorted_by(|a, b| a.u[0] <= b.u[0]));
    let scale = script.editor.view().viewport().scale;
    let row = report.rows[2];
    script.editor.look(Look::Around(row.middle));
    let viewport = *script.editor.view().viewport();
    assert!(viewport.scale > scale);
    let at = viewport.flatten(script.polygon().point(row.middle));
    let middle = 0.5 * viewport.size;
    assert!(viewport.to_screen(at).distance(middle) < 1e-6);
}

#[test]
fn the_canvas_marks_features_and_colours_monotone_pieces() {
    let mut script = Script::example("s-curve");
    let report = script.features().expect("features");
    let scene = script.scene();
    let curve = &scene.curves[0];
    assert_eq!(curve.features.len(), report.rows.len());
    let [rising, falling, undecided] = &curve.pieces;
    assert!(rising.len() > 10 && falling.len() > 10);
    assert!(undecided.iter().all(|point| point.is_nan()));
    assert_eq!(PieceTrend::ALL.len(), curve.pieces.len());
    // Pieces end where the extrema are.
    let polygon = script.polygon();
    for row in report.rows.iter().filter(|row| row.value.is_some()) {
        let at = polygon.point(row.middle).truncate();
        let curve = &script.scene().curves[0];
        let near = |chain: &[DVec2]| chain.iter().any(|point| point.distance(at) < 1e-9);
        assert!(near(&curve.pieces[0]) && near(&curve.pieces[1]), "{row:?}");
    }
    script.command(Command::ToggleLayer(Layer::Features));
    assert!(script.scene().curves[0].features.is_empty());
}

#[test]
fn lines_and_circles_are_told_from_monotone_curves() {
    let circle = [(3.0, -3.0), (3.0, 3.0), (-1.0, 3.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
    let circle = FloatPolygon::new(2, circle.to_vec(), Some(vec![1.0, 1.0, 3.0]), false);
    let line = FloatPolygon::planar(3, &[(0.0, 0.0), (0.1, 0.1), (0.3, 0.3), (0.7, 0.7)]);
    let spiral = FloatPolygon::planar(2, &[(0.0, 0.0), (8.0, 0.0), (18.0, 2.0)]);
    for (polygon, constant) in [(circle, true), (line, true), (spiral, false)] {
        let polygon = polygon.expect("a valid polygon");
        let mut script = Script::example("arc");
        script.set_polygon(polygon);
        let report = script.features().expect("features");
        assert_eq!(report.monotone, Verdict::Proved);
        assert_eq!(report.constant, constant);
    }
}

#[test]
fn hovering_a_mark_names_the_feature() {
    let mut script = Script::example("s-curve");
    let mark = script.scene().curves[0].features[0];
    let place = script.editor.view().viewport().to_screen(mark.at);
    script.move_to(place + DVec2::new(3.0, 2.0));
    let hover = script.scene().hover.clone();
    let Some(HoverScene::Curve { u, text, .. }) = hover else {
        panic!("nothing is hovered: {hover:?}");
    };
    assert_eq!(u, mark.u);
    assert!(text.starts_with(mark.kind.label()), "{text}");
}

#[test]
fn features_follow_a_drag() {
    let mut script = Script::example("hull");
    let before = script.features().expect("features");
    let at = script.at_vertex(6);
    script.press(at);
    script.move_to(at + DVec2::new(0.0, 60.0));
    let during = script.features().expect("features");
    assert_ne!(before.rows, during.rows);
    assert!(script.scene().curves[0].features.len() > 1);
    script.release(at + DVec2::new(0.0, 60.0));
    script.command(Command::Undo);
    assert_eq!(script.features().expect("features"), before);
}

#[test]
fn levels_are_plotted_over_arc_length_with_their_jumps() {
    let mut script = Script::example("s-curve");
    let polygon = script.polygon();
    let length = script.plots().length;
    // Degree 5 has a continuous second level of the curvature, and a third that jumps.
    for (level, gaps) in [(2, 0), (3, polygon.segments())] {
        let plot = script.level_plot(LevelPlot::Curvature(level), false);
        let holes = plot.series.iter().filter(|point| point.is_nan()).count();
        assert_eq!(holes, gaps, "level {level}");
        let last = plot.series.iter().rfind(|point| !point.is_nan());
        let last = last.expect("a point");
        assert!((last.x - length).abs() <= 1e-9 * length);
        let end = polygon.segment_curvature_levels(polygon.segments() - 1, 1.0, 1.0);
        let expected = end.curvature[level - 1];
        assert!(
            (last.y - expected).abs() <= 1e-12 * expected.abs(),
            "level {level}"
        );
    }
    let plot = script.level_plot(LevelPlot::Curvature(2), true);
    let first = plot.series[0];
    let last = plot.series[plot.series.len() - 1];
    assert!((last.x - 1.0).abs() <= 1e-9 && first.x == 0.0);
    let scaled = polygon
        .segment_curvature_levels(0, 0.0, 1.0 / length)
        .curvature[1];
    assert!(
        (first.y - scaled).abs() <= 1e-9 * scaled.abs(),
        "{first} {scaled}"
    );
    let plot = script.level_plot(LevelPlot::Torsion(1), false);
    assert!(
        plot.series.iter().all(|point| point.is_nan()),
        "a planar curve"
    );
}

#[test]
fn the_curvature_of_the_curve_at_length_1_is_plotted_over_shares() {
    let mut script = Script::example("s-curve");
    let plot = script.plots().clone();
    let scaled = script.level_plot(LevelPlot::CURVATURE, true);
    assert_eq!(scaled.series.len(), plot.series.len());
    for (a, b) in plot.series.iter().zip(&scaled.series) {
        assert!((a.x - b.x * plot.length).abs() <= 1e-12 * plot.length);
        assert!((a.y * plot.length - b.y).abs() <= 1e-12 * b.y.abs());
    }
}

#[test]
fn every_example_has_every_plot() {
    for example in 0..7 {
        let mut script = Script::example("arc");
        script.editor.open_example(example).expect("an example");
        let analysis = script.editor.view().analysis(script.curve());
        let planar = analysis.map(|analysis| analysis.is_planar());
        assert_eq!(planar, Some(true));
        for level in 1..=LEVELS {
            let plot = LevelPlot::Curvature(level);
            assert!(!script.level_plot(plot, true).series.is_empty());
        }
        let graph = script.level_plot(LevelPlot::Logarithmic, false);
        assert!(graph.series.iter().any(|point| point.is_finite()));
    }
}
