//! From one polygon of a curve to another, exactly or with a bound of the error: conversions between
//! knots, degrees, subdivision, parts, extension, rounding.

pub(in crate::geometry) mod amplification;
pub(in crate::geometry) mod approximation;
pub(in crate::geometry) mod bezier_polygon;
pub(in crate::geometry) mod chain_deviation;
pub(in crate::geometry) mod chain_fit;
pub(in crate::geometry) mod clamped_editing;
pub(in crate::geometry) mod clamped_polygon;
pub(in crate::geometry) mod closing;
pub(in crate::geometry) mod deviation;
pub(in crate::geometry) mod end_conversion;
pub(in crate::geometry) mod exact_polygon;
pub(in crate::geometry) mod exact_vertices;
pub(in crate::geometry) mod extension;
pub(in crate::geometry) mod knots;
pub(in crate::geometry) mod nearest_float;
pub(in crate::geometry) mod quasi_interpolation;
pub(in crate::geometry) mod rounding;
pub(in crate::geometry) mod subdivision;
pub(in crate::geometry) mod whole_vertices;

pub use amplification::Amplification;
pub use approximation::Approximation;
pub use bezier_polygon::{BezierPolygon, segment_bezier};
pub use clamped_polygon::ClampedPolygon;
pub use exact_polygon::ExactPolygon;
pub use extension::MAX_ADDED_SEGMENTS;
pub use nearest_float::NearestFloat;
pub use rounding::Rounded;
pub(in crate::geometry) use rounding::{cut_off, rounded_off};
