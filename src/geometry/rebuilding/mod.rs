//! The same curve by other polygons that keep its ends: of another degree, with more or fewer segments, or of a part.

mod degree_change;
mod kept_ends;
mod refitting;
mod splitting;

pub use splitting::{MAX_PART_SEGMENTS, MAX_SUBDIVISIONS};
