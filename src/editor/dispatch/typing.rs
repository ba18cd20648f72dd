//! Numbers and points typed on the canvas: they take the place of a click or a drag.

use crate::editor::Editor;
use crate::editor::hand::Entry;
use crate::editor::hand::tools::{self, Transformation, Transformed};
use crate::editor::hand::typed_point::{EntryError, TypedPoint};
use crate::editor::reply::{Note, Refusal, Reply};

impl Editor {
    /// Preview a typed text as far as it can be read: the vertex that it would set, or the rotation or scaling. An
    /// empty text takes the preview back. Returns whether the preview has changed.
    pub fn type_entry(&mut self, text: &str) -> bool {
        let (entry, unit) = (
            self.hand.entry(&self.view.pane.viewport),
            self.document().unit(),
        );
        if let Some(Entry::Angle | Entry::Factor) = entry {
            let typed = self.hand.typed_transformation(text, unit).ok();
            // A drag ends as soon as typing begins: both set the same figure.
            let interrupts = !text.is_empty() || !self.hand.is_dragging();
            return (typed.is_some() || interrupts) && self.type_transformation(typed);
        }
        let is_point = matches!(entry, Some(Entry::Point(_)));
        let typed = TypedPoint::read(text, unit).ok().filter(|_| is_point);
        let before = std::mem::replace(&mut self.hand.typed, typed);
        if before != typed
            && let Some(look) = self.hand.look_at_typed(&self.context())
        {
            self.look(look);
        }
        before != typed
    }

    /// Set the typed vertex, or rotate or scale by the typed figure. A running drag ends.
    ///
    /// # Errors
    /// [`EntryError`] if the text cannot be read or nothing can be done; nothing is changed then.
    pub fn enter(&mut self, text: &str) -> Result<(), EntryError> {
        let unit = self.document().unit();
        match self.hand.entry(&self.view.pane.viewport) {
            Some(Entry::Point(_)) => {
                let typed = TypedPoint::read(text, unit)?;
                if self.previewed_operation().is_some() {
                    self.operating().interrupt();
                }
                let effects =
                    self.with_tools(|tools, context| tools.used_mut().enter(typed, context))?;
                self.hand.typed = None;
                self.message = None;
                self.take_effects(effects, false);
                self.hand.gestures.reset();
                Ok(())
            }
            Some(Entry::Angle | Entry::Factor) => {
                let transformation = self.hand.typed_transformation(text, unit)?;
                self.type_transformation(None);
                let Err(Refusal(reason)) = self.transform(transformation) else {
                    return Ok(());
                };
                // The field shows it.
                self.message = None;
                Err(EntryError::Refused(reason))
            }
            None => Ok(()),
        }
    }

    /// Preview a typed angle or factor, or take the preview back; a running drag ends. Returns whether that changes
    /// anything.
    fn type_transformation(&mut self, typed: Option<Transformation>) -> bool {
        let effects =
            self.with_tools(|tools, context| tools.used_mut().type_number(typed, context));
        let changes = !effects.is_empty();
        if changes {
            self.hand.gestures.reset();
            self.take_effects(effects, false);
        }
        changes
    }

    /// Move, or rotate or scale about the pivot, the selected vertices, or the selected curves and references, as one
    /// step. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if there is nothing to transform.
    pub fn transform(&mut self, transformation: Transformation) -> Reply {
        let context = self.context();
        let taken = Transformed::of(&context);
        let pivot = match transformation {
            Transformation::Move(_) => taken.middle(&context),
            _ => self.hand.pivot(&context),
        };
        let Some(pivot) = pivot else {
            return self.tell(Err(tools::NOTHING_TO_TRANSFORM.into()));
        };
        let label = taken.label_of(transformation);
        let edits = match taken.edits(transformation, pivot, context.viewport) {
            Ok(edits) => edits,
            Err(error) => return self.tell(Err(Refusal(error.to_string()))),
        };
        let staying = context.staying();
        let reply = self.apply(&label, edits);
        if reply.is_ok() && !matches!(transformation, Transformation::Move(_)) {
            self.hand.settings.turned = Some((pivot, self.hand.selection.clone()));
        }
        match staying {
            Some(staying) if reply.is_ok() => self.tell(Ok(Note::done(staying))),
            _ => reply,
        }
    }
}
