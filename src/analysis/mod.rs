//! What is shown of a curve: samples, comb, evolute and plots as plain series. Kept up to date
//! segment by segment; nothing in here draws.

mod cache;
mod comb;
mod curve_analysis;
mod curve_features;
mod level_series;
mod orientation;
mod outline;
mod plot_series;
mod sample;
mod vertex_chain;

pub use cache::AnalysisCache;
pub use comb::CombSettings;
pub use curve_analysis::CurveAnalysis;
pub use curve_features::{FeatureProof, PieceTrend};
pub use level_series::LevelPlot;
pub use orientation::Orientation;
pub use outline::{Bounds, GAP, ViewBox};
pub use sample::Sample;
pub use vertex_chain::{ChainFigures, VertexChain};
