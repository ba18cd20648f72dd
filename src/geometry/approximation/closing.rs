//! A planar curve made periodic within a tolerance: ends that meet, but for a small corner, go over into each other, and
//! a blend closes a gap.

use glam::DVec2;

use super::blending::blend;
use super::merging::{
    MergeError, Merged, SMALLEST, Track, added_by_joint, check_joint, counts_of, joint_of, sampled,
    samples_of,
};
use crate::geometry::distance::SideDeviation;
use crate::geometry::fitting::{Extrema, FitError, PlaneFit, fit_plane};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// How many numbers of extrema are tried, by twos: a periodic curve has an even number.
const TRIED: usize = 3;

/// The share of the tolerance that samples must keep, so that the curve between them does too.
const KEPT: f64 = 0.9;

/// The share of the time that is left for each number of extrema.
const SHARE: f64 = 0.5;

/// The most vertices, by those of the curve.
const MOST: usize = 2;

/// The samples of a blend.
const BLEND_SAMPLES: usize = 48;

/// Make a planar open curve periodic and without weights, within a tolerance. It has as many curvature extrema as the
/// curve, a blend between its ends if they are apart, and the joints ask for, or a few more, proved; the deviation is
/// that of the curve from it.
///
/// Where no such curve keeps the tolerance, the nearest one that was found is returned.
///
/// # Errors
/// [`MergeError`]; a curve in space is [`MergeError::NotFound`].
pub fn close_within(
    polygon: &FloatPolygon,
    tolerance: f64,
    progress: &Progress,
) -> Result<Merged, MergeError> {
    polygon.check_open("closed")?;
    if !polygon.is_planar() {
        return Err(MergeError::NotFound);
    }
    let [own, inflections] = counts_of([polygon], progress)?;
    let joint = joint_of(polygon, polygon);
    let mut points = sampled(polygon, samples_of(polygon));
    // The ends count once.
    points.pop();
    let (extrema, bends, asked) = if joint.meets(tolerance) {
        check_joint(joint, polygon.size(), tolerance)?;
        let added = added_by_joint([polygon; 2], true, tolerance);
        (own + added, usize::from(inflections % 2 == 1), None)
    } else {
        let between = blend(polygon, polygon).ok_or(MergeError::NoBlend)?;
        let [blended, bends] = counts_of([&between], progress)?;
        let joints = [[polygon, &between], [&between, polygon]];
        let added = joints.map(|pair| added_by_joint(pair, true, tolerance));
        points.extend(sampled(&between, BLEND_SAMPLES));
        points.pop();
        // Beside a blend that bends to one side a flat end must not wave.
        let is_even = inflections % 2 == 0;
        let asked = (bends == 0 && is_even).then_some(inflections);
        let added: usize = added.into_iter().sum();
        (own + blended + added, bends, asked)
    };
    let points: Vec<DVec2> = points.iter().map(|point| point.truncate()).collect();
    let mut nearest: Option<Merged> = None;
    for extrema in (0..TRIED).map(|more| extrema + extrema % 2 + 2 * more) {
        let wanted = PlaneFit {
            degree: polygon.degree(),
            periodic: true,
            most: Some((MOST * polygon.vertices().len()).max(SMALLEST)),
            extrema: Extrema::Exactly(extrema),
            inflections: asked,
            tolerance: Some(KEPT * tolerance),
            outliers: Some(Vec::new()),
            of_curve: true,
            ..PlaneFit::default()
        };
        let found = fit_plane(&points, &wanted, &progress.hurried(SHARE));
        if progress.is_cancelled() && !progress.is_late() {
            return Err(MergeError::Cancelled);
        }
        let closed = match found {
            Err(FitError::Cancelled) => return Err(MergeError::Cancelled),
            Ok(found) if found.holds => found.polygon,
            _ => continue,
        };
        let expected = inflections + bends;
        let waves = counts_of([&closed], &progress.without_limit())?[1].saturating_sub(expected);
        let closed = measured(polygon, closed, [own, extrema], &progress.without_limit())?;
        let closed = Merged { waves, ..closed };
        if closed.deviation <= tolerance {
            return Ok(closed);
        }
        let is_nearer = |known: &Merged| closed.deviation < known.deviation;
        if nearest.as_ref().is_none_or(is_nearer) {
            nearest = Some(closed);
        }
    }
    nearest.ok_or(MergeError::NotFound)
}

fn measured(
    polygon: &FloatPolygon,
    closed: FloatPolygon,
    extrema: [usize; 2],
    progress: &Progress,
) -> Result<Merged, MergeError> {
    let cancelled = |_| MergeError::Cancelled;
    let side = SideDeviation::of_curve(polygon, &closed, progress).map_err(cancelled)?;
    let track = Track::along(&closed, polygon, 0.0);
    Ok(Merged {
        waves: 0,
        polygon: closed,
        tracks: [track.clone(), track],
        deviation: side.largest.distance(),
        bounded: false,
        extrema,
    })
}
