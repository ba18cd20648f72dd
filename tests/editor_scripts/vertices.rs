//! Adding, inserting, deleting, drawing and measuring.

use batten::document::{Curve, Document};
use batten::editor::{Command, DrawWay, Editor, Key, ToolKind};
use batten::geometry::{End, FloatPolygon};
use batten::operations::Value;
use glam::{DVec2, DVec3};

use super::script::Script;

#[test]
fn the_add_tool_adds_at_the_nearer_end() {
    for (end, index) in [(0, 0), (9, 10)] {
        let mut script = Script::example("arc");
        script.draw_by(DrawWay::Vertices);
        script.tool(ToolKind::AddVertex);
        let place = script.at_vertex(end) + DVec2::new(5.0, 20.0);
        script.click(place);
        let polygon = script.polygon();
        assert_eq!(polygon.vertices().len(), 11);
        let expected = script.editor.view().viewport().to_model(place);
        assert!(polygon.vertex(index).truncate().distance(expected) < 1e-9);
        assert_eq!(script.editor.workspace().history().undo_steps(), 1);
    }
}

/// A place ahead of a curve's end, and the end that is given.
fn ahead(script: &Script, end: End) -> (DVec2, DVec3) {
    let jet = script.polygon().end_jet(end);
    let outwards = match end {
        End::Start => -1.0,
        End::Finish => 1.0,
    };
    let way = outwards * jet.tangent().expect("a direction");
    let to = jet.point + 0.3 * script.polygon().size() * way;
    let viewport = script.editor.view().viewport();
    (viewport.to_screen(viewport.flatten(to)), to)
}

/// The largest distance between vertices of the same number.
fn farthest(a: &FloatPolygon, b: &FloatPolygon) -> f64 {
    assert_eq!(a.vertices().len(), b.vertices().len());
    let pairs = a.vertices().iter().zip(b.vertices());
    pairs.fold(0.0_f64, |most, (a, b)| most.max(a.distance(*b)))
}

#[test]
fn the_add_tool_goes_on_to_the_click() {
    for name in ["arc", "s-curve", "hull", "figure2"] {
        for end in End::BOTH {
            let mut script = Script::example(name);
            let before = script.polygon();
            script.tool(ToolKind::AddVertex);
            let (place, to) = ahead(&script, end);
            script.move_to(place);
            script.editor.refresh();
            let shown = &script.editor.view().scene().proposal;
            assert!(!shown.curve.is_empty(), "{name}: no preview");
            script.click(place);
            let after = script.polygon();
            let expected = before.continued(end, to).expect("a polygon");
            let off = farthest(&after, &expected);
            assert!(
                off <= 1e-9 * before.size(),
                "{name}, {}: {off:e}",
                end.name()
            );
            assert_eq!(script.steps(), 1);
            assert!(script.editor.message().is_none_or(|it| !it.warns), "{name}");
            script.command(Command::Undo);
            assert_eq!(script.polygon(), before);
        }
    }
}

#[test]
fn adding_to_a_drawn_curve_is_drawing_on() {
    let clicks: Vec<(f64, f64)> = (0..9)
        .map(|step| (f64::from(step), (0.5 * f64::from(step)).sin()))
        .collect();
    let points = |count: usize| clicks[..count].iter().map(|(x, y)| DVec3::new(*x, *y, 0.0));
    let drawn = |count: usize| {
        let points: Vec<DVec3> = points(count).collect();
        FloatPolygon::through_ends(5, &points).expect("a polygon")
    };
    let document = Document::from_curves([Curve::new("a", drawn(8))]);
    let mut script = Script {
        editor: Editor::with_document(document),
    };
    script.tool(ToolKind::AddVertex);
    let (x, y) = clicks[8];
    script.editor.enter(&format!("{x},{y}")).expect("a point");
    let (added, expected) = (script.polygon(), drawn(9));
    let off = farthest(&added, &expected);
    assert!(off <= 1e-9 * expected.size(), "{off:e}");
}

#[test]
fn adding_leaves_locked_vertices_and_turns_to_vertices_by_t() {
    let mut script = Script::example("s-curve");
    let before = script.polygon();
    let last = before.vertices().len() - 1;
    script.click(script.at_vertex(last));
    script.command(Command::ToggleVerticesLocked);
    let locked = script.steps();
    script.tool(ToolKind::AddVertex);
    let (place, _) = ahead(&script, End::Finish);
    script.click(place);
    assert_eq!(script.polygon(), before);
    assert_eq!(script.steps(), locked);
    let message = &script.editor.message().expect("a reason").text;
    assert!(message.contains("locked"), "{message}");
    script.key(Key::Character('t'));
    script.click(place);
    assert_eq!(script.polygon().vertices().len(), last + 2);
    assert_eq!(script.polygon().vertices()[..=last], *before.vertices());
    script.key(Key::Character('t'));
    assert_eq!(script.editor.hand().draw_settings().way, DrawWay::OnClicks);
}

#[test]
fn the_insert_tool_splits_the_leg_under_the_pointer() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.command(Command::ToggleKeepShape);
    script.tool(ToolKind::Insert);
    let middle = 0.5 * (script.at_vertex(3) + script.at_vertex(4));
    script.click(middle);
    let polygon = script.polygon();
    assert_eq!(polygon.vertices().len(), 11);
    let expected = 0.5 * (before.vertex(3) + before.vertex(4));
    assert!(polygon.vertex(4).distance(expected) < 1e-9);
    assert_eq!(polygon.vertex(5), before.vertex(4));
}

#[test]
fn inserting_and_dragging_is_one_step_and_escape_takes_it_back() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.tool(ToolKind::Insert);
    let middle = 0.5 * (script.at_vertex(3) + script.at_vertex(4));
    script.press(middle);
    script.move_to(middle + 40.0);
    script.key(Key::Escape);
    script.release(middle + 40.0);
    assert_eq!(script.polygon(), before);
    script.drag(middle, middle + 40.0);
    assert_eq!(script.polygon().vertices().len(), 11);
    assert_eq!(script.editor.workspace().history().undo_steps(), 1);
}

#[test]
fn a_vertex_that_the_degree_needs_is_not_deleted() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.tool(ToolKind::Delete);
    script.click(script.at_vertex(4));
    assert_eq!(script.polygon(), before);
    assert!(
        script.message().contains("needs at least 10"),
        "{}",
        script.message()
    );
    let degree = [("degree", Value::Whole(5))];
    let changed = script.operate("reinterpret-degree", &degree);
    changed.expect("another degree");
    script.click(script.at_vertex(4));
    assert_eq!(script.polygon().vertices().len(), 9);
}

#[test]
fn drawing_ends_with_enter_and_a_click_on_the_first_vertex_makes_it_periodic() {
    for periodic in [false, true] {
        let mut script = Script::example("arc");
        script.tool(ToolKind::Draw);
        script.draw_by(DrawWay::Vertices);
        let corners = [
            (100.0, 100.0),
            (300.0, 120.0),
            (400.0, 300.0),
            (250.0, 400.0),
            (90.0, 300.0),
        ];
        for (x, y) in corners {
            script.click(DVec2::new(x, y));
        }
        if periodic {
            script.click(DVec2::new(100.0, 100.0));
        } else {
            script.key(Key::Enter);
        }
        assert_eq!(script.editor.document().len(), 2);
        let polygon = script.polygon();
        assert_eq!(polygon.vertices().len(), 5);
        assert_eq!(polygon.is_periodic(), periodic);
        assert_eq!(polygon.degree(), 4);
        assert_eq!(script.editor.hand().tool(), ToolKind::Select);
        script.command(Command::Undo);
        assert_eq!(script.editor.document().len(), 1);
    }
}

#[test]
fn measuring_says_the_distance_and_changes_nothing() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    script.tool(ToolKind::Measure);
    script.drag(DVec2::new(100.0, 100.0), DVec2::new(400.0, 500.0));
    let length = 500.0 * script.editor.view().viewport().pixel();
    let hint = script.editor.hint();
    let first = hint.split_whitespace().nth(1);
    let told: f64 = first.and_then(|it| it.parse().ok()).expect("a figure");
    // Eight digits are told.
    assert!((told - length).abs() <= 0.5e-7 * length, "{hint}");
    assert_eq!(script.polygon(), before);
    assert!(!script.editor.workspace().is_modified());
}
