//! Guide lines, to which dragged points snap.

use glam::DVec3;

/// The plane where one coordinate of the model has a value: a line in each view along the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuideLine {
    /// The coordinate: 0 x, 1 y, 2 z.
    pub axis: usize,
    /// Its value, in the document's unit.
    pub at: f64,
}

impl GuideLine {
    /// The name of the coordinate.
    pub fn coordinate(self) -> &'static str {
        ["x", "y", "z"].get(self.axis).copied().unwrap_or_default()
    }

    /// A point of the plane, and its normal.
    pub fn plane(self) -> [DVec3; 2] {
        let normal = DVec3::AXES.get(self.axis).copied().unwrap_or(DVec3::X);
        [self.at * normal, normal]
    }

    /// Whether it is a plane at all.
    pub(super) fn is_usable(self) -> bool {
        self.axis < DVec3::AXES.len() && self.at.is_finite()
    }
}
