//! A reference, or a curve in another degree or count, approximated by a float polygon.

use glam::DVec3;

use super::alternatives::remark_on_alternatives;
use super::editable::check_editable;
use super::error::OperationError;
use super::inputs::Inputs;
use super::lists::{given, given_count};
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Annotation, Deviation, Figure, Outcome};
use super::parameter::{ANY, Choice, Kind, POSITIVE, Parameter};
use super::time_limit::{TIME_LIMIT, limited, why_ended};
use super::values::Values;
use crate::document::{Curve, CurveId, Edit, ParameterSpan};
use crate::geometry::approximation::{
    Approximated, ApproximationError, ApproximationRequest, Goal, LevelComparison, MOST_SEGMENTS,
    Placing, Spacing, Watched, approximate_between, approximate_by_steps, approximate_to_tolerance,
};
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::references::ReferenceCurve;
use crate::geometry::{
    Differentiable, FloatPolygon, MAX_DEGREE, Progress, bounds, sampled_cusps, significant,
};

/// The most vertices that can be asked for.
const MOST: usize = 10_000;

/// The number of vertices if none is given, if the degree allows it.
const COUNT_OFFERED: usize = 20;

/// If none is given the number is doubled while the corrections of quasi-interpolation grow, so many times at most.
const DOUBLINGS: usize = 5;

/// A curve that is farther off than this share of the reference's size hardly follows it.
const FAR: f64 = 0.1;

/// The steps between the points that show the size of a reference.
const SIZE_SAMPLES: usize = 256;

/// The share that the search has of all work; what else would do is told afterwards.
const SEARCH: f64 = 0.8;

/// The share of the time that is left for what else would do; in the rest features are proved.
const ALTERNATIVES: f64 = 0.8;

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
            Choice::new("on-curve", "On the curve"),
            Choice::new("quasi", "Quasi"),
        ],
        default: 1,
    },
};

const PLACINGS: [Placing; 2] = [Placing::OnCurve, Placing::Quasi];

const DEGREE: Parameter = Parameter {
    name: "degree",
    label: "Degree",
    help: "The degree of the float polygon",
    kind: Kind::whole(1, MAX_DEGREE, 8),
};

const FROM: Parameter = Parameter {
    name: "from",
    label: "From",
    help: "The parameter where the curve begins; with a step, the one of vertex 0",
    kind: Kind::optional_number(ANY, |_| "where the reference begins"),
};

const TO: Parameter = Parameter {
    name: "to",
    label: "To",
    help: "The parameter where the curve ends; of a periodic curve that runs once round if it is not given",
    kind: Kind::optional_number(ANY, |_| "where the reference ends"),
};

const STEP: Parameter = Parameter {
    name: "step",
    label: "Step",
    help: "Distance between the parameters of neighbouring vertices",
    kind: Kind::optional_number(POSITIVE, |_| "even parts from start to end"),
};

const COUNT: Parameter = Parameter {
    name: "count",
    label: "Vertices",
    help: "The number of vertices",
    kind: Kind::optional_count(
        MOST,
        false,
        |_| "from the tolerance; without one 20, up to 640 while corrections grow",
    ),
};

const TOLERANCE: Parameter = Parameter {
    name: "tolerance",
    label: "Tolerance",
    help: "Largest distance of the curve from the reference; its levels must have the same features too",
    kind: Kind::optional_number(POSITIVE, |_| "none"),
};

const SPACING: Parameter = Parameter {
    name: "spacing",
    label: "Spacing",
    help: "Whether even steps follow the parameter, the arc length, or arc length and turning together",
    kind: Kind::Choice {
        options: &[
            Choice::new("automatic", "Automatic"),
            Choice::new("parameter", "Parameter"),
            Choice::new("arc-length", "Arc length"),
            Choice::new("curvature", "Curvature"),
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
    help: "How many levels of curvature and torsion must have the features of the reference",
    kind: Kind::whole(0, crate::geometry::LEVELS, 2),
};

const FIT_ENDS: Parameter = Parameter {
    name: "fit-ends",
    label: "Exact ends",
    help: "Give both ends the reference's points and directions; all vertices share the correction",
    kind: Kind::Switch { default: false },
};

/// The operation: its description, and how it is run.
pub static OPERATION: Operation = Operation {
    name: "approximate",
    label: "Approximate",
    help: "Make a float polygon whose curve follows a reference, or the chosen curve in another degree or count",
    inputs: Inputs::OneOrNone,
    each: true,
    parameters: &[
        REFERENCE, METHOD, DEGREE, FROM, TO, STEP, COUNT, TOLERANCE, SPACING, LEVELS, FIT_ENDS,
        TIME_LIMIT,
    ],
    check: |input| match input.curves() {
        [] => Ok(()),
        _ => check_editable(input),
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
    fn of(input: &'a Operands, values: &'a Values) -> Result<Self, OperationError> {
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

    /// Refuse a part that a reference does not have, or with a place without a point in it.
    fn check(&self, part: [f64; 2]) -> Result<(), OperationError> {
        let ascends = part[0] < part[1];
        match self {
            Self::Reference(reference) if ascends => Ok(reference.over(part)?.check_points()?),
            _ => Ok(()),
        }
    }

    /// The parameters between two others at which it stops, as samples show.
    fn cusps(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        match self {
            Self::Reference(reference) => match reference.over([from, to]) {
                Ok(part) => {
                    let cusps = sampled_cusps(&part).into_iter();
                    cusps.map(|u| part.parameter(u)).collect()
                }
                Err(_) => Vec::new(),
            },
            Self::Curve(polygon) => {
                let cusps = sampled_cusps(*polygon).into_iter();
                cusps.filter(|u| (from..=to).contains(u)).collect()
            }
        }
    }

    fn is_periodic(&self) -> bool {
        matches!(self, Self::Curve(polygon) if polygon.is_periodic())
    }

    fn interval(&self) -> [f64; 2] {
        match self {
            Self::Reference(reference) => reference.interval(),
            Self::Curve(polygon) => [0.0, polygon.segments() as f64],
        }
    }
}

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let source = Source::of(input, values)?;
    let tolerance = given(values, &TOLERANCE);
    let placing = values.choice(&METHOD, &PLACINGS);
    let search = limited(progress, values);
    let curve = Watched::new(source.differentiable(), progress);
    let found = approximated(&source, &curve, values, placing, tolerance, &search);
    if progress.is_cancelled() {
        return Err(OperationError::Cancelled);
    }
    let id = match source {
        Source::Reference(_) => input.document().next_id(),
        Source::Curve(_) => input.curve()?.0,
    };
    let (found, alternatives) = match found {
        Err(OperationError::Approximation(ApproximationError::Cancelled)) => {
            return Ok(nothing_in_time(id, &why_ended(&search, values)));
        }
        found => found?,
    };
    let nearer = match placing {
        Placing::OnCurve => by_quasi_interpolation(&Watched::new(&curve, &search), values, &found),
        Placing::Quasi => None,
    };
    let deviation = match found.deviation.bounded {
        true => Deviation::AtMost(found.deviation.largest),
        false => Deviation::Measured(found.deviation.largest),
    };
    let annotations = annotations(&source, &found);
    let outcome = match source {
        Source::Reference(reference) => {
            let name = reference.form().label().to_lowercase();
            let name = input.document().free_name(&name);
            let curve = Curve::new(name, found.polygon.clone());
            let curve = curve.in_group(input.group(Some(reference)));
            Outcome {
                edits: vec![Edit::Add(Box::new(curve))],
                ..Outcome::unchanged(deviation)
            }
        }
        Source::Curve(_) => {
            let polygon = input.polygon()?;
            Outcome::renumbered(
                input,
                found.polygon.clone(),
                spans(polygon, &found.polygon),
                deviation,
            )?
        }
    };
    let mut remarks = outcome.remarks.clone();
    let why = why_ended(&search, values);
    remarks.extend(remark_on_time(&why, &found, tolerance));
    remarks.extend(alternatives);
    remarks.extend(remark_on_levels(values, &found));
    remarks.extend(remark_on_size(&source, &found, tolerance));
    remarks.extend(remark_on_corrections(&found));
    remarks.extend(remark_on_cusps(&source, found.interval));
    remarks.extend(remark_on_quasi(&found, nearer));
    let limit = tolerance.map(|most| Requirement::Limit {
        found: found.distance(),
        most,
    });
    let differs = tolerance.is_some() && !found.is_equivalent();
    let differs = differs.then_some(Requirement::Failed { left: None });
    Ok(Outcome {
        requirements: vec![(id, limit.into_iter().chain(differs).collect())],
        figures: figures(&found),
        annotations,
        equivalence: Some(found.levels),
        remarks,
        ..outcome
    })
}

/// The outcome of a search whose time was up before it found anything.
fn nothing_in_time(id: CurveId, why: &str) -> Outcome {
    Outcome {
        requirements: vec![(id, vec![Requirement::Failed { left: None }])],
        remarks: vec![format!(
            "{why} before a curve was found: allow more, or choose a part of the reference"
        )],
        ..Outcome::unchanged(Deviation::Unmeasured)
    }
}

/// Say that the time was up before the search came to its end.
fn remark_on_time(why: &str, found: &Approximated, tolerance: Option<f64>) -> Option<String> {
    let is_reached = tolerance.is_some_and(|tolerance| found.meets(tolerance));
    let what = match is_reached {
        true => "fewer vertices may do",
        false => "this is the best found so far",
    };
    found.stopped.then(|| format!("{why}: {what}"))
}

/// The parameters of a curve with those of its approximation: at the approximation's knots the nearest points, as far
/// as these follow one another along the curve.
fn spans(curve: &FloatPolygon, approximation: &FloatPolygon) -> Vec<ParameterSpan> {
    let segments = [curve, approximation].map(|polygon| polygon.segments());
    let [last, new_last] = segments.map(|segments| segments as f64);
    let inner = (1..segments[1]).map(|knot| {
        let new = knot as f64;
        [curve.nearest(approximation.point(new)).u, new]
    });
    let mut places = vec![[0.0, 0.0]];
    for place in inner {
        let before = places.last().map_or(0.0, |[old, _]| *old);
        if place[0] > before && place[0] < last {
            places.push(place);
        }
    }
    places.push([last, new_last]);
    let pairs = places.windows(2);
    let spans = pairs.map(|pair| ParameterSpan {
        old: [pair[0][0], pair[1][0]],
        new: [pair[0][1], pair[1][1]],
    });
    spans.collect()
}

/// Approximate as asked; where a tolerance is not reached with a remark on what would do.
fn approximated(
    source: &Source<'_>,
    curve: &dyn Differentiable,
    values: &Values,
    placing: Placing,
    tolerance: Option<f64>,
    progress: &Progress,
) -> Result<(Approximated, Option<String>), OperationError> {
    let degree = values.whole(&DEGREE);
    let count = given_count(values, &COUNT);
    let part = Part::of(source, values, tolerance, count)?;
    let asked = ApproximationRequest {
        degree,
        placing,
        levels: values.whole(&LEVELS),
        periodic: matches!(part, Part::Round(_)),
        fit_ends: values.switch(&FIT_ENDS),
    };
    let offered = COUNT_OFFERED.max(degree + 1);
    source.check(part.interval(degree, count.unwrap_or(offered)))?;
    let interval = match part {
        Part::Steps(steps) => {
            let count = count.unwrap_or(offered);
            return Ok((approximate_by_steps(curve, steps, count, &asked)?, None));
        }
        Part::Between(interval) | Part::Round(interval) => interval,
    };
    let spacing = values.choice(&SPACING, &SPACINGS);
    Ok(match (count, tolerance) {
        (None, Some(tolerance)) => {
            let goal = Goal {
                tolerance,
                spacing,
                most_segments: MOST_SEGMENTS,
            };
            let first = progress.part(0.0, SEARCH);
            let found = approximate_to_tolerance(curve, interval, &goal, &asked, &first)?;
            let rest = progress.part(SEARCH, 1.0).hurried(ALTERNATIVES);
            let remark = match found.stopped {
                true => None,
                false => remark_on_alternatives(curve, interval, &goal, &asked, &found, &rest),
            };
            (found, remark)
        }
        _ => {
            let spacing = spacing.unwrap_or(Spacing::Parameter);
            let by = |count, asked: &ApproximationRequest| {
                approximate_between(curve, interval, count, spacing, asked)
            };
            let count = count.unwrap_or_else(|| {
                let plain = ApproximationRequest { levels: 0, ..asked };
                let mut counts = (0..DOUBLINGS).map(|doublings| offered << doublings);
                let fades = counts.find(|count| by(*count, &plain).is_ok_and(|it| !diverges(&it)));
                fades.unwrap_or(offered << DOUBLINGS)
            });
            (by(count, &asked)?, None)
        }
    })
}

/// Whether the corrections of quasi-interpolation grow instead of fading.
fn diverges(found: &Approximated) -> bool {
    found.corrections.is_some_and(|it| it.growth > 1.0)
}

/// How far as many vertices by quasi-interpolation would be off, where levels are not compared; `None` where there
/// are none.
fn by_quasi_interpolation(
    curve: &dyn Differentiable,
    values: &Values,
    found: &Approximated,
) -> Option<f64> {
    let asked = ApproximationRequest {
        degree: found.polygon.degree(),
        placing: Placing::Quasi,
        levels: 0,
        periodic: found.polygon.is_periodic(),
        fit_ends: values.switch(&FIT_ENDS),
    };
    let count = found.polygon.vertices().len();
    let quasi = approximate_between(curve, found.interval, count, found.spacing, &asked);
    Some(quasi.ok()?.deviation.largest)
}

/// What part of the curve is approximated.
enum Part {
    /// Vertex i belongs to the first number + i times the second one.
    Steps([f64; 2]),
    /// From one parameter to another.
    Between([f64; 2]),
    /// Once round a periodic curve.
    Round([f64; 2]),
}

impl Part {
    fn of(
        source: &Source<'_>,
        values: &Values,
        tolerance: Option<f64>,
        count: Option<usize>,
    ) -> Result<Self, OperationError> {
        let [start, end] = source.interval();
        let from = given(values, &FROM).unwrap_or(start);
        let to = given(values, &TO);
        let step = given(values, &STEP);
        let excluded = [(&TO, to), (&TOLERANCE, tolerance)];
        let excluded = excluded.iter().find(|(_, other)| other.is_some());
        if let (Some(_), Some((other, _))) = (step, excluded) {
            let (first, second) = (STEP.label, other.label);
            return Err(OperationError::Exclude { first, second });
        }
        let period = source.is_periodic().then_some(end - start);
        Ok(match (step, period) {
            (None, None) => Self::Between([from, to.unwrap_or(end)]),
            (None, Some(period)) => match to {
                Some(to) if to - from != period => Self::Between([from, to]),
                _ => Self::Round([from, from + period]),
            },
            // Steps that run once round make a periodic curve; others stop somewhere.
            (Some(step), Some(period)) if is_once(step, count, period) => {
                let degree = values.whole(&DEGREE) as f64;
                let begin = from + 0.5 * (degree - 1.0) * step;
                Self::Round([begin, begin + period])
            }
            (Some(step), _) => Self::Steps([from, step]),
        })
    }
}

impl Part {
    /// From where to where a curve of so many vertices runs.
    fn interval(&self, degree: usize, count: usize) -> [f64; 2] {
        match *self {
            Self::Between(interval) | Self::Round(interval) => interval,
            Self::Steps([from, step]) => {
                let begin = from + 0.5 * (degree as f64 - 1.0) * step;
                [begin, begin + step * count.saturating_sub(degree) as f64]
            }
        }
    }
}

/// Whether so many steps are the period, but for rounding.
fn is_once(step: f64, count: Option<usize>, period: f64) -> bool {
    count.is_some_and(|count| (step * count as f64 - period).abs() <= 1e-12 * period)
}

fn figures(found: &Approximated) -> Vec<Figure> {
    let mut figures = vec![
        Figure::count("vertices", "Vertices", found.polygon.vertices().len()),
        Figure::length("mean_deviation", "Mean deviation", found.deviation.mean),
    ];
    // From point to point, unlike the deviation, which goes to the nearest one.
    if let Some([start, end]) = found.end_errors {
        figures.push(Figure::length("start_error", "Start to start", start));
        figures.push(Figure::length("end_error", "End to end", end));
    }
    figures
}

/// Where the deviation is largest, and where levels first differ.
fn annotations(source: &Source<'_>, found: &Approximated) -> Vec<Annotation> {
    let difference = |level: &LevelComparison| {
        let (there, here) = level.side_by_side().nth(level.first_difference()?)?;
        Some(match (there, here) {
            (_, Some((u, _))) => found.polygon.point(u),
            (Some((t, _)), None) => source.differentiable().derivatives(t, 0)[0],
            (None, None) => return None,
        })
    };
    let largest = found.polygon.point(found.deviation.u);
    let differences = found.levels.iter().filter_map(difference);
    let places: Vec<DVec3> = std::iter::once(largest).chain(differences).collect();
    places.into_iter().map(Annotation::Point).collect()
}

/// Say that the curve is far off, where no tolerance does.
fn remark_on_size(
    source: &Source<'_>,
    found: &Approximated,
    tolerance: Option<f64>,
) -> Option<String> {
    let [from, to] = found.interval;
    let curve = source.differentiable();
    let sample = |index: usize| {
        let share = index as f64 / SIZE_SAMPLES as f64;
        curve.derivatives(from * (1.0 - share) + to * share, 0)[0]
    };
    let (low, high) = bounds((0..=SIZE_SAMPLES).map(sample));
    let size = low.distance(high);
    let off = found.distance();
    (tolerance.is_none() && off > FAR * size).then(|| {
        let [off, size] = [off, size].map(|length| significant(length, 3));
        format!("The curve is {off} off a reference of size {size}: take more vertices, or give a tolerance")
    })
}

/// Say that quasi-interpolation diverges: its corrections grow instead of fading.
fn remark_on_corrections(found: &Approximated) -> Option<String> {
    let corrections = found.corrections.filter(|_| diverges(found))?;
    Some(format!(
        "The corrections that quasi-interpolation makes do not fade but grow, {} times at vertex {}: its vertices are not where they belong; take more vertices, a lower degree, or vertices on the curve",
        significant(corrections.growth, 2),
        corrections.vertex,
    ))
}

/// Say that quasi-interpolation would be nearer, if it is by more than a factor of 2.
fn remark_on_quasi(found: &Approximated, quasi: Option<f64>) -> Option<String> {
    let (own, quasi) = (found.deviation.largest, quasi?);
    (2.0 * quasi < own).then(|| {
        format!(
            "With vertices on the curve it is {} off: that keeps the shape, not the place. Method quasi would be {} off",
            significant(own, 3),
            significant(quasi, 3)
        )
    })
}

/// Say where the curve stops: the rule for cusps.
fn remark_on_cusps(source: &Source<'_>, interval: [f64; 2]) -> Option<String> {
    let cusps = source.cusps(interval);
    let first = significant(*cusps.first()?, 5);
    let (what, place) = match cusps.len() {
        1 => ("a cusp".to_owned(), "it"),
        count => (format!("{count} cusps, the first"), "them"),
    };
    Some(format!(
        "What is approximated has {what} at {first}: it has no curvature there, levels are compared beside {place}, and vertices can be spaced by its parameter only"
    ))
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
