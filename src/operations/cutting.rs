//! What splitting and trimming share.

use super::error::OperationError;
use super::lists::given_count;
use super::matches::without_match;
use super::outcome::Deviation;
use super::parameter::{Kind, Parameter};
use super::values::Values;
use crate::document::{Curve, CurveId, Document, Edit};
use crate::geometry::features::{Feature, Features};
use crate::geometry::{Approximation, End, FloatPolygon, MAX_SUBDIVISIONS, PolygonError, Progress};

/// How often segments may be halved to bring a knot to where the curve is cut.
pub(super) const SUBDIVISIONS: Parameter = Parameter {
    name: "subdivisions",
    label: "Refine at most",
    help: "How often segments are halved to put a knot at the cut; automatic: until features stay",
    kind: Kind::optional_count(MAX_SUBDIVISIONS as usize, false, |_| "automatic"),
};

/// The most halvings that keep features unasked: each doubles the vertices.
const UNASKED: u32 = 3;

/// Cut with the halvings that are asked for; or else with the fewest that add no curvature extremum to a part of the
/// curve, or with none where that takes too many. `parts` lists what the cut leaves.
pub(super) fn fairest<T>(
    curve: (&FloatPolygon, [f64; 2]),
    values: &Values,
    progress: &Progress,
    cut: impl Fn(u32) -> Result<T, PolygonError>,
    parts: impl Fn(&T) -> Vec<&Approximation>,
) -> Result<T, OperationError> {
    if let Some(halvings) = given_count(values, &SUBDIVISIONS) {
        return Ok(cut(halvings as u32)?);
    }
    let plain = cut(0)?;
    if parts(&plain).iter().all(|part| part.exact) {
        return Ok(plain);
    }
    let (whole, [from, to]) = curve;
    let places = extrema(whole, progress)?.into_iter();
    // On a periodic curve the part may lie past the joint.
    let turns = match whole.is_periodic() {
        true => vec![0.0, whole.segments() as f64],
        false => vec![0.0],
    };
    let within = places.filter(|([low, high], _)| {
        turns
            .iter()
            .any(|turn| high + turn >= from && low + turn <= to)
    });
    let most: usize = within.map(|(_, count)| count).sum();
    let adds = |found: &T| -> Result<bool, OperationError> {
        let mut sum = 0;
        for part in parts(found) {
            let places = extrema(&part.polygon, progress)?;
            sum += places.iter().map(|(_, count)| count).sum::<usize>();
        }
        Ok(sum > most)
    };
    if !adds(&plain)? {
        return Ok(plain);
    }
    for halvings in 1..=UNASKED {
        let finer = cut(halvings)?;
        if !adds(&finer)? {
            return Ok(finer);
        }
    }
    Ok(plain)
}

/// The curvature extrema of a curve: where they are, and how many.
fn extrema(
    polygon: &FloatPolygon,
    progress: &Progress,
) -> Result<Vec<([f64; 2], usize)>, OperationError> {
    let features = Features::proved(polygon, |_| !progress.is_cancelled());
    let features = features.ok_or(OperationError::Cancelled)?;
    Ok(features.places(Feature::CurvatureExtremum))
}

/// Say what brings parts nearer that are not exact.
pub(super) fn remark_on_nearness(deviation: Deviation) -> Option<String> {
    (deviation != Deviation::Exact)
        .then(|| "No knot lies at the cut: “Refine at most” brings the part nearer".to_owned())
}

/// Forget the target of an end that is cut off, if it has one, and its match.
pub(super) fn without_target(
    document: &Document,
    id: CurveId,
    curve: &Curve,
    end: End,
) -> impl Iterator<Item = Edit> {
    let target = curve.targets.get(end).map(|_| Edit::SetTarget {
        curve: id,
        end,
        target: None,
    });
    without_match(document, id, end).into_iter().chain(target)
}
