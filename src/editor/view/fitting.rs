//! Fitting the model into the canvas, with a comb of legible size.

use glam::{DVec2, DVec3};

use crate::analysis::STRAIGHT;
use crate::document::{CurveId, Document};
use crate::editor::view::comb::{CombSettings, CombsOf};
use crate::editor::view::layers::Layer;
use crate::editor::view::outline::Bounds;
use crate::editor::view::shown::Shown;
use crate::editor::view::view::View;
use crate::editor::view::viewport::Viewport;
use crate::geometry::{FloatPolygon, bounds};

/// The length of the comb's longest tooth after a reset, as a share of the longer side of the curve's box.
const COMB_HEIGHT: f64 = 0.35;

/// The teeth that the comb of a long curve has after a reset, about.
const TEETH: usize = 256;

/// A float polygon that is so many times as large as its curve is left out of a fitted view.
const FAR_POLYGON: f64 = 8.0;

/// A curve smaller than this share of the view's smaller side is a speck.
const SPECK: f64 = 0.15;

/// The shortest and the longest tooth of a comb that stays when another curve becomes active or takes its place, in units of
/// its box.
const LEGIBLE: std::ops::RangeInclusive<f64> = 0.03..=2.0;

/// How far beside curve and polygon a fitted view follows the comb, in units of their extent.
const COMB_REACH: f64 = 1.0;

impl View {
    /// Fit everything into the canvas, and give the comb a legible scale.
    pub(super) fn fit_all(&mut self, shown: Shown<'_>) {
        self.reset_comb(shown);
        self.each_pane(|view| {
            view.analyse(shown.document());
            view.show_all(shown);
        });
        self.even_scales(shown);
    }

    /// Give all panes that show everything the scale of the one that needs the smallest: a planar curve that is seen
    /// from the edge stays as large as it is.
    pub(super) fn even_scales(&mut self, shown: Shown<'_>) {
        let now = |view: &Self| view.pane.fitted == Some(view.fitted_now(shown));
        let mut scale = f64::INFINITY;
        self.each_pane(|view| {
            if now(view) {
                scale = scale.min(view.pane.viewport.scale);
            }
        });
        self.each_pane(|view| {
            if now(view) {
                view.pane.viewport.scale = scale;
                view.pane.fitted = Some(view.fitted_now(shown));
            }
        });
    }

    pub(super) fn set_canvas_size(&mut self, size: DVec2, shown: Shown<'_>) {
        if size.min_element() >= 1.0 {
            self.canvas = size;
            self.size_panes(shown);
        }
    }

    pub(super) fn set_pane_size(&mut self, size: DVec2, shown: Shown<'_>) {
        if !(size.min_element() >= 1.0) {
            return;
        }
        let is_fitted = self.pane.fitted == Some(self.fitted_now(shown));
        self.pane.viewport.size = size;
        if !self.placed {
            self.placed = true;
            self.fit_all(shown);
        } else if is_fitted && !shown.is_holding {
            self.analyse(shown.document());
            self.show_all(shown);
        }
    }

    /// Fit everything into the canvas, and remember that nothing has changed since.
    fn show_all(&mut self, shown: Shown<'_>) {
        let document = shown.document();
        let visible = document.all_ids().filter(|id| document.is_visible(*id));
        let visible: Vec<CurveId> = visible.collect();
        let bounds = self.bounds_of_all(&visible, shown);
        self.fit_bounds(&bounds, document);
        self.pane.fitted = Some(self.fitted_now(shown));
    }

    /// Fit a box, and turn the view about the middle of all from now on.
    fn fit_bounds(&mut self, bounds: &Bounds, document: &Document) {
        self.pane.viewport = self.pane.viewport.fitted(bounds);
        self.pane.target = middle(document);
    }

    /// The view and the state of the document that it shows.
    fn fitted_now(&self, shown: Shown<'_>) -> (Viewport, u64) {
        (self.pane.viewport, shown.workspace.revision())
    }

    pub(super) fn bring_into_sight(&mut self, new: &[CurveId], shown: Shown<'_>) {
        self.analyse(shown.document());
        let seen = self.pane.viewport.view_box();
        // The curve alone: the view stays where a polygon goes beyond the points that were drawn.
        let is_hidden = |id: &CurveId| {
            let bounds = self.pane.outlines.get(*id).map(|it| it.curve.bounds());
            let is_outside =
                |it: Bounds| it.low.cmplt(seen.low).any() || it.high.cmpgt(seen.high).any();
            bounds.is_some_and(is_outside)
        };
        if new.iter().any(is_hidden) {
            self.fit_all(shown);
        }
        let comb = self.comb;
        self.reset_comb(shown);
        let curves = new.iter().filter_map(|id| self.pane.outlines.get(*id));
        let alone = curves.map(|it| it.curve.bounds());
        let alone = alone.fold(Bounds::EMPTY, Bounds::united);
        let seen = self.pane.viewport.view_box();
        let (extent, side) = (alone.high - alone.low, seen.high - seen.low);
        if extent.max_element() < SPECK * side.min_element() {
            let bounds = self.bounds_of_all(new, shown);
            self.fit_bounds(&bounds, shown.document());
        } else if self.is_legible(comb, shown) {
            self.comb = comb;
        }
    }

    /// Reset the comb where its longest tooth on the active curve is too short or too long to be read.
    pub(super) fn suit_comb(&mut self, shown: Shown<'_>) {
        self.analyse(shown.document());
        if !self.is_legible(self.comb, shown) {
            self.reset_comb(shown);
        }
    }

    /// Whether the longest tooth of the combs can be read; so can one without teeth.
    fn is_legible(&self, comb: CombSettings, shown: Shown<'_>) -> bool {
        let whole = self.whole_comb_scale(shown);
        whole.is_none_or(|whole| LEGIBLE.contains(&(comb.scale / whole)))
    }

    /// Give the comb a scale at which its longest tooth is a good part of the curves' box, and so many teeth a segment
    /// as can be told apart on the longest of them: what is straight, as between points, has no teeth to count.
    pub(super) fn reset_comb(&mut self, shown: Shown<'_>) {
        self.analyse(shown.document());
        self.comb = CombSettings::default();
        let with_comb = self.with_comb(shown).into_iter();
        let pieces = with_comb.filter_map(|id| {
            let samples = self.analyses.sampled(id)?.samples;
            let largest = samples.curvature()?.magnitude();
            (samples.extent() * largest > STRAIGHT).then(|| samples.pieces())
        });
        let Some(pieces) = pieces.max() else {
            return;
        };
        self.comb.density = (TEETH / pieces).clamp(1, self.comb.density);
        // Without curvature there is no scale to choose.
        if let Some(scale) = self.whole_comb_scale(shown) {
            self.set_comb(CombSettings {
                scale: COMB_HEIGHT * scale,
                ..self.comb
            });
        }
    }

    /// The scale at which the longest tooth of all combs is as long as the largest box of their curves; `None` without
    /// curvature, or with that of rounding alone.
    pub(super) fn whole_comb_scale(&self, shown: Shown<'_>) -> Option<f64> {
        let (mut size, mut largest) = (0.0_f64, 0.0_f64);
        for id in self.with_comb(shown) {
            let Some(sampled) = self.analyses.sampled(id) else {
                continue;
            };
            // The same from all sides.
            size = size.max(sampled.samples.extent());
            let curvature = sampled.samples.curvature();
            largest = curvature.map_or(largest, |it| largest.max(it.magnitude()));
        }
        let scale = (size * largest > STRAIGHT).then(|| size / largest);
        scale.filter(|scale| *scale > 0.0 && scale.is_finite())
    }

    /// The curves and references whose combs are shown where combs are, visible or active.
    pub(super) fn with_comb(&self, shown: Shown<'_>) -> Vec<CurveId> {
        if self.combs_of == CombsOf::Active {
            return shown.active().into_iter().collect();
        }
        let document = shown.document();
        let curves = document.curves().filter(|(_, it)| it.visible);
        let references = document.references().filter(|(_, it)| it.visible);
        let all = curves.map(|(id, _)| id).chain(references.map(|(id, _)| id));
        all.filter(|id| self.combs_of.takes(*id, shown.selection))
            .collect()
    }

    /// Fit the selected vertices, or the selected curves where there are fewer than two: one has no extent.
    pub(super) fn fit_selection(&mut self, shown: Shown<'_>) {
        if shown.selection.vertices().len() < 2 {
            return self.fit_items(shown);
        }
        self.reset_comb(shown);
        let (document, selection) = (shown.document(), shown.selection);
        let vertices = selection
            .vertices()
            .filter_map(|(id, index)| Some(document.curve(id)?.polygon.vertex(index)));
        let vertices: Vec<DVec3> = vertices.collect();
        self.each_pane(|view| {
            let mut bounds = Bounds::EMPTY;
            for vertex in &vertices {
                bounds.add(view.pane.viewport.flatten(*vertex));
            }
            view.pane.viewport = view.pane.viewport.fitted(&bounds);
        });
    }

    /// Fit the selected curves and references, as far as they are visible.
    fn fit_items(&mut self, shown: Shown<'_>) {
        self.reset_comb(shown);
        let document = shown.document();
        let mut items = shown.selection.items();
        items.retain(|id| document.is_visible(*id));
        if self.bounds_of_all(&items, shown).is_empty() {
            return self.fit_all(shown);
        }
        self.each_pane(|view| {
            view.analyse(document);
            let bounds = view.bounds_of_all(&items, shown);
            view.fit_bounds(&bounds, document);
        });
    }

    fn bounds_of_all(&self, ids: &[CurveId], shown: Shown<'_>) -> Bounds {
        let bounds = ids.iter().map(|id| self.bounds_of(*id, shown));
        bounds.fold(Bounds::EMPTY, Bounds::united)
    }

    /// The box of a float polygon without its tails, unless it is hardly more than these.
    fn bounds_without_tails(&self, polygon: &FloatPolygon) -> Bounds {
        let tail = match polygon.segments() >= polygon.degree() {
            true => polygon.tail_legs(),
            false => 0,
        };
        let vertices = polygon.vertices();
        let mut bounds = Bounds::EMPTY;
        for vertex in vertices.iter().take(vertices.len() - tail).skip(tail) {
            bounds.add(self.pane.viewport.flatten(*vertex));
        }
        bounds
    }

    fn bounds_of(&self, id: CurveId, shown: Shown<'_>) -> Bounds {
        let (layers, scale) = (shown.layers, self.comb.scale);
        let outlined = self.pane.outlines.get(id);
        let Some((sampled, outlined)) = self.analyses.sampled(id).zip(outlined) else {
            return Bounds::EMPTY;
        };
        let mut bounds = outlined.curve.bounds();
        if layers.shows(Layer::Clamped) {
            bounds = bounds.united(outlined.clamped.bounds());
        }
        if layers.shows(Layer::Float) {
            let float = match shown.document().curve(id) {
                Some(curve) => self.bounds_without_tails(&curve.polygon),
                None => outlined.float.bounds(),
            };
            let extent = |bounds: &Bounds| (bounds.high - bounds.low).max_element();
            // The float polygon of a Bézier curve may lie far away: the curve must not become a speck.
            if extent(&float) <= FAR_POLYGON * extent(&bounds) {
                bounds = bounds.united(float);
            }
        }
        if layers.shows(Layer::Comb) && self.combs_of.takes(id, shown.selection) {
            // Long teeth are cut off: the curve must not become a speck.
            let around = bounds.grown(COMB_REACH);
            let comb = outlined.curve.comb_bounds(sampled, scale);
            bounds = bounds.united(comb.within(&around));
        }
        bounds
    }
}

/// The middle of the box around the float S-polygons that are shown.
pub(super) fn middle(document: &Document) -> DVec3 {
    let shown = document.curves().filter(|(_, curve)| curve.visible);
    let (low, high) = bounds(shown.flat_map(|(_, curve)| curve.polygon.vertices()));
    if low.is_finite() {
        0.5 * (low + high)
    } else {
        DVec3::ZERO
    }
}
