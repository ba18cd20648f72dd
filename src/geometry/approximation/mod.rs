//! Float polygons near curves that are no float polygons, or of another degree.

mod deviation;
mod error;
mod knots;
mod placing;

pub use deviation::MeasuredDeviation;
pub use error::ApproximationError;
pub use knots::UniformKnots;
pub use placing::{Placing, float_polygon};
