//! Both ends brought to their targets: at once, or step by step (step 7 of the end fit).

use std::ops::Bound;

use glam::DVec3;

use super::amount::Amount;
use super::editable::{check_measurable, open};
use super::end_change::{is_another, refine_first, warnings_of_change};
use super::error::OperationError;
use super::features::{gains_cusp, proved, remark_on_lost_inflections};
use super::inputs::Inputs;
use super::lists::{LOCKED, given, locked};
use super::operands::Operands;
use super::operation::Operation;
use super::outcome::{Deviation, Figure, Outcome};
use super::parameter::{ANY, Choice, Kind, Parameter};
use super::targets::{SHARE_OF_SIZE, annotations, corrected, cusp, place_of, residual};
use super::turned_over::turned_over;
use super::values::Values;
use crate::document::{Curve, CurveId, EditError};
use crate::geometry::end_correction::{EndOverlap, EndTarget, correct_in_turn};
use crate::geometry::fairing::joint_correction::{CorrectionError, Disturbance, correct_jointly};
use crate::geometry::fairing::requirement::{Check, Requirement};
use crate::geometry::features::{Feature, Features};
use crate::geometry::parameters::{Number, Quantity};
use crate::geometry::{End, FloatPolygon, Progress, counted, significant};

/// What is left where only rounding is left, in units of the polygon's size.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

const ROUNDING_LEAVES_MORE: &str = "Rounding leaves more than the tolerance: allow more";

const METHOD: Parameter = Parameter {
    name: "method",
    label: "Method",
    help: "Both ends at once, or steps 2 to 6 repeated, which meet points and directions only",
    kind: Kind::Choice {
        options: &[
            Choice::new("joint", "Both ends at once"),
            Choice::new("steps", "Step by step"),
        ],
        default: 0,
    },
};

const ORDER: Parameter = Parameter {
    name: "order",
    label: "Disturb least",
    help: "What moves least: vertices (differences of an order), the curve, or else disharmony",
    kind: Kind::Choice {
        options: &[
            Choice::new("automatic", "Automatic"),
            Choice::new("1", "Vertices, order 1"),
            Choice::new("2", "Vertices, order 2"),
            Choice::new("3", "Vertices, order 3"),
            Choice::new("curve", "Curve"),
            Choice::new("harmonious", "Harmony"),
        ],
        default: 0,
    },
};

/// The meanings of the options of [`ORDER`].
const DISTURBANCES: [Option<Disturbance>; 6] = [
    None,
    Some(Disturbance::Differences(1)),
    Some(Disturbance::Differences(2)),
    Some(Disturbance::Differences(3)),
    Some(Disturbance::Curve),
    Some(Disturbance::Harmony),
];

/// What else is tried where the vertices that move least add features.
const FAIRER: [Disturbance; 5] = [
    Disturbance::Turned(2),
    Disturbance::Turned(3),
    Disturbance::Differences(1),
    Disturbance::Differences(2),
    Disturbance::Differences(3),
];

/// Automatic, a correction with fewer features may move the curve so many times as far as one with more.
const LITTLE_FARTHER: f64 = 1.5;

const TOLERANCE: Parameter = Parameter {
    name: "tolerance",
    label: "Tolerance",
    help: "Largest miss of a target; angles, curvatures and slopes are converted to lengths",
    kind: Kind::Real(Number {
        from: Bound::Excluded(Amount::Number(0.0)),
        to: Bound::Unbounded,
        default: Amount::Of {
            words: "1e-9 of the size of the polygon",
            value: |input| {
                let offered = SHARE_OF_SIZE * input.polygon()?.size();
                Ok(offered.max(f64::MIN_POSITIVE))
            },
        },
        quantity: Quantity::Length,
    }),
};

/// The parameters of one end.
struct EndParameters {
    point: Parameter,
    direction: Parameter,
    curvature: Parameter,
    slope: Parameter,
    normal: Parameter,
}

/// Describe the parameters of an end, whose names begin with that of the end.
macro_rules! end_parameters {
    ($end:expr, $name:literal, $label:literal) => {
        EndParameters {
            point: Parameter {
                name: $name,
                label: concat!($label, " point"),
                help: concat!("Where the curve has its ", $name),
                kind: Kind::vector(false, |input| kept(input, $end, |_| true, "where it is")),
            },
            direction: Parameter {
                name: concat!($name, "-direction"),
                label: concat!($label, " direction"),
                help: concat!("The direction at the ", $name, ", along the curve"),
                kind: Kind::vector(false, |input| {
                    kept(input, $end, |it| it.direction.is_some(), "as it is")
                }),
            },
            curvature: Parameter {
                name: concat!($name, "-curvature"),
                label: concat!($label, " curvature"),
                help: concat!(
                    "The curvature at the ",
                    $name,
                    ", positive where a planar curve turns left; by the joint method only"
                ),
                kind: Kind::optional_number(ANY, |input| {
                    kept(input, $end, |it| it.curvature.is_some(), "free")
                }),
            },
            slope: Parameter {
                name: concat!($name, "-slope"),
                label: concat!($label, " curvature slope"),
                help: concat!(
                    "The slope of the curvature at the ",
                    $name,
                    ", by arc length; by the joint method only"
                ),
                kind: Kind::optional_number(ANY, |input| {
                    kept(input, $end, |it| it.slope.is_some(), "free")
                }),
            },
            normal: Parameter {
                name: concat!($name, "-normal"),
                label: concat!($label, " normal"),
                help: concat!(
                    "The normal of the osculating plane at the ",
                    $name,
                    ", in space; by the joint method only"
                ),
                kind: Kind::vector(true, |input| {
                    kept(input, $end, |it| it.normal.is_some(), "free")
                }),
            },
        }
    };
}

const START: EndParameters = end_parameters!(End::Start, "start", "Start");
const FINISH: EndParameters = end_parameters!(End::Finish, "end", "End");

/// The default of a condition in words: as its target requires, otherwise as it is, or free.
fn kept(
    input: Option<&Operands>,
    end: End,
    asks: fn(&EndTarget) -> bool,
    otherwise: &'static str,
) -> &'static str {
    let Some(input) = input else {
        return "as the target is set";
    };
    let target = input
        .curve()
        .ok()
        .and_then(|(_, curve)| curve.targets.get(end));
    match target {
        Some(target) if asks(&target) => "as the target is set",
        Some(_) => "free",
        None => otherwise,
    }
}

/// The operation: its description, and how it is checked and run.
pub static OPERATION: Operation = Operation {
    name: "correct-ends",
    label: "Correct ends",
    help: "Bring the ends to their targets; an end without one keeps its point and direction",
    inputs: Inputs::One,
    each: false,
    parameters: &[
        METHOD,
        ORDER,
        START.point,
        START.direction,
        START.curvature,
        START.slope,
        START.normal,
        FINISH.point,
        FINISH.direction,
        FINISH.curvature,
        FINISH.slope,
        FINISH.normal,
        LOCKED,
        TOLERANCE,
    ],
    check: |input| check_measurable(open(input, "corrected at its ends")?),
    unused: |_| &[],
    run,
};

/// The result of a method.
struct Correction {
    /// The polygon, if the ends reach their targets.
    polygon: Option<FloatPolygon>,
    residual: f64,
    passes: usize,
    /// Why the targets are not reached.
    reason: String,
    /// What was chosen.
    remark: Option<String>,
}

fn run(input: &Operands, values: &Values, progress: &Progress) -> Result<Outcome, OperationError> {
    let both = values.choice(&METHOD, &[true, false]);
    if let (false, Some(label)) = (
        both,
        [&START, &FINISH]
            .into_iter()
            .find_map(|it| it.bends(values)),
    ) {
        return Err(OperationError::NotBySteps { label });
    }
    let (id, curve) = input.curve()?;
    let curve = &with_targets(input, id, curve, values)?;
    let tolerance = values.real(&TOLERANCE);
    let requirements = requirements(curve, values, tolerance)?;
    let is_met = |polygon: &FloatPolygon| {
        Check::of(&requirements, polygon, progress).is_some_and(|check| check.holds)
    };
    let correction = match both {
        true => at_once(curve, values, &is_met, progress)?,
        false => step_by_step(curve, values, &is_met, tolerance)?,
    };
    let failed = Requirement::Failed {
        left: Some(correction.residual),
    };
    let mut outcome = match correction.polygon {
        Some(polygon) if polygon == curve.polygon => {
            let mut outcome = Outcome::unchanged(Deviation::Exact);
            outcome.remarks = vec!["Already within the tolerance".to_owned()];
            outcome
        }
        Some(polygon) => {
            let turned = turned_over(&curve.polygon, &polygon);
            let before = &curve.polygon;
            let features = proved([before, &polygon], progress)?;
            let cusp = gains_cusp([before, &polygon], &features);
            let cusp_told = cusp.then(|| {
                let refine = refine_first(before);
                format!(
                    "A bend is nearly a cusp now: choose another way in “Disturb least”, or {refine}"
                )
            });
            let mut warnings: Vec<String> = cusp_told.into_iter().collect();
            warnings.extend(warnings_of_change(curve, &polygon, turned.as_deref())?);
            let lost = remark_on_lost_inflections(before.is_planar(), &features);
            warnings.extend(lost);
            let is_wrong = turned.is_some() || cusp || is_another(curve, &polygon)?;
            let outcome = corrected(id, curve, polygon)?;
            let failed = is_wrong.then_some(Requirement::Failed { left: None });
            let requirements = requirements.iter().cloned().chain(failed).collect();
            Outcome {
                warnings,
                remarks: correction.remark.into_iter().collect(),
                requirements: vec![(id, requirements)],
                ..outcome
            }
        }
        None => Outcome {
            requirements: vec![(id, vec![failed])],
            remarks: vec![correction.reason],
            ..Outcome::unchanged(Deviation::Exact)
        },
    };
    if outcome.requirements.is_empty() {
        outcome.requirements = vec![(id, requirements)];
    }
    let negative = |(_, target): &(End, EndTarget)| target.curvature.is_some_and(|it| it < 0.0);
    if !curve.polygon.is_planar() && curve.targets.list().iter().any(negative) {
        outcome
            .remarks
            .push("In space the curvature has no sign: its magnitude counts".to_owned());
    }
    let passes = correction.passes;
    outcome.figures = vec![
        Figure::count("passes", "Passes", passes),
        Figure::count("iterations", "Iterations", passes),
    ];
    outcome.annotations = End::BOTH.map(|end| annotations(curve, end)).concat();
    Ok(outcome)
}

/// What must hold: the targets, an end without one at its point and in its direction, and the locked vertices.
fn requirements(
    curve: &Curve,
    values: &Values,
    tolerance: f64,
) -> Result<Vec<Requirement>, OperationError> {
    let polygon = &curve.polygon;
    let places = targets(curve).into_iter();
    let places = places.map(|(end, target)| place_of(polygon, end, target, tolerance));
    let vertices = locked(curve, values)?.into_iter();
    let vertices = vertices.map(|vertex| Requirement::Vertex {
        vertex,
        point: polygon.vertex(vertex),
    });
    Ok(places.chain(vertices).collect())
}

/// The targets of both ends. An end without one keeps its point and direction.
fn targets(curve: &Curve) -> [(End, EndTarget); 2] {
    let kept = |end: End| EndTarget::keeping(&curve.polygon.end_jet(end));
    End::BOTH.map(|end| (end, curve.targets.get(end).unwrap_or_else(|| kept(end))))
}

/// The curve with its targets, changed by the values.
///
/// # Errors
/// [`OperationError::NoTarget`] without any target, [`OperationError::NoDirection`],
/// [`EditError::BadTarget`], or [`EditError::MatchedEnd`].
fn with_targets(
    input: &Operands,
    id: CurveId,
    curve: &Curve,
    values: &Values,
) -> Result<Curve, OperationError> {
    let mut aimed = curve.clone();
    for (end, parameters) in [(End::Start, &START), (End::Finish, &FINISH)] {
        parameters.check_directions(values)?;
        let target = parameters.target(curve, end, values);
        if target != curve.targets.get(end) {
            input.document().check_unmatched(id, end)?;
        }
        if target.is_some_and(|target| !target.is_usable()) {
            return Err(EditError::BadTarget.into());
        }
        aimed.targets.set(end, target);
    }
    if aimed.targets.list().is_empty() {
        return Err(OperationError::NoTarget { end: None });
    }
    Ok(aimed)
}

impl EndParameters {
    /// The label of a value that the steps cannot bring.
    fn bends(&self, values: &Values) -> Option<&'static str> {
        let bending = [&self.curvature, &self.slope, &self.normal].into_iter();
        let mut given = bending.filter(|parameter| !values.list(parameter).is_empty());
        given.next().map(|parameter| parameter.label)
    }

    /// Refuse directions of length 0.
    fn check_directions(&self, values: &Values) -> Result<(), OperationError> {
        let is_none = |parameter: &&Parameter| {
            let numbers = values.list(parameter);
            !numbers.is_empty() && numbers.iter().all(|number| *number == 0.0)
        };
        match [&self.direction, &self.normal].into_iter().find(is_none) {
            Some(Parameter { label, .. }) => Err(OperationError::NoDirection { label }),
            None => Ok(()),
        }
    }

    /// The target of an end, changed by the values. Without a target and a point the end keeps its
    /// point and direction.
    fn target(&self, curve: &Curve, end: End, values: &Values) -> Option<EndTarget> {
        let vector = |parameter| match *values.list(parameter) {
            [x, y] => Some(DVec3::new(x, y, 0.0)),
            [x, y, z] => Some(DVec3::new(x, y, z)),
            _ => None,
        };
        let set = curve.targets.get(end);
        let [point, direction, normal] = [&self.point, &self.direction, &self.normal].map(vector);
        let [curvature, slope] =
            [&self.curvature, &self.slope].map(|parameter| given(values, parameter));
        let bends = curvature.is_some() || slope.is_some() || normal.is_some();
        if point.is_none() && direction.is_none() && !bends {
            return set;
        }
        let jet = curve.polygon.end_jet(end);
        let target = set.unwrap_or(EndTarget {
            point: jet.point,
            direction: jet.tangent().filter(|_| point.is_none()),
            ..EndTarget::default()
        });
        Some(EndTarget {
            point: point.unwrap_or(target.point),
            direction: direction.or(target.direction),
            curvature: curvature.or(target.curvature),
            normal: normal.or(target.normal),
            slope: slope.or(target.slope),
        })
    }
}

/// Correct both ends by the least disturbance. An end without a target keeps its point and
/// direction.
fn at_once(
    curve: &Curve,
    values: &Values,
    is_met: &dyn Fn(&FloatPolygon) -> bool,
    progress: &Progress,
) -> Result<Correction, OperationError> {
    let locked = locked(curve, values)?;
    if is_met(&curve.polygon) {
        return Ok(Correction {
            polygon: Some(curve.polygon.clone()),
            residual: residual(curve, &curve.polygon),
            passes: 0,
            reason: String::new(),
            remark: None,
        });
    }
    let least = |disturbance: Disturbance| -> Result<Correction, OperationError> {
        match correct_jointly(
            &curve.polygon,
            &targets(curve),
            disturbance,
            &locked,
            progress,
        ) {
            Ok(joint) => Ok(Correction {
                residual: joint.residual,
                passes: joint.steps,
                reason: why_missed(curve, &joint.polygon, joint.residual),
                polygon: Some(joint.polygon).filter(is_met),
                remark: None,
            }),
            Err(error @ CorrectionError::NotSolvable { residual, .. }) => Ok(Correction {
                polygon: None,
                residual,
                passes: 1,
                reason: error.to_string(),
                remark: None,
            }),
            Err(CorrectionError::Cancelled) => Err(OperationError::Cancelled),
            Err(error) => Err(error.into()),
        }
    };
    if let Some(disturbance) = values.choice(&ORDER, &DISTURBANCES) {
        return least(disturbance);
    }
    fairest(curve, nearest(curve, &least)?, &least, progress)
}

/// Correct with the smallest moves of vertices, or of the curve where those turn it over or make another curve of it.
fn nearest(
    curve: &Curve,
    least: &dyn Fn(Disturbance) -> Result<Correction, OperationError>,
) -> Result<Correction, OperationError> {
    let by_vertices = least(Disturbance::Turned(1))?;
    let is_wrong = |polygon: &FloatPolygon| {
        let turned = turned_over(&curve.polygon, polygon).is_some();
        Ok::<bool, OperationError>(turned || is_another(curve, polygon)?)
    };
    match &by_vertices.polygon {
        Some(polygon) if !is_wrong(polygon)? => return Ok(by_vertices),
        _ => {}
    }
    let by_curve = least(Disturbance::Curve)?;
    let is_better = match (&by_curve.polygon, &by_vertices.polygon) {
        (Some(polygon), Some(_)) => !is_wrong(polygon)?,
        (polygon, None) => polygon.is_some(),
        (None, Some(_)) => false,
    };
    Ok(match is_better {
        true => Correction {
            remark: Some(
                "The curve moves least, not its vertices: those would make another curve of it"
                    .to_owned(),
            ),
            ..by_curve
        },
        false => by_vertices,
    })
}

/// Of corrections that move the curve little farther than a given one take that which adds the fewest curvature extrema
/// and inflections: the smallest differences of higher orders bend it less, and free ends where they share vertices.
fn fairest(
    curve: &Curve,
    nearest: Correction,
    least: &dyn Fn(Disturbance) -> Result<Correction, OperationError>,
    progress: &Progress,
) -> Result<Correction, OperationError> {
    let features = |polygon: &FloatPolygon| {
        let features = Features::proved(polygon, |_| !progress.is_cancelled());
        let features = features.ok_or(OperationError::Cancelled)?;
        let kinds = [Feature::CurvatureExtremum, Feature::Inflection];
        Ok::<[usize; 2], OperationError>(kinds.map(|it| features.count(it)))
    };
    let own = features(&curve.polygon)?;
    let added = |polygon: &FloatPolygon| {
        let counts = features(polygon)?.into_iter().zip(own);
        Ok::<usize, OperationError>(counts.map(|(now, own)| now.saturating_sub(own)).sum())
    };
    let Some(polygon) = &nearest.polygon else {
        return Ok(nearest);
    };
    let mut fewest = added(polygon)?;
    let most = LITTLE_FARTHER * curve.polygon.deviation(polygon)?;
    let mut fairest = nearest;
    for other in FAIRER {
        if fewest == 0 {
            break;
        }
        let other = least(other)?;
        let Some(polygon) = &other.polygon else {
            continue;
        };
        let is_near = curve.polygon.deviation(polygon)? <= most
            && turned_over(&curve.polygon, polygon).is_none();
        let count = added(polygon)?;
        if is_near && count < fewest {
            (fewest, fairest) = (count, other);
        }
    }
    Ok(fairest)
}

/// Repeat steps 2 to 6 on every end that has a target, and on one that has none if it moves with the other.
fn step_by_step(
    curve: &Curve,
    values: &Values,
    is_met: &dyn Fn(&FloatPolygon) -> bool,
    tolerance: f64,
) -> Result<Correction, OperationError> {
    let locked = locked(curve, values)?;
    let targets = match EndOverlap::of(&curve.polygon) {
        EndOverlap::None => curve.targets.list(),
        EndOverlap::Partial { .. } | EndOverlap::OneSegment => targets(curve).to_vec(),
    };
    let outcome = correct_in_turn(&curve.polygon, &targets, tolerance)?;
    let residual = outcome.residuals.last().copied().unwrap_or_default();
    let passes = outcome.passes();
    let moves =
        |vertex: &&usize| outcome.polygon.vertex(**vertex) != curve.polygon.vertex(**vertex);
    let moved = locked.iter().find(moves);
    let refused = match moved {
        Some(vertex) => Some(format!(
            "The steps would move vertex {vertex}, which is locked. Use “both ends at once”"
        )),
        None => cusp(curve, &outcome.polygon),
    };
    let settled = outcome.converged && refused.is_none() && is_met(&outcome.polygon);
    Ok(Correction {
        residual,
        passes,
        reason: refused.unwrap_or_else(|| why_not(curve, passes, residual)),
        remark: None,
        polygon: Some(outcome.polygon).filter(|_| settled),
    })
}

/// Say why a joint correction does not reach the targets.
fn why_missed(curve: &Curve, polygon: &FloatPolygon, left: f64) -> String {
    let refine = refine_first(&curve.polygon);
    let is_backward = |(end, target): &(End, EndTarget)| {
        let along = polygon.end_jet(*end).first;
        target.direction.is_some_and(|it| it.dot(along) < 0.0)
    };
    if let Some((end, _)) = curve.targets.list().into_iter().find(is_backward) {
        let name = end.name();
        return format!(
            "The curve would run backward through its {name}: {refine}, or ask for less there"
        );
    }
    match cusp(curve, polygon) {
        Some(cusp) => cusp,
        None if left <= ROUNDING * polygon.size() => ROUNDING_LEAVES_MORE.to_owned(),
        None => format!("The targets are missed: {refine}, or ask for less"),
    }
}

/// Say why the loop was given up.
fn why_not(curve: &Curve, passes: usize, left: f64) -> String {
    let polygon = &curve.polygon;
    if left <= ROUNDING * polygon.size() {
        return ROUNDING_LEAVES_MORE.to_owned();
    }
    let bends = |target: &EndTarget| {
        target.curvature.is_some() || target.slope.is_some() || target.normal.is_some()
    };
    let reason = match EndOverlap::of(polygon) {
        _ if curve.targets.list().iter().any(|(_, target)| bends(target)) => {
            "the steps bring points and directions to their targets, not curvatures".to_owned()
        }
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
