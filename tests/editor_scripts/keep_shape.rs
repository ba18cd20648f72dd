//! Inserting and deleting vertices: the curve keeps its shape, or the other vertices stay.

use batten::document::{Curve, CurveId, Document, Edit, EndMatch, MatchPlace};
use batten::editor::{Command, Editor, Input, Look, ToolKind};
use batten::geometry::{Continuity, End, FloatPolygon};
use glam::{DVec2, DVec3};

use super::script::Script;
use super::several::two;

/// What a curve may be off beyond what is told: rounding, as a share of its size.
const ROUNDING: f64 = 1e-12;

/// A script with one curve, seen whole.
fn of(polygon: FloatPolygon) -> Script {
    let document = Document::from_curves(vec![Curve::new("curve", polygon)]);
    let mut script = Script {
        editor: Editor::with_document(document),
    };
    script.editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    script.check();
    script.command(Command::FitAll);
    script
}

/// An arch of so many vertices, lifted out of the plane by `rise`.
fn arch(degree: usize, count: usize, rise: f64, weights: Option<Vec<f64>>) -> FloatPolygon {
    let vertices = (0..count).map(|index| {
        let t = index as f64 / (count - 1) as f64;
        DVec3::new(10.0 * t, 6.0 * t * (1.0 - t) + 0.4 * t * t, rise * t * t)
    });
    FloatPolygon::new(degree, vertices.collect(), weights, false).expect("a polygon")
}

/// A ring of so many vertices.
fn ring(degree: usize, count: usize) -> FloatPolygon {
    let vertices = (0..count).map(|index| {
        let (sin, cos) = (std::f64::consts::TAU * index as f64 / count as f64).sin_cos();
        DVec3::new(5.0 * cos, 3.0 * sin, 0.0)
    });
    FloatPolygon::new(degree, vertices.collect(), None, true).expect("a polygon")
}

/// The curves that are tried, by what they are.
fn kinds() -> Vec<(&'static str, FloatPolygon)> {
    let bump = |t: f64| 1.0 + t * (1.0 - t);
    let weights = (0..12).map(|index| bump(f64::from(index) / 11.0)).collect();
    vec![
        ("plane", arch(5, 12, 0.0, None)),
        ("cubic", arch(3, 9, 0.0, None)),
        ("space", arch(4, 11, 3.0, None)),
        ("rational", arch(5, 12, 0.0, Some(weights))),
        ("periodic", ring(4, 14)),
        ("single segment", arch(6, 7, 0.0, None)),
    ]
}

/// How far two curves are apart in the parameter that runs evenly along both.
fn apart(before: &FloatPolygon, after: &FloatPolygon) -> f64 {
    let [of_before, of_after] = [before, after].map(|polygon| polygon.segments() as f64);
    let shares = (0..=2000).map(|step| f64::from(step) / 2000.0);
    let off = shares.map(|t| {
        before
            .point(t * of_before)
            .distance(after.point(t * of_after))
    });
    off.fold(0.0, f64::max)
}

fn keeps_ends(name: &str, before: &FloatPolygon, after: &FloatPolygon) {
    if before.is_periodic() {
        return;
    }
    for end in End::BOTH {
        let [a, b] = [before, after].map(|polygon| polygon.end_jet(end));
        let off = a.point.distance(b.point);
        assert!(off <= ROUNDING * before.size(), "{name}: {off:e}");
        let turned = a.first.normalize().cross(b.first.normalize()).length();
        assert!(turned <= 1e-9, "{name}: {turned:e}");
    }
}

/// How far a text says that the curve moves.
fn told(text: &str) -> f64 {
    if text.contains("No deviation") {
        return 0.0;
    }
    let figure = text.split("at most ").nth(1).expect("a figure");
    let figure = figure.split([';', ' ']).next().expect("a figure");
    figure.parse().expect("a number")
}

/// The middle of a leg on the canvas.
fn leg(script: &Script, index: usize) -> DVec2 {
    0.5 * (script.at_vertex(index) + script.at_vertex(index + 1))
}

#[test]
fn an_inserted_vertex_keeps_the_curve_and_says_before_how_well() {
    for (name, polygon) in kinds() {
        let mut script = of(polygon.clone());
        script.tool(ToolKind::Insert);
        let place = leg(&script, 3);
        script.move_to(place);
        let hint = script.editor.hint();
        let steps = script.steps();
        script.click(place);
        let after = script.polygon();
        let count = polygon.vertices().len();
        assert_eq!(after.vertices().len(), count + 1, "{name}");
        assert_eq!(script.steps(), steps + 1, "{name}");
        assert_eq!(script.selected(), [4], "{name}");
        let off = apart(&polygon, &after);
        let allowed = told(&hint) + ROUNDING * polygon.size();
        assert!(off <= allowed, "{name}: {off:e}, {hint}");
        assert!(off <= 2e-4 * polygon.size(), "{name}: {off:e}");
        keeps_ends(name, &polygon, &after);
        script.command(Command::Undo);
        assert_eq!(script.polygon(), polygon, "{name}");
    }
}

#[test]
fn a_vertex_is_inserted_at_a_click_on_the_curve_far_from_its_legs() {
    let polygon = arch(3, 9, 0.0, None);
    let mut script = of(polygon.clone());
    script.tool(ToolKind::Insert);
    let viewport = script.editor.view().viewport();
    let at = |u: f64| viewport.to_screen(viewport.flatten(polygon.point(u)));
    // The curve is close to the legs of a cubic: zoom in until they are far.
    let middle = at(2.5);
    script.input(Input::Zoomed {
        at: middle,
        factor: 30.0,
    });
    script.click(middle);
    assert_eq!(
        script.polygon().vertices().len(),
        10,
        "{}",
        script.message()
    );
    let off = apart(&polygon, &script.polygon());
    assert!(off <= 2e-4 * polygon.size(), "{off:e}");
}

#[test]
fn a_vertex_in_a_single_segment_leaves_the_curve_itself() {
    let polygon = arch(6, 7, 0.0, None);
    let mut script = of(polygon.clone());
    script.tool(ToolKind::Insert);
    script.move_to(leg(&script, 2));
    assert!(script.editor.hint().contains("No deviation"));
    script.click(leg(&script, 2));
    let message = script.message();
    assert!(message.contains("eviation"), "{message}");
    let off = apart(&polygon, &script.polygon());
    assert!(off <= ROUNDING * polygon.size(), "{off:e}");
}

#[test]
fn a_deleted_vertex_keeps_the_curve_by_tool_and_by_command() {
    for (name, polygon) in kinds() {
        let count = polygon.vertices().len();
        for by_command in [false, true] {
            let mut script = of(polygon.clone());
            let place = script.at_vertex(4);
            let told_text = if by_command {
                script.click(place);
                script.command(Command::Delete);
                script.message()
            } else {
                script.tool(ToolKind::Delete);
                script.move_to(place);
                let hint = script.editor.hint();
                script.click(place);
                hint
            };
            let after = script.polygon();
            if name == "single segment" {
                assert_eq!(after, polygon);
                assert!(told_text.contains("lower its degree"), "{told_text}");
                continue;
            }
            assert_eq!(after.vertices().len(), count - 1, "{name}");
            let off = apart(&polygon, &after);
            let allowed = told(&told_text) + ROUNDING * polygon.size();
            assert!(off <= allowed, "{name}: {off:e}, {told_text}");
            assert!(off <= 0.01 * polygon.size(), "{name}: {off:e}");
            keeps_ends(name, &polygon, &after);
            assert_eq!(script.steps(), 1, "{name}");
            script.command(Command::Undo);
            assert_eq!(script.polygon(), polygon, "{name}");
        }
    }
}

#[test]
fn features_that_a_deletion_changes_are_named_before_the_click() {
    // A wave that fewer vertices cannot follow.
    let wave = (0..9).map(|index| {
        let y = if index % 2 == 0 { 1.0 } else { -1.0 };
        DVec3::new(f64::from(index), y, 0.0)
    });
    let polygon = FloatPolygon::new(3, wave.collect(), None, false).expect("a polygon");
    let mut script = of(polygon);
    script.tool(ToolKind::Delete);
    script.move_to(script.at_vertex(4));
    let hint = script.editor.hint();
    assert!(
        hint.contains("extrema") && hint.contains(" before, "),
        "{hint}"
    );
}

#[test]
fn what_is_inserted_and_dragged_begins_where_it_keeps_the_shape() {
    let polygon = arch(5, 12, 0.0, None);
    let mut clicked = of(polygon.clone());
    clicked.tool(ToolKind::Insert);
    let place = leg(&clicked, 5);
    clicked.click(place);
    let kept = clicked.polygon();

    let mut script = of(polygon.clone());
    script.tool(ToolKind::Insert);
    script.drag(place, place + DVec2::new(8.0, -12.0));
    let dragged = script.polygon();
    let scale = script.editor.view().viewport().pixel();
    for (index, (a, b)) in kept.vertices().iter().zip(dragged.vertices()).enumerate() {
        let expected = match index {
            6 => DVec3::new(8.0 * scale, 12.0 * scale, 0.0),
            _ => DVec3::ZERO,
        };
        let off = (*b - *a - expected).length();
        assert!(off <= 1e-9 * polygon.size(), "{index}: {off:e}");
    }
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), polygon);

    // Back where it began, it is the click.
    script.press(place);
    script.move_to(place + 20.0);
    script.move_to(place);
    script.release(place);
    assert_eq!(script.polygon(), kept);
}

#[test]
fn without_it_the_other_vertices_stay() {
    let polygon = arch(5, 12, 0.0, None);
    let mut script = of(polygon.clone());
    script.command(Command::ToggleKeepShape);
    script.tool(ToolKind::Insert);
    script.click(leg(&script, 3));
    let after = script.polygon();
    assert_eq!(after.vertices()[..4], polygon.vertices()[..4]);
    assert_eq!(after.vertices()[5..], polygon.vertices()[4..]);
    // The switch stays in a new document.
    script.editor.open_example(0).expect("an example");
    let kept = Command::ToggleKeepShape.is_checked(&script.editor);
    assert_eq!(kept, Some(false));
}

#[test]
fn locked_vertices_locked_and_hidden_curves_are_left_with_the_reason() {
    let polygon = arch(5, 12, 0.0, None);
    let lock = |script: &mut Script| {
        let edit = Edit::SetVerticesLocked {
            curve: script.curve(),
            vertices: vec![7],
            locked: true,
        };
        script.editor.apply("lock", vec![edit]).expect("a lock");
    };
    for tool in [ToolKind::Insert, ToolKind::Delete] {
        let mut script = of(polygon.clone());
        lock(&mut script);
        let steps = script.steps();
        script.tool(tool);
        let place = match tool {
            ToolKind::Insert => leg(&script, 3),
            _ => script.at_vertex(3),
        };
        script.move_to(place);
        assert!(script.editor.hint().contains("vertex 7"), "{tool:?}");
        script.click(place);
        assert_eq!(script.polygon(), polygon, "{tool:?}");
        let message = script.message();
        assert!(message.contains("Keep shape"), "{message}");
        assert_eq!(script.steps(), steps, "{tool:?}");

        for attribute in [Command::ToggleLocked, Command::ToggleVisible] {
            let mut script = of(polygon.clone());
            script.command(attribute);
            let steps = script.steps();
            script.tool(tool);
            script.click(place);
            assert_eq!(script.polygon(), polygon, "{tool:?} {attribute:?}");
            assert_eq!(script.steps(), steps, "{tool:?} {attribute:?}");
        }
    }
}

#[test]
fn a_matched_end_stays_matched() {
    for continuity in [Continuity::G1, Continuity::G2, Continuity::G3] {
        for tool in [ToolKind::Insert, ToolKind::Delete] {
            let second = arch(5, 12, 0.0, None);
            let shift = DVec3::new(10.5, 1.0, 0.0);
            let vertices = second.vertices().iter().map(|vertex| *vertex + shift);
            let second = FloatPolygon::new(5, vertices.collect(), None, false);
            let curves = vec![
                Curve::new("first", arch(5, 12, 0.0, None)),
                Curve::new("second", second.expect("a polygon")),
            ];
            let document = Document::from_curves(curves);
            let ids: Vec<CurveId> = document.ids().collect();
            let matched = EndMatch {
                curve: ids[1],
                end: End::Start,
                source: ids[0],
                place: MatchPlace::End(End::Finish),
                continuity,
                reversed: false,
            };
            let document = document.edited([Edit::SetMatch(matched)]).expect("a match");
            let mut script = Script {
                editor: Editor::with_document(document),
            };
            script.editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
            script.command(Command::FitAll);
            for changed in [ids[1], ids[0]] {
                script.editor.activate(changed);
                let before = script.polygon();
                script.tool(tool);
                let place = match tool {
                    ToolKind::Insert => leg(&script, 5),
                    _ => script.at_vertex(5),
                };
                script.click(place);
                assert_ne!(script.polygon(), before, "{}", script.message());
                let is_met = script.editor.document().meets(&matched);
                assert!(is_met, "{continuity:?} {tool:?}");
            }
        }
    }
}

#[test]
fn other_curves_stay_and_a_cut_takes_just_what_it_copies() {
    let (mut script, [arc, other]) = two();
    let polygon_of = |script: &Script, id| {
        let curve = script.editor.document().curve(id).expect("a curve");
        curve.polygon.clone()
    };
    let [kept, before] = [arc, other].map(|id| polygon_of(&script, id));
    script.editor.activate(other);
    script.tool(ToolKind::Insert);
    script.click(leg(&script, 6));
    assert_eq!(polygon_of(&script, arc), kept);
    assert_ne!(polygon_of(&script, other), before);
    script.command(Command::Undo);
    script.tool(ToolKind::Select);
    script.editor.select_vertex(other, 0, false);
    script.editor.cut().expect("the vertex");
    assert_eq!(
        polygon_of(&script, other).vertices(),
        &before.vertices()[1..]
    );
}
