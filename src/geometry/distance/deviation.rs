//! Distance of a curve from the one that it approximates.

use super::bound::{Bound, Wanted};
use super::error::DistanceError;
use super::places;
use super::target::Target;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::float_polygon::FloatPolygon;
use crate::geometry::progress::Progress;
use crate::geometry::root::maximum;

/// Samples a segment at which distances are measured.
const SAMPLES: usize = 16;

/// The least samples of the curve that distances are measured to.
const LEAST_SAMPLES: usize = 256;

/// Maxima between samples are looked for about samples that reach this share of the largest.
const NEARLY_LARGEST: f64 = 0.95;

/// Steps of the golden section: they leave 1e-3 of two samples' distance, and of a smooth maximum's height
/// an error of the square of that.
const SECTIONS: usize = 15;

/// Distance of one curve from another: true distances, from points of the one to the nearest points
/// of the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredDeviation {
    /// The largest distance: a bound that is at most 1 % above it but for rounding, or to 1e-3 of itself what samples
    /// show, 16 a segment, refined.
    pub largest: f64,
    /// Whether that is a bound: nothing between samples is missed.
    pub bounded: bool,
    /// The largest distance that was found.
    pub(in crate::geometry) found: f64,
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
    /// [`DistanceError::NoPoint`] where the other curve has no points;
    /// [`DistanceError::Cancelled`] soon after a cancellation.
    pub fn measure(
        polygon: &FloatPolygon,
        curve: &dyn Differentiable,
        parameter: &dyn Fn(f64) -> f64,
        reach: [f64; 2],
        progress: &Progress,
    ) -> Result<Self, DistanceError> {
        Sides::new(polygon, curve, parameter, reach)?.one_way(progress)
    }

    /// Measure how far a curve and the part of another one that it runs along are from each other, both ways, within
    /// their ends: by a bound where the other curve is enclosed, otherwise by samples.
    ///
    /// # Errors
    /// As [`MeasuredDeviation::measure`].
    pub(in crate::geometry) fn both_ways(
        polygon: &FloatPolygon,
        curve: &dyn Differentiable,
        parameter: &dyn Fn(f64) -> f64,
        progress: &Progress,
    ) -> Result<Self, DistanceError> {
        let interval = [0, polygon.segments()].map(|u| parameter(u as f64));
        let sides = Sides::new(polygon, curve, parameter, interval)?;
        let sampled = sides.both_ways(progress)?;
        let wanted = Wanted::Tight {
            found: sampled.largest,
            there: &|u| sides.off_there(u).1,
            here: &|t| sides.off_here(t).1,
        };
        let Some(bound) = Bound::of(polygon, curve, parameter, wanted) else {
            return Ok(sampled);
        };
        let found = sampled.largest.max(bound.at_least);
        let [u, t] = match found > sampled.largest {
            true => bound.place,
            false => [sampled.u, sampled.t],
        };
        let bounded = bound.is_close(found);
        Ok(Self {
            largest: if bounded { bound.at_most } else { found },
            bounded,
            found,
            u,
            t,
            mean: sampled.mean,
        })
    }

    /// Measure how far the curves of two polygons are from each other that run beside each other at equal shares of
    /// their parameters.
    ///
    /// # Errors
    /// [`DistanceError::Cancelled`].
    pub fn between(
        polygon: &FloatPolygon,
        other: &FloatPolygon,
        progress: &Progress,
    ) -> Result<Self, DistanceError> {
        let rate = other.segments() as f64 / polygon.segments() as f64;
        Self::both_ways(polygon, other, &|u| u * rate, progress)
    }

    /// Tell whether two curves are as near as a tolerance, both ways: if not, by a distance that is reached, and that
    /// need not be the largest.
    ///
    /// # Errors
    /// As [`MeasuredDeviation::measure`].
    pub(in crate::geometry) fn within(
        tolerance: f64,
        polygon: &FloatPolygon,
        curve: &dyn Differentiable,
        parameter: &dyn Fn(f64) -> f64,
        progress: &Progress,
    ) -> Result<Self, DistanceError> {
        let wanted = Wanted::Within { tolerance };
        let bound = Bound::of(polygon, curve, parameter, wanted);
        let decided = bound.filter(|it| it.at_least > tolerance || it.at_most <= tolerance);
        let Some(bound) = decided else {
            let interval = [0, polygon.segments()].map(|u| parameter(u as f64));
            return Sides::new(polygon, curve, parameter, interval)?.both_ways(progress);
        };
        let bounded = bound.at_most <= tolerance;
        let [u, t] = bound.place;
        Ok(Self {
            largest: if bounded {
                bound.at_most
            } else {
                bound.at_least
            },
            bounded,
            found: bound.at_least,
            u,
            t,
            mean: bound.mean,
        })
    }
}

/// Two curves beside each other, sampled so that distances can be measured both ways.
struct Sides<'a> {
    polygon: &'a FloatPolygon,
    curve: &'a dyn Differentiable,
    parameter: &'a dyn Fn(f64) -> f64,
    /// Parameters u, and those t of the other curve that are near.
    places: Vec<[f64; 2]>,
    here: Target<'a>,
    there: Target<'a>,
}

impl<'a> Sides<'a> {
    /// Sample a polygon's curve, and the one that it runs beside, beyond its end as far as `reach`.
    fn new(
        polygon: &'a FloatPolygon,
        curve: &'a dyn Differentiable,
        parameter: &'a dyn Fn(f64) -> f64,
        reach: [f64; 2],
    ) -> Result<Self, DistanceError> {
        let segments = polygon.segments();
        let place = |index: usize| {
            let u = index as f64 / SAMPLES as f64;
            [u, parameter(u)]
        };
        let places: Vec<[f64; 2]> = (0..=segments * SAMPLES).map(place).collect();
        let count = (segments * SAMPLES).max(LEAST_SAMPLES);
        let share = segments as f64 / count as f64;
        let [from, to] = [0, segments].map(|u| parameter(u as f64));
        // Where the other curve changes at once, even samples do not show where it is.
        let mut parameters: Vec<f64> = places::places(curve, [from, to]);
        parameters.extend((0..=count).map(|index| parameter(index as f64 * share)));
        parameters.sort_by(f64::total_cmp);
        parameters.dedup();
        let step = (to - from) / count as f64;
        let beyond = |end: f64, step: f64, most: f64| {
            let steps = ((most - end) / step).floor().clamp(0.0, count as f64) as usize;
            let beyond = (1..=steps).map(|index| end + step * index as f64);
            beyond.collect::<Vec<f64>>()
        };
        let beyond = [beyond(from, -step, reach[0]), beyond(to, step, reach[1])];
        let own = places.iter().map(|[u, _]| *u);
        Ok(Self {
            here: Target::new(polygon, own, [vec![], vec![]])?,
            there: Target::new(curve, parameters.into_iter(), beyond)?,
            polygon,
            curve,
            parameter,
            places,
        })
    }

    /// The distance of the polygon's curve at u from the other one, and the parameter t there.
    fn off_there(&self, u: f64) -> (f64, f64) {
        self.there
            .nearest(self.polygon.point(u), (self.parameter)(u))
    }

    /// The distance of the other curve at t from the polygon's, and the parameter u there.
    fn off_here(&self, t: f64) -> (f64, f64) {
        let after = self.places.partition_point(|[_, place]| *place < t);
        let near = self.places.get(after).or(self.places.last());
        let point = self.curve.derivatives(t, 0)[0];
        self.here.nearest(point, near.map_or(0.0, |[u, _]| *u))
    }

    /// Measure how far the polygon's curve is from the other one.
    fn one_way(&self, progress: &Progress) -> Result<MeasuredDeviation, DistanceError> {
        let places: Vec<f64> = self.places.iter().map(|[u, _]| *u).collect();
        let distance = |u: f64| self.off_there(u).0;
        let samples = Samples::new(&places, &distance, progress)?;
        let (u, largest) = samples.largest(0.0, progress)?;
        Ok(MeasuredDeviation {
            largest,
            bounded: false,
            found: largest,
            u,
            t: self.off_there(u).1,
            mean: mean(self.polygon, &samples.distances),
        })
    }

    /// Measure how far each curve is from the other one at most.
    fn both_ways(&self, progress: &Progress) -> Result<MeasuredDeviation, DistanceError> {
        let here = self.one_way(progress)?;
        let places: Vec<f64> = self.places.iter().map(|[_, t]| *t).collect();
        let distance = |t: f64| self.off_here(t).0;
        let samples = Samples::new(&places, &distance, progress)?;
        let (t, largest) = samples.largest(here.largest, progress)?;
        Ok(match largest > here.largest {
            true => MeasuredDeviation {
                largest,
                found: largest,
                u: self.off_here(t).1,
                t,
                ..here
            },
            false => here,
        })
    }
}

/// Distances at some places.
struct Samples<'a> {
    places: &'a [f64],
    distance: &'a dyn Fn(f64) -> f64,
    distances: Vec<f64>,
}

impl<'a> Samples<'a> {
    fn new(
        places: &'a [f64],
        distance: &'a dyn Fn(f64) -> f64,
        progress: &Progress,
    ) -> Result<Self, DistanceError> {
        let going_on = |place: &f64| (!progress.is_cancelled()).then_some(*place);
        let distances = places.iter().map(|place| Some(distance(going_on(place)?)));
        let distances: Option<Vec<f64>> = distances.collect();
        Ok(Self {
            places,
            distance,
            distances: distances.ok_or(DistanceError::Cancelled)?,
        })
    }

    /// Find the largest distance, and where it is, between the samples too if it may be above a `known` one.
    fn largest(&self, known: f64, progress: &Progress) -> Result<(f64, f64), DistanceError> {
        let larger = |known: (f64, f64), other: (f64, f64)| {
            if other.1 > known.1 { other } else { known }
        };
        let pairs = self
            .places
            .iter()
            .copied()
            .zip(self.distances.iter().copied());
        let sampled = pairs.fold((0.0, -1.0), larger);
        let enough = NEARLY_LARGEST * sampled.1.max(known);
        let last = self.places.len() - 1;
        let mut found = sampled;
        for (index, here) in self.distances.iter().enumerate() {
            if progress.is_cancelled() {
                return Err(DistanceError::Cancelled);
            }
            let beside = [index.saturating_sub(1), (index + 1).min(last)];
            let [before, after] = beside.map(|beside| self.distances[beside]);
            // Of equal samples the first one counts.
            let is_highest = (*here > before || index == 0) && *here >= after;
            if *here >= enough && is_highest {
                let bracket = beside.map(|index| self.places[index]);
                found = larger(found, maximum(bracket, SECTIONS, self.distance));
            }
        }
        Ok(found)
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
