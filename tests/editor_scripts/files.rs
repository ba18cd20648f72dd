//! Opening and saving: what files say that is not known, names, and what messages tell.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use batten::document::{Curve, Document, Extras};
use batten::editor::{Command, Editor, FileAnswer, Note};
use batten::geometry::expressions::LengthUnit;
use batten::geometry::{FloatPolygon, PolygonKind};
use batten::io::{ColumnChoice, disk};
use glam::DVec2;
use tempfile::TempDir;

use super::script::Script;
use super::window::exporter;

const PROJECT: &str = r#"{"format": "batten", "version": 1, "made by": {"b": 1.50, "a": [2]}, "curves": [
  {"name": "arc", "degree": 2, "vertices": [[0, 0], [10, 20], [30, 0], [40, 5]], "weigths": [1, 2e0]}]}"#;

fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

fn write(folder: &TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, text).expect("the file");
    path
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).expect("the file")
}

fn opened(path: &Path) -> Script {
    let mut script = Script::example("arc");
    script.editor.open(&[path.to_owned()]).expect("a project");
    script.check();
    script
}

fn is_kept(text: &str) -> bool {
    text.contains(r#""weigths": [1, 2e0]"#) && text.contains(r#""made by": {"b": 1.50, "a": [2]}"#)
}

#[test]
fn unknown_keys_are_told_when_a_project_is_opened() {
    let folder = folder();
    let path = write(&folder, "own.batten", PROJECT);
    let expected = format!(
        "1 curve read from {}\n\
         the project's key “made by” is not known and has no effect\n\
         curve 1 “arc”: the key “weigths” is not known and has no effect\n\
         Unknown keys are kept when you save.",
        path.display()
    );
    assert_eq!(opened(&path).message(), expected);
    let mut script = Script::example("arc");
    script
        .editor
        .open(std::slice::from_ref(&path))
        .expect("a project");
    assert_eq!(script.message(), expected, "from the command line too");
    script
        .editor
        .import(std::slice::from_ref(&path))
        .expect("a project");
    assert_eq!(
        script.message().lines().nth(2),
        Some(
            format!(
                "{}: curve 1 “arc”: the key “weigths” is not known and has no effect",
                path.display()
            )
            .as_str()
        )
    );
}

#[test]
fn unknown_keys_survive_edits_undo_and_saving() {
    let folder = folder();
    let path = write(&folder, "own.batten", PROJECT);
    let mut script = opened(&path);
    script.drag_vertex(1, DVec2::new(30.0, 10.0));
    script.operate("reverse", &[]).expect("the curve reversed");
    script
        .operate("reinterpret-degree", &[])
        .expect("a higher degree");
    script.editor.save(&path).expect("a file");
    assert!(is_kept(&text(&path)), "{}", text(&path));
    let edited = text(&path);
    for _ in 0..3 {
        script.command(Command::Undo);
    }
    script.editor.save(&path).expect("a file");
    assert!(is_kept(&text(&path)), "{}", text(&path));
    for _ in 0..3 {
        script.command(Command::Redo);
    }
    script.editor.save(&path).expect("a file");
    assert_eq!(text(&path), edited);
    script.editor.begin_empty();
    script.editor.save(&path).expect("a file");
    assert!(!text(&path).contains("made by"), "another document");
}

#[test]
fn a_reload_keeps_unknown_keys_that_another_program_changed() {
    let folder = folder();
    let path = write(&folder, "own.batten", PROJECT);
    let mut script = opened(&path);
    let changed = PROJECT.replace("\"a\": [2]", "\"a\": [3]");
    write(&folder, "own.batten", &changed);
    script.editor.reload().expect("a project");
    script.editor.save(&path).expect("a file");
    assert!(text(&path).contains(r#""a": [3]"#), "{}", text(&path));
    script.command(Command::Undo);
    script.editor.save(&path).expect("a file");
    assert!(is_kept(&text(&path)), "{}", text(&path));
}

#[test]
fn unknown_keys_do_not_go_with_copies() {
    let folder = folder();
    let mut script = opened(&write(&folder, "own.batten", PROJECT));
    let copied = script
        .editor
        .copy(batten::editor::CopyForm::Own)
        .expect("a text");
    assert!(!copied.contains("weigths"), "{copied}");
    script.editor.paste(&copied).expect("a curve");
    script.editor.paste(PROJECT).expect("a curve");
    assert_eq!(
        script.message(),
        "1 curve pasted\n\
         the project's key “made by” is not known and has no effect\n\
         curve 1 “arc”: the key “weigths” is not known and has no effect"
    );
    script.command(Command::Duplicate);
    let document = script.editor.document();
    let extras: Vec<bool> = document
        .curves()
        .map(|(_, curve)| curve.extras.is_empty())
        .collect();
    assert_eq!(extras, [false, true, true, true]);
    assert_eq!(document.extras().iter().count(), 1);
}

#[test]
fn a_pasted_table_tells_how_it_was_read() {
    let mut script = Script::example("arc");
    script
        .editor
        .paste("# degree=1\t\nx\ty\n0\t0,5\n1\t1,25\n")
        .expect("a curve");
    assert_eq!(
        script.message(),
        "1 curve pasted\nread with tabs between columns and decimal commas"
    );
}

#[test]
fn a_name_with_a_point_gets_its_extension() {
    let folder = folder();
    let mut script = Script::example("hull");
    for (name, written) in [
        ("hull v1.2", "hull v1.2.batten"),
        ("hull", "hull.batten"),
        ("hull.", "hull.batten"),
        ("lines.doc", "lines.doc.batten"),
        ("upper.BATTEN", "upper.BATTEN"),
    ] {
        let path = folder.path().join(name);
        let saved = script.editor.save(&path);
        let path = folder.path().join(written);
        let note = Note::told(format!("Saved to {}", path.display()));
        assert_eq!(saved, Ok(note), "{name}");
        assert_eq!(script.message(), format!("Saved to {}", path.display()));
        fs::remove_file(&path).expect("what was saved");
    }
    let export = exporter("csv", PolygonKind::Float);
    let exported = script
        .editor
        .export(&folder.path().join("hull v1.2"), &export);
    assert!(exported.is_ok(), "{exported:?}");
    assert!(folder.path().join("hull v1.2.csv").is_file());
    let drawing = folder.path().join("hull.dxf");
    assert!(script.editor.save(&drawing).is_err(), "another format");
    assert!(!drawing.exists());
}

#[cfg(unix)]
#[test]
fn a_hard_link_that_saving_breaks_is_told() {
    let folder = folder();
    let path = write(&folder, "own.batten", PROJECT);
    fs::hard_link(&path, folder.path().join("other")).expect("a link");
    let mut script = opened(&path);
    script.editor.save(&path).expect("a file");
    let expected = format!(
        "Saved to {}\nthe file had another name (a hard link), which keeps the old content",
        path.display()
    );
    assert_eq!(script.message(), expected);
    assert_eq!(text(&folder.path().join("other")), PROJECT);
}

#[test]
fn several_projects_become_one_without_what_each_says_of_itself() {
    let folder = folder();
    let paths = ["a.batten", "b.batten"].map(|name| write(&folder, name, PROJECT));
    let mut script = Script::example("arc");
    script.editor.open(&paths).expect("two projects");
    assert_eq!(script.editor.document().extras(), &Extras::default());
    let path = folder.path().join("both.batten");
    script.editor.save(&path).expect("a file");
    let read = disk::read_file(&path).expect("what was saved");
    assert!(
        read.curves
            .iter()
            .all(|curve| curve.extras.iter().count() == 1)
    );
}

/// A document with a curve from x = 0 to x = 2.
fn in_unit(unit: Option<LengthUnit>) -> Document {
    let polygon = FloatPolygon::planar(2, &[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]);
    let curve = Curve::new("arc".to_owned(), polygon.expect("a polygon"));
    Document::from_curves([curve]).with_unit(unit)
}

/// Write such a document to a project.
fn project_in(folder: &TempDir, name: &str, unit: Option<LengthUnit>) -> PathBuf {
    let path = folder.path().join(name);
    disk::write_document(&path, &in_unit(unit), None).expect("a project");
    path
}

/// The widths of all curves, and the unit.
fn widths(editor: &Editor) -> (Vec<f64>, Option<LengthUnit>) {
    let curves = editor.document().curves();
    let width = |curve: &Curve| curve.polygon.vertex(2).x - curve.polygon.vertex(0).x;
    let widths = curves.map(|(_, curve)| width(curve)).collect();
    (widths, editor.document().unit())
}

const MM: Option<LengthUnit> = Some(LengthUnit::Millimetre);
const INCH: Option<LengthUnit> = Some(LengthUnit::Inch);

#[test]
fn files_in_several_units_are_imported_in_that_of_the_document() {
    let folder = folder();
    let [inch, mm, none] = [("inch", INCH), ("mm", MM), ("none", None)]
        .map(|(name, unit)| project_in(&folder, &format!("{name}.batten"), unit));
    let mut editor = Editor::with_document(in_unit(MM));
    let note = editor.import(&[inch.clone(), mm, none]).expect("curves");
    assert_eq!(widths(&editor), (vec![2.0, 50.8, 2.0, 2.0], MM));
    let [converted, counted] = [
        "inch.batten: converted from inches to millimetres",
        "none.batten: no unit given: the numbers count in millimetres",
    ];
    assert!(
        note.text.contains(converted) && note.text.contains(counted),
        "{}",
        note.text
    );
    editor.execute(Command::Undo).expect("one step");
    assert_eq!(widths(&editor), (vec![2.0], MM));
    // Several are added, even when they are opened; in an empty document the first one states the unit.
    let mut editor = Editor::default();
    editor
        .open(&[inch.clone(), project_in(&folder, "b.batten", MM)])
        .expect("curves");
    let (opened, unit) = widths(&editor);
    assert!(
        unit == INCH && (opened[1] - 2.0 / 25.4).abs() < 1e-15,
        "{opened:?}"
    );
}

#[test]
fn a_document_without_a_unit_is_asked_for_it() {
    let folder = folder();
    let inch = project_in(&folder, "inch.batten", INCH);
    for (answer, expected) in [
        (None, (vec![2.0], None)),
        (MM, (vec![2.0, 50.8], MM)),
        (INCH, (vec![2.0, 2.0], INCH)),
    ] {
        let mut editor = Editor::with_document(in_unit(None));
        editor
            .import(std::slice::from_ref(&inch))
            .expect("a question");
        assert_eq!(editor.filing().unit_question(), Some(LengthUnit::Inch));
        assert_eq!(widths(&editor), (vec![2.0], None));
        editor
            .answer_files(answer.map(FileAnswer::Unit))
            .expect("an answer");
        assert_eq!(editor.filing().unit_question(), None);
        assert_eq!(widths(&editor), expected);
    }
}

#[test]
fn files_wait_for_the_columns_of_their_tables() {
    let folder = folder();
    let [inch, first, second, other] =
        ["inch.batten", "1.dat", "2.dat", "3.dat"].map(|name| folder.path().join(name));
    fs::copy(project_in(&folder, "a.batten", INCH), inch.clone()).expect("a copy");
    for path in [&first, &second] {
        fs::write(path, "0 1 2 3\n4 5 6 7\n8 9 10 11\n").expect("a table");
    }
    fs::write(&other, "a;b;c\n1;2;3\n4;5;6\n").expect("a table");
    let paths = [inch, first.clone(), second, other.clone()];
    let mut editor = Editor::with_document(in_unit(INCH));
    let choice = |numbers: &[usize]| ColumnChoice::of_numbers(numbers).map(FileAnswer::Columns);
    let asked = |editor: &Editor| editor.filing().column_question().map(|it| it.path.clone());
    editor.import(&paths).expect("a question");
    assert_eq!(asked(&editor), Some(first));
    assert_eq!(editor.document().references().count(), 0);
    // One answer serves all tables with these columns.
    editor.answer_files(choice(&[3, 4])).expect("a question");
    assert_eq!(asked(&editor), Some(other));
    editor
        .answer_files(choice(&[2, 1]))
        .expect("curves and points");
    assert_eq!(asked(&editor), None);
    let document = editor.document();
    assert_eq!(
        (document.curves().count(), document.references().count()),
        (2, 3)
    );
    let lists = document
        .references()
        .map(|(_, it)| it.points().expect("points")[0].truncate());
    let lists: Vec<[f64; 2]> = lists.map(|it| it.to_array()).collect();
    assert_eq!(lists, [[2.0, 3.0], [2.0, 3.0], [2.0, 1.0]]);
    editor.execute(Command::Undo).expect("one step");
    assert_eq!(editor.document().len(), 1);
    // A refusal asks nothing, and nothing is read without an answer.
    editor.import(&paths[1..2]).expect("a question");
    editor
        .answer_files(choice(&[1, 9]))
        .expect_err("no such column");
    assert_eq!(asked(&editor), None);
    editor.import(&paths[1..2]).expect("a question");
    editor.answer_files(None).expect("nothing");
    assert_eq!((asked(&editor), editor.document().len()), (None, 1));
}

#[test]
fn the_clipboard_keeps_the_size_of_curves() {
    let mut copied = Editor::with_document(in_unit(INCH));
    let curve = copied.document().ids().next().expect("a curve");
    copied.activate(curve);
    let text = copied.copy(batten::editor::CopyForm::Own).expect("a text");
    let mut editor = Editor::with_document(in_unit(MM));
    editor.paste(&text).expect("a curve");
    let (pasted, unit) = widths(&editor);
    assert!(unit == MM && (pasted[1] - 50.8).abs() < 1e-12, "{pasted:?}");
}

#[test]
fn a_question_about_a_file_opened_at_the_start_outlasts_the_change_to_threads() {
    let folder = folder();
    let path = folder.path().join("scan.dat");
    fs::write(&path, "0 1 2 3\n4 5 6 7\n8 9 10 11\n").expect("a table");
    let mut editor = Editor::new();
    editor
        .open(std::slice::from_ref(&path))
        .expect("a question");
    editor.run_in_background(Duration::from_secs(10), || ());
    let asked = editor.filing().column_question().map(|it| it.path.clone());
    assert_eq!(asked, Some(path));
    let choice = ColumnChoice::of_numbers(&[2, 3]).map(FileAnswer::Columns);
    editor.answer_files(choice).expect("a request");
    let end = Instant::now() + Duration::from_secs(60);
    while editor.document().references().next().is_none() && Instant::now() < end {
        std::thread::sleep(Duration::from_millis(5));
        editor.begin_frame();
    }
    assert_eq!(editor.document().references().count(), 1);
}
