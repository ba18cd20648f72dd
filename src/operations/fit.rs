//! A curve through the middle of points.

use super::amount::Amount;
use super::error::OperationError;
use super::inputs::Inputs;
use super::lists::{given, given_count};
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::parameter::{Kind, POSITIVE, Parameter};
use super::values::Values;
use crate::document::{Curve, Edit};
use crate::geometry::approximation::{FitError, FitRequest, Fitted, fit_points};
use crate::geometry::parameters::OutOfRange;
use crate::geometry::{MAX_DEGREE, Progress, counted, significant};

/// A fit is far off if the nearest one with as many vertices is nearer by this factor.
const FAR: f64 = 1.3;

const DEGREE: Parameter = Parameter {
    name: "degree",
    label: "Degree",
    help: "The degree of the float polygon",
    kind: Kind::whole_of(
        Amount::Number(1.0),
        Amount::Number(MAX_DEGREE as f64),
        Amount::Of {
            words: "5, or less where there are few points",
            value: |input| Ok(input.points().len().saturating_sub(1).clamp(1, 5) as f64),
        },
    ),
};

const COUNT: Parameter = Parameter {
    name: "count",
    label: "Vertices",
    help: "The number of vertices",
    kind: Kind::optional_count(usize::MAX, false, |_| "from the points or the tolerance"),
};

const EXTREMA: Parameter = Parameter {
    name: "extrema",
    label: "Curvature extrema",
    help: "How many extrema of the curvature the curve has, proved",
    kind: Kind::optional_count(usize::MAX, false, |_| "any number"),
};

const TOLERANCE: Parameter = Parameter {
    name: "tolerance",
    label: "Tolerance",
    help: "How far points may be from the curve, outliers aside; the curve is as fair as this allows",
    kind: Kind::optional_number(POSITIVE, |_| "none"),
};

/// The operation: its description, and how it is run.
pub static OPERATION: Operation = Operation {
    name: "fit",
    label: "Fit points",
    help: "Draw a fair curve through the middle of points by least squares; points far off do not count",
    inputs: Inputs::Points,
    parameters: &[DEGREE, COUNT, EXTREMA, TOLERANCE],
    check: |_| Ok(()),
    unused: |_| &[],
    run,
};

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let asked = FitRequest {
        degree: values.whole(&DEGREE),
        count: vertices(input, values)?,
        extrema: given_count(values, &EXTREMA),
        tolerance: given(values, &TOLERANCE),
    };
    let found = match fit_points(input.points(), &asked, progress) {
        Ok(found) => found,
        Err(FitError::Cancelled) => return Err(OperationError::Cancelled),
        Err(error) => return Err(error.into()),
    };
    let name = input.document().free_name("fit");
    let annotations = found.outliers.iter();
    let annotations = annotations.filter_map(|index| input.points().get(*index));
    Ok(Outcome {
        reached: found.reached,
        edits: vec![Edit::Add(Box::new(Curve::new(name, found.polygon.clone())))],
        figures: figures(&asked, &found),
        remarks: remarks(&asked, &found),
        annotations: annotations.map(|point| Annotation::Point(*point)).collect(),
        ..Outcome::unchanged(Deviation::FromPoints(found.largest))
    })
}

/// The number of vertices asked for, at most as many as there are points.
fn vertices(input: &Operands, values: &Values) -> Result<Option<usize>, OperationError> {
    let most = input.points().len();
    match given_count(values, &COUNT) {
        Some(count) if count > most => Err(OutOfRange {
            label: COUNT.label,
            value: count.to_string().into(),
            needed: format!("at most {most}, the number of points,").into(),
        }
        .into()),
        count => Ok(count),
    }
}

fn figures(asked: &FitRequest, found: &Fitted) -> Vec<Figure> {
    let any = asked.extrema.map(|_| {
        let label = "RMS with any number of extrema";
        Figure::length("rms_of_any", label, found.rms_of_any)
    });
    let before = [
        Figure::count("vertices", "Vertices", found.polygon.vertices().len()),
        Figure::count("extrema", "Curvature extrema", found.extrema),
        Figure::length("rms", "Off on average (RMS)", found.rms),
    ];
    let behind = [
        Figure::count("outliers", "Outliers", found.outliers.len()),
        Figure::indices("outlying_points", "Outlying points", &found.outliers),
        Figure::number("fairness", "Fairness weight", found.fairness),
    ];
    before.into_iter().chain(any).chain(behind).collect()
}

/// What is to say beside the figures: counts and tolerances that are missed, and a fit that is far off.
fn remarks(asked: &FitRequest, found: &Fitted) -> Vec<String> {
    let mut remarks = Vec::new();
    let vertices = found.polygon.vertices().len();
    if let Some(extrema) = asked.extrema.filter(|extrema| *extrema != found.extrema) {
        let has = counted(found.extrema, "curvature extremum", "curvature extrema");
        remarks.push(format!(
            "The curve has {has}, {extrema} asked for: give it more vertices, or ask for another number"
        ));
    } else if found.rms > FAR * found.rms_of_any {
        let [rms, any] = [found.rms, found.rms_of_any].map(|length| significant(length, 3));
        remarks.push(format!(
            "With any number of extrema {vertices} vertices come nearer to the points: RMS {any}, not {rms}. Give the curve more vertices, or ask for another number of extrema"
        ));
    }
    if let Some(tolerance) = asked
        .tolerance
        .filter(|tolerance| found.largest > *tolerance)
    {
        let [largest, tolerance] = [found.largest, tolerance].map(|length| significant(length, 3));
        let more = match (asked.count, asked.extrema) {
            (Some(_), _) => "give it more vertices, or allow more",
            (None, Some(_)) => "allow more, or another number of extrema",
            (None, None) => "allow more",
        };
        remarks.push(format!(
            "One point is {largest} off the curve, the tolerance is {tolerance}: {more}"
        ));
    }
    remarks
}
