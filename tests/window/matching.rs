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
    click(&mut window, "Keep matched");
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
