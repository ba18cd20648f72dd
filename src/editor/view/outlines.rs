//! The outlines of all curves, seen from one side.

use std::collections::BTreeMap;

use crate::analysis::{AnalysisCache, CurveAnalysis};
use crate::document::CurveId;
use crate::editor::view::chain_outlines::ChainOutlines;
use crate::editor::view::curve_outlines::CurveOutlines;
use crate::editor::view::orientation::Orientation;

/// Hold what is drawn of each curve.
#[derive(Debug, Default)]
pub struct Outlines {
    curves: BTreeMap<CurveId, Outlined>,
}

/// What is drawn of one curve and its polygons.
#[derive(Debug, Default)]
pub struct Outlined {
    /// The curve itself, and what hangs on it.
    pub curve: CurveOutlines,
    /// The float S-polygon.
    pub float: ChainOutlines,
    /// The closed S-polygon.
    pub clamped: ChainOutlines,
}

impl Outlines {
    /// Bring all outlines up to date with their curves; what did not change is kept.
    pub fn update(&mut self, analyses: &AnalysisCache, orientation: Orientation) {
        self.curves.retain(|id, _| analyses.get(*id).is_some());
        for (id, analysis) in analyses.iter() {
            let outlined = self.curves.entry(id).or_default();
            outlined.update(analysis, orientation);
        }
    }

    /// What is drawn of one curve.
    pub fn get(&self, id: CurveId) -> Option<&Outlined> {
        self.curves.get(&id)
    }

    /// What is drawn of one curve, to go on with.
    pub fn get_mut(&mut self, id: CurveId) -> Option<&mut Outlined> {
        self.curves.get_mut(&id)
    }
}

impl Outlined {
    fn update(&mut self, analysis: &CurveAnalysis, orientation: Orientation) {
        self.curve.set_orientation(orientation);
        self.curve.update(analysis.sampled());
        let chains = [
            (&mut self.float, analysis.float()),
            (&mut self.clamped, analysis.clamped()),
        ];
        for (outlines, chain) in chains {
            outlines.set_orientation(orientation);
            outlines.update(chain);
        }
    }
}
