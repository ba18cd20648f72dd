//! Files of other programs, saved back in their own format.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use batten::editor::{EditedFile, Editor};
use batten::io::{disk, examples::EXAMPLES};
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

use super::hand::*;

/// Write the arc in some format.
fn arc_in(folder: &Path, extension: &str) -> PathBuf {
    let path = folder.join(format!("arc.{extension}"));
    let document = EXAMPLES[0].read().expect("the arc").into_document();
    let document = document.expect("a document");
    disk::write_document(&path, &document, None).expect("a file");
    path
}

/// Edit a file in a window, and move its curve.
fn moved(path: &Path, is_alone: bool) -> Window {
    let mut editor = Editor::default();
    editor.filing_mut().edit(EditedFile::new(path, is_alone));
    editor.open(&[path.to_owned()]).expect("the file opens");
    editor.dismiss_message();
    let mut window = open_window_with(editor, 1480.0, 920.0);
    nudge(&mut window);
    window
}

/// Move all vertices by a step to the right.
fn nudge(window: &mut Window) {
    press(window, Modifiers::COMMAND, Key::A);
    press(window, Modifiers::NONE, Key::ArrowRight);
    assert!(is_modified(window));
}

fn is_modified(window: &Window) -> bool {
    window.state().editor().workspace().is_modified()
}

fn is_saved(window: &Window) -> bool {
    let edited = window.state().editor().filing().edited();
    let flag = edited.map(EditedFile::saved_flag).expect("an edited file");
    flag.load(Ordering::Relaxed)
}

fn save(window: &mut Window) {
    press(window, Modifiers::COMMAND, Key::S);
}

const QUESTION: &str = "Save with losses?";

#[test]
fn every_format_of_drawings_is_saved_back() {
    for extension in [
        "dxf", "step", "ap242", "igs", "3dm", "svg", "glif", "obj", "brep", "json",
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = arc_in(folder.path(), extension);
        let before = fs::read(&path).expect("the file");
        let mut window = moved(&path, false);
        let edited = curve(&window);

        save(&mut window);
        // Only what was edited changes in the text of these.
        if !matches!(extension, "svg" | "glif") {
            window.get_by_label(QUESTION);
            window.get_by_label_contains("holds the curves alone");
            assert_eq!(fs::read(&path).expect("the file"), before, "{extension}");
            click(&mut window, "Cancel");
            assert!(is_modified(&window) && !is_saved(&window), "{extension}");

            save(&mut window);
            click(&mut window, "Save");
        }
        assert!(window.query_by_label(QUESTION).is_none(), "{extension}");
        assert!(!is_modified(&window) && is_saved(&window), "{extension}");
        let curves = disk::read_file(&path).expect("the file").curves;
        assert_eq!(curves.len(), 1, "{extension}");
        let written = curves[0].polygon.point(0.5);
        let off = written.distance(edited.polygon.point(0.5));
        assert!(off < 1e-9 * edited.polygon.size(), "{extension}: {off}");

        // The question comes once.
        nudge(&mut window);
        save(&mut window);
        assert!(window.query_by_label(QUESTION).is_none(), "{extension}");
        assert!(!is_modified(&window), "{extension}");
    }
}

#[test]
fn everything_else_in_a_drawing_stays() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("logo.svg");
    let text = "<svg xmlns='http://www.w3.org/2000/svg' width='9mm' height='9mm' viewBox='1 1 9 9'>\n\
        <!-- stays --><text x='3'>Batten</text>\n<path d='M1 2C3 4 5 2 7 8' class=\"hull\"/></svg>";
    fs::write(&path, text).expect("the file");
    let mut window = moved(&path, false);
    save(&mut window);
    assert!(!is_modified(&window) && is_saved(&window));
    let saved = fs::read_to_string(&path).expect("the file");
    let [before, after] = text.split("M1 2C3 4 5 2 7 8").collect::<Vec<_>>()[..] else {
        panic!("one path");
    };
    assert!(
        saved != text && saved.starts_with(before) && saved.ends_with(after),
        "{saved}"
    );
    // Undone, the file is what it was.
    press(&mut window, Modifiers::COMMAND, Key::Z);
    save(&mut window);
    assert_eq!(fs::read_to_string(&path).expect("the file"), text);
}

#[test]
fn nothing_is_asked_where_nothing_is_lost() {
    for (extension, is_alone) in [("step", true), ("batten", false)] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = arc_in(folder.path(), extension);
        let mut window = moved(&path, is_alone);
        save(&mut window);
        assert!(window.query_by_label(QUESTION).is_none(), "{extension}");
        assert!(!is_modified(&window) && is_saved(&window), "{extension}");
    }
}

#[test]
fn losses_of_the_curves_are_named_even_if_they_are_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = arc_in(folder.path(), "step");
    let mut window = moved(&path, true);
    let before = fs::read(&path).expect("the file");
    press(&mut window, Modifiers::NONE, Key::L);
    save(&mut window);
    window.get_by_label(QUESTION);
    window.get_by_label_contains("vertex locks aren't stored in the STEP");
    assert_eq!(fs::read(&path).expect("the file"), before);
}

#[test]
fn polylines_beside_the_curves_of_a_drawing_are_written_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = arc_in(folder.path(), "dxf");
    let exported = disk::read_file(&path).expect("the file");
    assert_eq!(exported.references.len(), 2);
    let mut window = moved(&path, false);
    save(&mut window);
    click(&mut window, "Save");
    let saved = disk::read_file(&path).expect("the file");
    assert_eq!((saved.curves.len(), saved.references.len()), (1, 2));
}

#[test]
fn a_file_that_has_changed_is_not_overwritten_unasked() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = arc_in(folder.path(), "step");
    let mut window = moved(&path, false);
    fs::write(&path, "of another program").expect("the file");
    save(&mut window);
    click(&mut window, "Save");
    window.get_by_label("The file has changed on disk");
    assert_eq!(
        fs::read_to_string(&path).expect("the file"),
        "of another program"
    );
    assert!(!is_saved(&window));
    click(&mut window, "Overwrite");
    assert!(disk::read_file(&path).is_ok() && is_saved(&window));
}

#[test]
fn a_copy_leaves_the_edited_file_the_documents_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = arc_in(folder.path(), "step");
    let before = fs::read(&path).expect("the file");
    let mut window = moved(&path, true);
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    let copy = folder.path().join("copy.batten");
    answer(&mut window, &copy);
    assert!(copy.is_file() && is_modified(&window) && !is_saved(&window));
    assert_eq!(fs::read(&path).expect("the file"), before);
    save(&mut window);
    assert!(!is_modified(&window) && is_saved(&window));
    assert_ne!(fs::read(&path).expect("the file"), before);
}
