//! Reading and writing files beside the frame, one task at a time.

use std::path::{Path, PathBuf};

use super::Client;
use super::autosaving::Autosaver;
use super::edited_file::EditedFile;
use super::exporting::{ExportForecast, ExportRequest, Exported, Forecasting, exported};
use super::file_reading::{ColumnQuestion, FilesToRead, ImportQuestion, Purpose, ReadFile, Unread};
use super::patience::Patience;
use crate::document::{CurveId, Document, quoted};
use crate::editor::reply::{Note, Refusal, Reply, with_lines};
use crate::editor::selection::Selection;
use crate::editor::workspace::Workspace;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::{Progress, counted};
use crate::io::{
    ExportChoice, FileError, Fingerprint, Original, PROJECT, Scope, counted_content, counted_items,
    disk, formats, shown_path,
};

/// Read and write files, and watch the document's own file.
#[derive(Debug, Default)]
pub struct Filing {
    client: Client<FileWork, Result<FileResult, Refusal>>,
    /// Foresees what an export would write and lose.
    forecasting: Forecasting,
    /// The export that is to be foreseen.
    foreseen: Option<ExportChoice>,
    /// The last export of the document, with the number of its opening.
    last_export: Option<(u64, ExportChoice)>,
    /// Looks at the document's file for changes by other programs.
    watch: Client<PathBuf, Fingerprint>,
    /// The file that the program was started to edit.
    edited: Option<EditedFile>,
    /// The reply to the last request for files, until the window takes it.
    pub(in crate::editor) reply: Option<FileReply>,
    /// Documents that wait for the unit of the document that receives them.
    pub(in crate::editor) question: Option<UnitQuestion>,
    /// Files that wait for the columns of a table.
    pub(in crate::editor) column_question: Option<Box<ColumnQuestion>>,
    /// Files of other programs that wait for what is taken of them.
    pub(in crate::editor) import_question: Option<Box<ImportQuestion>>,
    /// The files of other programs that came in last, to be chosen anew.
    pub(in crate::editor) imported: Option<FilesToRead>,
}

/// A task that is not finished.
#[derive(Clone, Debug)]
pub struct FileWork {
    /// The text in the window, as "Saving hull.batten…".
    pub text: String,
    /// The revision of the document at the request.
    pub(in crate::editor) revision: u64,
    /// The opening of the document at the request.
    pub(in crate::editor) opening: u64,
    /// Whether it reads files, which changes nothing before its end.
    pub(in crate::editor) is_reading: bool,
}

/// A request to read or write files.
#[derive(Debug)]
pub(in crate::editor) enum FileTask {
    /// Read files as one document, or to add their curves.
    Read(FilesToRead),
    /// Read the document's own file again.
    Reload(PathBuf),
    /// Write the document; refuse if its file is known and holds something else.
    Save {
        path: PathBuf,
        document: Document,
        known: Option<Fingerprint>,
    },
    /// Write the document back to the file of another program that it was read from; ask first if that
    /// loses something, and refuse if the file is known and holds something else.
    WriteBack {
        edited: EditedFile,
        document: Document,
        known: Option<Fingerprint>,
    },
    /// Write what is chosen.
    Export {
        path: PathBuf,
        choice: Box<ExportChoice>,
        document: Document,
        selected: Vec<CurveId>,
    },
}

/// The result of a task, to be applied to the editor, with the text that tells of it.
#[derive(Debug)]
pub(in crate::editor) enum FileResult {
    Opened {
        document: Document,
        /// The file that the document is saved back to.
        own: Option<(PathBuf, Fingerprint)>,
        text: String,
        /// The file of another program that it was read from, to be chosen anew.
        file: Option<FilesToRead>,
        /// The content of the file that is edited.
        original: Option<Original>,
    },
    Reloaded {
        document: Document,
        fingerprint: Fingerprint,
        /// The content of the file that is edited.
        original: Option<Original>,
        text: String,
    },
    /// Documents to be merged.
    Read(Incoming),
    /// A table whose columns must be chosen first.
    Asked(Box<ColumnQuestion>),
    /// Files of other programs of which must be chosen first what is taken.
    AskedImport(Box<ImportQuestion>),
    Saved {
        path: PathBuf,
        document: Document,
        fingerprint: Fingerprint,
        text: String,
    },
    /// Another program has changed the file, so nothing is written.
    Changed(PathBuf),
    /// The user must accept these losses first, so nothing is written.
    Loses(Vec<String>),
    Exported {
        text: String,
    },
}

/// Documents that were read, to be merged by the rule for units.
#[derive(Clone, Debug)]
pub(in crate::editor) struct Incoming {
    pub purpose: Purpose,
    pub documents: Vec<ReadDocument>,
    /// The files of other programs among their files, to be chosen anew.
    pub files: Option<FilesToRead>,
}

/// A document that was read, with the remarks on it.
#[derive(Clone, Debug)]
pub(in crate::editor) struct ReadDocument {
    pub document: Document,
    /// The prefix of its remarks, as "hull.csv: ".
    pub name: String,
    pub remarks: String,
}

/// The reply to a request to read or write files.
#[derive(Clone, Debug, PartialEq)]
pub struct FileReply {
    /// The reply, as the message shows it.
    pub reply: Reply,
    /// Whether nothing was written because another program has changed the file.
    pub is_file_changed: bool,
    /// The losses that the user must accept before anything is written, one line each.
    pub losses: Vec<String>,
}

/// A question for the unit of the document, with what waits for the answer.
#[derive(Debug)]
pub struct UnitQuestion {
    /// The unit of the incoming document.
    pub incoming: LengthUnit,
    /// The documents to add.
    pub waiting: Incoming,
    /// Whether a step was taken back for them, which comes back if nothing is added.
    pub has_retaken: bool,
}

impl Filing {
    /// Work on threads from now on, which call `wake` when a result is there. Questions about files that were opened
    /// before stay.
    pub(in crate::editor) fn run_in_background(
        &mut self,
        wake: impl Fn() + Clone + Send + 'static,
    ) {
        self.client = Client::background("files", wake.clone());
        self.forecasting = Client::background("export forecast", wake.clone());
        self.watch = Client::background("file watch", wake);
    }

    /// The choice of the document's last export.
    pub fn last_export(&self, workspace: &Workspace) -> Option<&ExportChoice> {
        let (opening, choice) = self.last_export.as_ref()?;
        (*opening == workspace.opening()).then_some(choice)
    }

    /// Keep a choice as that of the document's last export.
    pub fn keep_export(&mut self, choice: ExportChoice, workspace: &Workspace) {
        self.last_export = Some((workspace.opening(), choice));
    }

    /// Foresee an export from the next frame on; without a choice foresee nothing.
    pub fn foresee_export(&mut self, choice: Option<&ExportChoice>) {
        self.foreseen = choice.cloned();
    }

    /// Work out the export that is to be foreseen, unless that is known.
    pub(in crate::editor) fn forecast(
        &mut self,
        workspace: &Workspace,
        selection: &Selection,
        patience: &mut Patience,
    ) {
        let request = self.foreseen.clone().map(|choice| ExportRequest {
            choice,
            selected: selection.items(),
            state: [workspace.revision(), workspace.opening()],
        });
        let job = |request: ExportRequest| {
            let document = workspace.settled().clone();
            move |progress: &Progress| request.forecast(&document, progress)
        };
        self.forecasting.advance(request, Some(patience), job);
    }

    /// What the export that is foreseen would write and lose; `None` while that is worked out.
    pub fn export_forecast(&self) -> Option<Result<&ExportForecast, &Refusal>> {
        let request = self.forecasting.request()?;
        let known = self.forecasting.result();
        known
            .filter(|_| self.foreseen.as_ref() == Some(&request.choice))
            .map(Result::as_ref)
    }

    /// Take the final reply to the last request for files, once it is there.
    pub fn take_reply(&mut self) -> Option<FileReply> {
        self.reply.take()
    }

    /// The unit of documents that cannot be added until
    /// [`Editor::answer_files`](crate::editor::Editor::answer_files) gives the unit of the document that
    /// receives them.
    pub fn unit_question(&self) -> Option<LengthUnit> {
        self.question.as_ref().map(|question| question.incoming)
    }

    /// The table that cannot be read until
    /// [`Editor::answer_files`](crate::editor::Editor::answer_files) chooses its columns.
    pub fn column_question(&self) -> Option<&ColumnQuestion> {
        self.column_question.as_deref()
    }

    /// The files of other programs that cannot be read until
    /// [`Editor::answer_files`](crate::editor::Editor::answer_files) chooses what is taken.
    pub fn import_question(&self) -> Option<&ImportQuestion> {
        self.import_question.as_deref()
    }

    /// Keep the files of other programs that came in, and let the note offer to choose from them anew.
    pub(in crate::editor) fn note_imported(
        &mut self,
        files: Option<FilesToRead>,
        note: Note,
        workspace: &Workspace,
    ) -> Note {
        let note = note.offering_choice(files.is_some());
        self.imported = files.map(|files| FilesToRead {
            retakes: Some(workspace.revision()),
            asks: false,
            ..files
        });
        note
    }

    /// The files of other programs that came in last, to be asked about again.
    pub(in crate::editor) fn choosing_anew(&self, workspace: &Workspace) -> Option<FilesToRead> {
        let files = self.imported.clone()?;
        let is_last = files.retakes == Some(workspace.revision());
        Some(FilesToRead {
            asks: true,
            // What was done since would be lost with the document.
            purpose: match is_last {
                true => files.purpose,
                false => Purpose::Import,
            },
            ..files
        })
    }

    /// Whether files of other programs came in, to be chosen anew.
    pub fn has_imported(&self) -> bool {
        self.imported.is_some()
    }

    /// Name the file that the program was started to edit: when it is opened, whatever its format, it becomes the
    /// document's own file.
    pub fn edit(&mut self, edited: EditedFile) {
        self.edited = Some(edited);
    }

    /// The purpose of opening files: a single project replaces the document, and so does anything where there is
    /// nothing to keep. Other files are added.
    pub(in crate::editor) fn purpose_of(
        &self,
        paths: &[PathBuf],
        workspace: &Workspace,
    ) -> Purpose {
        match (&self.edited, paths) {
            (Some(edited), [path]) if edited.path() == path => Purpose::Edit,
            (_, [path]) if is_project(path) => Purpose::Open,
            _ if workspace.has_nothing_to_keep() => Purpose::Open,
            _ => Purpose::Import,
        }
    }

    /// The file that the program was started to edit.
    pub fn edited(&self) -> Option<&EditedFile> {
        self.edited.as_ref()
    }

    /// Set the content of the edited file into which changes are written.
    pub(in crate::editor) fn set_original(&mut self, original: Option<Original>) {
        if let Some(edited) = &mut self.edited {
            edited.set_original(original);
        }
    }

    /// Accept what the format of the edited file cannot hold. From now on saving does not ask.
    pub fn accept_losses(&mut self) {
        if let Some(edited) = &mut self.edited {
            edited.accept_losses();
        }
    }

    /// Whether a save to another path is a copy: the edited file stays the document's file.
    pub(in crate::editor) fn is_copy(&self, path: &Path, workspace: &Workspace) -> bool {
        let is_edited =
            |edited: &EditedFile| workspace.path() == Some(edited.path()) && edited.path() != path;
        self.edited.as_ref().is_some_and(is_edited)
    }

    /// The task that saves a document. The edited file is written back in its own format.
    pub(in crate::editor) fn saving(
        &self,
        path: &Path,
        document: Document,
        known: Option<Fingerprint>,
    ) -> FileTask {
        let edited = self.edited.as_ref();
        match edited.filter(|edited| edited.is_foreign() && edited.path() == path) {
            Some(edited) => FileTask::WriteBack {
                edited: edited.clone(),
                document,
                known,
            },
            None => FileTask::Save {
                path: path.to_owned(),
                document,
                known,
            },
        }
    }

    /// The task that is not finished.
    pub fn work(&self) -> Option<&FileWork> {
        self.client.request()
    }

    /// Start a task. `autosaver` knows which files other windows have open.
    pub(in crate::editor) fn start(
        &mut self,
        task: FileTask,
        workspace: &Workspace,
        autosaver: Option<Autosaver>,
        patience: &mut Patience,
    ) {
        // A change that was seen before the task does not count after it.
        self.watch.forget();
        let work = FileWork {
            text: task.text(),
            revision: workspace.revision(),
            opening: workspace.opening(),
            is_reading: matches!(task, FileTask::Read(_)),
        };
        let is_own = |path: &Path| workspace.path() == Some(path);
        let autosaver = match &task {
            FileTask::Save { path, .. } if is_own(path) => None,
            _ => autosaver,
        };
        let job = move |progress: &Progress| Some(task.run(autosaver.as_ref(), progress));
        self.client.start(work, job, Some(patience));
    }

    /// Take the result of the task, once it is there.
    pub(in crate::editor) fn finish(&mut self) -> Option<(FileWork, Result<FileResult, Refusal>)> {
        self.client.receive();
        let work = self.client.request()?.clone();
        let failed = |panic: &str| Err(Refusal(format!("{} failed: {panic}", work.text)));
        let result = match self.client.take_result() {
            Some(result) => result,
            None => failed(self.client.failure()?),
        };
        self.client.forget();
        Some((work, result))
    }

    /// The share of the reading of files that is done; `None` while nothing is read.
    pub fn reading(&self) -> Option<f64> {
        self.work().filter(|work| work.is_reading)?;
        self.client.progress()
    }

    /// Stop the reading of files, which has changed nothing. Returns whether there was any.
    pub fn stop_reading(&mut self) -> bool {
        let is_reading = self.work().is_some_and(|work| work.is_reading);
        if is_reading {
            self.client.forget();
            self.reply = Some(FileReply {
                reply: Ok(Note::silent()),
                is_file_changed: false,
                losses: Vec::new(),
            });
        }
        is_reading
    }

    /// Wait until the task is finished; nobody waits for files that are read.
    pub(in crate::editor) fn end(&mut self) {
        if !self.stop_reading() {
            self.client.wait();
        }
    }

    /// Look whether another program has changed the document's file. [`Filing::seen_change`] tells it
    /// in a later frame.
    pub(in crate::editor) fn look_at(&mut self, path: &Path) {
        if self.work().is_none() {
            let look = path.to_owned();
            let job = move |_: &_| disk::fingerprint(&look);
            self.watch.start(path.to_owned(), job, None);
        }
    }

    /// Take a change of the document's file by another program, as a text. Each change is told once.
    pub(in crate::editor) fn seen_change(&mut self, workspace: &mut Workspace) -> Option<String> {
        self.watch.receive();
        let path = self
            .watch
            .request()
            .filter(|path| workspace.path() == Some(path));
        let name = quoted(&path?.file_name().unwrap_or_default().to_string_lossy());
        let is_new = workspace.note_file(self.watch.take_result()?);
        is_new.then(|| format!("Another program has changed {name}"))
    }
}

impl FileWork {
    /// Whether the document was changed since the request.
    pub(in crate::editor) fn is_outdated(&self, workspace: &Workspace) -> bool {
        workspace.revision() != self.revision
    }
}

impl FileResult {
    /// Whether the result takes the place of the document.
    pub fn replaces(&self) -> bool {
        match self {
            Self::Opened { .. } | Self::Reloaded { .. } => true,
            Self::Read(incoming) => incoming.purpose == Purpose::Open,
            _ => false,
        }
    }
}

impl FileTask {
    /// The text in the window while the task runs.
    fn text(&self) -> String {
        let name = |path: &Path| {
            let name = path.file_name().unwrap_or_default();
            name.to_string_lossy().into_owned()
        };
        let names = |paths: &[PathBuf]| match paths {
            [path] => name(path),
            paths => counted(paths.len(), "file", "files"),
        };
        match self {
            Self::Read(files) => match files.purpose {
                Purpose::Open | Purpose::Edit => format!("Opening {}…", names(&files.paths)),
                _ => format!("Importing {}…", names(&files.paths)),
            },
            Self::Reload(path) => format!("Reloading {}…", name(path)),
            Self::Save { path, .. } => format!("Saving {}…", name(path)),
            Self::WriteBack { edited, .. } => format!("Saving {}…", name(edited.path())),
            Self::Export { path, .. } => format!("Exporting {}…", name(path)),
        }
    }

    fn run(
        self,
        autosaver: Option<&Autosaver>,
        progress: &Progress,
    ) -> Result<FileResult, Refusal> {
        match self {
            Self::Read(files) => {
                let read = match (files.purpose, files.paths.as_slice()) {
                    (Purpose::Open | Purpose::Edit, [path]) => {
                        open(&files, path, autosaver, progress)
                    }
                    _ => read_all(&files, progress),
                };
                match read {
                    Ok(result) => Ok(result),
                    Err(Unread::Asked(question)) => Ok(FileResult::Asked(question)),
                    Err(Unread::AskedImport(question)) => Ok(FileResult::AskedImport(question)),
                    Err(Unread::Refused(refusal)) => Err(refusal),
                }
            }
            Self::Reload(path) => reload(&path),
            Self::Save {
                path,
                document,
                known,
            } => save(&path, document, known, autosaver),
            Self::WriteBack {
                edited,
                document,
                known,
            } => write_back(&edited, document, known),
            Self::Export {
                path,
                choice,
                document,
                selected,
            } => export(&path, &choice, &document, &selected),
        }
    }
}

fn open(
    files: &FilesToRead,
    path: &Path,
    autosaver: Option<&Autosaver>,
    progress: &Progress,
) -> Result<FileResult, Unread> {
    let drawings = files.drawings()?;
    let ReadFile {
        document,
        fingerprint,
        remarks,
    } = files.read(path, &drawings, progress)?;
    let counted = counted_content([&document]);
    let text = format!("{counted} read from {}", shown_path(path));
    let mut text = with_lines(text, &remarks);
    if document.has_extras() {
        text += "\nUnknown keys are kept when you save.";
    }
    let own = match files.purpose {
        Purpose::Edit => Some(path.to_owned()),
        _ => own_path(path),
    };
    if files.purpose == Purpose::Edit {
        text += "\nSave writes the file back. Close the window when you are done.";
    }
    let elsewhere = own.as_deref().map(|own| open_elsewhere(own, autosaver));
    let own = own.zip(fingerprint);
    let original = own
        .as_ref()
        .and_then(|(path, known)| disk::original(path, *known, &document));
    Ok(FileResult::Opened {
        document,
        own,
        original,
        text: with_lines(text, &elsewhere.unwrap_or_default()),
        file: (!drawings.is_empty()).then(|| files.clone()),
    })
}

fn reload(path: &Path) -> Result<FileResult, Refusal> {
    let (mut reading, fingerprint) = disk::read_with_fingerprint(path, None, None)?;
    let remarks = std::mem::take(&mut reading.remarks);
    let text = format!("Reloaded from {}", shown_path(path));
    let document = reading.into_document()?;
    Ok(FileResult::Reloaded {
        original: disk::original(path, fingerprint, &document),
        document,
        fingerprint,
        text: with_lines(text, &remarks),
    })
}

fn save(
    path: &Path,
    document: Document,
    known: Option<Fingerprint>,
    autosaver: Option<&Autosaver>,
) -> Result<FileResult, Refusal> {
    let path = with_extension(path, PROJECT.extension());
    let shown = shown_path(&path);
    let format = formats::to_write(&path).map_err(|error| format!("{shown}: {error}"))?;
    if !format.holds_documents {
        return Err(Refusal(format!(
            "{shown}: a {format} cannot store a whole document: save as .batten, or export"
        )));
    }
    if is_changed(&path, known) {
        return Ok(FileResult::Changed(path));
    }
    let saved = disk::write_document(&path, &document, None)?;
    let text = with_lines(format!("Saved to {shown}"), &saved);
    Ok(FileResult::Saved {
        text: with_lines(text, &open_elsewhere(&path, autosaver)),
        path,
        document,
        fingerprint: saved.fingerprint,
    })
}

/// Whether a file whose content is known holds another one now. A file that is not there, or cannot be read, holds
/// nothing that could be lost.
fn is_changed(path: &Path, known: Option<Fingerprint>) -> bool {
    let found = known.and_then(|_| disk::fingerprint(path));
    found.is_some() && found != known
}

fn write_back(
    edited: &EditedFile,
    document: Document,
    known: Option<Fingerprint>,
) -> Result<FileResult, Refusal> {
    let path = edited.path();
    let format = formats::to_write(path).map_err(FileError::at(path))?;
    let written = edited.written(format, &document);
    let written = written.map_err(FileError::at(path))?;
    let losses = edited.losses_to_accept(format, &document, &written);
    if !losses.is_empty() {
        return Ok(FileResult::Loses(losses));
    }
    if is_changed(path, known) {
        return Ok(FileResult::Changed(path.to_owned()));
    }
    let saved = disk::write_export(path, written.export)?;
    Ok(FileResult::Saved {
        text: with_lines(format!("Saved to {}", shown_path(path)), &saved),
        path: path.to_owned(),
        document,
        fingerprint: saved.fingerprint,
    })
}

fn export(
    path: &Path,
    choice: &ExportChoice,
    document: &Document,
    selected: &[CurveId],
) -> Result<FileResult, Refusal> {
    let extension = choice.format.extension();
    let path = with_extension(path, extension);
    let shown = shown_path(&path);
    let format = formats::to_write(&path).map_err(|error| format!("{shown}: {error}"))?;
    if format != choice.format {
        return Err(Refusal(format!(
            "{shown}: that would be a {format}: give it the extension .{extension}"
        )));
    }
    let Exported {
        export,
        counts: [curves, references],
        told,
        ..
    } = exported(choice, document, selected, &Progress::default())?;
    let mut text = format!("{} exported to {shown}", counted_items(curves, references));
    let hidden = document.curves().filter(|(_, curve)| !curve.visible);
    let rest = hidden.count();
    if rest > 0 && choice.scope == Scope::Visible {
        let hidden = counted(rest, "hidden curve", "hidden curves");
        text += &format!("; {hidden} skipped");
    }
    let saved = disk::write_export(&path, export)?;
    let text = told.iter().fold(text, with_lines);
    Ok(FileResult::Exported {
        text: with_lines(text, &saved),
    })
}

/// Read several files, to be merged.
fn read_all(files: &FilesToRead, progress: &Progress) -> Result<FileResult, Unread> {
    let drawings = files.drawings()?;
    let count = files.paths.len() as f64;
    let documents = files.paths.iter().enumerate().map(|(index, path)| {
        let own = progress.part(index as f64 / count, (index + 1) as f64 / count);
        let ReadFile {
            document, remarks, ..
        } = files.read(path, &drawings, &own)?;
        Ok(ReadDocument {
            document,
            name: format!("{}: ", shown_path(path)),
            remarks,
        })
    });
    Ok(FileResult::Read(Incoming {
        purpose: files.purpose,
        documents: documents.collect::<Result<_, Unread>>()?,
        files: (!drawings.is_empty()).then(|| files.clone()),
    }))
}

/// The line that another window has a file open; empty if none has.
pub(in crate::editor) fn open_elsewhere(path: &Path, autosaver: Option<&Autosaver>) -> String {
    match autosaver.is_some_and(|autosaver| autosaver.is_open_elsewhere(path)) {
        true => "Another window has this file open: the last save wins".to_owned(),
        false => String::new(),
    }
}

/// The path that a document read from it is saved back to: only a project loses nothing there.
pub(in crate::editor) fn own_path(path: &Path) -> Option<PathBuf> {
    is_project(path).then(|| path.to_owned())
}

/// Whether a file is a project, by its name.
pub fn is_project(path: &Path) -> bool {
    formats::to_read(path).is_ok_and(|format| format.holds_documents)
}

/// Give a path the extension if it has none that is a format's: what follows the point in
/// "hull v1.2" is part of the name.
pub fn with_extension(path: &Path, extension: &str) -> PathBuf {
    let given = path.extension().map(|given| given.to_string_lossy());
    match (given.as_deref(), path.file_name()) {
        (Some(given), _) if formats::find(given).is_some() => path.to_owned(),
        (Some(""), _) | (None, _) | (_, None) => path.with_extension(extension),
        (Some(_), Some(name)) => {
            let mut name = name.to_owned();
            name.push(".");
            name.push(extension);
            path.with_file_name(name)
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;
    use std::time::Duration;

    use super::*;
    use crate::document::Edit;
    use crate::editor::Editor;

    /// The task to read a file.
    fn reading(editor: &Editor, name: &str) -> FileWork {
        FileWork {
            text: format!("Opening {name}…"),
            revision: editor.workspace().revision(),
            opening: editor.workspace().opening(),
            is_reading: true,
        }
    }

    /// Longer than any job here takes.
    const LONG: Duration = Duration::from_secs(60);

    #[test]
    fn a_document_that_is_changed_while_a_file_is_read_stays() {
        let mut editor = Editor::new();
        let (sender, woken) = channel();
        editor.run_in_background(Duration::ZERO, move || sender.send(()).unwrap_or_default());
        // A file that is read as slowly as the test wants.
        let (lets_go, held) = channel::<()>();
        let job = move |_: &_| {
            held.recv().unwrap_or_default();
            Some(Ok(FileResult::Opened {
                document: Document::default(),
                own: None,
                text: "read".to_owned(),
                file: None,
                original: None,
            }))
        };
        let work = reading(&editor, "slow.batten");
        editor.filing.client.start(work, job, None);
        let busy = editor.save(Path::new("other.batten"));
        let busy = busy.expect_err("one task at a time").to_string();
        assert!(busy.starts_with("Opening slow.batten…"), "{busy}");
        let curve = editor.active().expect("a curve");
        let name = "renamed".to_owned();
        let renamed = editor.apply("Rename", vec![Edit::Rename { curve, name }]);
        renamed.expect("an edit");
        lets_go.send(()).expect("the job is held");
        while editor.filing().work().is_some() {
            woken.recv_timeout(LONG).expect("the frame is woken");
            editor.begin_frame();
        }
        let reply = editor
            .filing_mut()
            .take_reply()
            .expect("the final reply")
            .reply;
        assert!(reply.is_err_and(|refusal| refusal.0.contains("changed while")));
        assert_eq!(editor.document().name(curve), Some("renamed"));
    }

    #[test]
    fn nobody_waits_for_files_that_are_read() {
        let mut editor = Editor::new();
        editor.run_in_background(Duration::ZERO, || {});
        let before = editor.document().clone();
        for closes in [false, true] {
            // A file that is read until the test ends.
            let (_lets_go, held) = channel::<()>();
            let job = move |_: &_| {
                held.recv().unwrap_or_default();
                None
            };
            let work = reading(&editor, "slow.dxf");
            editor.filing.client.start(work, job, None);
            assert_eq!(editor.filing().reading(), Some(0.0));
            match closes {
                true => drop(editor.close(false)),
                false => drop(editor.filing_mut().stop_reading()),
            }
            assert!(editor.filing().work().is_none());
            assert!(editor.document().is_same(&before));
        }
    }
}
