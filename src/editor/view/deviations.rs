//! The distance between the active curve and what it is compared with: for panels, and marked on the canvas.

use crate::analysis::{Distance, Item};
use crate::document::CurveId;
use crate::editor::jobs::comparing::Pair;
use crate::editor::view::scene::Mark;
use crate::editor::view::shown::Shown;
use crate::editor::view::sight::Sight;
use crate::editor::view::view::View;
use crate::geometry::figure;

impl View {
    /// The curve and what it is compared with, if there is something to compare.
    pub(super) fn compared_pair(&self, shown: Shown<'_>) -> Option<Pair> {
        let (active, compared) = (shown.active()?, self.compared(shown.active()?)?);
        let document = shown.document();
        if active == compared {
            return None;
        }
        // The active one is the curve that is measured, unless it is a reference.
        let (curve, other) = match document.curve(active) {
            Some(curve) => (curve, compared),
            None => (document.curve(compared)?, active),
        };
        Some(Pair {
            ids: [active, compared],
            curve: curve.clone(),
            other: Item::of(document, other)?,
        })
    }
}

impl<'a> Sight<'a> {
    /// The curve or reference that the active one is compared with.
    pub fn compared(self) -> Option<CurveId> {
        self.view.compared(self.active()?)
    }

    /// How far the active curve is from what it is compared with, or a curve from the active reference that
    /// it is compared with; `None` until it is measured, and between two references. While a curve is changed
    /// it is that of the last state that was measured.
    pub fn distance(self) -> Option<&'a Distance> {
        self.view.comparing.distance()
    }

    /// Mark on the canvas where the largest distance is.
    pub(super) fn distance_marks(self) -> Vec<Mark> {
        let is_visible = |id| self.document().is_visible(id);
        let both = [self.active(), self.compared()];
        let Some(distance) = self
            .distance()
            .filter(|_| both.into_iter().all(|id| id.is_some_and(is_visible)))
        else {
            return Vec::new();
        };
        let [from, to] = distance.places.map(|place| self.viewport().flatten(place));
        vec![
            Mark::Ruler([from, to]),
            Mark::Extreme {
                at: from,
                text: format!("distance {}", figure(distance.largest)),
            },
        ]
    }
}
