//! Why there is no approximation.

use thiserror::Error;

use crate::geometry::distance::DistanceError;
use crate::geometry::error::PolygonError;
use crate::geometry::fairing::joint_correction::CorrectionError;

/// A reason why a curve has no float polygon near it.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ApproximationError {
    /// The knots are not finite, or do not ascend.
    #[error("the distance of the knots is {step}: it must be a positive number")]
    BadStep {
        /// The distance.
        step: f64,
    },
    /// The curve has no point or derivative where a vertex needs it.
    #[error(
        "the curve has no point, or not all derivatives, at parameter {parameter}, where vertex {vertex} needs them: choose a part of the curve without this place"
    )]
    NotFinite {
        /// The vertex, counted from 0.
        vertex: usize,
        /// The parameter of the expansion.
        parameter: f64,
    },
    /// The curve has no point somewhere.
    #[error(
        "the curve has no point at parameter {parameter}: choose a part of the curve without this place"
    )]
    NoPoint {
        /// The parameter.
        parameter: f64,
    },
    /// The curve stops somewhere, so no length or turning grows there.
    #[error(
        "the curve has no direction near parameter {parameter}: space the vertices by its own parameter, or choose a part without this place"
    )]
    NoDirection {
        /// Near where.
        parameter: f64,
    },
    /// A periodic curve has no ends.
    #[error(
        "a periodic curve has no ends that could be made exact: leave exact ends out, or choose a part of the curve"
    )]
    NoEnds,
    /// The caller cancelled the computation.
    #[error("cancelled")]
    Cancelled,
    /// The ends cannot be brought to the curve's.
    #[error(transparent)]
    Ends(#[from] CorrectionError),
    /// The vertices make no polygon.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
}

impl From<DistanceError> for ApproximationError {
    fn from(error: DistanceError) -> Self {
        match error {
            DistanceError::NoPoint { parameter } => Self::NoPoint { parameter },
            DistanceError::Cancelled => Self::Cancelled,
        }
    }
}
