//! The measurement of the active curve's harmony, one curve at a time.

use super::Client;
use super::patience::Patience;
use crate::analysis::{AnalysisCache, Item, MeasuredHarmony};
use crate::document::CurveId;

/// Measure harmony beside the frame.
pub type Measuring = Client<(CurveId, Item), MeasuredHarmony>;

impl Measuring {
    /// Hand the result to the analyses, and start the measurement of a curve that has changed.
    pub fn measure(&mut self, id: CurveId, analyses: &mut AnalysisCache, patience: &mut Patience) {
        self.receive();
        self.hand_over(analyses);
        let Some(analysis) = analyses.get(id) else {
            return;
        };
        let request = (id, Item::Curve(analysis.curve().clone()));
        if self.request() == Some(&request) {
            return;
        }
        if let Some(measurement) = analysis.harmony_measurement() {
            let patience = patience.with_segments(measurement.segments());
            self.start(request, move |progress| measurement.run(progress), patience);
            self.hand_over(analyses);
        }
    }

    fn hand_over(&mut self, analyses: &mut AnalysisCache) {
        let analysis = self.request().and_then(|(id, _)| analyses.get_mut(*id));
        if let (Some(analysis), Some(measured)) = (analysis, self.take_result()) {
            analysis.take_harmony(measured);
        }
    }
}
