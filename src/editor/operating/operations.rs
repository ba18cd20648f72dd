//! The course of an operation: preview, apply, change its values, leave it.

use crate::document::{CurveId, Document};
use crate::editor::hand::Hand;
use crate::editor::jobs::Client;
use crate::editor::jobs::patience::Patience;
use crate::editor::reply::{Message, Note, Refusal, Reply};
use crate::editor::selection::Selection;
use crate::editor::view::{Look, View};
use crate::editor::workspace::{Interruption, Workspace};
use crate::geometry::{Nearest, Progress};
use crate::operations::{
    FeatureComparison, Inputs, Operands, Operation, OperationError, Value, Values,
};

use super::end_fit_step::EndFitStep;
use super::fitted_points::FittedPoints;
use super::in_progress::{OperationInProgress, Run, Stage};

const HELD_BACK: &str = "Not applied yet: look at the warning, Enter applies";

/// Hold the operation in progress and run it beside the frame.
#[derive(Debug, Default)]
pub(in crate::editor) struct Operations {
    client: Client<(), JobResult>,
    /// Measures how far points are from the curves that are shown.
    pub(super) measuring: Client<(), Vec<Nearest>>,
    pub(super) operation: Option<OperationInProgress>,
}

/// The result of a job: a run, then the proof of its features.
#[derive(Debug)]
enum JobResult {
    Run(Box<Result<Run, OperationError>>),
    /// Of the item whose report is shown, and of the others.
    Features(Vec<Option<FeatureComparison>>),
}

/// The operations with the parts of the editor that they change.
#[derive(Debug)]
pub struct Operating<'a> {
    pub(in crate::editor) operations: &'a mut Operations,
    pub(in crate::editor) workspace: &'a mut Workspace,
    pub(in crate::editor) hand: &'a mut Hand,
    pub(in crate::editor) view: &'a mut View,
    pub(in crate::editor) patience: &'a mut Patience,
    pub(in crate::editor) message: &'a mut Option<Message>,
}

impl Operations {
    /// Run operations on a thread, which calls `wake` when a result is there.
    pub fn background(wake: impl Fn() + Clone + Send + 'static) -> Self {
        Self {
            client: Client::background("operations", wake.clone()),
            measuring: Client::background("points", wake),
            operation: None,
        }
    }

    /// The operation that is previewed or was applied last, unless something else was done since.
    pub fn current(
        &self,
        workspace: &Workspace,
        active: Option<CurveId>,
    ) -> Option<&OperationInProgress> {
        self.operation.as_ref().filter(|it| match it.stage {
            Stage::Previewed(preview) => workspace.preview() == Some(preview),
            Stage::Applied { revision, .. } => {
                workspace.revision() == revision
                    && workspace.preview().is_none()
                    && it.belongs_to(active, workspace.document())
            }
        })
    }

    /// The share of the running job that is done, from 0 to 1; `None` without one.
    pub fn progress(&self) -> Option<f64> {
        self.client.progress()
    }
}

impl Operating<'_> {
    /// The operation in progress.
    pub(super) fn current(&self) -> Option<&OperationInProgress> {
        let active = self.hand.selection.active();
        self.operations.current(self.workspace, active)
    }

    /// The operation in progress, to be changed.
    pub(super) fn current_mut(&mut self) -> Option<&mut OperationInProgress> {
        self.current()?;
        self.operations.operation.as_mut()
    }

    /// The operation that is previewed.
    pub(super) fn previewed(&self) -> Option<&OperationInProgress> {
        self.current().filter(|it| !it.is_applied())
    }

    /// Apply an operation with some values, now or once its run is finished. A preview that is open
    /// must be ended before.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot run or does not reach its aim; nothing is changed then.
    pub(in crate::editor) fn apply_at_once(
        &mut self,
        operation: &'static Operation,
        input: Result<Operands, OperationError>,
        given: &[(&str, Value)],
        end_fit: Option<EndFitStep>,
    ) -> Reply {
        let begun = self.preview(operation, input, given, end_fit);
        let is_unseen = self.previewed().is_some_and(|it| it.is_unseen(&[]));
        if begun.is_ok() && end_fit.is_some() && is_unseen {
            return Ok(held_back());
        }
        let reply = begun.and_then(|()| self.settle());
        if reply.is_err() {
            self.leave();
        }
        reply
    }

    /// Tell of an operation that was not applied before the reply of the one that runs now.
    pub(in crate::editor) fn tell_first(&mut self, lost: Note) {
        if let Some(current) = self.current_mut().filter(|it| it.pending) {
            current.lost = lost;
        }
    }

    /// Apply the operation that is previewed, now or once its run is finished. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if it does not reach its aim.
    pub fn apply(&mut self) -> Reply {
        if self.previewed().is_none() {
            return Ok(Note::silent());
        }
        self.let_go();
        let settled = self.settle();
        let waits = self.previewed().is_some_and(|it| it.is_waiting_to_apply());
        let reply = match waits {
            true => Ok(Note::told("Applies when ready; Esc cancels")),
            false => settled,
        };
        self.tell(&reply);
        reply
    }

    /// Cancel the preview with the selection and the view before it, or forget the operation that was applied last. The
    /// view stays where the user has turned it.
    pub fn leave(&mut self) {
        let framings = self.previewed().map(|it| it.framings.clone());
        self.end();
        if let Some((before, Some(own))) = framings
            && own.sees_as(&self.view.framing())
        {
            self.view.restore(before);
        }
    }

    /// End the preview with the selection before it, or forget the operation that was applied last.
    fn end(&mut self) {
        let previews = self.previewed().is_some();
        if previews {
            self.workspace.abort();
        }
        self.operations.client.forget();
        self.operations.measuring.forget();
        let is_held_back = self.message.as_ref().is_some_and(|it| it.text == HELD_BACK);
        if previews && is_held_back {
            *self.message = None;
        }
        // A preview that something else has ended has nothing to restore.
        if let Some(left) = self.operations.operation.take()
            && previews
        {
            self.hand.selection = left.selection;
        }
        self.document_changed();
    }

    /// Cancel the preview because something else begins. The selection stays if all vertices have the
    /// numbers that they had before.
    pub(in crate::editor) fn interrupt(&mut self) {
        let numbers = |document: &Document| -> Vec<(CurveId, usize)> {
            let curves = document.curves();
            let counts = curves.map(|(id, curve)| (id, curve.polygon.vertices().len()));
            counts.collect()
        };
        if numbers(self.workspace.settled()) == numbers(self.workspace.document()) {
            self.leave_selecting(self.hand.selection.clone());
        } else {
            self.end();
        }
    }

    /// Cancel the preview if another curve is active now.
    pub(in crate::editor) fn leave_stale(&mut self) {
        let active = self.hand.selection.active();
        let document = self.workspace.document();
        let previewed = self.previewed();
        if previewed.is_some_and(|it| !it.belongs_to(active, document)) {
            self.leave_selecting(self.hand.selection.clone());
        }
    }

    fn leave_selecting(&mut self, selection: Selection) {
        self.end();
        self.hand.selection = selection;
        self.document_changed();
    }

    /// Take the results of background jobs. Call this once a frame.
    pub(in crate::editor) fn receive(&mut self) {
        self.operations.client.receive();
        self.take_result();
        self.show_best();
        self.operations.measuring.receive();
        self.take_distances();
    }

    /// Stop the search that runs: the best found so far becomes its result. An operation that does not search for a
    /// limited time goes on.
    pub fn stop(&mut self) {
        if let Some(current) = self.current_mut().filter(|it| it.can_be_stopped()) {
            current.stops = true;
            self.operations.client.watched().inspect(|it| it.stop());
        }
    }

    /// Show in the preview the best that the search has found so far.
    fn show_best(&mut self) {
        let Some(current) = self.previewed().filter(|it| it.pending) else {
            return;
        };
        let watched = self.operations.client.watched();
        let Some(best) = watched.and_then(Progress::take_shown) else {
            return;
        };
        // A whole result of other values is better than a part of the new one.
        if best.len() < current.points.curves && current.finished().is_some() {
            return;
        }
        let (input, values) = (&current.input, &current.values);
        let edits = current.operation.edits_of_best(input, values, best);
        // What cannot be shown is no fault of the user: the result tells what is wrong.
        if self.workspace.update(edits).is_ok() {
            self.document_changed();
            self.activate_made(false);
            self.measure_points();
        }
    }

    /// Change the values of some parameters.
    ///
    /// # Errors
    /// [`OperationError`] if a parameter does not take its value; nothing is changed then.
    pub fn set_values(&mut self, given: &[(&str, Value)]) -> Result<(), OperationError> {
        let Some(current) = self.current_mut() else {
            return Ok(());
        };
        let (operation, input) = (current.operation, &current.input);
        let values = operation.values_with(input, &current.values, given.iter().cloned())?;
        if values != current.values {
            let before = std::mem::replace(&mut current.values, values);
            if current.held.is_none() {
                current.earlier.push(before);
            }
            self.request_run();
        }
        Ok(())
    }

    /// Let the operation in progress take another second curve, with its present values. Why it cannot run on that
    /// is told; nothing is changed then.
    pub fn choose_second(&mut self, second: CurveId) {
        let refused = self.take_second(second).err();
        let refused = refused.map(|error| Refusal(error.to_string()));
        Message::tell_update(self.message, refused);
    }

    fn take_second(&mut self, second: CurveId) -> Result<(), OperationError> {
        let Some(current) = self.current_mut() else {
            return Ok(());
        };
        let operation = current.operation;
        let document = current.input.document();
        let input = Operands::choose(document, operation.inputs, current.curve(), &[second])?;
        operation.check(&input)?;
        current.values = operation.values_with(&input, &current.values, [])?;
        current.input = input;
        self.request_run();
        Ok(())
    }

    /// Begin a change that goes on, such as a drag: all values set from now on are one change, until
    /// [`Operating::keep_values`] or [`Operating::restore_values`]. A change in progress stays.
    pub fn hold_values(&mut self) {
        if let Some(current) = &mut self.operations.operation {
            current.held.get_or_insert_with(|| current.values.clone());
        }
    }

    /// End the change in progress with its values.
    pub fn keep_values(&mut self) {
        if let Some(current) = &mut self.operations.operation
            && let Some(before) = current.held.take()
            && before != current.values
        {
            current.earlier.push(before);
        }
    }

    /// End the change in progress with the values before it.
    pub fn restore_values(&mut self) {
        let operation = self.operations.operation.as_mut();
        if let Some(before) = operation.and_then(|it| it.held.take()) {
            self.give_back(before);
        }
    }

    /// Take back the change of values in progress, or the last one. Returns whether there was one.
    pub(in crate::editor) fn undo_values(&mut self) -> bool {
        let current = self.current();
        if !current.is_some_and(OperationInProgress::has_changed_values) {
            return false;
        }
        self.let_go();
        let operation = self.operations.operation.as_mut();
        if let Some(before) = operation.and_then(|it| it.held.take().or_else(|| it.earlier.pop())) {
            self.give_back(before);
        }
        true
    }

    fn give_back(&mut self, before: Values) {
        if let Some(current) = &mut self.operations.operation
            && current.values != before
        {
            current.values = before;
            self.request_run();
        }
    }

    /// End the drag of a handle; the gesture goes on without it.
    fn let_go(&mut self) {
        if self.end_handle_drag() {
            self.hand.gestures.reset();
        }
    }

    /// Preview an operation with some values, and run it. A preview that is open must be ended before.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot run; nothing is changed then.
    pub(in crate::editor) fn preview(
        &mut self,
        operation: &'static Operation,
        input: Result<Operands, OperationError>,
        given: &[(&str, Value)],
        end_fit: Option<EndFitStep>,
    ) -> Result<(), Refusal> {
        let prepared = input.and_then(|input| {
            let values = operation.values(&input, given.iter().cloned())?;
            Ok((input, values))
        });
        let (input, values) = prepared.map_err(|error| Refusal(error.to_string()))?;
        let preview = self.workspace.begin(operation.label, Interruption::Aborts);
        self.operations.operation = Some(OperationInProgress {
            operation,
            input,
            values,
            stage: Stage::Previewed(preview),
            selection: self.hand.selection.clone(),
            framings: (self.view.framing(), None),
            run: None,
            pending: false,
            stops: false,
            has_made: false,
            features: None,
            handles: Vec::new(),
            dragged: None,
            points: FittedPoints::default(),
            held: None,
            earlier: Vec::new(),
            applies: false,
            lost: Note::silent(),
            end_fit,
        });
        self.request_run();
        Ok(())
    }

    /// Run the operation with its present values, and wait a moment for the result.
    fn request_run(&mut self) {
        let Operations {
            client, operation, ..
        } = &mut *self.operations;
        let Some(current) = operation else {
            return;
        };
        // What was to be applied was the result of other values.
        let changed = current.changed();
        if changed.warns {
            *self.message = Message::of(&Ok(changed));
        }
        current.pending = true;
        current.stops = false;
        current.applies = false;
        current.update_points();
        let operation = current.operation;
        let (input, values) = (current.input.clone(), current.values.clone());
        let job = move |progress: &Progress| {
            let run = Run::new(operation, &input, &values, progress);
            Some(JobResult::Run(Box::new(run)))
        };
        client.start((), job, Some(self.patience));
        self.take_result();
    }

    /// Prove the features before and afterwards.
    fn request_features(&mut self) {
        let Operations {
            client, operation, ..
        } = &mut *self.operations;
        let Some(current) = operation else {
            return;
        };
        let Some(run) = current.finished() else {
            return;
        };
        let own = (Some(run.input.clone()), Some(run.outcome.clone()));
        let others = run.others.iter().map(|other| {
            let outcome = other
                .result
                .as_ref()
                .ok()
                .map(|(outcome, _)| outcome.clone());
            (other.input.clone(), outcome)
        });
        let all: Vec<_> = [own].into_iter().chain(others).collect();
        let job = move |progress: &Progress| {
            let features = all.iter().map(|(input, outcome)| {
                FeatureComparison::prove(input.as_ref()?, outcome.as_ref()?, progress)
            });
            Some(JobResult::Features(features.collect()))
        };
        client.go_on(job, Some(self.patience));
        self.take_result();
    }

    /// Take the result of the newest job, unless something else was done since.
    fn take_result(&mut self) {
        if self.current().is_none() {
            return;
        }
        if let Some(panic) = self.operations.client.failure() {
            let failed = format!("The operation failed: {panic}. Nothing was changed");
            self.leave();
            *self.message = Message::of(&Err(Refusal(failed)));
            return;
        }
        match self.operations.client.take_result() {
            Some(JobResult::Run(run)) => self.take_run(*run),
            Some(JobResult::Features(features)) => self.take_features(features),
            None => {}
        }
    }

    fn take_run(&mut self, run: Result<Run, OperationError>) {
        let Some(current) = &mut self.operations.operation else {
            return;
        };
        let succeeds = run.as_ref().is_ok_and(Run::succeeds);
        let is_first_result = current.run.is_none();
        // The handles of the last success lead back to one.
        if let Ok(run) = &run {
            current.handles.clone_from(&run.outcome.handles);
        }
        let seen = current
            .finished()
            .map(|run| run.warnings().cloned().collect());
        let seen: Vec<String> = seen.unwrap_or_default();
        current.run = Some(run);
        current.pending = false;
        let holds_back = current.applies && current.is_unseen(&seen);
        current.applies &= !holds_back;
        let applies = current.applies;
        match current.stage {
            Stage::Previewed(_) => {
                self.show_run();
                self.activate_made(is_first_result);
            }
            Stage::Applied { steps, .. } => {
                // A run that fails leaves the applied step as it is.
                if succeeds {
                    self.amend(steps);
                }
                let reply = self.reply();
                *self.message = Message::of(&reply);
            }
        }
        self.measure_points();
        if applies {
            let reply = self.settle();
            self.tell(&reply);
        }
        if holds_back {
            *self.message = Message::of(&Ok(held_back()));
        }
        if succeeds {
            self.request_features();
        }
    }

    /// Show the reply of what was applied where it was asked for: in the end-fit panel, or as a message.
    fn tell(&mut self, reply: &Reply) {
        let current = self.operations.operation.as_mut();
        let is_done = |current: &&mut OperationInProgress| !current.is_waiting_to_apply();
        match current
            .filter(is_done)
            .and_then(|current| current.end_fit.take())
        {
            Some(step) => self.keep_end_fit_action(step, reply),
            None => *self.message = Message::of(reply),
        }
    }

    /// Complete the report, and what was told of it: features are proved after the step is done.
    fn take_features(&mut self, features: Vec<Option<FeatureComparison>>) {
        let told = self.reply();
        let Some(current) = &mut self.operations.operation else {
            return;
        };
        let Some(Ok(run)) = &mut current.run else {
            return;
        };
        let mut features = features.into_iter();
        run.report.features = features.next().flatten();
        current.features.clone_from(&run.report.features);
        for (other, features) in run.others.iter_mut().zip(features) {
            if let Ok((_, report)) = &mut other.result {
                report.features = features;
            }
        }
        let reply = self.reply();
        if *self.message == Message::of(&told) {
            *self.message = Message::of(&reply);
        }
        let last = self.hand.settings.last_end_fit.as_mut();
        if let Some(last) = last.filter(|last| last.reply == told) {
            last.reply = reply;
        }
    }

    /// Keep an action of the end-fit panel with its reply, for the panel.
    pub(in crate::editor) fn keep_end_fit_action(&mut self, step: EndFitStep, reply: &Reply) {
        let active = self.hand.selection.active();
        let curve = active.and_then(|id| Some((id, &**self.workspace.document().curve(id)?)));
        if let Some(curve) = curve {
            let report = self.current().and_then(OperationInProgress::report);
            let revision = self.workspace.revision();
            let last = step.last_action(curve, revision, reply, report);
            self.hand.settings.last_end_fit = Some(last);
        }
    }

    /// Show the last run in the preview.
    fn show_run(&mut self) {
        let operation = self.operations.operation.as_ref();
        let run = operation.and_then(OperationInProgress::finished);
        let edits = run.map_or_else(Vec::new, Run::edits);
        let updated = self.workspace.update(edits);
        Message::tell_update(self.message, updated.err().map(Refusal::from));
        self.document_changed();
    }

    /// Put the last run in place of the applied step, which comes after `steps` others.
    fn amend(&mut self, steps: usize) {
        let Some(current) = &mut self.operations.operation else {
            return;
        };
        let Some(run) = current.finished() else {
            return;
        };
        let (label, edits) = (current.operation.label, run.edits());
        let amended = if self.workspace.history().undo_steps() > steps {
            self.workspace.amend(label, edits)
        } else {
            self.workspace.apply(label, edits)
        };
        Message::tell_update(self.message, amended.err().map(Refusal::from));
        let revision = self.workspace.revision();
        current.stage = Stage::Applied { revision, steps };
        self.document_changed();
    }

    /// The reply that tells of the last run.
    fn reply(&self) -> Reply {
        let current = self.operations.operation.as_ref();
        let lost = current.map_or_else(Note::silent, |it| it.lost.clone());
        lost.before(match current.and_then(|it| it.run()) {
            Some(Ok(run)) if run.succeeds() => Ok(Note {
                warns: run.warns(),
                offers_undo: self.has_made_step(),
                ..Note::told(match run.changes_nothing() {
                    true => format!("Nothing is changed. {}", run.told(self.workspace.settled())),
                    false => run.told(self.workspace.settled()),
                })
            }),
            Some(Ok(run)) => Err(Refusal(run.report.summary())),
            Some(Err(error)) => Err(Refusal(error.to_string())),
            None => Ok(Note::silent()),
        })
    }

    /// Whether the operation that was applied last changed something: else Undo would take back the step before.
    fn has_made_step(&self) -> bool {
        let undone = self.workspace.history().undo_steps();
        let operation = self.operations.operation.as_ref();
        operation
            .is_some_and(|it| matches!(it.stage, Stage::Applied { steps, .. } if undone > steps))
    }

    /// Apply the last run, now or once the pending one is finished; or say why it cannot be applied.
    fn settle(&mut self) -> Reply {
        let Some(current) = &mut self.operations.operation else {
            return Ok(Note::silent());
        };
        current.applies = current.pending;
        if current.pending {
            return Ok(Note::silent());
        }
        current.dragged = None;
        current.held = None;
        let Some(run) = current.finished().filter(|run| run.succeeds()) else {
            return self.reply();
        };
        let renumbers = run.renumbers();
        let steps = self.workspace.history().undo_steps();
        self.workspace.commit();
        let revision = self.workspace.revision();
        current.stage = Stage::Applied { revision, steps };
        if renumbers {
            self.hand.selection.clear();
        }
        self.document_changed();
        self.reply()
    }

    /// Make a new curve the active one, compare it with the other new curve, or with the reference or
    /// the curve that it follows, and bring it into sight the first time; the comb suits the first result too.
    fn activate_made(&mut self, is_first_result: bool) {
        let Some(current) = self.current() else {
            return;
        };
        let made = current.made_curves(self.workspace.document());
        let Some(first) = made.first() else {
            return;
        };
        let inputs = current.operation.inputs;
        let follows = matches!(
            inputs,
            Inputs::OneOrNone | Inputs::Points | Inputs::References
        );
        let (followed, was_active) = (current.curve(), current.selection.active());
        let is_first = match &mut self.operations.operation {
            Some(current) => !std::mem::replace(&mut current.has_made, true),
            None => false,
        };
        let selection = &mut self.hand.selection;
        let active = match selection.active().filter(|id| made.contains(id)) {
            Some(active) => active,
            None => {
                selection.activate(*first);
                *first
            }
        };
        let mut others = made.iter().copied().filter(|id| *id != active);
        let compared = self.view.compared(active);
        // Copies of a curve are no two solutions, nor are curves in the place of several references.
        if ![Inputs::One, Inputs::References].contains(&inputs)
            && compared.is_none_or(|id| !others.clone().any(|other| other == id))
            && let Some(other) = others.next()
        {
            self.view.compare(active, Some(other));
        }
        if is_first && follows {
            let document = self.workspace.document();
            let reference = was_active.filter(|id| document.reference(*id).is_some());
            if let Some(other) = reference.or(followed) {
                self.view.compare(active, Some(other));
            }
        }
        // A curve lies where its points are, though its vertices may be far away.
        let is_alone = made.len() == self.workspace.document().curves().count();
        let look = match self.sees_points() {
            false if is_first => Look::New(made),
            true if is_alone && (is_first || is_first_result) => Look::ResetComb,
            _ => Look::SuitComb,
        };
        let layers = self.hand.layers(self.view.layers);
        let shown = self.hand.shown(self.workspace, layers);
        let framing = self.view.framing();
        self.view.look(look, shown);
        if let Some(current) = &mut self.operations.operation {
            let own = &mut current.framings.1;
            if own.as_ref().is_none_or(|own| own.sees_as(&framing)) {
                *own = Some(self.view.framing());
            }
        }
    }

    /// Deselect vertices that the document no longer has.
    fn document_changed(&mut self) {
        self.hand.selection.retain_valid(self.workspace.document());
    }
}

/// What is told of a result that waits because of its warnings.
fn held_back() -> Note {
    Note::told(HELD_BACK).warning()
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;
    use std::sync::mpsc::{Receiver, Sender, channel};
    use std::time::Duration;

    use glam::DVec3;

    use super::*;
    use crate::document::Curve;
    use crate::editor::Editor;
    use crate::geometry::end_correction::EndTarget;
    use crate::geometry::{End, FloatPolygon};
    use crate::operations::{Outcome, translate_end};

    /// Longer than any job here takes.
    const LONG: Duration = Duration::from_secs(60);

    /// Says that a run begins, and what holds it; the first run takes both.
    static HELD: Mutex<Option<(Sender<()>, Receiver<()>)>> = Mutex::new(None);

    /// Translate an end; the run that is held panics.
    static OPERATION: Operation = Operation {
        name: "translate-end-or-panic",
        run: panic_if_held,
        ..translate_end::OPERATION
    };

    fn panic_if_held(
        input: &Operands,
        values: &Values,
        progress: &Progress,
    ) -> Result<Outcome, OperationError> {
        let held = HELD.lock().expect("channels").take();
        if let Some((begins, held)) = held {
            begins.send(()).expect("the test waits");
            held.recv().expect("the test lets go");
            panic!("on purpose");
        }
        (translate_end::OPERATION.run)(input, values, progress)
    }

    #[test]
    fn a_panic_in_an_outdated_run_leaves_the_newer_preview_alone() {
        let points = [(0.0, 0.0), (1.0, 2.0), (3.0, 3.0), (5.0, 2.0), (6.0, 0.0)];
        let polygon = FloatPolygon::planar(2, &points).expect("a polygon");
        let mut curve = Curve::new("arc", polygon);
        let target = DVec3::new(-1.0, 0.5, 0.0);
        for end in End::BOTH {
            let target = EndTarget {
                point: target,
                ..EndTarget::default()
            };
            curve.targets.set(end, Some(target));
        }
        let mut editor = Editor::with_document(Document::from_curves([curve]));
        let (sender, woken) = channel();
        editor.run_in_background(Duration::ZERO, move || sender.send(()).unwrap_or_default());
        let (begins, begun) = channel();
        let (lets_go, held) = channel();
        *HELD.lock().expect("channels") = Some((begins, held));
        editor.preview_operation(&OPERATION).expect("a preview");
        begun.recv_timeout(LONG).expect("the run begins");

        let [parameter] = OPERATION.parameters else {
            panic!("which end is the only parameter");
        };
        let is_first = |values: &Values| *values.get(parameter) == Value::Choice(0);
        let in_progress = editor.operation().expect("an operation");
        let other = Value::Choice(usize::from(is_first(in_progress.values())));
        let set = editor.operating().set_values(&[(parameter.name, other)]);
        assert_eq!(set, Ok(()));
        lets_go.send(()).expect("the run is held");
        while editor
            .operation()
            .is_some_and(OperationInProgress::is_pending)
        {
            woken.recv_timeout(LONG).expect("the frame is woken");
            editor.begin_frame();
        }

        let previewed = editor.previewed_operation().expect("it is still previewed");
        assert!(previewed.report().is_some());
        assert!(editor.message().is_none(), "{:?}", editor.message());
        let (_, curve) = editor.document().curves().next().expect("a curve");
        let ends = End::BOTH.map(|end| curve.polygon.end_jet(end).point);
        let met = ends.iter().filter(|end| end.distance(target) < 1e-12);
        assert_eq!(met.count(), 1, "the preview shows the newer run: {ends:?}");
        assert!(editor.operating().apply().is_ok());
        assert_eq!(editor.workspace().history().undo_steps(), 1);
    }
}
