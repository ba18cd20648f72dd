//! The same curve by twice as many segments.

use super::editable::check_editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Outcome};
use super::values::Values;
use crate::document::{Curve, Edit, ParameterSpan};
use crate::geometry::Progress;

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "subdivide",
    label: "Subdivide",
    help: "Halve every segment; the curve stays",
    inputs: Inputs::One,
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
    let locked = halved_locks(curve);
    if !locked.is_empty() {
        outcome.remarks = vec![
            "Locks go to the vertices that stand in the same places along the curve".to_owned(),
        ];
        outcome.edits.push(Edit::SetVerticesLocked {
            curve: id,
            vertices: locked,
            locked: true,
        });
    }
    Ok(outcome)
}

/// The vertices that take the places of the locked ones: those with the Greville abscissa that is
/// nearest to theirs, now that u counts twice as many segments. Vertex i stands at i − (n − 1)/2.
fn halved_locks(curve: &Curve) -> Vec<usize> {
    let polygon = &curve.polygon;
    let before = polygon.vertices().len();
    let offset = (polygon.degree() - 1) / 2;
    let count = if polygon.is_periodic() {
        2 * before
    } else {
        2 * before - polygon.degree()
    };
    let halved = |vertex: usize| {
        if polygon.is_periodic() {
            (2 * vertex + count - offset) % count
        } else {
            (2 * vertex).saturating_sub(offset).min(count - 1)
        }
    };
    curve.locked_vertices.iter().map(halved).collect()
}
