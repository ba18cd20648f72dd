//! What is being tried out, and what ends it: saving and looking do not, everything else does.

use std::path::PathBuf;

use batten::document::{Document, Edit};
use batten::editor::{Command, Key, NamedView, Note};
use batten::geometry::PolygonKind;
use batten::io::disk;
use glam::{DVec2, DVec3};

use super::script::Script;
use super::window::exporter;

/// How far the drags go, in screen points.
const BY: DVec2 = DVec2::new(40.0, -25.0);

/// The arc in the middle of a drag of vertex 3, and the document without it.
fn dragging() -> (Script, Document) {
    let mut script = Script::example("arc");
    let before = script.editor.document().clone();
    let at = script.at_vertex(3);
    script.press(at);
    script.move_to(at + BY);
    assert!(!script.editor.document().is_same(&before));
    (script, before)
}

/// The arc in the middle of a number field's drag, and the document without it.
fn in_field() -> (Script, Document) {
    let mut script = Script::example("arc");
    let before = script.editor.document().clone();
    preview(&mut script, DVec3::new(1.5, 2.5, 0.0));
    assert!(!script.editor.document().is_same(&before));
    (script, before)
}

/// Show vertex 3 somewhere else, as its number fields do.
fn preview(script: &mut Script, to: DVec3) {
    let edits = moved(script, to);
    script.editor.preview("Set coordinate", edits);
    script.check();
}

fn moved(script: &Script, to: DVec3) -> Vec<Edit> {
    vec![Edit::MoveVertices {
        curve: script.curve(),
        moves: vec![(3, to)],
    }]
}

/// A folder, and a path in it.
fn file(name: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    (folder, path)
}

/// Save and export in the middle of what is being tried out: it goes on, and files hold the
/// document without it.
fn check_saved(script: &mut Script, before: &Document) {
    let shown = script.editor.document().clone();
    let preview = script.editor.workspace().preview();
    let (folder, path) = file("own.batten");
    script.editor.save(&path).expect("a file");
    let export = exporter("csv", PolygonKind::Float);
    let table = folder.path().join("own.csv");
    script.editor.export(&table, &export).expect("a table");
    let expected: Vec<_> = before.curves().map(|(_, curve)| &curve.polygon).collect();
    for file in [path, table] {
        let read = disk::read_file(&file).expect("what was written").curves;
        let read: Vec<_> = read.iter().map(|curve| &curve.polygon).collect();
        assert_eq!(read, expected, "{}", file.display());
    }
    assert!(preview.is_some() && script.editor.workspace().preview() == preview);
    assert!(script.editor.document().is_same(&shown));
    assert!(script.editor.workspace().settled().is_same(before));
    assert_eq!(script.steps(), 0);
}

#[test]
fn saving_in_the_middle_of_a_drag_ends_nothing_and_writes_no_preview() {
    let (mut script, before) = dragging();
    check_saved(&mut script, &before);
    assert!(script.editor.hand().is_dragging());
    let to = script.at_vertex(3) + BY;
    script.move_to(to);
    script.release(to);
    assert_eq!(script.steps(), 1);
    assert!(script.editor.workspace().is_modified(), "the drag is kept");
    script.command(Command::Undo);
    assert!(!script.editor.workspace().is_modified());
}

#[test]
fn saving_in_the_middle_of_a_drag_that_is_taken_back_leaves_nothing_to_save() {
    let (mut script, before) = dragging();
    check_saved(&mut script, &before);
    script.key(Key::Escape);
    assert!(!script.editor.workspace().is_modified());
}

#[test]
fn saving_in_the_middle_of_a_field_ends_nothing_and_writes_no_preview() {
    let (mut script, before) = in_field();
    check_saved(&mut script, &before);
    let shown = script.editor.document().clone();
    script.editor.commit_preview();
    assert_eq!(script.steps(), 1);
    assert!(script.editor.document().is_same(&shown));
    assert!(script.editor.workspace().is_modified(), "the value is kept");

    let (mut script, before) = in_field();
    check_saved(&mut script, &before);
    script.editor.abort_preview();
    assert!(!script.editor.workspace().is_modified());
}

#[test]
fn what_only_shows_leaves_a_field_going_on() {
    let (mut script, before) = in_field();
    let preview = script.editor.workspace().preview();
    let shown = script.editor.document().clone();
    for command in Command::all().into_iter().filter(|c| c.only_shows()) {
        assert_eq!(
            script.editor.execute(command),
            Ok(Note::silent()),
            "{command:?}"
        );
        script.check();
        assert_eq!(script.editor.workspace().preview(), preview, "{command:?}");
    }
    assert!(script.editor.document().is_same(&shown));
    script.editor.abort_preview();
    assert!(script.editor.document().is_same(&before));
}

#[test]
fn what_is_more_than_showing_keeps_a_field_and_takes_back_a_drag() {
    let is_ending = |command: &Command| {
        !command.only_shows() && !matches!(command, Command::Undo | Command::Redo)
    };
    for command in Command::all().into_iter().filter(is_ending) {
        let (mut script, before) = in_field();
        if !command.is_enabled(&script.editor) {
            continue;
        }
        let shown = script.editor.document().clone();
        script.command(command);
        leave_its_own_preview(&mut script, command);
        assert_eq!(script.editor.workspace().preview(), None, "{command:?}");
        let of_its_own = script.steps() - 1;
        for _ in 0..of_its_own {
            script.command(Command::Undo);
        }
        assert!(script.editor.document().is_same(&shown), "{command:?}");
        script.command(Command::Undo);
        assert!(script.editor.document().is_same(&before), "{command:?}");

        let (mut script, before) = dragging();
        script.command(command);
        leave_its_own_preview(&mut script, command);
        assert_eq!(script.editor.workspace().preview(), None, "{command:?}");
        assert!(!script.editor.hand().is_dragging(), "{command:?}");
        script.undo_all();
        assert!(script.editor.document().is_same(&before), "{command:?}");
        // Of the drag nothing can be made again. What the field shows is not symmetric, but for the drag it is.
        let of_its_own = match command {
            Command::ToggleSymmetric => 1,
            _ => of_its_own,
        };
        let redone = |script: &mut Script| {
            script.command(Command::Redo);
            script.steps()
        };
        assert!(redone(&mut script) <= of_its_own, "{command:?}");
    }
}

/// An operation's command begins a preview of its own.
fn leave_its_own_preview(script: &mut Script, command: Command) {
    let trial = script.editor.operation().map(|trial| trial.operation());
    if trial.is_some_and(|operation| command == Command::Operation(operation)) {
        script.editor.operating().leave();
    }
}

#[test]
fn undo_in_the_middle_of_a_drag_takes_back_only_the_drag() {
    let mut script = Script::example("arc");
    script.drag_vertex(5, BY);
    let before = script.editor.document().clone();
    let at = script.at_vertex(3);
    script.press(at);
    script.move_to(at + BY);
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
    assert_eq!(script.steps(), 1);
    assert!(!Command::Redo.is_enabled(&script.editor));
    // The rest of the drag does nothing.
    script.move_to(at + 2.0 * BY);
    script.release(at + 2.0 * BY);
    assert!(script.editor.document().is_same(&before));
    script.command(Command::Undo);
    assert_eq!(script.steps(), 0);
}

#[test]
fn undo_with_a_fields_preview_keeps_its_value_as_a_step_and_takes_that_back() {
    let mut script = Script::example("arc");
    script.drag_vertex(5, BY);
    let before = script.editor.document().clone();
    preview(&mut script, DVec3::new(1.5, 2.5, 0.0));
    let shown = script.editor.document().clone();
    assert_eq!(
        Command::Undo.label_now(&script.editor),
        "Undo set coordinate"
    );
    script.command(Command::Undo);
    assert!(script.editor.document().is_same(&before));
    assert_eq!(script.steps(), 1);
    script.command(Command::Redo);
    assert!(script.editor.document().is_same(&shown));
    assert_eq!(script.steps(), 2);
}

#[test]
fn escape_takes_back_what_a_field_shows() {
    let (mut script, before) = in_field();
    script.key(Key::Escape);
    assert!(script.editor.document().is_same(&before));
    assert_eq!(script.editor.workspace().preview(), None);
    assert_eq!(script.steps(), 0);
    assert!(!Command::Undo.is_enabled(&script.editor));
    assert!(!Command::Redo.is_enabled(&script.editor));
}

#[test]
fn a_fields_message_goes_with_the_next_value_that_can_be_shown() {
    let (mut script, _) = in_field();
    let shown = script.editor.document().clone();
    preview(&mut script, DVec3::new(f64::NAN, 0.0, 0.0));
    let message = script.editor.message().expect("why not");
    assert!(message.is_error, "{message:?}");
    assert!(message.text.contains("finite numbers"), "{message:?}");
    assert!(script.editor.document().is_same(&shown), "what was good");
    preview(&mut script, DVec3::new(1.5, 3.5, 0.0));
    assert_eq!(script.editor.message(), None);
    // A message that tells of something else stays.
    let (_folder, path) = file("own.batten");
    script.editor.save(&path).expect("a file");
    preview(&mut script, DVec3::new(1.5, 4.5, 0.0));
    assert!(script.message().starts_with("Saved to"));
}

#[test]
fn a_fields_message_goes_when_the_field_is_taken_back() {
    let refused = || {
        let (mut script, _) = in_field();
        preview(&mut script, DVec3::new(f64::NAN, 0.0, 0.0));
        assert!(script.editor.message().is_some());
        script
    };
    let mut script = refused();
    script.key(Key::Escape);
    assert_eq!(script.editor.message(), None);
    let mut script = refused();
    script.editor.abort_preview();
    assert_eq!(script.editor.message(), None);
}

#[test]
fn what_is_dragged_is_dragged_in_the_plane_that_is_seen() {
    let views = NamedView::ALL.map(Command::View);
    let (mut script, _) = dragging();
    let seen = *script.editor.view().viewport();
    for view in views {
        assert!(!view.is_enabled(&script.editor), "{view:?}");
        script.command(view);
        assert_eq!(*script.editor.view().viewport(), seen, "{view:?}");
        assert!(script.editor.hand().is_dragging(), "{view:?}");
    }
    script.key(Key::Escape);
    let (script, _) = in_field();
    for view in views {
        assert!(view.is_enabled(&script.editor), "{view:?}");
    }
}

#[test]
fn a_field_that_ends_leaves_a_drag_alone() {
    let (mut script, before) = dragging();
    let shown = script.editor.document().clone();
    script.editor.commit_preview();
    script.editor.abort_preview();
    assert!(script.editor.hand().is_dragging());
    assert!(script.editor.document().is_same(&shown));
    assert_eq!(script.steps(), 0);
    script.key(Key::Escape);
    assert!(script.editor.document().is_same(&before));
}
