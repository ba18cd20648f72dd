//! A planar curve made periodic within a tolerance: ends that meet, but for a small corner, go over into each other, and
//! a blend closes a gap.

use glam::{DVec2, DVec3};

use super::blending::blend;
use super::merging::{
    KEPT, MOST, MergeError, Merged, SMALLEST, Track, beside, check_joint, counts_of, joint_of,
    sampled, samples_of,
};
use crate::geometry::distance::SideDeviation;
use crate::geometry::end::End;
use crate::geometry::fitting::{FitError, PlaneFit, fit_plane};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::largest_curvature::largest_curvature;
use crate::geometry::progress::Progress;

/// Samples nearer to the middle of a gap than so many times its width do not count.
const BESIDE: f64 = 2.0;

/// The samples of a blend.
const BLEND_SAMPLES: usize = 48;

/// Ends that are no farther apart than this share of the size, and turn little, go over into each other.
pub const SMALL_GAP: f64 = 0.01;

/// Ends that go over into each other so many times as sharply as the curve bends elsewhere bulge.
const BULGE: f64 = 1.25;

/// Make a planar open curve periodic and without weights, within a tolerance; where its last n vertices are its first, it
/// is exact and keeps them. It has the fewest curvature extrema that
/// the curve and a blend between its ends, if they are apart, allow, proved; the deviation is that of the curve from it.
/// Across a gap of up to 1 % of the size ends go over into each other, and move by no more than the gap; where that fails
/// or bulges, or the gap is wider, the blend connects them.
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
    let counts = counts_of([polygon], progress)?;
    if let Some(closed) = polygon.rolled() {
        let [extrema, _] = counts_of([&closed], progress)?;
        return measured(&[polygon], closed, [counts[0], extrema], progress);
    }
    if !polygon.is_planar() {
        return Err(MergeError::NotFound);
    }
    let (joint, size) = (joint_of(polygon, polygon), polygon.size());
    let meets = joint.meets(tolerance);
    let bent = check_joint(joint, size, tolerance);
    let near = match bent.is_ok() && joint.meets(SMALL_GAP * size) {
        true => Closing::meeting(polygon, counts, tolerance.max(joint.gap)).fitted(progress),
        false => Err(MergeError::NotFound),
    };
    let is_near = |closed: &Merged| closed.deviation <= tolerance.max(joint.gap);
    match near {
        Ok(closed) if is_near(&closed) && (meets || !bulges(&closed.polygon, polygon)) => {
            Ok(closed)
        }
        Err(MergeError::Cancelled) => Err(MergeError::Cancelled),
        near if meets => bent.and(near),
        near => {
            let blended = Closing::blended(polygon, counts, tolerance, progress)?.fitted(progress);
            match (near, blended) {
                (Ok(near), Err(_)) if is_near(&near) => Ok(near),
                (_, blended) => blended,
            }
        }
    }
}

/// Make a periodic curve without weights of two planar ones that meet at both ends, but for small corners, within a
/// tolerance: as [`close_within`] where ends meet.
///
/// # Errors
/// As [`close_within`].
pub fn close_halves(
    parts: [&FloatPolygon; 2],
    tolerance: f64,
    progress: &Progress,
) -> Result<Merged, MergeError> {
    let counts = counts_of(parts, progress)?;
    let whole = parts[0].followed_by(parts[1]);
    if let Some(closed) = whole.and_then(|whole| whole.rolled()) {
        let [extrema, _] = counts_of([&closed], progress)?;
        return measured(&parts, closed, [counts[0], extrema], progress);
    }
    if !parts.iter().all(|part| part.is_planar()) {
        return Err(MergeError::NotFound);
    }
    let [mut points, others] = parts.map(|part| {
        let mut points = sampled(part, samples_of(part));
        points.pop();
        points
    });
    points.extend(others);
    Closing::between(parts.to_vec(), points, counts, tolerance).fitted(progress)
}

/// Whether a curve that is closed bends more sharply than the open one did.
fn bulges(closed: &FloatPolygon, open: &FloatPolygon) -> bool {
    let [now, was] = [closed, open].map(|polygon| {
        let whole = [0.0, polygon.segments() as f64];
        largest_curvature(polygon, whole)
    });
    now > BULGE * was
}

/// What a periodic curve is to be near to.
struct Closing<'a> {
    /// What it closes, in order.
    parts: Vec<&'a FloatPolygon>,
    points: Vec<DVec3>,
    /// The extrema and inflections of the curve.
    counts: [usize; 2],
    /// The inflections that it may have beside those of the curve.
    bends: usize,
    /// The inflections asked for.
    inflections: Option<usize>,
    tolerance: f64,
}

impl<'a> Closing<'a> {
    /// Let ends that meet, or nearly do, go over into each other: samples beside them do not count.
    fn meeting(polygon: &'a FloatPolygon, counts: [usize; 2], tolerance: f64) -> Self {
        let [start, end] = End::BOTH.map(|end| polygon.end_jet(end).point);
        let (middle, gap) = (start.midpoint(end), start.distance(end));
        let mut points = sampled(polygon, samples_of(polygon));
        points.pop();
        points.retain(|point| gap == 0.0 || point.distance(middle) > BESIDE * gap);
        Self::between(vec![polygon], points, counts, tolerance)
    }

    /// Let curves go over into each other.
    fn between(
        parts: Vec<&'a FloatPolygon>,
        points: Vec<DVec3>,
        counts: [usize; 2],
        tolerance: f64,
    ) -> Self {
        let [_, inflections] = counts;
        Self {
            parts,
            points,
            counts,
            bends: inflections % 2,
            inflections: (inflections % 2 == 0).then_some(inflections),
            tolerance,
        }
    }

    /// Connect the ends by a blend.
    fn blended(
        polygon: &'a FloatPolygon,
        counts: [usize; 2],
        tolerance: f64,
        progress: &Progress,
    ) -> Result<Self, MergeError> {
        let between = blend(polygon, polygon).ok_or(MergeError::NoBlend)?;
        let [_, bends] = counts_of([&between], progress)?;
        let mut points = sampled(polygon, samples_of(polygon));
        points.pop();
        points.extend(sampled(&between, BLEND_SAMPLES));
        points.pop();
        // Beside a blend that bends to one side a flat end must not wave.
        let [_, inflections] = counts;
        let is_plain = bends == 0 && inflections % 2 == 0;
        Ok(Self {
            parts: vec![polygon],
            points,
            counts,
            bends,
            inflections: is_plain.then_some(inflections),
            tolerance,
        })
    }

    /// The curve with the fewest extrema within the tolerance; else the nearest one.
    fn fitted(&self, progress: &Progress) -> Result<Merged, MergeError> {
        let degrees = self.parts.iter().map(|part| part.degree());
        let vertices: usize = self.parts.iter().map(|part| part.vertices().len()).sum();
        let points: Vec<DVec2> = self.points.iter().map(|point| point.truncate()).collect();
        let wanted = PlaneFit {
            degree: degrees.max().unwrap_or_default(),
            periodic: true,
            most: Some((MOST * vertices).max(SMALLEST)),
            inflections: self.inflections,
            tolerance: Some(KEPT * self.tolerance),
            outliers: Some(Vec::new()),
            of_curve: true,
            ..PlaneFit::default()
        };
        let found = fit_plane(&points, &wanted, progress);
        if progress.is_cancelled() && !progress.is_late() {
            return Err(MergeError::Cancelled);
        }
        let closed = match found {
            Err(FitError::Cancelled) => return Err(MergeError::Cancelled),
            Ok(found) if found.holds => found.polygon,
            _ => return Err(MergeError::NotFound),
        };
        let endless = progress.without_limit();
        let [extrema, after] = counts_of([&closed], &endless)?;
        let closed = measured(&self.parts, closed, [self.counts[0], extrema], &endless)?;
        let waves = after.saturating_sub(self.counts[1] + self.bends);
        Ok(Merged { waves, ..closed })
    }
}

fn measured(
    parts: &[&FloatPolygon],
    closed: FloatPolygon,
    extrema: [usize; 2],
    progress: &Progress,
) -> Result<Merged, MergeError> {
    let cancelled = |_| MergeError::Cancelled;
    let mut deviation = 0.0_f64;
    let mut tracks: Vec<Track> = Vec::new();
    let mut end = 0.0;
    for part in parts.iter().copied() {
        let side = SideDeviation::of_curve(part, &closed, progress).map_err(cancelled)?;
        deviation = deviation.max(side.largest.distance());
        let track = Track::along(&closed, part, beside(&closed, part.point(0.0), end));
        end = track.at(part.segments() as f64);
        tracks.push(track);
    }
    let last = tracks.pop().ok_or(MergeError::NotFound)?;
    let first = tracks.pop().unwrap_or_else(|| last.clone());
    Ok(Merged {
        waves: 0,
        polygon: closed,
        tracks: [first, last],
        deviation,
        bounded: false,
        extrema,
    })
}
