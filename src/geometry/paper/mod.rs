//! The mathematics of the figures and of Table 1 of *Techniques for modeling a high-quality B-spline curves
//! by S-polygons in a float format* (R. Ziatdinov et al.).

mod circle_comparison;
mod rounding_test;

pub use circle_comparison::{
    CircleComparison, PAPER_RADIUS, equal_leg_bezier, evolute_reach, paper_sides, regular_polygon,
};
pub use rounding_test::{RoundingTest, Shortening};
