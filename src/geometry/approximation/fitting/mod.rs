//! Float polygons through the middle of points: least squares with a fairness weight.

mod error;
mod fit;
mod outliers;
mod point_list;
mod smoothing;
mod vertex_count;

pub use error::FitError;
pub use fit::{FitRequest, Fitted, fit_points};
