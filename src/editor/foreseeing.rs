//! Telling beforehand how far changes of degree would move the active curve, worked out beside the frame.

use std::sync::Arc;
use std::time::Duration;

use crate::document::Curve;
use crate::editor::patience::Patience;
use crate::editor::worker::{Outcome, Worker};
use crate::geometry::Progress;
use crate::operations::{Deviation, Input, Operation, Values};

/// Curves of more segments are looked at later than the frame that asks.
const MOST_SEGMENTS: usize = 1000;

/// An operation, what it works on, and the values that it begins with.
pub(in crate::editor) type Begun = (&'static Operation, Input, Values);

/// Foresee deviations of one curve at a time.
#[derive(Debug)]
pub(in crate::editor) struct Foreseeing {
    worker: Worker<Foreseen>,
    /// The curve that was asked about last.
    asked: Option<Arc<Curve>>,
    known: Option<Foreseen>,
}

/// How far operations would move a curve with the values that they begin with.
#[derive(Debug)]
struct Foreseen {
    curve: Arc<Curve>,
    deviations: Vec<(&'static Operation, Deviation)>,
}

impl Default for Foreseeing {
    /// Foresee at once, however long it takes.
    fn default() -> Self {
        Self {
            worker: Worker::inline(),
            asked: None,
            known: None,
        }
    }
}

impl Foreseeing {
    /// Foresee on a thread of its own; `wake` is called when more is known later than it is waited for.
    pub fn background(wake: impl Fn() + Send + 'static) -> Self {
        Self {
            worker: Worker::background("foresight", wake),
            ..Self::default()
        }
    }

    /// Take what was found out since the last frame.
    pub fn receive(&mut self) {
        let ready = self.worker.take();
        self.take(ready);
    }

    /// Whether a curve was asked about last.
    pub fn is_about(&self, curve: &Arc<Curve>) -> bool {
        let asked = self.asked.as_ref();
        asked.is_some_and(|asked| Arc::ptr_eq(asked, curve))
    }

    /// Find out how far operations with these values would move a curve.
    pub fn ask(&mut self, curve: Arc<Curve>, begun: Vec<Begun>, patience: &mut Patience) {
        let waits = curve.polygon.segments() <= MOST_SEGMENTS;
        self.asked = Some(curve.clone());
        let job = move |progress: &Progress| {
            let deviations = begun.iter().filter_map(|(operation, input, values)| {
                let outcome = operation.run(input, values, progress).ok()?;
                Some((*operation, outcome.deviation))
            });
            Foreseen {
                deviations: deviations.collect(),
                curve,
            }
        };
        let ready = patience.spend(|left| {
            let at_most = if waits { left } else { Duration::ZERO };
            self.worker.start(job, at_most)
        });
        self.take(ready);
    }

    /// How far an operation would move a curve; `None` if that is not known, or not yet.
    pub fn deviation(&self, curve: &Arc<Curve>, operation: &Operation) -> Option<Deviation> {
        let known = self.known.as_ref();
        let known = known.filter(|known| Arc::ptr_eq(&known.curve, curve))?;
        let mut deviations = known.deviations.iter();
        let found = deviations.find(|(other, _)| *other == operation)?;
        Some(found.1)
    }

    fn take(&mut self, outcomes: impl IntoIterator<Item = Outcome<Foreseen>>) {
        for outcome in outcomes {
            // Of a failed one nothing is known until the curve changes.
            if let Outcome::Done(foreseen) = outcome {
                self.known = Some(foreseen);
            }
        }
    }
}
