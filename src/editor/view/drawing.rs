//! Making the scene: what the canvas shows for this frame.

use std::sync::Arc;

use glam::DVec2;

use crate::analysis::SampledCurve;
use crate::document::{Curve, CurveId, Reference};
use crate::editor::Editor;
use crate::editor::hand::snapping::{Carried, snap_to_point};
use crate::editor::hand::tools::ToolKind;
use crate::editor::view::comb::CombSettings;
use crate::editor::view::curve_outlines::{CurveOutlines, PieceTrend};
use crate::editor::view::density::{disc, disc_among_kept};
use crate::editor::view::end_marks;
use crate::editor::view::feature_report::{FeatureMark, append_marks};
use crate::editor::view::ghost::Ghost;
use crate::editor::view::layers::{Layer, Layers};
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::{GAP, ViewBox};
use crate::editor::view::scene::{ClampedMark, CurveScene, Mark, ProposalScene, Scene, VertexMark};
use crate::geometry::End;

/// Screen points around the canvas that are drawn too, so that strokes run off it.
const BORDER: f64 = 16.0;

/// Where pieces are smaller than this on the whole, in screen points, joints are not looked at.
const JOINT_SPACING: f64 = 6.0;

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
        scene.marks.extend(self.snap_name());
        self.draw_guides(&mut scene.guides);
        scene.hover = self.hover();
        self.view.scene = scene;
    }

    /// The name of what a click of a tool that sets points would snap to.
    fn snap_name(&self) -> Option<Mark> {
        let sets_points = matches!(
            self.hand.tool(),
            ToolKind::Draw | ToolKind::AddVertex | ToolKind::Measure
        );
        // With Shift they keep to a direction instead.
        if !sets_points || self.hand.modifiers.shift || self.is_trying() {
            return None;
        }
        let context = self.context();
        let (at, carried) = (context.pointer?, Carried::default());
        let snap = match self.hand.tool() {
            // What is measured is attracted without the switch.
            ToolKind::Measure if context.modifiers.ctrl => None,
            ToolKind::Measure => snap_to_point(at, context.before, &carried, context.viewport),
            _ => context.snap(at, &carried),
        }?;
        let at = self.view.viewport.flatten(snap.point);
        Some(Mark::Name(at, snap.name))
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
        outlined.float.append_points(chain, view, &mut points);
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
        let locked = &curve.locked_vertices;
        let (layers, comb, active) = (self.layers(), self.view.comb, scene.active);
        let viewport = self.view.viewport;
        let orientation = viewport.orientation;
        self.append_features(active, view, &mut scene.features);
        let shows_bands = layers.shows(Layer::Features) && self.view.shows_bands();
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
            let (outlines, chain) = (&outlined.float, analysis.float());
            outlines.append_legs(chain, None, view, &mut scene.float);
            let selection = &self.hand.selection;
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
            let mut kept: Vec<usize> = selection.of_curve(id).chain(locked.iter()).collect();
            kept.sort_unstable();
            kept.dedup();
            let seen = outlines.seen(chain);
            for (place, index) in kept.iter().enumerate() {
                let last = place.checked_sub(1).and_then(|last| kept.get(last));
                let is_beside = last.is_some_and(|last| last + 1 == *index)
                    || kept.get(place + 1) == Some(&(index + 1));
                let size = match is_beside {
                    true => disc_among_kept(seen.spacing(*index) / view.pixel),
                    false => 1.0,
                };
                marks.extend(seen.place(*index).map(|at| mark(*index, at, size)));
            }
        }
        // Only the active curve shows what is derived from it: the others step back.
        if !active {
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
            outlines.append_legs(chain, covering, view, &mut scene.clamped);
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
            let chains = (&mut scene.ghost, &mut scene.ghost_polygon);
            self.view.ghost.append(&before, orientation, view, chains);
        }
        let ghosts = &mut self.view.other_ghosts;
        ghosts.resize_with(others.len(), Ghost::default);
        for (ghost, other) in ghosts.iter_mut().zip(&others) {
            scene.ghost.push(GAP);
            let chains = (&mut scene.ghost, &mut scene.ghost_polygon);
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
            let changed = self.hand.selection.active();
            let changed = changed.filter(|_| self.hand.tool() != ToolKind::Draw);
            let document = self.workspace.document();
            scene.id = Some(changed.unwrap_or(document.next_id()));
            scene.colour = changed.and_then(|id| document.curve(id)?.colour);
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
        self.clamped_vertices.clear();
        self.clamped.clear();
        self.float.clear();
        for chain in [
            &mut self.comb,
            &mut self.evolute,
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

/// Append the joints between pieces, with the curve's normals, which are shorter where the joints crowd.
fn append_joints(
    SampledCurve { curve, samples }: SampledCurve<'_>,
    eye: &Orientation,
    view: &ViewBox,
    out: &mut Vec<[DVec2; 2]>,
) {
    let pieces = samples.pieces();
    // Where a whole piece is smaller than that everywhere there is nothing to draw.
    if pieces as f64 * JOINT_SPACING * view.pixel > 4.0 * extent(view) {
        return;
    }
    let ends = |piece: usize| {
        let own = samples.piece(piece);
        Some((own.first()?, own.last()?))
    };
    let from = usize::from(!curve.is_periodic());
    for piece in from..pieces {
        let before = ends(if piece == 0 { pieces - 1 } else { piece - 1 });
        let Some(((start, joint), (_, end))) = before.zip(ends(piece)) else {
            continue;
        };
        let [last, at, next] = [start, joint, end].map(|sample| eye.flatten(sample.point));
        let size = disc(0.5 * (last.distance(at) + at.distance(next)) / view.pixel);
        if size > 0.0 && view.holds(at) {
            out.push([at, f64::from(size) * eye.flatten(joint.normal)]);
        }
    }
}

fn extent(view: &ViewBox) -> f64 {
    let size = view.high - view.low;
    size.x + size.y
}
