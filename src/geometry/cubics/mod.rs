//! Chains of cubic Béziers along planar curves, and their features.

mod chain_features;
mod cubic;
mod fair_chain;

pub use chain_features::ChainFeatures;
pub use cubic::Cubic;
pub use fair_chain::fair_chain;
