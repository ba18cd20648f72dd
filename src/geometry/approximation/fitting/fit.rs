//! Fits of float polygons to points.

use std::cmp::{Ordering, Reverse};

use glam::DVec3;

use super::outliers::leave_out_outliers;
use super::point_list::PointList;
use super::smoothing::{Smoothed, Smoothing};
use super::vertex_count::{ROUNDING, best_count};
use crate::geometry::control_polygon::check_size;
use crate::geometry::fairing::near_points::{NearPoints, Points};
use crate::geometry::fairing::point_fit::{extrema_of, nearest_with_extrema};
use crate::geometry::features::Features;
use crate::geometry::fitting::FitError;
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

/// The points of a curve, by segments or vertices, by which it gets another number of vertices.
const SAMPLES: usize = 4;

/// Request for a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitRequest {
    /// The degree.
    pub degree: usize,
    /// The number of vertices; `None` for as many as the points or the tolerance call for.
    pub count: Option<usize>,
    /// The number of curvature extrema; `None` for any.
    pub extrema: Option<usize>,
    /// Tolerance of points, outliers aside.
    pub tolerance: Option<f64>,
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
    /// The root of the mean squared distance of the points, outliers aside.
    pub rms: f64,
    /// The same of the nearest fit found with as many vertices and any number of extrema.
    pub rms_of_any: f64,
    /// The largest distance, outliers aside.
    pub largest: f64,
    /// The numbers of the points that do not count, from 0.
    pub outliers: Vec<usize>,
    /// The fairness weight, by points a vertex.
    pub fairness: f64,
}

/// Fit a curve to points that follow each other along it.
///
/// Minimises Σ |C(uᵢ) − pᵢ|² + λ Σ |Δ³P|² over all points but the outliers. The parameters begin as chord
/// lengths and become those of the nearest points. Outliers are found once, against a curve with a vertex
/// for every few points: they are far from it, and stand out from their neighbours. Without a number of
/// vertices the one is taken that explains the points best for its size (Bayes' information criterion),
/// or, where no extrema are asked for, the smallest that keeps the tolerance. Extrema asked for are
/// conditions on the sign of the curvature's slope: λ is the largest that leaves the errors as they are, and
/// the curve is the nearest found whose curvature rises and falls so often, proved; without a number of
/// vertices more are tried until its errors are about those of the noise.
///
/// # Errors
/// [`FitError`].
pub fn fit_points(
    points: &[DVec3],
    asked: &FitRequest,
    progress: &Progress,
) -> Result<Fitted, FitError> {
    check(points, asked)?;
    let mut list = PointList::new(points);
    leave_out_outliers(&mut list, asked.degree, progress)?;
    progress.set_done(0.1);
    let fit = Fit {
        list: &list,
        asked,
        progress,
        smoothing: Smoothing::new(&list, asked.degree, progress),
    };
    match (asked.extrema, asked.tolerance) {
        (Some(extrema), _) => fit.best_with_extrema(extrema),
        (None, Some(tolerance)) => fit.fairest(tolerance),
        (None, None) => fit.plain(fit.smoothing.least(fit.count(None)?)?),
    }
}

/// Check that there can be such a fit.
fn check(points: &[DVec3], asked: &FitRequest) -> Result<(), FitError> {
    let degree = asked.degree;
    check_size(degree, asked.count.unwrap_or(degree + 1), false)?;
    let differing = points.windows(2).filter(|pair| pair[0] != pair[1]);
    let found = differing.count() + usize::from(!points.is_empty());
    if found < degree + 1 {
        return Err(FitError::TooFewPoints { found, degree });
    }
    if let Some(count) = asked.count.filter(|count| *count > points.len()) {
        let points = points.len();
        return Err(FitError::TooManyVertices { count, points });
    }
    let Some(extrema) = asked.extrema else {
        return Ok(());
    };
    let needed = vertices_for(extrema, degree);
    let limits = [
        (asked.count.unwrap_or(needed), "vertices"),
        (points.len(), "points"),
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
    list: &'a PointList<'a>,
    asked: &'a FitRequest,
    progress: &'a Progress,
    smoothing: Smoothing<'a>,
}

impl Fit<'_> {
    /// The requested number of vertices, or else the best.
    fn count(&self, tolerance: Option<f64>) -> Result<usize, FitError> {
        let best = || best_count(&self.smoothing, tolerance);
        self.asked.count.map_or_else(best, Ok)
    }

    /// The curve with the largest fairness weight that keeps the tolerance.
    fn fairest(&self, tolerance: f64) -> Result<Fitted, FitError> {
        let count = self.count(Some(tolerance))?;
        let keeps = |smoothed: &Smoothed| smoothed.errors[1] <= tolerance;
        let mut found = self.smoothing.while_passing(count, keeps)?;
        match found.pop() {
            Some(fairest) => self.plain(fairest),
            None => self.plain(self.smoothing.least(count)?),
        }
    }

    /// The fit with so many extrema that is nearest to the points, with the number of vertices given or the
    /// least from the best on with which it is about as near as noise allows.
    fn best_with_extrema(&self, extrema: usize) -> Result<Fitted, FitError> {
        let least = vertices_for(extrema, self.asked.degree);
        let natural = best_count(&self.smoothing, None)?.max(least);
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
        Ok(found.or(again, extrema))
    }

    /// The nearest with ever more vertices until it is near.
    fn best_of_many(&self, natural: usize, extrema: usize) -> Result<Fitted, FitError> {
        let most = self.list.points.len();
        let enough = self.enough(&self.smoothing.least(natural)?);
        let mut best = self.with_extrema(natural, extrema, enough, None)?;
        let (mut count, mut more) = (natural, MORE);
        while count < most && !best.is_near(enough) {
            let done = (count as f64 / natural as f64).ln() / (most as f64 / natural as f64).ln();
            self.progress.set_done(0.1 + 0.9 * done);
            count = ((more * count as f64) as usize).clamp(count + 1, most);
            more *= MORE;
            let known = Some(&best.polygon).filter(|_| best.extrema == extrema);
            let found = self.with_extrema(count, extrema, enough, known)?;
            best = best.or(found, extrema);
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
        let rms_of_any = least.errors[0];
        let mut best = self.finished(least.clone(), rms_of_any)?;
        let fairest = fairest.filter(|_| fairness > least.fairness);
        for start in known.into_iter().chain(fairest).chain([least]) {
            let (from, fairness) = (start.near.clone(), start.fairness);
            best = best.or(self.finished(start, rms_of_any)?, extrema);
            if best.is_near(enough) {
                break;
            }
            let points = Points {
                points: self.list.points,
                counts: &self.list.counts,
                fairness: self.smoothing.weight(count, fairness),
                noise: noise.max(LEAST_NOISE * self.list.size),
            };
            if let Some(near) = nearest_with_extrema(&points, &from, extrema, self.progress)? {
                let found = Smoothed::new(self.list, near, fairness);
                best = best.or(self.finished(found, rms_of_any)?, extrema);
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
        let mut list = PointList::new(&samples);
        list.shares = shares;
        let smoothing = Smoothing::new(&list, self.asked.degree, self.progress);
        let polygon = smoothing.least(count)?.near.polygon;
        let places: Vec<f64> = self.list.shares.iter().map(|share| share * end).collect();
        let known = NearPoints::new(known.clone(), self.list.points, &places);
        let share = polygon.segments() as f64 / end;
        let places: Vec<f64> = known.places.iter().map(|u| share * u).collect();
        Ok(NearPoints::new(polygon, self.list.points, &places))
    }

    /// Prove and measure a fit on which there are no conditions.
    fn plain(&self, smoothed: Smoothed) -> Result<Fitted, FitError> {
        let rms = smoothed.errors[0];
        self.finished(smoothed, rms)
    }

    /// Prove and measure a fit.
    fn finished(&self, smoothed: Smoothed, rms_of_any: f64) -> Result<Fitted, FitError> {
        let polygon = smoothed.near.polygon;
        let features = Features::proved(&polygon, |_| !self.progress.is_cancelled());
        let extrema = extrema_of(&features.ok_or(FitError::Cancelled)?);
        let [rms, largest] = smoothed.errors;
        let asked = self.asked;
        let right = asked.extrema.is_none_or(|asked| asked == extrema);
        let near = asked.tolerance.is_none_or(|tolerance| largest <= tolerance);
        let outliers = self.list.counts.iter().enumerate();
        let outliers = outliers.filter(|(_, counts)| !**counts);
        Ok(Fitted {
            polygon,
            reached: right && near,
            extrema,
            rms,
            rms_of_any: rms_of_any.min(rms),
            largest,
            outliers: outliers.map(|(index, _)| index).collect(),
            fairness: smoothed.fairness,
        })
    }
}

impl Fitted {
    /// Whether it meets the request and the tolerance.
    fn is_near(&self, enough: f64) -> bool {
        self.reached && self.rms <= enough
    }

    /// The better of two: it reaches what was asked for, or its number of extrema is nearer to the one asked
    /// for, or it is nearer to the points.
    fn or(self, other: Self, extrema: usize) -> Self {
        let rank = |fitted: &Self| (fitted.reached, Reverse(fitted.extrema.abs_diff(extrema)));
        match rank(&other).cmp(&rank(&self)) {
            Ordering::Greater => other,
            Ordering::Equal if other.rms < self.rms => other,
            _ => self,
        }
    }
}
