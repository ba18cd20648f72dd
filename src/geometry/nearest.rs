//! The point of a curve nearest to a given point.

use glam::DVec3;

use super::float_polygon::FloatPolygon;
use super::jet::Jet;
use super::sampler::{Batch, Sampler};
use super::vector;

/// Samples a segment from which the search for the nearest point starts.
const STARTS: usize = 16;

/// Newton steps a start: far more than quadratic convergence needs.
const STEPS: usize = 24;

/// The point of a curve nearest to another point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Its parameter, in \[0, L\].
    pub u: f64,
    /// The point C(u).
    pub point: DVec3,
    /// Its distance from the given point.
    pub distance: f64,
}

impl FloatPolygon {
    /// Find the point of the curve nearest to `target`.
    ///
    /// Segments whose polygon's box is farther away than the best point so far are passed over;
    /// the others are sampled, and the best sample is refined by Newton's method on
    /// (C − target) · C′ = 0, kept within its two neighbours. Where two points are equally near
    /// either may be found.
    pub fn nearest(&self, target: DVec3) -> Nearest {
        let sampler = Sampler::even(self.degree(), STARTS);
        let mut batch = Batch::default();
        let mut order: Vec<(f64, usize)> = (0..self.segments())
            .map(|segment| (self.box_distance(segment, target), segment))
            .collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut best = self.candidate(0, 0.0, target);
        for (distance, segment) in order {
            if distance >= best.distance {
                break;
            }
            sampler.segment(self, segment, 0, &mut batch);
            let samples: Vec<f64> = (0..batch.len())
                .map(|index| batch.jet(index).point.distance(target))
                .collect();
            for index in local_minima(&samples) {
                let found = self.refine(segment, index as f64 / STARTS as f64, target);
                if found.distance < best.distance {
                    best = found;
                }
            }
        }
        best
    }

    /// Find where the curve passes `target` at most `reach` away: the points whose distance is a minimum.
    ///
    /// Minima are found among 16 samples a segment, and refined as [`FloatPolygon::nearest`] does.
    pub fn passes(&self, target: DVec3, reach: f64) -> Vec<Nearest> {
        let sampler = Sampler::even(self.degree(), STARTS);
        let mut batch = Batch::default();
        let mut passes: Vec<Nearest> = Vec::new();
        for segment in 0..self.segments() {
            if self.box_distance(segment, target) > reach {
                continue;
            }
            sampler.segment(self, segment, 0, &mut batch);
            let samples: Vec<f64> = (0..batch.len())
                .map(|index| batch.jet(index).point.distance(target))
                .collect();
            let found = local_minima(&samples);
            let found =
                found.map(|index| self.refine(segment, index as f64 / STARTS as f64, target));
            for pass in found.filter(|it| it.distance <= reach) {
                // At a knot both segments have it.
                let is_known = |it: &Nearest| (it.u - pass.u).abs() < 1.0 / STARTS as f64;
                match passes.last_mut().filter(|it| is_known(it)) {
                    Some(last) if pass.distance < last.distance => *last = pass,
                    Some(_) => {}
                    None => passes.push(pass),
                }
            }
        }
        passes
    }

    /// Find the parameter of the point nearest to `target` within half a segment of a parameter, by Newton's method.
    ///
    /// A minimum nearby is found if there is one; an open curve ends at its ends, a periodic one has no seam.
    pub fn parameter_near(&self, target: DVec3, u: f64) -> f64 {
        let end = self.segments() as f64;
        if self.is_periodic() {
            let bracket = [u - 0.5, u + 0.5];
            let found = refined_parameter(target, u, bracket, |u| self.jet(u));
            return found.rem_euclid(end);
        }
        let u = u.clamp(0.0, end);
        let bracket = [(u - 0.5).max(0.0), (u + 0.5).min(end)];
        refined_parameter(target, u, bracket, |u| self.jet(u))
    }

    fn box_distance(&self, segment: usize, target: DVec3) -> f64 {
        let vertices = segment..=segment + self.degree();
        let (low, high) = vector::bounds(vertices.map(|index| self.vertex(index)));
        target.distance(target.clamp(low, high))
    }

    fn refine(&self, segment: usize, start: f64, target: DVec3) -> Nearest {
        let step = 1.0 / STARTS as f64;
        let bracket = [(start - step).max(0.0), (start + step).min(1.0)];
        let jet = |t| self.segment_jet(segment, t);
        let t = refined_parameter(target, start, bracket, jet);
        let refined = self.candidate(segment, t, target);
        let unrefined = self.candidate(segment, start, target);
        if refined.distance <= unrefined.distance {
            refined
        } else {
            unrefined
        }
    }

    fn candidate(&self, segment: usize, t: f64, target: DVec3) -> Nearest {
        let point = self.segment_point(segment, t);
        Nearest {
            u: segment as f64 + t,
            point,
            distance: point.distance(target),
        }
    }
}

/// Refine the parameter of the point of a curve nearest to `target` by Newton's method on
/// (C − target) · C′ = 0, kept within a bracket.
pub(super) fn refined_parameter(
    target: DVec3,
    start: f64,
    [low, high]: [f64; 2],
    jet: impl Fn(f64) -> Jet,
) -> f64 {
    let precision = f64::EPSILON * low.abs().max(high.abs());
    let mut t = start;
    for _ in 0..STEPS {
        let jet = jet(t);
        let away = jet.point - target;
        let slope = jet.first.length_squared() + away.dot(jet.second);
        let next = if slope > 0.0 {
            t - away.dot(jet.first) / slope
        } else {
            // Here the distance is not convex: walk downhill by an eighth of the bracket.
            t - 0.125 * (high - low) * away.dot(jet.first).signum()
        };
        let next = next.clamp(low, high);
        if !((next - t).abs() > precision) {
            break;
        }
        t = next;
    }
    t
}

fn local_minima(samples: &[f64]) -> impl Iterator<Item = usize> + '_ {
    (0..samples.len()).filter(|&index| {
        let before = index.checked_sub(1).map_or(f64::INFINITY, |i| samples[i]);
        let after = samples.get(index + 1).copied().unwrap_or(f64::INFINITY);
        samples[index] <= before && samples[index] <= after
    })
}
