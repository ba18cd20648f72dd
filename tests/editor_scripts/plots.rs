//! What plots mark: features, bands, joints, the state before and what a curve is compared with.

use batten::analysis::LevelPlot;
use batten::document::{Edit, Reference};
use batten::editor::{
    Command, FeatureKind, FeatureMark, Layer, Look, Modifiers, PieceTrend, PlotKind, PlotScene,
};
use batten::geometry::references::{PointList, ReferenceCurve, ReferenceForm};
use batten::operations::Value;
use glam::{DVec2, DVec3};

use super::script::Script;
use super::several::two;

/// The arc length of a curve, summed up over many chords.
fn length(script: &Script, from: f64, to: f64) -> f64 {
    let polygon = script.polygon();
    let point = |step: u32| polygon.point(from + (to - from) * f64::from(step) / 20_000.0);
    (0..20_000)
        .map(|step| point(step).distance(point(step + 1)))
        .sum()
}

fn kinds(features: &[FeatureMark]) -> Vec<FeatureKind> {
    features.iter().map(|feature| feature.kind).collect()
}

#[test]
fn the_plot_marks_the_features_where_they_are() {
    for example in ["s-curve", "bottle", "hull"] {
        let mut script = Script::example(example);
        let report = script.features().expect("features");
        let is_planar = script.polygon().is_planar();
        let plots = script.plots().clone();
        assert_eq!(plots.features.len(), report.rows.len(), "{example}");
        for (feature, row) in plots.features.iter().zip(&report.rows) {
            assert_eq!(feature.kind, row.kind);
            let expected = length(&script, 0.0, row.middle);
            assert!((feature.at.x - expected).abs() <= 1e-5 * plots.length);
            let curvature = script.polygon().jet(row.middle).curvature_of(is_planar);
            let largest = plots.series.iter().filter(|at| !at.is_nan());
            let largest = largest.fold(0.0, |most: f64, at| most.max(at.y.abs()));
            assert!(
                (feature.at.y - curvature).abs() <= 1e-9 * largest,
                "{row:?}"
            );
        }
    }
}

#[test]
fn bands_tell_where_the_curvature_rises_and_falls() {
    for example in ["s-curve", "bottle", "periodic"] {
        let mut script = Script::example(example);
        let plots = script.plots().clone();
        let report = script.features();
        assert!(plots.bands.len() >= 2, "{example}: {report:?}");
        for pair in plots.bands.windows(2) {
            assert!(pair[0].to <= pair[1].from + 1e-9 * plots.length);
        }
        for band in &plots.bands {
            assert_ne!(band.trend, PieceTrend::Undecided, "{example}");
            let room = 2.0 / 2048.0 * plots.length;
            let own = plots.series.iter().filter(|at| !at.is_nan());
            let own = own.filter(|at| (band.from + room..=band.to - room).contains(&at.x));
            let own: Vec<f64> = own.map(|at| at.y).collect();
            let rises = band.trend == PieceTrend::Rising;
            let slack = 1e-9 * own.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
            for pair in own.windows(2) {
                let change = pair[1] - pair[0];
                assert!(
                    if rises {
                        change >= -slack
                    } else {
                        change <= slack
                    },
                    "{example}"
                );
            }
        }
        let covered: f64 = plots.bands.iter().map(|band| band.to - band.from).sum();
        assert!(covered > 0.98 * plots.length, "{example}: {covered}");
    }
}

#[test]
fn marks_go_with_the_layer_and_follow_a_drag_and_its_undo() {
    let mut script = Script::example("s-curve");
    let before = script.plots().clone();
    script.command(Command::ToggleLayer(Layer::Features));
    assert!(script.plots().features.is_empty() && script.plots().bands.is_empty());
    script.command(Command::ToggleLayer(Layer::Features));
    assert_eq!(script.plots().features, before.features);
    let at = script.at_vertex(3);
    script.press(at);
    script.move_to(at + DVec2::new(4.0, 30.0));
    assert_ne!(script.plots().features, before.features);
    assert_ne!(script.plots().bands, before.bands);
    script.release(at + DVec2::new(4.0, 30.0));
    script.command(Command::Undo);
    assert_eq!(script.plots().features, before.features);
    assert_eq!(script.plots().bands, before.bands);
}

#[test]
fn levels_mark_what_belongs_to_them() {
    let mut script = Script::example("hull");
    let torsion = LevelPlot::Torsion(1);
    let plots = script.level_plot(torsion, false).clone();
    assert!(!plots.features.is_empty() || script.polygon().is_planar());
    let scaled = script.level_plot(torsion, true).clone();
    assert_eq!(kinds(&scaled.features), kinds(&plots.features));
    for (a, b) in plots.features.iter().zip(&scaled.features) {
        assert!((a.at.x - b.at.x * plots.length).abs() <= 1e-12 * plots.length);
        assert!((a.at.y * plots.length - b.at.y).abs() <= 1e-12 * b.at.y.abs());
    }
    let higher = script.level_plot(LevelPlot::Curvature(2), false);
    assert!(higher.features.is_empty() && higher.bands.is_empty());
}

#[test]
fn features_of_the_curve_at_length_1_stand_at_shares() {
    let mut script = Script::example("bottle");
    let plots = script.plots().clone();
    let scaled = script.level_plot(LevelPlot::CURVATURE, true);
    assert_eq!(kinds(&scaled.features), kinds(&plots.features));
    for (a, b) in plots.features.iter().zip(&scaled.features) {
        assert!((a.at.x - b.at.x * plots.length).abs() <= 1e-12 * plots.length);
        assert!((a.at.y * plots.length - b.at.y).abs() <= 1e-12 * b.at.y.abs());
    }
    assert_eq!(scaled.bands.len(), plots.bands.len());
    let last = scaled.bands.last().expect("a band");
    assert!((last.to - 1.0).abs() < 1e-9);
}

#[test]
fn a_joint_is_marked_while_curves_are_joined() {
    let (mut script, [arc, _]) = two();
    let own = length(&script, 0.0, script.polygon().segments() as f64);
    assert!(script.plots().joints.is_empty());
    script.try_out("join").expect("an operation");
    let plots = script.plots().clone();
    let [[from, to]] = plots.joints[..] else {
        panic!("no joint: {:?}", plots.joints);
    };
    assert!(0.0 < from && from < to && to < plots.length);
    // Before or after it the first curve is as it was.
    let kept = (from - own).abs().min((plots.length - to - own).abs());
    assert!(kept <= 1e-4 * own, "{from} {to} {own}");
    // Strips mark the vertices of the bridge.
    let bridge = script.trial_report();
    let bridge = serde_json::to_value(bridge).expect("a report");
    let count = bridge["bridge"].as_u64().expect("the bridge");
    script.editor.view_mut().plot = Some(PlotKind::Harmony);
    let [[first, last]] = script.plots().joints[..] else {
        panic!("no joint in the strips");
    };
    assert_eq!(last - first, count as f64);
    script.editor.view_mut().plot = Some(PlotKind::CURVATURE);
    script.editor.operating().apply().expect("a step");
    assert_eq!(script.plots().joints, plots.joints);
    script.command(Command::Undo);
    assert!(script.plots().joints.is_empty());
    script.editor.activate(arc);
    script.try_out("close").expect("an operation");
    let plots = script.plots().clone();
    let [[from, to]] = plots.joints[..] else {
        panic!("no joint: {:?}", plots.joints);
    };
    assert!((from - own).abs() <= 1e-4 * own);
    assert!((to - plots.length).abs() <= 1e-9 * plots.length);
    script.editor.operating().leave();
    assert!(script.plots().joints.is_empty());
}

fn source(name: &str) -> Value {
    let reference = ReferenceCurve::from_text(name).expect("a reference");
    Value::Reference(Some(Box::new(reference)))
}

#[test]
fn a_reference_that_is_typed_is_overlaid_as_one_of_the_document_is() {
    let mut script = Script::example("arc");
    script.try_out("approximate").expect("it can run");
    script
        .set("reference", source("conical-spiral"))
        .expect("a value");
    let typed = script.plots().clone();
    let other = typed.compared.as_ref().expect("the source");
    assert_eq!(typed.compared_name, "source: conical spiral");
    assert_eq!(script.editor.document().references().count(), 0);
    // The document's own reference has the same series.
    let curve = ReferenceCurve::from_text("conical-spiral").expect("a reference");
    let mut witness = Script::example("arc");
    let reference = Edit::AddReference(Box::new(Reference::new("a", curve)));
    witness
        .editor
        .apply("add", vec![reference])
        .expect("an edit");
    let id = witness
        .editor
        .document()
        .references()
        .next()
        .map(|(id, _)| id);
    witness.command(Command::Compare(id));
    let same = witness.plots().compared.as_ref().expect("the reference");
    assert_eq!(other.series, same.series);
    // Another one takes its place, in every plot.
    script
        .set("reference", source("circle:radius=3"))
        .expect("a value");
    let plots = script.plots();
    assert_eq!(plots.compared_name, "source: circle");
    let other = plots.compared.as_ref().expect("the source");
    assert!(
        other
            .series
            .iter()
            .all(|at| (at.y - 1.0 / 3.0).abs() < 1e-12)
    );
    let levels = script.level_plot(LevelPlot::Curvature(2), false);
    let other = levels.compared.as_ref().expect("the source");
    assert!(!other.series.is_empty());
    script.editor.operating().leave();
    assert!(script.plots().compared.is_none());
}

#[test]
fn the_curve_before_is_overlaid_while_it_is_approximated() {
    let mut script = Script::example("s-curve");
    let before = script.plots().series.clone();
    script.try_out("approximate").expect("it can run");
    script.set("degree", Value::Whole(7)).expect("a value");
    let plots = script.plots();
    let ghost = plots.before.as_ref().expect("the state before");
    assert_eq!(ghost.series, before);
    assert_ne!(plots.series, before);
}

#[test]
fn points_are_overlaid_by_their_discrete_curvature_while_a_curve_is_fitted() {
    let angle = |index: usize| 0.05 * index as f64;
    let point = |index| {
        DVec3::new(
            5.0 * f64::cos(angle(index)),
            5.0 * f64::sin(angle(index)),
            0.0,
        )
    };
    let points: Vec<DVec3> = (0..60).map(point).collect();
    let form = ReferenceForm::Points(PointList::new(points).expect("points"));
    let curve = ReferenceCurve::of(form).expect("a reference");
    let mut script = Script::example("arc");
    let reference = Edit::AddReference(Box::new(Reference::new("points", curve)));
    script
        .editor
        .apply("add", vec![reference])
        .expect("an edit");
    let id = script
        .editor
        .document()
        .references()
        .next()
        .map(|(id, _)| id);
    script.editor.activate(id.expect("the points"));
    script.check();
    script.try_out("fit").expect("it can run");
    let plots = script.plots();
    let other = plots.compared.as_ref().expect("the points");
    assert_eq!(other.discrete.len(), 58);
    for (index, at) in &other.discrete {
        let along = *index as f64 * 10.0 * f64::sin(0.025);
        assert!((at.x - along).abs() < 1e-9, "{index} {at}");
        // 2 / (R (1 + cos θ)) on a circle's polygon.
        let expected = 2.0 / (5.0 * (1.0 + f64::cos(0.05)));
        assert!((at.y - expected).abs() < 1e-9);
    }
    assert!(!plots.series.is_empty());
}

#[test]
fn what_alt_shows_is_in_the_plot_with_its_marks() {
    let mut script = Script::example("s-curve");
    let before = script.plots().series.clone();
    let at = script.at_vertex(3);
    script.press(at);
    script.move_to(at + DVec2::new(4.0, 30.0));
    script.modifiers(Modifiers {
        alt: true,
        ..Modifiers::NONE
    });
    let plots: &PlotScene = script.plots();
    let ghost = plots.before.as_ref().map(|plots| &plots.series);
    assert_eq!(ghost, Some(&before));
    assert!(!plots.features.is_empty());
    script.modifiers(Modifiers::NONE);
    assert!(script.plots().before.is_none());
    script.editor.view_mut().plot = Some(PlotKind::CURVATURE);
    script.release(at);
}

/// The gaps of a chain: the points before and after each.
fn gaps(chain: &[DVec2]) -> Vec<[DVec2; 2]> {
    let pairs = chain.windows(3).filter(|three| three[1].is_nan());
    pairs.map(|three| [three[0], three[2]]).collect()
}

#[test]
fn a_formula_is_not_drawn_through_its_poles() {
    let curve = ReferenceCurve::from_text("formula:x=t;y=tan(t);from=-4;to=5").expect("a formula");
    let mut script = Script::example("arc");
    let reference = Edit::AddReference(Box::new(Reference::new("tan", curve)));
    script
        .editor
        .apply("add", vec![reference])
        .expect("an edit");
    let id = script
        .editor
        .document()
        .references()
        .next()
        .map(|(id, _)| id);
    script.editor.activate(id.expect("the formula"));
    script.command(Command::FitAll);
    let drawn = |script: &mut Script| {
        let curves = &script.scene().curves;
        let found = curves.iter().find(|curve| curve.id == id);
        found.expect("the formula").curve.clone()
    };
    let poles = [-0.5, 0.5, 1.5].map(|times| times * std::f64::consts::PI);
    let chain = drawn(&mut script);
    let found = gaps(&chain);
    assert_eq!(found.len(), 3, "{found:?}");
    for ([a, b], pole) in found.iter().zip(poles) {
        assert!(
            a.x < pole && pole < b.x && a.y > 0.0 && b.y < 0.0,
            "{a} {b}"
        );
    }
    // Near a pole, where it is sampled anew, too.
    script.editor.look(Look::Around(id.map_or(0.0, |_| {
        let curve = script.editor.document().shape(id.expect("it")).expect("it");
        (4.0 - 0.45 * std::f64::consts::PI) / 9.0 * curve.pieces() as f64
    })));
    for pair in drawn(&mut script).windows(2) {
        let crosses = poles
            .iter()
            .any(|pole| pair[0].x < *pole && *pole < pair[1].x);
        assert!(!crosses, "{pair:?}");
    }
    let plots = script.plots().clone();
    assert!(plots.length.is_finite());
    assert_eq!(gaps(&plots.series).len(), 3);
    let levels = script.level_plot(LevelPlot::Curvature(2), false);
    assert!(gaps(&levels.series).len() >= 3);
    // A pole is no inflection: tan bends the other way between poles alone.
    let features = script.features().expect("features");
    assert_eq!(features.count(&[FeatureKind::Inflection]), 3);
}
