//! Steps of the curvature: where it rises or falls steeply, then hardly at all, and again.

use super::float_polygon::FloatPolygon;
use super::sampler::{BATCH_ORDER, Batch, Sampler};

/// Samples of a segment.
const SAMPLES: usize = 8;

/// A smaller share of its range is no turn of the slope.
const LEAST_TURN: f64 = 0.1;

/// Count how often the slope of the curvature turns: the extrema of dκ/ds · |C′|³ that differ by more than a tenth of
/// its range, at samples. A curve whose curvature has n extrema turns about n + 1 times; one whose curvature climbs in
/// steps turns twice at each.
///
/// The factor |C′|³ makes a wave count by how far it moves the curve, as legs are shorter where a curve bends more.
pub fn curvature_turns(polygon: &FloatPolygon) -> usize {
    let planar = polygon.is_planar();
    let sampler = Sampler::even(polygon.degree(), SAMPLES);
    let mut batch = Batch::default();
    let mut slopes: Vec<f64> = Vec::new();
    for segment in 0..polygon.segments() {
        sampler.segment(polygon, segment, BATCH_ORDER, &mut batch);
        slopes.extend((0..batch.len()).map(|index| {
            let jet = batch.jet(index);
            jet.curvature_slope(planar) * jet.speed().powi(3)
        }));
    }
    turns(&slopes)
}

/// Count the extrema of a sequence that differ by more than [`LEAST_TURN`] of its range.
fn turns(values: &[f64]) -> usize {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let low = finite().fold(f64::INFINITY, f64::min);
    let high = finite().fold(f64::NEG_INFINITY, f64::max);
    let least = LEAST_TURN * (high - low);
    let mut count = 0;
    // The extremes since the last turn.
    let [mut lowest, mut highest] = [f64::INFINITY, f64::NEG_INFINITY];
    let mut rises = None;
    for value in finite() {
        lowest = lowest.min(value);
        highest = highest.max(value);
        let turns_down = rises != Some(false) && highest - value > least;
        let turns_up = rises != Some(true) && value - lowest > least;
        if turns_down || turns_up {
            count += usize::from(rises.is_some());
            rises = Some(turns_up);
            [lowest, highest] = [value; 2];
        }
    }
    count
}
