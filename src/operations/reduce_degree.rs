//! A lower degree for nearly the same curve.

use std::ops::Bound;

use super::amount::Amount;
use super::editable::editable;
use super::error::OperationError;
use super::input::Input;
use super::inputs::Inputs;
use super::operation::Operation;
use super::outcome::{Deviation, Outcome};
use super::parameter::{Kind, Parameter, Range, Unit};
use super::values::Values;
use crate::geometry::Progress;

const DEGREE: Parameter = Parameter {
    name: "degree",
    label: "Degree",
    help: "The degree that the curve gets",
    kind: Kind::Whole {
        range: Range {
            from: Bound::Included(Amount::Number(1.0)),
            to: Bound::Included(Amount::Degree(-1)),
        },
        default: Amount::Degree(-1),
        unit: Unit::None,
    },
};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "reduce-degree",
    label: "Lower degree, keep curve",
    help: "Lower the degree; the result is a curve near this one",
    inputs: Inputs::One,
    parameters: &[DEGREE],
    check,
    run,
};

fn check(input: &Input) -> Result<(), OperationError> {
    if editable(input)?.polygon.degree() <= 1 {
        return Err(OperationError::LowestDegree);
    }
    Ok(())
}

fn run(input: &Input, values: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let lowered = curve.polygon.with_degree(values.whole(&DEGREE))?;
    let deviation = Deviation::of(&lowered);
    let mut outcome = Outcome::reshaped(id, lowered.polygon, deviation);
    outcome.renumbered = true;
    Ok(outcome)
}
