//! The deviation that a change of degree would cause, worked out before the user starts it.

use std::sync::Arc;

use super::Client;
use super::patience::Patience;
use crate::analysis::Item;
use crate::document::Curve;
use crate::geometry::Progress;
use crate::operations::{Deviation, Operands, Operation, Values};

/// An operation with its input and default values.
pub(in crate::editor) type Candidate = (&'static Operation, Operands, Values);

/// Foresee deviations beside the frame, of one curve at a time.
pub(in crate::editor) type Foreseeing = Client<Item, Vec<(&'static Operation, Deviation)>>;

impl Foreseeing {
    /// Request the deviations of a curve by some operations.
    pub fn foresee(
        &mut self,
        curve: Arc<Curve>,
        candidates: Vec<Candidate>,
        patience: &mut Patience,
    ) {
        let patience = patience.with_segments(curve.polygon.segments());
        let job = move |progress: &Progress| {
            let deviations = candidates.iter().filter_map(|(operation, input, values)| {
                let outcome = operation.run(input, values, progress).ok()?;
                Some((*operation, outcome.deviation))
            });
            Some(deviations.collect())
        };
        self.start(Item::Curve(curve), job, patience);
    }

    /// Whether the latest request is about this state of a curve.
    pub fn is_about(&self, curve: &Arc<Curve>) -> bool {
        self.request() == Some(&Item::Curve(curve.clone()))
    }

    /// The deviation of a curve by an operation; `None` until it is known, and if the operation fails.
    pub fn deviation(&self, curve: &Arc<Curve>, operation: &Operation) -> Option<Deviation> {
        let deviations = self.result().filter(|_| self.is_about(curve))?;
        let of_operation = deviations.iter().find(|(other, _)| *other == operation);
        of_operation.map(|(_, deviation)| *deviation)
    }
}
