//! What the operations share that let another polygon stand in for a curve's.

use super::amount::Amount;
use super::error::OperationError;
use super::features::{proved, remark_on_lost_inflections};
use super::lists::given;
use super::operands::Operands;
use super::outcome::{Deviation, Figure, Outcome};
use super::parameter::{Kind, POSITIVE, Parameter};
use super::values::Values;
use crate::document::ParameterSpan;
use crate::geometry::distance::MeasuredDeviation;
use crate::geometry::fairing::counts::CountRequest;
use crate::geometry::fairing::requirement::Requirement;
use crate::geometry::features::{Feature, Features};
use crate::geometry::{
    Approximation, BezierPolygon, FloatPolygon, MAX_PART_SEGMENTS, Progress, percent, significant,
};

/// The parameter that is the degree which the curve gets.
pub(super) const fn degree(from: Amount, to: Amount, default: Amount) -> Parameter {
    Parameter {
        name: "degree",
        label: "Degree",
        help: "The degree that the curve gets",
        kind: Kind::whole_of(from, to, default),
    }
}

/// How far the new curve may be from the old one.
pub(super) const TOLERANCE: Parameter = Parameter {
    name: "tolerance",
    label: "Tolerance",
    help: "How far the curve may move; with it the vertices are as few as keep it",
    kind: Kind::optional_number(POSITIVE, |_| "none"),
};

/// More vertices than these are told.
const MANY: usize = 1000;

/// The most vertices with which features are looked for that are not kept with fewer.
const MOST_FOR_FEATURES: usize = 2000;

/// A curve that moves by more than this share of its size without a tolerance is told.
const FAR: f64 = 0.001;

/// The factor by which segments grow where features are not kept.
const GROWTH: f64 = 1.3;

/// The bound of a deviation may be so many times the distance of the curves.
const LOOSE: f64 = 6.0;

/// The most and the fewest times as many segments that are tried next where the tolerance is missed.
const NEXT: [f64; 2] = [1.05, 4.0];

/// Let a curve of the degree asked for stand in for the curve: with as many segments, or with as few as keep the
/// tolerance.
pub(super) fn changed(
    input: &Operands,
    values: &Values,
    degree: &Parameter,
    progress: &Progress,
) -> Result<Outcome, OperationError> {
    let (polygon, degree) = (input.polygon()?, values.whole(degree));
    match given(values, &TOLERANCE) {
        None => {
            let changed = polygon.with_degree(degree)?;
            let features = proved([polygon, &changed.polygon], progress)?;
            let lost = remark_on_lost_inflections(polygon.is_planar(), &features);
            let far = far(polygon, &by_distance(changed.clone(), polygon, progress));
            let mut outcome = instead(input, changed)?;
            outcome.warnings.extend(far.into_iter().chain(lost));
            Ok(outcome)
        }
        tolerance => {
            let goal = Goal {
                degree,
                segments: None,
                least: if polygon.is_periodic() {
                    polygon.segments()
                } else {
                    1
                },
                tolerance,
            };
            refitted(input, &goal, progress)
        }
    }
}

/// The polygon that is to stand in for a curve's.
pub(super) struct Goal {
    pub(super) degree: usize,
    /// The number of segments; `None` for the fewest that keep the tolerance and the features.
    pub(super) segments: Option<usize>,
    /// The fewest segments.
    pub(super) least: usize,
    /// The largest deviation.
    pub(super) tolerance: Option<f64>,
}

/// Let the nearest curve of a degree with as many segments as asked for, or as few as keep the tolerance, stand in for
/// the curve. It must have the same features.
pub(super) fn refitted(
    input: &Operands,
    goal: &Goal,
    progress: &Progress,
) -> Result<Outcome, OperationError> {
    let (id, curve) = input.curve()?;
    curve.check_vertices_unlocked(curve.locked_vertices.iter())?;
    let polygon = &curve.polygon;
    let own = Shape::of(polygon, progress)?;
    let found = match goal.segments {
        Some(segments) => polygon.refitted(goal.degree, segments)?,
        None => fewest(polygon, goal, progress)?,
    };
    let vertices = found.polygon.vertices().len();
    let limit = goal.tolerance.map(|most| Requirement::Limit {
        found: found.deviation,
        most,
    });
    let requirements = own.request().into_iter().chain(limit).collect();
    let keeps = own.is_kept(&found.polygon, progress)?;
    let far = match goal.tolerance {
        None => far(polygon, &by_distance(found.clone(), polygon, progress)),
        Some(_) => None,
    };
    let mut outcome = instead(input, found)?;
    outcome.warnings.extend(far);
    if !keeps {
        let more = match goal.segments {
            Some(_) => "take more vertices, give a tolerance",
            None => "give a smaller tolerance",
        };
        outcome.remarks.push(format!(
            "Inflections or extrema change: {more}, or another degree"
        ));
    }
    outcome.requirements = vec![(id, requirements)];
    outcome
        .figures
        .push(Figure::count("vertices", "Vertices", vertices));
    if vertices > MANY {
        outcome.remarks.push(format!(
            "The polygon has {vertices} vertices: a larger tolerance takes fewer"
        ));
    }
    Ok(outcome)
}

/// The features that a new curve must have too, if all are known.
#[derive(PartialEq)]
struct Shape(Option<[usize; 4]>);

impl Shape {
    fn of(polygon: &FloatPolygon, progress: &Progress) -> Result<Self, OperationError> {
        let features = Features::proved(polygon, |_| !progress.is_cancelled());
        let features = features.ok_or(OperationError::Cancelled)?;
        let is_known = features.undecided.is_empty() && features.cusps.is_empty();
        let kinds = [
            Feature::Inflection,
            Feature::CurvatureExtremum,
            Feature::TorsionZero,
            Feature::TorsionExtremum,
        ];
        Ok(Self(
            is_known.then(|| kinds.map(|kind| features.count(kind))),
        ))
    }

    /// Whether another curve has these features, if all are known.
    fn is_kept(&self, polygon: &FloatPolygon, progress: &Progress) -> Result<bool, OperationError> {
        Ok(self.0.is_none() || Self::of(polygon, progress)? == *self)
    }

    fn request(&self) -> Option<Requirement> {
        let [inflections, extrema, zeros, torsion_extrema] = self.0?;
        // A planar curve has no torsion, one in space no inflections.
        let request =
            CountRequest::exactly([inflections + zeros, extrema, torsion_extrema].map(Some));
        Some(Requirement::Features {
            stretch: None,
            request,
        })
    }
}

/// The curve with the fewest segments that keeps the tolerance and the features, or the nearest tried.
pub(super) fn fewest(
    polygon: &FloatPolygon,
    goal: &Goal,
    progress: &Progress,
) -> Result<Approximation, OperationError> {
    let own = Shape::of(polygon, progress)?;
    let tolerance = goal.tolerance.unwrap_or(f64::INFINITY);
    let refitted =
        |segments: usize| nearer_bound(polygon, goal.degree, segments, tolerance, progress);
    let mut missed = goal.least.saturating_sub(1);
    let mut found = refitted(goal.least)?;
    let order = goal.degree as f64 + 1.0;
    while found.deviation > tolerance {
        if progress.is_cancelled() {
            return Err(OperationError::Cancelled);
        }
        missed = found.polygon.segments();
        // The deviation falls with the power n + 1 of the segments' length.
        let factor = (found.deviation / tolerance).powf(order.recip());
        let factor = factor.clamp(NEXT[0], NEXT[1]);
        let next = (missed + 1).max((factor * missed as f64).ceil() as usize);
        if next > MAX_PART_SEGMENTS {
            return Ok(found);
        }
        found = refitted(next)?;
    }
    while found.polygon.segments() > missed + 1 {
        if progress.is_cancelled() {
            return Err(OperationError::Cancelled);
        }
        let middle = missed.midpoint(found.polygon.segments());
        let tried = refitted(middle)?;
        match tried.deviation <= tolerance {
            true => found = tried,
            false => missed = middle,
        }
    }
    let kept = found.clone();
    // The most segments that are known to lose features.
    let mut lost = None;
    while Shape::of(&found.polygon, progress)? != own {
        let segments = found.polygon.segments();
        lost = Some(segments);
        let grown = (segments + 1).max((GROWTH * segments as f64).round() as usize);
        // Halved segments give the curve itself, and so its features.
        let halved = (1..usize::BITS).map(|halvings| polygon.segments() << halvings);
        let halved = halved.filter(|_| goal.degree == polygon.degree());
        let next = halved
            .take_while(|halved| *halved <= grown)
            .find(|halved| *halved > segments)
            .unwrap_or(grown);
        if own.0.is_none() || next > MOST_FOR_FEATURES {
            return Ok(kept);
        }
        found = refitted(next)?;
    }
    while let Some(low) = lost.filter(|low| found.polygon.segments() > low + 1) {
        let middle = low.midpoint(found.polygon.segments());
        let tried = refitted(middle)?;
        match tried.deviation <= tolerance && Shape::of(&tried.polygon, progress)? == own {
            true => found = tried,
            false => lost = Some(middle),
        }
    }
    Ok(found)
}

/// The nearest curve with so many segments. Unless the bound in its own parameter misses the tolerance by far, the distance
/// of the curves counts, if it can be bounded.
fn nearer_bound(
    polygon: &FloatPolygon,
    degree: usize,
    segments: usize,
    tolerance: f64,
    progress: &Progress,
) -> Result<Approximation, OperationError> {
    let found = polygon.refitted(degree, segments)?;
    if found.exact || tolerance.is_infinite() || found.deviation > LOOSE * tolerance {
        return Ok(found);
    }
    Ok(by_distance(found, polygon, progress))
}

/// The approximation of a curve with the distance between both, if that can be bounded: less than the bound in the
/// parameter, which may be several times as large.
fn by_distance(found: Approximation, polygon: &FloatPolygon, progress: &Progress) -> Approximation {
    if found.exact {
        return found;
    }
    let measured = MeasuredDeviation::between(&found.polygon, polygon, progress);
    let measured = measured.ok().filter(|it| it.bounded);
    let deviation = measured.map_or(found.deviation, |it| it.largest.min(found.deviation));
    Approximation { deviation, ..found }
}

/// Say that the curve moves by much of its size.
fn far(polygon: &FloatPolygon, changed: &Approximation) -> Option<String> {
    let size = BezierPolygon::from_float(polygon).size();
    (changed.deviation > FAR * size).then(|| {
        let moved = significant(changed.deviation, 3);
        let share = percent(changed.deviation / size);
        format!("The curve moves by {moved}, {share} of its size: give a tolerance")
    })
}

/// The inflections (in space zeros of the torsion) and the curvature extrema of two curves; `None` if they have the same
/// features, or those of the first are not all known.
pub(super) fn changed_features(
    polygon: &FloatPolygon,
    other: &FloatPolygon,
    progress: &Progress,
) -> Result<Option<[[usize; 2]; 2]>, OperationError> {
    let own = Shape::of(polygon, progress)?;
    if own.is_kept(other, progress)? {
        return Ok(None);
    }
    let counts = |polygon: &FloatPolygon| {
        let features = Features::proved(polygon, |_| !progress.is_cancelled());
        let features = features.ok_or(OperationError::Cancelled)?;
        let turns = features.count(Feature::Inflection) + features.count(Feature::TorsionZero);
        Ok::<_, OperationError>([turns, features.count(Feature::CurvatureExtremum)])
    };
    Ok(Some([counts(polygon)?, counts(other)?]))
}

/// Replace the curve by an approximation whose parameter runs evenly along it.
fn instead(input: &Operands, changed: Approximation) -> Result<Outcome, OperationError> {
    let polygon = input.polygon()?;
    let deviation = Deviation::of(&changed);
    let whole = |polygon: &FloatPolygon| [0.0, polygon.segments() as f64];
    let span = ParameterSpan {
        old: whole(polygon),
        new: whole(&changed.polygon),
    };
    Outcome::renumbered(input, changed.polygon, vec![span], deviation)
}
