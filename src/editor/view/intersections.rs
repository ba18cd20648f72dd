//! Intersections near a place on the canvas, of what is seen there.

use glam::{DVec2, DVec3};

use super::hit::{CurveHit, REACH};
use super::layers::Layer;
use super::sight::Sight;
use crate::document::CurveId;
use crate::geometry::Intersection;

impl Sight<'_> {
    /// Find the intersection nearest to a place on the canvas, within reach: of two curves or references, or of
    /// one with itself. Those that `takes` refuses do not count.
    pub(in crate::editor) fn intersection(
        &self,
        place: DVec2,
        takes: impl Fn(CurveId) -> bool,
    ) -> Option<DVec3> {
        let passes = self.passes(place, takes);
        let pairs = passes.iter().enumerate().flat_map(|(index, one)| {
            let others = passes[index + 1..].iter();
            others.map(move |other| (one, other))
        });
        let at = self.viewport().to_model(place);
        let reach = REACH * self.viewport().pixel();
        let near = pairs.filter_map(|(one, other)| {
            let curves = [one, other].map(|hit| self.document().shape(hit.curve));
            let [Some(first), Some(second)] = curves else {
                return None;
            };
            let point = Intersection::near([first, second], [one.u, other.u])?.point;
            let distance = self.viewport().flatten(point).distance(at);
            (distance <= reach).then_some((distance, point))
        });
        let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(_, point)| point)
    }

    /// Find where curves and references that are shown pass a place on the canvas, of those that `takes` accepts.
    pub(in crate::editor) fn passes(
        &self,
        place: DVec2,
        takes: impl Fn(CurveId) -> bool,
    ) -> Vec<CurveHit> {
        let curves = self.shown.layers.shows(Layer::Curve).then(|| self.curves());
        let curves = curves.into_iter().flatten().map(|(id, _)| id);
        let is_picture = |id: &CurveId| {
            let reference = self.document().reference(*id);
            reference.is_some_and(|it| it.picture.is_some())
        };
        let references = self.shown_references().filter(|id| !is_picture(id));
        let shown = curves.chain(references).filter(|id| takes(*id));
        let model = self.viewport().to_model(place);
        let reach = REACH * self.viewport().pixel();
        let passes = shown.filter_map(|id| {
            let sampled = self.view.analyses.sampled(id)?;
            let outlines = &self.view.pane.outlines.get(id)?.curve;
            let passes = outlines.passes(sampled, model, reach).into_iter();
            Some(passes.map(move |(u, point, _)| CurveHit {
                curve: id,
                u,
                point,
            }))
        });
        passes.flatten().collect()
    }
}
