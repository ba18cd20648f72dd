//! The deviation that a change of degree would cause, worked out before the user starts it.

use std::sync::Arc;

use super::Client;
use super::patience::Patience;
use crate::document::Curve;
use crate::geometry::Progress;
use crate::operations::{Deviation, Operands, Operation, Values};

/// The most segments of a curve that a frame waits for: a thousand take about a millisecond.
const MOST_SEGMENTS: usize = 1000;

/// An operation with its input and default values.
pub(in crate::editor) type Candidate = (&'static Operation, Operands, Values);

/// Foresee deviations beside the frame, of one curve at a time.
#[derive(Debug, Default)]
pub(in crate::editor) struct Foreseeing(Client<Arc<Curve>, Vec<(&'static Operation, Deviation)>>);

impl Foreseeing {
    /// Foresee on a thread, which calls `wake` when deviations are known.
    pub fn background(wake: impl Fn() + Send + 'static) -> Self {
        Self(Client::background("foresight", wake))
    }

    /// Take what the thread has finished.
    pub fn receive(&mut self) {
        self.0.receive();
    }

    /// Whether the latest request is about this state of a curve.
    pub fn is_about(&self, curve: &Arc<Curve>) -> bool {
        let latest = self.0.request();
        latest.is_some_and(|latest| Arc::ptr_eq(latest, curve))
    }

    /// Request the deviations of a curve by some operations.
    pub fn request(
        &mut self,
        curve: Arc<Curve>,
        candidates: Vec<Candidate>,
        patience: &mut Patience,
    ) {
        let patience = (curve.polygon.segments() <= MOST_SEGMENTS).then_some(patience);
        let job = move |progress: &Progress| {
            let deviations = candidates.iter().filter_map(|(operation, input, values)| {
                let outcome = operation.run(input, values, progress).ok()?;
                Some((*operation, outcome.deviation))
            });
            Some(deviations.collect())
        };
        self.0.start(curve, job, patience);
    }

    /// The deviation of a curve by an operation; `None` until it is known, and if the operation fails.
    pub fn deviation(&self, curve: &Arc<Curve>, operation: &Operation) -> Option<Deviation> {
        let deviations = self.0.result().filter(|_| self.is_about(curve))?;
        let of_operation = deviations.iter().find(|(other, _)| *other == operation);
        of_operation.map(|(_, deviation)| *deviation)
    }
}
