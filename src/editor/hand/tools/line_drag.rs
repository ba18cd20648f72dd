//! Dragging lines across themselves: guides, new ones from the rulers, and axes of symmetry with their curves.

use glam::DVec2;

use super::tool::{Context, Effect};
use crate::document::{CurveId, Edit, GuideLine};
use crate::editor::hand::snapping::{Carried, Snap};
use crate::editor::view::plane_lines::{LineOf, PlaneLine};
use crate::editor::view::rulers;
use crate::editor::view::scene::{Mark, MeasuredFigure};

/// A drag of a line.
#[derive(Debug)]
pub struct LineDrag {
    /// A new guide is one behind the document's.
    of: LineOf,
    line: PlaneLine,
    /// Where the pointer began, in the view plane.
    origin: DVec2,
    snap: Option<Snap>,
    /// Where the line goes; `None` for a guide that is let go.
    to: Option<DVec2>,
}

impl LineDrag {
    /// Begin to drag the line under a place on the canvas.
    pub fn on_canvas(place: DVec2, context: &Context) -> Option<(Self, Effect)> {
        let (of, line) = context.hits.plane_line(place)?;
        let label = match of {
            LineOf::Symmetry(_) => "Move axis",
            LineOf::Guide(_) => "Move guide",
        };
        Some(Self::begin(of, line, place, label, context))
    }

    /// Begin to drag a new guide from the ruler at a place on the canvas.
    pub fn from_ruler(place: DVec2, context: &Context) -> Option<(Self, Effect)> {
        let guide = rulers::guide_at(place, context.viewport)?;
        let line = PlaneLine::seen(guide.plane(), context.viewport)?;
        let of = LineOf::Guide(context.before.guide_lines().len());
        Some(Self::begin(of, line, place, "Place guide", context))
    }

    fn begin(
        of: LineOf,
        line: PlaneLine,
        place: DVec2,
        label: &str,
        context: &Context,
    ) -> (Self, Effect) {
        let drag = Self {
            of,
            line,
            origin: context.model(place),
            snap: None,
            to: None,
        };
        (drag, Effect::Begin(label.to_owned()))
    }

    /// Go on with the pointer at a place on the canvas.
    pub fn drag(&mut self, place: DVec2, context: &Context) -> Effect {
        let pointer = context.model(place);
        let along = self.line.along;
        // The line keeps its distance from the pointer.
        let grip = self.line.foot(self.origin) - self.origin;
        let free = pointer + grip;
        self.snap = context.line_snap(free, along, &self.carried());
        let snapped = self.snap.as_ref();
        let to = snapped.map_or(free, |snap| context.viewport.flatten(snap.point));
        match self.of {
            LineOf::Symmetry(curve) => {
                self.to = Some(to);
                self.move_curve(curve, to, context)
            }
            LineOf::Guide(index) => {
                let is_let_go = rulers::is_off(place, context.viewport);
                self.snap = self.snap.take().filter(|_| !is_let_go);
                self.to = (!is_let_go).then_some(to);
                self.move_guide(index, context)
            }
        }
    }

    fn move_guide(&self, index: usize, context: &Context) -> Effect {
        let before = context.before.guide_lines();
        let others = before.iter().enumerate().filter(|(it, _)| *it != index);
        let mut guides: Vec<GuideLine> = others.map(|(_, it)| *it).collect();
        if let Some((axis, at)) = self.coordinate(context) {
            guides.insert(index.min(guides.len()), GuideLine { axis, at });
        }
        Effect::Preview(vec![Edit::SetGuideLines(guides)])
    }

    /// Move a curve so that its axis passes a place of the view plane.
    fn move_curve(&self, id: CurveId, to: DVec2, context: &Context) -> Effect {
        let Some(curve) = context.before.curve(id) else {
            return Effect::Preview(Vec::new());
        };
        let by = context.viewport.orientation.lift(to - self.line.foot(to));
        let vertices = curve.polygon.vertices().iter().enumerate();
        let moves = vertices.map(|(index, vertex)| (index, *vertex + by));
        Effect::Preview(vec![Edit::MoveVertices {
            curve: id,
            moves: moves.collect(),
        }])
    }

    fn carried(&self) -> Carried {
        match self.of {
            LineOf::Symmetry(id) => Carried {
                item: Some(id),
                ..Carried::default()
            },
            LineOf::Guide(index) => Carried {
                guide: Some(index),
                ..Carried::default()
            },
        }
    }

    /// The coordinate that is the same all along the line, if it lies along an axis of the model, and its value.
    fn coordinate(&self, context: &Context) -> Option<(usize, f64)> {
        let normal = self.line.plane[1].abs().to_array();
        let axis = normal.iter().position(|it| *it == 1.0)?;
        let point = context.viewport.orientation.lift(self.to?);
        Some((axis, point[axis]))
    }

    /// What the mouse does meanwhile.
    pub fn hint(&self, context: &Context) -> String {
        let what = match self.of {
            LineOf::Symmetry(_) => "Moving the curve by its axis",
            LineOf::Guide(_) => "Moving the guide: drop it on a ruler to remove it",
        };
        let snapping = if context.snapping { "off" } else { "on" };
        format!("{what}; Ctrl turns snapping {snapping}, Esc cancels")
    }

    /// The marks of the drag: the place of the line, and its snap.
    pub fn marks(&self, context: &Context) -> Vec<Mark> {
        let Some(at) = context.pointer else {
            return Vec::new();
        };
        let lines = self.snap.iter().flat_map(Snap::line_marks);
        let name = self.snap.as_ref();
        let name = name.map(|snap| Mark::Name(at, snap.name.clone()));
        let figure = self
            .coordinate(context)
            .map(|(axis, value)| MeasuredFigure {
                name: GuideLine { axis, at: value }.coordinate(),
                values: vec![value],
                is_angle: false,
                is_about: false,
            });
        let figure = figure.map(|figure| Mark::Measured(at, vec![figure]));
        lines.chain(name).chain(figure).collect()
    }
}
