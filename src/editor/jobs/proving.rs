//! The proof of the active curve's features, one curve at a time.

use super::Client;
use super::patience::Patience;
use crate::analysis::{AnalysisCache, ProofResult, Revision};
use crate::document::CurveId;

/// Prove features beside the frame. The request is the state of the features that a proof completes.
pub type Proving = Client<Revision, (CurveId, ProofResult)>;

impl Proving {
    /// Hand results to the analyses, and start the proof of a curve's open features.
    pub fn prove(&mut self, id: CurveId, analyses: &mut AnalysisCache, patience: &mut Patience) {
        self.receive();
        self.hand_over(analyses);
        let Some(analysis) = analyses.get(id) else {
            return;
        };
        let revision = analysis.proof_revision();
        if self.request() == Some(&revision) {
            return;
        }
        match analysis.proof() {
            Some(proof) => {
                let job = move |progress: &_| Some((id, proof.run(progress)));
                self.start(revision, job, Some(patience));
                self.hand_over(analyses);
            }
            None => self.forget(),
        }
    }

    /// The share that is done of the latest proof, from 0 to 1; `None` if it panicked. The features
    /// it left open stay so until the curve changes.
    pub fn share(&self) -> Option<f64> {
        let share = self.progress().unwrap_or_default();
        self.failure().is_none().then_some(share)
    }

    /// Outdated results count too: many segments of a curve are the same as before.
    fn hand_over(&mut self, analyses: &mut AnalysisCache) {
        let outdated = self.take_outdated();
        for (id, result) in outdated.into_iter().chain(self.take_result()) {
            if let Some(analysis) = analyses.get_mut(id) {
                analysis.take_proof(result);
            }
        }
    }
}
