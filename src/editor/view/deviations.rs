//! The deviation of the active curve from what it is compared with: for panels, and marked on the canvas.

use glam::DVec3;

use crate::analysis::{Deviation, Item};
use crate::document::CurveId;
use crate::editor::jobs::comparing::Pair;
use crate::editor::view::scene::Mark;
use crate::editor::view::shown::Shown;
use crate::editor::view::sight::Sight;
use crate::editor::view::view::View;
use crate::editor::view::whiskers::Whiskers;
use crate::geometry::expressions::LengthUnit;
use crate::geometry::figure;

impl View {
    /// The active curve or reference and what it is compared with, if there is something to compare.
    pub(super) fn compared_pair(&self, shown: Shown<'_>) -> Option<Pair> {
        let (active, compared) = (shown.active()?, self.compared(shown.active()?)?);
        let ids = [active, compared];
        let [first, second] = ids.map(|id| Item::of(shown.document(), id));
        (active != compared).then_some(Pair {
            ids,
            items: [first?, second?],
        })
    }

    /// The deviation that is shown.
    fn deviation(&self) -> Option<&Deviation> {
        let within = self.comparing.within_ends();
        let within = within.filter(|_| self.whiskers.within_ends);
        within.or(self.comparing.deviation())
    }

    /// Give the whiskers of the deviation a scale that suits them, unless they have one that still does. While the hand
    /// holds something they keep theirs.
    pub(super) fn suit_whiskers(&mut self, is_holding: bool) {
        let Some(deviation) = self.deviation() else {
            self.suited_scale = None;
            return;
        };
        if is_holding && self.suited_scale.is_some() {
            return;
        }
        let largest = deviation.largest().map_or(0.0, |(_, it)| it.distance());
        let places: Vec<DVec3> = deviation.whiskers().map(|it| it.places[0]).collect();
        let suiting = Whiskers::default().scale_for(&places, largest);
        self.suited_scale = Some(Whiskers::kept_scale(self.suited_scale, suiting));
    }
}

impl<'a> Sight<'a> {
    /// The curve or reference that the active one is compared with, while the document has it.
    pub fn compared(self) -> Option<CurveId> {
        let compared = self.view.compared(self.active()?)?;
        self.document().name(compared).map(|_| compared)
    }

    /// The deviation of the active curve or reference from what it is compared with; `None` until it is measured, and
    /// between two lists of points. While one of them is changed it is that of the last state that was measured. Without
    /// the points past an end if they are left out.
    pub fn deviation(self) -> Option<&'a Deviation> {
        self.view.deviation()
    }

    /// The deviation with the points past an end.
    pub fn whole_deviation(self) -> Option<&'a Deviation> {
        self.view.comparing.deviation()
    }

    /// Whether points past an end can be left out of the deviation.
    pub fn has_points_within_ends(self) -> bool {
        self.view.comparing.within_ends().is_some()
    }

    /// The scale at which the whiskers of the deviation are drawn.
    pub fn deviation_scale(self) -> f64 {
        let whiskers = &self.view.whiskers;
        whiskers.scale.or(self.view.suited_scale).unwrap_or(1.0)
    }

    /// Mark the distances on the canvas, and where the largest is.
    pub(super) fn deviation_marks(self) -> Vec<Mark> {
        let is_visible = |id| self.document().is_visible(id);
        let both = [self.active(), self.compared()];
        let Some(deviation) = self
            .deviation()
            .filter(|_| both.into_iter().all(|id| id.is_some_and(is_visible)))
        else {
            return Vec::new();
        };
        let seen = |point: DVec3| self.viewport().flatten(point);
        let mut marks = Vec::new();
        let settings = &self.view.whiskers;
        if settings.shown {
            let scale = self.deviation_scale();
            let limit = settings.limit.unwrap_or(f64::INFINITY);
            for beyond in [false, true] {
                let own = deviation.whiskers();
                let own = own.filter(|it| (it.distance() > limit) == beyond);
                let lines = own.map(|it| Whiskers::whisker(it.places, scale).map(seen));
                marks.push(Mark::Whiskers {
                    lines: lines.collect(),
                    beyond,
                });
            }
        }
        if let Some((_, largest)) = deviation.largest() {
            let [from, to] = largest.places.map(seen);
            let length = LengthUnit::behind(self.document().unit(), figure(largest.distance()));
            marks.push(Mark::Ruler([from, to]));
            marks.push(Mark::Extreme {
                at: from,
                text: format!("distance {length}"),
            });
        }
        marks
    }
}
