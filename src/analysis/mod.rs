//! The analyses of curves and references: samples, features, harmony, distances, and plots as plain series.
//! A change updates only the segments that depend on it. Nothing in here draws or knows the view.

mod bins;
mod cache;
mod changed_segments;
mod close_series;
mod curve_analysis;
mod curve_samples;
mod deviation;
mod discrete_curvature;
mod feature_proof;
mod harmony_measurement;
mod item;
mod joints;
mod leaps;
mod level_series;
mod reference_analysis;
mod revision;
mod sample;
mod sampled_features;
mod vertex_chain;

pub use cache::AnalysisCache;
pub use curve_analysis::{CurveAnalysis, STRAIGHT};
pub use curve_samples::{Block, CurveSamples, SampledCurve};
pub use deviation::Deviation;
pub use discrete_curvature::LengthCursor;
pub use feature_proof::{FeatureProof, ProofResult};
pub use harmony_measurement::{HarmonyMeasurement, MeasuredHarmony};
pub use item::Item;
pub use joints::{CurveJoint, Joints};
pub use leaps::mark_closer;
pub use level_series::{LevelPlot, LevelSeries};
pub use reference_analysis::ReferenceAnalysis;
pub use revision::Revision;
pub use sample::{PieceSampler, Sample};
pub use sampled_features::{SampledFeature, SampledKind};
pub use vertex_chain::{ChainFigures, Flow, VertexChain};
