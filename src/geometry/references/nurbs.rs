//! A B-spline curve on any knots, as other programs give it.
//!
//! It is evaluated by de Boor's recurrence on its own knots, for power series of numbers and of bounds alike.

use std::f64::consts::FRAC_PI_4;
use std::ops::{Add, Mul};
use std::sync::Arc;

use glam::DVec3;
use thiserror::Error;

use crate::geometry::coefficient::Coefficient;
use crate::geometry::control_polygon::MAX_MAGNITUDE;
use crate::geometry::error::MAX_DEGREE;
use crate::geometry::interval::Interval;
use crate::geometry::power_series::PowerSeries;
use crate::geometry::root::root;
use crate::geometry::vector::{self, widen};

/// A piece may turn by about so much.
const PIECE_TURNING: f64 = FRAC_PI_4;

/// Samples by which the turning of a span is estimated.
const SAMPLES: usize = 16;

/// The most pieces of a span between two knots.
const MOST_PIECES: f64 = 16.0;

/// Knots this near, in units of the interval, are one: files repeat them within rounding.
const SAME_KNOT: f64 = 1e-12;

/// Hold a checked B-spline curve: degree, knots, control points and weights.
#[derive(Clone, Debug, PartialEq)]
pub struct Nurbs {
    degree: usize,
    knots: Arc<[f64]>,
    points: Arc<[DVec3]>,
    weights: Option<Arc<[f64]>>,
    periodic: bool,
}

/// Why numbers are no B-spline curve.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum NurbsError {
    /// The degree is out of range.
    #[error("a B-spline of degree {0}: degrees from 1 to {MAX_DEGREE} are read")]
    Degree(usize),
    /// There are too few points.
    #[error("{found} control points: degree {degree} needs {} or more", degree + 1)]
    Points {
        /// Their number.
        found: usize,
        /// The degree.
        degree: usize,
    },
    /// The number of knots does not fit.
    #[error("{found} knots: {needed} belong to these control points")]
    Knots {
        /// Their number.
        found: usize,
        /// The number of points, the degree and 1.
        needed: usize,
    },
    /// A knot is not finite, or lies before the one before it.
    #[error("knot {0} is out of order or no number")]
    Knot(usize),
    /// The curve would jump at a knot.
    #[error("knot {0} is repeated so often that the curve breaks there")]
    Break(usize),
    /// The knots leave no interval.
    #[error("all knots of the curve are equal")]
    NoInterval,
    /// A point is too large or no number.
    #[error("control point {0} is too large or no number")]
    Point(usize),
    /// A weight is not positive, or there is not one for each point.
    #[error("weight {0} is missing or not positive")]
    Weight(usize),
}

impl Nurbs {
    /// Check a curve over `knots[degree] ..= knots[points]`. Points are not multiplied by their weights; weights that
    /// are all alike are left out. `periodic` is what its file calls it, and changes nothing.
    ///
    /// # Errors
    /// [`NurbsError`].
    pub fn new(
        degree: usize,
        knots: impl Into<Arc<[f64]>>,
        points: impl Into<Arc<[DVec3]>>,
        weights: Option<Vec<f64>>,
        periodic: bool,
    ) -> Result<Self, NurbsError> {
        let (knots, points) = (knots.into(), points.into());
        check(degree, &knots, &points, weights.as_deref())?;
        let differ = |weights: &Vec<f64>| weights.iter().any(|it| Some(it) != weights.first());
        Ok(Self {
            degree,
            knots,
            points,
            weights: weights.filter(differ).map(Arc::from),
            periodic,
        })
    }

    /// Make the curve larger about the origin.
    ///
    /// # Errors
    /// [`NurbsError::Point`] if a point leaves its range.
    pub(super) fn scaled(&self, factor: f64) -> Result<Self, NurbsError> {
        let points: Arc<[DVec3]> = self.points.iter().map(|point| factor * *point).collect();
        check(self.degree, &self.knots, &points, self.weights.as_deref())?;
        Ok(Self {
            points,
            ..self.clone()
        })
    }

    /// The degree.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The knots, points + degree + 1 of them.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The control points.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The weights of the control points, if they differ.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// Whether its file calls it periodic.
    pub fn is_periodic(&self) -> bool {
        self.periodic
    }

    /// Whether it lies in the plane z = 0.
    pub fn is_planar(&self) -> bool {
        self.points.iter().all(|point| point.z == 0.0)
    }

    /// The interval of its parameter.
    pub fn interval(&self) -> [f64; 2] {
        interval(self.degree, &self.knots)
    }

    /// The same curve with all knots as multiple as the degree: a chain of Bézier segments. `None` for rational curves.
    ///
    /// Point j of a segment over [a, b] is the blossom at n − j times a and j times b (Ramshaw).
    pub fn bezier_chain(&self) -> Option<Self> {
        if self.weights.is_some() {
            return None;
        }
        let n = self.degree;
        let (mut knots, mut points) = (Vec::new(), Vec::new());
        for knot in self.spans() {
            let [from, to] = [self.knots[knot], self.knots[knot + 1]];
            let begin = if points.is_empty() { 0 } else { 1 };
            knots.extend(vec![from; if begin == 0 { n + 1 } else { n }]);
            points.extend(
                (begin..=n).map(|j| self.blossom(knot, |round| if round <= j { to } else { from })),
            );
        }
        knots.extend(vec![self.interval()[1]; n + 1]);
        Self::new(n, knots, points, None, false).ok()
    }

    /// The blossom of the polynomial between a knot and the next at the parameters `at(1)` to `at(n)`.
    fn blossom(&self, knot: usize, at: impl Fn(usize) -> f64) -> DVec3 {
        let n = self.degree;
        let mut values = self.points[knot - n..=knot].to_vec();
        for round in 1..=n {
            let t = at(round);
            for index in (round..=n).rev() {
                let low = self.knots[knot + index - n];
                let high = self.knots[knot + index + 1 - round];
                let share = (t - low) / (high - low);
                values[index] = values[index - 1] * (1.0 - share) + values[index] * share;
            }
        }
        values[n]
    }

    /// Widen a box by the curve: by its points at so many even steps between each two knots, and by those where a
    /// coordinate turns. Between two steps a coordinate that turns back and forth again is passed over.
    pub fn widen(&self, bounds: &mut Option<[DVec3; 2]>, steps: usize) {
        for knot in self.spans() {
            let [from, to] = [self.knots[knot], self.knots[knot + 1]];
            let at = |step: usize| {
                let share = step as f64 / steps as f64;
                let t = from * (1.0 - share) + to * share;
                let values = self.expansion(knot, t, 1);
                (t, values[0], values[1])
            };
            let mut before = at(0);
            widen(bounds, before.1);
            for step in 1..=steps {
                let now = at(step);
                widen(bounds, now.1);
                for turn in self.turns(knot, [before, now], *bounds) {
                    widen(bounds, turn);
                }
                before = now;
            }
        }
    }

    /// The points between two places where a coordinate turns, if it may leave a box there. The places have their
    /// parameter, point and first derivative.
    fn turns(
        &self,
        knot: usize,
        [before, now]: [(f64, DVec3, DVec3); 2],
        bounds: Option<[DVec3; 2]>,
    ) -> impl Iterator<Item = DVec3> {
        let axes = (0..3).filter(move |axis| {
            let [a, b] = [before.2[*axis], now.2[*axis]];
            // Its tangent reaches farther than a coordinate that turns once.
            let farthest = before.1[*axis] + a * (now.0 - before.0);
            let is_within =
                bounds.is_some_and(|[low, high]| (low[*axis]..=high[*axis]).contains(&farthest));
            a * b < 0.0 && !is_within
        });
        axes.map(move |axis| {
            let slope = |t: f64| self.expansion(knot, t, 1)[1][axis];
            self.expansion(knot, root([before.0, now.0], 0.0, slope), 0)[0]
        })
    }

    /// How many derivatives are continuous at all its knots.
    pub fn continuity(&self) -> usize {
        let inner = inner_knots(self.degree, &self.knots);
        let least = inner.map(|(_, times)| self.degree.saturating_sub(times));
        least.min().unwrap_or(usize::MAX)
    }

    /// The knots within a part of the interval, its ends, and places between them where the curve turns much.
    pub(super) fn breaks(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        let mut breaks = vec![from];
        for knot in self.spans() {
            let [low, high] = [self.knots[knot].max(from), self.knots[knot + 1].min(to)];
            if low < high {
                let count = (self.turning(knot, [low, high]) / PIECE_TURNING).ceil();
                let count = count.clamp(1.0, MOST_PIECES) as usize;
                let shares = (1..count).map(|index| index as f64 / count as f64);
                breaks.extend(shares.map(|share| low * (1.0 - share) + high * share));
                breaks.push(high);
            }
        }
        breaks
    }

    /// The point at t and its derivatives by t, by the polynomials that hold around `about`.
    pub(super) fn derivatives_beside(&self, about: f64, t: f64, order: usize) -> Vec<DVec3> {
        let mut values = self.expansion(self.span_at(about), t, order);
        let mut factorial = 1.0;
        for (order, value) in values.iter_mut().enumerate() {
            factorial *= order.max(1) as f64;
            *value *= factorial;
        }
        values
    }

    /// The coefficients of the series about t of the curve between a knot and the next.
    fn expansion(&self, knot: usize, t: f64, order: usize) -> Vec<DVec3> {
        let mut values = self.taylor(knot, t, order, |index| {
            let point = self.points[index];
            self.weights.as_ref().map_or(point, |it| it[index] * point)
        });
        if let Some(weights) = &self.weights {
            let below = self.taylor(knot, t, order, |index| weights[index]);
            divide(&mut values, &below);
        }
        values
    }

    /// The coefficients of the series about t of control values between a knot and the next: [`Nurbs::series`] for
    /// numbers, without an allocation at each step of the recurrence.
    fn taylor<V: Copy + Default + Add<Output = V> + Mul<f64, Output = V>>(
        &self,
        knot: usize,
        t: f64,
        order: usize,
        control: impl Fn(usize) -> V,
    ) -> Vec<V> {
        let (n, at) = (self.degree, |index: usize| self.knots[index]);
        let length = order + 1;
        let mut values = vec![V::default(); (n + 1) * length];
        for index in 0..=n {
            values[index * length] = control(knot - n + index);
        }
        for round in 1..=n {
            // So many derivatives are not 0 after it.
            let highest = order.min(round);
            for index in (round..=n).rev() {
                let low = at(knot + index - n);
                let high = at(knot + index + 1 - round);
                let scale = 1.0 / (high - low);
                let (up, down) = ((t - low) * scale, (high - t) * scale);
                let (before, rest) = values.split_at_mut(index * length);
                let (before, own) = (&before[(index - 1) * length..], &mut rest[..length]);
                for k in (1..=highest).rev() {
                    let falling = before[k] * down + before[k - 1] * -scale;
                    own[k] = falling + (own[k] * up + own[k - 1] * scale);
                }
                own[0] = before[0] * down + own[0] * up;
            }
        }
        values.split_off(n * length)
    }

    /// The point at t and its derivatives by t; at a knot the later part counts.
    pub(super) fn derivatives(&self, t: f64, order: usize) -> Vec<DVec3> {
        self.derivatives_beside(t, t, order)
    }

    /// Bound the coordinates for bounds of the series of t, where these lie between two knots.
    pub(super) fn enclosed(&self, t: &PowerSeries<Interval>) -> Option<[PowerSeries<Interval>; 3]> {
        let [low, high] = t.value().bounds();
        let knot = self.span_at(0.5 * (low + high));
        let room = 4.0 * f64::EPSILON * low.abs().max(high.abs());
        let fits = self.knots[knot] - room <= low && high <= self.knots[knot + 1] + room;
        fits.then(|| self.series(knot, t))
    }

    /// The knots that begin a part of some length.
    fn spans(&self) -> impl Iterator<Item = usize> {
        let all = self.degree..self.points.len();
        all.filter(|knot| self.knots[*knot] < self.knots[knot + 1])
    }

    /// The last knot at or before t that begins a part of some length; the first such knot for all t before it.
    fn span_at(&self, t: f64) -> usize {
        let [from, to] = self.interval();
        let last = self.points.len();
        let behind = match t < to {
            true => self.knots[..last].partition_point(|knot| *knot <= t.max(from)),
            false => self.knots[..last].partition_point(|knot| *knot < to),
        };
        behind.saturating_sub(1).max(self.degree)
    }

    /// De Boor's recurrence on the polynomials between a knot and the next.
    fn series<T: Coefficient>(&self, knot: usize, t: &PowerSeries<T>) -> [PowerSeries<T>; 3] {
        let first = knot - self.degree;
        let points = &self.points[first..=knot];
        let order = t.order();
        let constant = |value: f64| PowerSeries::constant(T::of(value), order);
        let axes = [0, 1, 2].map(|axis| -> Vec<PowerSeries<T>> {
            let weighted = points.iter().enumerate().map(|(index, point)| {
                let weight = self.weights.as_ref().map(|it| it[first + index]);
                let value = PowerSeries::constant(T::of(point[axis]), order);
                weight.map_or(value.clone(), |weight| value.times(T::of(weight)))
            });
            weighted.collect()
        });
        let Some(weights) = &self.weights else {
            return axes.map(|values| self.blended(knot, t, values));
        };
        let weights = weights[first..=knot].iter().map(|it| constant(*it));
        let below = self.blended(knot, t, weights.collect());
        axes.map(|values| &self.blended(knot, t, values) / &below)
    }

    fn blended<T: Coefficient>(
        &self,
        knot: usize,
        t: &PowerSeries<T>,
        mut values: Vec<PowerSeries<T>>,
    ) -> PowerSeries<T> {
        let (n, at) = (self.degree, |index: usize| T::of(self.knots[index]));
        for round in 1..=n {
            for index in (round..=n).rev() {
                let low = at(knot + index - n);
                let high = at(knot + index + 1 - round);
                let scale = T::of(1.0) / (high - low);
                let up = t.clone().plus(-low).times(scale);
                let down = (-t).plus(high).times(scale);
                values[index] = &(&down * &values[index - 1]) + &(&up * &values[index]);
            }
        }
        values
            .pop()
            .unwrap_or_else(|| PowerSeries::constant(T::UNKNOWN, t.order()))
    }

    /// The sum of the angles between directions at samples of a part between two knots.
    fn turning(&self, knot: usize, [from, to]: [f64; 2]) -> f64 {
        let directions = (0..=SAMPLES).filter_map(|sample| {
            let share = sample as f64 / SAMPLES as f64;
            let values = self.expansion(knot, from * (1.0 - share) + to * share, 1);
            values.get(1).copied().and_then(vector::direction)
        });
        let directions: Vec<DVec3> = directions.collect();
        let pairs = directions.windows(2);
        pairs.map(|pair| pair[0].angle_between(pair[1])).sum()
    }
}

/// Divide a series by another one, as [`PowerSeries`] does.
fn divide(series: &mut [DVec3], below: &[f64]) {
    let inverse = 1.0 / below[0];
    series[0] /= below[0];
    for k in 1..series.len() {
        let known = (1..=k).map(|j| below[j] * series[k - j]);
        series[k] = (series[k] - known.sum::<DVec3>()) * inverse;
    }
}

fn interval(degree: usize, knots: &[f64]) -> [f64; 2] {
    [knots[degree], knots[knots.len() - degree - 1]]
}

/// The first of each group of equal knots strictly within the interval, with the size of the group.
fn inner_knots(degree: usize, knots: &[f64]) -> impl Iterator<Item = (usize, usize)> {
    let [from, to] = interval(degree, knots);
    let same = SAME_KNOT * (to - from);
    let inner =
        (0..knots.len()).filter(move |it| from + same < knots[*it] && knots[*it] < to - same);
    let first = inner.filter(move |it| *it == 0 || knots[*it] - knots[it - 1] > same);
    first.map(move |it| {
        let group = knots[it..]
            .iter()
            .take_while(|knot| **knot - knots[it] <= same);
        (it, group.count())
    })
}

fn check(
    degree: usize,
    knots: &[f64],
    points: &[DVec3],
    weights: Option<&[f64]>,
) -> Result<(), NurbsError> {
    if !(1..=MAX_DEGREE).contains(&degree) {
        return Err(NurbsError::Degree(degree));
    }
    let found = points.len();
    if found < degree + 1 {
        return Err(NurbsError::Points { found, degree });
    }
    let (found, needed) = (knots.len(), points.len() + degree + 1);
    if found != needed {
        return Err(NurbsError::Knots { found, needed });
    }
    let is_good = |value: f64| value.abs() <= MAX_MAGNITUDE;
    if let Some(index) = knots.iter().position(|knot| !is_good(*knot)) {
        return Err(NurbsError::Knot(index));
    }
    if let Some(index) = knots.windows(2).position(|pair| pair[0] > pair[1]) {
        return Err(NurbsError::Knot(index + 1));
    }
    let [from, to] = interval(degree, knots);
    if !(from < to) {
        return Err(NurbsError::NoInterval);
    }
    if let Some((index, _)) = inner_knots(degree, knots).find(|(_, times)| *times > degree) {
        return Err(NurbsError::Break(index));
    }
    let is_bad = |point: &DVec3| point.is_nan() || !is_good(point.abs().max_element());
    if let Some(index) = points.iter().position(is_bad) {
        return Err(NurbsError::Point(index));
    }
    let Some(weights) = weights else {
        return Ok(());
    };
    let is_weight = |weight: &f64| *weight > 0.0 && is_good(*weight);
    let bad = weights.iter().position(|weight| !is_weight(weight));
    let short = (weights.len() != points.len()).then_some(weights.len().min(points.len()));
    match bad.or(short) {
        Some(index) => Err(NurbsError::Weight(index)),
        None => Ok(()),
    }
}
