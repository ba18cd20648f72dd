//! A higher degree for the same curve.

use super::amount::Amount;
use super::degree::{TOLERANCE, changed, degree};
use super::editable::editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Outcome};
use super::parameter::Parameter;
use super::values::Values;
use crate::geometry::{FloatPolygon, MAX_DEGREE, Progress};

const DEGREE: Parameter = degree(
    Amount::Degree(1),
    Amount::Of {
        words: "25 (a periodic curve: the number of segments − 1 at the most)",
        value: |input| Ok(highest(input.polygon()?) as f64),
    },
    Amount::Degree(1),
);

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "elevate-degree",
    label: "Elevate degree",
    help: "Raise the degree; exact for a curve of one segment, otherwise a uniform curve near it",
    inputs: Inputs::One,
    each: true,
    parameters: &[DEGREE, TOLERANCE],
    check,
    unused: |_| &[],
    run,
};

fn check(input: &Operands) -> Result<(), OperationError> {
    let polygon = &editable(input)?.polygon;
    let degree = polygon.degree();
    if degree >= highest(polygon) {
        return Err(OperationError::HighestDegree { degree });
    }
    Ok(())
}

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let mut outcome = changed(input, values, &DEGREE, progress)?;
    if outcome.deviation != Deviation::Exact {
        let why = "With more than one segment, raising the degree would double the knots: a uniform curve can only approximate it";
        outcome.remarks.push(why.to_owned());
    }
    Ok(outcome)
}

/// The highest degree that the curve can have with as many segments.
fn highest(polygon: &FloatPolygon) -> usize {
    if polygon.is_periodic() {
        MAX_DEGREE.min(polygon.segments() - 1)
    } else {
        MAX_DEGREE
    }
}
