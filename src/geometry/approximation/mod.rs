//! Float polygons near curves that are no float polygons, or of another degree.

mod approximating;
mod blending;
mod closing;
mod equivalence;
mod error;
mod fitting;
mod knots;
pub mod merging;
mod placing;
mod spacing;
mod watched;

pub use approximating::{
    Approximated, ApproximationRequest, Goal, MOST_FOR_SHAPE, MOST_SEGMENTS, approximate_between,
    approximate_by_steps, approximate_to_tolerance,
};
pub use blending::blend;
pub use closing::{SMALL_GAP, close_halves, close_within};
pub use equivalence::{LevelComparison, LevelFeature, SideBySide};
pub use error::ApproximationError;
pub use fitting::{FitError, FitRequest, Fitted, fit_points};
pub use knots::UniformKnots;
pub use placing::{Corrections, Placing, float_polygon};
pub use spacing::{Respaced, Spacing};
pub use watched::Watched;
