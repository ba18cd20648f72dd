//! An operation that is previewed or was applied last: the state of the operation panel.

use std::sync::Arc;

use glam::DVec2;

use super::end_fit_step::EndFitStep;
use super::fitted_points::FittedPoints;
use crate::document::{Curve, CurveId, Document, Edit, quoted};
use crate::editor::reply::Note;
use crate::editor::selection::Selection;
use crate::editor::view::{Framing, Mark, Viewport};
use crate::editor::workspace::PreviewId;
use crate::geometry::Progress;
use crate::operations::{
    self, FeatureComparison, Handle, Inputs, Operands, Operation, OperationError, Outcome, Report,
    Share, Values,
};

/// The most lines on items with a result in a message.
const MOST_LINES: usize = 4;

/// Hold an operation whose values can be changed: it is previewed, or it made the last step.
#[derive(Debug)]
pub struct OperationInProgress {
    pub(super) operation: &'static Operation,
    pub(super) input: Operands,
    pub(super) values: Values,
    pub(super) stage: Stage,
    /// The selection before the operation.
    pub(super) selection: Selection,
    /// The framing before the operation, and the one that it chose for a curve that it made.
    pub(super) framings: (Framing, Option<Framing>),
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
    /// What is told first: an operation before it was not applied.
    pub(super) lost: Note,
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
    /// What the outcome is of.
    pub(super) input: Operands,
    /// The edits, figures and marks.
    pub outcome: Outcome,
    /// The report; it gets features once they are proved.
    pub report: Report,
    /// The results for the other items that it ran on.
    pub others: Vec<OtherResult>,
}

/// The result of a run for another item than the one whose report is shown.
#[derive(Debug)]
pub struct OtherResult {
    /// The curve or the reference.
    pub item: CurveId,
    /// What the operation ran on; `None` if it cannot run on the item.
    pub(super) input: Option<Operands>,
    /// The outcome with its report, or why there is none.
    pub result: Result<(Outcome, Report), OperationError>,
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
    /// The selection before the operation, once it is applied.
    pub(in crate::editor) fn selection_before(&self) -> Option<&Selection> {
        self.is_applied().then_some(&self.selection)
    }

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

    /// What is told when something else ends the preview.
    pub(in crate::editor) fn ended(&self) -> Note {
        let label = self.operation.label;
        match self.is_waiting_to_apply() {
            true => Note::told(format!("{label}: not applied, it was not ready")).warning(),
            false => Note::told(format!("{label}: cancelled")),
        }
    }

    /// What is told when its values change before it is applied.
    pub(in crate::editor) fn changed(&self) -> Note {
        let label = self.operation.label;
        match self.is_waiting_to_apply() {
            true => Note::told(format!("{label}: not applied, its values have changed")).warning(),
            false => Note::silent(),
        }
    }

    /// Whether the run has warnings that nobody could see yet, beside some that were seen, or has not reached what was asked
    /// for without being stopped. Searches show the best that they have found, and single steps of the end fit are no
    /// result.
    pub(super) fn is_unseen(&self, seen: &[String]) -> bool {
        let is_new = |run: &Run| seen.is_empty() || run.warnings().any(|it| !seen.contains(it));
        let warns = |run: &Run| !self.operation.can_be_stopped() && run.warns() && is_new(run);
        !self.is_applied()
            && self.end_fit.is_none_or(EndFitStep::is_joint)
            && self
                .finished()
                .is_some_and(|run| (!self.stops && run.falls_short()) || warns(run))
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
            .all_curves()
            .any(|(id, curve)| is_changed((*id, curve), now))
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
            || active.is_some_and(|active| self.input.all_curves().any(|(id, _)| *id == active))
            || active.is_some_and(|active| self.made_curves(now).contains(&active))
    }

    /// The curves that can be the second one, neither locked nor hidden, with their names, and which one is; none where
    /// the operation takes no second curve.
    pub fn seconds(&self) -> (Vec<(CurveId, String)>, Option<CurveId>) {
        if self.operation.inputs != Inputs::Two {
            return (Vec::new(), None);
        }
        let second = self.input.curves().get(1).map(|(id, _)| *id);
        let others = self.input.document().curves().filter(|(id, curve)| {
            let can_be = curve.check_editable().is_ok() || Some(*id) == second;
            can_be && Some(*id) != self.curve()
        });
        let others = others.map(|(id, curve)| (id, curve.name.clone()));
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
        let inputs = self.input.all_curves();
        let changed =
            inputs.filter(|(id, curve)| Some(*id) != active && is_changed((*id, curve), now));
        changed.map(|(_, curve)| curve.clone()).collect()
    }

    /// The curves of the preview that do not meet the request.
    pub(in crate::editor) fn unreached(&self, now: &Document) -> Vec<CurveId> {
        let Some(run) = self.finished().filter(|run| !run.is_reached()) else {
            return Vec::new();
        };
        let (before, reached) = (self.input.document(), run.reached_items());
        let changed = now.curves().filter(|it| is_changed(*it, before));
        let ids = changed.map(|(id, _)| id);
        ids.filter(|id| !reached.contains(id)).collect()
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

/// Whether a curve is another one in a document, or not there.
fn is_changed((id, curve): (CurveId, &Arc<Curve>), other: &Document) -> bool {
    !other
        .curve(id)
        .is_some_and(|other| Arc::ptr_eq(other, curve))
}

impl Run {
    pub(super) fn new(
        operation: &'static Operation,
        input: &Operands,
        values: &Values,
        progress: &Progress,
    ) -> Result<Self, OperationError> {
        let mut results = match input.beside().is_empty() {
            true => vec![Share {
                item: input.item(),
                input: Some(input.clone()),
                outcome: operation.run(input, values, progress),
            }],
            false => operation.run_on_each(input, values, progress),
        };
        // The report is that of the first item with a result.
        let of_use = results
            .iter()
            .position(|it| it.outcome.as_ref().is_ok_and(Outcome::is_useful));
        let first = of_use.or(results.iter().position(|it| it.outcome.is_ok()));
        let Share {
            input: own,
            outcome,
            ..
        } = results.remove(first.unwrap_or(0));
        let (input, outcome) = (own.unwrap_or_else(|| input.clone()), outcome?);
        let others = results.into_iter().filter_map(|share| {
            let result = share.outcome.map(|outcome| {
                let input = share.input.as_ref();
                let report = input.map(|input| Report::new(operation, input, &outcome));
                (outcome, report)
            });
            Some(OtherResult {
                item: share.item?,
                input: share.input,
                result: match result {
                    Ok((outcome, report)) => Ok((outcome, report?)),
                    Err(error) => Err(error),
                },
            })
        });
        Ok(Self {
            report: Report::new(operation, &input, &outcome),
            others: others.collect(),
            input,
            outcome,
        })
    }

    /// Whether the result is one to keep.
    pub(super) fn succeeds(&self) -> bool {
        self.outcome.is_useful()
    }

    /// The curve or the reference whose report is shown, where there are others.
    pub fn item(&self) -> Option<CurveId> {
        self.input.item().filter(|_| !self.others.is_empty())
    }

    /// The outcomes of all items that have one.
    fn outcomes(&self) -> impl Iterator<Item = (Option<CurveId>, &Outcome)> {
        let others = self.others.iter();
        let others = others.filter_map(|it| Some((Some(it.item), &it.result.as_ref().ok()?.0)));
        [(self.item(), &self.outcome)].into_iter().chain(others)
    }

    /// Whether the results of all items meet the request.
    fn is_reached(&self) -> bool {
        self.outcomes().all(|(_, outcome)| outcome.reached)
    }

    /// The items among several whose results meet the request.
    fn reached_items(&self) -> Vec<CurveId> {
        let reached = self.outcomes().filter(|(_, outcome)| outcome.reached);
        reached.filter_map(|(item, _)| item).collect()
    }

    /// The edits for all items.
    pub(super) fn edits(&self) -> Vec<Edit> {
        let edits = self.outcomes().flat_map(|(_, outcome)| &outcome.edits);
        edits.cloned().collect()
    }

    /// Whether vertices of any item get other numbers.
    pub(super) fn renumbers(&self) -> bool {
        self.outcomes().any(|(_, outcome)| outcome.renumbered)
    }

    /// Whether the document stays as it is.
    pub fn changes_nothing(&self) -> bool {
        self.outcomes().all(|(_, outcome)| outcome.edits.is_empty())
    }

    /// Whether the user may not want the result of any item.
    pub(super) fn warns(&self) -> bool {
        self.reports().any(Report::warns)
    }

    /// The warnings of all items.
    pub(super) fn warnings(&self) -> impl Iterator<Item = &String> {
        self.reports().flat_map(|report| &report.warnings)
    }

    /// Whether the result of an item is the best that was found, and not what was asked for.
    fn falls_short(&self) -> bool {
        self.reports()
            .any(|report| report.useful && !report.reached)
    }

    fn reports(&self) -> impl Iterator<Item = &Report> {
        let others = self.others.iter().filter_map(|it| it.result.as_ref().ok());
        [&self.report]
            .into_iter()
            .chain(others.map(|(_, report)| report))
    }

    /// Say what was done, of several items line by line; those without a result are always named.
    pub(super) fn told(&self, document: &Document) -> String {
        let Some(item) = self.item() else {
            return self.report.summary();
        };
        let name = |id: CurveId| quoted(document.name(id).unwrap_or_default());
        let done = self.others.iter().filter(|it| it.is_useful()).count();
        let all = 1 + self.others.len();
        let counted = match done + 1 == all {
            true => format!("{all} done"),
            false => format!("{} of {all} done", done + 1),
        };
        let mut lines = vec![format!("{}: {counted}", self.report.label)];
        // A message shows its first lines: those without a result come first.
        let failed = self.others.iter().filter(|it| !it.is_useful());
        lines.extend(failed.map(|it| it.line(document)));
        let own = format!("{}: {}", name(item), self.report.details());
        let useful = self.others.iter().filter(|it| it.is_useful());
        let useful = useful.map(|it| it.line(document));
        lines.extend([own].into_iter().chain(useful).take(MOST_LINES));
        lines.extend((done >= MOST_LINES).then(|| format!("{} more", done + 1 - MOST_LINES)));
        lines.join("\n")
    }
}

impl OtherResult {
    /// Whether there is something to keep.
    pub fn is_useful(&self) -> bool {
        self.result
            .as_ref()
            .is_ok_and(|(outcome, _)| outcome.is_useful())
    }

    /// Say of the item what was done, or why nothing was, in one line.
    pub fn line(&self, document: &Document) -> String {
        let name = quoted(document.name(self.item).unwrap_or_default());
        let details = match &self.result {
            Ok((_, report)) => report.details(),
            Err(error) => error.to_string(),
        };
        // What is locked or hidden is named already.
        match details.starts_with(&name) {
            true => details,
            false => format!("{name}: {details}"),
        }
    }
}
