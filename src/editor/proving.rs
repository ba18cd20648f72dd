//! Proving the features of the active curve beside the frame.

use crate::analysis::{AnalysisCache, ProofResult, Revision};
use crate::document::CurveId;
use crate::editor::patience::Patience;
use crate::editor::worker::{Outcome, Worker};
use crate::geometry::Progress;

/// Prove features one curve at a time.
#[derive(Debug)]
pub struct Proving {
    worker: Worker<Proved>,
    /// The state of the features that the newest proof set out to complete.
    asked: Option<Revision>,
    /// Whether it failed, which would be a fault of the program.
    failed: bool,
}

impl Default for Proving {
    /// Prove at once, however long it takes.
    fn default() -> Self {
        Self {
            worker: Worker::inline(),
            asked: None,
            failed: false,
        }
    }
}

impl Proving {
    /// Prove on a thread of its own; `wake` is called when more is proved later than it is waited
    /// for.
    pub fn background(wake: impl Fn() + Send + 'static) -> Self {
        Self {
            worker: Worker::background("features", wake),
            ..Self::default()
        }
    }

    /// Take what is proved, and see to it that the rest of a curve's features will be.
    pub fn advance(&mut self, id: CurveId, analyses: &mut AnalysisCache, patience: &mut Patience) {
        let ready = self.worker.take();
        self.take(ready, analyses);
        let Some(analysis) = analyses.get(id) else {
            return;
        };
        let revision = analysis.proof_revision();
        if self.asked == Some(revision) {
            return;
        }
        self.asked = Some(revision);
        self.failed = false;
        if let Some(proof) = analysis.proof() {
            let job = move |progress: &Progress| (id, proof.run(progress));
            let ready = patience.spend(|left| self.worker.start(job, left));
            self.take(ready, analyses);
        }
    }

    /// The share that is done of what the newest proof set out to do; `None` if it failed.
    pub fn share(&self) -> Option<f64> {
        let share = self.worker.progress().map_or(0.0, Progress::done);
        (!self.failed).then_some(share)
    }

    /// Take what proofs came to. What a failed one left open stays so until the curve changes.
    fn take(
        &mut self,
        outcomes: impl IntoIterator<Item = Outcome<Proved>>,
        analyses: &mut AnalysisCache,
    ) {
        for outcome in outcomes {
            match outcome {
                Outcome::Done((id, result)) => {
                    if let Some(analysis) = analyses.get_mut(id) {
                        analysis.take_proof(result);
                    }
                }
                Outcome::Panicked(_) => self.failed = true,
            }
        }
    }
}

/// A curve, and what a proof of its features came to.
type Proved = (CurveId, ProofResult);
