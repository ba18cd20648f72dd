//! A rectangle that holds a picture.

use glam::{DVec2, DVec3};

use super::error::ReferenceError;
use super::point_list::PointList;

/// Hold a rectangle from the origin to its size, with its outline: corners counter-clockwise, the first one twice.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    outline: PointList,
}

impl Frame {
    /// Make a rectangle of this width and height.
    ///
    /// # Errors
    /// [`ReferenceError::BadPoint`] if a side is not finite, [`ReferenceError::OnePoint`] if one is not above 0.
    pub fn new(size: DVec2) -> Result<Self, ReferenceError> {
        if size.min_element() <= 0.0 {
            return Err(ReferenceError::OnePoint);
        }
        let [across, up] = [size.x * DVec3::X, size.y * DVec3::Y];
        let corners = [DVec3::ZERO, across, across + up, up, DVec3::ZERO];
        let outline = PointList::new(corners.to_vec())?;
        Ok(Self { outline })
    }

    /// The width and the height.
    pub fn size(&self) -> DVec2 {
        let opposite = self.outline.points().get(2);
        opposite.map_or(DVec2::ONE, |corner| corner.truncate())
    }

    /// The corners counter-clockwise, the first one twice.
    pub fn corners(&self) -> &[DVec3] {
        self.outline.points()
    }

    /// The outline as a closed row of points.
    pub(super) fn outline(&self) -> &PointList {
        &self.outline
    }
}
