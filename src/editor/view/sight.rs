//! Read access to the view for hit tests and panels.

use glam::DVec3;

use crate::document::{CurveId, Document};
use crate::editor::report::{CurveReport, Readout, ReferenceReport};
use crate::editor::view::feature_report::FeatureReport;
use crate::editor::view::layers::Layers;
use crate::editor::view::orientation::Orientation;
use crate::editor::view::scene::HoverScene;
use crate::editor::view::shown::Shown;
use crate::editor::view::view::View;
use crate::editor::view::viewport::Viewport;
use crate::geometry::Amplification;
use crate::geometry::harmony::Harmony;

/// Borrow the view, the document and the selection. Figures are those of the last
/// [`crate::editor::Editor::refresh`].
#[derive(Clone, Copy)]
pub struct Sight<'a> {
    pub(in crate::editor) view: &'a View,
    pub(in crate::editor) shown: Shown<'a>,
}

impl View {
    /// Borrow the view together with the document and the selection.
    pub(in crate::editor) fn sight<'a>(&'a self, shown: Shown<'a>) -> Sight<'a> {
        Sight { view: self, shown }
    }
}

impl<'a> Sight<'a> {
    /// The visible layers: the user's choice, as the tool in use changes it.
    pub fn layers(self) -> Layers {
        self.shown.layers
    }

    /// The features of the active curve or reference; `None` until the proof is complete.
    pub fn features(self) -> Option<&'a FeatureReport> {
        let (item, report) = self.view.features.as_ref()?;
        item.is_of(self.document(), self.active()?)
            .then_some(report)
    }

    /// The share of the active curve whose features are known; `None` without a curve, and where the proof
    /// failed, which is a fault of the program.
    pub fn proof_progress(self) -> Option<f64> {
        let known = self.view.analyses.get(self.active()?)?.proof_progress();
        Some(known + (1.0 - known) * self.view.proving.share()?)
    }

    /// The harmony of the active curve, once it is measured: only while something shows it.
    pub fn harmony(self) -> Option<&'a Harmony> {
        self.view.analyses.get(self.active()?)?.harmony()
    }

    /// The figures of the active curve.
    pub fn report(self) -> Option<CurveReport> {
        let analysis = self.view.analyses.get(self.active()?)?;
        let figures = analysis.float().figures();
        let polygon = &analysis.curve().polygon;
        Some(CurveReport {
            planar: analysis.is_planar(),
            segments: polygon.segments(),
            length: analysis.samples().length(),
            curvature: analysis.curvature(),
            legs: figures.legs,
            turns: figures.turns,
            amplification: Amplification::of_unclamping(polygon.degree(), polygon.segments()),
        })
    }

    /// The figures of the active reference.
    pub fn reference_report(self) -> Option<ReferenceReport> {
        let analyses = &self.view.analyses;
        let samples = analyses.reference(self.active()?)?.sampled().samples;
        Some(ReferenceReport {
            planar: samples.is_planar(),
            length: samples.is_continuous().then(|| samples.length()),
            curvature: samples.curvature(),
        })
    }

    /// The scale at which the comb's longest tooth is as long as the active curve's box; `None` without curvature.
    pub fn whole_comb_scale(self) -> Option<f64> {
        self.view.whole_comb_scale(self.shown)
    }

    /// Whether a curve or a reference is planar.
    pub fn is_planar(self, id: CurveId) -> Option<bool> {
        Some(self.view.analyses.sampled(id)?.samples.is_planar())
    }

    /// Whether all visible curves are planar and the view is not from above.
    pub fn is_orbited(self) -> bool {
        let mut shown = self.curves();
        self.viewport().orientation != Orientation::XY
            && shown.all(|(_, curve)| curve.polygon.is_planar())
    }

    /// The vertex of the active curve that is hovered, on the canvas or in a panel.
    pub fn hovered_vertex(self) -> Option<usize> {
        let active = self.active()?;
        let marked = self.view.hovered.vertex;
        marked.or(self.view.hovered_before.vertex).or_else(|| {
            let place = self.shown.pointer.filter(|_| !self.shown.is_dragging)?;
            let (id, vertex) = self.vertex(place)?;
            (id == active).then_some(vertex)
        })
    }

    /// The contents of the status bar.
    pub fn readout(self) -> Readout {
        let active = self.active();
        let curve = active.and_then(|id| self.document().curve(id));
        let reference = |id| self.document().reference(id);
        let mut readout = Readout {
            pointer: self.pointed_at(),
            in_space: self.tells_z(),
            scale: self.viewport().scale,
            parameter_name: if active.and_then(reference).is_some() {
                "t"
            } else {
                "u"
            },
            degree: curve.map(|curve| curve.polygon.degree()),
            ..Readout::default()
        };
        if let Some((curve, u, curvature)) = self.view.pane.scene.hovered() {
            (readout.parameter_name, readout.parameter) = match reference(curve) {
                Some(reference) => ("t", Some(reference.curve.parameter(u))),
                None => ("u", Some(u)),
            };
            readout.curvature = Some(curvature);
        }
        readout
    }

    /// The point of the model that is hovered, or under the pointer.
    fn pointed_at(self) -> Option<DVec3> {
        match &self.view.pane.scene.hover {
            Some(HoverScene::Vertex { point, .. } | HoverScene::Curve { point, .. }) => {
                Some(*point)
            }
            _ => {
                // In the plane through the point about which the view turns; from above in the plane z = 0.
                let place = self.viewport().to_model(self.shown.pointer?);
                let orientation = &self.viewport().orientation;
                Some(orientation.point_at(place, self.view.pane.target))
            }
        }
    }

    /// Whether the status bar shows z.
    fn tells_z(self) -> bool {
        let mut all = self.document().all_ids();
        !self.viewport().orientation.is_from_above()
            || all.any(|id| !self.is_planar(id).unwrap_or(true))
    }

    pub(in crate::editor) fn document(self) -> &'a Document {
        self.shown.document()
    }

    pub(in crate::editor) fn viewport(self) -> &'a Viewport {
        &self.view.pane.viewport
    }

    pub(in crate::editor) fn active(self) -> Option<CurveId> {
        self.shown.active()
    }
}
