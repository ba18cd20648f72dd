//! What panels read.

use crate::document::CurveId;
use crate::editor::Editor;
use crate::editor::report::{CurveReport, Readout};
use crate::editor::view::scene::HoverScene;
use crate::geometry::{Amplification, FloatPolygon, PolygonKind};

impl Editor {
    /// Whether the active curve is planar, if there is one.
    pub fn active_is_planar(&self) -> Option<bool> {
        Some(self.analyses.get(self.active()?)?.is_planar())
    }

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
            degree: self.active_curve().map(|(_, curve)| curve.polygon.degree()),
            ..Readout::default()
        };
        if let Some(HoverScene::Curve { u, curvature, .. }) = self.view.scene.hover {
            readout.u = Some(u);
            readout.curvature = Some(curvature);
        }
        readout
    }

    /// What the inspector says of the active curve.
    pub fn report(&self) -> Option<CurveReport> {
        let analysis = self.analyses.get(self.active()?)?;
        let figures = analysis.float().figures();
        Some(CurveReport {
            planar: analysis.is_planar(),
            segments: analysis.curve().polygon.segments(),
            length: analysis.samples().length(),
            curvature: analysis.samples().curvature(),
            legs: figures.legs,
            turns: figures.turns,
            amplification: clamped_amplification(&analysis.curve().polygon),
        })
    }

    /// The vertex of the active curve that is hovered, on the canvas or in a panel.
    pub fn hovered_vertex(&self) -> Option<usize> {
        self.vertex_hovered_on(self.hand.selection.active()?)
    }

    /// The number of segments of a curve that were sampled when it last changed.
    pub fn segments_redone(&self, curve: CurveId) -> Option<usize> {
        Some(self.analyses.get(curve)?.segments_redone())
    }

    /// The number of segments of a curve whose features were proved when it last changed.
    pub fn segments_proved(&self, curve: CurveId) -> Option<usize> {
        Some(self.analyses.get(curve)?.segments_proved())
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

/// How much an error in a vertex of the closed S-polygon grows in the float S-polygon.
fn clamped_amplification(polygon: &FloatPolygon) -> Option<Amplification> {
    let (degree, segments) = (polygon.degree(), polygon.segments());
    Amplification::of(PolygonKind::Clamped, PolygonKind::Float, degree, segments).ok()
}
