//! The items of a transformation: vertices, or a reference as a whole.

use glam::{DQuat, DVec2, DVec3};

use super::tool::{Context, move_edits};
use super::transformation::Transformation;
use crate::document::{CurveId, Edit};
use crate::editor::selection::VertexId;
use crate::editor::view::outline::Bounds;
use crate::editor::view::viewport::Viewport;
use crate::geometry::counted;
use crate::geometry::references::{Placement, ReferenceCurve, ReferenceError};

/// Hold the items of a transformation, as they were before.
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

    /// The middle of the items as they are seen, if there are any.
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
    pub fn label(&self, action: Transformation) -> String {
        let verb = match action {
            Transformation::Rotate(_) => "Rotate",
            Transformation::Scale(_) | Transformation::Stretch(..) => "Scale",
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
        action: Transformation,
        pivot: DVec2,
        viewport: &Viewport,
    ) -> Result<Vec<Edit>, ReferenceError> {
        let moved = self.vertices.iter();
        let moved = moved.map(|(id, vertex)| (*id, action.apply(pivot, *vertex, viewport)));
        let mut edits = move_edits(moved);
        if let Some((id, curve)) = &self.reference {
            let placement = placed(curve.placement(), action, pivot, viewport)?;
            edits.push(set_placement(*id, curve, placement));
        }
        Ok(edits)
    }
}

/// The edit that places a reference.
pub(super) fn set_placement(
    reference: CurveId,
    curve: &ReferenceCurve,
    placement: Placement,
) -> Edit {
    let curve = curve.clone().placed(placement);
    Edit::SetReference { reference, curve }
}

/// Transform a placement: it turns about the direction of the view, as vertices do in the view plane.
fn placed(
    before: &Placement,
    action: Transformation,
    pivot: DVec2,
    viewport: &Viewport,
) -> Result<Placement, ReferenceError> {
    match action {
        Transformation::Rotate(angle) => {
            let orientation = &viewport.orientation;
            let pivot = orientation.point_at(pivot, before.translation());
            let turn = DQuat::from_axis_angle(orientation.towards(), angle);
            before.rotated_about(pivot, turn)
        }
        Transformation::Scale(factor) | Transformation::Stretch(_, factor) => {
            before.scaled_about(viewport.grounded(pivot), factor)
        }
    }
}
