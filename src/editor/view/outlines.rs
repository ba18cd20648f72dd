//! The outlines of all curves and references, and of curves outside the document: earlier states, drawn faintly,
//! and the curve that a click would make.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::analysis::{AnalysisCache, CurveAnalysis};
use crate::document::{Curve, CurveId};
use crate::editor::view::chain_outlines::ChainOutlines;
use crate::editor::view::curve_outlines::CurveOutlines;
use crate::editor::view::orientation::Orientation;
use crate::editor::view::outline::ViewBox;
use crate::editor::view::scene::CurveScene;

/// Hold the outlines of each curve and reference.
#[derive(Debug, Default)]
pub struct Outlines {
    curves: BTreeMap<CurveId, Outlined>,
}

/// The outlines of one curve and its polygons, or of a reference.
#[derive(Debug, Default)]
pub struct Outlined {
    /// The curve, its comb and its evolute.
    pub curve: CurveOutlines,
    /// The float S-polygon, or the points of a reference.
    pub float: ChainOutlines,
    /// The closed S-polygon.
    pub clamped: ChainOutlines,
}

impl Outlines {
    /// Update all outlines; blocks that did not change are kept.
    pub fn update(&mut self, analyses: &AnalysisCache, orientation: Orientation) {
        self.curves.retain(|id, _| analyses.sampled(*id).is_some());
        for (id, analysis) in analyses.iter() {
            let outlined = self.curves.entry(id).or_default();
            outlined.update(analysis, orientation);
        }
        for (id, reference) in analyses.references() {
            let outlined = self.curves.entry(id).or_default();
            outlined.curve.update(reference.sampled(), orientation);
            outlined.float.update(reference.points(), orientation);
            // A curve of another document may have had the identity.
            outlined.clamped = ChainOutlines::default();
        }
    }

    /// The outlines of one curve or reference.
    pub fn get(&self, id: CurveId) -> Option<&Outlined> {
        self.curves.get(&id)
    }

    /// The outlines of one curve or reference, to append from.
    pub fn get_mut(&mut self, id: CurveId) -> Option<&mut Outlined> {
        self.curves.get_mut(&id)
    }
}

impl Outlined {
    /// Bring the outlines up to date with a curve.
    pub fn update(&mut self, analysis: &CurveAnalysis, orientation: Orientation) {
        self.curve.update(analysis.sampled(), orientation);
        self.float.update(analysis.float(), orientation);
        self.clamped.update(analysis.clamped(), orientation);
    }
}

/// Keep the analysis and the outlines of a curve from frame to frame, so that only changes cost time.
#[derive(Debug, Default)]
pub struct Sketch {
    analysis: Option<CurveAnalysis>,
    outlined: Outlined,
}

impl Sketch {
    /// Analyse a curve.
    pub fn analysis(&mut self, curve: &Arc<Curve>) -> &mut CurveAnalysis {
        let analysis = match self.analysis.take() {
            Some(mut known) => {
                known.update(curve);
                known
            }
            None => CurveAnalysis::new(curve.clone()),
        };
        self.analysis.insert(analysis)
    }

    /// Append the visible part of a curve and its float S-polygon, and if wanted of its closed one, without the legs
    /// that lie on the float one's.
    pub fn append(
        &mut self,
        curve: &Arc<Curve>,
        orientation: Orientation,
        view: &ViewBox,
        scene: &mut CurveScene,
        clamped: bool,
    ) {
        self.analysis(curve);
        let Self { analysis, outlined } = self;
        let Some(analysis) = analysis else {
            return;
        };
        outlined.update(analysis, orientation);
        let (float, tail) = (analysis.float(), curve.polygon.tail_legs());
        outlined
            .curve
            .append_curve(analysis.sampled(), view, &mut scene.curve);
        outlined
            .float
            .append_legs(float, tail, None, view, &mut scene.float);
        if clamped {
            let covering = Some(outlined.float.seen(float));
            let (outlines, chain) = (&outlined.clamped, analysis.clamped());
            outlines.append_legs(chain, 0, covering.as_ref(), view, &mut scene.clamped);
        }
    }
}
