//! What splitting and trimming share.

use std::time::Duration;

use super::error::OperationError;
use super::lists::given_count;
use super::matches::without_match;
use super::outcome::Deviation;
use super::parameter::{Kind, Parameter};
use super::values::Values;
use crate::document::{Curve, CurveId, Document, Edit};
use crate::geometry::fairing::harmonising::{Harmony, Held, harmonise};
use crate::geometry::features::{Feature, Features};
use crate::geometry::{
    Approximation, BezierPolygon, End, FloatPolygon, MAX_SUBDIVISIONS, PolygonError, Progress,
};

/// How often segments may be halved to bring a knot to where the curve is cut.
pub(super) const SUBDIVISIONS: Parameter = Parameter {
    name: "subdivisions",
    label: "Refine at most",
    help: "How often segments are halved to put a knot at the cut; automatic: until features stay",
    kind: Kind::optional_count(MAX_SUBDIVISIONS as usize, false, |_| "automatic"),
};

/// The most halvings that keep features unasked: each doubles the vertices.
const UNASKED: u32 = 3;

/// How near a part must be unasked, in units of its size.
const NEAR: f64 = 1e-4;

/// A part whose curvature is made fair again may be so many times as far off as before.
const FARTHER: f64 = 10.0;

/// The time to make a part fair again.
const FAIRING: Duration = Duration::from_secs(3);

/// Cut a curve into parts from u to u with the halvings that are asked for.
///
/// Unasked each part has the fewest with which it is near, at most 1e-4 of its size off, and has no more curvature
/// extrema than the curve has there. Where no number does, it is the fairest part, harmonised.
pub(super) fn fairest(
    curve: &FloatPolygon,
    spans: &[[f64; 2]],
    values: &Values,
    progress: &Progress,
    cut: impl Fn(u32) -> Result<Vec<Approximation>, PolygonError>,
) -> Result<Vec<Approximation>, OperationError> {
    if let Some(halvings) = given_count(values, &SUBDIVISIONS) {
        return Ok(cut(halvings as u32)?);
    }
    let plain = cut(0)?;
    if plain.iter().all(|part| part.exact) {
        return Ok(plain);
    }
    let places = extrema(curve, progress)?;
    let mut levels = vec![plain];
    let mut parts = Vec::new();
    for (index, span) in spans.iter().enumerate() {
        let most = within(curve, &places, *span);
        let mut tried: Vec<Tried> = Vec::new();
        for halvings in 0..=UNASKED {
            if levels.len() <= halvings as usize {
                levels.push(cut(halvings)?);
            }
            let Some(part) = levels.get(halvings as usize).and_then(|it| it.get(index)) else {
                break;
            };
            let own = Tried::new(part.clone(), most, progress)?;
            let does = own.does();
            tried.push(own);
            if does {
                break;
            }
        }
        parts.extend(chosen(tried, most, progress));
    }
    Ok(parts)
}

/// A part of a curve with some number of halvings.
struct Tried {
    part: Approximation,
    /// How many extrema it has that the curve does not have there.
    added: usize,
    is_near: bool,
}

impl Tried {
    fn new(part: Approximation, most: usize, progress: &Progress) -> Result<Self, OperationError> {
        let count: usize = extrema(&part.polygon, progress)?
            .iter()
            .map(|(_, count)| count)
            .sum();
        let size = BezierPolygon::from_float(&part.polygon).size();
        Ok(Self {
            added: count.saturating_sub(most),
            is_near: part.deviation <= NEAR * size,
            part,
        })
    }

    fn does(&self) -> bool {
        self.added == 0 && self.is_near
    }
}

/// Choose the last one if it does, otherwise the fairest, or one that can be harmonised.
fn chosen(mut tried: Vec<Tried>, most: usize, progress: &Progress) -> Option<Approximation> {
    if tried.last().is_some_and(Tried::does) {
        return tried.pop().map(|last| last.part);
    }
    if tried.iter().all(|it| it.added > 0) {
        let progress = progress.limited(FAIRING);
        let near = tried.iter().filter(|it| it.is_near).chain(tried.last());
        let mut harmonised = near.filter_map(|it| harmonised(&it.part, most, &progress));
        if let Some(harmonised) = harmonised.next() {
            return Some(harmonised);
        }
    }
    let tried = tried.into_iter().map(|it| (it.added, it.part));
    let fairest = tried.min_by(|(a, one), (b, other)| {
        let deviation = || one.deviation.total_cmp(&other.deviation);
        a.cmp(b).then_with(deviation)
    });
    fairest.map(|(_, part)| part)
}

/// Give a part just so many extrema; its ends keep as much as they can.
fn harmonised(part: &Approximation, most: usize, progress: &Progress) -> Option<Approximation> {
    let size = BezierPolygon::from_float(&part.polygon).size();
    let farthest = (FARTHER * part.deviation).max(NEAR * size);
    let mut found = [Held::Curvature, Held::Direction].into_iter().map(|held| {
        let harmony = Harmony {
            stretch: None,
            ends: [held; 2],
            locked: &[],
            extrema: Some(most),
            inflections: None,
            torsion_extrema: None,
            largest_deviation: Some(farthest),
            symmetry: None,
        };
        let found = harmonise(&part.polygon, &harmony, progress).ok()?;
        // The deviation of the part is told as a bound.
        (found.reached && found.bounded).then_some(found)
    });
    let found = found.find_map(|found| found)?;
    Some(Approximation {
        polygon: found.polygon,
        deviation: part.deviation + found.deviation,
        exact: false,
    })
}

/// Count the extrema of a curve in a part of it.
fn within(curve: &FloatPolygon, places: &[([f64; 2], usize)], [from, to]: [f64; 2]) -> usize {
    // On a periodic curve the part may lie past the joint.
    let turns = match curve.is_periodic() {
        true => vec![0.0, curve.segments() as f64],
        false => vec![0.0],
    };
    let within = places.iter().filter(|([low, high], _)| {
        turns
            .iter()
            .any(|turn| high + turn >= from && low + turn <= to)
    });
    within.map(|(_, count)| count).sum()
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
        .then(|| "No knot lies at the cut: more halvings of segments bring it nearer".to_owned())
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
