//! Another degree on the same polygon.

use super::amount::Amount;
use super::degree::degree;
use super::editable::check_editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Outcome};
use super::parameter::Parameter;
use super::values::Values;
use crate::document::{Edit, Renumbering};
use crate::geometry::distance::MeasuredDeviation;
use crate::geometry::{FloatPolygon, MAX_DEGREE, Progress};

const DEGREE: Parameter = degree(
    Amount::Number(1.0),
    Amount::Of {
        words: "the number of vertices − 1 (25 at the most)",
        value: |input| Ok(highest(input.polygon()?) as f64),
    },
    Amount::Of {
        words: "the degree + 1, if the polygon has vertices enough",
        value: |input| {
            let polygon = input.polygon()?;
            Ok(highest(polygon).min(polygon.degree() + 1) as f64)
        },
    },
);

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "reinterpret-degree",
    label: "Change degree, keep polygon",
    help: "Give the polygon another degree: higher is smoother, lower follows the polygon closer",
    inputs: Inputs::One,
    each: true,
    parameters: &[DEGREE],
    check: check_editable,
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    let (polygon, degree) = (&curve.polygon, values.whole(&DEGREE));
    if degree == polygon.degree() {
        let mut outcome = Outcome::unchanged(Deviation::Exact);
        outcome
            .remarks
            .push(format!("The degree is {degree} already"));
        return Ok(outcome);
    }
    let weights = polygon.weights().map(<[f64]>::to_vec);
    let vertices = polygon.vertices().to_vec();
    let polygon = FloatPolygon::new(degree, vertices, weights, polygon.is_periodic())?;
    let moved = MeasuredDeviation::between(&polygon, &curve.polygon, progress);
    let deviation = moved.map_or(Deviation::Unmeasured, |moved| match moved.bounded {
        true => Deviation::AtMost(moved.largest),
        false => Deviation::Measured(moved.largest),
    });
    let another = if degree > curve.polygon.degree() {
        "Elevate"
    } else {
        "Reduce"
    };
    Ok(Outcome {
        remarks: vec![format!(
            "The polygon stays, the curve changes; {another} degree with a tolerance keeps the curve"
        )],
        edits: vec![Edit::Renumber {
            curve: id,
            renumbering: Renumbering::of_vertices(curve, &polygon, Some),
            polygon,
        }],
        ..Outcome::unchanged(deviation)
    })
}

/// The highest degree that so many vertices make a curve of.
fn highest(polygon: &FloatPolygon) -> usize {
    MAX_DEGREE.min(polygon.vertices().len() - 1)
}
