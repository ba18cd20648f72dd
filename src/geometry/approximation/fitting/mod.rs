//! Float polygons through the middle of points in space: least squares with a fairness weight.

mod fit;
mod point_list;
mod smoothing;
mod vertex_count;

pub use crate::geometry::fitting::FitError;
pub use fit::{FitRequest, Fitted, fit_points};
