//! What a window asks of the editor besides inputs and commands, in one place: where methods of the
//! editor move, this file follows and the matrix and the model stay as they are.

use std::path::{Path, PathBuf};

use batten::analysis::LevelPlot;
use batten::document::{Colour, Curve, CurveId, Document, Edit, History};
use batten::editor::{
    CombSettings, Command, Editor, EndFitAction, EndFitMarks, FileAnswer, Input, Layer, Look,
    OperationInProgress, PlotKind, Reply, Selection, Shortcut, Transformation, Viewport, told,
};
use batten::geometry::expressions::LengthUnit;
use batten::geometry::{FloatPolygon, PolygonKind};
use batten::io::{ExportChoice, PROJECT, formats};
use batten::operations::{Kind, Operation, Parameter, Value, Values, find};
use glam::{DVec2, DVec3};
use tempfile::TempDir;

use super::documents::Foreign;

/// The canvas's width and height in screen points.
pub const CANVAS: DVec2 = DVec2::new(1000.0, 700.0);

/// A text that the clipboard may hold, good or bad.
const TEXTS: [&str; 10] = [
    "",
    "no curve at all",
    "x,y\n0,0\n1,2\n3,3\n5,1\n",
    "0 0\n1 2\n3 3",
    "x,y,z\n0,0,0\n1,2,1\n3,3,NaN\n",
    "{\"format\": \"batten\", \"version\": 1, \"curves\": []}",
    "{\"format\": \"batten\", \"version\": 1, \"curves\": [{\"name\": \"pasted\", \"degree\": 2, \
     \"vertices\": [[0, 0], [1, 2.5], [3, 1]], \"weights\": [1, 2, 1]}]}",
    "{\"format\": \"batten\", \"version\": 1, \"curves\": [{\"name\": \"short\", \"degree\": 5, \
     \"vertices\": [[0, 0], [1, 2]]}]}",
    "{\"format\": \"batten\", \"version\": 99, \"curves\": []}",
    "# degree=1 polygon=float\nx,y\n-1e100,0\n1e100,1e-300\n",
];

/// The number of a text that holds a curve.
const GOOD_TEXT: usize = 6;

/// Something that a panel, a dialog or the window asks for. Curves and vertices are counted from 0
/// and round again, so that any number is one of those that are there.
#[derive(Clone, Debug)]
pub enum Panel {
    /// A coordinate's field is dragged in the vertex table.
    PreviewVertex(usize, usize, DVec3),
    /// A weight's field is dragged in the vertex table.
    PreviewWeight(usize, usize, f64),
    /// The field is released.
    CommitField,
    /// The field is called off.
    AbortField,
    /// A coordinate is typed.
    TypeVertex(usize, usize, DVec3),
    /// A weight is typed.
    TypeWeight(usize, usize, f64),
    /// The list of curves or the inspector asks for something of a curve.
    OfCurve(usize, OfCurve),
    /// All curves and references are selected in the list.
    SelectItems,
    /// The end-fit panel asks for something.
    EndFit(EndFitAction),
    /// An angle or a factor is typed.
    Transform(Transformation),
    /// The pivot is typed, or centred.
    SetPivot(Option<DVec2>),
    /// The clipboard's text comes, by its number.
    Paste(usize),
    /// What is selected is copied and removed.
    Cut,
    /// What is selected is copied.
    Copy,
    /// What is copied comes back at once.
    CopyAndPaste,
    /// The operation's parameter with this number gets a value that is read from another.
    SetValue(usize, f64),
    /// The operation's parameter with this number gets a value of any kind.
    SetAnyValue(usize, Value),
    /// The operation that is tried out is applied.
    Apply,
    /// The operation that is tried out is cancelled, or the panel of the last one closed.
    Leave,
    /// An operation is applied at once, its parameters read from numbers.
    Operate(&'static Operation, [f64; 3]),
    /// A row of the vertex table is clicked, or clicked with Shift.
    SelectVertex(usize, usize, bool),
    /// Plots and rows are hovered, or nothing is.
    Hover(Option<f64>, Option<usize>),
    /// The window is resized.
    SetCanvasSize(DVec2),
    /// The view is turned by a drag of the compass.
    Orbit(DVec2),
    /// The comb's fields are dragged.
    SetComb(f64, usize),
    /// A feature is clicked in the list.
    GoTo(f64),
    /// The message is closed.
    DismissMessage,
    /// Another document is opened, whether or not there are unsaved changes.
    Replace(Replacement),
    /// A dialog asks for files, or another program changes one.
    File(OfFile),
}

/// Something that happens to files.
#[derive(Clone, Debug)]
pub enum OfFile {
    /// The document is saved to its file; it gets one if it has none.
    Save,
    /// Another program writes another document to that file.
    Change(Foreign),
    /// The document's file is read again.
    Reload,
    /// A file with another document is imported.
    Import(Foreign),
    /// Files with other documents are opened as one.
    Open(Vec<Foreign>),
    /// The question for the document's unit is answered, or called off.
    AnswerUnit(Option<LengthUnit>),
}

/// What is opened in place of the document.
#[derive(Clone, Copy, Debug)]
pub enum Replacement {
    /// An empty document.
    Empty,
    /// A built-in example, by its number.
    Example(usize),
    /// A file that is not there.
    MissingFile,
}

impl Panel {
    /// What a window asks for itself when a key is pressed.
    pub fn of_key(shortcut: Shortcut) -> Option<Self> {
        let keys = [
            ('x', Self::Cut),
            ('c', Self::Copy),
            ('v', Self::Paste(GOOD_TEXT)),
        ];
        let found = keys
            .into_iter()
            .find(|(letter, _)| Shortcut::ctrl(*letter) == shortcut);
        found.map(|(_, panel)| panel)
    }
}

/// Something that the list of curves or the inspector asks for of a curve.
#[derive(Clone, Copy, Debug)]
pub enum OfCurve {
    /// It is clicked.
    Activate,
    /// It is clicked with Ctrl.
    Toggle,
    /// Its name is typed.
    Rename(&'static str),
    /// Its colour is chosen.
    Recolour(Option<[u8; 3]>),
    /// It is dragged to another place of the list.
    Reorder(usize),
    /// Its degree is typed.
    SetDegree(usize),
    /// Its end is joined to its start, or not.
    SetPeriodic(bool),
    /// It is shown or hidden.
    SetVisible(bool),
    /// It is locked or unlocked.
    SetLocked(bool),
}

/// Stand in for the window: hold an editor and tell it what a window would.
pub struct Window {
    editor: Editor,
    /// The folder of its files, once there is one.
    folder: Option<TempDir>,
}

impl Window {
    /// Open a document that counts as saved.
    pub fn open(document: Document) -> Self {
        let mut editor = Editor::with_document(document);
        editor.look(Look::Canvas(CANVAS));
        editor.refresh();
        let folder = None;
        Self { editor, folder }
    }

    /// Send one input, and draw the frame that follows.
    pub fn input(&mut self, input: Input) {
        self.editor.input(input);
        self.editor.refresh();
    }

    /// Give a command, and draw the frame that follows.
    pub fn execute(&mut self, command: Command) -> Reply {
        let reply = self.editor.execute(command);
        self.editor.refresh();
        reply
    }

    /// Do what a panel asks for, and draw the frame that follows.
    pub fn panel(&mut self, panel: &Panel) {
        self.tell(panel);
        self.editor.refresh();
    }

    /// The document, previews included.
    pub fn document(&self) -> &Document {
        self.editor.document()
    }

    /// The document without the preview of a gesture.
    pub fn settled(&self) -> &Document {
        self.editor.workspace().settled()
    }

    /// A number that changes when another document is opened.
    pub fn opening(&self) -> u64 {
        self.editor.workspace().opening()
    }

    /// Whether a gesture shows a preview or may show one.
    pub fn is_in_gesture(&self) -> bool {
        self.editor.workspace().preview().is_some()
    }

    /// The operation that is tried out or was applied last.
    pub fn trial(&self) -> Option<&OperationInProgress> {
        self.editor.operation()
    }

    /// Whether an operation is tried out.
    pub fn is_trying(&self) -> bool {
        self.editor.previewed_operation().is_some()
    }

    /// The values of the operation that is tried out or was applied last.
    pub fn values(&self) -> Option<Values> {
        Some(self.editor.operation()?.values().clone())
    }

    /// Whether the pointer drags.
    pub fn is_dragging(&self) -> bool {
        self.editor.hand().is_dragging()
    }

    /// Whether the primary button is held on the canvas.
    pub fn is_holding(&self) -> bool {
        self.editor.hand().is_holding()
    }

    /// The number of steps that can be taken back.
    pub fn undo_steps(&self) -> usize {
        self.history().undo_steps()
    }

    /// The steps and what they lead to.
    pub fn history(&self) -> &History {
        self.editor.workspace().history()
    }

    /// Whether a step can be made again.
    pub fn can_redo(&self) -> bool {
        self.history().redo_label().is_some()
    }

    /// Whether a command is offered now.
    pub fn is_enabled(&self, command: Command) -> bool {
        command.is_enabled(&self.editor)
    }

    /// Whether there is something to save.
    pub fn is_modified(&self) -> bool {
        self.editor.workspace().is_modified()
    }

    /// What is selected.
    pub fn selection(&self) -> &Selection {
        self.editor.hand().selection()
    }

    /// The active curve, if there is one.
    pub fn active(&self) -> Option<CurveId> {
        self.editor.active()
    }

    /// The active curve's polygon.
    pub fn active_polygon(&self) -> Option<FloatPolygon> {
        let curve = self.document().curve(self.active()?)?;
        Some(curve.polygon.clone())
    }

    /// Whether undo takes back a point of what is not finished, instead of a step.
    pub fn undoes_points(&self) -> bool {
        let label = Command::Undo.label_now(&self.editor);
        ["Undo first point", "Undo last point"].contains(&label.as_str())
    }

    /// How the model is mapped to the canvas.
    pub fn viewport(&self) -> &Viewport {
        self.editor.view().viewport()
    }

    /// How the comb is drawn.
    pub fn comb(&self) -> CombSettings {
        self.editor.view().comb()
    }

    /// The pivot of the tool that has one.
    pub fn pivot(&self) -> Option<DVec2> {
        self.editor.hand().pivot(&self.editor.context())
    }

    /// The message's text, if there is one.
    pub fn message(&self) -> Option<&str> {
        self.editor.message().map(|message| message.text.as_str())
    }

    /// Every command there is: see [`every_command`].
    pub fn commands(&self) -> Vec<Command> {
        every_command()
    }

    /// The teeth of the active curve's comb, as they are drawn.
    pub fn teeth(&mut self) -> Vec<[DVec2; 2]> {
        self.editor.refresh();
        let scene = self.editor.view().scene();
        let active = scene.curves.iter().find(|curve| curve.active);
        active.map_or(Vec::new(), |curve| curve.teeth.clone())
    }

    /// The marks of the end that the end-fit tool works on.
    pub fn end_marks(&mut self) -> Option<EndFitMarks> {
        self.editor.refresh();
        let ends = &self.editor.view().scene().ends;
        let chosen = ends.iter().find(|marks| marks.chosen);
        chosen.or(ends.first()).cloned()
    }

    /// Make all that panels, plots and the status bar read.
    pub fn read_panels(&mut self) {
        let level = |plot| PlotKind::Levels {
            plot,
            normalised: true,
        };
        for kind in [
            PlotKind::Harmony,
            level(LevelPlot::Curvature(2)),
            level(LevelPlot::Logarithmic),
            PlotKind::CURVATURE,
        ] {
            self.editor.view_mut().plot = Some(kind);
            self.editor.refresh();
        }
        self.editor.sight().features();
        self.editor.sight().report();
        self.editor
            .hand()
            .end_fit(self.editor.workspace(), self.editor.view());
        self.editor.sight().readout();
        self.editor.cursor();
        self.editor.sight().hovered_vertex();
        for command in self.commands() {
            command.is_checked(&self.editor);
            assert!(!command.label_now(&self.editor).is_empty(), "{command:?}");
        }
    }

    /// What the status bar says.
    pub fn hint(&self) -> String {
        self.editor.hint()
    }

    /// Save the document.
    pub fn save(&mut self, path: &Path) -> Reply {
        self.editor.save(path)
    }

    /// Export the document.
    pub fn export(&mut self, path: &Path, extension: &'static str, polygon: PolygonKind) {
        told(self.editor.export(path, &exporter(extension, polygon)));
    }

    /// Add the curves of a file.
    pub fn import(&mut self, path: &Path) {
        told(self.editor.import(&[path.to_owned()]));
        self.editor.refresh();
    }

    /// Whether the canvas shows ends as met or not met, in the order of curves and ends: of visible curves that
    /// follow others. `None` while the layer of targets is hidden.
    pub fn shown_matches(&self) -> Option<Vec<bool>> {
        let shows_targets = self.editor.sight().layers().shows(Layer::Targets);
        let ends = &self.editor.view().scene().ends;
        shows_targets.then(|| ends.iter().filter_map(|marks| marks.matched).collect())
    }

    fn file(&mut self, asked: &OfFile) {
        let own = self.path_of("own.batten");
        match asked {
            OfFile::Save => told(self.editor.save(&own)),
            OfFile::Change(foreign) => write(&own, *foreign),
            OfFile::Reload => told(self.editor.reload()),
            OfFile::Import(foreign) => {
                let path = self.path_of("imported.batten");
                write(&path, *foreign);
                told(self.editor.import(&[path]));
            }
            OfFile::Open(all) => {
                let names = (0..all.len()).map(|number| format!("opened {number}.batten"));
                let paths: Vec<PathBuf> = names.map(|name| self.path_of(&name)).collect();
                paths
                    .iter()
                    .zip(all)
                    .for_each(|(path, it)| write(path, *it));
                told(self.editor.open(&paths));
            }
            OfFile::AnswerUnit(unit) => told(self.editor.answer_files(unit.map(FileAnswer::Unit))),
        }
    }

    /// A path in the window's own folder.
    fn path_of(&mut self, name: &str) -> PathBuf {
        let new = || tempfile::tempdir().expect("a folder");
        self.folder.get_or_insert_with(new).path().join(name)
    }

    fn curve(&self, number: usize) -> Option<(CurveId, &Curve)> {
        let count = self.document().len();
        let mut curves = self.document().curves();
        let (id, curve) = curves.nth(number.checked_rem(count)?)?;
        Some((id, curve))
    }

    /// The curve with a number, and its vertex with another.
    pub fn vertex(&self, curve: usize, vertex: usize) -> Option<(CurveId, usize)> {
        let (id, curve) = self.curve(curve)?;
        Some((id, vertex % curve.polygon.vertices().len()))
    }

    fn tell(&mut self, panel: &Panel) {
        match panel {
            Panel::PreviewVertex(curve, vertex, to) => {
                let edits = self.moved(*curve, *vertex, *to);
                self.editor.preview("Set coordinate", edits);
            }
            Panel::PreviewWeight(curve, vertex, weight) => {
                let edits = self.weighted(*curve, *vertex, *weight);
                self.editor.preview("Set weight", edits);
            }
            Panel::CommitField => self.editor.commit_preview(),
            Panel::AbortField => self.editor.abort_preview(),
            Panel::TypeVertex(curve, vertex, to) => {
                let edits = self.moved(*curve, *vertex, *to);
                told(self.editor.apply("Set coordinate", edits));
            }
            Panel::TypeWeight(curve, vertex, weight) => {
                let edits = self.weighted(*curve, *vertex, *weight);
                told(self.editor.apply("Set weight", edits));
            }
            Panel::Paste(text) => told(self.editor.paste(TEXTS[text % TEXTS.len()])),
            Panel::Cut => told(self.editor.cut()),
            Panel::Copy => told(self.editor.copy(batten::editor::CopyForm::Own)),
            Panel::CopyAndPaste => {
                if let Ok(text) = self.editor.copy(batten::editor::CopyForm::Own) {
                    told(self.editor.paste(&text));
                }
            }
            Panel::SetValue(parameter, number) => {
                let value = self.parameter(*parameter).map(|found| read(found, *number));
                value
                    .iter()
                    .for_each(|value| self.set(*parameter, value.clone()));
            }
            Panel::SetAnyValue(parameter, value) => self.set(*parameter, value.clone()),
            Panel::Apply => told(self.editor.operating().apply()),
            Panel::Leave => self.editor.operating().leave(),
            Panel::Operate(operation, numbers) => {
                let given = operation.parameters.iter().zip(numbers);
                let given = given.map(|(found, number)| (found.name, read(found, *number)));
                let given: Vec<(&str, Value)> = given.collect();
                told(self.editor.apply_operation(operation, &given));
            }
            Panel::EndFit(action) => told(self.editor.end_fit_action(*action)),
            Panel::Transform(transformation) => told(self.editor.transform(*transformation)),
            Panel::SetPivot(pivot) => self.editor.hand_mut().set_pivot(*pivot),
            Panel::Hover(length, vertex) => {
                self.editor.view_mut().hover_nothing();
                length
                    .iter()
                    .for_each(|at| self.editor.view_mut().hover_length(*at));
                vertex
                    .iter()
                    .for_each(|at| self.editor.view_mut().hover_vertex(*at));
            }
            Panel::SetCanvasSize(size) => self.editor.look(Look::Canvas(*size)),
            Panel::Orbit(by) => self.editor.look(Look::Orbit(*by)),
            Panel::SetComb(scale, density) => {
                let (scale, density) = (*scale, *density);
                self.editor
                    .view_mut()
                    .set_comb(CombSettings { scale, density });
            }
            Panel::GoTo(u) => self.editor.look(Look::Around(*u)),
            Panel::DismissMessage => self.editor.dismiss_message(),
            Panel::Replace(replacement) => match *replacement {
                Replacement::Empty => self.editor.begin_empty(),
                Replacement::Example(index) => told(self.editor.open_example(index)),
                Replacement::MissingFile => {
                    told(self.editor.open(&["no such file.batten".into()]));
                }
            },
            Panel::File(asked) => self.file(asked),
            Panel::SelectVertex(curve, vertex, add) => {
                if let Some((curve, vertex)) = self.vertex(*curve, *vertex) {
                    self.editor.select_vertex(curve, vertex, *add);
                }
            }
            Panel::SelectItems => {
                let items: Vec<CurveId> = self.document().all_ids().collect();
                self.editor.hand_mut().select_items(items);
            }
            Panel::OfCurve(number, asked) => {
                if let Some((curve, _)) = self.curve(*number) {
                    self.tell_of(curve, *asked);
                }
            }
        }
    }

    fn tell_of(&mut self, curve: CurveId, asked: OfCurve) {
        let (label, edit) = match asked {
            OfCurve::Activate => return self.editor.activate(curve),
            OfCurve::Toggle => return self.editor.hand_mut().toggle_item(curve),
            OfCurve::SetDegree(degree) => {
                self.editor.activate(curve);
                let operation = find("reinterpret-degree").expect("an operation");
                let given = [("degree", Value::Whole(degree))];
                return told(self.editor.apply_operation(operation, &given));
            }
            OfCurve::SetPeriodic(is) => {
                self.editor.activate(curve);
                let toggle = Command::TogglePeriodic;
                if toggle.is_checked(&self.editor) == Some(!is) {
                    told(self.editor.execute(toggle));
                }
                return;
            }
            OfCurve::SetVisible(is) => {
                return told(self.editor.change(Edit::SetVisible { curve, visible: is }));
            }
            OfCurve::SetLocked(is) => {
                return told(self.editor.change(Edit::SetLocked { curve, locked: is }));
            }
            OfCurve::Rename(name) => {
                let name = name.to_owned();
                ("Rename", Edit::Rename { curve, name })
            }
            OfCurve::Recolour(colour) => {
                let colour = colour.map(Colour);
                ("Set colour", Edit::Recolour { curve, colour })
            }
            OfCurve::Reorder(place) => ("Reorder", Edit::Reorder { curve, place }),
        };
        told(self.editor.apply(label, vec![edit]));
    }

    fn moved(&self, curve: usize, vertex: usize, to: DVec3) -> Vec<Edit> {
        let found = self.vertex(curve, vertex).into_iter();
        let edit = |(curve, vertex)| Edit::MoveVertices {
            curve,
            moves: vec![(vertex, to)],
        };
        found.map(edit).collect()
    }

    fn weighted(&self, curve: usize, vertex: usize, weight: f64) -> Vec<Edit> {
        let found = self.vertex(curve, vertex).into_iter();
        let edit = |(curve, vertex)| Edit::SetWeight {
            curve,
            vertex,
            weight,
        };
        found.map(edit).collect()
    }

    /// A parameter of the operation, counted round.
    fn parameter(&self, number: usize) -> Option<&'static Parameter> {
        let parameters = self.trial()?.operation().parameters;
        parameters.get(number.checked_rem(parameters.len())?)
    }

    fn set(&mut self, parameter: usize, value: Value) {
        if let Some(parameter) = self.parameter(parameter) {
            // The panel shows why not; the player looks at what stays.
            let _ = self
                .editor
                .operating()
                .set_values(&[(parameter.name, value)]);
        }
    }
}

/// Write a file as another program does.
fn write(path: &Path, foreign: Foreign) {
    let written = PROJECT.write(&foreign.document(), None);
    std::fs::write(path, written.expect("a file").bytes).expect("it is written");
}

/// Read a value of a parameter's kind from any number: it may be out of range.
fn read(parameter: &Parameter, number: f64) -> Value {
    let whole = number as usize;
    match &parameter.kind {
        Kind::Whole { .. } => Value::Whole(whole),
        Kind::Real { .. } => Value::Real(number),
        Kind::Choice { .. } => Value::Choice(whole % 3),
        Kind::Reference { .. } => Value::Reference(None),
        Kind::Switch { .. } => Value::Switch(whole % 2 == 1),
        Kind::List { count, .. } => {
            let numbers = (0..*count.start()).map(|more| (whole + more) as f64);
            Value::List(numbers.collect())
        }
    }
}

/// Every command there is. Of the kinds of references two stand for all: the others differ in
/// numbers, which take time.
pub fn every_command() -> Vec<Command> {
    let stands = |command: &Command| match command {
        Command::AddReference(kind) => ["circle", "conical-spiral"].contains(&kind.name),
        _ => true,
    };
    Command::all().into_iter().filter(stands).collect()
}

/// The export to files with an extension, of a polygon where the format lets one choose.
pub fn exporter(extension: &str, polygon: PolygonKind) -> ExportChoice {
    let mut exporters = formats::exporters()
        .into_iter()
        .filter(|it| it.format.extension() == extension);
    let exporter = exporters.find(|it| it.row.polygon.is_none_or(|kind| kind == polygon));
    ExportChoice::of(exporter.expect("an export"))
}
