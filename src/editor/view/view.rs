//! The view's state.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::analysis::{AnalysisCache, CurveAnalysis, Item, Joints, ReferenceAnalysis};
use crate::document::{CurveId, Document, PictureSource};
use crate::editor::jobs::Client;
use crate::editor::jobs::comparing::Comparing;
use crate::editor::jobs::guides::{FeatureOf, Guides};
use crate::editor::jobs::measuring::Measuring;
use crate::editor::jobs::patience::Patience;
use crate::editor::jobs::pictures::Pictures;
use crate::editor::jobs::proving::Proving;
use crate::editor::view::comb::{CombSettings, CombsOf};
use crate::editor::view::curvature_display::CurvatureDisplay;
use crate::editor::view::evolute::EvoluteCrowd;
use crate::editor::view::feature_report::FeatureReport;
use crate::editor::view::layers::Layers;
use crate::editor::view::pane::Pane;
use crate::editor::view::pane_layout::PaneLayout;
use crate::editor::view::plot_scene::{MarkSource, PlotKind, PlotScene, PlotSource};
use crate::editor::view::scene::Scene;
use crate::editor::view::shown::Shown;
use crate::editor::view::viewport::Viewport;
use crate::editor::view::whiskers::Whiskers;

/// Hold viewport, layers, hovering, analyses with their background work, and the contents of canvas and
/// plots.
#[derive(Debug, Default)]
pub struct View {
    pub(in crate::editor) analyses: AnalysisCache,
    pub(in crate::editor) proving: Proving,
    pub(in crate::editor) measuring: Measuring,
    pub(in crate::editor) comparing: Comparing,
    pub(in crate::editor) guides: Guides,
    pub(in crate::editor) pictures: Pictures,
    pub(in crate::editor) joints: Joints,
    /// The distance within which ends of curves meet; `None` for the usual one.
    pub joint_tolerance: Option<f64>,
    /// The pane that the hand is in, or was last.
    pub(in crate::editor) pane: Pane,
    /// The other panes, row by row.
    pub(super) other_panes: Vec<Pane>,
    /// The place of the pane in use among them.
    pub(super) used: usize,
    /// The place of the pane that is used while the pointer is not on the canvas.
    pub(super) chosen_pane: usize,
    pub(super) layout: PaneLayout,
    /// The size of the canvas in screen points.
    pub(super) canvas: DVec2,
    /// Whether the canvas has been given its size and the document fitted into it.
    pub(in crate::editor) placed: bool,
    /// The layers that the user chose, without the changes of a tool.
    pub layers: Layers,
    /// Whether bands of rising and falling curvature are shown only in the plot, and not on the canvas with the
    /// layer of features.
    pub bands_only_plotted: bool,
    /// How curvatures are written.
    pub curvature_display: CurvatureDisplay,
    pub(in crate::editor) comb: CombSettings,
    /// The curves and references that the comb was last made to suit.
    combed: Vec<CurveId>,
    /// Which curves and references have a comb.
    pub combs_of: CombsOf,
    /// Whether the evolute of the active curve is drawn where it would cover much of the view.
    pub evolute: EvoluteCrowd,
    /// How distances are drawn.
    pub whiskers: Whiskers,
    /// The scale that was last made to suit the distances of the deviation; `None` without one.
    pub(super) suited_scale: Option<f64>,
    pub(in crate::editor) hovered: Hovered,
    /// The marks of panels in the frame before, for panels that come first.
    pub(in crate::editor) hovered_before: Hovered,
    /// The report of features, for the curve or the reference that it was made of.
    pub(in crate::editor) features: Option<(Item, FeatureReport)>,
    /// The feature whose loss is shown.
    pub(in crate::editor) chosen: Option<FeatureOf>,
    /// The kind of the plot; `None` while plots are folded.
    pub plot: Option<PlotKind>,
    /// The curve or reference that each one is compared with in every plot; none for those that are new.
    comparisons: BTreeMap<CurveId, CurveId>,
    /// The part of the active curve that is plotted in detail, between two arc lengths; `None` for all of it.
    pub plot_part: Option<[f64; 2]>,
    pub(in crate::editor) plots: PlotScene,
    /// What its series were made of.
    pub(in crate::editor) plotted: Option<PlotSource>,
    /// What its marks were made of.
    pub(in crate::editor) plot_marked: Option<MarkSource>,
    /// The analysis of the reference that an operation was given.
    pub(in crate::editor) given: Option<ReferenceAnalysis>,
    /// Whether a panel shows harmony: it is measured only then.
    pub harmony: bool,
    /// Whether a panel shows the atlas of an operation: it is proved only then.
    pub shows_atlas: bool,
}

/// The rows and places that panels hover, marked on the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::editor) struct Hovered {
    pub(in crate::editor) length: Option<f64>,
    pub(in crate::editor) vertex: Option<usize>,
    pub(in crate::editor) joint: Option<usize>,
}

/// What the canvas shows at which size, and the comb that suits it.
#[derive(Clone, Debug)]
pub(in crate::editor) struct Framing {
    /// How each pane sees the model, and the point about which it turns.
    panes: Vec<(Viewport, DVec3)>,
    comb: CombSettings,
    combed: Vec<CurveId>,
}

impl Framing {
    /// Whether both show the same part of the model, whatever the comb.
    pub(in crate::editor) fn sees_as(&self, other: &Self) -> bool {
        self.panes == other.panes
    }
}

impl View {
    /// The present framing.
    pub(in crate::editor) fn framing(&self) -> Framing {
        let panes = self.panes_in_order();
        Framing {
            panes: panes.map(|it| (it.viewport, it.target)).collect(),
            comb: self.comb,
            combed: self.combed.clone(),
        }
    }

    /// Go back to an earlier framing.
    pub(in crate::editor) fn restore(&mut self, framing: Framing) {
        for (place, (viewport, target)) in framing.panes.into_iter().enumerate() {
            if let Some(pane) = self.pane_mut(place) {
                (pane.viewport, pane.target) = (viewport, target);
            }
        }
        self.comb = framing.comb;
        self.combed = framing.combed;
    }

    /// The curve or reference that a curve or reference is compared with; it may be no longer in the document.
    pub fn compared(&self, id: CurveId) -> Option<CurveId> {
        self.comparisons.get(&id).copied()
    }

    /// Why a picture cannot be shown, once that is known.
    pub fn picture_fault(&self, source: &PictureSource) -> Option<&str> {
        self.pictures
            .get(source)?
            .as_ref()
            .err()
            .map(String::as_str)
    }

    /// Each curve or reference that is compared with another one, and that one.
    pub fn comparisons(&self) -> impl Iterator<Item = [CurveId; 2]> {
        self.comparisons.iter().map(|(one, other)| [*one, *other])
    }

    /// Compare a curve or a reference with another one, or with nothing.
    pub fn compare(&mut self, id: CurveId, other: Option<CurveId>) {
        match other {
            Some(other) => self.comparisons.insert(id, other),
            None => self.comparisons.remove(&id),
        };
    }

    /// Forget all comparisons.
    pub(in crate::editor) fn compare_nothing(&mut self) {
        self.comparisons.clear();
    }

    /// Do slow work on threads of its own; a thread calls `wake` when it has a result.
    pub(in crate::editor) fn run_in_background(
        &mut self,
        wake: impl Fn() + Clone + Send + 'static,
    ) {
        self.proving = Client::background("features", wake.clone());
        self.measuring = Client::background("harmony", wake.clone());
        self.comparing = Comparing::background(wake.clone());
        self.guides = Guides::background(wake.clone());
        self.pictures = Pictures::background(wake);
    }

    /// Update the analyses and the outlines, which hit tests read.
    pub(in crate::editor) fn analyse(&mut self, document: &Document) {
        self.analyses.update(document);
        self.outline();
    }

    /// Update the outlines of the pane in use, with analyses that are up to date.
    pub(in crate::editor) fn outline(&mut self) {
        let orientation = self.pane.viewport.orientation;
        self.pane.outlines.update(&self.analyses, orientation);
    }

    /// Update analyses, features, harmony, joints and distances.
    pub(in crate::editor) fn update(&mut self, shown: Shown<'_>, patience: &mut Patience) {
        self.analyse(shown.document());
        self.pictures.update(shown.document());
        // A drag that Esc takes back leaves the comb as it was.
        let combed = self.with_comb(shown);
        if self.combed != combed && !shown.is_holding {
            self.combed = combed;
            self.suit_comb(shown);
        }
        if let Some(active) = shown.active() {
            self.proving.prove(active, &mut self.analyses, patience);
            self.list_features(active, shown);
            if self.shows_harmony() {
                self.measuring.measure(active, &mut self.analyses, patience);
            }
        }
        let tolerance = self.joint_tolerance;
        self.joints
            .update(shown.document(), &self.analyses, tolerance);
        let pair = self.compared_pair(shown);
        self.comparing.advance(pair, patience);
        self.suit_whiskers(shown.is_holding);
    }

    /// List the features of the active curve once all are proved, those of a reference as its samples show.
    fn list_features(&mut self, active: CurveId, shown: Shown<'_>) {
        if self.sight(shown).features().is_some() {
            return;
        }
        let listed = match self.analyses.reference(active) {
            Some(analysis) => Some((
                Item::Reference(analysis.reference().clone()),
                FeatureReport::of_samples(analysis),
            )),
            None => self.analyses.get(active).and_then(|analysis| {
                let report =
                    FeatureReport::of(analysis.known_features()?, &analysis.curve().polygon);
                Some((Item::Curve(analysis.curve().clone()), report))
            }),
        };
        self.features = listed.or_else(|| self.features.take());
    }

    /// The analysis of a curve.
    pub fn analysis(&self, curve: CurveId) -> Option<&CurveAnalysis> {
        self.analyses.get(curve)
    }

    /// The viewport.
    pub fn viewport(&self) -> &Viewport {
        &self.pane.viewport
    }

    /// The comb's settings.
    pub fn comb(&self) -> CombSettings {
        self.comb
    }

    /// Set the comb's scale and density. A scale that is not a positive number changes nothing.
    pub fn set_comb(&mut self, comb: CombSettings) {
        if comb.scale > 0.0 && comb.scale.is_finite() {
            self.comb = CombSettings {
                scale: comb.scale,
                density: comb
                    .density
                    .clamp(*CombSettings::DENSITY.start(), *CombSettings::DENSITY.end()),
            };
        }
    }

    /// The contents of the canvas.
    pub fn scene(&self) -> &Scene {
        &self.pane.scene
    }

    /// The contents of the plot.
    pub fn plots(&self) -> &PlotScene {
        &self.plots
    }

    /// Forget the marks of panels, before the panels of the next frame.
    pub fn hover_nothing(&mut self) {
        self.hovered_before = std::mem::take(&mut self.hovered);
    }

    /// Mark the point at an arc length of the active curve until [`View::hover_nothing`].
    pub fn hover_length(&mut self, arc_length: f64) {
        self.hovered.length = Some(arc_length);
    }

    /// Name a joint of curves, by its place in the list, until [`View::hover_nothing`].
    pub fn hover_joint(&mut self, index: usize) {
        self.hovered.joint = Some(index);
    }

    /// Mark a vertex of the active curve until [`View::hover_nothing`].
    pub fn hover_vertex(&mut self, vertex: usize) {
        self.hovered.vertex = Some(vertex);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comb_that_cannot_be_drawn_is_passed_over() {
        let mut view = View::default();
        let chosen = CombSettings {
            scale: 2.5,
            density: 1000,
        };
        view.set_comb(chosen);
        let density = *CombSettings::DENSITY.end();
        let drawn = CombSettings { density, ..chosen };
        assert_eq!(view.comb(), drawn);
        for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            view.set_comb(CombSettings { scale, density: 1 });
            assert_eq!(view.comb(), drawn);
        }
    }

    #[test]
    fn what_panels_mark_is_known_for_one_frame_more() {
        let mut view = View::default();
        view.hover_vertex(3);
        view.hover_nothing();
        assert_eq!(view.hovered, Hovered::default());
        assert_eq!(view.hovered_before.vertex, Some(3));
        view.hover_nothing();
        assert_eq!(view.hovered_before, Hovered::default());
    }
}
