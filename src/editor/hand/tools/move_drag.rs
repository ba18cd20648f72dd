//! A drag that moves something: it follows the pointer, along an axis or to what it snaps to.

use glam::{DVec2, DVec3};

use super::tool::Context;
use crate::document::CurveId;
use crate::editor::hand::snapping::{Carried, Snap, along_axis};
use crate::editor::view::scene::{DragReadout, Mark};

/// A dragged point that is farther from the pointer, in screen points, is held back.
const LAG: f64 = 2.0;

/// The state of a drag that moves something. Places are those of the view plane.
#[derive(Debug)]
pub(super) struct MoveDrag {
    /// Where the pointer began.
    origin: DVec2,
    /// Where the held point was seen.
    held: DVec2,
    carried: Carried,
    snap: Option<Snap>,
    /// How far the pointer asks the held point to move.
    by: DVec2,
}

impl MoveDrag {
    /// Begin with the pointer at a place on the canvas.
    pub fn begin(place: DVec2, held: DVec2, carried: Carried, context: &Context) -> Self {
        Self {
            origin: context.model(place),
            held,
            carried,
            snap: None,
            by: DVec2::ZERO,
        }
    }

    /// Go on with the pointer at a place on the canvas. Returns the movement in the view plane.
    pub fn go_on(&mut self, place: DVec2, context: &Context) -> DVec2 {
        let free = context.model(place) - self.origin;
        self.snap = None;
        self.by = free;
        if context.axis.is_some() {
            return free;
        }
        if context.modifiers.shift {
            self.by = along_axis(free);
            return self.by;
        }
        let wanted = self.held + free;
        self.snap = context.snap(wanted, &self.carried);
        if let Some(snap) = &self.snap {
            let snapped = context.viewport.flatten(snap.point);
            // What rests on its snap already does not move by rounding.
            if snapped != wanted {
                self.by = snapped - self.held;
            }
        }
        self.by
    }

    /// Why a point of a curve is not where it is dragged, if a match or the curve's symmetry does that.
    pub fn lag(
        &self,
        curve: CurveId,
        [from, to]: [DVec3; 2],
        planar: bool,
        context: &Context,
    ) -> Option<&'static str> {
        let is_matched = context.document.matches().any(|it| it.curve == curve);
        let own = context.document.curve(curve);
        let is_symmetric = own.is_some_and(|it| it.symmetry.is_some());
        let wanted = context
            .viewport
            .flatten(from + context.movement(self.by, planar));
        let off = wanted.distance(context.viewport.flatten(to));
        let lags = context.held_back.is_none() && off > LAG * context.viewport.pixel();
        match (lags, is_matched, is_symmetric) {
            (true, true, _) => Some("The match holds it back"),
            (true, false, true) => Some("The symmetry holds it back"),
            _ => None,
        }
    }

    /// Tell of a point that was dragged from somewhere to somewhere, with a remark and what the drag adds, or why it
    /// is held back.
    pub fn readout(
        &self,
        [from, to]: [DVec3; 2],
        in_space: bool,
        remark: Option<String>,
        context: &Context,
    ) -> DragReadout {
        let name = self.snap.as_ref().map(|snap| snap.name.clone());
        let held = context.held_back.map(|reason| format!("Held; {reason}"));
        let added = held.or(context.added.map(str::to_owned));
        DragReadout {
            at: context.viewport.flatten(to),
            way: context.viewport.flatten(to - from),
            by: to - from,
            to,
            in_space: in_space || from.z != 0.0 || to.z != 0.0,
            remarks: name.into_iter().chain(remark).chain(added).collect(),
        }
    }

    /// The line that the drag keeps to, its snap, and the readout.
    pub fn marks(&self, readout: Option<DragReadout>, context: &Context) -> Vec<Mark> {
        let snap = self.snap.as_ref();
        let at = snap.map(|snap| Mark::Snap(context.viewport.flatten(snap.point)));
        let guide = self.axis_guide(context).into_iter();
        let lines = snap.into_iter().flat_map(Snap::line_marks);
        guide
            .chain(lines)
            .chain(at)
            .chain(readout.map(Mark::Drag))
            .collect()
    }

    /// The line that the drag keeps to, if it keeps to one.
    fn axis_guide(&self, context: &Context) -> Option<Mark> {
        let (direction, axis) = match context.axis {
            Some(axis) => (
                context.viewport.flatten(*DVec3::AXES.get(axis)?),
                Some(axis),
            ),
            None if context.modifiers.shift => {
                let direction = along_axis(self.by);
                let across = usize::from(direction.x == 0.0);
                let axes = context.viewport.orientation.axes();
                (direction, axes.map(|axes| axes[across]))
            }
            None => return None,
        };
        let direction = direction.try_normalize()?;
        let seen = context.viewport.view_box();
        let reach = 2.0 * seen.low.distance(seen.high);
        let ends = [self.held - reach * direction, self.held + reach * direction];
        Some(Mark::Axis { ends, axis })
    }
}
