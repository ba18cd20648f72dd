//! The geometry of a curve.

use glam::DVec3;

use crate::io::exchange::drawing::Shape;

/// The geometry of a curve.
pub enum Form {
    /// A line without ends: parameter u is at point + u · step.
    Line {
        /// Where u is 0.
        point: DVec3,
        /// The way from 0 to 1.
        step: DVec3,
    },
    /// Pieces in order: one, but for composite curves.
    Shapes(Vec<Shape>),
}
