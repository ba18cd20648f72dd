//! The items of a transformation: vertices, or curves and references as a whole.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DQuat, DVec2, DVec3};

use super::tool::{Context, move_edits};
use super::transformation::Transformation;
use crate::document::{CurveId, Edit};
use crate::editor::selection::VertexId;
use crate::editor::view::outline::Bounds;
use crate::editor::view::viewport::Viewport;
use crate::geometry::references::{Placement, ReferenceCurve, ReferenceError};
use crate::geometry::{ParametricCurve, counted, extent};
use crate::io::counted_items;

/// What moves without changing its shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// A vertex of its own.
    Vertex(VertexId),
    /// A curve or a reference.
    Item(CurveId),
}

/// Hold the items of a transformation, as they were before.
#[derive(Clone, Debug)]
pub struct Transformed {
    vertices: Vec<(VertexId, DVec3)>,
    references: Vec<(CurveId, ReferenceCurve)>,
    /// Whether several curves and references are taken as a whole.
    are_items: bool,
}

impl Transformed {
    /// Take the selected vertices, otherwise the selected references and the vertices of the selected curves; without
    /// what is locked or hidden.
    pub fn of(context: &Context) -> Self {
        let selection = context.selection;
        let items = match selection.is_empty() {
            true => selection.items(),
            false => Vec::new(),
        };
        let references = items.into_iter().filter_map(|id| {
            let reference = context.before.reference(id)?;
            reference.check_editable().ok()?;
            Some((id, reference.curve.clone()))
        });
        Self {
            vertices: context.transformed(),
            references: references.collect(),
            are_items: selection.is_of_whole_items(),
        }
    }

    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty() && self.references.is_empty()
    }

    /// Whether a vertex of a curve, or a reference, is among the items.
    pub(super) fn holds(&self, id: CurveId) -> bool {
        let mut curves = self.vertices.iter().map(|((curve, _), _)| *curve);
        curves.any(|curve| curve == id) || self.references.iter().any(|(it, _)| *it == id)
    }

    /// The vertices.
    pub(super) fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.vertices.iter().map(|(id, _)| *id)
    }

    /// Whether it can be scaled along one axis: a reference keeps its shape.
    pub fn can_stretch(&self) -> bool {
        self.references.is_empty()
    }

    /// The items that keep their shape: each vertex, or each curve and reference.
    pub fn parts(&self) -> Vec<Part> {
        let mut parts: Vec<Part> = self.vertices().map(|vertex| self.part(vertex)).collect();
        parts.dedup();
        parts.extend(self.references.iter().map(|(id, _)| Part::Item(*id)));
        parts
    }

    fn part(&self, vertex: VertexId) -> Part {
        match self.are_items {
            true => Part::Item(vertex.0),
            false => Part::Vertex(vertex),
        }
    }

    /// How far each part reaches along a direction.
    pub(super) fn extents(&self, direction: DVec3, context: &Context) -> Vec<[f64; 2]> {
        let places: BTreeMap<VertexId, DVec3> = self.vertices.iter().copied().collect();
        let reach = |part: &Part| match part {
            Part::Vertex(vertex) => places.get(vertex).map(|at| [direction.dot(*at); 2]),
            Part::Item(id) => match (context.before.curve(*id), context.before.reference(*id)) {
                (Some(curve), _) => Some(extent(&curve.polygon, direction)),
                (_, reference) => reference.map(|it| extent(&it.curve, direction)),
            },
        };
        let parts = self.parts();
        parts
            .iter()
            .map(|it| reach(it).unwrap_or_default())
            .collect()
    }

    /// The edits that take each part to a place: `to` tells it of each vertex or origin of a part.
    ///
    /// # Errors
    /// [`ReferenceError`] if a reference cannot be placed so.
    pub(super) fn placed_by(
        &self,
        to: impl Fn(Part, DVec3) -> DVec3,
    ) -> Result<Vec<Edit>, ReferenceError> {
        let vertices = self.vertices.iter();
        let mut edits = move_edits(vertices.map(|(id, at)| (*id, to(self.part(*id), *at))));
        for (id, curve) in &self.references {
            let now = curve.placement();
            let to = to(Part::Item(*id), now.translation());
            let placement = Placement::new(now.rotation(), now.scale(), to)?;
            edits.push(set_placement(*id, curve, placement));
        }
        Ok(edits)
    }

    /// The middle of the items as they are seen, if there are any.
    pub fn middle(&self, context: &Context) -> Option<DVec2> {
        let mut bounds = Bounds::EMPTY;
        let mut whole: BTreeSet<CurveId> = self.references.iter().map(|(id, _)| *id).collect();
        // A curve as a whole is where it is drawn, however far its polygon reaches.
        if context.selection.is_empty() {
            whole.extend(self.vertices().map(|(curve, _)| curve));
        }
        for ((curve, _), vertex) in &self.vertices {
            if !whole.contains(curve) {
                bounds.add(context.viewport.flatten(*vertex));
            }
        }
        for id in whole {
            if let Some(outlines) = context.hits.view.pane.outlines.get(id) {
                bounds = bounds.united(outlines.curve.bounds());
            }
        }
        (!bounds.is_empty()).then(|| 0.5 * (bounds.low + bounds.high))
    }

    /// Name the items: how many vertices, or curves and references.
    pub(super) fn noun(&self) -> String {
        let curves: BTreeSet<CurveId> = self.vertices().map(|(curve, _)| curve).collect();
        match (self.are_items, self.references.is_empty()) {
            (true, _) => counted_items(curves.len(), self.references.len()),
            (false, true) => counted(self.vertices.len(), "vertex", "vertices"),
            (false, false) => "reference".to_owned(),
        }
    }

    /// Name the step of undo that does something to the items.
    pub(super) fn label(&self, verb: &str) -> String {
        format!("{verb} {}", self.noun())
    }

    /// Name the step of undo that a transformation of it is.
    pub fn label_of(&self, action: Transformation) -> String {
        self.label(match action {
            Transformation::Rotate(_) => "Rotate",
            Transformation::Scale(_) | Transformation::Stretch(..) => "Scale",
            Transformation::Move(_) => "Move",
        })
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
        for (id, curve) in &self.references {
            let placement = placed(curve.placement(), action, pivot, viewport)?;
            edits.push(set_placement(*id, curve, placement));
        }
        Ok(edits)
    }

    /// The edits that move it: `by` is the movement of what lies in the plane z = 0, and of what does not, and `add`
    /// adds it to a place.
    ///
    /// # Errors
    /// [`ReferenceError`] if a reference cannot be placed so.
    pub(super) fn moved(
        &self,
        by: impl Fn(bool) -> DVec3,
        add: impl Fn(DVec3, DVec3) -> DVec3,
        context: &Context,
    ) -> Result<Vec<Edit>, ReferenceError> {
        let planar = context.planar_curves(&self.vertices);
        let vertices = self.vertices.iter();
        let moved = vertices.map(|(id, at)| (*id, add(*at, by(planar.contains(&id.0)))));
        let mut edits = move_edits(moved);
        for (id, curve) in &self.references {
            let now = curve.placement();
            let to = add(now.translation(), by(curve.is_planar()));
            let placement = Placement::new(now.rotation(), now.scale(), to)?;
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
        Transformation::Move(by) => {
            Placement::new(before.rotation(), before.scale(), before.translation() + by)
        }
    }
}
