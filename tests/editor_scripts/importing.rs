//! Files of other programs: what is asked, what comes in, what is told.

use std::path::PathBuf;

use batten::document::{Document, Edit, Reference};
use batten::editor::{Command, Editor, FileAnswer};
use batten::geometry::expressions::LengthUnit;
use batten::geometry::references::{ReferenceCurve, ReferenceForm};
use batten::io::exchange::import::ImportChoice;
use batten::operations::Value;
use glam::DVec3;
use tempfile::TempDir;

use crate::drawings::{dxf, uneven_spline};
use crate::script::Script;

fn file(folder: &TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, text).expect("a file");
    path
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

/// The choices that are offered, changed.
fn choices(editor: &Editor, change: impl Fn(&mut ImportChoice)) -> Option<FileAnswer> {
    let question = editor.filing().import_question().expect("a question");
    let mut choices: Vec<ImportChoice> = question
        .files
        .iter()
        .map(|file| file.choice.clone())
        .collect();
    choices.iter_mut().for_each(change);
    Some(FileAnswer::Import(choices))
}

fn names(editor: &Editor) -> Vec<String> {
    editor.document().names().map(str::to_owned).collect()
}

const LINES: [(&str, [f64; 2]); 3] = [
    ("Deck", [120.0, 45.0]),
    ("Deck", [60.0, 20.0]),
    ("Keel", [10.0, 0.0]),
];

#[test]
fn a_file_without_a_unit_waits_for_what_is_taken() {
    let folder = folder();
    let path = file(&folder, "hull.dxf", &dxf(None, &LINES, 2));
    let mut editor = Editor::with_document(Document::default());
    editor.import(&[path]).expect("a question");
    assert!(editor.document().is_empty(), "nothing yet");
    let answer = choices(&editor, |choice| {
        choice.unit = Some(LengthUnit::Inch);
        choice.taken.retain(|key| key.layer[..] == ["Deck"]);
    });
    let note = editor.answer_files(answer).expect("what is chosen");
    assert!(editor.filing().import_question().is_none());
    assert_eq!(editor.document().unit(), Some(LengthUnit::Inch));
    assert_eq!(editor.document().references().count(), 2);
    let told: Vec<&str> = note.text.lines().collect();
    assert_eq!(told[0], "2 references added to the document");
    assert!(
        told[1].ends_with("hull.dxf: 1 item not chosen, left out"),
        "{told:?}"
    );
    assert!(
        told[2].contains("not understood: 2 HATCH, the first at line "),
        "{told:?}"
    );
    editor.execute(Command::Undo).expect("one step");
    assert!(editor.document().is_empty());
    assert_eq!(editor.document().unit(), None);
}

#[test]
fn a_circle_of_another_unit_has_the_radius_that_is_seen() {
    let folder = folder();
    let circle = "  0\nCIRCLE\n 10\n3\n 20\n0\n 40\n2\n";
    let text = dxf(Some(1), &[], 0).replace("ENTITIES\n", &format!("ENTITIES\n{circle}"));
    let path = file(&folder, "inch.dxf", &text);
    let mut editor = Editor::new();
    let unit = Some(LengthUnit::Millimetre);
    editor
        .apply("Unit", vec![Edit::SetUnit(unit)])
        .expect("a unit");
    editor.import(&[path]).expect("a circle");
    let (_, circle) = editor.document().references().last().expect("a circle");
    let ReferenceForm::Analytic(form) = circle.curve.form() else {
        panic!("no circle");
    };
    assert_eq!(form.values(), [50.8]);
    let placement = circle.curve.placement();
    let place = DVec3::new(3.0 * 25.4, 0.0, 0.0);
    assert_eq!((placement.scale(), placement.translation()), (1.0, place));
}

#[test]
fn a_view_of_references_alone_is_fitted_where_a_curve_was_before() {
    let folder = folder();
    let path = file(&folder, "small.dxf", &dxf(Some(4), &LINES[2..], 0));
    let mut script = Script::example("arc");
    script.command(Command::FitAll);
    script.editor.open(&[path]).expect("a line");
    script.command(Command::FitAll);
    script.scene();
    let viewport = script.editor.view().viewport();
    // The line is 10 mm long, and the canvas some hundred points.
    let length = 10.0 * viewport.scale;
    assert!(
        length > 0.5 * viewport.size.x,
        "{length} of {}",
        viewport.size
    );
}

#[test]
fn a_plain_file_comes_in_unasked_and_can_be_chosen_anew() {
    let folder = folder();
    let path = file(&folder, "plain.dxf", &dxf(Some(4), &LINES[..2], 0));
    let mut editor = Editor::new();
    let unit = Some(LengthUnit::Millimetre);
    editor
        .apply("Unit", vec![Edit::SetUnit(unit)])
        .expect("a unit");
    let note = editor.import(&[path]).expect("lines");
    assert!(note.offers_choice && note.offers_undo);
    let before = names(&editor);
    assert_eq!(before.len(), 3);
    // A look at the panel changes nothing.
    editor
        .answer_files(Some(FileAnswer::Anew))
        .expect("a question");
    editor.answer_files(None).expect("no answer");
    assert_eq!(names(&editor), before);
    editor
        .answer_files(Some(FileAnswer::Anew))
        .expect("a question");
    let answer = choices(&editor, |choice| choice.taken.clear());
    editor.answer_files(answer).expect("nothing");
    assert_eq!(
        editor.document().references().count(),
        0,
        "in place of the first"
    );
    assert_eq!(editor.document().curves().count(), 1);
}

#[test]
fn points_without_a_name_are_called_as_their_file() {
    let folder = folder();
    let table = "0 0\n1 0.5\n2 0\n";
    let mut editor = Editor::new();
    for name in ["scan 7.csv", "probe.csv"] {
        let path = file(&folder, name, table);
        editor.import(&[path]).expect("points");
    }
    let two = format!("{table}\n\n{table}");
    editor
        .import(&[file(&folder, "two.csv", &two)])
        .expect("points");
    let references = editor.document().references();
    let names: Vec<&str> = references.map(|(_, it)| it.name.as_str()).collect();
    assert_eq!(names, ["scan 7", "probe", "two 1", "two 2"]);
    // Names that are taken get a number that no other has.
    editor
        .import(&[file(&folder, "two.csv", &two)])
        .expect("points");
    let references = editor.document().references();
    let names: Vec<&str> = references.map(|(_, it)| it.name.as_str()).collect();
    assert_eq!(names[4..], ["two 3", "two 4"]);
}

#[test]
fn what_was_done_since_stays_when_files_are_chosen_anew() {
    let folder = folder();
    let path = file(&folder, "plain.dxf", &dxf(Some(4), &LINES[..2], 0));
    let mut editor = Editor::new();
    editor.open(std::slice::from_ref(&path)).expect("lines");
    assert_eq!(
        editor.document().len() + editor.document().references().count(),
        2,
        "the example gives way"
    );
    editor.execute(Command::Duplicate).expect("a copy");
    editor
        .answer_files(Some(FileAnswer::Anew))
        .expect("a question");
    let answer = choices(&editor, |_| {});
    editor.answer_files(answer).expect("lines");
    assert_eq!(editor.document().references().count(), 5, "added");
    // So is what is opened beside work of one's own.
    editor.open(&[path]).expect("lines");
    assert_eq!(editor.document().references().count(), 7);
}

#[test]
fn references_become_float_polygons_within_the_tolerance() {
    let folder = folder();
    let path = file(&folder, "spline.dxf", &uneven_spline());
    let mut editor = Editor::with_document(Document::default());
    editor.import(&[path]).expect("a spline");
    let reference = editor.document().references().next().expect("a reference");
    let reference = reference.1.curve.clone();
    editor
        .answer_files(Some(FileAnswer::Anew))
        .expect("a question");
    let answer = choices(&editor, |choice| {
        choice.to_float = true;
        choice.tolerance = Some(1e-3);
    });
    let note = editor.answer_files(answer).expect("a curve");
    let (_, curve) = editor.document().curves().next().expect("a curve");
    assert_eq!(editor.document().references().count(), 0);
    let vertices = curve.polygon.vertices().len();
    assert!(
        note.text.contains(&format!("{vertices} vertices, off by ")),
        "{}",
        note.text
    );
    for share in 0..=20 {
        use batten::geometry::Differentiable;
        let t = 5.0 * f64::from(share) / 20.0;
        let point = reference.derivatives(t, 0)[0];
        let off = curve.polygon.nearest(point).distance;
        assert!(off <= 1e-3, "{t}: {off}");
    }
}

#[test]
fn curves_in_the_place_of_several_references_are_not_compared() {
    let references = ["circle", "ellipse:a=2,b=1"].map(|form| {
        let curve = ReferenceCurve::from_text(form).expect("a reference");
        Reference::new(form, curve)
    });
    let document = Document::default().with_references(references);
    let mut script = Script {
        editor: Editor::with_document(document),
    };
    script.try_out("to-float").expect("a preview");
    script.set("references", Value::Choice(2)).expect("all");
    let made = script.made_curves();
    assert_eq!(made.len(), 2);
    for curve in made {
        script.editor.activate(curve);
        assert_eq!(script.editor.sight().compared(), None);
    }
}

#[test]
fn numbers_without_a_unit_keep_to_the_rule_for_units() {
    let folder = folder();
    let path = file(&folder, "hull.dxf", &dxf(None, &LINES[..1], 0));
    let mm = Document::default().with_unit(Some(LengthUnit::Millimetre));
    let mut editor = Editor::with_document(mm);
    editor.import(&[path]).expect("a question");
    let answer = choices(&editor, |choice| choice.unit = Some(LengthUnit::Inch));
    editor.answer_files(answer).expect("a line");
    let (_, line) = editor.document().references().next().expect("a line");
    let points = line.points().expect("points");
    assert!((points[1].x - 3048.0).abs() < 1e-9, "{}", points[1]);
    assert_eq!(editor.document().unit(), Some(LengthUnit::Millimetre));
}
