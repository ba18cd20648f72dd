//! `batten apply`: an operation on curves of a file.

use std::process::ExitCode;

use anyhow::{Context, anyhow, bail};

use super::apply_arguments::misused;
use super::ends::{Destination, Source};
use super::items::{found, items, listed};
use super::output::{self, Messages};
use super::progress::watched;
use crate::document::{Curve, CurveId, Document, Edit, MergeError};
use crate::geometry::Progress;
use crate::geometry::expressions::LengthUnit;
use crate::io::{Format, json_layout};
use crate::operations::{ALL, Inputs, Operands, Operation, OperationError, Outcome, Report, Value};

/// The exit code of arguments that cannot be used.
const MISUSED: u8 = 2;

/// The share of the work that the operation has; the rest is the proof of features.
const RUN: f64 = 0.8;

/// What a run of an operation did.
#[derive(Debug)]
pub(super) struct Done {
    /// The report.
    pub(super) report: Report,
    /// Whether the destination was written; an error if it could not be.
    pub(super) written: anyhow::Result<bool>,
}

/// An operation with where its input comes from and its result goes.
pub(super) struct Application {
    /// The operation.
    pub(super) operation: &'static Operation,
    /// The source; `None` if the operation has no input.
    pub(super) source: Option<Source>,
    /// The source of the second curve, if not the same.
    pub(super) second: Option<Source>,
    /// The destination.
    pub(super) destination: Destination,
    /// The name of the curve that was chosen, and of the second of two.
    pub(super) curves: [Option<String>; 2],
    /// The values of the parameters that are given.
    pub(super) values: Vec<(&'static str, Value)>,
    /// The unit of what states none.
    pub(super) assumed_unit: Option<LengthUnit>,
    /// Whether the best result is written where the request is not reached.
    pub(super) best: bool,
    /// Whether the report is printed as text, not as JSON.
    pub(super) text: bool,
}

/// List the operations.
///
/// # Errors
/// If the standard output cannot be written.
pub(super) fn list() -> anyhow::Result<()> {
    let width = ALL.iter().map(|operation| operation.name.len());
    let width = width.max().unwrap_or_default();
    let line = |operation: &&Operation| format!("{:width$}  {}\n", operation.name, operation.help);
    output::print(&ALL.iter().map(line).collect::<String>())
}

/// Apply an operation, write the document, and print the report: to the standard error if
/// the document goes to the standard output. The exit code is 1, and nothing but the best found, if
/// that is wanted, is written, if what was asked for is not reached; it is 2, with the usage, if the arguments alone
/// are at fault.
///
/// # Errors
/// If the source cannot be read, the operation cannot run, or the destination cannot be written;
/// nothing is written then.
pub(super) fn run(application: &Application) -> anyhow::Result<ExitCode> {
    let Done { report, written } = match application.run(&Messages::Printed) {
        Ok(done) => done,
        Err(error) => {
            let fault = error.downcast_ref::<OperationError>();
            let Some(fault) = fault.filter(|it| application.is_misused(it)) else {
                return Err(error);
            };
            let usage = misused(application.operation, &fault.to_string());
            output::usage(&usage.render().to_string());
            return Ok(ExitCode::from(MISUSED));
        }
    };
    written?;
    let text = match application.text {
        true => report.text(),
        false => json_layout::to_text(&report),
    };
    if application.destination.is_standard() {
        output::print_error(&text);
    } else {
        output::print(&text)?;
        if !report.reached && !application.text {
            output::message(&report.summary());
        }
    }
    Ok(if report.reached {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

impl Application {
    /// Run the operation and write the document. Where what was asked for is not reached, nothing is written, or the
    /// best found if that is wanted.
    ///
    /// # Errors
    /// If the source cannot be read or the operation cannot run.
    pub(super) fn run(&self, messages: &Messages) -> anyhow::Result<Done> {
        let format = self.destination.format()?;
        let input = self.input(messages)?;
        let done = match messages {
            Messages::Printed => self.applied(&input),
            // Many files are told of together.
            Messages::Kept(_) => self.outcome(&input, &Progress::default()),
        };
        let (outcome, report) = done.with_context(|| self.place())?;
        let written = self.write(&input, &outcome, format, messages);
        Ok(Done { report, written })
    }

    /// Write the document, if there is something to write.
    fn write(
        &self,
        input: &Operands,
        outcome: &Outcome,
        format: &Format,
        messages: &Messages,
    ) -> anyhow::Result<bool> {
        let is_wanted = outcome.reached || self.best;
        if is_wanted {
            let document = outcome.applied_to(input.document())?;
            let document = self.destination.placed(document);
            let export = format.write(&document, None);
            let export = export.with_context(|| self.destination.name())?;
            self.destination.write(export, messages)?;
        }
        Ok(is_wanted)
    }

    /// Whether the arguments alone are at fault, whatever a file holds: nothing was read, two parameters exclude
    /// each other, a direction has none, or the steps cannot do what is asked.
    fn is_misused(&self, error: &OperationError) -> bool {
        let is_of_arguments = matches!(
            error,
            OperationError::Exclude { .. }
                | OperationError::NoDirection { .. }
                | OperationError::NotBySteps { .. }
        );
        is_of_arguments || (self.source.is_none() && *error != OperationError::Cancelled)
    }

    /// What messages name as the place of an error.
    pub(super) fn place(&self) -> String {
        match &self.source {
            Some(source) => source.name(),
            None => self.operation.name.to_owned(),
        }
    }

    fn input(&self, messages: &Messages) -> anyhow::Result<Operands> {
        let document = match &self.source {
            Some(source) => source.document(self.assumed_unit, messages)?,
            None => Document::default(),
        };
        let second = self.second.as_ref().map(|source| {
            let document = source.document(self.assumed_unit, messages)?;
            let chosen = self.only_second(&document);
            chosen.with_context(|| source.name())
        });
        let second = second.transpose()?;
        let chosen = self.chosen(document, second, messages);
        chosen.with_context(|| self.place())
    }

    /// Choose the input of the operation in a document and in that of a second file, if there is one.
    fn chosen(
        &self,
        document: Document,
        second: Option<Document>,
        messages: &Messages,
    ) -> anyhow::Result<Operands> {
        let inputs = self.operation.inputs;
        let choose =
            |active, others: &[CurveId]| Ok(Operands::choose(&document, inputs, active, others)?);
        match (inputs, second) {
            (Inputs::None | Inputs::UpToTwo, _) => choose(None, &[]),
            (Inputs::OneOrNone, _) if self.source.is_none() => choose(None, &[]),
            (Inputs::References, _) if self.curves[0].is_none() => choose(None, &[]),
            (Inputs::Two, Some(second)) => self.with_second(document, &second, messages),
            (Inputs::Two, None) => {
                let items = items(&document, inputs);
                let named = |name: &String| found(&items, inputs, name);
                match (&self.curves, &items[..]) {
                    ([Some(first), Some(second)], _) => {
                        choose(Some(named(first)?), &[named(second)?])
                    }
                    ([Some(first), None], [_, _]) => choose(Some(named(first)?), &[]),
                    ([None, None], [(first, _), _]) => choose(Some(*first), &[]),
                    (_, []) => bail!(no_curve(&document)),
                    _ => bail!("choose two with --curve and --with: {}", listed(&items)),
                }
            }
            _ => choose(Some(self.item(&document, inputs, 0)?), &[]),
        }
    }

    /// Find the item that was named as the first or second; without a name, the only one.
    fn item(&self, document: &Document, inputs: Inputs, place: usize) -> anyhow::Result<CurveId> {
        let items = items(document, inputs);
        match (&self.curves[place], &items[..]) {
            (_, []) => bail!(match inputs {
                Inputs::OneOrNone => "there is neither a curve nor a reference",
                Inputs::References => "there is no reference",
                Inputs::Points => no_points(document),
                _ => no_curve(document),
            }),
            (Some(name), _) => found(&items, inputs, name),
            (None, [(only, _)]) => Ok(*only),
            _ => {
                let option = ["--curve", "--with"][place];
                bail!("choose one with {option}: {}", listed(&items))
            }
        }
    }

    /// Reduce the document of a second file to the second curve.
    fn only_second(&self, document: &Document) -> anyhow::Result<Document> {
        let id = self.item(document, Inputs::Two, 1)?;
        let curve = document.curve(id).context("there is no curve")?;
        Ok(Document::from_curves([Curve::clone(curve)]).with_unit(document.unit()))
    }

    /// Merge the second curve into the document that has the first one.
    fn with_second(
        &self,
        mut document: Document,
        second: &Document,
        messages: &Messages,
    ) -> anyhow::Result<Operands> {
        let first = self.item(&document, Inputs::Two, 0)?;
        let id = document.next_id();
        let name = |document: &Document| document.names().map(str::to_owned).next();
        let name = document.free_name(&name(second).unwrap_or_default());
        let merge = document.merging(second, self.assumed_unit);
        let merge = merge.map_err(|error| match error {
            MergeError::NoUnit { .. } => anyhow!("{error} with --assume-unit"),
            error => error.into(),
        })?;
        if let (Some(remark), Some(source)) = (merge.remark, &self.second) {
            messages.tell(&format!("{}: {remark}", source.name()));
        }
        for edit in merge.edits {
            document.apply(edit)?;
        }
        document.apply(Edit::Rename { curve: id, name })?;
        Ok(Operands::choose(
            &document,
            Inputs::Two,
            Some(first),
            &[id],
        )?)
    }

    /// Run the operation on another thread, and tell how far it has come while it takes long.
    fn applied(&self, input: &Operands) -> Result<(Outcome, Report), OperationError> {
        watched(self.operation.name, |progress| {
            self.outcome(input, progress)
        })
    }

    fn outcome(
        &self,
        input: &Operands,
        progress: &Progress,
    ) -> Result<(Outcome, Report), OperationError> {
        let operation = self.operation;
        let values = operation.values(input, self.values.iter().cloned())?;
        let outcome = operation.run(input, &values, &progress.part(0.0, RUN))?;
        let report = Report::of(operation, input, &outcome, &progress.part(RUN, 1.0));
        Ok((outcome, report.ok_or(OperationError::Cancelled)?))
    }
}

/// Say that there is no curve, and how to get one of points.
fn no_curve(document: &Document) -> &'static str {
    let mut references = document.references();
    match references.any(|(_, reference)| reference.points().is_some()) {
        true => "there is no curve, only points: make a curve of them with batten apply fit",
        false => "there is no curve",
    }
}

/// Say that a document has no points to fit, and what makes float polygons of its references.
fn no_points(document: &Document) -> &'static str {
    match document.references().next() {
        Some(_) => {
            "there is no list of points: make float polygons of references with batten apply to-float"
        }
        None => "there is neither a curve nor a list of points",
    }
}

#[cfg(test)]
mod tests;
