//! Undo and redo: labelled snapshots of the document.

use std::collections::BTreeSet;

use super::curve::CurveId;
use super::document::Document;
use super::edit::Edit;
use super::error::EditError;

/// Hold the document with every state it can be taken back to.
///
/// A preview (of a drag, a typed field, an operation) is begun, shown any number of times, and
/// committed as one step or aborted; each time starts from the state at the beginning, so nothing
/// drifts and an abort restores it bit for bit. A match that cannot be met may take long to try: where
/// one was not met a moment ago, it is tried only briefly until the preview is committed.
#[derive(Clone, Debug, Default)]
pub struct History {
    document: Document,
    saved: Document,
    /// Whether the last saved state is unknown.
    unsaved: bool,
    undo: Vec<Step>,
    redo: Vec<Step>,
    preview: Option<Preview>,
}

/// A preview on a state of the document.
#[derive(Clone, Debug)]
struct Preview {
    step: Step,
    /// The previewed edits.
    edits: Vec<Edit>,
    /// The curves that miss a match in the previewed document.
    unmet: BTreeSet<CurveId>,
    /// Whether the preview tried matches only briefly.
    hasty: bool,
}

/// A state of the document with the label of the step from it.
#[derive(Clone, Debug)]
struct Step {
    label: String,
    document: Document,
}

impl History {
    /// Begin with a document that counts as saved.
    pub fn new(document: Document) -> Self {
        Self {
            saved: document.clone(),
            document,
            ..Self::default()
        }
    }

    /// The document as it is now, with the preview.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// Begin a preview; one that still runs is committed first.
    pub fn begin(&mut self, label: impl Into<String>) {
        self.commit();
        let step = Step {
            label: label.into(),
            document: self.document.clone(),
        };
        self.preview = Some(Preview {
            step,
            edits: Vec::new(),
            unmet: self.document.unmet(),
            hasty: false,
        });
    }

    /// The document as it was when the running preview began; as it is now if none runs.
    pub fn settled(&self) -> &Document {
        let preview = self.preview.as_ref();
        preview.map_or(&self.document, |preview| &preview.step.document)
    }

    /// What `edits` would show.
    ///
    /// # Errors
    /// As [`History::preview`].
    pub fn previewed(&self, edits: Vec<Edit>) -> Result<Document, EditError> {
        match &self.preview {
            Some(preview) => preview.step.document.edited_hastily(edits, &preview.unmet),
            None => self.document.edited(edits),
        }
    }

    /// Show what `edits` make of the document that the preview began with. Without one there is
    /// nothing to go back to, and nothing is shown.
    ///
    /// # Errors
    /// [`EditError`] of the first edit that cannot be made; what was shown last stays.
    pub fn preview(&mut self, edits: Vec<Edit>) -> Result<(), EditError> {
        let Some(preview) = &mut self.preview else {
            return Ok(());
        };
        let before = &preview.step.document;
        self.document = before.edited_hastily(edits.clone(), &preview.unmet)?;
        preview.hasty = !preview.unmet.is_empty();
        preview.unmet = self.document.unmet();
        preview.edits = edits;
        Ok(())
    }

    /// Try matches as long as it takes that were tried only briefly for what is shown, and show that if it
    /// is `allowed`. Otherwise what is shown is what a commit keeps.
    pub fn take_time(&mut self, allowed: impl FnOnce(&Document) -> bool) {
        let Some(preview) = self.preview.as_mut().filter(|preview| preview.hasty) else {
            return;
        };
        preview.hasty = false;
        let tried = preview.step.document.edited(preview.edits.clone());
        if let Some(document) = tried.ok().filter(allowed) {
            self.document = document;
        }
    }

    /// End the preview and keep what it shows as one step. Returns whether there is a step: a
    /// preview that changed nothing, or came back to where it began, leaves none.
    pub fn commit(&mut self) -> bool {
        self.take_time(|_| true);
        let Some(Preview { step, .. }) = self.preview.take() else {
            return false;
        };
        if self.document.is_same(&step.document) {
            // Equal is not the same: a zero may have changed its sign.
            self.document = step.document;
            return false;
        }
        self.undo.push(step);
        self.redo.clear();
        true
    }

    /// End the preview and restore the document that it began with.
    pub fn abort(&mut self) {
        if let Some(Preview { step, .. }) = self.preview.take() {
            self.document = step.document;
        }
    }

    /// Make some edits as one step.
    ///
    /// # Errors
    /// [`EditError`] of the first edit that cannot be made; none is made then.
    pub fn apply(&mut self, label: impl Into<String>, edits: Vec<Edit>) -> Result<(), EditError> {
        self.begin(label);
        let result = self.preview(edits);
        match result {
            Ok(()) => {
                self.commit();
            }
            Err(_) => self.abort(),
        }
        result
    }

    /// Make some edits as a part of the last step if it bears this label and nothing was undone
    /// since, otherwise as a step of their own: so that a key that is held makes one step.
    ///
    /// # Errors
    /// [`EditError`] of the first edit that cannot be made; none is made then.
    pub fn extend(&mut self, label: &str, edits: Vec<Edit>) -> Result<(), EditError> {
        let goes_on = self.redo.is_empty()
            && self.preview.is_none()
            && self.undo.last().is_some_and(|step| step.label == label);
        let steps = self.undo.len();
        self.apply(label, edits)?;
        if goes_on && self.undo.len() > steps {
            // The state in between is no longer one to go back to.
            self.undo.pop();
        }
        Ok(())
    }

    /// Make other edits in place of the last step, from the document before it; without edits, or
    /// if they change nothing, the step is gone. What was undone cannot be made again.
    ///
    /// # Errors
    /// [`EditError`] of the first edit that cannot be made; the last step stays then.
    pub fn amend(&mut self, label: &str, edits: Vec<Edit>) -> Result<(), EditError> {
        self.commit();
        let Some(last) = self.undo.pop() else {
            return self.apply(label, edits);
        };
        let amended = std::mem::replace(&mut self.document, last.document.clone());
        let result = self.apply(label, edits);
        if result.is_err() {
            self.document = amended;
            self.undo.push(last);
        }
        result
    }

    /// Put another document in this one's place, as one step even if both look the same: it counts as saved. A
    /// preview is aborted.
    pub fn replace(&mut self, label: impl Into<String>, document: Document) {
        self.abort();
        self.saved = document.clone();
        self.unsaved = false;
        let label = label.into();
        let document = std::mem::replace(&mut self.document, document);
        self.undo.push(Step { label, document });
        self.redo.clear();
    }

    /// Take back the last step, or abort the running preview. Returns its label.
    pub fn undo(&mut self) -> Option<String> {
        if let Some(Preview { step, .. }) = self.preview.take() {
            self.document = step.document;
            return Some(step.label);
        }
        let step = self.undo.pop()?;
        let label = step.label.clone();
        self.redo.push(Step {
            label: step.label,
            document: std::mem::replace(&mut self.document, step.document),
        });
        Some(label)
    }

    /// Make the last undone step again. Returns its label.
    pub fn redo(&mut self) -> Option<String> {
        if self.preview.is_some() {
            return None;
        }
        let step = self.redo.pop()?;
        let label = step.label.clone();
        self.undo.push(Step {
            label: step.label,
            document: std::mem::replace(&mut self.document, step.document),
        });
        Some(label)
    }

    /// The document before the last steps that bear such labels; as it is now if the last step does not.
    pub fn before(&self, labels: &[&str]) -> &Document {
        let steps = self.undo.iter().rev();
        let steps = steps.take_while(|step| labels.contains(&step.label.as_str()));
        steps.last().map_or(&self.document, |step| &step.document)
    }

    /// The label of the step that undo would take back.
    pub fn undo_label(&self) -> Option<&str> {
        let preview = self.preview.as_ref().map(|preview| &preview.step);
        let step = preview.or(self.undo.last());
        step.map(|step| step.label.as_str())
    }

    /// The label of the step that redo would make again.
    pub fn redo_label(&self) -> Option<&str> {
        self.redo.last().map(|step| step.label.as_str())
    }

    /// The number of steps that can be taken back.
    pub fn undo_steps(&self) -> usize {
        self.undo.len()
    }

    /// Whether the document differs from the one last saved or opened.
    pub fn is_modified(&self) -> bool {
        self.is_unsaved(&self.document)
    }

    /// Whether the document without what a running preview shows differs from the one last saved or
    /// opened.
    pub fn is_settled_modified(&self) -> bool {
        self.is_unsaved(self.settled())
    }

    /// Count a state of the document as saved.
    pub fn mark_saved(&mut self, saved: Document) {
        self.saved = saved;
        self.unsaved = false;
    }

    /// Count the document as modified, whatever is undone, until it is saved.
    pub fn mark_unsaved(&mut self) {
        self.unsaved = true;
    }

    fn is_unsaved(&self, document: &Document) -> bool {
        self.unsaved || !document.is_same(&self.saved)
    }
}
