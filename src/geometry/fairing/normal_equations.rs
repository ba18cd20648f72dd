//! The normal equations of a sum of squares, in skyline form.

use glam::DVec3;

use super::unknowns::Unknowns;
use crate::geometry::banded::BandedCholesky;

/// Gather JᵀJ and Jᵀr of residuals r with the Jacobian J, row by row.
pub(super) struct NormalEquations<'a> {
    unknowns: &'a Unknowns,
    /// For each unknown, the entries from the diagonal leftwards.
    rows: Vec<Vec<f64>>,
    gradient: Vec<f64>,
}

impl<'a> NormalEquations<'a> {
    /// Begin without residuals.
    pub(super) fn new(unknowns: &'a Unknowns) -> Self {
        Self {
            unknowns,
            rows: vec![vec![0.0]; unknowns.len()],
            gradient: vec![0.0; unknowns.len()],
        }
    }

    /// Add a residual with its gradient by the vertices.
    pub(super) fn add(&mut self, residual: f64, gradient: &[(usize, DVec3)]) {
        let axes = self.unknowns.axes();
        for (vertex, slope) in gradient {
            let Some(first) = self.unknowns.first(*vertex) else {
                continue;
            };
            for axis in 0..axes {
                self.gradient[first + axis] += residual * slope[axis];
            }
            for (other, other_slope) in gradient {
                let Some(other_first) = self.unknowns.first(*other).filter(|it| *it <= first)
                else {
                    continue;
                };
                for axis in 0..axes {
                    for other_axis in 0..axes {
                        self.entry(
                            first + axis,
                            other_first + other_axis,
                            slope[axis] * other_slope[other_axis],
                        );
                    }
                }
            }
        }
    }

    /// Add a residual vector of a weight times a combination of vertices.
    pub(super) fn add_vector(&mut self, residual: DVec3, stencil: &[(usize, f64)]) {
        let axes = self.unknowns.axes();
        for (vertex, weight) in stencil {
            let Some(first) = self.unknowns.first(*vertex) else {
                continue;
            };
            for (other, other_weight) in stencil {
                let Some(other_first) = self.unknowns.first(*other).filter(|it| *it <= first)
                else {
                    continue;
                };
                for axis in 0..axes {
                    self.entry(first + axis, other_first + axis, weight * other_weight);
                }
            }
            for axis in 0..axes {
                self.gradient[first + axis] += weight * residual[axis];
            }
        }
    }

    fn entry(&mut self, row: usize, column: usize, value: f64) {
        let Some(offset) = row.checked_sub(column) else {
            return;
        };
        let row = &mut self.rows[row];
        if row.len() <= offset {
            row.resize(offset + 1, 0.0);
        }
        row[offset] += value;
    }

    /// The gradient Jᵀr.
    pub(super) fn gradient(self) -> Vec<f64> {
        self.gradient
    }

    /// The gradient Jᵀr, and the factor of JᵀJ; `None` if that is not positive definite.
    pub(super) fn factor(self) -> Option<(Vec<f64>, BandedCholesky)> {
        Some((self.gradient, BandedCholesky::new(self.rows)?))
    }
}
