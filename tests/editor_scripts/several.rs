//! Several curves at once: whose is what is hovered, copied, cut, exported and named.

use batten::document::{Curve, CurveId, Document, Edit};
use batten::editor::{
    CombsOf, Command, Editor, HoverScene, Input, Key, Layer, Look, Modifiers, NamedView, ToolKind,
};
use batten::geometry::end_correction::EndTarget;
use batten::geometry::{ClampedPolygon, Continuity, End, FloatPolygon, PolygonKind};
use batten::io::disk;
use batten::operations::{self, Inputs, Value};
use glam::{DVec2, DVec3};

use super::common::matched;
use super::script::Script;
use super::window::exporter;

/// The paper's arc, which is active, and a longer curve below it.
pub fn two() -> (Script, [CurveId; 2]) {
    let mut script = Script::example("arc");
    let arc = script.curve();
    let points: Vec<_> = (0..9)
        .map(|i| (4.0 * f64::from(i) - 16.0, -20.0 + f64::from(i * i) / 9.0))
        .collect();
    let other = Curve::new(
        "other",
        FloatPolygon::planar(3, &points).expect("a polygon"),
    );
    script
        .editor
        .apply("add", vec![Edit::Add(Box::new(other))])
        .expect("an edit");
    let other = script
        .editor
        .document()
        .curves()
        .map(|(id, _)| id)
        .find(|id| *id != arc);
    let other = other.expect("the other curve");
    script.command(Command::FitAll);
    script.editor.activate(arc);
    (script, [arc, other])
}

fn polygon_of(script: &Script, id: CurveId) -> FloatPolygon {
    let curve = script.editor.document().curve(id);
    curve.expect("the curve").polygon.clone()
}

#[test]
fn what_is_hovered_is_told_of_the_curve_it_is_on() {
    let (mut script, [arc, other]) = two();
    let polygon = polygon_of(&script, other);
    let u = 4.5;
    let place = polygon.point(u).truncate();
    script.move_to(script.editor.view().viewport().to_screen(place));
    let hover = script.scene().hover.clone();
    let Some(HoverScene::Curve { curve, text, .. }) = hover else {
        panic!("{hover:?}");
    };
    assert_eq!((curve, script.curve()), (other, arc));
    assert!(text.starts_with("other\n"), "{text}");
    let readout = script.editor.sight().readout();
    assert!((readout.parameter.expect("u") - u).abs() < 1e-3);
    let expected = polygon
        .jet(readout.parameter.expect("u"))
        .signed_curvature();
    assert_eq!(readout.curvature, Some(expected));
    // The plots are the active curve's, which is not hovered.
    assert_eq!(script.plots().hovered, None);
    script.editor.activate(other);
    script.scene();
    assert!(script.plots().hovered.is_some());
}

/// What the canvas shows of all curves, written out.
fn shown(script: &mut Script) -> Vec<String> {
    let curves = &script.scene().curves;
    curves.iter().map(|curve| format!("{curve:?}")).collect()
}

/// Check that what was kept of the frames before is what is drawn anew once another layer is shown.
#[track_caller]
fn check_kept(script: &mut Script) {
    let kept = shown(script);
    script.command(Command::ToggleLayer(Layer::Grid));
    script.scene();
    script.command(Command::ToggleLayer(Layer::Grid));
    let anew = shown(script);
    assert!(kept == anew, "kept: {kept:#?}\nanew: {anew:#?}");
}

#[test]
fn what_is_kept_of_other_curves_is_what_they_are_now() {
    let (document, [first, second]) = matched(Continuity::G2, 9.0);
    let mut editor = Editor::with_document(document);
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let mut script = Script { editor };
    script.editor.activate(first);
    script.command(Command::FitAll);
    check_kept(&mut script);
    // The second curve follows a drag of the first, and comes back with Esc.
    let before = shown(&mut script);
    let at = script.at_vertex_of(first, 7);
    script.press(at);
    script.move_to(at + DVec2::new(12.0, -9.0));
    assert_ne!(shown(&mut script)[0], before[0]);
    check_kept(&mut script);
    script.key(Key::Escape);
    script.move_to(DVec2::ZERO);
    assert_eq!(shown(&mut script)[0], before[0]);
    script.drag(at, at + DVec2::new(12.0, -9.0));
    check_kept(&mut script);
    let at = DVec2::new(300.0, 200.0);
    script.input(Input::Zoomed { at, factor: 2.0 });
    check_kept(&mut script);
    for combs in [CombsOf::Visible, CombsOf::Selected] {
        script.command(Command::ShowCombs(combs));
        check_kept(&mut script);
    }
    let mut comb = script.editor.view().comb();
    comb.scale *= 3.0;
    script.editor.view_mut().set_comb(comb);
    script.command(Command::ShowCombs(CombsOf::Visible));
    check_kept(&mut script);
    // A selected vertex of the second curve, which then is the active one, and goes back.
    script.editor.select_vertex(second, 4, false);
    check_kept(&mut script);
    script.editor.activate(first);
    check_kept(&mut script);
    script.editor.hand_mut().select_items([first, second]);
    check_kept(&mut script);
    let curve = second;
    for edit in [
        Edit::SetLocked {
            curve,
            locked: true,
        },
        Edit::SetVisible {
            curve,
            visible: false,
        },
    ] {
        script.editor.change(edit).expect("an edit");
        check_kept(&mut script);
    }
    script.command(Command::View(NamedView::Isometric));
    check_kept(&mut script);
    for _ in 0..3 {
        script.command(Command::Undo);
        check_kept(&mut script);
    }
}

#[test]
fn cutting_removes_what_it_copies() {
    let (mut script, [arc, other]) = two();
    for vertex in 0..4 {
        script.editor.select_vertex(other, vertex, vertex > 0);
    }
    assert_eq!(script.curve(), other);
    let untouched = polygon_of(&script, arc);
    let before = polygon_of(&script, other);
    let text = script.editor.cut().expect("the vertices' text");
    let left = polygon_of(&script, other);
    assert_eq!(left.vertices(), &before.vertices()[4..]);
    assert_eq!(polygon_of(&script, arc), untouched);
    script.editor.paste(&text).expect("a curve");
    assert_eq!(script.polygon().vertices().len(), 4);
}

#[test]
fn a_deleted_curve_that_comes_back_is_active_again() {
    let (mut script, [arc, other]) = two();
    script.editor.activate(other);
    script.command(Command::DeleteCurve);
    assert_eq!(script.curve(), arc);
    script.command(Command::Undo);
    assert_eq!(script.curve(), other);
}

#[test]
fn what_cannot_be_cut_is_not_copied() {
    let (mut script, [_, other]) = two();
    // The six vertices that are left would be no curve of degree 7.
    let points: Vec<_> = (0..8).map(|i| (f64::from(i), f64::from(i * i))).collect();
    let polygon = FloatPolygon::planar(7, &points).expect("a polygon");
    script.editor.activate(other);
    script.set_polygon(polygon);
    script.editor.select_vertex(other, 0, false);
    script.editor.select_vertex(other, 1, true);
    assert!(script.editor.cut().is_err());
    assert!(script.message().contains("too few"), "{}", script.message());
    // Neither are vertices of a locked curve.
    script
        .editor
        .change(Edit::SetLocked {
            curve: other,
            locked: true,
        })
        .expect("a curve");
    script.editor.select_vertex(other, 0, false);
    assert!(script.editor.cut().is_err());
    assert!(script.message().contains("locked"), "{}", script.message());
}

#[test]
fn the_active_curve_stays_active_when_its_vertex_is_dragged_among_others() {
    let (mut script, [arc, other]) = two();
    script.command(Command::SelectAll);
    script.command(Command::SelectAll);
    let at = script.at_vertex_of(other, 2);
    script.click_with(Modifiers::SHIFT, script.at_vertex_of(other, 0));
    script.click_with(Modifiers::SHIFT, script.at_vertex_of(other, 0));
    assert_eq!(script.curve(), other);
    script.drag(at, at + DVec2::new(15.0, 10.0));
    assert_eq!(script.curve(), other);
    script.key(Key::Up);
    assert_eq!(script.curve(), other);
    script.tool(ToolKind::Rotate);
    script.drag(DVec2::new(700.0, 100.0), DVec2::new(720.0, 160.0));
    assert_eq!(script.curve(), other);
    assert_eq!(script.selected_of(arc).len(), 10);
    assert_eq!(script.selected_of(other).len(), 9);
}

#[test]
fn a_leg_of_a_selection_takes_the_selection_along() {
    let (mut script, [arc, other]) = two();
    script.command(Command::SelectAll);
    script.command(Command::SelectAll);
    let before = [arc, other].map(|id| polygon_of(&script, id));
    // The first leg lies beyond the curve's end.
    let middle = 0.5 * (script.at_vertex_of(other, 0) + script.at_vertex_of(other, 1));
    script.drag(middle, middle + DVec2::new(0.0, 30.0));
    for (id, before) in [arc, other].into_iter().zip(before) {
        let moved = polygon_of(&script, id).vertex(0) - before.vertex(0);
        assert!(moved.y < 0.0 && moved.x.abs() < 1e-9, "{moved}");
    }
    assert_eq!(script.steps(), 2);
}

#[test]
fn what_is_hidden_is_not_edited() {
    let (mut script, [arc, _]) = two();
    script
        .editor
        .change(Edit::SetVisible {
            curve: arc,
            visible: false,
        })
        .expect("a curve");
    script.editor.activate(arc);
    let before = script.editor.document().clone();
    for tool in ToolKind::ALL
        .into_iter()
        .filter(|tool| *tool != ToolKind::Draw)
    {
        script.tool(tool);
        script.drag(DVec2::new(300.0, 100.0), DVec2::new(420.0, 160.0));
        if script.curve() != arc {
            script.editor.activate(arc);
        }
        script.click(DVec2::new(500.0, 120.0));
    }
    let operations = operations::ALL.iter().copied();
    let needs = |inputs: Inputs| !matches!(inputs, Inputs::None | Inputs::UpToTwo);
    let on_curves = operations.filter(|operation| needs(operation.inputs));
    let operations = on_curves.map(Command::Operation);
    for command in operations.chain([Command::TogglePeriodic]) {
        assert!(!command.is_enabled(&script.editor), "{command:?}");
    }
    let moves = vec![(0, DVec3::ZERO)];
    let edit = Edit::MoveVertices { curve: arc, moves };
    assert!(script.editor.apply("move", vec![edit]).is_err());
    assert!(script.message().contains("hidden"), "{}", script.message());
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn a_single_vertex_is_copied_as_its_coordinates() {
    let (mut script, [arc, other]) = two();
    let copied = |script: &mut Script| {
        script
            .editor
            .copy(batten::editor::CopyForm::Own)
            .expect("a text")
    };
    script.click(script.at_vertex_of(other, 3));
    let DVec3 { x, y, .. } = polygon_of(&script, other).vertex(3);
    assert_eq!(copied(&mut script), format!("{x},{y}\n"));
    assert_eq!(script.message(), "1 vertex copied");
    // With a header only where vertices make a curve.
    script.editor.select_vertex(arc, 2, true);
    script.editor.select_vertex(arc, 5, true);
    let text = copied(&mut script);
    let lines: Vec<&str> = text.lines().filter(|line| !line.is_empty()).collect();
    assert_eq!(lines.iter().filter(|line| line.starts_with('#')).count(), 1);
    assert!(lines[0].starts_with("# degree=1"), "{text}");
    assert_eq!(lines.last(), Some(&format!("{x},{y}").as_str()));
    // A table of vertices is a curve again.
    script.command(Command::SelectNone);
    script.click(script.at_vertex_of(other, 0));
    for vertex in 1..5 {
        script.editor.select_vertex(other, vertex, true);
    }
    let text = copied(&mut script);
    script.editor.paste(&text).expect("a curve");
    assert_eq!(script.polygon().vertices().len(), 5);
}

#[test]
fn drawings_of_other_programs_are_pasted() {
    let (mut script, _) = two();
    let cubic = [[10.0, -20.0], [30.0, -40.0], [50.0, -60.0], [70.0, -20.0]];
    let check = |script: &mut Script, text: &str| {
        let before = script.editor.document().curves().len();
        script.editor.paste(text).expect("a curve");
        let now = script.editor.document().curves().len();
        assert_eq!(now, before + 1, "{text}");
        let clamped = ClampedPolygon::from_float(&script.polygon());
        for (vertex, expected) in clamped.vertices().iter().zip(cubic) {
            let expected = DVec2::from_array(expected).extend(0.0);
            assert!(vertex.distance(expected) < 1e-12, "{text}: {vertex}");
        }
        script.command(Command::Undo);
        assert_eq!(script.editor.document().curves().len(), before);
    };
    let data = "M10,20 C 30 40 50 60 70 20";
    check(&mut script, data);
    let svg = format!("<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"{data}\"/></svg>");
    check(&mut script, &format!("<?xml version=\"1.0\"?>\n{svg}"));
    let text = |pairs: &[(&str, &str)]| {
        let lines = pairs
            .iter()
            .map(|(code, value)| format!("  {code}\n{value}\n"));
        lines.collect::<String>()
    };
    let knots = ["0", "0", "0", "0", "1", "1", "1", "1"].map(|knot| ("40", knot));
    let vertices = ["10", "30", "50", "70"]
        .into_iter()
        .zip(["-20", "-40", "-60", "-20"]);
    let vertices = vertices.flat_map(|(x, y)| [("10", x), ("20", y), ("30", "0")]);
    let begin = [
        ("0", "SECTION"),
        ("2", "ENTITIES"),
        ("0", "SPLINE"),
        ("71", "3"),
        ("72", "8"),
        ("73", "4"),
    ];
    let spline = begin.into_iter().chain(knots).chain(vertices);
    let dxf: Vec<_> = spline.chain([("0", "ENDSEC"), ("0", "EOF")]).collect();
    check(&mut script, &text(&dxf));
    // What begins like a drawing is read as one only, and a text is no path.
    for text in [
        "<svg><path d=",
        "Move 3 curves",
        "  0\nSECTION\n  2\nENTITIES\n  0\nENDSEC\n",
    ] {
        let before = script.steps();
        let reply = script.editor.paste(text);
        assert!(
            reply.is_err() || reply.is_ok_and(|note| note.text.contains("no curves")),
            "{text}"
        );
        assert_eq!(script.steps(), before);
    }
}

#[test]
fn pasting_in_the_middle_of_a_drag_calls_the_drag_off() {
    let mut script = Script::example("arc");
    let before = script.polygon();
    let text = script
        .editor
        .copy(batten::editor::CopyForm::Own)
        .expect("the arc's text");
    let (arc, at) = (script.curve(), script.at_vertex(3));
    script.press(at);
    script.move_to(at + 40.0);
    script.editor.paste(&text).expect("a curve");
    script.move_to(at + 80.0);
    script.release(at + 80.0);
    let polygon = |script: &Script| {
        script
            .editor
            .document()
            .curve(arc)
            .map(|c| c.polygon.clone())
    };
    assert_eq!(polygon(&script), Some(before));
    assert_eq!(script.steps(), 1);
    script.command(Command::Undo);
    assert_eq!(script.editor.document().len(), 1);
}

#[test]
fn exports_keep_to_their_format_and_tell_what_is_hidden() {
    let (mut script, [_, other]) = two();
    let folder = tempfile::tempdir().expect("a folder");
    let export = exporter("dxf", PolygonKind::Float);
    let project = folder.path().join("own.batten");
    assert!(script.editor.export(&project, &export).is_err());
    assert!(!project.exists() && script.message().contains("own.batten"));
    let hide = Edit::SetVisible {
        curve: other,
        visible: false,
    };
    script.editor.apply("hide", vec![hide]).expect("an edit");
    let drawing = folder.path().join("own.dxf");
    assert!(script.editor.export(&drawing, &export).is_ok());
    assert!(drawing.exists());
    assert!(
        script.message().contains("1 hidden curve skipped"),
        "{}",
        script.message()
    );
}

#[test]
fn the_parts_of_a_curve_get_names_of_their_own() {
    let (mut script, _) = two();
    script.command(Command::Duplicate);
    for _ in 0..2 {
        let given = [
            ("at", Value::Real(0.5)),
            ("subdivisions", Value::List(vec![1.0])),
        ];
        script.operate("split", &given).expect("the parts");
    }
    let mut names: Vec<String> = script
        .editor
        .document()
        .curves()
        .map(|(_, curve)| curve.name.clone())
        .collect();
    let count = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[test]
fn targets_of_any_direction_survive_a_file() {
    let mut script = Script::example("arc");
    let direction = DVec3::new(1e-200, -3e-310, 0.0);
    let target = EndTarget {
        point: DVec3::ZERO,
        direction: Some(direction),
        ..EndTarget::default()
    };
    let curve = script.curve();
    let edit = Edit::SetTarget {
        curve,
        end: End::Finish,
        target: Some(target),
    };
    script.editor.apply("target", vec![edit]).expect("an edit");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("own.batten");
    script.editor.save(&path).expect("a file");
    let read = disk::read_file(&path).expect("what was saved").curves;
    assert_eq!(read[0].targets.get(End::Finish), Some(target));
    script
        .editor
        .open(std::slice::from_ref(&path))
        .expect("a project");
    assert_eq!(script.editor.document().len(), 1);
}

#[test]
fn select_all_says_that_the_active_curve_is_hidden_and_takes_no_other() {
    let (mut script, [arc, _]) = two();
    script
        .editor
        .change(Edit::SetVisible {
            curve: arc,
            visible: false,
        })
        .expect("a curve");
    script.editor.activate(arc);
    script.command(Command::SelectAll);
    assert_eq!(script.curve(), arc);
    assert!(script.editor.hand().selection().is_empty());
    assert!(script.message().contains("hidden"), "{}", script.message());
}

/// A wave through so many vertices.
fn wave(count: usize) -> FloatPolygon {
    let vertices = (0..count).map(|index| {
        let x = 10.0 * index as f64 / (count - 1) as f64;
        DVec3::new(x, (0.9 * x).sin(), 0.0)
    });
    FloatPolygon::new(3, vertices.collect(), None, false).expect("a polygon")
}

/// Two curves that run along each other.
fn along(few: &FloatPolygon, many: &FloatPolygon) -> (Editor, Vec<CurveId>) {
    let curves = [("few", few), ("many", many)];
    let curves = curves.map(|(name, polygon)| Curve::new(name, polygon.clone()));
    let mut editor = Editor::with_document(Document::from_curves(curves));
    editor.look(Look::Canvas(DVec2::new(1000.0, 700.0)));
    let ids = editor.document().ids().collect();
    (editor, ids)
}

#[test]
fn the_active_curve_is_dragged_before_others_that_run_along_it() {
    // Many vertices, which are not drawn, over few of another curve.
    let (editor, ids) = along(&wave(40), &wave(2000));
    let few = editor
        .document()
        .curve(ids[0])
        .expect("a curve")
        .polygon
        .clone();
    let at = editor
        .view()
        .viewport()
        .to_screen(few.vertex(20).truncate());
    let mut script = Script { editor };
    for (active, other) in [(ids[1], ids[0]), (ids[0], ids[1])] {
        script.editor.activate(active);
        script.editor.refresh();
        script.drag(at, at + DVec2::new(3.0, 20.0));
        assert_eq!(script.editor.active(), Some(active));
        let before = script.editor.workspace().history().undo_steps();
        assert_eq!(before, 1);
        let of = |id| {
            script
                .editor
                .document()
                .curve(id)
                .expect("a curve")
                .polygon
                .clone()
        };
        assert_eq!(
            of(other),
            [wave(40), wave(2000)][usize::from(other == ids[1])]
        );
        assert_ne!(
            of(active),
            [wave(40), wave(2000)][usize::from(active == ids[1])]
        );
        script.command(Command::Undo);
    }
}

#[test]
fn no_leg_of_another_curve_is_dragged_where_the_active_one_runs() {
    let [few, many] = [wave(12), wave(2000)];
    let (editor, ids) = along(&few, &many);
    let viewport = *editor.view().viewport();
    let seen = |point: DVec3| viewport.to_screen(point.truncate());
    // On a leg, some 3.5 points beside the other curve.
    let place = (0..1000).map(|step| few.vertex(5).lerp(few.vertex(6), f64::from(step) / 2000.0));
    let off = |at: DVec3| {
        let samples = (0..=20_000).map(|it| f64::from(it) / 20_000.0 * many.segments() as f64);
        let distances = samples.map(|u| seen(many.point(u)).distance(seen(at)));
        distances.fold(f64::INFINITY, f64::min)
    };
    let place = place.step_by(10).find(|at| (3.2..3.9).contains(&off(*at)));
    let at = seen(place.expect("a place on the leg"));
    let mut script = Script { editor };
    for (active, is_other) in [(ids[1], true), (ids[0], false)] {
        script.editor.activate(active);
        script.editor.refresh();
        script.drag(at, at + DVec2::new(2.0, 25.0));
        assert_eq!(script.editor.active(), Some(active));
        let of_few = script.editor.document().curve(ids[0]).expect("a curve");
        assert_eq!(of_few.polygon == few, is_other);
        script.command(Command::Undo);
    }
}
