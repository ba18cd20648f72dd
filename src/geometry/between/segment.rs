//! Segments between two ends, as float polygons.

use super::ends::Ends;
use super::error::BetweenError;
use super::harmonised::monotone;
use super::parts::{Part, Parts};
use super::polygon::{Fit, fit};
use super::solving::log_aesthetic_parts;
use super::superspiral::superspiral_parts;
use crate::geometry::end::End;
use crate::geometry::fairing::counts::CountRequest;
use crate::geometry::fairing::requirement::{PlaceRequest, Requirement};
use crate::geometry::features::{Features, Verdict};
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;

/// The tolerance that is offered, in units of the length.
const SHARE_OF_LENGTH: f64 = 1e-6;

/// The largest miss of an end, in units of the curve's size.
const SHARE_OF_SIZE: f64 = 1e-9;

/// Precision of lengths.
const LENGTH: f64 = 1e-12;

/// The number of segments of a straight one.
const STRAIGHT: usize = 8;

/// Request for a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SegmentKind {
    /// A log-aesthetic segment, with α or with the one that gives an end its curvature, and the
    /// clothoid's if no curvature is given; with both curvatures two of them where one does not do.
    LogAesthetic {
        /// The slope α of the logarithmic curvature graph.
        alpha: Option<f64>,
    },
    /// A segment of the superspiral with ρ(ψ) = ₂F₁(a, b; c; −ψ), a > 0, c > b > 0.
    Superspiral {
        /// The numbers a, b and c.
        values: [f64; 3],
    },
    /// Any segment with monotone curvature.
    AnyMonotone,
}

/// Hold a segment between two ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// The float polygon. Its ends are exact but for rounding.
    pub polygon: FloatPolygon,
    /// The true segment, in one part or two that meet with one curvature; none for any monotone curve,
    /// which is its own, unless it is an arc.
    pub parts: Vec<Part>,
    /// What the polygon must hold: the ends, the tolerance and, unless it is an arc, monotone curvature.
    pub requirements: Vec<Requirement>,
    /// The largest distance from the true segment, 0 where there is none.
    pub deviation: f64,
    /// The tolerance of that distance.
    pub tolerance: f64,
    /// The length of the polygon's curve.
    pub length: f64,
    /// Whether the curvature is proved to be monotone.
    pub monotone: Verdict,
    /// Whether the true segment is a circular arc: its curvature is constant, and that of the polygon's curve
    /// is so only nearly.
    pub arc: bool,
    /// Whether both directions follow the chord, so that it is straight but for rounding.
    pub straight: bool,
}

impl Segment {
    /// Whether it is near enough to the true segment, and monotone or an arc.
    pub fn is_found(&self) -> bool {
        let is_monotone = self.arc || self.monotone == Verdict::Proved;
        is_monotone && self.deviation <= self.tolerance
    }
}

/// What a segment must hold.
fn requirements(
    polygon: &FloatPolygon,
    ends: &Ends,
    is_arc: bool,
    [deviation, tolerance]: [f64; 2],
) -> Vec<Requirement> {
    let size = polygon.size();
    let places = [0, 1].map(|index| {
        Requirement::Place(PlaceRequest {
            u: End::BOTH[index].parameter(polygon),
            target: ends.target(index),
            tolerance: Some(SHARE_OF_SIZE * size),
            speed: None,
        })
    });
    let monotone = Requirement::Features {
        stretch: None,
        request: CountRequest::exactly([None, Some(0), None]),
    };
    let limit = Requirement::Limit {
        found: deviation,
        most: tolerance,
    };
    let monotone = Some(monotone).filter(|_| !is_arc);
    places.into_iter().chain([limit]).chain(monotone).collect()
}

/// Find a segment of a kind between two ends, as a float polygon of a degree from 3 on: with the fewest
/// segments, of a fixed series of numbers, with which it stays within `tolerance` of the true segment
/// (1e-6 of that segment's length if none is given) and has monotone curvature, proved.
/// Between the ends of a circular arc it follows the arc. When the time of `progress` is up it is the nearest that was
/// found.
///
/// The vertices quasi-interpolate the true segment at equal steps of arc length, superspirals of
/// the direction angle, and log-aesthetic segments that bend too sharply for that of ln ρ; then both ends are made exact by the least disturbance.
///
/// # Errors
/// [`BetweenError`]: where there is no such segment it names the possible ones.
pub fn between(
    ends: &Ends,
    kind: SegmentKind,
    degree: usize,
    tolerance: Option<f64>,
    progress: &Progress,
) -> Result<Segment, BetweenError> {
    let ends = &ends.with_moderate_directions();
    let task = ends.task()?;
    if task.is_straight() {
        return straight(ends, degree, tolerance);
    }
    let parts = match kind {
        SegmentKind::LogAesthetic { alpha } => Some(log_aesthetic_parts(&task, alpha)?),
        SegmentKind::Superspiral { values } => Some(superspiral_parts(&task, values)?),
        // No other curve has the ends of an arc.
        SegmentKind::AnyMonotone if task.is_arc() => log_aesthetic_parts(&task, None).ok(),
        SegmentKind::AnyMonotone => None,
    };
    let allowed = |length: f64| tolerance.unwrap_or(SHARE_OF_LENGTH * length);
    let Fit {
        polygon,
        deviation,
        monotone,
    } = match &parts {
        Some(parts) => fit(parts, ends, degree, allowed(parts.length()), progress)?,
        None => monotone(&task, ends, degree, &allowed, progress)?,
    };
    let length = polygon.arc_length(LENGTH);
    let tolerance = allowed(parts.as_ref().map_or(length, Parts::length));
    let arc = parts.as_ref().is_some_and(Parts::is_arc);
    Ok(Segment {
        requirements: requirements(&polygon, ends, arc, [deviation, tolerance]),
        arc,
        parts: parts.map_or_else(Vec::new, |parts| parts.parts),
        deviation,
        tolerance,
        length,
        monotone,
        straight: false,
        polygon,
    })
}

/// A straight segment, which all kinds have where both directions follow the chord.
fn straight(ends: &Ends, degree: usize, tolerance: Option<f64>) -> Result<Segment, BetweenError> {
    let [from, to] = ends.points.map(|point| point.extend(0.0));
    let place = |index: usize| {
        let middle = index as f64 - 0.5 * (degree as f64 - 1.0);
        from.lerp(to, middle / STRAIGHT as f64)
    };
    let vertices = (0..STRAIGHT + degree).map(place).collect();
    // Correcting the ends would bend it by rounding.
    let polygon = FloatPolygon::new(degree, vertices, None, false)?;
    let length = from.distance(to);
    let tolerance = tolerance.unwrap_or(SHARE_OF_LENGTH * length);
    Ok(Segment {
        requirements: requirements(&polygon, ends, false, [0.0, tolerance]),
        monotone: Features::new(&polygon).monotone,
        polygon,
        parts: Vec::new(),
        deviation: 0.0,
        tolerance,
        length,
        arc: false,
        straight: true,
    })
}
