//! Deviation of a curve, or of points, from a curve: from one side.
//!
//! Two curves deviate from each other by both sides: the nearest points of a part of a curve lie on the whole, so that
//! only the whole tells what the part lacks.

use std::cell::Cell;

use glam::DVec3;

use super::error::DistanceError;
use super::target::Target;
use crate::geometry::differentiable::Differentiable;
use crate::geometry::parametric_curve::ParametricCurve;
use crate::geometry::progress::Progress;
use crate::geometry::quadrature::{quadrature, settled_quadrature};
use crate::geometry::root::maximum;
use crate::geometry::spacing::Spacing;

/// Samples a piece, of a curve with many pieces.
const SAMPLES: usize = 16;

/// The least samples of a curve.
const LEAST_SAMPLES: usize = 256;

/// How often an interval between samples is halved that may hold the largest distance: 1/256 of a segment is left.
const HALVINGS: usize = 4;

/// How much longer than by the speeds at its ends and its middle an interval may be.
const LENGTH_MARGIN: f64 = 1.1;

/// Steps of the golden section: they leave 1e-9 of an interval, so that a kink of the distance is found as closely as
/// a smooth maximum.
const SECTIONS: usize = 44;

/// Distances that differ by this share of the target's size are equal: rounding of nearest points.
const ROUNDING: f64 = 1e-13;

/// A curve is closed whose ends are nearer than this share of its size: readers leave such gaps.
const CLOSED: f64 = 1e-9;

/// A place is square to an end if the cosine is at most this.
const SQUARE: f64 = 1e-6;

/// The most equal samples that may hide a maximum between them: more are a plateau.
const LONGEST_RUN: usize = 3;

/// The relative error of the mean and of the mean square.
const MEAN_TOLERANCE: f64 = 1e-8;

/// Whiskers of a curve, evenly by its arc length.
const WHISKERS: usize = 101;

/// Deviation of a curve or of points from a curve: true distances, to the nearest points.
#[derive(Clone, Debug, PartialEq)]
pub struct SideDeviation {
    /// Where the distance is largest.
    pub largest: Whisker,
    /// The mean, over the arc length or over the points.
    pub mean: f64,
    /// The root of the mean square, over the same.
    pub rms: f64,
    /// What they are means over: the arc length, or the number of points.
    pub extent: f64,
    /// Distances at even steps of the arc length, or at all points.
    pub whiskers: Vec<Whisker>,
}

/// A distance at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whisker {
    /// The parameter u of the place, or the number of the point.
    pub at: f64,
    /// The parameter u of the nearest point of the other curve.
    pub nearest_at: f64,
    /// The place, and the nearest point.
    pub places: [DVec3; 2],
    /// On which side of the other curve the place is, in the plane z = 0.
    pub side: Option<CurveSide>,
    /// Whether the place lies past an end of the other curve, which is open: that is the nearest point, and not square
    /// to the curve.
    pub past_end: bool,
}

/// A side of a curve, seen along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveSide {
    /// To the left of an open curve.
    Left,
    /// To the right of an open curve.
    Right,
    /// Within a closed curve.
    Inside,
    /// Outside of a closed curve.
    Outside,
}

impl CurveSide {
    /// Every side.
    pub const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Inside, Self::Outside];

    /// Its name in one word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Inside => "inside",
            Self::Outside => "outside",
        }
    }
}

impl Whisker {
    /// How long it is.
    pub fn distance(&self) -> f64 {
        let [place, nearest] = self.places;
        place.distance(nearest)
    }
}

impl SideDeviation {
    /// Measure how far a curve is from another one, at all its points.
    ///
    /// The largest distance is searched for between samples too, wherever it can lie by the arc length between them;
    /// means are integrals that are halved until they settle.
    ///
    /// # Errors
    /// [`DistanceError::NoPoint`] where one of them has no point; [`DistanceError::Cancelled`] soon after a
    /// cancellation.
    pub fn of_curve(
        curve: &dyn ParametricCurve,
        other: &dyn ParametricCurve,
        progress: &Progress,
    ) -> Result<Self, DistanceError> {
        let (own, other) = (Pieces(curve), Pieces(other));
        // Its own points exist, too.
        own.target()?;
        let side = Side::new(&other, progress)?;
        let [length, sum, squares] = side.integrals(own)?;
        let largest = side.largest(own)?;
        let even = Spacing::ArcLength.parameters(curve, WHISKERS).into_iter();
        let whiskers = even.map(|at| side.whisker(at, own.point(at)));
        let share = |sum: f64| if length > 0.0 { sum / length } else { 0.0 };
        Ok(Self {
            largest: side.whisker(largest, own.point(largest)),
            mean: share(sum),
            rms: share(squares).sqrt(),
            extent: length,
            whiskers: whiskers.collect(),
        })
    }

    /// Measure the largest distance between two curves, of all points of either one from the other.
    ///
    /// # Errors
    /// As [`SideDeviation::of_curve`].
    pub fn both_ways(
        [one, other]: [&dyn ParametricCurve; 2],
        progress: &Progress,
    ) -> Result<f64, DistanceError> {
        let there = Self::of_curve(one, other, progress)?.largest.distance();
        let back = Self::of_curve(other, one, progress)?.largest.distance();
        Ok(there.max(back))
    }

    /// Measure how far points are from a curve; `None` without points.
    ///
    /// # Errors
    /// As [`SideDeviation::of_curve`].
    pub fn of_points(
        points: &[DVec3],
        other: &dyn ParametricCurve,
        progress: &Progress,
    ) -> Result<Option<Self>, DistanceError> {
        let other = Pieces(other);
        let side = Side::new(&other, progress)?;
        let mut whiskers = Vec::with_capacity(points.len());
        for (index, point) in points.iter().enumerate() {
            if progress.is_cancelled() {
                return Err(DistanceError::Cancelled);
            }
            whiskers.push(side.whisker(index as f64, *point));
        }
        Ok(Self::of_whiskers(whiskers))
    }

    /// Measure how far points are by a whisker of each; `None` without points.
    pub fn of_whiskers(whiskers: Vec<Whisker>) -> Option<Self> {
        let longer = |best: Whisker, it: Whisker| match it.distance() > best.distance() {
            true => it,
            false => best,
        };
        let largest = whiskers.iter().copied().reduce(longer)?;
        let extent = whiskers.len() as f64;
        let distances = || whiskers.iter().map(Whisker::distance);
        Some(Self {
            largest,
            mean: distances().sum::<f64>() / extent,
            rms: (distances().map(|it| it * it).sum::<f64>() / extent).sqrt(),
            extent,
            whiskers,
        })
    }
}

/// A curve in pieces, over one parameter u.
#[derive(Clone, Copy)]
struct Pieces<'a>(&'a dyn ParametricCurve);

impl Pieces<'_> {
    /// Its samples: even ones in each piece, the ends of pieces among them.
    fn parameters(&self) -> Vec<f64> {
        let pieces = self.0.pieces();
        let each = SAMPLES.max(LEAST_SAMPLES.div_ceil(pieces));
        let last = pieces * each;
        (0..=last).map(|it| it as f64 / each as f64).collect()
    }

    /// # Errors
    /// [`DistanceError::NoPoint`] at a sample without a point.
    fn target(&self) -> Result<Target<'_>, DistanceError> {
        Target::new(self, self.parameters().into_iter(), [vec![], vec![]])
    }

    fn point(&self, u: f64) -> DVec3 {
        self.0.jet(u).point
    }

    /// Twice its signed area by its samples, if it is closed.
    fn area(&self, target: &Target) -> Option<f64> {
        let samples = target.samples();
        let (_, first) = *samples.first()?;
        let gap = first.distance(samples.last()?.1);
        let is_closed = self.0.is_periodic() || gap <= CLOSED * target.size();
        let sides = samples.array_windows();
        is_closed.then(|| {
            sides
                .map(|[(_, from), (_, to)]| (*from - first).cross(*to - first).z)
                .sum()
        })
    }
}

impl Differentiable for Pieces<'_> {
    fn derivatives(&self, u: f64, order: usize) -> Vec<DVec3> {
        let (piece, t) = self.0.locate(u);
        let mut values = vec![DVec3::ZERO; order + 1];
        self.0.fill_derivatives(piece, t, &mut values);
        values
    }
}

/// A curve that distances are measured to.
struct Side<'a> {
    other: Pieces<'a>,
    target: Target<'a>,
    /// Twice the signed area of a closed curve.
    area: Option<f64>,
    /// The parameter of the last nearest point: the next one is near.
    near: Cell<f64>,
    progress: &'a Progress,
}

/// A sample: its parameter and its distance.
#[derive(Clone, Copy)]
struct Sample {
    at: f64,
    distance: f64,
}

impl<'a> Side<'a> {
    fn new(other: &'a Pieces<'a>, progress: &'a Progress) -> Result<Self, DistanceError> {
        let target = other.target()?;
        Ok(Self {
            other: *other,
            area: other.area(&target),
            target,
            near: Cell::new(0.0),
            progress,
        })
    }

    /// The distance of a point.
    fn distance(&self, point: DVec3) -> f64 {
        let (distance, nearest) = self.target.nearest(point, self.near.get());
        self.near.set(nearest);
        distance
    }

    fn whisker(&self, at: f64, point: DVec3) -> Whisker {
        self.distance(point);
        let nearest_at = self.near.get();
        let jet = self.other.0.jet(nearest_at);
        let turn = jet.first.cross(point - jet.point).z;
        let is_flat = self.other.0.is_planar() && point.z == 0.0 && turn != 0.0;
        Whisker {
            at,
            nearest_at,
            places: [point, jet.point],
            past_end: self.is_past_end(nearest_at, jet.first, point - jet.point),
            side: is_flat.then_some(match self.area {
                None if turn > 0.0 => CurveSide::Left,
                None => CurveSide::Right,
                Some(area) if turn * area > 0.0 => CurveSide::Inside,
                Some(_) => CurveSide::Outside,
            }),
        }
    }

    /// Whether a way from the nearest point leads past an end of the open target, and not square to its derivative.
    fn is_past_end(&self, nearest_at: f64, derivative: DVec3, way: DVec3) -> bool {
        let along = way.dot(derivative);
        let square = SQUARE * way.length() * derivative.length();
        let is_end = nearest_at == self.other.0.pieces() as f64;
        self.area.is_none() && (nearest_at == 0.0 && along < -square || is_end && along > square)
    }

    fn sample(&self, curve: Pieces, at: f64) -> Sample {
        // After a cancellation nothing counts.
        let distance = match self.progress.is_cancelled() {
            true => 0.0,
            false => self.distance(curve.point(at)),
        };
        Sample { at, distance }
    }

    /// The arc length of a curve, and the integrals of the distance and of its square over it.
    fn integrals(&self, curve: Pieces) -> Result<[f64; 3], DistanceError> {
        let mut sums = [0.0; 3];
        for piece in 0..curve.0.pieces() {
            let functions = |t: f64| {
                let jet = curve.0.piece_jet(piece, t);
                let (distance, speed) = (self.distance(jet.point), jet.first.length());
                [speed, distance * speed, distance * distance * speed]
            };
            if self.progress.is_cancelled() {
                return Err(DistanceError::Cancelled);
            }
            let whole = quadrature(0.0, 1.0, &functions);
            let rounding = self.target.size() * ROUNDING;
            let allowed = [
                MEAN_TOLERANCE * whole[0],
                MEAN_TOLERANCE * whole[1] + rounding * whole[0],
                MEAN_TOLERANCE * whole[2] + rounding * rounding * whole[0],
            ];
            let settled = settled_quadrature([0.0, 1.0], whole, allowed, &functions);
            for (sum, value) in sums.iter_mut().zip(settled.values) {
                *sum += value;
            }
        }
        Ok(sums)
    }

    /// Find where a curve is farthest.
    fn largest(&self, curve: Pieces) -> Result<f64, DistanceError> {
        let parameters = curve.parameters().into_iter();
        let mut samples: Vec<Sample> = parameters.map(|at| self.sample(curve, at)).collect();
        for _ in 0..HALVINGS {
            samples = self.halved(curve, &samples);
        }
        let found = self.refined(curve, &samples);
        if self.progress.is_cancelled() {
            return Err(DistanceError::Cancelled);
        }
        Ok(found.at)
    }

    /// Add the middles of the intervals that may hold a distance above all samples: along an arc the distance grows by
    /// its length at most.
    fn halved(&self, curve: Pieces, samples: &[Sample]) -> Vec<Sample> {
        let best = highest(samples).distance;
        let mut halved = Vec::with_capacity(2 * samples.len());
        for [from, to] in samples.array_windows() {
            halved.push(*from);
            let middle = 0.5 * (from.at + to.at);
            let speeds = [from.at, middle, to.at].map(|u| curve.0.jet(u).first.length());
            let length = LENGTH_MARGIN * speeds.into_iter().fold(0.0, f64::max) * (to.at - from.at);
            if 0.5 * (from.distance + to.distance + length) > best {
                halved.push(self.sample(curve, middle));
            }
        }
        halved.extend(samples.last());
        halved
    }

    /// Refine the highest samples between their neighbours.
    fn refined(&self, curve: Pieces, samples: &[Sample]) -> Sample {
        let noise = ROUNDING * self.target.size();
        let mut found = highest(samples);
        let mut first = 0;
        while first < samples.len() {
            // Samples as high as each other are one place.
            let height = samples[first].distance;
            let run = samples[first..].iter();
            let run = run.take_while(|it| (it.distance - height).abs() <= noise);
            let next = first + run.count().max(1);
            let before = first.checked_sub(1).map(|it| samples[it]);
            let after = samples.get(next).copied();
            let is_lower = |it: Option<Sample>| it.is_none_or(|it| it.distance < height);
            if is_lower(before) && is_lower(after) && next - first <= LONGEST_RUN {
                let low = before.unwrap_or(samples[first]).at;
                let high = after.unwrap_or(samples[next - 1]).at;
                let (at, distance) =
                    maximum([low, high], SECTIONS, |u| self.sample(curve, u).distance);
                if distance > found.distance {
                    found = Sample { at, distance };
                }
            }
            first = next;
        }
        found
    }
}

/// The first of the highest samples.
fn highest(samples: &[Sample]) -> Sample {
    let none = Sample {
        at: 0.0,
        distance: -1.0,
    };
    let higher = |best: Sample, it: &Sample| match it.distance > best.distance {
        true => *it,
        false => best,
    };
    samples.iter().fold(none, higher)
}
