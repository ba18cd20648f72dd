//! The same curve, run through the other way.

use super::editable::check_editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Outcome};
use super::values::Values;
use crate::document::{Edit, Renumbering};
use crate::geometry::Progress;

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "reverse",
    label: "Reverse direction",
    help: "Reverse the direction of the curve; its shape stays",
    inputs: Inputs::One,
    each: true,
    parameters: &[],
    check: check_editable,
    unused: |_| &[],
    run,
};

fn run(input: &Operands, _: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let mut outcome = Outcome::unchanged(Deviation::Exact);
    outcome.renumbered = true;
    // Targets and matches stay where they are: each becomes the other end's.
    outcome.edits.push(Edit::Renumber {
        curve: id,
        polygon: curve.polygon.reversed(),
        renumbering: Renumbering::reversed(curve),
    });
    Ok(outcome)
}
