//! The analyses of a document's curves.

use std::collections::BTreeMap;

use super::curve_analysis::CurveAnalysis;
use crate::document::{CurveId, Document};

/// Hold one analysis a curve, brought up to date with the document on demand.
#[derive(Debug, Default)]
pub struct AnalysisCache {
    analyses: BTreeMap<CurveId, CurveAnalysis>,
}

impl AnalysisCache {
    /// Bring all analyses up to date: curves that are gone are forgotten, new ones analysed, and
    /// changed ones redone where they changed.
    pub fn update(&mut self, document: &Document) {
        self.analyses.retain(|id, _| document.curve(*id).is_some());
        for (id, curve) in document.curves() {
            self.analyses
                .entry(id)
                .and_modify(|analysis| analysis.update(curve))
                .or_insert_with(|| CurveAnalysis::new(curve.clone()));
        }
    }

    /// The analysis of one curve.
    pub fn get(&self, id: CurveId) -> Option<&CurveAnalysis> {
        self.analyses.get(&id)
    }

    /// The analysis of one curve, to go on with.
    pub fn get_mut(&mut self, id: CurveId) -> Option<&mut CurveAnalysis> {
        self.analyses.get_mut(&id)
    }

    /// All analyses.
    pub fn iter(&self) -> impl Iterator<Item = (CurveId, &CurveAnalysis)> {
        self.analyses.iter().map(|(id, analysis)| (*id, analysis))
    }
}
