//! Operations in progress: previewed, applied, and changed afterwards.

mod end_fit_step;
mod gestures;
mod handles;
mod in_progress;
mod operations;

pub(in crate::editor) use end_fit_step::EndFitStep;
pub use in_progress::{OperationInProgress, Run};
pub use operations::Operating;
pub(in crate::editor) use operations::Operations;
