//! Trying operations out, applying them, and changing what was applied last.

use std::sync::Arc;

use glam::DVec3;

use crate::document::{Curve, CurveId, Document, Edit};
use crate::editor::Editor;
use crate::editor::hand::tools::ToolKind;
use crate::editor::reply::{Message, Note, Refusal, Reply, told};
use crate::editor::selection::Selection;
use crate::editor::trial::{JobResult, Operations, Run, Stage, Trial};
use crate::editor::view::Look;
use crate::editor::view::scene::Mark;
use crate::editor::workspace::Interruption;
use crate::geometry::Progress;
use crate::operations::{self, FeatureComparison, Input, Inputs, Operation, OperationError, Value};

impl Editor {
    /// The operation that is being tried out or was applied last, unless something else was done
    /// since.
    pub fn trial(&self) -> Option<&Trial> {
        let trial = self.operations.trial.as_ref()?;
        let counts = match trial.stage {
            Stage::Tried(preview) => self.workspace.preview() == Some(preview),
            Stage::Applied { revision, .. } => {
                self.workspace.revision() == revision
                    && self.workspace.preview().is_none()
                    && self.is_about_active(trial)
            }
        };
        counts.then_some(trial)
    }

    /// Whether the active curve is the one that an operation works on or one that it made; an operation without
    /// a curve does not mind.
    fn is_about_active(&self, trial: &Trial) -> bool {
        let active = self.active();
        trial.curve().is_none()
            || trial.curve() == active
            || active.is_some_and(|active| self.made_by(trial).contains(&active))
    }

    /// Whether an operation is being tried out.
    pub fn is_trying(&self) -> bool {
        self.trial().is_some_and(|trial| !trial.is_applied())
    }

    /// Whether this operation is being tried out.
    pub(in crate::editor) fn is_tried(&self, operation: &Operation) -> bool {
        let trial = self.trial().filter(|trial| !trial.is_applied());
        trial.is_some_and(|trial| trial.operation() == operation)
    }

    /// The share of the work that is done, while the worker is busy with the operation.
    pub fn operation_progress(&self) -> Option<f64> {
        self.operations.client.progress()
    }

    /// Why an operation cannot be begun now, if it cannot.
    ///
    /// # Errors
    /// [`OperationError`].
    pub fn check_operation(&self, operation: &'static Operation) -> Result<(), OperationError> {
        operation.check(&self.input_of(operation)?)
    }

    /// Try an operation out on the active curve; one without parameters is applied at once. The
    /// reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot run on the curve.
    pub fn try_operation(&mut self, operation: &'static Operation) -> Reply {
        if operation.parameters.is_empty() {
            return self.apply_operation(operation, &[]);
        }
        self.message = None;
        self.interrupt();
        let begun = self.begin_trial(operation, &[]);
        if begun.is_ok() {
            self.ask();
        }
        self.tell(begun.map(|()| Note::silent()))
    }

    /// Apply an operation with some values; the others have their defaults. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if it cannot run, or what is asked for is not reached; nothing is changed then.
    pub fn apply_operation(
        &mut self,
        operation: &'static Operation,
        given: &[(&str, Value)],
    ) -> Reply {
        self.message = None;
        let reply = self.operate(operation, given);
        self.tell(reply)
    }

    /// Apply an operation with some values.
    pub(in crate::editor) fn operate(
        &mut self,
        operation: &'static Operation,
        given: &[(&str, Value)],
    ) -> Reply {
        self.interrupt();
        let begun = self.begin_trial(operation, given);
        let reply = begun.and_then(|()| {
            self.ask();
            self.settle_trial()
        });
        if reply.is_err() {
            self.leave_trial();
        }
        reply
    }

    /// Keep what the operation that is tried out does, as one step; if it still runs, as soon as it
    /// is done. The reply is told.
    ///
    /// # Errors
    /// [`Refusal`] if it does not reach what is asked for.
    pub fn apply_trial(&mut self) -> Reply {
        if !self.is_trying() {
            return Ok(Note::silent());
        }
        if self.end_handle_drag() {
            self.hand.gestures.reset();
        }
        let reply = self.settle_trial();
        self.tell(reply)
    }

    /// Take the operation that is tried out back, or put that which was applied out of reach.
    pub fn leave_trial(&mut self) {
        let tries = self.is_trying();
        if tries {
            self.workspace.abort();
        }
        self.operations.client.forget();
        self.hand.tools.end_fit.awaited = None;
        // What a drag or a field has taken back has nothing to restore any more.
        if let Some(trial) = self.operations.trial.take()
            && tries
        {
            self.hand.selection = trial.selection;
        }
        self.document_changed();
    }

    /// The active curve before the operation that is tried out, or before a correction of its ends:
    /// the canvas shows it faintly.
    pub(in crate::editor) fn before_operation(&self) -> Option<Arc<Curve>> {
        let trial = self.trial()?;
        let corrects = self.hand.tool() == ToolKind::EndFit;
        let shown = !trial.is_applied() || corrects;
        let active = self.active().filter(|_| shown)?;
        trial.input.document().curve(active).cloned()
    }

    /// The other curves that the operation that is tried out works on, as they were.
    pub(in crate::editor) fn others_before_operation(&self) -> Vec<Arc<Curve>> {
        let trial = self.trial().filter(|trial| !trial.is_applied());
        trial.map_or_else(Vec::new, |trial| {
            let others = trial.input.curves().iter();
            let changed = |(id, curve): &&(CurveId, Arc<Curve>)| {
                let now = self.document().curve(*id);
                Some(*id) != self.active() && !now.is_some_and(|now| Arc::ptr_eq(now, curve))
            };
            others
                .filter(changed)
                .map(|(_, curve)| curve.clone())
                .collect()
        })
    }

    /// What the operation that is tried out marks on the canvas.
    pub(in crate::editor) fn operation_marks(&self) -> Vec<Mark> {
        let trial = self.trial().filter(|trial| !trial.is_applied());
        let Some(Ok(run)) = trial.and_then(Trial::run) else {
            return Vec::new();
        };
        let seen = |point| self.view.viewport.flatten(point);
        let marks = run.outcome.marks.iter();
        let marks = marks.map(|mark| match *mark {
            operations::Mark::Point(point) => Mark::Snap(seen(point)),
            operations::Mark::Arrow { from, to } => Mark::Ruler([seen(from), seen(to)]),
        });
        marks.collect()
    }

    /// End what is tried out if another curve is active now.
    pub(in crate::editor) fn leave_stale_trial(&mut self) {
        let other = self
            .trial()
            .is_some_and(|trial| !trial.is_applied() && !self.is_about_active(trial));
        if other {
            self.leave_trial_selecting(self.hand.selection.clone());
        }
    }

    /// Take the operation that is tried out back because something else is begun. What was selected
    /// meanwhile stays so if all vertices have the numbers that they had before.
    pub(in crate::editor) fn interrupt_trial(&mut self) {
        let numbers = |document: &Document| -> Vec<(CurveId, usize)> {
            let curves = document.curves();
            let counts = curves.map(|(id, curve)| (id, curve.polygon.vertices().len()));
            counts.collect()
        };
        let keeps = numbers(self.workspace.settled()) == numbers(self.workspace.document());
        if keeps {
            self.leave_trial_selecting(self.hand.selection.clone());
        } else {
            self.leave_trial();
        }
    }

    fn leave_trial_selecting(&mut self, selection: Selection) {
        self.leave_trial();
        self.hand.selection = selection;
        self.document_changed();
    }

    /// Take what the worker has to tell.
    pub(in crate::editor) fn receive_operations(&mut self) {
        self.operations.client.receive();
        self.take_result();
    }

    pub(in crate::editor) fn input_of(
        &self,
        operation: &Operation,
    ) -> Result<Input, OperationError> {
        let selection = &self.hand.selection;
        let active = selection.active();
        let active = active.filter(|id| self.document().curve(*id).is_some());
        let curves: Vec<CurveId> = match operation.inputs {
            Inputs::None | Inputs::Points => Vec::new(),
            Inputs::One | Inputs::OneOrNone => active.into_iter().collect(),
            // The active curve comes first.
            Inputs::Two | Inputs::UpToTwo => {
                let others = self.document().ids().filter(|id| Some(*id) != active);
                let others: Vec<CurveId> = others.collect();
                let is_selected = |id: &&CurveId| selection.of_curve(**id).next().is_some();
                let selected: Vec<CurveId> = others.iter().filter(is_selected).copied().collect();
                // Where two are needed and there are two, there is no choice.
                let needed = operation.inputs == Inputs::Two;
                let chosen = if needed && selected.is_empty() && others.len() == 1 {
                    others
                } else {
                    selected
                };
                active.into_iter().chain(chosen).collect()
            }
        };
        let settled = self.workspace.settled();
        let reference = selection.active().and_then(|id| settled.reference(id));
        let reference = reference.map(|reference| reference.curve.clone());
        let input = Input::new(settled, curves)?.with_reference(reference);
        let points = self
            .active_points()
            .filter(|_| operation.inputs == Inputs::Points);
        Ok(match points {
            Some(points) => input.with_points(points),
            None => input,
        })
    }

    /// The points of the active reference, where they are placed, if it is a list of them.
    fn active_points(&self) -> Option<Vec<DVec3>> {
        let analysis = self.view.analyses.reference(self.active()?)?;
        let points = analysis.points().vertices();
        (!points.is_empty()).then(|| points.to_vec())
    }

    fn begin_trial(
        &mut self,
        operation: &'static Operation,
        given: &[(&str, Value)],
    ) -> Result<(), Refusal> {
        let prepared = self.input_of(operation).and_then(|input| {
            let values = operation.values(&input, given.iter().cloned())?;
            Ok((input, values))
        });
        let (input, values) = prepared.map_err(|error| Refusal(error.to_string()))?;
        let preview = self.workspace.begin(operation.label, Interruption::Aborts);
        self.operations.trial = Some(Trial {
            operation,
            input,
            values,
            stage: Stage::Tried(preview),
            selection: self.hand.selection.clone(),
            run: None,
            pending: false,
            features: None,
            handles: Vec::new(),
            dragged: None,
            held: None,
            earlier: Vec::new(),
            applies: false,
        });
        Ok(())
    }

    /// Make a curve the active one that an operation has made beside its inputs, compare it with the
    /// other if there is one, else with the reference that was active, and bring it into view when
    /// it is new.
    fn activate_made(&mut self, is_new: bool) {
        let made = self.made_curves();
        let Some(first) = made.first() else {
            return;
        };
        if self.active().is_none_or(|active| !made.contains(&active)) {
            self.hand.selection.activate(*first);
        }
        // Two curves are made to be compared.
        let other = made.iter().find(|id| Some(**id) != self.active());
        let is_other = |id: &CurveId| made.contains(id) && Some(*id) != self.active();
        if other.is_some() && !self.view.compared.is_some_and(|id| is_other(&id)) {
            self.view.compared = other.copied();
        }
        if is_new {
            // What follows a curve or a reference is compared with it.
            let followed = self.trial().filter(|trial| {
                matches!(trial.operation().inputs, Inputs::OneOrNone | Inputs::Points)
            });
            let active = followed.and_then(|trial| trial.selection.active());
            let reference = active.filter(|id| self.document().reference(*id).is_some());
            let followed = followed.and_then(Trial::curve);
            self.view.compared = reference.or(followed).or(self.view.compared);
            self.look(Look::New(made));
        }
    }

    /// The curves that the operation has made beside those that it left as they were: they are compared with
    /// each other.
    pub fn made_curves(&self) -> Vec<CurveId> {
        self.trial()
            .map_or_else(Vec::new, |trial| self.made_by(trial))
    }

    fn made_by(&self, trial: &Trial) -> Vec<CurveId> {
        let (before, now) = (trial.input.document(), self.document());
        let leaves = |(id, curve): &(CurveId, Arc<Curve>)| {
            now.curve(*id).is_some_and(|now| Arc::ptr_eq(now, curve))
        };
        if !trial.input.curves().iter().all(leaves) {
            return Vec::new();
        }
        let ids = now.ids();
        ids.filter(|id| before.curve(*id).is_none()).collect()
    }

    /// Run the operation with its present values, and wait a moment for the result.
    pub(in crate::editor) fn ask(&mut self) {
        let Operations { client, trial } = &mut self.operations;
        let Some(trial) = trial else {
            return;
        };
        trial.pending = true;
        let (operation, input, values) =
            (trial.operation, trial.input.clone(), trial.values.clone());
        let job = move |progress: &Progress| {
            let run = Run::new(operation, &input, &values, progress);
            Some(JobResult::Run(Box::new(run)))
        };
        client.start((), job, Some(&mut self.patience));
        self.take_result();
    }

    /// Prove the features before and afterwards.
    fn ask_for_features(&mut self) {
        let Operations { client, trial } = &mut self.operations;
        let Some(trial) = trial else {
            return;
        };
        let Some(Ok(run)) = &trial.run else {
            return;
        };
        let (input, outcome) = (trial.input.clone(), run.outcome.clone());
        let job = move |progress: &Progress| {
            let features = FeatureComparison::prove(&input, &outcome, progress);
            Some(JobResult::Features(features))
        };
        client.go_on(job, Some(&mut self.patience));
        self.take_result();
    }

    /// Take the result of the newest job, if the operation still counts.
    fn take_result(&mut self) {
        if self.trial().is_none() {
            return;
        }
        let Operations { client, trial } = &mut self.operations;
        if let Some(panic) = client.failure() {
            let failed = format!("The operation failed: {panic}. Nothing was changed");
            self.leave_trial();
            self.message = Message::of(&Err(Refusal(failed)));
            return;
        }
        match client.take_result() {
            Some(JobResult::Run(run)) => self.take_run(*run),
            Some(JobResult::Features(features)) => {
                if let Some(trial) = trial
                    && let Some(Ok(run)) = &mut trial.run
                {
                    trial.features = features.clone();
                    run.report.features = features;
                }
            }
            None => {}
        }
    }

    fn take_run(&mut self, run: Result<Run, OperationError>) {
        let edits = match &run {
            Ok(run) => run.outcome.edits.clone(),
            Err(_) => Vec::new(),
        };
        let succeeds = run.as_ref().is_ok_and(|run| run.outcome.is_useful());
        let Some(trial) = &mut self.operations.trial else {
            return;
        };
        let is_first = trial.run.is_none();
        // Where there is no curve, the last one's handles are what leads back to one.
        if let Ok(run) = &run {
            trial.handles.clone_from(&run.outcome.handles);
        }
        trial.run = Some(run);
        trial.pending = false;
        let (label, stage, applies) = (trial.operation.label, trial.stage, trial.applies);
        match stage {
            Stage::Tried(_) => {
                self.update(edits);
                self.activate_made(is_first);
            }
            Stage::Applied { steps, .. } => {
                // A run that fails leaves the applied step as it is.
                if succeeds {
                    self.amend(label, steps, edits);
                }
                self.tell_of_amendment();
            }
        }
        if applies {
            let reply = self.settle_trial();
            // Whoever asked has its answer: this is what came of it later.
            match self.hand.tools.end_fit.awaited.take() {
                Some((action, passes)) => self.keep_end_fit_action(action, passes, &reply),
                None => told(self.tell(reply)),
            }
        }
        if succeeds {
            self.ask_for_features();
        }
    }

    /// Put other edits in place of the step that the operation made after `steps` others, if it made
    /// one.
    fn amend(&mut self, label: &str, steps: usize, edits: Vec<Edit>) {
        let amended = if self.workspace.history().undo_steps() > steps {
            self.workspace.amend(label, edits)
        } else {
            self.workspace.apply(label, edits)
        };
        self.tell_of_update(amended.err().map(Refusal::from));
        if let Some(trial) = &mut self.operations.trial {
            let revision = self.workspace.revision();
            trial.stage = Stage::Applied { revision, steps };
        }
        self.document_changed();
    }

    /// Tell what the operation does with other values than those it was applied with.
    fn tell_of_amendment(&mut self) {
        let run = self.operations.trial.as_ref().and_then(Trial::run);
        let reply = match run {
            Some(Ok(run)) if run.outcome.is_useful() => Ok(Note::done(run.report.summary())),
            Some(Ok(run)) => Err(Refusal(run.report.summary())),
            Some(Err(error)) => Err(Refusal(error.to_string())),
            None => return,
        };
        told(self.tell(reply));
    }

    /// Keep what the operation does, now or once it is known; or say why it cannot be kept.
    fn settle_trial(&mut self) -> Reply {
        let Some(trial) = &mut self.operations.trial else {
            return Ok(Note::silent());
        };
        trial.applies = false;
        if trial.pending {
            trial.applies = true;
            return Ok(Note::silent());
        }
        trial.dragged = None;
        trial.held = None;
        let renumbers = match &trial.run {
            None => return Ok(Note::silent()),
            Some(Err(error)) => return Err(Refusal(error.to_string())),
            Some(Ok(run)) if !run.outcome.is_useful() => return Err(Refusal(run.report.summary())),
            Some(Ok(run)) => run.outcome.renumbered,
        };
        let steps = self.workspace.history().undo_steps();
        self.workspace.commit();
        trial.stage = Stage::Applied {
            revision: self.workspace.revision(),
            steps,
        };
        let said = match &trial.run {
            Some(Ok(run)) => run.report.summary(),
            _ => String::new(),
        };
        if renumbers {
            self.hand.selection.clear();
        }
        self.document_changed();
        Ok(Note::done(said))
    }
}
