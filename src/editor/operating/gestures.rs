//! Gestures on the canvas while an operation is in progress: its points and handles come first.

use glam::DVec2;

use super::operations::Operating;
use crate::editor::hand::gesture::Gesture;
use crate::editor::hand::tools::Context;
use crate::editor::reply::{Message, Refusal};
use crate::editor::view::{Look, REACH};

impl Operating<'_> {
    /// Take a click on a point that is fitted, and a gesture that is meant for a handle of the previewed operation, or
    /// beside the handles of one that offers some. Returns whether the gesture was taken.
    pub(in crate::editor) fn take_gesture(&mut self, gesture: Gesture) -> bool {
        if let Gesture::Click(at) | Gesture::DoubleClick(at) = gesture {
            let (context, tool) = (self.context(), self.hand.tool());
            let current = self.current();
            if let Some(point) = current.and_then(|it| it.point_at(at, tool, &context)) {
                self.switch_point(point);
                return true;
            }
        }
        let Some(previewed) = self.previewed() else {
            return false;
        };
        if let Gesture::Click(at) = gesture
            && let (_, Some(second)) = previewed.seconds()
            && let Some(hit) = self.context().hits.curve(at)
            && ![Some(second), previewed.curve()].contains(&Some(hit.curve))
        {
            self.choose_second(hit.curve);
            return true;
        }
        let offers_handles = previewed.offers_handles();
        let taken = match gesture {
            Gesture::DragStart(at) => self.begin_handle_drag(at),
            Gesture::Click(at) | Gesture::DoubleClick(at) => {
                let on_handle = previewed.handle_at(&self.view.pane.viewport, at).is_some();
                on_handle || self.click_on_curve(at)
            }
            Gesture::Drag(at) => {
                let given = previewed.dragged_values(at, &self.context());
                self.go_on_with_handle(given)
            }
            Gesture::DragEnd(_) => self.end_handle_drag().then(|| self.keep_values()).is_some(),
            Gesture::Cancel => self
                .end_handle_drag()
                .then(|| self.restore_values())
                .is_some(),
            _ => false,
        };
        if !taken && offers_handles {
            self.leave_beside_handles(gesture);
        }
        taken || offers_handles
    }

    /// Answer a gesture beside the handles, which does not change the operation.
    ///
    /// A double click on nothing shows everything; a press on a curve says how to leave the operation.
    fn leave_beside_handles(&mut self, gesture: Gesture) {
        let is_over_curve = |at: DVec2| {
            let hits = self.context().hits;
            hits.vertex(at).is_some()
                || hits.curve(at).is_some()
                || hits.leg(at, 0.5 * REACH).is_some()
        };
        match gesture {
            Gesture::DoubleClick(at) if !is_over_curve(at) => {
                let layers = self.hand.layers(self.view.layers);
                let shown = self.hand.shown(self.workspace, layers);
                self.view.look(Look::All, shown);
            }
            Gesture::DragStart(at) if is_over_curve(at) => {
                let label = self.previewed().map_or("", |it| it.operation().label);
                let first = format!("Apply or cancel {label} before you edit curves on the canvas");
                *self.message = Message::of(&Err(Refusal(first)));
            }
            _ => {}
        }
    }

    pub(super) fn context(&self) -> Context<'_> {
        let layers = self.hand.layers(self.view.layers);
        self.hand.context(self.workspace, self.view, layers)
    }
}
