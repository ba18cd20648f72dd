//! Distance of a curve from the one that it approximates.

use glam::DVec3;

use super::error::ApproximationError;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::jet::Jet;
use crate::geometry::nearest::refined_parameter;
use crate::geometry::progress::Progress;
use crate::geometry::root::maximum;
use crate::geometry::vector;

/// Samples a segment at which distances are measured.
const SAMPLES: usize = 16;

/// The least samples of the curve that distances are measured to.
const LEAST_SAMPLES: usize = 256;

/// Samples of that curve that share a box.
const BLOCK: usize = 16;

/// Maxima between samples are looked for about samples that reach this share of the largest.
const NEARLY_LARGEST: f64 = 0.95;

/// Steps of the golden section: they leave 1e-3 of two samples' distance, and of a smooth maximum's height
/// an error of the square of that.
const SECTIONS: usize = 15;

/// Distance of one curve from another: true distances, from points of the one to the nearest points
/// of the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredDeviation {
    /// The largest distance, to 1e-3 of itself: sampled at 16 parameters a segment, and refined.
    pub largest: f64,
    /// The parameter u where it is.
    pub u: f64,
    /// The parameter of the other curve's point that is nearest there.
    pub t: f64,
    /// The mean over the arc length.
    pub mean: f64,
}

impl MeasuredDeviation {
    /// Measure how far a curve is from another one, which it runs beside: `parameter` tells which t is near a
    /// given u. Points beside the ends are measured to where the other curve goes on beyond them, as far
    /// as `reach` if it has points there.
    ///
    /// # Errors
    /// [`ApproximationError::NotFinite`] where the other curve has no points;
    /// [`ApproximationError::Cancelled`] soon after a cancellation.
    pub fn measure(
        polygon: &FloatPolygon,
        curve: &dyn Differentiable,
        parameter: &dyn Fn(f64) -> f64,
        reach: [f64; 2],
        progress: &Progress,
    ) -> Result<Self, ApproximationError> {
        let segments = polygon.segments();
        let count = (segments * SAMPLES).max(LEAST_SAMPLES);
        let interval = [0, segments].map(|u| parameter(u as f64));
        let target = Target::new(curve, interval, reach, count)?;
        let nearest = |u: f64| target.nearest(polygon.point(u), parameter(u));
        let distance = |u: f64| nearest(u).0;
        let last = segments * SAMPLES;
        let place = |index: usize| index as f64 / SAMPLES as f64;
        let going_on = |index: usize| (!progress.is_cancelled()).then_some(index);
        let distances = (0..=last).map(|index| Some(distance(place(going_on(index)?))));
        let distances: Option<Vec<f64>> = distances.collect();
        let distances = distances.ok_or(ApproximationError::Cancelled)?;
        let mut found = (0..=last).fold(
            Self {
                largest: -1.0,
                u: 0.0,
                t: 0.0,
                mean: mean(polygon, &distances),
            },
            |found, index| found.or(distances[index], place(index)),
        );
        let enough = NEARLY_LARGEST * found.largest;
        for index in 0..=last {
            going_on(index).ok_or(ApproximationError::Cancelled)?;
            let (before, after) = (index.saturating_sub(1), (index + 1).min(last));
            let here = distances[index];
            if here >= enough && here >= distances[before] && here >= distances[after] {
                let (u, largest) = maximum([place(before), place(after)], SECTIONS, distance);
                found = found.or(largest, u);
            }
        }
        found.t = nearest(found.u).1;
        Ok(found)
    }

    fn or(self, distance: f64, u: f64) -> Self {
        if distance > self.largest {
            Self {
                largest: distance,
                u,
                ..self
            }
        } else {
            self
        }
    }
}

/// The mean of sampled distances over the arc length, by the trapezium rule.
fn mean(polygon: &FloatPolygon, distances: &[f64]) -> f64 {
    let (mut sum, mut length) = (0.0, 0.0);
    for (index, distance) in distances.iter().enumerate() {
        let at_end = index == 0 || index + 1 == distances.len();
        let speed = polygon.jet(index as f64 / SAMPLES as f64).speed();
        let weight = if at_end { 0.5 * speed } else { speed };
        sum += weight * distance;
        length += weight;
    }
    if length > 0.0 { sum / length } else { 0.0 }
}

/// A curve to measure distances to, sampled at even parameters.
struct Target<'a> {
    curve: &'a dyn Differentiable,
    samples: Vec<(f64, DVec3)>,
    step: f64,
    blocks: Vec<Block>,
}

/// Some samples that follow each other.
struct Block {
    first: usize,
    low: DVec3,
    high: DVec3,
    /// Margin of the box: the curve leaves it by at most half of the longest step.
    margin: f64,
}

impl<'a> Target<'a> {
    /// Sample a curve at `count` steps of an interval, and beyond it as far as `reach` while there are
    /// points.
    fn new(
        curve: &'a dyn Differentiable,
        [from, to]: [f64; 2],
        reach: [f64; 2],
        count: usize,
    ) -> Result<Self, ApproximationError> {
        let step = (to - from) / count as f64;
        let sample = |parameter: f64| (parameter, curve.derivatives(parameter, 0)[0]);
        let beyond = |end: f64, step: f64, most: f64| {
            let steps = ((most - end) / step).floor().clamp(0.0, count as f64) as usize;
            let samples = (1..=steps).map(move |index| sample(end + step * index as f64));
            samples.take_while(|(_, point)| point.is_finite())
        };
        let mut samples: Vec<(f64, DVec3)> = beyond(from, -step, reach[0]).collect();
        samples.reverse();
        for index in 0..=count {
            let share = index as f64 / count as f64;
            let (parameter, point) = sample(from * (1.0 - share) + to * share);
            if !point.is_finite() {
                return Err(ApproximationError::NoPoint { parameter });
            }
            samples.push((parameter, point));
        }
        samples.extend(beyond(to, step, reach[1]));
        let blocks = (0..samples.len() - 1).step_by(BLOCK);
        Ok(Self {
            blocks: blocks.map(|first| Block::new(&samples, first)).collect(),
            curve,
            samples,
            step,
        })
    }

    /// The distance of a point from the curve, and the parameter of the nearest point there; `near` is a
    /// parameter in its neighbourhood.
    fn nearest(&self, point: DVec3, near: f64) -> (f64, f64) {
        let last = self.samples.len() - 1;
        let start = ((near - self.samples[0].0) / self.step).round();
        let mut best = self.refined(point, (start.max(0.0) as usize).min(last));
        for block in &self.blocks {
            let box_distance = point.distance(point.clamp(block.low, block.high));
            if box_distance - block.margin >= best.0 {
                continue;
            }
            let samples = block.first..=(block.first + BLOCK).min(last);
            let distances = samples.map(|index| (self.samples[index].1.distance(point), index));
            let nearest = distances.min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((distance, index)) = nearest
                && distance - block.margin < best.0
            {
                let refined = self.refined(point, index);
                if refined.0 < best.0 {
                    best = refined;
                }
            }
        }
        best
    }

    /// The distance from the curve near one of its samples, and where that is.
    fn refined(&self, point: DVec3, index: usize) -> (f64, f64) {
        let last = self.samples.len() - 1;
        let bracket = [index.saturating_sub(1), (index + 1).min(last)];
        let bracket = bracket.map(|index| self.samples[index].0);
        let jet = |t: f64| {
            let values = self.curve.derivatives(t, 2);
            Jet {
                point: values[0],
                first: values[1],
                second: values[2],
                third: DVec3::ZERO,
            }
        };
        let (start, sample) = self.samples[index];
        let t = refined_parameter(point, start, bracket, jet);
        let refined = self.curve.derivatives(t, 0)[0].distance(point);
        let sampled = sample.distance(point);
        // Where the curve has no derivatives the sample counts.
        if refined < sampled {
            (refined, t)
        } else {
            (sampled, start)
        }
    }
}

impl Block {
    /// The samples from `first` to the first one of the next block.
    fn new(samples: &[(f64, DVec3)], first: usize) -> Self {
        let last = (first + BLOCK).min(samples.len() - 1);
        let samples = &samples[first..=last];
        let steps = samples.windows(2).map(|step| step[0].1.distance(step[1].1));
        let (low, high) = vector::bounds(samples.iter().map(|(_, point)| point));
        Self {
            first,
            low,
            high,
            margin: 0.5 * steps.fold(0.0, f64::max),
        }
    }
}
