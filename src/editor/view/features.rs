//! Keeping the features of the active curve up to date, and going to one of them.

use crate::editor::Editor;
use crate::editor::view::feature_report::FeatureReport;
use crate::editor::view::layers::Layer;
use crate::editor::view::outline::Bounds;
use crate::editor::view::shown::Shown;

/// How much of a segment is shown around a feature, on either side.
const SURROUNDINGS: f64 = 0.6;

impl Editor {
    /// The features of the active curve or reference, once all are known: in the background this may be some
    /// frames after the curve has changed.
    pub fn features(&self) -> Option<&FeatureReport> {
        let shown = Shown::of(self.document(), self.active()?)?;
        let (reported, report) = self.view.features.as_ref()?;
        (*reported == shown).then_some(report)
    }

    /// The share of the active curve whose features are known; `None` if they cannot be proved, for
    /// a fault of the program, or if there is no curve.
    pub fn proof_progress(&self) -> Option<f64> {
        let known = self.analyses.get(self.active()?)?.proof_progress();
        Some(known + (1.0 - known) * self.proving.share()?)
    }

    /// Prove the features of the active curve, and list them once all are known. Those of a reference
    /// are only sampled.
    pub(in crate::editor) fn prove(&mut self) {
        let Some(active) = self.active() else {
            return;
        };
        let (analyses, patience) = (&mut self.analyses, &mut self.patience);
        self.proving.advance(active, analyses, patience);
        if self.features().is_none()
            && let Some(reference) = self.analyses.reference(active)
        {
            let shown = Shown::Reference(reference.reference().clone());
            self.view.features = Some((shown, FeatureReport::of_samples(reference)));
        }
        if self.features().is_none()
            && let Some(analysis) = self.analyses.get(active)
            && let Some(features) = analysis.known_features()
        {
            let curve = analysis.curve().clone();
            let report = FeatureReport::of(features, &curve.polygon);
            self.view.features = Some((Shown::Curve(curve), report));
        }
    }

    /// Show the surroundings of a parameter of the active curve or reference, and the layer of its
    /// features.
    pub fn go_to(&mut self, u: f64) {
        let active = self.active();
        let Some(curve) = active.and_then(|id| self.document().shape(id)) else {
            return;
        };
        let jet = curve.jet(u.clamp(0.0, curve.pieces() as f64));
        let reach = SURROUNDINGS * jet.speed();
        let at = self.view.viewport.flatten(jet.point);
        let mut bounds = Bounds::EMPTY;
        bounds.add(at - reach);
        bounds.add(at + reach);
        self.view.viewport = self.view.viewport.fitted(&bounds);
        self.view.layers.set(Layer::Features, true);
        self.view.layers.set(Layer::Curve, true);
    }
}
