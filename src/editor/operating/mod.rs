//! Operations in progress: previewed, applied, and changed afterwards.

mod end_fit_step;
mod fitted_points;
mod gestures;
mod handles;
mod in_progress;
mod on_curve;
mod operations;
mod points_on_canvas;

pub(in crate::editor) use end_fit_step::EndFitStep;
pub use fitted_points::FittedPoints;
pub use in_progress::{OperationInProgress, OtherResult, Run};
pub use operations::Operating;
pub(in crate::editor) use operations::Operations;
