//! Curvature and torsion levels by Taylor arithmetic.

pub(in crate::geometry) mod curvature_levels;
pub(in crate::geometry) mod segment_expansion;
pub(in crate::geometry) mod taylor_series;

pub use curvature_levels::{CurvatureLevels, LEVEL_ORDER, LEVELS, logarithmic_point};
pub use segment_expansion::SegmentExpansion;
