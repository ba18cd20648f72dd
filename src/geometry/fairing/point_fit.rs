//! Nearest curve to points in space among those whose curvature rises and falls as requested.
//!
//! Makes Σ |C(uᵢ) − pᵢ|² + λ Σ |Δ³P|² small while the slope of the curvature keeps its sign between
//! two turns, at samples: the conditions press by multipliers, which are found by turns with the
//! vertices (Gauss–Newton steps, damped). Slopes are measured in what noise of the points makes of them.
//! Turns move to the side where conditions press, and samples are added where a proof finds extrema
//! between them.

use super::least_squares::LeastSquares;
use super::near_points::{NearPoints, Points};
use super::slope_signs::SlopeSign;
use super::unknowns::Unknowns;
use crate::geometry::error::PolygonError;
use crate::geometry::features::{Feature, Features};
use crate::geometry::fitting::best_runs;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

use glam::DVec3;

/// The local parameters of a segment at which the slope has conditions.
const SAMPLES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// The weights of the conditions, the first and the last, and the factor between them.
const FIRST: f64 = 1.0;
const LAST: f64 = 1e4;
const GROWTH: f64 = 3.0;

/// The most changes of the multipliers, and the most steps between them.
const ROUNDS: usize = 40;
const STEPS: usize = 8;

/// Rounds in a row without a step after which nothing changes any more.
const STUCK: usize = 4;

/// A relative decrease below this ends the steps, and one of the sum of squares below the second the rounds.
const SETTLED: [f64; 2] = [1e-4, 1e-3];

/// The weights by which vertices are held where they are: the first, the least and the most, and the
/// factor between them.
const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-9;
const MOST_DAMPING: f64 = 1e3;
const DAMPING: f64 = 10.0;

/// The share of the promised decrease that a step must bring, that with which damping stays as it is, and that
/// with which it may fall.
const SUFFICIENT: f64 = 1e-4;
const FAIR: f64 = 0.1;
const GOOD: f64 = 0.5;

/// Find the curve nearest to the points with just so many extrema of the curvature, proved, beginning at a
/// curve near them: with the pattern of rising and falling that suits its curvature best, or else with
/// that which begins the other way. `None` where none is found or the computation was cancelled.
///
/// # Errors
/// [`PolygonError`] if a vertex leaves the range of numbers.
pub(in crate::geometry) fn nearest_with_extrema(
    points: &Points,
    from: &NearPoints,
    extrema: usize,
    progress: &Progress,
) -> Result<Option<NearPoints>, PolygonError> {
    let polygon = &from.polygon;
    let segments = 0..polygon.segments();
    let samples = segments.flat_map(|segment| SAMPLES.map(|t| (segment, t)));
    let samples = samples.map(|(segment, t)| SlopeSign::new(polygon, segment, t, true));
    let samples: Vec<SlopeSign> = samples.collect();
    let vertices = polygon.vertices();
    let curvatures = samples.iter().map(|it| it.curvature(vertices));
    let curvatures: Vec<f64> = curvatures.collect();
    if !curvatures.iter().all(|curvature| curvature.is_finite()) {
        return Ok(None);
    }
    let even = vec![1.0; curvatures.len()];
    for runs in best_runs(&curvatures, &even, extrema) {
        let mut signs = samples.clone();
        for (index, sign) in signs.iter_mut().enumerate() {
            sign.ask(runs.rises(index));
        }
        let fit = PointFit {
            points,
            unknowns: Unknowns::new(polygon, false, |_| true),
            extrema,
            progress,
            weight: FIRST,
            damping: FIRST_DAMPING,
            signs,
        };
        let found = fit.run(from)?;
        if found.is_some() || progress.is_cancelled() {
            return Ok(found);
        }
    }
    Ok(None)
}

struct PointFit<'a> {
    points: &'a Points<'a>,
    unknowns: Unknowns,
    extrema: usize,
    progress: &'a Progress,
    /// The weight of the conditions.
    weight: f64,
    damping: f64,
    /// The conditions, by parameter.
    signs: Vec<SlopeSign>,
}

impl PointFit<'_> {
    fn run(mut self, from: &NearPoints) -> Result<Option<NearPoints>, PolygonError> {
        let mut near = from.clone();
        let mut best: Option<(f64, NearPoints)> = None;
        let mut stuck = 0;
        if !self.measure(&near, 0) {
            return Ok(None);
        }
        self.weight = self.first_weight(&near.polygon);
        for _ in 0..ROUNDS {
            if self.progress.is_cancelled() {
                return Ok(None);
            }
            let settled;
            (near, settled) = self.descend(near)?;
            let is_stuck = self.damping >= MOST_DAMPING;
            self.damping = self.damping.min(MOST_DAMPING / DAMPING);
            stuck = if is_stuck { stuck + 1 } else { 0 };
            if self.update(&near.polygon) {
                let features = Features::proved(&near.polygon, |_| !self.progress.is_cancelled());
                let Some(features) = features else {
                    return Ok(None);
                };
                let square = self.points.square(&near);
                let known = best.as_ref().map_or(f64::INFINITY, |(known, _)| *known);
                if extrema_of(&features) == self.extrema {
                    if square < known {
                        best = Some((square, near.clone()));
                    }
                    if square > (1.0 - SETTLED[1]) * known {
                        break;
                    }
                } else if !self.add_samples(&near, &features) {
                    break;
                }
            }
            if stuck == STUCK {
                break;
            }
            self.move_turns();
            if settled {
                self.weight = (self.weight * GROWTH).min(LAST);
            }
        }
        Ok(best.map(|(_, near)| near))
    }

    /// The weight that fits the mean size of the slopes: less where they are noise, more where the curve is smooth.
    fn first_weight(&self, polygon: &FloatPolygon) -> f64 {
        let slopes = self.signs.iter();
        let slopes = slopes.map(|sign| sign.slope(polygon.vertices()).0.abs());
        let mean = slopes.sum::<f64>() / self.signs.len() as f64;
        mean.recip().clamp(FIRST, LAST)
    }

    /// Take what presses as the multipliers. Returns whether all slopes have their signs.
    fn update(&mut self, polygon: &FloatPolygon) -> bool {
        let mut holds = true;
        for sign in &mut self.signs {
            let (slope, _) = sign.slope(polygon.vertices());
            sign.update(self.weight, slope);
            holds &= slope > 0.0;
        }
        holds
    }

    /// Step down while that brings something. Returns also whether it no longer does.
    fn descend(&mut self, mut near: NearPoints) -> Result<(NearPoints, bool), PolygonError> {
        let mut value = self.value(&near);
        for _ in 0..STEPS {
            let Some((gradient, factors)) = self.squares(&near).factor() else {
                return Ok((near, true));
            };
            let downhill = factors.solution();
            let terms = gradient.iter().zip(&downhill);
            let promised: f64 = terms.map(|(slope, part)| slope * part).sum();
            let vertices = self
                .unknowns
                .moved(near.polygon.vertices(), &downhill, -1.0);
            let moved = near.moved(vertices, self.points.points)?;
            let reached = self.value(&moved);
            let share = (value - reached) / promised;
            if share > GOOD {
                self.damping = (self.damping / DAMPING).max(LEAST_DAMPING);
            } else if !(share > FAIR) {
                self.damping *= DAMPING;
            }
            if share > SUFFICIENT {
                let settled = value - reached <= SETTLED[0] * value;
                (near, value) = (moved, reached);
                if settled {
                    return Ok((near, true));
                }
            }
            if self.damping >= MOST_DAMPING {
                return Ok((near, true));
            }
        }
        Ok((near, false))
    }

    fn value(&self, near: &NearPoints) -> f64 {
        let vertices = near.polygon.vertices();
        let pressures = self.signs.iter().map(|sign| {
            let (slope, _) = sign.slope(vertices);
            2.0 * sign.pressure(self.weight, slope).value
        });
        self.points.value(near) + pressures.sum::<f64>()
    }

    fn squares(&self, near: &NearPoints) -> LeastSquares<'_> {
        let vertices = near.polygon.vertices();
        let mut squares = LeastSquares::new(&self.unknowns);
        self.points.gather(near, &mut squares);
        for sign in &self.signs {
            let (slope, gradient) = sign.slope(vertices);
            let pressure = sign.pressure(self.weight, slope);
            let root = pressure.second.sqrt();
            let gradient = gradient.into_iter();
            let gradient: Vec<(usize, DVec3)> =
                gradient.map(|(vertex, it)| (vertex, root * it)).collect();
            squares.add(pressure.first / root, &gradient);
        }
        let share = self.points.points.len() as f64 / vertices.len() as f64;
        let held = (self.damping * share).sqrt() / self.points.noise;
        for vertex in 0..vertices.len() {
            squares.add_vector(DVec3::ZERO, &[(vertex, held)]);
        }
        squares
    }

    /// Measure slopes, from some condition on, by how far noise moves them. Returns whether that can be.
    fn measure(&mut self, near: &NearPoints, first: usize) -> bool {
        let mut squares = LeastSquares::new(&self.unknowns);
        self.points.gather(near, &mut squares);
        let Some((_, factors)) = squares.factor() else {
            return false;
        };
        for sign in &mut self.signs[first..] {
            let (_, gradient) = sign.slope(near.polygon.vertices());
            let row = self.unknowns.row(&gradient);
            let response = factors.solve(&row);
            let terms = row.iter().zip(response);
            let variance: f64 = terms.map(|(slope, response)| slope * response).sum();
            sign.measure_in(variance.sqrt());
        }
        true
    }

    /// Ask for the sign between extrema that are too many. Returns whether anything is added.
    fn add_samples(&mut self, near: &NearPoints, features: &Features) -> bool {
        let extrema = features.curvature_extrema.iter();
        let middles: Vec<f64> = extrema.map(|it| 0.5 * (it.u[0] + it.u[1])).collect();
        let known = self.signs.len();
        for pair in middles.windows(2) {
            let u = 0.5 * (pair[0] + pair[1]);
            let (segment, t) = near.polygon.locate(u);
            let distance = |sign: &&SlopeSign| (sign.u - u).abs();
            let nearest = self.signs[..known].iter();
            let nearest = nearest.min_by(|a, b| distance(a).total_cmp(&distance(b)));
            let rises = nearest.is_some_and(|sign| sign.rises);
            let sign = SlopeSign::new(&near.polygon, segment, t, rises);
            if sign.slope(near.polygon.vertices()).0 < 0.0 {
                self.signs.push(sign);
            }
        }
        let is_added = self.signs.len() > known && self.measure(near, known);
        self.signs.sort_by(|a, b| a.u.total_cmp(&b.u));
        is_added
    }

    /// Move turns to the side where the conditions press: the sample beside a turn whose condition is active
    /// goes over to the other run, unless it is the last of its own.
    fn move_turns(&mut self) {
        let rises: Vec<bool> = self.signs.iter().map(|sign| sign.rises).collect();
        let mut index = 1;
        while index < rises.len() {
            let (before, behind) = (index - 1, index);
            if rises[before] != rises[behind] {
                let active = [before, behind].map(|sign| self.signs[sign].active);
                let goes_on = |other: Option<&bool>, own: usize| other == Some(&rises[own]);
                let earlier = before.checked_sub(1).and_then(|it| rises.get(it));
                match active {
                    [true, false] if goes_on(earlier, before) => {
                        self.signs[before].ask(rises[behind]);
                    }
                    [false, true] if goes_on(rises.get(behind + 1), behind) => {
                        self.signs[behind].ask(rises[before]);
                        index += 1;
                    }
                    _ => {}
                }
            }
            index += 1;
        }
    }
}

/// The number of curvature extrema, undecided places among them.
pub(in crate::geometry) fn extrema_of(features: &Features) -> usize {
    features.count(Feature::CurvatureExtremum) + features.undecided.len()
}
