//! Changing the values of an operation: a drag or a field is one change, which undo takes back.

use crate::editor::Editor;
use crate::operations::{OperationError, Value, Values};

impl Editor {
    /// Give the operation that is tried out, or was applied last, another value for a parameter.
    ///
    /// # Errors
    /// As [`Editor::set_values`].
    pub fn set_value(&mut self, parameter: &str, value: Value) -> Result<(), OperationError> {
        self.set_values(&[(parameter, value)])
    }

    /// Give the operation that is tried out, or was applied last, other values for some parameters.
    ///
    /// # Errors
    /// [`OperationError`] if a parameter does not take its value; nothing is changed then.
    pub fn set_values(&mut self, given: &[(&str, Value)]) -> Result<(), OperationError> {
        if self.trial().is_none() {
            return Ok(());
        }
        let Some(trial) = &mut self.operations.trial else {
            return Ok(());
        };
        let (operation, input) = (trial.operation, &trial.input);
        let values = operation.values_with(input, &trial.values, given.iter().cloned())?;
        if values != trial.values {
            let before = std::mem::replace(&mut trial.values, values);
            if trial.held.is_none() {
                trial.earlier.push(before);
            }
            self.ask();
        }
        Ok(())
    }

    /// Begin a change that goes on, such as a drag: what [`Editor::set_values`] sets from now on is one change,
    /// until [`Editor::keep_values`] or [`Editor::restore_values`]. One that is already going on stays.
    pub fn hold_values(&mut self) {
        if let Some(trial) = self.operations.trial.as_mut()
            && trial.held.is_none()
        {
            trial.held = Some(trial.values.clone());
        }
    }

    /// Whether a change of values is going on.
    pub fn holds_values(&self) -> bool {
        self.trial().is_some_and(|trial| trial.held.is_some())
    }

    /// End the change that is going on; its values stay.
    pub fn keep_values(&mut self) {
        if let Some(trial) = &mut self.operations.trial
            && let Some(before) = trial.held.take()
            && before != trial.values
        {
            trial.earlier.push(before);
        }
    }

    /// End the change that is going on, and give the operation the values back that it had.
    pub fn restore_values(&mut self) {
        let trial = self.operations.trial.as_mut();
        if let Some(before) = trial.and_then(|trial| trial.held.take()) {
            self.give_back(before);
        }
    }

    /// Whether undo would take a change of the values back, of the operation that is tried out.
    pub(in crate::editor) fn has_changed_values(&self) -> bool {
        self.trial().is_some_and(|trial| {
            trial.held.is_some() || (!trial.is_applied() && !trial.earlier.is_empty())
        })
    }

    /// Take back the change of values that is going on, or the last one; returns whether there was one.
    pub(in crate::editor) fn undo_values(&mut self) -> bool {
        if !self.has_changed_values() {
            return false;
        }
        if self.end_handle_drag() {
            self.hand.gestures.reset();
        }
        if self.holds_values() {
            self.restore_values();
            return true;
        }
        let trial = self.operations.trial.as_mut();
        if let Some(before) = trial.and_then(|trial| trial.earlier.pop()) {
            self.give_back(before);
        }
        true
    }

    fn give_back(&mut self, before: Values) {
        if let Some(trial) = &mut self.operations.trial
            && trial.values != before
        {
            trial.values = before;
            self.ask();
        }
    }
}
