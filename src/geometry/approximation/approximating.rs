//! Approximations with what is known of them: how far they are from the curve, and whether they have its
//! shape.

use glam::DVec3;

use super::deviation::MeasuredDeviation;
use super::equivalence::{LevelComparison, compare_levels, compare_levels_at_samples};
use super::error::ApproximationError;
use super::knots::UniformKnots;
use super::placing::{Corrections, PlacedPolygon, Placing, placed};
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
    /// The knots of `count` vertices for a part of a curve.
    fn knots(&self, part: [f64; 2], count: usize) -> Result<UniformKnots, ApproximationError> {
        match self.periodic {
            true => UniformKnots::around(self.degree, part, count),
            false => UniformKnots::between(self.degree, part, count),
        }
    }

    /// The number of vertices of a number of segments.
    fn vertices(&self, segments: usize) -> usize {
        match self.periodic {
            true => segments,
            false => segments + self.degree,
        }
    }

    /// The least number of segments that there can be.
    fn least_segments(&self) -> usize {
        match self.periodic {
            true => self.degree + 1,
            false => 1,
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
    Ok(Placed::uniform(curve, &knots, request)?
        .measured()?
        .compared())
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
    match spacing {
        Spacing::Parameter => {
            let knots = request.knots(interval, count)?;
            Ok(Placed::uniform(curve, &knots, request)?
                .measured()?
                .compared())
        }
        _ => {
            let respaced = Respaced::new(curve, interval, spacing)?;
            let placed = Placed::respaced(curve, &respaced, spacing, count, request)?;
            Ok(placed.measured()?.compared())
        }
    }
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
    request.knots(interval, request.degree + 1)?;
    let spacings = goal
        .spacing
        .map_or(SPACINGS.to_vec(), |spacing| vec![spacing]);
    let respaced = spacings.into_iter().map(|spacing| {
        let respaced = match spacing {
            Spacing::Parameter => None,
            _ => Some(Respaced::new(curve, interval, spacing)?),
        };
        Ok((spacing, respaced))
    });
    let search = Search {
        curve,
        interval,
        goal,
        request,
        spacings: respaced.collect(),
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
    spacings: Vec<Result<(Spacing, Option<Respaced<'a>>), ApproximationError>>,
}

impl Search<'_> {
    fn run(&self, progress: &Progress) -> Result<Approximated, ApproximationError> {
        let least = self.request.least_segments();
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
        let count = self.request.vertices(segments);
        let mut best: Option<Result<Approximated, ApproximationError>> = None;
        for spacing in &self.spacings {
            let tried = match spacing {
                Ok((spacing, respaced)) => self.tried(*spacing, respaced.as_ref(), count),
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
    /// else what is nearer. Of equal ones that counts which is known.
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
        spacing: Spacing,
        respaced: Option<&Respaced<'_>>,
        count: usize,
    ) -> Result<Approximated, ApproximationError> {
        let placed = match respaced {
            None => {
                let knots = self.request.knots(self.interval, count)?;
                Placed::uniform(self.curve, &knots, self.request)?
            }
            Some(respaced) => Placed::respaced(self.curve, respaced, spacing, count, self.request)?,
        };
        let measured = placed.measured()?;
        // Levels take time: compare them only within the tolerance.
        if measured.found.distance() <= self.goal.tolerance {
            Ok(measured.compared_by(compare_levels_at_samples))
        } else {
            Ok(measured.found)
        }
    }
}

/// A polygon, placed but not measured.
struct Placed<'a> {
    curve: &'a dyn Differentiable,
    request: &'a ApproximationRequest,
    polygon: FloatPolygon,
    corrections: Option<Corrections>,
    spacing: Spacing,
    interval: [f64; 2],
    reach: [f64; 2],
    /// A parameter t near a given u.
    parameter: Box<dyn Fn(f64) -> f64 + 'a>,
}

/// A polygon that is measured, but whose levels are not compared.
struct MeasuredPolygon<'a> {
    placed: Placed<'a>,
    found: Approximated,
}

impl<'a> Placed<'a> {
    fn uniform(
        curve: &'a dyn Differentiable,
        knots: &UniformKnots,
        request: &'a ApproximationRequest,
    ) -> Result<Self, ApproximationError> {
        let knots = *knots;
        let PlacedPolygon {
            polygon,
            corrections,
        } = placed(curve, &knots, request.placing)?;
        let placed = Self {
            curve,
            request,
            polygon,
            corrections,
            spacing: Spacing::Parameter,
            interval: knots.interval(),
            reach: knots.reach(),
            parameter: Box::new(move |u| knots.curve_parameter(u)),
        };
        placed.with_ends()
    }

    fn respaced(
        curve: &'a dyn Differentiable,
        respaced: &'a Respaced<'a>,
        spacing: Spacing,
        count: usize,
        request: &'a ApproximationRequest,
    ) -> Result<Self, ApproximationError> {
        let knots = request.knots([0.0, 1.0], count)?;
        let PlacedPolygon {
            polygon,
            corrections,
        } = placed(respaced, &knots, request.placing)?;
        let placed = Self {
            curve,
            request,
            polygon,
            corrections,
            spacing,
            interval: respaced.interval(),
            reach: match knots.is_periodic() {
                true => respaced.interval(),
                false => knots.reach().map(|v| respaced.parameter(v)),
            },
            parameter: Box::new(move |u| respaced.near(knots.curve_parameter(u))),
        };
        placed.with_ends()
    }

    /// Bring the ends to the curve's points and directions, if requested.
    fn with_ends(mut self) -> Result<Self, ApproximationError> {
        if self.request.fit_ends && self.polygon.is_periodic() {
            return Err(ApproximationError::NoEnds);
        }
        if self.request.fit_ends {
            let ends = [End::Start, End::Finish].into_iter().zip(self.interval);
            let targets = ends.map(|(end, t)| {
                let values = self.curve.derivatives(t, 1);
                let target = EndTarget {
                    point: values[0],
                    direction: Some(values[1]).filter(|it| *it != DVec3::ZERO),
                    ..EndTarget::default()
                };
                (end, target)
            });
            let targets: Vec<(End, EndTarget)> = targets.collect();
            let corrected = correct_jointly(
                &self.polygon,
                &targets,
                Disturbance::Differences(3),
                &[],
                &Progress::default(),
            )?;
            self.polygon = corrected.polygon;
        }
        Ok(self)
    }

    fn measured(self) -> Result<MeasuredPolygon<'a>, ApproximationError> {
        let polygon = &self.polygon;
        let deviation =
            MeasuredDeviation::measure(polygon, self.curve, &*self.parameter, self.reach)?;
        let ends = [0.0, polygon.segments() as f64].map(|u| polygon.point(u));
        let error = |index: usize| {
            let point = self.curve.derivatives(self.interval[index], 0)[0];
            ends[index].distance(point)
        };
        let found = Approximated {
            polygon: polygon.clone(),
            interval: self.interval,
            deviation,
            end_errors: (!polygon.is_periodic()).then(|| [error(0), error(1)]),
            levels: Vec::new(),
            spacing: self.spacing,
            corrections: self.corrections,
        };
        Ok(MeasuredPolygon {
            placed: self,
            found,
        })
    }
}

/// Comparison of levels.
type Compare =
    fn(&FloatPolygon, &dyn Differentiable, &dyn Fn(f64) -> f64, usize) -> Vec<LevelComparison>;

impl MeasuredPolygon<'_> {
    fn compared(self) -> Approximated {
        self.compared_by(compare_levels)
    }

    fn compared_by(self, compare: Compare) -> Approximated {
        let Placed {
            curve,
            request,
            polygon,
            parameter,
            ..
        } = self.placed;
        Approximated {
            levels: compare(&polygon, curve, &*parameter, request.levels),
            ..self.found
        }
    }
}
