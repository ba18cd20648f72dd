//! What is known of a curve besides its polygon: samples, features, outlines and plots as plain
//! series. Kept up to date segment by segment; nothing in here draws.

mod bins;
mod cache;
mod chain_outlines;
mod comb;
mod curvature_series;
mod curve_analysis;
mod curve_outlines;
mod curve_samples;
mod discrete_curvature;
mod evolute;
mod feature_proof;
mod level_series;
mod orientation;
mod outline;
mod revision;
mod sample;
mod sample_chain;
mod vertex_chain;

pub use cache::AnalysisCache;
pub use chain_outlines::ChainOutlines;
pub use comb::CombSettings;
pub use curvature_series::CurvatureSeries;
pub use curve_analysis::CurveAnalysis;
pub use curve_outlines::{CurveOutlines, PieceTrend};
pub use curve_samples::{CurveSamples, SampledCurve};
pub use feature_proof::{FeatureProof, ProofResult};
pub use level_series::{LevelPlot, LevelSeries};
pub use orientation::Orientation;
pub use outline::{Bounds, GAP, ViewBox};
pub use revision::Revision;
pub use sample::Sample;
pub use vertex_chain::{ChainFigures, VertexChain};
