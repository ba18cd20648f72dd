//! Approximations of a curve by float polygons, with their distance from it and the comparison of
//! their levels.

use glam::DVec3;

use super::deviation::MeasuredDeviation;
use super::equivalence::{LevelComparison, Places, compare_levels};
use super::error::ApproximationError;
use super::knots::UniformKnots;
use super::placing::{Corrections, Placing, placed};
use super::spacing::{Respaced, Spacing};
use crate::geometry::differentiable::Differentiable;
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
    approximated(curve, &knots, None, request, |_| Some(Places::Refined))
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
    let respaced = Respaced::by(curve, interval, spacing)?;
    let knots = request.knots(interval, respaced.as_ref(), count)?;
    approximated(curve, &knots, respaced.as_ref(), request, |_| {
        Some(Places::Refined)
    })
}

/// Approximate the part of a curve between two of its parameters so that the deviation is at most a
/// tolerance and all levels compared have the curve's features, by as few vertices as it takes; where that is more
/// than a hundred, by up to 1 % more. Where nothing
/// reaches both, what comes back is the nearest that was found, or of those that are near enough the one with
/// the most levels that are equal, and of these the one with the fewest vertices.
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
    let search = Search {
        curve,
        interval,
        goal,
        request,
        spacings: spacings
            .map(|it| Respaced::by(curve, interval, it))
            .collect(),
    };
    let found = search.run(progress)?;
    // What is too far away was not compared yet, nor are places of features refined.
    let count = found.polygon.vertices().len();
    approximate_between(curve, interval, count, found.spacing, request)
}

/// The search for the least number of vertices.
struct Search<'a> {
    curve: &'a dyn Differentiable,
    interval: [f64; 2],
    goal: &'a Goal,
    request: &'a ApproximationRequest,
    /// A curve that stops somewhere has no arc length to go by; its own parameter is left then.
    spacings: Vec<Result<Option<Respaced<'a>>, ApproximationError>>,
}

impl Search<'_> {
    fn run(&self, progress: &Progress) -> Result<Approximated, ApproximationError> {
        let least = match self.request.periodic {
            true => self.request.degree + 1,
            false => 1,
        };
        let most_tried = self.goal.most_segments.max(least);
        let (mut too_few, mut segments, mut most) = (least - 1, least, most_tried);
        let mut best: Option<Result<Approximated, ApproximationError>> = None;
        let mut found = None;
        while found.is_none() && !progress.is_cancelled() {
            progress.set_done(0.5 * segments as f64 / most as f64);
            let tried = self.best_of(segments);
            let distance = tried.as_ref().map(Approximated::distance);
            let is_near = distance.is_ok_and(|distance| distance <= self.goal.tolerance);
            if is_near && tried.as_ref().is_ok_and(Approximated::is_equivalent) {
                found = tried.ok();
                continue;
            }
            best = Some(self.better(best, tried));
            if is_near {
                most = most.min(MOST_FOR_SHAPE.max(segments));
            }
            if segments == most {
                break;
            }
            too_few = segments;
            // The shape takes many more.
            let more = if is_near {
                segments
            } else {
                segments.div_ceil(2)
            };
            segments = (segments + more).min(most);
        }
        let Some(mut found) = found else {
            return best.unwrap_or_else(|| self.best_of(least));
        };
        while segments - too_few > 1 + segments / FINE && !progress.is_cancelled() {
            let middle = too_few + (segments - too_few) / 2;
            match self.best_of(middle) {
                Ok(tried) if tried.meets(self.goal.tolerance) => {
                    (found, segments) = (tried, middle);
                }
                _ => too_few = middle,
            }
            progress.set_done(1.0 - 0.5 / (segments - too_few) as f64);
        }
        Ok(found)
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
        // Levels take time: compare them only within the tolerance.
        let near = |distance: f64| (distance <= self.goal.tolerance).then_some(Places::Samples);
        approximated(self.curve, &knots, respaced, self.request, near)
    }
}

/// Approximate a curve at knots of its own parameter, or of a respaced one. `places` tells by the
/// distance whether levels are compared, and how closely their features are placed.
fn approximated(
    curve: &dyn Differentiable,
    knots: &UniformKnots,
    respaced: Option<&Respaced>,
    request: &ApproximationRequest,
    places: impl Fn(f64) -> Option<Places>,
) -> Result<Approximated, ApproximationError> {
    let (polygon, corrections) = match respaced {
        Some(respaced) => placed(respaced, knots, request.placing)?,
        None => placed(curve, knots, request.placing)?,
    };
    let interval = respaced.map_or(knots.interval(), Respaced::interval);
    let reach = match respaced {
        Some(respaced) if !knots.is_periodic() => knots.reach().map(|v| respaced.parameter(v)),
        Some(_) => interval,
        None => knots.reach(),
    };
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
    let progress = Progress::default();
    let deviation = MeasuredDeviation::measure(&polygon, curve, &parameter, reach, &progress)?;
    let mut found = Approximated {
        interval,
        deviation,
        end_errors: (!polygon.is_periodic())
            .then(|| [error(End::Start, from), error(End::Finish, to)]),
        levels: Vec::new(),
        spacing: respaced.map_or(Spacing::Parameter, |it| it.spacing),
        corrections,
        polygon,
    };
    if let Some(places) = places(found.distance()) {
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
