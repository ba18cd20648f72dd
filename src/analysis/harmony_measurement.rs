//! The harmony of a curve, updated segment by segment.

use std::sync::Arc;

use super::changed_segments::changed_segments;
use crate::document::Curve;
use crate::geometry::Progress;
use crate::geometry::features::Features;
use crate::geometry::harmony::{Harmony, SegmentFairness};

/// Measure the harmony of a curve: a job for any thread.
#[derive(Clone, Debug)]
pub struct HarmonyMeasurement {
    curve: Arc<Curve>,
    features: Features,
    /// The last result, which still holds for unchanged segments.
    known: Option<Arc<MeasuredHarmony>>,
}

/// Hold the harmony of a curve, with the figures of its segments.
#[derive(Debug)]
pub struct MeasuredHarmony {
    curve: Arc<Curve>,
    segments: Vec<SegmentFairness>,
    harmony: Harmony,
}

impl HarmonyMeasurement {
    pub(super) fn new(
        curve: Arc<Curve>,
        features: Features,
        known: Option<Arc<MeasuredHarmony>>,
    ) -> Self {
        Self {
            curve,
            features,
            known,
        }
    }

    /// The number of segments of the curve.
    pub fn segments(&self) -> usize {
        self.curve.polygon.segments()
    }

    /// Measure segment by segment; `None` if the measurement is cancelled.
    pub fn run(&self, progress: &Progress) -> Option<MeasuredHarmony> {
        let polygon = &self.curve.polygon;
        let planar = polygon.is_planar();
        let known = self.known.as_ref().and_then(|known| {
            let changed = changed_segments(&known.curve.polygon, polygon)?;
            Some((known.segments.clone(), changed))
        });
        let whole = 0..polygon.segments();
        let (mut segments, changed) = known.unwrap_or((Vec::new(), vec![whole]));
        for segment in changed.into_iter().flatten() {
            if progress.is_cancelled() {
                return None;
            }
            let fairness = SegmentFairness::new(polygon, segment, planar);
            match segments.get_mut(segment) {
                Some(own) => *own = fairness,
                None => segments.push(fairness),
            }
        }
        let harmony = Harmony::assemble(polygon, &self.features, &segments);
        Some(MeasuredHarmony {
            curve: self.curve.clone(),
            segments,
            harmony,
        })
    }
}

impl MeasuredHarmony {
    /// The harmony, if it is that of this very curve.
    pub(super) fn of(&self, curve: &Arc<Curve>) -> Option<&Harmony> {
        Arc::ptr_eq(&self.curve, curve).then_some(&self.harmony)
    }
}
