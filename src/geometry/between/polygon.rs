//! The float polygon of a segment.

use std::cmp::Ordering;

use super::ends::Ends;
use super::error::BetweenError;
use super::growth::ByGrowth;
use super::parts::Parts;
use crate::geometry::approximation::{
    ApproximationError, Placing, Respaced, Spacing, UniformKnots, float_polygon,
};
use crate::geometry::differentiable::Differentiable;
use crate::geometry::distance::MeasuredDeviation;
use crate::geometry::end::End;
use crate::geometry::fairing::joint_correction::{CorrectionError, Disturbance, correct_jointly};
use crate::geometry::features::{Features, Verdict};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// The numbers of segments that are tried.
const COUNTS: [usize; 13] = [8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512];

/// The disturbance of the end correction: third differences keep the curvature even.
const DISTURBANCE: Disturbance = Disturbance::Differences(3);

/// A polygon with its differences from the true segment.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fit {
    /// The polygon, whose ends are exact.
    pub(super) polygon: FloatPolygon,
    /// The largest distance to the true segment.
    pub(super) deviation: f64,
    /// Whether its curvature is monotone.
    pub(super) monotone: Verdict,
}

/// Find the polygon with the fewest segments that stays within a tolerance of the true segment and
/// has monotone curvature; without one, the closest.
///
/// Vertices belong to even steps of the parts' own parameter. Where no number of them does, they belong to even
/// steps of ln ρ if the segment is log-aesthetic, or else of arc length and turning together: both are fine where
/// it bends sharply.
pub(super) fn fit(
    parts: &Parts,
    ends: &Ends,
    degree: usize,
    tolerance: f64,
    progress: &Progress,
) -> Result<Fit, BetweenError> {
    let search = Search {
        parts,
        ends,
        degree,
        tolerance,
        progress,
    };
    let own = search.closest(parts, parts.end, &|t| t);
    let reached = |fit: &Fit| fit.deviation <= tolerance && fit.monotone == Verdict::Proved;
    let found = match own {
        Err(BetweenError::Cancelled) => return own,
        Ok(fit) if reached(&fit) || parts.is_arc() => return Ok(fit),
        own => match (own, search.closest_by_bending()) {
            (Ok(own), Err(BetweenError::Cancelled)) if progress.is_late() => Ok(own),
            (_, Err(BetweenError::Cancelled)) => return Err(BetweenError::Cancelled),
            (Ok(own), Ok(other)) if other.is_better(&own, tolerance) => Ok(other),
            (Err(_), other) => other,
            (own, _) => own,
        },
    };
    let mut found = found?;
    if found.deviation > tolerance {
        found.monotone = monotony(&found.polygon, progress);
    }
    Ok(found)
}

impl Fit {
    /// Whether it is to be preferred to another one: near enough and monotone first, then near enough, then
    /// nearer.
    fn is_better(&self, other: &Self, tolerance: f64) -> bool {
        let rank = |fit: &Self| {
            let close = fit.deviation <= tolerance;
            (close, close && fit.monotone == Verdict::Proved)
        };
        match rank(self).cmp(&rank(other)) {
            Ordering::Equal => !rank(self).0 && self.deviation < other.deviation,
            order => order == Ordering::Greater,
        }
    }
}

/// Search for a polygon.
struct Search<'a> {
    parts: &'a Parts,
    ends: &'a Ends,
    degree: usize,
    tolerance: f64,
    progress: &'a Progress,
}

impl Search<'_> {
    /// Find the polygon as [`Search::closest`] does, with vertices that are close where the segment bends.
    fn closest_by_bending(&self) -> Result<Fit, BetweenError> {
        let parts = self.parts;
        if let Some(grown) = ByGrowth::of(parts) {
            return self.closest(&grown, 1.0, &|v| grown.arc_length(v));
        }
        let respaced = Respaced::new(parts, [0.0, parts.end], Spacing::Curvature)?;
        self.closest(&respaced, 1.0, &|v| respaced.near(v))
    }

    /// Find the polygon with the fewest segments that does, or that comes closest, with vertices at even
    /// steps of the parameter of a curve that is the true segment from 0 to `end`; `own` tells the parts'
    /// parameter that belongs to it.
    fn closest(
        &self,
        curve: &dyn Differentiable,
        end: f64,
        own: &dyn Fn(f64) -> f64,
    ) -> Result<Fit, BetweenError> {
        let mut best: Option<Fit> = None;
        let mut failed = None;
        for (index, count) in COUNTS.into_iter().enumerate() {
            if self.progress.is_cancelled() {
                break;
            }
            self.progress.set_done(index as f64 / COUNTS.len() as f64);
            // Few segments near a singularity of the true one make no curve.
            let found = quasi(curve, end, self.degree, count);
            let found =
                found.and_then(|polygon| Ok(exact_ends(&polygon, self.ends, self.progress)?));
            let polygon = match found {
                Ok(found) => found,
                Err(error) => {
                    failed = Some(error);
                    continue;
                }
            };
            let rate = end / count as f64;
            let deviation = deviation(self.parts, &polygon, &|u| own(u * rate), self.progress);
            let deviation = match deviation {
                Err(ApproximationError::Cancelled) => break,
                deviation => deviation?,
            };
            let close = deviation <= self.tolerance;
            let monotone = match close {
                true => monotony(&polygon, self.progress),
                false => Verdict::Undecided,
            };
            let found = Fit {
                polygon,
                deviation,
                monotone,
            };
            if monotone == Verdict::Proved {
                return Ok(found);
            }
            // Of those that are close enough the one with the fewest segments is kept.
            if best
                .as_ref()
                .is_none_or(|best| found.is_better(best, self.tolerance))
            {
                best = Some(found);
            }
            // More segments make no arc monotone.
            if close && self.parts.is_arc() {
                break;
            }
        }
        match (best, failed) {
            _ if self.progress.is_cancelled() && !self.progress.is_late() => {
                Err(BetweenError::Cancelled)
            }
            (Some(best), _) => Ok(best),
            // What the end of the time spoilt says nothing.
            (None, Some(error)) if !self.progress.is_cancelled() => Err(error),
            (None, _) => Err(BetweenError::Cancelled),
        }
    }
}

/// Quasi-interpolate a curve from parameter 0 to `end` by `segments` segments.
pub(super) fn quasi(
    curve: &dyn Differentiable,
    end: f64,
    degree: usize,
    segments: usize,
) -> Result<FloatPolygon, BetweenError> {
    let knots = UniformKnots::between(degree, [0.0, end], segments + degree)?;
    Ok(float_polygon(curve, &knots, Placing::Quasi)?)
}

/// Give a polygon exact ends with the requested curvatures.
pub(super) fn exact_ends(
    polygon: &FloatPolygon,
    ends: &Ends,
    progress: &Progress,
) -> Result<FloatPolygon, CorrectionError> {
    let targets = [(End::Start, ends.target(0)), (End::Finish, ends.target(1))];
    let corrected = correct_jointly(polygon, &targets, DISTURBANCE, &[], progress)?;
    Ok(corrected.polygon)
}

/// Measure the largest distance between a polygon's curve and the true segment; `parameter` tells which
/// of its parameters is near a given u.
fn deviation(
    parts: &Parts,
    polygon: &FloatPolygon,
    parameter: &dyn Fn(f64) -> f64,
    progress: &Progress,
) -> Result<f64, ApproximationError> {
    let interval = [0.0, parts.end];
    let measured = MeasuredDeviation::measure(polygon, parts, parameter, interval, progress)?;
    Ok(measured.largest)
}

/// Whether the curvature is proved to be monotone before `progress` is cancelled.
pub(super) fn monotony(polygon: &FloatPolygon, progress: &Progress) -> Verdict {
    let features = Features::proved(polygon, |_| !progress.is_cancelled());
    features.map_or(Verdict::Undecided, |features| features.monotone)
}
