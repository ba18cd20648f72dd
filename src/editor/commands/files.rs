//! Opening, saving and exporting; the window only asks for paths.

use std::path::{Path, PathBuf};

use crate::document::{Document, Edit};
use crate::editor::Editor;
use crate::editor::commands::drawing::end_drawing;
use crate::editor::jobs::edited_file::EditedFile;
use crate::editor::jobs::file_reading::{FilesToRead, Purpose};
use crate::editor::jobs::filing::{FileReply, FileResult, FileTask, FileWork, Filing};
use crate::editor::reply::{Message, Note, Refusal, Reply};
use crate::editor::view::{Look, Viewport};
use crate::io::ExportChoice;
use crate::io::examples::EXAMPLES;

impl Editor {
    /// Begin an empty document.
    pub fn begin_empty(&mut self) {
        self.message = None;
        let unit = self.document().unit();
        self.replace(Document::default().with_unit(unit), None);
    }

    /// Open files; none leaves the document as it is. A single project replaces it, and any other file where there is
    /// nothing to keep; otherwise files are added. Only a single project is saved back to its file, with its unknown
    /// keys, and the file that [`Filing::edit`] names.
    ///
    /// The message shows the reply of this and of the other functions on files. A task that takes longer
    /// than a frame continues beside it: then the reply is a note of that, and
    /// [`Filing::take_reply`] has the final one later.
    ///
    /// # Errors
    /// [`Refusal`] if a file cannot be read; nothing is changed then.
    pub fn open(&mut self, paths: &[PathBuf]) -> Reply {
        if paths.is_empty() {
            return Ok(Note::silent());
        }
        let purpose = self.filing.purpose_of(paths, &self.workspace);
        self.start_file_task(FileTask::Read(FilesToRead::new(paths, purpose)))
    }

    /// Open a document that was made elsewhere in place of the present one. The message shows a refusal.
    ///
    /// # Errors
    /// The given [`Refusal`]; nothing is changed then.
    pub fn open_document(&mut self, document: Result<Document, Refusal>) -> Reply {
        let reply = document.map(|document| {
            self.replace(document, None);
            Note::silent()
        });
        self.tell(reply)
    }

    /// Open a built-in example in place of the document, by its number. The message shows the reply.
    ///
    /// # Errors
    /// [`Refusal`] if there is no such example.
    pub fn open_example(&mut self, index: usize) -> Reply {
        let example = EXAMPLES.get(index).ok_or("There is no such example");
        let reply = example.map_err(Refusal::from).and_then(|example| {
            let reading = example.read().map_err(|error| error.to_string())?;
            self.replace(reading.into_document()?, None);
            self.workspace.mark_offered();
            let (title, description) = (example.title, example.description);
            Ok(Note::told(format!("{title}: {description}")))
        });
        self.tell(reply)
    }

    /// Read the document's file again, as one step that can be undone.
    ///
    /// # Errors
    /// [`Refusal`] if there is none, or it cannot be read; nothing is changed then.
    pub fn reload(&mut self) -> Reply {
        match self.workspace.path() {
            Some(path) => self.start_file_task(FileTask::Reload(path.to_owned())),
            None => self.tell(Err(Refusal::from("The document has no file yet"))),
        }
    }

    /// Add the curves of some files to the document, as one step.
    ///
    /// # Errors
    /// [`Refusal`] if a file cannot be read; nothing is changed then.
    pub fn import(&mut self, paths: &[PathBuf]) -> Reply {
        self.start_file_task(FileTask::Read(FilesToRead::new(paths, Purpose::Import)))
    }

    /// Save the document without the preview, which goes on, and with what is being drawn.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be written.
    pub fn save(&mut self, path: &Path) -> Reply {
        end_drawing(self);
        let document = self.workspace.settled().clone();
        self.start_file_task(self.filing.saving(path, document, None))
    }

    /// Save the document to its own file, unless another program has changed it, or the file's format loses
    /// something that the user has not accepted.
    ///
    /// # Errors
    /// [`Refusal`] if it has no file, the file was changed, or it cannot be written.
    pub fn save_unless_changed(&mut self) -> Reply {
        end_drawing(self);
        match self.workspace.path() {
            Some(path) => {
                let document = self.workspace.settled().clone();
                let known = self.workspace.fingerprint();
                self.start_file_task(self.filing.saving(path, document, known))
            }
            None => self.tell(Err(Refusal::from("The document has no file yet"))),
        }
    }

    /// Export what is chosen without the preview, which goes on, and with what is being drawn. The reply names what the
    /// format cannot hold. The document keeps the choice for the next export.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be written.
    pub fn export(&mut self, path: &Path, choice: &ExportChoice) -> Reply {
        end_drawing(self);
        self.filing.keep_export(choice.clone(), &self.workspace);
        self.start_file_task(FileTask::Export {
            path: path.to_owned(),
            choice: Box::new(choice.clone()),
            document: self.workspace.settled().clone(),
            selected: self.hand.selection.items(),
        })
    }

    /// The reading and writing of files beside the frame.
    pub fn filing(&self) -> &Filing {
        &self.filing
    }

    /// The reading and writing of files, to take its reply.
    pub fn filing_mut(&mut self) -> &mut Filing {
        &mut self.filing
    }

    /// Look whether another program has changed the document's file, as when the window gets the
    /// keyboard again. A later frame tells a change, once.
    pub fn look_at_file(&mut self) {
        if let Some(path) = self.workspace.path() {
            self.filing.look_at(path);
        }
    }

    /// Take the result of the task on files, and a change of the document's file. Returns the reply to
    /// the task, which is told.
    pub(in crate::editor) fn receive_files(&mut self) -> Option<Reply> {
        if let Some(text) = self.filing.seen_change(&mut self.workspace) {
            self.message = Some(Message::file_changed(text));
        }
        let (work, result) = self.filing.finish()?;
        let is_file_changed = matches!(result, Ok(FileResult::Changed(_)));
        let losses = match &result {
            Ok(FileResult::Loses(losses)) => losses.clone(),
            _ => Vec::new(),
        };
        let reply = result.and_then(|result| self.take_files(&work, result));
        let reply = self.tell(reply);
        self.filing.reply = Some(FileReply {
            reply: reply.clone(),
            is_file_changed,
            losses,
        });
        Some(reply)
    }

    pub(in crate::editor) fn start_file_task(&mut self, task: FileTask) -> Reply {
        if let Some(work) = self.filing.work() {
            let busy = format!("{} Wait until that is done", work.text);
            return self.tell(Err(Refusal(busy)));
        }
        self.filing.reply = None;
        let autosaver = self.recovery.autosaver().cloned();
        let patience = &mut self.patience;
        self.filing
            .start(task, &self.workspace, autosaver, patience);
        if let Some(reply) = self.receive_files() {
            return reply;
        }
        let note = self.filing.work().map(|work| Note::told(&work.text));
        self.tell(Ok(note.unwrap_or_default()))
    }

    /// Apply the result of a task to the document.
    fn take_files(&mut self, work: &FileWork, result: FileResult) -> Reply {
        match result {
            result if result.replaces() && work.is_outdated(&self.workspace) => Err(Refusal::from(
                "The document was changed while the file was read: open it again",
            )),
            FileResult::Opened {
                document,
                own,
                text,
                file,
                original,
            } => {
                let (path, fingerprint) = own.unzip();
                if self.filing.edited().map(EditedFile::path) == path.as_deref() {
                    self.filing.set_original(original);
                }
                self.replace(document, path);
                self.workspace.set_fingerprint(fingerprint);
                Ok(self
                    .filing
                    .note_imported(file, Note::told(text), &self.workspace))
            }
            FileResult::Reloaded {
                document,
                fingerprint,
                original,
                text,
            } => {
                if self.filing.edited().map(EditedFile::path) == self.workspace.path() {
                    self.filing.set_original(original);
                }
                self.interrupt();
                self.workspace.reload(document, fingerprint);
                self.document_changed();
                Ok(Note::done(text))
            }
            FileResult::Read(incoming) => self.merge(incoming, None),
            FileResult::Asked(question) => {
                self.filing.column_question = Some(question);
                Ok(Note::silent())
            }
            FileResult::AskedImport(question) => {
                self.filing.import_question = Some(question);
                Ok(Note::silent())
            }
            FileResult::Saved {
                path,
                document,
                fingerprint,
                text,
            } => {
                if let Some(edited) = self.filing.edited().filter(|it| it.path() == path) {
                    edited.mark_saved();
                }
                // Another document may be open by now.
                let is_same = work.opening == self.workspace.opening();
                if is_same && !self.filing.is_copy(&path, &self.workspace) {
                    self.workspace.mark_saved(path, document, fingerprint);
                }
                Ok(match self.document().is_same(self.workspace.settled()) {
                    true => Note::told(text),
                    false => Note::told(format!("{text}, without what is previewed")).warning(),
                })
            }
            FileResult::Changed(path) => {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                Err(Refusal(format!("Another program has changed {name}")))
            }
            FileResult::Loses(losses) => {
                let lines = losses.join("\n");
                Err(Refusal(format!("Accept what is lost first:\n{lines}")))
            }
            FileResult::Exported { text } => Ok(Note::told(text)),
        }
    }

    /// Make edits that add items as one step, and make the first of them active.
    pub(in crate::editor) fn add(&mut self, label: &str, edits: Vec<Edit>) -> Reply {
        let first = self.document().next_id();
        let added = self.make(label, edits, false)?;
        if self.document().name(first).is_some() {
            self.hand.selection.clear();
            self.hand.selection.activate(first);
        }
        Ok(added)
    }

    /// Put another document in the place of this one.
    pub(in crate::editor) fn replace(&mut self, document: Document, path: Option<PathBuf>) {
        self.interrupt();
        self.filing.question = None;
        self.filing.column_question = None;
        self.filing.import_question = None;
        self.workspace.replace(document, path);
        self.hand.begin_document();
        self.view.compare_nothing();
        self.document_changed();
        if self.view.placed {
            if self.document().is_empty() {
                // An empty document has no size: it begins at the usual scale.
                let Viewport { centre, scale, .. } = Viewport::default();
                self.view.each_pane(|view| {
                    view.pane.viewport.centre = centre;
                    view.pane.viewport.scale = scale;
                });
            }
            self.look(Look::All);
        }
    }
}
