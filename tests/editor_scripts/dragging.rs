//! What is told and drawn while something is dragged: the readout, what it snaps to, the axis it keeps to.

use batten::document::{Curve, Document, Edit};
use batten::editor::{Command, Look, ToolKind};
use batten::editor::{DragReadout, Editor, HoverScene, Input, Key, Mark, Modifiers, NamedView};
use batten::geometry::{Continuity, FloatPolygon};
use glam::{DVec2, DVec3};

use super::common::matched;
use super::script::Script;

fn readout(script: &mut Script) -> Option<DragReadout> {
    let mut marks = script.scene().marks.iter();
    marks.find_map(|mark| match mark {
        Mark::Drag(readout) => Some(readout.clone()),
        _ => None,
    })
}

/// The ends and the axis of the line that a drag keeps to.
fn guide(script: &mut Script) -> Option<([DVec2; 2], Option<usize>)> {
    let mut marks = script.scene().marks.iter();
    marks.find_map(|mark| match mark {
        Mark::Axis { ends, axis } => Some((*ends, *axis)),
        _ => None,
    })
}

/// Two curves of degree 3 whose vertices lie off the grid.
fn two() -> Script {
    let polygon = |x: f64| {
        let points = [(0.13, 0.21), (2.17, 1.33), (4.11, 0.87), (6.23, 2.19)];
        FloatPolygon::planar(3, &points.map(|(a, b)| (a + x, b))).expect("a polygon")
    };
    let curves = [
        Curve::new("left", polygon(0.0)),
        Curve::new("right", polygon(9.0)),
    ];
    let mut editor = Editor::with_document(Document::from_curves(curves));
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let mut script = Script { editor };
    // Steps of the grid that are wide enough to get between.
    script.input(Input::Zoomed {
        at: DVec2::new(500.0, 350.0),
        factor: 0.9,
    });
    script
}

#[test]
fn a_drag_tells_the_difference_and_the_place_behind_it() {
    let mut script = two();
    let before = script.polygon().vertex(1);
    let at = script.at_vertex(1);
    script.press(at);
    let way = DVec2::new(60.0, -45.0);
    script.move_to(at + way);
    let told = readout(&mut script).expect("a readout");
    let now = script.polygon().vertex(1);
    assert_eq!((told.to, told.by), (now, now - before));
    assert!(told.by.x > 0.0 && told.by.y > 0.0 && !told.in_space);
    // The readout stands opposite: the way is the drag's.
    let expected = DVec2::new(60.0, 45.0) / script.editor.view().viewport().scale;
    assert!(told.way.distance(expected) < 1e-12, "{}", told.way);
    assert_eq!(told.at, now.truncate());
    assert_eq!(told.remarks, ["+2 curvature extrema"]);
    // The vertex under the hand is marked without a text that would lie over the readout.
    let Some(HoverScene::Vertex { text, point, .. }) = script.scene().hover.clone() else {
        panic!("the vertex is marked");
    };
    assert_eq!((text.as_str(), point), ("", now));
    script.release(at + way);
    assert_eq!(readout(&mut script), None);
}

#[test]
fn a_drag_names_what_it_snaps_to() {
    let mut script = two();
    script.command(Command::ToggleSnapping);
    let other = script.editor.document().ids().last().expect("a curve");
    let at = script.at_vertex(3);
    let near = DVec2::new(3.0, 2.0);
    let seen = |script: &Script, point: DVec3| {
        let viewport = script.editor.view().viewport();
        viewport.to_screen(viewport.flatten(point))
    };
    let polygon = script
        .editor
        .document()
        .curve(other)
        .expect("it")
        .polygon
        .clone();
    let end = polygon.end_jet(batten::geometry::End::Start).point;
    let crossing = DVec3::new(10.0, -4.0, 0.0);
    let middle = 0.5 * (polygon.vertex(2) + polygon.vertex(3));
    let own = script.polygon();
    let own = 0.5 * (own.vertex(2) + own.vertex(3));
    let targets = [
        (seen(&script, middle), "Middle of vertices 2 and 3"),
        (script.at_vertex_of(other, 2), "Vertex 2"),
        (seen(&script, end), "Start"),
        (seen(&script, crossing), "Grid"),
        (seen(&script, DVec3::ZERO), "Origin"),
    ];
    script.press(at);
    for (place, name) in targets {
        script.move_to(place + near);
        let told = readout(&mut script).expect("a readout").remarks;
        let (first, added) = told.split_first().expect("the name of the snap");
        assert_eq!(first, name);
        assert!(added.iter().all(|it| it.starts_with('+')), "{added:?}");
        let marks = &script.scene().marks;
        assert!(
            marks.iter().any(|mark| matches!(mark, Mark::Snap(_))),
            "{name}"
        );
    }
    // What is dragged along does not attract.
    script.move_to(seen(&script, own) + near);
    let told = readout(&mut script).expect("a readout").remarks;
    assert!(told.iter().all(|it| !it.starts_with("Middle")), "{told:?}");
    script.key(Key::Escape);
}

#[test]
fn drawing_names_what_a_click_would_snap_to() {
    let mut script = two();
    script.command(Command::ToggleSnapping);
    let at = script.at_vertex(3);
    script.command(Command::Tool(ToolKind::Draw));
    let names = |script: &mut Script| {
        let marks = script.scene().marks.iter();
        let names = marks.filter_map(|mark| match mark {
            Mark::Name(_, name) => Some(name.clone()),
            _ => None,
        });
        names.collect::<Vec<String>>()
    };
    script.move_to(at + DVec2::new(3.0, -2.0));
    assert_eq!(names(&mut script), ["Vertex 3"]);
    script.input(Input::Modifiers(Modifiers::CTRL));
    assert_eq!(names(&mut script), Vec::<String>::new(), "without snapping");
}

#[test]
fn what_keeps_to_an_axis_shows_its_line() {
    let mut script = two();
    let start = script.polygon().vertex(1).truncate();
    let at = script.at_vertex(1);
    script.press(at);
    script.move_to(at + DVec2::new(40.0, 10.0));
    assert_eq!(guide(&mut script), None);
    let check = |script: &mut Script, direction: DVec2, expected: Option<usize>| {
        let (ends, axis) = guide(script).expect("a line");
        assert_eq!(axis, expected);
        let along = (ends[1] - ends[0]).normalize();
        assert!(along.perp_dot(direction).abs() < 1e-9, "{along}");
        let off = (start - ends[0]).perp_dot(along).abs();
        assert!(off < 1e-9 * ends[0].distance(ends[1]), "through the start");
        let view = script.editor.view().viewport().view_box();
        assert!(ends[0].distance(ends[1]) > 2.0 * view.low.distance(view.high));
    };
    script.input(Input::Modifiers(Modifiers::SHIFT));
    script.move_to(at + DVec2::new(40.0, 11.0));
    check(&mut script, DVec2::X, Some(0));
    script.move_to(at + DVec2::new(10.0, 41.0));
    check(&mut script, DVec2::Y, Some(1));
    script.input(Input::Modifiers(Modifiers::NONE));
    script.input(Input::AxisHeld(Some(1)));
    script.move_to(at + DVec2::new(40.0, 10.0));
    check(&mut script, DVec2::Y, Some(1));
    script.input(Input::AxisHeld(Some(2)));
    script.move_to(at + DVec2::new(41.0, 10.0));
    assert_eq!(guide(&mut script), None, "z points to the eye");
    script.key(Key::Escape);
    script.input(Input::AxisHeld(None));
    script.command(Command::View(NamedView::Xz));
    let at = script.at_vertex(1);
    script.press(at);
    script.input(Input::AxisHeld(Some(2)));
    script.move_to(at + DVec2::new(5.0, 30.0));
    let (ends, axis) = guide(&mut script).expect("a line");
    assert_eq!((axis, ends[0].x - ends[1].x), (Some(2), 0.0));
    script.key(Key::Escape);
}

#[test]
fn the_status_bar_reads_the_model_in_every_view() {
    let mut script = Script::example("s-curve");
    script.move_to(DVec2::new(10.0, 10.0));
    script.scene();
    let readout = script.editor.sight().readout();
    let viewport = *script.editor.view().viewport();
    let place = viewport.to_model(DVec2::new(10.0, 10.0));
    assert_eq!(readout.pointer, Some(place.extend(0.0)));
    assert!(!readout.in_space, "planar and seen from above");
    // At an angle: in the plane through the middle, seen where the pointer is.
    script.command(Command::View(NamedView::Isometric));
    script.scene();
    let readout = script.editor.sight().readout();
    let viewport = *script.editor.view().viewport();
    let point = readout.pointer.expect("a point");
    let seen = viewport.to_screen(viewport.flatten(point));
    assert!(readout.in_space && seen.distance(DVec2::new(10.0, 10.0)) < 1e-9);
    // What is hovered is told itself.
    script.move_to(script.at_vertex(2));
    script.scene();
    let vertex = script.polygon().vertex(2);
    assert_eq!(script.editor.sight().readout().pointer, Some(vertex));
}

#[test]
fn views_have_names() {
    let mut script = Script::example("s-curve");
    let name = |script: &Script| {
        let view = script.editor.view().viewport().orientation;
        batten::editor::view_name(&view)
    };
    let named = NamedView::ALL.map(|view| {
        script.command(Command::View(view));
        name(&script)
    });
    assert_eq!(named, ["Top", "Front", "Right", "Isometric"]);
    script.editor.look(Look::Orbit(DVec2::new(7.0, 3.0)));
    assert_eq!(name(&script), "Orbit");
}

#[test]
fn nudges_by_decimals_leave_no_rounding() {
    let mut script = two();
    script.click(script.at_vertex(1));
    let before = script.polygon().vertex(1);
    script.editor.hand_mut().set_nudge_step(0.01);
    let decimal = |number: f64| format!("{number:.2}").parse::<f64>().expect("a number");
    for step in 1..=300 {
        script.key(Key::Right);
        script.key(Key::Down);
        let by = 0.01 * f64::from(step);
        let expected = [decimal(2.17 + by), decimal(1.33 - by)];
        let now = script.polygon().vertex(1);
        assert_eq!(now.truncate().to_array(), expected);
    }
    for _ in 0..300 {
        script.key(Key::Left);
        script.key(Key::Up);
    }
    assert_eq!(script.polygon().vertex(1), before);
}

#[test]
fn a_drag_seen_at_an_angle_snaps_to_the_grid_on_the_ground() {
    let mut script = two();
    script.command(Command::ToggleSnapping);
    script.command(Command::View(NamedView::Isometric));
    let viewport = *script.editor.view().viewport();
    let crossing = DVec3::new(10.0, -4.0, 0.0);
    let seen = viewport.to_screen(viewport.flatten(crossing));
    script.press(script.at_vertex(3));
    script.move_to(seen + DVec2::new(2.0, -1.0));
    let told = readout(&mut script).expect("a readout").remarks;
    assert_eq!(told, ["Grid", "+1 curvature extremum"]);
    script.release(seen + DVec2::new(2.0, -1.0));
    let off = script.polygon().vertex(3).distance(crossing);
    assert!(off < 1e-12 * crossing.length(), "{off}");
    // What does not lie on the ground only seems to meet it.
    let curve = script.curve();
    let raised = DVec3::new(3.0, 1.0, 2.0);
    let moves = vec![(0, raised)];
    let edit = Edit::MoveVertices { curve, moves };
    script.editor.apply("Raise", vec![edit]).expect("an edit");
    script.press(script.at_vertex(0));
    script.move_to(seen + DVec2::new(2.0, -1.0));
    let remarks = readout(&mut script).expect("a readout").remarks;
    assert!(!remarks.contains(&"Grid".to_owned()), "{remarks:?}");
}

#[test]
fn a_drag_that_bends_a_curve_sharply_warns_and_one_that_scales_it_does_not() {
    let warning = |script: &Script| {
        let message = script.editor.message().filter(|it| it.warns);
        message.map(|it| (it.text.clone(), it.offers_undo))
    };
    let mut script = Script::example("s-curve");
    script.drag_vertex(3, DVec2::new(6.0, 4.0));
    assert_eq!(warning(&script), None, "a small drag");
    script.command(Command::Undo);
    // Past its neighbour: the polygon folds.
    let by = script.at_vertex(5) - script.at_vertex(3);
    script.drag_vertex(3, 1.02 * by);
    let (text, offers_undo) = warning(&script).expect("a warning");
    assert!(
        text.contains("is bent to the radius") && offers_undo,
        "{text}"
    );
    script.command(Command::Undo);
    assert_eq!(warning(&script), None);
    script.command(Command::SelectAll);
    script.command(Command::Tool(ToolKind::Scale));
    script.editor.enter("0.05").expect("a factor");
    assert_eq!(warning(&script), None, "a smaller curve bends as before");
}

/// By degree 4 three vertices cannot keep four derivatives, so that all move at G3 and the dragged one lags.
#[test]
fn a_vertex_that_its_match_holds_back_says_so() {
    for (continuity, lags) in [(Continuity::G1, false), (Continuity::G3, true)] {
        let (document, [_, second]) = matched(continuity, 5.0);
        let mut script = Script {
            editor: Editor::with_document(document),
        };
        script.command(Command::FitAll);
        script.editor.activate(second);
        let from = script.at_vertex(3);
        script.press(from);
        script.move_to(from + DVec2::new(6.0, -20.0));
        let remarks = readout(&mut script).expect("a readout").remarks;
        let told = remarks.contains(&"The match holds it back".to_owned());
        assert_eq!(told, lags, "{continuity:?}: {remarks:?}");
        script.release(from);
    }
}

#[test]
fn a_drag_lines_up_with_vertices_and_ends() {
    let mut script = two();
    script.command(Command::ToggleSnapping);
    let level = script.at_vertex(1).y;
    let from = script.at_vertex(2);
    script.press(from);
    // Far from all points, a little above the level of vertex 1.
    let to = DVec2::new(from.x + 37.0, level - 2.0);
    script.move_to(to);
    let remarks = readout(&mut script).expect("a readout").remarks;
    assert!(
        remarks.contains(&"Level with vertex 1".to_owned()),
        "{remarks:?}"
    );
    let lines = |script: &mut Script| {
        let marks = script.scene().marks.iter();
        marks
            .filter(|it| matches!(it, Mark::Axis { axis: None, .. }))
            .count()
    };
    assert_eq!(lines(&mut script), 1);
    let polygon = script.polygon();
    let off = (polygon.vertex(2).y - polygon.vertex(1).y).abs();
    assert!(off <= 1e-15 * polygon.size(), "{off}");
    // A little farther the crossing with the upright line of vertex 3 attracts.
    let upright = script.at_vertex(3).x;
    script.move_to(DVec2::new(upright + 2.0, level - 2.0));
    let remarks = readout(&mut script).expect("a readout").remarks;
    assert!(remarks[0].contains("Level with vertex 1"), "{remarks:?}");
    assert!(remarks[0].contains("Upright with vertex 3"), "{remarks:?}");
    assert_eq!(lines(&mut script), 2);
    // Without the switch the grid alone is left.
    script.command(Command::ToggleAlignment);
    script.move_to(to);
    let remarks = readout(&mut script).expect("a readout").remarks;
    assert!(
        !remarks.iter().any(|it| it.contains("Level")),
        "{remarks:?}"
    );
    assert_eq!(lines(&mut script), 0);
}
