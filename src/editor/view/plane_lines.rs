//! Planes that are seen from their edge, as lines: the axes of the active curve, and guides.

use glam::{DVec2, DVec3};

use super::layers::Layer;
use super::scene::Mark;
use super::sight::Sight;
use super::viewport::Viewport;
use crate::document::{Curve, CurveId};

/// A plane is seen from its edge if its normal is turned towards the eye by less than this sine.
const EDGE_ON: f64 = 1e-9;

/// How near to a line the pointer must be to take it, in screen points.
const REACH: f64 = 4.0;

/// The owner of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LineOf {
    /// A curve that stays symmetric about it.
    Symmetry(CurveId),
    /// A guide, by its place among the document's.
    Guide(usize),
}

/// A plane that is seen as a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneLine {
    /// A point of the plane, and its normal, of length 1.
    pub plane: [DVec3; 2],
    /// A point of the line in the view plane.
    pub through: DVec2,
    /// Its direction there, of length 1.
    pub along: DVec2,
}

impl PlaneLine {
    /// See a plane as a line; `None` where it is not seen from its edge.
    pub fn seen(plane: [DVec3; 2], viewport: &Viewport) -> Option<Self> {
        let [through, normal] = plane;
        let orientation = &viewport.orientation;
        let is_edge_on = normal.dot(orientation.towards()).abs() <= EDGE_ON;
        let across = orientation.flatten(normal).try_normalize()?;
        is_edge_on.then(|| Self {
            plane,
            through: orientation.flatten(through),
            along: across.perp(),
        })
    }

    /// The foot of a place of the view plane on the line.
    pub fn foot(&self, place: DVec2) -> DVec2 {
        self.through + (place - self.through).dot(self.along) * self.along
    }

    /// The line across all that is seen.
    pub fn across(&self, viewport: &Viewport) -> [DVec2; 2] {
        let seen = viewport.view_box();
        let reach = seen.low.distance(seen.high);
        let foot = self.foot(0.5 * (seen.low + seen.high));
        [foot - reach * self.along, foot + reach * self.along]
    }
}

impl<'a> Sight<'a> {
    /// The axes of the active curve, and the guides if they are shown.
    fn plane_lines(self) -> impl Iterator<Item = (LineOf, PlaneLine)> + use<'a> {
        let active = self.active();
        let curve = active.and_then(|id| Some((id, self.document().curve(id)?)));
        let curve = curve.filter(|(_, curve)| curve.visible);
        let axes = curve.into_iter().flat_map(move |(id, curve)| {
            let axes = symmetry_axes(curve, self.viewport());
            axes.map(move |line| (LineOf::Symmetry(id), line))
        });
        let guides = self.layers().shows(Layer::Guides).then_some(self);
        let guides = guides.into_iter().flat_map(Sight::guide_lines);
        axes.chain(guides)
    }

    fn guide_lines(self) -> impl Iterator<Item = (LineOf, PlaneLine)> + use<'a> {
        let guides = self.document().guide_lines().iter().enumerate();
        guides.filter_map(move |(index, guide)| {
            let line = PlaneLine::seen(guide.plane(), self.viewport())?;
            Some((LineOf::Guide(index), line))
        })
    }

    /// The lines, across all that is seen.
    pub(super) fn line_marks(self) -> impl Iterator<Item = Mark> + use<'a> {
        self.plane_lines().map(move |(of, line)| {
            let ends = line.across(self.viewport());
            match of {
                LineOf::Symmetry(_) => Mark::SymmetryAxis(ends),
                LineOf::Guide(_) => Mark::GuideLine(ends),
            }
        })
    }

    /// Find the line under a place on the canvas.
    pub(in crate::editor) fn plane_line(self, place: DVec2) -> Option<(LineOf, PlaneLine)> {
        let model = self.viewport().to_model(place);
        let off = |line: &PlaneLine| line.foot(model).distance(model);
        let lines = self.plane_lines();
        let nearest = lines.min_by(|(_, a), (_, b)| off(a).total_cmp(&off(b)))?;
        (off(&nearest.1) <= REACH * self.viewport().pixel()).then_some(nearest)
    }
}

/// The axes of a curve that a viewport shows as lines.
pub fn symmetry_axes(
    curve: &Curve,
    viewport: &Viewport,
) -> impl Iterator<Item = PlaneLine> + use<> {
    let planes = curve.symmetry.into_iter().flat_map(|it| it.planes());
    let viewport = *viewport;
    planes.filter_map(move |plane| PlaneLine::seen(plane, &viewport))
}
