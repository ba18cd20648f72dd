//! A curve whose ends are joined, so that it is periodic.

use super::bridge::{BRIDGE, annotations, fault, figures, found, knuckle, remarks};
use super::crossing::new_crossing;
use super::editable::open;
use super::error::OperationError;
use super::inputs::Inputs;
use super::lists::given_count;
use super::matches::without_match;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Outcome};
use super::values::Values;
use crate::document::{Edit, ParameterSpan};
use crate::geometry::fairing::bridging::close;
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::{End, Progress};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "close",
    label: "Close curve",
    help: "Join the two ends of a curve by a harmonious bridge, so that it is periodic; the curve itself stays",
    inputs: Inputs::One,
    each: true,
    parameters: &[BRIDGE],
    check: |input| open(input, "closed").map(drop),
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let found = found(close(
        &curve.polygon,
        given_count(values, &BRIDGE),
        progress,
    ))?;
    let document = input.document();
    let mut edits: Vec<Edit> = Vec::new();
    for end in End::BOTH {
        edits.extend(without_match(document, id, end));
        let target = curve.targets.get(end).map(|_| Edit::SetTarget {
            curve: id,
            end,
            target: None,
        });
        edits.extend(target);
    }
    let polygon = found.polygon.clone();
    let segments = curve.polygon.segments();
    let span = ParameterSpan {
        old: [0.0, segments as f64],
        new: [0.0, (segments << found.halvings[0]) as f64],
    };
    let mut outcome = Outcome::renumbered(input, polygon, vec![span], Deviation::Exact)?;
    edits.append(&mut outcome.edits);
    outcome.edits = edits;
    outcome.renumbered = false;
    outcome.figures = figures(&found);
    outcome.remarks.extend(remarks(&found));
    let polygons = [&curve.polygon; 2];
    let fault = fault(&found, polygons);
    let knuckle = knuckle(&found).filter(|_| fault.is_none());
    outcome.warnings.extend(knuckle);
    let crossing = new_crossing(&[&curve.polygon], &found.polygon);
    outcome.warnings.extend(crossing);
    if let Some(fault) = fault {
        let failed = Requirement::Failed { left: None };
        outcome.requirements = vec![(id, vec![failed])];
        outcome
            .warnings
            .push(format!("{fault}: move the ends apart"));
    }
    outcome.annotations = annotations(&found);
    outcome.joint = Some(found.joint);
    Ok(outcome)
}
