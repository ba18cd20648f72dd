//! The float polygon of a segment.

use super::ends::Ends;
use super::error::BetweenError;
use super::parts::Parts;
use crate::geometry::approximation::{
    ApproximationError, MeasuredDeviation, Placing, UniformKnots, float_polygon,
};
use crate::geometry::differentiable::Differentiable;
use crate::geometry::end::End;
use crate::geometry::end_correction::EndTarget;
use crate::geometry::fairing::joint_correction::{CorrectionError, Disturbance, correct_jointly};
use crate::geometry::features::{Features, Verdict};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// The numbers of segments that are tried.
const COUNTS: [usize; 13] = [8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512];

/// What both ends are bent by least: third differences keep the curvature even.
const DISTURBANCE: Disturbance = Disturbance::Differences(3);

/// Hold a polygon with what it lacks of the true segment.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fit {
    /// The polygon, whose ends are exact.
    pub(super) polygon: FloatPolygon,
    /// What is left of the ends, as a length.
    pub(super) residual: f64,
    /// The largest distance to the true segment.
    pub(super) deviation: f64,
    /// Whether its curvature is monotone.
    pub(super) monotone: Verdict,
}

/// Find the polygon with the fewest segments that stays within a tolerance of the true segment and
/// has monotone curvature; without one, that which comes closest.
pub(super) fn fit(
    parts: &Parts,
    ends: &Ends,
    degree: usize,
    tolerance: f64,
    progress: &Progress,
) -> Result<Fit, BetweenError> {
    let mut best: Option<Fit> = None;
    let mut failed = None;
    for (index, count) in COUNTS.into_iter().enumerate() {
        if progress.is_cancelled() {
            return Err(BetweenError::Cancelled);
        }
        progress.set_done(index as f64 / COUNTS.len() as f64);
        // Few segments near a singularity of the true one make no curve.
        let found = quasi(parts, parts.end(), degree, count);
        let found = found.and_then(|polygon| Ok(exact_ends(&polygon, ends)?));
        let (polygon, residual) = match found {
            Ok(found) => found,
            Err(error) => {
                failed = Some(error);
                continue;
            }
        };
        let deviation = deviation(parts, &polygon)?;
        let close = deviation <= tolerance;
        let monotone = match close {
            true => Features::new(&polygon).monotone,
            false => Verdict::Undecided,
        };
        let found = Fit {
            polygon,
            residual,
            deviation,
            monotone,
        };
        if monotone == Verdict::Proved {
            return Ok(found);
        }
        // Of those that are close enough the one with the fewest segments is kept.
        let better = best
            .as_ref()
            .is_none_or(|best| best.deviation > tolerance && deviation < best.deviation);
        if better {
            best = Some(found);
        }
        // More segments make no arc monotone.
        if close && parts.is_arc() {
            break;
        }
    }
    match (best, failed) {
        (Some(best), _) => Ok(best),
        (None, failed) => Err(failed.unwrap_or(BetweenError::Cancelled)),
    }
}

/// Quasi-interpolate a curve from parameter 0 to an end by so many segments.
pub(super) fn quasi(
    curve: &dyn Differentiable,
    end: f64,
    degree: usize,
    segments: usize,
) -> Result<FloatPolygon, BetweenError> {
    let knots = UniformKnots::between(degree, [0.0, end], segments + degree)?;
    Ok(float_polygon(curve, &knots, Placing::Quasi)?)
}

/// Give a polygon exact ends, and the curvatures there that are asked for.
pub(super) fn exact_ends(
    polygon: &FloatPolygon,
    ends: &Ends,
) -> Result<(FloatPolygon, f64), CorrectionError> {
    let target = |index: usize| EndTarget {
        point: ends.points[index].extend(0.0),
        direction: Some(ends.directions[index].extend(0.0)),
        curvature: ends.curvatures[index],
        ..EndTarget::default()
    };
    let targets = [(End::Start, target(0)), (End::Finish, target(1))];
    let corrected = correct_jointly(polygon, &targets, DISTURBANCE, &[])?;
    Ok((corrected.polygon, corrected.residual))
}

/// Measure the largest distance between a polygon's curve and the true segment.
fn deviation(parts: &Parts, polygon: &FloatPolygon) -> Result<f64, ApproximationError> {
    let rate = parts.end() / polygon.segments() as f64;
    let interval = [0.0, parts.end()];
    let measured = MeasuredDeviation::measure(polygon, parts, &|u| u * rate, interval)?;
    Ok(measured.largest)
}
