//! The same curve by twice as many segments.

use super::editable::check_editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::locks::{LOCKS_HALVED, halved};
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Outcome};
use super::values::Values;
use crate::document::{Edit, ParameterSpan};
use crate::geometry::Progress;

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "subdivide",
    label: "Subdivide",
    help: "Halve every segment; the curve stays",
    inputs: Inputs::One,
    each: true,
    parameters: &[],
    check: check_editable,
    unused: |_| &[],
    run,
};

fn run(input: &Operands, _: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let polygon = curve.polygon.subdivided()?;
    let segments = Figure::count("segments", "Segments", polygon.segments());
    let last = curve.polygon.segments() as f64;
    let doubled = ParameterSpan {
        old: [0.0, last],
        new: [0.0, 2.0 * last],
    };
    let mut outcome = Outcome::renumbered(input, polygon, vec![doubled], Deviation::Exact)?;
    outcome.figures.push(segments);
    let locked = curve.locked_vertices.iter();
    let locked: Vec<usize> = locked.map(|it| halved(&curve.polygon, 1, it)).collect();
    if !locked.is_empty() {
        outcome.remarks = vec![LOCKS_HALVED.to_owned()];
        outcome.edits.push(Edit::SetVerticesLocked {
            curve: id,
            vertices: locked,
            locked: true,
        });
    }
    Ok(outcome)
}
