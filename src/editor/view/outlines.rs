//! The outlines of all curves and references.

use std::collections::BTreeMap;

use crate::analysis::{AnalysisCache, CurveAnalysis};
use crate::document::CurveId;
use crate::editor::view::chain_outlines::ChainOutlines;
use crate::editor::view::curve_outlines::CurveOutlines;
use crate::editor::view::orientation::Orientation;

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
