//! Making the scene: what the canvas shows for this frame.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::analysis::{CurveAnalysis, GAP, Orientation, PieceTrend, ViewBox};
use crate::document::{Curve, CurveId};
use crate::editor::Editor;
use crate::editor::hand::tools::ToolKind;
use crate::editor::view::end_marks;
use crate::editor::view::feature_report::append_marks;
use crate::editor::view::hit::REACH;
use crate::editor::view::layers::Layer;
use crate::editor::view::scene::{CurveScene, HoverScene, Scene, VertexMark};
use crate::geometry::{End, FloatPolygon, Jet, figure};

/// Screen points around the canvas that are drawn too, so that strokes run off it.
const BORDER: f64 = 16.0;

/// Chords in half of the osculating circle.
const CIRCLE_STEPS: i32 = 64;

/// Joints nearer together than this, in screen points, are not drawn.
const JOINT_SPACING: f64 = 12.0;

/// Remember the analysis of a curve as it was, which changes rarely while it is drawn often.
#[derive(Debug, Default)]
pub(in crate::editor) struct Ghost {
    analysis: Option<CurveAnalysis>,
}

impl Ghost {
    fn append(
        &mut self,
        curve: &Arc<Curve>,
        orientation: Orientation,
        view: &ViewBox,
        out: &mut Vec<DVec2>,
    ) {
        let analysis = self
            .analysis
            .get_or_insert_with(|| CurveAnalysis::new(curve.clone(), orientation));
        analysis.set_orientation(orientation);
        analysis.update(curve);
        let (outlines, sampled) = analysis.outlines();
        outlines.append_curve(sampled, view, out);
    }
}

impl Editor {
    /// Bring what is hovered up to date, without all that is drawn besides.
    pub fn update_hover(&mut self) {
        self.analyses.update(self.workspace.document());
        self.view.scene.hover = self.hover();
    }

    /// Bring the scene up to date and return it.
    pub fn scene(&mut self) -> &Scene {
        self.analyses.update(self.workspace.document());
        let mut scene = std::mem::take(&mut self.view.scene);
        let mut view = self.view.viewport.view_box();
        let border = BORDER * view.pixel;
        view.low -= border;
        view.high += border;
        self.draw_curves(&view, &mut scene.curves);
        self.draw_ghost(&view, &mut scene.ghost);
        scene.ends.clear();
        if self.layers().shows(Layer::Targets) || self.hand.tool() == ToolKind::EndFit {
            self.draw_ends(&mut scene);
        }
        // Tools look at the scene's teeth, so it is put back before they draw.
        scene.hover = None;
        scene.marks.clear();
        self.view.scene = scene;
        let mut marks = self.hand.tools.used().marks(&self.context());
        marks.extend(self.operation_marks());
        let hover = self.hover();
        self.view.scene.marks = marks;
        self.view.scene.hover = hover;
        &self.view.scene
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
        // The active curve is drawn last, on top.
        shown.sort_by_key(|(id, _)| Some(*id) == active);
        scenes.resize_with(shown.len(), CurveScene::default);
        for ((id, curve), scene) in shown.iter().zip(scenes.iter_mut()) {
            scene.clear();
            scene.id = Some(*id);
            scene.active = Some(*id) == active;
            scene.locked = curve.locked;
            scene.colour = curve.colour;
            self.draw_curve(*id, &curve.polygon, view, scene);
        }
    }

    fn draw_curve(
        &mut self,
        id: CurveId,
        polygon: &FloatPolygon,
        view: &ViewBox,
        scene: &mut CurveScene,
    ) {
        let (layers, comb, active) = (self.layers(), self.view.comb, scene.active);
        let orientation = self.view.viewport.orientation;
        let report = active.then(|| self.known_features()).flatten();
        let Some(analysis) = self.analyses.get(id) else {
            return;
        };
        if layers.shows(Layer::Curve) {
            let (outlines, sampled) = analysis.outlines();
            outlines.append_curve(sampled, view, &mut scene.curve);
            append_joints(analysis, &orientation, view, &mut scene.joints);
        }
        if layers.shows(Layer::Float) {
            let (outlines, chain) = analysis.float_outlines();
            outlines.append_legs(chain, view, &mut scene.float);
            let mut handles = Vec::new();
            outlines.append_handles(chain, view, &mut handles);
            let selection = &self.hand.selection;
            // A selected vertex keeps its handle in a crowd.
            let crowd = handles.len() < polygon.vertices().len();
            if crowd {
                handles.extend(selection.of_curve(id));
                handles.sort_unstable();
                handles.dedup();
            }
            scene
                .vertices
                .extend(handles.into_iter().map(|index| VertexMark {
                    index,
                    at: self.view.viewport.flatten(polygon.vertex(index)),
                    selected: selection.contains((id, index)),
                }));
        }
        // Only the active curve shows what is derived from it: the others step back.
        if !active {
            return;
        }
        if layers.shows(Layer::Features) {
            for (trend, chain) in PieceTrend::ALL.into_iter().zip(&mut scene.pieces) {
                analysis.append_trend(trend, view, chain);
            }
            if let Some(report) = &report {
                append_marks(report, &orientation, view, &mut scene.features);
            }
        }
        if layers.shows(Layer::Clamped) {
            let (outlines, chain) = analysis.clamped_outlines();
            outlines.append_legs(chain, view, &mut scene.clamped);
            let mut handles = Vec::new();
            outlines.append_handles(chain, view, &mut handles);
            let vertices = chain.vertices();
            scene.clamped_vertices.extend(
                handles
                    .iter()
                    .filter_map(|index| vertices.get(*index))
                    .map(|vertex| self.view.viewport.flatten(*vertex)),
            );
        }
        let (outlines, sampled) = analysis.outlines();
        if layers.shows(Layer::Evolute) {
            outlines.append_evolute(sampled, view, &mut scene.evolute);
        }
        if layers.shows(Layer::Comb) {
            outlines.append_comb(sampled, view, &comb, &mut scene.comb);
            outlines.append_teeth(sampled, view, &comb, &mut scene.teeth);
        }
    }

    /// The curve before the gesture, while Alt is held; or before the last end correction.
    fn draw_ghost(&mut self, view: &ViewBox, out: &mut Vec<DVec2>) {
        out.clear();
        let held = self.hand.modifiers.alt && self.workspace.preview().is_some();
        let before = if held {
            let active = self.hand.selection.active();
            active
                .and_then(|id| self.workspace.settled().curve(id))
                .cloned()
        } else {
            self.before_operation()
        };
        if let Some(before) = before {
            self.view
                .ghost
                .append(&before, self.view.viewport.orientation, view, out);
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
                let marks = end_marks::marks(curve, end, chosen, &self.view.viewport);
                scene.ends.extend(marks.map(|mut marks| {
                    if !self.layers().shows(Layer::Float) {
                        marks.terminal.clear();
                    }
                    marks
                }));
            }
        }
    }

    fn hover(&self) -> Option<HoverScene> {
        if let Some(hover) = self.hover_from_panels() {
            return Some(hover);
        }
        let place = self.hand.gestures.pointer()?;
        let context = self.context();
        if self.hand.gestures.is_dragging() {
            let held = self.held_vertex()?;
            return self.vertex_hover(held);
        }
        if self.hand.gestures.is_panning()
            || !matches!(
                self.hand.tool(),
                ToolKind::Select
                    | ToolKind::Delete
                    | ToolKind::EndFit
                    | ToolKind::Rotate
                    | ToolKind::Scale
            )
        {
            return None;
        }
        if let Some(vertex) = context.hits.vertex(place) {
            return self.vertex_hover(vertex);
        }
        if let (ToolKind::Select, Some((id, index))) =
            (self.hand.tool(), context.hits.clamped_vertex(place))
        {
            return self.clamped_hover(id, index);
        }
        if let Some((id, mark)) = self
            .hand
            .selection
            .active()
            .zip(self.feature_mark(place, REACH))
        {
            let mut hover = self.curve_hover(id, mark.u);
            if let Some(HoverScene::Curve { text, .. }) = &mut hover {
                *text = format!("{}\n{text}", mark.kind.label());
            }
            return hover;
        }
        let hit = context.hits.curve(place)?;
        self.curve_hover(hit.curve, hit.u)
    }

    /// The one vertex that a drag moves.
    fn held_vertex(&self) -> Option<(CurveId, usize)> {
        let mut selected = self.hand.selection.vertices();
        let only = selected.next().filter(|_| selected.next().is_none());
        only.filter(|_| self.hand.tool() == ToolKind::Select && self.workspace.preview().is_some())
    }

    fn hover_from_panels(&self) -> Option<HoverScene> {
        let id = self.hand.selection.active()?;
        if let Some(index) = self.view.hovered.vertex {
            return self.vertex_hover((id, index));
        }
        let u = self
            .analyses
            .peek(id)?
            .parameter_at_length(self.view.hovered.length?);
        self.curve_hover(id, u)
    }

    fn vertex_hover(&self, (id, index): (CurveId, usize)) -> Option<HoverScene> {
        let curve = self.document().curve(id).filter(|curve| curve.visible)?;
        let vertex = *curve.polygon.vertices().get(index)?;
        let mut text = format!(
            "vertex {index}\nx {}\ny {}",
            figure(vertex.x),
            figure(vertex.y)
        );
        if vertex.z != 0.0 {
            text += &format!("\nz {}", figure(vertex.z));
        }
        if let Some(weights) = curve.polygon.weights() {
            text += &format!("\nw {}", figure(*weights.get(index)?));
        }
        if self.hand.selection.active() != Some(id) {
            text = format!("{}\n{text}", curve.name);
        }
        Some(HoverScene::Vertex {
            at: self.view.viewport.flatten(vertex),
            text,
        })
    }

    fn clamped_hover(&self, id: CurveId, index: usize) -> Option<HoverScene> {
        let analysis = self.analyses.peek(id)?;
        let vertex = *analysis.clamped_vertices().get(index)?;
        let mut text = format!(
            "closed vertex {index}\nx {}\ny {}",
            figure(vertex.x),
            figure(vertex.y)
        );
        if !analysis.is_planar() {
            text += &format!("\nz {}", figure(vertex.z));
        }
        let polygon = &analysis.curve().polygon;
        if let Some(times) = polygon.clamped_vertex_amplification(index) {
            text += &format!("\nfloat × {}", figure(times));
        }
        Some(HoverScene::Handle {
            at: self.view.viewport.flatten(vertex),
            text,
        })
    }

    fn curve_hover(&self, id: CurveId, u: f64) -> Option<HoverScene> {
        let curve = self.document().curve(id).filter(|curve| curve.visible)?;
        let planar = self.analyses.peek(id)?.is_planar();
        let jet = curve.polygon.jet(u);
        let curvature = jet.curvature_of(planar);
        let radius = 1.0 / curvature.abs();
        let mut lines = vec![
            format!("u {u:.4}"),
            format!("x {}", figure(jet.point.x)),
            format!("y {}", figure(jet.point.y)),
        ];
        if !planar {
            lines.push(format!("z {}", figure(jet.point.z)));
        }
        lines.push(format!("κ {}", figure(curvature)));
        let radius = Some(radius).filter(|radius| radius.is_finite());
        lines.push(format!("R {}", radius.map_or("∞".to_owned(), figure)));
        let torsion = Some(jet.torsion()).filter(|torsion| !planar && torsion.is_finite());
        lines.extend(torsion.map(|torsion| format!("τ {}", figure(torsion))));
        if self.hand.selection.active() != Some(id) {
            lines.insert(0, curve.name.clone());
        }
        let text = lines.join("\n");
        let centre = jet.centre_of_curvature();
        let seen_as_it_is = planar && self.view.viewport.orientation.is_from_above();
        let circle = centre.filter(|_| !seen_as_it_is);
        Some(HoverScene::Curve {
            curve: id,
            u,
            curvature,
            at: self.view.viewport.flatten(jet.point),
            centre: centre
                .filter(|_| seen_as_it_is)
                .map(|centre| self.view.viewport.flatten(centre)),
            circle: circle.map_or(Vec::new(), |centre| self.circle(&jet, centre)),
            text,
        })
    }

    /// The osculating circle as it is seen; of a large one only the part near its point.
    fn circle(&self, jet: &Jet, centre: DVec3) -> Vec<DVec2> {
        let arm = jet.point - centre;
        let reach = 4.0
            * (self.view.viewport.size.x + self.view.viewport.size.y)
            * self.view.viewport.pixel();
        let half = (reach / arm.length()).min(PI);
        let across = jet.tangent().unwrap_or_default() * arm.length();
        let angle = |step: i32| half * f64::from(step) / f64::from(CIRCLE_STEPS);
        let place = |angle: f64| centre + angle.cos() * arm + angle.sin() * across;
        let steps = -CIRCLE_STEPS..=CIRCLE_STEPS;
        let points = steps.map(|step| self.view.viewport.flatten(place(angle(step))));
        points.collect()
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
        ] {
            chain.clear();
        }
    }
}

/// Append the joints between segments, with the curve's unit normals, unless they crowd.
fn append_joints(
    analysis: &CurveAnalysis,
    eye: &Orientation,
    view: &ViewBox,
    out: &mut Vec<[DVec2; 2]>,
) {
    let polygon = &analysis.curve().polygon;
    let segments = polygon.segments();
    let joint = |segment: usize| analysis.segment_samples(segment).first();
    let mut kept = GAP;
    // Where a whole segment is smaller than the spacing everywhere there is nothing to draw.
    if segments as f64 * JOINT_SPACING * view.pixel > 4.0 * extent(view) {
        return;
    }
    let from = usize::from(!polygon.is_periodic());
    for sample in (from..segments).filter_map(joint) {
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
