//! Drawing polygons and measuring: hasty clicks, undo, the first curve of a document.

use batten::editor::{
    CombSettings, Command, DrawWay, Input, Key, Mark, Modifiers, NamedView, ToolKind,
};
use glam::{DVec2, DVec3};

use super::script::Script;
use super::several::two;

const CORNERS: [DVec2; 5] = [
    DVec2::new(200.0, 500.0),
    DVec2::new(300.0, 200.0),
    DVec2::new(500.0, 180.0),
    DVec2::new(700.0, 250.0),
    DVec2::new(800.0, 520.0),
];

fn drawing() -> Script {
    let mut script = Script::example("arc");
    script.editor.begin_empty();
    script.draw_by(DrawWay::Vertices);
    script.tool(ToolKind::Draw);
    for corner in CORNERS {
        script.click(corner);
    }
    script
}

#[test]
fn a_hasty_click_on_the_first_vertex_closes_the_polygon() {
    for (from, to) in [
        (DVec2::new(2.0, 1.0), DVec2::new(6.0, 1.0)),
        (DVec2::new(7.0, 0.0), DVec2::new(11.0, 0.0)),
        (DVec2::new(11.0, 0.0), DVec2::new(6.0, 0.0)),
    ] {
        let mut script = drawing();
        script.drag(CORNERS[0] + from, CORNERS[0] + to);
        assert_eq!(script.editor.document().len(), 1);
        assert!(script.polygon().is_periodic());
        assert_eq!(script.polygon().vertices().len(), CORNERS.len());
    }
    // A real drag from the first vertex sets a vertex where it ends.
    let mut script = drawing();
    script.drag(CORNERS[0], CORNERS[0] + DVec2::new(150.0, -20.0));
    script.key(Key::Enter);
    assert_eq!(script.polygon().vertices().len(), CORNERS.len() + 1);
    assert!(!script.polygon().is_periodic());
}

#[test]
fn undo_takes_back_the_last_point_before_any_step_of_the_document() {
    let mut script = Script::example("hull");
    script.drag_vertex(2, DVec2::new(10.0, 20.0));
    let before = script.polygon();
    script.draw_by(DrawWay::Vertices);
    script.tool(ToolKind::Draw);
    for corner in CORNERS {
        script.click(corner);
    }
    assert_eq!(Command::Undo.label_now(&script.editor), "Undo last point");
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
    script.key(Key::Enter);
    assert_eq!(script.polygon().vertices().len(), CORNERS.len() - 1);
    script.command(Command::Undo);
    script.command(Command::Undo);
    assert_ne!(script.polygon(), before);
}

#[test]
fn undo_is_offered_for_points_in_an_empty_document_too() {
    let mut script = drawing();
    assert!(Command::Undo.is_enabled(&script.editor));
    for _ in CORNERS {
        script.command(Command::Undo);
    }
    assert!(!Command::Undo.is_enabled(&script.editor));
    script.key(Key::Enter);
    assert!(script.editor.document().is_empty());
}

#[test]
fn redo_sets_the_point_again_that_undo_took_back() {
    let mut script = Script::example("arc");
    let before = script.steps();
    script.drag_vertex(2, DVec2::new(9.0, 5.0));
    script.command(Command::Undo);
    script.tool(ToolKind::Draw);
    let clicks = [(200.0, 200.0), (300.0, 260.0), (400.0, 220.0)].map(DVec2::from);
    for at in clicks {
        script.click(at);
    }
    script.command(Command::Undo);
    script.command(Command::Undo);
    for _ in 0..2 {
        assert!(Command::Redo.is_enabled(&script.editor));
        script.command(Command::Redo);
    }
    assert!(
        !Command::Redo.is_enabled(&script.editor),
        "the step comes after the drawing"
    );
    // Another point takes the place of what was taken back.
    script.command(Command::Undo);
    script.click(DVec2::new(420.0, 300.0));
    assert!(!Command::Redo.is_enabled(&script.editor));
    script.key(Key::Enter);
    assert_eq!(script.steps(), before + 1);
}

#[test]
fn a_cancelled_drawing_comes_back() {
    let mut script = drawing();
    let before = script.editor.document().len();
    let drawn = script.scene().marks.len();
    script.key(Key::Escape);
    assert!(script.message().contains("Ctrl+Z"), "{}", script.message());
    assert!(script.scene().marks.len() < drawn);
    script.command(Command::Undo);
    assert_eq!(script.scene().marks.len(), drawn);
    script.key(Key::Enter);
    assert_eq!(script.editor.document().len(), before + 1);
    // Other points leave nothing to bring back.
    let mut script = drawing();
    script.key(Key::Escape);
    script.click(CORNERS[0]);
    script.key(Key::Backspace);
    assert!(!Command::Undo.is_enabled(&script.editor));
}

#[test]
fn the_view_stays_where_the_first_curve_is_drawn() {
    let mut script = Script::example("arc");
    script.editor.begin_empty();
    script.tool(ToolKind::Draw);
    script.draw_by(DrawWay::OnClicks);
    script.click(CORNERS[0]);
    script.click(CORNERS[1]);
    let view = *script.editor.view().viewport();
    for corner in &CORNERS[2..] {
        script.click(*corner);
    }
    script.key(Key::Enter);
    assert_eq!(script.editor.document().len(), 1);
    assert_eq!(*script.editor.view().viewport(), view);
}

#[test]
fn the_first_curve_that_is_drawn_is_fitted_with_a_comb_of_its_own() {
    let mut script = Script::example("periodic");
    script.editor.view_mut().set_comb(CombSettings {
        scale: 1e5,
        density: 3,
    });
    script.editor.begin_empty();
    assert_eq!(script.editor.view().comb(), CombSettings::default());
    script.tool(ToolKind::Draw);
    // Small, in a corner.
    for corner in CORNERS {
        script.click(0.1 * corner);
    }
    script.key(Key::Enter);
    let view = *script.editor.view().viewport();
    let seen = |index| view.to_screen(script.polygon().vertex(index).truncate());
    assert!(seen(0).distance(seen(4)) > 0.3 * view.size.x);
    assert_ne!(
        script.editor.view().comb().scale,
        CombSettings::default().scale
    );
    // The second one leaves the view as it is.
    script.tool(ToolKind::Draw);
    for corner in CORNERS {
        script.click(0.1 * corner);
    }
    script.key(Key::Enter);
    assert_eq!(*script.editor.view().viewport(), view);
}

/// The distance that the measure tool tells.
fn told(script: &Script) -> f64 {
    let hint = script.editor.hint();
    let first = hint.split_whitespace().nth(1).expect("a figure");
    first.parse().expect("a number")
}

#[test]
fn a_measurement_stays_true_from_another_side() {
    let mut script = Script::example("arc");
    script.tool(ToolKind::Measure);
    script.click(DVec2::new(200.0, 500.0));
    script.click(DVec2::new(500.0, 350.0));
    let hint = script.editor.hint();
    let expected = DVec2::new(300.0, 150.0) / script.editor.view().viewport().scale;
    assert!((told(&script) - expected.length()).abs() < 1e-5);
    assert!(hint.contains(" Δx ") && hint.contains(" Δy "), "{hint}");
    for view in NamedView::ALL {
        script.command(Command::View(view));
        assert_eq!(script.editor.hint(), hint);
    }
}

#[test]
fn between_vertices_in_space_the_distance_is_that_in_space() {
    let mut script = Script::example("arc");
    let curve = script.curve();
    let moves = vec![(0, script.polygon().vertex(0) + DVec3::new(0.0, 0.0, 7.0))];
    let edit = batten::document::Edit::MoveVertices { curve, moves };
    script.editor.apply("lift", vec![edit]).expect("an edit");
    script.command(Command::ToggleSnapping);
    script.tool(ToolKind::Measure);
    script.click(script.at_vertex(0));
    script.click(script.at_vertex(9));
    let expected = script
        .polygon()
        .vertex(0)
        .distance(script.polygon().vertex(9));
    assert!(
        (told(&script) - expected).abs() < 1e-5,
        "{}",
        script.editor.hint()
    );
    assert!(
        script.editor.hint().contains(" Δz "),
        "{}",
        script.editor.hint()
    );
}

#[test]
fn hasty_clicks_measure_as_clicks_do() {
    let mut script = Script::example("arc");
    script.tool(ToolKind::Measure);
    let (from, to) = (DVec2::new(200.0, 500.0), DVec2::new(500.0, 350.0));
    let jerk = DVec2::new(4.0, 0.0);
    script.drag(from, from + jerk);
    script.drag(to - jerk, to);
    let expected = (to - from).length() / script.editor.view().viewport().scale;
    assert!(
        (told(&script) - expected).abs() < 1e-5,
        "{}",
        script.editor.hint()
    );
    // By a drag.
    script.drag(to, from);
    assert!(
        (told(&script) - expected).abs() < 1e-5,
        "{}",
        script.editor.hint()
    );
    // Undo takes back a first point that waits for the second.
    script.click(from);
    let steps = script.steps();
    script.command(Command::Undo);
    assert_eq!(script.steps(), steps);
    assert!(script.editor.hint().starts_with("Click two points"));
}

#[test]
fn a_key_that_is_held_makes_one_step() {
    let mut script = Script::example("hull");
    script.click(script.at_vertex(3));
    let before = script.polygon();
    script.key(Key::Right);
    let once = script.polygon().vertex(3).x - before.vertex(3).x;
    for _ in 0..20 {
        script.input(Input::KeyRepeated(Key::Right));
    }
    let moved = script.polygon().vertex(3).x - before.vertex(3).x;
    assert!((moved / once - 21.0).abs() < 1e-9, "{moved} against {once}");
    assert_eq!(script.steps(), 1);
    // Released and pressed again it is another step.
    script.key(Key::Right);
    script.input(Input::KeyRepeated(Key::Right));
    assert_eq!(script.steps(), 2);
    script.command(Command::Undo);
    script.command(Command::Undo);
    assert_eq!(script.polygon(), before);
    script.modifiers(Modifiers::NONE);
}

fn way(script: &Script) -> DrawWay {
    script.editor.hand().draw_settings().way
}

#[test]
fn t_changes_the_way_while_drawing_and_it_is_remembered() {
    assert_eq!(way(&Script::example("arc")), DrawWay::OnClicks);
    let mut script = drawing();
    script.draw_by(DrawWay::OnClicks);
    for expected in [
        DrawWay::Vertices,
        DrawWay::ThroughPoints,
        DrawWay::Points,
        DrawWay::OnClicks,
    ] {
        script.key(Key::Character('t'));
        assert_eq!(way(&script), expected);
    }
    script.key(Key::Character('t'));
    script.key(Key::Enter);
    // Five clicks are five vertices.
    assert_eq!(script.polygon().vertices().len(), CORNERS.len());
    script.editor.begin_empty();
    assert_eq!(way(&script), DrawWay::Vertices);
}

#[test]
fn a_curve_through_points_is_shown_while_it_is_drawn() {
    for (view, closes) in [
        (NamedView::Xy, false),
        (NamedView::Xy, true),
        (NamedView::Yz, false),
    ] {
        let mut script = Script::example("arc");
        script.editor.begin_empty();
        script.command(Command::View(view));
        script.tool(ToolKind::Draw);
        script.key(Key::Character('t'));
        script.key(Key::Character('t'));
        let viewport = *script.editor.view().viewport();
        let mut clicks = Vec::new();
        for corner in CORNERS {
            script.click(corner);
            clicks.push(viewport.to_model(corner));
        }
        let at = if closes { CORNERS[0] } else { CORNERS[4] };
        script.move_to(at);
        assert!(!script.scene().proposal.curve.is_empty());
        match closes {
            true => script.click(at),
            false => script.key(Key::Enter),
        }
        let polygon = script.polygon();
        assert_eq!(polygon.is_periodic(), closes);
        assert_eq!(polygon.degree(), 5);
        for click in clicks {
            let passes = (0..=400 * polygon.segments()).map(|it| {
                let point = polygon.point(it as f64 / 400.0);
                viewport.flatten(point).distance(click)
            });
            let nearest = passes.fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-3 * polygon.size(), "{nearest}");
        }
        assert_eq!(script.steps(), 1);
    }
}

#[test]
fn a_curve_that_makes_a_detour_is_marked() {
    let detours = |script: &mut Script| {
        let marks = script.scene().marks.iter();
        let texts = marks.filter_map(|mark| match mark {
            Mark::Extreme { text, .. } => Some(text.clone()),
            _ => None,
        });
        texts.filter(|text| text.contains("longer")).count()
    };
    let mut script = Script::example("arc");
    script.editor.begin_empty();
    script.tool(ToolKind::Draw);
    let zigzag = [
        (100.0, 300.0),
        (600.0, 310.0),
        (130.0, 330.0),
        (620.0, 350.0),
    ];
    for at in zigzag {
        script.click(DVec2::from(at));
    }
    assert_eq!(detours(&mut script), 0, "only of points that it passes");
    script.key(Key::Character('t'));
    script.key(Key::Character('t'));
    assert_eq!(detours(&mut script), 1);
    script.key(Key::Enter);
    assert!(script.message().contains("longer"), "{}", script.message());
    // Along a gentle bend there is none.
    script.tool(ToolKind::Draw);
    for corner in CORNERS {
        script.click(corner);
    }
    assert_eq!(detours(&mut script), 0);
}

#[test]
fn a_new_curve_is_compared_with_nothing() {
    let (mut script, [arc, other]) = two();
    script.command(Command::Compare(Some(other)));
    assert_eq!(script.editor.sight().compared(), Some(other));
    script.tool(ToolKind::Draw);
    for corner in CORNERS {
        script.click(corner);
    }
    script.key(Key::Enter);
    assert_ne!(script.curve(), arc);
    assert_eq!(script.editor.sight().compared(), None);
    assert!(script.editor.sight().deviation().is_none());
    // The comparison belongs to the first curve.
    script.editor.activate(arc);
    assert_eq!(script.editor.sight().compared(), Some(other));
    script.editor.activate(other);
    assert_eq!(script.editor.sight().compared(), None);
}

#[test]
fn another_tool_or_saving_ends_the_drawing_and_keeps_its_curve() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("drawn.batten");
    let leave: [fn(&mut Script, &std::path::Path); 4] = [
        |script, _| script.command(Command::Tool(ToolKind::Select)),
        |script, _| script.command(Command::Tool(ToolKind::Draw)),
        |script, path| {
            drop(script.editor.save(path));
        },
        |script, path| {
            drop(script.editor.save(path));
            drop(script.editor.save_unless_changed());
        },
    ];
    for (way, leave) in leave.into_iter().enumerate() {
        let mut script = drawing();
        let (before, steps) = (script.editor.document().len(), script.steps());
        leave(&mut script, &path);
        assert_eq!(script.editor.document().len(), before + 1, "{way}");
        assert_eq!(script.steps(), steps + 1, "{way}");
        if path.exists() {
            let written = std::fs::read_to_string(&path).expect("a file");
            let count = written.matches("\"vertices\"").count();
            assert_eq!(count, before + 1, "{way}");
            std::fs::remove_file(&path).expect("a file");
        }
        script.command(Command::Undo);
        assert_eq!(script.editor.document().len(), before, "{way}");
    }
}

#[test]
fn saving_says_that_a_preview_is_not_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("arc.batten");
    let mut script = Script::example("arc");
    drop(script.editor.save(&path));
    assert!(
        !script.message().contains("previewed"),
        "{}",
        script.message()
    );
    let from = script.at_vertex(3);
    script.press(from);
    script.move_to(from + DVec2::new(0.0, 30.0));
    drop(script.editor.save(&path));
    assert!(
        script.message().ends_with("without what is previewed"),
        "{}",
        script.message()
    );
}

#[test]
fn the_first_point_typed_again_closes_the_curve() {
    let mut script = Script::example("arc");
    script.editor.begin_empty();
    script.tool(ToolKind::Draw);
    for text in ["-20,0", "-10,20", "10,20", "20,0", "-20,0"] {
        script.editor.enter(text).expect("a point");
        script.check();
    }
    assert!(script.polygon().is_periodic());
    assert_eq!(script.polygon().vertices().len(), 4);
}

#[test]
fn delete_takes_back_a_point_of_a_drawing_and_leaves_other_curves() {
    let mut script = drawing();
    let before = script.editor.document().len();
    let drawn = script.scene().marks.len();
    for _ in 0..2 {
        script.command(Command::Delete);
    }
    assert_eq!(script.scene().marks.len(), drawn - 2);
    assert_eq!(script.editor.document().len(), before);
}

#[test]
fn a_click_that_lets_a_curve_go_on_says_how_far_it_moves_the_rest() {
    let mut script = Script::example("s-curve");
    script.tool(ToolKind::AddVertex);
    let before = script.polygon();
    let end = before.end_jet(batten::geometry::End::Finish).point;
    let viewport = script.editor.view().viewport();
    let at = viewport.to_screen(viewport.flatten(end)) + DVec2::new(40.0, 60.0);
    script.move_to(at);
    let named = |script: &mut Script| {
        let marks = script.scene().marks.iter();
        let texts = marks.filter_map(|mark| match mark {
            Mark::Name(_, text) | Mark::Label(_, text) => Some(text.clone()),
            _ => None,
        });
        texts.collect::<Vec<_>>().join("\n")
    };
    let foretold = named(&mut script);
    assert!(foretold.contains("moves by at most"), "{foretold}");
    script.click(at);
    let message = script.message();
    assert!(message.contains(&foretold), "{message} {foretold}");
    // As far as that, and not much less.
    let bound = foretold
        .rsplit(' ')
        .find_map(|word| word.parse::<f64>().ok());
    let bound = bound.expect("a length");
    let after = script.polygon();
    let off = (0..=1000).map(|step| {
        let u = f64::from(step) / 1000.0 * before.segments() as f64;
        before.point(u).distance(after.point(u))
    });
    let off = off.fold(0.0, f64::max);
    assert!(off <= bound && off >= 0.9 * bound, "{off} {bound}");
}
