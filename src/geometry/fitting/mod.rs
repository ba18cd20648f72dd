//! Fits of planar float polygons to points with a wished number of curvature extrema.
//!
//! The numerator of the curvature's slope is a polynomial on each segment. Conditions on the signs of its
//! Bernstein coefficients, with as many changes as there are extrema, make each solution its own proof
//! (Descartes' rule). The signs come from the best piecewise monotone sequence near the curvature of a
//! smoothed curve; sequential quadratic programming with a banded interior point method finds the vertices;
//! fits with few vertices begin those with many.

mod banded_rows;
mod conditions;
mod counted_points;
mod descent;
mod error;
mod estimate;
mod first_places;
mod fit;
mod interior_point;
mod levels;
mod monotone_runs;
mod neighbours;
mod plane_fit;
mod prepared;
mod problem;
mod refit;
mod sharp_bend;
mod sign_runs;
mod slope_coefficients;
mod splines;
mod symmetry_axis;
mod trend;
mod winding;

pub use counted_points::{CountedPoints, is_closed};
pub use error::FitError;
pub use fit::{Fitted, TradeOff, Uncrossed, fit_plane, fit_plane_corrected};
pub(super) use monotone_runs::best_runs;
pub use neighbours::corners;
pub(super) use neighbours::with_middles;
pub use plane_fit::{Extrema, PlaneFit};
pub(super) use refit::{Refit, refit};
pub use sharp_bend::SharpBend;
pub use symmetry_axis::SymmetryAxis;
