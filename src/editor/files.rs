//! Opening, saving and exporting; the window only asks for paths.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::document::{Curve, CurveId, Document, Edit, EndMatch, Reference, quoted};
use crate::editor::reply::{Message, Note, Refusal, Reply};
use crate::editor::view::Look;
use crate::editor::{Editor, Export};
use crate::geometry::counted;
use crate::geometry::expressions::LengthUnit;
use crate::io::examples::EXAMPLES;
use crate::io::{FileError, Fingerprint, Format, Reading, disk, shown_path};

impl Editor {
    /// Begin an empty document.
    pub fn begin_empty(&mut self) {
        self.message = None;
        self.replace(Document::default(), None);
    }

    /// Open files as one document in place of the present one; none leaves it as it is. Only a
    /// single project is saved back to where it came from, with what it says of itself that is not
    /// known. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if one of them cannot be read; nothing is changed then.
    pub fn open(&mut self, paths: &[PathBuf]) -> Reply {
        if paths.is_empty() {
            return Ok(Note::silent());
        }
        let reply = self.replace_by_files(paths);
        self.tell(reply)
    }

    /// Open a built-in example in place of the document, by its number. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if there is no such example.
    pub fn open_example(&mut self, index: usize) -> Reply {
        let reply = self.replace_by_example(index);
        self.tell(reply)
    }

    /// Read the document's file again, as one step that can be undone. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if there is none, or it cannot be read; nothing is changed then.
    pub fn reload(&mut self) -> Reply {
        let reply = self.read_again();
        self.tell(reply)
    }

    /// Add the curves of some files to the document, as one step. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if one of them cannot be read; nothing is changed then.
    pub fn import(&mut self, paths: &[PathBuf]) -> Reply {
        let reply = self.add_files(paths);
        self.tell(reply)
    }

    /// Save the document, without what is being tried out, which goes on. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot be written.
    pub fn save(&mut self, path: &Path) -> Reply {
        let reply = self.write_document(path);
        self.tell(reply)
    }

    /// Export the document's visible curves and references, without what is being tried out, which goes on. The
    /// reply, also of what the format could not hold, is told.
    ///
    /// # Errors
    /// [`Refusal`] if they cannot be written.
    pub fn export(&mut self, path: &Path, export: &Export) -> Reply {
        let reply = self.write_export(path, export);
        self.tell(reply)
    }

    /// Add curves and references, with the matches between them, as one step and make the first of them
    /// active.
    pub(in crate::editor) fn add(&mut self, label: &str, added: Reading) -> Reply {
        self.interrupt();
        let first = self.document().next_id();
        let mut ids = self.document().next_ids();
        let curves: Vec<CurveId> = ids.by_ref().take(added.curves.len()).collect();
        let references: Vec<CurveId> = ids.take(added.references.len()).collect();
        let matches = added.matches.iter();
        let matches = matches.map(|matched| matched.between(&curves, &references));
        let matches = matches.collect::<Result<Vec<EndMatch>, _>>()?;
        let curve = |curve: Curve| Edit::Add(Box::new(curve));
        let reference = |reference: Reference| Edit::AddReference(Box::new(reference));
        let curves = added.curves.into_iter().map(curve);
        let references = added.references.into_iter().map(reference);
        let edits = curves
            .chain(references)
            .chain(matches.into_iter().map(Edit::SetMatch))
            .collect();
        let added = self.make(label, edits, false)?;
        if self.document().name(first).is_some() {
            self.hand.selection.clear();
            self.hand.selection.activate(first);
        }
        Ok(added)
    }

    /// Whether the document's file holds something else than when it was last read or written. A
    /// file that is not there, or cannot be read, holds nothing that could be lost.
    pub fn is_file_changed(&self) -> bool {
        let path = self.workspace.path();
        self.is_other(path.and_then(disk::fingerprint))
    }

    /// Look whether another program has changed the document's file, as when the window gets the
    /// keyboard again. A change is told once, by a later frame.
    pub fn look_at_file(&mut self) {
        if let Some(path) = self.workspace.path() {
            let path = path.to_owned();
            let look = path.clone();
            let job = move |_: &_| disk::fingerprint(&look);
            self.file_watch.start(path, job, None);
        }
    }

    /// Tell of a change of the document's file that was seen since the last frame.
    pub(in crate::editor) fn tell_file_change(&mut self) {
        self.file_watch.receive();
        let Some(path) = self.file_watch.request().cloned() else {
            return;
        };
        let is_own = self.workspace.path() == Some(&path);
        let found = self.file_watch.take_result().filter(|_| is_own);
        if found.is_some_and(|found| self.workspace.note_file(found)) {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let text = format!("Another program has changed {}", quoted(&name));
            self.message = Some(Message::file_changed(text));
        }
    }

    /// Say that another window has the document's file open; empty if none has.
    pub(in crate::editor) fn open_elsewhere(&self) -> String {
        let path = self.workspace.path();
        match path.filter(|path| self.autosaving.is_open_elsewhere(path)) {
            Some(_) => "Another window has this file open: the last save wins".to_owned(),
            None => String::new(),
        }
    }

    fn is_other(&self, found: Option<Fingerprint>) -> bool {
        let known = self.workspace.fingerprint();
        found.is_some_and(|found| known.is_some_and(|known| known != found))
    }

    fn replace_by_files(&mut self, paths: &[PathBuf]) -> Reply {
        if let [path] = paths {
            return self.replace_by_file(path);
        }
        let (reading, remarks) = read_together(paths)?;
        let text = format!("{} read from {} files", reading.counted(), paths.len());
        self.replace(reading.into_document()?, None);
        Ok(Note::told(with_lines(text, &remarks)))
    }

    fn replace_by_file(&mut self, path: &Path) -> Reply {
        let (mut reading, fingerprint) = disk::read_with_fingerprint(path)?;
        let text = format!("{} read from {}", reading.counted(), shown_path(path));
        let remarks = std::mem::take(&mut reading.remarks);
        let document = reading.into_document()?;
        let keeps = document.has_extras();
        let own = own_path(path);
        let known = own.as_ref().map(|_| fingerprint);
        self.replace(document, own);
        self.workspace.set_fingerprint(known);
        let mut text = with_lines(text, &remarks);
        if keeps {
            text += "\nUnknown keys are kept when you save.";
        }
        Ok(Note::told(with_lines(text, &self.open_elsewhere())))
    }

    fn read_again(&mut self) -> Reply {
        let path = self
            .workspace
            .path()
            .ok_or("The document has no file yet")?;
        let path = path.to_owned();
        let (mut reading, fingerprint) = disk::read_with_fingerprint(&path)?;
        let remarks = std::mem::take(&mut reading.remarks);
        let document = reading.into_document()?;
        self.interrupt();
        self.workspace.reload(document, fingerprint);
        self.document_changed();
        let text = format!("Reloaded from {}", shown_path(&path));
        Ok(Note::done(with_lines(text, &remarks)))
    }

    fn replace_by_example(&mut self, index: usize) -> Reply {
        let example = EXAMPLES.get(index).ok_or("There is no such example")?;
        let reading = example.read().map_err(|error| error.to_string())?;
        self.replace(reading.into_document()?, None);
        let (title, description) = (example.title, example.description);
        Ok(Note::told(format!("{title}: {description}")))
    }

    fn add_files(&mut self, paths: &[PathBuf]) -> Reply {
        let (reading, remarks) = read_together(paths)?;
        let mut text = format!("{} added", reading.counted());
        let foreign = |unit: &LengthUnit| self.document().unit() != Some(*unit);
        if let Some(unit) = reading.unit.filter(foreign) {
            let name = unit.name();
            text += &format!("; what is added is in {name}, and its numbers stay as they are");
        }
        self.add("Import curves", reading)?;
        self.look(Look::All);
        Ok(Note::done(with_lines(text, &remarks)))
    }

    fn write_document(&mut self, path: &Path) -> Reply {
        let path = with_extension(path, Format::Batten.extension());
        let shown = shown_path(&path);
        match Format::to_write(&path).map_err(|error| format!("{shown}: {error}"))? {
            Format::Batten => {}
            other => {
                return Err(Refusal(format!(
                    "{shown}: a {other} cannot store a whole document: save as .batten, or export"
                )));
            }
        }
        let document = self.workspace.settled();
        let saved = disk::write_document(&path, document, None)?;
        let is_new = self.workspace.path() != Some(&path);
        self.workspace.mark_saved(path, saved.fingerprint);
        let text = with_lines(format!("Saved to {shown}"), &saved);
        Ok(Note::told(match is_new {
            true => with_lines(text, &self.open_elsewhere()),
            false => text,
        }))
    }

    fn write_export(&self, path: &Path, export: &Export) -> Reply {
        let path = with_extension(path, export.extension);
        let shown = shown_path(&path);
        let format = Format::to_write(&path).map_err(|error| format!("{shown}: {error}"))?;
        if format.extension() != export.extension {
            return Err(Refusal(format!(
                "{shown}: that would be a {format}: give it the extension .{}",
                export.extension
            )));
        }
        let polygon = (export.extension == Format::Csv.extension()).then_some(export.polygon);
        let document = self.workspace.settled();
        let (visible, hidden): (Vec<Curve>, Vec<Curve>) = curves_of(document)
            .into_iter()
            .partition(|curve| curve.visible);
        let references = document.references().map(|(_, it)| Reference::clone(it));
        let references = references.filter(|reference| reference.visible);
        let references: Vec<Reference> = references.collect();
        if visible.is_empty() && references.is_empty() {
            return Err(Refusal::from(
                "Everything is hidden: show the curves to export",
            ));
        }
        let count = counted(visible.len(), "curve", "curves");
        let exported = Document::from_curves(visible)
            .with_references(references)
            .with_unit(document.unit())
            .with_extras(document.extras().clone());
        let mut saved = disk::write_document(&path, &exported, polygon)?;
        saved.losses.add_matches(document, |curve| curve.visible);
        let mut text = format!("{count} exported to {shown}");
        if !hidden.is_empty() {
            text += &format!(
                "; {} skipped",
                counted(hidden.len(), "hidden curve", "hidden curves")
            );
        }
        Ok(Note::told(with_lines(text, &saved)))
    }

    /// Put another document in the place of this one.
    pub(in crate::editor) fn replace(&mut self, document: Document, path: Option<PathBuf>) {
        self.interrupt();
        self.workspace.replace(document, path);
        self.document_replaced();
    }
}

fn curves_of(document: &Document) -> Vec<Curve> {
    let curves = document.curves();
    curves.map(|(_, curve)| Curve::clone(curve)).collect()
}

/// Read the curves of several files, with what there is to tell of each.
fn read_together(paths: &[PathBuf]) -> Result<(Reading, String), FileError> {
    let mut together = Reading::default();
    let mut lines = Vec::new();
    for path in paths {
        let reading = disk::read_file(path)?;
        let remarks = reading.remarks.to_string();
        together.append(reading);
        let named = remarks
            .lines()
            .map(|remark| format!("{}: {remark}", shown_path(path)));
        lines.extend(named);
    }
    Ok((together, lines.join("\n")))
}

/// Add lines to a message, if there are any.
pub(in crate::editor) fn with_lines(text: String, lines: &impl fmt::Display) -> String {
    format!("{text}\n{lines}").trim_end().to_owned()
}

/// The path that a document read from it is saved back to: only a project loses nothing there.
fn own_path(path: &Path) -> Option<PathBuf> {
    let is_project = Format::to_read(path).is_ok_and(|format| format == Format::Batten);
    is_project.then(|| path.to_owned())
}

/// Give a path the extension if it has none that is a format's: what follows the point in
/// "hull v1.2" is part of the name.
pub fn with_extension(path: &Path, extension: &str) -> PathBuf {
    let given = path.extension().map(|given| given.to_string_lossy());
    match (given.as_deref(), path.file_name()) {
        (Some(given), _) if Format::find(given).is_some() => path.to_owned(),
        (Some(""), _) | (None, _) | (_, None) => path.with_extension(extension),
        (Some(_), Some(name)) => {
            let mut name = name.to_owned();
            name.push(".");
            name.push(extension);
            path.with_file_name(name)
        }
    }
}
