//! Making the scene: what the canvas shows for this frame.

use std::sync::Arc;

use glam::DVec2;

use crate::analysis::SampledCurve;
use crate::document::{Curve, CurveId, Reference};
use crate::editor::Editor;
use crate::editor::hand::tools::ToolKind;
use crate::editor::view::comb::CombSettings;
use crate::editor::view::curve_outlines::{CurveOutlines, PieceTrend};
use crate::editor::view::end_marks;
use crate::editor::view::feature_report::{FeatureMark, append_marks};
use crate::editor::view::ghost::Ghost;
use crate::editor::view::layers::{Layer, Layers};
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::{GAP, ViewBox};
use crate::editor::view::scene::{CurveScene, ProposalScene, Scene, VertexMark};
use crate::geometry::End;

/// Screen points around the canvas that are drawn too, so that strokes run off it.
const BORDER: f64 = 16.0;

/// Joints nearer together than this, in screen points, are not drawn.
const JOINT_SPACING: f64 = 12.0;

impl Editor {
    /// Make the scene of what is analysed.
    pub(in crate::editor) fn draw(&mut self) {
        let mut scene = std::mem::take(&mut self.view.scene);
        let mut view = self.view.viewport.view_box();
        let border = BORDER * view.pixel;
        view.low -= border;
        view.high += border;
        self.draw_curves(&view, &mut scene.curves);
        self.draw_ghost(&view, &mut scene);
        self.draw_proposal(&view, &mut scene);
        scene.ends.clear();
        if self.layers().shows(Layer::Targets) || self.hand.tool() == ToolKind::EndFit {
            self.draw_ends(&mut scene);
        }
        scene.marks = self.hand.tools.used().marks(&self.context());
        if let Some(measurement) = self.hand.tools.measurement() {
            scene.marks.extend(measurement.marks(&self.context()));
        }
        scene.marks.extend(self.operation_marks());
        scene.marks.extend(self.handle_marks());
        scene.marks.extend(self.flow_marks());
        scene.marks.extend(self.distance_marks());
        self.draw_guides(&mut scene.guides);
        scene.hover = self.hover();
        self.view.scene = scene;
    }

    fn draw_curves(&mut self, view: &ViewBox, scenes: &mut Vec<CurveScene>) {
        let active = self.hand.selection.active();
        let mut shown: Vec<(CurveId, Arc<Curve>)> = self
            .workspace
            .document()
            .curves()
            .filter(|(_, curve)| curve.visible)
            .map(|(id, curve)| (id, curve.clone()))
            .collect();
        let references = self.workspace.document().references();
        let mut references: Vec<(CurveId, Arc<Reference>)> = references
            .filter(|(_, reference)| reference.visible)
            .map(|(id, reference)| (id, reference.clone()))
            .collect();
        // What is active is drawn last, on top.
        shown.sort_by_key(|(id, _)| Some(*id) == active);
        references.sort_by_key(|(id, _)| Some(*id) == active);
        scenes.resize_with(references.len() + shown.len(), CurveScene::default);
        let (behind, before) = scenes.split_at_mut(references.len());
        for ((id, reference), scene) in references.iter().zip(behind) {
            scene.clear();
            scene.id = Some(*id);
            scene.is_reference = true;
            scene.active = Some(*id) == active;
            scene.locked = reference.locked;
            scene.colour = reference.colour;
            self.draw_reference(*id, view, scene);
        }
        for ((id, curve), scene) in shown.iter().zip(before) {
            scene.clear();
            scene.id = Some(*id);
            scene.is_reference = false;
            scene.active = Some(*id) == active;
            scene.locked = curve.locked;
            scene.colour = curve.colour;
            self.draw_curve(*id, curve, view, scene);
        }
    }

    fn draw_reference(&mut self, id: CurveId, view: &ViewBox, scene: &mut CurveScene) {
        let orientation = self.view.viewport.orientation;
        self.append_features(scene.active, view, &mut scene.features);
        let (layers, comb) = (self.layers(), self.view.comb);
        let outlined = self.view.outlines.get_mut(id);
        let Some((analysis, outlined)) = self.analyses.reference(id).zip(outlined) else {
            return;
        };
        let sampled = analysis.sampled();
        outlined.curve.append_curve(sampled, view, &mut scene.curve);
        let mut points = Vec::new();
        let chain = analysis.points();
        outlined.float.append_handles(chain, view, &mut points);
        let points = points.iter().filter_map(|index| chain.get(*index));
        let places = points.map(|point| orientation.flatten(point));
        scene.points.extend(places);
        if scene.active && analysis.is_smooth() {
            append_derived(&mut outlined.curve, sampled, view, (layers, comb), scene);
        }
    }

    /// Append the marks of the features of what is active.
    fn append_features(&self, active: bool, view: &ViewBox, out: &mut Vec<FeatureMark>) {
        if let Some(report) = self.features()
            && active
            && self.layers().shows(Layer::Features)
        {
            append_marks(report, &self.view.viewport.orientation, view, out);
        }
    }

    fn draw_curve(&mut self, id: CurveId, curve: &Curve, view: &ViewBox, scene: &mut CurveScene) {
        let (polygon, locked) = (&curve.polygon, &curve.locked_vertices);
        let (layers, comb, active) = (self.layers(), self.view.comb, scene.active);
        let viewport = self.view.viewport;
        let orientation = viewport.orientation;
        self.append_features(active, view, &mut scene.features);
        let outlined = self.view.outlines.get_mut(id);
        let Some((analysis, outlined)) = self.analyses.get(id).zip(outlined) else {
            return;
        };
        let sampled = analysis.sampled();
        if layers.shows(Layer::Curve) {
            outlined.curve.append_curve(sampled, view, &mut scene.curve);
            append_joints(sampled, &orientation, view, &mut scene.joints);
        }
        if layers.shows(Layer::Float) {
            let (outlines, chain) = (&mut outlined.float, analysis.float());
            outlines.append_legs(chain, view, &mut scene.float);
            let mut handles = Vec::new();
            outlines.append_handles(chain, view, &mut handles);
            let selection = &self.hand.selection;
            // A selected or locked vertex keeps its handle in a crowd.
            let crowd = handles.len() < polygon.vertices().len();
            if crowd {
                handles.extend(selection.of_curve(id).chain(locked.iter()));
                handles.sort_unstable();
                handles.dedup();
            }
            scene
                .vertices
                .extend(handles.into_iter().map(|index| VertexMark {
                    index,
                    at: viewport.flatten(polygon.vertex(index)),
                    selected: selection.contains((id, index)),
                    locked: locked.contains(index),
                }));
        }
        // Only the active curve shows what is derived from it: the others step back.
        if !active {
            return;
        }
        if layers.shows(Layer::Features) {
            // What is not proved yet must not be remembered as empty.
            if let Some(segments) = analysis.proved_segments() {
                for (trend, chain) in PieceTrend::ALL.into_iter().zip(&mut scene.pieces) {
                    let outlines = &mut outlined.curve;
                    outlines.append_trend(sampled, segments, trend, view, chain);
                }
            }
        }
        if layers.shows(Layer::Clamped) {
            let (outlines, chain) = (&mut outlined.clamped, analysis.clamped());
            outlines.append_legs(chain, view, &mut scene.clamped);
            let mut handles = Vec::new();
            outlines.append_handles(chain, view, &mut handles);
            let vertices = handles.iter().filter_map(|index| chain.get(*index));
            let places = vertices.map(|vertex| viewport.flatten(vertex));
            scene.clamped_vertices.extend(places);
        }
        append_derived(&mut outlined.curve, sampled, view, (layers, comb), scene);
    }

    /// The active curve before what is tried out on it, while Alt is held; before an operation
    /// without that.
    pub(in crate::editor) fn before(&self) -> Option<Arc<Curve>> {
        if self.hand.modifiers.alt && self.workspace.preview().is_some() {
            let active = self.hand.selection.active()?;
            return self.workspace.settled().curve(active).cloned();
        }
        self.before_operation()
    }

    fn draw_ghost(&mut self, view: &ViewBox, scene: &mut Scene) {
        scene.ghost.clear();
        scene.ghost_polygon.clear();
        let others = self.others_before_operation();
        let orientation = self.view.viewport.orientation;
        let shows_float = self.layers().shows(Layer::Float);
        if let Some(before) = self.before() {
            let chains = [&mut scene.ghost, &mut scene.ghost_polygon];
            self.view.ghost.append(&before, orientation, view, chains);
        }
        let ghosts = &mut self.view.other_ghosts;
        ghosts.resize_with(others.len(), Ghost::default);
        for (ghost, other) in ghosts.iter_mut().zip(&others) {
            scene.ghost.push(GAP);
            scene.ghost_polygon.push(GAP);
            let chains = [&mut scene.ghost, &mut scene.ghost_polygon];
            ghost.append(other, orientation, view, chains);
        }
        if !shows_float {
            scene.ghost_polygon.clear();
        }
    }

    /// The curve that a click would make now.
    fn draw_proposal(&mut self, view: &ViewBox, scene: &mut Scene) {
        scene.proposal = ProposalScene::default();
        if let Some(polygon) = self.proposal() {
            let (orientation, layers) = (self.view.viewport.orientation, self.layers());
            let (proposed, scene) = (&mut self.view.proposed, &mut scene.proposal);
            proposed.draw(polygon, orientation, layers, view, scene);
        }
    }

    fn draw_ends(&self, scene: &mut Scene) {
        let fitting = self.hand.tool() == ToolKind::EndFit;
        let active = self.hand.selection.active();
        for (id, curve) in self.workspace.document().curves() {
            if !curve.visible || curve.polygon.is_periodic() {
                continue;
            }
            for end in End::BOTH {
                let chosen =
                    fitting && Some(id) == active && end == self.hand.tools.end_fit.settings.end;
                let document = self.workspace.document();
                let matched = document.match_of(id, end);
                let matched = matched.map(|matched| document.meets(matched));
                let viewport = &self.view.viewport;
                let marks = end_marks::marks(curve, end, chosen, matched, viewport);
                scene.ends.extend(marks.map(|mut marks| {
                    if !self.layers().shows(Layer::Float) {
                        marks.terminal.clear();
                    }
                    marks
                }));
            }
        }
    }
}

impl CurveScene {
    fn clear(&mut self) {
        self.teeth.clear();
        self.joints.clear();
        self.vertices.clear();
        self.features.clear();
        self.pieces.iter_mut().for_each(Vec::clear);
        for chain in [
            &mut self.comb,
            &mut self.evolute,
            &mut self.clamped,
            &mut self.clamped_vertices,
            &mut self.float,
            &mut self.curve,
            &mut self.points,
        ] {
            chain.clear();
        }
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
    if layers.shows(Layer::Comb) {
        outlines.append_comb(sampled, view, &comb, &mut scene.comb);
        outlines.append_teeth(sampled, view, &comb, &mut scene.teeth);
    }
}

/// Append the joints between pieces, with the curve's unit normals, unless they crowd.
fn append_joints(
    SampledCurve { curve, samples }: SampledCurve<'_>,
    eye: &Orientation,
    view: &ViewBox,
    out: &mut Vec<[DVec2; 2]>,
) {
    let pieces = samples.pieces();
    let joint = |piece: usize| samples.piece(piece).first();
    let mut kept = GAP;
    // Where a whole piece is smaller than the spacing everywhere there is nothing to draw.
    if pieces as f64 * JOINT_SPACING * view.pixel > 4.0 * extent(view) {
        return;
    }
    let from = usize::from(!curve.is_periodic());
    for sample in (from..pieces).filter_map(joint) {
        let at = eye.flatten(sample.point);
        let apart = kept.is_nan() || at.distance(kept) >= JOINT_SPACING * view.pixel;
        if apart && at.cmpge(view.low).all() && at.cmple(view.high).all() {
            out.push([at, eye.flatten(sample.normal)]);
            kept = at;
        }
    }
}

fn extent(view: &ViewBox) -> f64 {
    let size = view.high - view.low;
    size.x + size.y
}
