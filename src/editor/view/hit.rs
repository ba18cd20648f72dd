//! Hit tests: the vertex, leg, curve or feature under a place on the canvas.

use glam::{DVec2, DVec3};

use crate::analysis::ReferenceAnalysis;
use crate::document::{Curve, CurveId};
use crate::editor::selection::VertexId;
use crate::editor::view::density::{self, SeenChain};
use crate::editor::view::feature_report::FeatureRow;
use crate::editor::view::layers::Layer;
use crate::editor::view::outline::ViewBox;
use crate::editor::view::sight::Sight;
use crate::editor::view::view::View;

/// The reach of the pointer, in screen points.
pub const REACH: f64 = 8.0;

/// Nearer to a vertex than this, in screen points, a press is meant for the vertex and not for the tip of a
/// comb's tooth.
const BESIDE: f64 = 2.0 * REACH;

/// Nearer to a leg or to the curve than this, in screen points, a press is not meant for the tip of a tooth.
const APART: f64 = 12.0;

/// Nearer to the active curve than this, in screen points, a press is meant for it, and for no vertex of another one.
const UNDER: f64 = 0.5 * REACH;

/// A vertex of the closed S-polygon that is nearer than one of the float S-polygon by more than this, in screen points, is
/// meant by a press.
const NEARER: f64 = 2.0;

/// How much farther than the active curve another one counts, and a reference than that, in screen points.
const BEHIND: f64 = 2.0;

/// The smallest length of a comb's tooth, in screen points, that can be dragged by its tip.
const SHORTEST_TOOTH: f64 = 4.0;

/// A place on a curve or on a reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveHit {
    /// The curve or the reference.
    pub curve: CurveId,
    /// The parameter.
    pub u: f64,
    /// The point.
    pub point: DVec2,
}

/// A place on a leg of a float S-polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegHit {
    /// The curve.
    pub curve: CurveId,
    /// The vertex where the leg begins.
    pub index: usize,
    /// The share of the leg before the place.
    pub share: f64,
    /// The place.
    pub point: DVec2,
}

impl<'a> Sight<'a> {
    /// Find the vertex under a place; of several that overlap, the one that Tab has chosen. Those of the active curve
    /// come first, and where it runs under the pointer itself, vertices of others come after it. Where a vertex of the
    /// closed S-polygon is clearly nearer there is none.
    pub(in crate::editor) fn vertex(&self, place: DVec2) -> Option<(CurveId, usize)> {
        if !self.shown.layers.shows(Layer::Float) {
            return None;
        }
        let mut found: Vec<(f64, VertexId)> = self.vertices_within(place, REACH).collect();
        if found.is_empty() {
            return None;
        }
        let is_other = |id: &VertexId| self.active() != Some(id.0);
        // The active curve's win, of these the nearest, of equals the one drawn on top.
        found.sort_by(|(a, one), (b, other)| {
            let by_activity = is_other(one).cmp(&is_other(other));
            by_activity.then(a.total_cmp(b)).then(other.cmp(one))
        });
        let clamped = self.clamped_within(place, REACH);
        let is_beside = |(nearest, _): &(f64, VertexId)| {
            let margin = NEARER * self.viewport().pixel();
            clamped.is_some_and(|(distance, _)| distance + margin < *nearest)
        };
        if self.shown.cycle == 0 && found.first().is_some_and(is_beside) {
            return None;
        }
        let has_own = found.first().is_some_and(|(_, id)| !is_other(id));
        let behind_curve = usize::from(!has_own && self.is_active_under(place));
        let chosen = self.shown.cycle % (found.len() + behind_curve);
        found
            .get(chosen.checked_sub(behind_curve)?)
            .map(|(_, id)| *id)
    }

    /// Whether the active curve runs under a place, and can be changed.
    pub(in crate::editor) fn is_active_under(&self, place: DVec2) -> bool {
        let id = self.shown_active();
        let id = id.filter(|_| self.shown.layers.shows(Layer::Curve));
        id.is_some_and(|id| {
            let curve = self.document().curve(id);
            let is_editable = curve.is_some_and(|curve| curve.check_editable().is_ok());
            is_editable && self.hit_within(id, place, UNDER).is_some()
        })
    }

    /// Whether a place is near a visible vertex of either S-polygon.
    pub(in crate::editor) fn is_beside_vertex(&self, place: DVec2) -> bool {
        let float = self.shown.layers.shows(Layer::Float);
        (float && self.vertices_within(place, BESIDE).next().is_some())
            || self.clamped_within(place, BESIDE).is_some()
    }

    /// Find the vertex of the active curve's closed S-polygon under a place, if it is shown.
    pub(in crate::editor) fn clamped_vertex(&self, place: DVec2) -> Option<(CurveId, usize)> {
        self.clamped_within(place, REACH).map(|(_, id)| id)
    }

    /// The vertices within some screen points of a place, with their distances in the model. A polygon that
    /// crowds so much that its vertices are not drawn has none: the curve is hit instead.
    fn vertices_within(
        &self,
        place: DVec2,
        reach: f64,
    ) -> impl Iterator<Item = (f64, (CurveId, usize))> {
        let model = self.viewport().to_model(place);
        let reach = reach * self.viewport().pixel();
        let all = self.curves().flat_map(|(id, curve)| {
            let vertices = curve.polygon.vertices().iter().enumerate();
            vertices.map(move |(index, vertex)| (*vertex, (id, index)))
        });
        let distances =
            all.map(move |(vertex, id)| (self.viewport().flatten(vertex).distance(model), id));
        let near = distances.filter(move |(distance, _)| *distance <= reach);
        near.filter(|(_, id)| self.is_seen(*id))
    }

    /// Whether a vertex is seen.
    fn is_seen(&self, id: VertexId) -> bool {
        let (curve, index) = id;
        let is_locked = |curve: &Curve| curve.locked_vertices.contains(index);
        self.is_drawn(curve, density::disc, |seen| seen.spacing(index))
            || self.shown.selection.contains(id)
            || (self.document().curve(curve)).is_some_and(|curve| is_locked(curve))
    }

    /// Whether discs, or legs, are drawn at a spacing of a curve's polygon.
    fn is_drawn(
        &self,
        curve: CurveId,
        share: impl Fn(f64) -> f32,
        spacing: impl Fn(SeenChain) -> f64,
    ) -> bool {
        let View { analyses, pane, .. } = self.view;
        let known = analyses.get(curve).zip(pane.outlines.get(curve));
        known.is_none_or(|(analysis, outlined)| {
            let seen = outlined.float.seen(analysis.float());
            share(spacing(seen) * self.viewport().scale) > 0.0
        })
    }

    /// The nearest vertex of the closed S-polygon within some screen points of a place, with its distance in the model.
    fn clamped_within(&self, place: DVec2, reach: f64) -> Option<(f64, VertexId)> {
        if !self.shown.layers.shows(Layer::Clamped) {
            return None;
        }
        let id = self.shown_active()?;
        let model = self.viewport().to_model(place);
        let chain = self.view.analyses.get(id)?.clamped();
        let vertices = chain.vertices();
        let distance = |vertex: &DVec3| self.viewport().flatten(*vertex).distance(model);
        let distances = vertices.iter().map(distance).enumerate();
        let (index, nearest) = distances.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let outlines = &self.view.pane.outlines.get(id)?.clamped;
        let spacing = outlines.seen(chain).spacing(index);
        let is_seen = density::disc(spacing * self.viewport().scale) > 0.0;
        (is_seen && nearest <= reach * self.viewport().pixel()).then_some((nearest, (id, index)))
    }

    /// Find the place on a curve or on a reference under a place on the canvas. Where a curve follows
    /// a reference it is the curve that is found.
    pub(in crate::editor) fn curve(&self, place: DVec2) -> Option<CurveHit> {
        let curves = self.shown.layers.shows(Layer::Curve).then(|| self.curves());
        let behind = BEHIND * self.viewport().pixel();
        let after_active = |id: CurveId| match self.active() == Some(id) {
            true => 0.0,
            false => behind,
        };
        let curves = curves.into_iter().flatten();
        let curves = curves.map(|(id, _)| (id, after_active(id)));
        let references = self.shown_references();
        let references = references.map(|id| (id, behind + after_active(id)));
        let hits = curves.chain(references).filter_map(|(id, behind)| {
            let (distance, hit) = self.hit_on(id, place)?;
            Some((distance + behind, hit))
        });
        hits.min_by(|a, b| a.0.total_cmp(&b.0)).map(|hit| hit.1)
    }

    /// Find the place on a reference under a place on the canvas, on others than `left_out`.
    pub(in crate::editor) fn reference(
        &self,
        place: DVec2,
        left_out: Option<CurveId>,
    ) -> Option<CurveHit> {
        let others = self.shown_references().filter(|id| Some(*id) != left_out);
        let hits = others.filter_map(|id| self.hit_on(id, place));
        hits.min_by(|a, b| a.0.total_cmp(&b.0)).map(|hit| hit.1)
    }

    /// The place on one curve or reference under a place on the canvas, with its distance.
    fn hit_on(&self, id: CurveId, place: DVec2) -> Option<(f64, CurveHit)> {
        self.hit_within(id, place, REACH)
    }

    /// The same within some screen points.
    fn hit_within(&self, id: CurveId, place: DVec2, reach: f64) -> Option<(f64, CurveHit)> {
        let model = self.viewport().to_model(place);
        let reach = reach * self.viewport().pixel();
        let sampled = self.view.analyses.sampled(id)?;
        let outlines = &self.view.pane.outlines.get(id)?.curve;
        let (mut u, mut point, mut distance) = outlines.nearest(sampled, model, reach)?;
        let curve = id;
        let reference = self.view.analyses.reference(id);
        if reference.is_some_and(ReferenceAnalysis::has_points_apart) {
            // Nothing is drawn between the points.
            u = u.round();
            point = self.viewport().flatten(sampled.curve.jet(u).point);
            distance = point.distance(model);
            if distance > reach {
                return None;
            }
        }
        Some((distance, CurveHit { curve, u, point }))
    }

    /// Find the tooth of the active curve's comb whose tip is under a place, from its foot to its tip.
    /// Beside a vertex there is none: the press is meant for the vertex.
    pub(in crate::editor) fn tooth(&self, place: DVec2) -> Option<[DVec2; 2]> {
        if !self.shown.layers.shows(Layer::Comb) || self.is_beside_vertex(place) {
            return None;
        }
        let id = self.shown_active()?;
        if self.leg(place, APART).is_some() || self.hit_within(id, place, APART).is_some() {
            return None;
        }
        let reference = self.view.analyses.reference(id);
        if reference.is_some_and(|reference| !reference.is_smooth()) {
            return None;
        }
        let sampled = self.view.analyses.sampled(id)?;
        let (model, pixel) = (self.viewport().to_model(place), self.viewport().pixel());
        let outlines = &self.view.pane.outlines.get(id)?.curve;
        let (reach, shortest) = (REACH * pixel, SHORTEST_TOOTH * pixel);
        outlines.tooth(sampled, &self.view.comb, model, reach, shortest)
    }

    /// Find the feature of the active curve under a place, if they are shown.
    pub(in crate::editor) fn feature(&self, place: DVec2) -> Option<(CurveId, &'a FeatureRow)> {
        if !self.shown.layers.shows(Layer::Features) {
            return None;
        }
        let id = self.shown_active()?;
        let distance = |row: &FeatureRow| {
            let at = self.viewport().flatten(row.point);
            self.viewport().to_screen(at).distance(place)
        };
        let rows = self.features()?.rows.iter();
        let rows = rows.map(|row| (distance(row), row));
        let (nearest, row) = rows.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (nearest <= REACH).then_some((id, row))
    }

    /// The active curve or reference, unless it is hidden.
    fn shown_active(&self) -> Option<CurveId> {
        self.active().filter(|id| self.document().is_visible(*id))
    }

    /// Find the leg nearest to a place, within `reach` screen points, of those that are drawn.
    pub(in crate::editor) fn leg(&self, place: DVec2, reach: f64) -> Option<LegHit> {
        if !self.shown.layers.shows(Layer::Float) {
            return None;
        }
        let model = self.viewport().to_model(place);
        let mut best: Option<(f64, LegHit)> = None;
        for (curve, shape) in self.curves() {
            let vertices = shape.polygon.vertices();
            let count = vertices.len();
            for index in 0..count - usize::from(!shape.polygon.is_periodic()) {
                let ends = [vertices[index], vertices[(index + 1) % count]];
                let [from, to] = ends.map(|end| self.viewport().flatten(end));
                let leg = to - from;
                let along = (model - from).dot(leg) / leg.length_squared();
                let share = match along.is_nan() {
                    true => 0.5,
                    false => along.clamp(0.0, 1.0),
                };
                let point = from + share * leg;
                let distance = point.distance(model);
                if best.is_none_or(|(nearest, _)| distance < nearest)
                    && self.is_drawn(curve, density::leg, |seen| seen.leg_spacing(index))
                {
                    let hit = LegHit {
                        curve,
                        index,
                        share,
                        point,
                    };
                    best = Some((distance, hit));
                }
            }
        }
        let (distance, hit) = best?;
        (distance <= reach * self.viewport().pixel()).then_some(hit)
    }

    /// List the vertices inside a box, by opposite corners on the canvas: those of selected curves that are not
    /// locked. A curve that is alone on the canvas needs not be selected.
    pub(in crate::editor) fn vertices_in_box(&self, a: DVec2, b: DVec2) -> Vec<(CurveId, usize)> {
        if !self.shown.layers.shows(Layer::Float) {
            return Vec::new();
        }
        let within = self.view_box(a, b);
        let selection = self.shown.selection;
        let is_alone = self.curves().take(2).count() == 1 && selection.has_no_item();
        let curves = self.curves().filter(|(_, curve)| !curve.locked);
        let curves = curves.filter(|(id, _)| is_alone || selection.has_item(*id));
        let vertices = curves.flat_map(|(id, curve)| {
            let vertices = curve.polygon.vertices().iter().enumerate();
            vertices.map(move |(index, vertex)| ((id, index), self.viewport().flatten(*vertex)))
        });
        let found = vertices.filter(|(_, at)| within.holds(*at));
        found.map(|(id, _)| id).collect()
    }

    /// List the curves and references that a box meets, by opposite corners on the canvas, as far as they can be
    /// edited.
    pub(in crate::editor) fn items_in_box(&self, a: DVec2, b: DVec2) -> Vec<CurveId> {
        let document = self.document();
        let within = self.view_box(a, b);
        let curves = document
            .curves()
            .filter(|(_, it)| it.check_editable().is_ok());
        let curves = self.shown.layers.shows(Layer::Curve).then_some(curves);
        let references = document.references();
        let references = references.filter(|(_, it)| {
            // A picture lies behind what a box is drawn round.
            it.picture.is_none() && it.check_editable().is_ok()
        });
        let curves = curves.into_iter().flatten().map(|(id, _)| id);
        let items = curves.chain(references.map(|(id, _)| id));
        items.filter(|id| self.meets(*id, &within)).collect()
    }

    /// Whether a curve or a reference is seen to meet a box.
    fn meets(&self, id: CurveId, within: &ViewBox) -> bool {
        let known = self
            .view
            .analyses
            .sampled(id)
            .zip(self.view.pane.outlines.get(id));
        let Some((sampled, outlined)) = known else {
            return false;
        };
        if !outlined.curve.bounds().may_meet(within) {
            return false;
        }
        let mut last = None;
        (0..sampled.samples.pieces()).any(|piece| {
            let points = sampled.samples.piece(piece).iter();
            let mut points = points.map(|sample| self.viewport().flatten(sample.point));
            points.any(|at| {
                let before = last.replace(at);
                within.holds(at)
                    || before.is_some_and(|before| within.seen_length(before, at) > 0.0)
            })
        })
    }

    /// The box of the view plane between two opposite corners on the canvas.
    fn view_box(&self, a: DVec2, b: DVec2) -> ViewBox {
        let [a, b] = [a, b].map(|corner| self.viewport().to_model(corner));
        ViewBox {
            low: a.min(b),
            high: a.max(b),
            pixel: self.viewport().pixel(),
        }
    }

    /// The references that can be hit.
    pub(super) fn shown_references(&self) -> impl Iterator<Item = CurveId> {
        let references = self.document().references();
        let visible = references.filter(|(_, reference)| reference.visible);
        visible.map(|(id, _)| id)
    }

    /// The curves that can be hit.
    pub(in crate::editor) fn curves(&self) -> impl Iterator<Item = (CurveId, &'a Curve)> {
        let curves = self.document().curves();
        curves
            .filter(|(_, curve)| curve.visible)
            .map(|(id, curve)| (id, curve.as_ref()))
    }
}
