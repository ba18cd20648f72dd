//! Opening, saving and exporting; the window only asks for paths.

use std::fmt;
use std::path::{Path, PathBuf};

use super::Editor;
use super::examples;
use super::report::{AfterDiscard, Export, Request};
use crate::document::{Curve, Document, Edit, History};
use crate::geometry::counted;
use crate::io::examples::EXAMPLES;
use crate::io::{FileError, Format, Reading, disk, shown_path};

impl Editor {
    /// Open a file in place of the document. An error becomes the message, and nothing is
    /// changed.
    pub fn open(&mut self, path: &Path) {
        match disk::read_file(path) {
            Ok(reading) => self.replace_by_file(reading, path),
            Err(error) => self.fail(error.to_string()),
        }
    }

    /// Open several files as one document in place of the present one. Only a single project is
    /// saved back to where it came from, with what it says of itself that is not known.
    ///
    /// # Errors
    /// [`FileError`] of the first file that cannot be read; nothing is changed then.
    pub fn open_all(&mut self, paths: &[PathBuf]) -> Result<(), FileError> {
        match paths {
            [] => {}
            [path] => self.replace_by_file(disk::read_file(path)?, path),
            _ => {
                let (curves, remarks) = read_together(paths)?;
                let text = format!(
                    "{} read from {} files",
                    counted(curves.len(), "curve", "curves"),
                    paths.len()
                );
                self.replace(Document::from_curves(curves), None);
                self.say(with_lines(text, &remarks));
            }
        }
        Ok(())
    }

    /// Add the curves of some files to the document, as one step. An error becomes the message,
    /// and nothing is changed.
    pub fn import(&mut self, paths: &[PathBuf]) {
        let (curves, remarks) = match read_together(paths) {
            Ok(read) => read,
            Err(error) => return self.fail(error.to_string()),
        };
        let count = curves.len();
        if self.add_curves("Import curves", curves) {
            self.fit_all();
            let text = format!("{} added", counted(count, "curve", "curves"));
            self.say_done(with_lines(text, &remarks));
        }
    }

    /// Save the document. An error becomes the message. Returns whether it is saved.
    pub fn save(&mut self, path: &Path) -> bool {
        self.commit_field();
        let path = &with_extension(path, Format::Batten.extension());
        match Format::to_write(path) {
            Ok(Format::Batten) => {}
            Ok(other) => {
                self.fail(format!(
                    "{}: a {other} does not hold all of a document: save as .batten, or export",
                    shown_path(path)
                ));
                return false;
            }
            Err(error) => {
                self.fail(format!("{}: {error}", shown_path(path)));
                return false;
            }
        }
        let extras = self.document().extras();
        match disk::write_file(path, &self.curves(), extras, None) {
            Ok(saved) => {
                self.path = Some(path.clone());
                self.history.mark_saved();
                self.say(with_lines(format!("Saved to {}", shown_path(path)), &saved));
                true
            }
            Err(error) => {
                self.fail(error.to_string());
                false
            }
        }
    }

    /// Export the document's visible curves. An error becomes the message, and so does what the
    /// format could not hold.
    pub fn export(&mut self, path: &Path, export: &Export) {
        let path = &with_extension(path, export.extension);
        match Format::to_write(path) {
            Ok(format) if format.extension() == export.extension => {}
            Ok(other) => {
                self.fail(format!(
                    "{}: that would be a {other}: give it the extension .{}",
                    shown_path(path),
                    export.extension
                ));
                return;
            }
            Err(error) => {
                self.fail(format!("{}: {error}", shown_path(path)));
                return;
            }
        }
        let polygon = (export.extension == Format::Csv.extension()).then_some(export.polygon);
        let (shown, hidden): (Vec<Curve>, Vec<Curve>) =
            self.curves().into_iter().partition(|curve| curve.visible);
        if shown.is_empty() {
            self.fail("Every curve is hidden: show what shall be exported");
            return;
        }
        match disk::write_file(path, &shown, self.document().extras(), polygon) {
            Ok(saved) => {
                let count = counted(shown.len(), "curve", "curves");
                let mut text = format!("{count} exported to {}", shown_path(path));
                if !hidden.is_empty() {
                    text += &format!(
                        "; {} not, being hidden",
                        counted(hidden.len(), "curve", "curves")
                    );
                }
                self.say(with_lines(text, &saved));
            }
            Err(error) => self.fail(error.to_string()),
        }
    }

    /// Go on with what was wanted, whether or not there are unsaved changes.
    pub fn discard_and(&mut self, after: AfterDiscard) -> Option<Request> {
        match after {
            AfterDiscard::New => self.replace(Document::default(), None),
            AfterDiscard::Open => return Some(Request::Open),
            AfterDiscard::OpenFile(path) => self.open(&path),
            AfterDiscard::OpenExample(index) => self.open_example(index),
            AfterDiscard::Quit => return Some(Request::Quit),
        }
        None
    }

    /// Ask about unsaved changes if there are any, otherwise go on.
    pub fn confirmed(&mut self, after: AfterDiscard) -> Option<Request> {
        self.commit_field();
        if self.is_modified() {
            Some(Request::ConfirmDiscard(after))
        } else {
            self.discard_and(after)
        }
    }

    pub(super) fn open_example(&mut self, index: usize) {
        let Some(example) = EXAMPLES.get(index) else {
            return;
        };
        match example.curves() {
            Ok(curves) => {
                self.replace(Document::from_curves(curves), None);
                self.say(format!(
                    "{}: {}",
                    examples::title(index),
                    examples::description(index)
                ));
            }
            Err(error) => self.fail(error.to_string()),
        }
    }

    /// Add curves as one step and make the first of them active. An error becomes the message.
    /// Returns whether they were added.
    pub(super) fn add_curves(&mut self, label: &str, curves: Vec<Curve>) -> bool {
        let first = self.document().next_id();
        let edits = curves
            .into_iter()
            .map(|curve| Edit::Add(Box::new(curve)))
            .collect();
        let added = self.apply(label, edits);
        if self.document().curve(first).is_some() {
            self.selection.clear();
            self.selection.activate(first);
        }
        added
    }

    pub(super) fn curves(&self) -> Vec<Curve> {
        let curves = self.document().curves();
        curves.map(|(_, curve)| Curve::clone(curve)).collect()
    }

    fn replace_by_file(&mut self, reading: Reading, path: &Path) {
        let Reading {
            curves,
            extras,
            remarks,
        } = reading;
        let text = format!(
            "{} read from {}",
            counted(curves.len(), "curve", "curves"),
            shown_path(path)
        );
        let document = Document::from_curves(curves).with_extras(extras);
        let keeps = document.has_extras();
        self.replace(document, own_path(path));
        let mut text = with_lines(text, &remarks);
        if keeps {
            text += "\nUnknown keys are kept when you save.";
        }
        self.say(text);
    }

    fn replace(&mut self, document: Document, path: Option<PathBuf>) {
        self.call_off();
        self.history = History::new(document);
        self.path = path;
        self.document_replaced();
    }
}

/// Read the curves of several files, with what there is to tell of each.
fn read_together(paths: &[PathBuf]) -> Result<(Vec<Curve>, String), FileError> {
    let mut curves = Vec::new();
    let mut lines = Vec::new();
    for path in paths {
        let reading = disk::read_file(path)?;
        curves.extend(reading.curves);
        let remarks = reading.remarks.to_string();
        let named = remarks
            .lines()
            .map(|remark| format!("{}: {remark}", shown_path(path)));
        lines.extend(named);
    }
    Ok((curves, lines.join("\n")))
}

/// Add lines to a message, if there are any.
pub(super) fn with_lines(text: String, lines: &impl fmt::Display) -> String {
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
