//! Measuring the harmony of the active curve beside the frame.

use std::sync::Arc;
use std::time::Duration;

use crate::analysis::{AnalysisCache, MeasuredHarmony};
use crate::document::{Curve, CurveId};
use crate::editor::patience::Patience;
use crate::editor::worker::{Outcome, Worker};
use crate::geometry::Progress;

/// Curves of more segments are measured later than the frame that changes them.
const MOST_SEGMENTS: usize = 1000;

/// Measure harmony one curve at a time.
#[derive(Debug)]
pub struct Measuring {
    worker: Worker<Measured>,
    /// The curve whose harmony was asked for last.
    asked: Option<Arc<Curve>>,
}

/// A curve, and what its measurement came to if it was not cancelled.
type Measured = (CurveId, Option<MeasuredHarmony>);

impl Default for Measuring {
    /// Measure at once, however long it takes.
    fn default() -> Self {
        Self {
            worker: Worker::inline(),
            asked: None,
        }
    }
}

impl Measuring {
    /// Measure on a thread of its own; `wake` is called when more is known later than it is waited
    /// for.
    pub fn background(wake: impl Fn() + Send + 'static) -> Self {
        Self {
            worker: Worker::background("harmony", wake),
            ..Self::default()
        }
    }

    /// Take what is measured, and see to it that the harmony of a curve will be.
    pub fn advance(&mut self, id: CurveId, analyses: &mut AnalysisCache, patience: &mut Patience) {
        let ready = self.worker.take();
        take(ready, analyses);
        let Some(analysis) = analyses.get(id) else {
            return;
        };
        let asked = self.asked.as_ref();
        if asked.is_some_and(|asked| Arc::ptr_eq(asked, analysis.curve())) {
            return;
        }
        let Some(measurement) = analysis.harmony_measurement() else {
            return;
        };
        self.asked = Some(analysis.curve().clone());
        let waits = measurement.segments() <= MOST_SEGMENTS;
        let job = move |progress: &Progress| (id, measurement.run(progress));
        let ready = patience.spend(|left| {
            let at_most = if waits { left } else { Duration::ZERO };
            self.worker.start(job, at_most)
        });
        take(ready, analyses);
    }
}

/// Take what measurements came to. Of a failed one nothing is known until the curve changes.
fn take(outcomes: impl IntoIterator<Item = Outcome<Measured>>, analyses: &mut AnalysisCache) {
    for outcome in outcomes {
        if let Outcome::Done((id, Some(measured))) = outcome
            && let Some(analysis) = analyses.get_mut(id)
        {
            analysis.take_harmony(measured);
        }
    }
}
