//! Least squares with a fairness weight.

use glam::DVec3;

use super::point_list::PointList;
use crate::geometry::banded::{BandedQr, BandedRow, difference_stencil};
use crate::geometry::basis::uniform_basis_derivative;
use crate::geometry::fairing::near_points::{FAIR_ORDER, NearPoints};
use crate::geometry::fitting::FitError;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// Refinements of the parameters.
const ROUNDS: i32 = 8;

/// The fairness weights, by points a vertex, with the factor between them: the least only keeps what no point
/// tells within bounds.
pub(super) const LEAST: f64 = 1e-6;
const MOST: f64 = 1e8;
const FACTOR: f64 = 10.0;

/// Minimise Σ |C(uᵢ) − pᵢ|² + λ Σ |Δ³P|² over the points that count.
pub(super) struct Smoothing<'a> {
    pub(super) list: &'a PointList,
    pub(super) degree: usize,
    pub(super) progress: &'a Progress,
}

/// A solution for one fairness weight.
#[derive(Clone)]
pub(super) struct Smoothed {
    pub(super) near: NearPoints,
    /// The weight, by points a vertex.
    pub(super) fairness: f64,
    /// The root of the mean square and the largest of the distances.
    pub(super) errors: [f64; 2],
}

impl Smoothed {
    /// Measure a curve.
    pub(super) fn new(list: &PointList, near: NearPoints, fairness: f64) -> Self {
        Self {
            errors: list.errors(&near.offsets(&list.points)),
            near,
            fairness,
        }
    }
}

impl<'a> Smoothing<'a> {
    /// Take points, and the degree of the curve.
    pub(super) fn new(list: &'a PointList, degree: usize, progress: &'a Progress) -> Self {
        Self {
            list,
            degree,
            progress,
        }
    }

    /// Find the nearest curve to the points with `count` vertices.
    pub(super) fn least(&self, count: usize) -> Result<Smoothed, FitError> {
        self.solved(count, LEAST)
    }

    /// List the curves for ever larger fairness weights while they pass a test, the fairest last; the one with
    /// the least weight is always the first.
    pub(super) fn while_passing(
        &self,
        count: usize,
        passes: impl Fn(&Smoothed) -> bool,
    ) -> Result<Vec<Smoothed>, FitError> {
        let mut found = vec![self.least(count)?];
        let mut fairness = LEAST;
        while fairness < MOST {
            fairness *= FACTOR;
            let solved = self.solved(count, fairness)?;
            if !passes(&solved) {
                break;
            }
            found.push(solved);
        }
        Ok(found)
    }

    /// The weight λ that belongs to one by points a vertex.
    pub(super) fn weight(&self, count: usize, fairness: f64) -> f64 {
        fairness * self.list.counting() as f64 / count as f64
    }

    /// Solve for one fairness weight. The parameters begin as chord lengths and become those of the nearest
    /// points. With the least weight what is fair is the difference from the curve before, and where there are
    /// as many vertices as points the weight falls further, so that these are met exactly.
    fn solved(&self, count: usize, fairness: f64) -> Result<Smoothed, FitError> {
        let segments = (count - self.degree) as f64;
        let shares = self.list.shares.iter();
        let mut places: Vec<f64> = shares.map(|share| share * segments).collect();
        let mut before: Option<FloatPolygon> = None;
        let mut round = 0;
        loop {
            if self.progress.is_cancelled() {
                return Err(FitError::Cancelled);
            }
            let from = before.as_ref().filter(|_| fairness == LEAST);
            let exact = fairness == LEAST && count >= self.list.counting();
            let falling = if exact { FACTOR.powi(-round) } else { 1.0 };
            let polygon = self.least_squares(count, fairness * falling, &places, from)?;
            let near = NearPoints::new(polygon, &self.list.points, &places);
            round += 1;
            if round > ROUNDS {
                return Ok(Smoothed::new(self.list, near, fairness));
            }
            places = near.places;
            before = Some(near.polygon);
        }
    }

    /// Solve for one fairness weight and given parameters, of the difference from a curve if there is one.
    fn least_squares(
        &self,
        count: usize,
        fairness: f64,
        places: &[f64],
        from: Option<&FloatPolygon>,
    ) -> Result<FloatPolygon, FitError> {
        let degree = self.degree;
        let last = count - degree - 1;
        let mut rows: Vec<(BandedRow, DVec3)> = Vec::new();
        let weights = self.list.weights_for(count);
        let weighed = places.iter().zip(&self.list.points).zip(weights);
        for ((u, point), weight) in weighed.filter(|(_, weight)| *weight > 0.0) {
            let root = weight.sqrt();
            let first = (u.floor() as usize).min(last);
            let basis: Vec<f64> = uniform_basis_derivative(degree, 0, u - first as f64);
            let basis = basis.into_iter().map(|value| root * value).collect();
            let known = from.map_or(DVec3::ZERO, |from| from.point(*u));
            rows.push((row(first, basis), root * (*point - known)));
        }
        let order = FAIR_ORDER.min(count - 1);
        let factor = self.weight(count, fairness).sqrt();
        let stencil = difference_stencil(order);
        for first in 0..count - order {
            let entries = stencil.iter().map(|entry| entry * factor).collect();
            rows.push((row(first, entries), DVec3::ZERO));
        }
        let mut vertices = from.map_or(vec![DVec3::ZERO; count], |from| from.vertices().to_vec());
        for axis in 0..3 {
            let rows = rows.iter().map(|(row, right)| BandedRow {
                right: right[axis],
                ..row.clone()
            });
            let factors = BandedQr::new(rows.collect(), count);
            let found = self.list.counting();
            let factors = factors.ok_or(FitError::TooFewPoints { found, degree })?;
            for (vertex, value) in vertices.iter_mut().zip(factors.solution()) {
                vertex[axis] += value;
            }
        }
        Ok(FloatPolygon::new(degree, vertices, None, false)?)
    }
}

fn row(first: usize, entries: Vec<f64>) -> BandedRow {
    BandedRow {
        first,
        entries,
        right: 0.0,
    }
}
