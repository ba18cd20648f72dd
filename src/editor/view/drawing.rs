//! The scene of one frame, made of analyses and outlines.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec2;

use crate::analysis::{Item, SampledCurve};
use crate::document::{Colour, Curve, CurveId, Document};
use crate::editor::selection::Selection;
use crate::editor::view::comb::CombSettings;
use crate::editor::view::curve_outlines::{CurveOutlines, PieceTrend};
use crate::editor::view::density::disc_among_kept;
use crate::editor::view::end_marks::{self, EndFitMarks};
use crate::editor::view::feature_report::{FeatureMark, append_marks};
use crate::editor::view::layers::{Layer, Layers};
use crate::editor::view::outline::{GAP, ViewBox};
use crate::editor::view::outlines::Sketch;
use crate::editor::view::overlay::Overlay;
use crate::editor::view::scene::{ClampedMark, CurveScene, PictureScene, SceneSource, VertexMark};
use crate::editor::view::shown::Shown;
use crate::editor::view::view::View;
use crate::geometry::{End, FloatPolygon};

/// Screen points around the canvas that are drawn too, so that strokes run off it.
const BORDER: f64 = 16.0;

impl View {
    /// Make the scene of the analysed curves.
    pub(in crate::editor) fn draw(&mut self, shown: Shown<'_>, overlay: &mut Overlay) {
        let mut scene = std::mem::take(&mut self.pane.scene);
        let mut view = self.pane.viewport.view_box();
        let border = BORDER * view.pixel;
        view.low -= border;
        view.high += border;
        scene.pictures.clear();
        scene.pictures.extend(self.drawn_pictures(shown.document()));
        self.draw_curves(shown, &view, &mut scene.curves);
        for curve in &mut scene.curves {
            curve.unreached = curve.id.is_some_and(|id| overlay.unreached.contains(&id));
        }
        self.draw_ghosts(shown, overlay, &view, &mut scene.ghost);
        scene.proposal.clear();
        if let Some((polygon, changed)) = overlay.proposal.take() {
            self.draw_proposal(shown, polygon, changed, &view, &mut scene.proposal);
        }
        scene.ends.clear();
        if shown.layers.shows(Layer::Targets) || overlay.fitted_end.is_some() {
            self.draw_ends(shown, overlay.fitted_end, &mut scene.ends);
        }
        let sight = self.sight(shown);
        scene.marks = std::mem::take(&mut overlay.marks);
        scene.marks.extend(sight.line_marks());
        scene.marks.extend(sight.flow_marks());
        if !overlay.measures_points {
            scene.marks.extend(sight.deviation_marks());
        }
        scene.marks.extend(sight.joint_marks());
        sight.draw_guides(&mut scene.guides);
        scene.hover = sight.hover(overlay);
        self.pane.scene = scene;
    }

    /// The pictures of visible references, in their order.
    fn drawn_pictures(&self, document: &Document) -> impl Iterator<Item = PictureScene> {
        let orientation = &self.pane.viewport.orientation;
        let references = document.references().filter(|(_, it)| it.visible);
        references.filter_map(move |(_, reference)| {
            let (picture, [corner, across, up]) = reference.framed()?;
            let corner = orientation.flatten(corner);
            Some(PictureScene {
                corner,
                sides: [across, up].map(|side| orientation.flatten(side)),
                opacity: picture.opacity,
                picture: match self.pictures.get(&picture.source) {
                    Some(picture) => picture.clone(),
                    None => Err("The picture is being read".to_owned()),
                },
            })
        })
    }

    fn draw_curves(&mut self, shown: Shown<'_>, view: &ViewBox, scenes: &mut Vec<CurveScene>) {
        let (document, active) = (shown.document(), shown.active());
        let mut curves: Vec<_> = document.curves().filter(|(_, it)| it.visible).collect();
        let references = document.references();
        let mut references: Vec<_> = references.filter(|(_, it)| it.visible).collect();
        self.evolute.is_hidden &= active.is_some();
        // The active curve is drawn last, on top.
        curves.sort_by_key(|(id, _)| Some(*id) == active);
        references.sort_by_key(|(id, _)| Some(*id) == active);
        scenes.resize_with(references.len() + curves.len(), CurveScene::default);
        let (behind, before) = scenes.split_at_mut(references.len());
        for ((id, reference), scene) in references.into_iter().zip(behind) {
            let source = self.scene_source(shown, (id, Item::Reference(reference.clone())), view);
            if source.is_none() || scene.source != source {
                scene.begin(id, shown.selection, reference.locked, reference.colour);
                scene.is_reference = true;
                self.draw_reference(shown, id, view, scene);
                scene.source = source;
            }
        }
        for ((id, curve), scene) in curves.into_iter().zip(before) {
            let source = self.scene_source(shown, (id, Item::Curve(curve.clone())), view);
            if source.is_none() || scene.source != source {
                scene.begin(id, shown.selection, curve.locked, curve.colour);
                self.draw_curve(shown, id, curve, view, scene);
                scene.source = source;
            }
        }
    }

    /// What the scene of an inactive curve or reference is made of, as long as none of its vertices is selected; `None`
    /// of others.
    fn scene_source(
        &self,
        shown: Shown<'_>,
        (id, item): (CurveId, Item),
        view: &ViewBox,
    ) -> Option<SceneSource> {
        let selection = shown.selection;
        let is_plain = shown.active() != Some(id) && selection.of_curve(id).next().is_none();
        is_plain.then(|| SceneSource {
            id,
            item,
            view: *view,
            orientation: self.pane.viewport.orientation,
            layers: shown.layers,
            comb: self.combs_of.takes(id, selection).then_some(self.comb),
            selected: selection.has_several_items() && selection.has_item(id),
        })
    }

    fn draw_reference(
        &mut self,
        shown: Shown<'_>,
        id: CurveId,
        view: &ViewBox,
        scene: &mut CurveScene,
    ) {
        let orientation = self.pane.viewport.orientation;
        self.append_features(shown, scene.active, view, &mut scene.features);
        let (layers, comb) = (shown.layers, self.comb);
        let outlined = self.pane.outlines.get_mut(id);
        let Some((analysis, outlined)) = self.analyses.reference(id).zip(outlined) else {
            return;
        };
        let sampled = analysis.sampled();
        if !analysis.has_points_apart() {
            outlined.curve.append_curve(sampled, view, &mut scene.curve);
        }
        let mut points = Vec::new();
        let chain = analysis.points();
        outlined.float.append_points(chain, view, &mut points);
        let points = points.iter().filter_map(|index| chain.get(*index));
        let places = points.map(|point| orientation.flatten(point));
        scene.points.extend(places);
        if !analysis.is_smooth() {
            return;
        }
        if scene.active {
            append_derived(&mut outlined.curve, sampled, view, (layers, comb), scene);
            self.evolute.hide(&mut scene.evolute, view);
        } else if self.combs_of.takes(id, shown.selection) {
            append_comb(&mut outlined.curve, sampled, view, (layers, comb), scene);
        }
    }

    /// Append the marks of the active item's features.
    fn append_features(
        &self,
        shown: Shown<'_>,
        active: bool,
        view: &ViewBox,
        out: &mut Vec<FeatureMark>,
    ) {
        if let Some(report) = self.sight(shown).features()
            && active
            && shown.layers.shows(Layer::Features)
        {
            append_marks(report, &self.pane.viewport.orientation, view, out);
        }
    }

    fn draw_curve(
        &mut self,
        shown: Shown<'_>,
        id: CurveId,
        curve: &Curve,
        view: &ViewBox,
        scene: &mut CurveScene,
    ) {
        let locked = &curve.locked_vertices;
        let (layers, comb, active) = (shown.layers, self.comb, scene.active);
        self.append_features(shown, active, view, &mut scene.features);
        let shows_bands = layers.shows(Layer::Features) && !self.bands_only_plotted;
        let outlined = self.pane.outlines.get_mut(id);
        let Some((analysis, outlined)) = self.analyses.get(id).zip(outlined) else {
            return;
        };
        let sampled = analysis.sampled();
        if layers.shows(Layer::Curve) {
            outlined.curve.append_curve(sampled, view, &mut scene.curve);
            outlined
                .curve
                .append_joints(sampled, view, &mut scene.joints);
        }
        if layers.shows(Layer::Float) {
            let (outlines, chain) = (&outlined.float, analysis.float());
            let tail = curve.polygon.tail_legs();
            outlines.append_legs(chain, tail, None, view, &mut scene.float);
            let selection = shown.selection;
            let mark = |index: usize, at: DVec2, size: f32| VertexMark {
                index,
                at,
                selected: selection.contains((id, index)),
                locked: locked.contains(index),
                size,
            };
            let marks = &mut scene.vertices;
            outlines.append_discs(chain, view, |index, at, size| {
                let mark = mark(index, at, size);
                if !(mark.selected || mark.locked) {
                    marks.push(mark);
                }
            });
            // A selected or locked vertex keeps its disc in a crowd, smaller where its neighbours do too.
            let kept: BTreeSet<usize> = selection.of_curve(id).chain(locked.iter()).collect();
            let seen = outlines.seen(chain);
            for index in kept.iter().copied() {
                let is_kept = |other: Option<usize>| other.is_some_and(|it| kept.contains(&it));
                let size = match is_kept(index.checked_sub(1)) || is_kept(Some(index + 1)) {
                    true => disc_among_kept(seen.spacing(index) / view.pixel),
                    false => 1.0,
                };
                marks.extend(seen.place(index).map(|at| mark(index, at, size)));
            }
        }
        // Only the active curve shows what is derived from it but its comb: the others step back.
        if !active {
            if self.combs_of.takes(id, shown.selection) {
                append_comb(&mut outlined.curve, sampled, view, (layers, comb), scene);
            }
            return;
        }
        if shows_bands {
            // What is not proved yet must not be remembered as empty.
            if let Some(segments) = analysis.proved_segments() {
                for (trend, chain) in PieceTrend::ALL.into_iter().zip(&mut scene.pieces) {
                    let outlines = &mut outlined.curve;
                    outlines.append_trend(sampled, segments, trend, view, chain);
                }
            }
        }
        if layers.shows(Layer::Clamped) {
            let (outlines, chain) = (&outlined.clamped, analysis.clamped());
            let float = outlined.float.seen(analysis.float());
            let covering = layers.shows(Layer::Float).then_some(&float);
            outlines.append_legs(chain, 0, covering, view, &mut scene.clamped);
            let seen = outlines.seen(chain);
            let reach = curve.polygon.degree();
            let covers = |index| {
                covering.is_some_and(|float| seen.coincides(float, index, reach, view.pixel))
            };
            outlines.append_discs(chain, view, |index, at, size| {
                if !covers(index) {
                    scene.clamped_vertices.push(ClampedMark { at, size });
                }
            });
        }
        append_derived(&mut outlined.curve, sampled, view, (layers, comb), scene);
        self.evolute.hide(&mut scene.evolute, view);
    }

    fn draw_ghosts(
        &mut self,
        shown: Shown<'_>,
        overlay: &Overlay,
        view: &ViewBox,
        scene: &mut CurveScene,
    ) {
        scene.clear();
        let eye = self.pane.viewport.orientation;
        if let Some(before) = &overlay.before {
            self.pane.ghost.append(before, eye, view, scene, false);
        }
        let others = &overlay.others_before;
        self.pane
            .other_ghosts
            .resize_with(others.len(), Sketch::default);
        for (ghost, other) in self.pane.other_ghosts.iter_mut().zip(others) {
            scene.curve.push(GAP);
            ghost.append(other, eye, view, scene, false);
        }
        if !shown.layers.shows(Layer::Float) {
            scene.float.clear();
        }
    }

    /// Draw the curve that a click would make.
    fn draw_proposal(
        &mut self,
        shown: Shown<'_>,
        polygon: FloatPolygon,
        changed: Option<CurveId>,
        view: &ViewBox,
        scene: &mut CurveScene,
    ) {
        let document = shown.document();
        scene.id = Some(changed.unwrap_or(document.next_id()));
        scene.colour = changed.and_then(|id| document.curve(id)?.colour);
        let curve = Arc::new(Curve::new(String::new(), polygon));
        let (eye, clamped) = (
            self.pane.viewport.orientation,
            shown.layers.shows(Layer::Clamped),
        );
        self.pane.proposed.append(&curve, eye, view, scene, clamped);
    }

    /// Draw the targets of all ends, and the marks of the end that the end-fit tool corrects.
    fn draw_ends(&self, shown: Shown<'_>, fitted: Option<End>, out: &mut Vec<EndFitMarks>) {
        let document = shown.document();
        let open = |curve: &Curve| curve.visible && !curve.polygon.is_periodic();
        for (id, curve) in document.curves().filter(|(_, curve)| open(curve)) {
            for end in End::BOTH {
                let chosen = shown.active() == Some(id) && fitted == Some(end);
                let matched = document.match_of(id, end);
                let matched = matched.map(|matched| document.meets(matched));
                let marks = end_marks::marks(curve, end, chosen, matched, &self.pane.viewport);
                out.extend(marks.map(|mut marks| {
                    if !shown.layers.shows(Layer::Float) {
                        marks.terminal.clear();
                    }
                    marks
                }));
            }
        }
    }
}

impl CurveScene {
    /// Begin the scene of a curve or a reference, with the room of what it held.
    fn begin(&mut self, id: CurveId, selection: &Selection, locked: bool, colour: Option<Colour>) {
        self.clear();
        self.id = Some(id);
        self.is_reference = false;
        self.active = Some(id) == selection.active();
        self.selected = selection.has_several_items() && selection.has_item(id);
        self.locked = locked;
        self.colour = colour;
    }

    fn clear(&mut self) {
        self.source = None;
        self.id = None;
        self.colour = None;
        self.teeth.clear();
        self.joints.clear();
        self.vertices.clear();
        self.features.clear();
        self.pieces.iter_mut().for_each(Vec::clear);
        self.clamped_vertices.clear();
        self.clamped.clear();
        self.float.clear();
        self.comb.clear();
        self.evolute.clear();
        self.curve.clear();
        self.points.clear();
    }
}

/// Append the evolute and the comb, as far as they are shown.
fn append_derived(
    outlines: &mut CurveOutlines,
    sampled: SampledCurve<'_>,
    view: &ViewBox,
    (layers, comb): (Layers, CombSettings),
    scene: &mut CurveScene,
) {
    if layers.shows(Layer::Evolute) {
        outlines.append_evolute(sampled, view, &mut scene.evolute);
    }
    append_comb(outlines, sampled, view, (layers, comb), scene);
}

/// Append the comb, if combs are shown.
fn append_comb(
    outlines: &mut CurveOutlines,
    sampled: SampledCurve<'_>,
    view: &ViewBox,
    (layers, comb): (Layers, CombSettings),
    scene: &mut CurveScene,
) {
    if layers.shows(Layer::Comb) {
        outlines.append_comb(sampled, view, &comb, &mut scene.comb);
        outlines.append_teeth(sampled, view, &comb, &mut scene.teeth);
    }
}
