//! An operation that is previewed or was applied last: the state of the operation panel.

use std::sync::Arc;

use glam::DVec2;

use super::end_fit_step::EndFitStep;
use super::fitted_points::FittedPoints;
use crate::document::{Curve, CurveId, Document};
use crate::editor::selection::Selection;
use crate::editor::view::{Mark, Viewport};
use crate::editor::workspace::PreviewId;
use crate::geometry::Progress;
use crate::operations::{
    self, FeatureComparison, Handle, Inputs, Operands, Operation, OperationError, Outcome, Report,
    Values,
};

/// Hold an operation whose values can be changed: it is previewed, or it made the last step.
#[derive(Debug)]
pub struct OperationInProgress {
    pub(super) operation: &'static Operation,
    pub(super) input: Operands,
    pub(super) values: Values,
    pub(super) stage: Stage,
    /// The selection before the operation.
    pub(super) selection: Selection,
    /// The last run: of earlier values while the present ones are pending.
    pub(super) run: Option<Result<Run, OperationError>>,
    /// Whether the run with the present values is not finished.
    pub(super) pending: bool,
    /// Whether that run was asked for the best found so far.
    pub(super) stops: bool,
    /// Whether a curve that it made was shown.
    pub(super) has_made: bool,
    /// The last proved features before and afterwards.
    pub(super) features: Option<FeatureComparison>,
    /// The handles of the last run that succeeded.
    pub(super) handles: Vec<Handle>,
    pub(super) dragged: Option<HandleDrag>,
    /// The points that are fitted, if the operation fits some.
    pub(super) points: FittedPoints,
    /// The values before the change in progress, such as a drag.
    pub(super) held: Option<Values>,
    /// The values before each change, the oldest first.
    pub(super) earlier: Vec<Values>,
    /// Whether the operation is applied as soon as its run is finished.
    pub(super) applies: bool,
    /// The action of the end-fit panel that started the operation.
    pub(super) end_fit: Option<EndFitStep>,
}

/// A handle that is dragged.
#[derive(Clone, Copy, Debug)]
pub(super) struct HandleDrag {
    /// The handle when it was pressed.
    pub handle: Handle,
    /// Whether the handle stays in the plane z = 0.
    pub planar: bool,
    /// The pressed place in the view plane.
    pub from: DVec2,
}

/// A finished run of an operation.
#[derive(Debug)]
pub struct Run {
    /// The edits, figures and marks.
    pub outcome: Outcome,
    /// The report; it gets features once they are proved.
    pub report: Report,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stage {
    /// This preview shows the result.
    Previewed(PreviewId),
    /// The result is a step.
    Applied {
        /// The revision of the document since then.
        revision: u64,
        /// The number of steps before: an operation that changes nothing has no step of its own.
        steps: usize,
    },
}

impl OperationInProgress {
    /// The operation.
    pub fn operation(&self) -> &'static Operation {
        self.operation
    }

    /// The input, as it was before the operation.
    pub fn input(&self) -> &Operands {
        &self.input
    }

    /// The values of the parameters.
    pub fn values(&self) -> &Values {
        &self.values
    }

    /// Whether the operation was applied.
    pub fn is_applied(&self) -> bool {
        matches!(self.stage, Stage::Applied { .. })
    }

    /// The report of the last run; `None` if it failed or none is finished.
    pub fn report(&self) -> Option<&Report> {
        self.finished().map(|run| &run.report)
    }

    /// Whether the run with the present values is not finished.
    pub fn is_pending(&self) -> bool {
        self.pending
    }

    /// Whether Apply was asked for before the run is finished.
    pub fn is_waiting_to_apply(&self) -> bool {
        self.pending && self.applies
    }

    /// Whether the run can be stopped with the best found so far.
    pub fn can_be_stopped(&self) -> bool {
        self.pending && !self.stops && self.operation.can_be_stopped()
    }

    /// The last proved features before and afterwards, and whether they belong to the present values.
    pub fn features(&self) -> Option<(&FeatureComparison, bool)> {
        let current = self.report().and_then(|report| report.features.as_ref());
        match current {
            Some(features) if !self.pending => Some((features, true)),
            _ => Some((self.features.as_ref()?, false)),
        }
    }

    /// The last finished run; of earlier values while the present ones are pending.
    pub fn run(&self) -> Option<&Result<Run, OperationError>> {
        self.run.as_ref()
    }

    /// The last run, unless it failed.
    pub(in crate::editor) fn finished(&self) -> Option<&Run> {
        self.run.as_ref()?.as_ref().ok()
    }

    /// Whether a change of values is in progress, such as a drag.
    pub fn holds_values(&self) -> bool {
        self.held.is_some()
    }

    /// Whether undo takes back a change of values. Once the operation is applied, undo takes back its step.
    pub(in crate::editor) fn has_changed_values(&self) -> bool {
        self.held.is_some() || (!self.is_applied() && !self.earlier.is_empty())
    }

    /// The curves that the operation has made beside inputs that it left as they were.
    pub fn made_curves(&self, now: &Document) -> Vec<CurveId> {
        if self
            .input
            .curves()
            .iter()
            .any(|input| is_changed(input, now))
        {
            return Vec::new();
        }
        let before = self.input.document();
        let ids = now.ids();
        ids.filter(|id| before.curve(*id).is_none()).collect()
    }

    /// Whether the active curve is an input or was made by the operation. An operation without an
    /// input curve belongs to any.
    pub(super) fn belongs_to(&self, active: Option<CurveId>, now: &Document) -> bool {
        self.curve().is_none()
            || self.curve() == active
            || active.is_some_and(|active| self.made_curves(now).contains(&active))
    }

    /// The curves that can be the second one, with their names, and which one is; none where the operation takes no
    /// second curve.
    pub fn seconds(&self) -> (Vec<(CurveId, String)>, Option<CurveId>) {
        if self.operation.inputs != Inputs::Two {
            return (Vec::new(), None);
        }
        let others = self.input.document().curves();
        let others = others.filter(|(id, _)| Some(*id) != self.curve());
        let others = others.map(|(id, curve)| (id, curve.name.clone()));
        let second = self.input.curves().get(1).map(|(id, _)| *id);
        (others.collect(), second)
    }

    /// The first input curve.
    pub(super) fn curve(&self) -> Option<CurveId> {
        self.input.curves().first().map(|(id, _)| *id)
    }

    /// The active curve before the operation.
    pub(in crate::editor) fn before(&self, active: Option<CurveId>) -> Option<Arc<Curve>> {
        self.input.document().curve(active?).cloned()
    }

    /// The inputs beside the active curve that the operation changes, as they were.
    pub(in crate::editor) fn others_before(
        &self,
        active: Option<CurveId>,
        now: &Document,
    ) -> Vec<Arc<Curve>> {
        let inputs = self.input.curves().iter();
        let changed = inputs.filter(|input| Some(input.0) != active && is_changed(input, now));
        changed.map(|(_, curve)| curve.clone()).collect()
    }

    /// The marks of the last run on the canvas.
    pub(in crate::editor) fn marks(&self, viewport: &Viewport) -> Vec<Mark> {
        // Points that are fitted have marks of their own.
        let run = self.finished().filter(|_| self.fitted_points().is_none());
        let annotations = run.map(|run| run.outcome.annotations.iter());
        let seen = |point| viewport.flatten(point);
        let marks = annotations.into_iter().flatten().map(|mark| match *mark {
            operations::Annotation::Point(point) => Mark::Snap(seen(point)),
            operations::Annotation::Arrow { from, to } => Mark::Ruler([seen(from), seen(to)]),
        });
        marks.collect()
    }
}

fn is_changed((id, curve): &(CurveId, Arc<Curve>), now: &Document) -> bool {
    !now.curve(*id).is_some_and(|now| Arc::ptr_eq(now, curve))
}

impl Run {
    pub(super) fn new(
        operation: &'static Operation,
        input: &Operands,
        values: &Values,
        progress: &Progress,
    ) -> Result<Self, OperationError> {
        let outcome = operation.run(input, values, progress)?;
        let report = Report::new(operation, input, &outcome);
        Ok(Self { outcome, report })
    }

    /// Whether the result is one to keep.
    pub(super) fn succeeds(&self) -> bool {
        self.outcome.is_useful()
    }
}
