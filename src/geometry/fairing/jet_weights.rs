//! Weights of the vertices in a point of the curve and its derivatives.

use glam::DVec3;

use crate::geometry::basis::uniform_basis_derivative;
use crate::geometry::float_polygon::FloatPolygon;

/// The number of derivatives, the point among them.
pub(super) const ORDERS: usize = 4;

/// Hold the weights of the vertices in a point and its first three derivatives by u: for a rational
/// curve those of the rational basis, so that all are linear in the vertices.
#[derive(Clone, Debug)]
pub(super) struct JetWeights {
    /// The vertices of the segment.
    vertices: Vec<usize>,
    /// For each of them its weight in every derivative.
    weights: Vec<[f64; ORDERS]>,
}

impl JetWeights {
    /// Compute the weights at a parameter u.
    pub(super) fn at(polygon: &FloatPolygon, u: f64) -> Self {
        let (segment, t) = polygon.locate(u);
        Self::of_segment(polygon, segment, t)
    }

    /// Compute the weights at a local parameter t of a segment, at its ends too.
    pub(super) fn of_segment(polygon: &FloatPolygon, segment: usize, t: f64) -> Self {
        let degree = polygon.degree();
        let count = polygon.vertices().len();
        let weight = |index: usize| polygon.weight(segment + index);
        let bases: [Vec<f64>; ORDERS] =
            std::array::from_fn(|order| uniform_basis_derivative(degree, order, t));
        // The weight function and its derivatives.
        let sums: [f64; ORDERS] = std::array::from_fn(|order| {
            let basis = bases[order].iter().enumerate();
            basis.map(|(index, value)| value * weight(index)).sum()
        });
        let weights = (0..=degree).map(|index| {
            let mut quotients = [0.0; ORDERS];
            for order in 0..ORDERS {
                let mut value = weight(index) * bases[order][index];
                let mut binomial = 1.0;
                for k in 1..=order {
                    binomial *= (order + 1 - k) as f64 / k as f64;
                    value -= binomial * sums[k] * quotients[order - k];
                }
                quotients[order] = value / sums[0];
            }
            quotients
        });
        Self {
            weights: weights.collect(),
            vertices: (0..=degree)
                .map(|index| (segment + index) % count)
                .collect(),
        }
    }

    /// Take the weights of a point that is some combination of the vertices, without derivatives.
    pub(super) fn of_point(weights: Vec<(usize, f64)>) -> Self {
        let (vertices, weights) = weights
            .into_iter()
            .map(|(vertex, weight)| (vertex, [weight, 0.0, 0.0, 0.0]))
            .unzip();
        Self { vertices, weights }
    }

    /// The weights of the vertices in the derivative of an order.
    pub(super) fn terms(&self, order: usize) -> impl Iterator<Item = (usize, f64)> {
        let weights = self.weights.iter().map(move |weights| weights[order]);
        self.vertices.iter().copied().zip(weights)
    }

    /// The weights in the point.
    pub(super) fn of_value(self) -> Vec<(usize, f64)> {
        let weights = self.weights.into_iter().map(|[weight, ..]| weight);
        self.vertices.into_iter().zip(weights).collect()
    }

    /// Evaluate the point and its derivatives.
    pub(super) fn jet(&self, vertices: &[DVec3]) -> [DVec3; ORDERS] {
        let mut jet = [DVec3::ZERO; ORDERS];
        for (vertex, weights) in self.vertices.iter().zip(&self.weights) {
            for (sum, weight) in jet.iter_mut().zip(weights) {
                *sum += *weight * vertices[*vertex];
            }
        }
        jet
    }

    /// Pass a gradient by the derivatives on to the vertices.
    pub(super) fn gradient(&self, by_derivative: &[DVec3; ORDERS]) -> Vec<(usize, DVec3)> {
        let terms = self.vertices.iter().zip(&self.weights);
        let gradient = terms.map(|(vertex, weights)| {
            let slopes = weights.iter().zip(by_derivative);
            let slope = slopes.map(|(weight, slope)| *weight * *slope).sum();
            (*vertex, slope)
        });
        gradient
            .filter(|(_, slope)| *slope != DVec3::ZERO)
            .collect()
    }
}
