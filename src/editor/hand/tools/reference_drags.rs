//! Moving, rotating and scaling the active reference on the canvas: its frame, and the drags of it.

use glam::{DQuat, DVec2, DVec3};

use super::move_drag::MoveDrag;
use super::tool::{Context, Effect};
use super::transformed::set_placement;
use crate::document::{CurveId, Document, Reference};
use crate::editor::hand::snapping::Carried;
use crate::editor::view::hit::{CurveHit, REACH};
use crate::editor::view::scene::{DragReadout, Mark};
use crate::geometry::references::{Placement, ReferenceError};
use crate::geometry::{ParametricCurve, degrees_text};

/// How far the frame stands off the reference, in screen points.
const MARGIN: f64 = 12.0;

/// How far above the frame the handle stands that rotates, in screen points.
const ARM: f64 = 28.0;

/// A frame smaller than this, in screen points, is drawn as large as this.
const SMALLEST: f64 = 24.0;

/// The frame around the active reference, as it is seen: a box in the view plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    low: DVec2,
    high: DVec2,
    /// Where the handle is that rotates.
    turn: DVec2,
}

/// What of a frame is under a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrameHandle {
    /// A corner, by the one opposite, about which it scales.
    Corner(DVec2),
    /// The handle that rotates about the middle.
    Turn,
}

/// A drag of a reference.
#[derive(Debug)]
pub struct ReferenceDrag {
    id: CurveId,
    kind: Kind,
    /// Its label beside the pointer.
    label: Option<(DVec2, String)>,
}

#[derive(Debug)]
enum Kind {
    /// The point of it that is held follows the pointer.
    Move {
        drag: MoveDrag,
        held: DVec2,
        planar: bool,
    },
    /// It turns about a point, about the direction of the view. The pointer began at `origin`.
    Rotate { pivot: DVec3, origin: DVec2 },
    /// It grows and shrinks about a point.
    Scale { pivot: DVec3, origin: DVec2 },
}

impl Frame {
    /// The frame of the active reference, if it can be changed and nothing else is selected.
    pub fn of(context: &Context) -> Option<Self> {
        let (id, _) = editable(context).filter(|_| !context.selection.has_several_items())?;
        let bounds = context.hits.view.pane.outlines.get(id)?.curve.bounds();
        if bounds.is_empty() {
            return None;
        }
        let pixel = context.viewport.pixel();
        let middle = 0.5 * (bounds.low + bounds.high);
        let half = (0.5 * (bounds.high - bounds.low) + MARGIN * pixel)
            .max(DVec2::splat(0.5 * SMALLEST * pixel));
        let (low, high) = (middle - half, middle + half);
        let turn = DVec2::new(middle.x, high.y + ARM * pixel);
        Some(Self { low, high, turn })
    }

    fn middle(&self) -> DVec2 {
        0.5 * (self.low + self.high)
    }

    /// The corners, in their order around the box.
    pub fn corners(&self) -> [DVec2; 4] {
        let Self { low, high, .. } = *self;
        [
            low,
            DVec2::new(high.x, low.y),
            high,
            DVec2::new(low.x, high.y),
        ]
    }

    /// Find the handle under a place on the canvas.
    pub fn handle(&self, place: DVec2, context: &Context) -> Option<FrameHandle> {
        let near = |at: DVec2| context.viewport.to_screen(at).distance(place) <= REACH;
        if near(self.turn) {
            return Some(FrameHandle::Turn);
        }
        let corners = self.corners();
        let index = corners.iter().position(|corner| near(*corner))?;
        let opposite = corners[(index + 2) % corners.len()];
        Some(FrameHandle::Corner(opposite))
    }

    /// The frame as it is drawn.
    pub fn mark(&self) -> Mark {
        let top = DVec2::new(self.turn.x, self.high.y);
        Mark::Frame {
            corners: self.corners(),
            arm: [top, self.turn],
        }
    }
}

impl ReferenceDrag {
    /// Begin to drag a handle of the frame.
    pub fn by_handle(
        handle: FrameHandle,
        frame: &Frame,
        place: DVec2,
        context: &Context,
    ) -> Option<(Self, Effect)> {
        let (id, reference) = editable(context)?;
        let like = reference.curve.placement().translation();
        let lifted = |at: DVec2| context.viewport.orientation.point_at(at, like);
        let origin = context.model(place);
        let (kind, label) = match handle {
            FrameHandle::Turn => {
                let pivot = lifted(frame.middle());
                (Kind::Rotate { pivot, origin }, "Rotate reference")
            }
            FrameHandle::Corner(opposite) => {
                let pivot = lifted(opposite);
                (Kind::Scale { pivot, origin }, "Scale reference")
            }
        };
        Some(Self::begin(id, kind, label))
    }

    /// Begin to drag a reference by a place on it.
    pub fn by_body(hit: CurveHit, place: DVec2, context: &Context) -> Option<(Self, Effect)> {
        let reference = context.document.reference(hit.curve)?;
        reference.check_editable().ok()?;
        let carried = Carried {
            item: Some(hit.curve),
            ..Carried::default()
        };
        let kind = Kind::Move {
            drag: MoveDrag::begin(place, hit.point, carried, context),
            held: hit.point,
            planar: reference.curve.is_planar(),
        };
        Some(Self::begin(hit.curve, kind, "Move reference"))
    }

    fn begin(id: CurveId, kind: Kind, label: &str) -> (Self, Effect) {
        let drag = Self {
            id,
            kind,
            label: None,
        };
        (drag, Effect::Begin(label.to_owned()))
    }

    /// Whether it moves the reference, or rotates it.
    pub fn hint(&self, snapping: bool) -> String {
        match self.kind {
            Kind::Move { .. } => format!(
                "Moving the reference: Shift, X, Y or Z locks an axis, Ctrl turns snapping {}",
                if snapping { "off" } else { "on" }
            ),
            Kind::Rotate { .. } => "Rotating the reference: Shift snaps to 15°, Esc cancels".into(),
            Kind::Scale { .. } => {
                "Scaling the reference: Shift snaps to tenths, Esc cancels".into()
            }
        }
    }

    /// Go on with the pointer at a place on the canvas.
    pub fn drag(&mut self, place: DVec2, context: &Context) -> Effect {
        let Some(before) = context.before.reference(self.id) else {
            return Effect::Preview(Vec::new());
        };
        let curve = &before.curve;
        let placement = self.placed(curve.placement(), place, context);
        Effect::preview(placement.map(|it| vec![set_placement(self.id, curve, it)]))
    }

    fn placed(
        &mut self,
        before: &Placement,
        place: DVec2,
        context: &Context,
    ) -> Result<Placement, ReferenceError> {
        let now = context.model(place);
        let view = context.viewport;
        match &mut self.kind {
            Kind::Move { drag, planar, .. } => {
                let by = drag.go_on(place, context);
                let to = before.translation() + context.movement(by, *planar);
                Placement::new(before.rotation(), before.scale(), to)
            }
            Kind::Rotate { pivot, origin } => {
                let seen = view.flatten(*pivot);
                let angle = context.angle((*origin - seen).angle_to(now - seen));
                self.label = Some((now, degrees_text(angle.to_degrees(), 2)));
                let turn = DQuat::from_axis_angle(view.orientation.towards(), angle);
                before.rotated_about(*pivot, turn)
            }
            Kind::Scale { pivot, origin } => {
                let seen = view.flatten(*pivot);
                let arm = *origin - seen;
                let free = (now - seen).dot(arm) / arm.length_squared();
                let factor = context.factor(free.max(1e-3), 1.0);
                self.label = Some((now, format!("× {factor:.3}")));
                before.scaled_about(*pivot, factor)
            }
        }
    }

    /// The marks of the drag.
    pub fn marks(&self, context: &Context) -> Vec<Mark> {
        if let Kind::Move { drag, held, .. } = &self.kind {
            return drag.marks(self.readout(drag, *held, context), context);
        }
        let label = self.label.clone();
        label
            .map(|(at, text)| Mark::Label(at, text))
            .into_iter()
            .collect()
    }

    /// How far the reference was moved, and where its own origin is.
    fn readout(&self, drag: &MoveDrag, held: DVec2, context: &Context) -> Option<DragReadout> {
        let placed = |document: &Document| {
            let curve = &document.reference(self.id)?.curve;
            Some((curve.placement().translation(), curve.is_planar()))
        };
        let ((from, is_planar), (to, _)) = placed(context.before).zip(placed(context.document))?;
        let readout = drag.readout([from, to], !is_planar, None, context);
        Some(DragReadout {
            at: held + readout.way,
            ..readout
        })
    }
}

/// The active reference, if it can be changed.
fn editable<'a>(context: &Context<'a>) -> Option<(CurveId, &'a Reference)> {
    let id = context.selection.active()?;
    let reference = context.document.reference(id)?;
    reference.check_editable().ok()?;
    Some((id, reference))
}
