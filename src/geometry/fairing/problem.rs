//! Reshaping problem: moving vertices, held conditions, and steps towards the smallest
//! objective under these conditions.

use glam::DVec3;

use super::condition::Condition;
use super::jet_weights::JetWeights;
use super::least_squares::LeastSquares;
use super::objective::{Measure, Objective, Shape};
use super::unknowns::Unknowns;
use crate::geometry::banded::BandedQr;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::error::PolygonError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::pivoted_cholesky::PivotedCholesky;
use crate::geometry::progress::Progress;

/// Pivots of the conditions' Gram matrix below this share of the largest count as zero.
const RANK_TOLERANCE: f64 = 1e-13;

/// Repeated solutions on the residual: they bring linear conditions down to rounding.
const REFINEMENTS: usize = 4;

/// The most steps towards nonlinear conditions; then they count as contradictory.
pub(super) const MOST_STEPS: usize = 60;

/// Steps below this share of the curve's size count as none.
const NO_STEP: f64 = 4.0 * f64::EPSILON;

/// The residual of the conditions, in units of the curve's size, from which on Newton's steps
/// converge by themselves.
const NEAR: f64 = 1e-8;

/// The shortest share of a step that is tried.
const SHORTEST_SHARE: f64 = 1.0 / 1024.0;

/// The share of the promised decrease that a step must bring.
const SUFFICIENT: f64 = 1e-4;

/// The weight ε with which noise is taken from a polygon in space.
const SMOOTHING: f64 = 1e-10;

/// A relative decrease of the objective below this ends the descent.
const SETTLED: f64 = 1e-7;

/// A curve to be reshaped. Vertices stand in the polygon's own coordinates, so that what they are
/// rounded to counts; equations are set up about its first vertex, in units of its size.
pub(super) struct Problem<'a> {
    polygon: &'a FloatPolygon,
    planar: bool,
    unknowns: Unknowns,
    origin: DVec3,
    scale: f64,
    before: Vec<DVec3>,
    held: Vec<(JetWeights, Vec<Condition>)>,
    /// The vertices whose harmony counts.
    counts: Vec<bool>,
    /// The weights of second differences in a disturbance.
    tensions: Vec<f64>,
    /// Ends the steps early.
    progress: Progress,
}

/// The vertices that a descent found.
#[derive(Clone, Debug)]
pub(super) struct Descent {
    /// The vertices.
    pub(super) vertices: Vec<DVec3>,
    /// The number of steps.
    pub(super) steps: usize,
}

/// A way to harmony, for falling weights of the moves.
#[derive(Clone, Debug)]
pub(super) struct Sweep {
    pub(super) measure: Measure,
    /// The order of the differences.
    pub(super) order: usize,
    /// Start of each descent.
    pub(super) begin: Vec<DVec3>,
    /// Whether each descent begins where the one before ended.
    pub(super) goes_on: bool,
}

impl<'a> Problem<'a> {
    /// Let those vertices of a polygon move for which `moves` holds, in the plane z = 0 alone if
    /// `planar`.
    pub(super) fn new(
        polygon: &'a FloatPolygon,
        planar: bool,
        moves: impl Fn(usize) -> bool,
    ) -> Self {
        let origin = polygon.vertex(0);
        let size = polygon.size();
        // A power of two: scaling rounds nothing.
        let scale = if size > 0.0 && size.is_finite() {
            size.log2().floor().exp2()
        } else {
            1.0
        };
        let vertices = polygon.vertices().iter();
        Self {
            polygon,
            planar,
            unknowns: Unknowns::new(polygon, planar, moves),
            origin,
            scale,
            before: vertices.map(|vertex| (*vertex - origin) / scale).collect(),
            held: Vec::new(),
            counts: vec![true; polygon.vertices().len()],
            tensions: Vec::new(),
            progress: Progress::default(),
        }
    }

    /// Take no further steps once the computation is cancelled.
    pub(super) fn end_with(&mut self, progress: &Progress) {
        self.progress = progress.clone();
    }

    /// Let second differences of the moves count in a disturbance too, by these weights, one for each three vertices in a
    /// row.
    pub(super) fn stiffen(&mut self, tensions: Vec<f64>) {
        self.tensions = tensions;
    }

    /// Hold the curve at a parameter to a target; with a `speed`, |C′| too.
    pub(super) fn hold(&mut self, u: f64, target: &EndTarget, speed: Option<f64>) {
        let target = EndTarget {
            point: (target.point - self.origin) / self.scale,
            curvature: target.curvature.map(|curvature| curvature * self.scale),
            slope: target.slope.map(|slope| slope * self.scale * self.scale),
            ..*target
        };
        let speed = speed.map(|speed| speed / self.scale);
        let conditions = Condition::of(&target, self.planar, speed);
        self.held
            .push((JetWeights::at(self.polygon, u), conditions));
    }

    /// Hold a combination of the vertices to a point.
    pub(super) fn hold_point(&mut self, weights: Vec<(usize, f64)>, point: DVec3) {
        let target = EndTarget {
            point: (point - self.origin) / self.scale,
            ..EndTarget::default()
        };
        let conditions = Condition::of(&target, self.planar, None);
        self.held.push((JetWeights::of_point(weights), conditions));
    }

    /// Let the harmony of only those vertices count for which `counts` holds.
    pub(super) fn count_only(&mut self, counts: impl Fn(usize) -> bool) {
        self.counts = (0..self.before.len()).map(counts).collect();
    }

    /// Weigh moves from other places than those where the vertices are now.
    pub(super) fn moved_from(&mut self, before: &[DVec3]) {
        self.before = self.local(before);
    }

    /// The vertices as they were.
    pub(super) fn before(&self) -> &[DVec3] {
        self.polygon.vertices()
    }

    /// The harmony of the polygon by some measure, with differences of some order, and the moves
    /// weighed by `closeness`.
    pub(super) fn harmony(&self, measure: Measure, order: usize, closeness: f64) -> Objective {
        Objective::Harmony {
            measure,
            order,
            closeness,
            leg: self.mean_leg(),
        }
    }

    /// The default measure of the polygon.
    pub(super) fn measure(&self) -> Measure {
        if self.planar {
            Measure::SignedCurvature
        } else {
            Measure::CurvatureAndTorsion
        }
    }

    /// List the ways to harmony with differences of some order: from the vertices as they are. Noise
    /// in space turns torsion angles by any amount: there also from vertices that are freed of it,
    /// and by the curvature alone.
    pub(super) fn sweeps(&self, order: usize) -> Vec<Sweep> {
        let from_here = |measure| Sweep {
            measure,
            order,
            begin: self.before().to_vec(),
            goes_on: true,
        };
        let mut sweeps = vec![from_here(self.measure())];
        if !self.planar {
            let vector = Measure::CurvatureVector;
            let smoothing = self.harmony(vector, order, SMOOTHING);
            sweeps.push(Sweep {
                measure: self.measure(),
                order,
                begin: self.descend(smoothing, self.before(), MOST_STEPS).vertices,
                goes_on: false,
            });
            sweeps.push(from_here(vector));
        }
        sweeps
    }

    /// The number of unknowns.
    pub(super) fn freedoms(&self) -> usize {
        self.unknowns.len()
    }

    /// The number of conditions.
    pub(super) fn conditions(&self) -> usize {
        self.held
            .iter()
            .map(|(_, conditions)| conditions.len())
            .sum()
    }

    /// The mean leg, in units of the polygon's size; 1 for a polygon of no length.
    fn mean_leg(&self) -> f64 {
        let legs = self.before.windows(2).map(|leg| leg[0].distance(leg[1]));
        let sum: f64 = legs.sum();
        if sum > 0.0 {
            sum / (self.before.len() - 1) as f64
        } else {
            1.0
        }
    }

    /// Put vertices in place; those that do not move stay to the bit.
    ///
    /// # Errors
    /// [`PolygonError`] if a vertex would leave the range of numbers.
    pub(super) fn polygon(&self, vertices: &[DVec3]) -> Result<FloatPolygon, PolygonError> {
        let mut reshaped = self.polygon.clone();
        let moves = self.unknowns.vertices();
        let moves: Vec<(usize, DVec3)> = moves
            .map(|(vertex, _)| (vertex, vertices[vertex]))
            .collect();
        reshaped.move_vertices(moves)?;
        Ok(reshaped)
    }

    /// Find the vertices with the smallest quadratic objective that meet the conditions, beginning
    /// at some vertices, by at most so many steps. `None` if the equations cannot be solved at all;
    /// whether the conditions are met, the caller measures.
    pub(super) fn meet(
        &self,
        objective: Objective,
        begin: &[DVec3],
        most: usize,
    ) -> Option<Descent> {
        let mut all = self.held.iter().flat_map(|(_, conditions)| conditions);
        let most = if all.all(Condition::is_linear) {
            1
        } else {
            most
        };
        let mut vertices = begin.to_vec();
        let mut steps = 0;
        let mut last = f64::INFINITY;
        let (_, mut factors) = self.squares(objective, &vertices).factor()?;
        let mut conditions = self.linearise(&factors, &vertices)?;
        while steps < most && !self.progress.is_cancelled() {
            let step = conditions.step(&factors);
            let missing = conditions.missing(&conditions.left);
            let mut share = 1.0;
            let mut moved = self.moved(&vertices, &step, share);
            while missing > NEAR
                && share > SHORTEST_SHARE
                && conditions.missing(&self.left(&moved)) > (1.0 - 0.25 * share) * missing
            {
                share *= 0.5;
                moved = self.moved(&vertices, &step, share);
            }
            vertices = moved;
            steps += 1;
            if steps < most {
                (_, factors) = self.squares(objective, &vertices).factor()?;
                conditions = self.linearise(&factors, &vertices)?;
            }
            let length = step.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
            // Near the conditions steps that do not become shorter are rounding.
            if length <= NO_STEP || (missing <= NEAR && length >= last) {
                break;
            }
            last = length;
        }
        Some(Descent {
            vertices: self.restored(&conditions, vertices),
            steps,
        })
    }

    /// Go down to a smallest objective along vertices that meet the conditions, beginning at some
    /// that do, by at most `most` Gauss–Newton steps.
    pub(super) fn descend(&self, objective: Objective, begin: &[DVec3], most: usize) -> Descent {
        let mut vertices = begin.to_vec();
        let mut value = self.value(objective, &vertices);
        let mut steps = 0;
        while steps < most && !self.progress.is_cancelled() {
            let Some((gradient, factors)) = self.squares(objective, &vertices).factor() else {
                break;
            };
            let Some(conditions) = self.linearise(&factors, &vertices) else {
                break;
            };
            let step = conditions.step(&factors);
            let promised = -2.0 * dot(&gradient, &step);
            let mut share = 1.0;
            let found = loop {
                let moved = self.moved(&vertices, &step, share);
                let moved = self.restored(&conditions, moved);
                let reached = self.value(objective, &moved);
                if reached <= value - SUFFICIENT * share * promised {
                    break Some((moved, reached));
                }
                share *= 0.5;
                if share < SHORTEST_SHARE {
                    break None;
                }
            };
            steps += 1;
            let Some((moved, reached)) = found else {
                break;
            };
            let settled = value - reached <= SETTLED * value;
            (vertices, value) = (moved, reached);
            if settled {
                break;
            }
        }
        Descent { vertices, steps }
    }

    /// Correct the residuals of the conditions after a step.
    fn restored(&self, conditions: &Linearised, mut vertices: Vec<DVec3>) -> Vec<DVec3> {
        if self.held.is_empty() {
            return vertices;
        }
        for _ in 0..REFINEMENTS {
            let left = self.left(&vertices);
            let step = conditions.correction(&left);
            vertices = self.moved(&vertices, &step, 1.0);
            if conditions.missing(&left) <= NO_STEP {
                break;
            }
        }
        vertices
    }

    fn shape(&self) -> Shape<'_> {
        Shape {
            polygon: self.polygon,
            before: &self.before,
            counts: &self.counts,
            tensions: &self.tensions,
        }
    }

    fn moved(&self, vertices: &[DVec3], step: &[f64], share: f64) -> Vec<DVec3> {
        self.unknowns.moved(vertices, step, share * self.scale)
    }

    /// Vertices about the first one, in units of the size.
    fn local(&self, vertices: &[DVec3]) -> Vec<DVec3> {
        let local = |vertex: &DVec3| (*vertex - self.origin) / self.scale;
        vertices.iter().map(local).collect()
    }

    fn value(&self, objective: Objective, vertices: &[DVec3]) -> f64 {
        objective.value(self.shape(), &self.unknowns, &self.local(vertices))
    }

    fn squares(&self, objective: Objective, vertices: &[DVec3]) -> LeastSquares<'_> {
        objective.gather(self.shape(), &self.unknowns, &self.local(vertices))
    }

    /// Residuals of the conditions.
    fn left(&self, vertices: &[DVec3]) -> Vec<f64> {
        let vertices = &self.local(vertices);
        let conditions = self.held.iter().flat_map(|(weights, conditions)| {
            conditions.iter().map(move |condition| (weights, condition))
        });
        conditions
            .map(|(weights, condition)| condition.linearised(weights, vertices).0)
            .collect()
    }

    fn linearise(&self, factors: &BandedQr, vertices: &[DVec3]) -> Option<Linearised> {
        let vertices = &self.local(vertices);
        let mut left = Vec::new();
        let mut rows = Vec::new();
        for (weights, conditions) in &self.held {
            for condition in conditions {
                let (missing, gradient) = condition.linearised(weights, vertices);
                left.push(missing);
                rows.push(self.unknowns.row(&gradient));
            }
        }
        let responses: Vec<Vec<f64>> = rows.iter().map(|row| factors.solve(row)).collect();
        let entry = |row: usize, column: usize| dot(&rows[row], &responses[column]);
        // Points and derivatives, and the ends of a curve with very different weights, differ by
        // orders of magnitude: each condition is measured in its own unit.
        let units: Vec<f64> = (0..rows.len())
            .map(|row| entry(row, row).sqrt().recip())
            .map(|unit| if unit.is_finite() { unit } else { 0.0 })
            .collect();
        let gram = |row: usize, column: usize| units[row] * entry(row, column) * units[column];
        let gram = PivotedCholesky::new(rows.len(), gram, RANK_TOLERANCE)?;
        Some(Linearised {
            left,
            rows,
            responses,
            units,
            gram,
            unknowns: self.unknowns.len(),
        })
    }
}

/// The conditions near some vertices.
struct Linearised {
    left: Vec<f64>,
    rows: Vec<Vec<f64>>,
    responses: Vec<Vec<f64>>,
    units: Vec<f64>,
    gram: PivotedCholesky,
    unknowns: usize,
}

impl Linearised {
    /// The step to the smallest quadratic model on which the conditions hold.
    fn step(&self, factors: &BandedQr) -> Vec<f64> {
        let downhill = factors.solution();
        let rows = self.rows.iter().zip(&self.left);
        let left: Vec<f64> = rows.map(|(row, left)| left - dot(row, &downhill)).collect();
        let correction = self.correction(&left);
        let parts = correction.iter().zip(&downhill);
        parts.map(|(correction, down)| correction - down).collect()
    }

    /// The smallest step that cancels the residuals of the conditions.
    fn correction(&self, left: &[f64]) -> Vec<f64> {
        let scaled = left.iter().zip(&self.units);
        let scaled: Vec<f64> = scaled.map(|(left, unit)| -left * unit).collect();
        let multipliers = self.gram.solve(&scaled);
        let mut step = vec![0.0; self.unknowns];
        for ((response, multiplier), unit) in
            self.responses.iter().zip(multipliers).zip(&self.units)
        {
            for (part, value) in step.iter_mut().zip(response) {
                *part += multiplier * unit * value;
            }
        }
        step
    }

    /// The largest residual of the conditions, each in its own unit.
    fn missing(&self, left: &[f64]) -> f64 {
        let scaled = left.iter().zip(&self.units);
        scaled.fold(0.0, |most, (left, unit)| most.max((left * unit).abs()))
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
