//! A reference, or a curve in another degree or count, approximated by a float polygon.

use glam::DVec3;

use super::editable::open;
use super::error::OperationError;
use super::input::Input;
use super::inputs::Inputs;
use super::lists::{count, given, number, positive};
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Mark, Outcome};
use super::parameter::{Choice, Kind, Parameter};
use super::values::Values;
use super::whole;
use crate::document::{Curve, Edit};
use crate::geometry::approximation::{
    Approximated, Asked, Placing, Spacing, approximate_between, approximate_by_steps,
    approximate_to_tolerance,
};
use crate::geometry::references::ReferenceCurve;
use crate::geometry::{Differentiable, FloatPolygon, Progress};

/// The most vertices that can be asked for.
const MOST: usize = 10_000;

/// The number of vertices if none is given, if the degree allows it.
const COUNT_OFFERED: usize = 20;

const REFERENCE: Parameter = Parameter {
    name: "reference",
    label: "Reference",
    help: "The reference to approximate, such as conical-spiral, circle:radius=10 or formula:x=t;y=sin(t)",
    kind: Kind::Reference {
        none: "the chosen curve",
    },
};

const METHOD: Parameter = Parameter {
    name: "method",
    label: "Method",
    help: "Vertices by quasi-interpolation keep place and shape; vertices on the curve keep the shape alone",
    kind: Kind::Choice {
        options: &[
            Choice {
                name: "on-curve",
                label: "On the curve",
            },
            Choice {
                name: "quasi",
                label: "Quasi",
            },
        ],
        default: 1,
    },
};

const PLACINGS: [Placing; 2] = [Placing::OnCurve, Placing::Quasi];

const DEGREE: Parameter = Parameter {
    name: "degree",
    label: "Degree",
    help: "The degree of the float polygon",
    kind: whole::degree(8),
};

const FROM: Parameter = Parameter {
    name: "from",
    label: "From",
    help: "The parameter where the curve begins; with a step, the one of vertex 0",
    kind: number(|_| "where the reference begins"),
};

const TO: Parameter = Parameter {
    name: "to",
    label: "To",
    help: "The parameter where the curve ends",
    kind: number(|_| "where the reference ends"),
};

const STEP: Parameter = Parameter {
    name: "step",
    label: "Step",
    help: "How far the parameters of neighbouring vertices lie apart: vertex i belongs to from + i · step",
    kind: number(|_| "even parts from start to end"),
};

const COUNT: Parameter = Parameter {
    name: "count",
    label: "Vertices",
    help: "The number of vertices",
    kind: count(|_| "from the tolerance, or 20 without one"),
};

const TOLERANCE: Parameter = Parameter {
    name: "tolerance",
    label: "Tolerance",
    help: "How far the curve may be off; its levels must have the features of the reference too",
    kind: number(|_| "none"),
};

const SPACING: Parameter = Parameter {
    name: "spacing",
    label: "Spacing",
    help: "Whether even steps follow the parameter, the arc length, or arc length and turning together",
    kind: Kind::Choice {
        options: &[
            Choice {
                name: "automatic",
                label: "Automatic",
            },
            Choice {
                name: "parameter",
                label: "Parameter",
            },
            Choice {
                name: "arc-length",
                label: "Arc length",
            },
            Choice {
                name: "curvature",
                label: "Curvature",
            },
        ],
        default: 0,
    },
};

const SPACINGS: [Option<Spacing>; 4] = [
    None,
    Some(Spacing::Parameter),
    Some(Spacing::ArcLength),
    Some(Spacing::Curvature),
];

const LEVELS: Parameter = Parameter {
    name: "levels",
    label: "Levels",
    help: "How many levels of curvature and torsion are compared with those of the reference",
    kind: whole::between(0, crate::geometry::LEVELS, 2),
};

const FIT_ENDS: Parameter = Parameter {
    name: "fit-ends",
    label: "Exact ends",
    help: "Bring both ends to the points and directions of the reference, moving all vertices evenly",
    kind: Kind::Switch { default: false },
};

/// The operation: its description, and how it is run.
pub static OPERATION: Operation = Operation {
    name: "approximate",
    label: "Approximate",
    help: "Make a float polygon whose curve follows a reference, or the chosen curve in another degree or count",
    inputs: Inputs::OneOrNone,
    parameters: &[
        REFERENCE, METHOD, DEGREE, FROM, TO, STEP, COUNT, TOLERANCE, SPACING, LEVELS, FIT_ENDS,
    ],
    check: |input| match input.curves() {
        [] => Ok(()),
        _ => open(input, "approximated").map(drop),
    },
    unused: |_| &[],
    run,
};

/// What is approximated.
enum Source<'a> {
    Reference(&'a ReferenceCurve),
    Curve(&'a FloatPolygon),
}

impl<'a> Source<'a> {
    fn of(input: &'a Input, values: &'a Values) -> Result<Self, OperationError> {
        if let Some(reference) = values.reference(&REFERENCE) {
            return match reference.form().is_smooth() {
                true => Ok(Self::Reference(reference)),
                false => Err(OperationError::PointsOnly),
            };
        }
        let needed = Inputs::OneOrNone;
        let polygon = input.polygon();
        let polygon = polygon.map_err(|_| OperationError::Inputs { needed })?;
        Ok(Self::Curve(polygon))
    }

    fn differentiable(&self) -> &'a dyn Differentiable {
        match self {
            Self::Reference(reference) => *reference,
            Self::Curve(polygon) => *polygon,
        }
    }

    fn interval(&self) -> [f64; 2] {
        match self {
            Self::Reference(reference) => reference.interval(),
            Self::Curve(polygon) => [0.0, polygon.segments() as f64],
        }
    }
}

fn run(input: &Input, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let source = Source::of(input, values)?;
    let tolerance = positive(values, &TOLERANCE)?;
    let found = approximated(&source, values, tolerance, progress)?;
    let deviation = Deviation::Measured(found.deviation.largest);
    let outcome = match source {
        Source::Reference(reference) => {
            let name = reference.form().label().to_lowercase();
            let name = input.document().free_name(&name);
            Outcome {
                edits: vec![Edit::Add(Box::new(Curve::new(name, found.polygon.clone())))],
                ..Outcome::unchanged(deviation)
            }
        }
        Source::Curve(_) => {
            let (id, curve) = input.curve()?;
            Outcome::renumbered(id, curve, found.polygon.clone(), deviation)
        }
    };
    let mut remarks = outcome.remarks.clone();
    remarks.extend(remark_on_levels(values, &found));
    Ok(Outcome {
        reached: tolerance.is_none_or(|tolerance| found.meets(tolerance)),
        figures: figures(&found),
        marks: marks(&found),
        equivalence: Some(found.levels),
        remarks,
        ..outcome
    })
}

fn approximated(
    source: &Source<'_>,
    values: &Values,
    tolerance: Option<f64>,
    progress: &Progress,
) -> Result<Approximated, OperationError> {
    let curve = source.differentiable();
    let degree = values.whole(&DEGREE);
    let asked = Asked {
        degree,
        placing: values.choice(&METHOD, &PLACINGS),
        levels: values.whole(&LEVELS),
        fit_ends: values.switch(&FIT_ENDS),
    };
    let [start, end] = source.interval();
    let from = given(values, &FROM).unwrap_or(start);
    let offered = COUNT_OFFERED.max(degree + 1);
    let count = given(values, &COUNT).map(|count| count as usize);
    if let Some(count) = count.filter(|count| *count > MOST) {
        return Err(OperationError::OutOfRange {
            label: COUNT.label,
            value: count.to_string(),
            needed: format!("at most {MOST}"),
        });
    }
    if let Some(step) = given(values, &STEP) {
        for other in [&TO, &TOLERANCE] {
            if given(values, other).is_some() {
                let (first, second) = (STEP.label, other.label);
                return Err(OperationError::Exclude { first, second });
            }
        }
        let count = count.unwrap_or(offered);
        return Ok(approximate_by_steps(curve, [from, step], count, &asked)?);
    }
    let interval = [from, given(values, &TO).unwrap_or(end)];
    let spacing = values.choice(&SPACING, &SPACINGS);
    Ok(match (count, tolerance) {
        (None, Some(tolerance)) => {
            approximate_to_tolerance(curve, interval, tolerance, spacing, &asked, progress)?
        }
        _ => {
            let spacing = spacing.unwrap_or(Spacing::Parameter);
            let count = count.unwrap_or(offered);
            approximate_between(curve, interval, count, spacing, &asked)?
        }
    })
}

fn figures(found: &Approximated) -> Vec<Figure> {
    let [start, end] = found.end_errors;
    vec![
        Figure::count("vertices", "Vertices", found.polygon.vertices().len()),
        Figure::length("mean_deviation", "Mean deviation", found.deviation.mean),
        Figure::length("start_error", "Off at the start", start),
        Figure::length("end_error", "Off at the end", end),
    ]
}

/// Where the deviation is largest, and where levels first differ.
fn marks(found: &Approximated) -> Vec<Mark> {
    let differences = found.levels.iter().filter_map(|level| {
        let (u, _) = level.here.get(level.first_difference()?)?;
        Some(*u)
    });
    let places = std::iter::once(found.deviation.u).chain(differences);
    let point = |u: f64| -> DVec3 { found.polygon.point(u) };
    places.map(|u| Mark::Point(point(u))).collect()
}

/// Say which levels the degree leaves out.
fn remark_on_levels(values: &Values, found: &Approximated) -> Option<String> {
    let asked = values.whole(&LEVELS);
    let kinds = if found.polygon.is_planar() { 1 } else { 2 };
    let left_out = asked * kinds - found.levels.len();
    (left_out > 0).then(|| {
        format!(
            "{left_out} of {} levels are not compared: they are not continuous at degree {}",
            asked * kinds,
            found.polygon.degree()
        )
    })
}
