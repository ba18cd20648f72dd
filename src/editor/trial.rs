//! An operation as it is tried out, and once it is applied: the operation panel's state.

use crate::document::CurveId;
use crate::editor::hand::handle_drag::HandleDrag;
use crate::editor::jobs::Client;
use crate::editor::selection::Selection;
use crate::editor::workspace::PreviewId;
use crate::geometry::Progress;
use crate::operations::{
    FeatureComparison, Handle, Input, Operation, OperationError, Outcome, Report, Values,
};

/// Hold an operation that is being tried out, or that was applied last: its values can be changed
/// until something else is done.
#[derive(Debug)]
pub struct Trial {
    pub(in crate::editor) operation: &'static Operation,
    pub(in crate::editor) input: Input,
    pub(in crate::editor) values: Values,
    pub(in crate::editor) stage: Stage,
    /// What was selected before.
    pub(in crate::editor) selection: Selection,
    /// What it comes to with these values; while that is worked out, with those before.
    pub(in crate::editor) run: Option<Result<Run, OperationError>>,
    /// Whether the worker works out what it comes to with these values.
    pub(in crate::editor) pending: bool,
    /// The features before and afterwards that were proved last.
    pub(in crate::editor) features: Option<FeatureComparison>,
    /// The handles that it offers, or offered when it made a curve last.
    pub(in crate::editor) handles: Vec<Handle>,
    /// The handle that is dragged on the canvas.
    pub(in crate::editor) dragged: Option<HandleDrag>,
    /// The values before the change that is going on.
    pub(in crate::editor) held: Option<Values>,
    /// The values before each change, the oldest first.
    pub(in crate::editor) earlier: Vec<Values>,
    /// Whether it is applied as soon as it is known what it comes to.
    pub(in crate::editor) applies: bool,
}

/// What an operation comes to.
#[derive(Debug)]
pub struct Run {
    /// What it does.
    pub outcome: Outcome,
    /// That in figures; features come once they are proved.
    pub report: Report,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::editor) enum Stage {
    /// This preview shows what it would do.
    Tried(PreviewId),
    /// It was applied.
    Applied {
        /// The document's revision since.
        revision: u64,
        /// The number of steps before: where it changes nothing there is no step of its own.
        steps: usize,
    },
}

/// A result of a background job.
#[derive(Debug)]
pub(in crate::editor) enum JobResult {
    Run(Box<Result<Run, OperationError>>),
    Features(Option<FeatureComparison>),
}

/// Run operations beside the frame.
#[derive(Debug, Default)]
pub(in crate::editor) struct Operations {
    pub(in crate::editor) client: Client<(), JobResult>,
    pub(in crate::editor) trial: Option<Trial>,
}

impl Operations {
    /// Run operations on a thread of its own; `wake` is called when there is something new to show
    /// later than it is waited for.
    pub fn background(wake: impl Fn() + Send + 'static) -> Self {
        Self {
            client: Client::background("operations", wake),
            ..Self::default()
        }
    }
}

impl Trial {
    /// The operation.
    pub fn operation(&self) -> &'static Operation {
        self.operation
    }

    /// What it works on, as it was before.
    pub fn input(&self) -> &Input {
        &self.input
    }

    /// The values of its parameters.
    pub fn values(&self) -> &Values {
        &self.values
    }

    /// Whether it was applied.
    pub fn is_applied(&self) -> bool {
        matches!(self.stage, Stage::Applied { .. })
    }

    /// What it does in figures, once that is known.
    pub fn report(&self) -> Option<&Report> {
        let run = self.run.as_ref()?.as_ref().ok()?;
        Some(&run.report)
    }

    /// Whether it is still worked out what it comes to with these values: what is told of it so far
    /// is of those before.
    pub fn is_pending(&self) -> bool {
        self.pending
    }

    /// The features before and afterwards that were proved last, and whether they are of these
    /// values.
    pub fn features(&self) -> Option<(&FeatureComparison, bool)> {
        let current = self.report().and_then(|report| report.features.as_ref());
        match current {
            Some(features) if !self.pending => Some((features, true)),
            _ => Some((self.features.as_ref()?, false)),
        }
    }

    /// What it comes to; `None` until it is known for the first time.
    pub fn run(&self) -> Option<&Result<Run, OperationError>> {
        self.run.as_ref()
    }

    pub(in crate::editor) fn curve(&self) -> Option<CurveId> {
        self.input.curves().first().map(|(id, _)| *id)
    }
}

impl Run {
    pub(in crate::editor) fn new(
        operation: &'static Operation,
        input: &Input,
        values: &Values,
        progress: &Progress,
    ) -> Result<Self, OperationError> {
        let outcome = operation.run(input, values, progress)?;
        let report = Report::new(operation, input, &outcome);
        Ok(Self { outcome, report })
    }
}
