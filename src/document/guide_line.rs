//! Guide lines, to which dragged points snap.

use glam::DVec3;

use super::document::Document;

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

impl Document {
    /// Replace the guide lines. Two at one place count as one; those that are no planes are left out.
    #[must_use]
    pub fn with_guide_lines(mut self, lines: impl IntoIterator<Item = GuideLine>) -> Self {
        self.set_guide_lines(lines);
        self
    }

    /// The guide lines, in the order in which they were placed.
    pub fn guide_lines(&self) -> &[GuideLine] {
        &self.guide_lines
    }

    pub(super) fn set_guide_lines(&mut self, lines: impl IntoIterator<Item = GuideLine>) {
        self.guide_lines.clear();
        for line in lines.into_iter().filter(|it| it.is_usable()) {
            if !self.guide_lines.contains(&line) {
                self.guide_lines.push(line);
            }
        }
    }
}
