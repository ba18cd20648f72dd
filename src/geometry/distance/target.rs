//! A curve to measure distances to.

use glam::DVec3;

use super::error::DistanceError;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::jet::Jet;
use crate::geometry::nearest::refined_parameter;
use crate::geometry::vector;

/// Samples that share a box.
const BLOCK: usize = 16;

/// Boxes that share a larger box.
const FAN: usize = 4;

/// A curve, sampled, in a tree of boxes.
pub(super) struct Target<'a> {
    curve: &'a dyn Differentiable,
    samples: Vec<(f64, DVec3)>,
    /// The boxes of blocks of samples, then those of [`FAN`] boxes each, up to one box.
    levels: Vec<Vec<Bounds>>,
}

/// What some samples that follow each other lie in.
#[derive(Clone, Copy)]
struct Bounds {
    low: DVec3,
    high: DVec3,
    /// Margin of the box: the curve leaves it by at most half of the longest step.
    margin: f64,
}

impl<'a> Target<'a> {
    /// Sample a curve at ascending parameters, and beyond the last and the first one at those of `beyond` while there
    /// are points.
    ///
    /// # Errors
    /// [`DistanceError::NoPoint`] where the curve has no point.
    pub(super) fn new(
        curve: &'a dyn Differentiable,
        parameters: impl Iterator<Item = f64>,
        beyond: [Vec<f64>; 2],
    ) -> Result<Self, DistanceError> {
        let sample = |parameter: f64| (parameter, curve.derivatives(parameter, 0)[0]);
        let [before, after] = beyond.map(|parameters| {
            let samples = parameters.into_iter().map(sample);
            samples.take_while(|(_, point)| point.is_finite())
        });
        let mut samples: Vec<(f64, DVec3)> = before.collect();
        samples.reverse();
        for parameter in parameters {
            let (parameter, point) = sample(parameter);
            if !point.is_finite() {
                return Err(DistanceError::NoPoint { parameter });
            }
            samples.push((parameter, point));
        }
        samples.extend(after);
        let blocks = (0..samples.len().saturating_sub(1)).step_by(BLOCK);
        let mut levels = vec![blocks.map(|first| Bounds::of(&samples, first)).collect()];
        while let Some(finer) = levels.last().filter(|finer: &&Vec<Bounds>| finer.len() > 1) {
            levels.push(finer.chunks(FAN).map(Bounds::around).collect());
        }
        Ok(Self {
            curve,
            samples,
            levels,
        })
    }

    /// Its samples: parameters and points.
    pub(super) fn samples(&self) -> &[(f64, DVec3)] {
        &self.samples
    }

    /// The diagonal of the box of its samples.
    pub(super) fn size(&self) -> f64 {
        let whole = self.levels.last().and_then(|level| level.first());
        whole.map_or(0.0, |it| it.low.distance(it.high))
    }

    /// The distance of a point from the curve, and the parameter of the nearest point there; `near` is a
    /// parameter in its neighbourhood.
    pub(super) fn nearest(&self, point: DVec3, near: f64) -> (f64, f64) {
        // Nothing is nearer to such a point than anything else.
        if !point.is_finite() {
            return (f64::NAN, near);
        }
        let last = self.samples.len() - 1;
        let start = self.samples.partition_point(|(t, _)| *t < near);
        let mut best = self.refined(point, start.min(last));
        let mut left = vec![(self.levels.len() - 1, 0)];
        while let Some((level, index)) = left.pop() {
            let Some(around) = self.levels[level].get(index) else {
                continue;
            };
            if around.distance(point) >= best.0 {
                continue;
            }
            if let Some(finer) = level.checked_sub(1) {
                left.extend((FAN * index..FAN * (index + 1)).map(|index| (finer, index)));
                continue;
            }
            let first = BLOCK * index;
            for index in first..=(first + BLOCK).min(last) {
                let distance = |index: usize| self.samples[index].1.distance(point);
                let beside = [index.saturating_sub(1), (index + 1).min(last)];
                let here = distance(index);
                if here - around.margin < best.0 && beside.iter().all(|it| here <= distance(*it)) {
                    let refined = self.refined(point, index);
                    if refined.0 < best.0 {
                        best = refined;
                    }
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
        let (start, sample) = self.samples[index];
        let t = foot(self.curve, point, start, bracket);
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

/// The parameter of a curve's point next to another point, from a start, within a bracket.
pub(super) fn foot(curve: &dyn Differentiable, point: DVec3, start: f64, bracket: [f64; 2]) -> f64 {
    refined_parameter(point, start, bracket, |t| {
        let values = curve.derivatives(t, 2);
        Jet {
            point: values[0],
            first: values[1],
            second: values[2],
            third: DVec3::ZERO,
        }
    })
}

impl Bounds {
    /// The samples from `first` to the first one of the next block.
    fn of(samples: &[(f64, DVec3)], first: usize) -> Self {
        let last = (first + BLOCK).min(samples.len() - 1);
        let samples = &samples[first..=last];
        let steps = samples.windows(2).map(|step| step[0].1.distance(step[1].1));
        let (low, high) = vector::bounds(samples.iter().map(|(_, point)| point));
        Self {
            low,
            high,
            margin: 0.5 * steps.fold(0.0, f64::max),
        }
    }

    /// What some boxes lie in.
    fn around(boxes: &[Self]) -> Self {
        let corners = boxes.iter().flat_map(|it| [it.low, it.high]);
        let (low, high) = vector::bounds(corners);
        let margin = boxes.iter().fold(0.0, |most: f64, it| most.max(it.margin));
        Self { low, high, margin }
    }

    /// How far a point is from the curve within it, at least.
    fn distance(&self, point: DVec3) -> f64 {
        point.distance(point.clamp(self.low, self.high)) - self.margin
    }
}
