//! The open document: its history, its file, and the one preview.

use std::path::{Path, PathBuf};

use crate::document::{Document, Edit, EditError, History};
use crate::io::Fingerprint;

/// Hold the document with its history, its file and its preview.
///
/// Drags, number fields and operations share one preview: it is begun, updated any number of
/// times from the document as it was then, and committed as one step or aborted.
#[derive(Debug, Default)]
pub struct Workspace {
    history: History,
    path: Option<PathBuf>,
    /// The fingerprint of the file when it was last read or written.
    fingerprint: Option<Fingerprint>,
    /// The fingerprint of the file in the last look since then.
    seen: Option<Fingerprint>,
    preview: Option<Preview>,
    /// How many previews there have been.
    previews: u64,
    /// The number of steps, undos and redos.
    revision: u64,
    /// The number of documents that were opened before.
    opening: u64,
    /// Whether the document is one that the program itself offered.
    is_offered: bool,
}

/// The identity of a preview.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PreviewId(u64);

/// What happens to a preview when something else begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interruption {
    /// It becomes a step, as the value of a number field.
    Commits,
    /// It is cancelled, as an unfinished drag or operation.
    Aborts,
}

#[derive(Clone, Copy, Debug)]
struct Preview {
    id: PreviewId,
    interruption: Interruption,
}

impl Workspace {
    /// Begin with a document that counts as saved, and the file that it is saved back to.
    pub fn new(document: Document, path: Option<PathBuf>) -> Self {
        Self {
            history: History::new(document),
            path,
            ..Self::default()
        }
    }

    /// Replace the document and its history.
    pub fn replace(&mut self, document: Document, path: Option<PathBuf>) {
        *self = Self {
            previews: self.previews,
            revision: self.revision + 1,
            opening: self.opening + 1,
            ..Self::new(document, path)
        };
    }

    /// Put what the document's file holds now in its place, as one step. Without one the file has the bytes that were
    /// last read or written, and nothing was edited since.
    pub fn reload(&mut self, document: Document, fingerprint: Fingerprint) {
        self.interrupt();
        if self.fingerprint == Some(fingerprint) && !self.is_modified() {
            return;
        }
        self.revision += 1;
        self.set_fingerprint(Some(fingerprint));
        self.history.replace("Reload", document);
    }

    /// The document, with the preview.
    pub fn document(&self) -> &Document {
        self.history.document()
    }

    /// The document, without the preview.
    pub fn settled(&self) -> &Document {
        self.history.settled()
    }

    /// Its history.
    pub fn history(&self) -> &History {
        &self.history
    }

    /// The file that the document was opened from or saved to.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Whether there is something to save.
    pub fn is_modified(&self) -> bool {
        self.history.is_modified()
    }

    /// Whether the document has no file and no step yet.
    pub fn is_as_opened(&self) -> bool {
        let history = &self.history;
        let has_steps = history.undo_steps() > 0 || history.redo_label().is_some();
        self.path.is_none() && self.preview.is_none() && !has_steps && !self.is_modified()
    }

    /// Note that the document is one that the program itself offered, such as an example.
    pub fn mark_offered(&mut self) {
        self.is_offered = true;
    }

    /// Whether the user has made nothing yet: the document is empty, or was offered and is as it was.
    pub fn has_nothing_to_keep(&self) -> bool {
        let is_empty = self.settled().is_empty() && self.path.is_none();
        (is_empty || self.is_offered) && self.is_as_opened()
    }

    /// A number that grows with every step, undo and redo.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// A number that tells the document from those that were opened before it.
    pub fn opening(&self) -> u64 {
        self.opening
    }

    /// Whether there is something to save, without the preview.
    pub fn is_settled_modified(&self) -> bool {
        self.history.is_settled_modified()
    }

    /// Note that a state of the document was saved under a path.
    pub fn mark_saved(&mut self, path: PathBuf, saved: Document, fingerprint: Fingerprint) {
        self.path = Some(path);
        self.set_fingerprint(Some(fingerprint));
        self.history.mark_saved(saved);
    }

    /// Count the document as unsaved.
    pub fn mark_unsaved(&mut self) {
        self.history.mark_unsaved();
    }

    /// The fingerprint of the document's file when it was last read or written.
    pub fn fingerprint(&self) -> Option<Fingerprint> {
        self.fingerprint
    }

    /// Set the fingerprint of the document's file, after it was read or written.
    pub fn set_fingerprint(&mut self, fingerprint: Option<Fingerprint>) {
        self.fingerprint = fingerprint;
        self.seen = None;
    }

    /// Note what the document's file holds now. Returns whether another program has changed it since
    /// the last note.
    pub fn note_file(&mut self, found: Fingerprint) -> bool {
        let is_new = self.seen.replace(found) != Some(found);
        is_new && self.fingerprint.is_some_and(|known| known != found)
    }

    /// The preview that runs.
    pub fn preview(&self) -> Option<PreviewId> {
        self.preview.map(|preview| preview.id)
    }

    /// What happens to the running preview when something else begins.
    pub fn interruption(&self) -> Option<Interruption> {
        self.preview.map(|preview| preview.interruption)
    }

    /// Begin a preview; a running one is interrupted.
    pub fn begin(&mut self, label: &str, interruption: Interruption) -> PreviewId {
        self.interrupt();
        self.previews += 1;
        let id = PreviewId(self.previews);
        self.preview = Some(Preview { id, interruption });
        self.history.begin(label);
        id
    }

    /// Show what edits make of the document that the preview began with. Without a preview
    /// nothing is shown.
    ///
    /// # Errors
    /// [`EditError`] of the first edit that cannot be made; what was shown before stays.
    pub fn update(&mut self, edits: Vec<Edit>) -> Result<(), EditError> {
        self.history.preview(edits)
    }

    /// The document that edits would show in the preview.
    ///
    /// # Errors
    /// As [`Workspace::update`].
    pub fn previewed(&self, edits: Vec<Edit>) -> Result<Document, EditError> {
        self.history.previewed(edits)
    }

    /// Try matches as long as it takes that were tried only briefly for what is shown, and show that if it
    /// is `allowed`. Otherwise what is shown is what a commit keeps.
    pub fn take_time(&mut self, allowed: impl FnOnce(&Document) -> bool) {
        self.history.take_time(allowed);
    }

    /// End the preview and keep what it shows as one step. Returns whether there is a step.
    pub fn commit(&mut self) -> bool {
        let made = self.preview.take().is_some() && self.history.commit();
        self.revision += u64::from(made);
        made
    }

    /// End the preview and restore the document that it began with.
    pub fn abort(&mut self) {
        if self.preview.take().is_some() {
            self.history.abort();
        }
    }

    /// End the preview because something else begins. Returns what happened to it, if one ran.
    pub fn interrupt(&mut self) -> Option<Interruption> {
        let ended = self.interruption();
        match ended {
            None => {}
            Some(Interruption::Commits) => {
                self.commit();
            }
            Some(Interruption::Aborts) => self.abort(),
        }
        ended
    }

    /// Make edits as one step. A preview that runs is interrupted.
    ///
    /// # Errors
    /// [`EditError`] of the first edit that cannot be made; none is made then.
    pub fn apply(&mut self, label: &str, edits: Vec<Edit>) -> Result<(), EditError> {
        self.change(|history| history.apply(label, edits))
    }

    /// Make edits as a part of the last step if it bears this label, otherwise as a step of their
    /// own: so that a key that is held makes one step.
    ///
    /// # Errors
    /// [`EditError`] of the first edit that cannot be made; none is made then.
    pub fn extend(&mut self, label: &str, edits: Vec<Edit>) -> Result<(), EditError> {
        self.change(|history| history.extend(label, edits))
    }

    /// Make other edits in place of the last step, from the document before it. Without edits the
    /// step is gone.
    ///
    /// # Errors
    /// [`EditError`] of the first edit that cannot be made; the last step stays then.
    pub fn amend(&mut self, label: &str, edits: Vec<Edit>) -> Result<(), EditError> {
        self.change(|history| history.amend(label, edits))
    }

    /// Take back the last step. Returns its label.
    pub fn undo(&mut self) -> Option<String> {
        self.interrupt();
        self.revision += 1;
        self.history.undo()
    }

    /// Make the last undone step again. Returns its label.
    pub fn redo(&mut self) -> Option<String> {
        self.interrupt();
        self.revision += 1;
        self.history.redo()
    }

    fn change(
        &mut self,
        change: impl FnOnce(&mut History) -> Result<(), EditError>,
    ) -> Result<(), EditError> {
        self.interrupt();
        self.revision += 1;
        change(&mut self.history)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Curve;
    use crate::geometry::FloatPolygon;

    fn workspace() -> Workspace {
        let vertices = [[0.0, 0.0, 0.0], [1.0, 2.0, 0.0], [3.0, 1.0, 0.0]];
        let polygon = FloatPolygon::new(2, vertices.map(Into::into).into(), None, false);
        let curve = Curve::new("arc".to_owned(), polygon.expect("a polygon"));
        Workspace::new(Document::from_curves([curve]), None)
    }

    fn rename(workspace: &Workspace, name: &str) -> Vec<Edit> {
        let curve = workspace.document().ids().next().expect("a curve");
        let name = name.to_owned();
        vec![Edit::Rename { curve, name }]
    }

    fn name(document: &Document) -> &str {
        let (_, curve) = document.curves().next().expect("a curve");
        &curve.name
    }

    /// Begin a preview that shows another name.
    fn trying(interruption: Interruption) -> Workspace {
        let mut workspace = workspace();
        workspace.begin("Try", interruption);
        let edits = rename(&workspace, "tried");
        assert_eq!(workspace.update(edits), Ok(()));
        workspace
    }

    #[test]
    fn what_is_begun_next_keeps_a_field_and_takes_back_a_drag() {
        for (interruption, expected, steps) in [
            (Interruption::Commits, "tried", 2),
            (Interruption::Aborts, "arc", 1),
        ] {
            let mut workspace = trying(interruption);
            let first = workspace.preview();
            assert_ne!(Some(workspace.begin("Next", Interruption::Aborts)), first);
            assert_eq!(name(workspace.settled()), expected);
            let edits = rename(&workspace, "next");
            assert_eq!(workspace.apply("Apply", edits), Ok(()));
            assert_eq!(workspace.preview(), None);
            assert_eq!(workspace.history().undo_steps(), steps);
        }
    }

    #[test]
    fn what_is_tried_is_not_saved() {
        let mut workspace = trying(Interruption::Aborts);
        assert_eq!(name(workspace.document()), "tried");
        assert_eq!(name(workspace.settled()), "arc");
        let settled = workspace.settled().clone();
        workspace.mark_saved("arc.batten".into(), settled, Fingerprint::of(b"arc"));
        assert!(workspace.is_modified() && !workspace.is_settled_modified());
        assert!(workspace.preview().is_some(), "saving ends nothing");
        workspace.abort();
        assert!(!workspace.is_modified());
    }

    #[test]
    fn a_reload_is_a_step_whenever_the_bytes_differ() {
        let mut workspace = workspace();
        let [first, second] = [b"1", b"2"].map(|bytes| Fingerprint::of(bytes));
        workspace.set_fingerprint(Some(first));
        let same = workspace.document().clone();
        workspace.reload(same.clone(), first);
        assert_eq!(workspace.history().undo_steps(), 0);
        workspace.reload(same.clone(), second);
        assert_eq!(workspace.history().undo_steps(), 1);
        assert!(!workspace.is_modified());
        let edits = rename(&workspace, "edited");
        workspace.apply("Rename", edits).expect("a rename");
        workspace.reload(same, second);
        assert_eq!(workspace.history().undo_steps(), 3);
        assert_eq!(name(workspace.document()), "arc");
    }

    #[test]
    fn amending_replaces_the_last_step() {
        let mut workspace = workspace();
        let edits = rename(&workspace, "one");
        workspace.apply("Rename", edits).expect("a rename");
        let revision = workspace.revision();
        let edits = rename(&workspace, "two");
        workspace.amend("Rename", edits).expect("a rename");
        assert_eq!(name(workspace.document()), "two");
        assert_eq!(workspace.history().undo_steps(), 1);
        assert!(workspace.revision() > revision);
        let edits = rename(&workspace, " ");
        assert_eq!(workspace.amend("Rename", edits), Err(EditError::EmptyName));
        assert_eq!(name(workspace.document()), "two");
        workspace.amend("Rename", Vec::new()).expect("no edit");
        assert_eq!(name(workspace.document()), "arc");
        assert_eq!(workspace.history().undo_steps(), 0);
    }
}
