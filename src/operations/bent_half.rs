//! A half that bends near the mirror plane so that its image goes on smoothly from it.

use super::error::OperationError;
use super::half::KeptHalf;
use crate::geometry::distance::SideDeviation;
use crate::geometry::fairing::mirrored_half::joined_to_image;
use crate::geometry::features::{Feature, Features};
use crate::geometry::{End, FloatPolygon, Mirror, Progress};

/// How often the segments of a half that bends are halved: few vertices come first.
const HALVED: [u32; 2] = [0, 1];

/// How many vertices bend near the axis, as multiples of the degree and more: many bend fairly, few stay near.
const BENT: [[usize; 2]; 3] = [[4, 8], [2, 4], [1, 2]];

/// A half that was bent near the mirror plane, and its image in one.
pub(super) struct BentHalf {
    pub(super) polygon: FloatPolygon,
    /// How far the half moves, and beyond a gap before its image how far the new half is from it.
    pub(super) off: f64,
    /// The inflections that neither the half nor its image has, but for those that its corner asks for.
    waves: usize,
}

impl BentHalf {
    /// Bend the vertices of a half of a curve near the mirror plane: the first try without waves within the first
    /// limit, or the best one within the second. `None` for what has no plane.
    pub(super) fn new(
        polygon: &FloatPolygon,
        kept: &KeptHalf,
        mirror: &Mirror,
        [limit, near]: [f64; 2],
        progress: &Progress,
    ) -> Result<Option<Self>, OperationError> {
        if polygon.is_periodic() {
            return Ok(None);
        }
        let [from, to] = kept.span;
        let is_whole = [from, to] == [0.0, polygon.segments() as f64];
        let turns = 2 * usize::from(turns_back(kept, mirror));
        let own = 2 * inflections(&kept.part, progress)? + turns;
        let mut best: Option<Self> = None;
        for halvings in HALVED {
            // The end of the cut is near the plane: it need not be exact.
            let cut = match is_whole && halvings == 0 {
                true => polygon.clone(),
                false => polygon.trimmed(from, to, halvings)?.polygon,
            };
            for [times, more] in BENT {
                let reach = times * polygon.degree() + more;
                let Some(whole) = joined(&cut, kept.inner(), mirror, reach) else {
                    return Ok(None);
                };
                let bent = Self {
                    off: off(kept, &whole, cut.vertices().len(), progress)?,
                    waves: inflections(&whole, progress)?.saturating_sub(own),
                    polygon: whole,
                };
                let rank = |it: &Self| (it.off > near, it.waves, it.off);
                if best.as_ref().is_none_or(|known| rank(&bent) < rank(known)) {
                    best = Some(bent);
                }
                if best.as_ref().is_some_and(|it| it.is_within(limit)) {
                    return Ok(best);
                }
            }
            if best.as_ref().is_some_and(|it| it.is_within(near)) {
                break;
            }
        }
        Ok(best)
    }

    /// Whether it is fair and near.
    pub(super) fn is_within(&self, limit: f64) -> bool {
        self.waves == 0 && self.off <= limit
    }
}

/// A half joined to its image, in the order of the whole.
fn joined(cut: &FloatPolygon, inner: End, mirror: &Mirror, reach: usize) -> Option<FloatPolygon> {
    match inner {
        End::Start => joined_to_image(cut, mirror, reach),
        End::Finish => {
            let whole = joined_to_image(&cut.reversed(), mirror, reach);
            whole.map(|it| it.reversed())
        }
    }
}

/// How far a half is from a whole, and the half of the whole, of so many vertices, from it beyond the gap.
fn off(
    kept: &KeptHalf,
    whole: &FloatPolygon,
    count: usize,
    progress: &Progress,
) -> Result<f64, OperationError> {
    let vertices = whole.vertices();
    let last = vertices.len() - count;
    let own = match kept.inner() {
        End::Start => &vertices[last..],
        End::Finish => &vertices[..count],
    };
    let own = FloatPolygon::new(whole.degree(), own.to_vec(), None, false)?;
    let largest = |from: &FloatPolygon, to: &FloatPolygon| {
        let side = SideDeviation::of_curve(from, to, progress);
        let side = side.map_err(|_| OperationError::Cancelled)?;
        Ok::<f64, OperationError>(side.largest.distance())
    };
    let beyond = largest(&own, &kept.part)? - 0.5 * kept.joint().gap;
    Ok(largest(&kept.part, whole)?.max(beyond))
}

/// Whether a planar half turns the other way at the mirror plane than before it: then its curvature changes its sign on
/// either side.
fn turns_back(kept: &KeptHalf, mirror: &Mirror) -> bool {
    let jet = kept.part.end_jet(kept.inner());
    let (Some(tangent), Some([_, normal])) = (jet.tangent(), mirror.plane()) else {
        return false;
    };
    // Beyond the plane the part of the tangent across goes on, and that within it turns round.
    let across = tangent.dot(normal) * normal;
    let image = 2.0 * across - tangent;
    let turn = match kept.inner() {
        End::Start => image.truncate().perp_dot(tangent.truncate()),
        End::Finish => tangent.truncate().perp_dot(image.truncate()),
    };
    kept.part.is_planar() && turn * jet.curvature_of(true) < 0.0
}

/// Count the proved inflections of a curve.
fn inflections(polygon: &FloatPolygon, progress: &Progress) -> Result<usize, OperationError> {
    let features = Features::proved(polygon, |_| !progress.is_cancelled());
    let features = features.ok_or(OperationError::Cancelled)?;
    Ok(features.count(Feature::Inflection))
}
