//! Mineur–Farin configurations (paper, section 4): control polygons whose legs grow by a fixed ratio
//! and turn by a fixed angle, and where in the plane of both the curvature is monotone.

mod atlas;
mod configuration;

pub use atlas::{ATLAS_SIZE, Atlas, AtlasSearch, AtlasVerdicts};
pub use configuration::{Configuration, Format};
