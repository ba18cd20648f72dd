//! The same curve by more vertices.

use super::degree::{Goal, TOLERANCE, refitted};
use super::editable::editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::lists::{given, given_count};
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::Outcome;
use super::parameter::{Kind, Parameter};
use super::values::Values;
use crate::geometry::parameters::OutOfRange;
use crate::geometry::{MAX_PART_SEGMENTS, Progress};

const COUNT: Parameter = Parameter {
    name: "count",
    label: "Vertices",
    help: "The number of vertices; without it the fewest for the tolerance, or one more",
    kind: Kind::optional_count(MAX_PART_SEGMENTS, false, |_| "automatic"),
};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "refine",
    label: "Refine",
    help: "Give the polygon more vertices; features stay, and the report tells the deviation",
    inputs: Inputs::One,
    each: true,
    parameters: &[COUNT, TOLERANCE],
    check: |input| editable(input).map(drop),
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let polygon = input.polygon()?;
    let has = polygon.vertices().len();
    let (count, tolerance) = (given_count(values, &COUNT), given(values, &TOLERANCE));
    if let Some(count) = count.filter(|count| *count < has) {
        return Err(OutOfRange {
            label: COUNT.label,
            value: count.to_string().into(),
            needed: format!("{has} or more").into(),
        }
        .into());
    }
    let tail = has - polygon.segments();
    let goal = Goal {
        degree: polygon.degree(),
        segments: match (count, tolerance) {
            (Some(count), _) => Some(count - tail),
            (None, Some(_)) => None,
            (None, None) => Some(has + 1 - tail),
        },
        least: has + 1 - tail,
        tolerance,
    };
    refitted(input, &goal, progress)
}
