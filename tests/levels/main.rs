//! Levels of curvature and torsion: against values of 50 and more digits, and their properties.

#[path = "../common/mod.rs"]
mod common;

mod properties;
mod values;
