//! Both ends brought to their targets: at once, or step by step (step 7 of the end fit).

use std::ops::Bound;

use super::amount::Amount;
use super::error::OperationError;
use super::input::Input;
use super::inputs::Inputs;
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Outcome};
use super::parameter::{Choice, Kind, Parameter, Unit};
use super::targets::{check_targets, corrected, cusp, marks, residual};
use super::values::Values;
use crate::document::Curve;
use crate::geometry::end_correction::{EndOverlap, EndTarget, correct_in_turn};
use crate::geometry::fairing::joint_correction::{CorrectionError, Disturbance, correct_jointly};
use crate::geometry::{End, FloatPolygon, Progress, counted, significant};

/// What is left where only rounding is left, in units of the polygon's size.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

const ROUNDING_LEAVES_MORE: &str = "Rounding leaves more than the tolerance: allow more";

/// The tolerance that is offered, in units of the polygon's size.
const SHARE_OF_SIZE: f64 = 1e-9;

const METHOD: Parameter = Parameter {
    name: "method",
    label: "Method",
    help: "Move all vertices, as smoothly as possible, or repeat steps 2 to 6 on the terminal vertices",
    kind: Kind::Choice {
        options: &[
            Choice {
                name: "joint",
                label: "Both ends at once",
            },
            Choice {
                name: "steps",
                label: "Step by step",
            },
        ],
        default: 0,
    },
};

const TOLERANCE: Parameter = Parameter {
    name: "tolerance",
    label: "Tolerance",
    help: "How far an end may stay off its target; angles count as arcs over the size of the polygon",
    kind: Kind::Real {
        from: Bound::Excluded(Amount::Number(0.0)),
        to: Bound::Unbounded,
        default: Amount::Of {
            words: "1e-9 of the size of the polygon",
            value: |input| {
                let offered = SHARE_OF_SIZE * input.polygon()?.size();
                Ok(offered.max(f64::MIN_POSITIVE))
            },
        },
        unit: Unit::Length,
    },
};

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "correct-ends",
    label: "Correct ends",
    help: "Bring the ends of the curve to their targets; at once, an end without a target keeps its point and direction",
    inputs: Inputs::One,
    parameters: &[METHOD, TOLERANCE],
    check: check_targets,
    run,
};

/// What a method comes to.
struct Correction {
    /// The polygon, if the ends reach their targets.
    polygon: Option<FloatPolygon>,
    residual: f64,
    passes: usize,
    /// Why the targets are not reached.
    reason: String,
}

type Method = fn(&Curve, f64) -> Result<Correction, OperationError>;

fn run(input: &Input, values: &Values, _: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let method = values.choice(&METHOD, &[at_once as Method, step_by_step]);
    let correction = method(curve, values.real(&TOLERANCE))?;
    let mut outcome = match correction.polygon {
        Some(polygon) if polygon == curve.polygon => {
            let mut outcome = Outcome::unchanged(Deviation::Exact);
            outcome.remarks = vec!["Already within the tolerance".to_owned()];
            outcome
        }
        Some(polygon) => corrected(id, curve, polygon)?,
        None => {
            let mut outcome = Outcome::unchanged(Deviation::Exact);
            outcome.reached = false;
            outcome.remarks = vec![correction.reason];
            outcome
        }
    };
    outcome.residual = Some(correction.residual);
    outcome.figures = vec![Figure::count("passes", "Passes", correction.passes)];
    outcome.marks = End::BOTH.map(|end| marks(curve, end)).concat();
    Ok(outcome)
}

/// Correct both ends by the least disturbance. An end without a target keeps its point and
/// direction.
fn at_once(curve: &Curve, tolerance: f64) -> Result<Correction, OperationError> {
    let kept = |end: End| {
        let jet = curve.polygon.end_jet(end);
        EndTarget {
            point: jet.point,
            direction: jet.tangent(),
            ..EndTarget::default()
        }
    };
    let targets = End::BOTH.map(|end| (end, curve.targets.get(end).unwrap_or_else(|| kept(end))));
    if residual(curve, &curve.polygon) <= tolerance {
        return Ok(Correction {
            polygon: Some(curve.polygon.clone()),
            residual: residual(curve, &curve.polygon),
            passes: 0,
            reason: String::new(),
        });
    }
    match correct_jointly(&curve.polygon, &targets, Disturbance::Differences(1), &[]) {
        Ok(joint) => Ok(Correction {
            residual: joint.residual,
            polygon: Some(joint.polygon).filter(|_| joint.residual <= tolerance),
            passes: 1,
            reason: ROUNDING_LEAVES_MORE.to_owned(),
        }),
        Err(error @ CorrectionError::NotSolvable { residual, .. }) => Ok(Correction {
            polygon: None,
            residual,
            passes: 1,
            reason: error.to_string(),
        }),
        Err(error) => Err(error.into()),
    }
}

/// Repeat steps 2 to 6 on every end that has a target.
fn step_by_step(curve: &Curve, tolerance: f64) -> Result<Correction, OperationError> {
    let outcome = correct_in_turn(&curve.polygon, &curve.targets.list(), tolerance)?;
    let residual = outcome.residuals.last().copied().unwrap_or_default();
    let passes = outcome.passes();
    let cusp = cusp(curve, &outcome.polygon);
    let reached = outcome.converged && cusp.is_none();
    Ok(Correction {
        residual,
        passes,
        reason: cusp.unwrap_or_else(|| why_not(&curve.polygon, passes, residual)),
        polygon: Some(outcome.polygon).filter(|_| reached),
    })
}

/// Say why the loop was given up.
fn why_not(polygon: &FloatPolygon, passes: usize, left: f64) -> String {
    if left <= ROUNDING * polygon.size() {
        return ROUNDING_LEAVES_MORE.to_owned();
    }
    let reason = match EndOverlap::of(polygon) {
        EndOverlap::None => "the ends do not settle".to_owned(),
        EndOverlap::Partial { shared } => {
            let shared = counted(shared, "vertex", "vertices");
            format!("the ends share {shared}, and correcting one keeps spoiling the other")
        }
        EndOverlap::OneSegment => {
            "the curve is one segment, and both ends depend on almost the same vertices".to_owned()
        }
    };
    let (passes, left) = (counted(passes, "pass", "passes"), significant(left, 4));
    format!("Stopped after {passes}, {left} off: {reason}. Use “both ends at once”")
}
