//! What panels read.

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
            pointer: self
                .hand
                .gestures
                .pointer()
                .map(|at| self.view.viewport.to_model(at)),
            axes: self.axis_names(),
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
            length: samples.length(),
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
