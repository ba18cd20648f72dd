//! Opening, saving and exporting; the window only asks for paths.

use std::path::{Path, PathBuf};

use super::Editor;
use super::examples;
use super::report::{AfterDiscard, Export, Request};
use crate::document::{Curve, Document, Edit, History};
use crate::io::examples::EXAMPLES;
use crate::io::{FileError, Format, disk};

impl Editor {
    /// Open a file in place of the document. An error becomes the message, and nothing is
    /// changed.
    pub fn open(&mut self, path: &Path) {
        match disk::read_file(path) {
            Ok(curves) => self.replace(curves, own_path(path)),
            Err(error) => self.fail(error.to_string()),
        }
    }

    /// Open several files as one document in place of the present one. Only a single project is
    /// saved back to where it came from.
    ///
    /// # Errors
    /// [`FileError`] of the first file that cannot be read; nothing is changed then.
    pub fn open_all(&mut self, paths: &[PathBuf]) -> Result<(), FileError> {
        let mut curves = Vec::new();
        for path in paths {
            curves.extend(disk::read_file(path)?);
        }
        match paths {
            [] => {}
            [path] => self.replace(curves, own_path(path)),
            _ => self.replace(curves, None),
        }
        Ok(())
    }

    /// Add the curves of some files to the document, as one step. An error becomes the message,
    /// and nothing is changed.
    pub fn import(&mut self, paths: &[PathBuf]) {
        let mut curves = Vec::new();
        for path in paths {
            match disk::read_file(path) {
                Ok(read) => curves.extend(read),
                Err(error) => {
                    self.fail(error.to_string());
                    return;
                }
            }
        }
        let count = curves.len();
        self.add_curves("Import curves", curves);
        self.fit_all();
        self.say(format!("{} added", count_curves(count)));
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
                    path.display()
                ));
                return false;
            }
            Err(error) => {
                self.fail(format!("{}: {error}", path.display()));
                return false;
            }
        }
        match disk::write_file(path, &self.curves(), None) {
            Ok(_) => {
                self.path = Some(path.clone());
                self.history.mark_saved();
                self.say(format!("Saved to {}", path.display()));
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
                    path.display(),
                    export.extension
                ));
                return;
            }
            Err(error) => {
                self.fail(format!("{}: {error}", path.display()));
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
        match disk::write_file(path, &shown, polygon) {
            Ok(losses) => {
                let count = count_curves(shown.len());
                let mut text = format!("{count} exported to {}", path.display());
                if !hidden.is_empty() {
                    text += &format!("; {} not, being hidden", count_curves(hidden.len()));
                }
                if !losses.is_empty() {
                    text = format!("{text}\n{losses}");
                }
                self.say(text);
            }
            Err(error) => self.fail(error.to_string()),
        }
    }

    /// Go on with what was wanted, whether or not there are unsaved changes.
    pub fn discard_and(&mut self, after: AfterDiscard) -> Option<Request> {
        match after {
            AfterDiscard::New => self.replace(Vec::new(), None),
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
                self.replace(curves, None);
                self.say(format!(
                    "{}: {}",
                    examples::title(index),
                    examples::description(index)
                ));
            }
            Err(error) => self.fail(error.to_string()),
        }
    }

    pub(super) fn add_curves(&mut self, label: &str, curves: Vec<Curve>) {
        let first = self.document().next_id();
        let edits = curves
            .into_iter()
            .map(|curve| Edit::Add(Box::new(curve)))
            .collect();
        self.apply(label, edits);
        if self.document().curve(first).is_some() {
            self.selection.clear();
            self.selection.activate(first);
        }
    }

    pub(super) fn curves(&self) -> Vec<Curve> {
        let curves = self.document().curves();
        curves.map(|(_, curve)| Curve::clone(curve)).collect()
    }

    fn replace(&mut self, curves: Vec<Curve>, path: Option<PathBuf>) {
        self.call_off();
        let count = curves.len();
        self.history = History::new(Document::from_curves(curves));
        self.path = path;
        self.document_replaced();
        if let Some(path) = &self.path {
            let text = format!("{} read from {}", count_curves(count), path.display());
            self.say(text);
        }
    }
}

/// The path that a document read from it is saved back to: only a project loses nothing there.
fn own_path(path: &Path) -> Option<PathBuf> {
    let is_project = Format::to_read(path).is_ok_and(|format| format == Format::Batten);
    is_project.then(|| path.to_owned())
}

/// Say "1 curve" or "7 curves".
pub(super) fn count_curves(count: usize) -> String {
    match count {
        1 => "1 curve".to_owned(),
        count => format!("{count} curves"),
    }
}

/// Give a path the extension if it has none at all.
pub fn with_extension(path: &Path, extension: &str) -> PathBuf {
    if path.extension().is_some() {
        path.to_owned()
    } else {
        path.with_extension(extension)
    }
}
