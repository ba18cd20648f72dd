//! Step 5 of the end fit: translate the terminal vertices of an end.

use super::error::OperationError;
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Figure, Outcome};
use super::targets::{
    SHARE_OF_SIZE, annotations, check_targets, corrected, moved_with, place_of, target,
};
use super::values::Values;
use super::which_end::{END, end};
use crate::geometry::Progress;
use crate::geometry::end_correction::{EndDifference, EndTarget, translate_end};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "translate-end",
    label: "Translate end",
    help: "Translate the terminal vertices of an end so that it meets its target point (step 5)",
    inputs: Inputs::One,
    each: false,
    parameters: &[END],
    check: check_targets,
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let end = end(values);
    let target = target(curve, end)?;
    let way = EndDifference::between(&curve.polygon, end, &target).vector;
    let polygon = translate_end(&curve.polygon, end, way)?;
    let place = EndTarget {
        point: target.point,
        ..EndTarget::default()
    };
    let tolerance = SHARE_OF_SIZE * polygon.size();
    let requirement = place_of(&polygon, end, place, tolerance);
    let warning = moved_with(&curve.polygon, end.other(), &polygon);
    let mut outcome = corrected(id, curve, polygon)?;
    outcome.warnings.extend(warning);
    outcome.requirements = vec![(id, vec![requirement])];
    outcome.figures = vec![Figure::length("translation", "Translation", way.length())];
    outcome.annotations = annotations(curve, end);
    Ok(outcome)
}
