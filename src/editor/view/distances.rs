//! How far the active curve is from what it is compared with: for panels, and marked on the canvas.

use crate::analysis::{Distance, Measured};
use crate::document::CurveId;
use crate::editor::Editor;
use crate::editor::jobs::comparing::Pair;
use crate::editor::view::scene::Mark;
use crate::geometry::figure;

impl Editor {
    /// How far the active curve is from what it is compared with, or a curve from the active reference that it
    /// is compared with; `None` until it is measured, and between two references. While a curve is changed it
    /// is that of the last state that was measured.
    pub fn distance(&self) -> Option<&Distance> {
        self.comparing.distance()
    }

    /// Measure that, if there is something to compare with.
    pub(in crate::editor) fn compare_distances(&mut self) {
        let pair = self.compared_pair();
        self.comparing.advance(pair, &mut self.patience);
    }

    fn compared_pair(&self) -> Option<Pair> {
        let (active, compared) = (self.active()?, self.view.compared?);
        let document = self.document();
        if active == compared {
            return None;
        }
        let measured = |id: CurveId| match (document.curve(id), document.reference(id)) {
            (Some(curve), _) => Some(Measured::Curve(curve.clone())),
            (None, reference) => reference.cloned().map(Measured::Reference),
        };
        // The active one is the curve that is measured, unless it is a reference.
        let (curve, other) = match document.curve(active) {
            Some(curve) => (curve, compared),
            None => (document.curve(compared)?, active),
        };
        Some(Pair {
            ids: [active, compared],
            curve: curve.clone(),
            other: measured(other)?,
        })
    }

    /// Mark on the canvas where the largest distance is.
    pub(in crate::editor) fn distance_marks(&self) -> Vec<Mark> {
        let both = [self.active(), self.view.compared];
        let shown = |id: &Option<CurveId>| id.is_some_and(|id| self.document().is_visible(id));
        let Some(distance) = self.distance().filter(|_| both.iter().all(shown)) else {
            return Vec::new();
        };
        let [from, to] = distance
            .places
            .map(|place| self.view.viewport.flatten(place));
        vec![
            Mark::Ruler([from, to]),
            Mark::Extreme {
                at: from,
                text: format!("distance {}", figure(distance.largest)),
            },
        ]
    }
}
