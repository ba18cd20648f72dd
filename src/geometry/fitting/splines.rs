//! Planar uniform B-splines of one degree and number of vertices.

use glam::DVec2;

use crate::geometry::basis::derivative_bases;
use crate::geometry::error::MAX_DEGREE;

/// The largest step of a projection, in segments.
const LARGEST_STEP: f64 = 0.3;

/// The least share of |C′|² that a Newton step divides by.
const LEAST_DENOMINATOR: f64 = 0.3;

/// The values of the n + 1 basis functions of a segment.
pub(super) type Basis = [f64; MAX_DEGREE + 1];

/// Tell degree, number of vertices and whether the curves are periodic.
///
/// Parameters run from 0 to the number of segments; segment s is made by the vertices s … s + n.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Splines {
    pub(super) degree: usize,
    pub(super) count: usize,
    pub(super) periodic: bool,
}

impl Splines {
    /// The number of segments, which is also the last parameter.
    pub(super) fn segments(&self) -> usize {
        match self.periodic {
            true => self.count,
            false => self.count - self.degree,
        }
    }

    /// The last parameter.
    pub(super) fn end(&self) -> f64 {
        self.segments() as f64
    }

    /// The segment of a parameter and the local parameter there.
    pub(super) fn locate(&self, u: f64) -> (usize, f64) {
        let segment = (u.max(0.0) as usize).min(self.segments() - 1);
        (segment, u - segment as f64)
    }

    /// The segment of a parameter and the basis functions there.
    pub(super) fn basis(&self, u: f64) -> (usize, Basis) {
        let (segment, t) = self.locate(u);
        let [basis] = derivative_bases(self.degree, t);
        (segment, basis)
    }

    /// Evaluate the point at a parameter.
    pub(super) fn point(&self, vertices: &[DVec2], u: f64) -> DVec2 {
        let (segment, basis) = self.basis(u);
        let weights = basis.iter().take(self.degree + 1).enumerate();
        weights
            .map(|(k, weight)| *weight * vertices[(segment + k) % self.count])
            .sum()
    }

    /// Evaluate the derivatives of orders 0 to `ORDERS` − 1 at a parameter.
    pub(super) fn jet<const ORDERS: usize>(&self, vertices: &[DVec2], u: f64) -> [DVec2; ORDERS] {
        let (segment, t) = self.locate(u);
        let bases: [Basis; ORDERS] = derivative_bases(self.degree, t);
        let mut differences = [DVec2::ZERO; MAX_DEGREE + 1];
        for (k, it) in differences.iter_mut().take(self.degree + 1).enumerate() {
            *it = vertices[(segment + k) % self.count];
        }
        let mut jet = [DVec2::ZERO; ORDERS];
        for (order, (derivative, basis)) in jet.iter_mut().zip(&bases).enumerate() {
            let Some(left) = (self.degree + 1).checked_sub(order) else {
                break;
            };
            let weighed = basis.iter().zip(&differences).take(left);
            *derivative = weighed.map(|(weight, it)| *weight * *it).sum();
            for k in 1..left {
                differences[k - 1] = differences[k] - differences[k - 1];
            }
        }
        jet
    }

    /// Refine the parameters of the nearest points by Newton steps. The first and the last point of an open curve
    /// stay at its ends, and the order is kept.
    pub(super) fn project(
        &self,
        vertices: &[DVec2],
        points: &[DVec2],
        places: &mut [f64],
        steps: usize,
    ) {
        let last = points.len().saturating_sub(1);
        let end = self.end();
        for (index, (point, place)) in points.iter().zip(places.iter_mut()).enumerate() {
            if !self.periodic && (index == 0 || index == last) {
                continue;
            }
            for _ in 0..steps {
                let [at, first, second] = self.jet(vertices, *place);
                let off = at - *point;
                let square = first.length_squared();
                let denominator = (square + off.dot(second)).max(LEAST_DENOMINATOR * square);
                let step = off.dot(first) / denominator.max(f64::MIN_POSITIVE);
                let moved = *place - step.clamp(-LARGEST_STEP, LARGEST_STEP);
                *place = match self.periodic {
                    true => moved.rem_euclid(end),
                    false => moved.clamp(0.0, end),
                };
            }
        }
        if !self.periodic {
            for index in 1..places.len() {
                places[index] = places[index].max(places[index - 1]);
            }
        }
    }
}
