//! Distances between curves, both ways: measured at samples, and bounded where curves are enclosed.

mod bound;
mod deviation;
mod error;
mod places;
mod side;
mod target;

pub use deviation::MeasuredDeviation;
pub use error::DistanceError;
pub(in crate::geometry) use places::places;
pub use side::{CurveSide, SideDeviation, Whisker};
