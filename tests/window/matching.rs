//! The end-fit panel: matching to other curves, and the fields of curvature and slope.

use batten::document::{Curve, Document};
use batten::editor::{Command, Editor, ToolKind, told};
use batten::geometry::{Continuity, End, FloatPolygon};
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use glam::DVec3;

use crate::hand::*;
use crate::numbers::{click_events, enter, in_one_frame, strike, wave};

/// A curve "right" and one to its left; the end-fit tool works on the start of the first.
fn window() -> Window {
    let left = wave(8, 4);
    let vertices = left
        .vertices()
        .iter()
        .map(|at| *at + DVec3::new(9.0, 1.0, 0.0));
    let right = FloatPolygon::new(4, vertices.collect(), None, false).expect("a polygon");
    let curves = [Curve::new("right", right), Curve::new("left", left)];
    let mut editor = Editor::with_document(Document::from_curves(curves));
    told(editor.execute(Command::Tool(ToolKind::EndFit)));
    let mut window = open_window_with(editor, 1480.0, 1300.0);
    click(&mut window, "Start");
    window
}

fn click_on(window: &mut Window, point: DVec3) {
    let at = place(window, point.truncate());
    in_one_frame(window, click_events(at));
}

fn document(window: &Window) -> Document {
    window.state().editor().document().clone()
}

#[test]
fn curvature_and_slope_are_fixed_typed_and_freed() {
    let mut window = window();
    click(&mut window, "Use current end");
    let target = |window: &Window| curve(window).targets.start.expect("a target");
    assert_eq!(target(&window).curvature, None);
    click(&mut window, "Require curvature");
    let actual = curve(&window)
        .polygon
        .end_jet(End::Start)
        .signed_curvature();
    assert_eq!(target(&window).curvature, Some(actual));
    window.get_by_label("target curvature").click();
    window.run();
    strike(&mut window, "0.25");
    enter(&mut window);
    assert_eq!(target(&window).curvature, Some(0.25));
    for (radius, curvature) in [("R8", 0.125), ("r=-2", -0.5), ("1/4", 0.25)] {
        window.get_by_label("target curvature").click();
        window.run();
        strike(&mut window, radius);
        enter(&mut window);
        assert_eq!(target(&window).curvature, Some(curvature), "{radius}");
    }
    click(&mut window, "Require curvature slope");
    window.get_by_label("target curvature slope").click();
    window.run();
    strike(&mut window, "-0.5");
    enter(&mut window);
    assert_eq!(target(&window).slope, Some(-0.5));
    click(&mut window, "Require curvature");
    assert_eq!(
        (target(&window).curvature, target(&window).slope),
        (None, None)
    );
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(
        (target(&window).curvature, target(&window).slope),
        (Some(0.25), Some(-0.5))
    );
}

#[test]
fn a_match_is_picked_shown_and_removed() {
    let mut window = window();
    click(&mut window, "G0");
    click(&mut window, "Keep picks matched");
    click(&mut window, "Pick from curve");
    let source = document(&window)
        .curves()
        .last()
        .expect("a curve")
        .1
        .polygon
        .clone();
    click_on(&mut window, source.end_jet(End::Finish).point);
    let matches = document(&window).matches().copied().collect::<Vec<_>>();
    assert_eq!(matches.len(), 1, "{:?}", window.state().editor().message());
    assert_eq!(matches[0].continuity, Continuity::G0);
    window.get_by_label_contains("Matched to “left” at its end");
    click(&mut window, "G1");
    assert_eq!(
        document(&window)
            .matches()
            .next()
            .expect("a match")
            .continuity,
        Continuity::G1
    );

    // The other curve tells who follows it: a click makes it the active one.
    click_on(&mut window, source.point(1.5));
    window.get_by_label_contains("The start of “right” is matched to this curve");
    click(&mut window, "curve right");
    click(&mut window, "Remove match");
    assert_eq!(document(&window).matches().len(), 0);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(document(&window).matches().len(), 1);
    click(&mut window, "Clear");
    assert_eq!(document(&window).matches().len(), 0);
    assert_eq!(curve(&window).targets.start, None);
}

#[test]
fn a_picked_target_has_what_its_level_asks_for() {
    let mut window = window();
    let source = document(&window)
        .curves()
        .last()
        .expect("a curve")
        .1
        .clone();
    click(&mut window, "Pick from curve");
    click_on(&mut window, source.polygon.end_jet(End::Finish).point);
    let parts = |window: &Window| {
        let target = curve(window).targets.start.expect("a target");
        [
            target.direction.is_some(),
            target.curvature.is_some(),
            target.slope.is_some(),
        ]
    };
    assert_eq!(parts(&window), [true, false, false]);
    for (level, expected) in [
        ("G3", [true, true, true]),
        ("G0", [false, false, false]),
        ("G2", [true, true, false]),
    ] {
        click(&mut window, level);
        assert_eq!(parts(&window), expected, "{level}");
    }
    assert_eq!(document(&window).matches().len(), 0);
    // A target that was changed by hand since is not picked again.
    click(&mut window, "Flip direction");
    let flipped = curve(&window).targets;
    click(&mut window, "G3");
    assert_eq!(curve(&window).targets, flipped);
}

#[test]
fn a_joint_is_listed_gone_to_and_matched() {
    let whole = wave(20, 5);
    let cut = |from: f64, to: f64| whole.trimmed(from, to, 0).expect("a part").polygon;
    let [left, right] = [cut(0.0, 6.0), cut(6.0, 15.0)];
    let moved = right.vertices().iter().map(|at| *at + 1e-4 * DVec3::Y);
    let right = FloatPolygon::new(5, moved.collect(), None, false).expect("a polygon");
    let curves = [Curve::new("left", left), Curve::new("right", right)];
    let editor = Editor::with_document(Document::from_curves(curves));
    let mut window = open_window_with(editor, 1480.0, 1300.0);
    click(&mut window, "Joints");
    let gap = |window: &Window| {
        let joints = window.state().editor().sight().joints();
        joints.all().first().expect("a joint").joint.gap
    };
    assert!((gap(&window) - 1e-4).abs() < 1e-12);
    let scale = |window: &Window| window.state().editor().view().viewport().scale;
    let before = scale(&window);
    click(&mut window, "Joint G3: left end – right start");
    assert!(scale(&window) > before);
    click(&mut window, "Match left end – right start");
    window.get_by_label("end of left follows G0");
    click(&mut window, "start of right follows G2");
    let matched = *document(&window).matches().next().expect("a match");
    assert_eq!(
        (matched.end, matched.continuity),
        (End::Start, Continuity::G2)
    );
    assert!(gap(&window) < 1e-12);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(document(&window).matches().len(), 0);
    // Without an end within the tolerance there is none.
    window.get_by_label("Joint tolerance").click();
    window.run();
    strike(&mut window, "1e-5");
    enter(&mut window);
    assert_eq!(window.state().editor().sight().joints().all(), []);
    window.get_by_label_contains("No ends of visible curves meet here");
}
