//! Curves that stay symmetric, edited by hand.

use batten::document::{Curve, Document, Edit, EndMatch, MatchPlace};
use batten::editor::{Command, Editor, EndFitAction, Follow, Look, Modifiers, ToolKind};
use batten::geometry::{Continuity, End, FloatPolygon, Mirror};
use batten::operations::Value;
use glam::{DMat3, DVec2, DVec3};

use super::common::check_symmetry;
use super::laws::check_written;
use super::script::Script;

/// Half of the vertices of a vase, from its middle on.
const HALF: [(f64, f64); 6] = [
    (8.0, 0.0),
    (30.0, 4.0),
    (42.0, 30.0),
    (34.0, 60.0),
    (22.0, 80.0),
    (26.0, 100.0),
];

/// A script with a vase that stays symmetric about the y axis, and a curve beside it.
fn vase() -> Script {
    let image = HALF.iter().rev().map(|(x, y)| (-x, *y));
    let vertices: Vec<(f64, f64)> = image.chain(HALF).collect();
    let vase = FloatPolygon::planar(4, &vertices).expect("a polygon");
    let beside = [(60.0, 0.0), (70.0, 30.0), (62.0, 60.0), (70.0, 90.0)];
    let beside = FloatPolygon::planar(3, &beside).expect("a polygon");
    let curves = [Curve::new("vase", vase), Curve::new("beside", beside)];
    let document = Document::from_curves(curves);
    let mut script = Script {
        editor: Editor::with_document(document),
    };
    script.editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    script.check();
    script.command(Command::FitAll);
    script.command(Command::ToggleSymmetric);
    script
}

fn curve(script: &Script) -> Curve {
    let document = script.editor.document();
    let curve = document.curve(script.curve()).expect("the vase");
    Curve::clone(curve)
}

#[track_caller]
fn check(script: &Script) {
    let curve = curve(script);
    assert!(curve.symmetry.is_some(), "{}", script.message());
    check_symmetry(&curve).expect("a symmetric curve");
}

fn mirror(script: &Script) -> Mirror {
    curve(script).symmetry.expect("a rule").mirror()
}

#[test]
fn a_vertex_moves_its_image_and_undo_moves_both_back() {
    let mut script = vase();
    assert_eq!(mirror(&script), Mirror::of_coordinate(0));
    let before = script.polygon();
    let last = before.vertices().len() - 1;
    let steps = script.steps();
    for index in [2, 9, 5, 6] {
        let polygon = script.polygon();
        script.drag_vertex(index, DVec2::new(23.0, -17.0));
        check(&script);
        let now = script.polygon();
        let moved = now.moved_vertices(&polygon);
        let mut both = [index, last - index];
        both.sort_unstable();
        assert_eq!(moved, both);
    }
    assert_eq!(script.steps(), steps + 4);
    for _ in 0..4 {
        script.command(Command::Undo);
    }
    assert_eq!(script.polygon(), before);
}

#[test]
fn half_a_drag_is_half_the_change_with_every_way_of_following() {
    for follow in [None, Some(Follow::Softly), Some(Follow::InHarmony)] {
        let moves = [0.5, 1.0].map(|share| {
            let mut script = vase();
            if let Some(follow) = follow {
                script.command(Command::Follow(follow));
            }
            let before = script.polygon();
            let pixel = script.editor.view().viewport().pixel();
            script.drag_vertex(3, share * DVec2::new(24.0, 16.0));
            check(&script);
            let now = script.polygon();
            let wanted = share * pixel * DVec2::new(24.0, -16.0);
            let found = (now.vertex(3) - before.vertex(3)).truncate();
            assert!(
                found.distance(wanted) < 1e-9,
                "{follow:?}: {found}, {wanted}"
            );
            let pairs = now.vertices().iter().zip(before.vertices());
            pairs.map(|(a, b)| *a - *b).collect::<Vec<DVec3>>()
        });
        let [half, whole] = moves;
        let off = half
            .iter()
            .zip(&whole)
            .map(|(a, b)| (2.0 * *a).distance(*b));
        let off = off.fold(0.0, f64::max);
        assert!(off < 1e-9, "{follow:?}: {off:e}");
    }
}

#[test]
fn a_point_of_the_curve_takes_its_image_along() {
    let mut script = vase();
    script.command(Command::Tool(ToolKind::Select));
    let polygon = script.polygon();
    // Near the axis the image moves the point too; across the axis a point on it stays.
    for (u, held) in [(1.5, false), (6.5, false), (2.8, false), (4.0, true)] {
        let viewport = *script.editor.view().viewport();
        let at = viewport.to_screen(polygon.point(u).truncate());
        script.drag(at, at + DVec2::new(6.0, 9.0));
        check(&script);
        let by = script.polygon().point(u) - polygon.point(u);
        let wanted = viewport.pixel() * DVec3::new(6.0, -9.0, 0.0);
        let off = by.distance(wanted) / wanted.length();
        match held {
            true => assert!(by.x.abs() < 1e-12 * polygon.size(), "{by}"),
            false => assert!(off < 1e-6, "{u}: {off:e}"),
        }
        script.command(Command::Undo);
    }
}

#[test]
fn a_curve_that_moves_as_a_whole_takes_its_axis_along() {
    let mut script = vase();
    let before = script.polygon();
    script.command(Command::SelectAll);
    script.modifiers(Modifiers::CTRL);
    script.drag_vertex(2, DVec2::new(60.0, 0.0));
    check(&script);
    let by = script.polygon().vertex(0) - before.vertex(0);
    assert!(by.x > 1.0);
    let [through, normal] = mirror(&script).plane().expect("a plane");
    assert_eq!(normal.abs(), DVec3::X);
    assert!((through.x - by.x).abs() < 1e-12 * by.x);
    // One vertex still moves its image about the new axis.
    script.command(Command::SelectNone);
    script.drag_vertex(2, DVec2::new(11.0, 7.0));
    check(&script);
    script.command(Command::Undo);
    script.command(Command::Undo);
    assert_eq!(mirror(&script), Mirror::of_coordinate(0));
    // A drag to the side of both partners alone has nowhere to go.
    script.modifiers(Modifiers::NONE);
    script.click(script.at_vertex(2));
    script.click_with(Modifiers::SHIFT, script.at_vertex(9));
    assert_eq!(script.selected(), [2, 9]);
    script.modifiers(Modifiers::CTRL);
    script.drag_vertex(2, DVec2::new(30.0, 0.0));
    assert_eq!(script.polygon(), before);
}

#[test]
fn vertices_come_and_go_in_pairs() {
    for vertices_stay in [false, true] {
        let mut script = vase();
        if vertices_stay {
            script.command(Command::ToggleKeepShape);
        }
        let count = script.polygon().vertices().len();
        script.command(Command::Tool(ToolKind::Insert));
        let [a, b] = [8, 9].map(|index| script.at_vertex(index));
        script.click(0.5 * (a + b));
        check(&script);
        let inserted = script.polygon().vertices().len();
        assert!(inserted > count, "{}", script.message());
        if vertices_stay {
            assert_eq!(inserted, count + 2);
            let [selected] = script.selected()[..] else {
                panic!("{:?}", script.selected());
            };
            assert!(script.at_vertex(selected).distance(0.5 * (a + b)) < 1e-6);
        }
        script.command(Command::Tool(ToolKind::Select));
        script.click(script.at_vertex(3));
        script.command(Command::Delete);
        check(&script);
        assert!(script.polygon().vertices().len() < inserted);
    }
}

#[test]
fn an_end_leads_the_other_end() {
    let mut script = vase();
    script.command(Command::Tool(ToolKind::EndFit));
    script.end_fit_action(EndFitAction::Choose(End::Finish));
    script.end_fit_action(EndFitAction::SetPoint(DVec3::new(30.0, 104.0, 0.0)));
    script.end_fit_action(EndFitAction::SetDirection(Some(DVec3::new(0.0, 1.0, 0.0))));
    check(&script);
    let targets = curve(&script).targets;
    let start = targets.get(End::Start).expect("a target");
    assert_eq!(start.point, DVec3::new(-30.0, 104.0, 0.0));
    assert_eq!(start.direction, Some(DVec3::new(0.0, -1.0, 0.0)));
    script.end_fit_action(EndFitAction::BothAtOnce);
    check(&script);
    let end = script.polygon().end_jet(End::Finish);
    let size = script.polygon().size();
    assert!(end.point.distance(DVec3::new(30.0, 104.0, 0.0)) < 1e-9 * size);
    script.end_fit_action(EndFitAction::ClearTarget);
    assert!(curve(&script).targets.list().is_empty());
}

#[test]
fn one_end_follows_another_curve_and_the_other_is_its_image() {
    let mut script = vase();
    let ids: Vec<_> = script.editor.document().ids().collect();
    let matched = |end| {
        Edit::SetMatch(EndMatch {
            curve: ids[0],
            end,
            source: ids[1],
            place: MatchPlace::End(End::Finish),
            continuity: Continuity::G1,
            reversed: true,
        })
    };
    script
        .editor
        .apply("match", vec![matched(End::Finish)])
        .expect("a match");
    check(&script);
    let met = script.editor.document().matches().next().expect("a match");
    assert!(script.editor.document().meets(met));
    // Both ends cannot follow.
    let refused = script.editor.apply("match", vec![matched(End::Start)]);
    assert!(refused.is_err());
    script.drag_vertex(4, DVec2::new(9.0, 5.0));
    check(&script);
    let met = script.editor.document().matches().next().expect("a match");
    assert!(script.editor.document().meets(met));
}

#[test]
fn a_curve_that_is_cut_says_that_it_does_not_stay_symmetric() {
    let mut script = vase();
    let trimmed = script.operate("trim", &[("to", Value::Real(5.5))]);
    let told = trimmed.expect("a trimmed curve").text;
    assert!(told.contains("does not stay symmetric"), "{told}");
    assert_eq!(curve(&script).symmetry, None);
    script.command(Command::Undo);
    check(&script);
    // Switched off, a vertex moves alone.
    script.command(Command::ToggleSymmetric);
    let before = script.polygon();
    script.drag_vertex(2, DVec2::new(12.0, 8.0));
    assert_eq!(script.polygon().moved_vertices(&before), [2]);
    script.command(Command::ToggleSymmetric);
    assert!(
        script.message().contains("is not symmetric"),
        "{}",
        script.message()
    );
}

#[test]
fn a_slanted_axis_and_both_targets_are_read_back_to_the_bit() {
    let mut script = vase();
    let (id, polygon) = (script.curve(), script.polygon());
    let turn = DMat3::from_rotation_z(0.7);
    let vertices = polygon.vertices().iter().enumerate();
    let moves = vertices.map(|(index, at)| (index, turn * *at)).collect();
    let turned = vec![Edit::MoveVertices { curve: id, moves }];
    script.editor.apply("turn", turned).expect("a turned curve");
    check(&script);
    script.command(Command::Tool(ToolKind::EndFit));
    // Each end leads once: the file does not say which one did.
    for (end, x) in [(End::Start, -31.0), (End::Finish, 29.0)] {
        script.end_fit_action(EndFitAction::Choose(end));
        script.end_fit_action(EndFitAction::SetPoint(DVec3::new(x, 90.0, 0.0)));
        script.end_fit_action(EndFitAction::SetDirection(Some(DVec3::new(0.1, 1.0, 0.0))));
        script.operate("reverse", &[]).expect("a reversed curve");
        check(&script);
        check_written(script.editor.document()).expect("the same project");
    }
}
