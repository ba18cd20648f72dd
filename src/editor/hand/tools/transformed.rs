//! What a transformation takes: vertices, or a reference as a whole.

use glam::{DQuat, DVec2, DVec3};

use super::tool::{Context, move_edits};
use crate::document::{CurveId, Edit};
use crate::editor::hand::drawing_plane::DrawingPlane;
use crate::editor::selection::VertexId;
use crate::editor::view::outline::Bounds;
use crate::editor::view::viewport::Viewport;
use crate::geometry::counted;
use crate::geometry::references::{Placement, ReferenceCurve, ReferenceError};

/// A transformation about a pivot, as it is dragged or typed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Turn by an angle in radians, counterclockwise as it is seen.
    Rotate(f64),
    /// Scale by a factor, in all directions.
    Scale(f64),
    /// Scale by a factor along one axis (0 or 1) of the plane that is drawn in.
    Stretch(usize, f64),
}

impl Action {
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
        }
    }
}

/// Hold what a transformation takes, as it was before.
#[derive(Clone, Debug)]
pub struct Transformed {
    vertices: Vec<(VertexId, DVec3)>,
    reference: Option<(CurveId, ReferenceCurve)>,
}

impl Transformed {
    /// Take the active reference, otherwise the selected vertices, otherwise those of the active curve; without
    /// what is locked or hidden.
    pub fn of(context: &Context) -> Self {
        let active = context.selection.active();
        let found = active.and_then(|id| Some((id, context.before.reference(id)?)));
        let reference = found.filter(|(_, reference)| reference.check_editable().is_ok());
        Self {
            vertices: context.transformed(),
            reference: reference.map(|(id, reference)| (id, reference.curve.clone())),
        }
    }

    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty() && self.reference.is_none()
    }

    /// Whether it can be scaled along one axis: a reference keeps its shape.
    pub fn can_stretch(&self) -> bool {
        self.reference.is_none()
    }

    /// The middle of what is taken as it is seen, if there is anything.
    pub fn middle(&self, context: &Context) -> Option<DVec2> {
        let mut bounds = Bounds::EMPTY;
        for (_, vertex) in &self.vertices {
            bounds.add(context.viewport.flatten(*vertex));
        }
        if let Some((id, _)) = &self.reference
            && let Some(outlines) = context.hits.view.outlines.get(*id)
        {
            bounds = outlines.curve.bounds();
        }
        (!bounds.is_empty()).then(|| 0.5 * (bounds.low + bounds.high))
    }

    /// Name the step of undo that a transformation of it is.
    pub fn label(&self, action: Action) -> String {
        let verb = match action {
            Action::Rotate(_) => "Rotate",
            Action::Scale(_) | Action::Stretch(..) => "Scale",
        };
        let noun = match self.reference {
            Some(_) => "reference".to_owned(),
            None => counted(self.vertices.len(), "vertex", "vertices"),
        };
        format!("{verb} {noun}")
    }

    /// The edits that transform it about a pivot of the view plane.
    ///
    /// # Errors
    /// [`ReferenceError`] if a reference cannot be placed so, as where the factor is not positive.
    pub fn edits(
        &self,
        action: Action,
        pivot: DVec2,
        viewport: &Viewport,
    ) -> Result<Vec<Edit>, ReferenceError> {
        let moved = self.vertices.iter();
        let moved = moved.map(|(id, vertex)| (*id, action.apply(pivot, *vertex, viewport)));
        let mut edits = move_edits(moved);
        if let Some((id, curve)) = &self.reference {
            let placement = placed(curve.placement(), action, pivot, viewport)?;
            edits.push(Edit::SetReference {
                reference: *id,
                curve: curve.clone().placed(placement),
            });
        }
        Ok(edits)
    }
}

/// Transform a placement: it turns about the direction of the view, as vertices do in the view plane.
fn placed(
    before: &Placement,
    action: Action,
    pivot: DVec2,
    viewport: &Viewport,
) -> Result<Placement, ReferenceError> {
    match action {
        Action::Rotate(angle) => {
            let orientation = &viewport.orientation;
            let pivot = orientation.point_at(pivot, before.translation());
            let turn = DQuat::from_axis_angle(orientation.towards(), angle);
            before.rotated_about(pivot, turn)
        }
        Action::Scale(factor) | Action::Stretch(_, factor) => {
            before.scaled_about(viewport.grounded(pivot), factor)
        }
    }
}
