//! Fitting what is shown into the canvas, with a comb of legible size.

use glam::DVec2;

use crate::document::CurveId;
use crate::editor::Editor;
use crate::editor::view::comb::CombSettings;
use crate::editor::view::layers::Layer;
use crate::editor::view::outline::Bounds;
use crate::editor::view::viewport::Viewport;

/// The height of the comb after a reset, as a share of the smaller side of the curve's box.
const COMB_HEIGHT: f64 = 0.35;

/// The teeth that the comb of a long curve has after a reset, about.
const TEETH: usize = 256;

/// A float polygon that is so many times as large as its curve is left out of a fitted view.
const FAR_POLYGON: f64 = 8.0;

/// What is smaller than this share of the view's smaller side is a speck.
const SPECK: f64 = 0.15;

/// How far beside curve and polygon a fitted view follows the comb, in units of their extent.
const COMB_REACH: f64 = 1.0;

impl Editor {
    /// Fit everything into the canvas, and give the comb a legible scale.
    pub(in crate::editor) fn fit_all(&mut self) {
        self.reset_comb();
        self.show_all();
    }

    /// Tell how large the canvas is, in screen points. As long as the view shows everything as it was fitted, it
    /// is fitted again; afterwards the middle of the view stays where it is.
    pub fn set_canvas_size(&mut self, size: DVec2) {
        if !(size.min_element() >= 1.0) {
            return;
        }
        let is_fitted = self.view.fitted == Some(self.fitted_now());
        self.view.viewport.size = size;
        if !self.view.placed {
            self.view.placed = true;
            self.fit_all();
        } else if is_fitted && !self.hand.is_holding() {
            self.analyse();
            self.show_all();
        }
    }

    /// Fit everything into the canvas, and remember that nothing has changed since.
    fn show_all(&mut self) {
        let mut bounds = Bounds::EMPTY;
        let document = self.document();
        let shown = document.all_ids().filter(|id| document.is_visible(*id));
        let shown: Vec<CurveId> = shown.collect();
        for id in shown {
            bounds.unite(&self.bounds_of(id));
        }
        self.view.viewport = self.view.viewport.fitted(&bounds);
        self.view.target = self.middle();
        self.view.fitted = Some(self.fitted_now());
    }

    /// The view and the state of the document that it shows.
    fn fitted_now(&self) -> (Viewport, u64) {
        (self.view.viewport, self.workspace.revision())
    }

    /// Fit everything into the canvas if one of some curves lies beyond what is visible.
    pub(in crate::editor) fn bring_into_view(&mut self, curves: &[CurveId]) {
        self.analyse();
        let view = self.view.viewport.view_box();
        let hidden = curves.iter().any(|id| {
            let bounds = self.bounds_of(*id);
            bounds.low.cmplt(view.low).any() || bounds.high.cmpgt(view.high).any()
        });
        if hidden {
            self.fit_all();
        }
    }

    /// Fit everything into the canvas if one of some new curves lies beyond what is visible; where they would be a
    /// speck then, or are one already, fit them alone, with a legible comb.
    pub(in crate::editor) fn bring_into_sight(&mut self, new: &[CurveId]) {
        self.bring_into_view(new);
        let comb = self.view.comb;
        self.reset_comb();
        let mut bounds = Bounds::EMPTY;
        for id in new {
            bounds.unite(&self.bounds_of(*id));
        }
        let view = self.view.viewport.view_box();
        let (extent, side) = (bounds.high - bounds.low, view.high - view.low);
        if extent.max_element() < SPECK * side.min_element() {
            self.view.viewport = self.view.viewport.fitted(&bounds);
            self.view.target = self.middle();
        } else {
            self.view.comb = comb;
        }
    }

    /// Give the comb a scale at which its longest tooth is a good part of the active curve's box,
    /// and teeth of which a long curve has no more a segment than can be told apart.
    pub(in crate::editor) fn reset_comb(&mut self) {
        self.analyse();
        self.view.comb = CombSettings::default();
        let Some((samples, bounds)) = self.active().and_then(|id| {
            let outlined = self.view.outlines.get(id)?;
            Some((self.analyses.sampled(id)?.samples, outlined.curve.bounds()))
        }) else {
            return;
        };
        let extent = (bounds.high - bounds.low).max_element();
        let largest = samples
            .curvature()
            .map_or(0.0, |range| range.high.abs().max(range.low.abs()));
        self.view.comb.density = (TEETH / samples.pieces()).clamp(1, self.view.comb.density);
        // Without curvature there is no scale to choose.
        self.view.set_comb(CombSettings {
            scale: COMB_HEIGHT * extent / largest,
            ..self.view.comb
        });
    }

    /// Fit the selected vertices, or everything; the comb is legible again.
    pub(in crate::editor) fn fit(&mut self) {
        // A single vertex has no extent that could be fitted.
        if self.hand.selection.vertices().len() < 2 {
            self.fit_all();
        } else {
            self.reset_comb();
            let mut bounds = Bounds::EMPTY;
            for (curve, index) in self.hand.selection.vertices() {
                if let Some(curve) = self.document().curve(curve) {
                    bounds.add(self.view.viewport.flatten(curve.polygon.vertex(index)));
                }
            }
            self.view.viewport = self.view.viewport.fitted(&bounds);
        }
    }

    fn bounds_of(&self, id: CurveId) -> Bounds {
        let (layers, scale) = (self.layers(), self.view.comb.scale);
        let is_active = self.hand.selection.active() == Some(id);
        let outlined = self.view.outlines.get(id);
        let Some((sampled, outlined)) = self.analyses.sampled(id).zip(outlined) else {
            return Bounds::EMPTY;
        };
        let mut bounds = outlined.curve.bounds();
        if layers.shows(Layer::Clamped) {
            bounds.unite(&outlined.clamped.bounds());
        }
        if layers.shows(Layer::Float) {
            let float = outlined.float.bounds();
            let extent = |bounds: &Bounds| (bounds.high - bounds.low).max_element();
            // The float polygon of a Bézier curve may lie far away: the curve must not become a speck.
            if extent(&float) <= FAR_POLYGON * extent(&bounds) {
                bounds.unite(&float);
            }
        }
        if layers.shows(Layer::Comb) && is_active {
            // Long teeth are cut off: the curve must not become a speck.
            let around = bounds.grown(COMB_REACH);
            let comb = outlined.curve.comb_bounds(sampled, scale);
            bounds.unite(&comb.within(&around));
        }
        bounds
    }
}
