//! Approximations of a curve by float polygons, with their distance from it and the comparison of
//! their levels.

use glam::DVec3;

use super::equivalence::{LevelComparison, Places, compare_levels};
use super::error::ApproximationError;
use super::knots::UniformKnots;
use super::placing::{Corrections, Placing, placed};
use super::spacing::{Respaced, Spacing};
use super::watched::Watched;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::distance::MeasuredDeviation;
use crate::geometry::end::End;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::fairing::joint_correction::{Disturbance, correct_jointly};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// The most segments that are tried for a tolerance.
pub const MOST_SEGMENTS: usize = 4096;

/// Once the deviation is small enough, up to so many segments are tried for the shape, however many the deviation
/// took: what is reached for a small tolerance is reached for a larger one too.
pub const MOST_FOR_SHAPE: usize = 2048;

/// The least number of segments is found exactly below this number, and above it to one part in so many.
const FINE: usize = 128;

/// Where a deviation is too large, the next number of segments is the one at which the order of convergence lets
/// expect the tolerance, but between these multiples: fewer would take many steps, and the order may be misleading.
const GROWTH: std::ops::RangeInclusive<f64> = 1.5..=6.0;

/// The share of the time that the search has; what is left is for the figures of its result.
const SEARCHING: f64 = 0.75;

/// The share of that for the distance and the levels of the result; in the rest its features are proved.
const TELLING: f64 = 0.6;

/// The spacings that are tried for a tolerance, the simplest first.
const SPACINGS: [Spacing; 3] = [Spacing::Parameter, Spacing::ArcLength, Spacing::Curvature];

/// Request for an approximation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ApproximationRequest {
    /// The degree.
    pub degree: usize,
    /// The placing of the vertices.
    pub placing: Placing,
    /// The number of compared levels of curvature and torsion.
    pub levels: usize,
    /// Whether the part is the whole period of a periodic curve, so that the approximation is periodic too.
    pub periodic: bool,
    /// Whether the ends are brought to the curve's points and directions, which moves all vertices as
    /// evenly as possible.
    pub fit_ends: bool,
}

impl ApproximationRequest {
    /// The knots of `count` vertices for a part of a curve, or for all of a respaced one.
    fn knots(
        &self,
        part: [f64; 2],
        respaced: Option<&Respaced>,
        count: usize,
    ) -> Result<UniformKnots, ApproximationError> {
        let part = respaced.map_or(part, |_| [0.0, 1.0]);
        match self.periodic {
            true => UniformKnots::around(self.degree, part, count),
            false => UniformKnots::between(self.degree, part, count),
        }
    }
}

/// Goal of an approximation, and the means to reach it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// Tolerance of the curve, its ends included.
    pub tolerance: f64,
    /// The spacing of the vertices; without one the best of all.
    pub spacing: Option<Spacing>,
    /// The most segments that are tried.
    pub most_segments: usize,
}

/// An approximation with its distances.
#[derive(Clone, Debug, PartialEq)]
pub struct Approximated {
    /// The float polygon.
    pub polygon: FloatPolygon,
    /// The part of the curve, by its own parameter, that the approximation runs along.
    pub interval: [f64; 2],
    /// Its distance from the curve.
    pub deviation: MeasuredDeviation,
    /// Distances of its ends from those of the part; a periodic curve has none.
    pub end_errors: Option<[f64; 2]>,
    /// The levels of both.
    pub levels: Vec<LevelComparison>,
    /// The spacing of the vertices.
    pub spacing: Spacing,
    /// The corrections of quasi-interpolation, from degree 4 on.
    pub corrections: Option<Corrections>,
    /// Whether the time was up before the search for it came to its end.
    pub stopped: bool,
}

impl Approximated {
    /// Whether all levels that were compared have the same features.
    pub fn is_equivalent(&self) -> bool {
        self.first_difference().is_none()
    }

    /// Whether it is as near as a tolerance asks for, its ends too, and has the shape.
    pub fn meets(&self, tolerance: f64) -> bool {
        self.distance() <= tolerance && self.is_equivalent()
    }

    fn equal_levels(&self) -> usize {
        self.levels.iter().filter(|level| level.is_equal()).count()
    }

    /// The first level that differs, if the levels were compared.
    pub fn first_difference(&self) -> Option<&LevelComparison> {
        self.levels.iter().find(|level| !level.is_equal())
    }

    /// The larger distance: beside the curve, or at an end along it.
    pub fn distance(&self) -> f64 {
        let ends = self.end_errors.into_iter().flatten();
        ends.fold(self.deviation.largest, f64::max)
    }
}

/// Approximate a curve by vertices that belong to its parameters first, first + step …: an open curve.
///
/// # Errors
/// [`ApproximationError`].
pub fn approximate_by_steps(
    curve: &dyn Differentiable,
    [first, step]: [f64; 2],
    count: usize,
    request: &ApproximationRequest,
) -> Result<Approximated, ApproximationError> {
    let knots = UniformKnots::of_vertices(request.degree, first, step, count)?;
    let progress = Progress::default();
    approximated(curve, &knots, None, request, Precision::Full, &progress)
}

/// Approximate the part of a curve between two of its parameters by so many vertices.
///
/// # Errors
/// [`ApproximationError`].
pub fn approximate_between(
    curve: &dyn Differentiable,
    interval: [f64; 2],
    count: usize,
    spacing: Spacing,
    request: &ApproximationRequest,
) -> Result<Approximated, ApproximationError> {
    let progress = Progress::default();
    told(curve, interval, count, spacing, request, &progress)
}

/// Approximate as [`approximate_between`] does, until `progress` is cancelled.
fn told(
    curve: &dyn Differentiable,
    interval: [f64; 2],
    count: usize,
    spacing: Spacing,
    request: &ApproximationRequest,
    progress: &Progress,
) -> Result<Approximated, ApproximationError> {
    let respaced = Respaced::by(curve, interval, spacing)?;
    let knots = request.knots(interval, respaced.as_ref(), count)?;
    let respaced = respaced.as_ref();
    approximated(curve, &knots, respaced, request, Precision::Full, progress)
}

/// Approximate the part of a curve between two of its parameters so that the deviation is at most a
/// tolerance and all levels compared have the curve's features, by as few vertices as it takes; where that is more
/// than a hundred, by up to 1 % more. Where nothing
/// reaches both, or the time of `progress` is up before, what comes back is the nearest that was found, or of those
/// that are near enough the one with the most levels that are equal, and of these the one with the fewest vertices.
///
/// # Errors
/// [`ApproximationError`] if no number of vertices makes an approximation.
pub fn approximate_to_tolerance(
    curve: &dyn Differentiable,
    interval: [f64; 2],
    goal: &Goal,
    request: &ApproximationRequest,
    progress: &Progress,
) -> Result<Approximated, ApproximationError> {
    // The simplest knots refuse impossible requests at once.
    request.knots(interval, None, request.degree + 1)?;
    let spacings = goal
        .spacing
        .map_or(SPACINGS.to_vec(), |spacing| vec![spacing]);
    let spacings = spacings.into_iter();
    let hurried = progress.hurried(SEARCHING);
    let watched = Watched::new(curve, &hurried);
    let search = Search {
        curve: &watched,
        interval,
        goal,
        request,
        progress: &hurried,
        spacings: spacings
            .map(|it| Respaced::by(&watched, interval, it))
            .collect(),
    };
    let found = search.run()?;
    // What is too far away was not compared yet, nor are places of features refined.
    let count = found.polygon.vertices().len();
    let hurried = progress.hurried(TELLING);
    let watched = Watched::new(curve, &hurried);
    let told = told(&watched, interval, count, found.spacing, request, &hurried);
    let mut told = match told {
        Ok(told) if !hurried.is_cancelled() => told,
        _ => return Ok(found),
    };
    told.stopped = found.stopped;
    let (known, tight) = (&found.deviation, &mut told.deviation);
    if known.bounded && tight.bounded {
        // Of two bounds of the same distance the smaller one counts.
        tight.largest = tight.largest.min(known.largest);
    }
    if tight.found <= goal.tolerance && goal.tolerance < tight.largest {
        // So small a distance drowns in the rounding of bounds.
        (tight.largest, tight.bounded) = (tight.found, false);
    }
    Ok(told)
}

/// The search for the least number of vertices.
struct Search<'a> {
    curve: &'a dyn Differentiable,
    interval: [f64; 2],
    goal: &'a Goal,
    request: &'a ApproximationRequest,
    progress: &'a Progress,
    /// A curve that stops somewhere has no arc length to go by; its own parameter is left then.
    spacings: Vec<Result<Option<Respaced<'a>>, ApproximationError>>,
}

impl Search<'_> {
    fn run(&self) -> Result<Approximated, ApproximationError> {
        let progress = self.progress;
        let least = match self.request.periodic {
            true => self.request.degree + 1,
            false => 1,
        };
        let mut most = self.goal.most_segments.max(least);
        let (mut too_few, mut segments) = (Tried::none(least - 1), least);
        let mut best: Option<Result<Approximated, ApproximationError>> = None;
        let mut found = None;
        while found.is_none() && !progress.is_cancelled() {
            progress.set_done(0.5 * segments as f64 / most as f64);
            let tried = self.best_of(segments);
            let is_near = tried
                .as_ref()
                .is_ok_and(|tried| tried.distance() <= self.goal.tolerance);
            if is_near && tried.as_ref().is_ok_and(Approximated::is_equivalent) {
                found = tried.ok();
                continue;
            }
            let before = too_few;
            too_few = Tried::of(segments, &tried);
            // What the end of the time spoilt says nothing.
            if !progress.is_cancelled() {
                best = Some(self.better(best, tried));
                if let Some(Ok(best)) = &best {
                    progress.show(best.polygon.clone());
                }
            }
            if is_near {
                most = most.min(MOST_FOR_SHAPE.max(segments));
            }
            if segments == most {
                break;
            }
            // The shape takes many more.
            let growth = match is_near {
                true => 2.0,
                false => before.growth(&too_few, self.goal.tolerance),
            };
            segments = ((segments as f64 * growth).ceil() as usize).min(most);
        }
        let Some(mut found) = found else {
            let stopped = progress.is_cancelled();
            return match best {
                Some(Ok(best)) => Ok(Approximated { stopped, ..best }),
                Some(Err(error)) if !stopped => Err(error),
                _ => Err(ApproximationError::Cancelled),
            };
        };
        let mut enough = Tried::of(segments, &Ok(found.clone()));
        let mut halve = false;
        while enough.segments - too_few.segments > 1 + enough.segments / FINE
            && !progress.is_cancelled()
        {
            let [low, high] = [too_few.segments, enough.segments];
            let middle = match halve {
                true => low + (high - low) / 2,
                false => too_few.between(&enough, self.goal.tolerance),
            };
            let tried = self.best_of(middle);
            let known = Tried::of(middle, &tried);
            match tried {
                Ok(tried) if tried.meets(self.goal.tolerance) => (found, enough) = (tried, known),
                _ => too_few = known,
            }
            // Every other step is half of what is left at least.
            halve = !halve && 2 * (enough.segments - too_few.segments) > high - low;
            progress.set_done(1.0 - 0.5 / (enough.segments - too_few.segments) as f64);
        }
        let stopped = progress.is_cancelled();
        Ok(Approximated { stopped, ..found })
    }

    /// The first spacing that meets the request with `segments` segments, or the nearest.
    fn best_of(&self, segments: usize) -> Result<Approximated, ApproximationError> {
        let count = match self.request.periodic {
            true => segments,
            false => segments + self.request.degree,
        };
        let mut best: Option<Result<Approximated, ApproximationError>> = None;
        for spacing in &self.spacings {
            let tried = match spacing {
                Ok(respaced) => self.tried(respaced.as_ref(), count),
                Err(error) => Err(error.clone()),
            };
            if tried
                .as_ref()
                .is_ok_and(|tried| tried.meets(self.goal.tolerance))
            {
                return tried;
            }
            best = Some(self.better(best, tried));
        }
        best.unwrap_or_else(|| {
            let parameter = self.interval[0];
            Err(ApproximationError::NoPoint { parameter })
        })
    }

    /// The better of what is known and what was tried: what is near enough and has more equal levels, and
    /// else what is nearer. Of equal ones the known one stays.
    fn better(
        &self,
        known: Option<Result<Approximated, ApproximationError>>,
        tried: Result<Approximated, ApproximationError>,
    ) -> Result<Approximated, ApproximationError> {
        let (known, tried) = match (known, tried) {
            (None, tried) | (Some(Err(_)), tried @ Ok(_)) => return tried,
            (Some(known), Err(_)) => return known,
            (Some(Ok(known)), Ok(tried)) => (known, tried),
        };
        let tolerance = self.goal.tolerance;
        let is_better = match (known.distance() <= tolerance, tried.distance() <= tolerance) {
            (true, true) => tried.equal_levels() > known.equal_levels(),
            _ => tried.distance() < known.distance(),
        };
        Ok(if is_better { tried } else { known })
    }

    fn tried(
        &self,
        respaced: Option<&Respaced>,
        count: usize,
    ) -> Result<Approximated, ApproximationError> {
        let knots = self.request.knots(self.interval, respaced, count)?;
        let tolerance = self.goal.tolerance;
        approximated(
            self.curve,
            &knots,
            respaced,
            self.request,
            Precision::Goal { tolerance },
            self.progress,
        )
    }
}

/// A number of segments, and the distance that was found with it.
#[derive(Clone, Copy)]
struct Tried {
    segments: usize,
    /// Not a number where there is none.
    distance: f64,
}

impl Tried {
    fn none(segments: usize) -> Self {
        Self {
            segments,
            distance: f64::NAN,
        }
    }

    fn of(segments: usize, tried: &Result<Approximated, ApproximationError>) -> Self {
        let found = tried.as_ref().map(|tried| {
            let ends = tried.end_errors.into_iter().flatten();
            ends.fold(tried.deviation.found, f64::max)
        });
        Self {
            segments,
            distance: found.unwrap_or(f64::NAN),
        }
    }

    /// The order of convergence from here to a larger number, if there is any.
    fn order(&self, finer: &Self) -> Option<f64> {
        let order = (self.distance / finer.distance).ln()
            / (finer.segments as f64 / self.segments as f64).ln();
        (order > 0.0 && order.is_finite()).then_some(order)
    }

    /// How many times the segments of a larger number are expected to reach a tolerance.
    fn growth(&self, finer: &Self, tolerance: f64) -> f64 {
        let (least, most) = GROWTH.into_inner();
        let growth = |order: f64| (finer.distance / tolerance).powf(1.0 / order);
        let growth = self.order(finer).map(growth);
        growth.map_or(least, |growth| growth.clamp(least, most))
    }

    /// The number of segments, between this one and a larger one, that is expected to reach a tolerance just so.
    fn between(&self, finer: &Self, tolerance: f64) -> usize {
        let [low, high] = [self.segments, finer.segments];
        let half = low + (high - low) / 2;
        let is_above = self.distance > tolerance;
        let Some(order) = self.order(finer).filter(|_| is_above) else {
            return half;
        };
        let fewer = (finer.distance / tolerance).powf(1.0 / order);
        let expected = (high as f64 * fewer).ceil() as usize;
        // First a little above it, then a little below: what is between is as fine as it need be.
        let margin = 1 + high / (2 * FINE);
        let tried = match expected + margin < high {
            true => expected + margin,
            false => expected.saturating_sub(margin),
        };
        tried.clamp(low + 1, high - 1)
    }
}

/// How much is told of an approximation.
#[derive(Clone, Copy)]
enum Precision {
    /// Its distance, and features that are placed between samples.
    Full,
    /// Whether it is as near as a tolerance, and only then the features, placed at samples.
    Goal { tolerance: f64 },
}

/// Approximate a curve at knots of its own parameter, or of a respaced one.
fn approximated(
    curve: &dyn Differentiable,
    knots: &UniformKnots,
    respaced: Option<&Respaced>,
    request: &ApproximationRequest,
    precision: Precision,
    progress: &Progress,
) -> Result<Approximated, ApproximationError> {
    let (polygon, corrections) = match respaced {
        Some(respaced) => placed(respaced, knots, request.placing)?,
        None => placed(curve, knots, request.placing)?,
    };
    let interval = respaced.map_or(knots.interval(), Respaced::interval);
    let polygon = match request.fit_ends {
        true => with_ends(&polygon, curve, interval)?,
        false => polygon,
    };
    let parameter = |u: f64| {
        let v = knots.curve_parameter(u);
        respaced.map_or(v, |respaced| respaced.near(v))
    };
    let error = |end: End, t: f64| {
        let point = polygon.point(end.parameter(&polygon));
        point.distance(curve.derivatives(t, 0)[0])
    };
    let [from, to] = interval;
    let deviation = match precision {
        Precision::Full => MeasuredDeviation::both_ways(&polygon, curve, &parameter, progress),
        Precision::Goal { tolerance } => {
            MeasuredDeviation::within(tolerance, &polygon, curve, &parameter, progress)
        }
    }?;
    let mut found = Approximated {
        interval,
        deviation,
        end_errors: (!polygon.is_periodic())
            .then(|| [error(End::Start, from), error(End::Finish, to)]),
        levels: Vec::new(),
        spacing: respaced.map_or(Spacing::Parameter, |it| it.spacing),
        corrections,
        stopped: false,
        polygon,
    };
    let places = match precision {
        Precision::Full => Places::Refined,
        Precision::Goal { .. } => Places::Samples,
    };
    // Levels take time: compare them only within the tolerance.
    let is_near = match precision {
        Precision::Full => true,
        Precision::Goal { tolerance } => found.distance() <= tolerance,
    };
    if is_near {
        found.levels = compare_levels(&found.polygon, curve, &parameter, request.levels, places);
    }
    Ok(found)
}

/// Bring the ends of a polygon to the points and directions of a curve at the ends of an interval.
fn with_ends(
    polygon: &FloatPolygon,
    curve: &dyn Differentiable,
    interval: [f64; 2],
) -> Result<FloatPolygon, ApproximationError> {
    if polygon.is_periodic() {
        return Err(ApproximationError::NoEnds);
    }
    let targets = End::BOTH.into_iter().zip(interval).map(|(end, t)| {
        let values = curve.derivatives(t, 1);
        let target = EndTarget {
            point: values[0],
            direction: Some(values[1]).filter(|it| *it != DVec3::ZERO),
            ..EndTarget::default()
        };
        (end, target)
    });
    let targets: Vec<(End, EndTarget)> = targets.collect();
    let least = Disturbance::Differences(3);
    let corrected = correct_jointly(polygon, &targets, least, &[], &Progress::default())?;
    Ok(corrected.polygon)
}
