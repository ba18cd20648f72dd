//! The analyses of a document's curves.

use std::collections::BTreeMap;

use super::curve_analysis::CurveAnalysis;
use super::orientation::Orientation;
use crate::document::{CurveId, Document};

/// Hold one analysis a curve, brought up to date with the document on demand.
#[derive(Debug, Default)]
pub struct AnalysisCache {
    analyses: BTreeMap<CurveId, CurveAnalysis>,
    orientation: Orientation,
}

impl AnalysisCache {
    /// Choose from where the curves are seen from now on.
    pub fn set_orientation(&mut self, orientation: Orientation) {
        self.orientation = orientation;
        for analysis in self.analyses.values_mut() {
            analysis.set_orientation(orientation);
        }
    }

    /// Bring all analyses up to date: curves that are gone are forgotten, new ones analysed, and
    /// changed ones redone where they changed.
    pub fn update(&mut self, document: &Document) {
        self.analyses.retain(|id, _| document.curve(*id).is_some());
        for (id, curve) in document.curves() {
            self.analyses
                .entry(id)
                .and_modify(|analysis| analysis.update(curve))
                .or_insert_with(|| CurveAnalysis::new(curve.clone(), self.orientation));
        }
    }

    /// The analysis of one curve.
    pub fn get(&mut self, id: CurveId) -> Option<&mut CurveAnalysis> {
        self.analyses.get_mut(&id)
    }

    /// The analysis of one curve, to look at what is there.
    pub fn peek(&self, id: CurveId) -> Option<&CurveAnalysis> {
        self.analyses.get(&id)
    }
}
