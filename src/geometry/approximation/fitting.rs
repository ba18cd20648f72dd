//! Float polygons through the middle of points: least squares with a fairness weight.

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
const ROUNDS: usize = 8;

/// The rounds before which no point counts as an outlier: the curve is not yet near enough.
const TRUSTING_ROUNDS: usize = 2;

/// A point counts the less the farther it is away, and not at all from so many standard deviations on
/// (Tukey's biweight).
const OUTLYING: f64 = 6.0;

/// The standard deviation of normal errors in units of their median.
const BY_MEDIAN: f64 = 1.4826;

/// Errors below this share of the points' size are rounding, and make no outliers.
const ROUNDING: f64 = 1e-12;

/// The fairness weights, by points a vertex: the least only keeps what no point tells within bounds.
const LEAST: f64 = 1e-6;
const MOST: f64 = 1e8;

/// Errors that grow by less than this factor hardly grow.
const HARDLY: f64 = 1.05;

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
        "{found} different points in a row are too few for a curve: at least {needed} are needed"
    )]
    TooFewPoints {
        /// The number of points that differ from the one before.
        found: usize,
        /// The number needed.
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
/// Minimises Σ wᵢ |C(uᵢ) − pᵢ|² + λ Σ |Δ³P|². The parameters begin as chord lengths and become those of the
/// nearest points; weights fall with the distance, so that outliers do not count. Without a number of
/// vertices the one is taken that explains the points best for its size (Bayes' information criterion),
/// or the smallest that keeps the tolerance. Extrema asked for are reached by the least fairness weight λ
/// that has just so many, proved, or by harmonising what has more: the nearest to the points counts.
///
/// # Errors
/// [`FitError`].
pub fn fit_points(
    points: &[DVec3],
    asked: &FitAsked,
    progress: &Progress,
) -> Result<Fitted, FitError> {
    let fit = Fit::new(points, asked, progress)?;
    let count = match asked.count {
        Some(count) => count,
        None => fit.best_count()?,
    };
    progress.set_done(0.3);
    match (asked.extrema, asked.tolerance) {
        (Some(extrema), _) => fit.best_with_extrema(count, extrema),
        (None, Some(tolerance)) => fit.fairest(count, tolerance),
        (None, None) => fit.finished(fit.solved(count, LEAST)?),
    }
}

struct Fit<'a> {
    points: &'a [DVec3],
    asked: &'a FitAsked,
    progress: &'a Progress,
    planar: bool,
    size: f64,
    /// The share of the chord length up to each point.
    shares: Vec<f64>,
}

/// A solution for one fairness weight.
#[derive(Clone)]
struct Solved {
    polygon: FloatPolygon,
    fairness: f64,
    distances: Vec<f64>,
    outliers: Vec<usize>,
}

impl<'a> Fit<'a> {
    fn new(
        points: &'a [DVec3],
        asked: &'a FitAsked,
        progress: &'a Progress,
    ) -> Result<Self, FitError> {
        check_size(asked.degree, asked.count.unwrap_or(asked.degree + 1), false)?;
        let mut lengths = vec![0.0];
        for leg in points.windows(2) {
            let length = lengths.last().copied().unwrap_or_default();
            lengths.push(length + leg[0].distance(leg[1]));
        }
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
        let whole = lengths.last().copied().unwrap_or_default();
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
            shares: lengths.into_iter().map(|length| length / whole).collect(),
        })
    }

    /// Find the number of vertices with the best criterion, or the least that keeps the tolerance.
    fn best_count(&self) -> Result<usize, FitError> {
        let (most, axes) = (self.points.len(), if self.planar { 1.0 } else { 2.0 });
        let mut count = self.asked.degree + 1;
        let mut best = (f64::INFINITY, count);
        loop {
            let solved = self.solved(count, LEAST)?;
            let kept = self.points.len() - solved.outliers.len();
            let (rms, largest) = solved.errors();
            if self
                .asked
                .tolerance
                .is_some_and(|tolerance| largest <= tolerance)
            {
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
            if count >= most || (count > 2 * best.1 + 8 && self.asked.tolerance.is_none()) {
                return Ok(best.1);
            }
            count = (count + count.div_ceil(6)).min(most);
        }
    }

    /// The fit with so many extrema that is nearest to the points: with the number of vertices given, or with
    /// the best number or multiples of it, as more vertices leave more room for harmony.
    fn best_with_extrema(&self, count: usize, extrema: usize) -> Result<Fitted, FitError> {
        let multiples = if self.asked.count.is_some() {
            1..=1
        } else {
            1..=3
        };
        let mut best: Option<Fitted> = None;
        for multiple in multiples {
            let count = (multiple * count).min(self.points.len());
            let fitted = self.with_extrema(count, extrema)?;
            if best
                .as_ref()
                .is_none_or(|best| counts_for_more(&fitted, best))
            {
                best = Some(fitted);
            }
        }
        let (found, needed) = (self.points.len(), self.asked.degree + 1);
        best.ok_or(FitError::TooFewPoints { found, needed })
    }

    /// The least fairness weight with so many proved extrema, or what harmonising makes of smaller ones: of
    /// those that have just so many, the nearest to the points.
    fn with_extrema(&self, count: usize, extrema: usize) -> Result<Fitted, FitError> {
        let mut fairness = LEAST;
        let mut more: Option<Solved> = None;
        let mut found = None;
        while fairness <= MOST && found.is_none() {
            let solved = self.solved(count, fairness)?;
            match self.extrema(&solved.polygon)?.cmp(&extrema) {
                std::cmp::Ordering::Greater => more = Some(solved),
                std::cmp::Ordering::Equal => found = Some(solved),
                std::cmp::Ordering::Less => break,
            }
            fairness *= FACTOR;
        }
        self.progress.set_done(0.5);
        let mut best: Option<Fitted> = None;
        if let Some(mut equal) = found {
            let mut low = more.map_or(equal.fairness, |more| more.fairness);
            for _ in 0..BISECTIONS {
                let middle = (low * equal.fairness).sqrt();
                let solved = self.solved(count, middle)?;
                if self.extrema(&solved.polygon)? == extrema {
                    equal = solved;
                } else {
                    low = middle;
                }
            }
            best = Some(self.finished(equal)?);
        }
        self.progress.set_done(0.7);
        for from in self.near_points(count)? {
            let harmonised = self.finished(self.harmonised(from, extrema)?)?;
            if best
                .as_ref()
                .is_none_or(|best| counts_for_more(&harmonised, best))
            {
                best = Some(harmonised);
            }
        }
        match best {
            Some(best) => Ok(best),
            None => self.finished(self.solved(count, LEAST)?),
        }
    }

    /// Solve for the least fairness weight, and for larger ones while the errors hardly grow.
    fn near_points(&self, count: usize) -> Result<Vec<Solved>, FitError> {
        let least = self.solved(count, LEAST)?;
        let most = HARDLY * least.errors().0 + ROUNDING * self.size;
        let mut found = vec![least];
        let mut fairness = LEAST;
        while fairness < MOST {
            fairness *= FACTOR;
            let solved = self.solved(count, fairness)?;
            if solved.errors().0 > most {
                break;
            }
            found.push(solved);
        }
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
        let distances = self.distances(&polygon);
        Ok(Solved {
            polygon,
            distances,
            ..from
        })
    }

    /// The largest fairness weight that keeps the tolerance.
    fn fairest(&self, count: usize, tolerance: f64) -> Result<Fitted, FitError> {
        let mut best = self.solved(count, LEAST)?;
        let mut fairness = LEAST;
        while fairness < MOST {
            fairness *= FACTOR;
            let solved = self.solved(count, fairness)?;
            if solved.errors().1 > tolerance {
                break;
            }
            best = solved;
        }
        self.finished(best)
    }

    /// Solve for one fairness weight, refining parameters and weights in turn.
    fn solved(&self, count: usize, fairness: f64) -> Result<Solved, FitError> {
        if self.progress.is_cancelled() {
            return Err(FitError::Cancelled);
        }
        let segments = (count - self.asked.degree) as f64;
        let mut places: Vec<f64> = self.shares.iter().map(|share| share * segments).collect();
        let mut weights = vec![1.0; self.points.len()];
        let mut round = 0;
        loop {
            let polygon = self.least_squares(count, fairness, &places, &weights)?;
            self.refine(&polygon, &mut places);
            let distances: Vec<f64> = self
                .points
                .iter()
                .zip(&places)
                .map(|(point, u)| polygon.point(*u).distance(*point))
                .collect();
            round += 1;
            if round > TRUSTING_ROUNDS {
                weights = self.weights(&distances);
            }
            if round > ROUNDS {
                let numbered = weights.iter().enumerate();
                let outliers = numbered.filter(|(_, weight)| **weight == 0.0);
                return Ok(Solved {
                    polygon,
                    fairness,
                    distances,
                    outliers: outliers.map(|(index, _)| index).collect(),
                });
            }
        }
    }

    fn least_squares(
        &self,
        count: usize,
        fairness: f64,
        places: &[f64],
        weights: &[f64],
    ) -> Result<FloatPolygon, FitError> {
        let degree = self.asked.degree;
        let last = count - degree - 1;
        let mut rows: Vec<(BandedRow, DVec3)> = Vec::new();
        for ((u, weight), point) in places.iter().zip(weights).zip(self.points) {
            let first = (u.floor() as usize).min(last);
            let basis: Vec<f64> = uniform_basis_derivative(degree, 0, u - first as f64);
            let root = weight.sqrt();
            let entries = basis.into_iter().map(|value| value * root).collect();
            rows.push((row(first, entries), *point * root));
        }
        let order = ORDER.min(count - 1);
        let share = (fairness * self.points.len() as f64 / count as f64).sqrt();
        let stencil = difference_stencil(order);
        for first in 0..count - order {
            let entries = stencil.iter().map(|entry| entry * share).collect();
            rows.push((row(first, entries), DVec3::ZERO));
        }
        let mut vertices = vec![DVec3::ZERO; count];
        for axis in 0..if self.planar { 2 } else { 3 } {
            let rows = rows.iter().map(|(row, right)| BandedRow {
                right: right[axis],
                ..row.clone()
            });
            let factors = BandedQr::new(rows.collect(), count);
            let (found, needed) = (self.points.len(), degree + 1);
            let factors = factors.ok_or(FitError::TooFewPoints { found, needed })?;
            for (vertex, value) in vertices.iter_mut().zip(factors.solution()) {
                vertex[axis] = value;
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

    fn weights(&self, distances: &[f64]) -> Vec<f64> {
        let mut sorted = distances.to_vec();
        sorted.sort_by(f64::total_cmp);
        let median = sorted.get(sorted.len() / 2).copied().unwrap_or_default();
        let most = OUTLYING * (BY_MEDIAN * median).max(ROUNDING * self.size);
        // What the tolerance allows is no outlier.
        let most = most.max(2.0 * self.asked.tolerance.unwrap_or(0.0));
        let weight = |distance: &f64| {
            let share = distance / most;
            (1.0 - share * share).max(0.0).powi(2)
        };
        distances.iter().map(weight).collect()
    }

    /// The distances of the points from another curve near by.
    fn distances(&self, polygon: &FloatPolygon) -> Vec<f64> {
        let distance = |point: &DVec3| polygon.nearest(*point).distance;
        self.points.iter().map(distance).collect()
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
        let (rms, largest) = solved.errors();
        let right = self.asked.extrema.is_none_or(|asked| asked == extrema);
        let near = self
            .asked
            .tolerance
            .is_none_or(|tolerance| largest <= tolerance);
        Ok(Fitted {
            reached: right && near,
            extrema,
            rms,
            largest,
            polygon: solved.polygon,
            outliers: solved.outliers,
            fairness: solved.fairness,
        })
    }
}

impl Solved {
    /// The root of the mean square and the largest of the distances, outliers aside.
    fn errors(&self) -> (f64, f64) {
        let counts = |index: &usize| self.outliers.binary_search(index).is_err();
        let kept = (0..self.distances.len())
            .filter(counts)
            .map(|index| self.distances[index]);
        let (mut sum, mut largest, mut count) = (0.0, 0.0_f64, 0);
        for distance in kept {
            sum += distance * distance;
            largest = largest.max(distance);
            count += 1;
        }
        ((sum / count.max(1) as f64).sqrt(), largest)
    }
}

/// Whether one fit is better than another: it reaches what was asked for, or is nearer to the points.
fn counts_for_more(fitted: &Fitted, known: &Fitted) -> bool {
    match (fitted.reached, known.reached) {
        (true, false) => true,
        (false, true) => false,
        _ => fitted.rms < known.rms,
    }
}

fn row(first: usize, entries: Vec<f64>) -> BandedRow {
    BandedRow {
        first,
        entries,
        right: 0.0,
    }
}
