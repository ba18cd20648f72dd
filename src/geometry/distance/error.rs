//! Why no distance is measured.

use thiserror::Error;

/// Why the distance between two curves is not measured.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DistanceError {
    /// The curve has no point somewhere.
    #[error(
        "the curve has no point at parameter {parameter}: choose a part of the curve without this place"
    )]
    NoPoint {
        /// The parameter.
        parameter: f64,
    },
    /// The caller cancelled the computation.
    #[error("cancelled")]
    Cancelled,
}
