//! The proved features of a curve, updated segment by segment.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use super::revision::Revision;
use crate::document::Curve;
use crate::geometry::Progress;
use crate::geometry::features::{Features, SegmentFeatures, SegmentProver};

/// Hold the proved features of a curve's segments.
#[derive(Debug)]
pub struct ProvedFeatures {
    segments: Vec<SegmentFeatures>,
    /// The segments to prove, with their revisions.
    open: BTreeMap<usize, Revision>,
    /// The revision of the proof: it changes whenever there is something to prove.
    revision: Revision,
    /// The number of segments that the last proof counted for.
    proved: usize,
    /// The features of the whole curve, once they are put together.
    assembled: OnceCell<Features>,
}

/// Prove the features of some segments of a curve: a job for any thread.
#[derive(Clone, Debug)]
pub struct FeatureProof {
    curve: Arc<Curve>,
    planar: bool,
    segments: Vec<(usize, Revision)>,
}

/// The result of a proof: all of it, or the part before a cancellation.
#[derive(Debug)]
pub struct ProofResult(Vec<(usize, Revision, SegmentFeatures)>);

impl FeatureProof {
    /// Prove segment by segment, until all is proved or the proof is cancelled.
    pub fn run(&self, progress: &Progress) -> ProofResult {
        let mut prover = SegmentProver::new(self.planar);
        let count = self.segments.len() as f64;
        let mut proved = Vec::with_capacity(self.segments.len());
        for (segment, revision) in &self.segments {
            if progress.is_cancelled() {
                break;
            }
            let features = prover.segment(&self.curve.polygon, *segment);
            proved.push((*segment, *revision, features));
            progress.set_done(proved.len() as f64 / count);
        }
        ProofResult(proved)
    }
}

impl ProvedFeatures {
    /// Prepare for a curve of so many segments, of which nothing is known.
    pub(super) fn new(segments: usize) -> Self {
        let mut features = Self {
            segments: vec![SegmentFeatures::default(); segments],
            open: BTreeMap::new(),
            revision: Revision::new(),
            proved: 0,
            assembled: OnceCell::new(),
        };
        features.forget(0..segments);
        features
    }

    /// Forget what was proved of some segments.
    pub(super) fn forget(&mut self, segments: Range<usize>) {
        self.revision = Revision::new();
        self.assembled = OnceCell::new();
        let revision = self.revision;
        self.open
            .extend(segments.map(|segment| (segment, revision)));
    }

    /// The revision of the proof: it changes whenever there is something to prove.
    pub fn revision(&self) -> Revision {
        self.revision
    }

    /// The open part of the proof; `None` if all is proved.
    pub(super) fn proof(&self, curve: &Arc<Curve>, planar: bool) -> Option<FeatureProof> {
        let segments: Vec<_> = self.open.iter().map(|(k, since)| (*k, *since)).collect();
        (!segments.is_empty()).then(|| FeatureProof {
            curve: curve.clone(),
            planar,
            segments,
        })
    }

    /// Take the result of a proof. It counts for segments that have not changed since.
    pub(super) fn take(&mut self, result: ProofResult) {
        self.proved = 0;
        for (index, revision, features) in result.0 {
            if self.open.get(&index) == Some(&revision)
                && let Some(segment) = self.segments.get_mut(index)
            {
                self.open.remove(&index);
                self.proved += 1;
                *segment = features;
            }
        }
    }

    /// The number of segments that the last proof counted for.
    pub fn proved(&self) -> usize {
        self.proved
    }

    /// The features of the whole curve, if those of all its segments are known.
    pub(super) fn known(&self, curve: &Curve) -> Option<&Features> {
        let assemble = || Features::assemble(&curve.polygon, &self.segments);
        self.open
            .is_empty()
            .then(|| self.assembled.get_or_init(assemble))
    }

    /// The features of all segments, if they are known.
    pub fn segments(&self) -> Option<&[SegmentFeatures]> {
        self.open.is_empty().then_some(self.segments.as_slice())
    }

    /// The share of the segments whose features are known.
    pub fn share(&self) -> f64 {
        1.0 - self.open.len() as f64 / self.segments.len().max(1) as f64
    }
}
