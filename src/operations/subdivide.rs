//! The same curve by twice as many segments.

use super::editable::check_editable;
use super::error::OperationError;
use super::input::Input;
use super::inputs::Inputs;
use super::matches::{Moved, followers};
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Outcome};
use super::values::Values;
use crate::document::MatchPlace;
use crate::geometry::Progress;

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "subdivide",
    label: "Subdivide",
    help: "Halve every segment; the curve stays",
    inputs: Inputs::One,
    parameters: &[],
    check: check_editable,
    run,
};

fn run(input: &Input, _: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let polygon = curve.polygon.subdivided()?;
    let segments = Figure::count("segments", "Segments", polygon.segments());
    let mut outcome = Outcome::renumbered(id, curve, polygon, Deviation::Exact);
    outcome.figures.push(segments);
    let followers = followers(input.document(), id, |place| {
        let place = match place {
            MatchPlace::Parameter(u) => MatchPlace::Parameter(2.0 * u),
            place => place,
        };
        Moved::To(id, place, false)
    });
    outcome.edits.extend(followers);
    Ok(outcome)
}
