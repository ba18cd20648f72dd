//! A lower degree for nearly the same curve.

use super::amount::Amount;
use super::degree::{TOLERANCE, changed, degree};
use super::editable::editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::Outcome;
use super::parameter::Parameter;
use super::values::Values;
use crate::geometry::Progress;

const DEGREE: Parameter = degree(Amount::Number(1.0), Amount::Degree(-1), Amount::Degree(-1));

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "reduce-degree",
    label: "Reduce degree",
    help: "Lower the degree; the result is a curve near this one",
    inputs: Inputs::One,
    each: true,
    parameters: &[DEGREE, TOLERANCE],
    check,
    unused: |_| &[],
    run,
};

fn check(input: &Operands) -> Result<(), OperationError> {
    if editable(input)?.polygon.degree() <= 1 {
        return Err(OperationError::LowestDegree);
    }
    Ok(())
}

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    changed(input, values, &DEGREE, progress)
}
