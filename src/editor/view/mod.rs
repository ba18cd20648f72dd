//! What is seen: the viewport, the layers, what is hovered, and the scene in model coordinates.

mod drawing;
pub(in crate::editor) mod end_marks;
mod feature_report;
mod fitting;
pub(in crate::editor) mod grid;
pub(in crate::editor) mod hit;
pub(in crate::editor) mod layers;
pub(in crate::editor) mod orbit;
mod panels;
pub(in crate::editor) mod scene;
#[allow(clippy::module_inception)]
mod view;
pub(in crate::editor) mod viewport;

pub use end_marks::EndFitMarks;
pub use feature_report::{FeatureKind, FeatureMark, FeatureReport, FeatureRow};
pub use grid::grid_steps;
pub use hit::REACH;
pub use layers::{Layer, Layers};
pub use orbit::NamedView;
pub use scene::{CurveScene, HoverScene, Mark, PlotScene, Scene, VertexMark};
pub use view::View;
pub use viewport::Viewport;
