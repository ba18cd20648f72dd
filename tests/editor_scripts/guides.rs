//! Guides for moving a vertex: its safe region, and the moves that lose a feature.

use std::sync::mpsc::channel;
use std::time::Duration;

use batten::document::{Curve, Edit};
use batten::editor::{Command, FeatureKind, GuideScene, Key, Layer, Look, ToolKind};
use batten::geometry::FloatPolygon;
use batten::geometry::features::Features;
use batten::geometry::vertex_moves::FeatureRise;
use glam::{DVec2, DVec3};

use super::script::Script;
use super::several;

/// Longer than any search here takes: whoever waits so long has failed.
const LONG: Duration = Duration::from_secs(60);

/// An example whose safe regions are shown.
fn shown(name: &str) -> Script {
    let mut script = Script::example(name);
    script.command(Command::ToggleLayer(Layer::SafeRegion));
    script
}

fn select(script: &mut Script, vertex: usize) {
    let at = script.at_vertex(vertex);
    script.click(at);
}

/// The guides once they are as fine as they get.
fn finest(script: &mut Script) -> GuideScene {
    for _ in 0..4 {
        script.scene();
    }
    script.scene().guides.clone()
}

/// The border once it is as fine as it gets.
fn border(script: &mut Script) -> Vec<DVec2> {
    corners(&finest(script).border)
}

fn corners(chain: &[DVec2]) -> Vec<DVec2> {
    chain
        .iter()
        .copied()
        .filter(|point| point.is_finite())
        .collect()
}

#[test]
fn the_region_of_the_selected_vertex_is_outlined_with_what_is_added_beyond() {
    let mut script = shown("hull");
    assert!(script.scene().guides.border.is_empty(), "nothing selected");
    select(&mut script, 6);
    let coarse = corners(&script.scene().guides.border).len();
    let guides = finest(&mut script);
    let border = corners(&guides.border);
    assert!(coarse > 0 && border.len() > 2 * coarse, "{coarse}");
    assert!(!guides.labels.is_empty() && guides.labels.len() <= 5);
    let first = &guides.labels[0].text;
    assert!(
        first.starts_with('+') || first.starts_with("nothing"),
        "{first}"
    );
    // Every corner is a safe place; a little further out hardly any is, where the border is sharp.
    let before = script.polygon();
    let features = Features::new(&before);
    let centre = before.vertex(6);
    let is_safe = |by: DVec3| {
        let mut moved = before.clone();
        moved.move_vertices([(6, centre + by)]).expect("a place");
        FeatureRise::between(&features, &Features::new(&moved)).is_none()
    };
    let ways: Vec<DVec3> = border
        .iter()
        .map(|corner| corner.extend(0.0) - centre)
        .collect();
    assert!(ways.iter().all(|by| is_safe(*by)));
    let outside = ways.iter().filter(|by| !is_safe(1.02 * **by)).count();
    assert!(10 * outside > 9 * ways.len(), "{outside} of {}", ways.len());
}

#[test]
fn the_region_follows_selection_curve_and_tool() {
    let mut script = shown("hull");
    select(&mut script, 6);
    let six = border(&mut script);
    select(&mut script, 7);
    let seven = border(&mut script);
    assert_ne!(six, seven);
    script.editor.select_vertex(script.curve(), 6, true);
    assert!(script.scene().guides.border.is_empty(), "two are selected");
    select(&mut script, 6);
    assert_eq!(border(&mut script), six);
    script.tool(ToolKind::Measure);
    assert!(script.scene().guides.border.is_empty(), "another tool");
    script.tool(ToolKind::Select);
    assert_eq!(border(&mut script), six);
    // A neighbour moves: another region. Undone, the same again.
    let vertex = script.polygon().vertex(8);
    let curve = script.curve();
    let moves = vec![(8, vertex + DVec3::new(0.05, 0.1, 0.0))];
    let edit = Edit::MoveVertices { curve, moves };
    script.editor.apply("move", vec![edit]).expect("an edit");
    assert_ne!(border(&mut script), six);
    script.command(Command::Undo);
    assert_eq!(border(&mut script), six);
    script.command(Command::ToggleLayer(Layer::SafeRegion));
    assert!(script.scene().guides.border.is_empty(), "the layer is off");
}

#[test]
fn the_region_stays_where_it_is_while_its_vertex_is_dragged() {
    let mut script = shown("hull");
    select(&mut script, 6);
    let before = border(&mut script);
    let at = script.at_vertex(6);
    script.press(at);
    for step in 1..5 {
        script.move_to(at + DVec2::new(0.0, 20.0 * f64::from(step)));
        assert_eq!(corners(&script.scene().guides.border), before);
    }
    script.key(Key::Escape);
    assert_eq!(corners(&script.scene().guides.border), before);
    // A field that changes another vertex makes it stale.
    let curve = script.curve();
    let moves = vec![(3, DVec3::new(1.0, 2.0, 0.0))];
    script
        .editor
        .preview("field", vec![Edit::MoveVertices { curve, moves }]);
    assert!(script.scene().guides.border.is_empty());
    script.editor.abort_preview();
    assert_eq!(corners(&script.scene().guides.border), before);
}

#[test]
fn curves_that_have_no_region_say_why() {
    let mut script = shown("arc");
    let place = |i: u32| DVec3::new(f64::from(i), f64::from(i * i) / 9.0, f64::from(i % 3));
    let polygon = FloatPolygon::new(4, (0..9).map(place).collect(), None, false);
    let polygon = polygon.expect("a polygon");
    script.set_polygon(polygon);
    script.command(Command::FitAll);
    select(&mut script, 4);
    let guides = finest(&mut script);
    assert!(guides.border.is_empty() && guides.labels.len() == 1);
    let text = &guides.labels[0].text;
    assert!(text.contains("planar curves"), "{text}");
}

#[test]
fn regions_are_of_the_active_curve_periodic_ones_too() {
    let (mut script, [arc, other]) = several::two();
    script.command(Command::ToggleLayer(Layer::SafeRegion));
    script.editor.select_vertex(other, 4, false);
    assert_eq!(script.curve(), other);
    let of_other = finest(&mut script);
    assert!(!of_other.border.is_empty() || !of_other.limit.is_empty());
    script.editor.activate(arc);
    assert!(finest(&mut script).border.is_empty());
    let mut script = shown("periodic");
    for vertex in [0, script.polygon().vertices().len() - 1] {
        select(&mut script, vertex);
        let guides = finest(&mut script);
        assert!(!guides.border.is_empty() || !guides.limit.is_empty());
    }
    // What is locked cannot be moved anywhere.
    script.command(Command::ToggleLocked);
    assert!(finest(&mut script).labels.is_empty());
}

#[test]
fn in_the_background_regions_come_from_coarse_to_fine_and_never_stale() {
    let mut script = shown("bottle");
    let (sender, woken) = channel();
    let wake = move || sender.send(()).unwrap_or_default();
    script.editor.run_in_background(Duration::ZERO, wake);
    for vertex in [4, 5, 6] {
        select(&mut script, vertex);
    }
    let mut seen = Vec::new();
    while seen.last().is_none_or(|count| *count < 96) {
        woken.recv_timeout(LONG).expect("the frame is woken");
        let guides = &script.scene().guides;
        let count = corners(&guides.border).len() + corners(&guides.limit).len();
        if count > 0 && seen.last() != Some(&count) {
            seen.push(count);
        }
    }
    assert!(seen.is_sorted(), "{seen:?}");
    let fine = corners(&script.scene().guides.border);
    let mut inline = shown("bottle");
    select(&mut inline, 6);
    assert_eq!(border(&mut inline), fine);
}

/// Choose the first feature of a kind on the canvas, while no vertex lies over it.
fn choose(script: &mut Script, kind: FeatureKind) -> f64 {
    script.command(Command::ToggleLayer(Layer::Float));
    let marks = script.scene().curves[0].features.clone();
    let mark = marks.iter().find(|mark| mark.kind == kind);
    let mark = *mark.expect("a feature");
    let at = script.editor.view().viewport().to_screen(mark.at);
    script.click(at);
    script.command(Command::ToggleLayer(Layer::Float));
    mark.u
}

/// Check that what each arrow shows is proved to lose a feature.
fn check_arrows(before: &FloatPolygon, guides: &GuideScene) {
    let features = Features::new(before);
    let count = |features: &Features| features.curvature_extrema.len() + features.inflections.len();
    let lengths = guides.arrows.iter();
    let lengths = lengths.map(|arrow| arrow.ends[0].distance(arrow.ends[1]));
    assert!(lengths.is_sorted());
    for (rank, arrow) in guides.arrows.iter().enumerate() {
        assert_eq!(arrow.is_shortest, rank == 0);
        let [from, to] = arrow.ends.map(|end| end.extend(0.0));
        let vertex = before.vertices().iter().position(|vertex| *vertex == from);
        let mut moved = before.clone();
        let place = [(vertex.expect("a vertex"), to)];
        moved.move_vertices(place).expect("a place");
        let after = Features::new(&moved);
        assert!(count(&after) < count(&features));
        assert!(FeatureRise::between(&features, &after).is_none());
    }
}

#[test]
fn the_moves_that_lose_a_chosen_feature_are_shown_and_do_lose_it() {
    let kinds = [
        FeatureKind::CurvatureMaximum,
        FeatureKind::CurvatureMinimum,
        FeatureKind::Inflection,
    ];
    let mut lost = Vec::new();
    for name in ["bottle", "hull", "s-curve", "periodic"] {
        let mut script = Script::example(name);
        let report = script.features().expect("features");
        for row in report.rows.iter().filter(|row| kinds.contains(&row.kind)) {
            script.editor.look(Look::Feature(row.middle));
            let guides = script.scene().guides.clone();
            assert!(!guides.labels.is_empty() && guides.labels.len() <= 3);
            check_arrows(&script.polygon(), &guides);
            if guides.arrows.is_empty() {
                let text = &guides.labels[0].text;
                assert!(text.starts_with("No move of one vertex found"), "{text}");
            } else {
                lost.push((name, row.kind));
            }
        }
    }
    // The shape of the others needs their features: a vertex alone loses none without adding one.
    let expected = [FeatureKind::CurvatureMaximum, FeatureKind::CurvatureMinimum];
    assert_eq!(lost, expected.map(|kind| ("s-curve", kind)));
}

#[test]
fn the_moves_stay_while_a_vertex_is_dragged_and_go_once_the_curve_has_changed() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    let u = choose(&mut script, FeatureKind::CurvatureMaximum);
    assert_eq!(script.editor.view().chosen_feature(), Some(u));
    let guides = script.scene().guides.clone();
    assert!(!guides.arrows.is_empty(), "{:?}", guides.labels);
    let vertex = script.at_vertex(3);
    let by = DVec2::new(20.0, 10.0);
    script.press(vertex);
    script.move_to(vertex + by);
    assert_eq!(script.scene().guides.arrows, guides.arrows);
    script.release(vertex + by);
    assert!(script.scene().guides.arrows.is_empty());
    assert_eq!(script.editor.view().chosen_feature(), None);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
}

#[test]
fn a_feature_is_let_go_when_it_is_chosen_again() {
    let mut script = Script::example("bottle");
    let u = choose(&mut script, FeatureKind::Inflection);
    assert_eq!(script.editor.view().chosen_feature(), Some(u));
    let guides = script.scene().guides.clone();
    assert!(!guides.labels.is_empty());
    script.editor.look(Look::Feature(u));
    assert_eq!(script.editor.view().chosen_feature(), None);
    assert!(script.scene().guides.labels.is_empty());
    // From the list, and of another curve nothing.
    script.editor.look(Look::Feature(u));
    let other = Curve::new("other", Script::example("arc").polygon());
    let add = Edit::Add(Box::new(other));
    script.editor.apply("add", vec![add]).expect("an edit");
    let own = script.curve();
    let mut curves = script.editor.document().ids();
    let other = curves.find(|id| *id != own).expect("the other curve");
    drop(curves);
    script.editor.activate(other);
    assert!(script.scene().guides.labels.is_empty());
    assert_eq!(script.editor.view().chosen_feature(), None);
}
