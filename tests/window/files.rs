//! Files: saving, opening, replacing, dropping.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use batten::document::{Curve, Document};
use batten::editor::{Editor, ToolKind};
use batten::geometry::FloatPolygon;
use batten::geometry::expressions::LengthUnit;
use batten::io::{PROJECT, disk};
use eframe::egui::{DroppedFile, Event, Key, Modifiers, Pos2, Vec2};
use egui_kittest::kittest::Queryable;

use super::hand::*;

#[test]
fn unsaved_changes_are_asked_about() {
    let mut window = open_window();
    let from = vertex(&window, 4);
    drag(&mut window, from, from + BY);
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

/// Whether the question about unsaved changes is shown.
fn is_asked(window: &Window) -> bool {
    window.query_by_label("Save changes?").is_some()
}

/// How far the drags go.
const BY: Vec2 = Vec2::splat(30.0);

/// Begin a drag here and do not end it.
fn begin_drag(window: &mut Window, from: Pos2) {
    window.hover_at(from);
    window.run();
    window.drag_at(from);
    window.step();
    window.hover_at(from + BY);
    window.step();
}

/// The arc in the middle of a drag of vertex 4.
fn in_mid_drag() -> Window {
    let mut window = open_window();
    let from = vertex(&window, 4);
    begin_drag(&mut window, from);
    assert!(window.state().editor().hand().is_dragging());
    window
}

#[test]
fn keys_that_open_dialogs_take_a_drag_back() {
    for (modifiers, key) in [
        (Modifiers::NONE, Key::F1),
        (Modifiers::COMMAND, Key::P),
        (Modifiers::COMMAND, Key::I),
        (Modifiers::COMMAND, Key::E),
    ] {
        let mut window = in_mid_drag();
        window.key_press_modifiers(modifiers, key);
        window.step();
        window.step();
        let editor = window.state().editor();
        assert!(!editor.hand().is_dragging(), "{key:?}");
        assert!(!editor.workspace().is_modified(), "{key:?}");
    }
}

#[test]
fn typing_replaces_the_name_that_is_proposed_for_a_file() {
    let mut window = open_window();
    choose(&mut window, &["File", "Export as", "Export DXF…"]);
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.event(Event::Text("hull".to_owned()));
    window.run();
    let field = window.get_by_label("Path");
    let path = field.value().unwrap_or_default();
    assert!(path.ends_with("/hull.dxf"), "{path}");
}

/// What would lose unsaved changes, in the menus.
const LOSING: [&[&str]; 3] = [
    &["File", "New"],
    &["File", "Examples", "Waterline"],
    &["File", "Quit"],
];

#[test]
fn everything_that_would_lose_changes_asks_and_cancel_keeps_them() {
    let mut window = open_window();
    let from = vertex(&window, 4);
    drag(&mut window, from, from + BY);
    let changed = curve(&window);
    for path in LOSING {
        choose(&mut window, path);
        assert!(is_asked(&window), "{path:?}");
        click(&mut window, "Cancel");
        assert!(!is_asked(&window), "{path:?}");
        assert_eq!(curve(&window), changed, "{path:?}");
        assert!(window.state().editor().workspace().is_modified());
    }
}

#[test]
fn nothing_is_asked_about_when_nothing_is_unsaved() {
    for path in LOSING {
        let mut window = open_window();
        let from = vertex(&window, 4);
        drag(&mut window, from, from + BY);
        press(&mut window, Modifiers::COMMAND, Key::Z);
        choose(&mut window, path);
        assert!(!is_asked(&window), "{path:?}");
    }
}

#[test]
fn opening_asks_about_changes_once_a_project_is_chosen() {
    let mut window = open_window();
    let from = vertex(&window, 4);
    drag(&mut window, from, from + BY);
    let changed = curve(&window);
    let folder = tempfile::tempdir().expect("a folder");
    let project = folder.path().join("line.batten");
    let document = Document::from_curves([curve(&open_window())]);
    disk::write_document(&project, &document, None).expect("the file");
    press(&mut window, Modifiers::COMMAND, Key::O);
    assert!(!is_asked(&window), "nothing is chosen yet");
    answer(&mut window, &project);
    assert!(is_asked(&window));
    click(&mut window, "Cancel");
    assert_eq!(curve(&window), changed);
    // What is no project is added: nothing is lost.
    let table = folder.path().join("line.csv");
    std::fs::write(&table, "# degree=1\nx,y\n0,0\n1,2\n").expect("the file");
    press(&mut window, Modifiers::COMMAND, Key::O);
    answer(&mut window, &table);
    assert!(!is_asked(&window));
    assert_eq!(window.state().editor().document().len(), 2);
}

#[test]
fn a_drag_is_taken_back_before_changes_are_asked_about() {
    let original = curve(&open_window());
    let mut window = in_mid_drag();
    assert_ne!(curve(&window), original);
    press(&mut window, Modifiers::COMMAND, Key::O);
    assert!(!is_asked(&window), "only the drag was unsaved");
    assert_eq!(curve(&window), original);
    let mut window = in_mid_drag();
    press(&mut window, Modifiers::COMMAND, Key::N);
    assert!(window.state().editor().document().is_empty());
}

#[test]
fn a_fields_value_counts_before_changes_are_asked_about() {
    let mut window = open_window();
    show_vertices(&mut window);
    let original = curve(&window);
    let field = window.get_by_label("vertex 3 y").rect().center();
    begin_drag(&mut window, field);
    let shown = curve(&window);
    assert_ne!(shown, original);
    press(&mut window, Modifiers::COMMAND, Key::N);
    assert!(is_asked(&window));
    window.drop_at(field + BY);
    window.run();
    click(&mut window, "Cancel");
    assert_eq!(curve(&window), shown);
    let history = window.state().editor().workspace().history();
    assert_eq!(history.undo_steps(), 1);
}

#[test]
fn saving_in_the_middle_of_a_drag_lets_it_go_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("curve.batten");
    let mut editor = Editor::new();
    editor.save(&path).expect("a file");
    let mut window = open_window_with(editor, 1480.0, 920.0);
    let original = curve(&window);
    let from = vertex(&window, 4);
    begin_drag(&mut window, from);
    press(&mut window, Modifiers::COMMAND, Key::S);
    assert!(window.state().editor().hand().is_dragging());
    let read = disk::read_file(&path).expect("the file").curves;
    assert_eq!(read[0].polygon, original.polygon, "without the drag");
    window.drop_at(from + BY);
    window.run();
    assert_ne!(curve(&window), original);
    assert!(window.state().editor().workspace().is_modified());
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
    let document = Document::from_curves([curve(&window)]);
    disk::write_document(&project, &document, None).expect("the file");
    drop_file(&mut window, &project);
    click(&mut window, "Cancel");
    assert_eq!(window.state().editor().document().len(), 2);
    drop_file(&mut window, &project);
    click(&mut window, "Discard");
    assert_eq!(window.state().editor().document().len(), 1);
    assert_eq!(curve(&window).polygon.degree(), 1);
}

#[test]
fn curves_in_another_unit_wait_for_the_unit_of_the_document() {
    let mut window = open_window();
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("line.csv");
    std::fs::write(&table, "# unit=in\n# degree=1 name=line\nx,y\n0,0\n1,2\n").expect("the file");
    let question = "Choose the document's unit";
    for answer in ["Cancel", "millimetres"] {
        drop_file(&mut window, &table);
        window.get_by_label(question);
        assert_eq!(window.state().editor().document().len(), 1, "nothing yet");
        click(&mut window, answer);
        assert!(window.query_by_label(question).is_none(), "{answer}");
    }
    let document = window.state().editor().document();
    assert_eq!(document.unit(), Some(LengthUnit::Millimetre));
    let (_, line) = document.curves().last().expect("the line");
    let height = line.polygon.vertex(1).y;
    assert!((height - 50.8).abs() < 1e-12, "{height}");
    // One step takes the curve and the unit back.
    choose(&mut window, &["Edit", "Undo import curves"]);
    let document = window.state().editor().document();
    assert_eq!((document.len(), document.unit()), (1, None));
}

#[test]
fn columns_that_a_table_does_not_tell_are_chosen() {
    let mut window = open_window();
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("hull.csv");
    std::fs::write(&table, "station;half breadth;height\n1;0;2\n2;1;4\n3;5;5\n").expect("the file");
    let question = "Choose the columns";
    drop_file(&mut window, &table);
    window.get_by_label(question);
    click(&mut window, "Cancel");
    assert!(window.query_by_label(question).is_none());
    let points = |window: &Window| {
        let document = window.state().editor().document();
        let mut lists = document
            .references()
            .map(|(_, it)| it.points().expect("points"));
        lists.next().map(|list| (list, lists.count()))
    };
    assert_eq!(points(&window), None);
    drop_file(&mut window, &table);
    for (axis, column) in [("x", "2 “half breadth”"), ("y", "3 “height”")] {
        click(&mut window, axis);
        click(&mut window, column);
    }
    click(&mut window, "Read");
    assert!(window.query_by_label(question).is_none());
    let expected = [[0.0, 2.0], [1.0, 4.0], [5.0, 5.0]];
    let expected = expected.map(|[x, y]| glam::DVec3::new(x, y, 0.0));
    assert_eq!(points(&window), Some((expected.to_vec(), 0)));
}

#[test]
fn a_column_of_weights_can_be_chosen() {
    let mut window = open_window();
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("scan.csv");
    std::fs::write(&table, "east;north;up;trust\n1;0;2;0.5\n2;1;4;1\n3;5;5;2\n").expect("the file");
    drop_file(&mut window, &table);
    let weigh = |window: &mut Window, column: &str| {
        click(window, "weights");
        click(window, column);
        click(window, "Read");
    };
    // A coordinate is no weight: the question stays.
    weigh(&mut window, "2 “north”");
    window.get_by_label("Choose the columns");
    weigh(&mut window, "4 “trust”");
    let document = window.state().editor().document();
    let (_, list) = document.references().next().expect("the points");
    assert_eq!(list.weights(), Some(&[0.5, 1.0, 2.0][..]));
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

pub fn drop_file(window: &mut Window, path: &Path) {
    let file = Arc::new(Dropped(path.to_owned()));
    window.input_mut().dropped_files.push(file);
    window.run();
}

#[test]
fn keys_of_commands_do_nothing_in_a_drag() {
    let mut window = in_mid_drag();
    let before = curve(&window);
    for key in [Key::Delete, Key::O, Key::D, Key::P] {
        press(&mut window, Modifiers::NONE, key);
        assert!(window.state().editor().hand().is_dragging(), "{key:?}");
    }
    press(&mut window, Modifiers::CTRL, Key::D);
    let editor = window.state().editor();
    assert_eq!(editor.document().curves().count(), 1);
    assert_eq!(editor.hand().tool(), ToolKind::Select);
    assert_eq!(curve(&window).polygon, before.polygon);
}

#[test]
fn a_document_that_is_opened_again_is_judged_as_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let curve = |name: &str, height: f64| {
        let points = [(0.0, 0.0), (10.0, height), (20.0, height), (30.0, 0.0)];
        Curve::new(name, FloatPolygon::planar(3, &points).expect("a polygon"))
    };
    for name in ["one.batten", "other.batten"] {
        let document = Document::from_curves([curve("a", 5.0), curve("b", 6.0)]);
        let written = PROJECT.write(&document, None).expect("a project");
        std::fs::write(path(name), written.bytes).expect("the file");
    }
    let mut window = open_window();
    drop_file(&mut window, &path("one.batten"));
    let compared = |window: &Window| window.state().editor().sight().compared();
    click(&mut window, "Plot menu");
    pick(&mut window, "Compare with");
    pick(&mut window, "b");
    let other = compared(&window).expect("a curve to compare with");
    drop_file(&mut window, &path("other.batten"));
    assert_eq!(compared(&window), None);
    drop_file(&mut window, &path("one.batten"));
    assert_eq!(compared(&window), Some(other));
}
