//! What moving vertices does to the proved features of a planar curve: the region where a vertex may
//! go without adding any, and the shortest moves that lose one.
//!
//! Every place that is tried is proved; between those that are tried all of this is a guide.

mod feature_loss;
mod feature_rise;
mod move_prover;
mod ray;
mod safe_region;

pub use feature_loss::{FeatureLoss, LossSearch};
pub use feature_rise::FeatureRise;
pub use move_prover::{MoveError, MoveProver};
pub use ray::{PRECISION, reach};
pub use safe_region::{RayBorder, RegionSearch, SafeRegion};
