//! Errors of polygons, parameters and conditions, with their place.

use thiserror::Error;

use super::polygon_kind::PolygonKind;
use super::wording::counted;

/// The highest degree a polygon may have: CAD kernels stop at 25.
pub const MAX_DEGREE: usize = 25;

/// A reason why vertices, weights and a degree do not make a polygon.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PolygonError {
    /// The degree lies outside 1 to [`MAX_DEGREE`].
    #[error("degree {degree} is out of range: a degree from 1 to {MAX_DEGREE} is needed")]
    DegreeOutOfRange {
        /// The degree given.
        degree: usize,
    },
    /// There are fewer vertices than a curve of this degree has.
    #[error(
        "{} too few: {} curve of degree {degree} needs at least {needed}",
        counted(*found, "vertex is", "vertices are"),
        if *periodic { "a periodic" } else { "an open" }
    )]
    TooFewVertices {
        /// The number of vertices given.
        found: usize,
        /// The smallest number that makes a curve.
        needed: usize,
        /// The degree given.
        degree: usize,
        /// Whether the curve is periodic.
        periodic: bool,
    },
    /// A coordinate is infinite or not a number.
    #[error(
        "vertex {index}: coordinate {axis} is {value:?}, and only finite numbers up to 1e100 can be used"
    )]
    BadCoordinate {
        /// The vertex, counted from 0.
        index: usize,
        /// Its coordinate: x, y or z.
        axis: char,
        /// The value given.
        value: f64,
    },
    /// A weight is zero, negative, infinite or not a number.
    #[error(
        "vertex {index}: weight {value:?} cannot be used: weights are positive numbers from 1e-100 to 1e100"
    )]
    BadWeight {
        /// The vertex, counted from 0.
        index: usize,
        /// The value given.
        value: f64,
    },
    /// The number of weights is not the number of vertices.
    #[error(
        "{} for {}: give one weight a vertex, or none at all",
        counted(*weights, "weight", "weights"),
        counted(*vertices, "vertex", "vertices")
    )]
    WeightCount {
        /// The number of weights given.
        weights: usize,
        /// The number of vertices given.
        vertices: usize,
    },
    /// A chain of Bézier polygons has a number of vertices that no number of segments gives.
    #[error(
        "{found} vertices do not make Bézier polygons of degree {degree}: the number must be a multiple of {degree}, plus 1"
    )]
    BezierCount {
        /// The number of vertices given.
        found: usize,
        /// The degree given.
        degree: usize,
    },
    /// A chain of Bézier polygons is not the B-spline curve that a float polygon can hold.
    #[error(
        "the Bézier polygons do not join as one B-spline curve: at vertex {index} they are {distance:.3e} away from the nearest one found; import the segments one by one"
    )]
    NotSmooth {
        /// The worst vertex, counted from 0.
        index: usize,
        /// Its distance from the curve's own Bézier vertex.
        distance: f64,
    },
    /// The float polygon of a curve is too large for its size.
    #[error(
        "the float polygon of this curve is so large that its last digits move vertex {index} by {distance:.3e}: a curve like this needs a lower degree"
    )]
    DigitsLost {
        /// The worst of the vertices given, counted from 0.
        index: usize,
        /// The distance it would move.
        distance: f64,
    },
    /// A polygon does not close as a periodic curve does.
    #[error(
        "the curve does not close smoothly: vertex {index} of the {from} polygon is {distance:.3e} away from the periodic curve nearest to it; keep the curve open"
    )]
    NotPeriodic {
        /// The polygon given.
        from: PolygonKind,
        /// The worst vertex, counted from 0.
        index: usize,
        /// Its distance from the periodic curve's own vertex.
        distance: f64,
    },
    /// A conversion gives a vertex without a positive weight.
    #[error(
        "the {to} polygon would have weight {weight:e} at vertex {index}: a curve with these weights has no {to} polygon with positive weights"
    )]
    WeightLost {
        /// The requested polygon.
        to: PolygonKind,
        /// The vertex, counted from 0.
        index: usize,
        /// The weight the exact conversion gives it.
        weight: f64,
    },
    /// A conversion gives a coordinate too large to hold.
    #[error("the {to} polygon would have vertex {index} outside the range of numbers")]
    Overflow {
        /// The requested polygon.
        to: PolygonKind,
        /// The vertex, counted from 0.
        index: usize,
    },
    /// A vertex number that the polygon does not have.
    #[error("vertex {index} does not exist: the polygon has {count} vertices, counted from 0")]
    NoSuchVertex {
        /// The requested vertex.
        index: usize,
        /// The number of vertices.
        count: usize,
    },
    /// Two polygons have different knots, so their curves cannot be compared.
    #[error(
        "curves of {segments} and {other} segments cannot be compared parameter by parameter: their degree or knots differ"
    )]
    DifferentKnots {
        /// The number of segments of the one curve.
        segments: usize,
        /// That of the other.
        other: usize,
    },
    /// A part of a curve that the curve does not have.
    #[error(
        "there is no part from u = {from} to u = {to}: u runs from 0 to {segments}, and a part begins before it ends"
    )]
    NoSuchPart {
        /// The requested start.
        from: f64,
        /// The requested end.
        to: f64,
        /// The number of segments of the curve.
        segments: usize,
    },
    /// An extension or a part would be too long.
    #[error("{segments} segments are too many at once: at most {most} can be made")]
    TooManySegments {
        /// The requested number of segments.
        segments: usize,
        /// The largest number.
        most: usize,
    },
    /// A periodic curve has no ends.
    #[error("a periodic curve has no ends and cannot be {done}: open it first")]
    PeriodicCurve {
        /// The refused action.
        done: &'static str,
    },
}

impl PolygonError {
    /// Count the vertex that a conversion's error names from the other end of a polygon whose
    /// last vertex is `last`.
    pub(super) fn counted_backwards(self, last: usize) -> Self {
        match self {
            Self::WeightLost { to, index, weight } => Self::WeightLost {
                to,
                index: last - index,
                weight,
            },
            Self::Overflow { to, index } => Self::Overflow {
                to,
                index: last - index,
            },
            other => other,
        }
    }
}
