//! What panels read.

use glam::DVec3;

use crate::analysis::CurveAnalysis;
use crate::document::CurveId;
use crate::editor::Editor;
use crate::editor::report::{CurveReport, Readout, ReferenceReport};
use crate::editor::view::scene::HoverScene;
use crate::geometry::Amplification;

impl Editor {
    /// What the status bar reads.
    pub fn readout(&self) -> Readout {
        let mut readout = Readout {
            pointer: self.pointed_at(),
            in_space: self.tells_z(),
            scale: self.view.viewport.scale,
            parameter_name: match self.active_reference_id() {
                Some(_) => "t",
                None => "u",
            },
            degree: self.active_curve().map(|(_, curve)| curve.polygon.degree()),
            ..Readout::default()
        };
        if let Some(HoverScene::Curve {
            curve,
            u,
            curvature,
            ..
        }) = self.view.scene.hover
        {
            let reference = self.document().reference(curve);
            (readout.parameter_name, readout.parameter) = match reference {
                Some(reference) => ("t", Some(reference.curve.parameter(u))),
                None => ("u", Some(u)),
            };
            readout.curvature = Some(curvature);
        }
        readout
    }

    /// The point of the model that is hovered, or under the pointer.
    fn pointed_at(&self) -> Option<DVec3> {
        match &self.view.scene.hover {
            Some(HoverScene::Vertex { point, .. } | HoverScene::Curve { point, .. }) => {
                Some(*point)
            }
            _ => {
                let place = self.hand.gestures.pointer()?;
                Some(self.point_under(self.view.viewport.to_model(place)))
            }
        }
    }

    /// Whether the third coordinate tells something.
    fn tells_z(&self) -> bool {
        let is_planar = |id| self.is_planar(id).unwrap_or(true);
        let mut shown = self.document().all_ids();
        !self.view.viewport.orientation.is_from_above() || shown.any(|id| !is_planar(id))
    }

    /// What the inspector says of the active curve.
    pub fn report(&self) -> Option<CurveReport> {
        let analysis = self.analyses.get(self.active()?)?;
        let figures = analysis.float().figures();
        let polygon = &analysis.curve().polygon;
        Some(CurveReport {
            planar: analysis.is_planar(),
            segments: polygon.segments(),
            length: analysis.samples().length(),
            curvature: analysis.samples().curvature(),
            legs: figures.legs,
            turns: figures.turns,
            amplification: Amplification::of_unclamping(polygon.degree(), polygon.segments()),
        })
    }

    /// What the inspector says of the active reference.
    pub fn reference_report(&self) -> Option<ReferenceReport> {
        let samples = self.analyses.reference(self.active()?)?.sampled().samples;
        Some(ReferenceReport {
            planar: samples.is_planar(),
            length: samples.is_continuous().then(|| samples.length()),
            curvature: samples.curvature(),
        })
    }

    /// The vertex of the active curve that is hovered, on the canvas or in a panel.
    pub fn hovered_vertex(&self) -> Option<usize> {
        self.vertex_hovered_on(self.hand.selection.active()?)
    }

    /// Whether a curve or a reference is planar.
    pub fn is_planar(&self, id: CurveId) -> Option<bool> {
        Some(self.analyses.sampled(id)?.samples.is_planar())
    }

    /// What is known of a curve.
    pub fn analysis(&self, curve: CurveId) -> Option<&CurveAnalysis> {
        self.analyses.get(curve)
    }

    pub(in crate::editor) fn vertex_hovered_on(&self, id: CurveId) -> Option<usize> {
        let told = self.view.hovered.vertex.or(self.view.hovered_before.vertex);
        if told.is_some() {
            return told;
        }
        let place = self.hand.gestures.pointer()?;
        if self.hand.gestures.is_dragging() {
            return None;
        }
        let hit = self.context().hits.vertex(place)?;
        (hit.0 == id).then_some(hit.1)
    }
}
