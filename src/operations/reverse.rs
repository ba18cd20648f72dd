//! The same curve, run through the other way.

use super::editable::check_editable;
use super::error::OperationError;
use super::input::Input;
use super::inputs::Inputs;
use super::operation::Operation;
use super::outcome::{Deviation, Outcome};
use super::values::Values;
use crate::document::Edit;
use crate::geometry::{End, Progress};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "reverse",
    label: "Reverse direction",
    help: "Let the curve run the other way; its shape stays",
    inputs: Inputs::One,
    parameters: &[],
    check: check_editable,
    run,
};

fn run(input: &Input, _: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let last = curve.polygon.vertices().len() - 1;
    let locked = &curve.locked_vertices;
    let mut outcome = Outcome::unchanged(Deviation::Exact);
    outcome.renumbered = true;
    outcome.edits.push(Edit::Renumber {
        curve: id,
        polygon: curve.polygon.reversed(),
        locked_vertices: locked.renumbered(|vertex| last.checked_sub(vertex)),
    });
    // The targets stay where they are: each becomes the other end's.
    for end in End::BOTH {
        let target = curve.targets.get(end.other());
        let target = target.map(|target| target.turned(curve.polygon.is_planar()));
        if target != curve.targets.get(end) {
            outcome.edits.push(Edit::SetTarget {
                curve: id,
                end,
                target,
            });
        }
    }
    Ok(outcome)
}
