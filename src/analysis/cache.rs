//! The analyses of a document's curves and references.

use std::collections::BTreeMap;

use super::curve_analysis::CurveAnalysis;
use super::curve_samples::SampledCurve;
use super::reference_analysis::ReferenceAnalysis;
use crate::document::{CurveId, Document};

/// Hold one analysis of each curve and of each reference.
#[derive(Debug, Default)]
pub struct AnalysisCache {
    analyses: BTreeMap<CurveId, CurveAnalysis>,
    references: BTreeMap<CurveId, ReferenceAnalysis>,
}

impl AnalysisCache {
    /// Update all analyses: forget removed curves, analyse new ones, and the changed parts of the others.
    pub fn update(&mut self, document: &Document) {
        self.analyses.retain(|id, _| document.curve(*id).is_some());
        for (id, curve) in document.curves() {
            self.analyses
                .entry(id)
                .and_modify(|analysis| analysis.update(curve))
                .or_insert_with(|| CurveAnalysis::new(curve.clone()));
        }
        self.references
            .retain(|id, _| document.reference(*id).is_some());
        for (id, reference) in document.references() {
            self.references
                .entry(id)
                .and_modify(|analysis| analysis.update(reference))
                .or_insert_with(|| ReferenceAnalysis::new(reference.clone()));
        }
    }

    /// A curve or a reference with its samples, which drawing and hit tests need.
    pub fn sampled(&self, id: CurveId) -> Option<SampledCurve<'_>> {
        match self.analyses.get(&id) {
            Some(analysis) => Some(analysis.sampled()),
            None => Some(self.references.get(&id)?.sampled()),
        }
    }

    /// The analysis of one reference.
    pub fn reference(&self, id: CurveId) -> Option<&ReferenceAnalysis> {
        self.references.get(&id)
    }

    /// The analysis of one reference, to append plots from.
    pub fn reference_mut(&mut self, id: CurveId) -> Option<&mut ReferenceAnalysis> {
        self.references.get_mut(&id)
    }

    /// The analysis of one curve.
    pub fn get(&self, id: CurveId) -> Option<&CurveAnalysis> {
        self.analyses.get(&id)
    }

    /// The analysis of one curve, to append plots from.
    pub fn get_mut(&mut self, id: CurveId) -> Option<&mut CurveAnalysis> {
        self.analyses.get_mut(&id)
    }

    /// The analyses of all references.
    pub fn references(&self) -> impl Iterator<Item = (CurveId, &ReferenceAnalysis)> {
        self.references.iter().map(|(id, analysis)| (*id, analysis))
    }

    /// The analyses of all curves.
    pub fn iter(&self) -> impl Iterator<Item = (CurveId, &CurveAnalysis)> {
        self.analyses.iter().map(|(id, analysis)| (*id, analysis))
    }
}
