//! Fits of float polygons to points in space.

use std::cmp::{Ordering, Reverse};

use glam::DVec3;

use super::point_list::PointList;
use super::smoothing::{Smoothed, Smoothing};
use super::vertex_count::{ROUNDING, best_count};
use crate::geometry::control_polygon::check_size;
use crate::geometry::fairing::near_points::{NearPoints, Points};
use crate::geometry::fairing::point_fit::{extrema_of, nearest_with_extrema};
use crate::geometry::features::{Feature, Features};
use crate::geometry::fitting::{CountedPoints, FitError};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// Errors that grow by less than this factor hardly grow.
const HARDLY: f64 = 1.05;

/// Of the points at least this share tells the noise, however many vertices there are.
const TELLING: f64 = 0.1;

/// Distances are measured in no less than this share of the points' size.
const LEAST_NOISE: f64 = 1e-7;

/// The factor between the first numbers of vertices that are tried for extrema; it grows by itself each time.
const MORE: f64 = 1.25;

/// The points that each vertex stands for at least.
const POINTS_A_VERTEX: usize = 2;

/// The points of a curve, by segments or vertices, by which it gets another number of vertices.
const SAMPLES: usize = 4;

/// Request for a fit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FitRequest {
    /// The degree.
    pub degree: usize,
    /// The number of vertices; `None` for as many as the points or the tolerance call for.
    pub count: Option<usize>,
    /// The most vertices; `None` for half the number of points.
    pub most: Option<usize>,
    /// The number of curvature extrema; `None` for any.
    pub extrema: Option<usize>,
    /// The number of zeros of the torsion; `None` for any.
    pub torsion_zeros: Option<usize>,
    /// Tolerance of points, outliers aside.
    pub tolerance: Option<f64>,
    /// The points that do not count, from 0; `None` for those that stand out.
    pub outliers: Option<Vec<usize>>,
    /// How much each point counts; `None` if all count the same. Those of weight 0 do not count.
    pub weights: Option<Vec<f64>>,
}

/// A fit with its figures.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The float polygon.
    pub polygon: FloatPolygon,
    /// Whether the request is met: extrema, proved, and the tolerance.
    pub reached: bool,
    /// The number of curvature extrema, proved.
    pub extrema: usize,
    /// The number of zeros of the torsion, proved.
    pub torsion_zeros: usize,
    /// The root of the mean squared distance of the points that count, weighed.
    pub rms: f64,
    /// The same of the nearest fit found with as many vertices and any number of extrema.
    pub rms_of_any: f64,
    /// The largest distance of the points that count.
    pub deviation: f64,
    /// The largest distance of all points.
    pub largest: f64,
    /// The points that do not count, from 0, with their distances.
    pub outliers: Vec<(usize, f64)>,
    /// The points that repeat the one before, from 0.
    pub repeated: Vec<usize>,
    /// The estimated standard deviation of the points' noise.
    pub noise: f64,
    /// Whether the time was up before the search had ended.
    pub stopped: bool,
    /// The fairness weight, by points a vertex.
    pub fairness: f64,
}

/// Fit a curve to points that follow each other along it.
///
/// Minimises Σ |C(uᵢ) − pᵢ|² + λ Σ |Δ³P|² over the points that count, with light ones between them, so that the curve
/// does not bulge where points are sparse. The parameters begin as chord lengths and become those of the nearest
/// points. Without a number of vertices the one is taken that explains the points best for its size (Bayes'
/// information criterion), or, where no extrema are asked for, the smallest that keeps the tolerance. Extrema asked for
/// are conditions on the sign of the curvature's slope: λ is the largest that leaves the errors as they are, and
/// the curve is the nearest found whose curvature rises and falls so often, proved; without a number of
/// vertices more are tried until its errors are about those of the noise. Where the time of `progress` is up, the best
/// so far counts.
///
/// # Errors
/// [`FitError`].
pub fn fit_points(
    points: &[DVec3],
    asked: &FitRequest,
    progress: &Progress,
) -> Result<Fitted, FitError> {
    let outliers = asked.outliers.as_deref();
    let counted = CountedPoints::new(points, false, outliers, asked.weights.as_deref());
    check(&counted, asked)?;
    progress.set_done(0.1);
    let list = PointList::new(&counted.points, &counted.weights);
    // There must be a curve, however short the time.
    let patient = progress.without_limit();
    let fit = Fit {
        asked,
        progress,
        smoothing: Smoothing::new(&list, asked.degree, &patient),
        most: most_vertices(asked, list.counting()),
        list: &list,
    };
    let found = match (asked.extrema, asked.tolerance) {
        (Some(extrema), _) => fit.best_with_extrema(extrema),
        (None, Some(tolerance)) => fit.fairest(tolerance),
        (None, None) => fit.plain_of(fit.count(None)?),
    }?;
    let polygon = &found.polygon;
    let distance = |index: &usize| Some(polygon.nearest(*points.get(*index)?).distance);
    let distances = counted.outliers.iter();
    let distances = distances.filter_map(|index| Some((*index, distance(index)?)));
    let outliers: Vec<(usize, f64)> = distances.collect();
    let farthest = outliers.iter().map(|(_, off)| *off).fold(0.0, f64::max);
    Ok(Fitted {
        largest: found.deviation.max(farthest),
        outliers,
        repeated: counted.repeated,
        noise: counted.noise,
        stopped: progress.is_late(),
        ..found
    })
}

/// The most vertices for so many points.
fn most_vertices(asked: &FitRequest, points: usize) -> usize {
    let half = points / POINTS_A_VERTEX;
    asked.most.unwrap_or(half).clamp(asked.degree + 1, points)
}

/// Check that there can be such a fit.
fn check(counted: &CountedPoints, asked: &FitRequest) -> Result<(), FitError> {
    let degree = asked.degree;
    check_size(degree, asked.count.unwrap_or(degree + 1), false)?;
    let found = counted.points.len();
    if found < degree + 1 {
        return Err(FitError::TooFewPoints { found, degree });
    }
    if let Some(count) = asked.count.filter(|count| *count > found) {
        let points = found;
        return Err(FitError::TooManyVertices { count, points });
    }
    let Some(extrema) = asked.extrema else {
        return Ok(());
    };
    let needed = vertices_for(extrema, degree);
    let limits = [
        (asked.count.unwrap_or(needed), "vertices"),
        (found, "points"),
    ];
    match limits.into_iter().find(|(count, _)| *count < needed) {
        None => Ok(()),
        Some((count, of)) => Err(FitError::TooManyExtrema {
            extrema,
            count,
            of,
            needed,
        }),
    }
}

/// The least number of vertices whose discrete curvature, a number at each inner vertex, can have so many
/// extrema.
fn vertices_for(extrema: usize, degree: usize) -> usize {
    let outer = if extrema > 0 { 4 } else { 0 };
    (extrema + outer).max(degree + 1)
}

struct Fit<'a> {
    list: &'a PointList,
    asked: &'a FitRequest,
    progress: &'a Progress,
    smoothing: Smoothing<'a>,
    /// The most vertices.
    most: usize,
}

impl Fit<'_> {
    /// The requested number of vertices, or else the best.
    fn count(&self, tolerance: Option<f64>) -> Result<usize, FitError> {
        let best = || best_count(&self.smoothing, self.most, tolerance);
        self.asked.count.map_or_else(best, Ok)
    }

    /// The curve with the largest fairness weight that keeps the tolerance.
    fn fairest(&self, tolerance: f64) -> Result<Fitted, FitError> {
        let count = self.count(Some(tolerance))?;
        let keeps = |smoothed: &Smoothed| smoothed.errors[1] <= tolerance;
        let mut found = self.smoothing.while_passing(count, keeps)?;
        let fairest = match found.pop() {
            Some(fairest) => self.plain(fairest)?,
            None => self.plain(self.smoothing.least(count)?)?,
        };
        match fairest.reached {
            true => Ok(fairest),
            false => Ok(fairest.or(self.plain_of(count)?, self.asked)),
        }
    }

    /// The nearest curve with so many vertices; with zeros of the torsion asked for, the nearest one with these among
    /// ever fairer ones.
    fn plain_of(&self, count: usize) -> Result<Fitted, FitError> {
        let nearest = self.plain(self.smoothing.least(count)?)?;
        if self.asked.torsion_zeros.is_none() || nearest.reached {
            return Ok(nearest);
        }
        let mut best = nearest;
        for fairer in self.smoothing.while_passing(count, |_| true)? {
            best = best.or(self.plain(fairer)?, self.asked);
            if best.reached || self.progress.is_late() {
                break;
            }
        }
        Ok(best)
    }

    /// The fit with so many extrema that is nearest to the points, with the number of vertices given or the
    /// least from the best on with which it is about as near as noise allows.
    fn best_with_extrema(&self, extrema: usize) -> Result<Fitted, FitError> {
        let least = vertices_for(extrema, self.asked.degree);
        let natural = best_count(&self.smoothing, self.most, None)?.max(least);
        match self.asked.count {
            Some(count) => self.best_of_count(count, natural, extrema),
            None => self.best_of_many(natural, extrema),
        }
    }

    /// The nearest with so many vertices; where that is not near, also from the one with the natural number.
    fn best_of_count(
        &self,
        count: usize,
        natural: usize,
        extrema: usize,
    ) -> Result<Fitted, FitError> {
        let enough = self.enough(&self.smoothing.least(count)?);
        let found = self.with_extrema(count, extrema, enough, None)?;
        if count == natural || found.is_near(enough) {
            return Ok(found);
        }
        self.progress.set_done(0.4);
        let known = self.with_extrema(natural, extrema, enough, None)?;
        self.progress.set_done(0.7);
        if known.extrema != extrema {
            return Ok(found);
        }
        let again = self.with_extrema(count, extrema, enough, Some(&known.polygon))?;
        Ok(found.or(again, self.asked))
    }

    /// The nearest with ever more vertices until it is near.
    fn best_of_many(&self, natural: usize, extrema: usize) -> Result<Fitted, FitError> {
        let most = self.most.max(natural);
        let enough = self.enough(&self.smoothing.least(natural)?);
        let mut best = self.with_extrema(natural, extrema, enough, None)?;
        let (mut count, mut more) = (natural, MORE);
        while count < most && !best.is_near(enough) && !self.progress.is_late() {
            let done = (count as f64 / natural as f64).ln() / (most as f64 / natural as f64).ln();
            self.progress.set_done(0.1 + 0.9 * done);
            count = ((more * count as f64) as usize).clamp(count + 1, most);
            more *= MORE;
            let known = Some(&best.polygon).filter(|_| best.extrema == extrema);
            let found = self.with_extrema(count, extrema, enough, known)?;
            best = best.or(found, self.asked);
        }
        Ok(best)
    }

    /// Errors that are about those of the noise: each vertex takes a share of it out of the errors.
    fn enough(&self, least: &Smoothed) -> f64 {
        let count = least.near.polygon.vertices().len() as f64;
        let left = 1.0 - count / self.list.counting() as f64;
        HARDLY * least.errors[0] / left.max(TELLING).sqrt() + ROUNDING * self.list.size
    }

    /// The fit with so many vertices and extrema that is nearest to the points: from a known one with another
    /// number of vertices, from the fairest curve that is about as near as noise allows, and from the one
    /// nearest to the points, until one is near enough.
    fn with_extrema(
        &self,
        count: usize,
        extrema: usize,
        enough: f64,
        known: Option<&FloatPolygon>,
    ) -> Result<Fitted, FitError> {
        let least = self.smoothing.least(count)?;
        let noise = self.enough(&least);
        let passes = |smoothed: &Smoothed| smoothed.errors[0] <= noise;
        let fairest = self.smoothing.while_passing(count, passes)?.pop();
        let fairness = fairest.as_ref().map_or(least.fairness, |it| it.fairness);
        let known = known
            .map(|known| self.resampled(known, count))
            .transpose()?;
        let known = known.map(|near| Smoothed::new(self.list, near, fairness));
        let weights = self.list.weights_for(count);
        let rms_of_any = least.errors[0];
        let mut best = self.finished(least.clone(), rms_of_any)?;
        let fairest = fairest.filter(|_| fairness > least.fairness);
        for start in known.into_iter().chain(fairest).chain([least]) {
            let (from, fairness) = (start.near.clone(), start.fairness);
            best = best.or(self.finished(start, rms_of_any)?, self.asked);
            if best.is_near(enough) || self.progress.is_late() {
                break;
            }
            let points = Points {
                points: &self.list.points,
                weights: &weights,
                fairness: self.smoothing.weight(count, fairness),
                noise: noise.max(LEAST_NOISE * self.list.size),
            };
            if let Some(near) = nearest_with_extrema(&points, &from, extrema, self.progress)? {
                let found = Smoothed::new(self.list, near, fairness);
                best = best.or(self.finished(found, rms_of_any)?, self.asked);
            }
            if best.is_near(enough) {
                break;
            }
        }
        Ok(best)
    }

    /// Nearly the same curve with another number of vertices, with parameters in proportion.
    fn resampled(&self, known: &FloatPolygon, count: usize) -> Result<NearPoints, FitError> {
        let end = known.segments() as f64;
        let samples = SAMPLES * known.segments().max(count);
        let shares = (0..=samples).map(|sample| sample as f64 / samples as f64);
        let shares: Vec<f64> = shares.collect();
        let samples: Vec<DVec3> = shares
            .iter()
            .map(|share| known.point(share * end))
            .collect();
        let list = PointList::placed(samples, shares);
        let smoothing = Smoothing::new(&list, self.asked.degree, self.smoothing.progress);
        let polygon = smoothing.least(count)?.near.polygon;
        let places: Vec<f64> = self.list.shares.iter().map(|share| share * end).collect();
        let known = NearPoints::new(known.clone(), &self.list.points, &places);
        let share = polygon.segments() as f64 / end;
        let places: Vec<f64> = known.places.iter().map(|u| share * u).collect();
        Ok(NearPoints::new(polygon, &self.list.points, &places))
    }

    /// Prove and measure a fit on which there are no conditions.
    fn plain(&self, smoothed: Smoothed) -> Result<Fitted, FitError> {
        let rms = smoothed.errors[0];
        self.finished(smoothed, rms)
    }

    /// Prove and measure a fit.
    fn finished(&self, smoothed: Smoothed, rms_of_any: f64) -> Result<Fitted, FitError> {
        let polygon = smoothed.near.polygon;
        let going_on = |_| !self.smoothing.progress.is_cancelled();
        let features = Features::proved(&polygon, going_on).ok_or(FitError::Cancelled)?;
        let (extrema, zeros) = (extrema_of(&features), features.count(Feature::TorsionZero));
        let [rms, deviation] = smoothed.errors;
        let asked = self.asked;
        let right = asked.extrema.is_none_or(|asked| asked == extrema)
            && asked.torsion_zeros.is_none_or(|asked| asked == zeros);
        let near = asked
            .tolerance
            .is_none_or(|tolerance| deviation <= tolerance);
        Ok(Fitted {
            polygon,
            reached: right && near,
            extrema,
            torsion_zeros: zeros,
            rms,
            rms_of_any: rms_of_any.min(rms),
            deviation,
            largest: deviation,
            outliers: Vec::new(),
            repeated: Vec::new(),
            noise: 0.0,
            stopped: false,
            fairness: smoothed.fairness,
        })
    }
}

impl Fitted {
    /// Whether it meets the request and the tolerance.
    fn is_near(&self, enough: f64) -> bool {
        self.reached && self.rms <= enough
    }

    /// The better of two: it reaches what was asked for, or its numbers of features are nearer to those asked
    /// for, or it is nearer to the points.
    fn or(self, other: Self, asked: &FitRequest) -> Self {
        let off =
            |found: usize, asked: Option<usize>| asked.map_or(0, |asked| found.abs_diff(asked));
        let rank = |fitted: &Self| {
            let extrema = off(fitted.extrema, asked.extrema);
            let zeros = off(fitted.torsion_zeros, asked.torsion_zeros);
            (fitted.reached, Reverse(extrema + zeros))
        };
        match rank(&other).cmp(&rank(&self)) {
            Ordering::Greater => other,
            Ordering::Equal if other.rms < self.rms => other,
            _ => self,
        }
    }
}
