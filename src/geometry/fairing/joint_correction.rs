//! Both ends at once: the least disturbance that meets every end condition.

use std::cell::Cell;

use glam::DVec3;
use thiserror::Error;

use super::objective::Objective;
use super::problem::{self, Descent, Problem};
use super::requirement::PlaceRequest;
use crate::geometry::end::End;
use crate::geometry::end_correction::{EndTarget, largest_residual};
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;
use crate::geometry::vector;

/// The weight μ of the moves themselves; a correction fades over about 1/√μ vertices.
const FIDELITY: f64 = 1e-3;

/// The weight μ for turned ends: what lies far from them stays.
const TURNED_FIDELITY: f64 = 0.1;

/// The most steps towards curvatures and slopes that a frame has time for.
const HASTY_STEPS: usize = 8;

/// The weight ν of changes of the second derivative beside the moves of the curve.
const BENDING: f64 = 1e-2;

/// The most steps of harmonious corrections.
const MOST_STEPS: usize = 50;

/// The weight ε of the moves in a harmonious correction.
const CLOSENESS: f64 = 1.0;

/// Largest number of parts of the way to a curvature.
const MOST_PARTS: f64 = 256.0;

/// Why both ends cannot be corrected at once.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CorrectionError {
    /// A periodic curve has no ends.
    #[error("the curve is periodic and has no ends: open it first")]
    Periodic,
    /// A target direction or normal is the zero vector.
    #[error("the {} has a target direction of length 0: give it a direction", .end.name())]
    NoDirection {
        /// The end.
        end: End,
    },
    /// The conditions contradict each other or the polygon has too few vertices for them.
    #[error("{} (off by {residual:.2e}): ask for less, unlock vertices, or give the curve more of them", unsolved(*.conditions, *.freedoms))]
    NotSolvable {
        /// The number of conditions.
        conditions: usize,
        /// The number of vertex coordinates that may change.
        freedoms: usize,
        /// The largest residual left, as a length.
        residual: f64,
        /// The number of steps until this was found.
        steps: usize,
    },
    /// A vertex would leave the range of numbers.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
    /// The caller cancelled the correction.
    #[error("the correction was cancelled")]
    Cancelled,
}

fn unsolved(conditions: usize, freedoms: usize) -> String {
    if conditions > freedoms {
        format!(
            "{conditions} end conditions cannot be met by {freedoms} coordinates that may change"
        )
    } else {
        "the end conditions contradict each other, or lie too far from what the curve has"
            .to_owned()
    }
}

/// The disturbance that a correction minimises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Disturbance {
    /// The k-th differences of the vertices' moves, k = 0 to 3: 0 leaves alone what an end does
    /// not need, 1 moves the vertices least, 3 bends the curve most evenly.
    Differences(usize),
    /// The same, with derivatives at the ends that turn to their directions and keep their lengths, as those of rotated
    /// ends do: shorter ones, which move the vertices less, bend the curve sharply.
    Turned(usize),
    /// The moves of the curve, and of its second derivative: the least for a curve whose outer vertices hardly
    /// matter.
    Curve,
    /// The harmony of the polygon, as [`harmonise`](super::harmonising::harmonise) measures it.
    Harmony,
}

/// A way of correcting ends jointly: [`correct_jointly`] or [`correct_hastily`].
pub type Corrector = fn(
    &FloatPolygon,
    &[(End, EndTarget)],
    Disturbance,
    &[usize],
    &Progress,
) -> Result<JointCorrection, CorrectionError>;

/// The result of a joint correction.
#[derive(Clone, Debug, PartialEq)]
pub struct JointCorrection {
    /// The corrected polygon.
    pub polygon: FloatPolygon,
    /// The largest residual of an end afterwards, as [`EndDifference::residual`](crate::geometry::end_correction::EndDifference::residual)
    /// measures it.
    pub residual: f64,
    /// The number of steps.
    pub steps: usize,
}

/// Move the vertices, except the `locked` ones, as little as possible so that every target is met,
/// for any N ≥ n + 1, polynomial or rational, in the plane or in space.
///
/// The moves δ minimise Σ|Δᵏδᵢ|² + μ Σ|δᵢ|², or the harmony functional. Points and directions are
/// linear in the vertices and met at once; curvatures and slopes are approached by Newton's steps,
/// and where those fail from what the curve has, part by part. A planar curve with planar targets
/// stays planar. The derivatives of turned ends have the lengths that they have once the points alone are met; where
/// there are too few vertices for that, these are free. Should a free tangent come out backwards, the system is solved
/// again with such a length.
///
/// # Errors
/// [`CorrectionError`] if the curve is periodic, a direction is 0, the conditions cannot be met, or
/// `progress` is cancelled.
pub fn correct_jointly(
    polygon: &FloatPolygon,
    targets: &[(End, EndTarget)],
    disturbance: Disturbance,
    locked: &[usize],
    progress: &Progress,
) -> Result<JointCorrection, CorrectionError> {
    let correction = Correction::checked(polygon, targets, disturbance, locked, progress)?;
    correction.with_speeds(|speeds| correction.solve(speeds))
}

/// Correct as [`correct_jointly`] does, by its first steps alone: targets that could not be met a moment
/// ago cost hardly anything then.
///
/// # Errors
/// As [`correct_jointly`]; [`CorrectionError::NotSolvable`] also where that takes more steps.
pub fn correct_hastily(
    polygon: &FloatPolygon,
    targets: &[(End, EndTarget)],
    disturbance: Disturbance,
    locked: &[usize],
    progress: &Progress,
) -> Result<JointCorrection, CorrectionError> {
    let correction = Correction::checked(polygon, targets, disturbance, locked, progress)?;
    correction.with_speeds(|speeds| {
        let problem = correction.problem(targets, speeds);
        correction.finish(&problem, problem.before(), HASTY_STEPS)
    })
}

/// The lengths of the derivatives at the ends of the targets; `None` where they are free.
type Speeds = Option<[f64; 2]>;

struct Correction<'a> {
    polygon: &'a FloatPolygon,
    targets: &'a [(End, EndTarget)],
    disturbance: Disturbance,
    locked: &'a [usize],
    progress: &'a Progress,
    /// The steps of all attempts.
    taken: Cell<usize>,
}

impl<'a> Correction<'a> {
    /// Describe a correction; refuse a polygon without ends, and targets without a direction.
    fn checked(
        polygon: &'a FloatPolygon,
        targets: &'a [(End, EndTarget)],
        disturbance: Disturbance,
        locked: &'a [usize],
        progress: &'a Progress,
    ) -> Result<Self, CorrectionError> {
        if polygon.is_periodic() {
            return Err(CorrectionError::Periodic);
        }
        let is_zero = |vector: Option<DVec3>| {
            vector.is_some_and(|vector| vector::direction(vector).is_none())
        };
        let zero = |target: &EndTarget| is_zero(target.direction) || is_zero(target.normal);
        match targets.iter().find(|(_, target)| zero(target)) {
            Some((end, _)) => Err(CorrectionError::NoDirection { end: *end }),
            None => Ok(Self {
                polygon,
                targets,
                disturbance,
                locked,
                progress,
                taken: Cell::new(0),
            }),
        }
    }

    /// Correct with the lengths of the derivatives that the disturbance asks for, and with the others where that cannot
    /// be: a free tangent that comes out backward is half a turn away from its target, which is missed then.
    fn with_speeds(
        &self,
        correct: impl Fn(Speeds) -> Result<JointCorrection, CorrectionError>,
    ) -> Result<JointCorrection, CorrectionError> {
        let is_missed = |it: &Result<_, _>| matches!(it, Err(CorrectionError::NotSolvable { .. }));
        let turned = || self.speeds().map(|speeds| correct(Some(speeds)));
        if let Disturbance::Turned(_) = self.disturbance {
            let turned = turned().filter(|it| !is_missed(it));
            return turned.unwrap_or_else(|| correct(None));
        }
        let free = correct(None);
        match is_missed(&free) {
            true => turned().filter(|it| !is_missed(it)).unwrap_or(free),
            false => free,
        }
    }

    /// The lengths of the derivatives at the start and the finish once the points alone are met; `None` if those
    /// cannot be met, no end has a direction, or there are too few vertices.
    fn speeds(&self) -> Speeds {
        let mut targets = self.targets.iter();
        if !targets.any(|(_, target)| target.direction.is_some()) {
            return None;
        }
        let points = self.targets_with(|_, target| EndTarget {
            point: target.point,
            ..EndTarget::default()
        });
        let speeds = |polygon: &FloatPolygon| End::BOTH.map(|end| polygon.end_jet(end).speed());
        let lengths = if self.is_met(self.polygon, &points) {
            speeds(self.polygon)
        } else {
            let problem = self.problem(&points, None);
            let placed = self.meet(&problem, self.order(), problem.before(), 1)?;
            speeds(&problem.polygon(&placed.vertices).ok()?)
        };
        let problem = self.problem(self.targets, Some(lengths));
        (problem.conditions() <= problem.freedoms()).then_some(lengths)
    }

    /// The order of the differences.
    fn order(&self) -> usize {
        match self.disturbance {
            Disturbance::Differences(order) | Disturbance::Turned(order) => order,
            Disturbance::Curve | Disturbance::Harmony => 1,
        }
    }

    fn solve(&self, speeds: Speeds) -> Result<JointCorrection, CorrectionError> {
        let problem = self.problem(self.targets, speeds);
        let direct = self.finish(&problem, problem.before(), problem::MOST_STEPS);
        match direct {
            Err(CorrectionError::NotSolvable { .. }) if self.bends() => {
                self.part_by_part(speeds).unwrap_or(direct)
            }
            other => other,
        }
    }

    /// Whether a target asks for more than points and directions.
    fn bends(&self) -> bool {
        let mut targets = self.targets.iter();
        targets.any(|(_, target)| target.curvature.is_some() || target.slope.is_some())
    }

    fn problem(&self, targets: &[(End, EndTarget)], speeds: Speeds) -> Problem<'_> {
        let polygon = self.polygon;
        let mut targets_and_own = targets.iter();
        let planar = polygon.is_planar() && targets_and_own.all(|(_, target)| target.is_planar());
        let moves = |vertex| !self.locked.contains(&vertex);
        let mut problem = Problem::new(polygon, planar, moves);
        problem.end_with(self.progress);
        for (end, target) in targets {
            let speed = speeds.map(|[start, finish]| match end {
                End::Start => start,
                End::Finish => finish,
            });
            problem.hold(end.parameter(polygon), target, speed);
        }
        problem
    }

    fn not_solvable(&self, problem: &Problem, residual: f64) -> CorrectionError {
        CorrectionError::NotSolvable {
            conditions: problem.conditions(),
            freedoms: problem.freedoms(),
            residual,
            steps: self.taken.get(),
        }
    }

    /// Meet a problem's conditions with the least differences of the moves, and count the steps.
    fn meet(
        &self,
        problem: &Problem,
        order: usize,
        begin: &[DVec3],
        most: usize,
    ) -> Option<Descent> {
        let objective = match self.disturbance {
            Disturbance::Curve => Objective::CurveMoves { bending: BENDING },
            Disturbance::Turned(_) => Objective::Disturbance {
                order,
                fidelity: TURNED_FIDELITY,
                curve: [0.0; 2],
            },
            Disturbance::Differences(_) | Disturbance::Harmony => Objective::Disturbance {
                order,
                fidelity: FIDELITY,
                curve: [0.0; 2],
            },
        };
        let found = problem.meet(objective, begin, most)?;
        self.taken.update(|taken| taken + found.steps);
        Some(found)
    }

    /// Meet the targets from given vertices by at most `most` steps, and check the residual.
    fn finish(
        &self,
        problem: &Problem,
        begin: &[DVec3],
        most: usize,
    ) -> Result<JointCorrection, CorrectionError> {
        let unsolved = |residual| self.not_solvable(problem, residual);
        let found = self.meet(problem, self.order(), begin, most);
        let mut found = found.ok_or_else(|| unsolved(self.residual(self.polygon)))?;
        if self.disturbance == Disturbance::Harmony {
            let objective = problem.harmony(problem.measure(), 2, CLOSENESS);
            let faired = problem.descend(objective, &found.vertices, MOST_STEPS);
            found.steps += faired.steps;
            found.vertices = faired.vertices;
        }
        if self.progress.is_cancelled() {
            return Err(CorrectionError::Cancelled);
        }
        // Steps that lead nowhere may lead out of the range of numbers.
        let polygon = problem.polygon(&found.vertices);
        let polygon = polygon.map_err(|_| unsolved(self.residual(self.polygon)))?;
        let residual = self.residual(&polygon);
        if !self.is_met(&polygon, self.targets) {
            return Err(unsolved(residual));
        }
        Ok(JointCorrection {
            polygon,
            residual,
            steps: found.steps,
        })
    }

    /// Approach curvatures and slopes from those that the curve has once points and directions are
    /// met. `None` if even those cannot be met.
    fn part_by_part(&self, speeds: Speeds) -> Option<Result<JointCorrection, CorrectionError>> {
        let placed = self.targets_with(|_, target| EndTarget {
            curvature: None,
            slope: None,
            ..target
        });
        let problem = self.problem(&placed, speeds);
        let mut reached = self.meet(&problem, 1, problem.before(), problem::MOST_STEPS)?;
        let begun = problem.polygon(&reached.vertices).ok()?;
        let (mut done, mut part) = (0.0, 0.5);
        let mut steps = reached.steps;
        while done < 1.0 && part * MOST_PARTS >= 1.0 && !self.progress.is_cancelled() {
            let share: f64 = f64::min(1.0, done + part);
            let targets = self.targets_with(|end, target| partial(&begun, end, &target, share));
            let problem = self.problem(&targets, speeds);
            let next = self.meet(&problem, 1, &reached.vertices, problem::MOST_STEPS)?;
            steps += next.steps;
            let polygon = problem.polygon(&next.vertices);
            let is_met = polygon.is_ok_and(|polygon| self.is_met(&polygon, &targets));
            if is_met {
                (done, reached) = (share, next);
                part *= 2.0;
            } else {
                part *= 0.5;
            }
        }
        let problem = self.problem(self.targets, speeds);
        let found = self.finish(&problem, &reached.vertices, problem::MOST_STEPS);
        Some(found.map(|found| JointCorrection {
            steps: steps + found.steps,
            ..found
        }))
    }

    fn targets_with(&self, change: impl Fn(End, EndTarget) -> EndTarget) -> Vec<(End, EndTarget)> {
        let targets = self.targets.iter();
        targets
            .map(|(end, target)| (*end, change(*end, *target)))
            .collect()
    }

    fn residual(&self, polygon: &FloatPolygon) -> f64 {
        largest_residual(polygon, self.targets, self.polygon.size())
    }

    /// Whether every target is met, but for rounding.
    fn is_met(&self, polygon: &FloatPolygon, targets: &[(End, EndTarget)]) -> bool {
        targets.iter().all(|(end, target)| {
            let bends = target.curvature.is_some() || target.slope.is_some();
            let request = PlaceRequest {
                u: end.parameter(polygon),
                target: *target,
                tolerance: None,
                speed: bends.then(|| self.polygon.end_jet(*end).speed()),
            };
            request.is_met(polygon, self.polygon.size())
        })
    }
}

/// A target with a share of the way from a curve's own curvature and slope.
fn partial(begun: &FloatPolygon, end: End, target: &EndTarget, share: f64) -> EndTarget {
    let (jet, planar) = (begun.end_jet(end), begun.is_planar() && target.is_planar());
    let blend = |own: f64, wanted: f64| {
        let own = if own.is_finite() { own } else { wanted };
        own + share * (wanted - own)
    };
    EndTarget {
        curvature: target
            .curvature
            .map(|wanted| blend(jet.curvature_of(planar), wanted)),
        slope: target
            .slope
            .map(|wanted| blend(jet.curvature_slope(planar), wanted)),
        ..*target
    }
}
