//! Segments with monotone curvature between two points with directions, and with curvatures if they
//! are given.
//!
//! Place, size and side are taken away first: what is left of two ends are two angles. A kind's solver
//! finds the true segment, as reference curves; the float polygon then quasi-interpolates it, its
//! ends are made exact, and its curvature is proved to be monotone.

mod clothoid;
mod ends;
mod error;
mod existence;
mod growth;
mod harmonised;
mod log_aesthetic;
mod pair;
mod parts;
mod polygon;
mod segment;
mod solving;
mod superspiral;

pub use ends::Ends;
pub use error::BetweenError;
pub use parts::Part;
pub use segment::{Segment, SegmentKind, between};
