//! Measuring: what it snaps to, arc lengths, and how long a measurement stays.

use batten::editor::{Command, Key, Mark, NamedView, ToolKind};
use batten::geometry::{End, FloatPolygon, arc_length_between, significant};
use glam::{DVec2, DVec3};

use super::script::Script;

/// Half of the last digit that is written, in units of the first.
const DIGIT: f64 = 0.5e-7;

/// The figures that are written at the ruler.
fn written(script: &mut Script) -> Option<String> {
    let label = script.scene().marks.iter().find_map(|mark| match mark {
        Mark::Measured(_, figures) => {
            let lines = figures
                .iter()
                .map(|it| it.text(|length| significant(length, 8)));
            Some(lines.collect::<Vec<String>>().join("\n"))
        }
        _ => None,
    });
    let is_ruled = script
        .scene()
        .marks
        .iter()
        .any(|it| matches!(it, Mark::Ruler(_)));
    label.filter(|_| is_ruled)
}

/// The numbers of the line that begins with a word.
#[track_caller]
fn numbers(text: &str, word: &str) -> Vec<f64> {
    let line = text.lines().find(|line| line.starts_with(word));
    let line = line.unwrap_or_else(|| panic!("no {word} in {text}"));
    line.split(' ').filter_map(|it| it.parse().ok()).collect()
}

fn seen(script: &Script, point: DVec3) -> DVec2 {
    let viewport = script.editor.view().viewport();
    viewport.to_screen(viewport.flatten(point))
}

fn end_of(script: &Script, end: End) -> DVec2 {
    seen(script, script.polygon().end_jet(end).point)
}

fn measure(script: &mut Script, from: DVec2, to: DVec2) -> String {
    script.tool(ToolKind::Measure);
    script.click(from);
    script.click(to);
    written(script).expect("figures")
}

#[test]
fn between_both_ends_the_arc_is_the_whole_curve() {
    for name in ["arc", "s-curve", "hull"] {
        for view in [NamedView::Xy, NamedView::Isometric] {
            let mut script = Script::example(name);
            script.command(Command::View(view));
            let (from, to) = (end_of(&script, End::Start), end_of(&script, End::Finish));
            // A little beside them: ends attract.
            let text = measure(&mut script, from + DVec2::new(2.0, -2.0), to);
            let polygon = script.polygon();
            let [found] = numbers(&text, "Arc")[..] else {
                panic!("{text}");
            };
            let whole = polygon.arc_length(1e-13);
            assert!((found - whole).abs() <= DIGIT * whole, "{name}: {text}");
            let chord = polygon.end_jet(End::Finish).point - polygon.end_jet(End::Start).point;
            assert!((numbers(&text, "Δx")[0] - chord.x).abs() <= DIGIT * whole);
            assert!((numbers(&text, "Δy")[0] - chord.y).abs() <= DIGIT * whole);
        }
    }
}

#[test]
fn between_two_points_of_a_periodic_curve_there_are_two_arcs() {
    let mut script = Script::example("periodic");
    let polygon = script.polygon();
    let [u, v] = [1.25, 4.5].map(|u| polygon.jet(u).point);
    let (from, to) = (seen(&script, u), seen(&script, v));
    let text = measure(&mut script, from, to);
    let found = numbers(&text, "Arc");
    let whole = polygon.arc_length(1e-13);
    assert_eq!(found.len(), 2, "{text}");
    assert!(
        (found[0] + found[1] - whole).abs() <= 2.0 * DIGIT * whole,
        "{text}"
    );
    let expected = arc_length_between(&polygon, 1.25, 4.5, 1e-13);
    // The pointer is on the curve only to a part of a pixel.
    let near = |it: &f64| (it - expected).abs() < 0.1 * script.editor.view().viewport().pixel();
    assert!(found.iter().any(near), "{text} against {expected}");
}

#[test]
fn arcs_add_up_to_the_whole_and_agree_with_many_chords() {
    let polygon = Script::example("s-curve").polygon();
    let length = |from: f64, to: f64| arc_length_between(&polygon, from, to, 1e-13);
    let last = polygon.segments() as f64;
    let whole = polygon.arc_length(1e-13);
    assert!((length(0.0, last) - whole).abs() <= 1e-13 * whole);
    for u in [0.0, 0.3, 1.0, 1.7, last] {
        let sum = length(0.0, u) + length(u, last);
        assert!((sum - whole).abs() <= 1e-13 * whole, "{u}");
        assert_eq!(length(u, u), 0.0);
    }
    assert_eq!(length(2.0, 1.0), 0.0);
    let count = 20_000;
    let point = |step: i32| {
        polygon
            .jet(0.3 + 1.4 * f64::from(step) / f64::from(count))
            .point
    };
    let chords: f64 = (0..count)
        .map(|step| point(step).distance(point(step + 1)))
        .sum();
    // Chords are shorter by a share of κ² h² / 24.
    let off = (length(0.3, 1.7) - chords) / chords;
    assert!((0.0..1e-8).contains(&off), "{off:e}");
}

#[test]
fn vertices_attract_and_beside_curves_there_is_no_arc() {
    let mut script = Script::example("s-curve");
    let (from, to) = (script.at_vertex(1), script.at_vertex(3));
    let text = measure(
        &mut script,
        from + DVec2::splat(2.0),
        to - DVec2::splat(2.0),
    );
    let leg = script.polygon().vertex(3) - script.polygon().vertex(1);
    assert!((numbers(&text, "Δx")[0] - leg.x).abs() <= DIGIT * leg.length());
    assert!((numbers(&text, "Δy")[0] - leg.y).abs() <= DIGIT * leg.length());
    assert!(!text.contains("Arc"), "{text}");
    // A hidden curve attracts nothing.
    script.command(Command::ToggleVisible);
    let at = script.at_vertex(2) + DVec2::new(2.3, 1.7);
    script.tool(ToolKind::Measure);
    script.move_to(at);
    let snaps = |mark: &Mark| matches!(mark, Mark::Snap(place) if *place == at);
    assert!(!script.scene().marks.iter().any(snaps));
    let ends = End::BOTH.map(|end| end_of(&script, end));
    let text = measure(&mut script, ends[0], ends[1]);
    assert!(!text.contains("Arc"), "{text}");
}

#[test]
fn a_measurement_stays_until_it_is_dismissed_or_another_is_begun() {
    let mut script = Script::example("s-curve");
    let (from, to) = (end_of(&script, End::Start), end_of(&script, End::Finish));
    let text = measure(&mut script, from, to);
    for tool in [ToolKind::Draw, ToolKind::Rotate, ToolKind::Select] {
        script.tool(tool);
        assert_eq!(written(&mut script).as_ref(), Some(&text), "{tool:?}");
    }
    // Esc takes it away before anything else, and then does what it does anyway.
    script.click(script.at_vertex(2));
    script.key(Key::Escape);
    assert_eq!(written(&mut script), None);
    assert_eq!(script.selected(), [2]);
    script.key(Key::Escape);
    assert!(script.selected().is_empty());
    assert_eq!(script.steps(), 0);

    measure(&mut script, from, to);
    script.click(from);
    script.move_to(DVec2::new(300.0, 300.0));
    let text = written(&mut script).expect("the next measurement");
    assert!(!text.contains("Arc"), "{text}");
    script.key(Key::Escape);
    assert_eq!(written(&mut script), None);
    script.key(Key::Escape);
    assert_eq!(script.editor.hand().tool(), ToolKind::Select);
}

#[test]
fn the_arc_follows_a_curve_that_changes_between_its_points() {
    let mut script = Script::example("hull");
    let (from, to) = (end_of(&script, End::Start), end_of(&script, End::Finish));
    let first = measure(&mut script, from, to);
    let polygon = script.polygon();
    let middle = polygon.vertices().len() / 2;
    script.tool(ToolKind::Select);
    script.drag_vertex(middle, DVec2::new(7.0, -40.0));
    let ends = |polygon: &FloatPolygon| End::BOTH.map(|end| polygon.end_jet(end).point);
    assert_eq!(ends(&polygon), ends(&script.polygon()));
    let text = written(&mut script).expect("it stays");
    let found = numbers(&text, "Arc")[0];
    let whole = script.polygon().arc_length(1e-13);
    assert!((found / whole - 1.0).abs() < 1e-4, "{text} against {whole}");
    assert!((found - numbers(&first, "Arc")[0]).abs() > 1e-3 * whole);
    // Once an end has moved there is no arc between the points any more.
    script.drag_vertex(0, DVec2::new(-30.0, 20.0));
    let text = written(&mut script).expect("it stays");
    assert!(!text.contains("Arc"), "{text}");
    script.command(Command::Undo);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), polygon);
}
