//! Rotations, scalings and movements, as they are dragged or typed.

use glam::{DVec2, DVec3};

use crate::editor::hand::drawing_plane::DrawingPlane;
use crate::editor::view::viewport::Viewport;

/// A transformation as it is dragged or typed, about a pivot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transformation {
    /// Turn by an angle in radians, counterclockwise as it is seen.
    Rotate(f64),
    /// Scale by a factor, in all directions.
    Scale(f64),
    /// Scale by a factor along one axis (0 or 1) of the plane that is drawn in.
    Stretch(usize, f64),
    /// Move, wherever the pivot is.
    Move(DVec3),
}

impl Transformation {
    /// Carry one vertex along, about a pivot of the view plane: turned in the view plane, or
    /// scaled about the pivot's place on the ground.
    pub fn apply(self, pivot: DVec2, vertex: DVec3, viewport: &Viewport) -> DVec3 {
        match self {
            Self::Rotate(angle) => {
                let arm = viewport.flatten(vertex) - pivot;
                let turned = pivot + DVec2::from_angle(angle).rotate(arm);
                viewport.orientation.point_at(turned, vertex)
            }
            Self::Scale(factor) => {
                let pivot = viewport.grounded(pivot);
                pivot + factor * (vertex - pivot)
            }
            Self::Stretch(axis, factor) => {
                let direction = DrawingPlane::of(viewport).axis(axis);
                let along = direction.dot(vertex - viewport.grounded(pivot));
                vertex + (factor - 1.0) * along * direction
            }
            Self::Move(by) => vertex + by,
        }
    }
}
