//! The view: viewport, layers, hovering, analyses, and the scene in model coordinates.

mod blocks;
mod chain_outlines;
pub(in crate::editor) mod comb;
pub(in crate::editor) mod curvature_display;
mod curve_outlines;
mod density;
mod deviations;
mod drawing;
pub(in crate::editor) mod end_marks;
mod evolute;
pub(in crate::editor) mod feature_report;
mod fitting;
pub(in crate::editor) mod grid;
mod guiding;
mod harmony;
pub(in crate::editor) mod hit;
mod hovering;
mod intersections;
mod joint_marks;
pub(in crate::editor) mod layers;
mod look;
mod named_view;
mod orientation;
pub(in crate::editor) mod osculating_circle;
pub(in crate::editor) mod outline;
mod outlines;
pub(in crate::editor) mod overlay;
mod pane;
mod pane_layout;
mod panes;
mod picture_edges;
pub(in crate::editor) mod plane_lines;
mod plot_chain;
mod plot_marks;
mod plot_scene;
mod plotting;
pub(in crate::editor) mod rulers;
mod sample_chain;
pub(in crate::editor) mod scene;
pub(in crate::editor) mod shown;
pub(in crate::editor) mod sight;
mod sleeve;
#[allow(clippy::module_inception)]
mod view;
pub(in crate::editor) mod viewport;
mod whiskers;

pub use chain_outlines::ChainOutlines;
pub use comb::{CombSettings, CombsOf};
pub use curvature_display::CurvatureDisplay;
pub use curve_outlines::{CurveOutlines, PieceTrend};
pub use end_marks::EndFitMarks;
pub use evolute::EvoluteCrowd;
pub use feature_report::{FeatureKind, FeatureMark, FeatureReport, FeatureRow};
pub use grid::{GroundGrid, grid_steps, ground_grid};
pub use hit::REACH;
pub use layers::{Layer, LayerRow, LayerSample, Layers};
pub use look::Look;
pub use named_view::{NamedView, view_name};
pub use orientation::Orientation;
pub use outline::{Bounds, GAP, ViewBox};
pub use pane_layout::PaneLayout;
pub use panes::PaneView;
pub use plot_scene::{PlotBand, PlotKind, PlotScene};
pub use rulers::RULER;
pub use scene::{
    ClampedMark, CurveScene, DragReadout, GuideLabel, GuideScene, HoverScene, Legs, LossArrow,
    Mark, MeasuredFigure, PictureScene, Scene, VertexMark,
};
pub use sight::Sight;
pub(in crate::editor) use view::Framing;
pub use view::View;
pub use viewport::Viewport;
pub use whiskers::Whiskers;
