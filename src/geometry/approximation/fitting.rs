//! Float polygons through the middle of points: least squares with a fairness weight.

use std::cmp::Ordering;

use glam::DVec3;
use thiserror::Error;

use crate::geometry::banded::{BandedQr, BandedRow, difference_stencil};
use crate::geometry::basis::uniform_basis_derivative;
use crate::geometry::control_polygon::check_size;
use crate::geometry::error::PolygonError;
use crate::geometry::fairing::harmonising::{Harmony, HarmonyError, Held, harmonise};
use crate::geometry::features::Features;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::nearest::refined_parameter;
use crate::geometry::progress::Progress;

/// The order of the differences of the vertices that fairness keeps small.
const ORDER: usize = 3;

/// How often the parameters are refined.
const ROUNDS: i32 = 8;

/// Outliers are looked for with so many points a vertex: such a curve is not stiff.
const POINTS_A_VERTEX: usize = 8;

/// How often outliers are looked for: a curve without those that are known shows the others.
const SEARCHES: usize = 8;

/// While outliers are looked for no chord counts for more than so many times those about it, as the long
/// chords to an outlier would leave it a part of the curve of its own.
const CAP: f64 = 2.0;

/// An outlier is off by at least so many standard deviations.
const OUTLYING: f64 = 6.0;

/// How many neighbours on either side an outlier stands out from.
const NEIGHBOURS: usize = 3;

/// Points that are off by less than this share of the mean distance of neighbours are no outliers.
const NEGLIGIBLE: f64 = 1e-3;

/// The standard deviation of normal errors in units of their median.
const BY_MEDIAN: f64 = 1.4826;

/// Errors below this share of the points' size are rounding, and make no outliers.
const ROUNDING: f64 = 1e-12;

/// The fairness weights, by points a vertex: the least only keeps what no point tells within bounds.
const LEAST: f64 = 1e-6;
const MOST: f64 = 1e8;

/// Errors that grow by less than this factor hardly grow.
const HARDLY: f64 = 1.05;

/// The shares of the best number of vertices that are tried for extrema: how near a curve with few of them
/// comes changes much from one number to the next.
const SHARES: [f64; 13] = [
    1.0, 1.06, 0.94, 1.12, 0.88, 1.18, 0.82, 1.25, 0.75, 1.4, 1.6, 2.0, 3.0,
];

/// The next one is nearer by at least this factor.
const GAIN: f64 = 1.01;

/// How often a curve with the right extrema is the shape for the next one, while that is nearer to the points.
const NEARER: usize = 4;

/// The factor between weights that are tried, and the bisections afterwards.
const FACTOR: f64 = 10.0;
const BISECTIONS: usize = 6;

/// What a fit is to be like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitAsked {
    /// The degree.
    pub degree: usize,
    /// The number of vertices; `None` for as many as the points or the tolerance call for.
    pub count: Option<usize>,
    /// The number of curvature extrema; `None` for any.
    pub extrema: Option<usize>,
    /// How far points may be from the curve, outliers aside.
    pub tolerance: Option<f64>,
}

/// A fit, and what is known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The float polygon.
    pub polygon: FloatPolygon,
    /// Whether what was asked for is reached: extrema, proved, and the tolerance.
    pub reached: bool,
    /// The number of curvature extrema, proved.
    pub extrema: usize,
    /// The root of the mean squared distance of the points, outliers aside.
    pub rms: f64,
    /// The largest distance, outliers aside.
    pub largest: f64,
    /// The numbers of the points that do not count, from 0.
    pub outliers: Vec<usize>,
    /// The fairness weight, by points a vertex.
    pub fairness: f64,
}

/// Why points have no fit.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FitError {
    /// There are too few points, or they all coincide.
    #[error(
        "{} too few for a curve: at least {needed} points that differ from the one before are needed",
        if *found == 1 { "1 point is".to_owned() } else { format!("{found} different points are") }
    )]
    TooFewPoints {
        /// The number of points that differ from the one before.
        found: usize,
        /// The number needed.
        needed: usize,
    },
    /// There are too few vertices or points for the extrema.
    #[error(
        "{extrema} curvature extrema are too many for {count} {of}: the discrete curvature of a polygon has at most as many extrema as vertices less 4, so {needed} are needed"
    )]
    TooManyExtrema {
        /// The number of extrema asked for.
        extrema: usize,
        /// The number of vertices or points.
        count: usize,
        /// Of which of them there are too few.
        of: &'static str,
        /// The least number that can hold so many.
        needed: usize,
    },
    /// There are more vertices than points.
    #[error(
        "{count} vertices are too many for {points} points: give at most as many vertices as points"
    )]
    TooManyVertices {
        /// The number of vertices asked for.
        count: usize,
        /// The number of points.
        points: usize,
    },
    /// The computation was ended early.
    #[error("the fit was cancelled")]
    Cancelled,
    /// The vertices make no polygon.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
    /// The curve cannot be harmonised.
    #[error(transparent)]
    Harmony(#[from] HarmonyError),
}

/// Fit a curve to points that follow each other along it.
///
/// Minimises Σ |C(uᵢ) − pᵢ|² + λ Σ |Δ³P|² over all points but the outliers. The parameters begin as chord
/// lengths and become those of the nearest points. Outliers are found once, against a curve with a vertex
/// for every few points: they are far from it, and stand out from their neighbours. Without a number of
/// vertices the one is taken that explains the points best for its size (Bayes' information criterion),
/// or, where no extrema are asked for, the smallest that keeps the tolerance. Extrema asked for are reached
/// by the least fairness weight λ that has just so many, proved, or from a harmonised curve P⁰, with the
/// least λ in λ Σ |Δ³(P − P⁰)|²: the nearest to the points counts.
///
/// # Errors
/// [`FitError`].
pub fn fit_points(
    points: &[DVec3],
    asked: &FitAsked,
    progress: &Progress,
) -> Result<Fitted, FitError> {
    let mut fit = Fit::new(points, asked, progress)?;
    fit.find_outliers()?;
    progress.set_done(0.1);
    match (asked.extrema, asked.tolerance) {
        (Some(extrema), _) => fit.best_with_extrema(extrema),
        (None, Some(tolerance)) => fit.fairest(fit.count(Some(tolerance))?, tolerance),
        (None, None) => fit.finished(fit.solved(fit.count(None)?, LEAST, None)?),
    }
}

struct Fit<'a> {
    points: &'a [DVec3],
    asked: &'a FitAsked,
    progress: &'a Progress,
    planar: bool,
    size: f64,
    /// The sum of the chords.
    length: f64,
    /// The share of the chord length up to each point.
    shares: Vec<f64>,
    /// Whether each point counts.
    counts: Vec<bool>,
}

/// A solution for one fairness weight.
#[derive(Clone)]
struct Solved {
    polygon: FloatPolygon,
    fairness: f64,
    /// From each point to the curve.
    offsets: Vec<DVec3>,
    /// The root of the mean square and the largest of the distances, outliers aside.
    errors: [f64; 2],
}

impl<'a> Fit<'a> {
    fn new(
        points: &'a [DVec3],
        asked: &'a FitAsked,
        progress: &'a Progress,
    ) -> Result<Self, FitError> {
        check_size(asked.degree, asked.count.unwrap_or(asked.degree + 1), false)?;
        let legs = points.windows(2).filter(|leg| leg[0] != leg[1]);
        let (found, needed) = (
            legs.count() + usize::from(!points.is_empty()),
            asked.degree + 1,
        );
        if found < needed {
            return Err(FitError::TooFewPoints { found, needed });
        }
        if let Some(count) = asked.count.filter(|count| *count > points.len()) {
            let points = points.len();
            return Err(FitError::TooManyVertices { count, points });
        }
        if let Some(extrema) = asked.extrema {
            let needed = vertices_for(extrema, asked.degree);
            let limits = [
                (asked.count.unwrap_or(needed), "vertices"),
                (points.len(), "points"),
            ];
            if let Some((count, of)) = limits.into_iter().find(|(count, _)| *count < needed) {
                return Err(FitError::TooManyExtrema {
                    extrema,
                    count,
                    of,
                    needed,
                });
            }
        }
        let lengths = points.windows(2).map(|leg| leg[0].distance(leg[1]));
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = points.iter().fold(start, |(low, high), point| {
            (low.min(*point), high.max(*point))
        });
        Ok(Self {
            points,
            asked,
            progress,
            planar: points.iter().all(|point| point.z == 0.0),
            size: low.distance(high),
            length: lengths.sum(),
            shares: Vec::new(),
            counts: vec![true; points.len()],
        })
    }

    /// Find the points that are far from a curve that is not stiff, and stand out from their neighbours:
    /// what such a curve misses in a row is none.
    fn find_outliers(&mut self) -> Result<(), FitError> {
        let points = self.points.len();
        let least = self.asked.degree + 1;
        let count = (points / POINTS_A_VERTEX).max(least);
        let negligible = NEGLIGIBLE * self.length / (points - 1) as f64;
        for _ in 0..SEARCHES {
            self.shares = self.shares_of_chords(CAP);
            let solved = self.solved(count, LEAST, None)?;
            let distances: Vec<f64> = solved.offsets.iter().map(|it| it.length()).collect();
            let standing_out = self.standing_out(&solved.offsets);
            let limits = [&distances, &standing_out]
                .map(|lengths| OUTLYING * self.deviation(lengths).max(negligible / OUTLYING));
            let is_off = |index: &usize| {
                let index = *index;
                let near = self.neighbours(index).map(|other| distances[other]);
                // The worst pull the curve to them, and their neighbours wait for the next search.
                let is_worst = near.fold(0.0, f64::max) <= distances[index];
                is_worst && distances[index] > limits[0] && standing_out[index] > limits[1]
            };
            let mut counts = vec![true; points];
            for index in (0..points).filter(is_off) {
                counts[index] = false;
            }
            let left = counts.iter().filter(|counts| **counts).count();
            if counts == self.counts || left < least {
                break;
            }
            self.counts = counts;
        }
        self.shares = self.shares_of_chords(f64::INFINITY);
        Ok(())
    }

    /// The shares of the chord lengths of the points that count, where no chord counts for more than so many
    /// times those about it.
    fn shares_of_chords(&self, cap: f64) -> Vec<f64> {
        let counting = self.points.iter().zip(&self.counts);
        let counting = counting.filter_map(|(point, counts)| counts.then_some(*point));
        let counting: Vec<DVec3> = counting.collect();
        let legs = counting.windows(2).map(|leg| leg[0].distance(leg[1]));
        let legs: Vec<f64> = legs.collect();
        let about = |index: usize| {
            let last = (index + NEIGHBOURS + 1).min(legs.len());
            median(legs[index.saturating_sub(NEIGHBOURS)..last].iter().copied())
        };
        let capped = |(index, leg): (usize, &f64)| match cap * about(index) {
            most if most > 0.0 => leg.min(most),
            _ => *leg,
        };
        let mut lengths = legs.iter().enumerate().map(capped);
        let mut length = 0.0;
        let mut first = true;
        let lengths = self.counts.iter().map(|counts| {
            if *counts && !std::mem::take(&mut first) {
                length += lengths.next().unwrap_or_default();
            }
            length
        });
        let lengths: Vec<f64> = lengths.collect();
        lengths.into_iter().map(|it| it / length).collect()
    }

    /// How far the offset of each point is from the median of those of its neighbours that count.
    fn standing_out(&self, offsets: &[DVec3]) -> Vec<f64> {
        let stands_out = |index: usize| {
            let near: Vec<DVec3> = self.neighbours(index).map(|it| offsets[it]).collect();
            let middle = [0, 1, 2].map(|axis| median(near.iter().map(|offset| offset[axis])));
            offsets[index].distance(DVec3::from_array(middle))
        };
        (0..offsets.len()).map(stands_out).collect()
    }

    /// The points next to one, on either side, that count.
    fn neighbours(&self, index: usize) -> impl Iterator<Item = usize> {
        let last = self.points.len() - 1;
        let near = index.saturating_sub(NEIGHBOURS)..=(index + NEIGHBOURS).min(last);
        near.filter(move |other| *other != index && self.counts[*other])
    }

    /// The standard deviation of normal errors, by the median of those that count.
    fn deviation(&self, lengths: &[f64]) -> f64 {
        let kept = lengths.iter().zip(&self.counts);
        let kept = kept.filter_map(|(length, counts)| counts.then_some(*length));
        BY_MEDIAN * median(kept)
    }

    /// The number of vertices asked for, or else the best.
    fn count(&self, tolerance: Option<f64>) -> Result<usize, FitError> {
        match self.asked.count {
            Some(count) => Ok(count),
            None => self.best_count(tolerance),
        }
    }

    /// Find the number of vertices with the best criterion, or the least that keeps the tolerance.
    fn best_count(&self, tolerance: Option<f64>) -> Result<usize, FitError> {
        let (most, axes) = (self.points.len(), if self.planar { 1.0 } else { 2.0 });
        let kept = self.counts.iter().filter(|counts| **counts).count();
        let mut count = self.asked.degree + 1;
        let mut best = (f64::INFINITY, count);
        loop {
            let [rms, largest] = self.solved(count, LEAST, None)?.errors;
            if tolerance.is_some_and(|tolerance| largest <= tolerance) {
                return Ok(count);
            }
            // Each point tells its distance across the curve, in as many directions as there are.
            let told = axes * kept as f64;
            let variance = rms.max(ROUNDING * self.size).powi(2);
            let criterion = told * variance.ln() + axes * count as f64 * told.ln();
            if criterion < best.0 {
                best = (criterion, count);
            }
            // A good way beyond the best nothing better comes.
            if count >= most || (count > 2 * best.1 + 8 && tolerance.is_none()) {
                return Ok(best.1);
            }
            count = (count + count.div_ceil(6)).min(most);
        }
    }

    /// The fit with so many extrema that is nearest to the points: with the number of vertices given, or with
    /// the best number or shares of it: fewer vertices make fewer extrema, and more leave more room for harmony.
    fn best_with_extrema(&self, extrema: usize) -> Result<Fitted, FitError> {
        let count = self.count(None)?;
        let shares: &[f64] = if self.asked.count.is_some() {
            &[1.0]
        } else {
            &SHARES
        };
        let kept = self.counts.iter().filter(|counts| **counts).count() as f64;
        // Each vertex takes a share of the noise out of the errors.
        let left = (1.0 - count as f64 / kept).max(0.0).sqrt();
        let least = self.solved(count, LEAST, None)?.errors[0];
        let enough = HARDLY * least / left + ROUNDING * self.size;
        let mut best: Option<Fitted> = None;
        for share in shares {
            let count = (share * count as f64).round() as usize;
            let least = vertices_for(extrema, self.asked.degree);
            let count = count.clamp(least, self.points.len());
            let fitted = self.with_extrema(count, extrema, enough)?;
            keep_better(&mut best, fitted);
            if best
                .as_ref()
                .is_some_and(|best| best.reached && best.rms <= enough)
            {
                break;
            }
        }
        let (found, needed) = (self.points.len(), self.asked.degree + 1);
        best.ok_or(FitError::TooFewPoints { found, needed })
    }

    /// The least fairness weight with so many proved extrema, or where that is not near enough, the same from
    /// harmonised curves: of those that have just so many, the nearest to the points.
    fn with_extrema(&self, count: usize, extrema: usize, enough: f64) -> Result<Fitted, FitError> {
        let mut best = None;
        if let Some(fairest) = self.least_fairness(count, extrema, None)? {
            keep_better(&mut best, self.finished(fairest)?);
        }
        let near = |best: &Option<Fitted>| {
            let best = best.as_ref();
            best.is_some_and(|best| best.reached && best.rms <= enough)
        };
        for from in self.near_points(count)? {
            if near(&best) {
                break;
            }
            let harmonised = self.harmonised(from, extrema)?;
            let mut shape = harmonised.polygon.clone();
            let right = self.extrema(&shape)? == extrema;
            keep_better(&mut best, self.finished(harmonised)?);
            let mut rms = f64::INFINITY;
            for _ in 0..if right { NEARER } else { 0 } {
                let Some(nearer) = self.least_fairness(count, extrema, Some(&shape))? else {
                    break;
                };
                if near(&best) || nearer.errors[0] * GAIN > rms {
                    break;
                }
                rms = nearer.errors[0];
                // A little nearer to the points there are too many extrema, which harmonising takes away.
                let too_near = self.solved(count, nearer.fairness / FACTOR, Some(&shape))?;
                let harmonised = self.harmonised(too_near, extrema)?;
                let is_right = self.extrema(&harmonised.polygon)? == extrema;
                let is_nearer = is_right && harmonised.errors[0] < rms;
                let next = if is_nearer { &harmonised } else { &nearer };
                shape = next.polygon.clone();
                keep_better(&mut best, self.finished(next.clone())?);
            }
        }
        match best {
            Some(best) => Ok(best),
            None => self.finished(self.solved(count, LEAST, None)?),
        }
    }

    /// Solve for the least fairness weight with so many proved extrema, if there is one.
    fn least_fairness(
        &self,
        count: usize,
        extrema: usize,
        shape: Option<&FloatPolygon>,
    ) -> Result<Option<Solved>, FitError> {
        let mut fairness = LEAST;
        let mut low = None;
        let mut found = None;
        while fairness <= MOST && found.is_none() {
            let solved = self.solved(count, fairness, shape)?;
            match self.extrema(&solved.polygon)?.cmp(&extrema) {
                Ordering::Equal => found = Some(solved),
                // What is ever fairer has ever fewer, but the shape given has the right number.
                Ordering::Less if shape.is_none() => break,
                _ => low = Some(fairness),
            }
            fairness *= FACTOR;
        }
        let (Some(mut equal), Some(mut low)) = (found.clone(), low) else {
            return Ok(found);
        };
        for _ in 0..BISECTIONS {
            let middle = (low * equal.fairness).sqrt();
            let solved = self.solved(count, middle, shape)?;
            if self.extrema(&solved.polygon)? == extrema {
                equal = solved;
            } else {
                low = middle;
            }
        }
        Ok(Some(equal))
    }

    /// Solve for the least fairness weight, and for larger ones while the errors hardly grow.
    fn near_points(&self, count: usize) -> Result<Vec<Solved>, FitError> {
        let least = self.solved(count, LEAST, None)?;
        let most = HARDLY * least.errors[0] + ROUNDING * self.size;
        let mut found = vec![least];
        let mut fairness = LEAST;
        while fairness < MOST {
            fairness *= FACTOR;
            let solved = self.solved(count, fairness, None)?;
            if solved.errors[0] > most {
                break;
            }
            found.push(solved);
        }
        // The fairest need the least harmonising.
        found.reverse();
        Ok(found)
    }

    /// Move vertices as little as possible so that just so many extrema are left, if that can be.
    fn harmonised(&self, from: Solved, extrema: usize) -> Result<Solved, FitError> {
        let harmony = Harmony {
            stretch: None,
            ends: [Held::Free; 2],
            locked: &[],
            extrema: Some(extrema),
            inflections: None,
            torsion_extrema: None,
            largest_deviation: None,
        };
        let polygon = match harmonise(&from.polygon, &harmony, self.progress) {
            Err(HarmonyError::Cancelled) => return Err(FitError::Cancelled),
            harmonised => harmonised?.polygon,
        };
        let nearest = self
            .points
            .iter()
            .map(|point| polygon.nearest(*point).point);
        let offsets = self.points.iter().zip(nearest);
        let offsets = offsets.map(|(point, nearest)| nearest - *point).collect();
        Ok(self.measured(polygon, from.fairness, offsets))
    }

    /// The largest fairness weight that keeps the tolerance.
    fn fairest(&self, count: usize, tolerance: f64) -> Result<Fitted, FitError> {
        let mut best = self.solved(count, LEAST, None)?;
        let mut fairness = LEAST;
        while fairness < MOST {
            fairness *= FACTOR;
            let solved = self.solved(count, fairness, None)?;
            if solved.errors[1] > tolerance {
                break;
            }
            best = solved;
        }
        self.finished(best)
    }

    /// Solve for one fairness weight, refining parameters; what is fair is the difference from a shape, if
    /// one is given. With the least weight it is the difference from the curve before, and where there are as
    /// many vertices as points the weight falls further, so that these are met exactly.
    fn solved(
        &self,
        count: usize,
        fairness: f64,
        shape: Option<&FloatPolygon>,
    ) -> Result<Solved, FitError> {
        let segments = (count - self.asked.degree) as f64;
        let mut places: Vec<f64> = self.shares.iter().map(|share| share * segments).collect();
        let mut before: Option<FloatPolygon> = None;
        let mut round = 0;
        loop {
            if self.progress.is_cancelled() {
                return Err(FitError::Cancelled);
            }
            let shape = shape.or(before.as_ref().filter(|_| fairness == LEAST));
            let exact = fairness == LEAST && count >= self.points.len();
            let falling = if exact { FACTOR.powi(-round) } else { 1.0 };
            let polygon = self.least_squares(count, fairness * falling, &places, shape)?;
            self.refine(&polygon, &mut places);
            round += 1;
            if round > ROUNDS {
                let offsets = self.points.iter().zip(&places);
                let offsets = offsets.map(|(point, u)| polygon.point(*u) - *point);
                let offsets = offsets.collect();
                return Ok(self.measured(polygon, fairness, offsets));
            }
            before = Some(polygon);
        }
    }

    fn measured(&self, polygon: FloatPolygon, fairness: f64, offsets: Vec<DVec3>) -> Solved {
        let kept = offsets.iter().zip(&self.counts);
        let kept = kept.filter_map(|(offset, counts)| counts.then_some(offset.length()));
        let (mut sum, mut largest, mut count) = (0.0, 0.0_f64, 0);
        for distance in kept {
            sum += distance * distance;
            largest = largest.max(distance);
            count += 1;
        }
        Solved {
            polygon,
            fairness,
            offsets,
            errors: [(sum / count.max(1) as f64).sqrt(), largest],
        }
    }

    fn least_squares(
        &self,
        count: usize,
        fairness: f64,
        places: &[f64],
        shape: Option<&FloatPolygon>,
    ) -> Result<FloatPolygon, FitError> {
        let degree = self.asked.degree;
        let last = count - degree - 1;
        let mut rows: Vec<(BandedRow, DVec3)> = Vec::new();
        let counting = places.iter().zip(self.points).zip(&self.counts);
        for ((u, point), _) in counting.filter(|(_, counts)| **counts) {
            let first = (u.floor() as usize).min(last);
            let basis: Vec<f64> = uniform_basis_derivative(degree, 0, u - first as f64);
            let known = shape.map_or(DVec3::ZERO, |shape| shape.point(*u));
            rows.push((row(first, basis), *point - known));
        }
        let order = ORDER.min(count - 1);
        let share = (fairness * self.points.len() as f64 / count as f64).sqrt();
        let stencil = difference_stencil(order);
        for first in 0..count - order {
            let entries = stencil.iter().map(|entry| entry * share).collect();
            rows.push((row(first, entries), DVec3::ZERO));
        }
        let mut vertices =
            shape.map_or(vec![DVec3::ZERO; count], |shape| shape.vertices().to_vec());
        for axis in 0..if self.planar { 2 } else { 3 } {
            let rows = rows.iter().map(|(row, right)| BandedRow {
                right: right[axis],
                ..row.clone()
            });
            let factors = BandedQr::new(rows.collect(), count);
            let (found, needed) = (self.points.len(), degree + 1);
            let factors = factors.ok_or(FitError::TooFewPoints { found, needed })?;
            for (vertex, value) in vertices.iter_mut().zip(factors.solution()) {
                vertex[axis] += value;
            }
        }
        Ok(FloatPolygon::new(degree, vertices, None, false)?)
    }

    /// Move parameters to those of the nearest points; the first and the last stay at the ends.
    fn refine(&self, polygon: &FloatPolygon, places: &mut [f64]) {
        let end = polygon.segments() as f64;
        let inner = 1..places.len().saturating_sub(1);
        for index in inner {
            let start = places[index];
            let bracket = [(start - 1.0).max(0.0), (start + 1.0).min(end)];
            let jet = |u: f64| polygon.jet(u);
            places[index] = refined_parameter(self.points[index], start, bracket, jet);
        }
    }

    fn extrema(&self, polygon: &FloatPolygon) -> Result<usize, FitError> {
        let features = Features::proved(polygon, |_| !self.progress.is_cancelled());
        let features = features.ok_or(FitError::Cancelled)?;
        Ok(features
            .curvature_extrema
            .iter()
            .map(|it| it.count)
            .sum::<usize>()
            + features.undecided.len())
    }

    fn finished(&self, solved: Solved) -> Result<Fitted, FitError> {
        let extrema = self.extrema(&solved.polygon)?;
        let [rms, largest] = solved.errors;
        let right = self.asked.extrema.is_none_or(|asked| asked == extrema);
        let near = self
            .asked
            .tolerance
            .is_none_or(|tolerance| largest <= tolerance);
        let outliers = self.counts.iter().enumerate();
        let outliers = outliers.filter(|(_, counts)| !**counts);
        Ok(Fitted {
            reached: right && near,
            extrema,
            rms,
            largest,
            polygon: solved.polygon,
            outliers: outliers.map(|(index, _)| index).collect(),
            fairness: solved.fairness,
        })
    }
}

/// The least number of vertices whose discrete curvature, a number at each inner vertex, can have so many
/// extrema.
fn vertices_for(extrema: usize, degree: usize) -> usize {
    let outer = if extrema > 0 { 4 } else { 0 };
    (extrema + outer).max(degree + 1)
}

/// Whether one fit is better than another: it reaches what was asked for, or is nearer to the points.
fn counts_for_more(fitted: &Fitted, known: &Fitted) -> bool {
    match (fitted.reached, known.reached) {
        (true, false) => true,
        (false, true) => false,
        _ => fitted.rms < known.rms,
    }
}

/// Keep the better of two fits.
fn keep_better(best: &mut Option<Fitted>, fitted: Fitted) {
    if best
        .as_ref()
        .is_none_or(|best| counts_for_more(&fitted, best))
    {
        *best = Some(fitted);
    }
}

/// The median, of none 0.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}

fn row(first: usize, entries: Vec<f64>) -> BandedRow {
    BandedRow {
        first,
        entries,
        right: 0.0,
    }
}
