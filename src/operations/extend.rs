//! A longer curve: its end segment's polynomial continued.

use super::cutting::without_target;
use super::editable::open;
use super::error::OperationError;
use super::handle::{Handle, OnCurve, Sets};
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::parameter::{Kind, Parameter};
use super::values::Values;
use super::which_end::{END, end};
use crate::document::ParameterSpan;
use crate::geometry::{End, MAX_ADDED_SEGMENTS, Progress};

const SEGMENTS: Parameter = Parameter {
    name: "segments",
    label: "Segments",
    help: "How many segments are added",
    kind: Kind::whole(1, MAX_ADDED_SEGMENTS, 1),
};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "extend",
    label: "Extend curve",
    help: "Continue an end of the curve by whole segments, exactly as it runs",
    inputs: Inputs::One,
    each: false,
    parameters: &[END, SEGMENTS],
    check: |input| open(input, "extended").map(drop),
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let end = end(values);
    let added = values.whole(&SEGMENTS);
    let polygon = curve.polygon.extended(end, added)?;
    let segments = Figure::count("segments", "Segments", polygon.segments());
    let shift = if end == End::Start { added } else { 0 };
    let whole = [0.0, curve.polygon.segments() as f64];
    let span = ParameterSpan::shifted(whole, shift as f64);
    let mut outcome = Outcome::renumbered(input, polygon.clone(), vec![span], Deviation::Exact)?;
    outcome.renumbered = end == End::Start;
    // What follows the end stays where it is; the new end has neither target nor match.
    outcome.keep_followers(input, end, shift as f64 + end.parameter(&curve.polygon))?;
    let released = without_target(input.document(), id, curve, end);
    outcome.edits = released.chain(outcome.edits).collect();
    outcome.figures.push(segments);
    outcome
        .annotations
        .push(Annotation::Point(curve.polygon.end_jet(end).point));
    outcome.handles.push(Handle {
        at: polygon.end_jet(end).point,
        label: SEGMENTS.label,
        sets: Sets::OnCurve(OnCurve::Beyond {
            segments: SEGMENTS.name,
            end,
            from: whole[usize::from(end == End::Finish)],
        }),
    });
    Ok(outcome)
}
