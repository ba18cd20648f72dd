//! Measuring beside the frame how far the active curve is from what it is compared with.

use std::sync::Arc;

use crate::analysis::{Distance, Measured};
use crate::document::Curve;
use crate::editor::patience::Patience;
use crate::editor::worker::{Outcome, Worker};
use crate::geometry::Progress;

/// Measure one pair at a time.
#[derive(Debug)]
pub struct Comparing {
    worker: Worker<(u64, Option<Distance>)>,
    /// The pair that was asked about last, with the number of that question.
    asked: Option<(Pair, u64)>,
    /// What that came to, once it is known.
    found: Option<Distance>,
    questions: u64,
}

/// A curve and what it is measured against.
#[derive(Clone, Debug)]
pub struct Pair {
    /// The curve.
    pub curve: Arc<Curve>,
    /// What it is measured against.
    pub other: Measured,
}

impl Default for Comparing {
    /// Measure at once, however long it takes.
    fn default() -> Self {
        Self {
            worker: Worker::inline(),
            asked: None,
            found: None,
            questions: 0,
        }
    }
}

impl Comparing {
    /// Measure on a thread of its own; `wake` is called when more is known later than it is waited for.
    pub fn background(wake: impl Fn() + Send + 'static) -> Self {
        Self {
            worker: Worker::background("distances", wake),
            ..Self::default()
        }
    }

    /// Take what is measured, and see to it that a pair will be, if there is one.
    pub fn advance(&mut self, pair: Option<Pair>, patience: &mut Patience) {
        let ready = self.worker.take();
        self.take(ready);
        let Some(pair) = pair else {
            self.asked = None;
            self.found = None;
            return;
        };
        let known = self.asked.as_ref();
        if known.is_some_and(|(asked, _)| asked.is_same(&pair)) {
            return;
        }
        self.questions += 1;
        let question = self.questions;
        self.asked = Some((pair.clone(), question));
        let measure = move |_: &Progress| {
            let distance = Distance::measure(&pair.curve.polygon, &pair.other);
            (question, distance)
        };
        let ready = patience.spend(|left| self.worker.start(measure, left));
        self.take(ready);
    }

    /// What the last pair came to; `None` until it is measured.
    pub fn found(&self) -> Option<&Distance> {
        self.found.as_ref()
    }

    fn take(&mut self, outcomes: impl IntoIterator<Item = Outcome<(u64, Option<Distance>)>>) {
        for outcome in outcomes {
            if let Outcome::Done((question, distance)) = outcome
                && self
                    .asked
                    .as_ref()
                    .is_some_and(|(_, asked)| *asked == question)
            {
                self.found = distance;
            }
        }
    }
}

impl Pair {
    fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.curve, &other.curve) && self.other.is_same(&other.other)
    }
}
