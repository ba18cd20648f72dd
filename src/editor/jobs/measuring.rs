//! The measurement of the active curve's harmony, one curve at a time.

use std::sync::Arc;

use super::Client;
use super::patience::Patience;
use crate::analysis::{AnalysisCache, MeasuredHarmony};
use crate::document::{Curve, CurveId};

/// The most segments of a curve that a frame waits for: a thousand take about a millisecond.
const MOST_SEGMENTS: usize = 1000;

/// Measure harmony beside the frame.
#[derive(Debug, Default)]
pub struct Measuring(Client<(CurveId, Arc<Curve>), MeasuredHarmony>);

impl Measuring {
    /// Measure on a thread, which calls `wake` when harmony is measured.
    pub fn background(wake: impl Fn() + Send + 'static) -> Self {
        Self(Client::background("harmony", wake))
    }

    /// Hand the result to the analyses, and start the measurement of a curve that has changed.
    pub fn advance(&mut self, id: CurveId, analyses: &mut AnalysisCache, patience: &mut Patience) {
        self.0.receive();
        self.hand_over(analyses);
        let Some(analysis) = analyses.get(id) else {
            return;
        };
        let is_requested = |(_, curve): &(_, _)| Arc::ptr_eq(curve, analysis.curve());
        if self.0.request().is_some_and(is_requested) {
            return;
        }
        if let Some(measurement) = analysis.harmony_measurement() {
            let patience = (measurement.segments() <= MOST_SEGMENTS).then_some(patience);
            let job = move |progress: &_| measurement.run(progress);
            self.0.start((id, analysis.curve().clone()), job, patience);
            self.hand_over(analyses);
        }
    }

    fn hand_over(&mut self, analyses: &mut AnalysisCache) {
        let analysis = self.0.request().and_then(|(id, _)| analyses.get_mut(*id));
        if let (Some(analysis), Some(measured)) = (analysis, self.0.take_result()) {
            analysis.take_harmony(measured);
        }
    }
}
