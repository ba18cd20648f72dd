//! Recovered documents, and files that another program changes.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use batten::editor::{Editor, ToolKind};
use batten::geometry::FloatPolygon;
use batten::io::{Sessions, disk};
use eframe::egui::{Event, Key, Modifiers, Vec2};
use egui_kittest::kittest::Queryable;

use super::hand::*;

const BY: Vec2 = Vec2::splat(30.0);

fn sessions(folder: &Path) -> Sessions {
    Sessions::in_folder(folder.join("sessions"))
}

/// An editor with the arc.
fn arc() -> Editor {
    let mut editor = Editor::default();
    editor.open_example(0).expect("the arc");
    editor.dismiss_message();
    editor
}

fn open_with(mut editor: Editor, folder: &Path) -> Window {
    editor.autosave_in(sessions(folder), Duration::from_secs(30));
    open_window_with(editor, 1480.0, 920.0)
}

/// Leave a session with a vertex moved, as a crash does; `path` is the document's file.
fn crash(folder: &Path, path: Option<&Path>) -> FloatPolygon {
    let mut editor = arc();
    if let Some(path) = path {
        editor.save(path).expect("a file");
    }
    let mut window = open_with(editor, folder);
    // What earlier crashes have left is not the matter here.
    while is_offered(&window) {
        click(&mut window, "Later");
    }
    let from = vertex(&window, 4);
    drag(&mut window, from, from + BY);
    window.event(Event::WindowFocused(false));
    window.run();
    curve(&window).polygon
}

/// Whether recovered documents are listed.
fn is_offered(window: &Window) -> bool {
    window.query_by_label("Later").is_some()
}

fn is_modified(window: &Window) -> bool {
    window.state().editor().workspace().is_modified()
}

#[test]
fn recovered_documents_are_listed_opened_and_discarded() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let path = folder.join("hull.batten");
    let changed = crash(folder, Some(&path));
    crash(folder, None);
    let mut window = open_with(arc(), folder);
    let original = curve(&window).polygon;
    for text in ["hull.batten", "Untitled", "Later"] {
        window.get_by_label(text);
    }
    let facts = format!("1 curve · {} vertices", original.vertices().len());
    assert_eq!(window.query_all_by_label_contains(&facts).count(), 2);
    // Nothing else takes keys until that is decided.
    press(&mut window, Modifiers::NONE, Key::D);
    assert_eq!(window.state().editor().hand().tool(), ToolKind::Select);

    click(&mut window, "Open hull.batten");
    assert_eq!(curve(&window).polygon, changed);
    assert!(is_modified(&window));
    let own = window.state().editor().workspace().path();
    assert_eq!(own, Some(path.as_path()));

    // The other one would take the place of changes that are not saved.
    click(&mut window, "Open Untitled");
    window.get_by_label("Save changes?");
    click(&mut window, "Cancel");
    assert!(is_offered(&window));
    click(&mut window, "Discard Untitled");
    assert!(is_offered(&window));
    click(&mut window, "Really discard Untitled");
    assert!(!is_offered(&window));
    press(&mut window, Modifiers::COMMAND, Key::S);
    assert!(!is_modified(&window));
    let saved = disk::read_file(&path).expect("the file").curves;
    assert_eq!(saved[0].polygon, changed);
    drop(window);
    assert!(sessions(folder).abandoned().is_empty());
}

#[test]
fn what_is_left_for_later_is_offered_again() {
    let folder = tempfile::tempdir().expect("a folder");
    crash(folder.path(), None);
    for _ in 0..2 {
        let mut window = open_with(arc(), folder.path());
        assert!(is_offered(&window));
        click(&mut window, "Later");
        assert!(!is_offered(&window));
        assert!(!is_modified(&window));
    }
}

#[test]
fn a_damaged_document_says_so_and_cannot_be_opened() {
    let folder = tempfile::tempdir().expect("a folder");
    crash(folder.path(), None);
    let found = sessions(folder.path()).abandoned();
    fs::write(found[0].path(), "{").expect("damage");
    drop(found);
    let mut window = open_with(arc(), folder.path());
    window.get_by_label("Damaged document");
    let opens = window.query_by_label("Open Damaged document");
    assert!(opens.is_none());
    click(&mut window, "Discard Damaged document");
    assert!(is_offered(&window));
    click(&mut window, "Really discard Damaged document");
    assert!(!is_offered(&window));
}

/// A window on a file that another program has changed, with a change of its own.
fn on_changed_file(folder: &Path) -> (Window, PathBuf) {
    let path = folder.join("hull.batten");
    let mut editor = arc();
    editor.save(&path).expect("a file");
    let mut window = open_window_with(editor, 1480.0, 920.0);
    let from = vertex(&window, 4);
    drag(&mut window, from, from + BY);
    let text = fs::read_to_string(&path).expect("the file");
    fs::write(&path, text.replace("\"degree\": 9", "\"degree\": 8")).expect("the file");
    (window, path)
}

fn degree_in(path: &Path) -> usize {
    let curves = disk::read_file(path).expect("the file").curves;
    curves[0].polygon.degree()
}

#[test]
fn a_file_that_has_changed_is_not_overwritten_unasked() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path) = on_changed_file(folder.path());
    let own = curve(&window);
    press(&mut window, Modifiers::COMMAND, Key::S);
    window.get_by_label("The file has changed on disk");
    assert_eq!(degree_in(&path), 8);
    click(&mut window, "Cancel");
    assert!(degree_in(&path) == 8 && is_modified(&window));
    assert_eq!(curve(&window), own);

    press(&mut window, Modifiers::COMMAND, Key::S);
    click(&mut window, "Save as…");
    let other = folder.path().join("other.batten");
    answer(&mut window, &other);
    assert_eq!((degree_in(&path), degree_in(&other)), (8, 9));
    assert!(!is_modified(&window));

    let (mut window, path) = on_changed_file(folder.path());
    press(&mut window, Modifiers::COMMAND, Key::S);
    click(&mut window, "Overwrite");
    assert!(degree_in(&path) == 9 && !is_modified(&window));

    let (mut window, path) = on_changed_file(folder.path());
    press(&mut window, Modifiers::COMMAND, Key::S);
    click(&mut window, "Reload");
    assert_eq!(curve(&window).polygon.degree(), 8);
    assert!(degree_in(&path) == 8 && !is_modified(&window));
}

#[test]
fn saving_before_something_else_asks_about_a_changed_file_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path) = on_changed_file(folder.path());
    choose(&mut window, &["File", "New"]);
    click(&mut window, "Save");
    window.get_by_label("The file has changed on disk");
    click(&mut window, "Overwrite");
    assert_eq!(degree_in(&path), 9);
    assert!(window.state().editor().document().is_empty(), "gone on");
}

#[test]
fn a_changed_file_is_noticed_when_the_window_gets_the_keyboard() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, _) = on_changed_file(folder.path());
    window.event(Event::WindowFocused(true));
    window.run();
    window.get_by_label_contains("Another program has changed “hull.batten”");
    let own = curve(&window);
    click(&mut window, "Reload");
    assert_eq!(curve(&window).polygon.degree(), 8);
    assert!(!is_modified(&window));
    // Changes that were made here come back.
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(curve(&window), own);
    assert!(is_modified(&window));
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(curve(&window).polygon.degree(), 8);
    assert!(!is_modified(&window));
}

#[test]
fn the_frame_wakes_for_an_autosave_and_otherwise_rests() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_with(arc(), folder.path());
    let from = vertex(&window, 4);
    drag(&mut window, from, from + BY);
    let steps = window.run();
    assert!(steps <= 2, "{steps} frames for nothing");
    let delay = window.output().viewport_output.values().next();
    let delay = delay.expect("a viewport").repaint_delay;
    assert!(delay <= Duration::from_secs(30), "{delay:?}");
}

#[test]
fn escape_leaves_recovered_documents_for_later_and_their_folder_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    crash(folder.path(), None);
    let mut window = open_with(arc(), folder.path());
    let kept = folder.path().join("sessions");
    window.get_by_label(&format!("In {}", kept.display()));
    let centre = |window: &Window| {
        let later = window.get_by_label("Later").rect();
        later.center() - window.ctx.content_rect().center()
    };
    let before = centre(&window);
    window.set_size(Vec2::new(1800.0, 1100.0));
    window.run();
    assert!(
        (centre(&window) - before).length() < 2.0,
        "in the middle again"
    );
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!is_offered(&window));
    drop(window);
    assert_eq!(sessions(folder.path()).abandoned().len(), 1);
}
