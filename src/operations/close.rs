//! A curve whose ends are joined, so that it is periodic.

use super::bridge::{BRIDGE, annotations, figures, found, joint, remarks};
use super::editable::open;
use super::error::OperationError;
use super::inputs::Inputs;
use super::lists::given_count;
use super::matches::without_match;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Outcome};
use super::values::Values;
use crate::document::{Edit, ParameterSpan};
use crate::geometry::fairing::bridging::close;
use crate::geometry::{End, Progress};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "close",
    label: "Close curve",
    help: "Join the two ends of a curve by a harmonious bridge, so that it is periodic; the curve itself stays",
    inputs: Inputs::One,
    parameters: &[BRIDGE],
    check: |input| open(input, "closed").map(drop),
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let found = found(close(
        &curve.polygon,
        given_count(values, &BRIDGE),
        progress,
    ))?;
    let document = input.document();
    let mut edits: Vec<Edit> = Vec::new();
    for end in End::BOTH {
        edits.extend(without_match(document, id, end));
        let target = curve.targets.get(end).map(|_| Edit::SetTarget {
            curve: id,
            end,
            target: None,
        });
        edits.extend(target);
    }
    let polygon = found.polygon.clone();
    let whole = [0.0, curve.polygon.segments() as f64];
    let span = vec![ParameterSpan::shifted(whole, 0.0)];
    let mut outcome = Outcome::renumbered(input, polygon, span, Deviation::Exact)?;
    edits.append(&mut outcome.edits);
    outcome.edits = edits;
    outcome.renumbered = false;
    outcome.figures = figures(&found);
    outcome.remarks.extend(remarks(&found));
    outcome.annotations = annotations(&found);
    outcome.joint = Some(joint(&found));
    Ok(outcome)
}
