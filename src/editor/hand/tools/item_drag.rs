//! A drag that moves all selected curves and references.

use glam::DVec2;

use super::move_drag::MoveDrag;
use super::tool::{Context, Effect};
use super::transformed::Transformed;
use crate::editor::hand::snapping::Carried;
use crate::editor::view::hit::CurveHit;
use crate::editor::view::scene::Mark;

/// The drag of several items by a place on one of them.
#[derive(Debug)]
pub struct ItemDrag {
    drag: MoveDrag,
    items: Transformed,
    grip: CurveHit,
}

impl ItemDrag {
    /// Begin at a place on a curve or a reference; `None` unless it is selected with others, as a whole. Also
    /// returns the effects that begin the drag, or say why the item stays.
    pub fn begin(
        place: DVec2,
        grip: CurveHit,
        context: &Context,
    ) -> Option<(Option<Self>, Vec<Effect>)> {
        let selection = context.selection;
        if !selection.is_of_whole_items() || !selection.has_item(grip.curve) {
            return None;
        }
        let items = Transformed::of(context);
        if !items.holds(grip.curve) {
            let staying = context.staying().map(Effect::Say);
            return Some((None, staying.into_iter().collect()));
        }
        let is_planar = |id| {
            let shape = context.before.shape(id);
            shape.is_some_and(|shape| shape.is_planar())
        };
        let carried = Carried {
            vertices: items.vertices().collect(),
            item: Some(grip.curve),
            is_off_ground: !is_planar(grip.curve),
            ..Carried::default()
        };
        let begun = Effect::Begin(items.label("Move"));
        let drag = Self {
            drag: MoveDrag::begin(place, grip.point, carried, context),
            items,
            grip,
        };
        Some((Some(drag), vec![begun]))
    }

    /// Go on with the pointer at a place on the canvas.
    pub fn drag(&mut self, place: DVec2, context: &Context) -> Effect {
        let by = self.drag.go_on(place, context);
        let moved = |planar| context.movement(by, planar);
        Effect::preview(self.items.moved(moved, |at, by| at + by, context))
    }

    /// The marks of the drag: how far the grip was moved.
    pub fn marks(&self, context: &Context) -> Vec<Mark> {
        let CurveHit { curve, u, .. } = self.grip;
        let place =
            |shape: Option<&dyn crate::geometry::ParametricCurve>| Some(shape?.jet(u).point);
        let ends = place(context.before.shape(curve)).zip(place(context.document.shape(curve)));
        let is_planar = context.before.shape(curve).is_some_and(|it| it.is_planar());
        let lag = ends.and_then(|(from, to)| self.drag.lag(curve, [from, to], is_planar, context));
        let remark = lag.map(str::to_owned);
        let readout =
            ends.map(|(from, to)| self.drag.readout([from, to], !is_planar, remark, context));
        self.drag.marks(readout, context)
    }

    /// What the mouse does meanwhile.
    pub fn hint(&self, context: &Context) -> String {
        let staying = context.staying().map(|staying| format!(" ({staying})"));
        format!(
            "Moving {}{}: Shift locks to an axis, X, Y, Z to a model axis, Esc cancels",
            self.items.noun(),
            staying.unwrap_or_default()
        )
    }
}
