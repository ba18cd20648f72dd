//! A half and its image in one curve: bent, merged, closed, fitted, or joined over a bridge.

use std::time::Duration;

use glam::DVec2;

use super::bent_half::BentHalf;
use super::bridge::{self, found};
use super::error::OperationError;
use super::half::KeptHalf;
use super::join::{MERGING, TOLERANCE, WITHIN, merge_error};
use crate::geometry::approximation::merging::{MergeError, joint_of, merge};
use crate::geometry::approximation::{
    ApproximationRequest, Goal, Placing, approximate_to_tolerance, close_halves,
};
use crate::geometry::distance::SideDeviation;
use crate::geometry::fairing::bridging::{Bridge, join};
use crate::geometry::fitting::{PlaneFit, SymmetryAxis, fit_plane};
use crate::geometry::{FloatPolygon, Mirror, Progress, significant};

/// The share of the tolerance that cutting the curve in half may take.
pub(super) const OF_CUT: f64 = 0.1;

/// The shares that merging the half with its image may take, before the mean of both: each search finds another curve.
const OF_MERGE: [f64; 3] = [0.5, 0.2, 1.0];

/// The share of a half that a bridge replaces where nothing else is found: less leaves no room to turn a corner off.
const RECEDED: f64 = 0.04;

/// Beyond the tolerance, a fit within so many times of it shows what a larger one would give.
const LARGER: f64 = 4.0;

/// The time for a fit of both halves.
const FITTING: Duration = Duration::from_secs(5);

/// The points of a half to which one curve is fitted with its image.
const FITTED: usize = 200;

/// All of a half.
pub(super) const WHOLE: [f64; 2] = [0.0, 1.0];

/// A half and its image in one.
pub(super) struct Whole {
    pub(super) polygon: FloatPolygon,
    pub(super) method: &'static str,
    /// Where the first of both ends on it, and where the second begins.
    pub(super) joint: [f64; 2],
    /// The shares of the half between which it is kept.
    pub(super) kept: [f64; 2],
    /// How far it is from both.
    pub(super) off: f64,
    /// Whether that is a bound.
    pub(super) bounded: bool,
    /// Why it is no use.
    pub(super) fault: Option<String>,
    /// What the user may not want of it.
    pub(super) knuckle: Option<String>,
}

impl From<BentHalf> for Whole {
    fn from(bent: BentHalf) -> Self {
        Self {
            joint: [0.5 * bent.polygon.segments() as f64; 2],
            kept: WHOLE,
            polygon: bent.polygon,
            method: "bend",
            off: bent.off,
            bounded: false,
            fault: None,
            knuckle: None,
        }
    }
}

/// Merge a half with its image.
pub(super) fn merged(
    parts: [&FloatPolygon; 2],
    mirror: &Mirror,
    tolerance: f64,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    // What it finds meanwhile is not symmetric yet.
    let progress = progress.limited(MERGING).unshown();
    let within = |tolerance: f64| {
        let merged = merge(parts[0], parts[1], tolerance, &progress)?;
        let symmetric = merged.polygon.symmetrised(mirror)?;
        merged.with_polygon(parts, symmetric, &progress)
    };
    let mut merged = within(OF_MERGE[0] * tolerance);
    for (tried, share) in OF_MERGE.iter().enumerate().skip(1) {
        progress.set_done(tried as f64 / OF_MERGE.len() as f64);
        let is_near =
            matches!(&merged, Ok(merged) if merged.deviation <= (1.0 - OF_CUT) * tolerance);
        if is_near || progress.is_cancelled() {
            break;
        }
        merged = match (merged, within(share * tolerance)) {
            (Ok(merged), Ok(other)) if other.deviation < merged.deviation => Ok(other),
            (Err(_), other) => other,
            (merged, _) => merged,
        };
    }
    let merged = merged.map_err(|error| merge_error(error, &progress))?;
    Ok(Whole {
        joint: [merged.tracks[0].at(parts[0].segments() as f64); 2],
        kept: WHOLE,
        polygon: merged.polygon,
        method: "merge",
        off: merged.deviation,
        bounded: merged.bounded,
        fault: None,
        knuckle: None,
    })
}

/// The nearest periodic curve of a half and its image.
pub(super) fn closed(
    parts: [&FloatPolygon; 2],
    mirror: &Mirror,
    tolerance: f64,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    let limited = progress.limited(MERGING).unshown();
    let mut nearest: Option<Whole> = None;
    for share in OF_MERGE {
        let found = match close_halves(parts, share * tolerance, &limited) {
            Ok(found) => found,
            Err(_) if progress.is_cancelled() => return Err(OperationError::Cancelled),
            Err(_) => continue,
        };
        let polygon = found.polygon.symmetrised(mirror)?;
        let off = SideDeviation::of_curve(parts[0], &polygon, progress);
        let off = off.map_err(|_| OperationError::Cancelled)?;
        let off = off.largest.distance();
        let whole = Whole {
            joint: [
                found.tracks[0].at(parts[0].segments() as f64),
                found.tracks[1].at(0.0),
            ],
            kept: WHOLE,
            polygon,
            method: "merge",
            off,
            bounded: false,
            fault: None,
            knuckle: (off > tolerance).then(|| rounded_corners(parts)),
        };
        if nearest.as_ref().is_none_or(|known| whole.off < known.off) {
            nearest = Some(whole);
        }
        let limit = (1.0 - OF_CUT) * tolerance;
        if nearest.as_ref().is_some_and(|known| known.off <= limit) {
            break;
        }
    }
    nearest.ok_or(MergeError::NotFound.into())
}

/// Bridge the gap between a curve and its image.
pub(super) fn bridged(
    parts: [&FloatPolygon; 2],
    mirror: &Mirror,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    let wanted = Bridge {
        vertices: None,
        second_moves: false,
    };
    let found = found(join(parts[0], parts[1], &wanted, progress))?;
    let fault = bridge::fault(&found, parts).or_else(|| bridge::spike(&found));
    let symmetric = found.polygon.symmetrised(mirror)?;
    Ok(Whole {
        joint: found.joint,
        kept: WHOLE,
        method: "bridge",
        // Both parts have as many segments, so that the bridge lies in the middle.
        off: found.polygon.deviation(&symmetric)?,
        bounded: true,
        knuckle: bridge::knuckle(&found).filter(|_| fault.is_none()),
        fault: fault
            .map(|fault| format!("{fault}: bring the end to the axis, perpendicular to it")),
        polygon: symmetric,
    })
}

/// A whole with more vertices than both halves have, as a cut or a bridge refines them, as one curve with fewer if one is
/// within the tolerance.
pub(super) fn with_few_vertices(
    (whole, most): (Whole, usize),
    kept: &KeptHalf,
    mirror: &Mirror,
    tolerance: f64,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    let count = |polygon: &FloatPolygon| polygon.vertices().len();
    if count(&whole.polygon) <= most || whole.fault.is_some() {
        return Ok(whole);
    }
    let fitted = refitted(kept, mirror, tolerance, progress)?;
    let fewer = fitted.filter(|fitted| count(&fitted.polygon) < count(&whole.polygon));
    Ok(fewer.unwrap_or(whole))
}

/// A half and its image over a bridge, approximated by fewer vertices if they are within the tolerance. There are no points
/// of the halves across the bridge: a fit to these would go its own way.
pub(super) fn bridged_with_few_vertices(
    (whole, most): (Whole, usize),
    mirror: &Mirror,
    tolerance: f64,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    if whole.polygon.vertices().len() <= most || whole.fault.is_some() {
        return Ok(whole);
    }
    let polygon = &whole.polygon;
    let within = (1.0 - OF_CUT) * tolerance;
    let goal = Goal {
        tolerance: 0.5 * within,
        spacing: None,
        most_segments: polygon.segments(),
    };
    let asked = ApproximationRequest {
        degree: polygon.degree(),
        placing: Placing::Quasi,
        levels: 1,
        periodic: false,
        fit_ends: true,
    };
    let all = [0.0, polygon.segments() as f64];
    let limited = progress.limited(FITTING).unshown();
    let Ok(found) = approximate_to_tolerance(polygon, all, &goal, &asked, &limited) else {
        return match progress.is_cancelled() {
            true => Err(OperationError::Cancelled),
            false => Ok(whole),
        };
    };
    let fewer = found.polygon.symmetrised(mirror)?;
    let off = SideDeviation::both_ways([polygon, &fewer], progress);
    let off = whole.off + off.map_err(|_| OperationError::Cancelled)?;
    if off > within || fewer.vertices().len() >= polygon.vertices().len() {
        return Ok(whole);
    }
    Ok(Whole {
        joint: whole.joint.map(|u| fewer.nearest(polygon.point(u)).u),
        off,
        bounded: false,
        polygon: fewer,
        ..whole
    })
}

/// Fit one curve with few extrema to points of a half and of its image; `None` if none is near, or the mirror plane is none
/// of those that fits know.
///
/// Merging keeps every wave of the half, and has no room to turn a corner off. A fit may smooth both away.
fn refitted(
    kept: &KeptHalf,
    mirror: &Mirror,
    tolerance: f64,
    progress: &Progress,
) -> Result<Option<Whole>, OperationError> {
    let axis = match mirror {
        Mirror::Signs([true, false, false]) => SymmetryAxis::Y,
        Mirror::Signs([false, true, false]) => SymmetryAxis::X,
        _ => return Ok(None),
    };
    if !kept.part.is_planar() {
        return Ok(None);
    }
    let samples = |polygon: &FloatPolygon| {
        let whole = [0.0, polygon.segments() as f64];
        let steps = (0..=FITTED).map(|step| step as f64 / FITTED as f64);
        let parameters = steps.map(|share| whole[1] * share);
        let points = parameters.map(|u| polygon.point(u).truncate());
        points.collect::<Vec<DVec2>>()
    };
    let [mut points, second] = kept.parts().map(samples);
    // Both meet at the axis, but for what the tolerance allows.
    points.extend(second.into_iter().skip(1));
    let within = (1.0 - OF_CUT) * tolerance;
    let asked = PlaneFit {
        degree: kept.part.degree(),
        tolerance: Some((1.0 - OF_CUT) * within),
        outliers: Some(Vec::new()),
        mirror: Some(axis),
        of_curve: true,
        ..PlaneFit::default()
    };
    let fitted = match fit_plane(&points, &asked, &progress.limited(FITTING).unshown()) {
        Ok(fitted) => fitted,
        Err(_) if progress.is_cancelled() => return Err(OperationError::Cancelled),
        Err(_) => return Ok(None),
    };
    let off = SideDeviation::of_curve(&kept.part, &fitted.polygon, progress);
    let off = off.map_err(|_| OperationError::Cancelled)?;
    let off = off.largest.distance();
    let is_near = off <= within && fitted.crossing.is_none();
    Ok(is_near.then_some(Whole {
        joint: [0.5 * fitted.polygon.segments() as f64; 2],
        kept: WHOLE,
        polygon: fitted.polygon,
        method: "fit",
        off,
        bounded: false,
        fault: None,
        knuckle: None,
    }))
}

/// A half and its image in one where no merged curve is as fair: one fit within the tolerance, or a bridge, or what a larger
/// tolerance would give.
pub(super) fn smoothed(
    kept: &KeptHalf,
    mirror: &Mirror,
    tolerance: f64,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    if let Some(fitted) = refitted(kept, mirror, tolerance, progress)? {
        return Ok(fitted);
    }
    progress.set_done(0.7);
    let receded = receded(kept, mirror, progress)?;
    progress.set_done(0.85);
    if receded.fault.is_none() && receded.off <= (1.0 - OF_CUT) * tolerance {
        return Ok(receded);
    }
    let fitted = refitted(kept, mirror, LARGER * tolerance, progress)?;
    Ok(fitted.unwrap_or(receded))
}

/// Bridge from a half to its image, in place of what lies near the axis: where both meet at a corner that no curve as fair
/// comes near.
pub(super) fn receded(
    kept: &KeptHalf,
    mirror: &Mirror,
    progress: &Progress,
) -> Result<Whole, OperationError> {
    let short = kept.receded(RECEDED, mirror, OF_CUT * WITHIN * kept.part.size())?;
    let whole = bridged(short.parts(), mirror, progress)?;
    let off = SideDeviation::of_curve(&kept.part, &whole.polygon, progress);
    let off = off.map_err(|_| OperationError::Cancelled)?;
    Ok(Whole {
        off: off.largest.distance(),
        bounded: false,
        kept: kept.half.kept(RECEDED),
        ..whole
    })
}

/// Say which corners keep a closed curve from being near.
fn rounded_corners([first, second]: [&FloatPolygon; 2]) -> String {
    let angles = [joint_of(first, second), joint_of(second, first)].map(|joint| {
        let degrees = joint.angle.to_degrees();
        significant(degrees, 2)
    });
    let [inner, outer] = angles;
    format!(
        "The curve meets its image at corners of {inner}° and {outer}°, which are rounded: turn its ends perpendicular to the axis, or raise “{}”",
        TOLERANCE.label
    )
}
