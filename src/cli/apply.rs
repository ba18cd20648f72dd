//! `batten apply`: an operation on curves of a file.

use std::process::ExitCode;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use anyhow::{Context, anyhow, bail};
use glam::DVec3;

use super::apply_arguments::misused;
use super::ends::{Destination, Source};
use super::output;
use super::progress::Progress as Line;
use crate::document::{Curve, CurveId, Document, Edit, quoted};
use crate::geometry::Progress;
use crate::io::{Reading, json_layout};
use crate::operations::{ALL, Inputs, Operands, Operation, OperationError, Outcome, Report, Value};

/// The exit code of arguments that cannot be used.
const MISUSED: u8 = 2;

/// How often a long operation is asked how far it has come.
const PAUSE: Duration = Duration::from_millis(100);

/// An operation with where its input comes from and its result goes.
pub(super) struct Application {
    /// The operation.
    pub(super) operation: &'static Operation,
    /// What is read; `None` if the operation works on nothing.
    pub(super) source: Option<Source>,
    /// What the second of two curves is read from, if not from the same.
    pub(super) second: Option<Source>,
    /// What is written.
    pub(super) destination: Destination,
    /// The name of the curve that was chosen, and of the second of two.
    pub(super) curves: [Option<String>; 2],
    /// The values of the parameters that are given.
    pub(super) values: Vec<(&'static str, Value)>,
    /// Whether the best found is written where what was asked for is not reached.
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
    let format = application.destination.format()?;
    let input = application.input()?;
    let (outcome, report) = match application.applied(&input) {
        Ok(done) => done,
        Err(error) if application.is_misused(&error) => {
            let usage = misused(application.operation, &error.to_string());
            output::usage(&usage.render().to_string());
            return Ok(ExitCode::from(MISUSED));
        }
        Err(error) => return Err(error).with_context(|| application.place()),
    };
    if outcome.reached || application.best {
        let document = outcome.applied_to(input.document())?;
        let export = format.write_document(&document, None);
        let destination = &application.destination;
        destination.write(export.with_context(|| destination.name())?)?;
    }
    let text = match application.text {
        true => report.text(),
        false => json_layout::to_text(&report),
    };
    if application.destination.is_standard() {
        output::print_error(&text);
    } else {
        output::print(&text)?;
        if !outcome.reached && !application.text {
            output::message(&report.summary());
        }
    }
    Ok(if outcome.reached {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

impl Application {
    /// Whether the arguments alone are at fault, whatever a file holds: nothing was read, or two parameters exclude
    /// each other.
    fn is_misused(&self, error: &OperationError) -> bool {
        let excludes = matches!(error, OperationError::Exclude { .. });
        excludes || (self.source.is_none() && *error != OperationError::Cancelled)
    }

    /// What messages name as the place of an error.
    fn place(&self) -> String {
        match &self.source {
            Some(source) => source.name(),
            None => self.operation.name.to_owned(),
        }
    }

    fn input(&self) -> anyhow::Result<Operands> {
        let reading = match &self.source {
            Some(source) => source.read()?,
            None => Reading::default(),
        };
        let second = self.second.as_ref().map(|source| {
            let document = source.read()?.into_document()?;
            self.second_curve(&document).with_context(|| source.name())
        });
        let second = second.transpose()?;
        self.chosen(reading, second).with_context(|| self.place())
    }

    /// Choose what the operation works on of what was read.
    fn chosen(&self, reading: Reading, second: Option<Curve>) -> anyhow::Result<Operands> {
        let document = reading.into_document()?;
        match self.operation.inputs {
            Inputs::None | Inputs::UpToTwo => Ok(Operands::new(&document, [])?),
            Inputs::OneOrNone if self.source.is_none() => Ok(Operands::new(&document, [])?),
            Inputs::One => Ok(Operands::new(&document, [self.curve(&document, 0)?])?),
            Inputs::OneOrNone => self.curve_or_reference(&document),
            Inputs::Two => match second {
                None => Ok(Operands::new(&document, self.two_curves(&document)?)?),
                Some(second) => self.with_second(document, second),
            },
            Inputs::Points => {
                let curves = document.curves();
                let curves = curves.map(|(_, curve)| curve.polygon.vertices().to_vec());
                let lists = document.references().filter_map(|(_, it)| it.points());
                let mut tables: Vec<Vec<DVec3>> = curves.chain(lists).collect();
                let count = tables.len();
                let Some(points) = tables.pop().filter(|_| count == 1) else {
                    bail!("a table of points is needed, and there are {count} curves and lists");
                };
                Ok(Operands::new(&Document::default(), [])?.with_points(points))
            }
        }
    }

    /// Find the curve that was named as the first or second; without a name, the only one.
    fn curve(&self, document: &Document, place: usize) -> anyhow::Result<CurveId> {
        if document.curves().len() == 0 {
            bail!("there is no curve");
        }
        let mut ids = document.ids();
        match (&self.curves[place], ids.next(), ids.next()) {
            (Some(name), ..) => curve_named(document, name),
            (None, Some(only), None) => Ok(only),
            _ => {
                let option = ["--curve", "--with"][place];
                bail!("choose one with {option}: {}", there_are(document))
            }
        }
    }

    /// Choose the curve or reference that was named; without a name, the only one.
    fn curve_or_reference(&self, document: &Document) -> anyhow::Result<Operands> {
        let mut ids = document.all_ids();
        let id = match (&self.curves[0], ids.next(), ids.next()) {
            (Some(name), ..) => item_named(document, name)?,
            (None, Some(only), None) => only,
            (None, None, _) => bail!("there is neither a curve nor a reference"),
            _ => bail!("choose one with --curve: {}", listed(document.names())),
        };
        Ok(match document.reference(id) {
            None => Operands::new(document, [id])?,
            Some(reference) => {
                Operands::new(document, [])?.with_reference(Some(reference.curve.clone()))
            }
        })
    }

    /// Find the two curves that were named; without names, both if there are just two.
    fn two_curves(&self, document: &Document) -> anyhow::Result<Vec<CurveId>> {
        match &self.curves {
            [Some(first), Some(second)] => [first, second]
                .into_iter()
                .map(|name| curve_named(document, name))
                .collect(),
            [None, None] if document.curves().len() == 2 => Ok(document.ids().collect()),
            _ if document.curves().len() == 0 => bail!("there is no curve"),
            _ => bail!(
                "choose two with --curve and --with: {}",
                there_are(document)
            ),
        }
    }

    /// Find the second curve in a file of its own.
    fn second_curve(&self, document: &Document) -> anyhow::Result<Curve> {
        let curve = document.curve(self.curve(document, 1)?);
        Ok(Curve::clone(curve.context("there is no curve")?))
    }

    /// Add the second curve to the document that has the first one.
    fn with_second(&self, mut document: Document, mut second: Curve) -> anyhow::Result<Operands> {
        let first = self.curve(&document, 0)?;
        second.name = document.free_name(&second.name);
        let id = document.next_id();
        document.apply(Edit::Add(Box::new(second)))?;
        Ok(Operands::new(&document, [first, id])?)
    }

    /// Run the operation on another thread, and tell how far it has come while it takes long.
    fn applied(&self, input: &Operands) -> Result<(Outcome, Report), OperationError> {
        let progress = Progress::default();
        thread::scope(|scope| {
            let (sender, receiver) = mpsc::channel();
            let shared = progress.clone();
            scope.spawn(move || {
                // The receiver waits below until it has this.
                let _ = sender.send(self.outcome(input, &shared));
            });
            let mut line = Line::new();
            loop {
                match receiver.recv_timeout(PAUSE) {
                    Ok(result) => return result,
                    Err(RecvTimeoutError::Timeout) => {
                        let percent = 100.0 * progress.done();
                        line.tell(format_args!("{}: {percent:.0} %", self.operation.name));
                    }
                    // The thread panicked, and so does the end of its scope.
                    Err(RecvTimeoutError::Disconnected) => return Err(OperationError::Cancelled),
                }
            }
        })
    }

    fn outcome(
        &self,
        input: &Operands,
        progress: &Progress,
    ) -> Result<(Outcome, Report), OperationError> {
        let operation = self.operation;
        let values = operation.values(input, self.values.iter().cloned())?;
        let outcome = operation.run(input, &values, progress)?;
        let report = Report::of(operation, input, &outcome, progress);
        Ok((outcome, report.ok_or(OperationError::Cancelled)?))
    }
}

fn curve_named(document: &Document, name: &str) -> anyhow::Result<CurveId> {
    let named = document.curves().filter(|(_, curve)| curve.name == name);
    let found: Vec<CurveId> = named.map(|(id, _)| id).collect();
    match found[..] {
        [id] => Ok(id),
        [] => Err(anyhow!(
            "there is no curve {}: {}",
            quoted(name),
            there_are(document)
        )),
        _ => Err(anyhow!(
            "there are {} curves {}: give them different names first",
            found.len(),
            quoted(name)
        )),
    }
}

/// Find a curve or reference by its name.
fn item_named(document: &Document, name: &str) -> anyhow::Result<CurveId> {
    let named = document.all_ids().zip(document.names());
    let found: Vec<CurveId> = named
        .filter(|(_, known)| *known == name)
        .map(|(id, _)| id)
        .collect();
    match found[..] {
        [id] => Ok(id),
        [] => Err(anyhow!(
            "there is no curve or reference {}: {}",
            quoted(name),
            listed(document.names())
        )),
        _ => Err(anyhow!(
            "there are {} curves and references {}: give them different names first",
            found.len(),
            quoted(name)
        )),
    }
}

/// List the curves of a document by their names.
fn there_are(document: &Document) -> String {
    listed(document.curves().map(|(_, curve)| curve.name.as_str()))
}

fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.map(quoted).collect();
    match &names[..] {
        [name] => format!("there is {name}"),
        names => format!("there are {}", names.join(", ")),
    }
}

#[cfg(test)]
mod tests;
