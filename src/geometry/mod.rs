//! Curves as numbers: polygons, their conversions, evaluation, differential geometry and
//! corrections. Nothing in here knows of documents, files or windows, and nothing panics on
//! finite input.

pub mod approximation;
mod arc_length;
mod banded;
pub mod basis;
pub mod between;
mod bezier_matrix;
mod blend;
mod coefficient;
mod continuity;
mod contrast_edge;
mod control_polygon;
mod conversion;
mod crossing;
pub mod cubics;
mod curvature_levels;
mod cut;
mod differentiable;
pub mod distance;
mod end;
pub mod end_correction;
mod error;
mod error_free;
mod evaluation;
mod expansion;
pub mod expressions;
mod extent;
pub mod fairing;
pub mod features;
pub mod fitting;
mod float_polygon;
pub mod harmony;
mod intersection;
mod interval;
mod jet;
mod joint;
mod largest_curvature;
pub mod mineur_farin;
mod mirror;
mod nearest;
pub mod paper;
pub mod parameters;
mod parametric_curve;
mod pivoted_cholesky;
mod polygon_enclosure;
pub mod polygon_figures;
mod polygon_kind;
mod polyline;
mod power_of_two;
mod power_series;
mod progress;
mod quadrature;
mod rebuilding;
pub mod references;
mod rolling;
mod root;
mod sampled_cusps;
mod sampler;
mod segment_expansion;
mod spacing;
mod symmetry;
mod tables;
mod taylor_series;
mod vector;
pub mod vertex_moves;
mod whole_numbers;
mod wording;

pub use arc_length::arc_length_between;
pub use continuity::Continuity;
pub use contrast_edge::nearest_edge;
pub use control_polygon::{ControlPolygon, MAX_MAGNITUDE};
pub use conversion::{
    Amplification, Approximation, BezierPolygon, ClampedPolygon, ExactPolygon, MAX_ADDED_SEGMENTS,
    NearestFloat, Rounded, segment_bezier,
};
pub use crossing::{cross, curve_crossing, new_crossing};
pub use curvature_levels::{CurvatureLevels, LEVEL_ORDER, LEVELS};
pub use differentiable::Differentiable;
pub use end::{End, rotation_between};
pub use error::{MAX_DEGREE, PolygonError};
pub use extent::extent;
pub use float_polygon::FloatPolygon;
pub use intersection::Intersection;
pub use jet::Jet;
pub use joint::Joint;
pub use largest_curvature::largest_curvature;
pub use mirror::Mirror;
pub use nearest::Nearest;
pub use parametric_curve::{EvenBatch, ParametricCurve};
pub use polygon_figures::Range;
pub use polygon_kind::PolygonKind;
pub use polyline::{polyline_deviation, polyline_within};
pub use progress::Progress;
pub use rebuilding::{MAX_PART_SEGMENTS, MAX_SUBDIVISIONS};
pub use sampled_cusps::sampled_cusps;
pub use sampler::{BATCH_ORDER, Batch, Sampler};
pub use segment_expansion::SegmentExpansion;
pub use spacing::Spacing;
pub use symmetry::Symmetry;
pub use vector::{bounds, widen};
pub use wording::{
    SMALL, coordinate, counted, degrees_text, figure, noun, panic_message, percent, radius_of,
    rounded_up, significant, to_resolution,
};
