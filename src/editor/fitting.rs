//! Fitting what is shown into the canvas, with a comb of legible size.

use super::Editor;
use super::layers::Layer;
use crate::analysis::{Bounds, CombSettings};
use crate::document::CurveId;

/// The height of the comb after a reset, as a share of the smaller side of the curve's box.
const COMB_HEIGHT: f64 = 0.35;

/// The teeth that the comb of a long curve has after a reset, about.
const TEETH: usize = 256;

/// How far beside curve and polygon a fitted view follows the comb, in units of their extent.
const COMB_REACH: f64 = 1.0;

impl Editor {
    /// Fit everything into the canvas, and give the comb a legible scale.
    pub(super) fn fit_all(&mut self) {
        self.reset_comb();
        let mut bounds = Bounds::EMPTY;
        let shown: Vec<CurveId> = self
            .document()
            .curves()
            .filter(|(_, curve)| curve.visible)
            .map(|(id, _)| id)
            .collect();
        for id in shown {
            bounds.unite(&self.bounds_of(id));
        }
        self.viewport = self.viewport.fitted(&bounds);
    }

    /// Give the comb a scale at which its longest tooth is a good part of the active curve's box,
    /// and teeth of which a long curve has no more a segment than can be told apart.
    pub(super) fn reset_comb(&mut self) {
        self.analyses.update(self.history.document());
        self.comb = CombSettings::default();
        let Some(analysis) = self.selection.active().and_then(|id| self.analyses.get(id)) else {
            return;
        };
        let bounds = analysis.bounds();
        let extent = (bounds.high - bounds.low).max_element();
        let largest = analysis
            .curvature()
            .map_or(0.0, |range| range.high.abs().max(range.low.abs()));
        let segments = analysis.curve().polygon.segments();
        self.comb.density = (TEETH / segments.max(1)).clamp(1, self.comb.density);
        // Without curvature there is no scale to choose.
        self.set_comb(CombSettings {
            scale: COMB_HEIGHT * extent / largest,
            ..self.comb
        });
    }

    /// Fit the selected vertices, or everything; the comb is legible again.
    pub(super) fn fit(&mut self) {
        // A single vertex has no extent that could be fitted.
        if self.selection.vertices().len() < 2 {
            self.fit_all();
        } else {
            self.reset_comb();
            let mut bounds = Bounds::EMPTY;
            for (curve, index) in self.selection.vertices() {
                if let Some(curve) = self.document().curve(curve) {
                    bounds.add(self.viewport.flatten(curve.polygon.vertex(index)));
                }
            }
            self.viewport = self.viewport.fitted(&bounds);
        }
    }

    fn bounds_of(&mut self, id: CurveId) -> Bounds {
        let (layers, scale) = (self.layers(), self.comb.scale);
        let is_active = self.selection.active() == Some(id);
        let Some(analysis) = self.analyses.get(id) else {
            return Bounds::EMPTY;
        };
        let mut bounds = analysis.bounds();
        if layers.shows(Layer::Float) {
            bounds.unite(&analysis.float().figures().bounds);
        }
        if layers.shows(Layer::Comb) && is_active {
            // Long teeth are cut off: the curve must not become a speck.
            let around = bounds.grown(COMB_REACH);
            bounds.unite(&analysis.comb_bounds(scale).within(&around));
        }
        bounds
    }
}
