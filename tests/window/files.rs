//! Files: saving, opening, replacing, dropping.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use batten::document::Extras;
use batten::io::disk;
use eframe::egui::{DroppedFile, Key, Modifiers, Vec2};
use egui_kittest::kittest::Queryable;

use super::hand::*;

#[test]
fn unsaved_changes_are_asked_about() {
    let mut window = open_window();
    let from = vertex(&window, 4);
    drag(&mut window, from, from + Vec2::splat(30.0));
    let changed = curve(&window);
    choose(&mut window, &["File", "New"]);
    click(&mut window, "Cancel");
    assert_eq!(curve(&window), changed);
    choose(&mut window, &["File", "New"]);
    click(&mut window, "Save");
    let folder = tempfile::tempdir().expect("a folder");
    answer(
        &mut window,
        &folder.path().join("no such folder").join("curve.batten"),
    );
    assert_eq!(curve(&window), changed, "nothing is lost by a bad path");
    window.get_by_label_contains("There is no folder");
    let path = folder.path().join("curve.batten");
    answer(&mut window, &path);
    assert!(
        window.state().editor().document().is_empty(),
        "saved, then gone on"
    );
    assert_eq!(
        disk::read_file(&path).expect("the file").curves[0].polygon,
        changed.polygon
    );
}

#[test]
fn a_file_that_cannot_be_read_is_told_where_it_was_asked_for() {
    let mut window = open_window();
    let original = curve(&window);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("broken.batten");
    std::fs::write(&path, "{ this is no project").expect("the file");
    press(&mut window, Modifiers::COMMAND, Key::O);
    answer(&mut window, &path);
    window.get_by_label_contains("broken.batten");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(curve(&window), original);
}

#[test]
fn a_file_is_replaced_only_on_a_second_question() {
    let mut window = open_window();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("curve.batten");
    std::fs::write(&path, "precious").expect("the file");
    press(&mut window, Modifiers::COMMAND, Key::S);
    // The extension is added before the question is asked.
    answer(&mut window, &folder.path().join("curve"));
    window.get_by_label_contains("“curve.batten” exists");
    let kept = std::fs::read_to_string(&path).expect("the file");
    assert_eq!(kept, "precious");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(disk::read_file(&path).is_ok(), "it is a project now");
}

#[test]
fn a_dropped_table_is_added_and_a_dropped_project_asks_about_changes() {
    let mut window = open_window();
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("line.csv");
    std::fs::write(&table, "# degree=1\nx,y\n0,0\n1,2\n").expect("the file");
    drop_file(&mut window, &table);
    assert_eq!(window.state().editor().document().len(), 2);
    let project = folder.path().join("line.batten");
    disk::write_file(&project, &[curve(&window)], &Extras::default(), None).expect("the file");
    drop_file(&mut window, &project);
    click(&mut window, "Cancel");
    assert_eq!(window.state().editor().document().len(), 2);
    drop_file(&mut window, &project);
    click(&mut window, "Discard");
    assert_eq!(window.state().editor().document().len(), 1);
    assert_eq!(curve(&window).polygon.degree(), 1);
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

fn drop_file(window: &mut Window, path: &Path) {
    let file = Arc::new(Dropped(path.to_owned()));
    window.input_mut().dropped_files.push(file);
    window.run();
}
