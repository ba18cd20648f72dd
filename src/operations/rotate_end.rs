//! Step 6 of the end fit: rotate the terminal vertices of an end.

use super::error::OperationError;
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Outcome};
use super::targets::{
    SHARE_OF_SIZE, annotations, check_targets, corrected, cusp, moved_with, place_of, target,
};
use super::values::Values;
use super::which_end::{END, end};
use crate::geometry::Progress;
use crate::geometry::end_correction::{EndDifference, EndTarget, align_end};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "rotate-end",
    label: "Rotate end",
    help: "Rotate the terminal vertices about the end so that its tangent has the target direction (step 6)",
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
    let direction = target.direction;
    let direction = direction.ok_or(OperationError::NoTargetDirection { end })?;
    let aim = EndTarget {
        point: curve.polygon.end_jet(end).point,
        direction: Some(direction),
        ..EndTarget::default()
    };
    let tolerance = SHARE_OF_SIZE * curve.polygon.size();
    let requirements = vec![(id, vec![place_of(&curve.polygon, end, aim, tolerance)])];
    if curve.polygon.end_jet(end).tangent().is_none() {
        return Ok(Outcome {
            requirements,
            remarks: cusp(curve, &curve.polygon).into_iter().collect(),
            ..Outcome::unchanged(Deviation::Exact)
        });
    }
    let angle = EndDifference::between(&curve.polygon, end, &target).angle;
    let polygon = align_end(&curve.polygon, end, direction)?;
    let warning = moved_with(&curve.polygon, end.other(), &polygon);
    let mut outcome = corrected(id, curve, polygon)?;
    outcome.warnings.extend(warning);
    outcome.requirements = requirements;
    outcome.figures = vec![Figure::angle("rotation", "Rotation", angle)];
    outcome.annotations = annotations(curve, end);
    Ok(outcome)
}
