//! Why points have no fit.

use thiserror::Error;

use crate::geometry::error::PolygonError;

/// Why points have no fit.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FitError {
    /// There are too few points, or they all coincide.
    #[error(
        "{} too few for a curve of degree {degree}: at least {needed} points that differ from the one before are needed, or a lower degree",
        if *found == 1 { "1 point is".to_owned() } else { format!("{found} different points are") },
        needed = degree + 1
    )]
    TooFewPoints {
        /// The number of points that differ from the one before.
        found: usize,
        /// The degree, which needs one more.
        degree: usize,
    },
    /// There are too few vertices or points for the extrema.
    #[error(
        "{extrema} curvature extrema are too many for {count} {of}: the discrete curvature of a polygon has at most as many extrema as vertices less 4, so {needed} are needed"
    )]
    TooManyExtrema {
        /// The requested number of extrema.
        extrema: usize,
        /// The number of vertices or points.
        count: usize,
        /// Of which of them there are too few.
        of: &'static str,
        /// The least number that can hold them.
        needed: usize,
    },
    /// There are more vertices than points.
    #[error(
        "{count} vertices are too many for {points} points: give at most as many vertices as points"
    )]
    TooManyVertices {
        /// The requested number of vertices.
        count: usize,
        /// The number of points.
        points: usize,
    },
    /// The equations of the fit have no solution in doubles.
    #[error("these points determine no curve: ask for fewer vertices or a lower degree")]
    NotFound,
    /// The computation was ended early.
    #[error("the fit was cancelled")]
    Cancelled,
    /// The vertices make no polygon.
    #[error(transparent)]
    Polygon(#[from] PolygonError),
}
