//! Curves by their parameters, and parts of them.

use std::cmp::Ordering;

use glam::{DVec3, DVec4};

use super::super::splines::checked;
use crate::io::exchange::drawing::Nurbs;

/// The highest degree of which parts are cut out, at a cost of its square; programs go up to about 25.
const DEGREE_LIMIT: usize = 100;

/// A curve as the file describes it.
pub(super) struct Curve {
    pub(super) is_bezier: bool,
    pub(super) degree: usize,
    pub(super) points: Vec<DVec3>,
    pub(super) weights: Option<Vec<f64>>,
    /// The knots of a B-spline, or the parameters where Bézier curves meet.
    pub(super) parameters: Vec<f64>,
    /// The first and the last parameter.
    pub(super) range: (f64, f64),
}

impl Curve {
    /// Tell whether the range goes beyond the knots between which the curve is defined.
    pub(super) fn is_beyond(&self) -> bool {
        let first = self.parameters.get(self.degree);
        let last = self.parameters.get(self.points.len());
        !self.is_bezier
            && (first.is_some_and(|it| self.range.0 < *it)
                || last.is_some_and(|it| self.range.1 > *it))
    }

    /// Make the spline over the range of the curve, as far as it is defined.
    pub(super) fn spline(self) -> Result<Nurbs, String> {
        let knots = if self.is_bezier {
            bezier_knots(self.degree, self.points.len(), &self.parameters)?
        } else {
            self.parameters
        };
        let nurbs = checked(Nurbs {
            degree: self.degree,
            knots,
            points: self.points,
            weights: self.weights,
            periodic: false,
        })?;
        part(nurbs, self.range)
    }
}

fn bezier_knots(degree: usize, count: usize, parameters: &[f64]) -> Result<Vec<f64>, String> {
    if degree == 0 || count <= degree || !(count - 1).is_multiple_of(degree) {
        return Err(format!(
            "{count} points are no Bézier curves of degree {degree}"
        ));
    }
    let segments = (count - 1) / degree;
    if !parameters.is_empty() && parameters.len() != segments + 1 {
        return Err(format!(
            "it has {} parameters in place of {}",
            parameters.len(),
            segments + 1
        ));
    }
    // The ends are as multiple as the degree and once more.
    let last = segments * degree + degree;
    let knots = std::iter::once(0)
        .chain(0..last)
        .chain(std::iter::once(last - 1))
        .map(|it| it / degree);
    let mut all = Vec::with_capacity(last + 2);
    all.extend(knots.map(|it| parameters.get(it).copied().unwrap_or(it as f64)));
    Ok(all)
}

/// Cut a curve to a range, if it is not all of it, by inserting the ends as full knots.
fn part(nurbs: Nurbs, (from, to): (f64, f64)) -> Result<Nurbs, String> {
    let degree = nurbs.degree;
    let ends = (nurbs.knots.get(degree), nurbs.knots.get(nurbs.points.len()));
    let (Some(&first), Some(&last)) = ends else {
        return Ok(nurbs);
    };
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * (last - first);
    if (from <= first || near(from, first)) && (to >= last || near(to, last)) {
        return Ok(nurbs);
    }
    // Blender writes 0 and 1 for all curves, whatever their knots are.
    let (from, to) = (from.max(first), to.min(last));
    if !matches!(from.partial_cmp(&to), Some(Ordering::Less)) {
        return Err(format!("its range {from} to {to} is empty"));
    }
    if degree > DEGREE_LIMIT {
        return Err(format!(
            "it is a part of a curve of degree {degree}, which is too high"
        ));
    }
    let mut whole = Homogeneous::of(nurbs);
    whole.saturate(from);
    whole.saturate(to);
    whole.cut(from, to);
    checked(whole.spline())
}

/// A curve of points multiplied by their weights, which are moved rather than copied: there may be millions.
struct Homogeneous {
    degree: usize,
    knots: Vec<f64>,
    points: Vec<DVec3>,
    weights: Vec<f64>,
}

impl Homogeneous {
    fn of(nurbs: Nurbs) -> Self {
        let mut points = nurbs.points;
        let weights = nurbs.weights.unwrap_or_else(|| vec![1.0; points.len()]);
        for (point, weight) in points.iter_mut().zip(&weights) {
            *point *= *weight;
        }
        Self {
            degree: nurbs.degree,
            knots: nurbs.knots,
            points,
            weights,
        }
    }

    fn spline(mut self) -> Nurbs {
        for (point, weight) in self.points.iter_mut().zip(&self.weights) {
            *point /= *weight;
        }
        Nurbs {
            degree: self.degree,
            knots: self.knots,
            points: self.points,
            weights: Some(self.weights),
            periodic: false,
        }
    }

    /// Insert a knot until it is as multiple as the degree.
    fn saturate(&mut self, knot: f64) {
        let present = self.knots.iter().filter(|&&it| it == knot).count();
        for _ in present..self.degree {
            self.insert(knot);
        }
    }

    /// Insert a knot within the curve, by Boehm's rule.
    fn insert(&mut self, knot: f64) {
        let span = self.knots.partition_point(|&it| it <= knot);
        let moved = span.saturating_sub(self.degree)..span;
        let mut new = Vec::with_capacity(self.degree);
        for index in moved.clone() {
            let range = (self.knots.get(index), self.knots.get(index + self.degree));
            // Behind the last point, the share of the point that is missing is 0.
            let before = index.checked_sub(1).and_then(|it| self.corner(it));
            let corners = (before, self.corner(index).or(before));
            if let ((Some(low), Some(high)), (Some(before), Some(after))) = (range, corners) {
                let share = ((knot - low) / (high - low)).clamp(0.0, 1.0);
                new.push(before.lerp(after, share));
            }
        }
        let count = self.points.len();
        let replaced = moved.start.min(count)..span.saturating_sub(1).min(count);
        self.points
            .splice(replaced.clone(), new.iter().map(|it| it.truncate()));
        self.weights.splice(replaced, new.iter().map(|it| it.w));
        self.knots.insert(span, knot);
    }

    fn corner(&self, index: usize) -> Option<DVec4> {
        Some(self.points.get(index)?.extend(*self.weights.get(index)?))
    }

    /// Keep what is between two knots that are as multiple as the degree.
    fn cut(&mut self, from: f64, to: f64) {
        let start = self.knots.partition_point(|&it| it <= from);
        let start = start.saturating_sub(self.degree + 1);
        let end = self.knots.partition_point(|&it| it < to);
        self.points.truncate(end);
        self.weights.truncate(end);
        self.points.drain(..start.min(self.points.len()));
        self.weights.drain(..start.min(self.weights.len()));
        self.knots.retain(|&it| from < it && it < to);
        self.knots.splice(0..0, vec![from; self.degree + 1]);
        self.knots.extend(vec![to; self.degree + 1]);
    }
}
