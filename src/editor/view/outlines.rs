//! The outlines of all curves and references, seen from one side.

use std::collections::BTreeMap;

use crate::analysis::{AnalysisCache, CurveAnalysis, ReferenceAnalysis};
use crate::document::CurveId;
use crate::editor::view::chain_outlines::ChainOutlines;
use crate::editor::view::curve_outlines::CurveOutlines;
use crate::editor::view::orientation::Orientation;

/// Hold what is drawn of each curve and of each reference.
#[derive(Debug, Default)]
pub struct Outlines {
    curves: BTreeMap<CurveId, Outlined>,
}

/// What is drawn of one curve and its polygons, or of a reference.
#[derive(Debug, Default)]
pub struct Outlined {
    /// The curve itself, and what hangs on it.
    pub curve: CurveOutlines,
    /// The float S-polygon, or the points of a reference.
    pub float: ChainOutlines,
    /// The closed S-polygon.
    pub clamped: ChainOutlines,
}

impl Outlines {
    /// Bring all outlines up to date with their curves; what did not change is kept.
    pub fn update(&mut self, analyses: &AnalysisCache, orientation: Orientation) {
        self.curves.retain(|id, _| analyses.sampled(*id).is_some());
        for (id, analysis) in analyses.iter() {
            let outlined = self.curves.entry(id).or_default();
            outlined.update(analysis, orientation);
        }
        for (id, reference) in analyses.references() {
            let outlined = self.curves.entry(id).or_default();
            outlined.update_reference(reference, orientation);
        }
    }

    /// What is drawn of one curve or reference.
    pub fn get(&self, id: CurveId) -> Option<&Outlined> {
        self.curves.get(&id)
    }

    /// What is drawn of one curve or reference, to go on with.
    pub fn get_mut(&mut self, id: CurveId) -> Option<&mut Outlined> {
        self.curves.get_mut(&id)
    }
}

impl Outlined {
    /// Bring the outlines up to date with a curve.
    pub fn update(&mut self, analysis: &CurveAnalysis, orientation: Orientation) {
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

    fn update_reference(&mut self, reference: &ReferenceAnalysis, orientation: Orientation) {
        self.curve.set_orientation(orientation);
        self.curve.update(reference.sampled());
        self.float.set_orientation(orientation);
        self.float.update(reference.points());
    }
}
