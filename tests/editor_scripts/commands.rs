//! Commands, files and the clipboard.

use batten::document::Document;
use batten::editor::{Command, CopyForm, Editor, Input, Key, ToolKind};
use batten::geometry::ParametricCurve;
use glam::DVec2;

use super::script::Script;

#[test]
fn copy_and_paste_add_a_curve_aside_as_one_step() {
    let mut script = Script::example("arc");
    let text = script
        .editor
        .copy(batten::editor::CopyForm::Own)
        .expect("the arc's text");
    let pasted = script.editor.paste(&text).expect("a copy");
    assert!(pasted.offers_undo, "{pasted:?}");
    assert_eq!(script.editor.document().len(), 2);
    let names: Vec<String> = script
        .editor
        .document()
        .curves()
        .map(|(_, c)| c.name.clone())
        .collect();
    assert_ne!(names[0], names[1]);
    script.command(Command::Undo);
    assert_eq!(script.editor.document().len(), 1);
    let refused = script.editor.paste("no curve at all");
    assert!(refused.is_err(), "{refused:?}");
    assert_eq!(script.editor.document().len(), 1);
    assert!(
        script
            .editor
            .message()
            .is_some_and(|message| message.is_error)
    );
}

#[test]
fn a_command_that_cannot_be_given_says_what_it_needs() {
    let mut script = Script::example("arc");
    for (command, told) in [
        (
            Command::ToggleVerticesLocked,
            "Lock vertices: select vertices first",
        ),
        (Command::Undo, "Undo: nothing to undo"),
        (Command::Redo, "Redo: nothing to redo"),
        (
            Command::GoToFeature,
            "Go to feature: choose a feature in its list first",
        ),
    ] {
        script.command(command);
        assert_eq!(script.message(), told);
    }
    // Nothing is told while something goes on.
    script.key(Key::Escape);
    let at = script.at_vertex(1);
    script.press(at);
    script.move_to(at + 30.0);
    script.command(Command::Redo);
    assert!(
        script
            .editor
            .message()
            .is_none_or(|it| !it.text.contains("redo"))
    );
    script.release(at + 30.0);
    script.command(Command::DeleteCurve);
    for command in Command::all() {
        if let Some(need) = command.need(&script.editor) {
            let label = command.label();
            assert!(need.starts_with(label.trim_end_matches('…')), "{need}");
            assert!(need.len() < 100, "{need}");
            script.command(command);
            assert_eq!(script.message(), need);
        }
    }
    assert!(script.editor.document().is_empty());
}

#[test]
fn every_command_can_be_given_at_any_time() {
    for example in ["arc", "periodic"] {
        for command in Command::all() {
            let mut script = Script::example(example);
            script.command(command);
            script.check();
            // Also in the middle of a drag.
            let mut script = Script::example(example);
            let at = script.at_vertex(1);
            script.press(at);
            script.move_to(at + 30.0);
            script.command(command);
            script.move_to(at + 60.0);
            script.release(at + 60.0);
            script.check();
        }
    }
}

#[test]
fn what_only_shows_leaves_a_drag_going_on() {
    let mut script = Script::example("arc");
    let before = script.polygon().vertex(3);
    let at = script.at_vertex(3);
    script.press(at);
    script.move_to(at + 30.0);
    for command in Command::all().into_iter().filter(|c| c.only_shows()) {
        script.command(command);
        assert!(script.editor.hand().is_dragging(), "{command:?}");
    }
    let to = at + 60.0;
    script.move_to(to);
    script.release(to);
    assert_ne!(script.polygon().vertex(3), before);
    assert_eq!(script.steps(), 1);
}

#[test]
fn commands_have_names_and_keys_of_their_own() {
    let commands = Command::all();
    for (index, command) in commands.iter().enumerate() {
        assert!(!command.label().is_empty() && !command.tooltip().is_empty());
        for other in &commands[index + 1..] {
            assert_ne!(command.label(), other.label());
            if let Some(shortcut) = command.shortcut() {
                assert_ne!(
                    Some(shortcut),
                    other.shortcut(),
                    "{command:?} and {other:?}"
                );
            }
        }
    }
}

#[test]
fn an_empty_document_says_what_to_do() {
    let mut script = Script::example("arc");
    script.editor.begin_empty();
    assert!(script.editor.document().is_empty());
    assert!(
        script.editor.hint().contains("draw"),
        "{}",
        script.editor.hint()
    );
    for tool in ToolKind::ALL {
        script.tool(tool);
        script.click(DVec2::new(300.0, 300.0));
        script.drag(DVec2::new(100.0, 100.0), DVec2::new(200.0, 200.0));
        script.key(Key::Enter);
        script.key(Key::Escape);
        script.check();
    }
}

#[test]
fn several_files_open_as_one_document_and_a_bad_one_changes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut script = Script::example("arc");
    let paths = ["a", "b"].map(|name| folder.path().join(format!("{name}.batten")));
    for path in &paths {
        script.editor.save(path).expect("a file");
    }
    let mut editor = batten::editor::Editor::new();
    editor.open(&paths).expect("two files");
    assert_eq!(editor.document().len(), 2);
    assert_eq!(editor.workspace().path(), None);
    editor.open(&paths[..1]).expect("a file");
    assert_eq!(editor.workspace().path(), Some(paths[0].as_path()));
    let missing = folder.path().join("missing.batten");
    let error = editor
        .open(&[paths[1].clone(), missing])
        .expect_err("a missing file");
    assert!(error.to_string().contains("missing.batten"), "{error}");
    assert_eq!(editor.workspace().path(), Some(paths[0].as_path()));
}

#[test]
fn a_command_after_a_held_key_is_a_step_of_its_own() {
    let mut script = Script::example("arc");
    script.operate("extend", &[]).expect("a longer curve");
    script.key(Key::Function(6));
    script.input(Input::KeyRepeated(Key::Function(6)));
    script.operate("extend", &[]).expect("a longer curve");
    assert_eq!(script.steps(), 2);
}

#[test]
fn copies_for_other_programs_come_back_as_the_same_curve() {
    let mut script = Script::example("arc");
    let own = script.editor.document().clone();
    let (_, arc) = own.curves().next().expect("the arc");
    let table = script.editor.copy(CopyForm::Table).expect("a table");
    assert!(table.contains('\t'), "columns for spreadsheets");
    let path = script.editor.copy(CopyForm::SvgPath).expect("a path");
    assert!(path.starts_with('M') && path.contains('C'), "{path}");
    let message = script.message();
    assert!(
        message.starts_with("“arc” copied as an SVG path\n“arc”: written as "),
        "{message}"
    );
    let mut other = Editor::with_document(Document::default());
    other.paste(&path).expect("the path");
    let document = other.document();
    let curve = document.curves().next().map(|(_, it)| it.polygon.clone());
    let reference = document.references().next().map(|(_, it)| it.curve.clone());
    let pasted: &dyn ParametricCurve = match (&curve, &reference) {
        (Some(curve), _) => curve,
        (None, reference) => reference.as_ref().expect("a reference"),
    };
    let size = arc.polygon.size();
    for piece in 0..=32 {
        let u = pasted.pieces() as f64 * f64::from(piece) / 32.0;
        let off = arc.polygon.nearest(pasted.jet(u).point).distance;
        assert!(off <= 1e-4 * size, "{piece}: {off}");
    }
    let mut other = Editor::with_document(Document::default());
    other.paste(&table).expect("the table");
    let (_, copy) = other.document().curves().next().expect("a curve");
    let moved = copy.polygon.vertex(0) - arc.polygon.vertex(0);
    for (index, vertex) in arc.polygon.vertices().iter().enumerate() {
        assert!((copy.polygon.vertex(index) - *vertex).distance(moved) <= 1e-12 * size);
    }
}
