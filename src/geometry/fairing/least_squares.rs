//! The rows of a sum of squares, by the coordinates that may change.

use glam::DVec3;

use super::unknowns::Unknowns;
use crate::geometry::banded::{BandedQr, BandedRow};

/// Collect residuals r with the rows of their Jacobian J, and the gradient Jᵀr.
pub(super) struct LeastSquares<'a> {
    unknowns: &'a Unknowns,
    rows: Vec<BandedRow>,
    gradient: Vec<f64>,
}

impl<'a> LeastSquares<'a> {
    /// Begin without residuals.
    pub(super) fn new(unknowns: &'a Unknowns) -> Self {
        Self {
            unknowns,
            rows: Vec::new(),
            gradient: vec![0.0; unknowns.len()],
        }
    }

    /// Add a residual with its gradient by the vertices.
    pub(super) fn add(&mut self, residual: f64, gradient: &[(usize, DVec3)]) {
        let unknowns = self.unknowns;
        let axes = unknowns.axes;
        let moving = || {
            let terms = gradient.iter();
            terms.filter_map(|(vertex, slope)| Some((unknowns.first(*vertex)?, slope)))
        };
        let places = || moving().map(|(first, _)| first);
        let (Some(first), Some(last)) = (places().min(), places().max()) else {
            return;
        };
        let mut entries = vec![0.0; last + axes - first];
        for (place, slope) in moving() {
            for axis in 0..axes {
                entries[place - first + axis] += slope[axis];
                self.gradient[place + axis] += residual * slope[axis];
            }
        }
        self.rows.push(BandedRow {
            first,
            entries,
            right: residual,
        });
    }

    /// Add a residual vector of a combination of vertices.
    pub(super) fn add_vector(&mut self, residual: DVec3, stencil: &[(usize, f64)]) {
        for axis in 0..self.unknowns.axes {
            let along = |(vertex, weight): &(usize, f64)| (*vertex, *weight * DVec3::AXES[axis]);
            let gradient: Vec<(usize, DVec3)> = stencil.iter().map(along).collect();
            self.add(residual[axis], &gradient);
        }
    }

    /// The gradient Jᵀr, and the factors of J and r; `None` if the residuals do not determine all
    /// unknowns.
    pub(super) fn factor(self) -> Option<(Vec<f64>, BandedQr)> {
        let factors = BandedQr::new(self.rows, self.unknowns.len())?;
        Some((self.gradient, factors))
    }
}
